"""Orders, growth and thresholds: measured ones meet their closed forms within 1 percent."""

import re

import numpy as np
import pytest

from course.dynamics import (
    Bodies,
    explicit_euler,
    middle_axis_growth_rate,
    midpoint,
    rk4,
    splitting,
    symplectic_euler,
)
from course.rotations import identity
from course.study import (
    find_threshold,
    growth_per_step,
    growth_rate,
    measured_order,
    oscillator_growth,
    stability_map,
)

pytestmark = pytest.mark.slow  # orders and thresholds are measured by many steps

SEEDS = [0, 1]

# Energy per step on an oscillator, x = h w: |R(i x)|^2 of the stability function R.
ENERGY_FACTOR = {
    explicit_euler: lambda x: 1 + x**2,
    midpoint: lambda x: 1 + x**4 / 4,
    rk4: lambda x: 1 - x**6 / 72 + x**8 / 576,
}


@pytest.mark.parametrize("method", ENERGY_FACTOR)
def test_energy_grows_as_predicted(method):
    x = np.array([0.05, 0.1, 0.3, 0.7, 1.3, 2.0, 2.7, 3.2])
    predicted = ENERGY_FACTOR[method](x) - 1
    measured = oscillator_growth(method, x, steps=100) - 1
    # One step's rounding of the logarithm of the energy is about 1e-15: where the formula exceeds that.
    exceeds = np.abs(predicted) > 1e-12
    assert exceeds.sum() >= 7
    assert np.all(np.abs(measured / predicted - 1)[exceeds] < 0.01)


@pytest.mark.parametrize("method", [symplectic_euler, splitting])
def test_symplectic_methods_make_no_energy(method):
    growth = oscillator_growth(method, [0.1, 0.5, 1.0, 1.9], steps=1000)
    assert np.all(
        np.abs(growth - 1) < 5e-3
    )  # energy swings by up to (2 + x)/(2 - x): ln(39)/1000


def stays(method, steps=300, **options):
    # Over 300 steps energy that swings at 1 percent below 2 leaves ln(199)/300 = .018 a step.
    return lambda x: oscillator_growth(method, x, steps=steps, **options) <= 1.03


def test_the_threshold_of_rk4():
    assert find_threshold(
        stays(rk4, steps=100), 2.5, 3.3, tolerance=4e-3
    ) == pytest.approx(2 * np.sqrt(2), rel=1e-2)


@pytest.mark.parametrize("method", [symplectic_euler, splitting])
@pytest.mark.long
def test_the_threshold_of_symplectic_methods(method):
    assert find_threshold(stays(method), 1.7, 2.5, tolerance=4e-3) == pytest.approx(
        2, rel=1e-2
    )


@pytest.mark.parametrize("ratio", [0.02, 0.1, 0.5, 1.0])
@pytest.mark.long
def test_the_threshold_of_symplectic_euler_with_damping(ratio):
    predicted = 2 * (np.sqrt(1 + ratio**2) - ratio)
    found = find_threshold(
        stays(symplectic_euler, damping_ratio=ratio), 0.7 * predicted, 1.4 * predicted
    )
    assert found == pytest.approx(predicted, rel=1e-2)


@pytest.mark.parametrize("count", [2, 5])
def test_the_threshold_of_a_stack_on_springs(count):
    """Two-sided springs, the lowest to the ground, X = h sqrt(k/m): X < 1/cos(pi/(2n + 1)); n = 2: 1.23607."""

    def chain(stiffness):
        def wrench(bodies, time):
            x = bodies.position[:, 2]
            stretch = np.diff(x, prepend=0.0)
            force = np.zeros((count, 3))
            force[:, 2] = -stiffness * (stretch - np.append(stretch[1:], 0.0))
            return force, np.zeros((count, 3))

        return wrench

    def is_stable(x):
        rng = np.random.default_rng(0)
        rest = np.zeros((count, 3))
        start = rest.copy()
        start[:, 2] = rng.normal(size=count)
        bodies = Bodies(
            np.ones(count),
            np.tile(np.eye(3), (count, 1, 1)),
            start,
            identity(count),
            rest,
            rest,
        )
        for _ in range(400):
            bodies = symplectic_euler(bodies, chain(x**2), 1.0)
            if np.abs(bodies.position).max() > 1e3:
                return False
        return True

    predicted = 1 / np.cos(np.pi / (2 * count + 1))
    assert find_threshold(is_stable, 0.8, 1.6) == pytest.approx(predicted, rel=1e-2)


@pytest.mark.parametrize("seed", SEEDS)
@pytest.mark.parametrize("method", [rk4, splitting])
def test_the_wobble_about_the_middle_axis_grows_as_predicted(method, seed):
    rng = np.random.default_rng(seed)
    moments = np.sort(rng.uniform(1, 3, 3))
    spin, tilt = 2.0, np.array([1e-8, 0, 1e-8])
    momentum = moments * np.array([0, spin, 0]) + tilt
    bodies = Bodies(
        [1.0],
        [np.diag(moments)],
        np.zeros((1, 3)),
        identity(1),
        np.zeros((1, 3)),
        [momentum],
    )
    predicted = middle_axis_growth_rate(moments, spin)
    step, times, sizes = 0.02 / predicted, [], []
    for k in range(600):
        bodies = method(bodies, None, step)
        local = bodies.rotation[0].T @ momentum
        if (
            k % 30 == 0 and k * step * predicted > 5
        ):  # by then the part that dies away has died
            times.append((k + 1) * step)
            sizes.append(np.hypot(local[0], local[2]))
    assert growth_rate(times, sizes) == pytest.approx(predicted, rel=1e-2)


def test_stability_map():
    knob = np.linspace(0.1, 3.5, 35)
    chart = stability_map(
        {
            "explicit Euler": lambda x: oscillator_growth(explicit_euler, x, steps=100),
            "RK4": lambda x: oscillator_growth(rk4, x, steps=100),
            "symplectic Euler": lambda x: oscillator_growth(
                symplectic_euler, x, steps=600
            ),
        },
        knob,
        knob_name="h w",
    )
    assert chart.growth.shape == (3, 35) and chart.method[1] == "RK4"
    assert np.allclose(chart.thresholds(slack=5e-3), [0.0, 2.8, 1.9])
    assert np.array_equal(chart.stable()[1], chart.growth[1] <= 1.01)
    table = chart.table()
    assert len(table) == 105
    assert table[0] == {
        "method": "explicit Euler",
        "knob": pytest.approx(0.1),
        "growth": pytest.approx(1.01),
    }
    always = stability_map({"still": lambda x: np.ones(35)}, knob, knob_name="h w")
    assert always.thresholds()[0] == knob[-1]


def test_measures_by_hand():
    assert measured_order([0.1, 0.05, 0.025], [8e-3, 1e-3, 1.25e-4]) == pytest.approx(3)
    assert growth_rate([0.0, 1.0, 2.0], [1.0, np.e**0.5, np.e]) == pytest.approx(0.5)
    assert np.allclose(growth_per_step([[1.0, 7.0, 4.0], [2.0, 1.0, 0.5]]), [2.0, 0.5])
    assert find_threshold(
        lambda x: x < 1.234, 0.1, 10.0, tolerance=1e-9
    ) == pytest.approx(1.234, rel=1e-9)


def test_growth_broadcasts_and_a_batch_is_a_loop():
    x, z = np.array([0.5, 1.5, 3.0]), np.array([[0.0], [0.3]])
    table = oscillator_growth(symplectic_euler, x, damping_ratio=z, steps=40)
    assert table.shape == (2, 3)
    for i in range(2):
        for j in range(3):
            one = oscillator_growth(
                symplectic_euler, x[j], damping_ratio=z[i, 0], steps=40
            )
            assert table[i, j] == pytest.approx(one, rel=1e-12)


KNOB = np.array([1.0, 2.0])
REFUSED = [
    (
        lambda: measured_order([0.1], [1.0]),
        "steps: expected at least two different ones",
    ),
    (
        lambda: measured_order([0.1, 0.1], [1.0, 2.0]),
        "steps: expected at least two different ones",
    ),
    (
        lambda: measured_order([0.1, 0.2], [1.0, 0.0]),
        "errors: expected positive numbers; got 0.0 in entry 1",
    ),
    (
        lambda: growth_rate([0, 1], [1.0, 2.0, 3.0]),
        "values: expected shape (2,) as times; got shape (3,)",
    ),
    (lambda: growth_per_step([1.0]), "values: expected at least 2 along the last axis"),
    (
        lambda: find_threshold(lambda x: x < 2, 3.0, 4.0),
        "lower: expected a value that is stable; got 3.0",
    ),
    (
        lambda: find_threshold(lambda x: x < 2, 0.5, 1.0),
        "upper: expected a value that is not stable; got 1.0",
    ),
    (
        lambda: find_threshold(lambda x: x < 2, 3.0, 1.0),
        "lower: expected a value above 0 and below upper",
    ),
    (
        lambda: find_threshold(lambda x: x < 2, 1.0, 3.0, tolerance=0),
        "tolerance: expected a positive number",
    ),
    (
        lambda: oscillator_growth(rk4, 0.0),
        "frequency_step: expected positive numbers; got 0.0",
    ),
    (
        lambda: oscillator_growth(rk4, 1.0, damping_ratio=-1),
        "damping_ratio: expected numbers at or above 0",
    ),
    (
        lambda: oscillator_growth(rk4, 1.0, steps=0),
        "steps: expected a whole number of at least 1; got 0",
    ),
    (
        lambda: stability_map({}, KNOB, knob_name="x"),
        "methods: expected at least one; got none",
    ),
    (
        lambda: stability_map({"m": lambda x: x}, [2.0, 1.0], knob_name="x"),
        "knob: expected ascending numbers",
    ),
    (
        lambda: stability_map({"m": lambda x: 1.0}, KNOB, knob_name="x"),
        "growth of m: expected shape (2,)",
    ),
]


@pytest.mark.parametrize("call,message", REFUSED, ids=[m[:40] for _, m in REFUSED])
def test_bad_input_is_refused_by_name(call, message):
    with pytest.raises(ValueError, match=re.escape(message)):
        call()
