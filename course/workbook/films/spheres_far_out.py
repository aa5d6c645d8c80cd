"""Two spheres that meet far from the origin: places in 8 bytes, and in 4."""

from __future__ import annotations

from typing import Any

import numpy as np

from course import formulas
from course.study.far_meetings import FAR_RADII, FarMeeting, far_meeting
from course.study.far_places import spacing
from course.workbook.films.attempts import Attempt, Stopped, asked_of, moved
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
    ball,
    labelled,
)

TIMES = np.linspace(0.0, 6.0, 361)
#: What is seen, whatever the knobs say: left, bottom, right, top, from A's centre [m].
WINDOW = (-7.0, -13.0, 37.0, 13.0)
KNOBS = (
    Knob("far", "from the origin", 1e8, 1e4, 1e9, unit="m", logarithmic=True),
    Knob("lane", "B at y", 0.0, -8.0, 8.0, 0.5, "m"),
)
PRESETS = (
    Preset("100 km", {"far": 1e5, "lane": 0}),
    Preset("10,000 km", {"far": 1e7, "lane": 0}),
    Preset("100,000 km", {"far": 1e8, "lane": 0}),
    Preset("100,000 km, aside", {"far": 1e8, "lane": 5}),
)
QUESTION = (
    "100,000 km from the origin numbers of 4 bytes have steps of 8 m. The spheres touch when their centres are 9 m "
    "apart. How far apart are they in truth when B is stopped?"
)
ANSWER = (
    "12 m: as soon as B is nearer than that, its place is rounded to 8 m. The formula is right, and stops B 3 m "
    "early."
)


def far_spheres(function: Any = None, *, opening: bool = False) -> Exhibit:
    """Sphere B comes toward A until a verdict on their stored places stops it.

    Args:
        function: a ``spheres_overlap`` of your own that decides on both sides; none: the
            right one.
        opening: tells nothing beside what is seen: it opens the lesson.
    """
    says = formulas.spheres_overlap if function is None else function
    _, attempt = asked_of(function)

    def film(far: float, lane: float) -> Film:
        return _film(
            [
                attempt.motion(lambda size=size: far_meeting(far, lane, TIMES, size, says))  # type: ignore[misc]
                for size in (8, 4)
            ],
            far_meeting(far, lane, TIMES, 8, formulas.spheres_overlap),
            far, attempt, opening,
        )  # fmt: skip

    return Exhibit(
        film,
        KNOBS,
        [Hand({"lane": (0.0, 1.0, 0.0)}, body=2)],
        PRESETS,
        question="" if opening else QUESTION,
        answer="" if opening else ANSWER,
    )


def _film(
    motions: list[Any], right: FarMeeting, far: float, attempt: Attempt, opening: bool
) -> Film:
    made = [right if isinstance(m, Stopped) else m for m in motions]
    titles = ("places in 8 bytes each", "places in 4 bytes each")
    steps = tuple(spacing(far, s) for s in (8, 4))
    names = ("8 bytes", "4 bytes")
    gaps = dict(zip(names, (m.gap for m in made), strict=True))
    stored = dict(zip(names, (m.stored_gap for m in made), strict=True))
    colors = ["blue", "vermillion"]
    return Film(
        [_pane(title, m) for title, m in zip(titles, made, strict=True)],
        TIMES,
        Flat("xy", WINDOW),
        title="B comes nearer until the verdict is: they overlap",
        caption="A has a radius of 5 m, B of 4 m. B stops at the first moment at which it is said to overlap A. Both "
        "are drawn where their stored places are; the grey ball is where B is in truth.",
        ending=_ending(motions, made, attempt),
        charts=[] if opening else [
            Curves("true gap", "m", gaps, limits=(-10.0, 22.0), colors=colors),
            Curves("gap of the stored places", "m", stored, limits=(-10.0, 26.0), colors=colors),
        ],
        numbers=[] if opening else [
            Number("true gap where B stops", tuple(round(float(m.gap[-1]), 2) + 0.0 for m in made), "m"),
            Number("step of the numbers", steps, "m"),
        ],
    )  # fmt: skip


def _pane(title: str, m: FarMeeting) -> Pane:
    place = np.zeros((len(m.times), 3, 3))
    place[:, 1, :2], place[:, 2, :2] = m.true, m.drawn
    solids = [
        labelled(ball(r, color=c), name)
        for r, c, name in zip(FAR_RADII, ("blue", "orange"), "AB", strict=True)
    ]
    # Behind B, and a little smaller: it shows only where B is drawn at another place.
    truth = ball(0.97 * FAR_RADII[1], color="grey")
    return Pane([solids[0], truth, solids[1]], place, title=title)


def _ending(motions: list[Any], made: list[FarMeeting], attempt: Attempt) -> str:
    for motion in motions:
        if isinstance(motion, Stopped):
            return attempt.sentence(motion)
    if not moved(*motions)[-1].stopped:
        return "With places in 4 bytes nothing stops B"
    gap = float(made[-1].gap[-1])
    if abs(gap) < 0.005:
        return "In 4 bytes B stops where it touches A, to within 5 mm"
    if gap > 0:
        return f"In 4 bytes B stops {gap:.2f} m too early"
    return f"In 4 bytes B stops {-gap:.2f} m too late, inside A"
