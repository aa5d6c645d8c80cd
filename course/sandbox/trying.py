"""The child that tries repairs: runs changed sources of one answer on the cases it is given, within limits.

Changed code may take any memory and any time: this process caps its memory, a timer ends each run, and whoever started
it ends it where even that fails. It knows neither a reference nor a verdict.
"""

from __future__ import annotations

import contextlib
import os
import signal
import sys
import time
from collections.abc import Iterator, Mapping
from types import FrameType
from typing import Any, NoReturn

import numpy as np

from course.exercises.answer import Outcome, as_function, call_all
from course.sandbox import guard, limits, messages, wire

MEMORY_MB = 2000
#: Seconds that a changed source may take, at least; else so many times what the unchanged one took.
LEAST, TIMES = 0.15, 10
LONG = 86_400.0


class Overtime(BaseException):
    """A run took too long; no ``Exception``, or ``except Exception`` in a loop would keep it."""


def serve(where: Mapping[str, Any]) -> NoReturn:
    """Answer requests until the other end is closed."""
    asked, told = os.dup(0), os.dup(1)
    nowhere = os.open(os.devnull, os.O_RDWR)
    os.dup2(nowhere, 0)
    os.dup2(nowhere, 1)
    held = limits.apply_limits(limits.Limits(LONG, MEMORY_MB, 1))
    if hasattr(signal, "SIGALRM"):
        signal.signal(signal.SIGALRM, _over)
    guarded = False
    messages.send(told, messages.READY, wire.pack({"held": held}))
    served: _Served | None = None
    while message := messages.receive(lambda count: os.read(asked, count)):
        request = wire.unpack(message[1])
        if "prelude" in request:
            if not guarded:
                guard.install_guard(where["work"], (), where["path"], lambda _: None)
                guarded = True
            served = _Served(request)
            reply: Any = served.opened()
        else:
            assert served is not None
            indices, left = request["cases"], request["left"]
            reply = [[served.run(s, indices, left) for s in request["sources"]]]
        messages.send(told, messages.REPLY, wire.pack(reply))
    os._exit(0)


def _over(_: int, __: FrameType | None) -> None:
    raise Overtime("it takes too long")


@contextlib.contextmanager
def _within(seconds: float) -> Iterator[None]:
    """End what runs inside after some seconds; without timers (Windows) whoever started this process does."""
    timer = getattr(signal, "setitimer", None)
    if timer:
        timer(signal.ITIMER_REAL, seconds, seconds)
    try:
        yield
    finally:
        if timer:
            timer(signal.ITIMER_REAL, 0)


class _Served:
    """One answer: its names, cases and time."""

    def __init__(self, request: Mapping[str, Any]) -> None:
        self._request = request
        self._space: dict[str, Any] = {"__name__": "__main__"}
        self._limit = 5.0

    def opened(self) -> dict[str, Any]:
        """Run the prelude and the unchanged source; tell its outcomes and the axes of its names in a single case."""
        request = self._request
        try:
            with _within(self._limit):
                exec(request["prelude"], self._space)
        except BaseException as error:
            return {"error": str(error)[:200], "outcomes": [], "axes": {}}
        self._space.update(request["values"])
        axes: dict[str, int] = {}
        sys.setprofile(_spy(axes))
        try:
            self.run(request["source"], [request["single"]], False)
        finally:
            sys.setprofile(None)
        began = time.perf_counter()
        outcomes = self.run(request["source"], list(range(request["own"])), True)
        self._limit = LEAST + TIMES * (time.perf_counter() - began)
        return {"error": "", "outcomes": outcomes, "axes": axes}

    def run(self, source: str, indices: list[int], left: bool) -> list[dict[str, Any]]:
        """What a source gives on some of the cases; ``left``: and how it leaves its arguments."""
        request, space = self._request, dict(self._space)
        cases = [request["cases"][i] for i in indices]
        try:
            with _within(self._limit):
                exec(compile(source, "<cell>", "exec"), space)
                name = request["name"]
                function = as_function(
                    space[name], "function", name, request["arguments"]
                )
                outcomes = call_all(
                    _broadcast(function) if request["elementwise"] else function,
                    cases,
                    request["results"],
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
