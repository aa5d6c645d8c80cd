"""One body that turns with no torque on it: a handle in space, and a body of any three moments."""

from __future__ import annotations

import numpy as np

from course import rotations
from course.arrays import Array, ArrayLike, failure, positive, scalar, vectors, written
from course.dynamics import (
    Bodies,
    MassProperties,
    box_mass_properties,
    combined_mass_properties,
    orientation_error,
    torque_free_motion,
)
from course.scenes.scene import Scene

#: A steel T: a crossbar along axis 1 and a stem along axis 2, both 2 cm by 2 cm; centres and half extents [m]
#: about the middle of the crossbar, and the density [kg/m^3].
HANDLE_CENTERS = np.array([[0.0, 0.0, 0.0], [0.0, 0.06, 0.0]])
HANDLE_HALF_EXTENTS = np.array([[0.1, 0.01, 0.01], [0.01, 0.05, 0.01]])
STEEL = 7850.0


def handle_mass_properties() -> MassProperties:
    """Mass, centre and inertia of the steel T, in axes through the middle of its crossbar."""
    boxes = zip(HANDLE_CENTERS, HANDLE_HALF_EXTENTS, strict=True)
    return combined_mass_properties(
        [box_mass_properties(c, np.eye(3), e, density=STEEL) for c, e in boxes]
    )


def spinning_handle(
    *, tilt: float = np.radians(1.0), spin: float = 6.0, axis: int = 1
) -> Scene:
    """The handle at the origin, L upright, and one of its axes almost along L.

    The moments are least about the crossbar (axis 0), middle about the stem
    (axis 1), largest about the axis across both (axis 2).

    Args:
        tilt: angle between L and that axis [rad]; L leans toward the next axis.
        spin: |L| over the moment about that axis [rad/s].
        axis: 0, 1 or 2.
    """
    solid = handle_mass_properties()
    return spinning_body(
        np.diag(solid.inertia), mass=float(solid.mass), tilt=tilt, spin=spin, axis=axis
    )


def spinning_body(
    moments: ArrayLike,
    *,
    mass: float = 1.0,
    tilt: float = np.radians(1.0),
    spin: float = 6.0,
    axis: int = 1,
) -> Scene:
    """One body at the origin, L upright, and one of its axes almost along L.

    Args:
        moments: about its centre, (3,) [kg m^2]; the axes are numbered as they stand here.
        mass: [kg].
        tilt: angle between L and the axis of the spin [rad]; L leans toward the next axis.
        spin: |L| over the moment about that axis [rad/s].
        axis: 0, 1 or 2.
    """
    moment = positive("moments", vectors("moments", moments))
    if moment.ndim != 1:
        raise failure("moments", "shape (3,)", f"shape {moment.shape}")
    if axis not in (0, 1, 2):
        raise failure("axis", "0, 1 or 2", written(axis))
    leaning = _leaning(axis, scalar("tilt", tilt))
    # The least turn that takes the leaning direction to the world's z.
    up = np.array([0.0, 0.0, 1.0])
    across = np.cross(leaning, up)
    size = float(np.linalg.norm(across))
    angle = np.arctan2(size, leaning @ up)
    turn = rotations.from_rotation_vector(
        angle * across / size if size > 0 else angle * np.array([1.0, 0.0, 0.0])
    )
    none = np.zeros((1, 3))
    length = moment[axis] * scalar("spin", spin)
    momentum = length * up[None]
    start = Bodies(
        np.array([mass]), np.diag(moment)[None], none, turn[None], none, momentum
    )

    def motion(time: float) -> Bodies:
        return torque_free_motion(start, time)

    def error(bodies: Bodies, time: float) -> float:
        return orientation_error(bodies, motion(time))

    return Scene(start, truth=motion, error=error, name="spinning body")


def _leaning(axis: int, tilt: float) -> Array:
    """The unit vector along an axis, leaning toward the next one: from the stem toward axis 3."""
    direction = np.zeros(3)
    direction[axis], direction[(axis + 1) % 3] = np.cos(tilt), np.sin(tilt)
    return direction
