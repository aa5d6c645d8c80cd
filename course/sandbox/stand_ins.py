"""What student code sees instead of the course, and of packages that only plot.

``course`` and everything in it is a stand-in: import cells run, ``check`` answers its
exercise, ``use`` returns its argument, and the reference is not there. ``import
matplotlib.pyplot as plt`` and the like load nothing until the name is used, because a
lesson's import cell names them and an answer rarely uses them.
"""

from __future__ import annotations

import ast
import importlib
import importlib.machinery
import sys
from collections.abc import Callable
from types import ModuleType
from typing import Any

WORKBOOK = ("check", "hint", "predict", "progress", "show", "use")
LATER = frozenset(
    {"IPython", "cvxpy", "ipywidgets", "matplotlib", "pandas", "scipy", "sympy"}
)
LATER_NAME = "__import_later__"
#: Packages that take seconds to import: an answer that uses one finds it loaded when
#: its clock starts.
SLOW = frozenset({"cvxpy", "numba"})


#: What a value is used by: numbers, arrays, sequences.
USES = (
    "array float int complex index len iter getitem add radd sub rsub mul rmul truediv rtruediv pow rpow matmul "
    "rmatmul neg abs lt le gt ge"
).split()


class CourseNotHere(RuntimeError):
    """The answer uses something of the course itself, which is not there while an answer is marked."""


class StandInForCourse:
    """Anything of the course: calls and attributes return it again.

    It is no value: an answer that uses it as one is stopped with the reason.
    """

    def __call__(self, *_: Any, **__: Any) -> Any:
        return self

    def __getattr__(self, name: str) -> Any:
        if name.startswith("__"):
            raise AttributeError(name)
        return self

    def __enter__(self) -> Any:
        return self

    def __exit__(self, *_: Any) -> None:
        return None


def _not_here(*_: Any, **__: Any) -> Any:
    raise CourseNotHere(
        "It calls the course itself, which is not there while an answer is marked."
    )


for _use in USES:
    setattr(StandInForCourse, f"__{_use}__", _not_here)


class _Module(ModuleType):
    __path__: list[str] = []
    _check: Callable[..., None]

    def __getattr__(self, name: str) -> Any:
        if name == "__all__":
            return list(WORKBOOK) if self.__name__ == "course.workbook" else []
        if name.startswith("__"):
            raise AttributeError(name)
        if name == "use":
            return _same
        if name == "check":
            return _Module._check
        return _nothing if name in WORKBOOK else StandInForCourse()


class _Finder:
    """A finder and a loader, without their base classes, whose import would slow every
    start.
    """

    def find_spec(self, name: str, path: Any = None, target: Any = None) -> Any:
        if name == "course" or name.startswith("course."):
            return importlib.machinery.ModuleSpec(name, self, is_package=True)  # type: ignore[arg-type]
        return None

    def create_module(self, spec: Any) -> ModuleType:
        return _Module(spec.name)

    def exec_module(self, module: ModuleType) -> None:
        """A stand-in has nothing to run."""


class Later:
    """A module that is imported when an attribute is first asked of it."""

    _wanted: dict[str, set[str]] = {}

    def __init__(self, shown: str, loaded: str) -> None:
        self.__dict__["_shown"] = shown
        self._wanted.setdefault(shown, set()).add(loaded)

    def __getattr__(self, name: str) -> Any:
        for module in sorted(self._wanted[self._shown]):
            importlib.import_module(module)
        return getattr(sys.modules[self._shown], name)

    def __setattr__(self, name: str, value: Any) -> None:
        setattr(importlib.import_module(self._shown), name, value)


def install_stand_ins(check: Callable[..., None]) -> None:
    """Put the stand-in in the course's place, with this ``check``; what was imported of it stays with who holds it."""
    _Module._check = staticmethod(check)
    for name in [n for n in sys.modules if n == "course" or n.startswith("course.")]:
        del sys.modules[name]
    sys.meta_path.insert(0, _Finder())


def with_later_imports(tree: ast.Module) -> ast.Module:
    """The cell with its plain imports of heavy packages deferred; ``from`` imports
    stay.
    """
    body: list[ast.stmt] = []
    for node in tree.body:
        body += _put_off(node) if isinstance(node, ast.Import) else [node]
    tree.body = body
    return tree


def _put_off(node: ast.Import) -> list[ast.stmt]:
    statements: list[ast.stmt] = []
    for alias in node.names:
        top = alias.name.split(".")[0]
        if top not in LATER or top in sys.modules:
            statements.append(ast.Import([alias]))
            continue
        shown = alias.name if alias.asname else top
        text = f"{alias.asname or top} = {LATER_NAME}({shown!r}, {alias.name!r})"
        statements += ast.parse(text).body
    made = [ast.copy_location(statement, node) for statement in statements]
    return [ast.fix_missing_locations(statement) for statement in made]


def load(name: str) -> None:
    """Import a package, and have a compiler compile once: what it looks up for that it cannot look up under guard."""
    module = importlib.import_module(name)
    if name == "numba":
        module.njit(lambda x: x + 1)(sys.modules["numpy"].ones(2))


def answer_nobody(asked: Callable[[str], None]) -> None:
    """Make ``input`` and ``getpass`` return an empty line, and tell ``asked``.

    Nobody is there to answer.
    """
    import builtins
    import getpass

    def empty(prompt: object = "", *_: Any, **__: Any) -> str:
        asked("what was typed when it asked for input")
        print(prompt)
        return ""

    builtins.input = empty
    getpass.getpass = empty


def _same(function: Any, *_: Any, **__: Any) -> Any:
    return function


def _nothing(*_: Any, **__: Any) -> None:
    return None
