"""Attacks on the grader and on those who are marked beside it.

They aim at nothing but the grader, its other children and files of the batch.
"""

from hostile.submission import Hostile, attack

#: Who else's parent an orphan may get (a user's whole session, say) is none of our aims:
#: outside of a box of its own only a parent whose command line bears the seed is one.
AIM = """
import os, signal
p = os.getppid()
try:
    boxed = os.readlink('/proc/self/ns/pid') != '{pids}'
    if not boxed and '{seed}' not in open(f'/proc/{p}/cmdline').read():
        raise SystemExit('not our parent')
except OSError:
    pass
"""
PARENT = AIM + "if True:\n    "
C = "import ctypes\nc = ctypes.CDLL(None, use_errno=True)\n" + AIM
OTHERS = (
    AIM
    + """
import glob
others = []
for f in glob.glob('/proc/[0-9]*/stat'):
    try:
        words = open(f).read().rsplit(')', 1)[1].split()
    except OSError:
        continue
    if int(words[1]) == p and int(f.split('/')[2]) != os.getpid():
        others.append(int(f.split('/')[2]))
"""
)
REPLIES = """
import os
for d, _, names in os.walk('{tmp}'):
    if not os.getcwd().startswith(d) or d == '{tmp}':
        for n in names:
            if n in ('reply', 'stage', 'job') and not os.getcwd().startswith(d):
                {do}
"""
GOOD_REPLY = """
import json, os, struct
head = json.dumps({'dict': {'notes': [], 'held': [], 'outcomes': [{'dict': {'kind': 'value',
    'text': '', 'printed': '', 'values': [{'array': ['<f8', [3], 0]}]}}] * 3}}).encode()
message = struct.pack('<Q', len(head)) + head + struct.pack('<3d', 2.0, 4.0, 8.0)
"""
EVERY_FD = """
for n in range(3, 64):
    try:
        os.lseek(n, 0, 0)
    except OSError: pass
    try:
        os.write(n, message)
    except OSError: pass
"""
HOOK = """
import gc, sys
for o in gc.get_objects():
    if callable(o) and getattr(o, '__name__', '') == 'hook':
        for cell in o.__closure__ or ():
            cell.cell_contents = '/' if isinstance(cell.cell_contents, str) else []
        vars(sys.modules[o.__module__]) if o.__module__ in sys.modules else None
        o.__globals__.update(REFUSED=(), CHANGES=(), _require_inside=print,
                             _require_outside=print, WRITING=0)
        o.__code__ = (lambda event, details: None).__code__.replace(
            co_freevars=o.__code__.co_freevars)
open('{canary}/a', 'w').write('x')
"""
FRAMES = """
import sys
f = sys._getframe()
while f:
    for v in [*f.f_globals.values()]:
        if getattr(v, '__name__', '').endswith('guard'):
            vars(v).update(REFUSED=(), CHANGES=(), _require_inside=print)
    f = f.f_back
open('{canary}/a', 'w').write('x')
"""
HOOK_LIST = """
import ctypes
ctypes.pythonapi.PySys_AddAuditHook
open('{canary}/a', 'w').write('x')
"""
APPEND = """
for f in ('exercises/verdict.py', 'grading/verdict.py', 'grading/judge.py', '__init__.py'):
    try:
        open('{checkout}/course/' + f, 'a').write('\\n# changed\\n')
    except FileNotFoundError:
        pass
"""
PYC = """
import glob, os
for f in glob.glob('{checkout}/course/**/*.pyc', recursive=True)[:3]:
    open(f, 'ab').write(b'x')
open('{checkout}/course/sitecustomize.py', 'w').write('')
"""
WAYS = {
    "kill-parent": ("parent", PARENT + "os.kill(p, 9)"),
    "terminate-parent": ("parent", PARENT + "os.kill(p, signal.SIGTERM)"),
    "interrupt-parent": ("parent", PARENT + "os.kill(p, signal.SIGINT)"),
    "stop-parent": ("parent", PARENT + "os.kill(p, signal.SIGSTOP)"),
    "hang-up-parent": ("parent", PARENT + "os.kill(p, signal.SIGHUP)"),
    "group-of-parent": ("parent", PARENT + "if os.getpgid(p) == p: os.killpg(p, 9)"),
    "pidfd-parent": ("parent", PARENT + "signal.pidfd_send_signal(os.pidfd_open(p), 9)"),
    "ctypes-kill": ("parent", C + "c.kill(p, 9)"),
    "ctypes-syscall-kill": ("parent", C + "c.syscall(62, p, 9)"),
    "ctypes-tgkill": ("parent", C + "c.syscall(234, p, p, 9)"),
    "ctypes-sigqueue": ("parent", C + "c.sigqueue(p, 9, 0)"),
    "fcntl-owner": ("parent", PARENT + "import fcntl, time\n    r, w = os.pipe()\n"
                    "    fcntl.fcntl(r, fcntl.F_SETOWN, p)\n    fcntl.fcntl(r, 10, 9)\n"
                    "    fcntl.fcntl(r, fcntl.F_SETFL, os.O_ASYNC)\n    os.write(w, b'x')\n"
                    "    time.sleep(0.2)"),
    "lease-or-rlimit-of-parent": ("parent", PARENT + "import resource\n    resource.prlimit("
                                  "p, resource.RLIMIT_CPU, (1, 1))\n    "
                                  "resource.prlimit(p, resource.RLIMIT_NOFILE, (0, 0))"),
    "ptrace-parent": ("parent", C + "if c.ptrace(16, p, 0, 0) == 0:\n"
                      "    os.kill(p, 9)"),
    "write-parents-memory": ("parent", PARENT + """m = open(f'/proc/{p}/mem', 'r+b', 0)
    for line in open(f'/proc/{p}/maps'):
        words = line.split()
        if words[1].startswith('rw') and words[-1] in ('[heap]', '[stack]'):
            a, b = (int(v, 16) for v in words[0].split('-'))
            m.seek(a)
            m.write(bytes(b - a))"""),
    "process-vm-writev": ("parent", C + """class V(ctypes.Structure):
    _fields_ = [('b', ctypes.c_void_p), ('n', ctypes.c_size_t)]
b = ctypes.create_string_buffer(4096)
for line in open(f'/proc/{p}/maps'):
    words = line.split()
    if words[1].startswith('rw') and words[-1] in ('[heap]', '[stack]'):
        a, z = (int(v, 16) for v in words[0].split('-'))
        for at in range(a, z, 4096):
            c.process_vm_writev(p, ctypes.byref(V(ctypes.addressof(b), 4096)), 1,
                                ctypes.byref(V(at, 4096)), 1, 0)"""),
    "kill-siblings": ("neighbour", OTHERS + "for o in others: os.kill(o, 9)"),
    "stop-siblings": ("neighbour", OTHERS + "for o in others: os.kill(o, 19)"),
    "pidfd-siblings": ("neighbour", OTHERS + "import signal\nfor o in others: "
                       "signal.pidfd_send_signal(os.pidfd_open(o), 9)"),
    "limit-siblings": ("neighbour", OTHERS + "import resource\nfor o in others:\n"
                       "    resource.prlimit(o, resource.RLIMIT_FSIZE, (0, 0))\n"
                       "    resource.prlimit(o, resource.RLIMIT_AS, (0, 0))"),
    "delete-replies": ("neighbour", REPLIES.replace("{do}", "os.remove(f'{d}/{n}')")),
    "forge-replies": ("neighbour",
                      REPLIES.replace("{do}", "open(f'{d}/{n}', 'wb').write(b'forged')")),
    "delete-all-in-tmp": ("neighbour", "import glob, shutil, os\nfor f in glob.glob("
                          "'{tmp}/*'):\n    if not os.getcwd().startswith(f):\n"
                          "        shutil.rmtree(f)"),
    "delete-neighbour": ("changed", "import os\nos.remove('{neighbour}')"),
    "change-neighbour": ("changed", "open('{neighbour}', 'w').write('{}')"),
    "rewrite-table": ("changed", "open('{table}', 'a').write('passed,7,7,marked\\n')"),
    "delete-table": ("changed", "import os\nos.remove('{table}')"),
    "lock-table": ("changed", "import fcntl\nf = open('{table}', 'r+')\n"
                   "fcntl.flock(f, fcntl.LOCK_EX)\nf.write('x')"),
    "page-forged": ("changed", "import os\nos.makedirs('{pages}', exist_ok=True)\n"
                    "open('{pages}/Nina--90-toy.html', 'w').write('x')"),
    "hand-in-more": ("changed", "open('{handed_in}/more.ipynb', 'w').write('x')"),
    "change-verdict": ("changed", APPEND),
    "change-bytecode": ("changed", PYC),
    "shadow-numpy": ("changed", "import os\nos.mkdir('{site}/numpy')\n"
                     "open('{site}/numpy/__init__.py', 'w').write('1 / 0')"),
    "fill-reply": ("mark", "import os\nfor n in range(3, 64):\n    try:\n"
                   "        while True: os.write(n, b'x' * 10**6)\n"
                   "    except OSError: pass"),
    "forge-reply-and-exit": ("mark", GOOD_REPLY + EVERY_FD + "os._exit(0)"),
    "forge-reply-and-return": ("mark", GOOD_REPLY + EVERY_FD),
    "forge-reply-by-path": ("mark", GOOD_REPLY
                            + "for f in ('../reply', 'reply', '../out', '../answer'):\n"
                            "    open(f, 'wb').write(message)\nos._exit(0)"),
    "truncate-reply": ("mark", "import os\nfor n in range(3, 64):\n    try:\n"
                       "        os.ftruncate(n, 0)\n        os.ftruncate(n, 10**7)\n"
                       "    except OSError: pass\nos._exit(0)"),
    "reply-a-link": ("mark", "import os\nos.remove('../reply')\n"
                     "os.symlink('{secret}', '../reply')\nos._exit(0)"),
    "reply-a-fifo": ("mark", "import os\nos.remove('../reply')\nos.mkfifo('../reply')\n"
                     "os._exit(0)"),
    "reply-closed": ("mark", "import os\nos.closerange(3, 64)"),
    "reply-moved": ("mark", "import os\nfor n in range(3, 64):\n    try:\n"
                    "        os.dup2(2, n)\n    except OSError: pass"),
    "reply-early-and-loop": ("mark", GOOD_REPLY + EVERY_FD + "while True: pass"),
    "job-changed": ("mark", "for n in ('../job', '../path.json', '../stage'):\n"
                    "    open(n, 'wb').write(b'9' * 99)\nimport os\nos._exit(0)"),
    "stage-forged": ("mark", "import os\nfor n in range(3, 64):\n    try:\n"
                     "        os.lseek(n, 0, 0)\n        os.write(n, b'case 99999999  ')\n"
                     "    except OSError: pass\nos._exit(0)"),
    "ask-for-more-work": ("mark", "import os, socket\nfor n in range(3, 64):\n    try:\n"
                          "        while os.read(n, 10**6): pass\n    except OSError: pass"),
    "fds-passed-on": ("mark", "import os, socket, array\nfor n in range(3, 64):\n    try:\n"
                      "        s = socket.socket(fileno=n)\n        s.sendmsg([b'x'], [("
                      "socket.SOL_SOCKET, socket.SCM_RIGHTS, array.array('i', [0]))])\n"
                      "    except OSError: pass\nos._exit(0)"),
    "priority-raised": ("mark", "import os\nos.nice(-20)\nos.setpriority(0, 0, -20)"),
    "scheduler": ("mark", "import os\nos.sched_setscheduler(0, os.SCHED_FIFO, "
                  "os.sched_param(1))"),
    "scheduler-of-parent": ("mark", PARENT + "os.sched_setaffinity(p, {0})\n    "
                            "os.setpriority(0, p, 19)\n    "
                            "os.sched_setscheduler(p, os.SCHED_IDLE, os.sched_param(0))"),
    "limits-raised": ("mark", "import resource as r\nfor k in (r.RLIMIT_AS, r.RLIMIT_CPU, "
                      "r.RLIMIT_FSIZE, r.RLIMIT_NOFILE):\n"
                      "    r.setrlimit(k, (r.getrlimit(k)[1],) * 2)\n"
                      "    r.setrlimit(k, (r.RLIM_INFINITY, r.RLIM_INFINITY))"),
    "limits-raised-by-prlimit": ("mark", "import resource as r\n"
                                 "r.prlimit(0, r.RLIMIT_AS, (-1, -1))\nb'x' * 10**9"),
    "hook-by-gc": ("changed", HOOK),
    "hook-by-frames": ("changed", FRAMES),
    "hook-by-ctypes": ("changed", HOOK_LIST),
    "prctl": ("mark", C + "c.prctl(1, 0)\nc.prctl(4, 1)\nc.prctl(22, 0)\nc.prctl(15, b'x')"),
    "personality": ("mark", C + "c.personality(0x0040000)\nc.umask(0)"),
    "unshare": ("mark", C + "c.unshare(0x10000000)\nc.unshare(0x7e020000)\n"
                "c.setuid(0)\nc.setgid(0)\nc.capset(0, 0)"),
    "setns-of-parent": ("changed", C + "n = os.open(f'/proc/{p}/ns/mnt', 0)\nc.setns(n, 0)\n"
                        "open('{canary}/a', 'w').write('x')"),
    "proc-parent-root": ("changed", PARENT
                         + "open(f'/proc/{p}/root{canary}/a', 'w').write('x')"),
    "oom-score": ("mark", "import os\nopen(f'/proc/{os.getppid()}/oom_score_adj', 'w')"
                  ".write('1000')"),
    "core-pattern": ("mark", "open('/proc/sys/kernel/core_pattern').read()\n"
                     "print(open('/proc/self/cgroup').read())"),
    "tty-injection": ("mark", "import fcntl\nfor n in range(3):\n    try:\n"
                      "        fcntl.ioctl(n, 0x5412, b'x')\n    except OSError: pass"),
    "dup-parents-file": ("mark", C + "n = c.syscall(434, p, 0)\n"
                         "for i in range(64): c.syscall(438, n, i, 0)"),
    "inotify-flood": ("mark", C + "for i in range(500): c.inotify_init()"),
    "key-rings": ("mark", C + "c.syscall(248, b'user', b'a', b'b', 1, -3)"),
    "semaphores": ("left", C + "for i in range(3): c.semget(0, 1, 0o1600)"),
    "shared-segments": ("left", C + "for i in range(3): c.shmget(0, 4096, 0o1600)"),
    "message-queues": ("left", C + "for i in range(3): c.msgget(0, 0o1600)"),
    "bpf-and-perf": ("mark", C + "c.syscall(321, 0, 0, 0)\nc.syscall(298, 0, 0, -1, -1, 0)\n"
                     "c.syscall(323, 0)"),
    "io-uring": ("mark", C + "c.syscall(425, 4, ctypes.create_string_buffer(120))"),
    "monkeypatch-child": ("mark", "import sys\nm = sys.modules['__main__']\n"
                          "for n in list(vars(m)):\n    if callable(getattr(m, n)):\n"
                          "        setattr(m, n, lambda *a, **k: {'outcomes': []})"),
    "frames-of-the-runner": ("mark", "import sys\nf = sys._getframe()\nwhile f:\n"
                             "    f.f_globals['judge'] = f.f_globals['_same'] = id\n"
                             "    for k, v in list(f.f_globals.items()):\n"
                             "        if callable(v) and k.startswith('_as'):\n"
                             "            f.f_globals[k] = lambda *a: None\n"
                             "    f = f.f_back"),
    "held-emptied": ("mark", "import gc\nfor o in gc.get_objects():\n"
                     "    if isinstance(o, list) and 'memory' in o[:9]: o.clear()"),
}  # fmt: skip
SAMPLE = {"kill-parent", "kill-siblings", "delete-replies", "rewrite-table", "hook-by-gc",
          "change-verdict", "forge-reply-and-exit", "forge-replies"}  # fmt: skip
LONG = {"reply-early-and-loop", "stop-parent", "stop-siblings"}

FAMILY = [
    *[
        attack(f"grader-{n}", code, harm, works_bare=harm != "mark", sample=n in SAMPLE,
               long=n in LONG)
        for n, (harm, code) in WAYS.items()
    ],
    # What an answer leaves behind must not meet the next exercise or the next student.
    attack("grader-leaves-a-module", "open('numpy.py', 'w').write('1 / 0')\n"
           "open('json.py', 'w').write('1 / 0')\nopen('course.py', 'w').write('')",
           when="cell"),
    Hostile("grader-table-in-text", "def twice(x):\n    print('passed,2,2')\n"
            "    raise SystemExit('✓ twice 2/2 Right')\n"),
]  # fmt: skip
