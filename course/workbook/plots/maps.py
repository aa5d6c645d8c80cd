"""Pictures of lesson 00: the falling boxes, and the whole course at a glance."""

from __future__ import annotations

from typing import Any

import numpy as np
from matplotlib.axes import Axes
from matplotlib.patches import FancyBboxPatch, Rectangle

from course.arrays import Array
from course.dynamics import FallingBoxes
from course.workbook.plots.figure import (
    COLOURS,
    PALETTE,
    arrow,
    axes,
    bare,
    describe,
    side_by_side,
    style,
)


def falling_boxes(boxes: FallingBoxes, *, asked: bool = True, frames: int = 5) -> Axes:
    """The boxes at several times side by side, as a strip of pictures.

    Returns the last one's Axes.
    """
    heights = boxes.stacked if asked else boxes.unasked
    chosen = np.linspace(0, len(boxes.time) - 1, frames).round().astype(int)
    top = float(heights[0].max() + boxes.side + 0.2)
    _, several = side_by_side(frames, size=(8.6, 3.4))
    with style():
        for ax, k in zip(several, chosen, strict=True):
            _boxes(ax, heights[k], boxes.side)
            ax.set(xlim=(0, 1), ylim=(-2.2, top), aspect="equal", xticks=[])
            ax.set_title(f"{boxes.time[k]:.2f} s")
            ax.grid(False)
            if ax is not several[0]:
                ax.set_yticks([])
        several[0].set_ylabel("height [m]")
    end = ", ".join(f"{z:.2f}" for z in heights[-1])
    land = "land on the floor and on each other and stay"
    how = land if asked else "fall through the floor"
    describe(
        several[-1],
        f"{heights.shape[1]} boxes at {frames} times from {boxes.time[0]:.2f} to "
        f"{boxes.time[-1]:.2f} s: they {how}. Heights of their undersides at the end: "
        f"{end} m.",
    )
    return several[-1]


def _boxes(ax: Axes, heights: Array, side: float) -> None:
    """The floor, and each box with its number."""
    ax.axhspan(-2.2, 0.0, color="0.88", lw=0)
    ax.axhline(0.0, color="0.3", lw=1.5, ls="-", marker="")
    middle: dict[str, Any] = {"ha": "center", "va": "center"}
    for i, z in enumerate(heights):
        look: dict[str, Any] = {"fc": PALETTE[COLOURS[i % 6]], "ec": "black"}
        ax.add_patch(Rectangle((0.25, z), side, side, alpha=0.85, **look))
        place = (0.25 + side / 2, z + side / 2)
        ax.text(*place, str(i + 1), color="white", **middle)


# Each stage of the course: the question a program asks, and the lessons that answer it.
STAGES = (
    ("Which shape stands\nfor each body?", "01 02 03", "blue"),
    ("Which of them\nmay touch?", "07 08", "sky"),
    ("Do these two touch,\nwhere, and when?", "04 05 06", "green"),
    ("They collide:\nwhat is the impulse?", "10 11 12", "orange"),
    ("They rest: what forces\nkeep them apart?", "13 14 15 16", "vermillion"),
    ("Where is each body\none step later?", "09 17", "purple"),
)


def course_map(*, ax: Axes | None = None) -> Axes:
    """The loop of a physics program, each stage with its question and its lessons."""
    with style():
        ax = axes(ax, size=(8.8, 3.9))
        places = [(0, 1), (1, 1), (2, 1), (2, 0), (1, 0), (0, 0)]
        for i, (stage, (column, row)) in enumerate(zip(STAGES, places, strict=True)):
            _stage(ax, (3.0 * column, 1.9 * row), i + 1, *stage)
        for (a, b), (c, d) in zip(places, places[1:] + places[:1], strict=True):
            way = np.array([1.27 * np.sign(c - a), 0.68 * np.sign(d - b)])
            start, end = (
                np.array([3.0 * x + 1.15, 1.9 * y + 0.57]) for x, y in ((a, b), (c, d))
            )
            arrow(ax, start + way, end - way, lw=1.6, head=16)
        ax.set(xlim=(-0.2, 8.5), ylim=(-0.2, 3.25), aspect="equal")
        bare(ax)
    stages = (
        (i, q.replace("\n", " "), lessons)
        for i, (q, lessons, _) in enumerate(STAGES, 1)
    )
    spoken = " ".join(
        f"{i}. {question} Lessons {lessons}." for i, question, lessons in stages
    )
    describe(
        ax,
        f"The loop of a program that moves bodies, in six stages. {spoken} Then it "
        "begins again.",
    )
    return ax


def _stage(
    ax: Axes,
    place: tuple[float, float],
    number: int,
    question: str,
    lessons: str,
    colour: str,
) -> None:
    """A stage of the loop in a box with round corners."""
    x, y = place
    look: dict[str, Any] = {"fc": PALETTE[colour], "ec": PALETTE[colour], "lw": 1.6}
    round_box = FancyBboxPatch(
        place, 2.3, 1.15, boxstyle="round,pad=0.08", alpha=0.22, **look
    )
    ax.add_patch(round_box)
    middle: dict[str, Any] = {"ha": "center", "va": "center"}
    ax.text(x + 1.15, y + 0.7, f"{number}. {question}", fontsize=10, **middle)
    said = f"lessons {lessons}"
    ax.text(x + 1.15, y + 0.1, said, fontsize=8.5, color="0.25", **middle)
