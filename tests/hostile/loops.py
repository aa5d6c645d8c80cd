"""Loops without end, in Python, in C, against signals: each costs its time and no more."""

from hostile.submission import attack

WAYS = {
    "in-function": "while True: pass",
    "except-all": "while True:\n    try:\n        while True: pass\n"
                  "    except BaseException: pass",
    "signals-ignored": "import signal\nfor s in set(signal.Signals) - {9, 19}:\n    try:\n"
                       "        signal.signal(s, signal.SIG_IGN)\n    except OSError: pass\n"
                       "while True: pass",
    "in-del": "class D:\n    def __del__(self):\n        while True: pass\nD()",
    "regex": "import re\nre.match('(a+)+$', 'a' * 60 + 'b')",
    "bigint": "v = 3 ** (10 ** 9)",
    "bigint-text": "import sys\nsys.set_int_max_str_digits(0)\nstr(1 << 10**8)",
    "sum-of-range": "sum(range(10**12))",
    "c-iterator": "import itertools\nall(itertools.repeat(1))",
    "sleep": "import time\ntime.sleep(10**6)",
    "lock": "import threading\nl = threading.Lock()\nl.acquire()\nl.acquire()",
    "pause": "import signal\nsignal.pause()",
    "thread-and-return": "import threading\ndef f():\n    while True: pass\n"
                         "threading.Thread(target=f).start()",
    "join-forever": "import threading\nt = threading.Thread(target=lambda: t2.join())\n"
                    "t2 = threading.main_thread()\nt.start()\nt.join()",
    "read-of-a-pipe": "import os\nos.read(os.pipe()[0], 1)",
    "open-of-a-fifo": "import os\nos.mkfifo('f')\nopen('f').read()",
    "matrix-power": "a = np.ones((3000, 3000))\nwhile True: a = a @ a / 3000",
    "sleeping-reply": "class A:\n    def __array__(self, *a, **k):\n"
                      "        while True: pass\nreturn A()",
    "slow-trickle": "import time\nwhile True:\n    time.sleep(0.1)\n    print('.')",
    "await": "import asyncio\nasyncio.new_event_loop().run_forever()",
    "excepthook": "import sys\ndef f(*a):\n    while True: pass\nsys.excepthook = f\n1 / 0",
    "str-of-exception": "class E(Exception):\n    def __str__(self):\n"
                        "        while True: pass\nraise E",
}  # fmt: skip
QUICK = {"thread-and-return", "excepthook"}
SAMPLE = {"thread-and-return"}

FAMILY = [
    *[
        attack(f"loop-{name}", code, long=name not in QUICK | SAMPLE, sample=name in SAMPLE)
        for name, code in WAYS.items()
    ],
    attack("loop-in-cell", "while True:\n    pass", when="cell", long=True),
    attack("loop-in-cell-except", "while True:\n    try:\n        while 1: 1\n"
           "    except BaseException: 2", when="cell", long=True),
    attack("loop-at-exit", "import atexit\n@atexit.register\ndef f():\n    while True: pass",
           when="cell"),
    attack("loop-while-compiling", "exec('+'.join(['[' * 90 + ']' * 90] * 20_000))",
           long=True),
]  # fmt: skip
