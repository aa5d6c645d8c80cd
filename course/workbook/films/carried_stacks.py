"""A stack of boxes, carried for a moment by forces of one's own, beside the right ones."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

import numpy as np

from course.study import carried_stacks as study
from course.study.carried_stacks import CarriedStack, carried_stack
from course.workbook.films.attempts import Attempt, Stopped, asked_of, moved
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
    box,
    labelled,
    standing,
)
from course.workbook.stage.words import shown_number

SECONDS, MOST = 0.35, 6  # and boxes
HALF = (
    0.3,
    0.3,
    0.3,
)  # of a box as it is drawn; they are as high as those of the scene [m]
LONGEST = 0.9  # of the forces as they are drawn [m]
#: What is seen, whatever the knobs say: left, bottom, right, top [m].
WINDOW = (-0.9, -0.5, 1.5, 4.4)
KNOBS = (
    Knob("count", "boxes", 4, 2, MOST, 1),
    Knob("top", "mass of the topmost", 1.0, 0.1, 10.0, unit="kg", logarithmic=True),
)
PRESETS = (
    Preset("two", {"count": 2, "top": 1}),
    Preset("four", {"count": 4, "top": 1}),
    Preset("a heavy one on top", {"count": 4, "top": 10}),
)
#: How a function is asked for forces, by its exercise.
ASKED: dict[str, Callable[..., study.Solver]] = {
    "solve_contact_qp": study.by_solver,
    "pivot": study.by_solver,
    "projected_gauss_seidel": study.by_sweeps,
}


def carried_stack_film(against: Any = None, exercise: str = "pivot") -> Exhibit:
    """A stack under the forces that a function gives, beside one that carries itself.

    Args:
        against: plays a second one beside it: a function of your own.
        exercise: whose arguments that function has, one of ``ASKED``.
    """
    says = ASKED[exercise]
    answer, attempt = asked_of(against)
    times = np.linspace(0.0, SECONDS, 36)

    def film(count: float, top: float) -> Film:
        given = round(count), top, times
        right = carried_stack(*given)
        if against is None:
            return _film(right, right, None)
        other = attempt.motion(lambda: carried_stack(*given, says(answer)))
        return _film(right, other, attempt)

    return Exhibit(film, KNOBS, presets=PRESETS)


def _film(right: CarriedStack, other: Any, attempt: Attempt | None) -> Film:
    motions = moved(right, other) if attempt else [right]
    shown = motions[-1]
    scale = _scale(right)

    def pane(title: str, motion: CarriedStack) -> Pane:
        return _pane(title, motion, scale)

    title = "each contact carries all that stands above it"
    gaps = {f"under box {k + 1}": shown.gap[:, k] for k in range(len(shown.force))}
    return Film(
        attempt.panes(title, pane, right, other) if attempt else [pane("", right)],
        right.times,
        Flat("xz", WINDOW),
        title="A stack of boxes",
        caption="For a moment the forces stay as they are at the start. Does a box sink into the one below, "
        "or leave it?",
        ending=_ending(motions, attempt, other),
        charts=[Curves("gaps of the last picture" if attempt else "gaps", "m", gaps, limits=(-0.65, 0.65))],
        numbers=[
            Number(f"{name}{'₁₂₃₄₅₆'[k]}", tuple(round(float(get(m)[k]), 4) for m in motions), unit)
            for name, unit, get in (("f", "N", lambda m: m.force), ("d̈", "m/s²", lambda m: m.acceleration))
            for k in range(len(right.force))
        ],
        speed=0.15,
    )  # fmt: skip


def _scale(right: CarriedStack) -> float:
    """Metres for 1 N: 1, 2 or 5 times a power of ten, so that the right forces are seen."""
    wanted = LONGEST / float(right.force.max())
    power = 10.0 ** np.floor(np.log10(wanted))
    return float(power * max(s for s in (1, 2, 5) if s * power <= wanted))


def _pane(title: str, motion: CarriedStack, scale: float) -> Pane:
    times, count = motion.height.shape
    place = np.zeros((times, count + 1, 3))
    place[:, :count, 2] = motion.height * (2 * HALF[2] / _step(motion))
    place[:, count, 2] = -0.5
    colors = ["orange" if k % 2 else "sky" for k in range(count)]
    boxes = [labelled(box(HALF, color=c), str(k + 1)) for k, c in enumerate(colors)]
    at = np.zeros((count, 3))
    at[:, 0] = HALF[0] + 0.15
    at[:, 2] = 2 * HALF[2] * np.arange(count)
    return Pane(
        [*boxes, standing(box((40.0, 1.0, 0.5)), endless=True)],
        place,
        title=title,
        arrows=[Arrows("force f", np.outer(motion.force, [0, 0, 1.0]), "N", at=at, scale=scale, color="green",
                       numbers=True)],
    )  # fmt: skip


def _step(motion: CarriedStack) -> float:
    """From one centre to the next at the start [m]."""
    return 2 * float(motion.height[0, 0])


def _ending(motions: list[CarriedStack], attempt: Attempt | None, other: Any) -> str:
    if attempt and isinstance(other, Stopped):
        return attempt.sentence(other)
    last = motions[-1]
    whose = attempt.whose if attempt else "these forces"
    if len(motions) == 2 and np.allclose(motions[0].force, last.force, atol=1e-4):
        return "Here both carry the stack alike"
    k = int(last.acceleration.argmin())
    rate = shown_number(float(last.acceleration[k]), 3)
    if last.acceleration[k] < -1e-3:
        return f"With {whose} box {k + 1} sinks into what is below it, d̈ = {rate} m/s²"
    k = int(last.acceleration.argmax())
    rate = shown_number(float(last.acceleration[k]), 3)
    if last.acceleration[k] > 1e-3:
        return f"With {whose} box {k + 1} is thrown off, d̈ = {rate} m/s²"
    return f"With {whose} nothing sinks in, and nothing leaves"
