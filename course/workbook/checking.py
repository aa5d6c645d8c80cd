"""``check``: a student's answer, judged at once."""

from __future__ import annotations

import inspect
from functools import cache, partial
from pathlib import Path
from typing import Any

from course.exercises.definition import Exercise, Lesson, find_exercise
from course.exercises.explanation import verdict_message
from course.exercises.inputs import inputs_of
from course.exercises.message import Message, Part
from course.workbook import recording
from course.workbook.buttons import Action, show_buttons
from course.workbook.facts import borrowed_variables, facts_told
from course.workbook.hints import hint
from course.workbook.judging import judge_on
from course.workbook.lending import name_of, refuse_lent
from course.workbook.notebook import (
    display_message,
    display_value,
    in_notebook,
    in_our_lab,
)
from course.workbook.overview import minutes_left
from course.workbook.repairing import look_for_repair
from course.workbook.surroundings import unfinished_before, with_surroundings
from course.workbook.watching import WATCHED, watch
from course.workbook.work_folder import READ_ONLY


def check(answer: Any, name: str | None = None) -> None:
    """Judge a function you wrote (or a SymPy expression) and show the verdict.

    An expression needs the exercise's ``name``. Raises ``ValueError`` when no exercise
    has this name, and for functions that are not your own.
    """
    name = name_of(answer, name)
    lesson, exercise = find_exercise(name)
    refuse_lent(answer)
    inputs = inputs_of(exercise)
    verdict = judge_on(inputs, answer)
    borrowed: tuple[str, ...] = ()
    if verdict.failed:
        borrowed = borrowed_variables(answer)
        unfinished = unfinished_before(lesson, exercise, answer)
        facts = facts_told(exercise, answer, verdict)
        verdict = with_surroundings(verdict, unfinished, borrowed, facts)
    passed_before = recording.state().passed
    recording.record("check", name, state=verdict.state)
    if verdict.passed:
        passed = recording.state().passed
        after = Part("next", whats_next(lesson, exercise, passed_before, passed))
    else:
        after = Part("stuck?", f"hint({name!r}) gives {_next_help(name)}")
    moving = [Part("see it", f"watch({name}) plays it beside the right one")]
    message = verdict_message(exercise, verdict)
    seen = moving if name in WATCHED and verdict.state in ("passed", "wrong") else []
    display_message(message.followed_by(*seen, after))
    repair = None
    if in_notebook() and not borrowed:
        repair = look_for_repair(inputs, answer, verdict)
        if repair is not None:
            display_message(repair)
    if verdict.unexplained and not borrowed and repair is None:
        recording.record_unrecognised(name, _source(answer), str(message))
    say_that_nothing_is_kept()
    show_buttons(_actions(name, answer, passed=verdict.passed, moves=bool(seen)))


def _actions(name: str, answer: Any, *, passed: bool, moves: bool) -> list[Action]:
    """What the buttons below a verdict do."""
    actions: list[Action] = []
    if not passed:
        actions.append(("hint", f"the next hint for {name}", partial(hint, name)))
    if moves:
        beside = f"{name} beside the right one"
        actions.append(("see it move", beside, lambda: display_value(watch(answer))))
    return actions


@cache  # once a session
def say_that_nothing_is_kept() -> None:
    """In a notebook that is handed out, opened where it lies: say that it keeps nothing."""
    folder = Path.cwd()
    if folder.name not in READ_ONLY or not in_our_lab():
        return
    what = f"This notebook lies in {folder.name}/: nothing of it is saved or recorded"
    part = Part("instead", "open the one of the same name in work/ and write there")
    display_message(Message("not attempted", what, (part,)))


def _next_help(name: str) -> str:
    taken = recording.state().hints.get(name, 0)
    if taken >= 3:
        return "the reference"
    return "the next hint" if taken else "the first of three hints"


def whats_next(
    lesson: Lesson, exercise: Exercise, before: frozenset[str], passed: frozenset[str]
) -> str:
    """What to do after an exercise has passed; ``before`` are those that had passed before this check.

    That the last one that counts was done is news once: neither at a second check of it, nor at another's.
    """
    following = recording.next_exercise(lesson, exercise.name, passed)
    if following is not None:
        left = minutes_left(lesson, passed)
        return (
            f"{following.name}; about {left} minutes of exercises left in this lesson"
        )
    what, where = (
        ("exercise", "notebook") if lesson.deeper else ("core exercise", "lesson")
    )
    if exercise in lesson.counted and exercise.name not in before:
        return f"that was the last {what} of this {where}"
    return f"all {what}s of this {where} have passed"


def _source(answer: Any) -> str:
    try:
        return inspect.getsource(answer)
    except (OSError, TypeError):
        return str(answer)[:2000]
