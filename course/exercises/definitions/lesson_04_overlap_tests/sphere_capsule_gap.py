"""The exercise ``sphere_capsule_gap``: inputs, comparison and planted mistakes."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from course import formulas
from course.exercises.definition import Case, Exercise, Mistake, Value
from course.exercises.definitions.lesson_04_overlap_tests.shared import (
    Given,
    beside,
    center,
    gaps,
    length,
    point,
    radius,
    segment,
)
from course.exercises.slips import slip

_ARGUMENTS = (
    center("center", "the sphere"),
    length("radius", "radius of the sphere"),
    point("start", "one end of the capsule's segment"),
    point("end", "the other end"),
    length("capsule_radius", "radius of the capsule"),
)
_NEAREST = "closest_point_on_segment(center, start, end)"
_GAP = "np.linalg.norm(center - nearest, axis=-1) - radius - capsule_radius"
_ENDS = "np.sum((center - start) ** 2, axis=-1), np.sum((center - end) ** 2, axis=-1)"
_ON_LINE = (
    "start + np.sum((center - start) * (end - start), axis=-1, keepdims=True) / "
    "np.maximum(np.sum((end - start) ** 2, axis=-1, keepdims=True), 1e-300) * (end - start)"
)


def _given(*values: object) -> Given:
    return {
        v.name: np.asarray(x, float) for v, x in zip(_ARGUMENTS, values, strict=True)
    }


def _drawn(
    rng: np.random.Generator, shape: tuple[int, ...] = (), turn: int = 0
) -> Given:
    """Spheres beside, beyond and before capsules, with gaps of either sign."""
    count = int(np.prod(shape)) + turn
    start, end = segment(rng, (count,))
    r, big = radius(rng, (count,)), radius(rng, (count,))
    distance = np.abs(r + big + gaps(rng, (count,)))
    x = beside(rng, start, end, distance)
    given = x, r, start, end, big
    return _given(*(v[turn:].reshape((*shape, *v.shape[1:])) for v in given))


def _cases(rng: np.random.Generator) -> Sequence[Case]:
    a, b = np.array([1.0, 2, 3]), np.array([1.0, 2, 7])
    return [
        Case("beside the middle", _given([4.0, 6, 5], 1.5, a, b, 0.5)),
        Case("beyond the end", _given([1.0, 5, 11], 1.5, a, b, 0.5)),
        Case("beside it, drawn", _drawn(rng)),
        Case("beyond the end, drawn", _drawn(rng, turn=1)),
        Case("before the start, drawn", _drawn(rng, turn=2)),
        Case("its centre lies on the segment", _given([1.0, 2, 4], 0.3, a, b, 0.8), "edge"),
        Case("they touch", _given([4.0, 6, 5], 3.0, a, b, 2.0), "edge"),
        Case("the capsule is a sphere", _given([4.0, 6, 3], 0.7, a, a, 0.4), "edge"),
        Case("three of them", _drawn(rng, (3,)), "batch"),
        Case("twelve of them", _drawn(rng, (12,)), "batch"),
        Case("a 2 by 6 batch", _drawn(rng, (2, 6)), "batch"),
    ]  # fmt: skip


def _wrong(name: str, message: str, *edits: str) -> Mistake:
    return Mistake(name, slip(formulas.sphere_capsule_gap, *edits), message)


SPHERE_CAPSULE_GAP = Exercise(
    name="sphere_capsule_gap",
    rows=(3,),
    points=2,
    minutes=7,
    task="Return the gap of a sphere and a capsule: above 0 apart, 0 touching, below 0 overlapping.",
    arguments=_ARGUMENTS,
    results=(Value("gap", "(...)", "m", "signed gap"),),
    reference=formulas.sphere_capsule_gap,
    cases=_cases,
    mistakes=(
        _wrong(
            "sphere's radius left out",
            "That is the gap of the sphere's *centre* and the capsule: its own radius is missing.",
            " - radius -",
            " -",
        ),
        _wrong(
            "capsule's radius left out",
            "That is the gap of the sphere and the capsule's *segment*: the capsule reaches beyond it by its radius.",
            " - capsule_radius",
            "",
        ),
        _wrong(
            "no radius",
            "That is the distance of the centre and the segment. Both shapes reach beyond by their radii.",
            " - radius - capsule_radius",
            "",
        ),
        _wrong(
            "difference of the radii",
            "The radii have to be taken off both: (r + R), not (r - R).",
            "- capsule_radius",
            "+ capsule_radius",
        ),
        _wrong(
            "radii added",
            "You add the radii to the distance. They fill part of it: what is left over is the gap.",
            " - radius - capsule_radius",
            " + radius + capsule_radius",
        ),
        _wrong(
            "sign",
            "The size is right and the sign reversed: above 0 means apart.",
            _GAP,
            f"-({_GAP})",
        ),
        _wrong(
            "0 where they overlap",
            "Right where they are apart. Where they overlap the gap is below 0, and says how deep.",
            _GAP,
            f"np.maximum({_GAP}, 0.0)",
        ),
        _wrong(
            "without its sign",
            "Right where they are apart. Where they overlap the gap is below 0: leave its sign as it comes.",
            _GAP,
            f"np.abs({_GAP})",
        ),
        _wrong(
            "squared distance",
            "You take the squared distance, in m^2, and take lengths off it. A gap needs the length itself: here the "
            "root has to be taken.",
            "np.linalg.norm(center - nearest, axis=-1)",
            "np.sum((center - nearest) ** 2, axis=-1)",
        ),
        _wrong(
            "difference of squares",
            "You take the difference of two squares, in m^2. It has the sign of the gap, but a gap is a length: the "
            "distance, less both radii.",
            _GAP,
            "np.sum((center - nearest) ** 2, axis=-1) - (radius + capsule_radius) ** 2",
        ),
        _wrong(
            "the nearer end",
            "You measure to the nearer *end* of the segment. Beside the segment its nearest point lies between them.",
            _NEAREST,
            f"np.where(np.less(*({_ENDS}))[..., None], start, end)",
        ),
        _wrong(
            "endless, and 0/0",
            "You measure to the whole line: the capsule goes on beyond its ends. And where its segment is only a point "
            "you divide 0 by 0. Your closest_point_on_segment has an answer to both.",
            _NEAREST,
            _ON_LINE.replace(", 1e-300", ", 0.0"),
        ),
        _wrong(
            "endless",
            "Your capsule goes on beyond its ends: you measure to the whole line. The nearest point must lie on the "
            "segment.",
            _NEAREST,
            _ON_LINE,
        ),
        _wrong(
            "the start alone",
            "You measure to the start of the segment: that is the gap of two spheres.",
            _NEAREST,
            "start",
        ),
        _wrong(
            "the middle alone",
            "You measure to the middle of the segment: that is the gap of two spheres.",
            _NEAREST,
            "(start + end) / 2",
        ),
        _wrong(
            "one length for the batch",
            "Right for one pair. In a batch you take the length of all of it together: axis=-1.",
            "np.linalg.norm(center - nearest, axis=-1)",
            "np.linalg.norm(center - nearest)",
        ),
    ),
    hints=(
        "A capsule is all that is within its radius of its segment. Which point of the segment counts for this sphere?",
        "Your closest_point_on_segment, asked with the sphere's centre, gives that point. From there on it is two "
        "spheres: their distance less both radii. np.linalg.norm(x, axis=-1) is a length.",
        "nearest = closest_point_on_segment(____, start, end)\n"
        "return np.linalg.norm(center - ____, axis=-1) - ____ - capsule_radius",
    ),
)  # fmt: skip
