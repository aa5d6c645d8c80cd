"""The films by name, with the syllabus rows they go with and what to say about them in a room."""

from __future__ import annotations

from dataclasses import dataclass
from importlib import import_module

from course.arrays import choice
from course.workbook.stage import Exhibit, as_exhibit
from course.workbook.syllabus import read_syllabus


@dataclass(frozen=True)
class Listed:
    """A film: where it is made, what it shows, and how it is used in front of a room.

    Args:
        name: of the film, and of the function that makes it.
        module: of ``course.workbook.films`` in which that function is.
        title: a line.
        rows: of the syllabus.
        minutes: that it takes in a lecture.
        look: where to look, one line for whoever shows it.
        still: the moment of its picture [s].
    """

    name: str
    module: str
    title: str
    rows: tuple[int, ...]
    minutes: int
    look: str
    still: float = 0.0

    def exhibit(self) -> Exhibit:
        """The film, made now."""
        made = getattr(import_module(f"course.workbook.films.{self.module}"), self.name)
        return as_exhibit(made())


LISTED = (
    Listed(
        "impulse",
        "central_impacts",
        "One impact: masses, velocities, restitution",
        (15, 16, 17),
        5,
        "1: they swap. 2: the heavy ball is a wall. Then e to 0, and look at the grey area.",
        still=0.5,
    ),
    Listed(
        "handle",
        "tumbling",
        "A handle that spins in space, and turns over",
        (14,),
        5,
        "2 and play: L stands still, and it turns over. 1 and 3: it does not. Then the tilt ten times smaller.",
        still=1.56,
    ),
    Listed(
        "pushed_table",
        "tables",
        "Push a table from below: which of its feet feel it?",
        (21, 22, 24),
        5,
        "1: foot 3 presses more. Drag the ball inward until the black line meets foot 3 (key 2). 3 and play: it lifts.",
    ),
    Listed(
        "plank",
        "planks",
        "A plank on two feet, and the plane of the two forces",
        (20, 25),
        5,
        "Drag the load outward: at 0.75 m the lines' crossing leaves the quadrant, and a foot lifts. Then play.",
        still=8.0,
    ),
    Listed(
        "sweeps",
        "sweeping",
        "Sweeps of projected Gauss-Seidel through a stack",
        (25,),
        5,
        "1 and play: the forces climb. 2: twelve boxes, not done after 60 sweeps. 3: a heavy top. 5: r = 1.75.",
        still=9.0,
    ),
)


def find_film(name: str) -> Listed:
    """The film of this name; a ``ValueError`` lists them where there is none."""
    choice("name", name, tuple(film.name for film in LISTED))
    return next(film for film in LISTED if film.name == name)


def table() -> str:
    """The films, a line each, with their slides and the minutes they take."""
    slides = {row.number: row.slide for row in read_syllabus()}
    lines = [f"{'name':16} {'slides':10} {'minutes':8} what it shows"]
    for film in LISTED:
        shown = sorted({slides[row] for row in film.rows})
        numbers = f"{shown[0]}-{shown[-1]}" if len(shown) > 1 else f"{shown[0]}"
        lines.append(f"{film.name:16} {numbers:10} {film.minutes:<8} {film.title}")
    return "\n".join(lines)
