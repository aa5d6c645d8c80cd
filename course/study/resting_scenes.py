"""Scenes of resting contact, laid out or drawn by seed: for tests, benchmarks and lessons.

Every scene has velocities with d_dot = 0 at all its contacts, so that
``contact_system`` takes it as it is. The last body is the fixed ground unless
a scene says otherwise.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import replace

import numpy as np

from course.arrays import whole_number
from course.study.resting_balls import balls_on_domes, cannonballs, pile, wedged_ball
from course.study.resting_changes import (
    about_to_part,
    on_a_moving_ground,
    shaken,
    weighed_anew,
    with_duplicates,
    with_redundant_points,
)
from course.study.resting_layouts import (
    GRAVITY,
    RestingScene,
    leaning_rod,
    side_by_side,
    spinning_between_pins,
    stack,
    table,
    tangle,
    wall,
)

__all__ = [
    "GRAVITY",
    "RestingScene",
    "about_to_part",
    "balls_on_domes",
    "cannonballs",
    "leaning_rod",
    "on_a_moving_ground",
    "pile",
    "random_scene",
    "shaken",
    "side_by_side",
    "spinning_between_pins",
    "stack",
    "table",
    "tangle",
    "wall",
    "wedged_ball",
    "weighed_anew",
    "with_duplicates",
    "with_redundant_points",
]

#: What may be done to a random scene, in this order, each with its chance.
CHANCES = {
    "mass ratio": 0.4,
    "shaken": 0.5,
    "redundant": 0.15,
    "duplicates": 0.15,
    "parting": 0.06,
    "moving": 0.15,
}


def random_scene(seed: int | Sequence[int], *, contacts: int = 100) -> RestingScene:
    """A scene that has a solution, drawn from all that is here, of about this many contacts.

    Stacks, walls, blocks of bricks, piles, pyramids of balls, tangles, many
    tables or balls on domes side by side; then masses up to 1,000 times
    heavier or lighter, random accelerations, redundant points, duplicates,
    no load, a ground that flies and turns.

    Args:
        seed: of ``numpy.random.default_rng``.
        contacts: about how many; 0 gives a scene without any.
    """
    whole_number("contacts", contacts)
    rng = np.random.default_rng(seed)
    kinds = _kinds(rng, max(contacts, 1))
    scene = kinds[str(rng.choice(list(kinds)))]()
    still = not np.any(scene.bodies.momentum)
    changes: dict[str, Callable[[RestingScene], RestingScene]] = {
        "mass ratio": lambda s: weighed_anew(
            s, 10.0 ** rng.uniform(-3, 3, len(s.bodies))
        ),
        "shaken": lambda s: shaken(
            s, rng, strength=float(10.0 ** rng.uniform(-3, 0.5))
        ),
        "redundant": lambda s: with_redundant_points(s, rng),
        "duplicates": lambda s: with_duplicates(s, rng),
        "parting": lambda s: about_to_part(s, float(rng.choice([0.0, 1.0]))),
        "moving": lambda s: on_a_moving_ground(
            s, rng.normal(size=3), rng.normal(size=3)
        ),
    }
    for change, make in changes.items():
        if rng.uniform() < CHANCES[change] and (
            still or change not in ("mass ratio", "moving")
        ):
            scene = make(scene)
    return replace(scene, contacts=scene.contacts[:0]) if contacts == 0 else scene


def _kinds(
    rng: np.random.Generator, contacts: int
) -> dict[str, Callable[[], RestingScene]]:
    """What a scene of this many contacts may be."""
    side, edge = (
        max(round(np.sqrt(contacts / 8)), 2),
        max(round((contacts / 16) ** (1 / 3)), 2),
    )
    return {
        "tables": lambda: side_by_side(
            [_any_table(rng) for _ in range(max(contacts // 4, 1))]
        ),
        "domes": lambda: balls_on_domes(contacts, rng),
        "stack": lambda: stack(max(contacts // 4, 1), corners=int(rng.choice([1, 4]))),
        "wall": lambda: wall(max(side + int(rng.integers(-side // 2, side)), 1), side),
        "block": lambda: wall(edge, edge, depth=edge),
        "pile": lambda: pile(max(contacts // 3, 1), rng),
        "cannonballs": lambda: cannonballs(max(round((contacts * 0.75) ** (1 / 3)), 1)),
        "tangle": lambda: tangle(
            max(int(contacts * 10.0 ** rng.uniform(-1.5, 0)), 1), contacts, rng
        ),
    }


def _any_table(rng: np.random.Generator) -> RestingScene:
    if rng.uniform() < 0.2:
        return wedged_ball(float(rng.choice([0.0, rng.uniform(0.1, 1.4)])))
    x, y = rng.uniform(-0.6, 0.6, 2)
    return table(int(rng.integers(1, 9)), offset=(float(x), float(y)))
