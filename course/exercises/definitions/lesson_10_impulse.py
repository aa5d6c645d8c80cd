"""Lesson 10: impulses between two bodies."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

import numpy as np

from course.dynamics import impulse
from course.exercises.definition import Case, Exercise, Lesson, Mistake, Prediction, Property, Value

MASS_1 = Value("mass_1", "(...)", "kg", "mass of body 1")
MASS_2 = Value("mass_2", "(...)", "kg", "mass of body 2; infinity for a wall")
VELOCITY_1 = Value("velocity_1", "(..., 3)", "m/s", "velocity of body 1 before the impact")
VELOCITY_2 = Value("velocity_2", "(..., 3)", "m/s", "velocity of body 2 before the impact")
NORMAL = Value("normal", "(..., 3)", "", "unit vector out of body 2 toward body 1")
RESTITUTION = Value("restitution", "(...)", "", "e, from 0 to 1")


# Inputs. A normal off the axes, a sliding part in every velocity, e inside (0, 1) and unequal masses: each of them
# tells apart two mistakes that agree where it is missing.


def _unit(rng: np.random.Generator, shape: tuple[int, ...]) -> np.ndarray:
    vector = rng.normal(size=(*shape, 3))
    return np.asarray(vector / np.linalg.norm(vector, axis=-1, keepdims=True))


def _velocities(
    rng: np.random.Generator, shape: tuple[int, ...], normal: np.ndarray, closing: Any
) -> tuple[np.ndarray, np.ndarray]:
    """Velocities with (v2 - v1).n = closing and a sliding part across the normal."""
    velocity_2 = rng.normal(size=(*shape, 3))
    slide = np.cross(normal, rng.normal(size=(*shape, 3)))
    return velocity_2 - np.asarray(closing)[..., None] * normal + slide, velocity_2


def _pair(
    rng: np.random.Generator, shape: tuple[int, ...] = (), *, closing: Any = None, **fixed: Any
) -> dict[str, Any]:
    normal = _unit(rng, shape)
    closing = rng.uniform(0.5, 3.0, shape) if closing is None else closing
    velocity_1, velocity_2 = _velocities(rng, shape, normal, closing)
    pair = {
        "mass_1": rng.uniform(0.5, 2.0, shape),
        "mass_2": rng.uniform(3.0, 6.0, shape),
        "velocity_1": velocity_1,
        "velocity_2": velocity_2,
        "normal": normal,
        "restitution": rng.uniform(0.3, 0.8, shape),
    }
    # Three decimals where it does no harm: these numbers are shown to students.
    pair = {name: value if name == "normal" else np.round(value, 3) for name, value in pair.items()}
    pair.update(fixed)
    return {name: value.item() if isinstance(value, np.ndarray) and value.ndim == 0 else value
            for name, value in pair.items()}  # fmt: skip


ALONG_X = {
    "mass_1": 2.0,
    "mass_2": 1.0,
    "velocity_1": np.array([-3.0, 0.0, 0.0]),
    "velocity_2": np.array([1.0, 0.0, 0.0]),
    "normal": np.array([1.0, 0.0, 0.0]),
    "restitution": 0.5,
}


def _impacts(rng: np.random.Generator) -> Sequence[Case]:
    mixed = rng.uniform(-2.0, 2.0, 6)
    mixed[:2] = 1.0, -1.0
    at_rest = {"velocity_1": np.array([1.0, 2.0, 0.5]), "velocity_2": np.array([1.0, 2.0, 0.5])}
    return [
        Case("head-on along x", ALONG_X),
        Case("off the axes", _pair(rng)),
        Case("off the axes again", _pair(rng)),
        Case("they already part", _pair(rng, closing=-1.5), "edge"),
        Case("they move together", {**_pair(rng), **at_rest}, "edge"),
        Case("nothing lost, e = 1", _pair(rng, restitution=1.0), "edge"),
        Case("they stay together, e = 0", _pair(rng, restitution=0.0), "edge"),
        Case("body 2 is a wall", _pair(rng, mass_2=np.inf, velocity_2=np.zeros(3), **_toward_wall(rng)), "edge"),
        Case("three pairs, as many as a vector has components", _pair(rng, (3,)), "batch"),
        Case("six pairs", _pair(rng, (6,)), "batch"),
        Case("a 2 by 4 batch", _pair(rng, (2, 4)), "batch"),
        Case("some approach, some part", _pair(rng, (6,), closing=mixed), "batch"),
    ]


def _toward_wall(rng: np.random.Generator) -> dict[str, Any]:
    normal = _unit(rng, ())
    return {"normal": normal, "velocity_1": -2.0 * normal + np.cross(normal, rng.normal(size=3))}


def _only(names: Sequence[str], cases: Sequence[Case]) -> list[Case]:
    return [Case(c.label, {name: c.arguments[name] for name in names}, c.kind) for c in cases]


# The formula as it stands in the derivation: the mass, the closing speed and e are what mistakes change.


def _dot(a: Any, b: Any) -> Any:
    return np.sum(np.asarray(a) * b, axis=-1)


def _closing(velocity_1: Any, velocity_2: Any, normal: Any) -> Any:
    return _dot(np.asarray(velocity_2) - velocity_1, normal)


def _reduced(mass_1: Any, mass_2: Any) -> Any:
    return 1 / (1 / np.asarray(mass_1) + 1 / np.asarray(mass_2))


def _approaching(closing: Any, value: Any) -> Any:
    return np.where(closing > 0, value, 0.0)


# p_hat, the last step of the derivation, as an expression.


def _scalar_impulse(m_1: Any, m_2: Any, v_1: Any, v_2: Any, e: Any) -> Any:
    return (1 + e) * (v_2 - v_1) / (1 / m_1 + 1 / m_2)


def _points(rng: np.random.Generator) -> Sequence[Case]:
    v_1 = rng.uniform(-3.0, -1.0, 8)
    draws = {
        "m_1": rng.uniform(0.5, 2.0, 8),
        "m_2": rng.uniform(3.0, 6.0, 8),
        "v_1": v_1,
        "v_2": v_1 + rng.uniform(0.5, 3.0, 8),
        "e": rng.uniform(0.2, 0.9, 8),
    }
    by_hand = {"m_1": 2.0, "m_2": 1.0, "v_1": -3.0, "v_2": 1.0, "e": 0.5}
    return [Case("the numbers worked by hand", by_hand), Case("eight drawn points", draws, "batch")]


P_HAT = Exercise(
    name="p_hat",
    kind="expression",
    rows=(16, 17),
    points=2,
    minutes=8,
    task="Give p_hat in the symbols m_1, m_2, v_1, v_2 and e, where v_1 and v_2 are the speeds along n.",
    arguments=(
        Value("m_1", "scalar", "kg", "mass of body 1"),
        Value("m_2", "scalar", "kg", "mass of body 2"),
        Value("v_1", "scalar", "m/s", "v1.n before"),
        Value("v_2", "scalar", "m/s", "v2.n before"),
        Value("e", "scalar", "", "restitution"),
    ),
    results=(Value("p_hat", "(...)", "N s", "impulse along n"),),
    reference=_scalar_impulse,
    cases=_points,
    mistakes=(
        Mistake(
            "sign",
            lambda m_1, m_2, v_1, v_2, e: -_scalar_impulse(m_1, m_2, v_1, v_2, e),
            "The sign is turned round. While they approach, v_1 < v_2 along n, and an impulse that pushes them apart "
            "is positive: it must contain v_2 - v_1.",
        ),
        Mistake(
            "as printed",
            lambda m_1, m_2, v_1, v_2, e: (1 - e) * (v_2 - v_1) / (1 / m_1 + 1 / m_2),
            "You used the restitution line as the slide prints it, without its minus sign. It gives 1 - e: no impulse "
            "at all when nothing is lost. Take (v1' - v2').n = -e (v1 - v2).n.",
        ),
        Mistake(
            "only e",
            lambda m_1, m_2, v_1, v_2, e: e * (v_2 - v_1) / (1 / m_1 + 1 / m_2),
            "The factor is e where it must be 1 + e. The 1 stops the approach, the e sends them back; at e = 0 there "
            "is still an impulse.",
        ),
        Mistake(
            "no e",
            lambda m_1, m_2, v_1, v_2, e: (v_2 - v_1) / (1 / m_1 + 1 / m_2),
            "e is missing. This impulse only stops the approach, which is right for e = 0.",
        ),
        Mistake(
            "sum of masses",
            lambda m_1, m_2, v_1, v_2, e: (1 + e) * (v_2 - v_1) * (m_1 + m_2),
            "You multiply by m_1 + m_2. The same impulse changes v_1 by p_hat/m_1 and v_2 by p_hat/m_2, so the "
            "inverse masses add: divide by 1/m_1 + 1/m_2.",
        ),
        Mistake(
            "divided by the sum of masses",
            lambda m_1, m_2, v_1, v_2, e: (1 + e) * (v_2 - v_1) / (m_1 + m_2),
            "You divide by m_1 + m_2. The velocities change by p_hat/m_1 and p_hat/m_2, so what adds up are the "
            "inverse masses. (Look at the unit: an impulse is kg m/s.)",
        ),
        Mistake(
            "multiplied by the inverse masses",
            lambda m_1, m_2, v_1, v_2, e: (1 + e) * (v_2 - v_1) * (1 / m_1 + 1 / m_2),
            "You multiply by 1/m_1 + 1/m_2 where you must divide: that bracket stands beside p_hat, not beside the "
            "speeds.",
        ),
        Mistake(
            "difference of inverse masses",
            lambda m_1, m_2, v_1, v_2, e: (1 + e) * (v_2 - v_1) / (1 / m_1 - 1 / m_2),
            "You have 1/m_1 - 1/m_2. Body 2 gets -p_hat, and it is subtracted: v1' - v2' holds "
            "p_hat/m_1 - (-p_hat/m_2), a sum.",
        ),
    ),
    hints=(
        "You have v_1' = v_1 + p/m_1, v_2' = v_2 - p/m_2 and v_1' - v_2' = -e (v_1 - v_2): three equations, and p is "
        "the only unknown you want.",
        "Subtract the second from the first, put the third in its place, collect p on one side, and divide by what "
        "stands before it.",
        "p_hat = (1 + e) * (____ - ____) / (1/m_1 ____ 1/m_2)",
    ),
)


# momentum_after

MOMENTUM_AFTER = Exercise(
    name="momentum_after",
    rows=(15, 16),
    points=1,
    minutes=7,
    task="Return p1' = p1 + p_hat n and p2' = p2 - p_hat n, for one pair and for a batch.",
    arguments=(
        Value("momentum_1", "(..., 3)", "kg m/s", "p1 before"),
        Value("momentum_2", "(..., 3)", "kg m/s", "p2 before"),
        Value("impulse", "(...)", "N s", "p_hat"),
        NORMAL,
    ),
    results=(Value("momentum_1", "(..., 3)", "kg m/s"), Value("momentum_2", "(..., 3)", "kg m/s")),
    reference=impulse.momentum_after,
    cases=lambda rng: [
        Case("one pair along x", dict(momentum_1=np.array([-6.0, 0.0, 0.0]), momentum_2=np.array([1.0, 0.0, 0.0]),
                                      impulse=4.0, normal=np.array([1.0, 0.0, 0.0]))),
        Case("off the axes", _momenta(rng, ())),
        Case("no impulse", {**_momenta(rng, ()), "impulse": 0.0}, "edge"),
        Case("three pairs, as many as a vector has components", _momenta(rng, (3,)), "batch"),
        Case("five pairs", _momenta(rng, (5,)), "batch"),
        Case("a 2 by 4 batch", _momenta(rng, (2, 4)), "batch"),
    ],  # fmt: skip
    properties=(
        Property(
            "momentum",
            lambda given, answer: answer[0] + answer[1] - given["momentum_1"] - given["momentum_2"],
            "The sum of the momenta changes: what one body gains the other must lose.",
        ),
    ),
    mistakes=(
        Mistake(
            "both plus",
            lambda momentum_1, momentum_2, impulse, normal: (
                momentum_1 + _along(impulse, normal), momentum_2 + _along(impulse, normal)),
            "Both bodies gain. What pushes body 1 along +n pushes body 2 along -n: p2' = p2 - p_hat n.",
        ),
        Mistake(
            "swapped",
            lambda momentum_1, momentum_2, impulse, normal: (
                momentum_1 - _along(impulse, normal), momentum_2 + _along(impulse, normal)),
            "The signs are swapped: you push the bodies into each other. n points out of body 2 toward body 1, so "
            "body 1 gets +p_hat n.",
        ),
        Mistake(
            "the pair turned round",
            lambda momentum_1, momentum_2, impulse, normal: (
                momentum_2 - _along(impulse, normal), momentum_1 + _along(impulse, normal)),
            "Both momenta are right, but in the wrong order: return that of body 1 first.",
        ),
        Mistake(
            "no direction",
            lambda momentum_1, momentum_2, impulse, normal: (
                momentum_1 + np.asarray(impulse)[..., None], momentum_2 - np.asarray(impulse)[..., None]),
            "You add the number p_hat to every component. It acts along n: add p_hat n.",
        ),
        Mistake(
            "one batch axis short",
            lambda momentum_1, momentum_2, impulse, normal: (
                momentum_1 + impulse * normal, momentum_2 - impulse * normal),
            "Right for one pair, not for a batch: impulse has shape (...) and normal (..., 3), so impulse needs one "
            "more axis, impulse[..., None] * normal. (np.asarray(impulse)[..., None] serves plain numbers too.)",
        ),
    ),  # fmt: skip
    hints=(
        "Look at the two formulas for momentum under On the slide: each changes by the same vector, with opposite "
        "signs.",
        "The vector is the number p_hat times the unit vector n. In a batch the number needs one more axis before it "
        "multiplies: np.asarray(impulse)[..., None].",
        "change = np.asarray(impulse)[..., None] * ____\nreturn momentum_1 + change, momentum_2 ____ change",
    ),
)


def _along(impulse: Any, normal: Any) -> Any:
    return np.asarray(impulse)[..., None] * normal


def _momenta(rng: np.random.Generator, shape: tuple[int, ...]) -> dict[str, Any]:
    number = rng.uniform(0.5, 4.0, shape).round(3) if shape else round(rng.uniform(0.5, 4.0), 3)
    return {
        "momentum_1": rng.normal(size=(*shape, 3)).round(3),
        "momentum_2": rng.normal(size=(*shape, 3)).round(3),
        "impulse": number if shape else float(number),
        "normal": _unit(rng, shape),
    }


# separation_speed


def _speed_mistake(factor: Any) -> Any:
    """A wrong separation speed: factor(e) times the closing speed, and the guard kept."""

    def function(velocity_1: Any, velocity_2: Any, normal: Any, restitution: Any) -> Any:
        closing = _closing(velocity_1, velocity_2, normal)
        return np.where(closing > 0, factor(restitution) * closing, -closing)

    return function


def _no_normal(velocity_1: Any, velocity_2: Any, normal: Any, restitution: Any) -> Any:
    closing = _closing(velocity_1, velocity_2, normal)
    speed = np.linalg.norm(np.asarray(velocity_2) - velocity_1, axis=-1)
    return np.where(closing > 0, restitution * speed, -closing)


SEPARATION_SPEED = Exercise(
    name="separation_speed",
    rows=(17,),
    points=1,
    minutes=7,
    task="Return (v1' - v2').n after the impact: e times the closing speed; bodies that part keep their speed.",
    arguments=(VELOCITY_1, VELOCITY_2, NORMAL, RESTITUTION),
    results=(Value("separation_speed", "(...)", "m/s", "(v1' - v2').n, never below 0"),),
    reference=impulse.separation_speed,
    cases=lambda rng: _only(("velocity_1", "velocity_2", "normal", "restitution"), _impacts(rng)),
    mistakes=(
        Mistake(
            "as printed",
            _speed_mistake(lambda e: -np.asarray(e)),
            "The sign is the one the slide prints: after the impact your bodies still approach. Before it "
            "(v1 - v2).n is negative; after it, it must be positive: -e (v1 - v2).n.",
        ),
        Mistake(
            "restitution left out",
            _speed_mistake(lambda e: 1.0),
            "They leave as fast as they came, whatever e is. Multiply the closing speed by e.",
        ),
        Mistake(
            "v2 - v1",
            lambda velocity_1, velocity_2, normal, restitution: np.where(
                _closing(velocity_1, velocity_2, normal) < 0,
                -np.asarray(restitution) * _closing(velocity_1, velocity_2, normal),
                _closing(velocity_1, velocity_2, normal)),
            "Your u is (v2 - v1).n, which is positive while they approach. Then u < 0 picks the pairs that part. Take "
            "(v1 - v2).n.",
        ),
        Mistake(
            "guard the wrong way round",
            lambda velocity_1, velocity_2, normal, restitution: np.where(
                _closing(velocity_1, velocity_2, normal) < 0,
                np.asarray(restitution) * _closing(velocity_1, velocity_2, normal),
                -_closing(velocity_1, velocity_2, normal)),
            "Your condition picks the pairs that part and leaves those that approach as they are. They approach where "
            "(v1 - v2).n < 0.",
        ),
        Mistake(
            "0 for those that part",
            lambda velocity_1, velocity_2, normal, restitution: np.maximum(
                np.asarray(restitution) * _closing(velocity_1, velocity_2, normal), 0.0),
            "Right while they approach. Bodies that part have no *impulse*, but they do have a separation speed: the "
            "one they came with.",
        ),
        Mistake(
            "the size for all",
            lambda velocity_1, velocity_2, normal, restitution: np.abs(
                np.asarray(restitution) * _closing(velocity_1, velocity_2, normal)),
            "Right while they approach. With the absolute value you slow down bodies that part by themselves: nothing "
            "happens to them, return u.",
        ),
        Mistake(
            "1 + e",
            _speed_mistake(lambda e: 1 + np.asarray(e)),
            "1 + e is how much the relative speed *changes*. What is left after the impact is e times the closing "
            "speed.",
        ),
        Mistake(
            "squared",
            _speed_mistake(lambda e: np.asarray(e) ** 2),
            "e^2 is what remains of the energy of approach; of the speed, e remains.",
        ),
        Mistake(
            "whole speed",
            _no_normal,
            "You take the length of the whole relative velocity. Only its part along the normal changes; sliding "
            "across it goes on: take the dot product with n.",
        ),
        Mistake(
            "no guard",
            lambda velocity_1, velocity_2, normal, restitution: (
                restitution * _closing(velocity_1, velocity_2, normal)),
            "Right for bodies that approach; those that part you send into each other. Where (v1 - v2).n >= 0 nothing "
            "happens: return it as it is (np.where).",
        ),
    ),  # fmt: skip
    hints=(
        "Restitution speaks of one number only: the relative velocity along the normal, u = (v1 - v2).n.",
        "While u is negative they approach, and afterwards it is -e times what it was. Where u is not negative, it "
        "stays. np.where chooses element by element.",
        "u = np.sum((velocity_1 - velocity_2) * normal, axis=____)\nreturn np.where(u < 0, ____ * u, u)",
    ),
)


# impulse_central


def _impulse(*, mass: Any = _reduced, closing: Any = _closing, factor: Any = None, guard: bool = True) -> Any:
    """The impulse with one of its parts changed."""
    factor = factor or (lambda e: 1 + np.asarray(e))

    def function(
        mass_1: Any, mass_2: Any, velocity_1: Any, velocity_2: Any, normal: Any, restitution: Any
    ) -> Any:
        speed = closing(velocity_1, velocity_2, normal)
        value = factor(restitution) * speed * mass(mass_1, mass_2)
        return _approaching(_closing(velocity_1, velocity_2, normal), value) if guard else value

    return function


IMPULSE_CENTRAL = Exercise(
    name="impulse_central",
    rows=(16, 17),
    points=3,
    minutes=10,
    task="Return p_hat for a central impact, and 0 for bodies that do not approach; mass_2 may be infinite.",
    arguments=(MASS_1, MASS_2, VELOCITY_1, VELOCITY_2, NORMAL, RESTITUTION),
    results=(Value("p_hat", "(...)", "N s", "impulse along n, never below 0"),),
    reference=impulse.impulse_central,
    cases=_impacts,
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
            _impulse(guard=False),
            "Right while they approach. For bodies that already part your impulse is negative: it pulls them back "
            "together. Where (v1 - v2).n >= 0 the impulse is 0.",
        ),
        Mistake(
            "only e",
            _impulse(factor=lambda e: np.asarray(e)),
            "The factor is e where it must be 1 + e: the 1 stops the approach, the e sends them back. At e = 0 you "
            "would let them pass through each other.",
        ),
        Mistake(
            "no e",
            _impulse(factor=lambda e: 1.0),
            "e is missing: you stop the approach and no more.",
        ),
        Mistake(
            "as printed",
            _impulse(factor=lambda e: 1 - np.asarray(e)),
            "The factor is 1 - e, what the slide's restitution line gives as it is printed. With its minus sign "
            "mended it is 1 + e.",
        ),
        Mistake(
            "sign",
            _impulse(closing=lambda a, b, n: -_closing(a, b, n)),
            "The sign is turned round: this impulse pulls approaching bodies together. Along n, take v2 - v1.",
        ),
        Mistake(
            "guard the wrong way round",
            lambda mass_1, mass_2, velocity_1, velocity_2, normal, restitution: np.where(
                _closing(velocity_1, velocity_2, normal) < 0,
                (1 + np.asarray(restitution)) * _closing(velocity_1, velocity_2, normal) * _reduced(mass_1, mass_2),
                0.0),
            "Your condition picks the bodies that part. They approach where (v1 - v2).n < 0.",
        ),
        Mistake(
            "sum of masses",
            _impulse(mass=lambda a, b: np.asarray(a) + b),
            "You multiply by m1 + m2. The inverse masses add: divide by 1/m1 + 1/m2. (A wall, 1/m2 = 0, then leaves "
            "m1.)",
        ),
        Mistake(
            "divided by the sum of masses",
            _impulse(mass=lambda a, b: 1 / (np.asarray(a) + b)),
            "You divide by m1 + m2. Divide by the sum of the inverse masses, 1/m1 + 1/m2.",
        ),
        Mistake(
            "the size for all",
            lambda *given: np.abs(_impulse(guard=False)(*given)),
            "Right while they approach. With the absolute value you push bodies that already part: for them the "
            "impulse is 0.",
        ),
        Mistake(
            "the speed for those that part",
            lambda mass_1, mass_2, velocity_1, velocity_2, normal, restitution: np.where(
                _closing(velocity_1, velocity_2, normal) > 0,
                _impulse(guard=False)(mass_1, mass_2, velocity_1, velocity_2, normal, restitution),
                -_closing(velocity_1, velocity_2, normal)),
            "For bodies that part you return their speed. Asked is an impulse, and there is none: 0.",
        ),
        Mistake(
            "reduced mass as a fraction",
            _impulse(mass=lambda a, b: np.asarray(a) * b / (np.asarray(a) + b)),
            "Right for two bodies, NaN for a wall. Infinity over infinity, as in m1 m2/(m1 + m2), or infinity times 0 "
            "has no value; 1/(1/m1 + 1/m2) does, because 1/infinity is 0.",
        ),
        Mistake(
            "mean of masses",
            _impulse(mass=lambda a, b: 0.5 * (np.asarray(a) + b)),
            "You use the mean of the masses. The inverse masses add: divide by 1/m1 + 1/m2.",
        ),
        Mistake(
            "whole speed",
            _impulse(closing=lambda a, b, n: np.linalg.norm(np.asarray(b) - a, axis=-1)),
            "You take the length of the relative velocity. Without friction only its part along n matters: the dot "
            "product with n.",
        ),
        Mistake(
            "a vector",
            lambda *given: _along(_impulse()(*given), given[4]),
            "You return the vector p_hat n. Return the number p_hat, one for each pair.",
        ),
    ),  # fmt: skip
    hints=(
        "The formula for p_hat under On the slide, with two things added: the dot product over the last axis, and "
        "what happens to bodies that part.",
        "The closing speed is (v2 - v1).n. Where it is positive the impulse is (1 + e) times it, divided by the sum "
        "of the inverse masses; elsewhere it is 0.",
        "closing = np.sum((velocity_2 - velocity_1) * normal, axis=-1)\n"
        "value = (1 + restitution) * closing / (____ + ____)\n"
        "return np.where(closing > 0, value, ____)",
    ),
)


# kinetic_energy_lost


def _lost(
    *, mass: Any = _reduced, factor: Any = None, closing: Any = _closing, half: float = 0.5, guard: bool = True
) -> Any:
    """T_lost with one of its parts changed."""
    factor = factor or (lambda e: 1 - np.asarray(e) ** 2)

    def function(
        mass_1: Any, mass_2: Any, velocity_1: Any, velocity_2: Any, normal: Any, restitution: Any
    ) -> Any:
        speed = closing(velocity_1, velocity_2, normal)
        value = half * mass(mass_1, mass_2) * factor(restitution) * speed**2
        return _approaching(_closing(velocity_1, velocity_2, normal), value) if guard else value

    return function


KINETIC_ENERGY_LOST = Exercise(
    name="kinetic_energy_lost",
    rows=(15, 17),
    points=2,
    minutes=8,
    task="Return T_lost, the kinetic energy that the impact takes away; 0 for bodies that do not approach.",
    arguments=(MASS_1, MASS_2, VELOCITY_1, VELOCITY_2, NORMAL, RESTITUTION),
    results=(Value("T_lost", "(...)", "J", "kinetic energy lost, never below 0"),),
    reference=impulse.kinetic_energy_lost,
    cases=_impacts,
    properties=(
        Property(
            "never gained",
            lambda given, answer: np.minimum(answer, 0.0),
            "A negative loss is energy from nowhere.",
        ),
    ),
    mistakes=(
        Mistake(
            "1 - e",
            _lost(factor=lambda e: 1 - np.asarray(e)),
            "The factor is 1 - e where it must be 1 - e^2: energy goes with the square of the speed, and e^2 of the "
            "energy of approach comes back.",
        ),
        Mistake(
            "(1 - e)^2",
            _lost(factor=lambda e: (1 - np.asarray(e)) ** 2),
            "(1 - e)^2 is not 1 - e^2. Before the impact the energy of approach is mu u^2/2, after it mu (e u)^2/2: "
            "subtract.",
        ),
        Mistake(
            "what remains",
            _lost(factor=lambda e: np.asarray(e) ** 2),
            "This is the energy of approach that comes back, e^2 of it. Lost is the rest, 1 - e^2.",
        ),
        Mistake(
            "speed not squared",
            lambda mass_1, mass_2, velocity_1, velocity_2, normal, restitution: _approaching(
                _closing(velocity_1, velocity_2, normal),
                0.5 * _reduced(mass_1, mass_2) * (1 - np.asarray(restitution) ** 2)
                * _closing(velocity_1, velocity_2, normal)),
            "The speed is not squared: your unit is kg m/s, not J.",
        ),
        Mistake(
            "mass of body 1",
            _lost(mass=lambda a, b: np.asarray(a) + 0 / np.asarray(b)),
            "You use the mass of body 1 alone. Both bodies give up energy: take the reduced mass.",
        ),
        Mistake(
            "half forgotten",
            _lost(half=1.0),
            "Twice too much: the half of m v^2/2 is missing.",
        ),
        Mistake(
            "sum of masses",
            _lost(mass=lambda a, b: np.asarray(a) + b),
            "You use m1 + m2. The energy of approach belongs to the reduced mass, 1/(1/m1 + 1/m2); with m1 + m2 you "
            "could lose more than there is.",
        ),
        Mistake(
            "reduced mass upside down",
            _lost(mass=lambda a, b: 1 / np.asarray(a) + 1 / np.asarray(b)),
            "Your mass is 1/m1 + 1/m2, in 1/kg. The reduced mass is one over that.",
        ),
        Mistake(
            "reduced mass as a fraction",
            _lost(mass=lambda a, b: np.asarray(a) * b / (np.asarray(a) + b)),
            "Right for two bodies, NaN for a wall. Infinity over infinity, as in m1 m2/(m1 + m2), or infinity times 0 "
            "has no value; 1/(1/m1 + 1/m2) does, because 1/infinity is 0.",
        ),
        Mistake(
            "guard the wrong way round",
            lambda *given: np.where(_closing(*given[2:5]) < 0, _lost(guard=False)(*given), 0.0),
            "Your condition picks the pairs that part. They approach where (v1 - v2).n < 0.",
        ),
        Mistake(
            "whole speed",
            _lost(closing=lambda a, b, n: np.linalg.norm(np.asarray(b) - a, axis=-1)),
            "You use the whole relative speed. Without friction sliding keeps its energy: only the part along n is "
            "lost.",
        ),
        Mistake(
            "no guard",
            _lost(guard=False),
            "Bodies that already part lose nothing: there is no impact. Return 0 where (v2 - v1).n <= 0.",
        ),
    ),
    hints=(
        "Compare the energy of the relative motion along n before and after: its speed is u before and e u after.",
        "The mass that goes with the relative speed is the reduced mass, one over the sum of the inverse masses. "
        "Half of it times u^2 - (e u)^2 is lost.",
        "u = np.sum((velocity_1 - velocity_2) * normal, axis=-1)\n"
        "lost = 0.5 / (1 / mass_1 + 1 / mass_2) * (1 - ____) * ____**2\n"
        "return np.where(u < 0, lost, 0.0)",
    ),
)


def _blocks() -> int:
    from course.study.two_blocks import count_collisions

    return count_collisions(100**2)


def _cradle_choice() -> str:
    from course.study import ball_impacts

    first = float(ball_impacts.cradle([1.0, 0.0, 0.0], law="simultaneous")[0])
    return "stands" if abs(first) < 1e-9 else "back" if first < 0 else "on"


PREDICTIONS = (
    Prediction(
        "blocks",
        "A block of 10,000 kg slides toward one of 1 kg that stands before a wall. Nothing is lost. How many "
        "collisions are there in all, block against block and block against wall?",
        _blocks,
        "These are the first three digits of pi.",
        tolerance=0.0,
        later="See",
        wrong={
            2: "One block against block, one against the wall: but the small block comes back, again and again.",
            100: "The ratio of the speeds is 100, but the small block gains speed at every impact.",
            10000: "The count grows with the square root of the mass ratio, not with the ratio.",
        },
    ),
    Prediction(
        "equal_balls",
        "Two balls of 1 kg, e = 1, v_1 = -2 m/s, v_2 = 0. What is p_hat?",
        lambda: float(
            impulse.impulse_central(1.0, 1.0, np.array([-2.0, 0.0, 0.0]), np.zeros(3), np.array([1.0, 0.0, 0.0]), 1.0)
        ),
        "The bracket is 1/m_1 + 1/m_2 = 2, so -2 + 2 p_hat = 2 and p_hat = 2 N s: body 1 stops, body 2 leaves with "
        "the speed body 1 had.",
        unit="N s",
        tolerance=1e-9,
        wrong={
            4: "Here the bracket is 1: only one of the two bodies took part.",
            1: "This only stops the approach: e = 0.",
        },
    ),
    Prediction(
        "cradle",
        "Three equal balls hang in a row and touch; the first comes in at 1 m/s, nothing is lost. You solve for both "
        "impulses at once. What does the *first* ball do afterwards?",
        _cradle_choice,
        "Momentum and energy leave room for many outcomes. All at once and one pair after the other are two laws, "
        "and they choose differently; real balls, with springs in between, do a third thing.",
        choices={"stands": "it stands still", "back": "it goes back", "on": "it goes on slowly"},
        wrong={"stands": "This is what the toy shows, nearly: it is the answer of one pair after the other."},
    ),
    Prediction(
        "parting",
        "Two bodies already part at 2 m/s, e = 1/2, and a program calls the slide's formula all the same. At what "
        "separation speed do they leave? (Positive: they part, negative: they approach.)",
        lambda: -0.5 * 2.0,
        "The formula sets the speed along n to -e times what it was, whatever its sign: parting bodies are turned "
        "round into each other. It must ask first whether they approach.",
        unit="m/s",
        wrong={2: "So it should be. The formula does not know it.", 1: "Half the speed, but also the other way round."},
    ),
)

LESSON = Lesson(
    number="10",
    name="impulse",
    title="Impulse",
    question="A wall, 1 kg, 10,000 kg, nothing lost: how many collisions, exactly?",
    minutes=75,
    exercises=(P_HAT, MOMENTUM_AFTER, SEPARATION_SPEED, IMPULSE_CENTRAL, KINETIC_ENERGY_LOST),
    predictions=PREDICTIONS,
)
