"""Ends of every form: no points, the batch goes on, and no neighbour is touched."""

from hostile.submission import attack

C = "import ctypes\nc = ctypes.CDLL(None)\n"
WAYS = {
    "os-exit": "import os\nos._exit(0)",
    "os-exit-3": "import os\nos._exit(3)",
    "sys-exit": "import sys\nsys.exit(0)",
    "sys-exit-text": "import sys\nsys.exit('passed')",
    "sys-exit-thread": "import _thread, os\n_thread.start_new_thread(os._exit, (0,))\n"
                       "import time\ntime.sleep(1)",
    "raise-system-exit": "raise SystemExit({'kind': 'value'})",
    "keyboard-interrupt": "raise KeyboardInterrupt",
    "interrupt-main": "import _thread\n_thread.interrupt_main()\nfor i in range(10**6): pass",
    "generator-exit": "raise GeneratorExit",
    "base-exception": "raise type('passed', (BaseException,), {})('2')",
    "stop-iteration": "raise StopIteration(2 * x)",
    "exception-group": "raise BaseExceptionGroup('a', [SystemExit(0), KeyboardInterrupt()])",
    "exception-str-raises": "class E(Exception):\n    def __str__(self): raise SystemExit\n"
                            "    __repr__ = __str__\nraise E",
    "exception-in-a-circle": "a, b = ValueError(), KeyError()\na.__cause__ = b\n"
                             "b.__cause__ = a\nraise a",
    "kill-self": "import os\nos.kill(os.getpid(), 9)",
    "kill-own-group": "import os\nif os.getpgid(0) == os.getpid(): os.killpg(0, 9)",
    "raise-signal": "import signal\nsignal.raise_signal(signal.SIGKILL)",
    "raise-sigterm": "import signal\nsignal.raise_signal(signal.SIGTERM)",
    "raise-sigint": "import signal\nsignal.raise_signal(signal.SIGINT)",
    "abort": "import os\nos.abort()",
    "segfault": "import ctypes\nctypes.string_at(0)",
    "segfault-by-memory": C + "ctypes.memset(16, 0, 8)",
    "segfault-by-code": "f = lambda: 0\nf.__code__ = f.__code__.replace(co_code=b'\\x64\\xff'"
                        " * 20, co_stacksize=1)\nf()",
    "segfault-by-faulthandler": "import faulthandler\nfaulthandler._sigsegv()",
    "ctypes-exit": C + "c._exit(0)",
    "ctypes-exit-flushed": C + "c.exit(0)",
    "ctypes-syscall-exit-group": C + "c.syscall(231, 0)",
    "fatal-error": "import faulthandler\nfaulthandler._fatal_error_c_thread()",
    "recursion": "def f(): f()\nf()",
    "recursion-unlimited": "import sys\nsys.setrecursionlimit(10**9)\ndef f(): f()\nf()",
    "recursion-in-c": "import sys\nsys.setrecursionlimit(10**8)\nv = []\n"
                      "for _ in range(10**6): v = [v]\nrepr(v)",
    "recursion-in-del": "import sys\nv = None\nfor _ in range(10**6): v = (v,)\ndel v",
    "atexit-exit": "import atexit, os\natexit.register(os._exit, 0)",
    "exit-in-del": "import os\nclass D:\n    def __del__(self): os._exit(0)\nD()",
    "exec-true": "import os\nos.execv('/bin/true', ['true'])",
    "stop-self": "import os, signal\nos.kill(os.getpid(), signal.SIGSTOP)",
    "alarm": "import signal, time\nsignal.alarm(1)\ntime.sleep(2)",
    "daemon-thread-raises": "import threading\nthreading.Thread(target=lambda: 1 / 0)"
                            ".start()\nthreading.excepthook = None",
    "closes-every-file": "import os\nos.closerange(0, 100)",
    "exit-0-after-reply-closed": "import os\nfor n in range(3, 100):\n    try:\n"
                                 "        os.close(n)\n    except OSError: pass\nos._exit(0)",
}  # fmt: skip
LONG = {"stop-self", "recursion-unlimited", "alarm"}
SAMPLE = {"os-exit", "kill-self", "segfault", "recursion", "closes-every-file"}

FAMILY = [
    *[
        attack(f"exit-{name}", code, "mark", long=name in LONG, sample=name in SAMPLE)
        for name, code in WAYS.items()
    ],
    attack("exit-in-cell", "import os\nos._exit(0)", when="cell", sample=True),
    attack("kill-in-cell", "import os\nos.kill(os.getpid(), 9)", when="cell"),
    attack("exit-at-second-case", "import os\nglobal n\nn = globals().get('n', 0) + 1\n"
           "if n > 1: os._exit(0)"),
]  # fmt: skip
