"""A ball by steps, or by times of impact, of one's own, beside the right ones."""

from __future__ import annotations

from typing import Any

import numpy as np

from course.arrays import Array
from course.study.stepped_balls import (
    SteppedBall,
    exact_ball,
    flown_ball,
    stepped_ball,
)
from course.workbook.films.attempts import Attempt, Stopped, asked_of, moved
from course.workbook.films.timing import moments
from course.workbook.stage import (
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
    standing,
)
from course.workbook.stage.words import shown_number

DROP, RADIUS, SECONDS, IMPACTS = 1.0, 0.08, 4.0, 6
#: What is seen, whatever the knobs say: left, bottom, right, top [m].
WINDOW = (-0.9, -0.45, 0.9, 1.55)
RESTITUTION = Knob("restitution", "restitution e", 0.8, 0.0, 1.0, 0.05)
STEP = Knob("step", "step", 0.01, 0.002, 0.04, unit="s", logarithmic=True)
BOUNCES = (
    Preset("e = 0.8", {"restitution": 0.8}),
    Preset("nothing is lost", {"restitution": 1.0}),
    Preset("e = 0.5", {"restitution": 0.5}),
)


def ball_steps(against: Any = None) -> Exhibit:
    """A ball over a floor by fixed steps.

    Args:
        against: plays a second one beside it: a function of your own with the arguments
            of ``bouncing_ball_step``.
    """
    answer, attempt = asked_of(against)

    def film(restitution: float, step: float) -> Film:
        given = DROP, restitution, step, SECONDS
        right = stepped_ball(*given)
        other: Any = right
        if against is not None:
            other = attempt.motion(lambda: stepped_ball(*given, function=answer))
        exact = exact_ball(DROP, restitution, right.times)
        shown = None if against is None else attempt
        return _film("reflect or fall, then move", right, other, exact, shown)

    return Exhibit(film, (RESTITUTION, STEP), presets=BOUNCES)


def ball_times(against: Any = None) -> Exhibit:
    """A ball that touches the floor when a formula says so, and falls freely between.

    Args:
        against: plays a second one beside it: a function of your own with the arguments
            of ``bounce_times``.
    """
    answer, attempt = asked_of(against)

    def film(restitution: float) -> Film:
        hits = flown_ball(DROP, restitution, IMPACTS, np.zeros(1))[1]
        times, _ = moments(SECONDS, list(hits), frames=241)
        given = DROP, restitution, IMPACTS, times
        right = flown_ball(*given)[0]
        other: Any = right
        if against is not None:
            other = attempt.motion(lambda: flown_ball(*given, function=answer)[0])
        shown = None if against is None else attempt
        title = "impacts at t₀ (2 (1 + e + ... + eᵏ) − 1)"
        return _film(title, right, other, None, shown)

    return Exhibit(film, (RESTITUTION,), presets=BOUNCES)


def _film(
    title: str,
    right: SteppedBall,
    other: Any,
    exact: SteppedBall | None,
    attempt: Attempt | None,
) -> Film:
    motions = moved(right, other) if attempt else [right]
    names = attempt.names if attempt else ("by steps",)
    shown = dict(zip(names, motions, strict=False))
    if exact is not None:
        shown["exact"] = exact
    colors = ["blue", "vermillion"][: len(motions)] + ["grey"] * (exact is not None)
    energy = {n: 100 * m.energy / right.energy[0] for n, m in shown.items()}
    return Film(
        attempt.panes(title, _pane, right, other) if attempt else [_pane("", right)],
        right.times,
        Flat("xz", WINDOW),
        title="A ball on a floor",
        caption="The grey line is where it was dropped. Look where it is when it turns round, and how high it comes.",
        ending=_ending(motions, attempt, other),
        charts=[
            Curves("height of the lowest point", "m", {n: m.height for n, m in shown.items()},
                   limits=(-0.4, 1.4), colors=colors),
            Curves("energy", "%", energy, limits=(-10.0, 160.0), colors=colors),
        ],
        numbers=[
            Number("deepest in the floor", tuple(max(0.0, -float(m.height.min())) for m in motions), "m"),
            Number("energy at the end", tuple(100 * float(m.energy[-1] / m.energy[0]) for m in motions), "%"),
        ],
    )  # fmt: skip


def _pane(title: str, motion: SteppedBall) -> Pane:
    place: Array = np.zeros((len(motion.times), 2, 3))
    place[:, 0, 2] = motion.height + RADIUS
    place[:, 1, 2] = -1.0
    floor = standing(box((20.0, 1.0, 1.0)), endless=True)
    left, right = [[WINDOW[0], 0.0, DROP]], [[WINDOW[2], 0.0, DROP]]
    level = Segments("dropped from", left, right, color="grey")
    return Pane([ball(RADIUS), floor], place, title=title, segments=[level])


def _ending(motions: list[SteppedBall], attempt: Attempt | None, other: Any) -> str:
    if attempt and isinstance(other, Stopped):
        return attempt.sentence(other)
    names = ("The right one", attempt.short) if attempt else ("It",)
    said = [
        f"{name} is at most {shown_number(max(0.0, -float(m.height.min())), 2)} m in the floor"
        for name, m in zip(names, motions, strict=True)
    ]
    return ", ".join(said)
