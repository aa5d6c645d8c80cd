"""Nothing false is said of answers with two random slips, whatever the exercise."""

import dataclasses
import sys

import pytest
from campaigns import drawn_of
from exercises.mutants import Mutant
from exercises.two_slips import (
    EXERCISES,
    Slipped,
    Told,
    answers_with_two_slips,
    falsehoods,
    told_of,
)

from course.exercises.repair.recipe import Recipe
from course.exercises.repair.search import Repair, Step
from course.exercises.verdict import Verdict

pytestmark = pytest.mark.skipif(
    sys.platform == "win32", reason="a timer ends answers that run on"
)


@pytest.mark.long
@pytest.mark.parametrize("seed", range(1, 1 + drawn_of(3, 1)))
def test_of_fifty_answers_nothing_false_is_said(seed):
    """Each is searched for as long as a student's."""
    told = [t for t in map(told_of, answers_with_two_slips(seed, 50)) if t]
    assert len(told) > 40  # few of them are right, or stop the cell
    false = {str(t): f for t in told if (f := falsehoods(t))}
    assert not false, "\n".join(f"{said}\n  {why}" for said, why in false.items())
    named = [t for t in told if t.verdict.mistake or t.repair]
    # What is never said is never false. The search ends by the clock: 12 to 17 of 50 are
    # named, as busy as the machine is; hardly any would be, were the search broken.
    assert len(named) > 7


def test_what_is_false_is_found():
    """A repair that makes nothing right, a planted mistake that agrees by chance, a batch that is none."""
    exercise = next(e for e in EXERCISES if e.name == "speed_along")
    cell = "def speed_along(velocity, normal):\n    return 2 * np.sum(velocity * normal, axis=-1)\n"
    nothing = Mutant("", "", cell)
    answer = Slipped(exercise, (nothing, nothing), cell, "import numpy as np")
    verdict = Verdict("speed_along", "wrong")
    repair = Repair((Step("a sign", "return -1", "1", "-1", cell),))
    told = Told(answer, verdict, Recipe(cell, "import numpy as np"), repair)
    assert len(falsehoods(told)) == 2  # no such line, and not right
    changed = dataclasses.replace(verdict, mistake=exercise.mistakes[0])
    told = dataclasses.replace(told, repair=None, verdict=changed)
    assert len(falsehoods(told)) == 1
    for words in ("Right for one, wrong for many", "the same in every case"):
        reason = dataclasses.replace(verdict, reason=(words,))
        assert falsehoods(dataclasses.replace(told, verdict=reason))
    quiet = dataclasses.replace(told, verdict=verdict)
    assert falsehoods(quiet) == []
