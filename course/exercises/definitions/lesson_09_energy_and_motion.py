"""Lesson 09: kinetic energy, the equations of turning, and steps in time."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

import numpy as np

from course.dynamics import angular_kinetic_energy, linear_kinetic_energy
from course.exercises.definition import Case, Exercise, Lesson, Mistake, Prediction, Property, Value
from course.exercises.definitions.turning import (
    all_from_the_first,
    brought_back,
    divided_by_zero,
    drawn_vectors,
    exponential,
    first_order,
    inertias,
    one_batch_axis_short,
    plain_step,
    rodrigues,
    rotation_matrices,
    runge_kutta,
    solved,
    stretched,
    times,
    transposed,
    turned_inertia,
)

I_BODY = Value("I_body", "(..., 3, 3)", "kg m²", "inertia about the centre of mass, body axes")
ANGULAR_MOMENTUM = Value("L", "(..., 3)", "kg m²/s", "angular momentum about the centre of mass, world axes")


# Inputs. Turned bodies whose inertia is not diagonal, L off omega, a step that is not small: each tells apart mistakes
# that agree where it is missing. Rotations have few decimals: those of whole quaternions of squared length 25.


def _plain(value: Any) -> Any:
    return value.item() if isinstance(value, np.ndarray) and value.ndim == 0 else value


# The two energies.


def _of_a_point(rng: np.random.Generator, shape: tuple[int, ...]) -> dict[str, Any]:
    velocity = drawn_vectors(rng, shape)
    mass = rng.uniform(1.5, 4.0, shape).round(1)
    return {"p": (mass[..., None] * velocity).round(6), "v": velocity}


def _of_a_turn(rng: np.random.Generator, shape: tuple[int, ...]) -> dict[str, Any]:
    omega = drawn_vectors(rng, shape)
    return {"L": times(inertias(rng, shape), omega).round(6), "omega": omega}


def _half_a_dot(one: Any, other: Any) -> np.ndarray:
    return 0.5 * np.sum(np.asarray(one) * other, axis=-1)


def _energy_mistakes(first: str, second: str) -> tuple[Mistake, ...]:
    """Slips in half a dot product of ``first`` and ``second``."""
    return (
        Mistake(
            "half forgotten",
            lambda a, b: np.sum(np.asarray(a) * b, axis=-1),
            f"Twice too much. {first}.{second} is m v^2 (or I omega^2); the energy is half of it: it is what the "
            "work of bringing the body up to speed adds up to.",
        ),
        Mistake(
            "not summed",
            lambda a, b: 0.5 * np.asarray(a) * b,
            "These are three products, component by component. A dot product is their sum over the last axis: an "
            "energy is one number for each body.",
        ),
        Mistake(
            "summed over the batch",
            lambda a, b: 0.5 * np.sum(np.asarray(a) * b),
            "np.sum without an axis adds up the whole batch. Sum over the last axis only, axis=-1: one energy for "
            "each body.",
        ),
        Mistake(
            "np.dot",
            lambda a, b: 0.5 * np.dot(a, b),
            "np.dot is right for two vectors; of two batches it makes a matrix product. np.sum(a * b, axis=-1) "
            "serves both.",
        ),
    )


LINEAR = Exercise(
    name="linear_kinetic_energy",
    rows=(14,),
    points=1,
    minutes=4,
    task="Return p.v/2, the kinetic energy of the motion of the centre of mass.",
    arguments=(
        Value("p", "(..., 3)", "kg m/s", "momentum"),
        Value("v", "(..., 3)", "m/s", "velocity of the centre of mass"),
    ),
    results=(Value("energy", "(...)", "J"),),
    reference=linear_kinetic_energy,
    cases=lambda rng: [
        Case("2 kg at 3 m/s along x", {"p": np.array([6.0, 0.0, 0.0]), "v": np.array([3.0, 0.0, 0.0])}),
        Case("off the axes", _of_a_point(rng, ())),
        Case("at rest", {"p": np.zeros(3), "v": np.zeros(3)}, "edge"),
        Case("three bodies, as many as a vector has components", _of_a_point(rng, (3,)), "batch"),
        Case("five bodies", _of_a_point(rng, (5,)), "batch"),
        Case("a 2 by 4 batch", _of_a_point(rng, (2, 4)), "batch"),
    ],
    mistakes=(
        *_energy_mistakes("p", "v"),
        Mistake(
            "velocity twice",
            lambda p, v: _half_a_dot(v, v),
            "v.v/2 has no mass in it: it is the energy of one kilogram. The mass sits in p = m v: use p once and v "
            "once.",
        ),
        Mistake(
            "momentum twice",
            lambda p, v: _half_a_dot(p, p),
            "p.p/2 holds the mass twice, in kg J. p.p/(2 m) would be right; with v at hand, take p.v/2.",
        ),
    ),
    hints=(
        "Read the formula under On the slide: a number for each body, from two vectors.",
        "A dot product over a batch is np.sum(a * b, axis=-1). Then the half.",
        "return 0.5 * np.sum(____ * ____, axis=-1)",
    ),
)

ANGULAR = Exercise(
    name="angular_kinetic_energy",
    rows=(14,),
    points=1,
    minutes=4,
    task="Return L.omega/2, the kinetic energy of turning about the centre of mass.",
    arguments=(
        Value("L", "(..., 3)", "kg m²/s", "angular momentum about the centre of mass"),
        Value("omega", "(..., 3)", "rad/s", "angular velocity"),
    ),
    results=(Value("energy", "(...)", "J"),),
    reference=angular_kinetic_energy,
    cases=lambda rng: [
        Case("the case by hand", {"L": np.array([1.0, 4.0, 0.0]), "omega": np.array([1.0, 2.0, 0.0])}),
        Case("off the axes", _of_a_turn(rng, ())),
        Case("not turning", {"L": np.zeros(3), "omega": np.zeros(3)}, "edge"),
        Case("three bodies, as many as a vector has components", _of_a_turn(rng, (3,)), "batch"),
        Case("five bodies", _of_a_turn(rng, (5,)), "batch"),
        Case("a 2 by 4 batch", _of_a_turn(rng, (2, 4)), "batch"),
    ],
    mistakes=(
        *_energy_mistakes("L", "omega"),
        Mistake(
            "lengths",
            lambda L, omega: 0.5 * np.linalg.norm(L, axis=-1) * np.linalg.norm(omega, axis=-1),
            "|L||omega|/2 would be right if L pointed along omega. It does not, for a body that is no ball: the dot "
            "product takes the cosine of the angle between them into account.",
        ),
        Mistake(
            "omega twice",
            lambda L, omega: _half_a_dot(omega, omega),
            "omega.omega/2 has no inertia in it. The inertia sits in L = I omega: use L once and omega once.",
        ),
        Mistake(
            "cross product",
            lambda L, omega: 0.5 * np.cross(L, omega),
            "This is a cross product, a vector. The energy is a number: half the dot product. (You will need L x "
            "omega soon, for another purpose.)",
        ),
    ),
    hints=(
        "It is the function before this one with other letters.",
        "Half the dot product of L and omega over the last axis. Their lengths alone would not do: they point in "
        "different directions.",
        "return 0.5 * np.sum(____ * ____, axis=-1)",
    ),
)


# world_inertia


def _oriented(rng: np.random.Generator, shape: tuple[int, ...]) -> dict[str, Any]:
    return {"R": rotation_matrices(rng, shape), "I_body": inertias(rng, shape)}


QUARTER_TURN = np.array([[0.0, -1.0, 0.0], [1.0, 0.0, 0.0], [0.0, 0.0, 1.0]])

WORLD_INERTIA = Exercise(
    name="world_inertia",
    rows=(14, 22),
    points=1,
    minutes=7,
    task="Return the inertia in world axes, R I_body R'.",
    arguments=(Value("R", "(..., 3, 3)", "", "rotation, columns the body's axes in the world"), I_BODY),
    results=(Value("I", "(..., 3, 3)", "kg m²", "inertia in world axes"),),
    reference=turned_inertia,
    cases=lambda rng: [
        Case("a quarter turn about z", {"R": QUARTER_TURN, "I_body": np.diag([1.0, 2.0, 3.0])}),
        Case("turned about a slanted axis", _oriented(rng, ())),
        Case("not turned", {"R": np.eye(3), "I_body": inertias(rng, ())}, "edge"),
        Case("four bodies", _oriented(rng, (4,)), "batch"),
        Case("three bodies, as many as a vector has components", _oriented(rng, (3,)), "batch"),
        Case("a 2 by 3 batch", _oriented(rng, (2, 3)), "batch"),
    ],
    properties=(
        Property(
            "symmetric",
            lambda given, answer: answer - transposed(answer),
            "Your matrix is not symmetric. An inertia is, in whatever axes.",
        ),
        Property(
            "same moments",
            lambda given, answer: np.trace(answer, axis1=-2, axis2=-1) - np.trace(given["I_body"], axis1=-2, axis2=-1),
            "The sum of the diagonal changes. Turning a body changes no principal moment, so it keeps their sum.",
        ),
    ),
    mistakes=(
        Mistake(
            "body axes",
            lambda R, I_body: np.asarray(I_body) * np.ones(np.shape(R)),
            "This is the inertia in body axes: R is not used. It is right only while the body is not turned.",
        ),
        Mistake(
            "the other way round",
            lambda R, I_body: transposed(R) @ I_body @ R,
            "R' I R turns the other way. Read from right to left: R' takes a world vector to body axes, I acts "
            "there, R brings it back.",
        ),
        Mistake(
            "one side only",
            lambda R, I_body: np.asarray(R) @ I_body,
            "Only one rotation. A matrix is turned on both sides: its input comes in world axes (R' first) and its "
            "output must go back to them (R last).",
        ),
        Mistake(
            "not transposed",
            lambda R, I_body: np.asarray(R) @ I_body @ R,
            "The right-hand R must be transposed: R' takes a world vector to body axes.",
        ),
        Mistake(
            ".T of a batch",
            lambda R, I_body: np.asarray(R) @ I_body @ np.asarray(R).T,
            "Right for one body, not for a batch: .T turns *all* axes round. np.swapaxes(R, -1, -2) swaps the last "
            "two.",
        ),
        Mistake(
            "products of entries",
            lambda R, I_body: np.asarray(R) * I_body * transposed(R),
            "* multiplies entry by entry. The product of matrices is @.",
        ),
    ),
    hints=(
        "Take a world vector omega through it: I omega must be R (I_body (R' omega)).",
        "Three matrices multiplied with @. The transpose over a batch is np.swapaxes(R, -1, -2).",
        "return R @ ____ @ np.swapaxes(____, -1, -2)",
    ),
)


# angular_acceleration


def _spinning(rng: np.random.Generator, shape: tuple[int, ...], **fixed: Any) -> dict[str, Any]:
    drawn = {
        "I": turned_inertia(rotation_matrices(rng, shape), inertias(rng, shape)).round(3),
        "L": drawn_vectors(rng, shape, 2.0),
        "torque": drawn_vectors(rng, shape),
    }
    return {**drawn, **fixed}


def _angular_acceleration(I: Any, L: Any, torque: Any) -> np.ndarray:  # noqa: E741
    return solved(I, np.asarray(torque) + np.cross(L, solved(I, L)))


ANGULAR_ACCELERATION = Exercise(
    name="angular_acceleration",
    rows=(14, 23),
    points=2,
    minutes=10,
    task="Return omega_dot = I^-1 (torque + L x omega), with omega = I^-1 L.",
    arguments=(
        Value("I", "(..., 3, 3)", "kg m²", "inertia, world axes"),
        ANGULAR_MOMENTUM,
        Value("torque", "(..., 3)", "N m", "torque about the centre of mass, world axes"),
    ),
    results=(Value("omega_dot", "(..., 3)", "rad/s²"),),
    reference=_angular_acceleration,
    cases=lambda rng: [
        Case("the case by hand, no torque", {"I": np.diag([1.0, 2.0, 3.0]), "L": np.array([1.0, 4.0, 0.0]),
                                             "torque": np.zeros(3)}),
        Case("turned, with a torque", _spinning(rng, ())),
        Case("turned, no torque", _spinning(rng, (), torque=np.zeros(3))),
        Case("about a principal axis, no torque", {"I": np.diag([1.0, 2.0, 3.0]), "L": np.array([0.0, 4.0, 0.0]),
                                                   "torque": np.zeros(3)}, "edge"),
        Case("at rest, with a torque", _spinning(rng, (), L=np.zeros(3)), "edge"),
        Case("five bodies", _spinning(rng, (5,)), "batch"),
        Case("three bodies, as many as a vector has components", _spinning(rng, (3,)), "batch"),
        Case("a 2 by 4 batch", _spinning(rng, (2, 4)), "batch"),
    ],  # fmt: skip
    mistakes=(
        Mistake(
            "I alpha",
            lambda I, L, torque: solved(I, torque),  # noqa: E741
            "This is N = I alpha as the slide prints it. I turns with the body, so torque = d(I omega)/dt holds one "
            "term more: without torque omega would never change, and the handle would never turn over.",
        ),
        Mistake(
            "omega x L",
            lambda I, L, torque: solved(I, np.asarray(torque) - np.cross(L, solved(I, L))),  # noqa: E741
            "The cross product is the wrong way round: torque = I omega_dot + omega x L, and brought to the other "
            "side it is L x omega.",
        ),
        Mistake(
            "L in place of L x omega",
            lambda I, L, torque: solved(I, np.asarray(torque) + L),  # noqa: E741
            "This is I^-1 (torque + L), as a slide prints it. L is no torque (look at the units): it is L x omega.",
        ),
        Mistake(
            "inverse on the torque only",
            lambda I, L, torque: solved(I, torque) + np.cross(L, solved(I, L)),  # noqa: E741
            "I^-1 acts on the torque only. It belongs before the bracket: I^-1 (torque + L x omega).",
        ),
        Mistake(
            "torque forgotten",
            lambda I, L, torque: solved(I, np.cross(L, solved(I, L))),  # noqa: E741
            "The torque is missing: add it to L x omega before you apply I^-1.",
        ),
        Mistake(
            "I in place of its inverse",
            lambda I, L, torque: times(I, np.asarray(torque) + np.cross(L, solved(I, L))),  # noqa: E741
            "You multiply by I at the end where you must divide: I omega_dot is the bracket, and np.linalg.solve(I, "
            "...) gives omega_dot.",
        ),
        Mistake(
            "diagonal only",
            lambda I, L, torque: (  # noqa: E741
                np.asarray(torque) + np.cross(L, np.asarray(L) / np.diagonal(I, axis1=-2, axis2=-1))
            ) / np.diagonal(I, axis1=-2, axis2=-1),
            "You divide by the diagonal of I. In world axes I has entries off its diagonal, and dividing by a matrix "
            "is np.linalg.solve.",
        ),
        Mistake(
            "solve without a column",
            lambda I, L, torque: np.linalg.solve(I, np.asarray(torque) + np.cross(L, np.linalg.solve(I, L))),  # noqa: E741
            "Right for one body, not for a batch: np.linalg.solve takes a batch of vectors for one matrix. Make each "
            "a column and take it back: np.linalg.solve(I, x[..., None])[..., 0].",
        ),
    ),
    hints=(
        "First omega from L, then the cross product, then the bracket, then I^-1 once more.",
        "np.linalg.solve(I, x[..., None])[..., 0] is I^-1 x for one body and for a batch. np.cross(a, b) works on "
        "the last axis.",
        "omega = np.linalg.solve(I, L[..., None])[..., 0]\n"
        "return np.linalg.solve(I, (____ + np.cross(____, ____))[..., None])[..., 0]",
    ),
)


# sigma, the student's own step of the derivation, as an expression.


def _sigma(I_1: Any, I_2: Any, I_3: Any, Omega: Any) -> Any:
    # Not np.sqrt: a notebook also runs it on SymPy symbols.
    return Omega * ((I_2 - I_1) * (I_3 - I_2) / (I_1 * I_3)) ** 0.5


def _moments_drawn(rng: np.random.Generator) -> Sequence[Case]:
    least = rng.uniform(1.0, 1.5, 8)
    middle = least + rng.uniform(0.4, 1.0, 8)
    draws = {"I_1": least, "I_2": middle, "I_3": middle + rng.uniform(0.3, 0.9, 8), "Omega": rng.uniform(2.0, 5.0, 8)}
    by_hand = {"I_1": 1.0, "I_2": 2.0, "I_3": 3.0, "Omega": 6.0}
    return [Case("moments 1, 2, 3 and 6 rad/s", by_hand), Case("eight drawn points", draws, "batch")]


SIGMA = Exercise(
    name="sigma",
    kind="expression",
    rows=(14,),
    points=2,
    minutes=8,
    task="Give the growth rate sigma > 0 in the symbols I_1 < I_2 < I_3 and Omega.",
    arguments=(
        Value("I_1", "scalar", "kg m²", "least moment"),
        Value("I_2", "scalar", "kg m²", "middle moment"),
        Value("I_3", "scalar", "kg m²", "largest moment"),
        Value("Omega", "scalar", "rad/s", "spin about the middle axis"),
    ),
    results=(Value("sigma", "(...)", "1/s"),),
    reference=_sigma,
    cases=_moments_drawn,
    mistakes=(
        Mistake(
            "square",
            lambda I_1, I_2, I_3, Omega: _sigma(I_1, I_2, I_3, Omega) ** 2,
            "This is sigma^2: the second rate of exp(sigma t) is sigma^2 exp(sigma t). Take the root.",
        ),
        Mistake(
            "negative root",
            lambda I_1, I_2, I_3, Omega: -_sigma(I_1, I_2, I_3, Omega),
            "This is the root that dies away. Both solve the equation; the one that grows is the positive one.",
        ),
        Mistake(
            "imaginary",
            lambda I_1, I_2, I_3, Omega: Omega * np.sqrt((I_2 - I_3) * (I_2 - I_1) / (I_1 * I_3)),
            "What stands under your root is negative. The product of the two brackets is (I_2 - I_3)(I_1 - I_2): "
            "turn both round, and it is positive for the middle axis.",
        ),
        Mistake(
            "no spin",
            lambda I_1, I_2, I_3, Omega: _sigma(I_1, I_2, I_3, 1.0) + 0 * Omega,
            "Omega is missing: each of the two equations has it once, so sigma^2 has it twice.",
        ),
        Mistake(
            "spin under the root",
            lambda I_1, I_2, I_3, Omega: _sigma(I_1, I_2, I_3, 1.0) * np.sqrt(Omega),
            "Omega stands under your root once. Each of the two equations has it once, so their product has Omega^2.",
        ),
        Mistake(
            "not divided",
            lambda I_1, I_2, I_3, Omega: Omega * np.sqrt((I_2 - I_1) * (I_3 - I_2)),
            "The moments on the left are missing: divide the first equation by I_1, the second by I_3, before you "
            "put one into the other.",
        ),
        Mistake(
            "divided by one moment",
            lambda I_1, I_2, I_3, Omega: Omega * np.sqrt((I_2 - I_1) * (I_3 - I_2)) / I_2,
            "You divide by I_2. Nothing on the left has I_2: the moments there are I_1 and I_3.",
        ),
        Mistake(
            "one bracket",
            lambda I_1, I_2, I_3, Omega: Omega * (I_3 - I_1) / np.sqrt(I_1 * I_3),
            "The difference I_3 - I_1 belongs to the equation of the middle axis itself. The two that you need have "
            "I_2 - I_3 and I_1 - I_2.",
        ),
    ),
    hints=(
        "Two equations, each a rate: put the second into the rate of the first, and only omega_1 is left.",
        "omega_1'' = (a number) omega_1 grows as exp(sigma t), and sigma^2 is that number. It holds both brackets "
        "and Omega twice.",
        "sigma = Omega * sp.sqrt((____ - ____) * (____ - ____) / (I_1 * ____))",
    ),
)


# symplectic_euler_step


def _moving(rng: np.random.Generator, shape: tuple[int, ...], **fixed: Any) -> dict[str, Any]:
    drawn = {
        "x": drawn_vectors(rng, shape),
        "R": rotation_matrices(rng, shape),
        "p": drawn_vectors(rng, shape, 3.0),
        "L": drawn_vectors(rng, shape, 2.0),
        "mass": _plain(np.round(rng.uniform(1.5, 4.0, shape), 1)),
        "I_body": inertias(rng, shape),
        "force": drawn_vectors(rng, shape, 4.0),
        "torque": drawn_vectors(rng, shape, 2.0),
        "h": 0.3,
    }
    return {**drawn, **fixed}


AT_THE_ORIGIN = {
    "x": np.zeros(3),
    "R": np.eye(3),
    "p": np.array([1.0, 0.0, 0.0]),
    "L": np.array([0.0, 0.0, 6.0]),
    "mass": 2.0,
    "I_body": np.diag([1.0, 2.0, 3.0]),
    "force": np.array([0.0, 0.0, -20.0]),
    "torque": np.zeros(3),
    "h": 0.1,
}

SYMPLECTIC_EULER_STEP = Exercise(
    name="symplectic_euler_step",
    rows=(14, 22),
    points=3,
    minutes=14,
    task="Return x, R, p and L one step on: momenta first, then place and orientation with the new momenta.",
    arguments=(
        Value("x", "(..., 3)", "m", "position of the centre of mass"),
        Value("R", "(..., 3, 3)", "", "rotation, columns the body's axes in the world"),
        Value("p", "(..., 3)", "kg m/s", "momentum"),
        ANGULAR_MOMENTUM,
        Value("mass", "(...)", "kg"),
        I_BODY,
        Value("force", "(..., 3)", "N", "at the start of the step"),
        Value("torque", "(..., 3)", "N m", "at the start of the step, about the centre of mass"),
        Value("h", "scalar", "s", "the step"),
    ),
    results=(
        Value("x", "(..., 3)", "m"),
        Value("R", "(..., 3, 3)", ""),
        Value("p", "(..., 3)", "kg m/s"),
        Value("L", "(..., 3)", "kg m²/s"),
    ),
    reference=plain_step(),
    cases=lambda rng: [
        Case("a spinning body falls", AT_THE_ORIGIN),
        Case("pushed and twisted", _moving(rng, ())),
        Case("pushed and twisted again", _moving(rng, ())),
        Case("nothing acts", _moving(rng, (), force=np.zeros(3), torque=np.zeros(3)), "edge"),
        Case("neither moving nor turning, nothing acts",
             _moving(rng, (), p=np.zeros(3), L=np.zeros(3), force=np.zeros(3), torque=np.zeros(3)), "edge"),
        Case("a step back in time", _moving(rng, (), h=-0.2), "edge"),
        Case("five bodies", _moving(rng, (5,)), "batch"),
        Case("three bodies, as many as a vector has components", _moving(rng, (3,)), "batch"),
        Case("a 2 by 4 batch", _moving(rng, (2, 4)), "batch"),
    ],  # fmt: skip
    properties=(
        Property(
            "rotation",
            lambda given, answer: answer[1] @ transposed(answer[1]) - np.eye(3),
            "Your R is no rotation any more: its columns are not unit vectors at right angles.",
        ),
    ),
    mistakes=(
        Mistake(
            "explicit Euler",
            plain_step(x_from="old", turn_from="old"),
            "You move and turn with the momenta from before the step: that is explicit Euler. Here the *new* momenta "
            "move the body; on a spring this one line decides whether it gains energy without end.",
        ),
        Mistake(
            "moved with the old momentum",
            plain_step(x_from="old"),
            "The turn uses the new L, but the position still the old p. Take p' in x' = x + h p'/m.",
        ),
        Mistake(
            "turned with the old momentum",
            plain_step(turn_from="old"),
            "The position uses the new p, but the turn still the old L. Take L' in omega' = I^-1 L'.",
        ),
        Mistake(
            "body-frame inertia",
            plain_step(frame="body"),
            "omega = I_body^-1 L mixes axes: L is in world axes, I_body in those of the body. Turn the inertia "
            "first, R I_body R'.",
        ),
        Mistake(
            "omega in body axes",
            plain_step(frame="half"),
            "Your omega = I_body^-1 R' L is right, but in body axes, and the turn is about a world axis. Bring it "
            "back with R.",
        ),
        Mistake(
            "mass forgotten",
            plain_step(divide=False),
            "x' = x + h p' adds a momentum to a position. The velocity is p'/m.",
        ),
        Mistake(
            "step forgotten in the momenta",
            plain_step(timed=False),
            "You add the whole force and torque, as if the step were one second. Momentum changes by force times "
            "time, h F.",
        ),
        Mistake(
            "torque forgotten",
            plain_step(twisted=False),
            "L stays as it was. It changes by h times the torque, as p does by h times the force.",
        ),
        Mistake(
            "force forgotten",
            plain_step(pushed=False),
            "p stays as it was. It changes by h times the force.",
        ),
        Mistake(
            "turned by a second's worth",
            plain_step(turned=lambda R, omega, h: exponential(omega) @ R),
            "You turn by omega, the angle of one second. In a step the body turns by the rotation vector h omega.",
        ),
        Mistake(
            "order of the turns",
            plain_step(turned=lambda R, omega, h: R @ exponential(h * omega)),
            "turn @ R and R @ turn are different. omega is in world axes, so the turn comes after R, on its left.",
        ),
        Mistake(
            "added, not turned",
            plain_step(turned=first_order),
            "You add h omega x R to R. That is explicit Euler on nine numbers: its columns get longer at every step. "
            "Use the rotation matrix of the rotation vector h omega.",
        ),
        Mistake(
            "not turned",
            plain_step(turned=lambda R, omega, h: R),
            "R stays as it was. The body turns by the rotation vector h omega'.",
        ),
        Mistake(
            "one batch axis short",
            one_batch_axis_short,
            "Right for one body, not for a batch: mass has shape (...) and p (..., 3), so mass needs one more axis, "
            "np.asarray(mass)[..., None].",
        ),
    ),
    hints=(
        "Four lines in this order: p', L', x', R'. Each line uses the newest values there are, but R inside the "
        "inertia is still the old one.",
        "omega' is I^-1 L' with the inertia of the exercise before last. Rotation.from_rotvec(theta).as_matrix() is "
        "the rotation matrix of a rotation vector; it multiplies R from the left.",
        "p, L = p + h * force, L + h * torque\n"
        "omega = np.linalg.solve(____, L[..., None])[..., 0]\n"
        "turn = Rotation.from_rotvec(____).as_matrix()\n"
        "return x + h * ____, turn @ R, p, L",
    ),
)


# rotate (stretch): Rodrigues' formula


def _rotate(v: Any, theta: Any) -> np.ndarray:
    return times(exponential(theta), v)


def _turning(rng: np.random.Generator, shape: tuple[int, ...], **fixed: Any) -> dict[str, Any]:
    return {"v": drawn_vectors(rng, shape), "theta": drawn_vectors(rng, shape), **fixed}


ROTATE = Exercise(
    name="rotate",
    rows=(14,),
    points=2,
    minutes=12,
    level="stretch",
    task="Return v turned by the angle |theta| about the axis theta/|theta| (the exponential map).",
    arguments=(
        Value("v", "(..., 3)", "", "vectors"),
        Value("theta", "(..., 3)", "rad", "rotation vectors: axis times angle"),
    ),
    results=(Value("turned", "(..., 3)", ""),),
    reference=_rotate,
    cases=lambda rng: [
        Case("a quarter turn about z", {"v": np.array([1.0, 0.0, 2.0]), "theta": np.array([0.0, 0.0, np.pi / 2])}),
        Case("about a slanted axis", _turning(rng, ())),
        Case("no turn", _turning(rng, (), theta=np.zeros(3)), "edge"),
        Case("a tiny turn", _turning(rng, (), theta=np.array([3e-9, 0.0, 4e-9])), "edge"),
        Case("more than a whole turn", _turning(rng, (), theta=np.array([0.0, 6.0, 4.0])), "edge"),
        Case("five vectors", _turning(rng, (5,)), "batch"),
        Case("three vectors, one of them not turned",
             _turning(rng, (3,), theta=np.array([[0.5, 0.2, -1.0], [0.0, 0.0, 0.0], [2.0, 0.3, 0.4]])), "batch"),
        Case("a 2 by 4 batch", _turning(rng, (2, 4)), "batch"),
    ],  # fmt: skip
    properties=(
        Property(
            "length",
            lambda given, answer: np.linalg.norm(answer, axis=-1) - np.linalg.norm(given["v"], axis=-1),
            "The length of v changes. A turn keeps it.",
        ),
    ),
    mistakes=(
        Mistake(
            "zero angle",
            divided_by_zero,
            "NaN where nothing turns: theta/|theta| is 0/0 there. Divide by np.where(angle > 0, angle, 1.0).",
        ),
        Mistake(
            "the other way",
            rodrigues(sign=-1.0),
            "It turns the other way. By the right hand, a vector moves along theta x v, not v x theta.",
        ),
        Mistake(
            "last term forgotten",
            rodrigues(across=0.0),
            "The part of v along the axis shrinks by the cosine. It must stay: the term (1 - cos) (u.v) u gives it "
            "back.",
        ),
        Mistake(
            "half the angle",
            rodrigues(half=0.5),
            "It turns by half the angle. That half belongs to quaternions, which act twice; here the whole angle "
            "counts.",
        ),
        Mistake(
            "axis not of unit length",
            rodrigues(unit=False),
            "You use theta itself as the axis. The axis is u = theta/|theta|, of unit length; the angle is |theta|.",
        ),
        Mistake(
            "first order",
            stretched,
            "v + theta x v is explicit Euler: right for tiny angles only, and longer than v at every step.",
        ),
        Mistake(
            "first order, brought back",
            brought_back,
            "v + theta x v, brought back to its length, turns by arctan|theta| at most, not by |theta|, and what "
            "lies along the axis is lost from step to step.",
        ),
    ),
    hints=(
        "Split v into a part along the axis, which stays, and a part across it, which turns in its plane.",
        "With u the unit axis: cos times v, plus sin times u x v, plus (1 - cos) times (u.v) u. Keep the last axis "
        "of the angle: keepdims=True.",
        "angle = np.linalg.norm(theta, axis=-1, keepdims=True)\n"
        "u = theta / np.where(angle > 0, angle, 1.0)\n"
        "along = np.sum(u * v, axis=-1, keepdims=True) * u\n"
        "return np.cos(angle) * v + np.sin(angle) * np.cross(____, ____) + (1 - np.cos(angle)) * ____",
    ),
)


# rk4_step (stretch): the torque-free top in body axes


def _tops(rng: np.random.Generator, shape: tuple[int, ...], **fixed: Any) -> dict[str, Any]:
    return {"l": drawn_vectors(rng, shape, 2.0), "I_body": inertias(rng, shape), "h": 0.2, **fixed}


_FOUR = (0.5, 0.5, 1.0)

RK4_STEP = Exercise(
    name="rk4_step",
    rows=(14,),
    points=2,
    minutes=12,
    level="stretch",
    task=(
        "Return l one step on by the classical Runge-Kutta method; without torque l changes at the rate l x "
        "I_body^-1 l."
    ),
    arguments=(
        Value("l", "(..., 3)", "kg m²/s", "angular momentum in body axes"),
        I_BODY,
        Value("h", "scalar", "s", "the step"),
    ),
    results=(Value("l", "(..., 3)", "kg m²/s"),),
    reference=runge_kutta(_FOUR, (1 / 6, 1 / 3, 1 / 3, 1 / 6)),
    cases=lambda rng: [
        Case("moments 1, 2, 3", {"l": np.array([1.0, 4.0, 0.0]), "I_body": np.diag([1.0, 2.0, 3.0]), "h": 0.1}),
        Case("axes that are not principal", _tops(rng, ())),
        Case("about a principal axis", {"l": np.array([0.0, 4.0, 0.0]), "I_body": np.diag([1.0, 2.0, 3.0]), "h": 0.1},
             "edge"),
        Case("a step back in time", _tops(rng, (), h=-0.2), "edge"),
        Case("five tops", _tops(rng, (5,)), "batch"),
        Case("three tops, as many as a vector has components", _tops(rng, (3,)), "batch"),
        Case("a 2 by 4 batch", _tops(rng, (2, 4)), "batch"),
    ],  # fmt: skip
    mistakes=(
        Mistake(
            "sign of the rate",
            runge_kutta(_FOUR, (1 / 6, 1 / 3, 1 / 3, 1 / 6), sign=-1.0),
            "The rate is omega x l; without torque it is l x omega in body axes: L stands still and the body turns "
            "away under it.",
        ),
        Mistake(
            "equal weights",
            runge_kutta(_FOUR, (0.25, 0.25, 0.25, 0.25)),
            "All four rates count the same. The two in the middle of the step count twice: (k1 + 2 k2 + 2 k3 + "
            "k4)/6.",
        ),
        Mistake(
            "explicit Euler",
            runge_kutta((), (1.0,)),
            "This is explicit Euler, the first of the four rates alone.",
        ),
        Mistake(
            "midpoint",
            runge_kutta((0.5,), (0.0, 1.0)),
            "This is the midpoint method, of order 2: two of the four rates are missing.",
        ),
        Mistake(
            "full steps",
            runge_kutta((1.0, 1.0, 1.0), (1 / 6, 1 / 3, 1 / 3, 1 / 6)),
            "k2 and k3 are taken at the end of the step. They belong in its middle: l + h/2 k1 and l + h/2 k2.",
        ),
        Mistake(
            "half at the end",
            runge_kutta((0.5, 0.5, 0.5), (1 / 6, 1 / 3, 1 / 3, 1 / 6)),
            "k4 is taken in the middle of the step. It belongs at its end: l + h k3.",
        ),
        Mistake(
            "all from k1",
            all_from_the_first,
            "k3 and k4 start from k1. Each rate is taken where the one *before* it leads: k3 at l + h/2 k2, k4 at "
            "l + h k3.",
        ),
        Mistake(
            "sixth forgotten",
            runge_kutta(_FOUR, (1.0, 2.0, 2.0, 1.0)),
            "The weights 1, 2, 2, 1 add up to 6: divide by 6, or the step is six steps long.",
        ),
    ),
    hints=(
        "Write the rate as a function of l first; RK4 calls it four times.",
        "k1 at the start, k2 and k3 in the middle (each from the one before), k4 at the end; then their mean with "
        "the weights 1, 2, 2, 1.",
        "k1 = rate(l)\nk2 = rate(l + h / 2 * k1)\nk3 = rate(____)\nk4 = rate(____)\n"
        "return l + h / 6 * (k1 + ____ * k2 + ____ * k3 + k4)",
    ),
)


# Predictions: the top is the lesson's handle, its truth the exact motion.


def _what_L_does() -> str:
    from course.dynamics import explicit_euler
    from course.study.tumbling import free_tumble, spinning_handle

    # By steps, which are free to change L, half a second past the first turning over.
    start = bodies = spinning_handle()
    for _ in range(200):
        bodies = explicit_euler(bodies, None, 0.01)
    turned = float(free_tumble(start, [2.0]).seen_from_body[0, 1]) < 0
    along = float(np.sum(bodies.angular_momentum * start.angular_momentum))
    size = float(np.sum(start.angular_momentum**2))
    return "stays" if turned and along > 0.999 * size else "turns" if along < 0 else "shrinks"


def _first_turnover(degrees: float) -> float:
    from course.study.tumbling import free_tumble, spinning_handle, turnover_times

    motion = free_tumble(spinning_handle(tilt=np.radians(degrees)), np.linspace(0.0, 6.0, 1201))
    return float(turnover_times(motion)[0])


def _spring_growth() -> float:
    from course.dynamics import explicit_euler
    from course.study.stability import oscillator_growth

    steps = round(10 * 2 * np.pi / 0.1)
    return float(oscillator_growth(explicit_euler, 0.1, steps=steps)) ** steps


PREDICTIONS = (
    Prediction(
        "handle",
        "No torque acts on the handle. While it turns over, what does its angular momentum L do?",
        _what_L_does,
        "No torque, no change of L: that is what a torque is. It is the handle that turns about the L that stays.",
        choices={
            "turns": "it turns over with the handle",
            "shrinks": "it shrinks to zero and grows again, pointing the other way",
            "stays": "it stays as it is",
        },
        later="See",
        wrong={
            "turns": "L is not fixed to the body. It is the body's inertia times omega, and neither of them stays.",
            "shrinks": "Then something outside would have taken the angular momentum and given it back.",
        },
    ),
    Prediction(
        "half_example",
        "The body by hand, moments 1, 2 and 3 kg m^2, now with omega = (1, 0, 2) rad/s. What is T_angular?",
        lambda: float(angular_kinetic_energy(np.array([1.0, 0.0, 6.0]), np.array([1.0, 0.0, 2.0]))),
        "L = (1, 0, 6), L.omega = 1 + 12, and half of that is 6.5 J.",
        unit="J",
        tolerance=1e-6,
        wrong={
            13.0: "The half is missing.",
            2.5: "omega.omega/2: the moments are missing.",
            5.0: "This is omega.omega: the moments and the half are missing.",
        },
    ),
    Prediction(
        "careful",
        "Tilted by 1 degree at the start, the handle lies on its side after 1.56 s. Let it go ten times more "
        "carefully, tilted by 0.1 degree. After how many seconds does it lie on its side?",
        lambda: _first_turnover(0.1),
        "A tilt that grows as exp(sigma t) needs ln(10)/sigma = 0.68 s more to become ten times larger, whatever its "
        "size. Each further digit of care buys the same 0.68 s.",
        unit="s",
        tolerance=0.08,
        wrong={
            15.6: "Ten times the care is not ten times the time: the tilt grows exponentially.",
            4.93: "The root of ten would fit a tilt that grows with the square of time.",
            1.56: "The care does count, but only by its logarithm.",
        },
    ),
    Prediction(
        "spring",
        "A weight swings on a spring without friction. A program moves it by explicit Euler with 63 steps a swing. "
        "By what factor has its energy grown after ten swings?",
        _spring_growth,
        "Each step multiplies the energy by 1 + 0.1^2 = 1.01, and 1.01 to the power 628 is 518.",
        tolerance=0.2,
        wrong={
            1: "So it should be. Explicit Euler does not know it.",
            7.28: (
                "628 steps of one percent each, added: but each step takes its percent of all that the ones before "
                "made."
            ),
            1.1: "One percent a swing? It is one percent a step.",
        },
    ),
)

LESSON = Lesson(
    number="09",
    name="energy-and-motion",
    title="Energy and motion",
    question="No torque acts on the handle in space: why does it flip, and how soon?",
    minutes=75,
    exercises=(
        SIGMA,
        LINEAR,
        ANGULAR,
        WORLD_INERTIA,
        ANGULAR_ACCELERATION,
        SYMPLECTIC_EULER_STEP,
        ROTATE,
        RK4_STEP,
    ),
    predictions=PREDICTIONS,
)
