"""The exercise ``edge_normal_rate``: inputs, comparison and planted mistakes."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

import numpy as np

from course import formulas
from course.exercises.definition import Case, Exercise, Mistake, Property, Value
from course.exercises.definitions.lesson_13_separation.shared import (
    NORMAL,
    OMEGA_A,
    OMEGA_B,
    UP,
    ZERO,
    draw,
)
from course.exercises.definitions.vectors import dot, unit_vector
from course.exercises.slips import slip


def _edges(rng: np.random.Generator) -> Sequence[Case]:
    def crossing(shape: tuple[int, ...] = (), side: Any = 1.0) -> dict[str, Any]:
        e_a = unit_vector(rng, shape)
        across = np.cross(e_a, unit_vector(rng, shape))
        across /= np.linalg.norm(across, axis=-1, keepdims=True)
        angle = rng.uniform(0.5, 1.2, (*shape, 1))
        e_b = np.cos(angle) * e_a + np.sin(angle) * across
        n = np.cross(e_a, e_b) / np.sin(angle) * np.asarray(side)[..., None]
        omega_a, omega_b = draw(rng, shape), draw(rng, shape)
        return {"e_a": e_a, "e_b": e_b, "omega_a": omega_a, "omega_b": omega_b, "n": n}

    as_one = np.array([1.0, -2.0, 0.5])
    square = {
        "e_a": np.array([1.0, 0.0, 0.0]),
        "e_b": np.array([0.0, 1.0, 0.0]),
        "n": UP,
    }
    return [
        Case("edges along x and y, A tips", {**square, "omega_a": np.array([0.0, 2.0, 0.0]), "omega_b": ZERO, "n": UP}),
        Case("off the axes, N along e_A x e_B", crossing()),
        Case("off the axes, N against e_A x e_B", crossing(side=-1.0)),
        Case("both turn as one", {**crossing(), "omega_a": as_one, "omega_b": as_one}, "edge"),
        Case("three crossings", crossing((3,), np.array([1.0, -1.0, 1.0])), "batch"),
        Case("a 2 by 4 batch", crossing((2, 4), np.ones((2, 4))), "batch"),
        Case("edges along x and y, N down", {**square, "omega_a": np.array([0.0, 2, 0]), "omega_b": ZERO, "n": -UP}),
    ]  # fmt: skip


def _in_order(cases: Sequence[Case]) -> list[Case]:
    names = ("e_a", "e_b", "omega_a", "omega_b", "n")
    return [
        Case(c.label, {name: c.arguments[name] for name in names}, c.kind)
        for c in cases
    ]


EDGE_NORMAL_RATE = Exercise(
    name="edge_normal_rate",
    rows=(20,),
    points=2,
    minutes=18,
    level="stretch",
    task="Return N_dot of two crossing edges: N is e_A x e_B made a unit vector, or the opposite of it.",
    arguments=(
        Value("e_a", "(..., 3)", "", "unit direction of the edge of A"),
        Value("e_b", "(..., 3)", "", "unit direction of the edge of B"),
        OMEGA_A,
        OMEGA_B,
        NORMAL,
    ),
    results=(Value("n_dot", "(..., 3)", "1/s", "rate of N"),),
    reference=formulas.edge_normal_rate,
    cases=lambda rng: _in_order(_edges(rng)),
    properties=(
        Property(
            "keeps its length",
            lambda given, answer: dot(answer, given["n"]),
            "Your N_dot has a part along N, so N would not keep its length of 1: take that part away.",
        ),
    ),
    mistakes=(
        Mistake(
            "not projected",
            slip(
                formulas.edge_normal_rate,
                " - np.sum(rate * n, axis=-1)[..., None] * n",
                "",
            ),
            "Only the part of q_dot across N turns it; the part along N changes the length of q, which N does not "
            "have. Take it away: rate - (rate.N) N.",
        ),
        Mistake(
            "not divided",
            slip(
                formulas.edge_normal_rate,
                " / np.linalg.norm(q, axis=-1)[..., None]",
                "",
            ),
            "q = e_A x e_B is shorter than 1 where the edges are not square to each other, and a short arrow turns "
            "further by the same change: divide by |q|.",
        ),
        Mistake(
            "divided twice",
            slip(
                formulas.edge_normal_rate,
                "norm(q, axis=-1)[..., None]",
                "norm(q, axis=-1)[..., None] ** 2",
            ),
            "You divide by |q|^2. N is q/|q|, so its rate holds |q| once.",
        ),
        Mistake(
            "divided by its own length",
            slip(formulas.edge_normal_rate, "norm(q,", "norm(q_dot,"),
            "You divide by |q_dot| where it is |q|. N_dot is a rate: its length says how fast N turns, and is not 1.",
        ),
        Mistake(
            "a unit vector",
            slip(
                formulas.edge_normal_rate,
                "side * ",
                "",
                "norm(q,",
                "norm(q_dot,",
                " - np.sum(rate * n, axis=-1)[..., None] * n",
                "",
            ),
            "You made q_dot a unit vector. It is N that has length 1; N_dot is a rate, and its length says how fast N "
            "turns. Divide by |q|, and see to the sign and to the part along N.",
        ),
        Mistake(
            "sign left out",
            slip(formulas.edge_normal_rate, "side * ", ""),
            "Right where N lies along e_A x e_B. Where it lies against it, N_dot is reversed as well: the sign of "
            "q.N.",
        ),
        Mistake(
            "only the edge of A",
            slip(formulas.edge_normal_rate, " + np.cross(e_a, e_b_dot)", ""),
            "The edge of B turns too: q_dot has two terms, one for each edge.",
        ),
        Mistake(
            "only the edge of B",
            slip(formulas.edge_normal_rate, "np.cross(e_a_dot, e_b) + ", ""),
            "The edge of A turns too: q_dot has two terms, one for each edge.",
        ),
        Mistake(
            "spins swapped",
            slip(
                formulas.edge_normal_rate,
                "np.cross(omega_a, e_a), np.cross(omega_b, e_b)",
                "np.cross(omega_b, e_a), np.cross(omega_a, e_b)",
            ),
            "Each edge turns with the omega of the other body.",
        ),
        Mistake(
            "mean spin",
            slip(
                formulas.edge_normal_rate,
                "rate - np.sum(rate * n, axis=-1)[..., None] * n",
                "np.cross(0.5 * (omega_a + omega_b), n)",
            ),
            "You turn N with the mean of the two spins. Each edge turns with its own body, and what that does to N "
            "depends on how the edges lie: take the rate of their cross product.",
        ),
        Mistake(
            "a face of B",
            slip(
                formulas.edge_normal_rate,
                "rate - np.sum(rate * n, axis=-1)[..., None] * n",
                "np.cross(omega_b, n)",
            ),
            "omega_B x N is the rule for a face of B. Two edges carry the normal together.",
        ),
        Mistake(
            "sign of the second term",
            slip(
                formulas.edge_normal_rate,
                "+ np.cross(e_a, e_b_dot)",
                "- np.cross(e_a, e_b_dot)",
            ),
            "The second term of q_dot comes with the other sign: the product rule adds, and a cross product whose "
            "factors change places changes its sign.",
        ),
    ),
    hints=(
        "An edge is an arrow fixed to its body, so e_dot = omega x e. N is q/|q|, up to a sign, with q = e_A x e_B.",
        "q_dot is (omega_A x e_A) x e_B plus e_A x (omega_B x e_B). Divide it by |q|, give it the sign of q.N, and "
        "take its part along N away.",
        "q = np.cross(e_a, e_b)\n"
        "q_dot = np.cross(np.cross(omega_a, e_a), e_b) + np.cross(____, ____)\n"
        "side = np.sign(np.sum(q * n, axis=-1))[..., None]\n"
        "rate = side * q_dot / np.linalg.norm(q, axis=-1)[..., None]\n"
        "return rate - ____ * n",
    ),
)
