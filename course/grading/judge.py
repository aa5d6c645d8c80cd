"""From a submission to its rows: points, state and reason of every exercise.

The judge draws the inputs, runs the reference and compares; the submission's code runs
in ``course.sandbox`` and returns arrays. Nothing that code prints, patches or exits
with counts as a verdict.
"""

from __future__ import annotations

import threading
from collections.abc import Iterator, Sequence
from dataclasses import dataclass, field, replace
from functools import cached_property

from course.exercises.definition import Case, Exercise, Lesson, all_lessons
from course.exercises.message import verdict_message
from course.exercises.notebook_file import Outline
from course.exercises.verdict import State, Verdict, answers_of, judge
from course.sandbox.ending import WITHOUT_REPLY
from course.sandbox.running import Found, Question, Run, Sandbox

REASON_LIMIT = 500
#: An answer may give this many numbers where few are expected: a wrong shape is then
#: reported as such.
FEW = 10_000
#: Where a run ended that reached no case: said of the exercise whose cell it is, and of
#: one that uses that cell.
OWN_CELL = "its cell, outside the function,"
EARLIER_CELL = "a cell before it, which it uses,"
# The reference's call redirects what is printed, which is shared by all threads.
_judging = threading.Lock()


@dataclass(frozen=True)
class Row:
    """One exercise of one submission. ``points`` is None where a person has to give
    them.
    """

    exercise: Exercise
    points: int | None
    state: State
    reason: str
    verdict: Verdict
    seconds: float = 0.0
    refused: tuple[str, ...] = ()


@dataclass(frozen=True)
class Judge:
    """How a submission is judged.

    ``seed`` draws the inputs (None: those of every notebook's own check), ``sandbox``
    runs the code, ``lessons`` are the ones it may be of (default: all).
    """

    seed: int | None = None
    sandbox: Sandbox = field(default_factory=Sandbox)
    lessons: tuple[Lesson, ...] | None = None

    def rows(self, content: bytes, file: str) -> tuple[Lesson, Iterator[Row]]:
        """The lesson of a submission, and its rows in the lesson's order, as they are
        made.

        Raises ``UnusableNotebook``, ``SandboxFailure`` where this machine cannot run
        it, ``Cancelled`` when stopped.
        """
        rows = self._rows(content, file)
        lesson = next(rows)
        assert isinstance(lesson, Lesson)
        return lesson, rows  # type: ignore[return-value]

    def _rows(self, content: bytes, file: str) -> Iterator[Lesson | Row]:
        with self.sandbox.submission(content, file, self._outlines) as session:
            lesson = self._by_number[session.reading.lesson]
            yield lesson
            asked = [
                self._question(i, exercise, found)
                for i, (exercise, found) in enumerate(
                    zip(lesson.exercises, session.reading.exercises, strict=True)
                )
                if found.state == "run"
            ]
            runs = session.runs(asked)
            done: dict[int, Row] = {}
            for i, exercise in enumerate(lesson.exercises):
                found = session.reading.exercises[i]
                run = next(runs) if found.state == "run" else None
                done[i] = self._row(exercise, found, run, done)
                yield done[i]

    def _row(
        self, exercise: Exercise, found: Found, run: Run | None, done: dict[int, Row]
    ) -> Row:
        """The row of an exercise. ``done`` are the earlier rows, by place.

        A cell that ended one of their runs is not run again.
        """
        if run is None:
            verdict = _unrun(exercise, found)
        elif run.end == "blocked":
            by = done.get(run.by)
            verdict = replace(_blocked(by), exercise=exercise.name)
        else:
            own = found.cells - 1
            answer = (
                replace(exercise, name=found.nearest) if found.nearest else exercise
            )
            verdict = _safely(answer, self._drawn(exercise)[0], run, self.sandbox, own)
            if found.nearest:
                verdict = _renamed(exercise.name, found, verdict)
        points = None if verdict.state == "needs a person" else verdict.points
        reason = reason_of(exercise, verdict)
        more = (run.seconds, run.refused) if run else (0.0, ())
        return Row(exercise, points, verdict.state, reason, verdict, *more)

    def _question(self, index: int, exercise: Exercise, found: Found) -> Question:
        cases, most = self._drawn(exercise)
        return Question(
            index,
            found.nearest or exercise.name,
            exercise.kind,
            tuple(a.name for a in exercise.arguments),
            len(exercise.results),
            tuple(case.arguments for case in cases),
            most,
        )

    def _drawn(self, exercise: Exercise) -> tuple[tuple[Case, ...], tuple[int, ...]]:
        """The inputs, and how many numbers an answer may give for each.

        Drawn once, because all submissions get the same.
        """
        if exercise.name not in self._kept:
            cases = tuple(exercise.draw(self.seed))
            with _judging:
                expected = answers_of(exercise.reference, exercise, cases)
            sizes = [sum(v.size for v in outcome.values) for outcome in expected]
            most = tuple(max(FEW, 4 * size) for size in sizes)
            self._kept[exercise.name] = cases, most
        return self._kept[exercise.name]

    @cached_property
    def _kept(self) -> dict[str, tuple[tuple[Case, ...], tuple[int, ...]]]:
        return {}

    @cached_property
    def _by_number(self) -> dict[str, Lesson]:
        known = all_lessons() if self.lessons is None else self.lessons
        return {lesson.number: lesson for lesson in known}

    @cached_property
    def _outlines(self) -> tuple[Outline, ...]:
        return tuple(
            Outline(number, tuple(e.name for e in lesson.exercises))
            for number, lesson in self._by_number.items()
        )


def reason_of(exercise: Exercise, verdict: Verdict) -> str:
    """Why an answer has no points, in one line; empty where there is nothing to say."""
    if verdict.state in ("passed", "not attempted"):
        return ""
    told = verdict_message(exercise, verdict).parts
    words = [
        f"{p.label}: {p.text}" for p in told if p.label in ("case", "expected", "got")
    ]
    words += [p.text for p in told if p.label in ("look at", "also")]
    line = " | ".join(" ".join(word.split()) for word in words)
    return (
        line
        if len(line) <= REASON_LIMIT
        else line[: REASON_LIMIT - 1] + "\N{HORIZONTAL ELLIPSIS}"
    )


def _unrun(exercise: Exercise, found: Found) -> Verdict:
    """The verdict on an exercise that is blank, or that reading found cannot be run."""
    if found.state == "blank":
        return Verdict(exercise.name, "not attempted")
    state: State = "needs a person" if found.needs_person else "error"
    return Verdict(exercise.name, state, reason=(found.fault,))


def _blocked(by: Row | None) -> Verdict:
    """The verdict where a cell that an exercise needs ended an earlier run."""
    told = by.verdict.reason[:1] if by is not None else ()
    reason = tuple(r.replace(OWN_CELL, EARLIER_CELL) for r in told)
    state: State = "needs a person" if by is not None and by.points is None else "error"
    return Verdict("", state, reason=reason)


def _safely(
    exercise: Exercise, cases: Sequence[Case], run: Run, sandbox: Sandbox, own: int
) -> Verdict:
    """The verdict on a run; where judging its reply fails, a person has to look."""
    try:
        with _judging:
            verdict = _judged(exercise, cases, run, sandbox, own)
            verdict_message(
                exercise, verdict
            )  # what cannot be put into words cannot be a verdict either
            return verdict
    except Exception as error:
        return Verdict(
            exercise.name,
            "needs a person",
            reason=(f"the judge stopped: {type(error).__name__}: {error}",),
        )


def _judged(
    exercise: Exercise, cases: Sequence[Case], run: Run, sandbox: Sandbox, own: int
) -> Verdict:
    name, reply = exercise.name, run.reply
    if reply is None:
        return _unfinished(exercise, cases, run, sandbox, own)
    notes = dict(reply.notes)
    stopped = tuple(
        f"{'its cell' if i == own else EARLIER_CELL} stopped with {text}"
        for i, text in sorted(notes.items(), reverse=True)
    )
    if reply.blank:
        return Verdict(name, "not attempted")
    if reply.missing:
        if own in notes:
            return Verdict(name, "error", reason=stopped)
        return Verdict(
            name,
            "needs a person",
            reason=(f"its cell ran, but there is no {name} after it", *stopped),
        )
    if reply.fault:
        return Verdict(name, "error", reason=(reply.fault, *stopped))
    verdict = judge(exercise, cases, reply.outcomes)
    reason = verdict.reason + (() if verdict.passed else stopped)
    if verdict.outcome is not None and "StandInForCourse" in verdict.outcome.text:
        reason += (
            "It calls the course itself, which is not there while an answer is marked.",
        )
    return replace(verdict, reason=reason)


def _unfinished(
    exercise: Exercise, cases: Sequence[Case], run: Run, sandbox: Sandbox, own: int
) -> Verdict:
    """The verdict on a run that sent no reply: how it ended, and where."""
    limits = sandbox.limits
    words = {
        "time": f"did not finish within {limits.seconds:g} s: a loop without end?",
        "files": f"wrote more than {limits.file_mb} MB, or thousands of files",
        "memory": f"took more than {limits.memory_mb} MB of memory",
        "ended": f"ended the whole program ({run.detail}) instead of returning",
        "crashed": f"crashed Python ({run.detail})",
        "killed": f"was ended from outside ({run.detail})",
        "unreadable": f"sent back what cannot be read ({run.detail})",
    }
    where = "it"
    case = cases[run.index] if run.stage == "case" else None
    if case is None:
        where = OWN_CELL if run.index >= own else EARLIER_CELL
    reason = (f"{where} {words[run.end]}",)
    if run.end in WITHOUT_REPLY:
        twice = "It was run twice, the second time alone: somebody should look at it."
        return Verdict(
            exercise.name, "needs a person", case=case, reason=(*reason, twice)
        )
    if case is None:
        return Verdict(exercise.name, "error", reason=reason)
    return Verdict(exercise.name, "error", 0, len(cases), case, reason=reason)


def _renamed(name: str, found: Found, verdict: Verdict) -> Verdict:
    """A person decides on a renamed answer; it has been tried under the name it has."""
    if verdict.state == "not attempted":
        return verdict
    tried = "right" if verdict.passed else "not right"
    told = f"{found.fault}, and under that name it is {tried}"
    return Verdict(name, "needs a person", reason=(told,))
