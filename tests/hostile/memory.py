"""Memory by every road: bounded, also where no limit of a process counts it.

Each attack holds at most 1.2 GB, twice what a run may have here, and tells if it could.
"""

from hostile.submission import attack

WON = "raise RuntimeError('{won}')"
MB = 1_200
WAYS = {
    "bytes": f"v = []\nfor i in range({MB // 10}): v.append(b'x' * 10_000_000)\n{WON}",
    "bytearray": f"v = bytearray({MB}_000_000)\nv[::4096] = b'x' * len(v[::4096])\n{WON}",
    "arrays": f"v = [np.ones(10**6) for i in range({MB // 8})]\n{WON}",
    "list": f"v = [0] * {MB // 8}_000_000\n{WON}",
    "text": f"v = 'x' * {MB}_000_000\n{WON}",
    "mmap-private": f"import mmap\nm = mmap.mmap(-1, {MB}_000_000, mmap.MAP_PRIVATE | "
                    f"mmap.MAP_ANONYMOUS)\nm.write(b'x' * 1000)\n{WON}",
    "mmap-shared": f"import mmap\nfor i in range({MB // 20}):\n"
                   "    m = mmap.mmap(-1, 20_000_000)\n    m.write(b'x' * 20_000_000)\n"
                   f"    globals()[f'm{{i}}'] = m\n{WON}",
    "memfd": f"import os\nn = os.memfd_create('a')\nfor i in range({MB // 10}):\n"
             f"    if os.write(n, b'x' * 10_000_000) < 10_000_000: break\nelse:\n    {WON}",
    "memfd-many": f"import os\nfor i in range({MB // 40}):\n    n = os.memfd_create('a')\n"
                  f"    for j in range(4): os.write(n, b'x' * 10_000_000)\n{WON}",
    "shm": f"import os\nfor i in range({MB // 40}):\n"
           "    n = os.open(f'/dev/shm/{os.getpid()}-{i}', os.O_RDWR | os.O_CREAT)\n"
           f"    os.unlink(f'/dev/shm/{{os.getpid()}}-{{i}}')\n"
           f"    for j in range(4): os.write(n, b'x' * 10_000_000)\n{WON}",
    "shared-memory": "from multiprocessing.shared_memory import SharedMemory\n"
                     f"for i in range({MB // 40}):\n    s = SharedMemory(create=True, "
                     "size=40_000_000)\n    s.unlink()\n    s.buf[:] = b'x' * 40_000_000\n"
                     f"    globals()[f's{{i}}'] = s\n{WON}",
    "files": f"for i in range({MB // 40}):\n    with open(f'big{{i}}', 'wb') as f:\n"
             f"        for j in range(4): f.write(b'x' * 10_000_000)\n{WON}",
    "unlinked-files": f"import os\nfor i in range({MB // 40}):\n    f = open('big', 'wb')\n"
                      "    os.unlink('big')\n"
                      "    for j in range(4): f.write(b'x' * 10_000_000)\n"
                      f"    globals()[f'f{{i}}'] = f\n{WON}",
    "many-small-files": f"for i in range(20_000): open(str(i), 'w').close()\n{WON}",
    "many-folders": f"import os\nfor i in range(20_000): os.mkdir(str(i))\n{WON}",
    "deep-folders": "import os\nfor i in range(3_000):\n    os.mkdir('d')\n    os.chdir('d')",
    "closed-folders": "import os\nos.mkdir('d')\nopen('d/a', 'w').close()\nos.chmod('d', 0)\n"
                      "os.chmod('.', 0)",
    "pipes": f"import os\nfor i in range(1200):\n    r, w = os.pipe()\n"
             f"    os.set_blocking(w, False)\n    os.write(w, b'x' * 65536)\n{WON}",
    "sockets": "import socket\nv = []\nfor i in range(600):\n    v += [socket.socketpair()]\n"
               f"    v[-1][0].setblocking(False)\n    v[-1][0].send(b'x' * 100_000)\n{WON}",
    "threads": "import threading, time\nfor i in range(2000):\n"
               "    threading.Thread(target=time.sleep, args=(9,), daemon=True).start()",
    "small-stack-threads": "import threading, time\nthreading.stack_size(32768)\n"
                           "for i in range(2000):\n    threading.Thread("
                           "target=time.sleep, args=(9,), daemon=True).start()",
    "mapped-many-times": "import mmap\nv = [mmap.mmap(-1, 4096) for i in range(70_000)]",
    "recursion": "import sys\nsys.setrecursionlimit(10**7)\n"
                 "def f(n):\n    v = [0] * 1000\n    return f(n + 1) + len(v)\nf(0)",
    "sparse-file": "open('s', 'wb').truncate(10**12)",
    "fallocate": f"import os\nos.posix_fallocate(os.open('s', 66), 0, {MB}_000_000)\n{WON}",
    "swallowed": "v = []\nfor i in range(300):\n    try:\n        v.append(bytes(10**8))\n"
                 "    except MemoryError:\n        pass",
    "children-share": "import os, time\nfor i in range(4):\n    if os.fork() == 0:\n"
                      "        v = b'x' * 400_000_000\n        time.sleep(3)\n"
                      "        os._exit(0)\n" + WON,
}  # fmt: skip
SAMPLE = {"bytes", "memfd", "unlinked-files"}
SILENT = {"deep-folders", "closed-folders", "threads", "small-stack-threads",
          "mapped-many-times", "recursion", "sparse-file", "swallowed"}  # fmt: skip

FAMILY = [
    attack(
        f"memory-{name}",
        code,
        "mark" if name in SILENT else "told",
        works_bare=name not in SILENT,
        sample=name in SAMPLE,
    )
    for name, code in WAYS.items()
]
