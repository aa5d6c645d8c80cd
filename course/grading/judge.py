"""From a submission to its rows: points, state and reason of every exercise.

The judge draws the inputs, runs the reference and compares; the submission's code runs in ``sandbox`` and gives
arrays. Nothing that code prints, patches or exits with is looked at as a verdict.
"""

from __future__ import annotations

import ast
import threading
from collections.abc import Iterator, Sequence
from dataclasses import dataclass, field, replace

from course.exercises.answer import is_blank
from course.exercises.definition import Case, Exercise
from course.exercises.message import verdict_message
from course.exercises.notebook_file import ExerciseCell, NotebookFile, python_only
from course.exercises.verdict import State, Verdict, judge
from course.grading.limits import Limits
from course.grading.needed import needed_cells
from course.grading.sandbox import Job, Run, SandboxFailure, isolation, run_job

REASON_LIMIT = 500
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


@dataclass(frozen=True)
class Judge:
    """How a submission is judged: by which inputs (``seed`` None: those of every notebook's own check), in which
    limits, and until ``cancel`` is set."""

    seed: int | None = None
    limits: Limits = field(default_factory=Limits)
    cancel: threading.Event | None = None

    def rows(self, notebook: NotebookFile) -> Iterator[Row]:
        """The rows of a submission, in the lesson's order, each as it is found out.

        Raises ``SandboxFailure`` where this machine cannot run answers, ``Cancelled`` when stopped.
        """
        endless: dict[str, str] = {}
        for index, exercise in enumerate(notebook.lesson.exercises):
            verdict, seconds = self._verdict(notebook, index, exercise, endless)
            points = None if verdict.state == "needs a person" else verdict.points
            yield Row(
                exercise,
                points,
                verdict.state,
                reason_of(exercise, verdict),
                verdict,
                seconds,
            )

    def _verdict(
        self,
        notebook: NotebookFile,
        index: int,
        exercise: Exercise,
        endless: dict[str, str],
    ) -> tuple[Verdict, float]:
        """``endless`` holds the cells that ended a run before, and what became of it: none is waited for twice."""
        cell = notebook.cells[index]
        source = python_only(cell.source)
        if is_blank(source, exercise.name) or (cell.fault and _is_left_blank(source)):
            return Verdict(exercise.name, "not attempted"), 0.0
        if cell.fault and not cell.nearest:
            state: State = "needs a person" if cell.needs_person else "error"
            return Verdict(exercise.name, state, reason=(cell.fault,)), 0.0
        earlier = _earlier(notebook, index, source)
        told = next((endless[s] for s, _ in earlier if s in endless), "")
        if told:
            return Verdict(exercise.name, "error", reason=(told,)), 0.0
        cases = exercise.draw(self.seed)
        answer = replace(exercise, name=cell.nearest) if cell.nearest else exercise
        job = _job(answer, ((*earlier, (source, False))), cases)
        try:
            run = run_job(job, self.limits, cancel=self.cancel)
        except SandboxFailure:
            isolation(
                self.limits
            )  # raises where this machine is at fault; else it is the submission that is odd
            run = Run("unreadable", detail="its process did not start")
        verdict = _safely(exercise, cases, run, self.limits, len(earlier))
        if run.reply is None and run.stage == "cell":
            culprit = job.cells[run.index][0]
            endless[culprit] = _unfinished(
                exercise, cases, run, self.limits, len(job.cells)
            ).reason[0]
        return (_renamed(cell, verdict) if cell.nearest else verdict), run.seconds


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


def _earlier(
    notebook: NotebookFile, index: int, source: str
) -> tuple[tuple[str, bool], ...]:
    """The cells to run before the answer's own: of the preamble and of exercises before it, those it needs."""
    before = [python_only(s) for s in notebook.preamble]
    tolerant = [True] * len(before)
    for cell in notebook.cells[:index]:
        text = python_only(cell.source)
        if text and text != source and text not in before:
            before.append(text)
            tolerant.append(False)
    return tuple((before[i], tolerant[i]) for i in needed_cells(before, source))


def _job(
    exercise: Exercise, cells: tuple[tuple[str, bool], ...], cases: Sequence[Case]
) -> Job:
    return Job(
        cells, exercise.name, exercise.kind, tuple(a.name for a in exercise.arguments), len(exercise.results),
        tuple(case.arguments for case in cases),
    )  # fmt: skip


def _safely(
    exercise: Exercise, cases: Sequence[Case], run: Run, limits: Limits, own: int
) -> Verdict:
    """The verdict on a run; where judging itself fails over what came back, a person has to look."""
    try:
        with _judging:
            verdict = _judged(exercise, cases, run, limits, own)
            verdict_message(
                exercise, verdict
            )  # what cannot be told cannot be a verdict either
            return verdict
    except Exception as error:
        return Verdict(
            exercise.name,
            "needs a person",
            reason=(f"the judge stopped: {type(error).__name__}: {error}",),
        )


def _judged(
    exercise: Exercise, cases: Sequence[Case], run: Run, limits: Limits, own: int
) -> Verdict:
    name, reply = exercise.name, run.reply
    if reply is None:
        return _unfinished(exercise, cases, run, limits, own)
    notes = dict(reply.notes)
    stopped = tuple(
        f"{'its cell' if i == own else 'a cell before it, which it uses,'} stopped with {text}"
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
    exercise: Exercise, cases: Sequence[Case], run: Run, limits: Limits, own: int
) -> Verdict:
    """The verdict on a run that sent nothing back: what became of it, and where."""
    words = {
        "time": f"did not finish within {limits.seconds:g} s: a loop without end?",
        "files": f"wrote more than {limits.file_mb} MB, or thousands of files",
        "memory": f"took more than {limits.memory_mb} MB of memory",
        "ended": f"ended the whole program ({run.detail}) instead of returning",
        "crashed": f"crashed Python ({run.detail})",
    }
    if run.end == "unreadable":
        told = f"what came back from its process cannot be read ({run.detail}): somebody should look at the code"
        return Verdict(exercise.name, "needs a person", reason=(told,))
    if run.stage == "case":
        reason = (f"it {words[run.end]}",)
        return Verdict(
            exercise.name, "error", 0, len(cases), cases[run.index], reason=reason
        )
    where = (
        "its cell, outside the function,"
        if run.index >= own
        else "a cell before it, which it uses,"
    )
    return Verdict(exercise.name, "error", reason=(f"{where} {words[run.end]}",))


def _renamed(cell: ExerciseCell, verdict: Verdict) -> Verdict:
    """A renamed answer is a person's to decide; it has been tried under the name it has."""
    if verdict.state == "not attempted":
        return verdict
    tried = "right" if verdict.passed else "not right"
    return Verdict(
        cell.name,
        "needs a person",
        reason=(f"{cell.fault}, and under that name it is {tried}",),
    )


def _is_left_blank(source: str) -> bool:
    """Whether a cell without the name it should have is the lesson's blank: nothing but ..., or under another name."""
    try:
        tree = ast.parse(source)
    except (SyntaxError, ValueError, RecursionError, MemoryError):
        return False
    names = {node.name for node in tree.body if isinstance(node, ast.FunctionDef)}
    for node in tree.body:
        if isinstance(node, ast.Assign):
            names |= {
                target.id for target in node.targets if isinstance(target, ast.Name)
            }
        elif (
            isinstance(node, ast.Expr)
            and isinstance(node.value, ast.Constant)
            and node.value.value is Ellipsis
        ):
            return True
    return any(is_blank(source, name) for name in names)
