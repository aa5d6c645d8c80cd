"""A mug and the collider that stands for it, taken apart."""

from __future__ import annotations

from dataclasses import replace

import numpy as np

from course import formulas, rotations
from course.arrays import Array
from course.shapes import Mesh
from course.shapes.mesh_makers import convex_mesh
from course.study.mug_colliders import COLLIDERS, comparisons, mug, mug_collider
from course.workbook.stage import (
    Exhibit,
    Film,
    Knob,
    Number,
    Pane,
    Preset,
    Solid,
    Space,
    ball,
    joined,
    mesh,
)

TIMES = np.linspace(0.0, 6.0, 61)
MIDDLE = np.array([0.0, 0.0, 0.05])  # of the mug in its own axes [m]
#: Across the line of sight of the low camera: both are as far from the eye.
ACROSS = np.array([0.9, 0.42, 0.0]) / np.hypot(0.9, 0.42)
#: Its axis goes round a cone about a direction that is tilted toward the eye, so that one
#: looks into the mug at every moment [rad].
TILT, CONE = 0.7, 0.4
WINDOW = ((-0.04, -0.06, -0.06), (0.18, 0.12, 0.06))
#: By how much a collider is drawn larger, so that what coincides does not flicker.
SKIN = 1.004
KNOBS = (
    Knob("kind", "collider", 3.0, 1.0, 4.0, 1.0),
    Knob("apart", "taken apart by", 0.14, 0.0, 0.16, 0.01, "m"),
)
PRESETS = tuple(
    Preset(name, {"kind": k + 1.0, "apart": 0.14}) for k, name in enumerate(COLLIDERS)
)
COLORS = ("orange", "vermillion", "green", "purple")
QUESTION = (
    "A mug, and four colliders that enclose it. Which of them is the tightest that is convex, and how much of it is "
    "mug?"
)
ANSWER = (
    "The hull, and 27 percent of it is mug: it closes the mug like a lid. Only the compound, which is made of 17 "
    "convex parts, has no air."
)


def colliders() -> Exhibit:
    """A mug that turns, and its sphere, box, hull or compound, which turns with it."""
    return Exhibit(_film, KNOBS, (), PRESETS, question=QUESTION, answer=ANSWER)


def _film(kind: float, apart: float) -> Film:
    name = COLLIDERS[int(np.clip(round(kind), 1, 4)) - 1]
    shape = mug_collider(name)
    volume, visual = float(shape.volume()), mug().volume()
    tight = float(formulas.tightness(volume, visual))
    places = np.zeros((2, 3))
    places[1] = apart * ACROSS
    both = np.repeat(_turning()[:, None], 2, axis=1)
    return Film(
        [Pane([mug_solid(), _collider(name, apart)], places, both)],
        TIMES,
        Space("low", window=WINDOW),
        title=f"A mug without a handle, and a collider: {name}",
        caption="On the left what is seen, on the right what is asked. Move them together again: a collider is where "
        "its body is, and turns with it.",
        ending=f"The {name} is filled by the mug to {100 * tight:.0f} percent",
        numbers=[
            Number("volume of the mug", (1e6 * visual,), "cm³"),
            Number(f"volume of the {name}", (1e6 * volume,), "cm³"),
            Number("tightness", (tight,)),
            Number("comparisons for one point", (float(comparisons(shape)),)),
        ],
    )  # fmt: skip


def _turning() -> Array:
    """The orientation at every moment, (t, 4)."""
    spin = np.zeros((len(TIMES), 3))
    spin[:, 2] = 2 * np.pi * TIMES / TIMES[-1]
    toward_eye, round_about, from_it = (
        rotations.to_matrix(rotations.from_rotation_vector(vector))
        for vector in (TILT * ACROSS, spin, np.array([CONE, 0.0, 0.0]))
    )
    return rotations.from_matrix(toward_eye @ round_about @ from_it)


def mug_solid(color: str = "sky") -> Solid:
    """The mug about its middle, its parts each with their own edges."""
    parts = [_about_middle(part) for part in mug().parts()]
    solids = [mesh(part.vertices, _outer(part), color=color) for part in parts]
    return replace(joined(*solids), what="mug")


def _outer(part: Mesh) -> Array:
    """A part's triangles without those between two staves, which a still would show as slivers.

    These lie along the mug's axis and along its radius.
    """
    corners = part.vertices[part.triangles]
    normal = np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0])
    normal /= np.linalg.norm(normal, axis=-1, keepdims=True)
    around = np.cross([0.0, 0.0, 1.0], corners.mean(axis=1))
    length = np.linalg.norm(around, axis=-1)
    across = np.abs(np.sum(normal * around, axis=-1)) > 0.8 * length
    return np.asarray(part.triangles[~(across & (length > 1e-9))])


def _about_middle(part: Mesh) -> Mesh:
    return part.moved(np.eye(3), -MIDDLE)


def _collider(name: str, apart: float) -> Solid:
    """The collider about the mug's middle; a compound comes apart itself."""
    color = COLORS[COLLIDERS.index(name)]
    shape = mug_collider(name)
    if name == "sphere":
        radius, center = SKIN * float(shape.radius), np.asarray(shape.center) - MIDDLE
        return replace(ball(radius, center=center, color=color), what="sphere")
    if name == "compound":
        return _parts(0.25 * apart)
    points = _corners(name)
    found = convex_mesh(SKIN * (points - MIDDLE))
    return replace(mesh(found.vertices, found.triangles, color=color), what=name)


def _corners(name: str) -> Array:
    shape = mug_collider(name)
    if name == "hull":
        return np.asarray(shape.vertices)
    ends = np.array([shape.lower, shape.upper])
    bits = np.array([[i, j, k] for i in (0, 1) for j in (0, 1) for k in (0, 1)])
    return np.asarray(ends[bits, np.arange(3)])


def _parts(away: float) -> Solid:
    """The hulls of the compound, each moved outward, in two colours by turns."""
    solids = []
    for k, part in enumerate(mug().parts()):
        found = _about_middle(part)
        out = found.vertices.mean(axis=0)
        shift = away * out / np.linalg.norm(out)
        color = ("purple", "orange")[k % 2]
        solids.append(mesh(SKIN * found.vertices + shift, found.triangles, color=color))
    return replace(joined(*solids), what="compound")
