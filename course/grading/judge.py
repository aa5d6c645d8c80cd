"""From a submission to its rows: points, state and reason of every exercise.

The judge draws the inputs, runs the reference and compares; the submission's code runs in ``course.sandbox`` and gives
arrays. Nothing that code prints, patches or exits with is looked at as a verdict.
"""

from __future__ import annotations

import json
import threading
from collections.abc import Iterator, Sequence
from dataclasses import dataclass, field, replace
from functools import cached_property
from pathlib import Path

from course.exercises.definition import Case, Exercise, Lesson, all_lessons
from course.exercises.message import verdict_message
from course.exercises.notebook_file import Outline, digest_of
from course.exercises.verdict import State, Verdict, answers_of, judge
from course.sandbox.ending import WITHOUT_REPLY
from course.sandbox.limits import Limits
from course.sandbox.running import (
    FORKS,
    Answers,
    Found,
    Question,
    Run,
    Sandbox,
    Session,
)

REASON_LIMIT = 500
LESSONS = Path(__file__).resolve().parents[2] / "lessons"
#: An answer may give so many numbers where few are expected: a wrong shape is told as that.
FEW = 10_000
# The reference's own call redirects what is printed, which is one for all threads.
_judging = threading.Lock()


@dataclass(frozen=True)
class Row:
    """One exercise of one submission. ``points`` is None where a person has to give them."""

    exercise: Exercise
    points: int | None
    state: State
    reason: str
    verdict: Verdict
    seconds: float = 0.0
    refused: tuple[str, ...] = ()


@dataclass(frozen=True)
class Judge:
    """How a submission is judged: by which inputs (``seed`` None: those of every notebook's own check), run in which
    ``sandbox``, of which lessons (default: all there are)."""

    seed: int | None = None
    sandbox: Sandbox = field(default_factory=Sandbox)
    lessons: tuple[Lesson, ...] | None = None

    def rows(self, content: bytes, file: str) -> tuple[Lesson, Iterator[Row]]:
        """The lesson of a submission, and its rows in the lesson's order, each as it is found out.

        Raises ``UnusableNotebook``, ``SandboxFailure`` where this machine cannot run it, ``Cancelled`` when stopped.
        """
        rows = self._rows(content, file)
        lesson = next(rows)
        assert isinstance(lesson, Lesson)
        return lesson, rows  # type: ignore[return-value]

    def _rows(self, content: bytes, file: str) -> Iterator[Lesson | Row]:
        with self.sandbox.submission(content, file, self._outlines) as session:
            lesson = self._by_number[session.reading.lesson]
            yield lesson
            found = dict(zip(lesson.exercises, session.reading.exercises, strict=True))
            asked = [
                self._question(i, exercise, found[exercise])
                for i, exercise in enumerate(lesson.exercises)
                if found[exercise].state != "blank"
            ]
            heard = self._answers(session, asked, content, file)
            for exercise in lesson.exercises:
                blank = found[exercise].state == "blank"
                answers = None if blank else next(heard)
                yield self._row(exercise, found[exercise], answers)

    def _answers(
        self, session: Session, asked: Sequence[Question], content: bytes, file: str
    ) -> Iterator[Answers]:
        """What came of the exercises; where a run ended without a reply the notebook is run once more, for it alone."""
        heard = session.answers(asked) if FORKS else self._each(asked, content, file)
        for question, answers in zip(asked, heard, strict=True):
            if not _without_reply(answers):
                yield answers
                continue
            (again,) = self._each([question], content, file)
            refused = dict.fromkeys((*answers.refused, *again.refused))
            yield replace(again, refused=tuple(refused))

    def _each(
        self, asked: Sequence[Question], content: bytes, file: str
    ) -> Iterator[Answers]:
        """The exercises asked for, each in a process of its own."""
        for question in asked:
            with self.sandbox.submission(content, file, self._outlines) as alone:
                yield from alone.answers([question])

    def _row(self, exercise: Exercise, found: Found, answers: Answers | None) -> Row:
        if answers is None:
            verdict = Verdict(exercise.name, "not attempted")
            return Row(exercise, 0, verdict.state, "", verdict)
        named = replace(exercise, name=found.nearest) if found.nearest else exercise
        cases = self._drawn(exercise)[0]
        verdict = _safely(named, cases, found, answers, self.sandbox.limits)
        if found.nearest:
            verdict = _renamed(exercise.name, found, verdict)
        points = None if verdict.state == "needs a person" else verdict.points
        reason = reason_of(exercise, verdict)
        seconds = sum(run.seconds for run in answers.runs)
        return Row(
            exercise, points, verdict.state, reason, verdict, seconds, answers.refused
        )

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
        """The inputs, and how many numbers an answer may give for each: drawn once, as all submissions get the same."""
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
            Outline(number, tuple(e.name for e in lesson.exercises), handed_out(lesson))
            for number, lesson in self._by_number.items()
        )


def handed_out(lesson: Lesson) -> frozenset[str]:
    """Digests of a lesson's own cells as it is handed out; none where lessons/ is not there."""
    path = LESSONS / lesson.file_name
    if not path.exists():
        return frozenset()
    cells = json.loads(path.read_text(encoding="utf-8"))["cells"]
    own = [c for c in cells if c["metadata"].get("course", {}).get("role") == "lesson"]
    return frozenset(digest_of("".join(cell["source"])) for cell in own)


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


def _without_reply(answers: Answers) -> bool:
    ends = [run.end for run in answers.runs[-1:]]
    ends += [answers.own[0]] if answers.own else []
    return any(end in WITHOUT_REPLY for end in ends)


def _safely(
    exercise: Exercise,
    cases: Sequence[Case],
    found: Found,
    answers: Answers,
    limits: Limits,
) -> Verdict:
    """The verdict on an exercise; where judging itself fails over what came back, a person has to look."""
    try:
        with _judging:
            verdict = _judged(exercise, cases, found, answers, limits)
            verdict = _unless_unlike(verdict, answers)
            # What cannot be told cannot be a verdict either.
            verdict_message(exercise, verdict)
            return verdict
    except Exception as error:
        told = f"the judge stopped: {type(error).__name__}: {error}"
        return Verdict(exercise.name, "needs a person", reason=(told,))


def _judged(
    exercise: Exercise,
    cases: Sequence[Case],
    found: Found,
    answers: Answers,
    limits: Limits,
) -> Verdict:
    """One verdict of all that the notebook gave: where two answers disagree, a person decides."""
    every = [_of_run(exercise, cases, run, answers, limits) for run in answers.runs]
    given = [v for v in every if v is not None and v.state != "not attempted"]
    if answers.own and not any(_checked(run) for run in answers.runs):
        end, detail = answers.own
        return _ended(exercise, "its cell, outside the function,", end, detail, limits)
    if not given:
        return _nothing(
            exercise, found, answers, blank=any(v is not None for v in every)
        )
    right = sum(v.passed for v in given)
    if 0 < right < len(given):
        told = f"it is checked {len(given)} times, and right {right} times: which one counts?"
        return Verdict(exercise.name, "needs a person", reason=(told,))
    return given[-1]


def _unless_unlike(verdict: Verdict, answers: Answers) -> Verdict:
    """The verdict, but a person's where the answer is not right and leans on what only its author's kernel had."""
    told = [run.reply.unlike for run in answers.runs if run.reply is not None]
    what = next(filter(None, told), "")
    if not what or verdict.state not in ("wrong", "error"):
        return verdict
    words = f"it may lean on what was not here while it was marked ({what}): somebody should run it"
    reason = (words, *verdict.reason)
    return Verdict(verdict.exercise, "needs a person", reason=reason)


def _checked(run: Run) -> bool:
    return run.reply is not None and run.reply.checked


def _of_run(
    exercise: Exercise,
    cases: Sequence[Case],
    run: Run,
    answers: Answers,
    limits: Limits,
) -> Verdict | None:
    """The verdict on one run; None where there was no such name."""
    reply = run.reply
    if reply is None:
        case = cases[run.case] if run.case >= 0 else None
        return _ended(exercise, "it", run.end, run.detail, limits, case, len(cases))
    if reply.missing:
        return None
    if reply.blank:
        return Verdict(exercise.name, "not attempted")
    raised = _raised(answers)
    if reply.fault:
        return Verdict(exercise.name, "error", reason=(reply.fault, *raised))
    verdict = judge(exercise, cases, reply.outcomes)
    reason = verdict.reason + (() if verdict.passed else raised)
    if verdict.outcome is not None and "StandInForCourse" in verdict.outcome.text:
        reason += (
            "It calls the course itself, which is not there while an answer is marked.",
        )
    return replace(verdict, reason=reason)


def _nothing(
    exercise: Exercise, found: Found, answers: Answers, *, blank: bool
) -> Verdict:
    """The verdict where the notebook has no such name, or leaves it blank."""
    if blank:
        return Verdict(exercise.name, "not attempted")
    raised = _raised(answers)
    if found.fault:
        state: State = "needs a person" if found.needs_person else "error"
        return Verdict(exercise.name, state, reason=(found.fault, *raised))
    if any(own for own, _ in answers.notes):
        return Verdict(exercise.name, "error", reason=raised)
    told = f"its cell ran, but there is no {exercise.name} after it"
    return Verdict(exercise.name, "needs a person", reason=(told, *raised))


def _raised(answers: Answers) -> tuple[str, ...]:
    """What cells raised or did not finish, the exercise's own first."""
    notes = sorted(answers.notes, key=lambda note: not note[0])
    told = [
        f"{'its cell' if own else 'another cell'} stopped with {text}"
        for own, text in notes
    ]
    if answers.others:
        told.append("another cell did not come to its end")
    return tuple(told)


def _ended(
    exercise: Exercise, what: str, end: str, detail: str, limits: Limits,
    case: Case | None = None, tried: int = 0,
) -> Verdict:  # fmt: skip
    """The verdict where nothing was sent back: what became of it, and where."""
    words = {
        "time": f"did not finish within {limits.seconds:g} s: a loop without end?",
        "files": f"wrote more than {limits.file_mb} MB, or thousands of files",
        "memory": f"took more than {limits.memory_mb} MB of memory",
        "threads": "started thousands of threads",
        "ended": f"ended the whole program ({detail}) instead of returning",
        "crashed": f"crashed Python ({detail})",
        "killed": f"was ended from outside ({detail})",
        "unreadable": f"sent back what cannot be read ({detail})",
    }
    reason = (f"{what} {words[end]}",)
    if end in WITHOUT_REPLY:
        twice = "It was run twice, the second time alone: somebody should look at it."
        return Verdict(
            exercise.name, "needs a person", case=case, reason=(*reason, twice)
        )
    return Verdict(exercise.name, "error", 0, tried, case, reason=reason)


def _renamed(name: str, found: Found, verdict: Verdict) -> Verdict:
    """A renamed answer is a person's to decide; it has been tried under the name it has."""
    if verdict.state == "not attempted":
        return verdict
    tried = "right" if verdict.passed else "not right"
    told = f"{found.fault}, and under that name it is {tried}"
    return Verdict(name, "needs a person", reason=(told,))
