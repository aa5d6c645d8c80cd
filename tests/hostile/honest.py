"""Right answers that make noise, or that are written as people write: all points."""

from hostile.submission import honest

F = "def twice(x):\n    return 2 * x\n"
INSIDE = "def twice(x):\n    {}\n    return 2 * x\n"


def _then(before: str, after: str = "") -> str:
    return f"{before}\n\n{F}\n{after}"


FAMILY = [
    honest("prints", INSIDE.format("print('x is', x, '\\n' * 20)")),
    honest("prints-much", _then("for i in range(20_000): print(i, end=' ')")),
    honest(
        "prints-in-colour", INSIDE.format("print('\\x1b[31mred\\x1b[0m \\r \\u2603')")
    ),
    honest("input-before", _then("name = input('Your name? ')"), sample=True),
    honest(
        "input-in-use",
        _then("n = int(input('How many? '))\nfor i in range(n):\n    print(i)"),
    ),
    honest("getpass", _then("import getpass\nword = getpass.getpass()")),
    honest("input-after", _then("", "y = float(input('x? '))\nprint(twice(y))")),
    honest(
        "warns",
        INSIDE.format("import warnings; warnings.warn('old', DeprecationWarning)"),
    ),
    honest(
        "warnings-as-errors", _then("import warnings\nwarnings.simplefilter('error')")
    ),
    honest("divides-by-zero", INSIDE.format("np.array([1.0]) / 0")),
    honest("seterr-raise", _then("np.seterr(all='raise')\nnp.random.seed(0)")),
    honest(
        "set-printoptions", _then("np.set_printoptions(precision=2, suppress=True)")
    ),
    honest(
        "logging",
        _then(
            "import logging\nlogging.basicConfig(level='DEBUG')",
            "logging.warning('twice is ready')",
        ),
    ),  # fmt: skip
    honest("plots-below", _then("", "plt.plot(twice(np.arange(5.0)))\nplt.show()")),
    honest("plots-inside", INSIDE.format("plt.plot(np.ravel(x)); plt.show()")),
    honest(
        "savefig",
        _then("", "plt.plot([1, 2]);\nplt.savefig('a.png')\nplt.close('all')"),
        long=True,
    ),
    honest("interactive-backend", _then("import matplotlib\nmatplotlib.use('TkAgg')")),
    honest(
        "magics",
        _then("%matplotlib inline\n%load_ext autoreload\n%autoreload 2"),
        sample=True,
    ),  # fmt: skip
    honest("time-magic", "%%time\n" + F),
    honest("timeit-below", _then("", "%timeit twice(3.0)\n%time twice(1.0)\ntwice?")),
    honest(
        "shell-lines", _then("!pip install numpy\nfiles = !ls\n!ls | head -3 > a.txt")
    ),
    honest("pip-magic", _then("%pip install numpy", "%%capture")),
    honest("help-lines", _then("np.dot?\nnp.dot??\n?np.dot", "help(twice)")),
    honest("magic-in-block", _then("if True:\n    %pwd\n    !ls")),
    honest("pasted-with-its-indentation", "    def twice(x):\n        return 2 * x"),
    honest("pasted-prompts", ">>> def twice(x):\n...     return 2 * x\n... "),
    honest("pasted-ipython", "In [1]: def twice(x):\n   ...:     return 2 * x"),
    honest("shell-over-two-lines", _then("!ls \\\n  -l\n%pip install \\\n numpy")),
    honest("time-binds", "%time k = 2\ndef twice(x):\n    return k * x"),
    honest("magic-into-a-table", _then("d = {}\nd['here'] = %pwd\nnp.*dot*?")),
    honest(
        "no-magic-in-a-text",
        _then("s = '''\n%pwd\n'''\ny = (7\n% 4)\n%pwd\nassert len(s) == 6 and y == 3"),
    ),
    honest("other-line-ends", _then("s = 'a\x0c%b \u2028!c'\n%pwd")),
    honest("defined-in-a-block", "if True:\n    def twice(x):\n        return 2 * x"),
    honest(
        "defined-in-with",
        "with np.errstate(all='ignore'):\n    def twice(x):\n        return 2 * x",
    ),
    honest(
        "pickles-its-class",
        _then("import pickle\nclass A: pass\npickle.loads(pickle.dumps(A()))"),
    ),
    honest(
        "percent-in-text", _then("s = '''\n%d of 100\n!no shell\n'''\nt = 7 \\\n% 4")
    ),
    honest(
        "get-ipython", _then("get_ipython().run_line_magic('matplotlib', 'inline')")
    ),
    honest(
        "display",
        _then(
            "from IPython.display import Markdown, clear_output, display\n"
            "display(Markdown('**hello**'))\nclear_output(wait=True)"
        ),
        long=True,
    ),  # fmt: skip
    honest(
        "widgets",
        _then(
            "from ipywidgets import interact\n"
            "@interact(k=(1, 5))\ndef show_me(k=1):\n    print(k)"
        ),
        long=True,
    ),  # fmt: skip
    honest("await", _then("import asyncio\nawait asyncio.sleep(0)"), sample=True),
    honest(
        "await-in-loop",
        _then(
            "import asyncio\nfor i in range(3):\n"
            "    await asyncio.sleep(0)\n    print(i)"
        ),
    ),  # fmt: skip
    honest(
        "async-with",
        _then(
            "import asyncio\nlock = asyncio.Lock()\n"
            "async with lock:\n    print('locked')"
        ),
    ),  # fmt: skip
    honest(
        "threads",
        _then(
            "import threading, time\n"
            "threading.Thread(target=time.sleep, args=(9,)).start()"
        ),
    ),  # fmt: skip
    honest(
        "thread-pool",
        "from concurrent.futures import ThreadPoolExecutor\n"
        "def twice(x):\n    with ThreadPoolExecutor(4) as pool:\n"
        "        return np.array(list(pool.map(lambda v: 2 * v, x)))\n",
    ),
    honest("slow-cell", _then("import time\ntime.sleep(0.5)"), sample=True),
    honest("slow-import", _then("import scipy.optimize, scipy.stats"), long=True),
    honest("import-this", _then("import this")),
    honest("clear-screen", _then("import os\nos.system('cls')\nos.system('clear')")),
    honest(
        "runs-a-program",
        _then("import subprocess\nsubprocess.run(['git', '--version'])"),
    ),
    honest("environ", _then("import os\nos.environ['OMP_NUM_THREADS'] = '4'")),
    honest("own-test-fails", _then("", "assert twice(1.0) == 3, 'why?'")),
    honest("error-below", _then("", "print(no_such_name)")),
    honest("exit-below", _then("", "import sys\nsys.exit()")),
    honest("quit-below", _then("", "quit()")),
    honest("atexit", _then("import atexit\natexit.register(print, 'bye')")),
    honest(
        "signal", _then("import signal\nsignal.signal(signal.SIGINT, signal.SIG_DFL)")
    ),
    honest(
        "writes-a-file",
        _then("", "np.save('mine.npy', twice(np.ones(3)))\nprint(np.load('mine.npy'))"),
        sample=True,
    ),  # fmt: skip
    honest("changes-folder", _then("import os\nos.chdir('..')\n%cd ..")),
    honest(
        "tempfile",
        INSIDE.format("import tempfile; tempfile.TemporaryFile().write(b'1')"),
    ),
    honest("star-imports", _then("from math import *\nfrom numpy import *")),
    honest("own-names", _then("import numpy\nx = 3\nnp2 = numpy\ncheck = None")),
    honest(
        "shadows-builtins", _then("list = [1]\nsum = 3\nmax = min = len\nstr = 'a'")
    ),
    honest("deletes", _then("y = 1\ndel y")),
    honest("globals", _then("k = 2", "print(sorted(globals())[:3], locals()['k'])")),
    honest("eval", "factor = 2\ndef twice(x):\n    return eval('factor * x')\n"),
    honest("main-block", _then("", "if __name__ == '__main__':\n    print(twice(2))")),
    honest(
        "helper-cell",
        "def twice(x):\n    return doubled_by(x)\n",
        cells=["def doubled_by(v):\n    return v + v\n\nprint(doubled_by(2))"],
        sample=True,
    ),  # fmt: skip
    honest(
        "helper-cell-with-input",
        "def twice(x):\n    return gain * x\n",
        cells=["input('go on?')\ngain = 2"],
    ),  # fmt: skip
    honest(
        "class-with-call",
        "class T:\n    def __call__(self, x):\n        return 2 * x\ntwice = T()\n",
    ),  # fmt: skip
    honest("lambda", "twice = lambda x: 2 * x"),
    honest(
        "partial",
        "from functools import partial\ndef by(k, x):\n    return k * x\n"
        "twice = partial(by, 2)\n",
    ),  # fmt: skip
    honest("vectorize", "twice = np.vectorize(lambda v: 2 * v)\n"),
    honest(
        "lambdify", "s = sp.symbols('x')\ntwice = sp.lambdify(s, 2 * s)\n", long=True
    ),
    honest(
        "decorated",
        "import functools\ndef loud(f):\n    @functools.wraps(f)\n"
        "    def g(*a):\n        print('called', a)\n        return f(*a)\n"
        "    return g\n\n@loud\n" + F,
    ),  # fmt: skip
    honest("used", F + "\ntwice = use(twice)\nprogress()\nhint(twice)\ncheck(twice)\n"),
    honest(
        "generator-inside",
        "def twice(x):\n    def g():\n        for v in x.T:\n"
        "            yield 2 * v\n    return np.array(list(g())).T\n",
    ),  # fmt: skip
    honest("list-returned", "def twice(x):\n    return (2 * x).tolist()\n"),
    honest(
        "writes-own-copy", "def twice(x):\n    x = x.copy()\n    x *= 2\n    return x\n"
    ),
    honest(
        "ellipsis-index",
        "def twice(x):\n    y = 0 * x\n    y[..., :] = x[...]\n"
        "    ...\n    return y + y\n",
    ),  # fmt: skip
    honest("unicode-names", "def twice(x):\n    Δx, ζ1 = x, 2\n    return ζ1 * Δx\n"),
    honest("windows-lines", F.replace("\n", "\r\n")),
    honest("tabs", "def twice(x):\n\t'''2 x'''\n\tif True:\n\t\treturn 2 * x\n"),
    honest("spaces-behind", "   \n\n" + F.replace(":\n", ":" + " " * 300 + "\n")),
    honest(
        "semicolons", "import numpy as np;\n" + F + "\nplt.plot([1, 2]);\ntwice(1.0);"
    ),
    honest(
        "recursion",
        "def down(n):\n    return n and down(n - 1)\n\n"
        "def twice(x):\n    down(300)\n    return 2 * x\n",
    ),  # fmt: skip
    honest(
        "state-kept", "seen = []\ndef twice(x):\n    seen.append(x)\n    return 2 * x\n"
    ),
    honest(
        "except-all",
        "def twice(x):\n    try:\n        return 2 * x\n"
        "    except:\n        print('no')\n",
    ),  # fmt: skip
    honest(
        "annotated",
        "from __future__ import annotations\n\n"
        "def twice(x: np.ndarray, /, *, k: float = 2) -> NoSuch:\n"
        "    return k * x\n",
    ),  # fmt: skip
    honest(
        "pretty-symbols",
        "sp.init_printing()\na, b = sp.symbols('a b', positive=True)\n"
        "sp.pprint(a * b)\narea = sp.expand((a + 1) * b) - b\n",
        "area",
        long=True,
    ),  # fmt: skip
    honest(
        "symbols-with-input",
        "input()\na, b = sp.symbols('a b')\narea = b * a",
        "area",
        long=True,
    ),  # fmt: skip
    honest(
        "two-results-noisy",
        "def split(x):\n    print(x)\n    return [x[..., 0], x[..., 1:]]\n",
        "split",
    ),  # fmt: skip
    honest("defined-twice", "def twice(x):\n    return 7\n\n" + F),
    honest("breakpoint-below", _then("", "breakpoint()")),
    honest("unraisable", _then("class D:\n    def __del__(self): 1 / 0\nD()")),
    honest(
        "excepthook",
        _then(
            "import sys\nsys.excepthook = lambda *a: print('!')\n"
            "sys.stdout.flush()\nsys.stderr.write('noise')"
        ),
    ),  # fmt: skip
    honest("stdout-replaced", _then("import io, sys\nsys.stdout = io.StringIO()")),
    honest("stdout-closed", _then("import sys\nsys.stdout.close()")),
    honest("tqdm-like", INSIDE.format("print('\\r' + '#' * 40, end='', flush=True)")),
]
