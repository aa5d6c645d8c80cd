"""Projected Gauss-Seidel goes through a stack, contact by contact: forces climb it slowly."""

from __future__ import annotations

import numpy as np

from course.arrays import Array
from course.study.swept_stacks import SweptStack, swept_stack
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
    ball,
    box,
    standing,
)

SWEEPS, HIGH, MOST = 60, 0.5, 12  # how many, a box's height [m], most boxes
BESIDE, APART = 0.75, 0.36  # where the forces are drawn, each beside the one below [m]
KNOBS = (
    Knob("count", "boxes", 6, 2, MOST, 1),
    Knob("top", "mass of the topmost", 1.0, 0.01, 100.0, unit="kg", logarithmic=True),
    Knob("relaxation", "relaxation r", 1.0, 0.5, 1.95, 0.05),
)
PRESETS = (
    Preset("three boxes", {"count": 3, "top": 1, "relaxation": 1}),
    Preset("twelve", {"count": 12, "top": 1, "relaxation": 1}),
    Preset("a heavy one on top", {"count": 6, "top": 100, "relaxation": 1}),
    Preset("a light one on top", {"count": 6, "top": 0.01, "relaxation": 1}),
    Preset("twelve, looking ahead", {"count": 12, "top": 1, "relaxation": 1.75}),
)


def sweeps() -> Exhibit:
    """A stack, its forces as they grow, and the residual sweep by sweep."""
    return Exhibit(
        film,
        KNOBS,
        presets=PRESETS,
        question="Every step sets one contact's d̈ to 0. After how many sweeps does the lowest contact of "
        "twelve equal boxes know what stands on it?",
        answer="Not after 60: a sweep shrinks the error by a few percent only. Looking ahead (r = 1.75) it does.",
    )


def film(count: float, top: float, relaxation: float) -> Film:
    """Sixty sweeps; a second of the film is a sweep, and four are played in one."""
    found = swept_stack(round(count), top, relaxation, SWEEPS)
    steps, contacts = found.path.shape
    times = np.arange(steps) / contacts
    return Film(
        [_pane(found, times)],
        times,
        Flat("xz", _window(round(count))),
        title="Sweeps through a stack",
        caption="A second of the film is one sweep. The dot is at the contact that is set; green its force so far, "
        "black the force that carries all above.",
        ending=_ending(found, relaxation),
        charts=_charts(found, round(count), top, relaxation, times),
        counters={"sweep": np.floor(times + 1e-9)},
        numbers=_numbers(found),
        events=tuple(range(SWEEPS + 1)),
        speed=4.0,
    )  # fmt: skip


def longest(count: int) -> float:
    """Of the forces as they are drawn [m]."""
    return 0.4 + 0.2 * count


def _window(count: int) -> tuple[float, float, float, float]:
    """The stack and its forces, whatever stands on top: left, bottom, right, top [m]."""
    return -0.75, -0.35, BESIDE + APART * count + 0.1, HIGH * count + longest(count)


def _pane(found: SweptStack, times: Array) -> Pane:
    steps, count = found.path.shape
    height = HIGH * np.arange(count)
    place = np.zeros((steps, count + 2, 3))
    place[:, :count, 2] = height + 0.5 * HIGH
    place[:, count, 2] = -0.5
    place[:, count + 1, 0] = -0.6
    place[1:, count + 1, 2] = height[np.arange(steps - 1) % count]
    colors = ["orange" if k % 2 else "sky" for k in range(count)]
    boxes = [box((0.5, 0.5, 0.49 * HIGH), color=color) for color in colors]
    at = np.stack([BESIDE + APART * np.arange(count), 0 * height, height], axis=-1)
    scale = longest(count) / float(found.truth.max())
    power = 10.0 ** np.floor(np.log10(scale))
    scale = power * max(s for s in (1, 2, 5) if s * power <= scale)
    up = np.array([0.0, 0.0, 1.0])
    return Pane(
        [*boxes, standing(box((40.0, 1.0, 0.5)), endless=True), ball(0.06, color="vermillion")],
        place,
        arrows=[
            Arrows("force f", found.path[:, :, None] * up, "N", at=at, scale=scale, color="green"),
            Arrows("right force", np.outer(found.truth, up), "N", at=at + [0.13, 0, 0], scale=scale, color="black"),
        ],
    )  # fmt: skip


def _charts(
    found: SweptStack, count: int, top: float, relaxation: float, times: Array
) -> list[Curves]:
    residual = {f"r = {relaxation:g}": found.residual}
    if relaxation != 1.0:
        residual["r = 1"] = swept_stack(count, top, 1.0, SWEEPS).residual
    share = found.path / found.truth
    some = sorted({0, count // 2, count - 1})
    return [
        Curves("residual", "", {n: np.maximum(v, 1e-10) for n, v in residual.items()}, logarithmic=True,
               limits=(1e-9, 1.0), colors=("green", "grey")),
        Curves("force over the right force", "", {f"contact {k + 1}": share[:, k] for k in some},
               limits=(0.0, 1.4), colors=("blue", "vermillion", "purple")),
    ]  # fmt: skip


def _numbers(found: SweptStack) -> list[Number]:
    lowest = float(found.path[-1, 0])
    worst = 100 * float(np.abs(found.path[-1] / found.truth - 1).max())
    return [
        Number("lowest force after 60 sweeps", (lowest,), "N"),
        Number("the right one", (float(found.truth[0]),), "N"),
        Number("a sweep shrinks the error to", (found.factor,), "of it"),
        Number("the worst force is off by", (round(worst, 2),), "%"),
    ]


def _ending(found: SweptStack, relaxation: float) -> str:
    contacts = found.path.shape[1]
    off = np.abs(found.path[::contacts] / found.truth - 1).max(axis=1)
    bad = np.flatnonzero(off > 0.01)
    if len(bad) and bad[-1] == len(off) - 1:
        return f"With r = {relaxation:g}, after {SWEEPS} sweeps a force is still {100 * off[-1]:.0f} % off"
    return f"With r = {relaxation:g}, {bad[-1] + 1} sweeps bring every force within 1 % of the right one"
