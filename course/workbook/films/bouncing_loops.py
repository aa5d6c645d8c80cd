"""49 balls and two loops that differ in one line: which of them gains energy?"""

from __future__ import annotations

import numpy as np

from course.arrays import Array
from course.dynamics import BallMotion, ball_events
from course.scenes import GRAVITY
from course.study import bouncing_loop, energy_error
from course.study.bouncing_ball import BALLS, DROP, DURATION, RADIUS
from course.workbook.films.timing import moments
from course.workbook.stage import (
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
    box,
    joined,
    standing,
)
from course.workbook.stage.words import shown_number

#: What is seen, whatever the step: left, bottom, right, top [m].
WINDOW = (-6.3, -0.35, 6.3, 7.6)
PANES = {
    "from impact to impact": "",
    "a bounce or gravity (ODE)": "ode",
    "gravity, then bounce (Bullet)": "bullet",
}
_SHORT = {"": "exact", "ode": "ODE", "bullet": "Bullet"}
KNOBS = (Knob("step", "step", 0.01, 0.001, 0.02, unit="s", logarithmic=True),)
PRESETS = (
    Preset("1 ms", {"step": 0.001}),
    Preset("4 ms", {"step": 0.004}),
    Preset("10 ms", {"step": 0.01}),
    Preset("20 ms", {"step": 0.02}),
)


def many_balls() -> Exhibit:
    """The drop of 49 balls of a published benchmark, exact and by two fixed-step loops."""
    return Exhibit(
        _film,
        KNOBS,
        (),
        PRESETS,
        question="Two loops bounce the same 49 balls, nothing is lost. One lets gravity act in the step that "
        "bounces, too, before the velocity is turned round. What happens to its energy?",
        answer="It grows with every bounce: the velocity that is turned round has the pull of a whole step in "
        "it that the ball never felt. The other loop's energy only wavers.",
    )


def _film(step: float) -> Film:
    exact = ball_events(DROP - RADIUS, 1.0, DURATION)
    times, _ = moments(DURATION, list(exact.time), frames=501)
    motions = {"": exact.motion(times)}
    lifted = BallMotion(times, motions[""].height + RADIUS, motions[""].velocity)
    shown = {"": lifted} | {
        order: _loop(order, step, times) for order in ("ode", "bullet")
    }
    curves = {_SHORT[order]: motion for order, motion in shown.items()}
    energy = {name: _energy(motion) for name, motion in curves.items()}
    return Film(
        [_pane(title, shown[order].height) for title, order in PANES.items()],
        times,
        Flat("xz", WINDOW),
        title="49 balls",
        caption="The grey line is where they were dropped. Look which come back to it, and which rise above it.",
        ending=_ending(energy, step),
        charts=[
            Curves("energy of all balls", "%", energy, limits=(90.0, 145.0)),
            Curves("height of the centres", "m", {n: m.height for n, m in curves.items()}, limits=(0.0, 7.6)),
        ],
        counters={"bounces": np.searchsorted(exact.time, times, side="right").astype(float)},
        numbers=_numbers(energy, step),
    )  # fmt: skip


def _loop(order: str, step: float, times: Array) -> BallMotion:
    """What a loop shows at any time: its last step, since it knows nothing in between."""
    motion = bouncing_loop(order, step)
    at = np.minimum(np.floor(times / step + 1e-9).astype(int), motion.time.size - 1)
    return BallMotion(times, motion.height[at], motion.velocity[at])


def _energy(motion: BallMotion) -> Array:
    """Of a ball, kinetic and potential, over that at the start [%]."""
    now = GRAVITY * motion.height + 0.5 * motion.velocity**2
    return np.asarray(100.0 * now / (GRAVITY * DROP))


def _pane(title: str, height: Array) -> Pane:
    across = 0.25 * (np.arange(BALLS) - 0.5 * (BALLS - 1))
    row = joined(
        *(ball(RADIUS, center=(x, 0, 0)) for x in across), what="row of 49 balls"
    )
    place = np.zeros((len(height), 2, 3))
    place[:, 0, 2] = height
    place[:, 1, 2] = -1.0
    left, right = [[WINDOW[0], 0.0, DROP]], [[WINDOW[2], 0.0, DROP]]
    floor = standing(box((20.0, 1.0, 1.0)), endless=True)
    level = Segments("dropped from", left, right, color="grey")
    return Pane([row, floor], place, title=title, segments=[level])


def _numbers(energy: dict[str, Array], step: float) -> list[Number]:
    errors = [0.0, *(energy_error(order, step) for order in ("ode", "bullet"))]
    at_end = tuple(float(e[-1]) for e in energy.values())
    return [
        Number("energy at the end", at_end, "%", 4),
        Number("mean of (E − E₀)²", tuple(errors), "J²"),
        Number("over that of ODE", (0.0, 1.0, errors[2] / errors[1])),
    ]


def _ending(energy: dict[str, Array], step: float) -> str:
    _, ode, bullet = (float(e[-1]) for e in energy.values())
    return (
        f"With a step of {shown_number(1000 * step, 3)} ms Bullet's loop ends with {bullet:.1f} % of its energy "
        f"after 20 s, and ODE's with {ode:.1f} %"
    )
