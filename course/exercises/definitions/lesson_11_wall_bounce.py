"""Lesson 11: the wall bounce, in closed form and step by step."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

import numpy as np

from course.dynamics import bounce_rest_time, bounce_times, wall_bounce
from course.exercises.definition import Case, Exercise, Lesson, Mistake, Prediction, Property, Value

RESTITUTION = Value("restitution", "(...)", "", "e, from 0 to 1")
GRAVITY = Value("gravity", "(...)", "m/s^2", "g, positive")


# wall_bounce


def _unit(rng: np.random.Generator, shape: tuple[int, ...]) -> np.ndarray:
    vector = rng.normal(size=(*shape, 3))
    return np.asarray(vector / np.linalg.norm(vector, axis=-1, keepdims=True))


def _hits(rng: np.random.Generator, shape: tuple[int, ...] = (), speed: Any = None, **fixed: Any) -> dict[str, Any]:
    """Velocities that come in at ``speed`` along the normal and slide across it as well."""
    normal = _unit(rng, shape)
    speed = rng.uniform(0.5, 3.0, shape) if speed is None else np.asarray(speed)
    velocity = np.round(-speed[..., None] * normal + np.cross(normal, rng.normal(size=(*shape, 3))), 3)
    e = np.round(rng.uniform(0.3, 0.8, shape), 3)
    return {"velocity": velocity, "normal": normal, "restitution": e if shape else float(e), **fixed}


def _bounces(rng: np.random.Generator) -> Sequence[Case]:
    floor = {"velocity": np.array([1.0, 0.0, -2.0]), "normal": np.array([0.0, 0.0, 1.0]), "restitution": 0.5}
    return [
        Case("a floor", floor),
        Case("a slanted wall", _hits(rng)),
        Case("the ball already leaves", _hits(rng, speed=-1.2), "edge"),
        Case("the ball slides along the wall", {"velocity": np.array([1.0, 2.0, 0.0]),
             "normal": np.array([0.0, 0.0, 1.0]), "restitution": 0.5}, "edge"),
        Case("nothing lost, e = 1", _hits(rng, restitution=1.0), "edge"),
        Case("it sticks, e = 0", _hits(rng, restitution=0.0), "edge"),
        Case("three balls, as many as a vector has components", _hits(rng, (3,)), "batch"),
        Case("five balls", _hits(rng, (5,)), "batch"),
        Case("a 2 by 4 batch, one restitution for all", _hits(rng, (2, 4), restitution=0.4), "batch"),
        Case("some come, some go", _hits(rng, (4,), speed=[1.0, -1.0, 2.0, -0.5]), "batch"),
    ]  # fmt: skip


def _bounce(factor: Any, *, guard: bool = True) -> Any:
    """The bounce with another factor before (v.n) n."""

    def function(velocity: Any, normal: Any, restitution: Any) -> Any:
        along = np.sum(velocity * normal, axis=-1)[..., None]
        after = velocity - np.asarray(factor(np.asarray(restitution)))[..., None] * along * normal
        return np.where(along < 0, after, velocity) if guard else after

    return function


def _whole_velocity(velocity: Any, normal: Any, restitution: Any) -> Any:
    along = np.sum(velocity * normal, axis=-1)[..., None]
    return np.where(along < 0, -np.asarray(restitution)[..., None] * velocity, velocity)


def _both_parts(velocity: Any, normal: Any, restitution: Any) -> Any:
    along = np.sum(velocity * normal, axis=-1)[..., None]
    return np.where(along < 0, np.asarray(restitution)[..., None] * (velocity - 2 * along * normal), velocity)


def _only_along(velocity: Any, normal: Any, restitution: Any) -> Any:
    along = np.sum(velocity * normal, axis=-1)[..., None]
    return np.where(along < 0, -np.asarray(restitution)[..., None] * along * normal, velocity)


def _axis_short(velocity: Any, normal: Any, restitution: Any) -> Any:
    along = np.sum(velocity * normal, axis=-1)
    after = velocity - (1 + restitution) * along * normal
    return np.where(along < 0, after, velocity)


WALL_BOUNCE = Exercise(
    name="wall_bounce",
    rows=(18,),
    points=2,
    minutes=9,
    task="Return v' = v - (1 + e) (v.n) n for a ball that comes in, v itself for one that does not.",
    arguments=(
        Value("velocity", "(..., 3)", "m/s", "velocity before"),
        Value("normal", "(..., 3)", "", "unit vector out of the wall"),
        RESTITUTION,
    ),
    results=(Value("velocity", "(..., 3)", "m/s", "velocity after"),),
    reference=wall_bounce,
    cases=_bounces,
    properties=(
        Property(
            "no gain",
            lambda given, v: np.maximum(np.sum(np.square(v), -1) - np.sum(np.square(given["velocity"]), -1), 0.0),
            "The ball leaves faster than it came: a wall that stands still gives no energy.",
        ),
        Property(
            "sliding kept",
            lambda given, v: np.cross(v - given["velocity"], given["normal"]),
            "The part of the velocity along the wall changes. Without friction nothing pushes in that direction.",
        ),
    ),
    mistakes=(
        Mistake(
            "always 2",
            _bounce(lambda e: 2.0 + 0 * e),
            "The factor is 2, as on the slide. That is right for e = 1 only; in general it is 1 + e.",
        ),
        Mistake(
            "the slide's line",
            _bounce(lambda e: 2.0 + 0 * e, guard=False),
            "This is the slide's line as it stands: e = 1, and a ball that comes in. In general the factor is 1 + e, "
            "and a ball that already leaves keeps its velocity.",
        ),
        Mistake(
            "the size of v.n",
            lambda velocity, normal, restitution: velocity
            + (1 + np.asarray(restitution))[..., None] * np.abs(np.sum(velocity * normal, axis=-1))[..., None] * normal,
            "Right for balls that come in. With the absolute value you push a ball that already leaves, and it gains "
            "speed: where v.n >= 0 return v as it is.",
        ),
        Mistake(
            "only the part along n",
            _only_along,
            "You return the part along n alone. The part along the wall is not touched and belongs to the answer too.",
        ),
        Mistake(
            "only e",
            _bounce(lambda e: e),
            "The factor is e where it must be 1 + e: your ball goes on into the wall, a little slower.",
        ),
        Mistake(
            "1 - e",
            _bounce(lambda e: 1 - e),
            "The factor is 1 - e. The 1 stops the ball at the wall, and e more sends it back: 1 + e.",
        ),
        Mistake(
            "plus",
            _bounce(lambda e: -(1 + e)),
            "The sign is turned round: v.n is negative for a ball that comes in, so subtract (1 + e) (v.n) n.",
        ),
        Mistake(
            "no guard",
            _bounce(lambda e: 1 + e, guard=False),
            "Right for balls that come in. One that already leaves you throw back into the wall: where v.n >= 0 "
            "return v as it is.",
        ),
        Mistake(
            "whole velocity",
            _whole_velocity,
            "You turn the whole velocity round. Only the part along n meets the wall; the part along the wall stays.",
        ),
        Mistake(
            "friction by the way",
            _both_parts,
            "You multiply the whole reflected velocity by e. e acts on the part along n; sliding is not slowed.",
        ),
        Mistake(
            "one batch axis short",
            _axis_short,
            "Right for one ball, not for a batch: v.n has shape (...) and n has (..., 3). Give the numbers one more "
            "axis, (v.n)[..., None], restitution too if it is an array.",
        ),
    ),
    hints=(
        "Split v into the part along n and the rest. Only the first part changes, and only if it points into the wall.",
        "The speed along n goes from v.n to -e times v.n: subtract (1 + e) times v.n, along n. Where v.n is not "
        "negative keep v.",
        "along = np.sum(velocity * normal, axis=-1)[..., None]\n"
        "after = velocity - (1 + np.asarray(restitution)[..., None]) * ____ * normal\n"
        "return np.where(along < 0, after, ____)",
    ),
)


# The time to rest, the derivation's last step.


def _rest(h: Any, e: Any, g: Any) -> Any:
    return (2 * h / g) ** 0.5 * (1 + e) / (1 - e)


def _rest_points(rng: np.random.Generator) -> Sequence[Case]:
    draws = {"h": rng.uniform(0.5, 3, 8), "e": rng.uniform(0.2, 0.8, 8), "g": rng.uniform(1.5, 20, 8)}
    return [Case("the ball of the text", {"h": 1.0, "e": 0.5, "g": 9.81}), Case("eight drawn points", draws, "batch")]


REST_TIME = Exercise(
    name="rest_time",
    kind="expression",
    rows=(17, 18),
    points=2,
    minutes=8,
    task="Give the time from the drop until the ball rests, in the symbols h, e and g.",
    arguments=(
        Value("h", "scalar", "m", "height of the fall"),
        Value("e", "scalar", "", "restitution"),
        Value("g", "scalar", "m/s^2", "gravity"),
    ),
    results=(Value("rest_time", "(...)", "s"),),
    reference=_rest,
    cases=_rest_points,
    mistakes=(
        Mistake(
            "first fall twice",
            lambda h, e, g: (2 * h / g) ** 0.5 * 2 / (1 - e),
            "You count 2 t_0 for the first fall. The ball starts at the top: only the half flight t_0 is there; every "
            "later flight counts twice.",
        ),
        Mistake(
            "rises forgotten",
            lambda h, e, g: (2 * h / g) ** 0.5 / (1 - e),
            "You count only the falls. Before each later fall the ball rises as long as it falls.",
        ),
        Mistake(
            "first fall forgotten",
            lambda h, e, g: (2 * h / g) ** 0.5 * 2 * e / (1 - e),
            "The first fall, t_0 = sqrt(2 h/g), is missing from the sum.",
        ),
        Mistake(
            "e squared",
            lambda h, e, g: (2 * h / g) ** 0.5 * (1 + e**2) / (1 - e**2),
            "You sum powers of e^2. The *height* shrinks by e^2 at each bounce; the speed, and so the time of a "
            "flight, by e.",
        ),
        Mistake(
            "sqrt(h/g)",
            lambda h, e, g: (h / g) ** 0.5 * (1 + e) / (1 - e),
            "The first fall lasts sqrt(2 h/g): from h = g t^2/2.",
        ),
    ),
    hints=(
        "Add up the flights: the first fall t_0, then each flight up and down lasts e times the one before.",
        "t_0 plus two times t_0 times the sum of e + e^2 + e^3 + ..., and that sum is e/(1 - e).",
        "rest_time = sp.sqrt(2 * h / g) * (1 + 2 * ____ / (1 - ____))",
    ),
)


# bounce_times

COUNT = Value("count", "scalar", "", "how many impacts, at least 1", dtype="int")


def _drops(rng: np.random.Generator) -> Sequence[Case]:
    def drop(shape: tuple[int, ...], count: int) -> dict[str, Any]:
        height, e, g = (rng.uniform(a, b, shape).round(3) if shape else round(rng.uniform(a, b), 3)
                        for a, b in ((0.5, 3), (0.3, 0.8), (1.6, 12)))  # fmt: skip
        return {"height": height, "restitution": e, "count": count, "gravity": g}

    text = {"height": 1.0, "restitution": 0.5, "count": 5, "gravity": 9.81}
    return [
        Case("the ball of the text", text),
        Case("another ball on another planet", drop((), 4)),
        Case("only the first impact", drop((), 1), "edge"),
        Case("it stays down, e = 0", {**text, "restitution": 0.0}, "edge"),
        Case("it bounces for ever, e = 1", {**text, "restitution": 1.0}, "edge"),
        Case("three balls, three impacts", drop((3,), 3), "batch"),
        Case("four balls", drop((4,), 3), "batch"),
        Case("a 2 by 3 batch", drop((2, 3), 6), "batch"),
    ]


def _times(*, double: float = 2.0, first: float = 1.0, power: int = 1, two: float = 2.0, start: int = 1) -> Any:
    """Impact times with one of the sum's parts changed."""

    def function(height: Any, restitution: Any, count: int, gravity: Any) -> Any:
        fall = np.sqrt(two * np.asarray(height) / gravity)[..., None]
        k = np.arange(start, start + count - 1)
        flights = np.asarray(restitution)[..., None] ** (power * k)
        zero = np.zeros((*flights.shape[:-1], 1))
        return fall * (first + double * np.concatenate([zero, np.cumsum(flights, axis=-1)], axis=-1))

    return function


def _lengths_only(height: Any, restitution: Any, count: int, gravity: Any) -> Any:
    times = np.asarray(bounce_times(height, restitution, count, gravity))
    return np.diff(times, axis=-1, prepend=0.0)


BOUNCE_TIMES = Exercise(
    name="bounce_times",
    rows=(17, 18),
    points=2,
    minutes=10,
    task="Return the times of the first `count` impacts of a ball dropped from rest, on a new last axis.",
    arguments=(Value("height", "(...)", "m", "height of the drop"), RESTITUTION, COUNT, GRAVITY),
    results=(Value("times", "(..., count)", "s", "from the drop"),),
    reference=bounce_times,
    cases=_drops,
    properties=(
        Property("in order", lambda given, t: np.minimum(np.diff(t, axis=-1), 0.0), "The times are not in order."),
    ),
    mistakes=(
        Mistake(
            "rises forgotten",
            _times(double=1.0),
            "Each later flight counts once in your sum. The ball goes up and comes down: twice.",
        ),
        Mistake(
            "from the first impact",
            _times(first=0.0),
            "Your clock starts at the first impact. The first fall, sqrt(2 h/g), comes before it.",
        ),
        Mistake(
            "e squared",
            _times(power=2),
            "The flights shrink by e^2 in your answer. That is what the heights do; times go with the speed, by e.",
        ),
        Mistake(
            "first flight not shortened",
            _times(start=0),
            "Your first rise lasts as long as the first fall. The ball has already lost speed there: the powers begin "
            "with e^1.",
        ),
        Mistake(
            "sqrt(h/g)",
            _times(two=1.0),
            "The first fall lasts sqrt(2 h/g): from h = g t^2/2.",
        ),
        Mistake(
            "how long instead of when",
            _lengths_only,
            "These are the lengths of the flights. Asked are the times of the impacts: add them up (np.cumsum).",
        ),
    ),
    hints=(
        "The first impact comes after t_0 = sqrt(2 h/g). Each flight after it lasts 2 e t_0, 2 e^2 t_0, and so on.",
        "Impact k comes at t_0 times one plus two times the sum of the first k powers of e. Make the powers on a new "
        "last axis and use np.cumsum.",
        "k = np.arange(1, count)\n"
        "flights = 2 * np.asarray(restitution)[..., None] ** ____\n"
        "sums = np.cumsum(flights, axis=-1), with a 0 before the first\n"
        "return np.sqrt(2 * height / gravity)[..., None] * (____ + sums)",
    ),
)


# bouncing_ball_step


def _states(rng: np.random.Generator) -> Sequence[Case]:
    def state(height: Any, velocity: Any, step: float = 0.01, restitution: float = 0.7) -> dict[str, Any]:
        return {"height": height, "velocity": velocity, "step": step, "restitution": restitution, "gravity": 9.81}

    drawn = [rng.uniform(-most, most, (2, 3)).round(3) for most in (0.1, 3.0)]
    heights = np.array([0.5, -0.02, -0.01, 0.0, 0.3, -0.03])
    return [
        Case("in the air, falling", state(0.5, -1.0)),
        Case("below the floor, falling", state(-0.02, -3.0)),
        Case("in the air, rising", state(round(rng.uniform(0.2, 1), 3), round(rng.uniform(1, 2), 3))),
        Case("below the floor, falling, another step", state(-0.05, round(rng.uniform(-4, -2), 3), 0.04, 0.4)),
        Case("below the floor, already rising", state(-0.02, 2.0), "edge"),
        Case("exactly on the floor, falling", state(0.0, -2.0), "edge"),
        Case("nothing lost", state(-0.02, -3.0, 0.01, 1.0), "edge"),
        Case("six balls", state(heights, np.array([-1.0, -2.0, 1.5, -0.5, 2.0, -4.0])), "batch"),
        Case("a 2 by 3 batch", state(drawn[0], drawn[1]), "batch"),
    ]


def _ball_step(height: Any, velocity: Any, step: Any, restitution: Any, gravity: Any) -> Any:
    """The order of the engine with the small error: reflect, or else fall; then move with the new velocity."""
    hits = (np.asarray(height) < 0) & (np.asarray(velocity) < 0)
    after = np.where(hits, -restitution * np.asarray(velocity), np.asarray(velocity) - gravity * step)
    return height + step * after, after


def _gravity_first(height: Any, velocity: Any, step: Any, restitution: Any, gravity: Any) -> Any:
    after = np.asarray(velocity) - gravity * step
    after = np.where((np.asarray(height) < 0) & (after < 0), -restitution * after, after)
    return height + step * after, after


def _move_first(height: Any, velocity: Any, step: Any, restitution: Any, gravity: Any) -> Any:
    _, after = _ball_step(height, velocity, step, restitution, gravity)
    return height + step * np.asarray(velocity), after


def _no_rising_guard(height: Any, velocity: Any, step: Any, restitution: Any, gravity: Any) -> Any:
    after = np.where(np.asarray(height) < 0, -restitution * np.asarray(velocity), np.asarray(velocity) - gravity * step)
    return height + step * after, after


def _always_gravity(height: Any, velocity: Any, step: Any, restitution: Any, gravity: Any) -> Any:
    hits = (np.asarray(height) < 0) & (np.asarray(velocity) < 0)
    after = np.where(hits, -restitution * np.asarray(velocity), velocity) - gravity * step
    return height + step * after, after


def _no_restitution(height: Any, velocity: Any, step: Any, restitution: Any, gravity: Any) -> Any:
    return _ball_step(height, velocity, step, 1.0, gravity)


def _clamped(height: Any, velocity: Any, step: Any, restitution: Any, gravity: Any) -> Any:
    moved, after = _ball_step(height, velocity, step, restitution, gravity)
    return np.maximum(moved, 0.0), after


def _touch_counts(height: Any, velocity: Any, step: Any, restitution: Any, gravity: Any) -> Any:
    hits = (np.asarray(height) <= 0) & (np.asarray(velocity) < 0)
    after = np.where(hits, -restitution * np.asarray(velocity), np.asarray(velocity) - gravity * step)
    return height + step * after, after


BOUNCING_BALL_STEP = Exercise(
    name="bouncing_ball_step",
    rows=(18,),
    points=3,
    minutes=10,
    task="Reflect a ball that is below the floor and falling, else let gravity act; then move with the new velocity.",
    arguments=(
        Value("height", "(...)", "m", "of the ball's lowest point; below 0 it is in the floor"),
        Value("velocity", "(...)", "m/s", "upward"),
        Value("step", "scalar", "s", "length of the step"),
        Value("restitution", "scalar", "", "e, from 0 to 1"),
        Value("gravity", "scalar", "m/s^2", "g, positive"),
    ),
    results=(Value("height", "(...)", "m"), Value("velocity", "(...)", "m/s")),
    reference=_ball_step,
    cases=_states,
    mistakes=(
        Mistake(
            "gravity first",
            _gravity_first,
            "Gravity acts before you reflect. This is the other engine's order, the one with the larger error: ask "
            "about the wall first, and let gravity act only where nothing hit.",
        ),
        Mistake(
            "gravity as well",
            _always_gravity,
            "After reflecting you let gravity act too. In this order a step either reflects or falls.",
        ),
        Mistake(
            "moved with the old velocity",
            _move_first,
            "You move with the velocity from before. Change the velocity first, then move with the new one "
            "(symplectic Euler).",
        ),
        Mistake(
            "reflects a rising ball",
            _no_rising_guard,
            "You reflect every ball below the floor. One that already rises is sent down again and sticks in the "
            "floor: ask for velocity < 0 as well.",
        ),
        Mistake(
            "no restitution",
            _no_restitution,
            "Your ball leaves as fast as it came: multiply by e when it is reflected.",
        ),
        Mistake(
            "height clamped",
            _clamped,
            "You lift the ball to the floor. That gives it energy for nothing; in this step the height is only moved "
            "by step * velocity.",
        ),
        Mistake(
            "touching counts as below",
            _touch_counts,
            "A ball exactly at height 0 is not below the floor: reflect where height < 0.",
        ),
    ),
    hints=(
        "Three things happen in this order: ask whether it hits, change the velocity, move. np.where chooses which "
        "change.",
        "It hits where height < 0 and velocity < 0, both. There the velocity becomes -e times itself, elsewhere it "
        "loses g times the step. The height then gains step times the new velocity.",
        "hits = (height < 0) & (____ < 0)\n"
        "after = np.where(hits, ____, velocity - gravity * step)\n"
        "return height + step * ____, after",
    ),
)  # fmt: skip


def _long_normal() -> float:
    down, twice = np.array([0.0, 0.0, -1.0]), np.array([0.0, 0.0, 2.0])
    return float(np.linalg.norm(down - 2 * np.sum(down * twice) * twice))


def _order_choice() -> str:
    from course.study.bouncing_ball import energy_error

    ratio = energy_error("bullet", 1e-4) / energy_error("ode", 1e-4)
    return "alike" if ratio < 2 else "few" if ratio < 50 else "hundreds"


PREDICTIONS = (
    Prediction(
        "order",
        "49 balls bounce for 20 s, nothing lost, a step of 1e-4 s. One program reflects and then lets gravity act, the "
        "other lets gravity act and then reflects. How do their energy errors (mean square) compare?",
        _order_choice,
        "The published figures at this step are 1.85 and 752 J^2.",
        later="Speed against accuracy",
        choices={"alike": "about alike", "few": "a few times", "hundreds": "hundreds of times"},
        wrong={"alike": "The two lines differ by one g dt, once a bounce; but a bounce repeats, and errors add up."},
    ),
    Prediction(
        "rest",
        "A ball dropped from 1 m, e = 1/2, g = 9.81 m/s^2. After how many seconds is it at rest?",
        lambda: float(bounce_rest_time(1.0, 0.5, 9.81)),
        "sqrt(2 h/g) (1 + e)/(1 - e): infinitely many bounces, all done in a finite time.",
        unit="s",
        wrong={0.4515: "That is the first impact alone."},
    ),
    Prediction(
        "long_normal",
        "The programmer forgets to divide n by its length, which is 2. A ball comes straight in at 1 m/s, e = 1. How "
        "fast does it leave?",
        _long_normal,
        "v.n is twice too large, and it multiplies an n twice too long: 2 (v.n) n is four times what it should be, "
        "1 - 8 = -7. The energy grows 49-fold at every bounce.",
        unit="m/s",
        wrong={
            2: "n stands twice in the formula, so its length counts squared.",
            4: "Four times the change, not four times the speed: 1 - 2*4.",
        },
    ),
)  # fmt: skip

LESSON = Lesson(
    number="11",
    name="wall-bounce",
    title="The wall bounce",
    question="One line moved: why 400 times the energy error?",
    minutes=70,
    exercises=(REST_TIME, WALL_BOUNCE, BOUNCE_TIMES, BOUNCING_BALL_STEP),
    predictions=PREDICTIONS,
)
