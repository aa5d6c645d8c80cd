"""Projected Gauss-Seidel: the accumulated force is limited, and it converges as predicted."""

import numpy as np
import pytest

from course import formulas
from course.contact.solvers.projected_gauss_seidel import (
    gauss_seidel_path,
    measured_gauss_seidel_factor,
    optimal_relaxation,
    predicted_gauss_seidel_factor,
    solve_projected_gauss_seidel,
)
from course.scenes import shaken, stack, table, wall

PAIR = np.array([[1, 0.5], [0.5, 1]])


def test_the_accumulated_force_is_limited():
    """TRUTHS: clipping the changes answers (1, .5) here; right is (2/3, 2/3)."""
    found = solve_projected_gauss_seidel(PAIR, [-1.0, -1.0])
    np.testing.assert_allclose(found.force, 2 / 3, atol=1e-9)
    assert found.residual <= 1e-10


def test_the_sweeps_are_those_of_the_formula():
    rng = np.random.default_rng(1)
    system = shaken(wall(5, 4), rng).system()
    start = rng.uniform(0, 5, len(system))
    expected = formulas.projected_gauss_seidel(
        system.A.toarray(), system.b, start, sweeps=7
    )
    for a in (system.A, system.A.toarray()):
        found = solve_projected_gauss_seidel(a, system.b, max_sweeps=7, start=start)
        assert found.sweeps == 7
        np.testing.assert_allclose(found.force, expected, rtol=1e-12, atol=1e-13)


@pytest.mark.parametrize("relaxation", [0.7, 1.6])
def test_relaxation_stretches_each_step(relaxation):
    """By hand: f_1 = r, then w_2 = r/2 - 1 and f_2 = r (1 - r/2)."""
    found = solve_projected_gauss_seidel(
        PAIR, [-1.0, -1.0], max_sweeps=1, relaxation=relaxation
    )
    expected = [relaxation, relaxation * (1 - relaxation / 2)]
    np.testing.assert_allclose(found.force, expected, rtol=1e-15)


def test_the_path_shows_every_step():
    """Two contacts, two sweeps: (0, 0), (1, 0), (1, 1/2), (3/4, 1/2), (3/4, 5/8)."""
    path = gauss_seidel_path(PAIR, [-1.0, -1.0], 2)
    expected = [[0, 0], [1, 0], [1, 1 / 2], [3 / 4, 1 / 2], [3 / 4, 5 / 8]]
    assert np.array_equal(path, expected)


def test_a_contact_that_no_force_moves_is_left_out():
    found = solve_projected_gauss_seidel(np.diag([0.0, 2.0]), [1.0, -1.0])
    assert found.force.tolist() == [0.0, 0.5] and found.residual == 0


@pytest.mark.parametrize("count", [2, 5, 10, 30])
def test_stack_converges_by_cos_squared(count):
    """TRUTHS: cos^2(pi/2n); relaxation 2/(1 + s), s = sin(pi/2n), gives (1 - s)/(1 + s): .7295 for .9755 at n = 10."""
    system = stack(count, corners=1).system()
    s = np.sin(np.pi / (2 * count))
    predicted = predicted_gauss_seidel_factor(system.A)
    assert predicted == pytest.approx(np.cos(np.pi / (2 * count)) ** 2, abs=1e-12)
    measured = measured_gauss_seidel_factor(system.A, system.b, sweeps=5000)
    assert measured == pytest.approx(predicted, abs=1e-4)
    best = optimal_relaxation(predicted)
    assert best == pytest.approx(2 / (1 + s), rel=1e-12)
    relaxed = predicted_gauss_seidel_factor(system.A, relaxation=best)
    assert relaxed == pytest.approx((1 - s) / (1 + s), abs=1e-6)
    # There the matrix is defective: k sweeps bring k times the power, so the measured factor comes down to it slowly.
    assert (
        relaxed
        < measured_gauss_seidel_factor(system.A, system.b, sweeps=3000, relaxation=best)
        < relaxed + 0.02
    )
    if count == 10:
        assert (predicted, relaxed) == pytest.approx((0.9755, 0.7295), abs=5e-5)


@pytest.mark.parametrize("ratio", [1.0, 10.0, 200.0])
def test_heavy_on_light_converges_by_the_mass_ratio(ratio):
    """TRUTHS: R/(1 + R) for a box on one that is R times lighter."""
    system = stack(2, corners=1, mass=[1.0, ratio]).system()
    predicted = predicted_gauss_seidel_factor(system.A)
    assert predicted == pytest.approx(ratio / (1 + ratio), abs=1e-12)
    assert measured_gauss_seidel_factor(
        system.A, system.b, sweeps=5000
    ) == pytest.approx(predicted, abs=1e-4)


def test_four_corners_are_predicted_from_the_matrix():
    system = stack(4).system()
    assert np.linalg.matrix_rank(system.A.toarray()) < len(system)
    predicted = predicted_gauss_seidel_factor(system.A)
    measured = measured_gauss_seidel_factor(system.A, system.b, sweeps=2000)
    assert 0.5 < predicted < 1 and measured == pytest.approx(predicted, abs=2e-3)


def test_relaxation_and_a_start_save_sweeps():
    system = stack(10, corners=1).system()
    slow = solve_projected_gauss_seidel(system.A, system.b)
    fast = solve_projected_gauss_seidel(
        system.A, system.b, relaxation=optimal_relaxation(np.cos(np.pi / 20) ** 2)
    )
    warm = solve_projected_gauss_seidel(system.A, system.b, start=slow.force * 1.0001)
    assert slow.residual <= 1e-10 and fast.sweeps < slow.sweeps / 5
    assert warm.sweeps < 0.7 * slow.sweeps
    again = solve_projected_gauss_seidel(system.A, system.b, start=slow.force)
    assert again.sweeps == 0 and np.array_equal(again.force, slow.force)


def test_limits_and_refusals():
    system = table().system()
    stopped = solve_projected_gauss_seidel(system.A, system.b, max_sweeps=3)
    assert stopped.sweeps == 3 and stopped.residual > 1e-10
    negative = solve_projected_gauss_seidel(system.A, system.b, start=np.full(4, -1.0))
    assert negative.residual <= 1e-10 and np.all(negative.force >= 0)
    for arguments, match in (
        ({"relaxation": 0.0}, "relaxation"), ({"relaxation": 2.0}, "relaxation"),
        ({"start": np.zeros(3)}, "start"), ({"max_sweeps": -1}, "max_sweeps"),
    ):  # fmt: skip
        with pytest.raises(ValueError, match=match):
            solve_projected_gauss_seidel(system.A, system.b, **arguments)
    with pytest.raises(ValueError, match="convergence_factor"):
        optimal_relaxation(1.0)
