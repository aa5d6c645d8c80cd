"""The exercise ``simultaneous_impulses``: not unique where contacts are redundant, so
judged by what is true of every right answer.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from typing import Any

import numpy as np

from course import formulas
from course.exercises.definition import Case, Exercise, Mistake, Property, Value
from course.exercises.definitions.lesson_12_impulse_and_spin.shared import (
    CYCLING,
    drawn_number,
)
from course.exercises.slips import slip


def _left(given: Any, impulse: Any) -> Any:
    """w = u' + e u = A p + (1 + e) u."""
    return (
        given["matrix"] @ impulse
        + (1 + given["restitution"]) * given["normal_velocity"]
    )


#: The middle one is pressed by neither neighbour and by both.
CHAIN = np.array([[2.0, 1.2, -0.5], [1.2, 2.0, 1.2], [-0.5, 1.2, 2.0]])
CHAIN_COMES = np.array([-1.0, -0.8, -1.5])


def _corners(across: float, along: float) -> np.ndarray:
    """A of a box of 1 kg on its four corners: 1 + x_i x_j/k_y^2 + y_i y_j/k_x^2, rank
    3.
    """
    x, y = np.array([-1.0, -1.0, 1.0, 1.0]), np.array([-1.0, 1.0, -1.0, 1.0])
    return 1 + across * np.outer(x, x) + along * np.outer(y, y)


def _many(rng: np.random.Generator) -> Sequence[Case]:
    def case(matrix: Any, normal_velocity: Any, restitution: float) -> dict[str, Any]:
        given = {
            "matrix": np.array(matrix),
            "normal_velocity": np.array(normal_velocity),
            "restitution": restitution,
        }
        return given

    def drawn(count: int) -> dict[str, Any]:
        root = rng.normal(size=(count + 2, count))
        approach = np.round(-rng.uniform(0.3, 2.0, count), 2)
        # Eigenvalues from 1 up: without the ones, every hundredth draw needs more than
        # the text's 500 rounds.
        return case(
            np.round(root.T @ root + np.eye(count), 2),
            approach,
            drawn_number(rng, (), 0.3, 0.8),
        )

    tilt = np.round(rng.uniform(0.1, 0.4, 2), 2)
    rocking = (
        -1.0
        + tilt[0] * np.array([-1.0, -1.0, 1.0, 1.0])
        + tilt[1] * np.array([-1.0, 1.0, -1.0, 1.0])
    )
    strong = drawn_number(rng, (), 1.4, 1.8)
    return [
        Case(
            "a ball onto two that touch",
            case([[2.0, -1.0], [-1.0, 2.0]], [-1.0, 0.0], 1.0),
        ),
        Case("one contact", case([[4.0]], [-1.0], 0.5)),
        Case(
            "the second needs no push of its own",
            case([[2.0, strong], [strong, 2.0]], [-1.0, -0.2], 0.5),
        ),
        Case("three contacts", drawn(3)),
        Case("four contacts", drawn(4)),
        Case(
            "a box flat on its four corners",
            case(_corners(2.0, 1.5), [-1.0] * 4, 0.5),
            "edge",
        ),
        Case(
            "a box that rocks onto its four corners",
            case(_corners(2.0, 1.5), rocking, 0.75),
            "edge",
        ),
        Case(
            "one approaches, one parts",
            case([[2.0, -1.0], [-1.0, 2.0]], [-1.0, 0.1], 0.5),
            "edge",
        ),
        Case("nothing comes back, e = 0", {**drawn(3), "restitution": 0.0}, "edge"),
        *_hard(rng, case),
    ]


def _hard(rng: np.random.Generator, case: Callable[..., Any]) -> list[Case]:
    """Strongly coupled, badly scaled, undecided: where loops flip and guesses stop early."""
    touching = np.array([[2.0, -1.0], [-1.0, 2.0]])
    e, speed = drawn_number(rng, (), 0.3, 0.8), drawn_number(rng, (), 0.5, 2.0)
    coming, parting = -drawn_number(rng, (), 0.2, 0.4), drawn_number(rng, (), 1.0, 1.5)
    row = 2 * np.eye(6) - np.eye(6, k=1) - np.eye(6, k=-1)
    units = rng.permuted([0.2, 1.0, 5.0])
    pull = "one parts, and pulling it would part the other"
    return [
        Case(pull, case(touching, [coming, parting], e)),
        Case(f"{pull}, the other way round", case(touching, [parting, coming], e)),
        Case("four contacts that act as one", case(np.ones((4, 4)), [-speed] * 4, e)),
        Case("a ball onto a row of six", case(row, [-speed, 0, 0, 0, 0, 0], 1.0)),
        Case(
            "light beside heavy",
            case(CHAIN * units[:, None] * units, CHAIN_COMES * units, e),
        ),
        Case("five contacts that no exchange of all at once solves", case(CYCLING[0], 0.1 * np.array(CYCLING[1]), e)),
        Case("the second is left at 0", case([[2.0, 1], [1, 2]], [-1.0, -0.5], e), "edge"),
        Case("nothing moves", case(touching, [0.0, 0.0], e), "edge"),
    ]  # fmt: skip


def _solved(matrix: Any, normal_velocity: Any, restitution: Any) -> Any:
    return np.linalg.lstsq(
        matrix, -(1 + restitution) * np.asarray(normal_velocity), rcond=1e-9
    )[0]


def _in_turn(matrix: Any, normal_velocity: Any, restitution: Any) -> Any:
    from course.study import impulses_in_turn

    return impulses_in_turn(matrix, normal_velocity, restitution, passes=200)[0]


SIMULTANEOUS_IMPULSES = Exercise(
    name="simultaneous_impulses",
    rows=(15, 17, 21),
    points=3,
    minutes=25,
    level="stretch",
    task="Return impulses p for all contacts at once: p >= 0, w = A p + (1 + e) u >= 0, and p_i w_i = 0 for each i.",
    arguments=(
        Value(
            "matrix",
            "(c, c)",
            "1/kg",
            "A: a_ij is the change of u_i for 1 N s at contact j",
        ),
        Value("normal_velocity", "(c,)", "m/s", "u of each contact before"),
        Value("restitution", "scalar", "", "e, from 0 to 1"),
    ),
    results=(Value("impulse", "(c,)", "N s", "p, none below 0"),),
    reference=formulas.simultaneous_impulses,
    cases=_many,
    judged_by="properties",
    sample=lambda matrix, normal_velocity, restitution: np.zeros(len(normal_velocity)),
    properties=(
        Property(
            "pushes",
            lambda given, answer: np.minimum(answer, 0.0),
            "Some impulse is negative: a contact that pulls. Where an equation asks for that, the contact takes 0.",
            tolerance=1e-6,
        ),
        Property(
            "parts fast enough",
            lambda given, answer: np.minimum(_left(given, answer), 0.0),
            "Some w = A p + (1 + e) u is below 0: that contact parts slower than e times its closing speed. Print p "
            "after each round: does it settle?",
            tolerance=1e-6,
        ),
        Property(
            "no push too many",
            lambda given, answer: (
                np.maximum(answer, 0.0) * np.maximum(_left(given, answer), 0.0)
            ),
            "Some contact has p > 0 and w > 0: it is pushed although it parts faster than it must.",
            tolerance=1e-6,
        ),
    ),
    mistakes=(
        Mistake(
            "each as if alone",
            slip(
                formulas.simultaneous_impulses,
                "range(500)",
                "range(1)",
                "matrix[i] @ impulse + ",
                "",
            ),
            "Each contact gets the impulse it would get alone. But an impulse at one changes the velocity at the "
            "others: that is what the entries off the diagonal say.",
        ),
        Mistake(
            "one sweep",
            slip(formulas.simultaneous_impulses, "range(500)", "range(1)"),
            "You went through the contacts once. A later impulse disturbs those before it: go round again until "
            "nothing changes any more (a few hundred times will do here).",
        ),
        Mistake(
            "not divided by a_ii",
            slip(formulas.simultaneous_impulses, " / matrix[i, i]", ""),
            "Your loop does not settle: it changes p_i by w_i itself. But 1 N s at contact i changes w_i by a_ii: "
            "divide by that.",
        ),
        Mistake(
            "replaced instead of added",
            slip(formulas.simultaneous_impulses, "impulse[i] - surplus", "-surplus"),
            "Your loop does not settle: it puts -w_i/a_ii in the place of p_i. The w_i you compute holds the part of "
            "the old p_i already: what comes out is a change, to be added to it.",
        ),
        Mistake(
            "equations only",
            _solved,
            "You solved A p = -(1 + e) u. Where that makes an impulse negative the contact would pull: it must get 0, "
            "and may part faster.",
        ),
        Mistake(
            "clipped at the end",
            lambda *given: np.maximum(_solved(*given), 0.0),
            "You solved the equations and then set negative impulses to 0. The others were computed with them: they "
            "must be found again. Clip inside the loop, not after it.",
        ),
        Mistake(
            "one after the other",
            _in_turn,
            "This is the sequential law: each contact as if it were alone, with e for each single hit. Here e holds "
            "between before and after all impulses: w_i = (A p)_i + (1 + e) u_i with the u from before.",
        ),
        Mistake(
            "no e",
            slip(formulas.simultaneous_impulses, "(1 + restitution) * ", ""),
            "e is missing: your contacts only stop approaching. w holds (1 + e) u.",
        ),
        Mistake(
            "only e",
            slip(formulas.simultaneous_impulses, "(1 + restitution)", "restitution"),
            "The factor is e where it must be 1 + e: after the impact u' = u + A p, and it must reach -e u.",
        ),
        Mistake(
            "sign",
            slip(
                formulas.simultaneous_impulses,
                "(1 + restitution)",
                "-(1 + restitution)",
            ),
            "The sign of u is reversed: u < 0 approaches, and w = A p + (1 + e) u must be lifted up to 0.",
        ),
    ),
    hints=(
        "One contact: p = -(1 + e) u / a, if that is positive. With several, an impulse at one changes w at all "
        "others.",
        "Start with p = 0 and go through the contacts again and again. For each, compute w_i with the p you have, and "
        "change p_i by what brings w_i to 0, but never below p_i = 0.",
        "impulse = np.zeros(len(normal_velocity))\nfor _ in range(500):\n    for i in range(len(impulse)):\n"
        "        surplus = matrix[i] @ impulse + (1 + restitution) * normal_velocity[i]\n"
        "        impulse[i] = max(0.0, impulse[i] - ____ / ____)\nreturn impulse",
    ),
)
