"""Output without end, by every door: cut, told in a few words, no neighbour is delayed."""

from hostile.submission import attack, honest

WAYS = {
    "print": "while True: print('passed' * 1000)",
    "print-except": "while True:\n    try: print('x' * 10_000)\n    except Exception: pass",
    "one-text": "print('x' * 50_000_000)",
    "stderr": "import sys\nwhile True: sys.stderr.write('x' * 10_000)",
    "real-stdout": "import sys\nwhile True: sys.__stdout__.write('x' * 10_000)",
    "fd-1": "import os\nfor i in range(20_000): os.write(1, b'x' * 10_000)",
    "fd-2": "import os\nfor i in range(20_000): os.write(2, b'x' * 10_000)",
    "every-fd": "import os\nfor n in range(64):\n    try:\n"
                "        for i in range(100): os.write(n, b'x' * 100_000)\n"
                "    except OSError: pass",
    "warnings": "import warnings\nwarnings.simplefilter('always')\n"
                "for i in range(10**5): warnings.warn('x' * 1000)",
    "logging": "import logging\nfor i in range(10**5): logging.warning('x' * 1000)",
    "exception-text": "raise ValueError('x' * 50_000_000)",
    "exception-lines": "raise ValueError('\\n' * 10**6)",
    "exception-name": "raise type('E' * 10**6, (Exception,), {})",
    "exception-notes": "e = ValueError('a')\nfor i in range(10**5): e.add_note('x' * 100)\n"
                       "raise e",
    "exception-group": "raise ExceptionGroup('x', [ValueError('y' * 1000)] * 10**5)",
    "long-traceback": "def f(n):\n    return f(n - 1) if n else 1 / 0\nf(900)",
    "attribute-error": "np.zeros(3).__getattribute__('x' * 10**6)",
    "huge-array": "return np.ones(5 * 10**6)",
    "huge-list": "return list(range(3 * 10**6))",
    "huge-text": "return 'x' * 10**7",
    "huge-text-array": "return np.array(['x' * 900] * 20_000)",
    "huge-tuple": "return tuple(range(10**6))",
    "control-characters": "raise ValueError(''.join(map(chr, range(32))) + '\\x7f\\x9b31m')",
    "surrogates": "print('\\ud800' * 500)\nraise ValueError('\\udfff' * 500)",
    "combining": "raise ValueError('a' + '\\u0301' * 100_000)",
    "trace-on": "import sys\nsys.settrace(lambda *a: print(a))\nimport json.tool",
    "hex-of-a-big-one": "print(hex(1 << 8_000_000))\nprint(hex(1 << 8_000_000))",
    "repr-is-huge": "class R:\n    def __repr__(self): return 'R' * 10**7\nraise ValueError(R())",
    "interpreter-dump": "import faulthandler\nfaulthandler.dump_traceback(2)\n"
                        "import this, sys\nprint(sys.modules)\nprint(dir(np))",
    "line-of-source": "v = '" + "y" * 100_000 + "'; raise ValueError(v)",
}  # fmt: skip
SAMPLE = {"print", "exception-text", "surrogates"}
LONG = {"print-except", "real-stdout"}

FAMILY = [
    *[
        attack(f"flood-{name}", code, sample=name in SAMPLE, long=name in LONG)
        for name, code in WAYS.items()
    ],
    honest("flood-just-below", "for i in range(9): print('x' * 90_000)\n"
           "def twice(x):\n    return 2 * x\n"),
]  # fmt: skip
