"""Answers with two random slips, what a check and a repair say of them, and whether that is true.

python tests/exercises/two_slips.py SEED [COUNT]      every message, and what is false in it
"""

import ast
import re
import signal
import sys
from collections.abc import Callable, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Any

if __name__ == "__main__":
    sys.path.insert(0, str(Path(__file__).resolve().parents[1]))

import numpy as np
from exercises.mutants import Mutant, mutants_in, mutants_of

from course import formulas
from course.exercises.answer import Outcome, as_function, call_all
from course.exercises.definition import Case, Exercise, all_lessons
from course.exercises.explanation import verdict_message
from course.exercises.formula_source import own_statements, source_of
from course.exercises.inputs import answers_of, inputs_of
from course.exercises.repair.recipe import Recipe, expression_recipe
from course.exercises.repair.search import Repair
from course.exercises.verdict import Verdict, alike, judge
from course.sandbox.repairing import repair_of
from course.workbook.repairing import repair_message

EXERCISES = [e for lesson in all_lessons() for e in lesson.exercises]
#: Seeds that neither a notebook's check nor the search for a repair has.
FRESH = (71, 72, 73)
SECONDS = (
    3.0  # for the cases of one seed; more is told elsewhere, as an answer that runs on
)
WORDS = {
    "brackets: (a < 0)": (ast.BitAnd, ast.BitOr, ast.Compare),
    "`if`, `and`": (ast.If, ast.IfExp, ast.BoolOp, ast.Not, ast.While, ast.Call),
    "no axes to index": (ast.Subscript,),
    "np.einsum": (ast.Call,),
}


class TooLong(BaseException):
    """The cases of one seed took too long."""


@dataclass(frozen=True)
class Slipped:
    """An answer with two slips: its exercise, both slips, and what the student has in the cell."""

    exercise: Exercise
    slips: tuple[Mutant, Mutant]
    cell: str
    prelude: str


@dataclass(frozen=True)
class Told:
    """What was said of an answer."""

    answer: Slipped
    verdict: Verdict
    recipe: Recipe | None
    repair: Repair | None

    def __str__(self) -> str:
        said = [str(verdict_message(self.answer.exercise, self.verdict))]
        if self.repair:
            said.append(str(repair_message(self.answer.exercise.name, self.repair)))
        slips = "\n".join(f"  - {m.before}\n  + {m.after}" for m in self.answer.slips)
        return "\n".join([f"{slips}\n{self.answer.cell}", *said])


def answers_with_two_slips(seed: int, count: int) -> list[Slipped]:
    """Answers over all exercises in turn; the second slip is drawn from those of the first's text."""
    rng = np.random.default_rng(seed)
    made = []
    for number in range(count):
        exercise = EXERCISES[(number + seed) % len(EXERCISES)]
        while True:
            first = _drawn(rng, mutants_of(exercise.reference))
            seconds = mutants_in(first.source)  # of an empty function there are none
            second = _drawn(rng, seconds) if seconds else first
            if seconds and second.source != ast.unparse(
                _bare(source_of(exercise.reference))
            ):
                break
        made.append(_slipped(exercise, (first, second)))
    return made


def _drawn(rng: np.random.Generator, mutants: Sequence[Mutant]) -> Mutant:
    return mutants[rng.integers(len(mutants))]


def _bare(source: str) -> ast.Module:
    """A function without its docstring."""
    tree = ast.parse(source)
    if ast.get_docstring(tree.body[0]) is not None:
        del tree.body[0].body[0]
    return tree


def _slipped(exercise: Exercise, slips: tuple[Mutant, Mutant]) -> Slipped:
    source = slips[1].source + "\n"
    if exercise.kind == "expression":
        symbols = ", ".join(a.name for a in exercise.arguments)
        made = f'{symbols} = sp.symbols("{symbols.replace(",", "")}")\n'
        lines = own_statements(ast.parse(source).body[0].body)
        value = lines[-1].value if isinstance(lines[-1], ast.Return) else None
        given = ast.unparse(value) if value is not None else "..."
        return Slipped(
            exercise,
            slips,
            f"{made}{exercise.name} = {given}\n",
            "import sympy as sp\n",
        )
    called = {n.id for n in ast.walk(ast.parse(source)) if isinstance(n, ast.Name)}
    others = called & set(formulas.__all__) - {exercise.name}
    lines = [source_of(getattr(formulas, n)) for n in sorted(others)]
    return Slipped(exercise, slips, source, "\n".join(["import numpy as np", *lines]))


def function_of(answer: Slipped, source: str) -> Callable[..., Any]:
    """The function that a cell with this source leaves behind."""
    exercise, space = answer.exercise, {}
    exec(answer.prelude + "\n" + source, space)
    names = [a.name for a in exercise.arguments]
    return as_function(space[exercise.name], exercise.kind, exercise.name, names)


def outcomes_of(
    answer: Slipped, function: Callable[..., Any], cases: Sequence[Case]
) -> list[Outcome]:
    """What a function gives; raises ``TooLong``."""
    came: list[Outcome] = []
    signal.signal(signal.SIGALRM, _over)
    signal.setitimer(signal.ITIMER_REAL, SECONDS, SECONDS)
    try:
        given, count = [c.arguments for c in cases], len(answer.exercise.results)
        came = call_all(function, given, count)
    finally:
        signal.setitimer(signal.ITIMER_REAL, 0)
    if any(o.text.startswith("TooLong") for o in came):
        raise TooLong
    return came


def _over(*_: object) -> None:
    raise TooLong


def told_of(answer: Slipped) -> Told | None:
    """What is said of it; None where it passes, or where no function comes of it."""
    exercise = answer.exercise
    try:
        function = function_of(answer, answer.cell)
    except Exception:  # the cell stops: the notebook says so
        return None
    try:
        cases = exercise.draw()
        verdict = judge(exercise, cases, outcomes_of(answer, function, cases))
    except TooLong:
        return None
    if verdict.passed or verdict.state == "not attempted":
        return None
    recipe: Recipe | None = Recipe(answer.cell, answer.prelude)
    if exercise.kind == "expression":
        names = [a.name for a in exercise.arguments]
        recipe = expression_recipe(answer.cell, exercise.name, names)
    repair = None
    if recipe and verdict.unexplained:
        repair = repair_of(inputs_of(exercise), recipe, verdict.outcomes)
    return Told(answer, verdict, recipe, repair)


def falsehoods(told: Told) -> list[str]:
    """What of it is not so, on cases of seeds that nobody had."""
    answer, exercise = told.answer, told.answer.exercise
    function = function_of(answer, answer.cell)
    cases = [c for seed in FRESH for c in exercise.draw(seed)]
    try:
        outcomes = outcomes_of(answer, function, cases)
    except TooLong:
        return []
    return [
        *_of_the_mistake(told.verdict, exercise, cases, outcomes),
        *_of_the_repair(told),
        *_of_the_facts(told.verdict, answer, cases, outcomes),
    ]


def _of_the_mistake(verdict, exercise, cases, outcomes) -> list[str]:
    if verdict.mistake is None:
        return []
    theirs = answers_of(verdict.mistake.function, exercise, cases)
    same = alike(exercise, outcomes, theirs)
    return [] if same else [f"planted {verdict.mistake.name!r}: not with other seeds"]


def _of_the_repair(told: Told) -> list[str]:
    """The first step's line must be in the answer, and the answer with all of them made right; of two neither alone."""
    if told.repair is None:
        return []
    repair, false = told.repair, []
    lines = "\n".join(step.line for step in repair.steps).splitlines()
    there = [s.strip() for s in told.recipe.source.splitlines()]
    false += [f"no such line: {line}" for line in lines if line not in there]
    for step in repair.steps:
        if step.kind == "brackets" and _operands(step.old) != _operands(step.new):
            false.append(f"no brackets alone: {step.old} -> {step.new}")
    if not _right(told, repair.changed):
        false.append("the changed answer is not right")
    return false


def _operands(text: str) -> str:
    """A text without its brackets."""
    return re.sub(r"[()\s]", "", text)


def _right(told: Told, source: str) -> bool:
    """Whether a changed answer passes with seeds that the search did not have."""
    exercise, space = told.answer.exercise, {}
    exec(told.recipe.prelude + "\n" + source, space)
    function = space[exercise.name]
    if told.recipe.elementwise:
        number = function

        def function(*points):
            shape = np.broadcast_shapes(*map(np.shape, points))
            return np.broadcast_to(number(*points), shape).astype(float)

    for seed in FRESH:
        cases = exercise.draw(seed)
        outcomes = outcomes_of(told.answer, function, cases)
        if not judge(exercise, cases, outcomes).passed:
            return False
    return True


def _of_the_facts(verdict, answer, cases, outcomes) -> list[str]:
    false, reason = [], " ".join((*verdict.reason, *verdict.violated))
    judged = [
        judge(answer.exercise, [c], [o]) for c, o in zip(cases, outcomes, strict=True)
    ]
    failed = {c.kind for c, v in zip(cases, judged, strict=True) if not v.passed}
    if "Right for one, wrong for many" in reason and failed - {"batch"}:
        false.append(f"not right for one: {failed}")
    if "Right in the ordinary cases" in reason and failed - {"edge"}:
        false.append(f"not right in the ordinary cases: {failed}")
    if "the same in every case" in reason:
        values = [o.values[0] for o in outcomes if o.kind == "value"]
        if any((v != values[0].flat[0]).any() for v in values):
            false.append("not the same in every case")
    if "a batch has many answers" in reason and answer.exercise.kind == "function":
        single = [
            o.text for c, o in zip(cases, outcomes, strict=True) if c.kind != "batch"
        ]
        if any("truth value" in text for text in single):
            false.append("it is no batch that stops it")
    nodes = {type(n) for n in ast.walk(ast.parse(answer.cell))}
    for words, kinds in WORDS.items():
        if words in reason and not nodes & set(kinds):
            false.append(f"nothing of the kind in it: {words}")
    return false


def main(seed: int, count: int = 150) -> None:
    """Print every message and what is false in it."""
    said = false = 0
    for answer in answers_with_two_slips(seed, count):
        told = told_of(answer)
        if told is None:
            continue
        said += 1
        wrong = falsehoods(told)
        false += bool(wrong)
        print(f"{'-' * 100}\n{told}", *(f"FALSE: {w}" for w in wrong), sep="\n")
    print(
        f"seed {seed}: {said} answers of {count} judged, {false} told something false"
    )


if __name__ == "__main__":
    main(*map(int, sys.argv[1:]))
