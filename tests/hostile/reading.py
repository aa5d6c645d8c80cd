"""Reading what is nobody's business: no secret comes back, no neighbour's answer counts."""

from hostile.submission import Hostile, attack

SAY = "raise RuntimeError(text)"
WON = "raise RuntimeError('{won}')"
HOLDS = "\nif '{seed}' in text:\n    " + WON
SSH = "{home}/.ssh/id_ed25519"
ENVIRON = "/proc/{p}/environ"
PARENT = "import os\np = os.getppid()\n"

WAYS = {
    "ssh": f"text = open('{SSH}').read()\n{SAY}",
    "ssh-printed": f"print(open('{SSH}').read())\n1 / 0",
    "ssh-by-os-open": f"import os\ntext = os.read(os.open('{SSH}', 0), 99).decode()\n{SAY}",
    "ssh-by-dir-fd": "import os\nn = os.open('{home}', os.O_RDONLY)\ntext = os.read(os.open("
                     f"'.ssh/id_ed25519', 0, dir_fd=n), 99).decode()\n{SAY}",
    "ssh-by-o-path": "import os\nn = os.open('{home}/.ssh', os.O_PATH)\ntext = os.read("
                     f"os.open('id_ed25519', 0, dir_fd=n), 99).decode()\n{SAY}",
    "ssh-by-link": f"import os\nos.symlink('{SSH}', 'k')\ntext = open('k').read()\n{SAY}",
    "ssh-by-hard-link": f"import os\nos.link('{SSH}', 'k')\ntext = open('k').read()\n{SAY}",
    "ssh-by-fromfile": f"text = np.fromfile('{SSH}', 'u1').tobytes().decode()\n{SAY}",
    "ssh-by-linecache": f"import linecache\ntext = linecache.getline('{SSH}', 1)\n{SAY}",
    "ssh-by-glob": "import glob\ntext = open(glob.glob('{home}/.ssh/*')[0]).read()\n" + SAY,
    "ssh-by-walk": "import os\nfor d, _, names in os.walk('{home}'):\n"
                   "    for n in names:\n        try:\n"
                   "            text = open(os.path.join(d, n)).read()\n"
                   "        except (OSError, ValueError):\n            continue\n        " + SAY,
    "ssh-by-exec": f"try:\n    compile(open('{SSH}').read(), 'k', 'exec')\n"
                   "except SyntaxError as e:\n    raise RuntimeError(e.text)",
    "ssh-by-sqlite": "import sqlite3\nc = sqlite3.connect('file:{home}/.db?mode=ro', uri=1)\n"
                     f"text = c.execute('select a from t').fetchone()[0]\n{SAY}",
    "ssh-by-copy": f"import shutil\nshutil.copy('{SSH}', 'k')\ntext = open('k').read()\n{SAY}",
    "ssh-by-proc-root": f"text = open('/proc/self/root{SSH}').read()\n{SAY}",
    "ssh-by-ctypes": "import ctypes\nc = ctypes.CDLL(None)\nb = ctypes.create_string_buffer"
                     f"(99)\nc.read(c.open(b'{SSH}', 0), b, 99)\ntext = b.value.decode()\n{SAY}",
    "ssh-as-values": f"b = open('{SSH}', 'rb').read()\n"
                     "raise RuntimeError(''.join(map(chr, b)))",
    "ssh-as-module": "import sys\nfrom importlib.machinery import SourceFileLoader\n"
                     f"text = SourceFileLoader('k', '{SSH}').get_source('k')\n{SAY}",
    "netrc": "text = open('{home}/.netrc').read()\n" + SAY,
    "solutions": "text = open('{checkout}/solutions/90-toy.ipynb').read()[-300:]\n" + SAY,
    "own-environ": "import os\ntext = str(dict(os.environ))\n" + SAY,
    "proc-self-environ": "text = open('/proc/self/environ').read()\n" + SAY,
    "parents-environ": PARENT + "text = open(f'/proc/{p}/environ').read()\n"
                       "text = text[text.index('GRADER_TOKEN'):]\n" + SAY,
    "any-environ": "import glob\nfor e in glob.glob('/proc/[0-9]*/environ'):\n    try:\n"
                   "        text = open(e).read()\n    except OSError:\n        continue\n"
                   "    if 'GRADER_TOKEN' in text:\n"
                   "        raise RuntimeError(text[text.index('GRADER_TOKEN'):])",
    "environ-by-ps": "import subprocess\ntext = subprocess.run(['ps', 'axeww'], text=True, "
                     "capture_output=True).stdout\n"
                     "text = text[text.index('GRADER_TOKEN'):][:90]\n" + SAY,
    "shadow": "text = open('/etc/shadow').read()\nif text.startswith('root:'):\n    " + WON,
    "seed-in-a-command-line": "import glob\ntext = ''\n"
                              "for f in glob.glob('/proc/[0-9]*/cmdline'):\n    try:\n"
                              "        text += open(f).read()\n    except OSError:\n"
                              "        pass" + HOLDS,
    "seed-in-the-table": "text = open('{table}').read()" + HOLDS,
    "seed-in-parents-memory": PARENT + """
import re
text = ''
m = open(f'/proc/{p}/mem', 'rb')
for line in open(f'/proc/{p}/maps'):
    a, b = (int(v, 16) for v in line.split()[0].split('-'))
    if 'rw' in line and b - a < 10**8:
        m.seek(a)
        if b'GRADER_TOKEN=' in m.read(b - a):
            raise RuntimeError('{won}')""",
    "process-vm-readv": PARENT + """
import ctypes
c = ctypes.CDLL(None, use_errno=True)
a = next(int(v.split('-')[0], 16) for v in open(f'/proc/{p}/maps') if 'rw' in v)
class V(ctypes.Structure): _fields_ = [('b', ctypes.c_void_p), ('n', ctypes.c_size_t)]
b = ctypes.create_string_buffer(64)
if c.process_vm_readv(p, ctypes.byref(V(ctypes.addressof(b), 64)), 1,
                      ctypes.byref(V(a, 64)), 1, 0) == 64:
    raise RuntimeError('{won}')""",
    "parents-files": PARENT + "import glob\n"
                     "for f in glob.glob(f'/proc/{p}/fd/*'):\n    try:\n"
                     "        text = open(f).read(200)\n    except OSError:\n"
                     "        continue\n    if '{secret}'[-9:] in text:\n        " + WON,
    "neighbours-file": "text = open('{neighbour}').read()\n"
                       "raise RuntimeError(text[text.index('KEEP'):][:60])",
    "neighbours-name": "import os\ntext = str(os.listdir('{handed_in}'))\n"
                       "if 'Nina' in text:\n    " + WON,
    "feedback-of-others": "import glob\nfor f in glob.glob('{pages}/*'):\n"
                          "    " + WON,
    "other-folders-in-tmp": "import glob, os\nfor f in glob.glob('{tmp}/*'):\n"
                            "    if not os.getcwd().startswith(f):\n        " + WON,
    "keyring": "import ctypes\nif ctypes.CDLL(None).syscall(250, 0, -3, 0) > 0:\n    pass",
}  # fmt: skip
PROBES = {"keyring", "own-environ", "proc-self-environ", "parents-files"}
SAMPLE = {"ssh", "ssh-by-dir-fd", "parents-environ", "neighbours-file"}

STOLEN = """
import json
cells = json.load(open('{neighbour}'))['cells']
exec([c['source'] for c in cells if 'def twice' in c['source']][0])
"""

FAMILY = [
    *[
        attack(
            f"read-{name}",
            code,
            "mark" if name in PROBES else "told",
            works_bare=name not in PROBES,
            sample=name in SAMPLE,
        )
        for name, code in WAYS.items()
    ],
    Hostile("read-neighbours-answer", STOLEN, sample=True),
]
