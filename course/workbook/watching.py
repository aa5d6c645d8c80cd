"""See an answer move: the film of its case, with the answer beside what is right."""

from __future__ import annotations

from dataclasses import dataclass
from importlib import import_module
from typing import Any

from course.arrays import failure
from course.exercises.definition import find_exercise
from course.workbook.lending import name_of


@dataclass(frozen=True)
class Watched:
    """The film in which an exercise's function moves bodies.

    Args:
        module: of ``course.workbook.films``.
        name: of the function there that makes it, with ``against``.
        still: the moment of its picture [s].
        several: whether it has to be told which exercise it is.
    """

    module: str
    name: str
    still: float
    several: bool = False

    def exhibit(self, exercise: str, against: Any) -> Any:
        """The film with an answer beside the right one, or "printed" where the slide errs."""
        made = getattr(import_module(f"course.workbook.films.{self.module}"), self.name)
        more = {"exercise": exercise} if self.several else {}
        return made(against=against, **more)


_impulse = Watched("central_impacts", "impulse", 1.8, several=True)
_handle = Watched("stepped_handles", "handle_steps", 3.0, several=True)
_rod = Watched("rod_impacts", "rod", 0.6, several=True)
_mark = Watched("carried_marks", "carried_mark", 1.5, several=True)
_slide = Watched("sliding_polygons", "sliding", 2.0, several=True)
_meeting = Watched("meeting_shapes", "meeting_film", 4.0, several=True)
_plank = Watched("carried_planks", "carried_plank_film", 0.3, several=True)
_boxed = Watched("boxed_bodies", "boxed", 1.5, several=True)
#: The film of an exercise, by the exercise's name.
WATCHED = {
    "spheres_overlap": _meeting,
    "boxes_overlap": _meeting,
    "closest_point_on_segment": _meeting,
    "sphere_capsule_gap": _meeting,
    "capsule_gap": _meeting,
    "sphere_box_gap": _meeting,
    "support": _boxed,
    "rotated_box_extents": _boxed,
    "k_dop": _boxed,
    "compound_support": _boxed,
    "contact_state": Watched("stepped_boxes", "drifting", 0.8),
    "place": Watched("placed_colliders", "placed", 0.6),
    "shadow_gap": _slide,
    "polygons_overlap": _slide,
    "oriented_boxes_overlap": Watched("sinking_boxes", "sinking", 1.2),
    "swept_spheres_time": Watched("ball_throws", "throws", 1.2),
    "swept_boxes_time": Watched("bullet_and_wall", "swept_bullet", 0.02),
    "conservative_advancement": Watched("rods_and_balls", "rod_to_ball", 0.6),
    "rotate": _mark,
    "world_inertia": _handle,
    "angular_acceleration": _handle,
    "symplectic_euler_step": _handle,
    "rk4_step": _handle,
    "momentum_after": _impulse,
    "separation_speed": _impulse,
    "impulse_central": _impulse,
    "wall_bounce": Watched("wall_bounces", "wall", 1.5),
    "bounce_times": Watched("stepped_balls", "ball_times", 1.0),
    "bouncing_ball_step": Watched("stepped_balls", "ball_steps", 1.0),
    "point_velocity": _mark,
    "effective_mass": _rod,
    "impulse_at_point": _rod,
    "apply_impulse": _rod,
    "simultaneous_impulses": Watched("landed_boxes", "landed_box_film", 0.5),
    "normal_rate": _mark,
    "free_point_acceleration": _mark,
    "angular_acceleration_free": _handle,
    "contact_bias": Watched("held_bars", "held_bar_film", 0.4),
    "point_response": _plank,
    "contact_matrix_entry": _plank,
    "contact_matrix": _plank,
    "solve_contact_qp": _plank,
    "projected_gauss_seidel": _plank,
    "pivot": _plank,
}
_stack = Watched("carried_stacks", "carried_stack_film", 0.35, several=True)
#: Other films of an exercise, by what they show it on.
ELSEWHERE = {
    "stack": {
        n: _stack for n in ("solve_contact_qp", "projected_gauss_seidel", "pivot")
    },
    "cradle": {
        "simultaneous_impulses": Watched(
            "answered_cradles", "answered_cradle_film", 0.75
        )
    },
}
#: Exercises whose formula a slide prints wrongly, and the entry of docs/misprints.md.
MISPRINTED = {
    "impulse_central": 3,
    "separation_speed": 3,
    "wall_bounce": 4,
    "contact_bias": 7,
    "angular_acceleration_free": 9,
    "angular_acceleration": 10,
    "contact_matrix_entry": 11,
    "free_point_acceleration": 12,
    "solve_contact_qp": 14,
    "pivot": 14,
}


def watch(answer: Any, *, on: str | None = None) -> Any:
    """Play your function beside the right one; the last line of a cell.

    Whether it passes its check or not: a wrong one is seen to let bodies through each
    other, or to make them leave too fast. One that raises, or returns something that
    moves nothing, stands still, and its pane says why.

    Args:
        answer: your function, under its exercise's name; or that name alone, where a
            slide prints the formula wrongly: then the printed one plays.
        on: another case, "stack" for contact forces, "cradle" for impulses at once.
    Raises:
        ValueError: an exercise whose case is no motion, a name whose formula is not
            misprinted, a case that it has not; the words list those that are.
    """
    name = answer if isinstance(answer, str) else name_of(answer, None)
    if find_exercise(name)[1].kind == "expression":
        raise failure(
            "answer",
            "one of your functions",
            f"{name}, an expression, by which nothing moves",
        )
    if isinstance(answer, str) and name not in MISPRINTED:
        wanted = (
            f"the function itself, without quotation marks: watch({name})"
            if name in WATCHED
            else f"your function, or where a slide misprints it one of {', '.join(MISPRINTED)}"
        )
        raise failure("answer", wanted, repr(name))
    if name not in WATCHED:
        raise failure(
            "answer", f"a function that moves bodies: {', '.join(WATCHED)}", name
        )
    from course.workbook import stage

    film = WATCHED[name] if on is None else _elsewhere(name, answer, on)
    against = "printed" if isinstance(answer, str) else answer
    return stage.show(film.exhibit(name, against), still=film.still)


def _elsewhere(name: str, answer: Any, on: str) -> Watched:
    cases = [case for case, films in ELSEWHERE.items() if name in films]
    if isinstance(answer, str) or on not in cases:
        known = " or ".join(repr(case) for case in cases) or "nothing"
        wanted = f"{known} for your {name}" if cases else f"left out for {name}"
        raise failure("on", wanted, repr(on))
    return ELSEWHERE[on][name]
