"""The child that tries repairs: changes one answer's source and runs what comes of it, within limits.

Changed code may take any memory and any time: this process caps its memory, a timer ends each run, and whoever started
it ends it where even that fails. It knows neither a reference nor a verdict.
"""

from __future__ import annotations

import contextlib
import os
import signal
import sys
import time
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import asdict, astuple
from types import FrameType
from typing import Any, NoReturn

import numpy as np

from course.exercises.answer import Outcome, as_function, call_all
from course.exercises.repair.changes import UNCHANGED, ChangedSource
from course.exercises.repair.edits import Code
from course.sandbox import guard, limits, messages, wire

MEMORY_MB = 2000
#: Seconds that a changed source may take, at least; else so many times what the unchanged one took.
LEAST, TIMES = 0.15, 10
#: Seconds for the prelude, and for the unchanged source.
FIRST = 5.0
LONG = 86_400.0


class Overtime(KeyboardInterrupt):
    """A run took too long. An interrupt ends all its cases, and no ``except Exception`` in a loop keeps it."""


def serve(where: Mapping[str, Any]) -> NoReturn:
    """Answer the requests of a kernel until the other end is closed."""
    inlet, outlet = os.dup(0), os.dup(1)
    nowhere = os.open(os.devnull, os.O_RDWR)
    os.dup2(nowhere, 0)
    os.dup2(nowhere, 1)
    held = limits.apply_limits(limits.Limits(LONG, MEMORY_MB, 1))
    messages.send(outlet, messages.READY, wire.pack({"held": held}))
    guarded = False
    answer: _Answer | None = None
    while request := next_request(inlet):
        if "prelude" in request:
            if not guarded:
                guard.install_guard(where["work"], (), where["path"], lambda _: None)
                guarded = True
            answer = _Answer(request)
        assert answer is not None
        messages.send(outlet, messages.REPLY, wire.pack(answer.reply(request)))
    os._exit(0)


def serve_one(opening: Mapping[str, Any], inlet: int, outlet: int) -> NoReturn:
    """Answer an opening request, then those that come through ``inlet``: for a process that is limited already."""
    answer = _Answer(opening)
    request: Mapping[str, Any] | None = opening
    while request:
        messages.send(outlet, messages.REPLY, wire.pack(answer.reply(request)))
        request = next_request(inlet)
    os._exit(0)


def next_request(inlet: int) -> Any:
    """What is asked next; None where the other end is closed."""
    message = messages.receive(lambda count: os.read(inlet, count))
    return wire.unpack(message[1]) if message else None


def _over(_: int, __: FrameType | None) -> None:
    raise Overtime("it takes too long")


@contextlib.contextmanager
def _within(seconds: float) -> Iterator[None]:
    """End what runs inside after some seconds; without timers (Windows) whoever started this process does."""
    timer = getattr(signal, "setitimer", None)
    if timer:
        signal.signal(signal.SIGALRM, _over)
        timer(signal.ITIMER_REAL, seconds, seconds)
    try:
        yield
    finally:
        if timer:
            timer(signal.ITIMER_REAL, 0)


class _Answer:
    """One answer: its source and the changes of it, its names, cases and time."""

    def __init__(self, opening: Mapping[str, Any]) -> None:
        self._opening = opening
        self._space: dict[str, Any] = {"__name__": "__main__"}
        self._limit = min(FIRST, opening.get("seconds", FIRST))
        # An expression's function ends with a line that is not the student's.
        self._hidden = f"return {opening['name']}" if opening["elementwise"] else ""
        self._sources = ChangedSource(Code(opening["source"]), self._hidden)

    def reply(self, request: Mapping[str, Any]) -> Any:
        """What a request asks for: to begin, the changes there are, one of them in words, or runs."""
        if "prelude" in request:
            return self._begin()
        after = request.get("after", UNCHANGED)
        if "step" in request:
            return asdict(self._sources.step(request["step"], after))
        if "run" in request:
            sources = [self._sources.source(n, after) for n in request["run"]]
            return [self._run(s, request["cases"], request["left"]) for s in sources]
        return [list(astuple(c)) for c in self._sources.changes(after)]

    def _begin(self) -> dict[str, Any]:
        """Run the prelude and the unchanged source; what that gave on the answer's own cases."""
        opening = self._opening
        try:
            with _within(self._limit):
                exec(opening["prelude"], self._space)
        except BaseException as error:
            return {"error": str(error)[:200], "outcomes": []}
        self._space.update(opening["values"])
        axes: dict[str, int] = {}
        sys.setprofile(_spy(axes))
        try:
            self._run(opening["source"], [opening["single"]], False)
        finally:
            sys.setprofile(None)
        self._sources = ChangedSource(Code(opening["source"], axes), self._hidden)
        began = time.perf_counter()
        outcomes = self._run(opening["source"], range(opening["own"]), True)
        self._limit = LEAST + TIMES * (time.perf_counter() - began)
        return {"error": "", "outcomes": outcomes}

    def _run(
        self, source: str, indices: Sequence[int], left: bool
    ) -> list[dict[str, Any]]:
        """What a source gives on some of the cases; ``left``: and how it leaves its arguments."""
        opening, space = self._opening, dict(self._space)
        cases = [opening["cases"][i] for i in indices]
        try:
            with _within(self._limit):
                exec(compile(source, "<cell>", "exec"), space)
                name = opening["name"]
                function = as_function(
                    space[name], "function", name, opening["arguments"]
                )
                outcomes = call_all(
                    _broadcast(function) if opening["elementwise"] else function,
                    cases,
                    opening["results"],
                )
        except BaseException as error:
            outcomes = [
                Outcome("raised", text=f"{type(error).__name__}: {error}"[:200])
            ] * len(cases)
        return [_plain(o, left) for o in outcomes]


def _broadcast(function: Any) -> Any:
    """An expression's function gives an array of its arguments' common shape, a constant too."""

    def evaluate(*points: Any) -> np.ndarray:
        shape = np.broadcast_shapes(*(np.shape(p) for p in points))
        return np.broadcast_to(np.asarray(function(*points), dtype=float), shape).copy()

    return evaluate


def _plain(outcome: Outcome, left: bool) -> dict[str, Any]:
    given = dict(outcome.given) if left and outcome.kind == "value" else {}
    return {
        "kind": outcome.kind,
        "values": list(outcome.values),
        "text": outcome.text[:300],
        "given": given,
    }


def _spy(axes: dict[str, int]) -> Any:
    """Notes how many axes the numbers have that functions of the answer's source leave behind."""

    def profile(frame: FrameType, event: str, _: Any) -> None:
        if event == "return" and frame.f_code.co_filename == "<cell>":
            for name, value in frame.f_locals.items():
                if isinstance(value, (int, float, np.ndarray, np.generic)):
                    axes.setdefault(name, np.ndim(value))

    return profile
