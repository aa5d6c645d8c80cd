"""One impact of two balls: what the impulse makes of their velocities."""

from __future__ import annotations

from typing import Any

import numpy as np

from course.study.meeting_on_a_line import (
    LAST,
    MEETING,
    CentralMotion,
    by_impulse,
    by_momenta,
    by_separation_speed,
    central_motion,
    printed_law,
    printed_speed,
)
from course.workbook.films.attempts import Attempt, Stopped, asked_of, moved
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
    Path,
    Preset,
    ball,
    labelled,
)
from course.workbook.stage.words import shown_number

COLORS = ("blue", "vermillion")
#: What is seen, whatever the knobs say: left, bottom, right, top [m].
WINDOW = (-2.9, -0.95, 2.9, 1.25)
#: Metres drawn for 1 m/s, whatever comes out: an arrow that is held must not change its scale under the hand.
SCALE = 0.40
FASTEST = 4.0  # for which charts have room [m/s], before they are drawn smaller
PUSHED = 0.14  # for which the impulse is seen [s]
ROWS = (0.42, 0.12)  # of the velocities above the balls [m]
BELOW = -0.77  # where the centre of mass is shown [m]
KNOBS = (
    Knob("mass_1", "mass 1 (right)", 1.0, 0.01, 100.0, unit="kg", logarithmic=True),
    Knob("mass_2", "mass 2 (left)", 2.0, 0.01, 100.0, unit="kg", logarithmic=True),
    Knob("velocity_1", "velocity 1", -2.0, -4.0, 4.0, 0.1, "m/s"),
    Knob("velocity_2", "velocity 2", 2.0, -4.0, 4.0, 0.1, "m/s"),
    Knob("restitution", "restitution e", 0.8, 0.0, 1.0, 0.05),
)
PRESETS = (
    Preset("swap", {"mass_1": 1, "mass_2": 1, "velocity_1": 0, "velocity_2": 3, "restitution": 1}),
    Preset("a wall", {"mass_1": 1, "mass_2": 100, "velocity_1": -3, "velocity_2": 0, "restitution": 1}),
    Preset("heavy into light", {"mass_1": 0.1, "mass_2": 10, "velocity_1": 0, "velocity_2": 2, "restitution": 1}),
    Preset("they stick", {"mass_1": 1, "mass_2": 2, "velocity_1": -2, "velocity_2": 2, "restitution": 0}),
    Preset("they part", {"mass_1": 1, "mass_2": 2, "velocity_1": 1, "velocity_2": -0.5, "restitution": 1}),
)  # fmt: skip


#: What an answer says of the impact, by its exercise: the velocities after, the right formula, the printed one.
ASKED: dict[str, tuple[Any, str, Any]] = {
    "impulse_central": (by_impulse, "p̂ = (1 + e) (v₂ − v₁) / (1/m₁ + 1/m₂)", printed_law),
    "momentum_after": (by_momenta, "p₁ + p̂ n, p₂ − p̂ n", None),
    "separation_speed": (by_separation_speed, "they part with −e (v₁ − v₂)·n", printed_speed),
}  # fmt: skip


def impulse(against: Any = None, exercise: str = "impulse_central") -> Exhibit:
    """Two balls on a line; their velocities can be taken by the tip of their arrows.

    Args:
        against: plays a second impulse beside the right one: "printed", the formula of the
            slide as it stands there (not for ``momentum_after``), or a function of your own.
        exercise: whose arguments that function has: ``impulse_central``,
            ``momentum_after`` or ``separation_speed``.
    """
    says, formula, printed = ASKED[exercise]
    answer, attempt = asked_of(against, printed)
    outcome = says(answer)

    def film(**values: Any) -> Film:
        right = central_motion(**values)
        if against is None:
            return _film([("", right)])
        other = attempt.motion(lambda: central_motion(**values, outcome=outcome))
        return _film([(formula, right), (attempt.title, other)], attempt)

    hold = [
        Hand({f"velocity_{k + 1}": (1.0, 0.0, 0.0)}, arrows="velocity", index=k, until=MEETING - 1e-9)
        for k in range(2)
    ]  # fmt: skip
    return Exhibit(
        film,
        KNOBS,
        hold,
        PRESETS,
        question="Ball 2 weighs twice as much as ball 1, they meet head on at 2 m/s, and e = 0.8. "
        "Does ball 2 go on, stop, or turn round?",
        answer="It turns round, with 0.4 m/s: v₂ changes by half of what v₁ changes by, and that is 4.8 m/s. "
        "With e = 0.5 it would stop.",
    )  # fmt: skip


def _film(laws: list[tuple[str, Any]], attempt: Attempt | None = None) -> Film:
    title, right = laws[0]
    other = laws[-1][1]
    pushed = MEETING + PUSHED
    times = np.array([0.0, MEETING, MEETING, pushed, pushed, LAST])
    motions = moved(*(motion for _, motion in laws))

    def pane(title: str, motion: CentralMotion) -> Pane:
        return _pane(title, motion, times)

    return Film(
        attempt.panes(title, pane, right, other) if attempt else [pane(title, right)],
        times,
        Flat("xz", WINDOW),
        title="An impact",
        caption="Two balls on one line, n to the right. Take a velocity by the tip of its arrow before they meet.",
        ending=attempt.sentence(other)
        if attempt and isinstance(other, Stopped)
        else _ending(right),
        charts=_charts(motions, times),
        numbers=_numbers(motions),
        events=(MEETING,),
        speed=0.2,
    )


def _at(motion: CentralMotion, values: Any, times: Any) -> Any:
    """Values of the motion's four moments at the film's six: straight between them."""
    t = motion.times
    late = (values[3] - values[2]) * ((times[3] - t[2]) / (t[3] - t[2])) + values[2]
    return np.stack([values[0], values[1], values[2], late, late, values[3]])


def _pane(title: str, motion: CentralMotion, times: Any) -> Pane:
    line = _at(motion, motion.position, times)
    place = np.zeros((len(times), 3, 3))
    place[:, :2, 0] = line
    place[:, :2, 2] = np.maximum(times - MEETING, 0.0)[:, None] * motion.aside
    place[:, 2, 0] = _at(motion, motion.centre, times)
    place[:, 2, 2] = BELOW
    velocity = np.zeros((len(times), 2, 3))
    velocity[..., 0] = _at(motion, motion.velocity, times)
    push = np.zeros((len(times), 2, 3))
    push[2:4, :, 0] = motion.push
    # One row each, or they would cover each other while the balls approach.
    lifted = motion.radius.max() + np.array(ROWS)
    balls = [
        labelled(ball(r, color=color), str(k + 1))
        for k, (r, color) in enumerate(zip(motion.radius, COLORS, strict=True))
    ]
    return Pane(
        [*balls, labelled(ball(0.045, color="black"), "centre of mass")],
        place,
        title=title,
        arrows=[
            Arrows("velocity", velocity, "m/s", at=place[:, :2], scale=SCALE, color=COLORS,
                   lift=lifted, numbers=True),
            Arrows("impulse p̂", push, "N s", at=place[:, :2], scale=_push_scale(motion), color="green"),
            Arrows("normal n", [[1.0, 0.0, 0.0]], at=[[0.0, 0.0, BELOW]], scale=0.4, color="black", shown=False),
        ],
        trails=[2],
    )  # fmt: skip


def _push_scale(motion: CentralMotion) -> float:
    """Metres for 1 N s: 1, 2 or 5 times a power of ten, so that p_hat fits its ball."""
    largest = float(np.abs(motion.push).max())
    if not largest:
        return 1.0
    wanted = 1.6 / largest
    power = 10.0 ** np.floor(np.log10(wanted))
    return float(power * max(s for s in (1, 2, 5) if s * power <= wanted))


def _charts(motions: list[CentralMotion], times: Any) -> list[Any]:
    shown = motions[-1]
    velocity = _at(shown, shown.velocity, times)
    energy = _at(shown, shown.kinetic_energy, times)
    whole = energy[0].sum()
    # A law that adds energy has no loss to show.
    lost = np.maximum(whole - energy.sum(axis=1), 0.0)
    before, after = shown.velocity[0], motions[0].velocity[-1]
    return [
        Curves("velocity", "m/s", {"v₁": velocity[:, 0], "v₂": velocity[:, 1]}, limits=_around(shown, motions[0])),
        Curves("kinetic energy", "J", {"ball 1": energy[:, 0], "ball 2": energy[:, 1], "lost": lost}, stacked=True),
        Path("both velocities", "v₁ [m/s]", "v₂ [m/s]", velocity[:, 0], velocity[:, 1],
             guides=_guides(shown.mass, before, after)),
    ]  # fmt: skip


def _around(*motions: CentralMotion) -> tuple[float, float]:
    top = _top(*motions)
    return -1.08 * top, 1.08 * top


def _top(*motions: CentralMotion) -> float:
    """As fast as anything is, in steps of a factor of two: pictures stand still while a knob moves."""
    fastest = max(FASTEST, *(float(np.abs(m.velocity).max()) for m in motions))
    return float(FASTEST * 2.0 ** np.ceil(np.log2(fastest / FASTEST)))


def _guides(mass: Any, before: Any, after: Any) -> dict[str, Any]:
    """Where momentum is kept, a line, and where kinetic energy is, an ellipse."""
    centre = float(mass @ before / mass.sum())
    away = before - centre
    energy = float(mass @ away**2)
    turn = np.linspace(0.0, 2 * np.pi, 121)
    if energy == 0.0:
        return {}
    ring = centre + 0 * turn[:, None]
    whole = float(mass @ before**2)
    ring = np.stack([np.cos(turn), np.sin(turn)], axis=-1) * np.sqrt(whole / mass)
    reach = 1.25 * float(np.sqrt(energy)) * np.array([1.0, -1.0]) / mass
    reach /= float(np.sqrt((1 / mass).sum()))
    line = np.stack([centre + reach, centre - reach])
    return {"energy kept": ring, "momentum kept": line}


def _numbers(motions: list[CentralMotion]) -> list[Number]:
    def of(get: Any) -> tuple[float, ...]:
        return tuple(float(get(m)) for m in motions)

    return [
        Number("impulse p̂", of(lambda m: m.impulse), "N s"),
        Number("v₁ after", of(lambda m: m.velocity[-1, 0]), "m/s"),
        Number("v₂ after", of(lambda m: m.velocity[-1, 1]), "m/s"),
        Number("momentum", of(lambda m: m.mass @ m.velocity[-1]), "kg m/s"),
        Number("kinetic energy lost", of(lambda m: m.lost), "J"),
    ]


def _ending(motion: CentralMotion) -> str:
    v1, v2 = motion.velocity[-1]
    if not np.isfinite(motion.meeting):
        return f"They do not approach: nothing happens, and they go on with {v1:.2f} and {v2:.2f} m/s"
    if abs(v1 - v2) < 1e-9:
        return f"They go on together with {v1:.2f} m/s"
    return f"After an impulse of {shown_number(motion.impulse, 3)} N s ball 1 has {v1:.2f} m/s and ball 2 {v2:.2f} m/s"
