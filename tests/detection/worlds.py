"""Colliders of all kinds, drawn by seed, and what a world of them must say, found pair by pair."""

from dataclasses import dataclass, field, replace

import numpy as np
from overlap.drawn_shapes import DRAW, turns
from scipy.spatial.transform import Rotation

from course.detection import CollisionWorld
from course.overlap import contacts


@dataclass
class Told:
    """A collider as the test knows it."""

    shape: object
    body: int
    fixed: bool = False
    group: int = 1
    mask: int = -1
    pose: tuple = field(default=None)

    @property
    def standing(self):
        return self.shape if self.pose is None else self.shape.moved(*self.pose)


def may_touch(a, b):
    return (
        a.body != b.body
        and not (a.fixed and b.fixed)
        and bool(a.group & b.mask)
        and bool(b.group & a.mask)
    )


def expected_rows(told, margin=0.0):
    """What ``contacts`` must give: key, bodies and numbers of each contact, from all pairs one by one."""
    rows = []
    for g, a in told.items():
        for h, b in told.items():
            if g < h and may_touch(a, b):
                pair = (a.body, b.body)
                found = contacts(a.standing, b.standing, margin=margin, body_a=pair[0], body_b=pair[1])  # fmt: skip
                key = found.key + np.array([g, h, 0, 0])
                rows += rows_of(replace(found, key=key))
    return sorted(rows)


def rows_of(found):
    """One tuple a contact: key, bodies, feature, and the numbers to 9 digits."""
    numbers = np.column_stack([found.point, found.normal, found.separation])
    columns = (found.key, found.body_a, found.body_b, found.feature, numbers)
    return [
        (*k.tolist(), int(a), int(b), str(f), *(np.round(n, 9) + 0.0).tolist())
        for k, a, b, f, n in zip(*columns, strict=True)
    ]


def drawn_world(rng, count=6, planes=2, **columns):
    """A world of all kinds, and what a test knows of it, by handle."""
    world, told, body = CollisionWorld(), {}, 0
    for kind, draw in DRAW.items():
        n = planes if kind == "half_space" else count
        shapes = draw(rng, n)
        bodies = body + np.arange(n)
        handles = world.add(shapes, body=bodies, **columns)
        for k, handle in enumerate(handles.tolist()):
            told[handle] = Told(shapes[k], int(bodies[k]), **columns)
        body += n
    return world, told


def move_some(world, told, rng, handles, step=0.3, *, angle=None):
    """Move some colliders in one call: to drawn poses, or from where they are by a small angle each."""
    turn, shift = turns(rng, len(handles)), rng.normal(0, step, (len(handles), 3))
    if angle is not None:
        poses = [told[h].pose or (np.eye(3), np.zeros(3)) for h in handles]
        small = Rotation.from_rotvec(rng.normal(0, angle, shift.shape)).as_matrix()
        turn = small @ np.reshape([r for r, _ in poses], (-1, 3, 3))
        shift += np.reshape([t for _, t in poses], (-1, 3))
    world.move(handles, turn, shift)
    for k, handle in enumerate(handles):
        told[handle] = replace(told[handle], pose=(turn[k], shift[k]))
