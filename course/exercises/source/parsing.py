"""Source and its syntax tree: the one place where Python is asked to parse what a student wrote."""

from __future__ import annotations

import ast
import warnings

#: Characters; longer cells are no answers and take seconds to parse.
MAXIMUM_CELL = 200_000
#: What Python's parser and its visitors raise for source they cannot handle.
UNREADABLE = (SyntaxError, ValueError, RecursionError, MemoryError)


def tree_of(source: str) -> ast.Module | None:
    """The syntax tree of Python source; None if it does not parse or is too long."""
    return parsed(source)[0]


def parsed(source: str) -> tuple[ast.Module | None, str]:
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
