"""A ladder slides down a wall: does the wall hold on to it until it lies?"""

from __future__ import annotations

import numpy as np

from course import rotations
from course.study.ladder_slides import LadderSlide, ladder_slide
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
    box,
    capsule,
    standing,
)

LENGTH, THICK, MASS = 4.0, 0.05, 10.0  # [m], [m], [kg]
DURATION = 2.1  # of the film [s]
#: What is seen, wherever it starts: left, bottom, right, top [m].
WINDOW = (-4.7, -0.35, 0.55, 4.25)
SCALE = 0.02  # metres drawn for 1 N
KNOBS = (Knob("start", "angle at the start", 65.0, 40.0, 85.0, 1.0, "°"),)
PRESETS = (
    Preset("from 80°", {"start": 80}),
    Preset("from 65°", {"start": 65}),
    Preset("from 45°", {"start": 45}),
)


def ladder(pulling: bool = True) -> Exhibit:
    """A ladder let go on a smooth floor and a smooth wall; its middle can be taken at the start.

    Args:
        pulling: whether a second ladder plays beside it, on a wall that could pull.
    """

    def film(start: float) -> Film:
        angle = np.radians(start)
        shown = {
            "a wall that pushes": ladder_slide(angle, duration=DURATION),
            "a wall that could pull too": ladder_slide(
                angle, held=True, duration=DURATION
            ),
        }
        return _film(shown if pulling else {"": shown["a wall that pushes"]}, start)

    return Exhibit(
        film,
        KNOBS,
        [Hand({"start": (0.0, 33.0, 0.0)}, body=0, until=1e-9)],
        PRESETS,
        question="A ladder slides down, wall and floor are smooth. Does its top touch the wall until the ladder lies?",
        answer="No. The wall's force sinks to 0 where sin θ is 2/3 of what it was at the start, and a wall cannot "
        "pull. From there the ladder goes on away from the wall at a steady speed.",
    )


def _film(shown: dict[str, LadderSlide], start: float) -> Film:
    slides = list(shown.values())
    times = np.unique(np.concatenate([s.time for s in slides]))
    fitted = {title: _at(s, times) for title, s in shown.items()}
    right = slides[0]
    wall = {title or "wall": values[:, 4] for title, values in fitted.items()}
    gap = {title or "top": values[:, 5] for title, values in fitted.items()}
    return Film(
        [_pane(title, values) for title, values in fitted.items()],
        times,
        Flat("yz", WINDOW),
        title="A ladder on a smooth wall and a smooth floor",
        caption="Look at the top, and at the force of the wall. Take the middle of the ladder at the start.",
        ending=_ending(right, start),
        charts=[
            Curves("force of the wall", "N", wall, limits=(-155.0, 50.0)),
            Curves("gap between top and wall", "m", gap, limits=(-0.02, 0.28)),
        ],
        numbers=_numbers(slides, start),
        events=(right.leaving, right.lying),
        speed=0.5,
    )  # fmt: skip


def _at(slide: LadderSlide, times: np.ndarray) -> np.ndarray:
    """Angle, y, z, forces of floor and wall, gap at the wall, at all times of the film, (t, 6)."""
    columns = [slide.angle, *slide.centre.T, *slide.force.T, slide.gap[:, 1]]
    return np.stack([np.interp(times, slide.time, c) for c in columns], axis=-1)


def _pane(title: str, values: np.ndarray) -> Pane:
    angle, y, z, floor, wall, _ = values.T
    place = np.zeros((len(values), 3, 3))
    place[:, 0, 1], place[:, 0, 2] = y, z
    place[:, 1] = 0.0, 0.0, -5.0 - THICK
    place[:, 2] = 0.0, 5.0 + THICK, 0.0
    turn = np.zeros((len(values), 3, 3))
    turn[:, 0, 0] = angle
    reach = 0.5 * LENGTH * np.stack([0 * angle, np.cos(angle), np.sin(angle)], axis=-1)
    centre = place[:, 0]
    push = np.zeros((2, len(values), 1, 3))
    push[0, :, 0, 2], push[1, :, 0, 1] = np.nan_to_num(floor), -np.nan_to_num(wall)
    half = 0.5 * LENGTH
    return Pane(
        [
            capsule((0, -half, 0), (0, half, 0), THICK),
            standing(box((1.0, 20.0, 5.0)), endless=True),
            standing(box((1.0, 5.0, 20.0)), endless=True),
        ],
        place,
        rotations.from_rotation_vector(turn),
        title=title,
        arrows=[
            Arrows("force of the floor", push[0], "N", at=(centre - reach)[:, None], scale=SCALE, color="green"),
            Arrows("force of the wall", push[1], "N", at=(centre + reach)[:, None], scale=SCALE, color="vermillion"),
        ],
        trails=[0],
    )  # fmt: skip


def _numbers(slides: list[LadderSlide], start: float) -> list[Number]:
    right = slides[0]
    at = float(np.interp(right.leaving, right.time, right.angle))
    lowest = tuple(float(np.nanmin(s.force[:, 1])) for s in slides)
    return [
        Number("lets go at", (np.degrees(at),), "°", 4),
        Number("sin θ there / at the start", (np.sin(at) / np.sin(np.radians(start)),), "", 4),
        Number("least force of the wall", tuple(round(f, 6) + 0.0 for f in lowest), "N"),
        Number("lies after", tuple(s.lying for s in slides), "s"),
    ]  # fmt: skip


def _ending(slide: LadderSlide, start: float) -> str:
    at = np.degrees(np.interp(slide.leaving, slide.time, slide.angle))
    away = float(slide.gap[-1, 1])
    return (
        f"Let go at {start:.0f}° the ladder leaves the wall at {at:.1f}° after {slide.leaving:.2f} s; "
        f"it lies after {slide.lying:.2f} s, {away:.2f} m from the wall"
    )
