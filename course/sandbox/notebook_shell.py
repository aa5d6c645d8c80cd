"""A notebook's process: runs its cells in their order, as a kernel does; at each ``check`` a fork answers the exercise.

What an answer leans on is what is there at that moment: cells of the student's own, changed values, magics, files. It
runs in a process of its own, a fork of ``serving``, and can do there what it likes: the worst it can send are wrong
answers.
"""

from __future__ import annotations

import gc
import os
import socket
import sys
from collections.abc import Callable, Iterator, Mapping, Sequence
from dataclasses import dataclass, replace
from typing import Any

from course.exercises.answer import (
    Outcome,
    answer_to,
    describe,
)
from course.exercises.question import Question
from course.sandbox import forks, guard, limits, stand_ins, wire
from course.sandbox.attempts import IN_THE_ANSWER, Attempts
from course.sandbox.cells import MISSED, Cells
from course.sandbox.leaning import leans_on
from course.sandbox.messages import DONE, NOTE, REPLY, STAGE, send
from course.sandbox.plan import Step
from course.sandbox.seccomp import Filter

MISSING = object()
MISSED_NAMES = tuple(kind.__name__ for kind in MISSED)


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
    attempts = Attempts(pipe)
    answers = _Answers(steps, tasks, around, pipe, held, attempts)
    stand_ins.install_stand_ins(answers.check)
    _silence()
    stand_ins.answer_nobody(attempts.miss)
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
    cells = Cells(attempts)
    for step in steps:
        send(pipe, STAGE, f"cell {step.index}".encode())
        error = cells.execute(step)
        if error is not None:
            send(pipe, NOTE, wire.pack([step.index, describe(error)]))
    send(pipe, STAGE, b"end 0")
    answers.rest(cells.namespace)
    send(pipe, DONE, b"-1 0")
    os._exit(0)


class _Answers:
    """Answers exercises, each in a fork: what its code does there is not in the notebook's way."""

    def __init__(
        self, steps: Sequence[Step], tasks: Sequence[Question], around: Surroundings, pipe: int, held: list[str],
        attempts: Attempts,
    ) -> None:  # fmt: skip
        self._sources = {step.index: step.source for step in steps}
        self._tasks = {task.name: task for task in tasks}
        self._around, self._pipe, self._held = around, pipe, held
        self._attempts = attempts
        self._asked: set[str] = set()
        self.guard: Any = None

    def check(self, answer: Any = None, name: Any = None, *_: Any, **__: Any) -> None:
        """What ``check`` does here."""
        name = name if isinstance(name, str) else getattr(answer, "__name__", "")
        task = self._tasks.get(name)
        if task is not None:
            self._asked.add(name)
            self._answer(task, answer)

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
        told = _call(task, self._stage, value, self._attempts)
        told |= {"held": self._held, "checked": task.name in self._asked}
        told["unlike"] = leans_on(value, task.name, self._sources, self._attempts.unlike)  # fmt: skip
        packed = wire.pack(told)
        send(self._pipe, REPLY, task.index.to_bytes(4, "little") + packed)

    def _stage(self, what: str, index: int) -> None:
        send(self._pipe, STAGE, f"{what} {index}".encode())


def _call(
    task: Question, stage: Callable[[str, int], None], value: Any, attempts: Attempts
) -> dict[str, Any]:
    """What the answer gave for each case, or why it was not called."""
    if value is MISSING:
        return {"missing": True}
    attempts.cell = IN_THE_ANSWER
    try:
        came = answer_to(task, value, _told(stage, task.cases))
    except (
        BaseException
    ) as error:  # KeyboardInterrupt goes through call_all: a student can raise it too
        return {"fault": "it stopped with " + describe(error)}
    if came.blank or came.fault:
        return {"blank": True} if came.blank else {"fault": came.fault}
    for outcome in came.outcomes:
        if outcome.kind == "raised" and outcome.text.startswith(MISSED_NAMES):
            attempts.miss(outcome.text.partition("\n")[0])
    pairs = zip(came.outcomes, task.most, strict=True)
    return {"outcomes": [_plain(outcome, most) for outcome, most in pairs]}


def _told(
    stage: Callable[[str, int], None], cases: Sequence[Mapping[str, Any]]
) -> Iterator[Mapping[str, Any]]:
    for index, case in enumerate(cases):
        stage("case", index)
        yield case


def _plain(outcome: Outcome, most: int) -> dict[str, Any]:
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
