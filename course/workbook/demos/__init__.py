"""Films to play with: in a lesson ``demos.impulse()``, in front of a room ``course demo
impulse``.

Each is a function of one keyword, ``large``: text and controls for a room. What they
show, and where to look, stands in ``course.workbook.films.listing``.
"""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

from course.workbook import stage
from course.workbook.films.listing import find_film, table


def player(name: str) -> Callable[..., Any]:
    """The function that plays the film of this name."""
    film = find_film(name)

    def played(*, large: bool = False) -> Any:
        return stage.show(film.exhibit(), still=film.still, large=large)

    played.__name__ = played.__qualname__ = name
    played.__doc__ = f"{film.title}."
    return played


billiard_break = player("billiard_break")
bullet = player("bullet")
colliders = player("colliders")
cradle = player("cradle")
dome = player("dome")
far_spheres = player("far_spheres")
gap_rate = player("gap_rate")
growing_dop = player("growing_dop")
handle = player("handle")
impulse = player("impulse")
ladder = player("ladder")
landing_boxes = player("landing_boxes")
many_balls = player("many_balls")
plank = player("plank")
pushed_table = player("pushed_table")
resting = player("resting")
rod = player("rod")
shadows = player("shadows")
sinking = player("sinking")
sweeps = player("sweeps")
throws = player("throws")
touching = player("touching")
turning_rod = player("turning_rod")
two_blocks = player("two_blocks")
wall = player("wall")

__all__ = [
    "billiard_break",
    "bullet",
    "colliders",
    "cradle",
    "dome",
    "far_spheres",
    "gap_rate",
    "growing_dop",
    "handle",
    "impulse",
    "ladder",
    "landing_boxes",
    "many_balls",
    "plank",
    "player",
    "pushed_table",
    "resting",
    "rod",
    "shadows",
    "sinking",
    "sweeps",
    "table",
    "throws",
    "touching",
    "turning_rod",
    "two_blocks",
    "wall",
]
