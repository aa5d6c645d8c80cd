"""Notebooks that are green in the kernel, and what their graders have to make of them."""

from grading.toy_lessons import cell

RIGHT = "def thrice(x):\n    return 3 * x"
CHECKED = "\ncheck(thrice)"
PLAIN = "def thrice(x):\n    return k * x" + CHECKED


def mine(source):
    return cell(source)


def answer(source):
    return cell(source, exercise="thrice")


def lessons(source):
    return cell(source, role="lesson")


#: What an answer leans on is what is there when it is checked.
NAMES = {
    "the answer's cell split in two": [
        answer("def twice_it(x):\n    return 2 * x"),
        answer("def thrice(x):\n    return twice_it(x) + x" + CHECKED),
    ],
    "split with the check alone": [
        answer("def thrice(x):\n    return 3 * x"),
        answer("check(thrice)"),
    ],
    "a helper in a copied cell": [
        answer("k = 3\ndef thrice(x):\n    ..."),
        answer(PLAIN),
    ],
    "a number in one of the lesson's own cells": [lessons("k = 3"), answer(PLAIN)],
    "the lesson's own cell, changed": [lessons("k = 2\nk = 3"), answer(PLAIN)],
    "inside if": [mine("if True:\n    k = 3"), answer(PLAIN)],
    "inside try": [
        mine("try:\n    k = int('3')\nexcept ValueError:\n    k = 0"),
        answer(PLAIN),
    ],
    "inside with": [
        mine("import contextlib\nwith contextlib.suppress(OSError):\n    k = 3"),
        answer(PLAIN),
    ],
    "inside for": [mine("for k in range(4):\n    pass"), answer(PLAIN)],
    "by walrus": [mine("print(k := 3)"), answer(PLAIN)],
    "by exec": [mine("exec('k = 3')"), answer(PLAIN)],
    "by globals": [mine("globals()['k'] = 3"), answer(PLAIN)],
    "the answer by exec": [answer("exec('def thrice(x): return 3 * x')" + CHECKED)],
    "the answer inside if": [
        answer("if True:\n    def thrice(x):\n        return 3 * x" + CHECKED)
    ],
    "by a timed line": [mine("%time k = 3"), answer(PLAIN)],
    "by a timed cell": [mine("%%time\nk = 3"), answer(PLAIN)],
    "an import moved": [
        mine("import math as m"),
        answer("def thrice(x):\n    return m.sqrt(9) * x" + CHECKED),
    ],
    "an import below": [
        answer("def thrice(x):\n    import math\n    return math.sqrt(9) * x" + CHECKED)
    ],
    "a value added to": [mine("k = 2"), mine("k += 1"), answer(PLAIN)],
    "an entry changed": [
        mine("k = np.array([2.0])"),
        mine("k[0] = 3"),
        answer(PLAIN),
    ],
    "appended to": [
        mine("parts = [1]"),
        mine("parts.append(2)"),
        answer("def thrice(x):\n    return sum(parts) * x" + CHECKED),
    ],
    "filled": [mine("k = np.zeros(1)"), mine("k.fill(3)"), answer(PLAIN)],
    "summed in a loop": [
        mine("k = 0"),
        mine("for i in range(3):\n    k += 1"),
        answer(PLAIN),
    ],
    "two cells": [mine("a = 1"), mine("k = a + 2"), answer(PLAIN)],
    "a class": [
        mine("class Scale:\n    factor = 3"),
        answer("def thrice(x):\n    return Scale.factor * x" + CHECKED),
    ],
    "a file written and imported": [
        mine("%%writefile scales.py\nk = 3"),
        mine("from scales import k"),
        answer(PLAIN),
    ],
    "a file read": [
        mine("with open('k.txt', 'w') as f:\n    f.write('3')"),
        mine("k = int(open('k.txt').read())"),
        answer(PLAIN),
    ],
    "prompts of Python pasted": [
        answer(">>> def thrice(x):\n...     return 3 * x\n...\n>>> check(thrice)")
    ],
    "prompts of IPython pasted": [
        mine("In [3]: k = 3"),
        answer(
            "In [4]: def thrice(x):\n   ...:     return k * x\n   ...:\n\nIn [5]: check(thrice)"
        ),
    ],
    "await": [
        mine(
            "import asyncio\nasync def three():\n    await asyncio.sleep(0)\n    return 3"
        ),
        mine("k = await three()"),
        answer(PLAIN),
    ],
    "a shell line that goes on": [mine("!echo \\\n  hello\nk = 3"), answer(PLAIN)],
    "a magic line that goes on": [
        mine("%time k = \\\n   3"),
        answer(PLAIN),
    ],
    "what a shell line gives": [mine("files = !ls\nk = 3"), answer(PLAIN)],
    "annotations of the future": [
        mine("from __future__ import annotations"),
        answer("def thrice(x: Not | Known) -> Here:\n    return 3 * x" + CHECKED),
    ],
    "a decorator": [
        mine("def scaled(f):\n    return lambda x: 3 * f(x)"),
        answer("@scaled\ndef thrice(x):\n    return x\n\ncheck(thrice, 'thrice')"),
    ],
    "a cell that fails": [mine("k = 3\n1 / 0"), answer(PLAIN)],
    "a cell that fails between": [mine("k = 3"), mine("nothing_here"), answer(PLAIN)],
    "a loop that was stopped by hand": [
        mine("while True:\n    pass"),
        mine("k = 3"),
        answer(PLAIN),
    ],
    "checked twice, right both times": [
        answer(PLAIN.replace("k *", "3 *")),
        mine("check(thrice)"),
    ],
    "checked while blank, then right": [
        answer("def thrice(x):\n    ..." + CHECKED),
        answer("def thrice(x):\n    return 3 * x" + CHECKED),
    ],
    "changed after the check": [
        answer("k = 3\n" + PLAIN),
        mine("k = 0"),
    ],
    "no check at all": [answer("def thrice(x):\n    return 3 * x")],
    "a magic for pictures": [mine("%matplotlib inline\nk = 3"), answer(PLAIN)],
    "help asked for": [mine("np.sum?\nk = 3"), answer(PLAIN)],
}

#: One event loop runs all cells.
LOOP = {
    "task made and awaited in one cell": [
        mine(
            "import asyncio\n"
            "async def three():\n"
            "    await asyncio.sleep(0.01)\n"
            "    return 3\n"
            "t = asyncio.create_task(three())\n"
            "k = await t"
        ),
        answer(PLAIN),
    ],
    "task made in one cell awaited in another": [
        mine(
            "import asyncio\nasync def three():\n    await asyncio.sleep(0.01)\n    return 3"
        ),
        mine("t = asyncio.create_task(three())"),
        mine("k = await t"),
        answer(PLAIN),
    ],
    "gather": [
        mine(
            "import asyncio\n"
            "async def one():\n"
            "    return 1\n"
            "k = sum(await asyncio.gather(one(), one(), one()))"
        ),
        answer(PLAIN),
    ],
    "a running loop asked for": [
        mine("import asyncio\nloop = asyncio.get_running_loop()\nk = 3"),
        answer(PLAIN),
    ],
    "get_event_loop create_task": [
        mine(
            "import asyncio\n"
            "async def three():\n"
            "    return 3\n"
            "loop = asyncio.get_event_loop()\n"
            "f = loop.create_task(three())"
        ),
        mine("k = await f"),
        answer(PLAIN),
    ],
    "a lock over cells": [
        mine("import asyncio\nlock = asyncio.Lock()"),
        mine("async with lock:\n    k = 3"),
        answer(PLAIN),
    ],
    "async for": [
        mine("async def numbers():\n    for i in range(4):\n        yield i"),
        mine("async for k in numbers():\n    pass"),
        answer(PLAIN),
    ],
    "async comprehension": [
        mine("async def numbers():\n    for i in range(3):\n        yield 1"),
        mine("k = sum([i async for i in numbers()])"),
        answer(PLAIN),
    ],
    "task running behind": [
        mine(
            "import asyncio\n"
            "box = {}\n"
            "async def fill():\n"
            "    box['k'] = 3\n"
            "asyncio.create_task(fill())"
        ),
        mine("await asyncio.sleep(0.05)"),
        answer("def thrice(x):\n    return box['k'] * x" + CHECKED),
    ],
    "background task without sleep": [
        mine(
            "import asyncio\n"
            "box = {}\n"
            "async def fill():\n"
            "    box['k'] = 3\n"
            "t = asyncio.ensure_future(fill())"
        ),
        mine("1"),
        answer("def thrice(x):\n    return box['k'] * x" + CHECKED),
    ],
    "asyncio.run in thread": [
        mine(
            "import asyncio, threading\n"
            "async def three():\n"
            "    return 3\n"
            "out = []\n"
            "th = threading.Thread(target=lambda: out.append(asyncio.run(three())))\n"
            "th.start(); th.join()\n"
            "k = out[0]"
        ),
        answer(PLAIN),
    ],
    "a queue over cells": [
        mine("import asyncio\nq = asyncio.Queue()"),
        mine("await q.put(3)"),
        mine("k = await q.get()"),
        answer(PLAIN),
    ],
    "to_thread": [
        mine("import asyncio\nk = await asyncio.to_thread(lambda: 3)"),
        answer(PLAIN),
    ],
    "check inside async": [
        mine("async def go():\n    check(thrice)"),
        answer(RIGHT),
        mine("await go()"),
    ],
}

#: What a kernel keeps by number, its magics and its shell.
SHELL = {
    "underscore": [mine("1 + 2"), mine("k = _"), answer(PLAIN)],
    "double underscore": [mine("1 + 2"), mine("7"), mine("k = __"), answer(PLAIN)],
    "underscore N": [mine("1 + 2"), mine("k = _2"), answer(PLAIN)],
    "Out N": [mine("1 + 2"), mine("k = Out[2]"), answer(PLAIN)],
    "In N": [mine("k = 3"), mine("exec(In[2])"), answer(PLAIN)],
    "_i": [mine("k = 3"), mine("del k"), mine("exec(_ii)"), answer(PLAIN)],
    "_iN": [mine("k = 3"), mine("del k\nexec(_i2)"), answer(PLAIN)],
    "_ih": [
        mine("k = 3"),
        mine("k = len(_ih)"),
        answer("def thrice(x):\n    return (k - 1) * x" + CHECKED),
    ],
    "_oh": [mine("3"), mine("k = _oh[2]"), answer(PLAIN)],
    "_dh": [
        mine("import os\nk = 3 if str(_dh[0]) == os.getcwd() else 0"),
        answer(PLAIN),
    ],
    "semicolon hides output but keeps _": [
        mine("3;"),
        mine("k = Out.get(2, 3)"),
        answer(PLAIN),
    ],
    "recall %recall-less: %rerun": [
        mine("k = 3"),
        mine("del k"),
        mine("%rerun 2"),
        answer(PLAIN),
    ],
    "%macro": [
        mine("k = 3"),
        mine("%macro again 2\ndel k"),
        mine("again"),
        answer(PLAIN),
    ],
    "autocall on": [
        mine("def put(n):\n    global k\n    k = int(n)"),
        mine("%autocall 1"),
        mine("put 3"),
        answer(PLAIN),
    ],
    "slash call": [
        mine("def put(n):\n    global k\n    k = n"),
        mine("/put 3"),
        answer(PLAIN),
    ],
    "comma call": [
        mine("def put(n, m):\n    global k\n    k = int(n) + int(m)"),
        mine(",put 1 2"),
        answer(PLAIN),
    ],
    "semicolon call": [
        mine("def put(n):\n    global k\n    k = int(n)"),
        mine(";put 3"),
        answer(PLAIN),
    ],
    "help at end": [mine("np.sum?"), mine("k = 3"), answer(PLAIN)],
    "help source": [mine("np.sum??\nk = 3"), answer(PLAIN)],
    "question first": [mine("?np.sum\nk = 3"), answer(PLAIN)],
    "shell idle": [mine("!ls"), mine("k = 3"), answer(PLAIN)],
    "%%bash idle": [mine("%%bash\necho hello"), mine("k = 3"), answer(PLAIN)],
    "shell output counted": [
        mine("files = !ls"),
        mine("k = 3 if len(files) >= 0 else 0"),
        answer(PLAIN),
    ],
    "input unused": [
        mine("name = input('your name? ')\nprint('hello', name)"),
        mine("k = 3"),
        answer(PLAIN),
    ],
    "%run a written file": [
        mine("%%writefile scale.py\nk = 3"),
        mine("%run scale.py"),
        answer(PLAIN),
    ],
    "%run -i": [
        mine("%%writefile scale.py\nk = base + 1"),
        mine("base = 2\n%run -i scale.py"),
        answer(PLAIN),
    ],
    "%load done": [mine("# %load scale.py\nk = 3"), answer(PLAIN)],
    "%load undone": [
        mine("%%writefile scale.py\nk = 3"),
        mine("%load scale.py"),
        mine("k = 3"),
        answer(PLAIN),
    ],
    "%%capture": [mine("%%capture out\nprint('hello')\nk = 3"), answer(PLAIN)],
    "%%capture value": [
        mine("%%capture out\nprint('3')"),
        mine("k = int(out.stdout)"),
        answer(PLAIN),
    ],
    "%%time expression": [mine("%%time\nk = sum([1, 2])\nk"), answer(PLAIN)],
    "%%timeit": [
        mine("%%timeit -n1 -r1\nsum(range(10))"),
        mine("k = 3"),
        answer(PLAIN),
    ],
    "%timeit -o": [
        mine("t = %timeit -o -n1 -r1 sum(range(10))\nk = 3 if t.best > 0 else 0"),
        answer(PLAIN),
    ],
    "%timeit -o q": [
        mine("t = %timeit -q -o -n1 -r1 sum(range(10))"),
        mine("k = 3 if t.average > 0 else 0"),
        answer(PLAIN),
    ],
    "%store": [mine("k = 3\n%store k"), mine("del k\n%store -r k"), answer(PLAIN)],
    "%store other": [mine("%store -r"), mine("k = 3"), answer(PLAIN)],
    "%matplotlib widget": [mine("%matplotlib notebook"), mine("k = 3"), answer(PLAIN)],
    "%config": [
        mine("%config InlineBackend.figure_format = 'retina'\nk = 3"),
        answer(PLAIN),
    ],
    "%load_ext autoreload": [
        mine("%load_ext autoreload\n%autoreload 2"),
        mine("k = 3"),
        answer(PLAIN),
    ],
    "autoreload of a written file": [
        mine("%load_ext autoreload\n%autoreload 2"),
        mine("%%writefile sc.py\nk = 2"),
        mine("import sc"),
        mine("import time; time.sleep(1.1)"),
        mine("%%writefile sc.py\nk = 3"),
        answer("def thrice(x):\n    return sc.k * x\n"),
        mine(" "),
        mine("check(thrice)"),
    ],
    "importlib.reload": [
        mine("%%writefile sd.py\nk = 2"),
        mine("import sd"),
        mine("%%writefile sd.py\nk = 3.0"),
        mine("import importlib\nimportlib.reload(sd)\nk = sd.k"),
        answer(PLAIN),
    ],
    "display": [
        mine(
            "from IPython.display import display, HTML, Markdown, Math, Image\n"
            "display(HTML('<b>3</b>'), Markdown('x'))\n"
            "h = display('a', display_id=True)\n"
            "h.update('b')\n"
            "k = 3"
        ),
        answer(PLAIN),
    ],
    "display handle without import": [
        mine("h = display('a', display_id=True)\nh.update('b')\nk = 3"),
        answer(PLAIN),
    ],
    "clear_output": [
        mine(
            "from IPython.display import clear_output\nclear_output(wait=True)\nk = 3"
        ),
        answer(PLAIN),
    ],
    "get_ipython run_line_magic": [
        mine("get_ipython().run_line_magic('matplotlib', 'inline')\nk = 3"),
        answer(PLAIN),
    ],
    "get_ipython user_ns": [mine("get_ipython().user_ns['k'] = 3"), answer(PLAIN)],
    "get_ipython push": [mine("get_ipython().push({'k': 3})"), answer(PLAIN)],
    "get_ipython run_cell": [mine("get_ipython().run_cell('k = 3')"), answer(PLAIN)],
    "get_ipython ex": [mine("get_ipython().ex('k = 3')"), answer(PLAIN)],
    "get_ipython().system": [mine("get_ipython().system('ls')\nk = 3"), answer(PLAIN)],
    "is it a notebook": [
        mine("try:\n    get_ipython\n    k = 3\nexcept NameError:\n    k = 0"),
        answer(PLAIN),
    ],
    "is it a ZMQ shell": [
        mine("k = 3 if 'ZMQ' in type(get_ipython()).__name__ else 0"),
        answer(PLAIN),
    ],
    "interactiveshell setting": [
        mine(
            "from IPython.core.interactiveshell import InteractiveShell\n"
            "InteractiveShell.ast_node_interactivity = 'all'\n"
            "k = 3"
        ),
        answer(PLAIN),
    ],
    "%who": [mine("%who\n%whos\nk = 3"), answer(PLAIN)],
    "%reset": [
        mine("k = 2"),
        mine("%reset -f"),
        mine("k = 3\nfrom course.workbook import check"),
        answer(PLAIN),
    ],
    "%xdel": [mine("k = 3\nq = 2\n%xdel q"), answer(PLAIN)],
    "%cd": [
        mine("import os\nos.makedirs('deep', exist_ok=True)\n%cd deep"),
        mine("open('a.txt','w').write('3')\n%cd .."),
        mine("k = int(open('deep/a.txt').read())"),
        answer(PLAIN),
    ],
    "%pwd": [mine("here = %pwd\nk = 3 if here else 0"), answer(PLAIN)],
    "%env": [
        mine("%env SCALE=3"),
        mine("import os\nk = int(os.environ['SCALE'])"),
        answer(PLAIN),
    ],
    "%set_env": [
        mine("%set_env SCALE=3"),
        mine("k = %env SCALE"),
        mine("k = int(k)"),
        answer(PLAIN),
    ],
    "%pip": [
        mine("%pip install numpy\nimport numpy as np"),
        mine("k = 3"),
        answer(PLAIN),
    ],
    "!pip": [mine("!pip install numpy"), mine("k = 3"), answer(PLAIN)],
    "%pylab": [mine("%pylab inline --no-import-all"), mine("k = 3"), answer(PLAIN)],
    "%pprint": [mine("%pprint\nk = 3"), answer(PLAIN)],
    "%precision": [mine("%precision 3\nk = 3"), answer(PLAIN)],
    "%history": [mine("%history\nk = 3"), answer(PLAIN)],
    "%prun": [mine("%prun sum(range(10))\nk = 3"), answer(PLAIN)],
    "%prun binds": [mine("%prun k = 3"), answer(PLAIN)],
    "%%prun binds": [mine("%%prun\nk = 3"), answer(PLAIN)],
    "%timeit no bind": [mine("%timeit -n1 -r1 sum([1])\nk = 3"), answer(PLAIN)],
    "%time expr value": [mine("k = %time 1 + 2"), answer(PLAIN)],
    "%%html": [mine("%%html\n<b>hello</b>"), mine("k = 3"), answer(PLAIN)],
    "%%javascript": [
        mine("%%javascript\nalert(1)"),
        mine("%%latex\n$x$"),
        mine("%%markdown\n# x"),
        mine("%%svg\n<svg></svg>"),
        mine("k = 3"),
        answer(PLAIN),
    ],
    "%%python": [mine("%%python\nprint(3)"), mine("k = 3"), answer(PLAIN)],
    "%%script": [
        mine("%%script bash\necho 3"),
        mine("%%sh\nls"),
        mine("k = 3"),
        answer(PLAIN),
    ],
    "%lsmagic": [mine("%lsmagic\n%quickref\n%magic"), mine("k = 3"), answer(PLAIN)],
    "own magic": [
        mine(
            "from IPython.core.magic import register_line_magic, register_cell_magic\n"
            "@register_line_magic\n"
            "def setk(line):\n"
            "    get_ipython().user_ns['k'] = int(line)"
        ),
        mine("%setk 3"),
        answer(PLAIN),
    ],
    "own cell magic": [
        mine(
            "from IPython.core.magic import register_cell_magic\n"
            "@register_cell_magic\n"
            "def doit(line, cell):\n"
            "    exec(cell, get_ipython().user_ns)"
        ),
        mine("%%doit\nk = 3"),
        answer(PLAIN),
    ],
    "unknown magic": [mine("%nothing_of_this"), mine("k = 3"), answer(PLAIN)],
    "unknown cell magic": [
        mine("%%nothing_of_this\nk = 2"),
        mine("k = 3"),
        answer(PLAIN),
    ],
    "%load_ext line_profiler": [
        mine("%load_ext line_profiler"),
        mine("k = 3"),
        answer(PLAIN),
    ],
    "%load_ext memory": [
        mine("%load_ext tensorboard\nk = 4"),
        mine("k = 3"),
        answer(PLAIN),
    ],
    "%%debug/%pdb": [mine("%pdb off\nk = 3"), answer(PLAIN)],
    "%alias": [mine("%alias_magic t time"), mine("%t k = 3"), answer(PLAIN)],
    "%autosave": [mine("%autosave 60\nk = 3"), answer(PLAIN)],
    "%gui": [mine("%gui\nk = 3"), answer(PLAIN)],
    "%colors xmode": [mine("%xmode Minimal\nk = 3"), answer(PLAIN)],
    "%notebook edit": [mine("%dhist\n%pwd\nk = 3"), answer(PLAIN)],
    "%save & run": [
        mine("k = 3"),
        mine("%save -f saved 2"),
        mine("del k"),
        mine("%run saved.py"),
        answer(PLAIN),
    ],
    "ans by %time answer cell": [
        answer("%%time\ndef thrice(x):\n    return 3 * x" + CHECKED)
    ],
    "ans by %%capture": [
        answer("%%capture\ndef thrice(x):\n    return 3 * x"),
        mine("check(thrice)"),
    ],
    "ans checked in %%time": [answer(RIGHT), mine("%%time" + CHECKED)],
    "ans checked in %time": [answer(RIGHT), mine("%time check(thrice)")],
    "ans checked in %%capture": [answer(RIGHT), mine("%%capture" + CHECKED)],
    "ans by %run": [
        mine("%%writefile ans.py\ndef thrice(x):\n    return 3 * x"),
        answer("%run ans.py" + CHECKED),
    ],
    "ans by writefile": [
        mine("%%writefile ans.py\ndef thrice(x):\n    return 3 * x"),
        answer("from ans import thrice" + CHECKED),
    ],
    "ans by import of module": [
        mine("%%writefile ans.py\ndef thrice(x):\n    return 3 * x"),
        answer("import ans\ncheck(ans.thrice)"),
    ],
    "ans by writefile, own cell written": [
        answer("%%writefile ans.py\ndef thrice(x):\n    return 3 * x"),
        mine("from ans import thrice" + CHECKED),
    ],
    "writefile -a": [
        mine("%%writefile ans.py\ndef thrice(x):"),
        mine("%%writefile -a ans.py\n    return 3 * x"),
        mine("from ans import *"),
        answer("check(thrice)"),
    ],
    "%%file": [
        mine("%%file ans.py\ndef thrice(x):\n    return 3 * x"),
        mine("from ans import *"),
        answer("check(thrice)"),
    ],
}

#: Answers bound in every way that Python has, checked in every way.
BOUND = {
    "walrus lambda": [answer("(thrice := lambda x: 3 * x)\ncheck(thrice, 'thrice')")],
    "walrus in check": [answer("check(thrice := lambda x: 3 * x, 'thrice')")],
    "lambda": [answer("thrice = lambda x: 3 * x\ncheck(thrice, 'thrice')")],
    "lambda no check": [answer("thrice = lambda x: 3 * x")],
    "global in function": [
        answer(
            "def make():\n    global thrice\n    def thrice(x):\n        return 3 * x\nmake()"
            + CHECKED
        )
    ],
    "global in function, no check": [
        answer(
            "def make():\n    global thrice\n    def thrice(x):\n        return 3 * x\nmake()"
        )
    ],
    "callable object": [
        answer(
            "class Thrice:\n"
            "    def __call__(self, x):\n"
            "        return 3 * x\n"
            "thrice = Thrice()\n"
            "check(thrice, 'thrice')"
        )
    ],
    "class": [
        answer(
            "class thrice:\n    def __new__(cls, x):\n        return 3 * x" + CHECKED
        )
    ],
    "class no check": [
        answer("class thrice:\n    def __new__(cls, x):\n        return 3 * x\n")
    ],
    "partial": [
        answer(
            "import functools\n"
            "def times(n, x):\n"
            "    return n * x\n"
            "thrice = functools.partial(times, 3)\n"
            "check(thrice, 'thrice')"
        )
    ],
    "vectorize": [
        answer(
            "def g(x):\n    return 3 * x\nthrice = np.vectorize(g)\ncheck(thrice, 'thrice')"
        )
    ],
    "vectorize decorator": [
        answer(
            "@np.vectorize\ndef thrice(x):\n    return 3 * x\ncheck(thrice, 'thrice')"
        )
    ],
    "lru wraps": [
        answer(
            (
                "import functools\n"
                "def log(f):\n"
                "    @functools.wraps(f)\n"
                "    def inner(*a):\n"
                "        return f(*a)\n"
                "    return inner\n"
                "@log\n"
                "def thrice(x):\n"
                "    return 3 * x"
            )
            + CHECKED
        )
    ],
    "alias": [
        answer("def mine(x):\n    return 3 * x\nthrice = mine\ncheck(thrice, 'thrice')")
    ],
    "alias name set": [
        answer("def mine(x):\n    return 3 * x\nmine.__name__ = 'thrice'\ncheck(mine)")
    ],
    "other name given": [
        answer("def mine(x):\n    return 3 * x\ncheck(mine, 'thrice')")
    ],
    "in try": [
        answer(
            "try:\n    def thrice(x):\n        return 3 * x\nexcept Exception:\n    pass"
            + CHECKED
        )
    ],
    "in with": [
        answer(
            (
                "import contextlib\n"
                "with contextlib.nullcontext():\n"
                "    def thrice(x):\n"
                "        return 3 * x"
            )
            + CHECKED
        )
    ],
    "in for": [
        answer(
            "for n in (2, 3):\n    def thrice(x, n=n):\n        return n * x" + CHECKED
        )
    ],
    "in match": [
        answer(
            "match 3:\n    case 3:\n        def thrice(x):\n            return 3 * x"
            + CHECKED
        )
    ],
    "in while": [
        answer(
            "while True:\n    def thrice(x):\n        return 3 * x\n    break" + CHECKED
        )
    ],
    "in else": [
        answer(
            "if False:\n    pass\nelse:\n    thrice = lambda x: 3 * x\ncheck(thrice, 'thrice')"
        )
    ],
    "exec no check": [answer("exec('def thrice(x): return 3 * x')")],
    "globals no check": [answer("globals()['thrice'] = lambda x: 3 * x")],
    "locals update": [
        answer("locals().update(thrice=lambda x: 3 * x)\ncheck(thrice, 'thrice')")
    ],
    "vars": [answer("vars()['thrice'] = lambda x: 3 * x\ncheck(thrice, 'thrice')")],
    "setattr main": [
        answer(
            "import sys\n"
            "setattr(sys.modules['__main__'], 'thrice', lambda x: 3 * x)\n"
            "check(thrice, 'thrice')"
        )
    ],
    "import __main__": [mine("import __main__\n__main__.k = 3"), answer(PLAIN)],
    "__name__ is main": [mine("if __name__ == '__main__':\n    k = 3"), answer(PLAIN)],
    "del and anew": [
        answer(
            "def thrice(x):\n    return 2 * x\ndel thrice\ndef thrice(x):\n    return 3 * x"
            + CHECKED
        )
    ],
    "redefined wrong later, no check": [
        answer(RIGHT + CHECKED),
        mine("if True:\n    def thrice(x):\n        return 2 * x"),
    ],
    "redefined as number later": [
        answer(RIGHT + CHECKED),
        mine("thrice = thrice(np.ones(3))"),
    ],
    "loop over names": [
        answer(RIGHT),
        mine("for name in ['thrice']:\n    check(globals()[name], name)"),
    ],
    "loop over functions": [answer(RIGHT), mine("for f in (thrice,):\n    check(f)")],
    "check as c": [
        mine("from course.workbook import check as c"),
        answer("def thrice(x):\n    return 3 * x\nc(thrice)"),
    ],
    "import course.workbook as w": [
        mine("import course.workbook as w"),
        answer("def thrice(x):\n    return 3 * x\nw.check(thrice)"),
    ],
    "from course import workbook": [
        mine("from course import workbook"),
        answer("def thrice(x):\n    return 3 * x\nworkbook.check(thrice)"),
    ],
    "import star": [mine("from course.workbook import *"), answer(RIGHT + CHECKED)],
    "from checking": [
        mine("from course.workbook.checking import check"),
        answer(RIGHT + CHECKED),
    ],
    "check by keyword": [
        answer("def thrice(x):\n    return 3 * x\ncheck(answer=thrice)")
    ],
    "check by keywords": [
        answer("f = lambda x: 3 * x\ncheck(answer=f, name='thrice')")
    ],
    "check name keyword": [answer("f = lambda x: 3 * x\ncheck(f, name='thrice')")],
    "check in function": [
        answer(RIGHT),
        mine("def all_checks():\n    check(thrice)\nall_checks()"),
    ],
    "check in try": [
        answer(RIGHT),
        mine("try:\n    check(thrice)\nexcept Exception as e:\n    print(e)"),
    ],
    "check in lambda/map": [answer(RIGHT), mine("list(map(check, [thrice]))")],
    "check and show": [answer(RIGHT), mine("result = check(thrice)\nprint(result)")],
    "method bound": [
        answer(
            "class Box:\n"
            "    k = 3\n"
            "    def thrice(self, x):\n"
            "        return self.k * x\n"
            "box = Box()\n"
            "check(box.thrice)"
        )
    ],
    "staticmethod": [
        answer(
            "class Box:\n"
            "    @staticmethod\n"
            "    def thrice(x):\n"
            "        return 3 * x\n"
            "check(Box.thrice)"
        )
    ],
    "nested factory": [
        answer(
            (
                "def make(n):\n"
                "    def thrice(x):\n"
                "        return n * x\n"
                "    return thrice\n"
                "thrice = make(3)"
            )
            + CHECKED
        )
    ],
    "tuple targets": [
        answer("thrice, other = lambda x: 3 * x, None\ncheck(thrice, 'thrice')")
    ],
    "list of functions": [
        answer("fs = {'thrice': lambda x: 3 * x}\ncheck(fs['thrice'], 'thrice')")
    ],
    "starred target": [
        answer("thrice, *rest = [lambda x: 3 * x, 1]\ncheck(thrice, 'thrice')")
    ],
    "for target": [
        answer("for thrice in [lambda x: 3 * x]:\n    pass\ncheck(thrice, 'thrice')")
    ],
    "with as": [
        answer(
            "import contextlib\n"
            "with contextlib.nullcontext(lambda x: 3 * x) as thrice:\n"
            "    pass\n"
            "check(thrice, 'thrice')"
        )
    ],
    "import as": [
        mine("%%writefile h.py\ndef f(x):\n    return 3 * x"),
        answer("from h import f as thrice\ncheck(thrice, 'thrice')"),
    ],
    "def blank first, deleted": [
        answer("def thrice(x):\n    ...\n"),
        mine("exec('def thrice(x): return 3 * x')"),
        mine("check(thrice)"),
    ],
    "blank, then in if": [
        answer("def thrice(x):\n    ..."),
        mine("if True:\n    thrice = lambda x: 3 * x\ncheck(thrice, 'thrice')"),
    ],
    "blank, then global": [
        answer("def thrice(x):\n    ..." + CHECKED),
        mine(
            "def make():\n"
            "    global thrice\n"
            "    thrice = lambda x: 3 * x\n"
            "make()\n"
            "check(thrice, 'thrice')"
        ),
    ],
    "blank, then imported": [
        answer("def thrice(x):\n    ..." + CHECKED),
        mine("%%writefile h.py\ndef thrice(x):\n    return 3 * x"),
        mine("from h import thrice" + CHECKED),
    ],
    "blank, other name checked": [
        answer("def thrice(x):\n    ...\n"),
        mine("def my_function(x):\n    return 3 * x\ncheck(my_function, 'thrice')"),
    ],
    "blank cell left, answer as class": [
        answer("def thrice(x):\n    ..."),
        mine("class thrice:\n    def __new__(cls, x):\n        return 3 * x" + CHECKED),
    ],
    "type hints": [
        answer(
            (
                "from typing import Annotated\n"
                "def thrice(x: np.ndarray) -> np.ndarray:\n"
                "    return 3 * x"
            )
            + CHECKED
        )
    ],
    "numba": [
        answer(
            "from numba import njit\n"
            "@njit\n"
            "def thrice(x):\n"
            "    return 3 * x\n"
            "check(thrice, 'thrice')"
        )
    ],
    "dataclass": [
        mine("from dataclasses import dataclass\n@dataclass\nclass P:\n    k: int = 3"),
        answer("def thrice(x):\n    return P().k * x" + CHECKED),
    ],
    "pickle": [
        mine(
            "import pickle\nclass P:\n    k = 3\np = pickle.loads(pickle.dumps(P()))\nk = p.k"
        ),
        answer(PLAIN),
    ],
    "enum, namedtuple": [
        mine("import enum, collections\nclass E(enum.Enum):\n    K = 3\nk = E.K.value"),
        answer(PLAIN),
    ],
    "inspect.getsource": [
        mine("def f():\n    return 3"),
        mine("import inspect\nk = 3 if 'return 3' in inspect.getsource(f) else 0"),
        answer(PLAIN),
    ],
    "del of import": [
        mine("import math\nk = int(math.sqrt(9))\ndel math"),
        answer(PLAIN),
    ],
    "NotImplemented then": [
        answer("def thrice(x):\n    raise NotImplementedError"),
        mine(RIGHT + CHECKED),
    ],
    "docstring with ...": [
        answer(
            'def thrice(x):\n    """Three times x ..."""\n    ...\n    return 3 * x'
            + CHECKED
        )
    ],
    "yield helper": [mine("def gen():\n    yield 3\nk = next(gen())"), answer(PLAIN)],
    "type statement": [mine("k: int = 3"), answer(PLAIN)],
    "np.random": [
        mine("rng = np.random.default_rng(1)\nk = 3 + 0 * rng.normal()"),
        answer(PLAIN),
    ],
    "warnings error": [
        mine("import warnings\nwarnings.simplefilter('error')\nk = 3"),
        answer(PLAIN),
    ],
    "seterr": [mine("np.seterr(all='raise')\nk = 3"), answer(PLAIN)],
    "print options": [mine("np.set_printoptions(precision=3)\nk = 3"), answer(PLAIN)],
    "recursion limit": [
        mine("import sys\nsys.setrecursionlimit(5000)\nk = 3"),
        answer(PLAIN),
    ],
    "sys.exit cell": [mine("import sys\nsys.exit()"), mine("k = 3"), answer(PLAIN)],
    "exit()": [mine("k = 3"), mine("raise SystemExit"), answer(PLAIN)],
    "raise kbd": [mine("raise KeyboardInterrupt"), mine("k = 3"), answer(PLAIN)],
    "statement after error not run": [mine("k = 3"), mine("1/0\nk = 2"), answer(PLAIN)],
    "cell with syntax error": [
        mine("k = 3"),
        mine("def broken(:\n    pass"),
        answer(PLAIN),
    ],
    "answer checked then syntax error": [
        answer(RIGHT + CHECKED),
        mine("check(thrice\n"),
    ],
    "assert fails": [
        answer(RIGHT + CHECKED),
        mine("assert (thrice(np.ones(3)) == 2).all(), 'no'"),
    ],
    "sys.path append": [
        mine(
            "import sys, os\nsys.path.append('..')\nsys.path.insert(0, os.getcwd())\nk = 3"
        ),
        answer(PLAIN),
    ],
    "ipywidgets": [
        mine(
            "from ipywidgets import interact, FloatSlider\n"
            "@interact(x=(0, 1.0))\n"
            "def f(x=0.5):\n"
            "    return x\n"
            "k = 3"
        ),
        answer(PLAIN),
    ],
    "interact sets k": [
        mine("import ipywidgets as w\ns = w.IntSlider(value=3)\nk = s.value"),
        answer(PLAIN),
    ],
    "plt": [
        mine("plt.plot([1, 2], [3, 4])\nplt.title('x')\nplt.show()\nk = 3"),
        answer(PLAIN),
    ],
    "fig and axes": [
        mine("fig, ax = plt.subplots()\nax.plot([1, 2])\nfig.savefig('a.png')\nk = 3"),
        answer(PLAIN),
    ],
    "pandas-less scipy": [
        mine(
            "import scipy.stats, scipy.spatial\nk = round(scipy.stats.norm.cdf(0) * 6)"
        ),
        answer(PLAIN),
    ],
    "from scipy": [
        mine("from scipy.spatial.transform import Rotation as R\nk = 3"),
        answer(PLAIN),
    ],
    "sympy k": [
        mine("x_, = sp.symbols('x,')\nk = int(sp.solve(x_ - 3)[0])"),
        answer(PLAIN),
    ],
    "course formulas used for compare": [
        mine("import course.formulas as f\nk = 3"),
        answer(PLAIN),
    ],
    "hint called": [answer(RIGHT), mine("hint('thrice')"), mine("check(thrice)")],
    "hint of function": [answer(RIGHT), mine("hint(thrice)" + CHECKED)],
    "progress": [
        answer(RIGHT + CHECKED),
        mine("from course.workbook import progress\nprogress()"),
    ],
    "use": [answer(RIGHT + CHECKED), mine("thrice = use(thrice)\nthrice(np.ones(3))")],
    "time and sleep": [
        mine(
            "import time\n"
            "t = time.perf_counter()\n"
            "time.sleep(0.1)\n"
            "k = round(3 + 0 * (time.perf_counter() - t))"
        ),
        answer(PLAIN),
    ],
}

#: Green with what only the author's machine has: right or a person's, never wrong.
PERSON = {
    "shell echo value": [mine("n = !echo 3"), mine("k = int(n[0])"), answer(PLAIN)],
    "shell echo sx": [mine("n = %sx echo 3"), mine("k = int(n[0])"), answer(PLAIN)],
    "bash out": [mine("%%bash --out n\necho 3"), mine("k = int(n)"), answer(PLAIN)],
    "getoutput": [
        mine("n = get_ipython().getoutput('echo 3')"),
        mine("k = int(n[0])"),
        answer(PLAIN),
    ],
    "subprocess": [
        mine(
            "import subprocess\n"
            "k = int(subprocess.run(['echo', '3'], capture_output=True, text=True).stdout)"
        ),
        answer(PLAIN),
    ],
    "os.popen": [mine("import os\nk = int(os.popen('echo 3').read())"), answer(PLAIN)],
    "input": [mine("k = int(input('factor? '))"), answer(PLAIN)],
    "shell writes file": [
        mine("!echo 'k = 3' > scales2.py"),
        mine("from scales2 import k"),
        answer(PLAIN),
    ],
    "write by %%bash": [
        mine("%%bash\necho 3 > k.txt"),
        mine("k = int(open('k.txt').read())"),
        answer(PLAIN),
    ],
    "python by !": [
        mine("!python -c \"open('k3.txt','w').write('3')\""),
        mine("k = int(open('k3.txt').read())"),
        answer(PLAIN),
    ],
    "twice: wrong then right": [
        answer("def thrice(x):\n    return 2 * x" + CHECKED),
        mine(RIGHT + CHECKED),
    ],
    "module missing": [
        mine("import pandas_that_is_not_here as pd"),
        mine("k = 3"),
        answer(PLAIN),
    ],
}

#: What nobody tried anything with, though some of it is refused.
HARMLESS = {
    "platform": (
        "import platform\n"
        "platform.platform(); platform.node(); platform.processor(); platform.uname(); "
        "platform.python_version(); platform.machine()"
    ),
    "numba": "import numba",
    "scipy.stats": "import scipy.stats\nscipy.stats.norm",
    "matplotlib": (
        "import matplotlib.font_manager\n"
        "import matplotlib.pyplot as plt\n"
        "plt.plot([1]); plt.savefig('x.png'); plt.close()"
    ),
    "tex text": "plt.title(r'$\\alpha$'); plt.savefig('x.pdf')",
    "mpl config": (
        "import matplotlib\n"
        "matplotlib.rcParams['font.size'] = 12\n"
        "matplotlib.use('Agg')\n"
        "plt.style.use('ggplot')\n"
        "plt.figure()"
    ),
    "tempfile": (
        "import tempfile\n"
        "with tempfile.TemporaryDirectory() as d:\n"
        "    open(d + '/a', 'w').write('a')\n"
        "f = tempfile.NamedTemporaryFile('w'); f.write('a'); f.close()\n"
        "f = tempfile.TemporaryFile(); f.close()\n"
        "tempfile.mkdtemp(); tempfile.mkstemp()"
    ),
    "logging": (
        "import logging\n"
        "logging.basicConfig(level=logging.INFO)\n"
        "logging.info('x')\n"
        "logging.FileHandler('a.log').close()"
    ),
    "warnings": "import warnings\nwarnings.warn('x')\nwarnings.filterwarnings('ignore')",
    "cpu_count": (
        "import multiprocessing, os\n"
        "multiprocessing.cpu_count(); os.cpu_count(); os.getpid(); os.getppid(); "
        "os.uname(); os.getcwd(); os.environ.get('HOME'); os.sched_getaffinity(0); "
        "os.getloadavg()"
    ),
    "sleep": "import time\ntime.sleep(0.1)",
    "thread": (
        "import threading\n"
        "t = threading.Thread(target=lambda: None); t.start(); t.join()\n"
        "tm = threading.Timer(0.01, print); tm.start(); tm.join()"
    ),
    "pool": (
        "from concurrent.futures import ThreadPoolExecutor\n"
        "with ThreadPoolExecutor(4) as p:\n"
        "    list(p.map(abs, range(8)))"
    ),
    "thread pool": (
        "from multiprocessing.pool import ThreadPool\n"
        "with ThreadPool(2) as p:\n"
        "    p.map(abs, [1])"
    ),
    "home": (
        "from pathlib import Path\n"
        "Path.home(); Path.cwd(); Path('~').expanduser(); list(Path('.').iterdir()); "
        "Path('a').exists(); Path('/tmp').exists(); list(Path('.').glob('*.npy'))"
    ),
    "init_printing": "sp.init_printing()\nsp.init_session",
    "np.save": (
        "np.save('a.npy', np.ones(3)); np.load('a.npy'); np.savetxt('a.txt', "
        "np.ones(3)); np.loadtxt('a.txt'); np.savez('b', a=1)"
    ),
    "random": (
        "import random, secrets, uuid\n"
        "random.random(); secrets.token_hex(); uuid.uuid4(); uuid.uuid1(); "
        "np.random.default_rng()"
    ),
    "datetime": (
        "import datetime, time, locale, zoneinfo\n"
        "datetime.datetime.now(); time.localtime(); locale.getlocale(); "
        "time.strftime('%c')\n"
        "zoneinfo.ZoneInfo('Europe/Berlin')"
    ),
    "tqdm": (
        "try:\n"
        "    from tqdm.auto import tqdm\n"
        "    list(tqdm(range(3)))\n"
        "except ImportError:\n"
        "    pass"
    ),
    "listdir": (
        "import os, glob\n"
        "os.listdir('.'); os.listdir(); glob.glob('*'); list(os.walk('.')); "
        "os.path.exists('data.csv'); os.scandir('.').close()"
    ),
    "missing file": "try:\n    open('data.csv')\nexcept FileNotFoundError:\n    pass",
    "missing module": "try:\n    import nothing_of_this\nexcept ImportError:\n    pass",
    "mkdir": (
        "import os\n"
        "os.makedirs('figures', exist_ok=True)\n"
        "plt.plot([1]); plt.savefig('figures/a.png')\n"
        "os.remove('figures/a.png'); os.rmdir('figures')"
    ),
    "getpass": "import getpass\ngetpass.getuser",
    "hostname": "import socket\nsocket.gethostname()",
    "user": "import os, pwd\nos.getuid()",
    "psutil": (
        "import resource\n"
        "resource.getrusage(resource.RUSAGE_SELF)\n"
        "import gc; gc.collect(); gc.disable(); gc.enable()"
    ),
    "json csv": (
        "import json, csv, pickle, shelve, sqlite3\n"
        "json.dump([1], open('a.json', 'w'))\n"
        "pickle.dump([1], open('a.pkl', 'wb'))\n"
        "with shelve.open('sh') as s:\n"
        "    s['a'] = 1\n"
        "con = sqlite3.connect('a.db'); con.execute('create table t (a int)'); "
        "con.close()"
    ),
    "sqlite memory": "import sqlite3\ncon = sqlite3.connect(':memory:'); con.close()",
    "ctypes": "import ctypes\nctypes.sizeof(ctypes.c_double)",
    "cffi": (
        "import importlib.util\n"
        "importlib.util.find_spec('cupy')\n"
        "import importlib.metadata\n"
        "importlib.metadata.version('numpy')"
    ),
    "pkg list": "import importlib.metadata as m\nlen(list(m.distributions()))",
    "np.show_config": "np.show_config()\nnp.__version__",
    "np.test": "import numpy.testing as npt\nnpt.assert_allclose(1, 1)",
    "timeit": (
        "import timeit\n"
        "timeit.timeit('1', number=1)\n"
        "import cProfile, pstats, io\n"
        "cProfile.run('1')"
    ),
    "traceback": (
        "import traceback, inspect\n"
        "try:\n"
        "    1/0\n"
        "except Exception:\n"
        "    traceback.print_exc()\n"
        "inspect.stack(); inspect.currentframe()"
    ),
    "doctest": (
        "import doctest\n"
        "def dbl(x):\n"
        "    '''\n"
        "    >>> dbl(1)\n"
        "    2\n"
        "    '''\n"
        "    return 2 * x\n"
        "doctest.testmod()\n"
        "doctest.run_docstring_examples(dbl, globals())"
    ),
    "unittest": (
        "import unittest\n"
        "class T(unittest.TestCase):\n"
        "    def test(self):\n"
        "        self.assertEqual(1, 1)\n"
        "unittest.main(argv=[''], exit=False)"
    ),
    "IPython": (
        "import IPython\n"
        "from IPython.display import Image, display, IFrame, YouTubeVideo\n"
        "display(YouTubeVideo('abc')); IFrame('https://example.org', 10, 10)\n"
        "IPython.version_info; IPython.get_ipython()"
    ),
    "animation": (
        "from matplotlib.animation import FuncAnimation\n"
        "from matplotlib import cm\n"
        "fig, ax = plt.subplots()\n"
        "a = FuncAnimation(fig, lambda i: [], frames=2)\n"
        "a.to_jshtml()"
    ),
    "3d": (
        "from mpl_toolkits.mplot3d import Axes3D\n"
        "fig = plt.figure(); fig.add_subplot(projection='3d'); fig.savefig('a.png')"
    ),
    "asyncio": "import asyncio\nawait asyncio.sleep(0.01)",
    "signal": "import signal, faulthandler\nsignal.getsignal(signal.SIGINT)",
    "subprocess import": "import subprocess, shutil\nshutil.which('ls'); shutil.copy; shutil.disk_usage('.')",
    "shutil": (
        "import shutil, os\n"
        "os.makedirs('d1'); open('d1/a', 'w').close(); shutil.copy('d1/a', 'b'); "
        "shutil.move('b', 'c'); shutil.rmtree('d1'); os.rename('c', 'd'); os.remove('d')"
    ),
    "urllib": (
        "import urllib.request, urllib.parse\n"
        "urllib.parse.quote('a b')\n"
        "try:\n"
        "    import requests\n"
        "except ImportError:\n"
        "    pass"
    ),
    "jit": "from numba import njit\n@njit(cache=True)\ndef f(x):\n    return x + 1\nf(1)",
    "parallel": (
        "from numba import njit, prange\n"
        "@njit(parallel=True)\n"
        "def f(n):\n"
        "    s = 0\n"
        "    for i in prange(n):\n"
        "        s += i\n"
        "    return s\n"
        "f(4)"
    ),
    "mp import": (
        "import multiprocessing as mp\n"
        "mp.current_process(); mp.Lock; mp.get_start_method(allow_none=True)"
    ),
    "warn np": "np.float64(1) / 0",
    "scipy opt": (
        "from scipy.optimize import linprog, minimize\n"
        "minimize(lambda x: x @ x, np.ones(2))\n"
        "linprog([1, 1], A_eq=[[1, 1]], b_eq=[1])"
    ),
    "cvxpy": "import cvxpy as cp\nx = cp.Variable()\ncp.Problem(cp.Minimize(x ** 2)).solve()",
    "plotly": "try:\n    import plotly\nexcept ImportError:\n    pass",
    "k3d": "import k3d\nk3d.plot()",
    "pil": (
        "from PIL import Image\n"
        "Image.fromarray(np.zeros((2, 2), 'uint8')).save('a.png')\n"
        "Image.open('a.png').load()"
    ),
    "sympy lambdify": (
        "x_ = sp.symbols('x')\n"
        "f = sp.lambdify(x_, x_ ** 2)\n"
        "f(2)\n"
        "sp.latex(x_); sp.pprint(x_); sp.plot(x_, show=False)"
    ),
    "help": "help(np.sum)\nhelp('modules numpy.lib') if 0 else None",
    "pydoc": "import pydoc\npydoc.render_doc('len')",
    "typing": (
        "import typing, abc, dataclasses, enum, itertools, operator, functools, math, "
        "cmath, fractions, decimal, statistics, heapq, bisect, array, struct, copy, "
        "string, re, textwrap, pprint, collections, contextlib, io, types, weakref, "
        "queue, sched, calendar, hashlib, hmac, base64, zlib, gzip, bz2, lzma, zipfile, "
        "tarfile, configparser, argparse, html, xml.etree.ElementTree, ssl, email, "
        "http.client, selectors, select, mmap, codecs, unicodedata, difflib, ast, dis, "
        "tokenize, symtable, code, codeop, pdb, bdb, trace, tracemalloc, sysconfig, "
        "site, venv, ensurepip, runpy, pkgutil, modulefinder, zipimport, webbrowser, "
        "curses, readline, cmd, shlex"
    ),
    "tracemalloc": (
        "import tracemalloc, sys\n"
        "tracemalloc.start(); tracemalloc.stop(); sys.getsizeof(1); sys.getrefcount(1); "
        "sys.version; sys.executable"
    ),
    "gc objects": "import gc\nlen(gc.get_stats())",
    "pandas": (
        "try:\n"
        "    import pandas as pd\n"
        "    pd.DataFrame({'a': [1]}).to_csv('a.csv')\n"
        "    pd.read_csv('a.csv')\n"
        "except ImportError:\n"
        "    pass"
    ),
    "mmap": (
        "a = np.memmap('a.dat', dtype='f8', mode='w+', shape=(3,))\n"
        "a[:] = 1; a.flush(); del a"
    ),
    "stdout write": (
        "import sys\n"
        "sys.stdout.write('a'); sys.stdout.flush(); sys.stderr.write('b'); "
        "sys.stdout.isatty(); sys.stdin; sys.stdout.encoding"
    ),
    "stdout fileno": "import sys\ntry:\n    sys.stdout.fileno()\nexcept Exception:\n    pass",
    "devnull": "import os\nopen(os.devnull, 'w').write('a')\nopen('/dev/null').read()",
    "site": "import site\nsite.getsitepackages(); site.getusersitepackages()",
    "terminal": "import shutil, os\nshutil.get_terminal_size()",
    "hostinfo": (
        "import sys\n"
        "sys.platform; sys.getdefaultencoding(); sys.flags; sys.getfilesystemencoding()"
    ),
    "nosuch home file": (
        "import os\n"
        "os.path.exists(os.path.expanduser('~/.bashrc')); os.path.isfile('../data.csv'); "
        "os.path.isdir('..')"
    ),
    "relative file": (
        "import pathlib\n"
        "try:\n"
        "    np.load('../data/points.npy')\n"
        "except FileNotFoundError:\n"
        "    pass"
    ),
}

GREEN = NAMES | LOOP | SHELL | BOUND
