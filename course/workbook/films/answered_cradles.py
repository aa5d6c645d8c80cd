"""Newton's cradle with impulses of one's own beside the right ones."""

from __future__ import annotations

from typing import Any

import numpy as np

from course import formulas
from course.study.cradle_swings import SwingingCradle, by_impulses, swinging_cradle
from course.workbook.films.attempts import Attempt, Stopped, asked_of, moved
from course.workbook.films.cradle_laws import (
    BALLS,
    COLLISIONS,
    KNOBS,
    LENGTH,
    PRESETS,
    SPEED,
    WINDOW,
    cradle_pane,
)
from course.workbook.films.timing import moments
from course.workbook.stage import Curves, Exhibit, Film, Flat, Number

TITLE = "p ≥ 0, w = A p + (1 + e) u ≥ 0, p w = 0"


def answered_cradle_film(against: Any = None) -> Exhibit:
    """Five balls on threads; at the bottom all contacts get their impulses at once.

    Args:
        against: plays a second one beside it: a function of your own with the arguments
            of ``simultaneous_impulses``.
    """
    answer, attempt = asked_of(against)

    def film(coming: float, restitution: float) -> Film:
        def swung(function: Any) -> SwingingCradle:
            law = by_impulses(function, restitution)
            return swinging_cradle(
                BALLS, round(coming), restitution, law=law, speed=SPEED, length=LENGTH
            )

        right = swung(formulas.simultaneous_impulses)
        other = attempt.motion(lambda: swung(answer)) if against is not None else right
        return _film(right, other, None if against is None else attempt)

    return Exhibit(film, KNOBS, (), PRESETS)


def _film(right: SwingingCradle, other: Any, attempt: Attempt | None) -> Film:
    motions = moved(right, other) if attempt else [right]
    strikes = right.half_period * (0.5 + np.arange(COLLISIONS))
    times, after = moments(COLLISIONS * right.half_period, list(strikes), frames=72)
    done = np.searchsorted(strikes, times, side="left") + after
    names = attempt.names if attempt else ("right",)
    last = {
        name: m.at(times, done)[1][:, BALLS - 1]
        for name, m in zip(names, motions, strict=False)
    }
    after_one = np.array([m.velocity[1] for m in motions])
    kept = 100 * np.sum(after_one**2, axis=1) / np.sum(right.velocity[0] ** 2)

    def pane(title: str, motion: SwingingCradle) -> Any:
        return cradle_pane(title, motion.at(times, done))

    return Film(
        attempt.panes(TITLE, pane, right, other) if attempt else [pane("", right)],
        times,
        Flat("xz", WINDOW),
        title="Newton's cradle",
        caption="All contacts get their impulses at once. Do balls go through each other, or leave too fast?",
        ending=_ending(motions, attempt, other),
        charts=[Curves("velocity of ball 5", "m/s", last, colors=["blue", "vermillion"][: len(motions)])],
        counters={"collisions": done.astype(float)},
        numbers=[
            *(Number(f"v{k + 1} after", tuple(after_one[:, k] + 0.0), "m/s") for k in range(BALLS)),
            Number("energy kept", tuple(kept), "%"),
        ],
        speed=0.7,
    )  # fmt: skip


def _ending(motions: list[SwingingCradle], attempt: Attempt | None, other: Any) -> str:
    if attempt and isinstance(other, Stopped):
        return attempt.sentence(other)
    whose = attempt.whose if attempt else "these impulses"
    last = motions[-1].velocity[1]
    if len(motions) == 2 and np.allclose(
        motions[0].velocity, motions[-1].velocity, atol=1e-6
    ):
        return "Here both cradles swing alike"
    closing = np.diff(last)
    if closing.min() < -1e-6:
        k = int(closing.argmin())
        return f"With {whose} ball {k + 1} goes through ball {k + 2}"
    energy = float(np.sum(last**2) / np.sum(motions[0].velocity[0] ** 2))
    if energy > 1 + 1e-6:
        return f"With {whose} there is {energy:.2f} times the energy after the first collision"
    return (
        f"With {whose} {int(np.sum(last > 1e-6))} balls go on after the first collision"
    )
