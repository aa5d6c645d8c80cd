"""Shots that are looked at in steps, and swept: which hits are missed, and what it costs."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass

import numpy as np

from course import formulas
from course.arrays import Array, BoolArray
from course.overlap import overlaps, swept_bounds, time_of_impact
from course.shapes import Sphere
from course.study.engines import swept_engines
from course.study.precision import Method, Problem, WorkPrecision, work_precision

STEP = 1 / 60  # [s]


@dataclass(frozen=True, eq=False)
class Shots:
    """n balls A, each flying near a ball B for one step.

    Args:
        center_a, velocity_a, center_b, velocity_b: (n, 3) [m], [m/s].
        radius_a, radius_b: (n,) [m].
        step: h [s].
    """

    center_a: Array
    radius_a: Array
    velocity_a: Array
    center_b: Array
    radius_b: Array
    velocity_b: Array
    step: float = STEP

    def __len__(self) -> int:
        return len(self.center_a)

    @property
    def arguments(self) -> tuple[Array | float, ...]:
        """As ``swept_spheres_time`` takes them, the step as horizon."""
        return (
            self.center_a, self.radius_a, self.velocity_a,
            self.center_b, self.radius_b, self.velocity_b, self.step,
        )  # fmt: skip

    @property
    def balls(self) -> tuple[Sphere, Sphere]:
        """A and B at the start."""
        return (
            Sphere(self.center_a, self.radius_a),
            Sphere(self.center_b, self.radius_b),
        )


def random_shots(
    count: int, *, seed: int, speed: float = 900.0, radius: float = 0.002
) -> Shots:
    """Shots that are apart at the start and come near within the step.

    Args:
        speed: the greatest; each is drawn between half of it and it [m/s].
        radius: of A; that of B is drawn between 0.05 and 0.5 m [m].
    """
    rng = np.random.default_rng(seed)
    many = 3 * count
    way, aside = rng.normal(size=(2, many, 3))
    way /= np.linalg.norm(way, axis=-1, keepdims=True)
    aside = np.cross(way, aside)
    aside /= np.linalg.norm(aside, axis=-1, keepdims=True)
    radius_b = rng.uniform(0.05, 0.5, many)
    reach, rate = radius_b + radius, rng.uniform(0.5 * speed, speed, many)
    # Uniform over a disc 1.2 times as wide as what is hit; nearest at any time of the step.
    passes = 1.2 * reach * np.sqrt(rng.uniform(0.0, 1.0, many))
    nearest = rng.uniform(0.0, 1.0, many) * rate * STEP + reach * rng.uniform(
        0.0, 1.0, many
    )
    offset = passes[:, None] * aside - nearest[:, None] * way
    apart = np.flatnonzero(np.sum(offset**2, axis=-1) > reach**2)[:count]
    center_b, carried = rng.uniform(-5.0, 5.0, (2, many, 3))
    return Shots(
        (center_b + offset)[apart], np.full(count, radius), (carried + rate[:, None] * way)[apart],
        center_b[apart], radius_b[apart], carried[apart],
    )  # fmt: skip


def true_hits(shots: Shots) -> BoolArray:
    """Whether they meet within the step, by the library's closed form."""
    a, b = shots.balls
    time = time_of_impact(a, b, shots.velocity_a, shots.velocity_b, horizon=shots.step)
    return np.asarray(np.isfinite(time))


def by_looks(shots: Shots, looks: int) -> tuple[BoolArray, int]:
    """Whether they overlap at one of so many looks a step, and how many tests that took.

    The last look is at the end of the step; who is seen is not looked at again.
    """
    seen, tests = np.zeros(len(shots), dtype=bool), 0
    offset = shots.center_a - shots.center_b
    velocity = shots.velocity_a - shots.velocity_b
    reach = shots.radius_a + shots.radius_b
    for k in range(1, looks + 1):
        left = np.flatnonzero(~seen)
        tests += len(left)
        there = offset[left] + velocity[left] * (shots.step * k / looks)
        seen[left] = np.sum(there**2, axis=-1) <= reach[left] ** 2
    return seen, tests


def by_sweep(shots: Shots) -> tuple[BoolArray, int]:
    """Whether the sweep says that they meet; one test a pair."""
    time = formulas.swept_spheres_time(*shots.arguments)
    return np.isfinite(time), len(shots)


def by_swept_bounds(shots: Shots) -> BoolArray:
    """Whether the boxes around all that they sweep overlap."""
    a, b = shots.balls
    return np.asarray(
        overlaps(
            swept_bounds(a, shots.velocity_a, shots.step),
            swept_bounds(b, shots.velocity_b, shots.step),
        )
    )


def missed_share(said: BoolArray, hits: BoolArray) -> float:
    """Share of the hits that are not said to be any."""
    return float(np.mean(~said[hits]))


def chords(shots: Shots) -> Array:
    """How far A flies within reach of B on its whole line, (n,) [m]; 0 for those that pass.

    2 sqrt(r^2 - h^2), h = |m x v|/|v|
    """
    v = shots.velocity_a - shots.velocity_b
    across = np.linalg.norm(np.cross(shots.center_a - shots.center_b, v), axis=-1)
    reach = shots.radius_a + shots.radius_b
    aside = across / np.linalg.norm(v, axis=-1)
    return np.asarray(2 * np.sqrt(np.maximum(reach**2 - aside**2, 0.0)))


def missed_by_chords(shots: Shots, hits: BoolArray, looks: int) -> float:
    """The share of misses that the chords predict: mean of 1 - chord/way, not below 0."""
    v = np.linalg.norm(shots.velocity_a - shots.velocity_b, axis=-1)
    way, chord = v[hits] * shots.step / looks, chords(shots)[hits]
    return float(np.mean(1 - chord / np.maximum(way, chord)))


def missed_hit_costs(
    shots: Shots, hits: BoolArray, *, looks: tuple[int, ...] = (1, 2, 4, 8, 16, 32, 64, 128, 256), peers: bool = True
) -> WorkPrecision:  # fmt: skip
    """Missed hits against cost: looks, the sweep, and python-fcl and coal where they are installed.

    The counted unit is a test of one pair at one time, or one root. What the libraries
    count inside is not known: they have a count of 0.
    """
    problem = Problem(
        f"{len(shots)} shots", lambda said: missed_share(said, hits),
        "share of hits missed", "the library's time of impact",
    )  # fmt: skip
    methods = [
        Method("k looks a step", lambda k: by_looks(shots, int(k)), looks, "looks"),
        Method("sweep", lambda _: by_sweep(shots), (1,)),
    ]
    for name, asked in swept_engines().items() if peers else ():
        methods.append(Method(name, _asking(asked, shots), (1,)))
    return work_precision(problem, methods, count_unit="tests of a pair")


def _asking(
    asked: Callable[..., BoolArray], shots: Shots
) -> Callable[[float], tuple[BoolArray, int]]:
    return lambda _: (asked(*shots.arguments), 0)
