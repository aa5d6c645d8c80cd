"""A shape to drag among others until it touches, near the origin and far from it, with its gaps."""

from __future__ import annotations

import numpy as np

from course.study.dragged_shapes import AMONG, DRAGGED, DraggedShape, dragged_shape
from course.study.far_places import spacing
from course.workbook.films.shapes_as_solids import solid_of
from course.workbook.stage import (
    Curves,
    Exhibit,
    Film,
    Flat,
    Hand,
    Knob,
    Number,
    Pane,
    Preset,
    Segments,
)

TIMES = np.linspace(0.0, 6.0, 91)
#: What is seen, whatever the knobs say: left, bottom, right, top [m].
WINDOW = (-4.4, -3.0, 4.6, 3.0)

LABELS, COLORS = ("ball", "rod", "box"), ("blue", "orange", "green")
KNOBS = (
    Knob("shape", "A: 1 ball, 2 rod, 3 box", 1.0, 1.0, 3.0, 1.0),
    Knob("x", "A at x", -0.6, -3.2, 3.2, 0.05, "m"),
    Knob("y", "A at y", -1.7, -2.0, 2.0, 0.05, "m"),
    Knob("far", "from the origin", 1.0, 1.0, 1e7, unit="m", logarithmic=True),
)
PRESETS = (
    Preset("a ball, here", {"shape": 1, "x": -0.6, "y": -1.7, "far": 1}),
    Preset("a rod, here", {"shape": 2, "x": -0.6, "y": -1.7, "far": 1}),
    Preset("a ball, 1,000 km out", {"shape": 1, "x": -0.6, "y": -1.7, "far": 1e6}),
    Preset("a box, 10,000 km out", {"shape": 3, "x": -0.6, "y": -1.7, "far": 1e7}),
)
QUESTION = "10,000 km from the origin on both axes: how far can you drag A without any change in the right picture?"
ANSWER = (
    "By up to 1 m: that is the step of a number of 4 bytes there. Then A jumps, and its gaps with it; the other "
    "three stand at whole metres as well."
)


def touching() -> Exhibit:
    """A ball, a rod or a box to drag; the gaps to three others are written beside it."""
    return Exhibit(
        _film,
        KNOBS,
        [Hand({"x": (1.0, 0.0, 0.0), "y": (0.0, 1.0, 0.0)}, body=3)],
        PRESETS,
        question=QUESTION,
        answer=ANSWER,
    )


def _film(shape: float, x: float, y: float, far: float) -> Film:
    which = round(shape) - 1
    found = [dragged_shape(which, x, y, far, TIMES, size) for size in (8, 4)]
    curves = dict(zip(LABELS, found[0].gap.T, strict=True))
    fewer = dict(zip(LABELS, found[1].gap.T, strict=True))
    least = tuple(round(float(f.gap.min()), 3) + 0.0 for f in found)
    steps = tuple(round(1e3 * spacing(far, s), 3) + 0.0 for s in (8, 4))
    return Film(
        [_pane("places in 8 bytes each", which, found[0]), _pane("places in 4 bytes each", which, found[1])],
        TIMES,
        Flat("xy", WINDOW),
        title="Gaps of a shape that you drag",
        caption="Drag A, or give it another shape; the rod turns. The lines run between nearest points, with the gap "
        "beside them, below 0 where they overlap. Places are stored as seen from an origin that is far away.",
        ending=_ending(found),
        charts=[
            Curves("gap, places in 8 bytes", "m", curves, limits=(-1.5, 4.5), colors=COLORS),
            Curves("gap, places in 4 bytes", "m", fewer, limits=(-1.5, 4.5), colors=COLORS),
        ],
        numbers=[
            Number("least gap in a turn", least, "m"),
            Number("step of the numbers", steps, "mm"),
        ],
    )  # fmt: skip


def _pane(title: str, which: int, found: DraggedShape) -> Pane:
    # A is drawn last, in front of the others.
    solids = [
        solid_of(shape, color, name)
        for shape, color, name in zip(AMONG, COLORS, LABELS, strict=True)
    ] + [solid_of(DRAGGED[which], "sky", "A")]
    lines = [
        Segments(
            name,
            f.point_a[:, None],
            f.point_b[:, None],
            np.round(f.gap, 2)[:, None] + 0.0,
            color=color,
        )
        for name, color, f in zip(LABELS, COLORS, found.found, strict=True)
    ]
    order = [1, 2, 3, 0]
    return Pane(
        solids, found.place[order], found.turn[:, order], title=title, segments=lines
    )


def _ending(found: list[DraggedShape]) -> str:
    said = []
    for f in found:
        met = [n for n, g in zip(LABELS, f.gap.T, strict=True) if g.min() <= 0]
        said.append(", ".join(met) or "nothing")
    if said[0] == said[1]:
        return f"In a turn A meets: {said[0]}"
    return f"In a turn A meets: {said[0]}; with places in 4 bytes: {said[1]}"
