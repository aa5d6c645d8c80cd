"""A mark that has to stay on a tumbling handle: carried by a formula of one's own beside the right one."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, replace
from typing import Any

import numpy as np

from course import rotations
from course.arrays import Array
from course.study import carried_marks as study
from course.study.carried_marks import Mark, Tumbling, tumbling
from course.workbook.films.attempts import Attempt, Stopped, asked_of, moved
from course.workbook.films.tumbling import handle_solid
from course.workbook.stage import (
    Arrows,
    Curves,
    Exhibit,
    Film,
    Knob,
    Number,
    Pane,
    Preset,
    Segments,
    Space,
    ball,
)
from course.workbook.stage.words import shown_number

SECONDS, MOMENTS = 3.0, 241
#: What is seen, whatever the knob says, and where the shadow falls [m].
WINDOW, GROUND = ((-0.14, -0.14, -0.12), (0.16, 0.14, 0.2)), -0.12
FAR = 10.0  # a mark farther away is drawn there [m]
KNOBS = (Knob("tilt", "tilt at the start", 1.0, 0.1, 50.0, unit="°", logarithmic=True),)
PRESETS = (
    Preset("it turns over", {"tilt": 1.0}),
    Preset("it wobbles", {"tilt": 50.0}),
)
#: What is asked, by the exercise: the mark of a function, and the right formula, the printed one.
ASKED: dict[str, tuple[Callable[..., Mark], str, Any]] = {
    "point_velocity": (study.by_velocity, "ṗ = v + ω × r", None),
    "free_point_acceleration": (study.by_acceleration, "p̈ = v̇ + ω̇ × r + ω × (ω × r)", study.cross_lost),
    "normal_rate": (study.by_normal_rate, "Ṅ = ω × N", None),
    "rotate": (study.by_turn, "Rodrigues' formula", None),
}  # fmt: skip


@dataclass(frozen=True, eq=False)
class _Marked:
    """The handle, where its mark is (t, 3) [m], and how far that is from where it belongs (t,) [m]."""

    body: Tumbling
    mark: Array
    off: Array


def carried_mark(against: Any = None, exercise: str = "point_velocity") -> Exhibit:
    """The exact handle, and a mark that a formula carries.

    Args:
        against: plays a second mark beside it: a function of your own, or "printed" for
            ``free_point_acceleration``, whose second term has lost its cross product.
        exercise: whose arguments that function has, one of ``ASKED``.
    """
    says, title, printed = ASKED[exercise]
    answer, attempt = asked_of(against, printed)
    times = np.linspace(0.0, SECONDS, MOMENTS)

    def film(tilt: float) -> Film:
        body = tumbling(times, tilt=np.radians(tilt))
        right = _marked(body, says())
        if against is None:
            return _film(title, right, right, None)
        other = attempt.motion(lambda: _marked(body, says(answer)))
        return _film(title, right, other, attempt)

    return Exhibit(film, KNOBS, presets=PRESETS)


def _marked(body: Tumbling, mark: Mark) -> _Marked:
    place = np.clip(mark(body), -FAR, FAR)
    off = np.linalg.norm(place - body.position - body.arm, axis=1)
    return _Marked(body, place, off)


def _film(title: str, right: _Marked, other: Any, attempt: Attempt | None) -> Film:
    motions = moved(right, other) if attempt else [right]
    names = attempt.names if attempt else ("mark",)
    off = {name: m.off for name, m in zip(names, motions, strict=False)}
    colors = ["blue", "vermillion"][: len(motions)]
    return Film(
        attempt.panes(title, _pane, right, other) if attempt else [_pane("", right)],
        right.body.times,
        Space(ground=GROUND, window=WINDOW),
        title="A mark on a handle",
        caption="The handle moves as it does in truth; the formula carries the mark. Does it stay on the handle?",
        ending=_ending(motions, attempt, other),
        charts=[Curves("how far the mark is off", "m", off, limits=(0.0, 0.45), colors=colors)],
        numbers=[Number("farthest off", tuple(round(float(m.off.max()), 5) for m in motions), "m")],
    )  # fmt: skip


def _pane(title: str, marked: _Marked) -> Pane:
    body = marked.body
    turn = rotations.from_matrix(body.rotation)
    place = np.stack([body.position, marked.mark], axis=1)
    belongs = (body.position + body.arm)[:, None]
    still = np.broadcast_to(rotations.identity(1)[0], turn.shape)
    mark = replace(ball(0.012, color="vermillion"), what="mark")
    return Pane(
        [handle_solid(), mark],
        place,
        np.stack([turn, still], axis=1),
        title=title,
        arrows=[Arrows("ω", body.omega[:, None], "rad/s", at=place[:, :1], scale=0.02, color="green", shown=False)],
        segments=[Segments("off", belongs, place[:, 1:], color="purple")],
        trails=[1],
    )  # fmt: skip


def _ending(motions: list[_Marked], attempt: Attempt | None, other: Any) -> str:
    if attempt and isinstance(other, Stopped):
        return attempt.sentence(other)
    last = float(motions[-1].off.max())
    whose = attempt.whose if attempt else "the formula"
    if last < 1e-4:
        return f"With {whose} the mark stays on the handle"
    return f"With {whose} the mark comes up to {shown_number(100 * last, 3)} cm away from its place"
