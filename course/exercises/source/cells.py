"""A cell as Python, where IPython takes more than that: magics, shell lines, pasted prompts."""

from __future__ import annotations

import ast
import re
from collections.abc import Iterator

from course.exercises.source.parsing import MAXIMUM_CELL, parsed, tree_of
from course.exercises.source.statements import defined_in

#: What a pasted session begins its lines with.
PROMPT = re.compile(r"(>>>|In \[\d+\]:)( |$)")
MORE_PROMPT = re.compile(r"(>>>|\.\.\.|In \[\d+\]:|\s*\.\.\.:)( |$)")
#: What IPython is asked about, and what a magic's result can be given to.
ASKED = re.compile(r"[\w.*\[\]]+")
TARGETS = re.compile(r"[\w, .\[\]'\"]+")
#: What opens or closes a text or a bracket, a comment, or a pair that a backslash makes.
TOKENS = re.compile(r"\\.|\"\"\"|'''|[\"'#()\[\]{}]")


def cell_tree(source: str) -> ast.Module | None:
    """The syntax tree of a cell without IPython's own lines.

    None if it does not parse.
    """
    return tree_of(python_only(source))


def syntax_error(source: str) -> str:
    """Why a cell does not parse, in Python's words; "" if it does."""
    return parsed(python_only(source))[1]


def python_only(source: str) -> str:
    """The cell as Python, where IPython takes more than that; line numbers stay.

    Its own lines (%magic, !shell, name?) turn into ``0``, which does nothing; what was
    pasted with its indentation or with prompts loses these. It never gets longer. A cell
    that is Python as it stands is left alone.
    """
    if len(source) > MAXIMUM_CELL or not _may_be_more(source):
        return source
    if tree_of(source) is not None:
        return source
    lines = _without_margin(_lines(source))
    return "\n".join(_without_foreign(lines))


def _lines(source: str) -> list[str]:
    """The lines as Python counts them; a form feed, say, may stand within one."""
    return re.split("\r\n|\r|\n", source)


def _may_be_more(source: str) -> bool:
    lines = _lines(source)
    first = next((line for line in lines if line.strip()), "")
    margin = first[:1].isspace() or PROMPT.match(first) is not None
    return margin or any(map(_is_foreign, lines))


def _without_margin(lines: list[str]) -> list[str]:
    """The lines without the prompts, or the indentation, of the first that is not empty."""
    first = next((line for line in lines if line.strip()), "")
    if PROMPT.match(first):
        return [MORE_PROMPT.sub("", line, count=1) for line in lines]
    margin = first[: len(first) - len(first.lstrip())]
    return [line.removeprefix(margin) for line in lines]


def _without_foreign(lines: list[str]) -> Iterator[str]:
    """IPython's lines are those that begin a statement; what looks like one inside a text
    or in brackets is none. A backslash carries them on, too.
    """
    inside = _Inside()
    carried = False
    for line in lines:
        if carried or (not inside and _is_foreign(line)):
            yield "" if carried else _instead(line)
            carried = line.endswith("\\")
        else:
            inside.read(line)
            yield line


def _is_foreign(line: str) -> bool:
    """Whether a line is IPython's: %magic, !command, ?name, name?, name = %magic or
    !command.
    """
    line = line.strip()
    if line.startswith(("%", "!", "?")):
        return True
    if line.endswith("?"):
        return ASKED.fullmatch(line[:-1].removesuffix("?")) is not None
    left, equals, right = line.partition("=")
    magic = equals and right.lstrip().startswith(("%", "!"))
    return bool(magic) and TARGETS.fullmatch(left) is not None


def _instead(line: str) -> str:
    """What stands for a line of IPython's: ``%time name = value`` and ``name = !command`` do bind the name."""
    margin = line[: len(line) - len(line.lstrip())]
    left, equals, right = line.partition("=")
    if (
        equals
        and right.lstrip().startswith(("%", "!"))
        and TARGETS.fullmatch(left.strip())
    ):
        return f"{left}= 0" if right.startswith(" ") else f"{left}=0"
    timed = line.strip().removeprefix("%time ").lstrip()
    tree = None if timed[:1] in "%!?" else tree_of(timed)
    return margin + (timed if tree is not None and defined_in(tree) else "0")


class _Inside:
    """Whether the lines read so far end within a statement: a text, brackets, a line that
    a backslash carries on. Each character is looked at once.
    """

    def __init__(self) -> None:
        self._quotes, self._depth, self._carried = "", 0, False

    def __bool__(self) -> bool:
        return bool(self._quotes or self._depth or self._carried)

    def read(self, line: str) -> None:
        """Read one more line."""
        self._carried = False
        for part in TOKENS.findall(line):
            if self._quotes:
                self._quotes = "" if part == self._quotes else self._quotes
            elif part[0] == "#":
                return
            elif part[0] in "'\"":
                self._quotes = part
            elif part[0] in "([{":
                self._depth += 1
            elif part[0] in ")]}":
                self._depth = max(0, self._depth - 1)
        self._carried = line.endswith("\\")
        if len(self._quotes) == 1 and not self._carried:
            self._quotes = ""  # a text in single quotes ends with its line
