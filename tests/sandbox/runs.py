"""One answer run by itself, for the tests of the sandbox."""

import json
import subprocess
import sys
from dataclasses import dataclass

import pytest

from course.exercises.notebook_file import Outline
from course.exercises.question import Question
from course.sandbox.box import bubblewrap
from course.sandbox.findings import Answers, Run
from course.sandbox.limits import Limits
from course.sandbox.reply import Reply
from course.sandbox.running import Sandbox, find_isolation
from course.sandbox.session import SandboxFailure

POSIX = pytest.mark.skipif(sys.platform == "win32", reason="POSIX processes")
LINUX = pytest.mark.skipif(
    not sys.platform.startswith("linux"), reason="Linux limits the memory of a process"
)


def why_no_box():
    """Why submissions cannot be boxed on this machine; empty where they can."""
    if bubblewrap() is None:
        return "bubblewrap is not installed"
    try:
        return find_isolation(Limits()).reason
    except SandboxFailure as failure:
        return str(failure)


NO_BOX = why_no_box()
BOXED = pytest.mark.skipif(bool(NO_BOX), reason=f"no box here: {NO_BOX}")
#: Both ways to run a submission.
EITHER_WAY = pytest.mark.parametrize(
    "boxed", [False, pytest.param(True, marks=BOXED)], ids=["plain", "boxed"]
)


def descendants(process):
    """The numbers of the processes that one started, and those started, and so on."""
    command = ["ps", "-eo", "pid=,ppid="]
    told = subprocess.run(command, capture_output=True, text=True).stdout
    pairs = [tuple(map(int, line.split())) for line in told.splitlines()]
    found = [process]
    for one in found:
        found += [pid for pid, parent in pairs if parent == one]
    return found[1:]


def is_running(process):
    """Whether a process is there and no more than a name that nobody asked for."""
    command = ["ps", "-o", "stat=", "-p", str(process)]
    told = subprocess.run(command, capture_output=True, text=True).stdout
    return told.strip()[:1] not in ("", "Z")


def _imports(source):
    return all(line.startswith("import ") for line in source.splitlines())


def notebook_of(*sources):
    """A notebook of code cells; one that only imports is the lesson's import cell."""
    cells = [
        {
            "cell_type": "code",
            "source": source,
            "metadata": {"course": {"role": "imports"}} if _imports(source) else {},
        }
        for source in sources
    ]
    return json.dumps({"nbformat": 4, "cells": cells}).encode()


@dataclass(frozen=True)
class Ended:
    """How the notebook's last answer, or the cell that it is in, ended."""

    end: str
    detail: str
    reply: Reply | None
    answers: Answers

    @property
    def refused(self):
        return self.answers.refused


def answers_of(
    *sources, case=None, results=1, seconds=5.0, memory_mb=2000, file_mb=100,
    boxed=False, cancel=None, name="f", most=10**6,
):  # fmt: skip
    """What a notebook of these cells gives for the function f(x), which one of them defines."""
    cases = ({"x": 1.0} if case is None else case,)
    question = Question(name, "function", tuple(cases[0]), results, cases, (most,))
    sandbox = Sandbox(Limits(seconds, memory_mb, file_mb), boxed, cancel)
    with sandbox.submission(
        notebook_of(*sources), "f.ipynb", [Outline("90", (name,))]
    ) as session:
        (answers,) = session.answers([question])
    return answers


def run(*sources, **options):
    answers = answers_of(*sources, **options)
    last = answers.runs[-1] if answers.runs else Run("ended")
    end, detail = answers.own or (last.end, last.detail)
    return Ended(end, detail, last.reply, answers)


def outcome(source, **options):
    result = run(source, **options)
    assert result.end == "replied", result
    return result.reply.answer.outcomes[0]


def value(source, **options):
    told = outcome(source, **options)
    assert told.kind == "value", told
    return told.values[0]
