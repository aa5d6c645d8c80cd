"""From a submission to its rows: points, state and reason of every exercise.

The judge draws the inputs, runs the reference and compares; the submission's code runs in ``course.sandbox`` and gives
arrays. Nothing that code prints, patches or exits with is looked at as a verdict.
"""

from __future__ import annotations

import json
import threading
import time
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass, field, replace
from functools import cached_property
from pathlib import Path
from typing import Any

from course.exercises.definition import Exercise, Lesson, all_lessons
from course.exercises.explanation import verdict_message
from course.exercises.inputs import Inputs, inputs_of
from course.exercises.message import Message
from course.exercises.notebook_file import Outline, digest_of
from course.exercises.question import Question
from course.exercises.repair.explanation import cause_in_a_line, repair_parts
from course.exercises.repair.search import Repair
from course.exercises.verdict import State, Verdict
from course.grading.marking import verdict_on, without_reply
from course.grading.reasons import reason_of
from course.sandbox.findings import Answers, Found
from course.sandbox.repairing import search
from course.sandbox.running import Sandbox
from course.sandbox.session import FORKS, Cancelled, Session

LESSONS = Path(__file__).resolve().parents[2] / "lessons"
#: Beyond its budget a search may be answered by so much [s].
GRACE_SECONDS = 5.0
# The reference's own call redirects what is printed, which is one for all threads.
_judging = threading.Lock()


@dataclass(frozen=True)
class Row:
    """One exercise of one submission: its verdict, and that in words. ``repair`` is a cause that was found after."""

    exercise: Exercise
    verdict: Verdict
    message: Message
    seconds: float = 0.0
    refused: tuple[str, ...] = ()
    repair: Repair | None = None

    @property
    def state(self) -> State:
        """The verdict in a word."""
        return self.verdict.state

    @property
    def points(self) -> int | None:
        """The points; None where a person has to give them."""
        return None if self.state == "needs a person" else self.verdict.points

    @property
    def reason(self) -> str:
        """Why there are no points, in one line."""
        if self.state in ("passed", "not attempted"):
            return ""
        found = [cause_in_a_line(self.repair)] if self.repair else []
        return reason_of(self.message, *found)


def row_of(
    exercise: Exercise,
    verdict: Verdict,
    seconds: float = 0.0,
    refused: tuple[str, ...] = (),
) -> Row:
    """The row of a verdict."""
    message = verdict_message(exercise, verdict)
    return Row(exercise, verdict, message, seconds, refused)


@dataclass(frozen=True)
class Judge:
    """How a submission is judged: by which inputs (``seed`` None: those of every notebook's own check), run in which
    ``sandbox``, of which lessons (default: all there are).

    For ``repair_seconds`` of a submission, once all its marks are decided, a repair is looked for of each wrong answer
    that no planted mistake explains.
    """

    seed: int | None = None
    sandbox: Sandbox = field(default_factory=Sandbox)
    lessons: tuple[Lesson, ...] | None = None
    repair_seconds: float = 0.0

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
            rows = self._marked(session, lesson, content, file)
            if self.repair_seconds > 0 and FORKS:
                marked = list(rows)  # every mark is decided before a cause is sought
                yield from self._with_repairs(session, marked)
            else:
                yield from rows

    def _marked(
        self, session: Session, lesson: Lesson, content: bytes, file: str
    ) -> Iterator[Row]:
        """The rows with their verdicts."""
        pairs = list(zip(lesson.exercises, session.reading.exercises, strict=True))
        asked = [
            self._question(index, exercise, found)
            for index, (exercise, found) in enumerate(pairs)
            if found.state != "blank"
        ]
        heard = self._answers(session, asked, content, file)
        for exercise, found in pairs:
            answers = Answers() if found.state == "blank" else next(heard)
            yield self._row(exercise, found, answers)

    def _answers(
        self, session: Session, asked: Sequence[Question], content: bytes, file: str
    ) -> Iterator[Answers]:
        """What came of the exercises; where a run ended without a reply the notebook is run once more, for it alone."""
        heard = session.answers(asked) if FORKS else self._each(asked, content, file)
        for question, answers in zip(asked, heard, strict=True):
            if not without_reply(answers):
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

    def _row(self, exercise: Exercise, found: Found, answers: Answers) -> Row:
        """The row of an exercise; where judging itself fails over what came back, a person has to look."""
        seconds = sum(run.seconds for run in answers.runs)
        try:
            inputs = self._inputs(exercise)
            with _judging:
                verdict = verdict_on(inputs, found, answers, self.sandbox.limits)
                # What cannot be put in words cannot be a verdict either.
                return row_of(exercise, verdict, seconds, answers.refused)
        except Exception as error:
            words = f"the judge stopped: {type(error).__name__}: {error}"
            verdict = Verdict(exercise.name, "needs a person", reason=(words,))
            return row_of(exercise, verdict, seconds, answers.refused)

    def _with_repairs(self, session: Session, marked: Sequence[Row]) -> Iterator[Row]:
        """The rows, with the cause of a wrong answer where a repair is found; nothing here changes a verdict."""
        end = time.monotonic() + self.repair_seconds
        for index, row in enumerate(marked):
            left = end - time.monotonic()
            repair = None
            if row.verdict.unexplained and left > 0:
                try:
                    repair = self._repair(session, index, row, left)
                except Cancelled:
                    raise
                except Exception:  # the process answers no more, or nonsense
                    end = 0.0
            if repair is not None:
                message = row.message.followed_by(*repair_parts(repair))
                row = replace(row, repair=repair, message=message)
            yield row

    def _repair(
        self, session: Session, index: int, row: Row, seconds: float
    ) -> Repair | None:
        inputs = self._inputs(row.exercise)
        with _judging:
            for other in inputs.others:
                other.expected  # noqa: B018
        opening = {"index": index, "kind": row.exercise.kind, "seconds": seconds}

        def ask(request: Mapping[str, Any]) -> Any:
            return session.ask_for_repair(request, seconds + GRACE_SECONDS)

        return search(ask, opening, inputs, row.verdict.outcomes, seconds)

    def _question(self, index: int, exercise: Exercise, found: Found) -> Question:
        inputs = self._inputs(exercise)
        name = found.nearest or exercise.name
        return replace(inputs.question, name=name, most=inputs.most, index=index)

    def _inputs(self, exercise: Exercise) -> Inputs:
        """The inputs, drawn once, as all submissions get the same."""
        if exercise.name not in self._kept:
            inputs = inputs_of(exercise, self.seed)
            with _judging:
                inputs.expected  # noqa: B018
            self._kept[exercise.name] = inputs
        return self._kept[exercise.name]

    @cached_property
    def _kept(self) -> dict[str, Inputs]:
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
