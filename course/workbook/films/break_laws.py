"""The billiard break by three laws: is a symmetric break symmetric?"""

from __future__ import annotations

from typing import Any

import numpy as np

from course.arrays import Array
from course.contact.collisions import LAWS
from course.scenes import POOL_MASS, POOL_RADIUS, billiard_rack
from course.study import BallTracks, roll
from course.workbook.films.timing import moments
from course.workbook.stage import (
    Arrows,
    Curves,
    Exhibit,
    Film,
    Flat,
    Hand,
    Knob,
    Number,
    Pane,
    Preset,
    ball,
    box,
    standing,
)

SPEED, MEETING, ROLLING = 4.0, 0.1, 0.4  # of the cue ball [m/s]; [s], [s]
#: Where the cushions are: lower and upper corner [m].
TABLE = ((-0.55, -0.4), (0.65, 0.4))
WINDOW = (-0.6, -0.45, 0.7, 0.45)
SCALE = 0.03  # metres drawn for 1 m/s
KNOBS = (
    Knob("offset", "cue ball beside the middle", 0.0, -20.0, 20.0, 0.5, "mm"),
    Knob("rows", "rows in the rack", 5, 2, 5, 1),
    Knob("restitution", "restitution e", 1.0, 0.5, 1.0, 0.05),
)
PRESETS = (
    Preset("straight", {"offset": 0, "rows": 5, "restitution": 1}),
    Preset("5 mm beside", {"offset": 5, "rows": 5, "restitution": 1}),
    Preset("three balls", {"offset": 0, "rows": 2, "restitution": 1}),
    Preset("e = 0.9", {"offset": 0, "rows": 5, "restitution": 0.9}),
)


def billiard_break() -> Exhibit:
    """A cue ball onto a rack of touching balls; it can be taken and moved sideways."""

    def film(offset: float, rows: float, restitution: float) -> Film:
        rack: dict[str, Any] = {
            "speed": SPEED,
            "offset": 1e-3 * offset,
            "rows": round(rows),
        }
        scene = billiard_rack(**rack)
        tracks = {
            law: roll(
                scene.bodies,
                POOL_RADIUS,
                ROLLING,
                table=TABLE,
                law=law,
                restitution=restitution,
            )
            for law in LAWS
        }
        return _film(tracks, offset)

    return Exhibit(
        film,
        KNOBS,
        [Hand({"offset": (0.0, 1000.0, 0.0)}, body=0, until=MEETING - 1e-9)],
        PRESETS,
        question="The rack is symmetric and the cue ball comes along its middle; nothing is lost. "
        "Which of the laws break it symmetrically?",
        answer="Simultaneous and reflection do. The sequential law asks the contacts one after the other, in "
        "the order of a list, and the list is not symmetric.",
    )  # fmt: skip


def _film(tracks: dict[str, BallTracks], offset: float) -> Film:
    events = [t + MEETING for track in tracks.values() for t in track.time[1:-1]]
    times, after = moments(MEETING + ROLLING, [MEETING, *events], frames=11)
    moved = {law: _moved(track, times, after) for law, track in tracks.items()}
    return Film(
        [_pane(law, *moved[law]) for law in tracks],
        times,
        Flat("xy", WINDOW),
        title="The break by three laws",
        caption="Look for symmetry about the path of the cue ball. Nothing rubs; all balls touch at the start.",
        ending=_ending(tracks, offset),
        charts=_charts(times, moved),
        numbers=_numbers(tracks),
        events=(MEETING,),
        speed=0.12,
    )  # fmt: skip


def _moved(track: BallTracks, times: Array, after: Any) -> tuple[Array, Array]:
    """Positions and velocities of all balls, (t, n, 3) each: straight between events."""
    start = track.position[0], track.velocity[0]
    since = times - MEETING
    # A time that stands twice shows the ball before and after, its event and no other.
    late = np.searchsorted(track.time[1:-1], since + np.where(after, 1e-9, -1e-9))
    place = (
        track.position[late]
        + (since - track.time[late])[:, None, None] * (track.velocity[late])
    )
    before = since < 0
    place[before] = start[0] + since[before, None, None] * start[1]
    return place, track.velocity[late]


def _pane(law: str, place: Array, velocity: Array) -> Pane:
    (left, low), (right, high) = TABLE
    count = place.shape[1]
    wide, tall, thick = 0.5 * (right - left), 0.5 * (high - low), 0.02
    middle = 0.5 * (left + right), 0.5 * (low + high)
    cushions = [
        (box((wide + 2 * thick, thick, 0.1)), (middle[0], low - thick, 0)),
        (box((wide + 2 * thick, thick, 0.1)), (middle[0], high + thick, 0)),
        (box((thick, tall, 0.1)), (left - thick, middle[1], 0)),
        (box((thick, tall, 0.1)), (right + thick, middle[1], 0)),
    ]
    walls = np.broadcast_to([x for _, x in cushions], (len(place), 4, 3))
    balls = [
        ball(POOL_RADIUS, color="black" if k == 0 else "blue") for k in range(count)
    ]
    return Pane(
        [*balls, *(standing(solid) for solid, _ in cushions)],
        np.concatenate([place, walls], axis=1),
        title=law,
        arrows=[Arrows("velocity", velocity, "m/s", at=place, scale=SCALE, color="vermillion")],
        trails=range(count),
    )  # fmt: skip


def _charts(times: Array, moved: dict[str, tuple[Array, Array]]) -> list[Any]:
    energy = {
        law: 0.5 * POOL_MASS * np.sum(v**2, axis=(1, 2))
        for law, (_, v) in moved.items()
    }
    apart = {law: 1000 * _from_mirror(x) for law, (x, _) in moved.items()}
    return [
        Curves("kinetic energy of all balls", "J", energy, limits=(0.0, 1.5)),
        Curves("farthest a ball is from its mirror image", "mm", apart, limits=(-20.0, 800.0)),
    ]  # fmt: skip


def _from_mirror(values: Array) -> Array:
    """Greatest difference between a ball's vector and its partner's mirrored in y = 0.

    Args:
        values: of the cue ball and the rack, row by row, (..., n, 3).
    """
    rows = round((2 * values.shape[-2]) ** 0.5) - 1
    first = 1 + np.cumsum(np.arange(rows))
    partner = [0, *(i for k, at in enumerate(first) for i in range(at + k, at - 1, -1))]
    mirrored = values[..., partner, :] * np.array([1.0, -1.0, 1.0])
    return np.asarray(np.linalg.norm(values - mirrored, axis=-1).max(axis=-1))


def _numbers(tracks: dict[str, BallTracks]) -> list[Number]:
    after = [track.velocity[1] for track in tracks.values()]
    moving = [
        float(np.sum(np.linalg.norm(v[1:], axis=-1) > 1e-6 * SPEED)) for v in after
    ]
    fastest = [float(np.linalg.norm(v[1:], axis=-1).max()) for v in after]
    kept = [100 * float(np.sum(v**2)) / SPEED**2 for v in after]
    odd = [round(float(_from_mirror(v)), 9) + 0.0 for v in after]
    return [
        Number("velocities off mirror image", tuple(odd), "m/s"),
        Number("balls that move", tuple(moving)),
        Number("fastest of them", tuple(fastest), "m/s"),
        Number("energy kept", tuple(kept), "%"),
    ]


def _ending(tracks: dict[str, BallTracks], offset: float) -> str:
    if offset:
        return "The cue ball comes beside the middle: no break is symmetric"
    odd = [law for law, t in tracks.items() if _from_mirror(t.velocity[1]) > 1e-6]
    even = [law for law in tracks if law not in odd]
    said = f"Symmetric: {', '.join(even) or 'none'}"
    return f"{said}; not symmetric: {', '.join(odd) or 'none'}"
