"""The side of a check that has repairs tried: one limited process, spawned at the first need and kept warm.

Spawned, never forked: a kernel's threads and open files stay its own. What comes back are arrays and text; they are
judged here, and nothing of them is run.
"""

from __future__ import annotations

import atexit
import contextlib
import queue
import subprocess
import sys
import tempfile
import threading
from collections.abc import Mapping, Sequence
from pathlib import Path
from typing import Any

from course.exercises.advice import asks_one_question
from course.exercises.answer import Outcome
from course.exercises.definition import Case, Exercise
from course.exercises.repair.places import Code
from course.exercises.repair.recipe import Recipe
from course.exercises.repair.search import Repair, Search, drawn_cases
from course.exercises.verdict import alike
from course.sandbox import messages, wire
from course.sandbox.box import start_plain

#: Seconds for the search; half where memory cannot be capped (macOS).
BUDGET = 4.0
#: For the process to start, and to say anything at all.
START_SECONDS, SILENCE_SECONDS = 30.0, 10.0


class Ended(RuntimeError):
    """The process is gone or does not answer."""


class Child:
    """The process: started by the first request."""

    def __init__(self) -> None:
        self._folder = tempfile.TemporaryDirectory(
            prefix="course-repair-", ignore_cleanup_errors=True
        )
        start = start_plain(Path(self._folder.name).resolve(), "repair_child.py")
        own_group = {} if sys.platform == "win32" else {"start_new_session": True}
        self._process = subprocess.Popen(
            start.command, cwd=start.folder, env=start.environment, stdin=subprocess.PIPE,
            stdout=subprocess.PIPE, stderr=subprocess.DEVNULL, close_fds=True, **own_group,  # type: ignore[call-overload]
        )  # fmt: skip
        self._inbox: queue.SimpleQueue[bytes | None] = queue.SimpleQueue()
        threading.Thread(target=self._listen, daemon=True).start()
        atexit.register(self.close)
        self.capped = "memory" in self._next(START_SECONDS)["held"]

    def _listen(self) -> None:
        pipe = self._process.stdout
        assert pipe is not None
        with contextlib.suppress(OSError, ValueError):
            while message := messages.receive(pipe.read1):
                self._inbox.put(message[1])
        self._inbox.put(None)

    def _next(self, seconds: float) -> Any:
        try:
            payload = self._inbox.get(timeout=seconds)
        except queue.Empty:
            payload = None
        if payload is None:
            raise Ended
        return wire.unpack(payload)

    def ask(self, request: Mapping[str, Any]) -> Any:
        """Send a request and wait for its reply; raises ``Ended``."""
        assert self._process.stdin is not None
        try:
            messages.send(
                self._process.stdin.fileno(), messages.ASK, wire.pack(dict(request))
            )
        except OSError:
            raise Ended from None
        return self._next(SILENCE_SECONDS)

    def close(self) -> None:
        """End the process at once."""
        self._process.kill()
        self._process.wait()
        self._folder.cleanup()
        atexit.unregister(self.close)


_child: Child | None = None


@contextlib.contextmanager
def _warm() -> Any:
    """The process, kept for the next time; ended where anything goes wrong in between, an interrupt too."""
    global _child
    _child = _child or Child()
    try:
        yield _child
    except BaseException:
        _child.close()
        _child = None
        raise


def memory_capped() -> bool:
    """Whether the process that is kept could limit its memory; True where there is none yet."""
    return _child is None or _child.capped


def repair_of(
    exercise: Exercise,
    recipe: Recipe,
    outcomes: Sequence[Outcome],
    seconds: float = BUDGET,
) -> Repair | None:
    """The change that makes a wrong answer right, or None.

    Only where the recipe's source gives in the child what the answer gave in the notebook, ``outcomes``.
    """
    cases, own = drawn_cases(exercise)
    if _told_already(cases[:own], outcomes):
        return None
    try:
        with _warm() as child:
            told = child.ask(_request(exercise, recipe, cases, own))
            there = [_outcome(o) for o in told["outcomes"]]
            if told["error"] or not alike(exercise, cases[:own], outcomes, there):
                return None
            code = Code(
                recipe.source, {str(k): int(v) for k, v in told["axes"].items()}
            )

            def attempt(
                sources: Sequence[str], indices: Sequence[int], left: bool
            ) -> list[list[Outcome]]:
                request = {
                    "sources": list(sources),
                    "cases": list(indices),
                    "left": left,
                }
                (came,) = child.ask(request)
                return [[_outcome(o) for o in run] for run in came]

            search = Search(
                exercise, cases, own, attempt, seconds if child.capped else seconds / 2
            )
            return search.find(code, there)
    except (Ended, wire.Unreadable, OSError):
        return None


def _told_already(cases: Sequence[Case], outcomes: Sequence[Outcome]) -> bool:
    """Whether the outcomes say themselves what is wrong: inputs written to, an `if` on a batch.

    What makes these right is a copy or a rewriting; a smaller change that happens to do so is not the cause.
    """
    wrote = any(o.kind == "wrote" for o in outcomes)
    return wrote or asks_one_question(cases, outcomes)


def _request(
    exercise: Exercise, recipe: Recipe, cases: Sequence[Any], own: int
) -> dict[str, Any]:
    single = next((i for i, c in enumerate(cases) if c.kind == "single"), 0)
    return {
        "source": recipe.source,
        "prelude": recipe.prelude,
        "values": dict(recipe.values),
        "name": exercise.name,
        "arguments": [a.name for a in exercise.arguments],
        "results": len(exercise.results),
        "elementwise": recipe.elementwise,
        "cases": [dict(c.arguments) for c in cases],
        "own": own,
        "single": single,
    }


def _outcome(plain: Mapping[str, Any]) -> Outcome:
    return Outcome(
        plain["kind"], tuple(plain["values"]), plain["text"], given=plain["given"]
    )
