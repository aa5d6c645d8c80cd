"""From where a film is seen: onto a plane, or into space."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from course.arrays import (
    ArrayLike,
    choice,
    failure,
    scalar,
    scalars,
    shaped,
    vectors,
    written,
)

#: Where a camera in space looks from (a direction), and what is up in its picture.
CAMERAS = {
    "corner": ((0.62, -0.72, 0.42), (0.0, 0.0, 1.0)),
    "low": ((0.42, -0.9, 0.27), (0.0, 0.0, 1.0)),
    "front": ((0.0, -1.0, 0.0), (0.0, 0.0, 1.0)),
    "side": ((1.0, 0.0, 0.0), (0.0, 0.0, 1.0)),
    "top": ((0.0, 0.0, 1.0), (0.0, 1.0, 0.0)),
}
#: Flat views: what points right and up in the picture.
PLANES = {
    "xz": ((1.0, 0.0, 0.0), (0.0, 0.0, 1.0)),
    "xy": ((1.0, 0.0, 0.0), (0.0, 1.0, 0.0)),
    "yz": ((0.0, 1.0, 0.0), (0.0, 0.0, 1.0)),
}


@dataclass(frozen=True, eq=False)
class Flat:
    """A view onto a plane of the world, drawn to scale.

    Args:
        plane: "xz", "xy" or "yz".
        window: left, bottom, right, top of what is seen [m]; none: all that ever shows.
    """

    plane: str = "xz"
    window: tuple[float, float, float, float] | None = None

    def __post_init__(self) -> None:
        choice("plane", self.plane, tuple(PLANES))
        if self.window is not None:
            left, bottom, right, top = scalars("window", self.window)
            if not (left < right and bottom < top):
                raise failure(
                    "window",
                    "left < right and bottom < top",
                    written(np.array(self.window)),
                )


@dataclass(frozen=True, eq=False)
class Space:
    """A view into space, to be turned with the hand.

    Args:
        camera: "corner", "low", "front", "side" or "top".
        ground: height z of a ground plane on which shadows fall [m]; None: there is none.
        window: two opposite corners of what is seen, lowest and highest, (2, 3) [m]; none:
            all that ever shows. With it the picture stands still while a knob moves.
    """

    camera: str = "corner"
    ground: float | None = None
    window: ArrayLike | None = None

    def __post_init__(self) -> None:
        choice("camera", self.camera, tuple(CAMERAS))
        if self.ground is not None:
            scalar("ground", self.ground)
        if self.window is not None:
            corners = vectors("window", self.window)
            shaped("window", corners, (2, 3))
            low, high = corners
            if not np.all(low < high):
                raise failure("window", "lowest < highest corner", written(high - low))
