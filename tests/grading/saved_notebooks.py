"""One right notebook as students and their programs save it: each of these is green in the kernel."""

import json
import random
import string

from grading.toy_lessons import IMPORTS, cell

KERNEL = {"name": "python3", "display_name": "Python 3"}
HELPER = "k = 3"
ANSWER = "def thrice(x):\n    return k * x"
CHECK = "check(thrice)"


def cells(helper=HELPER, answer=ANSWER, check=CHECK, imports=IMPORTS):
    return [
        cell(imports, role="imports"),
        cell(helper),
        cell(f"{answer}\n\n{check}", exercise="thrice"),
    ]


def text(source):
    return {"cell_type": "markdown", "metadata": {}, "source": source}


def book(*own, **more):
    """The notebook as a file."""
    content = {
        "nbformat": 4,
        "nbformat_minor": 4,
        "metadata": {"course": {"lesson": "91"}, "kernelspec": KERNEL},
        "cells": list(own or cells()),
    }  # fmt: skip
    return json.dumps(content | more, ensure_ascii=False).encode()


def each(change):
    """The notebook with every code cell changed."""
    return book(*(c | change(c) for c in cells()))


def _output(text):
    return {"output_type": "stream", "name": "stdout", "text": text}


FAILED = {
    "output_type": "error",
    "ename": "NameError",
    "evalue": "no k",
    "traceback": ["\x1b[31mno k\x1b[0m"],
}
SAVED = {
    "with a byte order mark": b"\xef\xbb\xbf" + book(),
    "indented with one blank": json.dumps(json.loads(book()), indent=1).encode(),
    "in pure ASCII": json.dumps(json.loads(book(*cells("λ = 3\nk = λ")))).encode(),
    "lines that end as on Windows": each(
        lambda c: {"source": c["source"].replace("\n", "\r\n")}
    ),
    "lines that end as on an old Mac": each(
        lambda c: {"source": c["source"].replace("\n", "\r")}
    ),
    "lines in lists": each(lambda c: {"source": c["source"].splitlines(keepends=True)}),
    "tabs": book(*cells(answer=ANSWER.replace("    ", "\t"))),
    "tabs and blanks": book(
        *cells("def f():\n\treturn 3\ndef g():\n        return f()\nk = g()")
    ),
    "blanks that do not break, in a comment": book(
        *cells("k = 3  #\u00a0three\u00a0times\nname = 'a\u00a0b'")
    ),
    "curly quotes in a text": book(*cells("print('“k”')\nk = 3")),
    "Greek names": book(*cells("κ = 3", "def thrice(x):\n    return κ * x")),
    "a name in wide letters": book(*cells("\uff4b = 3")),
    "a picture in a text": book(*cells("print('\N{PARTY POPPER} done')\nk = 3")),
    "a form feed": book(*cells("a = 1\n\x0c\nk = 3")),
    "many blank lines": book(*cells("\n\n\n# three\n\n\nk = 3\n\n\n")),
    "blanks behind lines": book(
        *cells("k = 3   \n   \n", ANSWER.replace("\n", "   \n"))
    ),
    "semicolons": book(*cells("a = 1; b = 2; k = a + b;")),
    "a line carried on": book(*cells("k = 1 + \\\n    2")),
    "percent comments": book(*cells("# %%\n# %% [markdown]\n# # Title\n# %%\nk = 3")),
    "form fields": book(
        *cells("#@title Scale { run: 'auto' }\nk = 3 #@param {type:'number'}")
    ),
    "no outputs": book(
        *(
            {k: v for k, v in c.items() if k not in ("outputs", "execution_count")}
            | {"outputs": [], "execution_count": None}
            for c in cells()
        )
    ),
    "stale numbers": each(lambda c: {"execution_count": 17}),
    "run out of order": book(
        *(c | {"execution_count": n} for c, n in zip(cells(), (9, 12, 3), strict=True))
    ),
    "errors of an earlier day": each(
        lambda c: {"outputs": [FAILED], "execution_count": 4}
    ),
    "ten megabytes printed": each(lambda c: {"outputs": [_output("x" * 3_000_000)]}),
    "thousands of outputs": each(lambda c: {"outputs": [_output("line\n")] * 3000}),
    "half a character in an output": book().replace(
        b'"outputs": []',
        rb'"outputs": [{"output_type": "stream", "name": "stdout", "text": "\ud83d"}]',
        1,
    ),
    "from Colab": book(
        *(
            c
            | {
                "metadata": {
                    "id": "aB3",
                    "colab": {"base_uri": "https://localhost:8080/"},
                    "outputId": "u",
                }
            }
            for c in cells()
        ),
        metadata={
            "colab": {"provenance": [], "toc_visible": True},
            "accelerator": "GPU",
            "kernelspec": {"name": "python3", "display_name": "Python 3"},
        },
    ),
    "from VS Code": book(
        *(
            c | {"metadata": c["metadata"] | {"vscode": {"languageId": "python"}}}
            for c in cells()
        ),
        metadata={
            "kernelspec": {"name": "python3", "display_name": ".venv"},
            "orig_nbformat": 4,
            "vscode": {"interpreter": {"hash": "3"}},
        },
    ),
    "timed cells": each(
        lambda c: {
            "metadata": c["metadata"]
            | {
                "execution": {"iopub.execute_input": "2026-01-01T00:00:00Z"},
                "tags": ["a"],
                "collapsed": True,
                "deletable": False,
            }
        }
    ),
    "widgets kept": book(
        metadata={
            "course": {"lesson": "91"},
            "widgets": {
                "application/vnd.jupyter.widget-state+json": {
                    "state": {},
                    "version_major": 2,
                }
            },
        }
    ),
    "an old minor format": book(nbformat_minor=0),
    "ids": book(
        *(c | {"id": f"cell-{i}"} for i, c in enumerate(cells())), nbformat_minor=5
    ),
    "notes between": book(
        text("# Mine"),
        cells()[0],
        text("and"),
        cells()[1],
        {"cell_type": "raw", "metadata": {}, "source": "raw"},
        cells()[2],
        text(""),
    ),
    "a cell of comments": book(*cells(), cell("# done\n# and done")),
    "empty cells": book(cell(""), *cells()[:2], cell("  \n "), cells()[2], cell("")),
    "a cell that is not Python": book(
        *cells()[:2], cell("def broken(:\n    pass"), cells()[2]
    ),
    "words instead of code": book(
        *cells()[:2], cell("I do not know why this works"), cells()[2]
    ),
    "tests of their own that fail": book(
        *cells(),
        cell("assert (thrice(np.ones(3)) == 2).all(), 'twice?'"),
        cell("1 / 0"),
    ),
    "pictures and prints": book(
        *cells(
            "k = 3\nprint('k', k)\nplt.plot([0, 1], [0, k], label='k')\nplt.legend()\nplt.show()"
        )
    ),
    "all in one cell": book(
        cells()[0], cell(f"{HELPER}\n{ANSWER}\n{CHECK}", exercise="thrice")
    ),
    "all in one cell of their own": book(
        cell(f"{IMPORTS}\n{HELPER}\n{ANSWER}\n{CHECK}")
    ),
    "a cell each": book(
        cells()[0],
        cell(HELPER),
        cell(ANSWER, exercise="thrice"),
        cell(CHECK),
        cell("thrice(np.ones(3))"),
    ),
    "imports in the answer's cell": book(
        cell(
            f"import numpy as np\nfrom course.workbook import check\n{HELPER}\n{ANSWER}\n{CHECK}",
            exercise="thrice",
        )
    ),
    "imports in the function": book(
        cells()[0],
        cell(
            "def thrice(x):\n    import math\n    from numpy import asarray\n"
            "    return math.sqrt(9) * asarray(x)\ncheck(thrice)",
            exercise="thrice",
        ),
    ),
    "a helper of another name": book(
        cells()[0],
        cell("def my_helper_2(y, n=3):\n    return n * y"),
        cell(
            "def thrice(x):\n    return my_helper_2(x)\ncheck(thrice)",
            exercise="thrice",
        ),
    ),
    "the answer twice": book(*cells(), cells()[2]),
    "the import cell twice": book(cells()[0], *cells()),
    "an answer copied below its blank": book(
        cells()[0],
        cell("def thrice(x):\n    ...", exercise="thrice"),
        cells()[1],
        cell(f"{ANSWER}\n{CHECK}"),
    ),
    "a blank that comes after": book(*cells(), cell("def thrice_again(x):\n    ...")),
    "print for every call": book(
        *cells(answer="def thrice(x):\n    print('x =', x)\n    return k * x")
    ),
    "other words for it": book(
        *cells(
            answer='def thrice(x):\n    """Three times.\n\n    >>> thrice(1)\n    3\n    """\n    return k * x'
        )
    ),
}


def shuffled(seed):
    """The notebook changed in several of these ways at once, drawn by ``seed``."""
    rng = random.Random(seed)
    name = rng.choice(["k", "factor", "κ", "_k", "K2", "scale"])
    made = rng.choice(["{n} = 3", "{n} = 1 + 2", "for {n} in range(4):\n    pass", "print({n} := 3)",
                       "def make():\n    global {n}\n    {n} = 3\nmake()", "import math\n{n} = math.isqrt(9)",
                       "1 + 2\n", "exec('{n} = 3')", "%time {n} = 3", "{n} = await three()"])  # fmt: skip
    source = made.format(n=name)
    before = ["async def three():\n    return 3"]
    after = [f"{name} = _"] if source == "1 + 2\n" else []
    own = rng.choice(["def thrice(x):\n    return {n} * x", "def thrice(x):\n    return sum([x] * {n})",
                      "def thrice(x):\n    y = x\n    for _ in range({n} - 1):\n        y = y + x\n    return y",
                      "thrice = lambda x: {n} * x\nthrice.__name__ = 'thrice'",
                      "class Times:\n    def thrice(self, x):\n        return {n} * x\nthrice = Times().thrice",
                      "if True:\n    def thrice(x):\n        return {n} * x"]).format(n=name)  # fmt: skip
    asked = rng.choice(["check(thrice)", "check(thrice, 'thrice')", "for f in [thrice]:\n    check(f)",
                        "check(answer=thrice, name='thrice')", "%time check(thrice)"])  # fmt: skip
    noise = ["1 / 0", "print('a' * 1000)", "def broken(:", "!ls", "np.sum?", "assert False", "plt.plot([1, 2])",
             "%timeit sum([1])", "# note", "help(len)", "display(3)", "%who", "import os; os.getcwd()"]  # fmt: skip
    helpers = [cell(s) for s in (*before, source, *after)]
    answer = [cell(own, exercise="thrice"), cell(asked)]
    if rng.random() < 0.5:
        answer = [cell(f"{own}\n{asked}", exercise="thrice")]
    sources = [*helpers, *answer]
    between = [cell(rng.choice(noise)) for _ in range(rng.randrange(4))]
    for one in between:
        place = rng.choice(
            [0, len(sources)]
        )  # elsewhere it would part a value from its use
        sources.insert(place, one)
    changed = [c | {"execution_count": rng.randrange(1, 99)} for c in sources]
    if rng.random() < 0.3:
        changed = [c | {"source": c["source"].replace("\n", "\r\n")} for c in changed]
    if rng.random() < 0.3:
        changed = [
            c | {"source": c["source"].splitlines(keepends=True)} for c in changed
        ]
    junk = "".join(rng.choices(string.printable, k=200))
    notes = [text(junk)] * rng.randrange(3)
    return book(*notes, cells()[0], *changed, *notes)


DRAWN = 40
