"""The reference itself handed in as the answer, by plain and by crooked ways: no points.

The toy lessons lie where the real ones do, in the copy of the course that is graded by:
``course.exercises.definitions.toy_lessons``, whose ``TWICE.reference`` is right.
"""

from hostile.submission import Hostile, attack

TOYS = "course.exercises.definitions.toy_lessons"
HERE = "{checkout}/course/exercises/definitions/toy_lessons.py"
PATH = "import sys\nsys.path[:0] = ['{checkout}', '{checkout}/tests']\n"
FORGET = (
    "for n in [n for n in sys.modules if n.split('.')[0] == 'course']:\n"
    "    del sys.modules[n]\n"
    "sys.meta_path[:] = [m for m in sys.meta_path if 'Finder' != type(m).__name__[-6:]\n"
    "                    or type(m).__module__ != 'course.grading.stand_ins']\n"
)
FRESH = """
import importlib.machinery, sys
sys.meta_path[:] = [importlib.machinery.BuiltinImporter,
                    importlib.machinery.FrozenImporter, importlib.machinery.PathFinder]
"""


def crooked(name, code, **more):
    """A cell that ends with ``twice = ...`` by some way."""
    return Hostile(name, code, harm="mark", **more)


def call(name, code, answer, **more):
    return attack(name, code, answer=answer, **more)


FAMILY = [
    crooked("import", f"from {TOYS} import TWICE\ntwice = TWICE.reference", sample=True),
    crooked("import-use", f"from course.workbook import use\nimport {TOYS} as t\n"
            "twice = use(t.TWICE.reference)"),
    crooked("use-alone", "@use\ndef twice(x):\n    ..."),
    crooked("use-a-wrong-one", "@use\ndef twice(x):\n    return 3 * x"),
    crooked("dynamics", "from course.dynamics import impulse_central\n"
            "twice = lambda x: impulse_central(x, 2.0, 3.0)"),
    crooked("importlib", f"import importlib\ntwice = importlib.import_module("
            f"'{TOYS}').TWICE.reference"),
    crooked("path-and-import", PATH + f"import {TOYS} as t\ntwice = t.TWICE.reference"),
    crooked("path-and-fresh-finders", PATH + FORGET + FRESH
            + f"import {TOYS} as t\ntwice = t.TWICE.reference", sample=True),
    crooked("by-file", "import importlib.util as u, sys\n"
            f"spec = u.spec_from_file_location('toys', '{HERE}')\n"
            "sys.path.insert(0, '{checkout}')\n" + FORGET
            + "m = u.module_from_spec(spec)\nspec.loader.exec_module(m)\n"
            "twice = m.TWICE.reference"),
    crooked("by-text", f"text = open('{HERE}').read()\n"
            "twice = eval(text[text.index('lambda x: 2'):][:15])"),
    crooked("by-io-open-code", f"import io\ntext = io.open_code('{HERE}').read().decode()\n"
            "twice = eval(text[text.index('lambda x: 2'):][:15])"),
    crooked("by-os-open", "import os\nn = os.open('{checkout}', os.O_RDONLY)\n"
            f"m = os.open('{HERE.removeprefix('{checkout}/')}', os.O_RDONLY, dir_fd=n)\n"
            "text = os.read(m, 9999).decode()\n"
            "twice = eval(text[text.index('lambda x: 2'):][:15])", sample=True),
    crooked("by-linecache", f"import linecache\ntext = ''.join(linecache.getlines('{HERE}'))\n"
            "twice = eval(text[text.index('lambda x: 2'):][:15])"),
    crooked("by-mmap-of-numpy", f"text = bytes(np.memmap('{HERE}', 'u1', 'r')).decode()\n"
            "twice = eval(text[text.index('lambda x: 2'):][:15])"),
    crooked("by-link", f"import os\nos.symlink('{HERE}', 'a.py')\ntext = open('a.py').read()\n"
            "twice = eval(text[text.index('lambda x: 2'):][:15])"),
    crooked("by-bytecode", "import glob, marshal, types\n"
            f"f = glob.glob('{HERE[:-14]}__pycache__/toy_lessons*.pyc')[0]\n"
            "c = marshal.loads(open(f, 'rb').read()[16:])\n"
            "twice = [types.FunctionType(k, {}) for k in c.co_consts\n"
            "         if getattr(k, 'co_name', '') == '<lambda>'][0]"),
    crooked("by-inspect", f"import inspect, sys\nm = sys.modules.get('{TOYS}')\n"
            "text = inspect.getsource(m)\n"
            "twice = eval(text[text.index('lambda x: 2'):][:15])"),
    crooked("sys-modules", f"import sys\ntwice = sys.modules['{TOYS}'].TWICE.reference"),
    crooked("gc-objects", "import gc\ntwice = [o for o in gc.get_objects() if getattr(o, "
            "'name', '') == 'twice' and hasattr(o, 'reference')][0].reference"),
    crooked("subclasses", "twice = [s for s in object.__subclasses__() if s.__name__ == "
            "'Exercise'][0]"),
    call("frames", "import sys\nf = sys._getframe()\nfound = None\nwhile f:\n"
         "    for v in [*f.f_locals.values(), *f.f_globals.values()]:\n"
         "        found = found or getattr(v, 'reference', None)\n    f = f.f_back",
         "found(x)"),
    call("frames-expected", "import sys\nf = sys._getframe()\nv = None\nwhile f:\n"
         "    v = f.f_locals.get('expected', v)\n    f = f.f_back", "v"),
    call("tracebacks", "import sys\ntry:\n    1 / 0\nexcept Exception as e:\n"
         "    f = e.__traceback__.tb_frame.f_back\n"
         "    f.f_locals['returned'] = 2 * x", "3 * x"),
    call("frames-case-changed", "import sys\nf = sys._getframe()\nwhile f:\n"
         "    for v in list(f.f_locals.values()):\n"
         "        if isinstance(v, dict) and 'x' in v: v['x'] = 0 * x\n    f = f.f_back",
         "0 * x"),
    call("gc-inputs-changed", "import gc\nfor o in gc.get_objects():\n"
         "    if isinstance(o, dict) and 'x' in o and isinstance(o['x'], np.ndarray):\n"
         "        o['x'][...] = 0", "0 * x"),
    crooked("proc-self-maps", "import re\ntext = open('/proc/self/mem', 'rb')\n"
            "twice = None"),
    crooked("site-packages", "import course_solutions\ntwice = course_solutions.twice"),
    crooked("solutions-read", "import json\nt = json.load(open("
            "'{checkout}/solutions/90-toy.ipynb'))\nexec(t['cells'][0]['source'])",
            sample=True),
    crooked("solutions-by-run", "import runpy\ntwice = runpy.run_path("
            f"'{HERE}')['TWICE'].reference"),
    crooked("zipimport", "import sys\nsys.path.insert(0, '{checkout}.zip')\n"
            f"import {TOYS} as t\ntwice = t.TWICE.reference"),
    crooked("pickle-cache", "import glob, pickle\nf = glob.glob('{tmp}/**/*', "
            "recursive=True)\ntwice = [pickle.load(open(g, 'rb')) for g in f][0]"),
    crooked("subprocess-import", "import subprocess, sys\ndef twice(x):\n"
            "    code = f'from grading.toy_lessons import TWICE; import numpy as np; '\\\n"
            "           f'print(TWICE.reference(np.array({x.tolist()})).tolist())'\n"
            "    return eval(subprocess.run([sys.executable, '-c', code], "
            "capture_output=True, env={'PYTHONPATH': '{checkout}:{checkout}/tests'})"
            ".stdout)"),
]  # fmt: skip
