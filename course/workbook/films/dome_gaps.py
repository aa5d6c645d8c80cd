"""A particle on a dome: which of three gaps says whether it parts?"""

from __future__ import annotations

import numpy as np

from course.dynamics import Dome
from course.workbook.stage import (
    Arrows,
    Curves,
    Exhibit,
    Film,
    Flat,
    Knob,
    Number,
    Pane,
    Preset,
    Segments,
    ball,
    labelled,
    standing,
)
from course.workbook.stage.words import shown_number

LAST = 0.2  # of the film [s]
#: What is seen, wherever the particle is let go: left, bottom, right, top [m].
WINDOW = (-0.2, -0.3, 1.4, 1.25)
NAMES = ("gap to the dome", "from the old point", "from the old plane")
COLORS = ("blue", "vermillion", "green")
KNOBS = (Knob("angle", "let go at, from the top", 42.0, 5.0, 60.0, 1.0, "°"),)
PRESETS = (
    Preset("30°", {"angle": 30}),
    Preset("42°", {"angle": 42}),
    Preset("47°", {"angle": 47}),
    Preset("55°", {"angle": 55}),
)


def dome() -> Exhibit:
    """A particle that slid down from the top of a dome and flies on as if nothing pushed it."""
    return Exhibit(
        _film,
        KNOBS,
        (),
        PRESETS,
        question="A particle has slid down a smooth dome from its top. At 42°, does it need the dome's push "
        "any longer?",
        answer="It does, down to 48.2°: without a push its gap falls below 0 at first. Measured from the point of "
        "the dome that it touched, along the N of each moment, the gap grows from 36.9° on: that counts v²/R twice.",
    )


def _film(angle: float) -> Film:
    scene, theta = Dome(), np.radians(angle)
    times = np.linspace(0.0, LAST, 81)
    gaps = [
        scene.gap(theta, times),
        scene.gap_from_the_old_point(theta, times),
        scene.gap_from_the_old_plane(theta, times),
    ]
    curves = {name: 1000 * gap for name, gap in zip(NAMES, gaps, strict=True)}
    return Film(
        [_pane(scene, theta, times, gaps)],
        times,
        Flat("yz", WINDOW),
        title="A particle on a dome, without the dome's push",
        caption="Three gaps of the same flight. Only the blue one says whether the particle is in the dome.",
        ending=_ending(scene, theta),
        charts=[
            Curves("gaps, small", "mm", curves, limits=(-12.0, 12.0), colors=COLORS),
            Curves("gaps", "mm", curves, limits=(-200.0, 460.0), colors=COLORS),
        ],
        numbers=[
            Number("speed", (float(scene.speed(theta)),), "m/s"),
            Number("v²/R − g cos φ, the gap's d̈", (float(scene.bias(theta)),), "m/s²"),
            Number("2 v²/R − g cos φ, old point", (float(scene.bias_as_printed(theta)),), "m/s²"),
            Number("−g cos φ, old plane", (-9.81 * float(np.cos(theta)),), "m/s²"),
        ],
        speed=0.05,
    )  # fmt: skip


def _pane(scene: Dome, theta: float, times: np.ndarray, gaps: list[np.ndarray]) -> Pane:
    flight = np.zeros((len(times), 3))
    flight[:, 1:] = scene.flight(theta, times)
    normal = flight / np.linalg.norm(flight, axis=-1, keepdims=True)
    touched, first = flight[:1], normal[:1]
    true, old, plane = (gap[:, None] * n for gap, n in zip(gaps, (normal, normal, first), strict=True))  # fmt: skip
    # Beside each other: they lie on one line otherwise.
    aside = np.stack([0 * times, normal[:, 2], -normal[:, 1]], axis=-1)
    beside = 0.06 * aside
    place = np.zeros((len(times), 3, 3))
    place[:, 1], place[:, 2] = touched, flight
    ends = (
        (flight - true, flight),
        (flight - old + beside, flight + beside),
        (flight - plane - beside, flight - beside),
    )
    lines = [
        Segments(name, a[:, None], b[:, None], color=color)
        for name, (a, b), color in zip(NAMES, ends, COLORS, strict=True)
    ]
    level = Segments(
        "level of the old point", np.broadcast_to(touched, flight.shape)[:, None],
        (flight - old + beside)[:, None], color="grey",
    )  # fmt: skip
    return Pane(
        [
            standing(ball(scene.radius)),
            labelled(ball(0.014, color="orange"), "old point"),
            labelled(ball(0.018, color="black"), "particle"),
        ],
        place,
        arrows=[
            Arrows("normal N", normal[:, None], at=flight[:, None], scale=0.18, color="purple")
        ],
        segments=[level, *lines],
        trails=[2],
    )  # fmt: skip


def _ending(scene: Dome, theta: float) -> str:
    start = f"Let go at {np.degrees(theta):.0f}°, "
    says = "grows at once" if scene.bias_as_printed(theta) > 0 else "falls at first"
    other = f"the gap from the old point {says}"
    if scene.bias(theta) > 0:
        return f"{start}the particle parts from the dome, and {other}"
    times = np.geomspace(1e-5, LAST, 4000)  # just before it leaves, all is over at once
    true = scene.gap(theta, times)
    deep, out = 1000 * float(-true.min()), times[np.argmin(true) :][true[np.argmin(true) :] >= 0]  # fmt: skip
    then = (
        f"and is out of it again after {shown_number(1000 * out[0], 2)} ms"
        if out.size
        else f"and is still in it after {1000 * LAST:.0f} ms"
    )
    size = f"{shown_number(deep, 2)} mm" if deep >= 0.001 else "less than 0.001 mm"
    return f"{start}the particle sinks into the dome, {size} deep, {then}; {other}"
