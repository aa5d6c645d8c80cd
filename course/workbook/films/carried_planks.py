"""A plank on two feet, carried for a moment by forces of one's own, beside the right ones."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

import numpy as np

from course import formulas, rotations
from course.study import carried_planks as study
from course.study.carried_planks import CarriedPlank, Forces, carried_plank
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
    Preset,
    Segments,
    ball,
    box,
    joined,
    labelled,
    standing,
)

SECONDS, FORCE = 0.35, 0.002  # and metres for 1 N
THICK = 0.1  # of the plank [m]
#: What is seen, whatever the knob says: left, bottom, right, top [m].
WINDOW = (-1.75, -0.85, 1.75, 1.15)
KNOBS = (Knob("load_at", "place of the load", 1.2, -1.5, 1.5, 0.05, "m"),)
PRESETS = (
    Preset("a foot lifts", {"load_at": 1.2}),
    Preset("between the feet", {"load_at": 0.3}),
    Preset("the other foot lifts", {"load_at": -1.2}),
    Preset("in the middle", {"load_at": 0.0}),
)
_A = "the forces by A, aᵢⱼ = Nᵢ·(response to Nⱼ)"
_F = "f ≥ 0, d̈ = A f + b ≥ 0, f d̈ = 0"
#: What is asked, by the exercise: forces of a function, the right one, its words, what is printed.
ASKED: dict[str, tuple[Callable[..., Forces], Any, str, Any]] = {
    "solve_contact_qp": (study.by_solver, formulas.solve_contact_qp, _F, study.forced),
    "pivot": (study.by_solver, formulas.pivot, _F, study.forced),
    "projected_gauss_seidel": (study.by_sweeps, formulas.projected_gauss_seidel, _F, None),
    "contact_matrix": (study.by_matrix, formulas.contact_matrix, _A, None),
    "contact_matrix_entry": (study.by_entries, formulas.contact_matrix_entry, _A, study.printed_entry),
    "point_response": (study.by_response, formulas.point_response, _A, None),
}  # fmt: skip


def carried_plank_film(against: Any = None, exercise: str = "pivot") -> Exhibit:
    """The plank under the forces that a function gives; the load is dragged along it.

    Args:
        against: plays a second one beside it: a function of your own, or "printed": the
            forces with which every d_ddot is 0 (``pivot``, ``solve_contact_qp``), or
            the bracket of ``contact_matrix_entry`` as it stands on the slide.
        exercise: whose arguments that function has, one of ``ASKED``.
    """
    says, reference, title, printed = ASKED[exercise]
    answer, attempt = asked_of(against, printed)
    times = np.linspace(0.0, SECONDS, 36)

    def film(load_at: float) -> Film:
        right = carried_plank(load_at, says(reference), times)
        if against is None:
            return _film(title, right, right, None)
        other = attempt.motion(lambda: carried_plank(load_at, says(answer), times))
        return _film(title, right, other, attempt)

    return Exhibit(film, KNOBS, [Hand({"load_at": (0.0, 1.0, 0.0)}, body=1)], PRESETS)


def _film(title: str, right: CarriedPlank, other: Any, attempt: Attempt | None) -> Film:
    motions = moved(right, other) if attempt else [right]
    names = attempt.names if attempt else ("right",)
    curves = {
        f"{name}, foot {k + 1}": m.gap[:, k]
        for name, m in zip(names, motions, strict=False)
        for k in (0, 1)
    }
    colors = ["blue", "sky", "vermillion", "orange"][: 2 * len(motions)]
    return Film(
        attempt.panes(title, _pane, right, other) if attempt else [_pane("", right)],
        right.times,
        Flat("yz", WINDOW),
        title="A plank on two feet",
        caption="For a moment the forces stay as they are at the start. Drag the load: "
        "does the plank sink into a foot, or leave one that should carry it?",
        ending=_ending(motions, attempt, other),
        charts=[Curves("gap over each foot", "m", curves, limits=(-0.65, 0.65), colors=colors)],
        numbers=[
            Number(f"{name}{'₁₂'[k]}", tuple(_round(get(m)[k]) for m in motions), unit)
            for name, unit, get in (
                ("f", "N", lambda m: m.force), ("d̈", "m/s²", lambda m: m.acceleration),
            )
            for k in (0, 1)
        ],
        speed=0.15,
    )  # fmt: skip


def _round(value: float) -> float:
    """What is rounding of a solver is 0."""
    return round(float(value), 4)


def _pane(title: str, motion: CarriedPlank) -> Pane:
    count = len(motion.times)
    turn = rotations.from_rotation_vector(np.outer(motion.angle, [1.0, 0.0, 0.0]))
    y = motion.centre[0, 1]
    middle = box((0.1, 1.5, 0.5 * THICK), center=(0, -y, 0.5 * THICK), color="orange")
    load = labelled(ball(0.14, color="blue"), "20")
    place = np.zeros((count, 5, 3))
    place[:, 0] = motion.centre
    place[:, 1] = motion.centre + rotations.rotate(
        turn, np.array([0.0, motion.load_at - y, THICK + 0.14])
    )
    place[:, 2:4, 1], place[:, 2:4, 2] = motion.feet, -0.35
    place[:, 4, 2] = -1.7
    turns = np.tile(rotations.identity(1), (count, 5, 1))
    turns[:, :2] = turn[:, None]
    feet = [labelled(standing(box((0.1, 0.06, 0.35))), name) for name in "12"]
    ground = standing(box((0.1, 30.0, 1.0)), endless=True)
    at = np.zeros((2, 3))
    at[:, 1] = motion.feet
    push = np.broadcast_to(motion.force[:, None] * [0.0, 0.0, 1.0], (count, 2, 3))
    met = at + motion.gap[:, :, None] * [0.0, 0.0, 1.0]
    return Pane(
        [joined(middle, what="plank"), load, *feet, ground],
        place,
        turns,
        title=title,
        arrows=[Arrows("force f", push, "N", at=at - [0, 0.12, 0], scale=FORCE, color="green", numbers=True)],
        segments=[Segments("gap d", np.broadcast_to(at, met.shape), met)],
    )  # fmt: skip


def _ending(motions: list[CarriedPlank], attempt: Attempt | None, other: Any) -> str:
    if attempt and isinstance(other, Stopped):
        return attempt.sentence(other)
    last = motions[-1]
    whose = attempt.whose if attempt else "the forces"
    least = float(last.acceleration.min())
    alike = np.allclose(motions[0].force, last.force, atol=1e-4)
    if len(motions) == 2 and alike:
        return "Here both carry the plank alike"
    if least < -1e-3:
        return f"With {whose} the plank sinks in, d̈ = {least:.2f} m/s²"
    if last.force.min() < -1e-3:
        return f"With {whose} a foot pulls, with {-last.force.min():.0f} N"
    pressed = float((last.force * last.acceleration).max())
    if pressed > 0.1:
        return f"With {whose} a foot presses that the plank has left: f d̈ is not 0"
    return f"With {whose} nothing sinks in, and nothing pulls"
