"""Newton's cradle by three laws: how many balls go out?"""

from __future__ import annotations

from typing import Any

import numpy as np

from course.arrays import Array
from course.contact.collisions import LAWS
from course.study.cradle_swings import SwingingCradle, swinging_cradle
from course.workbook.films.timing import moments
from course.workbook.stage import (
    Arrows,
    Curves,
    Exhibit,
    Film,
    Flat,
    Knob,
    Number,
    Pane,
    Preset,
    Segments,
    ball,
    box,
    labelled,
    standing,
)

BALLS, RADIUS, LENGTH, COLLISIONS = 5, 0.06, 1.0, 4
SPEED = 0.8  # of the balls that come in [m/s]
#: What is seen, whatever the knobs say: left, bottom, right, top [m].
WINDOW = (-0.68, -0.16, 0.68, 1.12)
SCALE = 0.2  # metres drawn for 1 m/s
KNOBS = (
    Knob("coming", "balls that come in", 1, 1, 3, 1),
    Knob("restitution", "restitution e", 1.0, 0.0, 1.0, 0.05),
)
PRESETS = (
    Preset("one", {"coming": 1, "restitution": 1}),
    Preset("two", {"coming": 2, "restitution": 1}),
    Preset("three", {"coming": 3, "restitution": 1}),
    Preset("one, e = 0.8", {"coming": 1, "restitution": 0.8}),
    Preset("one, e = 0", {"coming": 1, "restitution": 0}),
)


def cradle() -> Exhibit:
    """Five balls on threads, one to three of them let go, by each of the three laws."""

    def film(coming: float, restitution: float) -> Film:
        motions = {
            law: swinging_cradle(
                BALLS, round(coming), restitution, law=law, speed=SPEED, length=LENGTH
            )
            for law in LAWS
        }
        return _film(motions, round(coming))

    return Exhibit(
        film,
        KNOBS,
        (),
        PRESETS,
        question="One ball comes in, nothing is lost. Momentum and energy are kept by each of the laws: "
        "do they agree on how many go out?",
        answer="No. By the sequential law and by reflection one ball goes out; by the simultaneous law four do "
        "and the first one bounces back. Both keep momentum and energy: the two balances do not "
        "say what happens.",
    )


def _film(motions: dict[str, SwingingCradle], coming: int) -> Film:
    half = next(iter(motions.values())).half_period
    strikes = half * (0.5 + np.arange(COLLISIONS))
    times, after = moments(COLLISIONS * half, list(strikes), frames=72)
    done = np.searchsorted(strikes, times, side="left") + after
    return Film(
        [cradle_pane(law, motion.at(times, done)) for law, motion in motions.items()],
        times,
        Flat("xz", WINDOW),
        title="Newton's cradle by three laws",
        caption="The same balls come in, and each law says what goes out. Small swings: all are back at the "
        "bottom at the same time.",
        ending=_ending(motions, coming),
        charts=_charts(motions, times, done),
        counters={"collisions": done.astype(float)},
        numbers=_numbers(motions),
        speed=0.7,
    )


def cradle_pane(law: str, moved: tuple[Array, Array]) -> Pane:
    """Balls on threads; displacements and velocities (t, n) [m], [m/s]."""
    shift, speed = moved
    shift = np.clip(
        shift, -LENGTH, LENGTH
    )  # of a wrong answer: as far as threads reach
    hung = 2 * RADIUS * (np.arange(BALLS) - 0.5 * (BALLS - 1))
    place = np.zeros((len(shift), BALLS + 1, 3))
    place[:, :BALLS, 0] = hung + shift
    # On its circle, so that the thread keeps its length.
    place[:, :BALLS, 2] = LENGTH - np.sqrt(LENGTH**2 - shift**2)
    place[:, BALLS] = 0.0, 0.0, LENGTH + 0.03
    top = np.zeros((BALLS, 3))
    top[:, 0], top[:, 2] = hung, LENGTH
    velocity = np.zeros((len(shift), BALLS, 3))
    velocity[..., 0] = speed
    balls = [labelled(ball(RADIUS), str(k + 1)) for k in range(BALLS)]
    threads = Segments(
        "threads", np.broadcast_to(top, velocity.shape), place[:, :BALLS], color="grey"
    )
    return Pane(
        [*balls, standing(box((0.5, 0.1, 0.03)))],
        place,
        title=law,
        arrows=[
            Arrows("velocity", velocity, "m/s", at=place[:, :BALLS], scale=SCALE,
                   color="vermillion", lift=RADIUS + 0.03),
        ],
        segments=[threads],
    )  # fmt: skip


def _charts(motions: dict[str, SwingingCradle], times: Array, done: Any) -> list[Any]:
    def share(motion: SwingingCradle) -> Array:
        """Energy of all balls, kinetic and potential, over that at the start."""
        energy = np.sum(motion.velocity**2, axis=1)
        return np.asarray(100.0 * energy[done] / energy[0])

    last = {
        law: motion.at(times, done)[1][:, BALLS - 1] for law, motion in motions.items()
    }
    kept = {law: share(motion) for law, motion in motions.items()}
    return [
        Curves("velocity of ball 5", "m/s", last, limits=(-1.1, 1.1)),
        Curves("energy of all balls", "%", kept, limits=(0.0, 110.0)),
    ]


def _numbers(motions: dict[str, SwingingCradle]) -> list[Number]:
    after = np.array([m.velocity[1] for m in motions.values()])
    each = [
        Number(f"v{k + 1} after", tuple(after[:, k] + 0.0), "m/s") for k in range(BALLS)
    ]
    kept = 100 * np.sum(after**2, axis=1)
    kept /= np.sum(next(iter(motions.values())).velocity[0] ** 2)
    return [*each, Number("energy kept", tuple(kept), "%")]


def _ending(motions: dict[str, SwingingCradle], coming: int) -> str:
    said = []
    for law, motion in motions.items():
        out = int(np.sum(motion.velocity[1] > 1e-6))
        back = int(np.sum(motion.velocity[1] < -1e-6))
        bounced = f" and {back} back" if back else ""
        said.append(f"{law}, {out} forward{bounced}")
    came = "1 ball comes" if coming == 1 else f"{coming} balls come"
    return f"{came} in. After the first collision: {'; '.join(said)}"
