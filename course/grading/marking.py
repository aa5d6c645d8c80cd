"""One verdict of all that a notebook gave for an exercise, and of how its runs ended."""

from __future__ import annotations

from dataclasses import replace

from course.exercises.answer import Answer
from course.exercises.definition import Case, Exercise
from course.exercises.inputs import Inputs
from course.exercises.verdict import State, Verdict, judge_answer
from course.sandbox.ending import WITHOUT_REPLY
from course.sandbox.findings import Answers, Found, Run
from course.sandbox.limits import Limits


def verdict_on(
    inputs: Inputs, found: Found, answers: Answers, limits: Limits
) -> Verdict:
    """The verdict on an exercise: of what reading ``found``, and of what came of running it."""
    if found.state == "blank":
        return judge_answer(inputs, Answer(blank=True))
    verdict = _verdict_on_runs(inputs, found, answers, limits)
    verdict = _unless_unlike(verdict, answers)
    return _renamed(found, verdict) if found.nearest else verdict


def without_reply(answers: Answers) -> bool:
    """Whether the last run, or the exercise's own cell, ended so that nothing is known of the answer."""
    ends = [run.end for run in answers.runs[-1:]]
    ends += [answers.own[0]] if answers.own else []
    return any(end in WITHOUT_REPLY for end in ends)


def _verdict_on_runs(
    inputs: Inputs, found: Found, answers: Answers, limits: Limits
) -> Verdict:
    """Where two answers disagree, a person decides."""
    exercise = inputs.exercise
    every = [_of_run(inputs, run, answers, limits) for run in answers.runs]
    given = [v for v in every if v is not None and v.state != "not attempted"]
    if answers.own and not any(run.reply and run.reply.checked for run in answers.runs):
        end, detail = answers.own
        return _ended(exercise, "its cell, outside the function,", end, detail, limits)
    if not given:
        blank = next((v for v in every if v is not None), None)
        return blank or _nothing(exercise, found, answers)
    right = sum(v.passed for v in given)
    if 0 < right < len(given):
        words = f"it is checked {len(given)} times, and right {right} times: which one counts?"
        return Verdict(exercise.name, "needs a person", reason=(words,))
    return given[-1]


def _unless_unlike(verdict: Verdict, answers: Answers) -> Verdict:
    """The verdict, but a person's where the answer is not right and leans on what only its author's kernel had."""
    unlike = [run.reply.unlike for run in answers.runs if run.reply is not None]
    what = next(filter(None, unlike), "")
    if not what or not verdict.failed:
        return verdict
    words = f"it may lean on what was not here while it was marked ({what}): somebody should run it"
    reason = (words, *verdict.reason)
    return Verdict(verdict.exercise, "needs a person", reason=reason)


def _of_run(
    inputs: Inputs, run: Run, answers: Answers, limits: Limits
) -> Verdict | None:
    """The verdict on one run; None where there was no such name."""
    reply, cases = run.reply, inputs.cases
    if reply is None:
        case = cases[run.case] if run.case >= 0 else None
        return _ended(
            inputs.exercise, "it", run.end, run.detail, limits, case, len(cases)
        )
    if reply.missing:
        return None
    verdict = judge_answer(inputs, reply.answer)
    if not verdict.failed:
        return verdict
    return replace(verdict, reason=(*verdict.reason, *_raised(answers)))


def _nothing(exercise: Exercise, found: Found, answers: Answers) -> Verdict:
    """The verdict where the notebook has no such name."""
    raised = _raised(answers)
    if found.fault:
        state: State = "needs a person" if found.needs_person else "error"
        return Verdict(exercise.name, state, reason=(found.fault, *raised))
    if any(own for own, _ in answers.notes):
        return Verdict(exercise.name, "error", reason=raised)
    words = f"its cell ran, but there is no {exercise.name} after it"
    return Verdict(exercise.name, "needs a person", reason=(words, *raised))


def _raised(answers: Answers) -> tuple[str, ...]:
    """What cells raised or did not finish, the exercise's own first."""
    notes = sorted(answers.notes, key=lambda note: not note[0])
    words = [
        f"{'its cell' if own else 'another cell'} stopped with {text}"
        for own, text in notes
    ]
    if answers.others:
        words.append("another cell did not come to its end")
    return tuple(words)


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


def _renamed(found: Found, verdict: Verdict) -> Verdict:
    """A renamed answer is a person's to decide; it has been tried under the name it has."""
    if verdict.state == "not attempted":
        return verdict
    tried = "right" if verdict.passed else "not right"
    words = f"{found.fault}, and under that name it is {tried}"
    return Verdict(verdict.exercise, "needs a person", reason=(words,))
