"""The exercise ``contact_matrix_entry``: inputs, comparison and planted mistakes."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

import numpy as np

from course import formulas
from course.exercises.definition import Case, Exercise, Mistake, Value
from course.exercises.definitions.lesson_15_contact_matrix.shared import (
    BODIES,
    CONTACTS,
    TOGETHER,
)
from course.exercises.definitions.lesson_15_contact_matrix.touching import (
    central_stack,
    drawn_contacts,
)
from course.exercises.slips import slip

#: Sharing in every way: A with A, A with B, B with A, both, both crosswise, none, the
#: same contact twice.
SHARED = {
    "the same body is A of both": ((0, 1), (0, 2)),
    "A of one is B of the other": ((0, 1), (2, 0)),
    "the same body is B of both": ((1, 0), (2, 0)),
    "two contacts of the same two bodies": ((0, 1), (0, 1)),
    "the same two bodies, A and B exchanged": ((0, 1), (1, 0)),
}

#: More contacts than two, so that neither i nor j can be told without being read.
RING = ((0, 1), (2, 3), (1, 2), (3, 0))


def _entries(rng: np.random.Generator) -> Sequence[Case]:
    def case(
        label: str,
        pairs: Any,
        i: int = 0,
        j: int = 1,
        kind: Any = "single",
        fixed: bool = False,
    ) -> Case:
        contacts, bodies = drawn_contacts(rng, pairs, fixed=fixed)
        return Case(
            label, {"i": i, "j": j, "contacts": contacts, "bodies": bodies}, kind
        )

    contacts, bodies = central_stack()
    return [
        Case(
            "2 kg on 4 kg on the floor",
            {"i": 0, "j": 1, "contacts": contacts, "bodies": bodies},
        ),
        *(case(label, pairs) for label, pairs in SHARED.items()),
        case("a contact with itself", ((0, 1), (1, 2)), 1, 1),
        case("on a fixed floor", ((0, 2), (1, 2)), 0, 0, "edge", fixed=True),
        case(
            "no body in common but the fixed floor",
            ((0, 2), (1, 2)),
            0,
            1,
            "edge",
            fixed=True,
        ),
        case("no body in common", ((0, 1), (2, 3)), 0, 1, "edge"),
        *(
            case(f"four bodies in a ring, a_{i}{j}", RING, i, j)
            for i, j in ((2, 0), (1, 2), (0, 3), (2, 2))
        ),
    ]


CONTACT_MATRIX_ENTRY = Exercise(
    name="contact_matrix_entry",
    rows=(21, 22, 24),
    points=3,
    minutes=12,
    task="Return a_ij, what a unit of force at contact j adds to d_ddot of contact i.",
    arguments=(
        Value("i", "scalar", "", "the contact that answers, from 0", dtype="int"),
        Value("j", "scalar", "", "the contact that is pushed, from 0", dtype="int"),
        CONTACTS,
        BODIES,
    ),
    results=(Value("a_ij", "scalar", "1/kg", "entry of the contact matrix"),),
    reference=formulas.contact_matrix_entry,
    cases=_entries,
    mistakes=(
        *(Mistake(name, slip(formulas.contact_matrix_entry, *edits), message) for name, edits, _, message in TOGETHER),
        Mistake("turned round", slip(formulas.contact_matrix_entry, "return a_ij", "return -a_ij"),
                "The whole has the wrong sign. A push at a contact opens its own "
                "gap: a_ii must be above 0."),
        Mistake("the other arm twice",
                slip(formulas.contact_matrix_entry, "point[j] - position[body]", "point[i] - position[body]"),
                "Both arms go to the point "
                "that answers. The torque is made where the body is pushed: r_j = p_j - x."),
        Mistake("pushed along N_i",
                slip(formulas.contact_matrix_entry, "push_sign * normal[j]", "push_sign * normal[i]"),
                "You push along the normal of the "
                "contact that answers. The force at j acts along N_j."),
        Mistake("not along N_i", slip(formulas.contact_matrix_entry, "normal[i] @ answer", "answer"),
                "Your answer is the acceleration of "
                "the point, a vector. The gap feels its part along the normal: dot it with N_i."),
        Mistake("inertia for its inverse",
                slip(formulas.contact_matrix_entry, "mass[body], world", "mass[body], np.linalg.pinv(world)"),
                "You invert the "
                "inertia once more: what is given is the inverse already. Only its axes have to be turned."),
        Mistake("normals left out",
                slip(
                    formulas.contact_matrix_entry,
                    "normal[i] @ answer",
                    "(normal[i] @ (answer - push / mass[body]) + push_sign / mass[body])",
                ),
                "The first part is 1/m, as if both pushes had one "
                "direction. It is N_i.N_j/m."),
        Mistake("asked along N_j", slip(formulas.contact_matrix_entry, "normal[i] @", "normal[j] @"),
                "You take the part of the answer along "
                "N_j. The gap at i is measured along N_i."),
    ),
    hints=(
        "Four possible terms: A or B of contact i, with A or B of contact j. A term counts where the two are one body.",
        "For each: point_response with that body's own mass, R I^-1 R' and arms, and N_j (for B: -N_j) as the push; "
        "dot it with N_i (for B: -N_i); add up.",
        "for body, sign in ((body_a[i], 1), (body_b[i], -1)):\n"
        "    for pushed, push_sign in ((body_a[j], 1), (body_b[j], ____)):\n"
        "        if body == pushed:\n"
        "            world = rotation[body] @ inverse_inertia[body] @ rotation[body].T\n"
        "            answer = point_response(mass[body], world, point[i] - position[body],\n"
        "                                    ____ - position[body], push_sign * normal[j])\n"
        "            a_ij += sign * normal[i] @ answer",
    ),
)  # fmt: skip
