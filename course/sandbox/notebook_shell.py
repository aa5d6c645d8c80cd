"""A notebook's process: runs its cells in their order, as a kernel does; at each ``check`` a fork answers the exercise.

What an answer leans on is what is there at that moment: cells of the student's own, changed values, magics, files. It
runs in a process of its own, a fork of ``serving``, and can do there what it likes: the worst it can send are wrong
answers.
"""

from __future__ import annotations
import __future__

import ast
import contextlib
import gc
import inspect
import os
import socket
import sys
from collections.abc import Callable, Iterator, Mapping, Sequence
from dataclasses import dataclass, replace
from types import CodeType
from typing import Any

from course.exercises import answer
from course.exercises.question import Question
from course.sandbox import forks, guard, limits, stand_ins, wire
from course.sandbox.messages import DONE, NOTE, REPLY, STAGE, TRIED, send
from course.sandbox.plan import Step
from course.sandbox.seccomp import Filter

MISSING = object()
#: Attempts told, each once; more of them say nothing new.
MOST_ATTEMPTS = 20
DEEP = 5_000
#: Magics that measure, draw or install, and bind nothing that an answer could need.
IDLE = "matplotlib timeit prun pip conda pinfo pinfo2 debug pdb bash sh script sx system html javascript latex".split()


@dataclass(frozen=True)
class Surroundings:
    """Where a run may write, what it may not read, where packages are, its limits, the filter of system calls."""

    work: str
    closed: tuple[str, ...]
    path: tuple[str, ...]
    limits: limits.Limits
    filter: Filter | None


def run(
    steps: Sequence[Step],
    tasks: Sequence[Question],
    around: Surroundings,
    pipe: int,
    way: socket.socket | None,
) -> None:
    """Run the notebook and send what came of it through ``pipe``. Does not return: nothing left running matters.

    Through ``way`` goes the listener that counts its forks.
    """
    os.chdir(around.work)
    whole = replace(around.limits, seconds=around.limits.seconds * (len(tasks) + 2))
    held = limits.apply_limits(whole)
    sys.path[:] = [around.work, *around.path]
    attempts = _Attempts(pipe)
    answers = _Answers(tasks, around, pipe, held)
    stand_ins.install_stand_ins(answers.check)
    _silence()
    stand_ins.answer_nobody(attempts)
    answers.guard = guard.install_guard(
        around.work, around.closed, around.path, attempts
    )
    if around.filter is not None and way is not None:
        with answers.guard.aside():
            listener = around.filter.close_but_ask()
            forks.hand_over(way, listener)
        held += ["system calls"] if listener is not None else []
    gc.freeze()
    gc.enable()
    cells = _Cells(attempts)
    for step in steps:
        send(pipe, STAGE, f"cell {step.index}".encode())
        error = cells.execute(step)
        if error is not None:
            send(pipe, NOTE, wire.pack([step.index, answer.describe(error)]))
    send(pipe, STAGE, b"end 0")
    answers.rest(cells.namespace)
    send(pipe, DONE, b"-1 0")
    os._exit(0)


class _Attempts:
    """Tells of what was tried and refused, at once: what was told cannot be taken back."""

    def __init__(self, pipe: int) -> None:
        self._pipe, self._told = pipe, set[str]()
        self.count = 0

    def __call__(self, attempt: str) -> None:
        self.count += 1
        if attempt not in self._told and len(self._told) < MOST_ATTEMPTS:
            self._told.add(attempt)
            send(self._pipe, TRIED, attempt.encode("utf-8", "replace"))


class _Answers:
    """Answers exercises, each in a fork: what its code does there is not in the notebook's way."""

    def __init__(
        self,
        tasks: Sequence[Question],
        around: Surroundings,
        pipe: int,
        held: list[str],
    ) -> None:
        self._tasks = {task.name: task for task in tasks}
        self._around, self._pipe, self._held = around, pipe, held
        self._asked: set[str] = set()
        self.guard: Any = None

    def check(self, value: Any = None, name: Any = None, *_: Any, **__: Any) -> None:
        """What ``check`` does here."""
        name = name if isinstance(name, str) else getattr(value, "__name__", "")
        task = self._tasks.get(name)
        if task is not None:
            self._asked.add(name)
            self._answer(task, value)

    def rest(self, namespace: Mapping[str, Any]) -> None:
        """Answer what was never checked, with what the notebook has at its end."""
        for task in self._tasks.values():
            if task.name not in self._asked:
                self._answer(task, namespace.get(task.name, MISSING))

    def _answer(self, task: Question, value: Any) -> None:
        if not hasattr(os, "fork"):  # one question a process
            self._reply(task, value)
            os._exit(0)
        send(self._pipe, STAGE, f"answer {task.index}".encode())
        with self.guard.aside():
            process = os.fork()
        if process == 0:
            try:
                self._in_fork(task, value)
            finally:
                os._exit(70)
        send(self._pipe, STAGE, f"by {process}".encode())
        _, status = os.waitpid(process, 0)
        code = os.waitstatus_to_exitcode(status)
        send(self._pipe, DONE, f"{task.index} {code}".encode())

    def _in_fork(self, task: Question, value: Any) -> None:
        with self.guard.aside():
            limits.apply_limits(self._around.limits)
            if self._around.filter is not None:
                self._around.filter.close()
        self._reply(task, value)
        os._exit(0)

    def _reply(self, task: Question, value: Any) -> None:
        told = _call(task, self._stage, value)
        checked = task.name in self._asked
        packed = wire.pack({**told, "held": self._held, "checked": checked})
        send(self._pipe, REPLY, task.index.to_bytes(4, "little") + packed)

    def _stage(self, what: str, index: int) -> None:
        send(self._pipe, STAGE, f"{what} {index}".encode())


class _Cells:
    """IPython's reading of cells and its namespace, without history, display or a terminal."""

    def __init__(self, attempts: _Attempts) -> None:
        nothing = stand_ins.StandInForCourse()
        self._shell = _shell(attempts)
        self.namespace: dict[str, Any] = self._shell.user_ns
        self.namespace |= {
            "exit": sys.exit,
            "quit": sys.exit,
            "display": nothing,
            "get_ipython": lambda: self._shell,
            stand_ins.LATER_NAME: stand_ins.Later,
        }
        self._attempts = attempts
        self._flags = ast.PyCF_ALLOW_TOP_LEVEL_AWAIT

    def execute(self, step: Step) -> BaseException | None:
        """Run one cell and give back what it raised first.

        A tolerant cell goes on after a statement that fails, and every cell after one that was refused something or
        imports what is not here: in the kernel it would have worked.
        """
        first: BaseException | None = None
        with (
            contextlib.redirect_stdout(answer.Printed()),
            contextlib.redirect_stderr(answer.Printed()),
        ):
            try:
                codes = self._codes(step)
            except BaseException as error:
                return error
            tolerant = step.tolerant
            for code in codes:
                before = self._attempts.count
                try:
                    self._run(code)
                except (
                    BaseException
                ) as error:  # SystemExit too: a notebook goes on with its next cell
                    first = first or error
                    missed = isinstance(error, ModuleNotFoundError)
                    tolerant = tolerant or missed or self._attempts.count > before
                    if not tolerant or isinstance(error, KeyboardInterrupt):
                        break
        return first

    def _codes(self, step: Step) -> list[CodeType]:
        with _deeper():
            source = self._shell.transform_cell(step.source)
            name = self._shell.compile.cache(source, step.index, raw_code=step.source)
            tree = stand_ins.with_later_imports(ast.parse(source, name))
            return [self._compiled(node, name) for node in tree.body]

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


def _shell(attempts: _Attempts) -> Any:
    from IPython.core.interactiveshell import InteractiveShell
    from traitlets.config import Config

    config = Config()
    config.HistoryManager.enabled = False
    shell: Any = InteractiveShell.instance(config=config)

    def refused(command: str, *_: Any, **__: Any) -> list[str]:
        attempts(f"the command {command}"[:100])
        return []

    shell.system = shell.getoutput = shell.system_raw = shell.system_piped = refused
    for name in IDLE:
        for kind in ("line", "cell"):
            shell.register_magic_function(_idle, magic_kind=kind, magic_name=name)
    return shell


def _idle(*_: Any, **__: Any) -> None:
    return None


@contextlib.contextmanager
def _deeper() -> Iterator[None]:
    """Compiling from a tree counts its depth: a thousand elif are a thousand blocks in each other."""
    limit = sys.getrecursionlimit()
    sys.setrecursionlimit(max(limit, DEEP))
    try:
        yield
    finally:
        sys.setrecursionlimit(limit)


def _call(
    task: Question, stage: Callable[[str, int], None], value: Any
) -> dict[str, Any]:
    """What came of the answer, as plain values."""
    if value is MISSING:
        return {"missing": True}
    try:
        came = answer.answer_to(task, value, _told(stage, task.cases))
    except (
        BaseException
    ) as error:  # KeyboardInterrupt goes through call_all: a student can raise it too
        return {"fault": "it stopped with " + answer.describe(error)}
    if came.blank or came.fault:
        return {"blank": True} if came.blank else {"fault": came.fault}
    pairs = zip(came.outcomes, task.most, strict=True)
    return {"outcomes": [_plain(outcome, most) for outcome, most in pairs]}


def _told(
    stage: Callable[[str, int], None], cases: Sequence[Mapping[str, Any]]
) -> Iterator[Mapping[str, Any]]:
    for index, case in enumerate(cases):
        stage("case", index)
        yield case


def _plain(outcome: answer.Outcome, most: int) -> dict[str, Any]:
    """An outcome as plain values; more numbers than there is room for are told, not sent."""
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
    """Send what is printed past Python's own streams nowhere, and read nothing."""
    nowhere = os.open(os.devnull, os.O_RDWR)
    for stream in (0, 1, 2):
        os.dup2(nowhere, stream)
