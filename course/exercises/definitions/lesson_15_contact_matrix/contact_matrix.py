"""The exercise ``contact_matrix``: inputs, comparison and planted mistakes."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from typing import Any

import numpy as np

from course import formulas
from course.exercises.definition import Case, Exercise, Mistake, Property, Value
from course.exercises.definitions.lesson_15_contact_matrix.shared import (
    BODIES,
    CONTACTS,
    TOGETHER,
    Edits,
)
from course.exercises.definitions.lesson_15_contact_matrix.touching import (
    central_stack,
    drawn_contacts,
)
from course.exercises.slips import slip


def _slipped(of_entry: Edits, of_matrix: Edits | None) -> Callable[..., Any]:
    """The slip in A = J M^-1 J', or where J cannot show it, in each entry."""
    if of_matrix is not None:
        return slip(formulas.contact_matrix, *of_matrix)
    entry = slip(formulas.contact_matrix_entry, *of_entry)

    def every_entry(contacts: Any, bodies: Any) -> Any:
        c = range(len(contacts[0]))
        return np.array([[entry(i, j, contacts, bodies) for j in c] for i in c])

    return every_entry


#: Those that a student who builds J can make as well.
ALIKE = tuple(row for row in TOGETHER if row[0] != "one point for both")


def _matrices(rng: np.random.Generator) -> Sequence[Case]:
    def case(label: str, pairs: Any, kind: Any = "single", fixed: bool = False) -> Case:
        contacts, bodies = drawn_contacts(rng, pairs, fixed=fixed)
        return Case(label, {"contacts": contacts, "bodies": bodies}, kind)

    contacts, bodies = central_stack()
    return [
        Case("2 kg on 4 kg on the floor", {"contacts": contacts, "bodies": bodies}),
        case("a body in both contacts", ((0, 1), (2, 0))),
        case("two contacts of the same two bodies", ((0, 1), (0, 1))),
        case("three boxes and the floor", ((0, 3), (1, 0), (2, 1), (0, 2)), fixed=True),
        case("one contact", ((0, 1),), "edge"),
        case("six contacts on one body that can move", tuple((0, 1) for _ in range(6)), "batch", fixed=True),
        case("eight contacts among five bodies", ((0, 4), (1, 4), (0, 1), (2, 0), (2, 1), (3, 2), (1, 3), (3, 4)),
             "batch", fixed=True),
    ]  # fmt: skip


CONTACT_MATRIX = Exercise(
    name="contact_matrix",
    rows=(21, 22, 24),
    points=3,
    minutes=12,
    task="Return the whole contact matrix A = J M^-1 J'.",
    arguments=(CONTACTS, BODIES),
    results=(Value("A", "(c, c)", "1/kg", "contact matrix"),),
    reference=formulas.contact_matrix,
    cases=_matrices,
    mistakes=(
        *(Mistake(name, _slipped(of_entry, of_matrix), message) for name, of_entry, of_matrix, message in ALIKE),
        Mistake("every axis turned round",
                slip(formulas.contact_matrix, "np.swapaxes(rotation, -1, -2)", "rotation.T"),
                "rotation.T of a batch reverses all three axes, "
                "the bodies too. R' of each body is np.swapaxes(rotation, -1, -2)."),
        Mistake("masses left out", slip(formulas.contact_matrix, "@ weighed.reshape", "@ J.reshape"),
                "This is J J'. Between the two stands M^-1: 1/m for the first three "
                "columns of a body, R I^-1 R' for the other three."),
        Mistake("masses for their inverses",
                slip(formulas.contact_matrix, "/ mass", "* mass", ", world,", ", np.linalg.pinv(world),"),
                "Heavy bodies answer more in your A, and light ones less: M "
                "stands where M^-1 belongs."),
        Mistake("one triangle",
                slip(
                    formulas.contact_matrix,
                    "J.reshape(len(point), -1) @ weighed.reshape(len(point), -1).T",
                    "np.tril(J.reshape(len(point), -1) @ weighed.reshape(len(point), -1).T)",
                ),
                "Only one triangle is filled. A is symmetric."),
        Mistake("diagonal alone",
                slip(
                    formulas.contact_matrix,
                    "J.reshape(len(point), -1) @ weighed.reshape(len(point), -1).T",
                    "np.diag(np.sum(J * weighed, axis=(1, 2)))",
                ),
                "Only the diagonal is there. Contacts "
                "that share a body feel each other."),
    ),
    properties=(
        Property("symmetric", lambda given, a: a - np.swapaxes(a, -1, -2), "It is not symmetric: what j does to i, i "
                 "must do to j."),
        Property("positive semidefinite", lambda given, a: np.minimum(np.linalg.eigvalsh(a + a.T), 0), "Some forces f "
                 "give f.A f below 0: as if pushes drew the bodies together."),
    ),
    hints=(
        "Build J with a block of six columns for each body, np.zeros((c, n, 6)), filled for A with +, for B with -.",
        "J[i, body] = +-(N, r x N). J M^-1: divide the first three of six by m, multiply the others by R I^-1 R'. "
        "Then A = J.reshape(c, -1) @ (the other).reshape(c, -1).T.",
        "for body, sign in ((body_a, 1), (body_b, -1)):\n"
        "    lever = np.cross(point - position[body], ____)\n"
        "    J[np.arange(len(point)), body] = sign * np.concatenate([normal, lever], axis=-1)\n"
        "world = rotation @ inverse_inertia @ np.swapaxes(rotation, -1, -2)\n"
        'turned = np.einsum("nij,cnj->cni", world, J[..., 3:])\n'
        "weighed = np.concatenate([J[..., :3] / mass[:, None], turned], axis=-1)\n"
        "return J.reshape(len(point), -1) @ ____.reshape(len(point), -1).T",
    ),
)  # fmt: skip
