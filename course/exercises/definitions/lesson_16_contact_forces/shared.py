"""What the exercises of lesson 16 share: small systems and their arguments."""

from __future__ import annotations

from typing import Any

import numpy as np

from course.exercises.definition import Case, Value

PAIR = np.array([[1.0, 0.5], [0.5, 1.0]])
LEVER = np.array([[1.0, 0.75], [0.75, 1.0]])
TWICE = np.array([[0.5, 0.5], [0.5, 0.5]])
WEDGE = np.array([[1.0, -0.6], [-0.6, 1.0]])
ROW = np.array([[2.0, 1.0, 0.2], [1.0, 2.0, 1.0], [0.2, 1.0, 2.0]])

A = Value("a", "(c, c)", "1/kg", "contact matrix, symmetric and positive semidefinite")
B = Value("b", "(c,)", "m/s²", "d_ddot without contact forces")


def apply(matrix: Any, vector: Any) -> Any:
    return np.einsum("...ij,...j->...i", matrix, vector)


def drawn_system(rng: np.random.Generator, count: int) -> tuple[np.ndarray, np.ndarray]:
    """A positive definite A of three decimals and b of both signs: they are shown to
    students.
    """
    root = np.round(rng.uniform(-1, 1, (count, count + 1)), 1)
    a = np.round(root @ root.T + 0.3 * np.eye(count), 3)
    return a, np.round(rng.uniform(-9, 3, count), 1)


def pulled_open(rng: np.random.Generator) -> list[Case]:
    """One contact parts, and pulling it shut would open the other as well.

    Whoever tries which contacts push and asks only w >= 0 takes the pull for an answer,
    in one of the two orders whatever contact he tries first.
    """
    sinking, parting = rng.uniform([-0.5, 1.0], [-0.2, 2.0]).round(2)
    label = "one parts, and pulling it would lift the other"
    return [
        Case(label, {"a": WEDGE, "b": np.array([sinking, parting])}),
        Case(f"{label}, the other way round", {"a": WEDGE, "b": np.array([parting, sinking])}),
    ]  # fmt: skip
