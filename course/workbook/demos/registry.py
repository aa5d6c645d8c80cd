"""The demos by name, with the syllabus rows they go with and how long they take in
front of a room.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from typing import Any

from course.workbook import stage
from course.workbook.demos import (
    impacts,
    separation,
    spin,
)
from course.workbook.films.listing import LISTED, Listed, find_film
from course.workbook.syllabus import read_syllabus


@dataclass(frozen=True)
class Demo:
    """A demo for a lecture: its name, what it shows, its syllabus rows, minutes, and
    what to try.
    """

    name: str
    make: Callable[..., Any]
    title: str
    rows: tuple[int, ...]
    minutes: int
    try_this: str
    on_stage: bool = False

    @classmethod
    def of_film(cls, film: Listed) -> Demo:
        """A film of the stage as a demo."""
        make = player(film.name)
        return cls(
            film.name, make, film.title, film.rows, film.minutes, film.look, True
        )


def player(name: str) -> Callable[..., Any]:
    """The function that shows a film of this name: ``demos.impulse(large=False)``."""

    def shown(*, large: bool = False) -> Any:
        film = find_film(name)
        return stage.show(film.exhibit(), still=film.still, large=large)

    shown.__name__ = shown.__qualname__ = name
    shown.__doc__ = find_film(name).title
    return shown


DEMOS = (
    *(Demo.of_film(film) for film in LISTED),
    Demo(
        "wall",
        impacts.wall,
        "A ball meets a wall",
        (18,),
        3,
        "Turn the wall under the ball: only the part along n changes. At e = 0 the ball slides along the wall.",
    ),
    Demo(
        "rod",
        spin.rod,
        "A falling rod is hit at its end, or elsewhere",
        (15, 16, 17, 22),
        5,
        "Level and hit at its end: a quarter of the impulse. Move the hit to the middle; then turn the rod upright.",
    ),
    Demo(
        "gap_rate",
        separation.gap_rate,
        "What closes a gap: two bodies rise and turn",
        (19, 20, 22),
        4,
        "Both centres stand still, and the gap closes. Let A rise until it stays. Then move A's centre over the gap.",
    ),
    Demo(
        "dome",
        separation.dome,
        "Sliding off a dome: what the printed formula counts twice",
        (20, 24),
        5,
        "Look ahead from 42 degrees: it sinks in, and yet the old point falls behind. Past 48 degrees it lets go.",
    ),
)


def find_demo(name: str) -> Demo:
    """The demo of this name; a ``ValueError`` lists them where there is none."""
    for demo in DEMOS:
        if demo.name == name:
            return demo
    raise ValueError(
        f"name: expected one of {', '.join(d.name for d in DEMOS)}; got {name!r}"
    )


def table() -> str:
    """The demos, a line each, with their slides and the minutes they take."""
    slides = {row.number: row.slide for row in read_syllabus()}
    lines = [f"{'name':12} {'slides':10} {'minutes':8} what it shows"]
    for demo in DEMOS:
        shown = sorted({slides[row] for row in demo.rows})
        numbers = f"{shown[0]}-{shown[-1]}" if len(shown) > 1 else f"{shown[0]}"
        lines.append(f"{demo.name:12} {numbers:10} {demo.minutes:<8} {demo.title}")
    return "\n".join(lines)
