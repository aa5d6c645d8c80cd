"""Every point of a manifold as it moves: its d_ddot is that of the separation of the two features its key names."""

import numpy as np
import pytest
from contact.moving_geometry import Flight
from overlap.feature_gaps import feature, separation_and_normal
from overlap.manifolds import box, prism, regular, touching

from course import rotations
from course.contact import contact_system, separation_acceleration
from course.dynamics import Bodies
from course.shapes import Capsule, Sphere
from course.shapes.rounded_polytopes import polytopes

#: Seconds together: left out of the minute's run.
pytestmark = pytest.mark.slow

HALF = [0.5, 0.6, 0.4]


def tilted(shape, angle, axis=(0.6, 0.8, 0.0), about=(0.0, 0.0, 0.0)):
    """The shape turned by a small angle about a horizontal axis through a point."""
    turn = rotations.to_matrix(rotations.from_rotation_vector(angle * np.array(axis)))
    return shape.moved(turn, np.array(about) - turn @ np.array(about))


def capsule(start, end, radius):
    return Capsule(np.array([start], float), np.array([end], float), np.array([radius]))


CASES = {
    "crossed boxes": (tilted(box([0.1, 0.2, 0.899], HALF, 0.4), 0.0), box([0, 0, 0], [0.5, 0.5, 0.5])),
    "tilted 1e-9": (tilted(box([0.1, 0.2, 0.899], HALF, 0.4), 1e-9), box([0, 0, 0], [0.5, 0.5, 0.5])),
    "tilted 1e-6": (tilted(box([0.1, 0.2, 0.899], HALF, 0.4), 1e-6), box([0, 0, 0], [0.5, 0.5, 0.5])),
    "tilted 1e-3": (tilted(box([0.1, 0.2, 0.899], HALF, 0.4), 1e-3), box([0, 0, 0], [0.5, 0.5, 0.5])),
    "aligned, tilted 1e-6": (tilted(box([0.1, 0.2, 0.899], HALF), 1e-6), box([0, 0, 0], [0.5, 0.5, 0.5])),
    "prisms": (prism(regular(5), 0.0, 1.0), prism(regular(7, 0.9, 0.3), -1.0, 0.001)),
    "crossed edges": (tilted(box([0, 0, 0.4], [2, 0.3, 0.3]), np.pi / 4, (1.0, 0.0, 0.0), (0, 0, 0.4)),
                      tilted(box([0, 0, -0.4], [0.3, 2, 0.3]), np.pi / 4, (0.0, 1.0, 0.0), (0, 0, -0.4))),
    "capsule on a face": (capsule([-0.3, 0.1, 0.599], [0.4, 0.2, 0.599], 0.1), box([0, 0, 0], [0.5, 0.5, 0.5])),
    "capsule over two edges": (capsule([-2, 0.1, 0.599], [2, 0.2, 0.599], 0.1), box([0, 0, 0], [0.5, 0.5, 0.5])),
    "face on a capsule": (box([0, 0, 0.599], [0.5, 0.5, 0.5]), capsule([-0.3, 0.1, 0.0], [0.4, 0.2, 0.0], 0.1)),
    "parallel capsules": (capsule([-0.5, 0, 0.299], [1, 0, 0.299], 0.1), capsule([-1, 0, 0], [0.7, 0, 0], 0.2)),
    "crossed capsules": (capsule([-0.5, 0, 0.299], [1, 0.1, 0.299], 0.1), capsule([0, -1, 0], [0.1, 0.7, 0], 0.2)),
    "sphere on an edge": (Sphere(np.array([[0.56, 0.0, 0.57]]), np.array([0.1])), box([0, 0, 0], [0.5, 0.5, 0.5])),
    "sphere on a vertex": (Sphere(np.array([[0.56, 0.55, 0.55]]), np.array([0.1])), box([0, 0, 0], [0.5, 0.5, 0.5])),
    "vertices apart": (box([1.03, 1.04, 1.05], [0.5, 0.5, 0.5]), box([0, 0, 0], [0.5, 0.5, 0.5])),
    "edges apart": (box([1.03, 0.2, 1.05], [0.5, 0.5, 0.5]), box([0, 0, 0], [0.5, 0.5, 0.5])),
}  # fmt: skip


def carried(flight, state, body, points):
    """A body's points now, that were where they were given at the start."""
    start, now = flight.bodies(flight.start), flight.bodies(state)
    old, new = (rotations.to_matrix(b.orientation[body]) for b in (start, now))
    return now.position[body] + (points - start.position[body]) @ old @ new.T


@pytest.mark.parametrize("name", CASES)
def test_acceleration_is_that_of_the_features(name):
    a, b = CASES[name]
    flight = Flight(np.random.default_rng(7), 2)
    bodies, (force, torque) = flight.bodies(flight.start), flight.wrench(0)
    contacts = touching(a, b, margin=0.1)
    assert len(contacts) >= (
        1 if "sphere" in name or "crossed" in name or "apart" in name else 2
    )
    said = separation_acceleration(bodies, contacts, force, torque)
    solids, h = (polytopes(a), polytopes(b)), 5e-4
    states = [flight.at(k * h) for k in (-2, -1, 0, 1, 2)]
    for k in range(len(contacts)):
        parts = [
            feature(s, n) for s, n in zip(solids, contacts.key[k, 2:], strict=True)
        ]
        d = []
        for state in states:
            moved = [
                (kind, carried(flight, state, i, p))
                for i, (kind, p) in enumerate(parts)
            ]
            d.append(separation_and_normal(*moved, contacts.normal[k])[0])
        radii = solids[0].radius[0] + solids[1].radius[0]
        assert contacts.separation[k] == pytest.approx(d[2] - radii, abs=1e-14)
        five = (-d[0] + 16 * d[1] - 30 * d[2] + 16 * d[3] - d[4]) / (12 * h * h)
        # 1e-7: differences of a gap that bends within centimetres; curvature of edges is 1e9, not infinite.
        assert said[k] == pytest.approx(five, rel=1e-6, abs=1e-7), (k, contacts.key[k])


@pytest.mark.parametrize("tilt", [0.0, *10.0 ** np.arange(-9, -2)])
def test_a_tilted_manifold_is_a_contact_system_as_it_is(tilt):
    """A box at rest: b is what gravity does to the separation of each vertex, d_ddot = -g n.z and its lever."""
    a = tilted(box([0.1, 0.2, 1.0], [0.5, 0.5, 0.5], 0.3), tilt)
    b = box([0, 0, 0], [0.5, 0.5, 0.5])
    contacts = touching(a, b, margin=0.01)
    bodies = Bodies(
        [2.0, np.inf], np.stack([np.eye(3) / 3] * 2), [[0.1, 0.2, 1.0], [0, 0, 0]],
        rotations.identity(2), np.zeros((2, 3)), np.zeros((2, 3)),
    )  # fmt: skip
    force = np.array([[0, 0, -2 * 9.81], [0, 0, 0]])
    system = contact_system(bodies, contacts, force, np.zeros((2, 3)))
    np.testing.assert_allclose(system.b, -9.81 * contacts.normal[:, 2], rtol=1e-12)
    level = touching(box([0.1, 0.2, 1.0], [0.5, 0.5, 0.5], 0.3), b, margin=0.01)
    assert len(level) == 5 and np.array_equal(contacts.key, level.key)


def test_capsules_deep_in_one_another_are_a_contact_system_too():
    """Where both are sunk deeper than they are round, the label is one that asks for no curvature."""
    rng = np.random.default_rng(2)
    start, end = rng.uniform(-1, 1, (2, 2, 200, 3))
    radius = rng.uniform(0, 1, (2, 200))
    a, b = (Capsule(start[i], end[i], radius[i]) for i in range(2))
    contacts = touching(a, b)
    bodies = Bodies(
        [1.0, 1.0], np.stack([np.eye(3)] * 2), np.zeros((2, 3)), rotations.identity(2),
        np.zeros((2, 3)), np.zeros((2, 3)),
    )  # fmt: skip
    zero = np.zeros((2, 3))
    assert len(contacts) > 150 and set(contacts.feature) >= {"curved"}
    assert np.isfinite(contact_system(bodies, contacts, zero, zero).b).all()
