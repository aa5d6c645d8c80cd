"""The exercise ``edge_normal_rate``: its inputs, its comparison, and the slips it knows."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

import numpy as np

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


def _edge_rate(
    *,
    project: bool = True,
    divide: Any = None,
    sign: bool = True,
    part_a: float = 1.0,
    part_b: float = 1.0,
    swap: bool = False,
) -> Any:
    """The rate of the normal of two edges with one of its parts changed."""

    def function(e_a: Any, e_b: Any, omega_a: Any, omega_b: Any, n: Any) -> Any:
        if swap:
            omega_a, omega_b = omega_b, omega_a
        q = np.cross(e_a, e_b)
        q_dot = part_a * np.cross(np.cross(omega_a, e_a), e_b) + part_b * np.cross(
            e_a, np.cross(omega_b, e_b)
        )
        length = np.linalg.norm(q, axis=-1)[..., None]
        rate = divide(q_dot, length) if divide else q_dot / length
        rate = np.sign(dot(q, n))[..., None] * rate if sign else rate
        return rate - dot(rate, n)[..., None] * n if project else rate

    return function


def _made_unit(vector: Any) -> Any:
    return vector / np.linalg.norm(vector, axis=-1)[..., None]


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
    reference=_edge_rate(),
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
            _edge_rate(project=False),
            "Only the part of q_dot across N turns it; the part along N changes the length of q, which N does not "
            "have. Take it away: rate - (rate.N) N.",
        ),
        Mistake(
            "not divided",
            _edge_rate(divide=lambda q_dot, length: q_dot),
            "q = e_A x e_B is shorter than 1 where the edges are not square to each other, and a short arrow turns "
            "further by the same change: divide by |q|.",
        ),
        Mistake(
            "divided twice",
            _edge_rate(divide=lambda q_dot, length: q_dot / length**2),
            "You divide by |q|^2. N is q/|q|, so its rate holds |q| once.",
        ),
        Mistake(
            "divided by its own length",
            _edge_rate(divide=lambda q_dot, length: _made_unit(q_dot)),
            "You divide by |q_dot| where it is |q|. N_dot is a rate: its length says how fast N turns, and is not 1.",
        ),
        Mistake(
            "a unit vector",
            _edge_rate(
                divide=lambda q_dot, length: _made_unit(q_dot),
                sign=False,
                project=False,
            ),
            "You made q_dot a unit vector. It is N that has length 1; N_dot is a rate, and its length says how fast N "
            "turns. Divide by |q|, and see to the sign and to the part along N.",
        ),
        Mistake(
            "sign left out",
            _edge_rate(sign=False),
            "Right where N lies along e_A x e_B. Where it lies against it, N_dot is turned round as well: the sign of "
            "q.N.",
        ),
        Mistake(
            "only the edge of A",
            _edge_rate(part_b=0.0),
            "The edge of B turns too: q_dot has two terms, one for each edge.",
        ),
        Mistake(
            "only the edge of B",
            _edge_rate(part_a=0.0),
            "The edge of A turns too: q_dot has two terms, one for each edge.",
        ),
        Mistake(
            "spins swapped",
            _edge_rate(swap=True),
            "Each edge turns with the omega of the other body.",
        ),
        Mistake(
            "mean spin",
            lambda e_a, e_b, omega_a, omega_b, n: np.cross(
                0.5 * (np.asarray(omega_a) + omega_b), n
            ),
            "You turn N with the mean of the two spins. Each edge turns with its own body, and what that does to N "
            "depends on how the edges lie: take the rate of their cross product.",
        ),
        Mistake(
            "a face of B",
            lambda e_a, e_b, omega_a, omega_b, n: np.cross(omega_b, n),
            "omega_B x N is the rule for a face of B. Two edges carry the normal together.",
        ),
        Mistake(
            "sign of the second term",
            _edge_rate(part_b=-1.0),
            "The second term of q_dot has the wrong sign: the product rule adds.",
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
