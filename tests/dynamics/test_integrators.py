"""Steps in time: orders, what each keeps, fixed bodies, batches, errors."""

import re
from dataclasses import replace
from functools import partial

import numpy as np
import pytest
from scipy.spatial.transform import Rotation

from course import rotations
from course.dynamics import (
    Bodies,
    advance,
    dop853,
    explicit_euler,
    kinetic_energy,
    midpoint,
    pendulum,
    reference_motion,
    rk4,
    splitting,
    symplectic_euler,
    torque_free_motion,
    total_angular_momentum,
    total_momentum,
    uniform_gravity,
)
from course.dynamics.integrators import splitting_method
from course.dynamics.integrators.splitting_method import _CHAINS

pytestmark = pytest.mark.slow  # with its like, left out of --quick

SEEDS = [0, *(pytest.param(seed, marks=pytest.mark.slow) for seed in (1, 2))]
STEPS = [explicit_euler, symplectic_euler, midpoint, rk4, splitting]
ORDERS = {explicit_euler: 1, symplectic_euler: 1, midpoint: 2, rk4: 4, splitting: 2}
STATE = ("position", "orientation", "momentum", "angular_momentum")


def tumbling(n=4, seed=0, fixed=False):
    """Random boxes, axes and all; the first one fixed where that is asked."""
    rng = np.random.default_rng(seed)
    e = rng.uniform(0.3, 1, (n, 3))
    axes = Rotation.random(n, random_state=rng).as_matrix()
    inertia = (axes * (e.sum(axis=1, keepdims=True) - e)[:, None, :]) @ np.swapaxes(
        axes, 1, 2
    )
    inertia = 0.5 * (inertia + np.swapaxes(inertia, 1, 2))
    mass, (x, p, angular) = rng.uniform(0.5, 2, n), rng.normal(size=(3, n, 3))
    if fixed:
        mass[0], p[0], angular[0], inertia[0] = np.inf, 0, 0, np.nan
    return Bodies(
        mass, inertia, x, Rotation.random(n, random_state=rng).as_quat(), p, angular
    )


def compass(bodies, time):
    """Springs to the origin that swing with time, and a torque as of a needle in a field along -z."""
    needle = rotations.rotate(bodies.orientation, [0.0, 0.0, 1.0])
    return np.sin(time) - 2 * bodies.position, np.cross(needle, [0.0, 0.0, -1.5])


def damped_compass(bodies, time):
    force, torque = compass(bodies, time)
    return force - 0.3 * bodies.velocity, torque - 0.3 * bodies.angular_velocity


def run(method, bodies, wrench, duration, count, time=0.0):
    for k in range(count):
        bodies = method(
            bodies, wrench, duration / count, time=time + k * duration / count
        )
    return bodies


def difference(one, other):
    turned = rotations.from_matrix(one.rotation @ np.swapaxes(other.rotation, 1, 2))
    parts = [2 * np.abs(turned[:, :3])]
    parts += [getattr(one, f) - getattr(other, f) for f in STATE if f != "orientation"]
    return max(np.abs(part).max() for part in parts)


def same(one, other):
    return all(np.array_equal(getattr(one, f), getattr(other, f)) for f in STATE)


# Orders


@pytest.mark.parametrize("seed", SEEDS)
@pytest.mark.parametrize("method", STEPS)
@pytest.mark.parametrize(
    "wrench", [None, compass, pytest.param(damped_compass, marks=pytest.mark.slow)]
)
def test_orders(method, wrench, seed):
    """1, 1, 2, 4, 2 on bodies that turn, free and driven, from halving the step."""
    bodies = tumbling(seed=seed)
    exact = (
        torque_free_motion(bodies, 1.0)
        if wrench is None
        else dop853(bodies, wrench, 1.0, time=0.3)
    )
    counts = (20, 40) if method is rk4 else (60, 120)
    errors = [
        difference(run(method, bodies, wrench, 1.0, n, 0.3), exact) for n in counts
    ]
    assert np.log2(errors[0] / errors[1]) == pytest.approx(ORDERS[method], abs=0.15)


@pytest.mark.slow
@pytest.mark.parametrize("seed", SEEDS)
@pytest.mark.parametrize("wrench", [None, compass])
@pytest.mark.parametrize("order", [4, 6, 8])
def test_orders_of_compositions(order, wrench, seed):
    """At least as promised, between rounding and 1e-4.

    Order 8 meets rounding before its error falls as slowly as h^8: slopes up
    to 12 are seen. A chain that is its own mirror image has even order, so
    that one which falls short has a slope less by 2 at least.
    """
    bodies, duration = tumbling(8, seed=seed), 2.0
    if wrench is None:
        # Faster and longer, or four steps are exact to rounding at order 8.
        bodies, duration = (
            replace(bodies, angular_momentum=4 * bodies.angular_momentum),
            4.0,
        )
    exact = (
        torque_free_motion(bodies, duration)
        if wrench is None
        else dop853(bodies, wrench, duration)
    )
    method, counts, errors = partial(splitting, order=order), [], []
    for count in (int(4 * 1.25**k) for k in range(30)):
        error = difference(run(method, bodies, wrench, duration, count), exact)
        if error < 5e-12 or len(errors) == 6:
            break
        if error < 1e-4:
            counts.append(count)
            errors.append(error)
    assert len(errors) >= 3
    slope = -np.polyfit(np.log(counts), np.log(errors), 1)[0]
    assert slope > order - 1


def test_a_single_kick_is_of_order_1_where_velocities_matter_and_of_2_elsewhere():
    bodies, once = tumbling(), partial(splitting, velocity_dependent=False)
    for wrench, order in ((damped_compass, 1), (compass, 2)):
        exact = dop853(bodies, wrench, 1.0)
        errors = [
            difference(run(once, bodies, wrench, 1.0, n), exact) for n in (100, 200)
        ]
        assert np.log2(errors[0] / errors[1]) == pytest.approx(order, abs=0.15)
    assert same(splitting(bodies, compass, 0.1), once(bodies, compass, 0.1))


def test_chains_satisfy_their_order_conditions():
    """Of a chain of steps and mirror images: sum g = 1, the alternating sum of g^2 and the sum of g^3 are 0.

    (Hairer, Lubich and Wanner, *Geometric Numerical Integration*, section III.3.1, order 3.) A chain that is
    its own mirror image has even order.
    """
    for order, chain in _CHAINS.items():
        g, sign = np.array(chain), np.array([1, -1] * (len(chain) // 2))
        assert g.sum() == pytest.approx(1, abs=1e-14)
        assert np.array_equal(g, g[::-1])
        if order > 2:
            assert np.sum(sign * g**2) == pytest.approx(0, abs=1e-14)
            assert np.sum(g**3) == pytest.approx(0, abs=1e-14)


@pytest.mark.slow
@pytest.mark.parametrize("method", STEPS)
def test_a_pendulum(method):
    """A needle of moment 2 about y in a field: I theta_ddot = -1.5 sin theta, exact by elliptic functions."""
    start = 2.5
    q = Rotation.from_rotvec(
        [0, start + np.pi, 0]
    ).as_quat()  # the wrench turns the needle toward -z
    bodies = Bodies(
        [1.0],
        [np.diag([1.0, 2.0, 1.5])],
        np.zeros((1, 3)),
        [q],
        np.zeros((1, 3)),
        np.zeros((1, 3)),
    )
    duration, errors = 5.0, []

    def wrench(bodies, time):
        return np.zeros((1, 3)), compass(bodies, time)[1]

    angle, rate = pendulum(start, np.sqrt(1.5 / 2), duration)
    exact = Rotation.from_rotvec([0, angle + np.pi, 0])
    counts = (100, 200) if method is rk4 else (400, 800)
    for count in counts:
        end = run(method, bodies, wrench, duration, count)
        turn = (Rotation.from_quat(end.orientation[0]) * exact.inv()).magnitude()
        errors.append(max(turn, abs(end.angular_velocity[0, 1] - rate)))
    assert errors[1] < {1: 0.1, 2: 1e-3, 4: 1e-5}[ORDERS[method]]
    assert np.log2(errors[0] / errors[1]) == pytest.approx(ORDERS[method], abs=0.2)


# What each keeps


@pytest.mark.parametrize("seed", SEEDS)
@pytest.mark.parametrize(
    "method", [midpoint, rk4, splitting, partial(splitting, order=6)]
)
def test_a_parabola_is_exact(method, seed):
    bodies, gravity = tumbling(seed=seed), np.array([0.3, 0.0, -9.81])
    after = method(bodies, uniform_gravity(gravity), 0.7)
    exact = bodies.position + 0.7 * bodies.velocity + 0.5 * 0.7**2 * gravity
    assert np.allclose(after.position, exact, rtol=1e-14, atol=1e-14)
    assert np.allclose(
        after.velocity, bodies.velocity + 0.7 * gravity, rtol=1e-14, atol=1e-14
    )
    assert np.array_equal(after.angular_momentum, bodies.angular_momentum)


@pytest.mark.parametrize("method", STEPS)
def test_a_ball_turns_exactly(method):
    """omega is constant for a sphere, and then the exponential map has no error."""
    bodies = replace(tumbling(), inertia=np.broadcast_to(0.7 * np.eye(3), (4, 3, 3)))
    exact = Rotation.from_rotvec(1.9 * bodies.angular_velocity) * Rotation.from_quat(
        bodies.orientation
    )
    after = method(bodies, None, 1.9)
    assert np.allclose(after.rotation, exact.as_matrix(), atol=1e-14)


@pytest.mark.parametrize("seed", SEEDS)
def test_splitting_turns_a_symmetric_top_exactly(seed):
    rng = np.random.default_rng(seed)
    across, along = rng.uniform(1, 2, (2, 4))
    moments = np.stack([across, along, across], axis=1)
    bodies = replace(tumbling(seed=seed), inertia=moments[:, :, None] * np.eye(3))
    assert (
        difference(splitting(bodies, None, 3.0), torque_free_motion(bodies, 3.0))
        < 1e-14 * 10
    )


@pytest.mark.parametrize("method", STEPS)
def test_without_torque_the_angular_momentum_is_untouched(method):
    bodies = tumbling()
    after = run(method, bodies, None, 10.0, 100)
    assert np.array_equal(after.angular_momentum, bodies.angular_momentum)
    assert np.array_equal(after.momentum, bodies.momentum)


@pytest.mark.parametrize("seed", SEEDS)
def test_the_free_turns_keep_the_length_of_l_in_body_axes(seed):
    """R'L after 1000 steps as long as before: the turns of splitting and the quaternions lose no length."""
    bodies = tumbling(seed=seed)
    after = run(splitting, bodies, None, 100.0, 1000)
    assert np.allclose(np.linalg.norm(after.orientation, axis=1), 1, atol=1e-15)
    body = np.einsum("nji,nj->ni", after.rotation, after.angular_momentum)
    assert np.allclose(
        np.linalg.norm(body, axis=1),
        np.linalg.norm(bodies.angular_momentum, axis=1),
        rtol=1e-14,
    )


@pytest.mark.slow
def test_energy_over_a_long_time():
    """Splitting's swings within a band; Euler's and RK4's drifts, both to be seen after 120 s."""
    bodies = tumbling()
    start = kinetic_energy(bodies) - 0.5 * np.sum(
        bodies.momentum * bodies.velocity, axis=1
    )
    spread = {}
    for method in (explicit_euler, rk4, splitting):
        state, history = bodies, []
        for _ in range(400):
            state = method(state, None, 0.3)
            history.append(
                kinetic_energy(state)
                - 0.5 * np.sum(state.momentum * state.velocity, axis=1)
            )
        history = np.abs(np.array(history) / start - 1)
        spread[method] = history[:200].max(), history[200:].max()
    assert spread[splitting][0] < 1e-2
    assert spread[splitting][1] < 1.05 * spread[splitting][0]
    assert spread[rk4][1] > 1.5 * spread[rk4][0]
    assert spread[explicit_euler][1] > 10 * spread[splitting][1]


@pytest.mark.parametrize("seed", SEEDS)
@pytest.mark.parametrize("order", [2, 4, 8])
@pytest.mark.parametrize("wrench", [None, compass])
def test_splitting_runs_back_where_it_came_from(wrench, order, seed):
    bodies, h = tumbling(seed=seed), 0.05
    there = run(partial(splitting, order=order), bodies, wrench, 20 * h, 20)
    back = run(partial(splitting, order=order), there, wrench, -20 * h, 20, time=20 * h)
    assert difference(back, bodies) < 1e-12
    assert difference(there, bodies) > 0.1


@pytest.mark.parametrize("method", [explicit_euler, symplectic_euler, midpoint, rk4])
def test_the_others_do_not(method):
    bodies = tumbling()
    back = run(
        method, run(method, bodies, compass, 1.0, 20), compass, -1.0, 20, time=1.0
    )
    assert difference(back, bodies) > 1e-9


@pytest.mark.parametrize("seed", SEEDS)
@pytest.mark.parametrize("method", STEPS)
def test_inner_forces_keep_the_momenta_of_all(method, seed):
    """A spring between two centres: p by every step; L + x x p where a kick meets one position."""

    def spring(bodies, time):
        force = np.zeros((4, 3))
        force[0] = 3 * (bodies.position[1] - bodies.position[0])
        force[1] = -force[0]
        return force, np.zeros((4, 3))

    bodies = tumbling(seed=seed)
    after = run(method, bodies, spring, 2.0, 50)
    assert np.allclose(total_momentum(after), total_momentum(bodies), atol=1e-13)
    if method in (symplectic_euler, splitting):
        assert np.allclose(
            total_angular_momentum(after), total_angular_momentum(bodies), atol=1e-13
        )


# The reference


@pytest.mark.parametrize("seed", SEEDS)
def test_dop853_on_the_free_top(seed):
    bodies = tumbling(seed=seed, fixed=True)
    assert (
        difference_of_free(dop853(bodies, None, 3.0), torque_free_motion(bodies, 3.0))
        < 1e-11
    )
    coarse = dop853(bodies, None, 3.0, relative_tolerance=1e-5)
    assert 1e-9 < difference_of_free(coarse, torque_free_motion(bodies, 3.0)) < 1e-2


def difference_of_free(one, other):
    return max(
        np.abs(one.rotation - other.rotation).max(),
        np.abs(one.position - other.position).max(),
    )


def test_reference_motion_is_dop853_at_each_time():
    bodies = tumbling()
    times = [0.2, 0.5, 0.5, 1.0]
    states = reference_motion(bodies, compass, times, time=0.1)
    assert len(states) == 4
    for t, state in zip(times, states, strict=True):
        assert difference(state, dop853(bodies, compass, t - 0.1, time=0.1)) < 1e-11
    back = reference_motion(states[-1], compass, [0.1], time=1.0)[0]
    assert difference(back, bodies) < 1e-11
    assert same(reference_motion(bodies, compass, [0.4], time=0.4)[0], bodies)


# Fixed bodies, batches, errors


@pytest.mark.parametrize("method", [*STEPS, dop853, partial(splitting, order=4)])
def test_fixed_bodies_stay_and_what_the_wrench_says_of_them_is_not_read(method):
    def wrench(bodies, time):
        force, torque = compass(bodies, time)
        force[0], torque[0] = np.nan, np.inf
        return force, torque

    bodies = tumbling(fixed=True)
    with np.errstate(all="raise", under="ignore"):
        for acting in (None, wrench):
            after = method(bodies, acting, 0.1)
            assert all(
                np.array_equal(getattr(after, f)[0], getattr(bodies, f)[0])
                for f in STATE
            )
            assert after.fixed[0] and not np.array_equal(
                after.position[1], bodies.position[1]
            )
    weight, none = uniform_gravity([0, 0, -9.81])(bodies, 0.0)
    assert np.array_equal(weight[0], np.zeros(3)) and not none.any()
    assert np.allclose(weight[1:, 2], -9.81 * bodies.mass[1:])


@pytest.mark.parametrize("method", [*STEPS, dop853])
def test_what_is_kept_from_call_to_call_fits_the_bodies(method):
    """The same inertia array, first in a fixed body, then in a free one, then fixed again."""
    free = tumbling(2, fixed=False)
    still = np.array([[0.0], [1.0]])
    fixed = replace(
        free,
        mass=np.array([np.inf, 1.0]),
        momentum=still * free.momentum,
        angular_momentum=still * free.angular_momentum,
    )
    assert fixed.inertia is free.inertia
    for _ in range(2):
        assert np.array_equal(
            method(fixed, None, 0.1).orientation[0], fixed.orientation[0]
        )
        assert (
            np.abs(method(free, None, 0.1).orientation[0] - free.orientation[0]).max()
            > 1e-3
        )


@pytest.mark.parametrize("method", [*STEPS, partial(splitting, order=6)])
@pytest.mark.parametrize("seed", SEEDS)
def test_a_batch_is_a_loop(method, seed):
    bodies = tumbling(5, seed=seed)
    together = method(bodies, damped_compass, 0.1, time=0.4)
    for i in range(5):
        after = method(bodies[i], damped_compass, 0.1, time=0.4)
        for f in STATE:
            assert np.allclose(
                getattr(together, f)[i], getattr(after, f)[0], rtol=1e-13, atol=1e-14
            )


@pytest.mark.parametrize("count", [0, 1, 16, 37])
def test_advance_is_a_loop_of_steps(count):
    bodies = tumbling(fixed=True)
    for method, wrench, options in (
        (splitting, None, {"order": 4}),
        (splitting, compass, {"velocity_dependent": False}),
        (rk4, None, {}),
        (dop853, compass, {"relative_tolerance": 1e-6}),
    ):
        if method is dop853 and count > 1:
            continue
        at_once = advance(
            bodies, wrench, 0.05, count, method=method, time=0.2, **options
        )
        stepped = bodies
        for k in range(count):
            stepped = method(stepped, wrench, 0.05, time=0.2 + k * 0.05, **options)
        assert difference_of_free(at_once, stepped) < 1e-13
        assert np.array_equal(at_once.momentum, stepped.momentum)
        assert all(
            np.array_equal(getattr(at_once, f)[0], getattr(bodies, f)[0]) for f in STATE
        )


def test_blocks_do_not_show(monkeypatch):
    bodies = tumbling(7)
    whole = splitting(bodies, compass, 0.1), splitting(bodies, None, 0.1)
    monkeypatch.setattr(splitting_method, "_BLOCK", 3)
    for one, other in zip(
        whole,
        (splitting(bodies, compass, 0.1), splitting(bodies, None, 0.1)),
        strict=True,
    ):
        assert difference(one, other) < 1e-15 * 10


@pytest.mark.parametrize("method", [*STEPS, dop853])
def test_inputs_are_not_written_results_cannot_be_and_are_full_bodies(method):
    bodies = tumbling()
    copies = {f: getattr(bodies, f).copy() for f in Bodies.__dataclass_fields__}
    after = method(bodies, compass, 0.1)
    assert all(np.array_equal(getattr(bodies, f), copies[f]) for f in copies)
    assert after.inertia is bodies.inertia
    for f in STATE:
        with pytest.raises(ValueError, match="read-only"):
            getattr(after, f)[0, 0] = 1.0
    again = Bodies(
        *(getattr(after, f) for f in copies)
    )  # passes every check of the constructor
    assert same(again, after)
    assert np.allclose(after.angular_velocity, again.angular_velocity)


@pytest.mark.parametrize("method", [*STEPS, dop853])
def test_no_bodies_and_no_time(method):
    none = Bodies(
        *(np.empty(s) for s in ((0,), (0, 3, 3), (0, 3), (0, 4), (0, 3), (0, 3)))
    )
    assert len(method(none, None, 0.1)) == 0
    bodies = tumbling()
    assert difference(method(bodies, compass, 0.0), bodies) < 1e-15 * 10


def test_the_time_the_wrench_is_told():
    seen = []

    def wrench(bodies, time):
        seen.append(time)
        return np.zeros((4, 3)), np.zeros((4, 3))

    bodies = tumbling()
    expected = {
        explicit_euler: [3.0],
        symplectic_euler: [3.0],
        midpoint: [3.0, 3.1],
        rk4: [3.0, 3.1, 3.1, 3.2],
        splitting: [3.1, 3.1],
    }
    for method, times in expected.items():
        seen.clear()
        method(bodies, wrench, 0.2, time=3.0)
        assert np.allclose(seen, times)


ZERO = np.zeros((4, 3))
REFUSED = [
    (lambda m: m(3, None, 0.1), "bodies: expected Bodies; got int"),
    (lambda m: m(tumbling(), None, np.nan), "step: expected finite one real number; got nan"),
    (lambda m: m(tumbling(), None, [0.1]), "step: expected one real number; got shape (1,)"),
    (lambda m: m(tumbling(), None, 0.1, time=np.inf), "time: expected finite"),
    (lambda m: m(tumbling(), lambda b, t: ZERO, 0.1), "wrench: expected a pair (force, torque); got array"),
    (lambda m: m(tumbling(), lambda b, t: (ZERO[0], ZERO), 0.1), "wrench force: expected shape (4, 3); got shape (3,)"),
    (lambda m: m(tumbling(), lambda b, t: (ZERO, ZERO + np.nan), 0.1), "wrench torque: expected finite vectors"),
    (lambda m: m(tumbling(), lambda b, t: ("push", ZERO), 0.1), "wrench force: expected real numbers; got 'push'"),
]  # fmt: skip


@pytest.mark.parametrize("method", [*STEPS, dop853])
@pytest.mark.parametrize("call,message", REFUSED, ids=[m[:30] for _, m in REFUSED])
def test_bad_input_is_refused_by_name(method, call, message):
    with pytest.raises(ValueError, match=re.escape(message)):
        call(method)


def test_bad_options_are_refused_by_name():
    with pytest.raises(
        ValueError, match="count: expected a whole number of at least 0; got -1"
    ):
        advance(tumbling(), None, 0.1, -1)
    with pytest.raises(ValueError, match="order: expected one of 2, 4, 6, 8; got 5"):
        advance(tumbling(), None, 0.1, 3, order=5)
    with pytest.raises(TypeError, match="substeps"):
        advance(tumbling(), None, 0.1, 3, substeps=5)
    for order in (3, 10, True, "2"):
        with pytest.raises(
            ValueError,
            match=re.escape(f"order: expected one of 2, 4, 6, 8; got {order!r}"),
        ):
            splitting(tumbling(), None, 0.1, order=order)
    with pytest.raises(
        ValueError,
        match="relative_tolerance: expected a number from 1e-13 to below 1; got 1e-20",
    ):
        dop853(tumbling(), None, 0.1, relative_tolerance=1e-20)
    with pytest.raises(
        ValueError, match="times: expected times one after the other in one direction"
    ):
        reference_motion(tumbling(), None, [1.0, 0.5])
    with pytest.raises(
        ValueError, match=r"times: expected shape \(t,\) with at least one"
    ):
        reference_motion(tumbling(), None, [])
    with pytest.raises(
        ValueError, match=r"gravity: expected shape \(3,\); got shape \(4, 3\)"
    ):
        uniform_gravity(np.ones((4, 3)))
