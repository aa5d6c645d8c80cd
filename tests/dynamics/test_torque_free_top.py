"""Exact motions: elliptic functions against mpmath, the top against conservation, other formulas and DOP853."""

import mpmath
import numpy as np
import pytest
from scipy.integrate import solve_ivp
from scipy.spatial.transform import Rotation
from scipy.special import ellipj

from course.dynamics import (
    Bodies,
    dop853,
    middle_axis_growth_rate,
    parabola,
    pendulum,
    symmetric_top,
    torque_free_motion,
    torque_free_rotation,
)
from course.dynamics.elliptic import first_integral, jacobi_functions, quarter_period

pytestmark = pytest.mark.slow  # orders and thresholds are measured by many steps

SEEDS = [0, 1, 2]


def quaternion_difference(one, other):
    return np.minimum(
        np.abs(one - other).max(axis=-1), np.abs(one + other).max(axis=-1)
    ).max()


def single(moments, momentum):
    return Bodies(
        [1.0],
        [np.diag(moments)],
        np.zeros((1, 3)),
        [[0, 0, 0, 1.0]],
        np.zeros((1, 3)),
        [momentum],
    )


def drawn(seed, n=12):
    """Moments of random boxes, in any order, and angular momenta; the second half near the separatrix."""
    rng = np.random.default_rng(seed)
    e = rng.uniform(0.2, 1, (n, 3)) ** 2
    moments = np.sum(e, axis=1, keepdims=True) - e
    momentum = rng.normal(size=(n, 3))
    for i in range(n // 2, n):
        j, two, k = np.argsort(moments[i])
        a, b, c = moments[i, [j, two, k]]
        momentum[i, k] = (
            momentum[i, j]
            * np.sqrt((b - a) * c / ((c - b) * a))
            * (1 + 10 ** rng.uniform(-12, -2))
        )
    return moments, momentum


@pytest.mark.parametrize("seed", SEEDS)
def test_elliptic_functions_against_mpmath(seed):
    rng = np.random.default_rng(seed)
    complement = np.concatenate([10 ** rng.uniform(-40, 0, 60), [1.0, 0.5, 1e-300]])
    u = rng.uniform(-3, 3, complement.size) * quarter_period(complement)
    ours = jacobi_functions(u, complement)
    with mpmath.workdps(340):
        for name, values in zip(("sn", "cn", "dn"), ours, strict=True):
            for x, m1, value in zip(u, complement, values, strict=True):
                exact = mpmath.ellipfun(name, u=mpmath.mpf(x), m=1 - mpmath.mpf(m1))
                # u is rounded to 1e-16 of itself, and no derivative of these functions exceeds 1.
                assert abs(float(exact) - value) < 1e-14 + 4e-16 * abs(x)


def test_elliptic_functions_away_from_1_are_scipys():
    u, m = np.linspace(-20, 20, 41), np.linspace(0, 0.99, 12)[:, None]
    for ours, theirs in zip(jacobi_functions(u, 1 - m), ellipj(u, m), strict=False):
        assert np.allclose(ours, theirs, atol=1e-13)


def test_elliptic_functions_on_the_separatrix():
    u = np.array([-800.0, -2.0, 0.0, 0.3, 30.0])
    sn, cn, dn = jacobi_functions(u, 0.0)
    assert np.allclose(sn, np.tanh(u)) and np.allclose(
        cn, 1 / np.cosh(np.clip(u, -700, 700))
    )
    assert np.array_equal(cn, dn)


def test_the_first_integral_inverts_sn():
    for m1 in (1.0, 0.3, 1e-8, 1e-20, 0.0):
        top = min(float(quarter_period(m1)), 15.0)
        u = np.linspace(-0.999, 0.999, 21) * top
        sn, cn, dn = jacobi_functions(u, m1)
        assert np.allclose(first_integral(sn, cn, m1), u, rtol=1e-12, atol=1e-14)


@pytest.mark.parametrize("seed", SEEDS)
@pytest.mark.parametrize("time", [0.0, 0.4, -3.0, 7.0, 500.0])
def test_what_the_top_keeps(seed, time):
    """|l|, T, and L in space, which is Q l(t) = l(0)."""
    moments, start = drawn(seed)
    later, turn = torque_free_rotation(moments, start, time)
    # Rounding of u = lambda t shifts l along its curve, not off it.
    assert np.allclose(np.sum(later**2, axis=1), np.sum(start**2, axis=1), rtol=1e-12)
    assert np.allclose(
        np.sum(later**2 / moments, axis=1),
        np.sum(start**2 / moments, axis=1),
        rtol=1e-12,
    )
    assert np.allclose(Rotation.from_quat(turn).apply(later), start, atol=1e-12)


@pytest.mark.parametrize("seed", SEEDS)
def test_the_top_moves_by_the_euler_equations(seed):
    """Central differences of order 4 of l and Q against l x omega and omega."""
    moments, start = drawn(seed)
    h, at = 1e-3, 1.7
    stencil = [(-2, 1 / 12), (-1, -2 / 3), (1, 2 / 3), (2, -1 / 12)]
    here, turn = torque_free_rotation(moments, start, at)
    rate, spin = np.zeros(here.shape), np.zeros(here.shape)
    for offset, weight in stencil:
        later, turned = torque_free_rotation(moments, start, at + offset * h)
        rate += weight / h * later
        spin += (
            weight
            / h
            * (Rotation.from_quat(turn).inv() * Rotation.from_quat(turned)).as_rotvec()
        )
    scale = (
        np.abs(here / moments).max() ** 5
    )  # of the fifth derivative in the error h^4/30 times it
    assert np.allclose(rate, np.cross(here, here / moments), atol=h**4 * scale + 1e-11)
    assert np.allclose(spin, here / moments, atol=h**4 * scale + 1e-11)


@pytest.mark.parametrize("seed", SEEDS)
def test_one_way_is_two_ways(seed):
    moments, start = drawn(seed)
    half, first = torque_free_rotation(moments, start, 2.0)
    end, second = torque_free_rotation(moments, half, 3.0)
    whole, turn = torque_free_rotation(moments, start, 5.0)
    # Near the separatrix the rounding of l after the first part grows by exp(lambda t).
    growth = np.exp(
        5.0
        * middle_axis_growth_rate(
            moments, np.linalg.norm(start, axis=1) / np.median(moments, axis=1)
        )
    )
    error = np.abs(end - whole).max(axis=1) / np.abs(start).max(axis=1)
    assert np.all(error < 1e-14 * (10 + growth))
    relative = (
        Rotation.from_quat(first) * Rotation.from_quat(second)
    ) * Rotation.from_quat(turn).inv()
    assert np.all(relative.magnitude() < 1e-13 * (10 + growth))


SPECIAL = {
    "about the least axis": ([1, 2, 3], [1, 0, 0]),
    "about the middle axis": ([1, 2, 3], [0, 1, 0]),
    "about the largest axis": ([1, 2, 3], [0, 0, -1]),
    "below the separatrix": ([1, 2, 3], [1, 0.3, 0.2]),
    "above the separatrix": ([1, 2, 3], [-0.2, 0.3, -1]),
    # (6 - 4)/6 = (4 - 3)/3: on the separatrix where l1^2 = l3^2, exactly so in floating point.
    "on the separatrix, one way": ([3, 4, 6], [1, 0.3, 1]),
    "on the separatrix, other way": ([3, 4, 6], [-1, -2.3, 1]),
    "just above": ([3, 4, 6], [1, 0.3, 1 + 1e-12]),
    "just below": ([3, 4, 6], [1, 0.3, 1 - 1e-12]),
    "a hair from the middle axis": ([1, 2, 3], [1e-9, 1, -1e-9]),
    "moments out of order": ([3, 1, 2], [0.3, 1, 0.2]),
    "moments out of order, odd": ([2, 1, 3], [0.3, 1, 0.2]),
    "oblate": ([2, 2, 3], [0.3, 1, 0.2]),
    "prolate": ([1, 2, 2], [0.3, 1, 0.2]),
    "prolate, still": ([1, 2, 2], [0, 1, 0.2]),
    "nearly oblate": ([2, 2 + 1e-12, 3], [0.3, 1, 1e-7]),
    "nearly prolate": ([1, 2, 2 + 1e-12], [1e-7, 1, 0.2]),
    "nearly a sphere": ([2, 2, 2 + 1e-12], [0.3, 1, 0.2]),
    "sphere": ([2, 2, 2], [0.3, 1, 0.2]),
    "at rest": ([1, 2, 3], [0, 0, 0]),
    "small": ([1e-6, 2e-6, 2.5e-6], [1e-6, -2e-6, 2e-6]),
}


@pytest.mark.parametrize("name", SPECIAL)
@pytest.mark.parametrize("time", [6.0, -6.0])
def test_special_tops_against_dop853(name, time):
    bodies = single(*SPECIAL[name])
    exact, reference = torque_free_motion(bodies, time), dop853(bodies, None, time)
    assert quaternion_difference(exact.orientation, reference.orientation) < 2e-12
    assert np.array_equal(exact.angular_momentum, bodies.angular_momentum)


@pytest.mark.parametrize("seed", SEEDS)
def test_bodies_in_any_axes_against_dop853(seed):
    rng = np.random.default_rng(seed)
    moments, momentum = drawn(seed, 6)
    turn = Rotation.random(6, random_state=rng).as_matrix()
    inertia = (turn * moments[:, None, :]) @ np.swapaxes(turn, 1, 2)
    q = Rotation.random(6, random_state=rng).as_quat()
    mass = np.array([np.inf, 1, 2, 3, 4, 5])
    p = rng.normal(size=(6, 3))
    p[0] = momentum[0] = 0
    bodies = Bodies(
        mass, 0.5 * (inertia + np.swapaxes(inertia, 1, 2)), p, q, p, momentum
    )
    exact, reference = torque_free_motion(bodies, 2.0), dop853(bodies, None, 2.0)
    assert quaternion_difference(exact.orientation, reference.orientation) < 1e-10
    assert np.allclose(exact.position, reference.position, atol=1e-12)
    assert np.array_equal(exact.orientation[0], bodies.orientation[0])
    assert np.array_equal(exact.position[0], bodies.position[0])


def test_on_the_separatrix_the_top_ends_at_its_middle_axis():
    later, _ = torque_free_rotation([3, 4, 6], [1.0, 0.3, 1.0], [50.0, 5000.0, -5000.0])
    size = np.sqrt(2.09)
    assert np.allclose(np.abs(later[1:]), [0, size, 0], atol=1e-15)
    assert (
        later[1, 1] * later[2, 1] < 0
    )  # it comes from the one end and goes to the other


@pytest.mark.parametrize("seed", SEEDS)
def test_the_symmetric_top(seed):
    rng = np.random.default_rng(seed)
    across, along = rng.uniform(1, 3, (2, 20))
    moments, momentum = (
        np.stack([across, across, along], axis=1),
        rng.normal(size=(20, 3)),
    )
    for time in (0.7, 30.0):
        l_1, q_1 = symmetric_top(moments, momentum, time)
        l_2, q_2 = torque_free_rotation(moments, momentum, time)
        assert np.allclose(l_1, l_2, atol=1e-13 * time + 1e-14)
        assert quaternion_difference(q_1, q_2) < 1e-13 * time + 1e-14


def test_the_period_of_a_real_top():
    """Landau and Lifshitz, section 37: l repeats after 4 K/lambda, with SciPy's K."""
    from scipy.special import ellipk

    i1, i2, i3 = 1.0, 2.0, 3.5
    l1, l2, l3 = 0.4, 0.9, 1.1
    twice_t, square = l1**2 / i1 + l2**2 / i2 + l3**2 / i3, l1**2 + l2**2 + l3**2
    assert square > twice_t * i2
    m = (i2 - i1) * (twice_t * i3 - square) / ((i3 - i2) * (square - twice_t * i1))
    period = (
        4 * ellipk(m) * np.sqrt(i1 * i2 * i3 / ((i3 - i2) * (square - twice_t * i1)))
    )
    later, turn = torque_free_rotation([i1, i2, i3], [l1, l2, l3], [period, period / 2])
    assert np.allclose(later[0], [l1, l2, l3], atol=1e-13)
    assert np.allclose(later[1], [-l1, -l2, l3], atol=1e-13)


def test_the_growth_rate_of_the_middle_axis():
    # (1, 2, 3): Omega/sqrt 3 = .577350 Omega.
    assert middle_axis_growth_rate([3, 1, 2], 2.0) == pytest.approx(
        2 / np.sqrt(3), rel=1e-14
    )
    times = np.linspace(6, 14, 5)  # the part that dies away is below 1e-3 by then
    later, _ = torque_free_rotation([1, 2, 3], np.array([1e-9, 2.0, 1e-9]), times)
    wobble = np.hypot(later[:, 0], later[:, 2])
    assert np.polyfit(times, np.log(wobble), 1)[0] == pytest.approx(
        1 / np.sqrt(3), rel=1e-2
    )


@pytest.mark.parametrize("amplitude", [0.0, 0.1, 1.0, 3.0, 3.1415])
def test_the_pendulum(amplitude):
    w, times = 1.7, np.linspace(0, 9, 5)
    solution = solve_ivp(
        lambda t, y: [y[1], -(w**2) * np.sin(y[0])],
        (0, 9), [amplitude, 0], method="DOP853", t_eval=times, rtol=1e-13, atol=1e-14,
    )  # fmt: skip
    angle, rate = pendulum(amplitude, w, times)
    # The last swings from near the top, where errors grow by exp(w t).
    tolerance = 1e-12 if amplitude <= 1 else 1e-9
    assert np.allclose(angle, solution.y[0], atol=tolerance) and np.allclose(
        rate, solution.y[1], atol=tolerance
    )
    energy = rate**2 / 2 - w**2 * np.cos(angle)
    assert np.allclose(energy, -(w**2) * np.cos(amplitude), atol=1e-14 * 10)


def test_the_parabola():
    x, v = parabola([0, 0, 1.0], [1.0, 0, 2.0], [0, 0, -10.0], [0.0, 0.5])
    assert np.allclose(x, [[0, 0, 1], [0.5, 0, 0.75]]) and np.allclose(
        v, [[1, 0, 2], [1, 0, -3]]
    )


def test_batches_are_loops_and_inputs_are_not_written():
    moments, momentum = drawn(5, 4)
    times = np.array([0.5, 3.0, 40.0])[:, None]
    copies = moments.copy(), momentum.copy()
    later, turn = torque_free_rotation(moments, momentum, times)
    assert later.shape == (3, 4, 3) and turn.shape == (3, 4, 4)
    for i in range(3):
        for j in range(4):
            one, quaternion = torque_free_rotation(moments[j], momentum[j], times[i, 0])
            # The panels of the quadrature depend on the batch.
            assert np.allclose(later[i, j], one, atol=1e-14)
            assert quaternion_difference(turn[i, j], quaternion) < 1e-12
    assert np.array_equal(moments, copies[0]) and np.array_equal(momentum, copies[1])


def test_bad_input_is_refused_by_name():
    with pytest.raises(
        ValueError, match=r"moments: expected positive numbers; got 0.0 in entry 1"
    ):
        torque_free_rotation([1, 0, 2], [1, 1, 1], 1.0)
    with pytest.raises(ValueError, match="angular_momentum: expected finite"):
        torque_free_rotation([1, 1, 2], [1, np.nan, 1], 1.0)
    with pytest.raises(
        ValueError, match="time: expected a batch that broadcasts with moments"
    ):
        torque_free_rotation(np.ones((2, 3)), np.ones((2, 3)), np.zeros(3))
    with pytest.raises(
        ValueError, match=r"time: expected one real number; got shape \(1,\)"
    ):
        torque_free_motion(single([1, 2, 3], [1, 1, 1]), [1.0])
    with pytest.raises(ValueError, match="bodies: expected Bodies; got int"):
        torque_free_motion(3, 1.0)
    with pytest.raises(ValueError, match="moments: expected the first two alike"):
        symmetric_top([1, 2, 2], [1, 1, 1], 1.0)
    with pytest.raises(
        ValueError, match="amplitude: expected numbers from 0 to 3.14159"
    ):
        pendulum(3.2, 1.0, 1.0)
    with pytest.raises(ValueError, match="frequency: expected positive"):
        pendulum(1.0, 0.0, 1.0)
