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
colliders = player("colliders")
cradle = player("cradle")
dome = player("dome")
gap_rate = player("gap_rate")
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
two_blocks = player("two_blocks")
wall = player("wall")

__all__ = [
    "billiard_break", "colliders", "cradle", "dome", "gap_rate", "handle", "impulse", "ladder", "landing_boxes",
    "many_balls", "plank", "player", "pushed_table", "resting", "rod", "shadows", "sinking", "sweeps", "table",
    "two_blocks", "wall",
]  # fmt: skip
