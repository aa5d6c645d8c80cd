"""Lesson 16: Baraff's method, contact by contact."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from course import formulas
from course.exercises.definition import Case, Exercise, Mistake, Value
from course.exercises.definitions.lesson_12_impulse_and_spin.shared import CYCLING
from course.exercises.definitions.lesson_16_contact_forces.shared import (
    LEVER,
    PAIR,
    ROW,
    WEDGE,
    A,
    B,
    drawn_system,
    pulled_open,
)
from course.exercises.slips import slip

#: A and b on whose way contacts leave and join, several at one k, and those not yet
#: dealt with would stop who asked them too. Found by drawing small whole numbers.
FIVE = np.array([[3.1, -0.3, 2.0, 0.8, -0.4], [-0.3, 3.7, 0.8, -0.4, 0.0], [2.0, 0.8, 2.5, 0.5, -0.1],
                 [0.8, -0.4, 0.5, 1.6, -0.2], [-0.4, 0.0, -0.1, -0.2, 1.7]]), (-2, 0, -3, -9, -2)  # fmt: skip
SIX = np.array([[3.4, 2.0, -0.1, 0.4, 1.5, 0.3], [2.0, 2.9, 0.7, 0.4, 2.0, -0.4], [-0.1, 0.7, 2.1, 0.5, 0.1, -0.5],
                [0.4, 0.4, 0.5, 2.3, -0.7, 0.3], [1.5, 2.0, 0.1, -0.7, 2.1, -0.4],
                [0.3, -0.4, -0.5, 0.3, -0.4, 2.9]]), (-3, -3, -2, -7, -4, -5)  # fmt: skip
#: The second force brings its own w and the first force to 0 in the same step, of 2 N.
TIED = np.array([[1, 0.5, -0.2], [0.5, 1, 0.25], [-0.2, 0.25, 1]]), (-1, -2, -3)


def _scaled(
    rng: np.random.Generator, a: np.ndarray, b: Sequence[float]
) -> dict[str, np.ndarray]:
    """The same way in other units, drawn for each contact: D A D and D b.

    Powers of 2, so that what coincides still does.
    """
    d = rng.choice([0.25, 0.5, 1.0, 2.0, 4.0], len(b))
    return {"a": a * d[:, None] * d, "b": b * d}


def _nearly_tied(rng: np.random.Generator) -> dict[str, np.ndarray]:
    """The first force reaches 0 a rounding error before w of the second: b_2 = b_1 a_22/a_12 but for that.

    So it leaves first whatever the order in which the stops are compared, and the second force has to be
    listed, or the third lifts its contact.
    """
    a_12 = rng.choice([0.25, 0.5])
    a_13, a_23, a_22 = rng.uniform([-0.3, 0.2, 1.0], [-0.1, 0.4, 1.5]).round(2)
    a = np.array([[1, a_12, a_13], [a_12, a_22, a_23], [a_13, a_23, 1]])
    b_1 = -float(rng.integers(1, 4))
    return {"a": a, "b": np.array([b_1, b_1 * a_22 / a_12 - 1e-13, 3 * b_1 - 6])}


#: What ends the loop for k besides its d_ddot.
LISTED = " and (k in pushing or f[k] == 0)"


def _pivot_systems(rng: np.random.Generator) -> Sequence[Case]:
    join = np.array([[1.0, -0.6, -0.6], [-0.6, 1.0, 0.8], [-0.6, 0.8, 1.0]])
    back = np.array([[1.0, 0.3, 0.3], [0.3, 1.0, -0.5], [0.3, -0.5, 1.0]])
    a, b = drawn_system(rng, 5)
    b[:3] = -np.abs(b[:3]) - 1
    return [
        Case("two contacts", {"a": PAIR, "b": np.array([-1.0, -1.0])}),
        Case("the first leaves", {"a": LEVER, "b": np.array([-1.0, -2.0])}),
        Case(
            "the second rests at first", {"a": ROW, "b": np.array([-9.0, -1.0, -2.0])}
        ),
        Case("one that parts must join", {"a": join, "b": np.array([1.0, -2.0, -3.0])}),
        Case("the first parts", {"a": back, "b": np.array([2.0, -1.0, -3.0])}),
        Case("five drawn contacts", {"a": a, "b": b}),
        Case("the last parts", {"a": PAIR, "b": np.array([-1.0, 2.0])}),
        Case("nothing pushes", {"a": PAIR, "b": np.array([1.0, 0.0])}, "edge"),
        Case("the one before must join", {"a": WEDGE, "b": np.array([0.5, -2.0])}),
        *pulled_open(rng),
        Case("they do not feel each other", {"a": np.diag([1.0, 2.0]), "b": np.array([1.0, -2.0])}, "edge"),
        Case("five contacts, strongly coupled", _scaled(rng, *FIVE)),
        Case("six contacts, strongly coupled", _scaled(rng, *SIX)),
        Case("five contacts that no exchange of all at once solves", _scaled(rng, *CYCLING)),
        Case("two stops at once", _scaled(rng, *TIED), "edge"),
        Case("two stops all but at once", _nearly_tied(rng), "edge"),
    ]  # fmt: skip


PIVOT = Exercise(
    name="pivot",
    rows=(20, 25),
    points=4,
    minutes=50,
    level="stretch",
    task="Return f >= 0 with w = A f + b >= 0 and f w = 0, contact by contact, for positive definite A.",
    arguments=(A, B),
    results=(Value("f", "(c,)", "N", "contact forces", relative=1e-8, absolute=1e-9),),
    reference=formulas.pivot,
    cases=_pivot_systems,
    mistakes=(
        Mistake("nobody leaves",
                slip(
                    formulas.pivot,
                    "            stops += [(-f[i] / change[i], i) for i in pushing if change[i] < 0]\n",
                    "",
                ),
                "A force went below 0: stop where one of the pushing forces reaches 0, and take it out of the list."),
        Mistake("nobody joins",
                slip(
                    formulas.pivot,
                    "            stops += [(-w[i] / rate[i], i) for i in resting if rate[i] < 0]\n",
                    "",
                ),
                "A contact that was dealt with sinks in: stop where the d_ddot of one that does not push reaches 0, "
                "and let it join."),
        Mistake("one stop alone",
                slip(
                    formulas.pivot,
                    "            stops += [(-f[i] / change[i], i) for i in pushing if change[i] < 0]\n"
                    "            stops += [(-w[i] / rate[i], i) for i in resting if rate[i] < 0]\n",
                    "",
                ),
                "You stop only where d_ddot_k reaches 0. A pushing force may reach 0 before, or the d_ddot of a "
                "contact that does not push: three kinds of stops, and the first of all ends the step."),
        Mistake("the others hold still",
                slip(formulas.pivot, "-np.linalg.solve(block, a[pushing, k])", "0.0"),
                "While one force grows, those that push already must change with it to keep their d_ddot at 0."),
        Mistake("sign of the answer", slip(formulas.pivot, "-np.linalg", "np.linalg"),
                "The pushing forces change the wrong way: A_CC df_C + A_Ck = 0 keeps their d_ddot at 0, so there is "
                "a minus before A_CC^-1 A_Ck."),
        Mistake("entries for a block",
                slip(formulas.pivot, "a[np.ix_(pushing, pushing)]", "a[pushing, pushing]"),
                "If the error speaks of a 1-dimensional array: a[C, C] takes single entries, a[0, 0], a[2, 2] and so "
                "on. The rows and columns of C are a[np.ix_(C, C)]."),
        Mistake("k is not listed",
                slip(
                    formulas.pivot,
                    "pushing.append(who)",
                    "pushing += [who] if who != k else []",
                    LISTED,
                    "",
                ),
                "A contact that has been dealt with and pushes must stand in the list, or nobody keeps its d_ddot at "
                "0: add k once its d_ddot is 0 and its force is above 0."),
        Mistake("the list keeps who leaves",
                slip(formulas.pivot, "                pushing.remove(who)\n", ""),
                "The contact whose force reached 0 stays in the list: the next step then has length 0, and so has "
                "every one after it. Take it out."),
        Mistake("stops that are not ahead",
                slip(formulas.pivot, " if change[i] < 0", "", " if rate[i] < 0", ""),
                "Not every contact can stop you: only a pushing force that falls, and a d_ddot that falls. The "
                "others would be met by going backwards, with a step below 0."),
        Mistake("two stops at once",
                slip(formulas.pivot, LISTED, ""),
                "Right unless two stops coincide. Where d_ddot_k and the force of another reach 0 together, the other "
                "leaves and k is done without being listed: nobody keeps its d_ddot at 0 from then on. Go on until "
                "k is in the list, or has no force."),
        Mistake("two stops all but at once",
                slip(formulas.pivot, LISTED, "", "min(stops)", "min(stops, key=lambda stop: stop[0])"),
                "Right unless two stops come so close together that d_ddot_k, at the force that leaves first, is "
                "already 0 but for rounding. k is then done without being listed: nobody keeps its d_ddot at 0 from "
                "then on. Go on until k is in the list, or has no force."),
        Mistake("contacts that part are pressed",
                slip(formulas.pivot, "w[k] >= -1e-12", "abs(w[k]) <= 1e-12"),
                "You bring d_ddot_k to 0 also where it is above 0. A contact that parts takes no force: leave it "
                "alone."),
    ),
    hints=(
        "Keep f, d_ddot (w in code) and the list of those that push. For each k a loop with a bound, for _ in "
        "range(100), that ends where d_ddot_k >= -1e-12 and k pushes or has no force: find the direction and the first "
        "stop; go there.",
        "The pushing forces answer a unit of force at k by -A_CC^-1 A_Ck. The stops: d_ddot_k = 0; a pushing force "
        "that falls reaches 0; a falling d_ddot of a contact before k that does not push reaches 0. The smallest "
        "step wins. A for-loop's else, which runs where no break came, raises an error after 100 stops.",
        "for _ in range(100):\n    if w[k] >= -1e-12 and (k in pushing or f[k] == 0):\n        break\n"
        "    change[pushing] = -np.linalg.solve(a[np.ix_(pushing, pushing)], a[pushing, k])\n    rate = a @ change\n"
        "    stops = [(-w[k] / rate[k], k)]\n    stops += [(____, i) for i in pushing if change[i] < 0]\n"
        "    stops += [(____, i) for i in range(k) if i not in pushing and rate[i] < 0]\n    step, who = min(stops)\n"
        '    ...\nelse:\n    raise RuntimeError(f"contact {k}: no end after 100 stops")',
    ),
)  # fmt: skip
