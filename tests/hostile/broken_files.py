"""Files that are no notebooks, or hardly: a row that says so, soon, and the batch goes on."""

import base64
import json
import zlib

from grading.toy_lessons import BLANK, RIGHT, cell, notebook, only
from hostile.submission import Hostile

F = "def twice(x):\n    return 2 * x\n"
WHOLE = json.dumps(notebook())
OWN = {e: BLANK[e] for e in ("twice", "split", "area")}


def unusable(name, content, **more):
    return Hostile(name, content=content, expect="unusable", harm="", **more)


def row(name, content, **more):
    """A file that may be marked or not; what it must not do is to stop or slow the batch."""
    return Hostile(name, content=content, expect="row", harm="", **more)


def right(name, content, **more):
    return Hostile(name, content=content, expect="full", harm="", **more)


def code(name, source, **more):
    """A notebook whose one tried cell is this."""
    make = source if callable(source) else lambda: source
    more.setdefault("expect", "none")
    return Hostile(name, content=lambda: only("twice", make()), harm="", **more)


def also(name, source, **more):
    """A right answer, with this in a cell that the student added: full points."""
    return right(name, lambda: notebook(cells=[cell(source())], **OWN | {"twice": F}),
                 **more)  # fmt: skip


def _as_version_3(answer):
    return {"nbformat": 3, "nbformat_minor": 0, "metadata": {"name": ""}, "worksheets": [
        {"metadata": {}, "cells": [{"cell_type": "code", "language": "python", "input": s,
         "outputs": [], "metadata": {}, "collapsed": False} for s in (answer,)]}]}  # fmt: skip


def _deep(n, opening="[", closing="]"):
    return '{"nbformat": 4, "cells": ' + opening * n + closing * n + "}"


def _names(n):
    return ", ".join(f"a{i}" for i in range(n)) + f" = [0] * {n}"


ZIP = base64.b64decode("UEsFBgAAAAAAAAAAAAAAAAAAAAAAAA==")
FILES = [
    unusable("empty", ""),
    unusable("one-space", " "),
    unusable("truncated", WHOLE[: len(WHOLE) // 2], sample=True),
    unusable("truncated-by-one", WHOLE[:-1]),
    unusable("twice-in-one-file", WHOLE + WHOLE),
    unusable("nul-bytes", WHOLE.replace("check", "check\0")),
    unusable("all-nul", bytes(100_000), sample=True),
    unusable("random-bytes", bytes(range(256)) * 40),
    unusable("zip", ZIP),
    unusable("compressed", zlib.compress(WHOLE.encode())),
    unusable("html", "<!DOCTYPE html><html><script>alert(1)</script></html>"),
    unusable("python-source", F, file="python-source.py"),
    unusable("pdf", b"%PDF-1.4\n%\xe2\xe3\xcf\xd3\n"),
    unusable("latin-1", WHOLE.replace("check", "pr\u00fcfe").encode("latin-1")),
    unusable("null", "null"),
    unusable("number", "4"),
    unusable("minus-infinity", "-Infinity"),
    unusable("list", "[]"),
    unusable("text", '"notebook"'),
    unusable("no-cells", '{"nbformat": 4}'),
    unusable("cells-null", '{"nbformat": 4, "cells": null}'),
    unusable("cells-a-tree", '{"nbformat": 4, "cells": {"cell_type": "code"}}'),
    unusable("cells-of-wrong-type", '{"nbformat": 4, "cells": [1, null, "x", [[]], {}]}'),
    unusable("nbformat-text", WHOLE.replace('"nbformat": 4', '"nbformat": "4"')),
    unusable("nbformat-missing", '{"cells": []}'),
    unusable("nbformat-true", '{"nbformat": true, "cells": []}'),
    unusable("nbformat-huge", '{"nbformat": 1' + "0" * 6000 + ', "cells": []}'),
    unusable("nbformat-3-bad", {"nbformat": 3, "worksheets": 7}),
    unusable("nbformat-3-of-wrong-types", {"nbformat": 3, "worksheets": [{"cells": [9]}]}),
    unusable("nbformat-minus", {"nbformat": -1, "cells": []}),
    unusable("deep-json", lambda: _deep(100_000), sample=True),
    unusable("deep-json-objects", lambda: _deep(100_000, '{"a":', "}")),
    unusable("51-MB", lambda: b'{"nbformat": 4, "a": "' + b"x" * 51_000_000 + b'"}',
             long=True),
    unusable("49-MB-of-digits", lambda: '{"nbformat": 4, "a": ' + "9" * 49_000_000 + "}",
             long=True),
    unusable("5-MB-of-digits", lambda: '{"nbformat": 4, "a": ' + "9" * 5_000_000 + "}"),
    Hostile("folder", content="", expect="any", harm="", file="folder.ipynb", special="folder"),
    unusable("link", "", file="link.ipynb", special="link", sample=True),
    unusable("link-to-nothing", "", file="link-to-nothing.ipynb", special="dangling"),
    unusable("link-to-itself", "", file="link-to-itself.ipynb", special="loop"),
    unusable("link-to-a-folder", "", file="link-to-a-folder", special="folder-link"),
    unusable("hidden-folder", WHOLE, file=".hidden-folder/90-toy.ipynb"),
    unusable("fifo", "", file="fifo.ipynb", special="fifo", sample=True),
    unusable("socket", "", file="socket.ipynb", special="socket"),
    row("closed", WHOLE, file="closed.ipynb", special="closed"),
    right("bom", "\ufeff" + WHOLE, sample=True),
    unusable("utf-16", WHOLE.encode("utf-16")),
    right("white-space", " \n\t" * 9 + WHOLE + "\n" * 999),
    right("nbformat-3", _as_version_3(F), file="nbformat-3.ipynb", long=True),
    right("nbformat-5", {**notebook(), "nbformat": 5}),
    right("nbformat-4-0", {**notebook(), "nbformat_minor": 0}),
    right("minor-is-text", {**notebook(), "nbformat_minor": "x"}),
    right("unknown-keys", {**notebook(), "x": [None, {"y": 1e308}]}),
    right("nan-in-json", WHOLE[:-1] + ', "x": NaN, "y": -Infinity, "z": 1e999}'),
    right("odd-cells-between", lambda: {**notebook(), "cells": [7, None, [], {}, "x",
          {"cell_type": 3}, {"cell_type": "code"}, {"cell_type": "code", "source": 9},
          {"cell_type": "code", "source": [1, None]}, *notebook()["cells"]]}),
    right("metadata-of-wrong-types", lambda: {**notebook(), "cells": [
          {**c, "metadata": 7, "outputs": "x", "execution_count": "y"}
          for c in notebook()["cells"]]}),
    right("10-MB-of-outputs", lambda: {**notebook(), "x": ["y" * 1000] * 10_000},
          long=True),
    right("wide-json", lambda: {**notebook(), "x": [[]] * 1_000_000}, long=True),
    right("keys-doubled", WHOLE[:-1] + ', "nbformat": 4, "nbformat": 4}'),
    row("lone-surrogates", WHOLE.replace("check", "\\ud800check")),
    row("surrogate-bytes", WHOLE.replace("check", "\ud800check")),
]  # fmt: skip
SOURCES = [
    code("syntax-error", "def twice(x:\n    return 2 * x"),
    code("python-2", "def twice(x):\n    print 'x'\n    return 2 * x"),
    code("nul-in-source", F + "\0"),
    code("bom-in-source", "\ufeff" + F, expect="row"),
    code("coding-line", "# -*- coding: utf-7 -*-\n" + F, expect="full"),
    code("surrogate-in-source", F + "s = '\ud800'\n# \udfff", expect="row"),
    code("surrogate-in-name", "def twice(x):\n    a\ud800 = 1\n"),
    code("parentheses", lambda: "y = " + "(" * 100_000 + "1" + ")" * 100_000 + "\n" + F),
    code("brackets", lambda: "y = " + "[" * 190 + "]" * 190 + "\n" + F, expect="row"),
    code("minus-100000-times", lambda: "y = " + "-" * 100_000 + "1\n" + F),
    code("minus-5000-times", lambda: "y = " + "-" * 5000 + "1\n" + F, expect="row"),
    code("nots", lambda: "y = " + "not " * 40_000 + "1\n" + F),
    code("plus-chain", lambda: "y = " + "1+" * 60_000 + "1\n" + F, expect="row"),
    code("calls-of-calls", lambda: "y = f" + "()" * 60_000 + "\n" + F),
    code("dots", lambda: "y = a" + ".a" * 60_000 + "\n" + F),
    code("lambdas", lambda: "y = " + "lambda: " * 20_000 + "1\n" + F),
    code("elifs", lambda: "if 0: pass\n" + "elif 0: pass\n" * 1000 + F, expect="full",
         sample=True),
    code("10000-elifs", lambda: "if 0: pass\n" + "elif 0: pass\n" * 10_000 + F,
         expect="row"),
    code("nested-ifs", lambda: "".join(" " * i + "if 1:\n" for i in range(99)) + " " * 99
         + "pass\n" + F, expect="row"),
    code("nested-fors", lambda: "".join(" " * i + "for i in x:\n" for i in range(60))
         + " " * 60 + "pass\n" + F),
    code("huge-integer", lambda: "y = " + "9" * 150_000 + "\n" + F),
    code("huge-hex", lambda: "y = 0x" + "f" * 150_000 + "\n" + F, expect="full"),
    code("huge-power", "y = 10 ** 10 ** 10 if 0 else 1\n" + F, expect="full"),
    code("constant-folding", "y = ((('a' * 4000) * 4000) if 0 else 1)\n" + F, expect="full"),
    code("spaces-40-kB", lambda: F + "y = (\n" + " " * 40_000 + "x y\n", sample=True,
         expect="row"),
    code("spaces-190-kB", lambda: F + " " * 190_000 + "x y\n", expect="row"),
    code("spaces-1-MB", lambda: F + " " * 1_000_000 + "x y\n", expect="row"),
    code("spaces-then-words", lambda: F + ("a " * 20_000) + "\n", expect="row"),
    code("commas-40-kB", lambda: F + "a," * 20_000 + " x y\n", expect="row"),
    code("words-40-kB", lambda: F + "a" * 40_000 + "  x\n", expect="row"),
    code("equals-and-spaces", lambda: F + ("a" + " " * 5000 + "=\n") * 8, expect="row"),
    code("words-and-marks", lambda: F + "a." * 20_000 + "??x\n", expect="row"),
    code("tabs-100-kB", lambda: F + "\t" * 100_000 + "%\n", expect="row"),
    code("form-feeds", lambda: F + "\f" * 50_000 + "x y\n", expect="row"),
    code("a-line-of-1-MB", lambda: F + "y = '" + "%" * 1_000_000 + "'\n", expect="row"),
    code("a-percent-line-of-1-MB", lambda: "%" + "x " * 500_000 + "\n" + F, expect="row"),
    code("a-shell-line-of-150-kB", lambda: "!" + "x " * 75_000 + "\n" + F, expect="full"),
    code("100000-lines", lambda: "\n" * 100_000 + F, expect="full"),
    # A kernel stops at the first: there is no magic of that name.
    code("100000-magics", lambda: "%a\n" * 50_000 + F, expect="row"),
    code("statements-40000", lambda: "y=1\n" * 40_000 + F, expect="row"),
    code("decorators", lambda: "@id\n" * 5000 + F, expect="row"),
    code("f-strings", lambda: "y = 1\nz = f'" + "{y}" * 20_000 + "'\n" + F, expect="row"),
    code("nested-f-strings", lambda: "y = " + "f'{" * 60 + "1" + "}'" * 60 + "\n" + F),
    code("unclosed-text", lambda: F + "'''" + "x" * 150_000, expect="row"),
    code("unclosed-texts", lambda: F + "'''\\\n" * 9999, expect="row"),
    code("backslashes", lambda: F + "\\\n" * 60_000, expect="row"),
    code("continuation", lambda: "y = \\\n" * 30_000 + "1\n" + F, expect="row"),
    code("comments", lambda: "# " + "x" * 190_000 + "\n" + F, expect="full"),
    code("annotations-deep", lambda: "y: " + "a[" * 150 + "b" + "]" * 150 + " = 1\n" + F,
         expect="row"),
    code("arguments-many", lambda: "def twice(x" + "".join(f", a{i}=0" for i in range(9000))
         + "):\n    return 2 * x\n", expect="row"),
    code("match-cases", lambda: "match 1:\n" + "    case 0: pass\n" * 5000 + F,
         expect="row"),
    code("comprehensions", lambda: "y = [1 " + "for a in [1] " * 5000 + "]\n" + F,
         expect="row"),
    code("ands", lambda: "y = " + "1 and (" * 90 + "1" + ")" * 90 + "\n" + F,
         expect="full"),
    code("chained-targets", lambda: "y = " * 30_000 + "1\n" + F, expect="row"),
    code("stars", lambda: "y = [" + "*" * 50_000 + "a]\n" + F),
    also("names-390000-beside", lambda: _names(26_000)),
    code("names-26000", lambda: _names(26_000) + "\n" + F, expect="row"),
    code("names-390000", lambda: _names(390_000) + "\n" + F, expect="row", long=True),
    also("names-in-many-cells", lambda: "\n".join(f"b{i} = 1" for i in range(15_000))),
    also("spaces-beside", lambda: "y = (\n" + " " * 40_000 + "x y", sample=True),
    also("megabyte-beside", lambda: " " * 1_000_000 + "x y"),
    also("parentheses-beside", lambda: "y = " + "(" * 100_000),
    also("minus-beside", lambda: "y = " + "-" * 100_000 + "1"),
    also("elifs-beside", lambda: "if 0: pass\n" + "elif 0: pass\n" * 5000),
    also("integer-beside", lambda: "y = " + "9" * 190_000),
    right("similar-names", lambda: notebook(cells=[cell("\n".join(
          f"{'twic' * 40}{i} = 1" for i in range(1000)))], **OWN | {"twice": F})),
    Hostile("similar-names-no-answer", content=lambda: notebook(cells=[cell("\n".join(
            f"{'twic' * 9}{i} = 1" for i in range(4000)))], **OWN | {"twice": "y = 1"}),
            harm="", long=True),
    Hostile("million-cells", content=lambda: {**notebook(), "cells":
            [{"cell_type": "code", "source": "x"}] * 1_000_000}, expect="row",
            harm="", long=True),
    Hostile("megabyte-cells", content=lambda: {**notebook(), "cells":
            [cell("y = [" + "1," * 90_000 + "]")] * 40 + notebook()["cells"]},
            expect="full", harm="", long=True),
    Hostile("twice-right", RIGHT["twice"], expect="full", harm=""),
]  # fmt: skip

FAMILY = [*FILES, *SOURCES]
