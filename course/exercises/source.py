"""Read what students wrote, without running it.

Is a cell blank, what does it define, which cells does it need? This is the one place
where a student's source is parsed. The source may be anything: if it does not parse,
for whatever reason, it is "not Python" and never an error here.
"""

from __future__ import annotations

import ast
import re
import symtable
import warnings
from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from functools import lru_cache

#: Characters; longer cells are no answers and take seconds to parse.
MAXIMUM_CELL = 200_000
#: What Python's parser and its visitors raise for source they cannot handle.
UNREADABLE = (SyntaxError, ValueError, RecursionError, MemoryError)
#: What a pasted session begins its lines with.
PROMPT = re.compile(r"(>>>|In \[\d+\]:)( |$)")
MORE_PROMPT = re.compile(r"(>>>|\.\.\.|In \[\d+\]:|\s*\.\.\.:)( |$)")
#: What IPython is asked about, and what a magic's result can be given to.
ASKED = re.compile(r"[\w.*\[\]]+")
TARGETS = re.compile(r"[\w, .\[\]'\"]+")
#: What opens or closes a text or a bracket, a comment, or a pair that a backslash makes.
TOKENS = re.compile(r"\\.|\"\"\"|'''|[\"'#()\[\]{}]")
#: A function may be defined in one, and is there afterwards.
BLOCKS = (ast.If, ast.For, ast.While, ast.With, ast.Try, ast.Match)
DYNAMIC = frozenset(
    {"globals", "locals", "vars", "eval", "exec", "__import__", "get_ipython"}
)


def tree_of(source: str) -> ast.Module | None:
    """The syntax tree of Python source; None if it does not parse or is too long."""
    return _parsed(source)[0]


def cell_tree(source: str) -> ast.Module | None:
    """The syntax tree of a cell without IPython's own lines.

    None if it does not parse.
    """
    return tree_of(python_only(source))


def syntax_error(source: str) -> str:
    """Why a cell does not parse, in Python's words; "" if it does."""
    return _parsed(python_only(source))[1]


def _parsed(source: str) -> tuple[ast.Module | None, str]:
    """The syntax tree, or None and why there is none."""
    if len(source) > MAXIMUM_CELL:
        return None, f"{len(source)} characters are too many (limit {MAXIMUM_CELL})"
    try:
        with warnings.catch_warnings():
            # "\d" in a string is the student's business
            warnings.simplefilter("ignore")
            return ast.parse(source), ""
    except SyntaxError as error:
        return None, f"{error.msg} (line {error.lineno})"
    except UNREADABLE as error:
        return None, str(error) or type(error).__name__


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
    """What stands for a line of IPython's: ``%time name = value`` does bind the name."""
    margin = line[: len(line) - len(line.lstrip())]
    timed = line.strip().removeprefix("%time ").lstrip()
    tree = None if timed[:1] in "%!?" else tree_of(timed)
    return margin + (timed if tree is not None and _defined(tree) else "0")


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


@dataclass(frozen=True)
class Facts:
    """What a cell's source alone shows, without IPython's own lines.

    ``defines`` are the names that it defines at its top level, functions in an ``if`` or
    ``with`` there too, ``definitions`` the source of those alone that stand in none;
    ``binds`` are the names it binds in the notebook's namespace ("*" for all of a
    module), ``uses`` those it takes from there.
    """

    defines: tuple[str, ...] = ()
    definitions: str = ""
    binds: frozenset[str] = frozenset()
    uses: frozenset[str] = frozenset()
    parsed: bool = False


@lru_cache(maxsize=4096)
def facts_of(source: str) -> Facts:
    """The facts of a cell, empty if it does not parse. Cached, because parsing takes
    time.
    """
    source = python_only(source)
    tree = tree_of(source)
    if tree is None:
        return Facts()
    try:
        with warnings.catch_warnings():
            warnings.simplefilter("ignore")
            table = symtable.symtable(source, "<cell>", "exec")
    except UNREADABLE:  # it parses but does not compile
        return Facts(_defined(tree), _definitions(source, tree))
    bound, used = _names(tree, table)
    return Facts(_defined(tree), _definitions(source, tree), bound, used, True)


def defined_names(source: str) -> tuple[str, ...]:
    """The names of functions and variables that a cell defines at its top level.

    None if it does not parse. ``f = use(f)`` defines nothing: it is how a lesson's own
    cells call what a student wrote.
    """
    return facts_of(source).defines


def definitions_only(source: str) -> str:
    """What a cell defines (functions, classes, imports, names), without its other
    statements.
    """
    return facts_of(source).definitions


def _defined(tree: ast.Module) -> tuple[str, ...]:
    names: list[str] = []
    for node in tree.body:
        if isinstance(node, BLOCKS):
            names += [n.name for n in _statements([node]) if _is_function(n)]  # type: ignore[attr-defined]
        elif isinstance(node, (ast.FunctionDef, ast.AsyncFunctionDef)):
            names.append(node.name)
        elif isinstance(node, (ast.Assign, ast.AnnAssign)) and not _is_use(node.value):
            targets = node.targets if isinstance(node, ast.Assign) else [node.target]
            parts = [p for t in targets for p in (_parts(t))]
            names += [p.id for p in parts if isinstance(p, ast.Name)]
    return tuple(names)


def _definitions(source: str, tree: ast.Module) -> str:
    wanted = (
        ast.FunctionDef,
        ast.ClassDef,
        ast.Import,
        ast.ImportFrom,
        ast.Assign,
        ast.AnnAssign,
    )
    if all(isinstance(node, wanted) for node in tree.body):
        return source
    try:
        return "\n\n".join(ast.unparse(n) for n in tree.body if isinstance(n, wanted))
    except UNREADABLE:
        return ""


def is_blank(source: str, name: str) -> bool:
    """Whether a cell's source leaves ``name`` blank, without running it.

    The last binding counts. A blank is ``name = ...``, or a function that sets a name
    of its own to ``...``, or one with a bare ``...`` that returns nothing else. A
    ``...`` left beside an answer that does return is not a blank, nor is one in an
    index, a type annotation, a string or an inner function.
    """
    tree = tree_of(source)
    if tree is None:
        return False
    blank = False
    for node in _statements(tree.body):
        if _is_function(node) and node.name == name:  # type: ignore[attr-defined]
            own = list(_statements(node.body))  # type: ignore[attr-defined]
            holes = [s for s in own if _is_hole(s)]
            answers = any(
                isinstance(s, ast.Return) and s.value is not None and s not in holes
                for s in own
            )
            blank = any(isinstance(s, (ast.Assign, ast.AnnAssign)) for s in holes)
            blank = blank or bool(holes and not answers)
        elif isinstance(node, (ast.Assign, ast.AnnAssign)) and name in _targets(node):
            blank = _is_hole(node)
    return blank


def is_left_blank(source: str) -> bool:
    """Whether a cell without the required name is the lesson's blank.

    It is nothing but ``...``, or a blank under another name.
    """
    tree = tree_of(source)
    if tree is None:
        return False
    names = {node.name for node in tree.body if isinstance(node, ast.FunctionDef)}
    for node in tree.body:
        if isinstance(node, ast.Assign):
            names |= {t.id for t in node.targets if isinstance(t, ast.Name)}
        elif isinstance(node, ast.Expr) and _is_hole(node):
            return True
    return any(is_blank(source, name) for name in names)


def needed_cells(sources: Sequence[str], wanted: str) -> tuple[int, ...]:
    """The indices of the cells that ``wanted`` needs, directly or through others.

    Only names are considered. Where they cannot decide (``eval``, ``from x import *``)
    a cell is kept. A cell that no name leads to is left out, so that its endless loop
    affects its own exercise alone.
    """
    used = names_of(wanted)[1]
    return tuple(range(len(sources))) if used & DYNAMIC else closure(sources, used)


def closure(sources: Sequence[str], used: frozenset[str]) -> tuple[int, ...]:
    """The indices of the cells that bind one of these names, or one that such a cell uses, and so on."""
    names = [names_of(source) for source in sources]
    kept: set[int] = {i for i, (bound, _) in enumerate(names) if "*" in bound}
    used = used.union(*(names[i][1] for i in kept))
    while True:
        more = {
            i for i, (bound, _) in enumerate(names) if i not in kept and bound & used
        }
        if not more:
            return tuple(sorted(kept))
        kept |= more
        used = used.union(*(names[i][1] for i in more))


def names_of(source: str) -> tuple[frozenset[str], frozenset[str]]:
    """The names a cell binds in the notebook's namespace, and those it takes from
    there.

    Both empty if it is not Python.
    """
    told = facts_of(source)
    return told.binds, told.uses


def _names(
    tree: ast.Module, table: symtable.SymbolTable
) -> tuple[frozenset[str], frozenset[str]]:
    bound = {"*"} if any(map(_imports_everything, ast.walk(tree))) else set()
    used = {name for node in ast.walk(tree) for name in _added_to(node)}
    tables = [table]
    while tables:
        part = tables.pop()
        tables += part.get_children()
        top = part.get_type() == "module"
        for symbol in part.get_symbols():
            if not top and not symbol.is_global():
                continue
            if symbol.is_assigned() or symbol.is_imported():
                bound.add(symbol.get_name())
            if symbol.is_referenced():
                used.add(symbol.get_name())
    return frozenset(bound), frozenset(used)


def modules_used(
    preamble: Sequence[str], answers: Sequence[str], among: frozenset[str]
) -> tuple[str, ...]:
    """Which of these packages the answers' cells use.

    They import one, or use a name that an import cell bound. An import that no answer
    uses does not count.
    """
    bound = {
        name: package
        for source in (*preamble, *answers)
        for name, package in _packages(source)
    }
    used = {package for source in answers for _, package in _packages(source)}
    for source in answers:
        used |= {bound[name] for name in names_of(source)[1] if name in bound}
    return tuple(sorted(used & among))


def _packages(source: str) -> list[tuple[str, str]]:
    """(name bound, its package) for all imports in a cell."""
    tree = tree_of(source)
    pairs = []
    for node in ast.walk(tree) if tree else ():
        if isinstance(node, ast.Import):
            pairs += [
                (a.asname or a.name.split(".")[0], a.name.split(".")[0])
                for a in node.names
            ]
        elif isinstance(node, ast.ImportFrom) and node.module and not node.level:
            top = node.module.split(".")[0]
            pairs += [(a.asname or a.name, top) for a in node.names]
    return pairs


def _statements(body: Sequence[ast.AST]) -> Iterator[ast.AST]:
    """Every statement in source order, those in blocks too, those of inner functions
    not.

    It keeps its own stack: a thousand ``elif`` nest a thousand blocks.
    """
    waiting = list(reversed(body))
    while waiting:
        node = waiting.pop()
        yield node
        if not _is_function(node) and not isinstance(node, ast.ClassDef):
            for block in ("cases", "finalbody", "orelse", "handlers", "body"):
                waiting += reversed(getattr(node, block, []))


def _is_function(node: ast.AST) -> bool:
    return isinstance(node, (ast.FunctionDef, ast.AsyncFunctionDef))


def _is_hole(node: ast.AST) -> bool:
    value = getattr(node, "value", None)
    is_statement = isinstance(node, (ast.Expr, ast.Assign, ast.AnnAssign, ast.Return))
    return is_statement and isinstance(value, ast.Constant) and value.value is Ellipsis


def _targets(node: ast.Assign | ast.AnnAssign) -> list[str]:
    targets = node.targets if isinstance(node, ast.Assign) else [node.target]
    return [t.id for t in targets if isinstance(t, ast.Name)]


def _parts(target: ast.expr) -> list[ast.expr]:
    return target.elts if isinstance(target, (ast.Tuple, ast.List)) else [target]


def _is_use(value: ast.expr | None) -> bool:
    return (
        isinstance(value, ast.Call)
        and isinstance(value.func, ast.Name)
        and value.func.id == "use"
    )


def _imports_everything(node: ast.AST) -> bool:
    return isinstance(node, ast.ImportFrom) and node.names[0].name == "*"


def _added_to(node: ast.AST) -> list[str]:
    """The name in ``name += ...``, which a symbol table does not count as used."""
    is_name = isinstance(node, ast.AugAssign) and isinstance(node.target, ast.Name)
    return [node.target.id] if is_name else []  # type: ignore[attr-defined]
