"""A rod that is turned by hand, and the box along the axes around it."""

from __future__ import annotations

import numpy as np

from course import rotations
from course.arrays import Array
from course.study.turned_rods import TurnedRod, about_z, turned_rod
from course.workbook.stage import (
    Exhibit,
    Film,
    Flat,
    Hand,
    Knob,
    Number,
    Pane,
    Path,
    Preset,
    Segments,
    box,
)

LENGTH = 1.0  # [m]
#: What is seen, whatever the knobs say: left, bottom, right, top [m].
WINDOW = (-0.95, -0.85, 0.95, 0.95)
TIMES, PACE = np.linspace(0.0, 6.0, 91), 15.0  # [s], and how fast it turns [degrees/s]
KNOBS = (
    Knob("angle", "rod turned by", 0.0, 0.0, 90.0, 1.0, "°"),
    Knob("thickness", "thickness", 0.01, 0.01, 1.0, 0.01, "m", logarithmic=True),
)
PRESETS = (
    Preset("along x", {"angle": 0, "thickness": 0.01}),
    Preset("at 45°", {"angle": 45, "thickness": 0.01}),
    Preset("10 cm thick", {"angle": 0, "thickness": 0.1}),
    Preset("a cube", {"angle": 0, "thickness": 1.0}),
)


def turning_rod(opening: bool = False) -> Exhibit:
    """A rod of 1 m in the plane, to be turned, and the upright box around it.

    Args:
        opening: whether it opens the lesson: then it tells no more than it asks, and has
            neither curve nor thickness.
    """
    if opening:
        return Exhibit(
            lambda angle: _film(angle, 0.01, told=False),
            KNOBS[:1],
            [Hand({"angle": (0.0, 115.0, 0.0)}, body=0)],
        )
    return Exhibit(
        lambda angle, thickness: _film(angle, thickness),
        KNOBS,
        [Hand({"angle": (0.0, 115.0, 0.0)}, body=0)],
        PRESETS,
        question="A rod of 1 m by 1 cm by 1 cm has the largest box at 45 degrees, with 51 times its volume. Ten times "
        "as thick, at which angle has it the largest, and with how many times its volume?",
        answer="At 45 degrees as well, but with 6.05 times. The ratio is 1 + sin(2θ) (q + 1/q)/2, with the thickness "
        "over the length q = 0.1: the thickness changes how high the curve is, and not where.",
    )


def _film(angle: float, thickness: float, *, told: bool = True) -> Film:
    e = 0.5 * np.array([LENGTH, thickness, thickness])
    found = turned_rod(angle + PACE * TIMES, e)
    most = (LENGTH + thickness) ** 2 / (2 * LENGTH * thickness)
    return Film(
        [_pane(found)],
        TIMES,
        Flat("xy", WINDOW),
        title="A rod that turns in a box that does not",
        caption="The rod turns about z; the box around it stays along the axes. The number is the volume of the box "
        "over that of the rod. Take hold of the rod, or play.",
        ending=f"It turns from {angle:g} to {angle + 90:g} degrees; at 45 the box has {most:.1f} times its volume",
        charts=[_chart(found, most)] if told else (),
        numbers=[
            Number("box over rod, now", (round(float(found.growth[0]), 3),)),
            Number("box over rod, at 45°", (round(most, 3),)),
        ] if told else (),
    )  # fmt: skip


def _pane(rod: TurnedRod) -> Pane:
    turns = np.zeros((len(TIMES), 1, 3))
    turns[:, 0, 2] = np.radians(rod.degrees)
    x, y = rod.extents[:, 0], rod.extents[:, 1]
    # The rod's origin is its end, which goes with the hand that turns it.
    end = np.array([rod.half_extents[0], 0.0, 0.0])
    place = about_z(rod.degrees) @ end
    growth = np.round(rod.growth, 1)[:, None]
    over = np.stack([0 * y, y + 0.09, 0 * y], axis=-1)[:, None]
    return Pane(
        [box(rod.half_extents, center=-end, color="blue")],
        place[:, None],
        rotations.from_rotation_vector(turns),
        segments=[
            Segments("box along the axes", *outline(x, y), color="vermillion"),
            Segments("volume, box over rod", over, over, growth, unit="×", color="vermillion"),
        ],
    )  # fmt: skip


def outline(x: Array, y: Array) -> tuple[Array, Array]:
    """Starts and ends of the four sides of rectangles about the origin, (t, 4, 3) each."""
    corners = [(-1, -1), (1, -1), (1, 1), (-1, 1)]
    at = np.stack([np.stack([i * x, j * y, 0 * x], axis=-1) for i, j in corners], axis=1)  # fmt: skip
    return at, np.roll(at, -1, axis=1)


def _chart(rod: TurnedRod, most: float) -> Path:
    every = np.linspace(0.0, 180.0, 181)
    curve = turned_rod(every, rod.half_extents).growth
    return Path(
        "volume of the box over the rod's", "angle [°]", "box over rod",
        rod.degrees, rod.growth,
        guides={"at every angle": np.stack([every, curve], axis=-1)},
        equal=False, limits=(0.0, 0.0, 180.0, 1.1 * most), answers=True,
    )  # fmt: skip
