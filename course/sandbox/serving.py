"""The process of a submission: reads the notebook, forks a process that runs it, and reports to the grader.

It runs nothing that a student wrote. It talks through its standard input and output; when the first closes, the grader
is gone, and it ends with all that it started.
"""

from __future__ import annotations

import contextlib
import gc
import os
import shutil
import signal
import socket
import sys
from collections.abc import Mapping, Sequence
from typing import Any, NoReturn

import numpy as np

from course.exercises.notebook_file import (
    NotebookFile,
    Outline,
    UnusableNotebook,
    parse_notebook,
)
from course.exercises.question import Question
from course.exercises.source import modules_used, python_only
from course.sandbox import messages, notebook_shell, stand_ins, wire
from course.sandbox.forks import take_over
from course.sandbox.limits import Limits, memory_limited
from course.sandbox.plan import Planned, Step, plan_of, steps_of
from course.sandbox.seccomp import filter_for_this_machine
from course.sandbox.watching import Abandoned, Seen, Watch

#: Seconds are lost on these: an answer that uses one finds it loaded when its clock starts.
SLOW = stand_ins.SLOW
#: How often a notebook is begun anew without the cells that took its process with them.
RESTARTS = 4
MOST_RUNS, MOST_NOTES = 10, 20


def serve(where: Mapping[str, Any]) -> NoReturn:
    """Serve one submission to its end. ``where``: the folder to write in, packages, closed folders, whether boxed."""
    gc.disable()  # nothing that is loaded here is garbage
    # A shell's background jobs ignore it, and an endless cell is interrupted by it.
    signal.signal(signal.SIGINT, signal.default_int_handler)
    inlet, outlet = _own_pipes()
    try:
        messages.send(outlet, messages.READY)
        _Server(where, inlet, outlet).submission()
    except (Abandoned, BrokenPipeError):
        pass
    finally:
        if not where["boxed"]:  # in a box it is memory, and ends with it
            os.chdir(os.path.dirname(where["work"]))
            shutil.rmtree(where["work"], ignore_errors=True)
    os._exit(0)


class _Server:
    """One submission: where it may write, and the pipes from and to the grader."""

    def __init__(self, where: Mapping[str, Any], inlet: int, outlet: int) -> None:
        self._where, self._inlet, self._outlet = where, inlet, outlet

    def submission(self) -> None:
        """Read the notebook, then run it for what is asked."""
        request = self._next()
        limits = Limits(*request["limits"])
        try:
            with memory_limited(limits):
                notebook, plan = _read(request)
                steps = steps_of(notebook)
        except UnusableNotebook as error:
            return self._unusable(str(error))
        except (MemoryError, RecursionError) as error:
            words = f"cannot be read within its limits ({type(error).__name__})"
            return self._unusable(words)
        messages.send(self._outlet, messages.READ, wire.pack(_found(notebook, plan)))
        questions = [Question(**q) for q in self._next()["questions"]]
        _load_packages(steps, questions)
        around = notebook_shell.Surroundings(
            self._where["work"],
            tuple(self._where["closed"]),
            tuple(self._where["path"]),
            limits,
            filter_for_this_machine() if self._where["boxed"] else None,
        )
        if not hasattr(os, "fork"):  # one question a process, and the grader watches
            notebook_shell.run(steps, questions, around, self._outlet, None)
        seen = self._run(steps, questions, around)
        for question in questions:
            report = _ended(seen, question, plan[question.index])
            messages.send(self._outlet, messages.END, wire.pack(report))
        self._serve_repairs(notebook, around)

    def _serve_repairs(
        self, notebook: NotebookFile, around: notebook_shell.Surroundings
    ) -> NoReturn:
        """To the end: most submissions ask for none, and load nothing for it."""
        request = self._next()["repair"]
        from course.sandbox.serving_repairs import Repairs

        repairs = Repairs(notebook, around, self._inlet, self._outlet)
        try:
            while True:
                repairs.answer(request)
                request = self._next()["repair"]
        finally:
            repairs.close()

    def _next(self) -> Any:
        """The grader's next request; raises ``Abandoned`` where there is none."""
        message = messages.receive(lambda count: os.read(self._inlet, count))
        if message is None or message[0] != messages.ASK:
            raise Abandoned
        return wire.unpack(message[1])

    def _unusable(self, words: str) -> None:
        messages.send(self._outlet, messages.UNUSABLE, words.encode("utf-8", "replace"))

    def _run(
        self,
        steps: Sequence[Step],
        questions: Sequence[Question],
        around: notebook_shell.Surroundings,
    ) -> Seen:
        """Run the notebook; where a cell takes the process with it, once more without that cell."""
        whole = Seen()
        for _ in range(RESTARTS):
            steps = [s for s in steps if s.index not in whole.stopped]
            left = [t for t in questions if t.index not in whole.answers]
            seen = self._once(steps, left, around)
            whole.answers |= seen.answers
            whole.notes |= seen.notes
            whole.refused += [r for r in seen.refused if r not in whole.refused]
            before = len(whole.stopped)
            whole.stopped |= seen.stopped
            whole.whole, whole.lost = seen.whole, seen.lost
            if seen.whole or (len(whole.stopped) == before and not seen.answers):
                break
        return whole

    def _once(
        self,
        steps: Sequence[Step],
        questions: Sequence[Question],
        around: notebook_shell.Surroundings,
    ) -> Seen:
        _clear(around.work)
        outlet, inlet = os.pipe()
        here, there = socket.socketpair() if around.filter else (None, None)
        process = os.fork()
        if process == 0:
            others = [outlet, self._inlet, self._outlet]
            _become_notebook(steps, questions, around, inlet, others, here, there)
        os.close(inlet)
        forks = None
        if here is not None and there is not None:
            there.close()
            forks = take_over(here, _checks(questions))
            here.close()
        seconds = around.limits.seconds * (len(questions) + 2)
        boxed = self._where["boxed"]
        try:
            return Watch(
                process, outlet, self._inlet, forks, around.work, around.limits,
                boxed=boxed, seconds=seconds,
            ).follow()  # fmt: skip
        finally:
            os.close(outlet)
            if forks is not None:
                forks.close()


def _read(request: Mapping[str, Any]) -> tuple[NotebookFile, tuple[Planned, ...]]:
    lessons = [Outline(n, tuple(e), frozenset(h)) for n, e, h in request["lessons"]]
    content = request["notebook"].tobytes()
    notebook = parse_notebook(content, request["file"], lessons)
    return notebook, plan_of(notebook)


def _found(notebook: NotebookFile, plan: Sequence[Planned]) -> dict[str, Any]:
    """The report on a notebook that is only read: the lesson, and of each exercise what its source shows."""
    exercises = [
        {
            "state": p.state,
            "fault": p.cell.fault,
            "nearest": p.cell.nearest,
            "person": p.cell.needs_person,
        }
        for p in plan
    ]
    return {"lesson": notebook.lesson, "exercises": exercises}


def _checks(questions: Sequence[Question]) -> int:
    """How many processes a notebook may make: a student checks an exercise more than once."""
    return 8 + 4 * len(questions)


def _ended(seen: Seen, question: Question, planned: Planned) -> dict[str, Any]:
    """The report on an exercise."""
    runs = [
        {
            "end": one.end,
            "detail": one.detail,
            "stage": one.stage,
            "reply": np.frombuffer(one.reply, np.uint8),
            "seconds": one.seconds,
        }
        for one in seen.answers.get(question.index, [])
    ]
    if not runs and not seen.whole:
        lost = {"end": seen.lost[0], "detail": seen.lost[1], "stage": ""}
        runs = [{**lost, "reply": np.zeros(0, np.uint8), "seconds": 0.0}]
    stopped = [seen.stopped[i] for i in planned.own if i in seen.stopped]
    notes = [[int(i in planned.own), _text(n)] for i, n in sorted(seen.notes.items())]
    return {
        "index": question.index,
        "runs": runs[-MOST_RUNS:],
        "own": list(stopped[0]) if stopped else [],
        "others": [list(s) for i, s in seen.stopped.items() if i not in planned.own],
        "notes": notes[:MOST_NOTES],
        "refused": seen.refused,
        "whole": seen.whole,
    }


def _text(note: bytes) -> str:
    """What a cell said that it raised."""
    try:
        sent = wire.unpack(note)
    except wire.Unreadable:
        return ""
    whole = isinstance(sent, list) and len(sent) == 2 and isinstance(sent[1], str)
    return sent[1][:3000] if whole else ""


def _become_notebook(
    steps: Sequence[Step],
    questions: Sequence[Question],
    around: notebook_shell.Surroundings,
    inlet: int,
    others: Sequence[int],
    here: socket.socket | None,
    there: socket.socket | None,
) -> NoReturn:
    try:
        os.setpgid(0, 0)
        for pipe in others:
            os.close(pipe)
        if here is not None:
            here.close()
        notebook_shell.run(steps, questions, around, inlet, there)
    except Exception as error:
        words = f"{type(error).__name__}: {error}"
        messages.send(inlet, messages.FAULT, words.encode("utf-8", "replace"))
    finally:
        os._exit(70)


def _load_packages(steps: Sequence[Step], questions: Sequence[Question]) -> None:
    """IPython, and what takes seconds to load: they are not the student's, and are spent once for all exercises."""
    preamble = [python_only(s.source) for s in steps if s.tolerant]
    answers = [python_only(s.source) for s in steps if not s.tolerant]
    wanted = {"IPython.core.interactiveshell", *modules_used(preamble, answers, SLOW)}
    if any(question.kind == "expression" for question in questions):
        wanted.add("sympy")
    for name in sorted(wanted):
        with contextlib.suppress(Exception):  # the run will find out for itself
            stand_ins.load(name)


def _clear(folder: str) -> None:
    """Empty the folder: what one exercise left there is not in the next one's way."""
    for name in os.listdir(folder):
        place = os.path.join(folder, name)
        with contextlib.suppress(OSError, RecursionError):
            if os.path.isdir(place) and not os.path.islink(place):
                shutil.rmtree(place, ignore_errors=True)
            else:
                os.unlink(place)


def _own_pipes() -> tuple[int, int]:
    """Standard input and output under other numbers, which no run inherits; in their place is nothing."""
    inlet, outlet = os.dup(0), os.dup(1)
    nowhere = os.open(os.devnull, os.O_RDWR)
    os.dup2(nowhere, 0)
    os.dup2(nowhere, 1)
    os.close(nowhere)
    sys.stdin = open(os.devnull)
    return inlet, outlet
