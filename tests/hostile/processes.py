"""Other processes, by every call there is: none is left, and none works after the run.

Each child would write into the canary folder half a second after its parent has gone.
"""

from hostile.submission import attack

LATER = (
    "import os, signal, time\\nsignal.signal(1, signal.SIG_IGN)\\n"
    "os.setsid() if os.getpid() != os.getsid(0) else 0\\n"
    "time.sleep(0.5)\\nopen('{canary}/from-a-child', 'w').write('x')\\ntime.sleep(4)"
)
CHILD = f"""
import os, sys, time
LATER = "{LATER}"
ARGV = [sys.executable, '-I', '-S', '-c', LATER]
"""
FORKED = """
if {pid} == 0:
    exec(LATER)
    os._exit(0)
time.sleep(0.3)
"""
CLONE = "import ctypes\nc = ctypes.CDLL(None)\n"
INTERPRETER = """
try:
    import _xxsubinterpreters as s
except ImportError:
    import _interpreters as s
try:
    i = s.create(isolated=False)
except TypeError:
    i = s.create('legacy')
s.run_string(i, "open('{canary}/a', 'w').write('x')\\nimport os; os.system('sleep 9 &')")
"""
SPAWN = "os.posix_spawn(sys.executable, ARGV, {})\ntime.sleep(0.3)"
FRESH = """
import importlib.machinery as m, importlib.util as u
for n in [n for n in sys.modules if n == '_posixsubprocess']: del sys.modules[n]
import _posixsubprocess as p
s = u.find_spec('_posixsubprocess')
if s.origin and s.origin != 'built-in':
    p = u.module_from_spec(s)
    s.loader.exec_module(p)
e = os.pipe()
p.fork_exec(ARGV, [sys.executable.encode()], True, (e[1],), None, None, -1, -1, -1, -1,
            -1, -1, *e, False, False, -1, None, None, None, -1, None, False)
time.sleep(0.3)
"""
DAEMON = """
if os.fork() == 0:
    os.setsid()
    if os.fork():
        os._exit(0)
    os.chdir('/')
    for n in range(3, 30):
        try: os.close(n)
        except OSError: pass
    exec(LATER)
time.sleep(0.3)
"""
ROW = """
if os.fork() == 0:
    os.setsid()
    for _ in range(80):
        time.sleep(0.1)
        try:
            text = open('{table}').read()
            open('{table}', 'w').write(text.replace(',0,7,marked', ',7,7,marked'))
            open('{canary}/rewrote', 'a').write('x')
        except OSError:
            pass
    os._exit(0)
"""
WAYS = {
    "fork": FORKED.replace("{pid}", "os.fork()"),
    "forkpty": FORKED.replace("{pid}", "os.forkpty()[0]"),
    "daemon": DAEMON,
    "daemon-rewrites-its-row": ROW,
    "posix-spawn": SPAWN,
    "posix-spawn-setsid": SPAWN.replace("{})", "{}, setsid=True)"),
    "posix-spawnp": SPAWN.replace("spawn(", "spawnp("),
    "spawnv": "os.spawnv(os.P_NOWAIT, sys.executable, ARGV)\ntime.sleep(0.3)",
    "system": "open('c.py', 'w').write(LATER)\n"
              "os.system(f'{sys.executable} -I -S c.py &')\ntime.sleep(0.3)",
    "popen": "open('c.py', 'w').write(LATER)\n"
             "os.popen(f'{sys.executable} -I -S c.py &')\ntime.sleep(0.3)",
    "subprocess": "import subprocess\n"
                  "subprocess.Popen(ARGV, start_new_session=True)\ntime.sleep(0.3)",
    "pty": "import pty\nif pty.fork()[0] == 0:\n    exec(LATER)\ntime.sleep(0.3)",
    "multiprocessing": "import multiprocessing as m\n"
                       "m.get_context('fork').Process(target=exec, args=(LATER,)).start()\n"
                       "time.sleep(0.3)",
    "process-pool": "from concurrent.futures import ProcessPoolExecutor as P\n"
                    "import multiprocessing as m\n"
                    "P(1, m.get_context('fork')).submit(exec, LATER)\ntime.sleep(0.3)",
    "posixsubprocess-fresh": FRESH,
    "subinterpreter": INTERPRETER,
    "ctypes-fork": CLONE + FORKED.replace("{pid}", "c.fork()"),
    "ctypes-syscall-fork": CLONE + FORKED.replace("{pid}", "c.syscall(57)"),
    "ctypes-syscall-clone": CLONE
        + FORKED.replace("{pid}", "c.syscall(56, 17, 0, 0, 0, 0)"),
    "ctypes-syscall-clone3": CLONE
        + "b = (ctypes.c_uint64 * 11)()\nb[4] = 17\n"
        + FORKED.replace("{pid}", "c.syscall(435, b, 88)"),
    "ctypes-clone-new-pid-space": CLONE
        + FORKED.replace("{pid}", "c.syscall(56, 0x20000000 | 17, 0, 0, 0, 0)"),
    "ctypes-system": CLONE + "open('c.py', 'w').write(LATER)\n"
                     "c.system(f'{sys.executable} -I -S c.py &'.encode())\ntime.sleep(0.3)",
    "exec": "os.execv(sys.executable, ARGV)",
    "exec-by-fd": "os.execve(os.open(sys.executable, os.O_RDONLY), ARGV, {})",
    "atexit-fork": "import atexit\natexit.register(lambda: os.fork() or exec(LATER))\n"
                   "atexit._run_exitfuncs()",
    "thread-forks": "import threading\nt = threading.Thread(target=lambda: os.fork() or "
                    "exec(LATER))\nt.start()\ntime.sleep(0.3)",
    "fork-many": "for i in range(60):\n    if os.fork() == 0:\n        exec(LATER)\n"
                 "        os._exit(0)\ntime.sleep(0.3)",
    "asyncio-subprocess": "import asyncio\nasync def m():\n"
                          "    await asyncio.create_subprocess_exec(*ARGV)\n"
                          "    await asyncio.sleep(0.3)\nasyncio.run(m())",
    "webbrowser": "import webbrowser\nopen('c.py', 'w').write(LATER)\n"
                  "webbrowser.BackgroundBrowser([sys.executable, '-I', '-S', 'c.py'])"
                  ".open('a')\ntime.sleep(0.3)",
    "stops-in-the-child": FORKED.replace("{pid}", "os.fork()").replace(
        "exec(LATER)", "import signal; signal.signal(15, signal.SIG_IGN); exec(LATER)"),
}  # fmt: skip
SAMPLE = {"fork", "daemon", "posixsubprocess-fresh", "daemon-rewrites-its-row"}

HARMS = dict.fromkeys(("exec", "exec-by-fd", "subinterpreter"), "changed")

FAMILY = [
    attack(
        f"process-{name}",
        CHILD + code,
        HARMS.get(name, "left"),
        works_bare=True,
        sample=name in SAMPLE,
    )
    for name, code in WAYS.items()
]
