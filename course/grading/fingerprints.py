"""A digest of everything that marks depend on except the submission.

The grader's own source, its libraries, the lessons.
"""

from __future__ import annotations

import dataclasses
import functools
import hashlib
import sys
import types
from collections.abc import Mapping, Sequence
from dataclasses import asdict
from functools import cache
from pathlib import Path
from typing import Any

import numpy as np

from course.exercises.definition import Lesson
from course.sandbox.limits import Limits

PACKAGE = Path(__file__).resolve().parents[1]
#: What no mark depends on: the lessons' figures and widgets, and the command line.
NO_MATTER = frozenset(
    "workbook cli.py __main__.py testing.py environment.py installation.py".split()
)


def grader_version(lessons: Sequence[Lesson]) -> str:
    """A digest of the program, the libraries its references call, and the lessons."""
    libraries = [sys.version_info[:2], np.__version__, _version_of_sympy()]
    return _digest(source_digest(PACKAGE), libraries, fingerprint(tuple(lessons)))


def key_of(submission: str, version: str, seed: int, limits: Limits) -> str:
    """A digest of everything that a submission's marks depend on.

    The submission itself, the grader's version, the seed and the limits.
    """
    return _digest(submission, version, seed, sorted(asdict(limits).items()))


@cache
def source_digest(package: Path) -> str:
    """A digest of the program's source, without the parts that no mark depends on."""
    found = hashlib.sha256()
    for path in sorted(package.rglob("*.py")):
        inside = path.relative_to(package)
        if inside.parts[0] not in NO_MATTER:
            found.update(inside.as_posix().encode() + b"\0")
            found.update(path.read_bytes().replace(b"\r\n", b"\n") + b"\0")
    return found.hexdigest()


def fingerprint(value: Any) -> str:
    """A digest of a value by its meaning, the same in every process.

    Functions count by their code and what they hold.
    """
    return _digest(_plain(value, ()))


def _plain(value: Any, inside: tuple[int, ...]) -> Any:
    if value is None or isinstance(value, (bool, int, float, complex, str, bytes)):
        return repr(value)
    if id(value) in inside:
        return "itself"
    inside = (*inside, id(value))
    if isinstance(value, np.ndarray):
        return ["array", str(value.dtype), value.shape, value.tobytes().hex()]
    if isinstance(value, Mapping):
        return ["map", *(_each(pair, inside) for pair in value.items())]
    if isinstance(value, (set, frozenset)):
        return ["set", *sorted(repr(_plain(one, inside)) for one in value)]
    if isinstance(value, (list, tuple)):
        return _each(value, inside)
    if dataclasses.is_dataclass(value) and not isinstance(value, type):
        held = [getattr(value, field.name) for field in dataclasses.fields(value)]
        return [type(value).__qualname__, *_each(held, inside)]
    return _plain_code(value, inside)


def _plain_code(value: Any, inside: tuple[int, ...]) -> Any:
    """Functions and code; of anything else that may occur, its name."""
    if isinstance(value, types.CodeType):
        parts = [value.co_code, value.co_names, value.co_consts]
        return ["code", *_each(parts, inside)]
    if isinstance(value, functools.partial):
        return ["partial", *_each([value.func, value.args, value.keywords], inside)]
    if isinstance(value, types.FunctionType):
        cells = [cell.cell_contents for cell in value.__closure__ or ()]
        held: list[Any] = [
            value.__code__,
            value.__defaults__,
            value.__kwdefaults__,
            cells,
        ]
        return [value.__module__, value.__qualname__, *_each(held, inside)]
    if hasattr(value, "__wrapped__"):
        return _plain(value.__wrapped__, inside)
    named = value if hasattr(value, "__qualname__") else type(value)
    return [getattr(named, "__module__", ""), getattr(named, "__qualname__", "")]


def _each(values: Any, inside: tuple[int, ...]) -> list[Any]:
    return [_plain(value, inside) for value in values]


def _digest(*parts: Any) -> str:
    return hashlib.sha256(repr(parts).encode("utf-8", "replace")).hexdigest()


def _version_of_sympy() -> str:
    from importlib import metadata

    try:
        return metadata.version("sympy")
    except metadata.PackageNotFoundError:
        return ""
