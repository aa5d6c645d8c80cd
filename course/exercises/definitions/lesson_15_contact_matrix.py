"""Lesson 15: how each contact force changes each d_ddot, the contact matrix A."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

import numpy as np

from course.exercises.definition import Case, Exercise, Lesson, Mistake, Prediction, Property, Value
from course.exercises.definitions.touching import (
    by_product,
    central_stack,
    drawn_contacts,
    entry,
    matrix,
    response,
    with_masses,
    without_masses,
)
from course.exercises.definitions.turning import drawn_vectors, rotation_matrices, times, turned_inertia

UP = np.array([0.0, 0.0, 1.0])


# ladder_entry, the student's step of the derivation: what a force at the top does to the gap at the foot.


def _ladder(*, factor: float = -3.0, power: float = 1.0, form: str = "both", extra: float = 0.0) -> Any:
    """a_12 of the ladder with one of its parts changed."""

    def function(mass: Any, theta: Any, ell: Any) -> Any:
        if not isinstance(theta, (float, np.ndarray)):
            import sympy

            return -3 * sympy.sin(theta) * sympy.cos(theta) / mass
        sin, cos = np.sin(theta), np.cos(theta)
        shape = {"both": sin * cos, "cos": cos * cos, "sin": sin * sin, "arm": sin * cos / ell,
                 "unit": sin * cos / ell**2, "none": 0.0 * sin}[form]
        return factor * shape / mass**power + extra / mass + 0.0 * ell

    return function


def _with_inertia(mass: Any, theta: Any, ell: Any) -> Any:
    return -(ell**2) / 4 * np.sin(theta) * np.cos(theta) * mass * ell**2 / 12


def _ladders(rng: np.random.Generator) -> Sequence[Case]:
    draws = {
        "mass": np.round(rng.uniform(5.0, 20.0, 8), 1),
        "theta": np.round(rng.uniform(0.3, 0.7, 8), 2),
        "ell": np.round(rng.uniform(2.0, 5.0, 8), 2),
    }
    return [Case("one ladder", {"mass": 10.0, "theta": 0.5, "ell": 4.0}), Case("eight ladders", draws, "batch")]


LADDER_ENTRY = Exercise(
    name="ladder_entry",
    kind="expression",
    rows=(21, 24),
    points=2,
    minutes=8,
    task="Give a_12 of the ladder, what a unit of force at its top adds to d_ddot at its foot, in mass, theta and ell.",
    arguments=(
        Value("mass", "scalar", "kg", "of the ladder; I = mass ell^2 / 12"),
        Value("theta", "scalar", "rad", "angle between ladder and floor"),
        Value("ell", "scalar", "m", "length of the ladder"),
    ),
    results=(Value("ladder_entry", "(...)", "1/kg", "a_12"),),
    reference=_ladder(),
    cases=_ladders,
    mistakes=(
        Mistake("sign", _ladder(factor=3.0), "The sign is turned round. The top is pushed to the left: which way does "
                "the ladder begin to turn, and where does that take the foot?"),
        Mistake("zero", _ladder(form="none"), "You say that the foot feels nothing. N_1.N_2 = 0 is true of the pushes "
                "themselves, but the push at the top also turns the ladder."),
        Mistake("with 1/m", _ladder(extra=1.0), "You add 1/m. The push at the top is horizontal: the centre is "
                "accelerated to the left, which does not move the foot up or down."),
        Mistake("whole arms", _ladder(factor=-12.0), "Too large by 4: both arms are half the ladder, not the whole."),
        Mistake("moment about the end", _ladder(factor=-0.75), "Too small by 4: m l^2/3 is the moment about an end. "
                "Torques are taken about the centre here, where it is m l^2/12."),
        Mistake("two cosines", _ladder(form="cos"), "You have cosine squared. That is the foot's own arm twice: at the "
                "top the part of the arm that lies across N_2 counts, which is the sine."),
        Mistake("two sines", _ladder(form="sin"), "You have sine squared. That is the top's own arm twice: at the foot "
                "the part of the arm that lies across N_1 counts, which is the cosine."),
        Mistake("half as large", _ladder(factor=-1.5), "Too small by 2. Both arms are ell/2, and 12/4 is 3."),
        Mistake("mass forgotten", _ladder(power=0.0), "The mass is missing: it stands in I = m l^2/12."),
        Mistake("one arm left out", _ladder(factor=-6.0, form="arm"), "A length is left over, as if one of the "
                "two arms were missing: the torque brings one, the way from the turn to the foot the other."),
        Mistake("directions for arms", _ladder(factor=-12.0, form="unit"), "Your arms have length 1. Each is half the "
                "ladder long, and then the length cancels."),
        Mistake("inertia for its inverse", _with_inertia, "You multiply by the inertia. The angular acceleration is "
                "torque divided by I."),
    ),
    hints=(
        "Start from a_11 in the text and change what is pushed: the push is N_2 at the top, the answer that of the "
        "foot along N_1.",
        "w = y N_z - z N_y is the lever of a contact at (y, z) from the centre: a_12 = N_1.N_2/m + w_1 w_2/I, "
        "w_1 = -(ell/2) cos(theta). Find w_2 the same way.",
        "w_1, w_2 = -ell / 2 * sp.cos(theta), ____\nladder_entry = w_1 * w_2 / (mass * ell**2 / ____)",
    ),
)  # fmt: skip


# point_response


def _responses(rng: np.random.Generator) -> Sequence[Case]:
    def push(shape: tuple[int, ...] = ()) -> dict[str, Any]:
        moments = np.round(rng.uniform([0.2, 0.8, 1.5], [0.5, 1.2, 2.5], (*shape, 3)), 2)
        inverse = np.round(turned_inertia(rotation_matrices(rng, shape), moments[..., None] * np.eye(3)), 3)
        return {
            "mass": np.round(rng.uniform(1.5, 5.0, shape), 1) if shape else float(np.round(rng.uniform(1.5, 5.0), 1)),
            "inverse_inertia": 0.5 * (inverse + np.swapaxes(inverse, -1, -2)),
            "arm": drawn_vectors(rng, shape), "push_arm": drawn_vectors(rng, shape), "push": drawn_vectors(rng, shape),
        }  # fmt: skip

    corner = {
        "mass": 4.0, "inverse_inertia": np.diag([2.0, 1.0, 0.5]), "arm": np.array([-0.5, -0.3, -0.7]),
        "push_arm": np.array([0.5, 0.3, -0.7]), "push": UP,
    }  # fmt: skip
    along = drawn_vectors(rng, ())
    return [
        Case("pushed up at one corner, asked at the opposite one", corner),
        Case("off the axes", push()),
        Case("off the axes again", push()),
        Case("pushed toward the centre", {**push(), "push_arm": -0.5 * along, "push": along}, "edge"),
        Case("a fixed body", {**push(), "mass": np.inf, "inverse_inertia": np.zeros((3, 3))}, "edge"),
        Case("three bodies, as many as a vector has components", push((3,)), "batch"),
        Case("a 2 by 4 batch", push((2, 4)), "batch"),
        Case("four points of one body", {**push(), "arm": drawn_vectors(rng, (4,))}, "batch"),
    ]


POINT_RESPONSE = Exercise(
    name="point_response",
    rows=(22, 24),
    points=2,
    minutes=9,
    task="Return the acceleration that a push at one point of a body gives another of its points.",
    arguments=(
        Value("mass", "(...)", "kg", "infinity for a fixed body"),
        Value("inverse_inertia", "(..., 3, 3)", "1/(kg m^2)", "I^-1 in world axes, zero for a fixed body"),
        Value("arm", "(..., 3)", "m", "r_i, from the centre of mass to the point that answers"),
        Value("push_arm", "(..., 3)", "m", "r_j, from the centre of mass to the point that is pushed"),
        Value("push", "(..., 3)", "N", "force on the body"),
    ),
    results=(Value("p_ddot", "(..., 3)", "m/s^2", "acceleration of the point that answers"),),
    reference=response(),
    cases=_responses,
    mistakes=(
        Mistake("arms swapped", response(arms=lambda i, j: (j, i)), "The arms have changed places: the torque is made "
                "where the body is pushed, with r_j; the turning is felt where it answers, at r_i."),
        Mistake("arm of the push twice", response(arms=lambda i, j: (j, j)), "You use the arm of the push for the "
                "answer too. That is how the pushed point itself moves: r_A in the table is that of i, not j."),
        Mistake("arm of the answer twice", response(arms=lambda i, j: (i, i)), "You use the arm of the answering point "
                "for the torque too. The torque is made by the arm of the push."),
        Mistake("a cross product turned round", response(turning=-1.0), "One of the two cross products is turned "
                "round. The torque is r_j x F, and what it does to the point omega_dot x r_i."),
        Mistake("x r left out", response(crossed=False), "You add omega_dot as it is, in rad/s^2. Crossed with the arm "
                "of the point that answers it becomes an acceleration."),
        Mistake("no turning", response(turning=0.0), "This is how the centre is accelerated. A push off the centre "
                "turns the body as well."),
        Mistake("only turning", response(moving=0.0), "The push also accelerates the body as a whole, by F/m."),
        Mistake("mass forgotten", response(divided=False), "The force is added as it is, in N: divide it by the mass."),
        Mistake("mass without an axis", response(axis=False), "Right for one mass. A batch of masses needs one more "
                "axis before it divides vectors: np.asarray(mass)[..., None]."),
        Mistake("inertia not used", response(apply=lambda m, v: v + 0.0 * m[..., 0]), "The torque is used as if it "
                "were omega_dot: it has to go through I^-1."),
        Mistake("inertia for its inverse", response(apply=lambda m, v: times(np.linalg.pinv(m), v)),
                "You use I where its inverse belongs. What is given is I^-1 already: multiply by it."),
        Mistake("diagonal alone", response(apply=lambda m, v: np.einsum("...ii->...i", m) * v), "You use the diagonal "
                "of I^-1 alone. That is right only while the body's axes lie along those of the world."),
        Mistake("matrix product with @", response(apply=lambda m, v: m @ v), "Right for one body. In a batch, @ takes "
                'the last two axes of both sides for matrices: np.einsum("...ij,...j->...i", matrix, vector).'),
    ),
    hints=(
        "See Derive, step 2: two parts, the motion of the centre and the turning about it.",
        "F/m, with an axis more on the mass; the torque r_j x F through I^-1 gives omega_dot; omega_dot x r_i.",
        'omega_dot = np.einsum("...ij,...j->...i", inverse_inertia, np.cross(____, push))\n'
        "return push / np.asarray(mass)[..., None] + np.cross(____, ____)",
    ),
)  # fmt: skip


# contact_matrix_entry and contact_matrix: the slips that both can have, in words.

TOGETHER = (
    ("sign of body B", {"sign_b": 1.0}, "Body B is pushed along -N_j, and its motion is subtracted in d: B has the "
     "opposite sign, both when it is pushed and when it answers."),
    ("body B forgotten", {"meet": lambda i, j: i == j == 0}, "Body B is missing. It may be a body that moves: it is "
     "pushed as hard as A and answers as well."),
    ("A with A, B with B", {"meet": lambda i, j: i == j}, "A body can be A of one contact and B of the other, like the "
     "middle box of a stack: such pairs are missing."),
    ("one arm for both bodies", {"arms": lambda p, q, x, x_a: (p - x_a, q - x_a)}, "The arms of A are used for B too. "
     "Each body has its own arm, from its own centre: r = p - x."),
    ("arms from the origin", {"arms": lambda p, q, x, x_a: (p, q)}, "Your arms are places of points. They are measured "
     "from the centre of mass: r = p - x."),
    ("one point for both", {"arms": lambda p, q, x, x_a: (q - x, q - x)}, "Both arms go to the point that is pushed. "
     "The answer is that of the other contact's point, r_i = p_i - x."),
    ("no turning", {"turning": 0.0}, "Only N_i.N_j/m is there. A push off the centre turns the body, and the turning "
     "moves the other point."),
    ("mass forgotten", {"divided": False}, "The mass is missing in the first part: N_i.N_j/m."),
    ("a cross product turned round", {"turning": -1.0}, "The part that turns has the wrong sign. With r_i x N_i and "
     "r_j x N_j on both sides of I^-1 there is no minus."),
    ("inertia in body axes", {"frame": "body"}, "The inverse inertia is given in body axes and used as if in world "
     "axes: R I^-1 R' with the rotation of the body."),
    ("rotation turned round", {"frame": "back"}, "You have R' I^-1 R, which turns world axes into body axes. It is "
     "R I^-1 R'."),
)  # fmt: skip

#: Those that a student who builds J can make as well.
ALIKE = tuple(slip for slip in TOGETHER if slip[0] != "one point for both")

#: Sharing in every way: A with A, A with B, B with A, both, both crosswise, none, the same contact twice.
SHARED = {
    "the same body is A of both": ((0, 1), (0, 2)),
    "A of one is B of the other": ((0, 1), (2, 0)),
    "the same body is B of both": ((1, 0), (2, 0)),
    "two contacts of the same two bodies": ((0, 1), (0, 1)),
    "the same two bodies, A and B exchanged": ((0, 1), (1, 0)),
}


def _entries(rng: np.random.Generator) -> Sequence[Case]:
    def case(label: str, pairs: Any, i: int = 0, j: int = 1, kind: Any = "single", fixed: bool = False) -> Case:
        contacts, bodies = drawn_contacts(rng, pairs, fixed=fixed)
        return Case(label, {"i": i, "j": j, "contacts": contacts, "bodies": bodies}, kind)

    contacts, bodies = central_stack()
    return [
        Case("2 kg on 4 kg on the floor", {"i": 0, "j": 1, "contacts": contacts, "bodies": bodies}),
        *(case(label, pairs) for label, pairs in SHARED.items()),
        case("a contact with itself", ((0, 1), (1, 2)), 1, 1),
        case("on a fixed floor", ((0, 2), (1, 2)), 0, 0, "edge", fixed=True),
        case("no body in common but the fixed floor", ((0, 2), (1, 2)), 0, 1, "edge", fixed=True),
        case("no body in common", ((0, 1), (2, 3)), 0, 1, "edge"),
    ]


CONTACTS = Value("contacts", "(body_a, body_b, point, normal)", "", "which bodies (c,), p and N (c, 3)")
BODIES = Value("bodies", "(mass, inverse_inertia, rotation, position)", "",
               "(n,), I^-1 in body axes (n, 3, 3), R (n, 3, 3), x (n, 3)")  # fmt: skip

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
    reference=entry(),
    cases=_entries,
    mistakes=(
        *(Mistake(name, entry(**options), message) for name, options, message in TOGETHER),
        Mistake("turned round", entry(whole=-1.0), "The whole has the wrong sign. A push at a contact opens its own "
                "gap: a_ii must be above 0."),
        Mistake("the other arm twice", entry(arms=lambda p, q, x, x_a: (p - x, p - x)), "Both arms go to the point "
                "that answers. The torque is made where the body is pushed: r_j = p_j - x."),
        Mistake("pushed along N_i", entry(normals=lambda n_i, n_j: (n_i, n_i)), "You push along the normal of the "
                "contact that answers. The force at j acts along N_j."),
        Mistake("not along N_i", entry(normals=lambda n_i, n_j: (np.eye(3), n_j)), "Your answer is the acceleration of "
                "the point, a vector. The gap feels its part along the normal: dot it with N_i."),
        Mistake("inertia for its inverse", entry(apply=lambda m, v: times(np.linalg.pinv(m), v)), "You invert the "
                "inertia once more: what is given is the inverse already. Only its axes have to be turned."),
        Mistake("normals left out", entry(dotted=False), "The first part is 1/m, as if both pushes had one "
                "direction. It is N_i.N_j/m."),
        Mistake("asked along N_j", entry(normals=lambda n_i, n_j: (n_j, n_j)), "You take the part of the answer along "
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
    reference=by_product,
    cases=_matrices,
    mistakes=(
        *(Mistake(name, matrix(**options), message) for name, options, message in ALIKE),
        Mistake("masses left out", without_masses, "This is J J'. Between the two stands M^-1: 1/m for the first three "
                "columns of a body, R I^-1 R' for the other three."),
        Mistake("masses for their inverses", with_masses, "Heavy bodies answer more in your A, and light ones less: M "
                "stands where M^-1 belongs."),
        Mistake("one triangle", matrix(shown=np.tril), "Only one triangle is filled. A is symmetric."),
        Mistake("diagonal alone", matrix(shown=lambda a: np.diag(np.diag(a))), "Only the diagonal is there. Contacts "
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
        "    J[rows, body] = sign * np.concatenate([normal, lever], axis=-1)\n"
        "world = rotation @ inverse_inertia @ np.swapaxes(rotation, -1, -2)\n"
        'turned = np.einsum("nij,cnj->cni", world, J[..., 3:])\n'
        "weighed = np.concatenate([J[..., :3] / mass[:, None], turned], axis=-1)\n"
        "return J.reshape(c, -1) @ ____.reshape(c, -1).T",
    ),
)  # fmt: skip


def _feet() -> str:
    from course.study.resting_scenes import table

    column = table().system().A.toarray()[1:, 0]
    if np.all(np.abs(column) < 1e-9):
        return "none"
    return "mixed" if column.min() < 0 < column.max() else "all"


def _top() -> float:
    from course.study import ladder

    return float(ladder(np.radians(60)).system().A.toarray()[1, 1])


def _legs() -> int:
    from course.study.resting_scenes import table

    return int(np.linalg.matrix_rank(table(8).system().A.toarray()))


PREDICTIONS = (
    Prediction(
        "feet",
        "The floor pushes up on foot 1 a little harder. What happens at once at the other three feet?",
        _feet,
        "All three feel it: the neighbours rise, and the foot across is driven down, because there the turning is "
        "stronger than the lift.",
        choices={
            "none": "nothing: only foot 1 is pushed",
            "all": "all three begin to rise with it",
            "mixed": "some begin to rise, at least one begins to go down",
        },
        later="See",
        wrong={
            "none": "A table is one body: push it anywhere, and all of it is accelerated.",
            "all": "The table rises as a whole, that is right. But it also turns about its centre of mass.",
        },
    ),
    Prediction(
        "ladder_diagonal",
        "The same ladder, 10 kg, 4 m, 60 degrees: what is a_22, what a unit of force at the top adds to d_ddot there?",
        _top,
        "The lever of the top is w_2 = 1.732 m, so a_22 = 1/10 + 3/13.33 = 0.325 1/kg: nearly twice a_11.",
        unit="1/kg",
        tolerance=0.01,
        wrong={
            0.1: "That is 1/m, as if the ladder could not turn. The push at the top acts off the centre.",
            0.175: "That is the foot's. At the top the normal is horizontal: another part of the arm lies across it.",
            0.4: "That is the whole arm, 2 m. Only the part of it that lies across N_2 counts: its z.",
            0.225: "That is the turning alone. The centre of mass is accelerated too, by 1/m.",
        },
    ),
    Prediction(
        "eight_legs",
        "A table on eight legs, all on one floor. How many of the eight columns of A are independent (its rank)?",
        _legs,
        "3. All normals are parallel, so the floor can only lift the table and tilt it about two axes. "
        "More legs add columns and nothing new.",
        tolerance=1e-9,
        wrong={
            8: "Each leg has its own column, but they depend on each other: the feet lie in one plane.",
            6: "A body can move in six ways. Pushes that all go up cannot make it slide or turn about the vertical.",
            4: "Three points carry a plane: the fourth foot's acceleration follows from the others.",
        },
    ),
)

LESSON = Lesson(
    number="15",
    name="contact-matrix",
    title="The contact matrix",
    question="Push on one foot of a table: which of the other feet feel it?",
    minutes=75,
    exercises=(LADDER_ENTRY, POINT_RESPONSE, CONTACT_MATRIX_ENTRY, CONTACT_MATRIX),
    predictions=PREDICTIONS,
)
