"""Widgets to play with: in a lesson ``demos.impulse()``, in front of a room ``course demo impulse``."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass

from course.workbook.demos.impacts import impulse, wall
from course.workbook.demos.panel import Panel

__all__ = ["DEMOS", "Demo", "Panel", "find_demo", "impulse", "wall"]


@dataclass(frozen=True)
class Demo:
    """A demo for a lecture: its name, what it shows, the syllabus rows it goes with, and how long it takes."""

    name: str
    make: Callable[[], Panel]
    title: str
    rows: tuple[int, ...]
    minutes: int
    try_this: str


DEMOS = (
    Demo(
        "impulse",
        impulse,
        "One impact: masses, speeds, restitution",
        (15, 16, 17),
        5,
        "Equal masses and e = 1: they swap. Then make mass 2 a hundred times larger: a wall. Then let them part.",
    ),
    Demo(
        "wall",
        wall,
        "A ball meets a wall",
        (18,),
        3,
        "Turn the wall under the ball: only the part along n changes. At e = 0 the ball slides along the wall.",
    ),
)


def find_demo(name: str) -> Demo:
    """The demo of this name; a ``ValueError`` lists them where there is none."""
    for demo in DEMOS:
        if demo.name == name:
            return demo
    raise ValueError(f"name: expected one of {', '.join(d.name for d in DEMOS)}; got {name!r}")
