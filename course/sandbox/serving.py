"""The process of a submission: reads the notebook, forks once per exercise, reports.

It runs none of the student's code itself. It talks through its standard input and
output; when the input closes, the grader is gone, and it ends with everything it
started.
"""

from __future__ import annotations

import contextlib
import importlib
import os
import shutil
import sys
from collections.abc import Mapping, Sequence
from typing import Any, NoReturn

import numpy as np

from course.exercises.notebook_file import Outline, UnusableNotebook, parse_notebook
from course.exercises.source import modules_used
from course.sandbox import messages, runner, stand_ins, wire
from course.sandbox.limits import Limits, memory_limited
from course.sandbox.plan import Planned, plan_of
from course.sandbox.seccomp import filter_installer
from course.sandbox.watching import Abandoned, watch

#: Packages that take seconds to import: loaded before an answer's clock starts.
SLOW = stand_ins.SLOW


def serve(where: Mapping[str, Any]) -> NoReturn:
    """Serve one submission to its end.

    ``where``: the folder to write in, packages, closed folders, whether boxed.
    """
    asked, told = _own_pipes()
    try:
        messages.send(told, messages.READY)
        _Server(where, asked, told).submission()
    except (Abandoned, BrokenPipeError):
        pass
    finally:
        if not where["boxed"]:  # in a box it is in memory and vanishes with the box
            os.chdir(os.path.dirname(where["work"]))
            shutil.rmtree(where["work"], ignore_errors=True)
    os._exit(0)


class _Server:
    """One submission: where it may write, and the pipes from and to the grader."""

    def __init__(self, where: Mapping[str, Any], asked: int, told: int) -> None:
        self._where, self._asked, self._told = where, asked, told
        # Cells that ended an earlier run, and whose run it was: none is waited for
        # twice.
        self._culprits: dict[str, int] = {}

    def submission(self) -> None:
        """Read the notebook, then run what is asked for."""
        request = _asked(self._asked)
        limits = Limits(*request["limits"])
        try:
            with memory_limited(limits):
                plan, told = _read(request)
        except UnusableNotebook as error:
            return self._unusable(str(error))
        except (MemoryError, RecursionError) as error:
            words = f"cannot be read within its limits ({type(error).__name__})"
            return self._unusable(words)
        messages.send(self._told, messages.TOLD, wire.pack(told))
        questions = _asked(self._asked)["questions"]
        _load_slow_packages([plan[q["index"]] for q in questions], questions)
        around = runner.Surroundings(
            self._where["work"],
            tuple(self._where["closed"]),
            tuple(self._where["path"]),
            limits,
            filter_installer() if self._where["boxed"] else None,
        )
        for question in questions:
            if not hasattr(
                os, "fork"
            ):  # one question a process, and the grader watches
                runner.run(_task(plan, question), around, self._told)
            ended = self._ask(_task(plan, question), question["index"], around)
            messages.send(self._told, messages.END, wire.pack(ended))

    def _unusable(self, words: str) -> None:
        messages.send(self._told, messages.UNUSABLE, words.encode("utf-8", "replace"))

    def _ask(
        self, task: runner.Task, index: int, around: runner.Surroundings
    ) -> dict[str, Any]:
        """Run one exercise in a fork, and return how it ended."""
        earlier = (self._culprits.get(source) for source, _ in task.cells[:-1])
        blocked = next((by for by in earlier if by is not None), None)
        if blocked is not None:
            return {"index": index, "end": "blocked", "by": blocked}
        _clear(around.work)
        outlet, inlet = os.pipe()
        process = os.fork()
        if process == 0:
            _become_runner(task, around, inlet, (outlet, self._asked, self._told))
        os.close(inlet)
        boxed = self._where["boxed"]
        try:
            seen = watch(
                process, outlet, self._asked, around.work, around.limits, boxed=boxed
            )
        finally:
            os.close(outlet)
        stage, _, number = seen.stage.partition(" ")
        if seen.end != "replied" and stage == "cell" and number.isdigit():
            culprit = task.cells[min(int(number), len(task.cells) - 1)][0]
            self._culprits[culprit] = index
        return {
            "index": index,
            "end": seen.end,
            "stage": seen.stage,
            "detail": seen.detail,
            "refused": seen.refused,
            "seconds": seen.seconds,
            "reply": np.frombuffer(seen.reply, np.uint8),
        }


def _read(request: Mapping[str, Any]) -> tuple[tuple[Planned, ...], dict[str, Any]]:
    """The plan of a notebook, and its report for the grader.

    The report: the lesson, and for each exercise whether it is run.
    """
    lessons = [Outline(number, tuple(names)) for number, names in request["lessons"]]
    content = request["notebook"].tobytes()
    notebook = parse_notebook(content, request["file"], lessons)
    plan = plan_of(notebook)
    told = [
        {
            "state": p.state,
            "fault": p.cell.fault,
            "nearest": p.cell.nearest,
            "person": p.cell.needs_person,
            "cells": len(p.cells),
        }
        for p in plan
    ]
    return plan, {"lesson": notebook.lesson, "exercises": told}


def _task(plan: Sequence[Planned], question: Mapping[str, Any]) -> runner.Task:
    cells = plan[question["index"]].cells
    told = {k: v for k, v in question.items() if k != "index"}
    lists = {k: tuple(v) for k, v in told.items() if isinstance(v, list)}
    return runner.Task(cells, **{**told, **lists})


def _become_runner(
    task: runner.Task,
    around: runner.Surroundings,
    inlet: int,
    others: Sequence[int],
) -> NoReturn:
    try:
        os.setpgid(0, 0)
        for pipe in others:
            os.close(pipe)
        runner.run(task, around, inlet)
    except Exception as error:
        told = f"{type(error).__name__}: {error}"
        messages.send(inlet, messages.FAULT, told.encode("utf-8", "replace"))
    finally:
        os._exit(70)


def _load_slow_packages(
    plan: Sequence[Planned], questions: Sequence[Mapping[str, Any]]
) -> None:
    """Loading them takes seconds that are not the student's; once for all exercises."""
    preamble = [s for p in plan for s, tolerant in p.cells if tolerant]
    answers = [s for p in plan for s, tolerant in p.cells if not tolerant]
    wanted = set(modules_used(preamble, answers, SLOW))
    if any(q["kind"] == "expression" for q in questions):
        wanted.add("sympy")
    for name in sorted(wanted):
        with contextlib.suppress(Exception):  # the run will notice by itself
            importlib.import_module(name)


def _clear(folder: str) -> None:
    """Empty the folder, so that one exercise's files do not affect the next."""
    for name in os.listdir(folder):
        place = os.path.join(folder, name)
        with contextlib.suppress(OSError, RecursionError):
            if os.path.isdir(place) and not os.path.islink(place):
                shutil.rmtree(place, ignore_errors=True)
            else:
                os.unlink(place)


def _asked(pipe: int) -> Any:
    """The grader's next request; raises ``Abandoned`` where there is none."""
    message = messages.receive(lambda count: os.read(pipe, count))
    if message is None or message[0] != messages.ASK:
        raise Abandoned
    return wire.unpack(message[1])


def _own_pipes() -> tuple[int, int]:
    """Standard input and output under other numbers that no run inherits; theirs lead
    to nothing.
    """
    asked, told = os.dup(0), os.dup(1)
    nowhere = os.open(os.devnull, os.O_RDWR)
    os.dup2(nowhere, 0)
    os.dup2(nowhere, 1)
    os.close(nowhere)
    sys.stdin = open(os.devnull)
    return asked, told
