"""A search for repairs of a wrong answer whose source is changed and run in another process.

For a notebook that is one limited process, spawned at the first need and kept warm: spawned, never forked, so that a
kernel's threads and open files stay its own. For a grader it is the submission's own. What comes back are arrays and
text; they are judged here, and nothing of them is run.
"""

from __future__ import annotations

import atexit
import contextlib
import queue
import subprocess
import sys
import tempfile
import threading
from collections.abc import Callable, Iterator, Mapping, Sequence
from dataclasses import replace
from pathlib import Path
from typing import Any

from course.exercises.answer import Outcome
from course.exercises.inputs import Inputs, observed
from course.exercises.repair.changes import UNCHANGED, Candidate, Step
from course.exercises.repair.recipe import Recipe
from course.exercises.repair.search import Repair, Search
from course.exercises.untrusted_text import clean
from course.exercises.verdict import alike
from course.sandbox import messages, wire
from course.sandbox.box import start_plain
from course.sandbox.limits import resident_mb
from course.sandbox.messages import NoReply
from course.sandbox.reply import checked_outcome
from course.sandbox.trying import MEMORY_MB

#: Seconds for the search of a check; half where memory cannot be capped (macOS).
BUDGET = 4.0
#: For the process to start, and to say anything at all.
START_SECONDS, SILENCE_SECONDS = 30.0, 10.0
#: How often the memory of a process is looked at that cannot be capped [s].
LOOK_SECONDS = 0.1
#: Characters of a kind of change, of a line, and of a whole source.
KIND, LINE, SOURCE = 100, 300, 20_000

#: Sends a request and gives the reply; raises ``NoReply``.
Ask = Callable[[Mapping[str, Any]], Any]


class Child:
    """The process of a kernel: started by the first request.

    ``watched`` (default: where it cannot cap its memory) has its resident memory looked at from here, and ends it
    above ``memory_mb``.
    """

    def __init__(
        self, *, watched: bool | None = None, memory_mb: int = MEMORY_MB
    ) -> None:
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
        held = self._next(START_SECONDS)["held"]
        self.watched = "memory" not in held if watched is None else watched
        self.ended_by_watch = False
        if self.watched:
            watch = threading.Thread(target=self._watch, args=[memory_mb], daemon=True)
            watch.start()

    def _listen(self) -> None:
        pipe = self._process.stdout
        assert pipe is not None
        with contextlib.suppress(OSError, ValueError):
            while message := messages.receive(pipe.read1):
                self._inbox.put(message[1])
        self._inbox.put(None)

    def _watch(self, memory_mb: int) -> None:
        while self._process.poll() is None:
            if resident_mb(self._process.pid) > memory_mb:
                self.ended_by_watch = True
                self._process.kill()
                return
            with contextlib.suppress(subprocess.TimeoutExpired):
                self._process.wait(LOOK_SECONDS)

    def _next(self, seconds: float) -> Any:
        try:
            payload = self._inbox.get(timeout=seconds)
        except queue.Empty:
            payload = None
        if payload is None:
            raise NoReply
        return wire.unpack(payload)

    def ask(self, request: Mapping[str, Any]) -> Any:
        """Send a request and wait for its reply; raises ``NoReply``."""
        assert self._process.stdin is not None
        try:
            messages.send(
                self._process.stdin.fileno(), messages.ASK, wire.pack(dict(request))
            )
        except OSError:
            raise NoReply from None
        return self._next(SILENCE_SECONDS)

    def close(self) -> None:
        """End the process at once."""
        self._process.kill()
        self._process.wait()
        self._folder.cleanup()
        atexit.unregister(self.close)


_child: Child | None = None


@contextlib.contextmanager
def _warm(child: Child | None = None) -> Iterator[Child]:
    """The process, kept for the next time; ended where anything goes wrong in between, an interrupt too."""
    global _child
    _child = child or _child or Child()
    try:
        yield _child
    except BaseException:
        _child.close()
        _child = None
        raise


def repair_of(
    inputs: Inputs,
    recipe: Recipe,
    outcomes: Sequence[Outcome],
    seconds: float = BUDGET,
    *,
    child: Child | None = None,
) -> Repair | None:
    """The change that makes a notebook's wrong answer right, or None.

    Only where the recipe's source gives in the child what the answer gave in the notebook, ``outcomes``. Where the
    child's memory can only be watched, the search has half its time, and the repair says so.
    """
    opening = {
        "source": recipe.source,
        "prelude": recipe.prelude,
        "values": dict(recipe.values),
        "elementwise": recipe.elementwise,
    }
    try:
        with _warm(child) as running:
            budget = seconds / 2 if running.watched else seconds
            repair = search(running.ask, opening, inputs, outcomes, budget)
            return repair and replace(repair, halved=running.watched)
    except (NoReply, wire.Unreadable, OSError):
        return None


def search(
    ask: Ask,
    opening: Mapping[str, Any],
    inputs: Inputs,
    outcomes: Sequence[Outcome],
    seconds: float,
) -> Repair | None:
    """The change that makes an answer right, which gave these outcomes, or None.

    ``opening`` is what the other end needs to know of the answer. Raises ``NoReply``, and ``wire.Unreadable`` where
    what comes back is not what was asked for.
    """
    answer = _AnswerElsewhere(ask, inputs)
    there = answer.begin(opening)
    if there is None or not alike(inputs.exercise, outcomes, there):
        return None
    return Search(inputs, answer, seconds).find(there)


class _AnswerElsewhere:
    """An answer in another process, as a search changes and runs it (``Changes``)."""

    def __init__(self, ask: Ask, inputs: Inputs) -> None:
        self._ask, self._inputs = ask, inputs
        draws = (inputs, *inputs.others)
        self._cases = [case for drawn in draws for case in drawn.cases]
        self._most = [most for drawn in draws for most in drawn.most]

    def begin(self, opening: Mapping[str, Any]) -> list[Outcome] | None:
        """What the unchanged source gives on the answer's own cases; None where it cannot be run there."""
        question, own = self._inputs.question, len(self._inputs.cases)
        kinds = [case.kind for case in self._cases]
        sent = self._ask({
            **opening, "name": question.name, "arguments": question.arguments, "results": question.results,
            "cases": [dict(case.arguments) for case in self._cases], "own": own,
            "single": kinds.index("single") if "single" in kinds else 0,
        })  # fmt: skip
        if not isinstance(sent, dict) or sent.get("error") != "":
            return None
        return self._outcomes(sent.get("outcomes"), range(own))

    def changes(self, after: int = UNCHANGED) -> list[Candidate]:
        """Every change of the source."""
        with _readable():
            return [
                Candidate(
                    clean(kind, KIND),
                    int(stage),
                    int(length),
                    int(grown),
                    bool(unlike),
                    bool(converts),
                )
                for kind, stage, length, grown, unlike, converts in self._ask(
                    {"after": after}
                )
            ]

    def step(self, number: int, after: int = UNCHANGED) -> Step:
        """A change in words and code."""
        with _readable():
            sent = self._ask({"step": number, "after": after})
            line, old, new = (clean(sent[k], LINE) for k in ("line", "old", "new"))
            changed = clean(sent["changed"], SOURCE)
            return Step(clean(sent["kind"], KIND), line, old, new, changed)

    def outcomes(
        self,
        numbers: Sequence[int],
        cases: Sequence[int],
        *,
        after: int = UNCHANGED,
        left: bool = False,
    ) -> list[list[Outcome]]:
        """What changed sources give."""
        sent = self._ask({"run": list(numbers), "cases": list(cases), "after": after, "left": left})  # fmt: skip
        if not isinstance(sent, list) or len(sent) != len(numbers):
            raise wire.Unreadable("not one list of results for each source")
        return [self._outcomes(one, cases) for one in sent]

    def _outcomes(self, sent: Any, cases: Sequence[int]) -> list[Outcome]:
        if not isinstance(sent, list) or len(sent) != len(cases):
            raise wire.Unreadable("not one result for each case")
        results = self._inputs.question.results
        pairs = zip(cases, sent, strict=True)
        return [
            observed(
                self._cases[i].arguments, checked_outcome(one, self._most[i], results)
            )
            for i, one in pairs
        ]


@contextlib.contextmanager
def _readable() -> Iterator[None]:
    """Whatever a stranger's data may bring about, it is unreadable."""
    try:
        yield
    except (TypeError, ValueError, KeyError, OverflowError) as error:
        raise wire.Unreadable(str(error)[:200]) from None
