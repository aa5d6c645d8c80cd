"""The Bodies class: derived motion, fixed bodies, checks."""

import subprocess
import sys
from dataclasses import fields, replace

import numpy as np
import pytest
from scipy.spatial.transform import Rotation

from course.dynamics import Bodies


def tumbling(n=5, seed=0):
    rng = np.random.default_rng(seed)
    inertia = np.array([np.diag(rng.uniform(1, 2, 3)) for _ in range(n)])
    q = Rotation.random(n, random_state=rng).as_quat()
    p, angular = rng.normal(size=(2, n, 3))
    return Bodies(rng.uniform(1, 3, n), inertia, rng.normal(size=(n, 3)), q, p, angular)


def test_velocities_follow_from_momenta():
    bodies = tumbling()
    rotation = Rotation.from_quat(bodies.orientation).as_matrix()
    for i in range(5):
        inertia = (
            rotation[i] @ bodies.inertia[i] @ rotation[i].T
        )  # syllabus row 22: omega = I^-1 L in the world
        assert np.allclose(bodies.world_inertia[i], inertia)
        assert np.allclose(
            bodies.world_inverse_inertia[i] @ inertia, np.eye(3), atol=1e-14
        )
        assert np.allclose(
            inertia @ bodies.angular_velocity[i], bodies.angular_momentum[i]
        )
        assert np.allclose(bodies.mass[i] * bodies.velocity[i], bodies.momentum[i])


def test_a_fixed_body_does_not_move_and_its_inertia_is_not_read():
    bodies = Bodies(
        [np.inf],
        np.full((1, 3, 3), np.nan),
        np.zeros((1, 3)),
        [[0, 0, 0, 1]],
        np.zeros((1, 3)),
        np.zeros((1, 3)),
    )
    assert bodies.fixed.all() and bodies.inverse_mass[0] == 0
    assert not bodies.world_inverse_inertia.any()
    assert not bodies.velocity.any() and not bodies.angular_velocity.any()
    assert np.array_equal(bodies.world_inertia[0], np.diag([np.inf] * 3))


def test_balls():
    bodies = Bodies.balls(
        [2.0, np.inf], 0.5, [[0, 0, 0], [1, 0, 0]], [[0, 0, 3.0], [0, 0, 0]]
    )
    assert np.allclose(
        bodies.inertia[0], 0.4 * 2 * 0.25 * np.eye(3)
    )  # solid ball, 2/5 m r^2
    assert np.array_equal(bodies.velocity, [[0, 0, 3], [0, 0, 0]])
    assert np.array_equal(bodies.momentum, [[0, 0, 6], [0, 0, 0]])
    assert len(Bodies.balls(1.0, 0.5, np.zeros((4, 3)))) == 4
    with pytest.raises(
        ValueError,
        match=r"velocity: expected zero in a body of infinite mass; .* in entry 1",
    ):
        Bodies.balls([1.0, np.inf], 0.5, np.zeros((2, 3)), [0, 0, 1.0])
    with pytest.raises(ValueError, match=r"position: expected shape \(n, 3\)"):
        Bodies.balls(1.0, 0.5, [0.0, 0.0, 0.0])


def test_fields_are_copies_that_cannot_be_written_and_replace_works():
    momentum = np.ones((5, 3))
    bodies = replace(tumbling(), momentum=momentum)
    momentum[:] = 7
    assert np.array_equal(bodies.momentum, np.ones((5, 3)))
    with pytest.raises(ValueError, match="read-only"):
        bodies.position[0, 0] = 1
    assert (
        replace(bodies, momentum=momentum).position is bodies.position
    )  # nothing copied twice
    turned = replace(
        bodies,
        orientation=np.roll(bodies.orientation, 1, axis=0),
        inertia=2 * bodies.inertia,
    )
    assert not np.allclose(
        turned.rotation, bodies.rotation
    )  # what is kept of one set is not taken for another
    assert not np.allclose(turned.world_inverse_inertia, bodies.world_inverse_inertia)
    with pytest.raises(AttributeError):
        bodies.mass = np.ones(5)


@pytest.mark.parametrize(
    "field, value, message",
    [
        ("mass", [1.0, 0.0], r"mass: expected positive numbers; got 0.0 in entry 1"),
        ("mass", [[1.0, 1.0]], r"mass: expected shape \(n,\)"),
        ("mass", [1.0, np.nan], "mass: expected positive numbers; got nan"),
        ("inertia", np.eye(3), r"inertia: expected shape \(2, 3, 3\); got shape \(3, 3\)"),
        ("inertia", np.zeros((2, 3, 3)), "inertia: expected symmetric positive definite"),
        ("inertia", [[["a"] * 3] * 3] * 2, "inertia: expected matrices"),
        ("position", np.zeros((3, 3)), r"position: expected shape \(2, 3\); got shape \(3, 3\)"),
        ("position", [[0, 0, 0], [0, 0, np.inf]], r"position: expected finite .* got inf in entry \(1, 2\)"),
        ("orientation", [[0, 0, 0, 1], [0, 0, 0, 2]], r"orientation: expected unit .* length 2.0 in entry 1"),
        ("orientation", np.zeros((2, 3)), "orientation: expected unit quaternions"),
        ("momentum", np.zeros((2, 2)), "momentum: expected vectors"),
        ("angular_momentum", np.zeros(3), r"angular_momentum: expected shape \(2, 3\)"),
    ],
)  # fmt: skip
def test_refuses(field, value, message):
    good = Bodies.balls([1.0, 1.0], 0.5, np.zeros((2, 3)))
    with pytest.raises(ValueError, match=message):
        replace(good, **{field: value})


@pytest.mark.parametrize("field", ["momentum", "angular_momentum"])
def test_refuses_momentum_in_a_fixed_body(field):
    wall = Bodies.balls([1.0, np.inf], 0.5, np.zeros((2, 3)))
    with pytest.raises(
        ValueError,
        match=rf"{field}: expected zero in a body of infinite mass; .* in entry 1",
    ):
        replace(wall, **{field: np.ones((2, 3))})


@pytest.mark.parametrize(
    "which, chosen",
    [
        (1, [1]),
        (np.int64(-1), [5]),
        (slice(None, None, -2), [5, 3, 1]),
        ([4, 0, 4], [4, 0, 4]),
        (np.array([True, False, True, False, False, True]), [0, 2, 5]),
        ([], []),
    ],
)
def test_indexing_selects_rows_of_every_field(which, chosen):
    wall = Bodies.balls(np.inf, 0.5, [[0, 0, -1.0]])
    bodies = Bodies.concatenate([tumbling(), wall])
    picked = bodies[which]
    assert len(picked) == len(chosen)
    for field in fields(Bodies):
        rows = getattr(bodies, field.name)[np.array(chosen, dtype=int)]
        assert np.array_equal(getattr(picked, field.name), rows)
        assert not np.shares_memory(
            getattr(picked, field.name), getattr(bodies, field.name)
        )
        with pytest.raises(ValueError, match="read-only"):
            getattr(picked, field.name)[...] = 0


def test_concatenating_single_bodies_restores_the_set():
    bodies = tumbling()
    again = Bodies.concatenate(bodies)  # iterating gives one body at a time
    for field in fields(Bodies):
        assert np.array_equal(getattr(again, field.name), getattr(bodies, field.name))


@pytest.mark.parametrize(
    "which, error, message",
    [
        (5, IndexError, r"bodies\[...\]: expected an index below 5; got 5"),
        ([0, -6], IndexError, r"bodies\[...\]: expected an index below 5; got -6"),
        (0.5, ValueError, r"bodies\[...\]: expected a mask, whole numbers or a slice"),
        ([[0], [1]], ValueError, r"shape \(k,\); got shape \(2, 1\)"),
        (
            [True],
            ValueError,
            r"bodies\[mask\]: expected shape \(5,\); got shape \(1,\)",
        ),
    ],
)
def test_refuses_an_index(which, error, message):
    with pytest.raises(error, match=message):
        tumbling()[which]


def test_concatenate_refuses_nothing_and_other_types():
    with pytest.raises(ValueError, match="parts: expected at least one Bodies; got no"):
        Bodies.concatenate([])
    with pytest.raises(ValueError, match=r"parts\[1\]: expected Bodies; got float"):
        Bodies.concatenate([tumbling(), 1.0])


def test_no_bodies_are_a_valid_set():
    assert len(Bodies.balls(1.0, 0.5, np.empty((0, 3)))) == 0


def test_importing_dynamics_loads_no_scipy():
    code = "import sys, course.dynamics, course.overlap, course.contact; print('scipy' in sys.modules)"
    out = subprocess.run(
        [sys.executable, "-c", code], capture_output=True, text=True, check=True
    )
    assert out.stdout.strip() == "False"
