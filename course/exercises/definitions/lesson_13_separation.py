"""Lesson 13: how far two bodies are apart, and how fast that changes."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

import numpy as np

from course import contact
from course.dynamics import point_velocity
from course.exercises.definition import Case, Exercise, Lesson, Mistake, Prediction, Property, Value

POINT_A = Value("p_a", "(..., 3)", "m", "the point on body A")
POINT_B = Value("p_b", "(..., 3)", "m", "the point on body B")
NORMAL = Value("n", "(..., 3)", "", "unit vector out of body B toward body A")
OMEGA_A = Value("omega_a", "(..., 3)", "rad/s", "angular velocity of A")
OMEGA_B = Value("omega_b", "(..., 3)", "rad/s", "angular velocity of B")


def _unit(rng: np.random.Generator, shape: tuple[int, ...] = ()) -> np.ndarray:
    vector = rng.normal(size=(*shape, 3))
    return np.asarray(vector / np.linalg.norm(vector, axis=-1, keepdims=True))


def _draw(rng: np.random.Generator, shape: tuple[int, ...] = (), size: float = 2.0) -> np.ndarray:
    """Vectors of two decimals: they are shown to students."""
    return np.asarray(np.round(rng.uniform(-size, size, (*shape, 3)), 2))


def _dot(a: Any, b: Any) -> Any:
    return np.sum(np.asarray(a) * b, axis=-1)


UP = np.array([0.0, 0.0, 1.0])
ZERO = np.zeros(3)


# top_rate, the student's step of the derivation: the rate of the gap between a ladder's top and the wall.


def _top_rate(v_y: Any, omega: Any, theta: Any, ell: Any) -> Any:
    if isinstance(theta, (float, np.ndarray)):
        return -v_y + ell / 2 * omega * np.sin(theta)
    import sympy

    return -v_y + ell / 2 * omega * sympy.sin(theta)


def _ladders(rng: np.random.Generator) -> Sequence[Case]:
    draws = {
        "v_y": np.round(rng.uniform(-2.0, -0.5, 8), 2),
        "omega": np.round(rng.uniform(-2.0, -0.5, 8), 2),
        "theta": np.round(rng.uniform(0.3, 1.3, 8), 2),
        "ell": np.round(rng.uniform(1.5, 5.0, 8), 2),
    }
    by_hand = {"v_y": -1.0, "omega": -0.5, "theta": 0.5, "ell": 4.0}
    return [Case("one ladder", by_hand), Case("eight ladders", draws, "batch")]


TOP_RATE = Exercise(
    name="top_rate",
    kind="expression",
    rows=(19, 20),
    points=2,
    minutes=8,
    task="Give the rate of d_2 = -y - (ell/2) cos(theta) in the symbols v_y, omega, theta and ell.",
    arguments=(
        Value("v_y", "scalar", "m/s", "rate of y, the centre's speed toward the wall"),
        Value("omega", "scalar", "rad/s", "rate of theta"),
        Value("theta", "scalar", "rad", "angle between ladder and floor"),
        Value("ell", "scalar", "m", "length of the ladder"),
    ),
    results=(Value("top_rate", "(...)", "m/s", "rate of the gap between top and wall"),),
    reference=_top_rate,
    cases=_ladders,
    mistakes=(
        Mistake(
            "turned round",
            lambda v_y, omega, theta, ell: v_y - ell / 2 * omega * np.sin(theta),
            "Both signs are turned round: you give the rate of +y + (ell/2) cos(theta), which is the speed of the top "
            "toward the wall. The gap shrinks when the top comes nearer.",
        ),
        Mistake(
            "chain rule",
            lambda v_y, omega, theta, ell: -v_y + ell / 2 * np.sin(theta),
            "omega is missing: theta depends on time, so the derivative of cos(theta) is -sin(theta) times the rate of "
            "theta. (Look at the unit: metres and metres per second do not add.)",
        ),
        Mistake(
            "sign of the cosine",
            lambda v_y, omega, theta, ell: -v_y - ell / 2 * omega * np.sin(theta),
            "The second sign: the derivative of cos(theta) is -sin(theta), and a minus stands before it already.",
        ),
        Mistake(
            "cosine kept",
            lambda v_y, omega, theta, ell: -v_y - ell / 2 * omega * np.cos(theta),
            "You multiplied by omega but left the cosine standing. Its derivative is -sin(theta).",
        ),
        Mistake(
            "that of the foot",
            lambda v_y, omega, theta, ell: -v_y + ell / 2 * omega * np.cos(theta),
            "cos(theta) belongs to the rate of the foot's gap. d_2 holds the cosine, whose derivative is a sine.",
        ),
        Mistake(
            "whole length",
            lambda v_y, omega, theta, ell: -v_y + ell * omega * np.sin(theta),
            "Your arm is the whole ladder. y is where the *centre* is: from there to the top it is half the length.",
        ),
        Mistake(
            "centre alone",
            lambda v_y, omega, theta, ell: -v_y + 0 * theta,
            "This is the rate for a ladder that does not turn. theta changes too.",
        ),
        Mistake(
            "turning alone",
            lambda v_y, omega, theta, ell: ell / 2 * omega * np.sin(theta),
            "This is the rate for a ladder that turns about a fixed centre. y changes too, at the rate v_y.",
        ),
        Mistake(
            "first sign",
            lambda v_y, omega, theta, ell: v_y + ell / 2 * omega * np.sin(theta),
            "The sign of v_y: d_2 holds -y. When the centre moves toward the wall, to the right, the gap shrinks.",
        ),
    ),
    hints=(
        "Go through d_2 term by term as the text does with d_1. What depends on time? y and theta.",
        "The rate of y is v_y. The rate of cos(theta) is -sin(theta) times the rate of theta, which is omega.",
        "top_rate = -____ + ell / 2 * ____ * sp.sin(theta)",
    ),
)


# separation


def _gaps(rng: np.random.Generator) -> Sequence[Case]:
    def pair(shape: tuple[int, ...] = ()) -> dict[str, Any]:
        return {"p_a": _draw(rng, shape), "p_b": _draw(rng, shape), "n": _unit(rng, shape)}

    n = _unit(rng)
    p = _draw(rng)
    across = np.round(np.cross(n, _unit(rng)), 2)
    return [
        Case(
            "a lamp over a table",
            {"p_a": np.array([0.2, 0.0, 1.0]), "p_b": np.array([0.0, 0.5, 0.7]), "n": UP},
        ),
        Case("off the axes", pair()),
        Case("penetrating", {"p_a": p - 0.2 * n + across - (across @ n) * n, "p_b": p, "n": n}),
        Case("touching", {"p_a": p, "p_b": p, "n": n}, "edge"),
        Case("three pairs, as many as a vector has components", pair((3,)), "batch"),
        Case("a 2 by 4 batch", pair((2, 4)), "batch"),
        Case(
            "many points over one plane",
            {"p_a": _draw(rng, (5,)), "p_b": _draw(rng), "n": _unit(rng)},
            "batch",
        ),
    ]


SEPARATION = Exercise(
    name="separation",
    rows=(19,),
    points=1,
    minutes=5,
    task="Return d = (p_A - p_B).N, for one pair of points and for a batch.",
    arguments=(POINT_A, POINT_B, NORMAL),
    results=(Value("d", "(...)", "m", "above 0 apart, 0 touching, below 0 penetrating"),),
    reference=contact.separation,
    cases=_gaps,
    mistakes=(
        Mistake(
            "turned round",
            lambda p_a, p_b, n: -_dot(p_a - p_b, n),
            "The sign is turned round. N points out of B toward A, so p_A - p_B lies along +N while they are apart.",
        ),
        Mistake(
            "distance",
            lambda p_a, p_b, n: np.linalg.norm(p_a - p_b, axis=-1),
            "You return the distance of the two points. What lies across N does not count, and a distance can never "
            "say that the bodies penetrate: project on N.",
        ),
        Mistake(
            "size",
            lambda p_a, p_b, n: np.abs(_dot(p_a - p_b, n)),
            "The size is right and the sign is lost, and with it the difference between a gap and a penetration.",
        ),
        Mistake(
            "no sum",
            lambda p_a, p_b, n: (p_a - p_b) * n,
            "You multiply component by component and stop there. A dot product adds the three products up: "
            "np.sum(..., axis=-1).",
        ),
        Mistake(
            "sum over everything",
            lambda p_a, p_b, n: np.sum((p_a - p_b) * n),
            "Right for one pair. For a batch you add all pairs up into one number: sum over the last axis only.",
        ),
        Mistake(
            "a vector",
            lambda p_a, p_b, n: _dot(p_a - p_b, n)[..., None] * n,
            "You return the vector d N. Asked is the number d, one for each pair.",
        ),
        Mistake(
            "only A",
            lambda p_a, p_b, n: _dot(p_a, n) + 0 * _dot(p_b, n),
            "p_B is missing: this is how far p_A is from the origin along N, not from B.",
        ),
        Mistake(
            "projected on B",
            lambda p_a, p_b, n: _dot(p_a - p_b, p_b),
            "You project on p_B, which is a place. The direction to project on is N.",
        ),
    ),
    hints=(
        "The formula stands under On the slide: a difference of two points, and a dot product.",
        "Subtract p_B from p_A, multiply by N component by component, and add up over the last axis.",
        "return np.sum((____ - ____) * n, axis=____)",
    ),
)


# normal_rate


def _rate_of_normal(n: Any, omega_a: Any, omega_b: Any, face: str) -> Any:
    return np.cross(omega_b if face == "face_b" else omega_a, n)


def _faces(rng: np.random.Generator) -> Sequence[Case]:
    def face(word: str, shape: tuple[int, ...] = ()) -> dict[str, Any]:
        omega_a, omega_b = _draw(rng, shape), _draw(rng, shape)
        return {"n": _unit(rng, shape), "omega_a": omega_a, "omega_b": omega_b, "face": word}

    turning = {"n": UP, "omega_a": np.array([0.0, 3.0, 0.0]), "omega_b": np.array([2.0, 0.0, 0.0])}
    return [
        Case("a plank that turns, face of B", {**turning, "face": "face_b"}),
        Case("the same, face of A", {**turning, "face": "face_a"}),
        Case("off the axes, face of B", face("face_b")),
        Case("off the axes, face of A", face("face_a")),
        Case("B turns about its own normal", {**face("face_b"), "n": UP, "omega_b": 2.5 * UP}, "edge"),
        Case("three faces of B", face("face_b", (3,)), "batch"),
        Case("a 2 by 4 batch, faces of A", face("face_a", (2, 4)), "batch"),
    ]


NORMAL_RATE = Exercise(
    name="normal_rate",
    rows=(20,),
    points=1,
    minutes=7,
    task='Return N_dot where a face carries the normal: a face of B (face is "face_b") or of A ("face_a").',
    arguments=(NORMAL, OMEGA_A, OMEGA_B, Value("face", "word", "", '"face_b" or "face_a"', dtype="str")),
    results=(Value("n_dot", "(..., 3)", "1/s", "rate of N"),),
    reference=_rate_of_normal,
    cases=_faces,
    properties=(
        Property(
            "keeps its length",
            lambda given, answer: _dot(answer, given["n"]),
            "Your N_dot has a part along N, so N would not keep its length of 1.",
        ),
    ),
    mistakes=(
        Mistake(
            "order",
            lambda n, omega_a, omega_b, face: -_rate_of_normal(n, omega_a, omega_b, face),
            "The sign is turned round: a cross product changes its sign with the order. What turns with omega changes "
            "by omega x (itself). (A's own outward normal is -N, but it turns by the same rule.)",
        ),
        Mistake(
            "the other body",
            lambda n, omega_a, omega_b, face: np.cross(omega_a if face == "face_b" else omega_b, n),
            "You took the omega of the other body. N is fixed to the body whose face it belongs to, and turns with it.",
        ),
        Mistake(
            "always B",
            lambda n, omega_a, omega_b, face: np.cross(omega_b, n),
            'Right for a face of B. When the face is A\'s (face == "face_a") the normal turns with A.',
        ),
        Mistake(
            "always A",
            lambda n, omega_a, omega_b, face: np.cross(omega_a, n),
            'Right for a face of A. When the face is B\'s (face == "face_b") the normal turns with B.',
        ),
        Mistake(
            "sign for A",
            lambda n, omega_a, omega_b, face: np.cross(omega_b if face == "face_b" else -omega_a, n),
            "Right for a face of B. For a face of A you turned the sign round: A's outward normal is -N, its rate is "
            "-N_dot, and the two signs cancel.",
        ),
        Mistake(
            "relative spin",
            lambda n, omega_a, omega_b, face: np.cross(np.asarray(omega_a) - omega_b, n),
            "You took the spin of A against B. The face knows nothing of the other body: one omega is enough.",
        ),
        Mistake(
            "relative spin, turned round",
            lambda n, omega_a, omega_b, face: np.cross(np.asarray(omega_b) - omega_a, n),
            "You took the spin of B against A. The face knows nothing of the other body: one omega is enough.",
        ),
        Mistake(
            "none",
            lambda n, omega_a, omega_b, face: 0.0 * np.cross(omega_b, n),
            "You leave the normal as it is. It is fixed to a face, and the face turns.",
        ),
        Mistake(
            "no cross",
            lambda n, omega_a, omega_b, face: np.asarray(omega_b if face == "face_b" else omega_a) * n,
            "You multiply component by component. A turning arrow changes by a cross product: np.cross.",
        ),
    ),
    hints=(
        "See Derive: an arrow that is fixed to a turning body. Which body is N fixed to?",
        "The rate is omega x N, with the omega of the body whose face it is. np.cross works on the last axis.",
        'omega = omega_b if face == "face_b" else ____\nreturn np.cross(____, ____)',
    ),
)


# separation_rate


def _velocity(body: Any, arm: Any) -> Any:
    return point_velocity(body[1], body[2], arm)


def _rate(p_a: Any, p_b: Any, body_a: Any, body_b: Any, n: Any, n_dot: Any) -> Any:
    relative = _velocity(body_a, p_a - body_a[0]) - _velocity(body_b, p_b - body_b[0])
    return _dot(relative, n) + _dot(p_a - p_b, n_dot)


def _rate_with(
    *,
    arm_a: Any = None,
    arm_b: Any = None,
    sign_b: float = -1.0,
    turning: float = 1.0,
    swap: bool = False,
    carried: float = 1.0,
) -> Any:
    """The rate with one of its parts changed."""

    def function(p_a: Any, p_b: Any, body_a: Any, body_b: Any, n: Any, n_dot: Any) -> Any:
        given = (p_a, p_b, body_a[0], body_b[0])
        r_a = arm_a(*given) if arm_a else p_a - body_a[0]
        r_b = arm_b(*given) if arm_b else p_b - body_b[0]
        omega_a, omega_b = (body_b[2], body_a[2]) if swap else (body_a[2], body_b[2])
        relative = (
            body_a[1]
            + turning * np.cross(omega_a, r_a)
            + sign_b * (body_b[1] + turning * np.cross(omega_b, r_b))
        )
        return _dot(relative, n) + carried * _dot(p_a - p_b, n_dot)

    return function


def _pairs(rng: np.random.Generator) -> Sequence[Case]:
    def body(shape: tuple[int, ...] = ()) -> tuple[np.ndarray, ...]:
        return _draw(rng, shape), _draw(rng, shape), _draw(rng, shape)

    def pair(shape: tuple[int, ...] = (), **fixed: Any) -> dict[str, Any]:
        n = _unit(rng, shape)
        # Points that are not opposite each other along N: otherwise the N_dot term is 0 and nobody misses it.
        drawn = {"p_a": _draw(rng, shape), "p_b": _draw(rng, shape), "body_a": body(shape), "body_b": body(shape),
                 "n": n, "n_dot": np.cross(_draw(rng, shape), n)}  # fmt: skip
        return drawn | fixed

    still = (np.array([0.0, 0.0, 0.0]), ZERO, ZERO)
    falling = {
        "p_a": np.array([0.0, 0.5, 0.7]), "p_b": np.array([0.0, 0.5, 0.2]),
        "body_a": (np.array([0.0, 0.0, 1.0]), np.array([0.0, 0.0, -1.0]), np.array([3.0, 0.0, 0.0])),
        "body_b": still, "n": UP, "n_dot": ZERO,
    }  # fmt: skip
    p = _draw(rng)
    x_a, _, omega_a = body()
    x_b, _, omega_b = body()
    return [
        Case("a box that falls and turns over a floor", falling),
        Case("off the axes", pair()),
        Case("off the axes again", pair()),
        Case(
            "both centres stand still", pair(body_a=(x_a, ZERO, omega_a), body_b=(x_b, ZERO, omega_b)), "edge"
        ),
        Case("they touch: p_A = p_B", pair(p_a=p, p_b=p), "edge"),
        Case(
            "nothing turns",
            pair(body_a=(x_a, _draw(rng), ZERO), body_b=(x_b, _draw(rng), ZERO), n_dot=ZERO),
            "edge",
        ),
        Case("three pairs", pair((3,)), "batch"),
        Case("a 2 by 4 batch", pair((2, 4)), "batch"),
        Case(
            "five corners of A over one floor",
            pair((5,), p_b=_draw(rng), body_b=still, n=UP, n_dot=ZERO),
            "batch",
        ),
    ]


MOTION = "(x, v, omega): centre of mass [m], its velocity [m/s], angular velocity [rad/s]"

SEPARATION_RATE = Exercise(
    name="separation_rate",
    rows=(20, 22),
    points=3,
    minutes=12,
    task="Return d_dot = N.(p_A_dot - p_B_dot) + N_dot.(p_A - p_B); a body is the tuple (x, v, omega).",
    arguments=(
        POINT_A,
        POINT_B,
        Value("body_a", "((..., 3), (..., 3), (..., 3))", "", MOTION),
        Value("body_b", "((..., 3), (..., 3), (..., 3))", "", MOTION),
        NORMAL,
        Value("n_dot", "(..., 3)", "1/s", "rate of N"),
    ),
    results=(Value("d_dot", "(...)", "m/s", "rate of the separation"),),
    reference=_rate,
    cases=_pairs,
    mistakes=(
        Mistake(
            "no turning",
            _rate_with(turning=0.0),
            "You use the velocities of the centres. The points that meet are elsewhere on the bodies, and move by "
            "omega x r besides.",
        ),
        Mistake(
            "cross product turned round",
            _rate_with(turning=-1.0),
            "omega x r has the wrong sign: either the order is r x omega, or the arm runs from the point to the "
            "centre. It is omega x r with r = p - x, from the centre to the point.",
        ),
        Mistake(
            "one arm for both bodies",
            _rate_with(arm_b=lambda p_a, p_b, x_a, x_b: p_a - x_a),
            "Both bodies turn with the arm of A. Each has its own arm, from its own centre to its own point: "
            "r_B = p_B - x_B.",
        ),
        Mistake(
            "arm from the origin",
            _rate_with(arm_a=lambda p_a, p_b, x_a, x_b: p_a, arm_b=lambda p_a, p_b, x_a, x_b: p_b),
            "Your arm is the place of the point, measured from the origin of the axes. A body turns about its own "
            "centre: r = p - x.",
        ),
        Mistake(
            "arms from the other centre",
            _rate_with(
                arm_a=lambda p_a, p_b, x_a, x_b: p_a - x_b, arm_b=lambda p_a, p_b, x_a, x_b: p_b - x_a
            ),
            "The arms start at the centre of the other body: r_A = p_A - x_A, r_B = p_B - x_B.",
        ),
        Mistake(
            "p_A on both bodies",
            _rate_with(arm_b=lambda p_a, p_b, x_a, x_b: p_a - x_b),
            "B's arm ends at p_A. That is the same while they touch; while they are apart, B's point is p_B.",
        ),
        Mistake(
            "spins swapped",
            _rate_with(swap=True),
            "Each arm turns with the omega of the other body. Go through which tuple is whose.",
        ),
        Mistake(
            "sign of body B",
            _rate_with(sign_b=1.0),
            "The velocities of the two points are added. What counts is how p_A moves as seen from p_B: subtract.",
        ),
        Mistake(
            "only A",
            _rate_with(sign_b=0.0),
            "Body B is missing. It may move and turn as well, and then its point moves.",
        ),
        Mistake(
            "N_dot lost",
            _rate_with(carried=0.0),
            "The second term, N_dot.(p_A - p_B), is missing. It is zero where the points touch or lie opposite each "
            "other along N, and these need not.",
        ),
        Mistake(
            "sign of N_dot",
            _rate_with(carried=-1.0),
            "The second term has the wrong sign. By the product rule both terms are added.",
        ),
        Mistake(
            "N_dot twice",
            _rate_with(carried=2.0),
            "The second term is taken twice. A factor 2 comes in the *second* derivative only.",
        ),
        Mistake(
            "turned round",
            lambda *given: -_rate(*given),
            "The whole has the wrong sign: below 0 they approach. Take A minus B in both terms.",
        ),
        Mistake(
            "whole speed",
            lambda p_a, p_b, body_a, body_b, n, n_dot: np.linalg.norm(
                _velocity(body_a, p_a - body_a[0]) - _velocity(body_b, p_b - body_b[0]), axis=-1
            ),
            "You return how fast the points move past each other. Only the part along N changes the gap: take the dot "
            "product with N.",
        ),
    ),  # fmt: skip
    hints=(
        "Two steps: the velocity of each point, as in Derive, then the two terms of the product rule.",
        "For each body the arm is r = p - x and the point moves with v + omega x r. Subtract B's from A's, dot with N, "
        "and add (p_A - p_B) dotted with N_dot.",
        "x_a, v_a, omega_a = body_a\n"
        "x_b, v_b, omega_b = body_b\n"
        "p_a_dot = v_a + np.cross(omega_a, ____ - ____)\n"
        "p_b_dot = v_b + np.cross(omega_b, ____ - ____)\n"
        "return np.sum(n * (____ - ____), axis=-1) + np.sum(____ * (p_a - p_b), axis=-1)",
    ),
)


# edge_normal_rate


def _edge_rate(
    *,
    project: bool = True,
    power: int = 1,
    sign: bool = True,
    part_a: float = 1.0,
    part_b: float = 1.0,
    swap: bool = False,
) -> Any:
    """The rate of the normal of two edges with one of its parts changed."""

    def function(e_a: Any, e_b: Any, omega_a: Any, omega_b: Any, n: Any) -> Any:
        if swap:
            omega_a, omega_b = omega_b, omega_a
        u = np.cross(e_a, e_b)
        u_dot = part_a * np.cross(np.cross(omega_a, e_a), e_b) + part_b * np.cross(
            e_a, np.cross(omega_b, e_b)
        )
        rate = u_dot / np.linalg.norm(u, axis=-1)[..., None] ** power
        rate = np.sign(_dot(u, n))[..., None] * rate if sign else rate
        return rate - _dot(rate, n)[..., None] * n if project else rate

    return function


def _edges(rng: np.random.Generator) -> Sequence[Case]:
    def crossing(shape: tuple[int, ...] = (), side: Any = 1.0) -> dict[str, Any]:
        e_a = _unit(rng, shape)
        across = np.cross(e_a, _unit(rng, shape))
        across /= np.linalg.norm(across, axis=-1, keepdims=True)
        angle = rng.uniform(0.5, 1.2, (*shape, 1))
        e_b = np.cos(angle) * e_a + np.sin(angle) * across
        n = np.cross(e_a, e_b) / np.sin(angle) * np.asarray(side)[..., None]
        omega_a, omega_b = _draw(rng, shape), _draw(rng, shape)
        return {"e_a": e_a, "e_b": e_b, "omega_a": omega_a, "omega_b": omega_b, "n": n}

    as_one = np.array([1.0, -2.0, 0.5])
    square = {"e_a": np.array([1.0, 0.0, 0.0]), "e_b": np.array([0.0, 1.0, 0.0]), "n": UP}
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
    return [Case(c.label, {name: c.arguments[name] for name in names}, c.kind) for c in cases]


EDGE_NORMAL_RATE = Exercise(
    name="edge_normal_rate",
    rows=(20,),
    points=2,
    minutes=15,
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
            lambda given, answer: _dot(answer, given["n"]),
            "Your N_dot has a part along N, so N would not keep its length of 1: take that part away.",
        ),
    ),
    mistakes=(
        Mistake(
            "not projected",
            _edge_rate(project=False),
            "Only the part of u_dot across N turns it; the part along N changes the length of u, which N does not "
            "have. Take it away: rate - (rate.N) N.",
        ),
        Mistake(
            "not divided",
            _edge_rate(power=0),
            "u = e_A x e_B is shorter than 1 where the edges are not square to each other, and a short arrow turns "
            "further by the same change: divide by |u|.",
        ),
        Mistake(
            "divided twice",
            _edge_rate(power=2),
            "You divide by |u|^2. N is u/|u|, so its rate holds |u| once.",
        ),
        Mistake(
            "sign left out",
            _edge_rate(sign=False),
            "Right where N lies along e_A x e_B. Where it lies against it, N_dot is turned round as well: the sign of "
            "u.N.",
        ),
        Mistake(
            "only the edge of A",
            _edge_rate(part_b=0.0),
            "The edge of B turns too: u_dot has two terms, one for each edge.",
        ),
        Mistake(
            "only the edge of B",
            _edge_rate(part_a=0.0),
            "The edge of A turns too: u_dot has two terms, one for each edge.",
        ),
        Mistake(
            "spins swapped",
            _edge_rate(swap=True),
            "Each edge turns with the omega of the other body.",
        ),
        Mistake(
            "a face of B",
            lambda e_a, e_b, omega_a, omega_b, n: np.cross(omega_b, n),
            "omega_B x N is the rule for a face of B. Two edges carry the normal together.",
        ),
        Mistake(
            "sign of the second term",
            _edge_rate(part_b=-1.0),
            "The second term of u_dot has the wrong sign: the product rule adds.",
        ),
    ),
    hints=(
        "An edge is an arrow fixed to its body, so e_dot = omega x e. N is u/|u|, up to a sign, with u = e_A x e_B.",
        "u_dot is (omega_A x e_A) x e_B plus e_A x (omega_B x e_B). Divide it by |u|, give it the sign of u.N, and "
        "take its part along N away.",
        "u = np.cross(e_a, e_b)\n"
        "u_dot = np.cross(np.cross(omega_a, e_a), e_b) + np.cross(____, ____)\n"
        "side = np.sign(np.sum(u * n, axis=-1))[..., None]\n"
        "rate = side * u_dot / np.linalg.norm(u, axis=-1)[..., None]\n"
        "return rate - ____ * n",
    ),
)


def _closing() -> float:
    from course.study import TurningPair

    pair = TurningPair()
    return float(contact.separation_rate(pair.bodies(), pair.contacts())[0])


def _left_corner() -> float:
    body = (np.array([0.0, 0.0, 1.0]), np.array([0.0, 0.0, -1.0]), np.array([3.0, 0.0, 0.0]))
    p = np.array([0.0, -0.5, 0.7])
    return float(_rate(p, p * (1, 1, 0), body, (ZERO, ZERO, ZERO), UP, ZERO))


def _top_speed() -> float:
    from course.study import ladder

    scene = ladder(np.radians(60), rate=-1.0)
    bodies, (foot, top) = scene.bodies, scene.contacts.point
    x, v, omega = bodies.position[0], bodies.velocity[0], bodies.angular_velocity[0]
    along, down = (float(np.linalg.norm(point_velocity(v, omega, p - x))) for p in (foot, top))
    return down / along


def _turning_of_the_normal() -> float:
    step, gap = 1e-9, 1e-3
    return float(np.arctan2(step, gap) / step)


PREDICTIONS = (
    Prediction(
        "closing",
        "The bar turns at 1.5 rad/s, the plank at 0.5 rad/s, both against the clock; the corner is 0.8 m left of the "
        "bar's centre and 1 m right of the plank's. At what rate does the gap change, in m/s? (Below 0: it closes.)",
        _closing,
        "The corner comes down at 1.5 * 0.8 = 1.2 m/s and the plank comes up at 0.5 * 1.0 = 0.5 m/s. What moves "
        "are the material points, not the centres.",
        unit="m/s",
        tolerance=0.01,
        later="See",
        wrong={
            0: "That is the rate at which the centres approach. The points that meet are elsewhere.",
            -1.2: "That is the bar alone. The plank turns too, and its face comes up.",
            -0.7: "The bar comes down and the plank comes up: their speeds add.",
            1.7: "The size is right. The gap gets smaller, so its rate is below 0.",
        },
    ),
    Prediction(
        "left_corner",
        "The same box: v = (0, 0, -1), omega = (3, 0, 0), but the left corner, r = (0, -0.5, -0.3). What is d_dot over "
        "a fixed floor, N = (0, 0, 1)?",
        _left_corner,
        "The z component of omega x r is 3 * (-0.5) = -1.5, and the centre adds -1: -2.5 m/s.",
        unit="m/s",
        tolerance=1e-9,
        wrong={
            0.5: "That is the right corner. With r_y = -0.5 the turning brings this one down.",
            -1: "That is the centre. The corner turns besides.",
            -0.1: "You took r_z for r_y: the z component of omega x r is omega_x r_y.",
        },
    ),
    Prediction(
        "top_speed",
        "The ladder slides down, touching both. At 60 degrees its foot moves away from the wall at 1 m/s. How fast "
        "does its top come down?",
        _top_speed,
        "Both d_dot are 0. The foot moves at ell omega sin(60 deg) and the top at ell omega cos(60 deg): their ratio "
        "is tan(60 deg).",
        unit="m/s",
        tolerance=0.01,
        wrong={
            1: "Only at 45 degrees. The ladder keeps its length, not the sum of its reaches along floor and wall.",
            1.7320508: "Turned round: a steep ladder's top comes down slowly while its foot runs.",
        },
    ),
    Prediction(
        "corner_normal",
        "A point passes 1 mm over the corner of a box at 1 m/s; the box lies still. N points from the nearest point of "
        "the box to the point. How fast does N turn, in rad/s, when the point is just past the corner?",
        _turning_of_the_normal,
        "It turns about the corner at v/gap = 1/0.001. Nothing turns but the question which point is nearest, and that "
        "changes the faster the nearer they are.",
        unit="rad/s",
        wrong={
            0: "The box does not turn. But its nearest point is the corner now, and N follows the moving point."
        },
    ),
)

LESSON = Lesson(
    number="13",
    name="separation",
    title="Separation",
    question="Both centres stand still, yet the gap closes. What moves?",
    minutes=75,
    exercises=(TOP_RATE, SEPARATION, NORMAL_RATE, SEPARATION_RATE, EDGE_NORMAL_RATE),
    predictions=PREDICTIONS,
)
