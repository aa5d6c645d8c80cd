"""Runs what a student wrote: the cells of one exercise, then the answer on every case.

It has a process of its own, a fork of ``serving``, and the code may do anything there:
the worst it can send is a wrong answer.
"""

from __future__ import annotations
import __future__

import ast
import contextlib
import gc
import inspect
import linecache
import os
import sys
from collections.abc import Callable, Iterator, Mapping, Sequence
from dataclasses import dataclass
from types import CodeType
from typing import Any

from course.exercises import answer
from course.sandbox import guard, limits, stand_ins, wire
from course.sandbox.messages import REPLY, STAGE, TRIED, send

MISSING = object()
#: Attempts reported, each once; more of them would say nothing new.
MOST_ATTEMPTS = 20
DEEP = 5_000


@dataclass(frozen=True)
class Task:
    """An exercise to run.

    Its cells (source, and whether to continue after a statement that fails), the
    answer's name and kind, the declared arguments, how many results, the inputs of each
    case, and how many numbers each result may have.
    """

    cells: tuple[tuple[str, bool], ...]
    name: str
    kind: str
    arguments: tuple[str, ...]
    results: int
    cases: tuple[Mapping[str, Any], ...]
    most: tuple[int, ...]


@dataclass(frozen=True)
class Surroundings:
    """Where a run may write, what it may not read, its limits, and its system-call
    filter.
    """

    work: str
    closed: tuple[str, ...]
    path: tuple[str, ...]
    limits: limits.Limits
    close_calls: Callable[[], bool] | None


def run(task: Task, around: Surroundings, pipe: int) -> None:
    """Do the task and send the result through ``pipe``. Does not return: the process
    ends here, whatever threads are still running.
    """
    stage = _Stage(pipe)
    os.chdir(around.work)
    held = limits.apply_limits(around.limits)
    sys.path[:] = around.path
    stand_ins.install_stand_ins()
    _silence()
    attempts = _Attempts(pipe)
    stand_ins.answer_nobody(attempts)
    guard.install_guard(around.work, around.closed, around.path, attempts)
    if around.close_calls is not None and around.close_calls():
        held.append("system calls")
    gc.freeze()
    stage("ready")
    told = _answers(task, stage, attempts)
    send(pipe, REPLY, wire.pack({**told, "held": held}))
    os._exit(0)


class _Stage:
    """Reports how far the run has got, for the case that the process is killed."""

    def __init__(self, pipe: int) -> None:
        self._pipe = pipe

    def __call__(self, what: str, index: int = 0) -> None:
        send(self._pipe, STAGE, f"{what} {index}".encode())


class _Attempts:
    """Reports a refused attempt at once: once sent, it cannot be taken back."""

    def __init__(self, pipe: int) -> None:
        self._pipe, self._told = pipe, set[str]()
        self.count = 0

    def __call__(self, attempt: str) -> None:
        self.count += 1
        if attempt not in self._told and len(self._told) < MOST_ATTEMPTS:
            self._told.add(attempt)
            send(self._pipe, TRIED, attempt.encode("utf-8", "replace"))


def _answers(
    task: Task, stage: Callable[..., None], attempts: _Attempts
) -> dict[str, Any]:
    """Run the cells, call the answer, and return what both gave."""
    cells, notes = _Cells(attempts), []
    for index, (source, tolerant) in enumerate(task.cells):
        stage("cell", index)
        error = cells.execute(source, index, tolerant)
        if error is not None:
            notes.append([index, answer.describe(error)])
    found = cells.namespace.get(task.name, MISSING)
    return {"notes": notes, **_call(task, stage, found)}


@contextlib.contextmanager
def _deeper() -> Iterator[None]:
    """Compiling a tree recurses with its depth: a thousand ``elif`` nest a thousand
    deep.
    """
    limit = sys.getrecursionlimit()
    sys.setrecursionlimit(max(limit, DEEP))
    try:
        yield
    finally:
        sys.setrecursionlimit(limit)


class _Cells:
    """The notebook's namespace; cells run in it as in a kernel, with await and
    __future__.
    """

    def __init__(self, attempts: _Attempts) -> None:
        nothing = stand_ins.StandInForCourse()
        self.namespace: dict[str, Any] = {
            "__name__": "__main__",
            "exit": sys.exit,
            "quit": sys.exit,
            "display": nothing,
            "get_ipython": nothing,
            stand_ins.LATER_NAME: stand_ins.Later,
        }
        self._attempts = attempts
        self._flags = ast.PyCF_ALLOW_TOP_LEVEL_AWAIT

    def execute(self, source: str, index: int, tolerant: bool) -> BaseException | None:
        """Run one cell and return the first exception it raised.

        A tolerant cell continues after a statement that fails, and so does every cell
        after a refused attempt: in the kernel it would have worked.
        """
        name, printed = f"<cell {index}>", answer.Printed
        lines = [line + "\n" for line in source.splitlines()]
        linecache.cache[name] = (len(source), None, lines, name)
        first: BaseException | None = None
        with (
            contextlib.redirect_stdout(printed()),
            contextlib.redirect_stderr(printed()),
        ):
            try:
                with _deeper():
                    tree = stand_ins.with_later_imports(ast.parse(source, name))
                    codes = [self._compiled(node, name) for node in tree.body]
            except BaseException as error:
                return error
            for code in codes:
                before = self._attempts.count
                try:
                    self._run(code)
                except (
                    BaseException
                ) as error:  # SystemExit too: a notebook continues with its next cell
                    first = first or error
                    tolerant = tolerant or self._attempts.count > before
                    if not tolerant:
                        break
        return first

    def _compiled(self, node: ast.stmt, name: str) -> CodeType:
        if isinstance(node, ast.ImportFrom) and node.module == "__future__":
            for alias in node.names:
                feature = getattr(__future__, alias.name, None)
                self._flags |= getattr(feature, "compiler_flag", 0)
        module = ast.Module([node], [])
        return compile(module, name, "exec", self._flags, dont_inherit=True)

    def _run(self, code: CodeType) -> None:
        if code.co_flags & inspect.CO_COROUTINE:
            import asyncio

            asyncio.run(eval(code, self.namespace))
        else:
            exec(code, self.namespace)


def _call(task: Task, stage: Callable[..., None], value: Any) -> dict[str, Any]:
    """What the answer gave for each case, or why it was not called."""
    if value is MISSING:
        return {"missing": True}
    if answer.is_stub(value, task.cells[-1][0]):
        return {"blank": True}
    try:
        function = answer.as_function(value, task.kind, task.name, task.arguments)
    except Exception as error:
        return {"fault": str(error)[: answer.TEXT_LIMIT]}
    try:
        outcomes = answer.call_all(function, _told(stage, task.cases), task.results)
    except (
        BaseException
    ) as error:  # KeyboardInterrupt passes through call_all: a student can raise it too
        return {"fault": "it stopped with " + answer.describe(error)}
    return {
        "outcomes": [_plain(o, m) for o, m in zip(outcomes, task.most, strict=True)]
    }


def _told(
    stage: Callable[..., None], cases: Sequence[Mapping[str, Any]]
) -> Iterator[Mapping[str, Any]]:
    for index, case in enumerate(cases):
        stage("case", index)
        yield case


def _plain(outcome: answer.Outcome, most: int) -> dict[str, Any]:
    """An outcome as plain values; of too many numbers only the count is sent."""
    count = sum(array.size for array in outcome.values)
    if count > most:
        text = f"expected at most {most:,} numbers; got {count:,}"
        return {"kind": "unreadable", "text": text, "printed": "", "values": []}
    return {
        "kind": outcome.kind,
        "text": outcome.text,
        "printed": outcome.printed,
        "values": list(outcome.values),
        "given": dict(outcome.given),
    }


def _silence() -> None:
    """Discard what is printed below Python's own streams; reading gives nothing."""
    nowhere = os.open(os.devnull, os.O_RDWR)
    for stream in (0, 1, 2):
        os.dup2(nowhere, stream)
