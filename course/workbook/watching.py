"""See an answer move: the film of its case, with the answer beside what is right."""

from __future__ import annotations

from typing import Any

from course.arrays import failure
from course.exercises.definition import find_exercise
from course.workbook.lending import name_of

#: The film in which an exercise's function moves bodies, by the exercise's name.
WATCHED = {"impulse_central": "impulse", "wall_bounce": "wall"}


def watch(answer: Any) -> Any:
    """Play your function beside the right one; the last line of a cell.

    Whether it passes its check or not: a wrong one is seen to let bodies through each
    other, or to make them leave too fast.

    Args:
        answer: your function, under its exercise's name.
    Raises:
        ValueError: an exercise whose case is no motion; the words list those that are.
    """
    name = name_of(answer, None)
    find_exercise(name)
    if name not in WATCHED:
        raise failure(
            "answer", f"a function that moves bodies: {', '.join(WATCHED)}", name
        )
    from course.workbook import stage
    from course.workbook.films.listing import find_film

    film = find_film(WATCHED[name])
    return stage.show(film.exhibit(against=answer), still=film.still)
