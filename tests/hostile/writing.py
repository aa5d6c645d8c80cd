"""Writing outside the working folder by every way there is: nothing outside changes."""

from hostile.submission import attack

SYSCALL = "import ctypes\nlibc = ctypes.CDLL(None, use_errno=True)\n"
WAYS = {
    "open": "open('{canary}/a', 'w').write('x')",
    "open-append": "open('{canary}/kept', 'a').write('x')",
    "os-open": "import os\nos.write(os.open('{canary}/kept', os.O_RDWR), b'x')",
    "dir-fd": "import os\nn = os.open('{canary}', os.O_RDONLY)\n"
              "os.write(os.open('a', os.O_WRONLY | os.O_CREAT, dir_fd=n), b'x')",
    "dir-fd-unlink": "import os\nos.unlink('kept', dir_fd=os.open('{canary}', 0))",
    "dir-fd-rename": "import os\nn = os.open('{canary}', 0)\n"
                     "os.rename('kept', 'gone', src_dir_fd=n, dst_dir_fd=n)",
    "dir-fd-mkdir": "import os\nos.mkdir('d', dir_fd=os.open('{canary}', 0))",
    "dir-fd-mknod": "import os, stat\n"
                    "os.mknod('f', 0o600 | stat.S_IFIFO, dir_fd=os.open('{canary}', 0))",
    "dir-fd-link": "import os\nn = os.open('{canary}', 0)\n"
                   "os.link('kept', 'b', src_dir_fd=n, dst_dir_fd=n)",
    "dir-fd-chmod": "import os\nos.chmod('kept', 0, dir_fd=os.open('{canary}', 0))",
    "fchmod": "import os\nos.fchmod(os.open('{canary}/kept', os.O_RDONLY), 0)",
    "fchdir": "import os\nos.fchdir(os.open('{canary}', 0))\nopen('a', 'w').write('x')",
    "chdir": "import os\nos.chdir('{canary}')\nopen('a', 'w').write('x')",
    "parent-folders": "import os\nopen(os.path.relpath('{canary}') + '/a', 'w').write('x')",
    "symlink": "import os\nos.symlink('{canary}', 's')\nopen('s/a', 'w').write('x')",
    "symlink-race": "import os\nos.symlink('/dev/null', 's')\nos.remove('s')\n"
                    "os.symlink('{canary}/kept', 's')\n"
                    "os.write(os.open('s', os.O_WRONLY), b'x')",
    "hard-link": "import os\nos.link('{canary}/kept', 'h')\nopen('h', 'w').write('x')",
    "rename-into": "import os\nopen('a', 'w').close()\nos.rename('a', '{canary}/a')",
    "replace": "import os\nopen('a', 'w').close()\nos.replace('a', '{canary}/kept')",
    "remove": "import os\nos.remove('{canary}/kept')",
    "truncate": "import os\nos.truncate('{canary}/kept', 0)",
    "ftruncate": "import os\nos.ftruncate(os.open('{canary}/kept', os.O_RDWR), 0)",
    "utime": "import os\nos.utime('{canary}/kept', (0, 0))",
    "rmtree": "import shutil\nshutil.rmtree('{canary}')",
    "copy": "import shutil\nshutil.copy(__import__('sys').executable, '{canary}/py')",
    "pathlib": "import pathlib\npathlib.Path('{canary}', 'a').touch()",
    "mkfifo": "import os\nos.mkfifo('{canary}/f')",
    "mknod": "import os\nos.mknod('{canary}/n')",
    "sqlite": "import sqlite3\nc = sqlite3.connect('{canary}/a.db')\n"
              "c.execute('create table t (a)')\nc.commit()",
    "sqlite-attach": "import sqlite3\nc = sqlite3.connect(':memory:')\n"
                     "c.execute('attach \"{canary}/b.db\" as b')\n"
                     "c.execute('create table b.t (a)')\nc.commit()",
    "sqlite-vacuum-into": "import sqlite3\nsqlite3.connect(':memory:').execute("
                          "\"vacuum into '{canary}/c.db'\")",
    "mmap": "import mmap, os\nm = mmap.mmap(os.open('{canary}/kept', os.O_RDWR), 4)\n"
            "m[:4] = b'xxxx'\nm.flush()",
    "np-memmap": "m = np.memmap('{canary}/kept', 'u1', 'r+')\nm[:4] = 0\nm.flush()",
    "np-save": "np.save('{canary}/a.npy', x)",
    "np-tofile": "np.ones(3).tofile('{canary}/a.bin')",
    "logging": "import logging\nlogging.FileHandler('{canary}/log').emit("
               "logging.makeLogRecord({'msg': 'x'}))",
    "tempfile": "import tempfile\ntempfile.NamedTemporaryFile(dir='{canary}', delete=False)",
    "mkstemp": "import tempfile\ntempfile.mkdtemp(dir='{canary}')",
    "zipfile": "import zipfile\nzipfile.ZipFile('{canary}/z', 'w').writestr('a', 'x')",
    "tarfile": "import io, tarfile\nb = io.BytesIO()\nt = tarfile.open(fileobj=b, mode='w')\n"
               "t.addfile(tarfile.TarInfo('{canary}/t'))\nt.close()\nb.seek(0)\n"
               "tarfile.open(fileobj=b).extractall('/', filter='fully_trusted')",
    "shelve": "import dbm.dumb\ndbm.dumb.open('{canary}/d', 'c')[b'a'] = b'x'",
    "savefig": "import matplotlib.pyplot as plt\nplt.savefig('{canary}/a.svg')",
    "bytecode": "import sys, os\nsys.dont_write_bytecode = False\n"
                "sys.pycache_prefix = '{canary}'\nopen('mine.py', 'w').close()\n"
                "sys.path.insert(0, os.getcwd())\nimport mine",
    "pth": "open('{site}/a.pth', 'w').write('import os')",
    "sitecustomize": "open('{site}/sitecustomize.py', 'w').write('raise SystemExit')",
    "home": "import os\nopen('{home}/.bashrc', 'a').write('x')",
    "tmp": "import os\nopen('{tmp}/left-by-an-answer', 'w').write('x')",
    "faulthandler": "import faulthandler\n"
                    "faulthandler.dump_traceback(open('{canary}/f', 'w'))",
    "trace": "import cProfile\ncProfile.run('1', '{canary}/profile')",
    "ctypes-open": SYSCALL + "libc.creat(b'{canary}/c', 0o600)",
    "ctypes-syscall": SYSCALL + "libc.syscall(83, b'{canary}/c', 0o700)",
    "ctypes-fopen": SYSCALL + "libc.fopen.restype = ctypes.c_void_p\n"
                    "libc.fopen(b'{canary}/f', b'w')",
    "ctypes-found-in-numpy": "import numpy.ctypeslib, sys\nc = sys.modules['ctypes']\n"
                             "c.PyDLL(None).mkdir(b'{canary}/d', 0o700)",
    "proc-self-root": "open('/proc/self/root{canary}/a', 'w').write('x')",
    "proc-self-cwd": "import os\nopen('/proc/self/cwd/' + os.path.relpath('{canary}/a'), "
                     "'w').write('x')",
    "thread": "import threading\nt = threading.Thread(target=lambda: "
              "open('{canary}/a', 'w').write('x'))\nt.start()\nt.join()",
    "chroot-and-back": "import os\nos.mkdir('c')\nn = os.open('/', 0)\nos.chroot('c')\n"
                       "os.fchdir(n)\nopen('.{canary}/a', 'w').write('x')",
    "setxattr": "import os\nos.setxattr('{canary}/kept', 'user.a', b'x')\n"
                "os.chmod('{canary}/kept', 0o777)",
    "mount": SYSCALL + "if libc.unshare(0x10020000): raise OSError(ctypes.get_errno())\n"
             "libc.mount(b'{canary}', b'.', None, 4096, None)\nimport os\n"
             "os.chdir(os.getcwd())\nopen('a', 'w').write('x')",
    "bytes-path": "open(b'{canary}/a', 'w').write('x')",
    "opener": "import os\nopen('a', 'w', opener=lambda p, f: os.open('{canary}/a', f))"
              ".write('x')",
    "pathlike-changes": "import os\nclass P:\n    n = 0\n    def __fspath__(self):\n"
                        "        P.n += 1\n"
                        "        return 'a' if P.n < 2 else '{canary}/a'\n"
                        "open(P(), 'w').write('x')\nopen(P(), 'w').write('x')",
    "finalizer": "import weakref\nclass O: pass\no = O()\nweakref.finalize(o, lambda: "
                 "open('{canary}/a', 'w').write('x'))\ndel o",
}  # fmt: skip
SAMPLE = {"open", "dir-fd", "hard-link", "sqlite", "mmap", "ctypes-open"}

FAMILY = [
    attack(f"write-{name}", code, "changed", works_bare=True, sample=name in SAMPLE)
    for name, code in WAYS.items()
]
