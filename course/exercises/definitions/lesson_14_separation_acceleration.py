"""Lesson 14: how fast the rate of a gap changes without contact forces, b."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

import numpy as np

from course.exercises.definition import Case, Exercise, Lesson, Mistake, Prediction, Value

UP = np.array([0.0, 0.0, 1.0])
ZERO = np.zeros(3)


def _unit(rng: np.random.Generator, shape: tuple[int, ...] = ()) -> np.ndarray:
    vector = rng.normal(size=(*shape, 3))
    return np.asarray(vector / np.linalg.norm(vector, axis=-1, keepdims=True))


def _draw(rng: np.random.Generator, shape: tuple[int, ...] = (), size: float = 2.0) -> np.ndarray:
    """Vectors of two decimals: they are shown to students."""
    return np.asarray(np.round(rng.uniform(-size, size, (*shape, 3)), 2))


def _dot(a: Any, b: Any) -> Any:
    return np.sum(np.asarray(a) * b, axis=-1)


def _apply(matrix: Any, vector: Any) -> Any:
    return np.einsum("...ij,...j->...i", matrix, vector)


# top_acceleration, the student's step of the derivation: the ladder's top against the wall.


def _top(
    *,
    sign_y: float = -1.0,
    turning: float = 1.0,
    inward: float = 1.0,
    power: int = 2,
    arm: float = 0.5,
    sine: bool = False,
) -> Any:
    """The second rate of the gap at the ladder's top with one of its parts changed."""

    def function(a_y: Any, alpha: Any, omega: Any, theta: Any, ell: Any) -> Any:
        if isinstance(theta, (float, np.ndarray)):
            sin, cos = np.sin(theta), np.cos(theta)
        else:
            import sympy

            sin, cos = sympy.sin(theta), sympy.cos(theta)
            return -a_y + ell / 2 * (alpha * sin + omega**2 * cos)
        return sign_y * a_y + arm * ell * (
            turning * alpha * sin + inward * omega**power * (sin if sine else cos)
        )

    return function


def _ladders(rng: np.random.Generator) -> Sequence[Case]:
    draws = {
        "a_y": np.round(rng.uniform(-3.0, -0.5, 8), 2),
        "alpha": np.round(rng.uniform(-4.0, -0.5, 8), 2),
        "omega": np.round(rng.uniform(-2.0, -0.5, 8), 2),
        "theta": np.round(rng.uniform(0.3, 0.7, 8), 2),
        "ell": np.round(rng.uniform(1.5, 5.0, 8), 2),
    }
    one = {"a_y": -1.0, "alpha": -2.0, "omega": -0.5, "theta": 0.5, "ell": 4.0}
    return [Case("one ladder", one), Case("eight ladders", draws, "batch")]


TOP_ACCELERATION = Exercise(
    name="top_acceleration",
    kind="expression",
    rows=(20, 23),
    points=2,
    minutes=8,
    task="Give the rate of d_2_dot = -v_y + (ell/2) omega sin(theta) in the symbols a_y, alpha, omega, theta and ell.",
    arguments=(
        Value("a_y", "scalar", "m/s^2", "rate of v_y, the centre's acceleration toward the wall"),
        Value("alpha", "scalar", "rad/s^2", "rate of omega"),
        Value("omega", "scalar", "rad/s", "rate of theta"),
        Value("theta", "scalar", "rad", "angle between ladder and floor"),
        Value("ell", "scalar", "m", "length of the ladder"),
    ),
    results=(Value("top_acceleration", "(...)", "m/s^2", "second rate of the gap between top and wall"),),
    reference=_top(),
    cases=_ladders,
    mistakes=(
        Mistake(
            "sine held still",
            _top(inward=0.0),
            "One term is missing: omega sin(theta) is a product, and theta changes too. The rate of sin(theta) is "
            "cos(theta) times omega.",
        ),
        Mistake(
            "omega held still",
            _top(turning=0.0),
            "One term is missing: omega changes as well, at the rate alpha.",
        ),
        Mistake(
            "omega once",
            _top(power=1),
            "In the last term omega stands only once. One omega is the factor in d_2_dot, the second comes from the "
            "chain rule.",
        ),
        Mistake(
            "sign of the last term",
            _top(inward=-1.0),
            "The last term has the wrong sign: the derivative of sin(theta) is +cos(theta).",
        ),
        Mistake(
            "twice",
            _top(inward=2.0),
            "The last term is taken twice. By the product rule, each factor is differentiated once.",
        ),
        Mistake(
            "sine kept",
            _top(sine=True),
            "In the last term you left the sine standing. Its derivative is the cosine.",
        ),
        Mistake(
            "whole length",
            _top(arm=1.0),
            "Your arm is the whole ladder. From the centre to the top it is half the length.",
        ),
        Mistake(
            "sign of a_y",
            _top(sign_y=1.0),
            "The sign of a_y: d_2_dot holds -v_y, and the sign stays with it.",
        ),
        Mistake(
            "centre held still",
            _top(sign_y=0.0),
            "a_y is missing: the centre's velocity changes too.",
        ),
        Mistake(
            "turned round",
            lambda *given: -_top()(*given),
            "All signs are turned round: this is the acceleration of the top toward the wall.",
        ),
    ),
    hints=(
        "Three things in d_2_dot depend on time: v_y, omega and theta. The second term is a product of two of them.",
        "The rate of v_y is a_y. The rate of omega sin(theta) is alpha sin(theta) plus omega times the rate of "
        "sin(theta), which is omega cos(theta).",
        "top_acceleration = -____ + ell / 2 * (alpha * sp.sin(theta) + ____ * sp.cos(theta))",
    ),
)


# angular_acceleration_free


def _spin_rate(
    inverse_inertia: Any,
    angular_momentum: Any,
    angular_velocity: Any,
    torque: Any,
    *,
    gyroscopic: float = 1.0,
) -> Any:
    twist = np.asarray(torque) + gyroscopic * np.cross(angular_momentum, angular_velocity)
    return _apply(inverse_inertia, twist)


def _spins(rng: np.random.Generator) -> Sequence[Case]:
    def spin(shape: tuple[int, ...] = ()) -> dict[str, Any]:
        axes = np.linalg.qr(rng.normal(size=(*shape, 3, 3)))[0]
        moments = np.round(rng.uniform([0.5, 1.5, 3.0], [1.0, 2.5, 4.0], (*shape, 3)), 2)
        inverse = np.round((axes / moments[..., None, :]) @ np.swapaxes(axes, -1, -2), 3)
        inverse = 0.5 * (inverse + np.swapaxes(inverse, -1, -2))
        momentum = _draw(rng, shape)
        return {"inverse_inertia": inverse, "angular_momentum": momentum,
                "angular_velocity": _apply(inverse, momentum), "torque": _draw(rng, shape)}  # fmt: skip

    plain = {
        "inverse_inertia": np.diag([1.0, 0.5, 0.25]), "angular_momentum": np.array([1.0, 2.0, 4.0]),
        "angular_velocity": np.array([1.0, 1.0, 1.0]), "torque": np.array([0.0, 3.0, 0.0]),
    }  # fmt: skip
    ball = {**spin(), "inverse_inertia": 0.5 * np.eye(3)}
    return [
        Case("moments 1, 2 and 4, axes along x, y and z", plain),
        Case("axes turned", spin()),
        Case("axes turned again", spin()),
        Case("no torque", {**spin(), "torque": ZERO}, "edge"),
        Case("a ball: L along omega", {**ball, "angular_velocity": 0.5 * ball["angular_momentum"]}, "edge"),
        Case("three bodies, as many as a vector has components", spin((3,)), "batch"),
        Case("a 2 by 4 batch", spin((2, 4)), "batch"),
    ]


ANGULAR_ACCELERATION_FREE = Exercise(
    name="angular_acceleration_free",
    rows=(23,),
    points=2,
    minutes=7,
    task="Return omega_dot without contact forces, I^-1 (tau + L x omega), for one body and for a batch.",
    arguments=(
        Value("inverse_inertia", "(..., 3, 3)", "1/(kg m^2)", "I^-1 in world axes"),
        Value("angular_momentum", "(..., 3)", "kg m^2/s", "L about the centre of mass, world axes"),
        Value("angular_velocity", "(..., 3)", "rad/s", "omega = I^-1 L"),
        Value("torque", "(..., 3)", "N m", "external torque about the centre of mass"),
    ),
    results=(Value("omega_dot", "(..., 3)", "rad/s^2", "angular acceleration"),),
    reference=_spin_rate,
    cases=_spins,
    mistakes=(
        Mistake(
            "L x omega forgotten",
            lambda i, l_, w, tau: _spin_rate(i, l_, w, tau, gyroscopic=0.0),
            "L x omega is missing. Without a torque L stays, but the body turns under it, so its inertia in world axes "
            "changes and omega with it.",
        ),
        Mistake(
            "omega x L",
            lambda i, l_, w, tau: _spin_rate(i, l_, w, tau, gyroscopic=-1.0),
            "The cross product is turned round: it is L x omega, as it comes to the side of the torque with a minus.",
        ),
        Mistake(
            "as printed",
            lambda i, l_, w, tau: _apply(i, np.asarray(tau) + l_),
            "You have I^-1 L where I^-1 (L x omega) belongs. I^-1 L is omega itself, in rad/s, not an acceleration.",
        ),
        Mistake(
            "not through the inverse inertia",
            lambda i, l_, w, tau: _apply(i, tau) + np.cross(l_, w),
            "L x omega is a torque like tau, in N m: it must go through I^-1 as well.",
        ),
        Mistake(
            "torque forgotten",
            lambda i, l_, w, tau: _apply(i, np.cross(l_, w)) + 0.0 * np.asarray(tau),
            "The external torque is missing: it acts without any contact, so it belongs to b.",
        ),
        Mistake(
            "inertia for its inverse",
            lambda i, l_, w, tau: np.linalg.solve(i, (np.asarray(tau) + np.cross(l_, w))[..., None])[..., 0],
            "You divide by I^-1, which multiplies by I. What is given is the inverse already: multiply by it.",
        ),
        Mistake(
            "matrix product with @",
            lambda i, l_, w, tau: np.asarray(i) @ (np.asarray(tau) + np.cross(l_, w)),
            "Right for one body. In a batch, @ takes the last two axes of both sides for matrices, and your vectors "
            'have one: np.einsum("...ij,...j->...i", matrix, vector) does it for any batch.',
        ),
        Mistake(
            "diagonal alone",
            lambda i, l_, w, tau: (
                np.einsum("...ii->...i", np.asarray(i)) * (np.asarray(tau) + np.cross(l_, w))
            ),
            "You use the diagonal of I^-1 alone. That is right only while the body's axes lie along those of the "
            "world: multiply by the whole matrix.",
        ),
    ),
    hints=(
        "See Derive, step 3. The torque and the gyroscopic term are added first and go through I^-1 together.",
        "Add tau and L x omega, then multiply the matrix I^-1 by the sum. For a batch np.einsum names the axes: "
        '"...ij,...j->...i" is matrix times vector.',
        'twist = torque + np.cross(____, ____)\nreturn np.einsum("...ij,...j->...i", ____, twist)',
    ),
)


# free_point_acceleration


def _point(
    *,
    turning: float = 1.0,
    inward: float = 1.0,
    crossed: bool = True,
    twice: bool = True,
    flat: bool = False,
    extra: float = 0.0,
) -> Any:
    """The acceleration of a point with one of its parts changed."""

    def function(acceleration: Any, angular_acceleration: Any, angular_velocity: Any, arm: Any) -> Any:
        once = np.cross(angular_velocity, arm)
        inner = np.cross(angular_velocity, once) if twice else once
        if flat:
            inner = -np.sum(np.asarray(angular_velocity) ** 2, axis=-1)[..., None] * arm
        swing = np.cross(angular_acceleration, arm) if crossed else np.asarray(angular_acceleration)
        return np.asarray(acceleration) + turning * swing + inward * inner + extra * once

    return function


def _points(rng: np.random.Generator) -> Sequence[Case]:
    def point(shape: tuple[int, ...] = ()) -> dict[str, Any]:
        names = ("acceleration", "angular_acceleration", "angular_velocity", "arm")
        return {name: _draw(rng, shape) for name in names}

    falling = {
        "acceleration": np.array([0.0, 0.0, -9.81]), "angular_acceleration": np.array([0.0, 1.0, 0.0]),
        "angular_velocity": np.array([2.0, 0.0, 0.0]), "arm": np.array([0.1, 0.5, -0.3]),
    }  # fmt: skip
    spin = _draw(rng)
    return [
        Case("a corner of a falling box", falling),
        Case("off the axes", point()),
        Case("off the axes again", point()),
        Case("the arm lies along omega", {**point(), "angular_velocity": spin, "arm": 0.5 * spin}, "edge"),
        Case("nothing turns", {**point(), "angular_velocity": ZERO, "angular_acceleration": ZERO}, "edge"),
        Case("three points", point((3,)), "batch"),
        Case("a 2 by 4 batch", point((2, 4)), "batch"),
        Case("five points of one body", {**point(), "arm": _draw(rng, (5,))}, "batch"),
    ]


FREE_POINT_ACCELERATION = Exercise(
    name="free_point_acceleration",
    rows=(23, 24),
    points=2,
    minutes=7,
    task="Return p_ddot = v_dot + omega_dot x r + omega x (omega x r), for one point and for a batch.",
    arguments=(
        Value("acceleration", "(..., 3)", "m/s^2", "v_dot, of the centre of mass"),
        Value("angular_acceleration", "(..., 3)", "rad/s^2", "omega_dot"),
        Value("angular_velocity", "(..., 3)", "rad/s", "omega"),
        Value("arm", "(..., 3)", "m", "r, from the centre of mass to the point"),
    ),
    results=(Value("p_ddot", "(..., 3)", "m/s^2", "acceleration of the point"),),
    reference=_point(),
    cases=_points,
    mistakes=(
        Mistake(
            "x r left out",
            _point(crossed=False),
            "omega_dot is added as it is, as in the slide's table, where I^-1 tau lacks its x r. It is in rad/s^2: "
            "crossed with the arm it becomes an acceleration.",
        ),
        Mistake(
            "no centripetal term",
            _point(inward=0.0),
            "The last term is missing or zero. It is omega x (omega x r); with the brackets the other way, "
            "(omega x omega) x r is always zero.",
        ),
        Mistake(
            "no omega_dot",
            _point(turning=0.0),
            "omega_dot x r is missing: the turning itself may speed up or change its axis.",
        ),
        Mistake(
            "outward",
            _point(inward=-1.0),
            "The last term has the wrong sign. A point on a circle is accelerated toward the middle: "
            "omega x (omega x r) points inward by itself.",
        ),
        Mistake(
            "order of omega_dot x r",
            _point(turning=-1.0),
            "omega_dot x r is turned round: a cross product changes its sign with the order.",
        ),
        Mistake(
            "omega x r once",
            _point(twice=False),
            "The last term is a velocity: omega x r. Differentiated once more it is omega x (omega x r).",
        ),
        Mistake(
            "omega squared times r",
            _point(flat=True),
            "You have -|omega|^2 r, which is omega x (omega x r) only for an arm at right angles to omega. A point on "
            "the axis is not accelerated at all.",
        ),
        Mistake(
            "factor 2",
            _point(inward=2.0),
            "The last term is taken twice. The arm is fixed to the body: differentiate omega x r, and it comes once.",
        ),
        Mistake(
            "with the velocity",
            _point(extra=1.0),
            "omega x r itself is added too. That is the velocity of the point, in m/s.",
        ),
    ),
    hints=(
        "See Derive, step 2: the velocity v + omega x r, differentiated by the product rule.",
        "Three terms: the centre's acceleration, omega_dot x r, and omega x (omega x r). np.cross inside np.cross.",
        "inward = np.cross(angular_velocity, ____)\nreturn acceleration + np.cross(____, arm) + inward",
    ),
)


# contact_bias


def _bias_with(
    *,
    factor: float = 2.0,
    sign_b: float = -1.0,
    face: Any = None,
    arm_a: Any = None,
    arm_b: Any = None,
    swing: float = 1.0,
    inward: float = 1.0,
    turning: float = 1.0,
    whole: float = 1.0,
) -> Any:
    """b with one of its parts changed; ``face(word, omega_a, omega_b)`` gives the omega that turns N."""

    def function(p: Any, n: Any, word: str, body_a: Any, body_b: Any) -> Any:
        def motion(body: Any, arm: Any) -> tuple[Any, Any]:
            x, v, omega, v_dot, omega_dot = body
            r = arm(p, body_a[0], body_b[0]) if arm else p - x
            p_dot = v + turning * np.cross(omega, r)
            return p_dot, v_dot + swing * np.cross(omega_dot, r) + inward * np.cross(
                omega, np.cross(omega, r)
            )

        (v_a, a_a), (v_b, a_b) = motion(body_a, arm_a), motion(body_b, arm_b)
        of_face = face(word, body_a[2], body_b[2]) if face else body_b[2] if word == "face_b" else body_a[2]
        n_dot = np.cross(of_face, n)
        return whole * (_dot(a_a + sign_b * a_b, n) + factor * _dot(v_a + sign_b * v_b, n_dot))

    return function


def _touching(rng: np.random.Generator) -> Sequence[Case]:
    def body(shape: tuple[int, ...] = ()) -> tuple[np.ndarray, ...]:
        return tuple(_draw(rng, shape) for _ in range(5))

    def touch(word: str, shape: tuple[int, ...] = (), **fixed: Any) -> dict[str, Any]:
        drawn = {
            "p": _draw(rng, shape),
            "n": _unit(rng, shape),
            "face": word,
            "body_a": body(shape),
            "body_b": body(shape),
        }
        return drawn | fixed

    ground: dict[str, Any] = {"p": ZERO, "n": UP, "face": "face_b"}
    floor = (np.array([0.0, 0.0, -1.0]), ZERO, ZERO, ZERO, ZERO)
    corner = (
        np.array([0.0, -0.5, 0.3]),
        np.array([0.0, -0.6, -1.0]),
        np.array([2.0, 0.0, 0.0]),
        -9.81 * UP,
        ZERO,
    )
    turntable = (np.array([0.0, -1.0, -0.2]), ZERO, np.array([0.5, 0.0, 0.0]), ZERO, ZERO)
    puck = (np.array([0.0, 0.5, 0.1]), np.array([0.0, 1.0, 0.75]), ZERO, -9.81 * UP, ZERO)
    return [
        Case("a corner of a box on the floor", {**ground, "body_a": corner, "body_b": floor}),
        Case("a puck slides on a seesaw", {"p": np.array([0.0, 0.5, 0.0]), "n": UP, "face": "face_b", "body_a": puck,
                                           "body_b": turntable}),
        Case("off the axes, face of B", touch("face_b")),
        Case("off the axes, face of A", touch("face_a")),
        Case("all at rest, only gravity", {**ground, "body_a": (0.5 * UP, ZERO, ZERO, -9.81 * UP, ZERO),
                                           "body_b": floor}, "edge"),
        Case("three contacts, faces of B", touch("face_b", (3,)), "batch"),
        Case("a 2 by 4 batch, faces of A", touch("face_a", (2, 4)), "batch"),
        Case("four feet of one table", touch("face_b", p=_draw(rng, (4,)), n=UP, body_b=floor), "batch"),
    ]  # fmt: skip


MOTION = "(x, v, omega, v_dot, omega_dot), the last two without contact forces"

CONTACT_BIAS = Exercise(
    name="contact_bias",
    rows=(20, 23, 24),
    points=3,
    minutes=14,
    task="Return b = (p_A_ddot - p_B_ddot).N + 2 (p_A_dot - p_B_dot).N_dot for a contact of a face, p_A = p_B = p.",
    arguments=(
        Value("p", "(..., 3)", "m", "the point where they touch"),
        Value("n", "(..., 3)", "", "unit vector out of body B toward body A"),
        Value("face", "word", "", '"face_b" or "face_a": whose face carries N', dtype="str"),
        Value("body_a", "five of (..., 3)", "", MOTION),
        Value("body_b", "five of (..., 3)", "", MOTION),
    ),
    results=(Value("b", "(...)", "m/s^2", "second rate of the gap without contact forces"),),
    reference=_bias_with(),
    cases=_touching,
    mistakes=(
        Mistake(
            "factor 2 missing",
            _bias_with(factor=1.0),
            "The factor 2 is missing. The product rule, used twice, gives the mixed term twice: once each time.",
        ),
        Mistake(
            "N_dot lost",
            _bias_with(factor=0.0),
            "The term with N_dot is missing. It is zero only if the normal stands still or the points move as one.",
        ),
        Mistake(
            "sign of N_dot",
            _bias_with(factor=-2.0),
            "The term with N_dot has the wrong sign: is it omega x N, in this order?",
        ),
        Mistake(
            "sign of body B",
            _bias_with(sign_b=1.0),
            "Body B's motion is added. What counts is how p_A moves as seen from p_B: subtract, in both terms.",
        ),
        Mistake(
            "only A",
            _bias_with(sign_b=0.0),
            "Body B is missing. It may move, turn and fall as well.",
        ),
        Mistake(
            "omega of the wrong body in N_dot",
            _bias_with(face=lambda word, a, b: a if word == "face_b" else b),
            "N turns with the other body: for a face of B it is omega_B x N, for a face of A omega_A x N.",
        ),
        Mistake(
            "always a face of B",
            _bias_with(face=lambda word, a, b: b),
            'Right for a face of B. Where face is "face_a" the normal turns with A.',
        ),
        Mistake(
            "relative spin in N_dot",
            _bias_with(face=lambda word, a, b: a - b),
            "You turn N with the spin of A against B. It belongs to a face, and turns with that face's body alone.",
        ),
        Mistake(
            "one arm for both bodies",
            _bias_with(arm_b=lambda p, x_a, x_b: p - x_a),
            "Both bodies have the arm of A. They touch in one point, but their centres are different: r_B = p - x_B.",
        ),
        Mistake(
            "arm from the origin",
            _bias_with(arm_a=lambda p, x_a, x_b: p, arm_b=lambda p, x_a, x_b: p),
            "Your arm is the place of the point. It is measured from the centre of mass: r = p - x.",
        ),
        Mistake(
            "arms turned round",
            _bias_with(arm_a=lambda p, x_a, x_b: x_a - p, arm_b=lambda p, x_a, x_b: x_b - p),
            "The arms run from the point to the centre. It is r = p - x.",
        ),
        Mistake(
            "no omega_dot",
            _bias_with(swing=0.0),
            "omega_dot x r is missing in the accelerations of the points.",
        ),
        Mistake(
            "no centripetal term",
            _bias_with(inward=0.0),
            "omega x (omega x r) is missing in the accelerations of the points.",
        ),
        Mistake(
            "centres in the velocity",
            _bias_with(turning=0.0),
            "In the term with N_dot you use the velocities of the centres. It wants the points': v + omega x r.",
        ),
        Mistake(
            "centres alone",
            _bias_with(turning=0.0, swing=0.0, inward=0.0),
            "You use velocity and acceleration of the centres throughout. The points that touch are elsewhere.",
        ),
        Mistake(
            "turned round",
            _bias_with(whole=-1.0),
            "The whole has the wrong sign. Take A minus B: gravity on A over a floor must give b below 0.",
        ),
    ),
    hints=(
        "Three parts: velocity and acceleration of the point on each body (your functions do the second), N_dot of the "
        "face, then the two terms.",
        "For each body r = p - x; the point's velocity is v + omega x r and its acceleration is exercise 2. Subtract B "
        "from A; dot the acceleration with N and twice the velocity with N_dot.",
        "x_a, v_a, omega_a, v_a_dot, omega_a_dot = body_a\nr_a = p - ____\n"
        "p_a_ddot = free_point_acceleration(v_a_dot, omega_a_dot, omega_a, r_a)\n"
        "# ... the same for B ...\n"
        'n_dot = np.cross(omega_b if face == "face_b" else ____, n)\n'
        "return np.sum((p_a_ddot - p_b_ddot) * n, axis=-1) + ____ * np.sum((p_a_dot - p_b_dot) * n_dot, axis=-1)",
    ),
)


def _counted_twice() -> str:
    from course.study import Dome

    dome = Dome()
    theta = dome.leaving_angle
    excess = dome.bias_as_printed(theta) - dome.bias(theta)
    parts = {"surface": dome.speed(theta) ** 2 / dome.radius, "gravity": -dome.gravity * np.cos(theta)}
    return min(parts, key=lambda name: abs(parts[name] - excess))


def _ladder_top() -> float:
    from course.contact import separation_acceleration
    from course.study import ladder

    scene = ladder(np.radians(60), rate=-0.5)
    return float(separation_acceleration(scene.bodies, scene.contacts, scene.force, scene.torque)[1])


def _book() -> str:
    inverse, momentum = np.diag([1.0, 0.5, 0.25]), np.array([1.0, 2.0, 4.0])
    change = _spin_rate(inverse, momentum, inverse @ momentum, ZERO)
    return "changes" if np.linalg.norm(change) > 1e-9 else "stays"


PREDICTIONS = (
    Prediction(
        "dome",
        "The printed formula lets the particle leave the dome at 37 degrees, nature at 48. Something in the formula is "
        "counted twice. What?",
        _counted_twice,
        "v^2/R, by which the surface falls away under the particle: once because the normal turns, and once more "
        "because the point of the dome that was touched is left behind.",
        choices={
            "gravity": "the pull of gravity",
            "speed": "the kinetic energy, and with it the speed",
            "surface": "the falling away of the surface under the particle",
        },
        later="Where it breaks",
        wrong={
            "gravity": "Gravity pulls the particle onto the dome: counted twice, it would leave later, not earlier.",
            "speed": "The speed comes from the energy, and is the same in both.",
        },
    ),
    Prediction(
        "thrown_book",
        "A book is thrown spinning, and no torque acts on it. Does its angular velocity stay the same?",
        _book,
        "L stays. The inertia of the book as the world sees it changes while it turns, and omega = I^-1 L with it.",
        choices={"stays": "it stays: no torque, no change", "changes": "it changes all the same"},
        wrong={"stays": "Without a torque the angular momentum L stays. omega is something else."},
    ),
    Prediction(
        "ladder_top",
        "The same sliding ladder: 4 m, 60 degrees, theta decreasing at 0.5 rad/s, no contact forces. What is b_2, "
        "the acceleration of the gap at its top?",
        _ladder_top,
        "a_y = 0 and alpha = 0, so b_2 = (4/2) * 0.25 * cos(60 degrees) = 0.25 m/s^2: without forces the top would "
        "leave the wall.",
        unit="m/s^2",
        tolerance=1e-6,
        wrong={
            0: "Gravity acts along the wall, that is right. But the ladder turns: its top is drawn toward the centre.",
            -0.25: "The top is accelerated toward the centre of the ladder, away from the wall: the gap opens.",
            0.4330127: "That is the sine. The part of the arm that lies across the wall is its cosine.",
            -9.81: "That is gravity, which acts along the wall here.",
        },
    ),
)

LESSON = Lesson(
    number="14",
    name="separation-acceleration",
    title="The acceleration of the separation",
    question="The formula says the particle leaves the dome at 37 degrees, nature says 48: what was counted twice?",
    minutes=75,
    exercises=(TOP_ACCELERATION, ANGULAR_ACCELERATION_FREE, FREE_POINT_ACCELERATION, CONTACT_BIAS),
    predictions=PREDICTIONS,
)
