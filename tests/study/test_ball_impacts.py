"""Newton's cradle by laws and springs, the billiard break, and balls on a table."""

import numpy as np
import pytest
from scenes.parts import bodies_and_contacts

from course.dynamics import Bodies, normal_velocity
from course.scenes import rack, touching_row
from course.study import (
    billiard_break,
    compare_cradles,
    cradle,
    cradle_by_springs,
    roll,
)

pytestmark = pytest.mark.slow  # with its like, left out of --quick

LAWS = ("simultaneous", "sequential", "reflection")
TABLE = ((-1.2, -0.6), (1.2, 0.6))


def test_cradle_of_the_laws():
    assert np.allclose(cradle([1.0, 0, 0]), [-1 / 3, 2 / 3, 2 / 3])
    assert np.allclose(cradle([1.0, 0, 0], law="sequential"), [0, 0, 1])
    assert np.allclose(
        cradle([1.0, 0], restitution=0.5, mass=[1.0, 3.0]), [-0.125, 0.375]
    )
    bodies, contacts = bodies_and_contacts(touching_row([1.0, 0, 0, 0]))
    assert len(bodies) == 4 and contacts.body_b.tolist() == [1, 2, 3]


def test_springs_reproduce_the_published_cradles():
    # Three balls of one mass; any stiffness gives the same end.
    linear, hertz = [-0.13026, 0.15023, 0.98003], [-0.07095, 0.07640, 0.99455]
    for stiffness in (1.0, 3e7):
        end = cradle_by_springs([1, 0, 0], exponent=1.0, stiffness=stiffness).final
        assert np.allclose(end, linear, atol=5e-6)
        assert np.allclose(
            cradle_by_springs([1, 0, 0], stiffness=stiffness, mass=0.2).final,
            hertz,
            atol=5e-6,
        )
    assert np.allclose(
        2 * np.array(hertz), cradle_by_springs([2, 0, 0]).final, atol=1e-5
    )


def test_two_balls_on_a_linear_spring_follow_the_sine():
    # One contact: delta = v/w sin(w t), w^2 = 2 k/m, until w t = pi; then the velocities have changed hands.
    motion = cradle_by_springs([1.0, 0.0], exponent=1.0, stiffness=8.0, mass=4.0)
    inside = motion.time < np.pi / 2
    assert np.allclose(
        motion.force[inside, 0],
        8.0 * np.sin(2.0 * motion.time[inside]) / 2.0,
        atol=1e-7,
    )
    assert np.allclose(motion.final, [0, 1], atol=1e-8)
    assert not motion.force[motion.time > np.pi / 2 + 0.01].any()


@pytest.mark.parametrize("exponent", [1.0, 1.5])
def test_springs_keep_momentum_and_energy(exponent):
    start, mass = np.array([1.0, 0.3, 0.0, -0.4]), np.array([1.0, 2.0, 0.5, 1.5])
    motion = cradle_by_springs(start, exponent=exponent, stiffness=50.0, mass=mass)
    assert np.allclose(motion.velocity @ mass, start @ mass, atol=1e-9)
    stored = (
        np.maximum(-np.diff(motion.displacement, axis=1), 0) ** (exponent + 1)
        * 50
        / (exponent + 1)
    )
    total = 0.5 * motion.velocity**2 @ mass + stored.sum(axis=1)
    assert np.allclose(total, total[0], rtol=1e-7)
    assert np.all(np.diff(motion.final) >= 0)


def test_no_single_law_is_the_truth():
    table = compare_cradles([1.0, 0, 0])
    assert table.model == (*LAWS, "linear springs", "Hertz springs")
    assert table.difference[-1] == 0
    assert table.difference[0] > 0.5 and 0.07 < table.difference[1] < 0.08
    assert np.allclose(table.velocity.sum(axis=1), 1) and np.allclose(
        (table.velocity**2).sum(axis=1), 1
    )


@pytest.mark.parametrize("law", LAWS)
def test_break(law):
    shot = billiard_break(law=law)
    assert len(shot.contacts) == 31
    v = shot.after.velocity
    assert np.allclose(v.sum(axis=0), [8, 0, 0], atol=1e-13) and (
        v**2
    ).sum() == pytest.approx(64, rel=1e-13)
    assert normal_velocity(shot.after, shot.contacts).min() >= -8e-12
    if law != "sequential":  # straight on: left and right alike
        mirror = np.array(
            [
                np.argmin(np.linalg.norm(shot.before.position - p * [1, -1, 1], axis=1))
                for p in shot.before.position
            ]
        )
        assert np.allclose(v[mirror] * [1, -1, 1], v, atol=1e-12)


def test_laws_disagree_on_the_break():
    outcomes = [billiard_break(law=law).after.velocity for law in LAWS]
    for i in range(3):
        for j in range(i):
            assert np.abs(outcomes[i] - outcomes[j]).max() > 1


def test_break_off_centre():
    shot = billiard_break(offset=0.02, restitution=0.9)
    apart = shot.before.position[0] - shot.before.position[1]
    assert np.linalg.norm(apart) == pytest.approx(2 * shot.radius) and apart[1] == 0.02
    assert 0 < (shot.after.velocity**2).sum() < 64


def test_two_balls_meet_head_on_at_the_time_of_impact():
    # A gap of 2 at relative speed 1: they touch at t = 2, then swap velocities.
    bodies = Bodies.balls(1.0, 0.5, [[0, 0, 0], [3.0, 0, 0]], [[1.0, 0, 0], [0, 0, 0]])
    tracks = roll(bodies, 0.5, 5.0)
    assert tracks.events == 1 and tracks.finished
    assert tracks.time.tolist() == pytest.approx([0, 2, 5])
    assert np.allclose(tracks.position[-1], [[2, 0, 0], [6, 0, 0]])


def test_cushions_mirror_and_a_corner_mirrors_twice():
    bodies = Bodies.balls(1.0, 0.1, [[0.0, 0, 0]], [[1.0, 1.0, 0]])
    tracks = roll(bodies, 0.1, 2.0, table=((-0.5, -0.5), (0.6, 0.6)))
    assert tracks.events == 2  # into the corner at 0.5 s, and the other at 1.4 s
    assert np.allclose(tracks.velocity[-1], [[1, 1, 0]]) and np.allclose(
        tracks.position[-1], [[0.2, 0.2, 0]]
    )


@pytest.mark.parametrize("law", LAWS)
@pytest.mark.parametrize("e", [1.0, 0.9])
def test_balls_stay_apart_and_on_the_table(law, e):
    shot = billiard_break(law=law, restitution=e, offset=0.003)
    tracks = roll(shot.after, shot.radius, 1.0, table=TABLE, law=law, restitution=e)
    assert tracks.finished and tracks.events > 10 and np.all(np.diff(tracks.time) >= 0)
    for x in tracks.position:
        gaps = (
            np.linalg.norm(x[:, None] - x, axis=-1)[np.triu_indices(16, 1)]
            - 2 * shot.radius
        )
        assert gaps.min() > -1e-9
        assert np.abs(x[:, 0]).max() < 1.2 - shot.radius + 1e-9
        assert np.abs(x[:, 1]).max() < 0.6 - shot.radius + 1e-9
    energy = (tracks.velocity**2).sum(axis=(1, 2))
    assert np.all(np.diff(energy) <= 1e-11)
    if e == 1:
        assert np.allclose(energy, 64, rtol=1e-12)


def test_too_many_events_are_said():
    bodies = Bodies.balls(1.0, 0.1, [[0.0, 0, 0]], [[1.0, 0, 0]])
    tracks = roll(bodies, 0.1, 100.0, table=((-0.5, -0.5), (0.5, 0.5)), max_events=7)
    assert not tracks.finished and tracks.events == 7 and tracks.time[-1] < 100


@pytest.mark.parametrize(
    "call, message",
    [
        (lambda: cradle([1.0]), r"velocity: expected the speeds of at least two balls"),
        (lambda: cradle([1.0, 0], law="none"), "law: expected one of"),
        (lambda: cradle_by_springs([1.0, 0], exponent=0.5), "exponent: expected at least 1; got 0.5"),
        (lambda: cradle_by_springs([1.0, 0], stiffness=0.0), "stiffness: expected positive numbers"),
        (lambda: billiard_break(offset=0.06), "offset: expected less than two radii"),
        (lambda: rack(rows=0), "rows: expected a whole number of at least 1"),
        (lambda: roll(Bodies.balls(np.inf, 1.0, [[0.0, 0, 0]]), 1.0, 1.0), "bodies: expected free balls"),
        (lambda: roll(Bodies.balls(1.0, 1.0, [[0.0, 0, 0]]), 1.0, 1.0, table=((0, 0), (1, 1))), "table: expected two"),
    ],
)  # fmt: skip
def test_refuses(call, message):
    with pytest.raises(ValueError, match=message):
        call()
