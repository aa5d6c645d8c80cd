"""What scenes say is true, against what bodies do: contact forces, impulses and motions; and what an error is."""

from dataclasses import replace

import numpy as np
import pytest
from scenes.parts import bodies_and_contacts

from course.contact import resolve_collisions, solve
from course.dynamics import Bodies, explicit_euler, reference_motion
from course.overlap import FEATURES
from course.scenes import (
    GRAVITY,
    Scene,
    about_to_part,
    balls_on_domes,
    bar_over_plank,
    cannonballs,
    falling_rods,
    ladder,
    leaning_rod,
    loaded_plank,
    moving_contact,
    on_a_moving_ground,
    pile,
    rod_on_two_pegs,
    shaken,
    spinning_body,
    spinning_handle,
    stack,
    table,
    tilted_foot,
    touching_row,
    wall,
    wedged_ball,
    weighed_anew,
    with_duplicates,
    without_forces,
)
from course.study import rod_on_spring

KNOWN = [
    stack(4, corners=1, mass=[1.0, 30.0, 0.1, 5.0]),
    stack(1, corners=1),
    *(leaning_rod(angle, length=3.0) for angle in (0.0, 1.1)),
    *(wedged_ball(angle) for angle in (0.5, 2.9)),
    ladder(1.2),
    ladder(0.9, rate=-0.4, length=3.0, mass=7.0),
    ladder(0.7, kerb=True),
    *(loaded_plank(y) for y in (0.3, -0.75, 1.3)),
    loaded_plank(-1.05, load=55.0),
    loaded_plank(0.9, feet=1.2, mass=3.0),
    balls_on_domes(60, np.random.default_rng(12)),
]
OPEN = [
    table(),
    stack(3),
    wall(3, 4),
    pile(15, np.random.default_rng(13)),
    cannonballs(3),
]


@pytest.mark.parametrize("scene", KNOWN, ids=lambda s: s.name)
def test_forces_in_closed_form_are_those_of_the_contact_system(scene):
    found = solve(scene.system(), tolerance=1e-13).force
    np.testing.assert_allclose(found, scene.truth, atol=1e-8 * scene.truth.max())
    assert scene.error(scene.truth) == 0
    wrong = scene.truth + 2.0 * (np.arange(len(scene.truth)) == 0)
    assert scene.error(wrong) == pytest.approx(2.0)  # [N]


@pytest.mark.parametrize("scene", OPEN, ids=lambda s: s.name)
def test_where_forces_are_not_unique_the_error_is_the_residual(scene):
    found = solve(scene.system()).force
    assert scene.truth is None and scene.error(found) < 1e-10
    assert scene.error(0 * found) > 1e-3 and scene.error(1.1 * found + 1) > 1e-3
    with pytest.raises(ValueError, match="force: expected shape"):
        scene.error(found[1:])


def test_upright_walls_push_as_much_as_one_likes():
    scene = wedged_ball(0.0)
    assert scene.truth is None
    assert scene.error([0, 0]) == 0 and scene.error([3.0, 3.0]) < 1e-15
    assert scene.error([3.0, 2.0]) > 0.1


@pytest.mark.parametrize(
    "change",
    [
        lambda s: shaken(s, np.random.default_rng(1)),
        lambda s: weighed_anew(s, [2.0, 3.0, np.inf]),
        lambda s: with_duplicates(s, np.random.default_rng(1)),
        lambda s: about_to_part(s, 1.0),
        lambda s: tilted_foot(s, 0, 0.2),
        lambda s: on_a_moving_ground(s, [1.0, 2, 3], [0.1, 0.2, 0.3]),
        without_forces,
    ],
)
def test_a_changed_scene_forgets_its_truth(change):
    scene = stack(2, corners=1)
    changed = change(scene)
    assert scene.truth is not None and changed.truth is None
    assert changed.error(solve(changed.system()).force) < 1e-10


@pytest.mark.parametrize("e", [0.0, 0.6, 1.0])
def test_impulses_of_rods_and_pegs(e):
    scene = falling_rods([0.0, 0.4, 1.2], place=[1.0, -0.5, 0.3], mass=2.0, speed=3.0)
    after = resolve_collisions(*bodies_and_contacts(scene), e)
    impulse = (after.momentum - scene.bodies.momentum)[:-1, 2]
    assert scene.error(impulse, e) < 1e-13
    assert scene.error(impulse + 0.5, e) == pytest.approx(0.5)
    pegs = rod_on_two_pegs(0.8)
    after = resolve_collisions(*bodies_and_contacts(pegs), e, law="simultaneous")
    assert after.momentum[0, 2] == pytest.approx(pegs.truth(e).sum() - 1)
    assert np.abs(after.angular_momentum).max() < 1e-14


def test_a_rod_on_a_spring_knows_nothing_of_the_closed_form():
    by_spring = [rod_on_spring(angle, 1e7) for angle in (0.0, 1.0)]
    assert falling_rods([0.0, 1.0]).error(by_spring, 1.0) < 1e-3


@pytest.mark.parametrize("kind", FEATURES)
def test_the_error_of_a_moving_pair_is_that_of_its_gap(kind):
    scene = moving_contact(kind, gap=0.2)
    assert scene.error(scene.at(0.3), 0.3) == 0
    up = replace(scene.bodies, position=scene.bodies.position + [[0, 0, 1e-3], [0] * 3])
    assert 0 < scene.error(up, 0.0) <= 1e-3 + 1e-12
    assert scene.gap(0.0) == pytest.approx(scene.contacts.separation[0], abs=1e-15)
    pushed = reference_motion(
        scene.bodies, lambda *_: (scene.force, scene.torque), [0.3]
    )
    assert scene.error(pushed[0], 0.3) < 1e-12


def test_a_spinning_body_is_held_against_its_exact_motion():
    for scene in (spinning_handle(tilt=0.5), spinning_body([1.0, 2.0, 2.5], tilt=0.5)):
        stepped = scene.bodies
        for _ in range(100):
            stepped = explicit_euler(stepped, None, 1e-3)
        assert scene.error(scene.at(0.1), 0.1) < 1e-12
        assert 1e-5 < scene.error(stepped, 0.1) < 1e-2


def test_weight_and_what_is_applied_add_up():
    bodies = Bodies.balls([2.0, np.inf], 1.0, np.zeros((2, 3)))
    scene = Scene(bodies, gravity=(0, 0, -3.0), applied_force=[[1.0, 0, 0], [0, 5, 0]])
    np.testing.assert_array_equal(scene.force, [[1, 0, -6], [0, 5, 0]])
    np.testing.assert_array_equal(scene.torque, np.zeros((2, 3)))
    assert table().force[0, 2] == -GRAVITY and not bar_over_plank().force.any()
    assert len(scene.contacts) == 0
    for field in (scene.gravity, scene.applied_force, scene.torque):
        with pytest.raises(ValueError, match="read-only"):
            field[...] = 1.0


@pytest.mark.parametrize(
    ("call", "message"),
    [
        (lambda b: Scene(b, applied_force=np.zeros((3, 3))), "applied_force: expected"),
        (lambda b: Scene(b, torque=[np.nan, 0, 0]), "torque: expected finite"),
        (lambda b: Scene(b, gravity=np.zeros((2, 3))), "gravity: expected shape"),
        (lambda b: Scene(b).at(1.0), "scene: expected one whose motion is known"),
        (lambda b: table().at(1.0), "scene: expected one whose motion is known"),
        (lambda b: Scene(b).touching(b), "scene: expected one with colliders"),
        (lambda b: spinning_handle().gap(0.0), "scene: expected one with colliders"),
    ],
)
def test_what_a_scene_refuses(call, message):
    with pytest.raises(ValueError, match=message):
        call(Bodies.balls([1.0, 1.0], 1.0, [[0, 0, 0], [3.0, 0, 0]]))


def test_colliders_find_the_contacts_that_a_scene_starts_with():
    for scene in (
        touching_row([1.0, 0, 0]),
        pile(20, np.random.default_rng(14)),
        bar_over_plank(),
    ):
        found = scene.touching(scene.bodies)
        np.testing.assert_array_equal(found.point, scene.contacts.point)
    apart = replace(scene.bodies, position=scene.bodies.position + [[0, 0, 1], [0] * 3])
    assert scene.touching(apart).separation[0] == pytest.approx(1.25)
