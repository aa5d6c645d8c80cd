"""A cube on its edge sinks onto another until a verdict says that they overlap."""

from __future__ import annotations

from dataclasses import replace
from typing import Any

import numpy as np

from course import formulas, rotations
from course.arrays import Array
from course.study.shadow_cases import SinkingBoxes, sinking_boxes
from course.workbook.films.attempts import Attempt, Stopped, asked_of, moved
from course.workbook.stage import (
    Curves,
    Exhibit,
    Film,
    Hand,
    Knob,
    Number,
    Pane,
    Preset,
    Segments,
    Space,
    box,
    labelled,
)

LAST = 3.0  # [s]
WINDOW = ((-2.2, -2.0, -1.5), (2.2, 2.0, 5.8))
KNOBS = (
    Knob("aside", "B at x", 0.0, -2.0, 2.0, 0.1, "m"),
    Knob("turn", "B turned about z by", 0.0, -90.0, 90.0, 5.0, "°"),
)
PRESETS = (
    Preset("edge on edge", {"turn": 0, "aside": 0}),
    Preset("edges at 45°", {"turn": -45, "aside": 0}),
    Preset("edges parallel", {"turn": 90, "aside": 0}),
    Preset("beside the edge", {"turn": 0, "aside": 1.2}),
)
QUESTION = (
    "Two cubes of 2 m, each on an edge, the edges crossed. Turn B: at which turn would the six face normals err least, "
    "and by how much do they err at 0 and at 45 degrees?"
)
ANSWER = (
    "By nothing at 90 degrees, where the two edges are parallel. At 0 they would stop B at 3.83 m and at 45 degrees at "
    "3.54 m, while the cubes touch at 2.83 m: a metre too high, and 0.71 m."
)


def sinking(against: Any = None) -> Exhibit:
    """Two cubes with half a side of 1 m; one sinks at 1 m/s until they are said to overlap.

    Args:
        against: plays a second one beside it: an ``oriented_boxes_overlap`` of your own;
            "faces" plays the verdict of the six face normals, and tells nothing else:
            it opens the lesson.
    """
    opening = isinstance(against, str) and against == "faces"
    if opening:
        answer, attempt = six_faces, Attempt("by the six face normals alone")
    else:
        answer, attempt = asked_of(against)
    times = np.linspace(0.0, LAST, 91)

    def film(aside: float, turn: float = 0.0) -> Film:
        right = sinking_boxes(turn, aside, times, formulas.oriented_boxes_overlap)
        if against is None:
            return _film("", right, None, None)
        other = attempt.motion(lambda: sinking_boxes(turn, aside, times, answer))
        if opening:
            film = _film("in truth", right, other, attempt)
            return replace(film, charts=(), numbers=())
        return _film("by all 15 axes", right, other, attempt)

    return Exhibit(
        film,
        KNOBS[:1] if opening else KNOBS,
        [Hand({"aside": (1.0, 0.0, 0.0)}, body=1)],
        () if opening else PRESETS,
        question="" if opening else QUESTION,
        answer="" if opening else ANSWER,
    )


def six_faces(
    center_a: Any, rotation_a: Any, half_a: Any, center_b: Any, rotation_b: Any, half_b: Any
) -> Any:  # fmt: skip
    """The verdict of the face normals alone."""
    axes = formulas.box_axes(rotation_a, rotation_b)[..., :6, :]
    between = np.abs(axes @ (center_b - center_a))
    reach = np.abs(axes @ rotation_a) @ half_a + np.abs(axes @ rotation_b) @ half_b
    return np.all(between <= reach)


def _film(title: str, right: SinkingBoxes, other: Any, attempt: Attempt | None) -> Film:
    motions = moved(right, other) if attempt else [right]
    last = motions[-1]
    gaps = tuple(round(float(max(m.faces[-1], m.edges[-1])), 3) + 0.0 for m in motions)
    names = ("B", "B by the other verdict")
    heights = {name: m.height for name, m in zip(names, motions, strict=False)}
    colors = ["blue", "orange"][: len(motions)]
    curves = {"six face normals": last.faces, "nine products of edges": last.edges}
    return Film(
        attempt.panes(title, _pane, right, other) if attempt else [_pane(title, right)],
        right.times,
        Space("corner", window=WINDOW),
        title="A cube sinks until the verdict is: they overlap",
        caption="The lower cube A stands on an edge, and so does B above it. B stops at the first moment at which "
        "it is said to overlap A. In black: A's upper and B's lower edge.",
        ending=_ending(motions, attempt, other),
        charts=[
            Curves("greatest gap on", "m", curves, limits=(-1.5, 2.2), colors=["vermillion", "green"]),
            Curves("height of B's centre", "m", heights, limits=(1.0, 4.6), colors=colors),
        ],
        numbers=[
            Number("B's centre ends at", tuple(round(float(m.height[-1]), 3) for m in motions), "m"),
            Number("greatest gap there", gaps, "m"),
        ],
        speed=0.6,
    )  # fmt: skip


def _pane(title: str, boxes: SinkingBoxes) -> Pane:
    place = np.zeros((len(boxes.times), 2, 3))
    place[:, 1, :2], place[:, 1, 2] = boxes.place, boxes.height
    turn = rotations.from_matrix(boxes.rotation)
    colors = (("blue", "sky", "blue"), ("orange", "orange", "vermillion"))
    solids = [
        labelled(box(e, color=c), name)
        for e, c, name in zip(boxes.half_extents, colors, "AB", strict=True)
    ]
    # The gap straight above A's upper edge, where both edges cross.
    start = np.zeros((len(boxes.times), 1, 3))
    start[:, 0, 2] = np.sqrt(2.0)
    end = start.copy()
    end[:, 0, 2] += np.maximum(boxes.edges, 0.0)
    gap = Segments(
        "gap", start, end, np.maximum(boxes.edges, 0.0)[:, None], color="green"
    )
    crossed = abs(boxes.place[0]) < 1e-9
    segments = [_edges(boxes, place), *([gap] if crossed else [])]
    return Pane(solids, place, turn, title=title, segments=segments)


def _edges(boxes: SinkingBoxes, place: Array) -> Segments:
    """A's upper edge and B's lower one, a hair outside, or the solids would cover them."""
    up = 1.01 * np.sqrt(2.0) * np.array([[0.0, 0.0, 1.0], [0.0, 0.0, -1.0]])
    along = np.stack([boxes.rotation[0][:, 0], boxes.rotation[1][:, 1]])
    middle = place + up
    return Segments("upper edge of A, lower edge of B", middle - along, middle + along, color="black")  # fmt: skip


def _ending(motions: list[SinkingBoxes], attempt: Attempt | None, other: Any) -> str:
    if attempt and isinstance(other, Stopped):
        return attempt.sentence(other)
    right, last = motions[0], motions[-1]
    if len(motions) == 2 and last.height[-1] != right.height[-1]:
        more = last.height[-1] - right.height[-1]
        if more > 0:
            return f"By this verdict B stops {more:.2f} m too high: nothing is there that it could rest on"
        return f"By this verdict B sinks {-more:.2f} m into A"
    if not last.stopped:
        return "B passes A without touching it"
    return f"B stops on A with its centre at {last.height[-1]:.2f} m"
