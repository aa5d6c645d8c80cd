"""The films by name, with the syllabus rows they go with and what to say about them in a room."""

from __future__ import annotations

from dataclasses import dataclass
from importlib import import_module
from typing import Any

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

    def exhibit(self, **options: Any) -> Exhibit:
        """The film, made now; ``against=function`` for those that play a second one."""
        made = getattr(import_module(f"course.workbook.films.{self.module}"), self.name)
        return as_exhibit(made(**options))


LISTED = (
    Listed(
        "landing_boxes",
        "landings",
        "Three boxes fall: gaps that are asked for, and gaps that are not",
        (0, 1),
        3,
        "1, at a tenth of the speed: which gap is 0 first, and what answers it?",
        still=0.3,
    ),
    Listed(
        "resting",
        "stepped_boxes",
        "A box falls onto a floor in steps: the word that is said in each",
        (1,),
        4,
        "1: it never rests. 3: where does it stop? Then 240 steps a second: which is the least tolerance now?",
        still=0.8,
    ),
    Listed(
        "colliders",
        "mug_colliders",
        "A mug and its colliders, taken apart",
        (1, 2),
        4,
        "1, 2, 3, 4, a guess of the tightness before each. Then together again, and play: it turns with the mug.",
    ),
    Listed(
        "turning_rod",
        "turning_rods",
        "A rod turned by hand in the box along the axes",
        (4,),
        4,
        "Vote first. 1, then take hold of the rod: at 5 degrees it is ten times already. 2: 51. 4: a cube doubles.",
        still=3.0,
    ),
    Listed(
        "growing_dop",
        "growing_dops",
        "A dumbbell in 6, 14, 18 and 26 sides",
        (4, 5),
        4,
        "1 and play: hardly a gain. 3: vote first, 14 or 18 sides? Then turn it, and look at the steps.",
        still=6.5,
    ),
    Listed(
        "far_spheres",
        "spheres_far_out",
        "Two spheres meet far from the origin, in 8 bytes and in 4",
        (9,),
        5,
        "3: where does the right one stop? Then 2: steps of 1 m. Ask what would mend it before you answer.",
        still=6.0,
    ),
    Listed(
        "touching",
        "dragged_shapes",
        "Drag a ball, a rod or a box among others: the gaps, here and far out",
        (3, 4, 9),
        5,
        "1: drag A until a gap is 0. 3, and drag slowly: the right picture jumps. 4: in steps of a metre.",
    ),
    Listed(
        "shadows",
        "polygon_shadows",
        "Two polygons and their shadows on all axes",
        (10, 6),
        5,
        "1: which axes have a gap? Then 2 and 3: only one does. Drag A in until none does.",
    ),
    Listed(
        "sinking",
        "sinking_boxes",
        "A cube sinks onto a cube: six axes and fifteen",
        (4, 10),
        4,
        "Vote first. 1 and play: the orange curve is below 0 while the green one is not. 3: parallel edges.",
        still=1.2,
    ),
    Listed(
        "bullet",
        "bullet_and_wall",
        "A bullet and a wall, looked at once a step",
        (12,),
        4,
        "1 and play: no look sees it. Move where the looks fall; then 3 and 4, and look at the share.",
        still=0.02,
    ),
    Listed(
        "throws",
        "ball_throws",
        "Two balls to throw, what they sweep, and when they meet",
        (12,),
        4,
        "1. Then 3: the swept volumes cross, the balls do not meet. 4 and 5: touching is not meeting.",
        still=1.2,
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
        "impulse",
        "central_impacts",
        "One impact: masses, velocities, restitution",
        (15, 16, 17),
        5,
        "1: they swap. 2: the heavy ball is a wall. Then e to 0, and look at the grey area.",
        still=0.1,
    ),
    Listed(
        "two_blocks",
        "block_collisions",
        "Two blocks and a wall: collisions that count the digits of pi",
        (16, 17, 18),
        6,
        "1, 2, 3, votes before each. The point walks round the circle in equal arcs until it is past the dashed line.",
        still=3.0,
    ),
    Listed(
        "cradle",
        "cradle_laws",
        "Newton's cradle by three laws",
        (16, 17),
        6,
        "1: all keep momentum and energy, and do not agree. Then e to 0.8: look at the sequential pane.",
        still=0.75,
    ),
    Listed(
        "billiard_break",
        "break_laws",
        "The billiard break by three laws",
        (16, 17),
        4,
        "1: which is symmetric? Take the cue ball a little aside: hardly anything of it is left alike.",
        still=0.3,
    ),
    Listed(
        "wall",
        "wall_bounces",
        "A ball meets a wall: the part along n, the part along the wall",
        (18,),
        4,
        "2: flatter, not steeper. Turn the wall, and let them say first where the ball goes.",
        still=1.5,
    ),
    Listed(
        "many_balls",
        "bouncing_loops",
        "49 balls and two loops that differ in one line",
        (18,),
        4,
        "3: the right loop rises above the grey line. Then 1: the ratio of the errors stays at about 400.",
        still=18.0,
    ),
    Listed(
        "rod",
        "rod_impacts",
        "A falling rod hit anywhere: the mass it feels as",
        (15, 16, 17),
        6,
        "1, 2. Then drag the peg from the middle to the end, slowly, and look at the impulse.",
        still=0.5,
    ),
    Listed(
        "gap_rate",
        "gap_rates",
        "A bar over a plank: the gap and what adds to its rate",
        (19,),
        5,
        "1, 2, 3. Then 4: the centre rises and the gap closes. Take the green arrow of A to 0.",
        still=0.2,
    ),
    Listed(
        "dome",
        "dome_gaps",
        "A particle on a dome: three gaps, one of which says whether it parts",
        (19, 20),
        5,
        "2, at a tenth of the speed: blue is below 0 while the old point says it parts. Then 3 and 4.",
        still=0.1,
    ),
    Listed(
        "ladder",
        "sliding_ladders",
        "A ladder slides down a wall, and lets go of it",
        (19, 20),
        4,
        "2: vote first. Then stop where the wall's force is 0, and go on by single steps.",
        still=0.9,
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
