"""One corner, face, edge or sphere of a body against one of another: the contact from the shapes alone."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

import numpy as np

from course.arrays import Array, choice
from course.overlap.contact_arrays import FEATURES, Contacts


@dataclass(frozen=True, eq=False)
class FeaturePair:
    """The parts of bodies 0 (A) and 1 (B) that meet.

    Args:
        kind: one of ``FEATURES``: a corner of A and a face of B ("face_b"), a face of A and
            a corner of B ("face_a"), two edges, two spheres ("curved").
        spot_a, spot_b: in each body's own axes, a point of what it meets with: the
            corner, a point of the face or edge, a sphere's centre, (3,) [m].
        axis_a, axis_b: in each body's own axes, the face's outward normal or the edge's
            direction, unit, (3,).
        radius_a, radius_b: of the spheres [m].
    """

    kind: str
    spot_a: Array
    spot_b: Array
    axis_a: Array
    axis_b: Array
    radius_a: float = 0.0
    radius_b: float = 0.0

    def __post_init__(self) -> None:
        choice("kind", self.kind, FEATURES)

    def contacts(self, position: Array, rotation: Array) -> Contacts:
        """The one contact when the bodies lie like this, (2, 3) and (2, 3, 3)."""
        (x_a, x_b), (turn_a, turn_b) = position, rotation
        spot_a, spot_b = x_a + turn_a @ self.spot_a, x_b + turn_b @ self.spot_b
        axis_a, axis_b = turn_a @ self.axis_a, turn_b @ self.axis_b
        data: dict[str, Any] = {}
        if self.kind == "face_b":
            d, normal, point_a = (spot_a - spot_b) @ axis_b, axis_b, spot_a
        elif self.kind == "face_a":
            d, normal = (spot_b - spot_a) @ axis_a, -axis_a
            point_a = spot_b + d * normal
        elif self.kind == "edges":
            point_a, point_b = _nearest_on_lines(spot_a, axis_a, spot_b, axis_b)
            across = np.cross(axis_a, axis_b)
            normal = across / np.linalg.norm(across)
            d = (point_a - point_b) @ normal
            data = {"edge_a": axis_a[None], "edge_b": axis_b[None]}
        else:
            distance = np.linalg.norm(spot_a - spot_b)
            normal = (spot_a - spot_b) / distance
            d, point_a = (
                distance - self.radius_a - self.radius_b,
                spot_a - self.radius_a * normal,
            )
            data = {
                "curvature_a": np.eye(3)[None] / self.radius_a,
                "curvature_b": np.eye(3)[None] / self.radius_b,
            }
        halfway = point_a - 0.5 * d * normal
        return Contacts(
            np.array([0]),
            np.array([1]),
            halfway[None],
            normal[None],
            np.array([float(d)]),
            np.array([self.kind]),
            **data,
        )


def _nearest_on_lines(p: Array, d: Array, q: Array, e: Array) -> tuple[Array, Array]:
    """The points nearest to each other of the lines p + s d and q + t e."""
    s, t = np.linalg.lstsq(np.stack([d, -e], axis=1), q - p, rcond=None)[0]
    return p + s * d, q + t * e
