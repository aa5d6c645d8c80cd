"""Rods on a floor, on pegs and on springs; boxes on four corners; what the order of contacts does."""

from itertools import permutations

import numpy as np
import pytest
from scenes.parts import bodies_and_contacts

from course.dynamics import effective_mass, normal_velocity, total_energy
from course.scenes import box_on_corners, rod_on_two_pegs
from course.study import box_landings, normal_response, outcomes_by_order, rod_on_spring


def test_a_rod_on_a_stiffer_spring_comes_nearer_to_the_closed_form():
    angle = np.radians([0.0, 30.0, 60.0, 75.0, 90.0])
    closed = 2.0 / (1 + 3 * np.cos(angle) ** 2)
    off = [
        np.abs([rod_on_spring(t, k) for t in angle] - closed).max()
        for k in (1e3, 1e5, 1e7)
    ]
    # The rod turns during the contact, which lasts as long as 1/sqrt(k): a tenth of the error for a hundred times k.
    assert off[0] < 0.07 and np.allclose(off[:-1] / np.array(off[1:]), 10, rtol=0.15)
    assert rod_on_spring(np.pi / 2, 40.0, mass=2.0, speed=3.0) == pytest.approx(
        2 * 2 * 3, rel=1e-9
    )


def test_a_spring_too_soft_is_refused():
    with pytest.raises(ValueError, match="stiffness: expected positive"):
        rod_on_spring(0.0, -1.0)


def test_box_matrix_by_hand():
    # a_ij = 1/m + x_i x_j/I_y + y_i y_j/I_x for corners at (x, y) and m = 1.
    bodies, contacts = bodies_and_contacts(box_on_corners(half_extents=(0.5, 0.3, 0.2)))
    x, y = contacts.point[:, 0], contacts.point[:, 1]
    i_x, i_y = (0.3**2 + 0.2**2) / 3, (0.5**2 + 0.2**2) / 3
    expected = 1 + np.outer(x, x) / i_y + np.outer(y, y) / i_x
    matrix = normal_response(bodies, contacts)
    assert np.allclose(matrix, expected, rtol=1e-13)
    assert np.linalg.matrix_rank(matrix) == 3
    assert np.allclose(1 / np.diagonal(matrix), effective_mass(bodies, contacts))


def test_landings_are_those_of_a_box_with_spins():
    landings = box_landings(30, seed=4)
    bodies, contacts = bodies_and_contacts(box_on_corners())
    assert np.array_equal(landings.matrix, normal_response(bodies, contacts))
    assert landings.normal_velocity.shape == (30, 4) and np.all(
        landings.normal_velocity < -0.05
    )
    for u in landings.normal_velocity[:5]:
        spin = (
            (u[1] - u[0]) / 0.6,
            -(u[2] - u[0]) / 1.0,
            0.0,
        )  # corners 0.6 m and 1 m apart
        assert np.allclose(
            normal_velocity(*bodies_and_contacts(box_on_corners(spin=spin))),
            u,
            atol=1e-14,
        )
    assert not np.array_equal(
        landings.normal_velocity, box_landings(30, seed=5).normal_velocity
    )


def test_orders_of_a_flat_box_keep_energy_and_disagree():
    bodies, contacts = bodies_and_contacts(box_on_corners())
    orders = list(permutations(range(4)))
    outcomes = outcomes_by_order(bodies, contacts, 1.0, orders)
    assert outcomes.order.shape == (24, 4)
    energy = 0.5 * np.sum(outcomes.velocity**2, axis=1)
    energy += 0.5 * np.einsum(
        "ki,ij,kj->k", outcomes.spin, bodies.inertia[0], outcomes.spin
    )
    assert np.allclose(energy, total_energy(bodies), rtol=1e-13)
    # The box is symmetric, so mirrored orders give mirrored spins: the cloud is its own mirror image.
    cloud = {tuple(np.round(s, 9) + 0.0) for s in outcomes.spin}
    assert len(cloud) == 20 and {(-a + 0.0, b, c) for a, b, c in cloud} == cloud
    at_once = outcomes_by_order(bodies, contacts, 1.0, orders[:6], law="simultaneous")
    assert np.abs(at_once.spin).max() < 1e-13


@pytest.mark.parametrize("orders", [[(0, 1, 2)], [(0, 1, 2, 2)], [(0, 1, 2, 4)]])
def test_what_is_no_order_is_refused(orders):
    with pytest.raises(
        ValueError, match="orders: expected orders of the contacts 0 to 3"
    ):
        outcomes_by_order(*bodies_and_contacts(box_on_corners()), 1.0, orders)


def test_pegs_do_not_feel_each_other_at_the_radius_of_gyration():
    def spins(place):
        return outcomes_by_order(
            *bodies_and_contacts(rod_on_two_pegs(place)), 1.0, [(0, 1), (1, 0)]
        ).spin[:, 1]

    threshold = 1 / np.sqrt(3)
    assert (
        abs(normal_response(*bodies_and_contacts(rod_on_two_pegs(threshold)))[0, 1])
        < 1e-14
    )
    assert np.abs(spins(threshold)).max() < 1e-13
    for place in (0.3, 0.5, 0.65, 0.9):
        left, right = spins(place)
        assert left == pytest.approx(-right, rel=1e-12) and np.sign(left) == np.sign(
            threshold - place
        )


def test_orders_with_the_same_outcome_are_counted_once():
    bodies, contacts = bodies_and_contacts(rod_on_two_pegs(0.9))
    found = outcomes_by_order(bodies, contacts, 1.0, [(0, 1), (1, 0), (0, 1)])
    assert found.different.shape == (2, 3) and sorted(found.times) == [1, 2]
    twice = found.different[np.argmax(found.times)]
    np.testing.assert_allclose(twice, found.spin[0], atol=1e-6)
