"""A dumbbell in k-DOPs of more and more sides."""

from __future__ import annotations

import numpy as np

from course import rotations
from course.arrays import Array, IntArray
from course.shapes import AABB, KDOP, Mesh, bounding_box, k_dop, polytopes
from course.shapes.mesh_makers import dumbbell_mesh
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
    mesh,
)

SIDES = (6, 14, 18, 26)
EACH = 2.0  # how long each number of sides is seen [s]
#: What is seen, whatever the knobs say: two opposite corners [m].
WINDOW = ((-0.33, -0.33, -0.33), (0.33, 0.33, 0.33))
#: The end of the dumbbell: its origin in the picture, which goes with the hand [m].
END = np.array([0.25, 0.0, 0.0])
KNOBS = (
    Knob("turn", "turned about z by", 30.0, -90.0, 90.0, 1.0, "°"),
    Knob("tilt", "tilted out of the plane by", 25.0, -90.0, 90.0, 1.0, "°"),
)
PRESETS = (
    Preset("along x", {"turn": 0, "tilt": 0}),
    Preset("along a diagonal of the plane", {"turn": 45, "tilt": 0}),
    Preset("along a diagonal of the cube", {"turn": 45, "tilt": 35}),
    Preset("along no direction of any", {"turn": 30, "tilt": 25}),
)
#: A moment of each number of sides, from where it begins to where it ends.
TIMES = np.repeat(EACH * np.arange(len(SIDES) + 1), 2)[1:-1]


def growing_dop() -> Exhibit:
    """A dumbbell to be turned, in the box along the axes and in k-DOPs of 14, 18 and 26 sides."""
    return Exhibit(
        _film,
        KNOBS,
        [Hand({"turn": (0.0, 250.0, 0.0), "tilt": (0.0, 0.0, 250.0)}, body=0)],
        PRESETS,
        question="Along the diagonal of a cube the box has 9 times the dumbbell's volume. The k-DOP with 14 sides has "
        "one across each end there, the one with 18 has none. Which of the two is tighter?",
        answer="The one with 18 sides: 2.2 times, against 4.5. Three of its directions stand square to the diagonal, "
        "so that six sides lie close along the bar.",
    )


def fitted(mesh_: Mesh) -> list[AABB | KDOP]:
    """The box along the axes and the k-DOPs, from few sides to many."""
    points = mesh_.vertices
    return [bounding_box(points), *(k_dop(points, k) for k in SIDES[1:])]


def _film(turn: float, tilt: float) -> Film:
    q = rotations.from_rotation_vector(np.array([0.0, 0.0, np.radians(turn)]))
    up = rotations.from_rotation_vector(np.array([0.0, -np.radians(tilt), 0.0]))
    rotation = rotations.to_matrix(q) @ rotations.to_matrix(up)
    seen = dumbbell_mesh().moved(rotation, np.zeros(3))
    around = fitted(seen)
    ratio = np.array([float(shape.volume()) / seen.volume() for shape in around])
    which = np.arange(len(TIMES)) // 2
    told = ", ".join(f"{k}: {r:.2f}" for k, r in zip(SIDES, ratio, strict=True))
    return Film(
        [_pane(seen, around, np.round(ratio, 2), which, rotation @ END)],
        TIMES,
        Space("corner", window=WINDOW),
        title="A dumbbell in 6, 14, 18 and 26 sides",
        caption="The sides belong to the world and not to the dumbbell: the box along the axes, then k-DOPs with "
        "14, 18 and 26 sides. Drag or turn the dumbbell, and compare.",
        ending=f"Volume over the dumbbell's by sides: {told}",
        charts=[Curves("volume over the dumbbell's", "", {"collider": ratio[which]}, colors=["vermillion"])],
        counters={"sides": np.array(SIDES)[which]},
        numbers=[Number(f"{k} sides", (round(float(r), 2),)) for k, r in zip(SIDES, ratio, strict=True)],
    )  # fmt: skip


def _pane(
    seen: Mesh, around: list[AABB | KDOP], ratio: Array, which: IntArray, end: Array
) -> Pane:  # fmt: skip
    edges = [edges_of(shape) for shape in around]
    over = np.broadcast_to([0.0, 0.0, 0.31], (len(which), 1, 3))
    most = max(len(e) for e in edges)
    # Those with fewer edges repeat their first corner: a line without length.
    wide = np.stack([
        np.concatenate([e, np.broadcast_to(e[:1, :1], (most - len(e), 2, 3))]) for e in edges
    ])[which]  # fmt: skip
    return Pane(
        [mesh(seen.vertices - end, seen.triangles, color="blue", smooth=True)],
        end[None],
        segments=[
            Segments("edges of the collider", wide[:, :, 0], wide[:, :, 1], color="vermillion"),
            Segments("volume over the dumbbell's", over, over, ratio[which][:, None], unit="×", color="vermillion"),
        ],
    )  # fmt: skip


def edges_of(shape: AABB | KDOP) -> Array:
    """Both ends of each edge, (e, 2, 3) [m]."""
    found = polytopes(shape)
    return np.asarray(found.vertices[found.edges])
