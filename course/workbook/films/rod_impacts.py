"""A falling rod is hit by a peg: how much impulse does it take, and how does it turn?"""

from __future__ import annotations

from typing import Any

import numpy as np

from course import rotations
from course.arrays import Array, BoolArray
from course.study import RodLanding, rod_landing
from course.study.asked_rods import asked_rod
from course.workbook.films.attempts import Attempt, Stopped, asked_of, moved
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
    Path,
    Preset,
    box,
    capsule,
    standing,
)
from course.workbook.stage.words import shown_number

MEETING, LAST, SPEED = 0.4, 1.0, 1.0  # [s], [s], of the fall [m/s]
HALF, THICK = 0.5, 0.018  # of the rod [m]
WITHDRAWN = 3.0  # how fast the peg is drawn away [m/s]
#: What is seen, whatever the knobs say: left, bottom, right, top [m].
WINDOW = (-1.1, -0.75, 1.1, 0.85)
SCALE, PUSH_SCALE = 0.15, 0.15  # metres drawn for 1 m/s and for 1 N s
KNOBS = (
    Knob("place", "hit at (0 middle, 1 end)", 1.0, -1.0, 1.0, 0.05),
    Knob("angle", "rod turned by", 0.0, 0.0, 60.0, 1.0, "°"),
    Knob("restitution", "restitution e", 1.0, 0.0, 1.0, 0.05),
)
PRESETS = (
    Preset("the middle", {"place": 0, "angle": 0, "restitution": 1}),
    Preset("the end", {"place": 1, "angle": 0, "restitution": 1}),
    Preset("halfway", {"place": 0.5, "angle": 0, "restitution": 1}),
    Preset("the end, e = 0", {"place": 1, "angle": 0, "restitution": 0}),
    Preset("slanting", {"place": 1, "angle": 45, "restitution": 1}),
)


#: The right formula of an exercise that is asked.
ASKED = {
    "effective_mass": "1/μ = 1/m + (r × n)·I⁻¹ (r × n)",
    "impulse_at_point": "p̂ = −(1 + e) u μ",
    "apply_impulse": "v + p̂ n/m, ω + I⁻¹ (r × p̂ n)",
}


def rod(against: Any = None, exercise: str = "apply_impulse") -> Exhibit:
    """A rod of 1 kg and 1 m that falls at 1 m/s on a peg; the peg can be dragged along it.

    Args:
        against: plays a second rod beside it: a function of your own.
        exercise: whose arguments that function has: ``effective_mass``,
            ``impulse_at_point`` or ``apply_impulse``.
    """
    answer, attempt = asked_of(against)

    def film(place: float, angle: float, restitution: float) -> Film:
        right = rod_landing(angle, restitution, place)
        if against is None:
            return _film("", right)
        own = {exercise: answer}
        other = attempt.motion(lambda: asked_rod(angle, restitution, place, **own))
        return _film(ASKED[exercise], right, other, attempt)

    return Exhibit(
        film,
        KNOBS,
        [Hand({"place": (1 / HALF, 0.0, 0.0)}, body=1, until=MEETING - 1e-9)],
        PRESETS,
        question="A level rod of 1 kg falls at 1 m/s on a peg and nothing is lost. Under its middle the peg gives it "
        "2 N s. How much under its end: more, as much, or less?",
        answer="A quarter of it, 0.5 N s: the end gives way by turning, and feels only 1/4 kg there. "
        "The middle keeps falling at 0.5 m/s, and the rod turns.",
    )  # fmt: skip


def _film(
    title: str, right: RodLanding, other: Any = None, attempt: Attempt | None = None
) -> Film:
    times, after = moments(LAST, [MEETING], frames=61)
    late = (times > MEETING) | after
    since = np.where(late, times - MEETING, 0.0)
    motions = moved(right, other) if attempt else [right]

    def pane(title: str, landing: RodLanding) -> Pane:
        return _pane(title, landing, times, late, since)

    return Film(
        attempt.panes(title, pane, right, other) if attempt else [pane(title, right)],
        times,
        Flat("xz", WINDOW),
        title="A rod and a peg",
        caption="The peg hits once and is drawn away; there is no gravity. Drag it along the rod before they meet.",
        ending=attempt.sentence(other)
        if attempt and isinstance(other, Stopped)
        else _ending(right),
        charts=_charts(motions[-1], times, late, since),
        numbers=_numbers(motions, attempt is not None),
        events=(MEETING,),
        speed=0.35,
    )  # fmt: skip


def _numbers(motions: list[RodLanding], beside: bool) -> list[Number]:
    def of(get: Any) -> tuple[float, ...]:
        return tuple(float(get(m)) for m in motions)

    hit = [Number("point that was hit, after", of(_hit), "m/s")] if beside else []
    return [
        Number("impulse p̂", of(lambda m: m.impulse), "N s"),
        Number("mass felt there", of(lambda m: m.felt), "kg"),
        *hit,
        Number("middle after, upward", of(lambda m: m.after[1, 2]), "m/s"),
        Number("left end", of(lambda m: m.after[0, 2]), "m/s"),
        Number("right end", of(lambda m: m.after[2, 2]), "m/s"),
        Number("spin after, clockwise", of(lambda m: m.spin), "rad/s")
        if beside
        else Number("spin after", of(lambda m: abs(m.spin)), "rad/s"),
        Number("energy kept", of(lambda m: 100 * m.kept), "%"),
    ]


def _hit(landing: RodLanding) -> float:
    """Velocity of the point that was hit after the impact, upward: e if it is right [m/s]."""
    middle, end = landing.after[1, 2], landing.after[2, 2]
    return float(middle + landing.place * (end - middle))


def _motion(
    landing: RodLanding, times: Array, late: BoolArray, since: Array
) -> tuple[Array, Array]:
    """Of upper end, middle and lower end, (t, 3, 3) each: places [m] and velocities [m/s]."""
    middle = np.zeros((len(times), 3))
    middle[:, 2] = np.where(
        late, since * landing.after[1, 2], SPEED * (MEETING - times)
    )
    middle[:, 0] = since * landing.after[1, 0]
    angle = np.radians(landing.angle) + since * landing.spin
    axis = np.stack([np.cos(angle), 0 * angle, -np.sin(angle)], axis=-1)
    side = HALF * np.array([-1.0, 0.0, 1.0])
    place = middle[:, None] + side[:, None] * axis[:, None]
    spin = np.where(late, landing.spin, 0.0)[:, None] * np.array([0.0, 1.0, 0.0])
    centre = np.where(late[:, None], landing.after[1], landing.before[1])
    turning = np.cross(spin[:, None], side[:, None] * axis[:, None])
    return place, centre[:, None] + turning


def _pane(
    title: str, landing: RodLanding, times: Array, late: BoolArray, since: Array
) -> Pane:
    points, velocity = _motion(landing, times, late, since)
    touch = HALF * landing.place * landing.axis
    place = np.zeros((len(times), 2, 3))
    place[:, 0] = points[:, 1]
    place[:, 1] = touch
    place[:, 1, 2] -= THICK + WITHDRAWN * since
    turn = np.zeros((len(times), 2, 3))
    turn[:, 0, 1] = np.radians(landing.angle) + since * landing.spin
    peg = standing(box((0.025, 0.02, 0.6), center=(0, 0, -0.6)))
    push = np.zeros((len(times), 1, 3))
    push[late & (since < 0.25), 0, 2] = landing.impulse
    return Pane(
        [capsule((-HALF, 0, 0), (HALF, 0, 0), THICK), peg],
        place,
        rotations.from_rotation_vector(turn),
        title=title,
        arrows=[
            Arrows("velocity of ends and middle", velocity, "m/s", at=points, scale=SCALE, color="vermillion"),
            Arrows("impulse p̂", push, "N s", at=touch[None], scale=PUSH_SCALE, color="green"),
        ],
    )  # fmt: skip


def _charts(
    landing: RodLanding, times: Array, late: BoolArray, since: Array
) -> list[Any]:
    _, velocity = _motion(landing, times, late, since)
    where = np.linspace(-1.0, 1.0, 81)
    felt = 1 / (1 + 3 * (where * np.cos(np.radians(landing.angle))) ** 2)
    impulse = np.stack([where, (1 + landing.restitution) * felt * SPEED], axis=-1)
    moving = 0.5 * np.sum(velocity[:, 1] ** 2, axis=-1)
    turning = np.where(late, 0.5 * landing.spin**2 / 12, 0.0)
    lost = np.maximum(0.5 * SPEED**2 - moving - turning, 0.0)
    return [
        Path("impulse, by where it is hit", "place (0 middle, 1 end)", "p̂ [N s]",
             np.full(len(times), landing.place), np.full(len(times), landing.impulse),
             guides={"hit elsewhere": impulse}, equal=False, limits=(-1.1, 0.0, 1.1, 2.2),
             answers=True),
        Curves("kinetic energy", "J", {"moving": moving, "turning": turning, "lost": lost}, stacked=True,
               limits=(0.0, 0.55), colors=["blue", "orange", "grey"]),
    ]  # fmt: skip


def _ending(landing: RodLanding) -> str:
    speed = float(landing.after[1, 2])
    way = "up" if speed > 0 else "on down"
    goes = (
        "stands still" if abs(speed) < 5e-3 else f"goes {way} with {abs(speed):.2f} m/s"
    )
    turns = (
        "does not turn"
        if abs(landing.spin) < 5e-3
        else f"turns with {abs(landing.spin):.2f} rad/s, "
        f"{'clockwise' if landing.spin > 0 else 'against the clock'}"
    )
    return f"After {shown_number(landing.impulse, 3)} N s the middle {goes} and the rod {turns}"
