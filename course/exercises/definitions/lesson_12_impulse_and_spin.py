"""Lesson 12: impulses on bodies that turn, and laws for many contacts at once."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from typing import Any

import numpy as np

from course.dynamics import impulse
from course.exercises.definition import Case, Exercise, Lesson, Mistake, Prediction, Property, Value

RESTITUTION = Value("restitution", "(...)", "", "e, from 0 to 1")
NORMAL = Value("normal", "(..., 3)", "", "unit vector out of body 2 toward body 1")


# Inputs. Normals off the axes, inertia tensors that are not diagonal, and two unlike bodies: each of them tells apart
# two mistakes that agree where it is missing. Numbers are short, because counterexamples print them.

UNIT = np.array([[0.48, 0.6, 0.64], [0.36, 0.48, 0.8]])  # exactly of length 1


def _unit(rng: np.random.Generator, shape: tuple[int, ...]) -> np.ndarray:
    """Unit vectors of two decimals: one of UNIT, its entries in any order and of any sign."""
    chosen = rng.permuted(UNIT[rng.integers(0, 2, shape)], axis=-1)
    return chosen * rng.choice([-1.0, 1.0], (*shape, 3))


def _vector(rng: np.random.Generator, shape: tuple[int, ...], size: float = 1.0) -> np.ndarray:
    """Vectors of two decimals, no entry near 0."""
    return np.round(rng.uniform(0.3, 1.5, (*shape, 3)) * size * rng.choice([-1.0, 1.0], (*shape, 3)), 2)


def _number(rng: np.random.Generator, shape: tuple[int, ...], low: float, high: float) -> Any:
    drawn = rng.uniform(low, high, shape)
    return np.round(drawn, 2) if shape else round(float(drawn), 2)


def _inverse_inertia(rng: np.random.Generator, shape: tuple[int, ...], size: float = 1.0) -> np.ndarray:
    """Symmetric, positive definite, far from diagonal, two decimals [1/(kg m^2)]."""
    root = rng.uniform(0.4, 1.0, (*shape, 3, 3)) * rng.choice([-1.0, 1.0], (*shape, 3, 3))
    return np.round(size * (root @ np.swapaxes(root, -1, -2) + 0.5 * np.eye(3)), 2)


def _apart(rng: np.random.Generator, draw: Callable[[], dict[str, Any]], good: Callable[[dict[str, Any]], Any]) -> Any:
    """Draw until the case serves."""
    for _ in range(1000):
        case = draw()
        if np.all(good(case)):
            return case
    raise RuntimeError("no case found")


# The formula's parts, which mistakes change one at a time.


def _dot(a: Any, b: Any) -> Any:
    return np.sum(np.asarray(a) * b, axis=-1)


def _times(matrix: Any, vector: Any) -> Any:
    return np.einsum("...ij,...j->...i", matrix, vector)


def _undone(matrix: Any, vector: Any) -> Any:
    return np.linalg.solve(matrix, np.asarray(vector)[..., None])[..., 0]


def _diagonal(matrix: Any, vector: Any) -> Any:
    return np.diagonal(matrix, axis1=-2, axis2=-1) * vector


def _along(number: Any, vector: Any) -> Any:
    return np.asarray(number)[..., None] * vector


def _slipped_cross(a: Any, b: Any) -> Any:
    """a x b entry by entry, with the middle one's sign slipped."""
    x, y, z = np.moveaxis(np.asarray(np.cross(a, b)), -1, 0)
    return np.stack([x, -y, z], axis=-1)


# rod_impulse, the student's step of the derivation.


def _rod_impulse(m: Any, v: Any, theta: Any, e: Any, ell: Any) -> Any:
    return (1 + e) * m * v / (1 + 3 * _cosine(theta) ** 2)


def _cosine(angle: Any) -> Any:
    if hasattr(angle, "free_symbols"):  # the reference is lent in the student's own symbols
        import sympy

        return sympy.cos(angle)
    return np.cos(angle)


def _rod(*, factor: Any = lambda e: 1 + e, bracket: Any = lambda c, s: 1 + 3 * c**2) -> Any:
    def function(m: Any, v: Any, theta: Any, e: Any, ell: Any) -> Any:
        return factor(e) * m * v / bracket(np.cos(theta), np.sin(theta))

    return function


def _rods(rng: np.random.Generator) -> Sequence[Case]:
    draws = {
        "m": _number(rng, (8,), 0.5, 3.0),
        "v": _number(rng, (8,), 0.5, 4.0),
        "theta": _number(rng, (8,), 0.2, 1.3),
        "e": _number(rng, (8,), 0.2, 0.9),
        "ell": _number(rng, (8,), 1.2, 3.0),
    }
    return [
        Case("a level rod", {"m": 1.0, "v": 1.0, "theta": 0.0, "e": 0.5, "ell": 2.0}),
        Case("an inclined rod", {name: float(values[0]) for name, values in draws.items()}),
        Case("eight drawn rods", draws, "batch"),
    ]


ROD_IMPULSE = Exercise(
    name="rod_impulse",
    kind="expression",
    rows=(17, 18),
    points=2,
    minutes=8,
    task="Give the impulse on the lower end of a rod that falls at speed v, at an angle theta from the horizontal.",
    arguments=(
        Value("m", "scalar", "kg", "mass of the rod"),
        Value("v", "scalar", "m/s", "speed at which it falls"),
        Value("theta", "scalar", "rad", "angle of the rod from the horizontal"),
        Value("e", "scalar", "", "restitution"),
        Value("ell", "scalar", "m", "length of the rod; it need not occur"),
    ),
    results=(Value("rod_impulse", "(...)", "N s", "impulse of the floor, upward"),),
    reference=_rod_impulse,
    cases=_rods,
    mistakes=(
        Mistake(
            "inertia about the end",
            _rod(bracket=lambda c, s: 1 + 0.75 * c**2),
            "You took m ell^2/3, the inertia of a rod about its end. Here the arm is measured from the centre of mass, "
            "and about that point the rod has m ell^2/12.",
        ),
        Mistake(
            "arm of the whole length",
            _rod(bracket=lambda c, s: 1 + 12 * c**2),
            "Your arm is the whole length. It runs from the centre of mass to the end: half the length.",
        ),
        Mistake(
            "sine",
            _rod(bracket=lambda c, s: 1 + 3 * s**2),
            "You have the sine where the cosine belongs. Only the part of the arm across n turns the rod, and n points "
            "up: look at the upright rod, which is not turned at all.",
        ),
        Mistake(
            "not squared",
            _rod(bracket=lambda c, s: 1 + 3 * c),
            "The lever counts twice: a longer one gives more spin, and each bit of spin moves the point more. So its "
            "square stands in the effective mass.",
        ),
        Mistake(
            "angle left out",
            _rod(bracket=lambda c, s: 4 + 0 * c),
            "Right for the level rod only. At an angle the lever r x n is shorter than half the length.",
        ),
        Mistake(
            "spin left out",
            _rod(bracket=lambda c, s: 1 + 0 * c),
            "This is the impulse on a body that cannot turn. Divide by 1/m and what turning adds to it.",
        ),
        Mistake(
            "only turning",
            _rod(bracket=lambda c, s: 3 * c**2),
            "You divide by what turning adds, and 1/m is missing: the end gives way by moving and by turning.",
        ),
        Mistake(
            "multiplied by the inertia",
            lambda m, v, theta, e, ell: (1 + e) * v / (1 / m + (0.5 * ell * np.cos(theta)) ** 2 * (m * ell**2 / 12)),
            "You multiply the lever's square by the inertia. It is the *inverse* inertia that stands there: a "
            "body that is hard to turn gives way less.",
        ),
        Mistake(
            "upside down",
            lambda m, v, theta, e, ell: (1 + e) * v * (1 / m) * (1 + 3 * np.cos(theta) ** 2),
            "You multiply by 1/mu. The impulse is -(1 + e) u mu; look at the unit, which must be kg m/s.",
        ),
        Mistake(
            "only e",
            _rod(factor=lambda e: e),
            "The factor is e where it must be 1 + e: the 1 stops the approach, the e sends the end back.",
        ),
        Mistake(
            "no e",
            _rod(factor=lambda e: 1 + 0 * e),
            "e is missing: this impulse stops the end and no more.",
        ),
        Mistake(
            "sign",
            _rod(factor=lambda e: -(1 + e)),
            "Your impulse points down. The end falls, so u = -v is negative and -(1 + e) u mu is positive: the floor "
            "pushes up.",
        ),
    ),
    hints=(
        "Everything is in the box above: u, r x n and I of this rod. u is the velocity of the end along n before.",
        "r = (ell/2)(cos theta, 0, -sin theta) and n = (0, 0, 1), so r x n has the length (ell/2) cos theta. "
        "1/mu is 1/m plus that length squared over I = m ell^2/12.",
        "lever = ell / 2 * sp.cos(theta)\nrod_impulse = (1 + e) * ____ / (1 / m + lever**2 / (____))",
    ),
)


# point_velocity


def _points(rng: np.random.Generator) -> Sequence[Case]:
    def drawn(shape: tuple[int, ...] = ()) -> dict[str, Any]:
        return {
            "velocity": _vector(rng, shape),
            "angular_velocity": _vector(rng, shape, 2.0),
            "arm": _vector(rng, shape),
        }

    wheel = {"velocity": [2.0, 0.0, 0.0], "angular_velocity": [0.0, 2.0, 0.0], "arm": [0.0, 0.0, 1.0]}
    along = {**drawn(), "arm": np.zeros(3)}
    return [
        Case("the top of a rolling wheel", {name: np.array(value) for name, value in wheel.items()}),
        Case("in all directions", drawn()),
        Case("in all directions again", drawn()),
        Case("the centre of mass itself", along, "edge"),
        Case("a body that does not turn", {**drawn(), "angular_velocity": np.zeros(3)}, "edge"),
        Case("three points, as many as a vector has components", drawn((3,)), "batch"),
        Case("five points", drawn((5,)), "batch"),
        Case("many points of one body", {**drawn(), "arm": _vector(rng, (4,))}, "batch"),
    ]


POINT_VELOCITY = Exercise(
    name="point_velocity",
    rows=(22,),
    points=1,
    minutes=5,
    task="Return the velocity of the point at the end of the arm: v + omega x r.",
    arguments=(
        Value("velocity", "(..., 3)", "m/s", "v of the centre of mass"),
        Value("angular_velocity", "(..., 3)", "rad/s", "omega"),
        Value("arm", "(..., 3)", "m", "r, from the centre of mass to the point"),
    ),
    results=(Value("velocity", "(..., 3)", "m/s", "of the point"),),
    reference=impulse.point_velocity,
    cases=_points,
    mistakes=(
        Mistake(
            "r x omega",
            lambda velocity, angular_velocity, arm: velocity + np.cross(arm, angular_velocity),
            "You took r x omega. The cross product changes its sign with the order: it is omega x r. Try the wheel: "
            "rolling to +x, it turns about +y, and its top runs ahead.",
        ),
        Mistake(
            "minus",
            lambda velocity, angular_velocity, arm: np.cross(angular_velocity, arm) - velocity,
            "The velocity of the centre has the wrong sign: the point moves with the centre *and* round it.",
        ),
        Mistake(
            "only turning",
            lambda velocity, angular_velocity, arm: np.cross(angular_velocity, arm) + 0 * np.asarray(velocity),
            "This is the motion round the centre only. Add the velocity of the centre.",
        ),
        Mistake(
            "only moving",
            lambda velocity, angular_velocity, arm: velocity + 0 * np.cross(angular_velocity, arm),
            "This is the velocity of the centre. A point away from it also moves round it.",
        ),
        Mistake(
            "entry by entry",
            lambda velocity, angular_velocity, arm: velocity + np.asarray(angular_velocity) * arm,
            "`*` multiplies entry by entry. The cross product is np.cross(a, b); it takes batches as they are.",
        ),
        Mistake(
            "v x r",
            lambda velocity, angular_velocity, arm: velocity + np.cross(velocity, arm),
            "You crossed the velocity with the arm. What turns the arm is the angular velocity.",
        ),
        Mistake(
            "dot product",
            lambda velocity, angular_velocity, arm: velocity + _along(_dot(angular_velocity, arm), np.ones(3)),
            "You took the dot product of omega and r. A point moves *across* its arm: take the cross product.",
        ),
        Mistake(
            "a sign inside the cross product",
            lambda velocity, angular_velocity, arm: velocity + _slipped_cross(angular_velocity, arm),
            "One entry of your cross product has the wrong sign, the middle one: it is a_z b_x - a_x b_z. "
            "np.cross does it for you.",
        ),
    ),
    hints=(
        "It stands under On the slide.",
        "The point moves with the centre, and round it: add the cross product of the angular velocity and the arm, in "
        "this order. np.cross works on the last axis.",
        "return velocity + np.cross(____, ____)",
    ),
)


# effective_mass


def _effective_mass(
    *,
    levers: Any = np.cross,
    turn: Any = _times,
    first: float = 1.0,
    second: float = 1.0,
    masses: Any = None,
    whole: Any = None,
) -> Any:
    """The effective mass with one of its parts changed."""
    masses = masses or (lambda one, two: np.asarray(one) + two)
    whole = whole or (lambda inverse: 1 / inverse)

    def function(
        inverse_mass_1: Any, inverse_mass_2: Any, inverse_inertia_1: Any, inverse_inertia_2: Any,
        arm_1: Any, arm_2: Any, normal: Any,
    ) -> Any:  # fmt: skip
        inverse = masses(inverse_mass_1, inverse_mass_2)
        for share, inertia, arm in ((first, inverse_inertia_1, arm_1), (second, inverse_inertia_2, arm_2)):
            lever = levers(arm, normal)
            inverse = inverse + share * _dot(lever, turn(inertia, lever))
        return whole(inverse)

    return function


def _by_length(matrix: Any, vector: Any) -> Any:
    """|I^-1 a| along a: what remains where the second lever is forgotten, per length of the first."""
    turned = _times(matrix, vector)
    length = np.linalg.norm(vector, axis=-1)
    share = np.divide(np.linalg.norm(turned, axis=-1), length**2, out=np.zeros(np.shape(length)), where=length > 0)
    return _along(share, vector)


def _bodies(rng: np.random.Generator, shape: tuple[int, ...] = ()) -> dict[str, Any]:
    return {
        "inverse_mass_1": _number(rng, shape, 0.3, 1.0),
        "inverse_mass_2": _number(rng, shape, 1.2, 2.0),
        "inverse_inertia_1": _inverse_inertia(rng, shape, 0.6),
        "inverse_inertia_2": _inverse_inertia(rng, shape, 0.2),
        "arm_1": _vector(rng, shape),
        "arm_2": _vector(rng, shape, 0.7),
        "normal": _unit(rng, shape),
    }


def _share(case: dict[str, Any], body: int) -> Any:
    lever = np.cross(case[f"arm_{body}"], case["normal"])
    return _dot(lever, _times(case[f"inverse_inertia_{body}"], lever))


def _told_apart(case: dict[str, Any]) -> Any:
    """Both bodies turn, and not so much that a sign slip makes 1/mu zero or hides beside rounding."""
    masses = np.asarray(case["inverse_mass_1"]) + case["inverse_mass_2"]
    one, two = _share(case, 1), _share(case, 2)
    away = (np.abs(masses - one - two) > 0.1) & (np.abs(masses + one - two) > 0.1)
    return (one > 0.05) & (two > 0.02) & away


ROD = {
    "inverse_mass_1": 1.0,
    "inverse_mass_2": 0.0,
    "inverse_inertia_1": np.diag([100.0, 12.0, 12.0]),
    "inverse_inertia_2": np.zeros((3, 3)),
    "arm_1": np.array([0.5, 0.0, 0.0]),
    "arm_2": np.zeros(3),
    "normal": np.array([0.0, 0.0, 1.0]),
}


def _masses(rng: np.random.Generator) -> Sequence[Case]:
    def drawn(shape: tuple[int, ...] = ()) -> dict[str, Any]:
        found: dict[str, Any] = _apart(rng, lambda: _bodies(rng, shape), _told_apart)
        return found

    central = drawn()
    central = {**central, "arm_1": -0.5 * central["normal"], "arm_2": 0.25 * central["normal"]}
    fixed_1, fixed_2 = drawn(), drawn()
    fixed_1 |= {"inverse_mass_1": 0.0, "inverse_inertia_1": np.zeros((3, 3))}
    fixed_2 |= {"inverse_mass_2": 0.0, "inverse_inertia_2": np.zeros((3, 3))}
    some_fixed = drawn((4,))
    free = np.array([1.0, 0.0, 1.0, 0.0])
    some_fixed["inverse_mass_2"] = some_fixed["inverse_mass_2"] * free
    some_fixed["inverse_inertia_2"] = some_fixed["inverse_inertia_2"] * free[:, None, None]
    return [
        Case("a rod of 1 kg and 1 m on a floor, hit at its end", ROD),
        Case("two bodies that turn", drawn()),
        Case("two other bodies", drawn()),
        Case("two more", drawn()),
        Case("both arms along the normal", central, "edge"),
        Case("body 2 is fixed", fixed_2, "edge"),
        Case("body 1 is fixed", fixed_1, "edge"),
        Case("three pairs, as many as a vector has components", drawn((3,)), "batch"),
        Case("five pairs", drawn((5,)), "batch"),
        Case("a 2 by 4 batch", drawn((2, 4)), "batch"),
        Case("four pairs, in two of them body 2 is fixed", some_fixed, "batch"),
    ]


def _matmul_mass(
    inverse_mass_1: Any, inverse_mass_2: Any, inverse_inertia_1: Any, inverse_inertia_2: Any,
    arm_1: Any, arm_2: Any, normal: Any,
) -> Any:  # fmt: skip
    lever_1, lever_2 = np.cross(arm_1, normal), np.cross(arm_2, normal)
    turned = _dot(lever_1, inverse_inertia_1 @ lever_1) + _dot(lever_2, inverse_inertia_2 @ lever_2)
    return 1 / (np.asarray(inverse_mass_1) + inverse_mass_2 + turned)


EFFECTIVE_MASS = Exercise(
    name="effective_mass",
    rows=(17, 22),
    points=3,
    minutes=12,
    task="Return mu, the mass that an impulse along n feels at a contact of two bodies that turn.",
    arguments=(
        Value("inverse_mass_1", "(...)", "1/kg", "1/m of body 1; 0 for a fixed body"),
        Value("inverse_mass_2", "(...)", "1/kg", "1/m of body 2; 0 for a fixed body"),
        Value("inverse_inertia_1", "(..., 3, 3)", "1/(kg m^2)", "I^-1 of body 1, world axes; zeros if it is fixed"),
        Value("inverse_inertia_2", "(..., 3, 3)", "1/(kg m^2)", "I^-1 of body 2, likewise"),
        Value("arm_1", "(..., 3)", "m", "from the centre of body 1 to the contact"),
        Value("arm_2", "(..., 3)", "m", "from the centre of body 2 to the contact"),
        NORMAL,
    ),
    results=(Value("effective_mass", "(...)", "kg"),),
    reference=_effective_mass(),
    cases=_masses,
    properties=(
        Property(
            "no more than without spin",
            lambda given, answer: np.maximum(
                answer * (np.asarray(given["inverse_mass_1"]) + given["inverse_mass_2"]) - 1, 0.0),
            "It feels heavier than if the bodies could not turn. Turning only makes a point give way more: each term "
            "adds to 1/mu.",
        ),
    ),
    mistakes=(
        Mistake(
            "one over forgotten",
            _effective_mass(whole=lambda inverse: inverse),
            "This is 1/mu, in 1/kg. Return one over it.",
        ),
        Mistake(
            "spin left out",
            _effective_mass(first=0.0, second=0.0),
            "This is 1/(1/m1 + 1/m2), the mass felt by an impulse through both centres. Add what turning contributes "
            "to 1/mu for each body.",
        ),
        Mistake(
            "only body 1 turns",
            _effective_mass(second=0.0),
            "Only body 1 turns in your formula. Body 2 gives way by turning as well, unless it is fixed.",
        ),
        Mistake(
            "only body 2 turns",
            _effective_mass(first=0.0),
            "Only body 2 turns in your formula. Body 1 gives way by turning as well.",
        ),
        Mistake(
            "body 2's sign",
            _effective_mass(second=-1.0),
            "Body 2's term is subtracted. Body 2 gets the opposite impulse, and its motion is subtracted from that of "
            "body 1: two minus signs, so its term adds to 1/mu.",
        ),
        Mistake(
            "both signs",
            _effective_mass(first=-1.0, second=-1.0),
            "The turning terms are subtracted: a cross product stands in the wrong order. (I^-1 (r x n)) x r is the "
            "velocity the turning gives the point; r x (I^-1 (r x n)) is the opposite.",
        ),
        Mistake(
            "r where r x n belongs",
            _effective_mass(levers=lambda arm, normal: arm),
            "You put the arm itself on both sides of I^-1. What turns a body is the lever r x n: an arm along n does "
            "nothing.",
        ),
        Mistake(
            "entry by entry",
            _effective_mass(levers=lambda arm, normal: np.asarray(arm) * normal),
            "Your lever is r times n, entry by entry. The cross product is np.cross(r, n).",
        ),
        Mistake(
            "only the diagonal",
            _effective_mass(turn=_diagonal),
            "You use only the diagonal of the inverse inertia. It is diagonal in the body's own axes, but a body that "
            "has turned has a full matrix in world axes.",
        ),
        Mistake(
            "inverse undone",
            _effective_mass(turn=_undone),
            "You divide by the matrix that is already inverted, and so multiply by the inertia. The argument is I^-1: "
            "multiply by it.",
        ),
        Mistake(
            "second lever forgotten",
            _effective_mass(turn=_by_length),
            "You add the length of I^-1 (r x n), which is a spin per impulse. The point moves by that spin times its "
            "lever: dot it with r x n once more.",
        ),
        Mistake(
            "masses not inverse",
            _effective_mass(masses=lambda one, two: 1 / np.asarray(one) + 1 / np.asarray(two)),
            "You invert the masses again. The arguments are inverse masses already, so that a fixed body is a plain 0: "
            "add them.",
        ),
        Mistake(
            "matrix times vector in a batch",
            _matmul_mass,
            "Right for one pair. In a batch `matrix @ vector` takes the vectors for a matrix: write "
            "(matrix @ vector[..., None])[..., 0].",
        ),
    ),  # fmt: skip
    hints=(
        "The last line of the derivation gives 1/mu: four terms, one for each way of giving way. Return one over their "
        "sum.",
        "For each body take the lever a = r x n, multiply the inverse inertia by it, and dot the result with a again. "
        "Matrix times vector in a batch is (matrix @ vector[..., None])[..., 0].",
        "lever_1, lever_2 = np.cross(arm_1, normal), np.cross(____, ____)\n"
        "turned_1 = (inverse_inertia_1 @ lever_1[..., None])[..., 0]\n"
        "turned_2 = (inverse_inertia_2 @ lever_2[..., None])[..., 0]\n"
        "return 1 / (inverse_mass_1 + inverse_mass_2 + np.sum(lever_1 * turned_1, axis=-1) + ____)",
    ),
)


# impulse_at_point


def _point_impulse(*, closing: Any = None, factor: Any = None, felt: Any = None, guard: Any = None) -> Any:
    """The impulse with one of its parts changed."""
    closing = closing or (lambda one, two, n: -_dot(np.asarray(one) - two, n))
    factor = factor or (lambda e: 1 + np.asarray(e))
    felt = felt or (lambda mass: mass)
    guard = guard or (lambda u, value: np.where(u < 0, value, 0.0))

    def function(
        point_velocity_1: Any, point_velocity_2: Any, normal: Any, mass_felt: Any, restitution: Any
    ) -> Any:
        u = _dot(np.asarray(point_velocity_1) - point_velocity_2, normal)
        return guard(u, factor(restitution) * closing(point_velocity_1, point_velocity_2, normal) * felt(mass_felt))

    return function


def _hits(rng: np.random.Generator) -> Sequence[Case]:
    def drawn(shape: tuple[int, ...] = (), *, closing: Any = None, **fixed: Any) -> dict[str, Any]:
        normal, second = _unit(rng, shape), _vector(rng, shape)
        closing = _number(rng, shape, 0.5, 3.0) if closing is None else closing
        slide = np.cross(normal, _vector(rng, shape))
        hit = {
            "point_velocity_1": np.round(second - _along(closing, normal) + slide, 3),
            "point_velocity_2": second,
            "normal": normal,
            "mass_felt": _number(rng, shape, 0.3, 0.9),
            "restitution": _number(rng, shape, 0.3, 0.8),
        }
        return hit | fixed

    together = {**drawn(), "point_velocity_1": np.array([1.0, 2.0, 0.5]), "point_velocity_2": np.array([1.0, 2.0, 0.5])}
    mixed = np.round(rng.uniform(-2.0, 2.0, 6), 2)
    mixed[:2] = 1.0, -1.0
    level = {
        "point_velocity_1": np.array([0.0, 0.0, -1.0]),
        "point_velocity_2": np.zeros(3),
        "normal": np.array([0.0, 0.0, 1.0]),
        "mass_felt": 0.25,
        "restitution": 1.0,
    }
    return [
        Case("the level rod on its end", level),
        Case("off the axes", drawn()),
        Case("off the axes again", drawn()),
        Case("the points already part", drawn(closing=-1.5), "edge"),
        Case("the points move together", together, "edge"),
        Case("nothing comes back, e = 0", drawn(restitution=0.0), "edge"),
        Case("three contacts, as many as a vector has components", drawn((3,)), "batch"),
        Case("six contacts", drawn((6,)), "batch"),
        Case("a 2 by 4 batch", drawn((2, 4)), "batch"),
        Case("some approach, some part", drawn((6,), closing=mixed), "batch"),
    ]


IMPULSE_AT_POINT = Exercise(
    name="impulse_at_point",
    rows=(17, 22),
    points=2,
    minutes=6,
    task="Return p_hat at a contact point, from the velocities of the two points and the mass felt there.",
    arguments=(
        Value("point_velocity_1", "(..., 3)", "m/s", "velocity of body 1's point at the contact"),
        Value("point_velocity_2", "(..., 3)", "m/s", "velocity of body 2's point at the contact"),
        NORMAL,
        Value("mass_felt", "(...)", "kg", "effective mass"),
        RESTITUTION,
    ),
    results=(Value("p_hat", "(...)", "N s", "impulse along n, never below 0"),),
    reference=_point_impulse(),
    cases=_hits,
    properties=(
        Property(
            "pushes",
            lambda given, answer: np.minimum(answer, 0.0),
            "A negative impulse pulls the bodies together. A collision can only push.",
        ),
    ),
    mistakes=(
        Mistake(
            "no guard",
            _point_impulse(guard=lambda u, value: value),
            "Right while they approach. Points that already part get a negative impulse from you: it pulls them back. "
            "Where u >= 0 the impulse is 0.",
        ),
        Mistake(
            "the size for all",
            _point_impulse(guard=lambda u, value: np.abs(value)),
            "Right while they approach. With the absolute value you also push points that already part: there the "
            "impulse is 0.",
        ),
        Mistake(
            "guard the wrong way round",
            _point_impulse(guard=lambda u, value: np.where(u > 0, value, 0.0)),
            "Your condition picks the points that part. They approach where u = (v1 - v2).n < 0.",
        ),
        Mistake(
            "sign",
            _point_impulse(closing=lambda one, two, n: _dot(np.asarray(one) - two, n)),
            "The sign is turned round: u is negative while they approach, and the impulse is -(1 + e) u mu, positive.",
        ),
        Mistake(
            "only e",
            _point_impulse(factor=lambda e: np.asarray(e)),
            "The factor is e where it must be 1 + e: the 1 stops the approach, the e sends the points back.",
        ),
        Mistake(
            "1 - e",
            _point_impulse(factor=lambda e: 1 - np.asarray(e)),
            "The factor is 1 - e. After the impact u' = -e u, so the change is -(1 + e) u: at e = 1 there is twice the "
            "impulse of e = 0, not none.",
        ),
        Mistake(
            "no e",
            _point_impulse(factor=lambda e: 1.0 + 0 * np.asarray(e)),
            "e is missing: you stop the approach and no more.",
        ),
        Mistake(
            "1 + e u",
            lambda point_velocity_1, point_velocity_2, normal, mass_felt, restitution: np.where(
                _dot(np.asarray(point_velocity_1) - point_velocity_2, normal) < 0,
                (1 - restitution * _dot(np.asarray(point_velocity_1) - point_velocity_2, normal)) * mass_felt, 0.0),
            "Brackets: 1 + e is one factor. You computed 1 and e times the closing speed, added.",
        ),
        Mistake(
            "divided by the mass",
            _point_impulse(felt=lambda mass: 1 / np.asarray(mass)),
            "You divide by the mass felt. An impulse is a mass times a change of velocity: multiply.",
        ),
        Mistake(
            "whole speed",
            _point_impulse(closing=lambda one, two, n: np.linalg.norm(np.asarray(one) - two, axis=-1)),
            "You take the length of the relative velocity. Without friction only its part along n matters: the dot "
            "product with n.",
        ),
        Mistake(
            "point 1 only",
            _point_impulse(closing=lambda one, two, n: -_dot(one, n)),
            "The velocity of body 2's point is missing: what counts is the relative velocity of the two points.",
        ),
        Mistake(
            "a vector",
            lambda point_velocity_1, point_velocity_2, normal, mass_felt, restitution: _along(
                _point_impulse()(point_velocity_1, point_velocity_2, normal, mass_felt, restitution), normal),
            "You return the vector p_hat n. Return the number p_hat, one for each contact.",
        ),
    ),  # fmt: skip
    hints=(
        "It is impulse_central of lesson 10, with two things exchanged: which velocities approach, and which "
        "mass is felt.",
        "u = (v1 - v2).n with the velocities of the points. Where u < 0 the impulse is -(1 + e) u times the mass felt; "
        "elsewhere it is 0.",
        "u = np.sum((point_velocity_1 - point_velocity_2) * normal, axis=-1)\n"
        "return np.where(u < 0, -(1 + restitution) * ____ * ____, 0.0)",
    ),
)


# apply_impulse


def _applied(*, lever: Any = np.cross, turn: Any = _times, mass: Any = None, sign: float = 1.0, order: int = 1) -> Any:
    """The velocities after the impulse with one of the parts changed."""
    mass = mass or (lambda inverse: np.asarray(inverse))

    def function(
        velocity: Any, angular_velocity: Any, inverse_mass: Any, inverse_inertia: Any,
        arm: Any, normal: Any, impulse: Any,
    ) -> Any:  # fmt: skip
        moved = velocity + sign * _along(np.asarray(impulse) * mass(inverse_mass), normal)
        turned = angular_velocity + sign * turn(inverse_inertia, lever(arm, _along(impulse, normal)))
        return (moved, turned)[::order]

    return function


def _matmul_apply(
    velocity: Any, angular_velocity: Any, inverse_mass: Any, inverse_inertia: Any, arm: Any, normal: Any, impulse: Any
) -> Any:
    push = _along(impulse, normal)
    return velocity + _along(inverse_mass, push), angular_velocity + inverse_inertia @ np.cross(arm, push)


def _short_axis(
    velocity: Any, angular_velocity: Any, inverse_mass: Any, inverse_inertia: Any, arm: Any, normal: Any, impulse: Any
) -> Any:
    push = impulse * np.asarray(normal)
    return velocity + inverse_mass * push, angular_velocity + _times(inverse_inertia, np.cross(arm, push))


def _pushes(rng: np.random.Generator) -> Sequence[Case]:
    def drawn(shape: tuple[int, ...] = (), **fixed: Any) -> dict[str, Any]:
        push = {
            "velocity": _vector(rng, shape),
            "angular_velocity": _vector(rng, shape, 2.0),
            "inverse_mass": _number(rng, shape, 0.3, 0.8),
            "inverse_inertia": _inverse_inertia(rng, shape),
            "arm": _vector(rng, shape),
            "normal": _unit(rng, shape),
            "impulse": _number(rng, shape, 0.5, 3.0),
        }
        return push | fixed

    rod = {
        "velocity": np.array([0.0, 0.0, -1.0]),
        "angular_velocity": np.zeros(3),
        "inverse_mass": 1.0,
        "inverse_inertia": np.diag([100.0, 12.0, 12.0]),
        "arm": np.array([0.5, 0.0, 0.0]),
        "normal": np.array([0.0, 0.0, 1.0]),
        "impulse": 0.5,
    }
    central = drawn()
    central["arm"] = 0.5 * central["normal"]
    mixed = drawn((4,))
    mixed["impulse"] = mixed["impulse"] * np.array([1.0, -1.0, 0.0, 1.0])
    return [
        Case("the level rod on its end", rod),
        Case("off the axes", drawn()),
        Case("off the axes again", drawn()),
        Case("body 2's share: a negative impulse", drawn(impulse=-1.5), "edge"),
        Case("no impulse", drawn(impulse=0.0), "edge"),
        Case("an arm along the normal", central, "edge"),
        Case("a fixed body", drawn(inverse_mass=0.0, inverse_inertia=np.zeros((3, 3))), "edge"),
        Case("three bodies, as many as a vector has components", drawn((3,)), "batch"),
        Case("five bodies", drawn((5,)), "batch"),
        Case("a 2 by 4 batch", drawn((2, 4)), "batch"),
        Case("four bodies, one pushed the other way, one not at all", mixed, "batch"),
    ]


APPLY_IMPULSE = Exercise(
    name="apply_impulse",
    rows=(15, 16, 22),
    points=2,
    minutes=8,
    task="Return the velocity and the angular velocity of a body after an impulse p_hat n at the end of its arm.",
    arguments=(
        Value("velocity", "(..., 3)", "m/s", "v of the centre of mass before"),
        Value("angular_velocity", "(..., 3)", "rad/s", "omega before"),
        Value("inverse_mass", "(...)", "1/kg", "1/m; 0 for a fixed body"),
        Value("inverse_inertia", "(..., 3, 3)", "1/(kg m^2)", "I^-1 about the centre, world axes; zeros if fixed"),
        Value("arm", "(..., 3)", "m", "r, from the centre of mass to the contact"),
        Value("normal", "(..., 3)", "", "unit vector n"),
        Value("impulse", "(...)", "N s", "p_hat; for body 2 it is given with a minus"),
    ),
    results=(Value("velocity", "(..., 3)", "m/s"), Value("angular_velocity", "(..., 3)", "rad/s")),
    reference=_applied(),
    cases=_pushes,
    mistakes=(
        Mistake(
            "n x r",
            _applied(lever=lambda arm, push: np.cross(push, arm)),
            "The spin has the wrong sign: you took n x r. The torque of a push is r x n, arm first.",
        ),
        Mistake(
            "inverse inertia forgotten",
            _applied(turn=lambda matrix, lever: lever),
            "You add r x n p_hat to omega. That is the change of angular momentum L; omega changes by I^-1 times it.",
        ),
        Mistake(
            "inverse undone",
            _applied(turn=_undone),
            "You divide by the matrix that is already inverted. The argument is I^-1: multiply by it.",
        ),
        Mistake(
            "only the diagonal",
            _applied(turn=_diagonal),
            "You use only the diagonal of the inverse inertia. In world axes a body that has turned has a full matrix: "
            "a push can spin it about an axis it was not pushed about.",
        ),
        Mistake(
            "arm not crossed",
            _applied(lever=lambda arm, push: push + 0 * np.asarray(arm)),
            "You multiply I^-1 by the push itself. What turns a body is the torque, r x the push.",
        ),
        Mistake(
            "entry by entry",
            _applied(lever=lambda arm, push: np.asarray(arm) * push),
            "Your torque is r times n, entry by entry. The cross product is np.cross.",
        ),
        Mistake(
            "inverse mass forgotten",
            _applied(mass=lambda inverse: np.ones(np.shape(inverse))),
            "You add p_hat n to the velocity. That is the change of momentum; the velocity changes by it times 1/m.",
        ),
        Mistake(
            "divided by the inverse mass",
            _applied(mass=lambda inverse: 1 / np.asarray(inverse)),
            "You divide by the inverse mass, and so multiply by the mass. The argument is 1/m already.",
        ),
        Mistake(
            "sign",
            _applied(sign=-1.0),
            "Both changes have the wrong sign: the impulse acts along +n. The minus of body 2 comes with its p_hat.",
        ),
        Mistake(
            "the pair turned round",
            _applied(order=-1),
            "Both are right, but in the wrong order: return the velocity first, then the angular velocity.",
        ),
        Mistake(
            "velocity of the point",
            lambda velocity, angular_velocity, inverse_mass, inverse_inertia, arm, normal, impulse: (
                _applied()(velocity, angular_velocity, inverse_mass, inverse_inertia, arm, normal, impulse)[0]
                + np.cross(_applied()(
                    velocity, angular_velocity, inverse_mass, inverse_inertia, arm, normal, impulse)[1], arm),
                _applied()(velocity, angular_velocity, inverse_mass, inverse_inertia, arm, normal, impulse)[1]),
            "The spin is right, but your velocity is that of the contact point. Asked is that of the centre of mass: "
            "v + p_hat n / m, wherever the push acts.",
        ),
        Mistake(
            "one batch axis short",
            _short_axis,
            "Right for one body, not for a batch: impulse and inverse_mass have shape (...), normal has (..., 3). Give "
            "them one more axis, np.asarray(impulse)[..., None] * normal.",
        ),
        Mistake(
            "matrix times vector in a batch",
            _matmul_apply,
            "Right for one body. In a batch `matrix @ vector` takes the vectors for a matrix: write "
            "(matrix @ vector[..., None])[..., 0].",
        ),
    ),  # fmt: skip
    hints=(
        "The table at the start of the derivation has both changes: one of v, one of omega.",
        "The push is the vector p_hat n. It changes v by the push times 1/m, and omega by I^-1 times the torque, which "
        "is the cross product of the arm and the push, in this order.",
        "push = np.asarray(impulse)[..., None] * normal\n"
        "torque = np.cross(____, ____)\n"
        "turned = (inverse_inertia @ torque[..., None])[..., 0]\n"
        "return velocity + np.asarray(inverse_mass)[..., None] * ____, angular_velocity + ____",
    ),
)


# simultaneous_impulses: not unique where contacts are redundant, so judged by what is true of every right answer.


def _at_once(matrix: Any, normal_velocity: Any, restitution: Any) -> Any:
    from course.contact.solvers.nnls import solve_nnls

    return solve_nnls(matrix, (1 + restitution) * np.asarray(normal_velocity)).force


def _left(given: Any, impulse: Any) -> Any:
    """w = u' + e u = A p + (1 + e) u."""
    return given["matrix"] @ impulse + (1 + given["restitution"]) * given["normal_velocity"]


def _corners(across: float, along: float) -> np.ndarray:
    """A of a box of 1 kg on its four corners: 1 + x_i x_j/k_y^2 + y_i y_j/k_x^2, rank 3."""
    x, y = np.array([-1.0, -1.0, 1.0, 1.0]), np.array([-1.0, 1.0, -1.0, 1.0])
    return 1 + across * np.outer(x, x) + along * np.outer(y, y)


def _many(rng: np.random.Generator) -> Sequence[Case]:
    def case(matrix: Any, normal_velocity: Any, restitution: float) -> dict[str, Any]:
        given = {"matrix": np.array(matrix), "normal_velocity": np.array(normal_velocity), "restitution": restitution}
        return given

    def drawn(count: int) -> dict[str, Any]:
        root = rng.normal(size=(count + 2, count))
        return case(np.round(root.T @ root, 2), np.round(-rng.uniform(0.3, 2.0, count), 2), _number(rng, (), 0.3, 0.8))

    tilt = np.round(rng.uniform(0.1, 0.4, 2), 2)
    rocking = -1.0 + tilt[0] * np.array([-1.0, -1.0, 1.0, 1.0]) + tilt[1] * np.array([-1.0, 1.0, -1.0, 1.0])
    strong = _number(rng, (), 1.4, 1.8)
    return [
        Case("a ball onto two that touch", case([[2.0, -1.0], [-1.0, 2.0]], [-1.0, 0.0], 1.0)),
        Case("one contact", case([[4.0]], [-1.0], 0.5)),
        Case("the second needs no push of its own", case([[2.0, strong], [strong, 2.0]], [-1.0, -0.2], 0.5)),
        Case("three contacts", drawn(3)),
        Case("four contacts", drawn(4)),
        Case("a box flat on its four corners", case(_corners(2.0, 1.5), [-1.0] * 4, 0.5), "edge"),
        Case("a box that rocks onto its four corners", case(_corners(2.0, 1.5), rocking, 0.75), "edge"),
        Case("one approaches, one parts", case([[2.0, -1.0], [-1.0, 2.0]], [-1.0, 0.1], 0.5), "edge"),
        Case("nothing comes back, e = 0", {**drawn(3), "restitution": 0.0}, "edge"),
    ]


def _instead(target: Any) -> Any:
    """The right solver on another right-hand side: w = A p + target(u, e)."""

    def function(matrix: Any, normal_velocity: Any, restitution: Any) -> Any:
        return _at_once(matrix, target(np.asarray(normal_velocity), restitution), 0.0)

    return function


def _alone(matrix: Any, normal_velocity: Any, restitution: Any) -> Any:
    return np.maximum(-(1 + restitution) * np.asarray(normal_velocity) / np.diagonal(matrix), 0.0)


def _solved(matrix: Any, normal_velocity: Any, restitution: Any) -> Any:
    return np.linalg.lstsq(matrix, -(1 + restitution) * np.asarray(normal_velocity), rcond=1e-9)[0]


def _in_turn(matrix: Any, normal_velocity: Any, restitution: Any) -> Any:
    from course.study.impact_laws import impulses_in_turn

    return impulses_in_turn(matrix, normal_velocity, restitution, passes=200)[0]


def _one_sweep(matrix: Any, normal_velocity: Any, restitution: Any) -> Any:
    from course.study.impact_laws import impulses_at_once

    return impulses_at_once(matrix, normal_velocity, restitution, sweeps=1)[0]


SIMULTANEOUS_IMPULSES = Exercise(
    name="simultaneous_impulses",
    rows=(15, 17, 21),
    points=3,
    minutes=20,
    level="stretch",
    task="Return impulses p for all contacts at once: p >= 0, w = A p + (1 + e) u >= 0, and p_i w_i = 0 for each i.",
    arguments=(
        Value("matrix", "(c, c)", "1/kg", "A: a_ij is the change of u_i for 1 N s at contact j"),
        Value("normal_velocity", "(c,)", "m/s", "u of each contact before"),
        Value("restitution", "scalar", "", "e, from 0 to 1"),
    ),
    results=(Value("impulse", "(c,)", "N s", "p, none below 0"),),
    reference=_at_once,
    cases=_many,
    judged_by="properties",
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
            "Some w = A p + (1 + e) u is below 0: that contact parts slower than e times its closing speed.",
            tolerance=1e-6,
        ),
        Property(
            "no push too many",
            lambda given, answer: answer * _left(given, answer),
            "Some contact has p > 0 and w > 0: it is pushed although it parts faster than it must.",
            tolerance=1e-6,
        ),
    ),
    mistakes=(
        Mistake(
            "each as if alone",
            _alone,
            "Each contact gets the impulse it would get alone. But an impulse at one changes the velocity at the "
            "others: that is what the entries off the diagonal say.",
        ),
        Mistake(
            "one sweep",
            _one_sweep,
            "You went through the contacts once. A later impulse disturbs those before it: go round again until "
            "nothing changes any more (a few hundred times will do here).",
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
            "must be found anew. Clip inside the loop, not after it.",
        ),
        Mistake(
            "one after the other",
            _in_turn,
            "This is the sequential law: each contact as if it were alone, with e for each single hit. Here e holds "
            "between before and after all impulses: w_i = (A p)_i + (1 + e) u_i with the u from before.",
        ),
        Mistake(
            "no e",
            _instead(lambda u, e: u),
            "e is missing: your contacts only stop approaching. w holds (1 + e) u.",
        ),
        Mistake(
            "only e",
            _instead(lambda u, e: e * u),
            "The factor is e where it must be 1 + e: after the impact u' = u + A p, and it must reach -e u.",
        ),
        Mistake(
            "sign",
            _instead(lambda u, e: -(1 + e) * u),
            "The sign of u is turned round: u < 0 approaches, and w = A p + (1 + e) u must be lifted up to 0.",
        ),
    ),
    hints=(
        "One contact: p = -(1 + e) u / a, if that is positive. With several, an impulse at one changes w at all "
        "others.",
        "Start with p = 0 and go through the contacts again and again. For each, compute w_i with the p you have, and "
        "change p_i by what brings w_i to 0, but never below p_i = 0.",
        "p = np.zeros(len(normal_velocity))\nfor _ in range(500):\n    for i in range(len(p)):\n"
        "        w = matrix[i] @ p + (1 + restitution) * normal_velocity[i]\n"
        "        p[i] = max(0.0, p[i] - ____ / ____)\nreturn p",
    ),
)


def _rod_centre() -> float:
    from course.contact import resolve_collisions
    from course.study import falling_rods

    return float(resolve_collisions(*falling_rods(0.0), 1.0).velocity[0, 2])


def _halfway() -> float:
    from course.study import falling_rods

    return float(impulse.effective_mass(*falling_rods(0.0, place=0.5))[0])


def _box_in_turn() -> str:
    from course.contact import resolve_collisions
    from course.study import box_on_corners

    after = resolve_collisions(*box_on_corners(), 1.0, law="sequential")
    return "turns" if np.linalg.norm(after.angular_velocity[0]) > 1e-6 else "straight"


def _clamped() -> str:
    u = np.array([-1.0, 0.1])
    push = _at_once(np.array([[2.0, -1.0], [-1.0, 2.0]]), np.array([2 * u[0], u[1]]), 0.0)
    change = float(push @ u + 0.5 * push @ np.array([[2.0, -1.0], [-1.0, 2.0]]) @ push)
    return "kept" if abs(change) < 1e-9 else "gained" if change > 0 else "lost"


PREDICTIONS = (
    Prediction(
        "rod_centre",
        "A rod falls flat at 1 m/s, and a fixed peg hits its end; nothing is lost. How fast does the rod's *centre* "
        "move just after? (Upward is positive.)",
        _rod_centre,
        "The peg gives 0.5 N s, and that takes 0.5 m/s from a rod of 1 kg: its centre goes on falling at half speed. "
        "The rest of the energy is in the spin.",
        unit="m/s",
        tolerance=0.01,
        later="See",
        wrong={
            1: "So a ball would bounce. Only the *end* of the rod comes back at 1 m/s.",
            0: "All the energy in the spin? The peg is too weak to stop the centre.",
            0.5: "Half the speed is right, but the centre still goes down.",
            -1: "The peg pushes the whole rod, not only its end: the centre changes by impulse over mass.",
        },
    ),
    Prediction(
        "halfway",
        "A rod of 1 kg feels like 1 kg when it is hit at its middle and like 0.25 kg at its end. How heavy does "
        "it feel half way between the two?",
        _halfway,
        "The lever is half as long, and it counts squared: 1/mu = 1 + 3/4, so mu = 4/7 kg.",
        unit="kg",
        tolerance=0.01,
        wrong={
            0.625: "The mean of the two. But what falls off evenly is neither mu nor the lever's square.",
            0.4: "The mean of 1 and 4 in 1/mu. The lever counts squared: half of it adds a quarter of 3.",
            0.5: "Half the lever is not half the mass.",
        },
    ),
    Prediction(
        "box_in_turn",
        "A box lands flat on its four corners, nothing is lost. The program hits one corner after the other, "
        "each as if it were alone, until none approaches. What does the box do?",
        _box_in_turn,
        "The first corner turns the box, so the next ones come in at other speeds. Every single hit is right, and yet "
        "the box tumbles; the order in the list decides which way.",
        choices={
            "straight": "it flies straight up at the speed it came with",
            "turns": "it flies up and turns",
        },
        wrong={"straight": "So a fair law would have it: nothing prefers one corner."},
    ),
    Prediction(
        "clamped",
        "Three balls of 1 kg touch and move at 1, 0 and 0.1 m/s. A program asks the first contact, which closes, "
        "to part as fast as it closed (e = 1), and the second, which already parts, only not to close. What "
        "becomes of the kinetic energy?",
        _clamped,
        "The second contact comes to be squeezed and gets an impulse while it parts: that is work done on the balls. "
        "They leave at -0.3, 0.7 and 0.7 m/s with 0.535 J; they came with 0.505 J.",
        choices={"kept": "it is kept", "lost": "some is lost", "gained": "some is gained"},
        wrong={
            "kept": "e = 1 keeps it for one contact. For several, it depends on which contacts it is asked of.",
            "lost": "The second contact looks plastic, but it was parting: the impulse there speeds things up.",
        },
    ),
)

LESSON = Lesson(
    number="12",
    name="impulse-and-spin",
    title="Impulse and spin",
    question="Hit a rod at its end: why does it take only a quarter of the impulse?",
    minutes=75,
    exercises=(ROD_IMPULSE, POINT_VELOCITY, EFFECTIVE_MASS, IMPULSE_AT_POINT, APPLY_IMPULSE, SIMULTANEOUS_IMPULSES),
    predictions=PREDICTIONS,
)
