"""One answer run by itself, for the tests of the sandbox."""

import json
import subprocess
import sys

import pytest

from course.exercises.notebook_file import Outline
from course.sandbox.box import bubblewrap
from course.sandbox.limits import Limits
from course.sandbox.running import Question, Sandbox, SandboxFailure, find_isolation

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


def notebook_of(*sources):
    cells = [
        {"cell_type": "code", "source": source, "metadata": {}} for source in sources
    ]
    return json.dumps({"nbformat": 4, "cells": cells}).encode()


def run(
    *sources, case=None, results=1, seconds=5.0, memory_mb=2000, file_mb=100,
    boxed=False, cancel=None, name="f", most=10**6,
):  # fmt: skip
    """The run of the function f(x), which the last cell defines; cells before it are helpers."""
    cases = ({"x": 1.0} if case is None else case,)
    question = Question(0, name, "function", tuple(cases[0]), results, cases, (most,))
    sandbox = Sandbox(Limits(seconds, memory_mb, file_mb), boxed, cancel)
    with sandbox.submission(
        notebook_of(*sources), "f.ipynb", [Outline("90", (name,))]
    ) as session:
        assert session.reading.exercises[0].state == "run", session.reading
        (ended,) = session.answers([question])
    return ended


def outcome(source, **options):
    result = run(source, **options)
    assert result.end == "replied", result
    return result.reply.outcomes[0]


def value(source, **options):
    told = outcome(source, **options)
    assert told.kind == "value", told
    return told.values[0]
