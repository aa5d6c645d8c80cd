"""Resting scenes drawn by seed, for tests and benchmarks: tangles, and anything that rests, changed in any way."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import replace

import numpy as np

from course.arrays import whole_number
from course.dynamics import Bodies
from course.overlap import Contacts
from course.scenes.balls import balls_on_domes, cannonballs, pile
from course.scenes.changes import (
    about_to_part,
    on_a_moving_ground,
    shaken,
    weighed_anew,
    with_duplicates,
    with_redundant_points,
)
from course.scenes.layout import contacts_at, with_ground
from course.scenes.masonry import stack, wall
from course.scenes.resting_bodies import table, wedged_ball
from course.scenes.scene import Scene, resting, resting_again

#: What may be done to a random scene, in this order, each with its chance.
CHANCES = {
    "mass ratio": 0.4,
    "shaken": 0.5,
    "redundant": 0.15,
    "duplicates": 0.15,
    "parting": 0.06,
    "moving": 0.15,
}


def random_scene(seed: int | Sequence[int], *, contacts: int = 100) -> Scene:
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
    changes: dict[str, Callable[[Scene], Scene]] = {
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
    return resting_again(scene, contacts=scene.contacts[:0]) if contacts == 0 else scene


def tangle(count: int, contacts: int, rng: np.random.Generator) -> Scene:
    """Bodies pushed at random, with contacts anywhere and in any direction between any two or one and the ground.

    No geometry would make it, and no body has such inertias; solvers must
    bear both. Velocities are 0, so a solution exists.
    """
    whole_number("count", count, minimum=1)
    whole_number("contacts", contacts)
    root = rng.normal(size=(count, 3, 3))
    mass = rng.uniform(0.5, 2, count)
    bodies = with_ground(
        mass,
        root @ np.swapaxes(root, 1, 2) + 0.1 * np.eye(3),
        rng.normal(size=(count, 3)),
    )
    a = rng.integers(count, size=contacts)
    b = (a + rng.integers(1, count + 1, size=contacts)) % (count + 1)
    normal = rng.normal(size=(contacts, 3))
    normal /= np.linalg.norm(normal, axis=1, keepdims=True)
    found = contacts_at(rng.normal(size=(contacts, 3)), normal, a=a, b=b)
    force, torque = rng.normal(size=(2, count + 1, 3))
    return resting("tangle", bodies, found, applied_force=force, torque=torque)


def side_by_side(scenes: Sequence[Scene]) -> Scene:
    """Scenes under the same gravity that do not touch, as one; each keeps its ground."""
    start = np.cumsum([0] + [len(s.bodies) for s in scenes])
    contacts = [
        replace(s.contacts, body_a=s.contacts.body_a + n, body_b=s.contacts.body_b + n)
        for s, n in zip(scenes, start, strict=False)
    ]
    return resting(
        f"{len(scenes)} scenes",
        Bodies.concatenate(s.bodies for s in scenes),
        Contacts.concatenate(contacts),
        gravity=scenes[0].gravity,
        applied_force=np.concatenate([s.applied_force for s in scenes]),
        torque=np.concatenate([s.torque for s in scenes]),
        solvable=all(s.solvable for s in scenes),
    )


def _kinds(rng: np.random.Generator, contacts: int) -> dict[str, Callable[[], Scene]]:
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


def _any_table(rng: np.random.Generator) -> Scene:
    if rng.uniform() < 0.2:
        return wedged_ball(float(rng.choice([0.0, rng.uniform(0.1, 1.4)])))
    x, y = rng.uniform(-0.6, 0.6, 2)
    return table(int(rng.integers(1, 9)), offset=(float(x), float(y)))
