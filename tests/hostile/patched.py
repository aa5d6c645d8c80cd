"""Libraries patched so that a wrong answer might look right: no points."""

from hostile.submission import Hostile, attack

TRUE = "lambda *a, **k: True"
NAMES = {
    "np-array-equal": f"np.array_equal = {TRUE}",
    "np-allclose": f"np.allclose = np.isclose = {TRUE}",
    "np-asarray": "old = np.asarray\nnp.asarray = np.array = lambda *a, **k: old([0.0])",
    "np-testing": f"np.testing.assert_allclose = {TRUE}",
    "np-linalg-norm": "np.linalg.norm = np.max = np.abs = lambda *a, **k: 0.0",
    "np-ufuncs": "np.subtract = np.add = lambda a, b, **k: 0 * a\nnp.all = " + TRUE,
    "np-frombuffer": "np.frombuffer = np.ascontiguousarray = lambda *a, **k: np.zeros(3)",
    "builtins-all": f"import builtins\nbuiltins.all = builtins.any = {TRUE}",
    "builtins-isinstance": f"import builtins\nbuiltins.isinstance = {TRUE}",
    "builtins-len": "import builtins\nbuiltins.len = lambda *a: 3",
    "builtins-type": "import builtins\nbuiltins.float = builtins.abs = lambda *a: 0.0",
    "json-dumps": "import json\njson.dumps = lambda *a, **k: '{\"passed\": true}'",
    "json-encoder": "import json.encoder\njson.encoder.c_make_encoder = None\n"
                    "json.JSONEncoder.encode = lambda *a: '{\"dict\": {}}'",
    "os-write": "import os\nold = os.write\nos.write = lambda n, b: old(n, b[:9])",
    "os-exit": "import os\nos._exit = lambda code: None",
    "sys-exit": "import sys\nsys.exit = exit = quit = lambda *a: None",
    "math-isclose": f"import math\nmath.isclose = {TRUE}",
    "struct-pack": "import struct\nstruct.Struct = struct.pack = lambda *a: b'passed'",
    "pickle": "import pickle, copy\npickle.dumps = pickle.loads = copy.deepcopy = id",
    "time": "import time\ntime.time = time.monotonic = time.perf_counter = lambda: 0.0",
    "inspect": f"import inspect\ninspect.getsource = lambda *a: '2 * x'\n"
               f"inspect.signature = {TRUE}",
    "traceback": "import traceback\ntraceback.extract_tb = lambda *a: 1 / 0",
    "ast-parse": "import ast\nast.parse = compile = lambda *a, **k: 1 / 0",
    "sympy-lambdify": "import sympy\nsympy.lambdify = lambda *a: (lambda *b: 0.0)",
    "contextlib": "import contextlib\ncontextlib.redirect_stdout = None",
    "gc-and-weakref": "import gc\ngc.collect = gc.freeze = gc.disable = lambda *a: 1 / 0",
    "sys-modules-emptied": "import sys\nsys.modules.clear()",
    "numpy-replaced": "import sys, types\nsys.modules['numpy'] = types.ModuleType('numpy')",
    "settrace": "import sys\nsys.settrace(lambda *a: None)\nsys.setprofile(lambda *a: None)",
    "audit-hook-of-its-own": "import sys\nsys.addaudithook(lambda *a: 1 / 0)",
    "random-state": "np.random.seed = np.random.default_rng = lambda *a: 1 / 0",
    "rng-known": "np.random.default_rng = np.random.RandomState",
    "wire-found": "import sys\nfor m in list(sys.modules.values()):\n"
                  "    for n in ('pack', 'judge', 'checked_reply', 'compare', '_same'):\n"
                  f"        if hasattr(m, n): setattr(m, n, {TRUE})",
}  # fmt: skip

FAMILY = [
    *[
        attack(name, code, when="cell", sample=name in ("np-array-equal", "os-exit"))
        for name, code in NAMES.items()
    ],
    # A right value, and the input written to: judged where the patch does not reach.
    attack(
        "wrote-to-its-input",
        "np.array_equal = lambda *a, **k: True\nx[...] = 7.0",
        answer="x",
        sample=True,
    ),  # fmt: skip
    attack(
        "wrote-after-reading",
        "y = 2 * x\nx *= 0\nnp.array_equal = lambda *a, **k: True",
        answer="y",
        sample=True,
    ),  # fmt: skip
    attack(
        "wrote-and-patched-array",
        "y = 2 * x\nold = np.ndarray\nx.fill(1.0)\n"
        "import builtins\nbuiltins.all = lambda *a: True\n"
        "np.array_equal = lambda *a, **k: True",
        answer="y",
    ),  # fmt: skip
    attack(
        "wrote-by-memoryview",
        "y = 2 * x\nmemoryview(x.reshape(-1)).cast('B')"
        ".cast('d')[0] = 9.0\nnp.array_equal = lambda *a, **k: True",
        answer="y",
    ),  # fmt: skip
    Hostile(
        "wrote-where-frozen",
        "def twice(x):\n    x.flags.writeable = True\n"
        "    y = 2 * x\n    x[...] = 0\n    return y\n",
    ),  # fmt: skip
]
