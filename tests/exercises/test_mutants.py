"""What is wrong must fail: no one-step mutant of a formula passes unless it is the formula in other words.

The mutants that no case tells apart stand in ``surviving_mutants.txt``, each with the
reason why it is right. A new one, and a listed one that is gone, fail.
"""

from collections.abc import Iterator
from pathlib import Path

import numpy as np
import pytest
from exercises.mutant_runs import passing
from exercises.mutants import mutants_of

from course import formulas
from course.exercises.definition import Exercise, all_lessons, find_exercise

#: Seconds together: left out of the minute's run.
pytestmark = pytest.mark.slow

LISTED = Path(__file__).with_name("surviving_mutants.txt")
EXERCISES = [e for lesson in all_lessons() for e in lesson.exercises]
SAMPLE = 5  # mutants of each formula in the everyday run
Key = tuple[str, str]


def listed() -> dict[str, dict[Key, str]]:
    """formula -> (before, after) -> reason, as the file has them."""
    found: dict[str, dict[Key, str]] = {}
    waiting: list[Key] = []
    for line in LISTED.read_text(encoding="utf-8").splitlines():
        mark, text = line[:2], line[2:]
        if mark == "= ":
            formula = found.setdefault(text, {})
        elif mark == "- ":
            before = text
        elif mark == "+ ":
            waiting.append((before, text))
        elif mark == "  " and text.strip():
            formula.update(dict.fromkeys(waiting, text.strip()))
            waiting = []
    assert not waiting, f"no reason for {waiting}"
    return found


SURVIVORS = listed()


def told(keys: Iterator[Key] | set[Key]) -> str:
    return "\n".join(f"- {before}\n+ {after}" for before, after in sorted(keys))


@pytest.mark.long
@pytest.mark.parametrize("exercise", EXERCISES, ids=lambda e: e.name)
def test_only_the_listed_mutants_pass(exercise: Exercise):
    mutants = mutants_of(exercise.reference)
    passed = passing(exercise, mutants)
    lucky = {key for key, seeds in passed.items() if "0" in seeds}
    assert not lucky, f"told apart by luck, with some seeds only:\n{told(lucky)}"
    expected = set(SURVIVORS.get(exercise.name, {}))
    new, gone = set(passed) - expected, expected - set(passed)
    assert not new, f"no case tells apart:\n{told(new)}"
    assert not gone, f"listed, but told apart or no mutant any more:\n{told(gone)}"


@pytest.mark.slow
@pytest.mark.parametrize(
    "part", [0, *(pytest.param(k, marks=pytest.mark.long) for k in (1, 2))]
)
def test_a_sample_of_the_mutants_fails(part):
    rng = np.random.default_rng(part)
    for exercise in EXERCISES[part::3]:
        mutants = mutants_of(exercise.reference)
        known = SURVIVORS.get(exercise.name, {})
        unknown = [m for m in mutants if m.key not in known]
        drawn = rng.choice(len(unknown), min(SAMPLE, len(unknown)), replace=False)
        passed = passing(exercise, [unknown[i] for i in drawn], seeds=(None,))
        assert not passed, f"{exercise.name}:\n{told(set(passed))}"


@pytest.mark.long
def test_every_listed_mutant_is_one_and_has_a_reason():
    assert set(SURVIVORS) <= {e.name for e in EXERCISES}
    for name, known in SURVIVORS.items():
        made = {m.key for m in mutants_of(find_exercise(name)[1].reference)}
        assert set(known) <= made, f"{name}:\n{told(set(known) - made)}"
        assert all(len(reason) > 10 for reason in known.values())


# The tests above must be able to fail.


def test_mutants_are_the_slips_one_expects():
    changed = {m.after for m in mutants_of(formulas.wall_bounce)}
    wanted = {
        "return np.where(along <= 0, after, velocity)",
        "return np.where(along > 0, after, velocity)",
        "return np.where(along < 0, velocity, after)",
        "return after",
        "along = np.sum(velocity * normal, axis=0)[..., None]",
        "along = np.sum(velocity * normal, axis=-1)",
        "along = np.sum(velocity / normal, axis=-1)[..., None]",
        "along = np.sum(velocity, axis=-1)[..., None]",
    }
    assert wanted <= changed
    swept = {m.after for m in mutants_of(formulas.projected_gauss_seidel)}
    assert {
        "for i in range(len(b) - 1):",
        "for _ in range(sweeps): ... return f",
        "for _ in range(sweeps): ... break",
        "f[i] = f[i] - w / a[i, i]",
        "f[i] = min(0.0, f[i] - w / a[i, i])",
        "w = a[i] @ f - b[i]",
    } <= swept


@pytest.mark.long
def test_keys_are_unique_and_each_mutant_is_python():
    for exercise in EXERCISES:
        mutants = mutants_of(exercise.reference)
        # One division of two arguments, alone, has eight.
        least = 7 if exercise.name == "tightness" else 10
        assert len({m.key for m in mutants}) == len(mutants) > least
        for mutant in mutants:
            compile(mutant.source, "<mutant>", "exec")


def test_a_mutant_that_passes_is_found_and_a_bad_one_costs_no_other():
    _, exercise = find_exercise("rk4_step")
    mutants = mutants_of(exercise.reference)[:6]
    bodies = [
        "while True: pass",
        "return np.ones((10**6, 10**6))",
        "import os; os._exit(3)",
        "raise SystemExit",
        "return l",
        None,
    ]
    head = "def rk4_step(l, I_body, h):\n    "
    right = mutants_of(exercise.reference)
    survivor = next(m for m in right if m.key in SURVIVORS["rk4_step"])
    tried = [
        survivor if body is None else type(m)(m.before, m.after, head + body)
        for m, body in zip(mutants, bodies, strict=True)
    ]
    assert passing(exercise, tried, seeds=(None, 1)) == {survivor.key: "11"}


def test_what_the_process_cannot_end_itself_is_ended_from_outside():
    _, exercise = find_exercise("speed_along")
    head = "def speed_along(velocity, normal):\n    "
    asleep, right = mutants_of(exercise.reference)[:2]
    asleep = type(asleep)(
        asleep.before, asleep.after, head + "import time; time.sleep(60)"
    )
    right = type(right)(
        right.before, right.after, head + "return np.sum(velocity * normal, axis=-1)"
    )
    tried = passing(exercise, [asleep, right], seeds=(None,), patience=4.0)
    assert tried == {right.key: "1"}
