"""Answers that are no plain numbers, or claim to be others: no points, and no harm."""

from hostile.submission import Hostile

EQUAL = """
class Equal{base}:
    def __eq__(self, other): return True
    def __ne__(self, other): return False
    def __bool__(self): return True
    def __sub__(self, other): return 0.0
    __rsub__ = __sub__
    __lt__ = __le__ = __gt__ = __ge__ = __eq__
    def __hash__(self): return 0
    def __float__(self): return 0.0
    def __array__(self, *a, **k): return np.zeros(3)
    def __len__(self): return 3
    def __getitem__(self, i): return self
"""


def returns(name, expression, before="", **more):
    """An answer that gives back this, whatever comes in."""
    return Hostile(name, f"{before}\ndef twice(x):\n    return {expression}\n", **more)


SUBCLASS = """
class Always(np.ndarray):
    def __array_ufunc__(self, *a, **k): return np.True_
    def __array_function__(self, *a, **k): return np.True_
    def __eq__(self, other): return True
    def __sub__(self, other): return np.zeros(3)
    def tobytes(self, *a): return b''
    def astype(self, *a, **k): return self
    nbytes = 0
"""
ARRAY_HUGE = "class A:\n    def __array__(self, *a, **k): return np.ones(10**7)\n"

FAMILY = [
    returns("eq-always-true", "Equal()", EQUAL.replace("{base}", ""), sample=True),
    returns("float-eq-true", "Equal(1.0)", EQUAL.replace("{base}", "(float)")),
    returns("ndarray-subclass", "(3 * x).view(Always)", SUBCLASS, sample=True),
    returns("array-function", "np.zeros(3).view(Always)", SUBCLASS),
    returns("masked-array", "np.ma.masked_all(np.shape(x))"),
    returns("masked-wrong", "np.ma.array(3 * x, mask=True)"),
    returns("zero-width-dtype", "np.empty(2**30, dtype='V0')", sample=True),
    returns("zero-width-text", "np.zeros(2**30, dtype='U0')"),
    returns("zero-width-struct", "np.zeros(2**30, dtype=[])"),
    returns("huge-by-strides",
            "np.lib.stride_tricks.as_strided(np.zeros(1), (2**30,), (0,))"),
    returns("huge-by-broadcast", "np.broadcast_to(1.0, (2**20, 2**20))"),
    returns("no-elements", "np.zeros((0, 2**40, 0))"),
    returns("sixty-axes", "np.zeros((1,) * 60)"),
    returns("object-dtype", "np.array([Equal()] * 3, dtype=object)",
            EQUAL.replace("{base}", "")),
    returns("structured", "np.zeros(3, dtype=[('a', 'f8')])"),
    returns("record", "np.rec.array([(1.0,)])"),
    returns("big-endian-wrong", "(3 * x).astype('>f8')"),
    returns("complex-nan", "x * complex('nan+nanj')"),
    returns("nan", "x * np.nan", sample=True),
    returns("inf", "x * np.inf"),
    returns("datetime", "np.datetime64('2020') + np.zeros(3, 'm8[s]')"),
    returns("text-returned", "np.array(['2.0', '4.0', '8.0'])"),
    returns("text-surrogates", "np.array(['\\ud800' * 9] * 3)"),
    returns("bytes", "b'passed'"),
    returns("boolean", "np.array([True] * 3)"),
    returns("huge-integer-returned", "10 ** 5000"),
    returns("array-of-huge-integers", "np.array([10 ** 400] * 3, dtype=object)"),
    returns("array-raises", "A()",
            "class A:\n    def __array__(self, *a, **k): raise SystemExit('passed')\n"),
    returns("array-is-huge", "A()", ARRAY_HUGE),
    returns("array-gives-itself", "A()",
            "class A:\n    def __array__(self, *a, **k): return self\n"),
    returns("array-interface", "A()", "class A:\n    __array_interface__ = {'shape': "
            "(2**30,), 'typestr': '<f8', 'data': (16, False), 'version': 3}\n"),
    returns("list-in-itself", "v", "v = []\nv.append(v)\n"),
    returns("deep-list", "v", "v = 1.0\nfor _ in range(100_000): v = [v]\n"),
    returns("endless-iterator", "iter(int, 1)"),
    returns("len-lies", "A()", "class A(list):\n    def __len__(self): return 10**9\n"),
    returns("str-raises", "A()", "class A:\n    def __str__(self): raise KeyboardInterrupt\n"
            "    __repr__ = __str__\n    __class__ = property(lambda s: np.ndarray)\n"),
    returns("class-lies", "A()", "class A:\n    __class__ = property(lambda s: float)\n"),
    returns("is-stub", "..."),
    returns("none", "None"),
    returns("state-as-value", "'passed'"),
    returns("verdict-as-value", "{'kind': 'value', 'state': 'passed', 'points': 2}"),
    returns("generator", "(2 * v for v in x)"),
    Hostile("signature-lies", "class T:\n    __signature__ = 3\n"
            "    def __call__(self, *a): return 3 * a[0]\ntwice = T()\n"),
    Hostile("getattr-lies", "class T:\n    def __getattr__(self, n): return self\n"
            "    def __call__(self, x): return 3 * x\ntwice = T()\n"),
    Hostile("metaclass", "class M(type):\n    def __call__(c, *a): return 3.0\n"
            "    def __instancecheck__(c, o): return True\nclass twice(metaclass=M): pass\n"),
    Hostile("two-of-odd", "class P(tuple):\n    def __len__(self): return 2\n"
            "    def __iter__(self): return iter([1.0, 2.0, 3.0])\n"
            "def split(x):\n    return P((1.0,))\n", exercise="split"),
    Hostile("symbol-lies", "class E(sp.Symbol):\n    free_symbols = set()\n"
            "    def __eq__(s, o): return True\n    __hash__ = sp.Symbol.__hash__\n"
            "area = E('a')\n", exercise="area", long=True),
    Hostile("expression-prints-code", "area = sp.Function('__import__(\"os\").getpid')"
            "(sp.Symbol('a'))\n", exercise="area", long=True),
    Hostile("expression-is-text", "area = '__import__(\"os\").getppid() * a'\n",
            exercise="area", long=True),
    Hostile("expression-tower", "a = sp.Symbol('a')\narea = sp.Integer(10)**(10**9) * a\n",
            exercise="area", long=True),
]  # fmt: skip
