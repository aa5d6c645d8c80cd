"""What lessons 00, 10 and 11 say in numbers, computed; each number is read from its sentence."""

import numpy as np
import pytest
from lesson_text import prose, rounds_to, said
from scipy.integrate import solve_ivp

from course.contact import resolve_collisions
from course.dynamics import ball_events, bounce_rest_time, impulse_central, two_blocks
from course.exercises.definition import all_lessons
from course.study import (
    PUBLISHED_BOUNCING,
    billiard_break,
    bouncing_errors,
    bouncing_loop,
    cradle_by_springs,
    cradle_by_steps,
    energy_error,
)

#: Seconds together: left out of the minute's run.
pytestmark = pytest.mark.slow

G = 9.81
X = np.array([1.0, 0.0, 0.0])


def remark(lesson, prediction, answer):
    """What a prediction says to a wrong answer."""
    (own,) = (le for le in all_lessons() if le.number == lesson)
    (found,) = (p for p in own.predictions if p.name == prediction)
    return found.wrong[answer]


# 00


def test_a_box_that_is_not_asked_about():
    (depth,) = said(
        "00", "Without asking, a box is # m deep after a second of 60 steps."
    )
    assert rounds_to(np.sum(np.cumsum(np.full(60, G / 60))) / 60, depth)


# 10


def test_the_light_block_is_fastest_where_the_heavy_one_turns():
    assert (
        "faster and faster until the heavy one has turned round, then slower"
        in prose("10")
    )
    for ratio in (100, 10_000):
        motion = two_blocks(ratio)
        light, heavy = np.abs(motion.velocity).T
        turned = int(np.argmax(motion.velocity[:, 1] > 0))
        assert np.all(np.diff(light[: turned + 1]) >= -1e-9)
        assert np.all(np.diff(light[turned + 1 :]) <= 1e-9)
        assert light[-1] < heavy[-1] and turned > motion.count / 3


def test_what_is_said_of_a_hundred_collisions():
    said_of_it = remark("10", "blocks", 100)
    assert "root of the mass ratio" in said_of_it and "by a factor of pi" in said_of_it
    assert two_blocks(100**2).count / np.sqrt(100**2) == pytest.approx(np.pi, rel=1e-3)


def test_every_two_collisions_are_a_step_of_the_same_angle():
    assert "Every two collisions are a step of the same angle" in prose("10")
    motion = two_blocks(100)
    y, x = motion.scaled_velocity.T
    angle = np.unwrap(np.arctan2(y, x)[1::2])
    assert np.diff(angle) == pytest.approx(
        np.full(len(angle) - 1, angle[1] - angle[0]), abs=1e-9
    )
    assert abs(angle[1] - angle[0]) == pytest.approx(2 * np.arctan(0.1))


def test_the_hertz_cradle_holds_ten_digits():
    assert "integrates that force to ten digits" in prose("10")

    def rate(_, state):
        push = np.concatenate([[0], np.maximum(-np.diff(state[:3]), 0) ** 1.5, [0]])
        return np.concatenate([state[3:], push[:-1] - push[1:]])

    start = np.array([0.0, 0.0, 0.0, 1.0, 0.0, 0.0])
    options = {"method": "DOP853", "rtol": 1e-13, "atol": 1e-15, "max_step": 0.01}
    fine = solve_ivp(rate, (0, 30), start, **options).y[3:, -1]
    assert np.abs(cradle_by_springs([1.0, 0.0, 0.0]).final - fine).max() < 1e-10


def test_a_break_by_the_reversed_list_is_the_mirror_image():
    (back,) = said("10", "the cue ball comes straight back at # of its 8 m/s")
    cue = billiard_break(law="simultaneous").after.velocity[0]
    assert rounds_to(-cue[0], back) and np.abs(cue[1:]).max() < 1e-12
    assert "fly: the mirror image." in prose("10")
    assert "six balls never learn of the break" in prose("10")
    one = billiard_break(law="sequential")
    other = resolve_collisions(one.before, one.contacts[::-1], 1.0, law="sequential")
    speed = np.linalg.norm(one.after.velocity, axis=1)
    assert int(np.sum(speed < 1e-9)) == 6
    mirror = np.array([1.0, -1.0, 1.0])
    partner = np.linalg.norm(
        other.position[:, None] - one.after.position * mirror, axis=-1
    ).argmin(axis=1)
    expected = one.after.velocity[partner] * mirror
    assert other.velocity == pytest.approx(expected, abs=1e-9)


def test_work_and_error_of_the_cradles():
    least, few, many = said(
        "10", """It cannot do better than # m/s; whoever wants better models the springs, at
        # to about # force evaluations.""",
    )  # fmt: skip
    (settle,) = said("10", "Linear springs settle at # m/s")
    truth, start = cradle_by_springs([1.0, 0.0, 0.0]).final, [1.0, 0.0, 0.0]

    def error(velocity):
        return float(np.abs(np.asarray(velocity) - truth).max())

    assert rounds_to(error([0.0, 0.0, 1.0]), least)
    counts = [cradle_by_steps(start, h)[1] for h in (0.5, 0.005)]
    assert counts[0] == int(few) and counts[1] == pytest.approx(int(many), abs=10)
    errors = [
        error(cradle_by_steps(start, h, exponent=1.0)[0]) for h in (0.5, 0.05, 0.005)
    ]
    assert rounds_to(errors[2], settle) and errors[0] < 0.9 * errors[2]


def test_bodies_that_part_and_are_not_asked():
    (percent,) = said(
        "10", "halves at every step, and after five steps # percent of it is left"
    )
    u = 2.0
    for _ in range(5):
        u = -0.5 * u
    assert rounds_to(100 * abs(u) / 2.0, percent)


def impacts_of_three(e):
    """Impacts of three touching balls, one pair at a time, until no pair approaches."""
    v, count, pair, quiet = [1.0, 0.0, 0.0], 0, 0, 0
    while quiet < 2:
        closing = v[pair] - v[pair + 1]
        if closing > 0:
            v[pair] -= (1 + e) * closing / 2
            v[pair + 1] += (1 + e) * closing / 2
            count, quiet = count + 1, 0
        else:
            quiet += 1
        pair = 1 - pair
    return count


def test_the_count_is_the_largest_whole_number_below_half_a_turn():
    count, e, turn = said(
        "10", r"""the largest whole number below the curve, which is half a turn over the
        angle of an impact: # impacts at $\varepsilon = #$, where half a turn takes #.""",
    )  # fmt: skip

    def half_a_turn(e):
        return np.pi / np.arccos((1 + e) / 4 / np.sqrt(e))

    assert impacts_of_three(float(e)) == int(count)
    assert rounds_to(half_a_turn(float(e)), turn)
    for e in np.linspace(0.08, 0.999, 920):
        below = int(np.ceil(half_a_turn(e))) - 1
        assert impacts_of_three(e) == below, e


def test_rounding_of_the_heavy_body_stays_under_its_bound_and_touches_it():
    assert "the measured points stay under the bound and touch it" in prose("10")
    (power,) = said("10", r"past a ratio of $6\cdot10^{#}$ body 2 does not notice")
    ratio = 10.0 ** np.arange(2, 19.5, 0.25)
    push = impulse_central(1.0, ratio, -X, X, X, 0.7)
    lost = np.abs(ratio * (1.0 - (1.0 - push / ratio)) - push) / push
    bound = np.minimum(np.finfo(float).eps / 4 * ratio / push, 1.0)
    assert np.all(lost <= bound * (1 + 1e-9)) and (lost / bound)[bound < 1].max() > 0.9
    threshold = push[-1] / (np.finfo(float).eps / 4)
    assert rounds_to(threshold / 10 ** int(power), "6")
    assert np.all(lost[ratio > threshold] == 1) and lost[ratio < threshold].max() < 1


def test_a_ball_on_a_player():
    assert "off by one percent of a speed of 1 m/s" in prose("10")
    true, wall = (
        impulse_central(0.43, heavy, -X, 0 * X, X, 0.8) / 0.43
        for heavy in (75.0, np.inf)
    )
    assert 100 * (wall - true) == pytest.approx(1.0, abs=0.05)


# 11


def loop(height, e, step):
    """Heights and velocities of the exercise's step, for ever."""
    state = (height, 0.0)
    while True:
        yield state
        z, v = state
        v = -e * v if z < 0 and v < 0 else v - G * step
        state = (z + step * v, v)


def test_the_first_impact_of_the_step_is_too_deep():
    (deep,) = said("11", "turns it round there, the first time # cm too deep")
    states = loop(1.0, 0.5, 0.01)
    first = next(z for z, v in states if z < 0 and v < 0)
    assert rounds_to(-100 * first, deep)


def test_gravity_in_the_step_that_bounces_first_or_last():
    before, after = said("11", "about 400 times larger (# and # times)")
    (recap,) = said("11", "each bounce loses as much, # times the error over 20 s")
    (gain, forty) = said("11", "# times the error over 20 s, # times over 40 s")
    assert recap == after and gain == before
    none = energy_error("ode", 1e-3)
    assert rounds_to(energy_error("bullet", 1e-3) / none, before)
    z, v, gained = 4.9, 0.0, []
    for _ in range(20_000):
        gained.append(49 * 10 * (G * (z - 4.9) + v**2 / 2))
        v = -v if z < 0 and v < 0 else v
        z, v = z + 1e-3 * (v - G * 1e-3), v - G * 1e-3
    assert rounds_to(np.mean(np.square(gained)) / none, after) and gained[-1] < 0
    longer = [energy_error(order, 1e-3, duration=40.0) for order in ("bullet", "ode")]
    assert rounds_to(longer[0] / longer[1], forty)


def test_the_predicted_ratio_against_the_measured_ones():
    (ratio,) = said("11", "that of the ratio, #, is one percent low")
    small, high, large = said(
        "11", "these small steps (#) and # percent high for the largest (#)"
    )
    times = np.linspace(0, 20, 10_001)
    k = np.searchsorted(ball_events(4.9, 1.0, 20.0).time, times)
    predicted = 1 + 12 * np.mean(k**2)
    errors = bouncing_errors()
    measured = errors.bullet / errors.ode
    assert rounds_to(predicted, ratio)
    for one in measured[:5]:  # steps of up to a millisecond
        assert one == pytest.approx(float(small), abs=1)
        assert rounds_to(100 * (1 - predicted / one), "1")
    assert rounds_to(measured[-1], large)
    assert rounds_to(100 * (predicted / measured[-1] - 1), high)
    ode = (49 * 10 * G * PUBLISHED_BOUNCING.step) ** 2 * 2 * G * 4.9 / 12
    off = np.abs(errors.ode / ode - 1)
    assert "good to a thousandth for steps of up to a millisecond" in prose("11")
    assert "and to 10 percent for the largest" in prose("11")
    assert off[:5].max() < 1e-3 and off.max() < 0.1 and off.argmax() == 8


def test_where_DART_leaves_the_line():
    assert (
        "at its second step at a quarter of it and at its third at two thirds"
        in prose("11")
    )
    share = PUBLISHED_BOUNCING.dart_error / PUBLISHED_BOUNCING.bullet_error
    assert share[1] == pytest.approx(1 / 4, abs=0.03)
    assert share[2] == pytest.approx(2 / 3, abs=0.03)
    assert np.delete(share, [1, 2]).min() > 0.9 and share.max() < 1


def test_the_energy_of_one_loop_wavers_and_that_of_the_other_climbs():
    assert r"wavers with $v$ by at most about $\tfrac12 m g\,\Delta t\,V$" in prose(
        "11"
    )
    assert r"is too large by about $k\,m V g\,\Delta t$" in prose("11")
    V, step = np.sqrt(2 * G * 4.9), 1e-3
    for order, unit, most in (("ode", 0.5, 1.0), ("bullet", 1.0, 10.0)):
        motion = bouncing_loop(order, step)
        off = G * motion.height + motion.velocity**2 / 2 - G * 5.0
        bound = unit * G * step * V
        if order == "bullet":  # ten bounces, and the wavering on top of the last
            most += 0.5
        assert np.abs(off).max() / bound == pytest.approx(most, rel=0.02)


def test_events_end_by_rounding_alone():
    (count,) = said("11", "After # events the speed itself is rounded to 0")
    found = ball_events(1.0, 0.5, 2.0)
    assert found.time.size == int(count.replace(",", "")) and found.speed[-1] == 0.0
    assert r"With $\varepsilon > 1/2$ not even that happens" in prose("11")
    assert "the clock stops long before the events do" in prose("11")
    assert int(np.argmax(np.diff(found.time) == 0)) < 100
    for e in (0.5000001, 0.51, 0.9, 0.99):
        endless = ball_events(1.0, e, 1e6, max_events=100_000)
        assert not endless.finished and endless.speed[-1] > 0
        assert e * endless.speed[-1] == endless.speed[-1]


def rests(e, threshold, *, height=1.0, step=0.01, steps=40_000):
    """When the lesson's rule puts the ball to rest: a rebound from 0 to below a threshold [s], or None."""
    states = loop(height, e, step)
    _, before = next(states)
    for k in range(steps):
        _, v = next(states)
        if before < 0 <= v < threshold:
            return k * step
        before = v
    return None


def test_which_threshold_puts_the_sinking_ball_to_rest():
    never, speed = said(
        "11", r"""may never be met, as # m/s here. $g\,\Delta t = #$ m/s was met for every
        $\varepsilon$ from 0 to 0.99 that we tried, in steps of 0.01.""",
    )  # fmt: skip
    assert rests(0.5, float(never)) is None and rests(0.5, 0.05) == pytest.approx(1.32)
    assert rounds_to(G * 0.01, speed)
    assert all(rests(e, G * 0.01) is not None for e in np.linspace(0, 0.99, 100))
    assert rests(0.0, G * 0.01) == pytest.approx(0.45)


def test_bounces_that_are_seen():
    five, half, many, ninety = said(
        "11", r"from 1 m to 1 mm # of them at $\varepsilon = #$ and # at #."
    )
    early, again, late = said(
        "11", """the ball comes to rest # s too early; at 0.9 it takes #, and rest comes # s
        too early""",
    )  # fmt: skip
    assert again == many
    for e, count, seconds in ((half, five, early), (ninety, many, late)):
        slow = np.sqrt(2 * G * 1e-3)
        kept = ball_events(1.0, float(e), 20.0, rest_speed=slow)
        assert kept.time.size == int(count)
        assert int(np.ceil(np.log(1e-3) / (2 * np.log(float(e))))) == int(count)
        assert rounds_to(float(bounce_rest_time(1.0, float(e))) - kept.rest, seconds)


def test_events_against_steps():
    events, steps = said(
        "11", "beats every fixed step of the chart: # events against # steps"
    )
    assert ball_events(4.9, 1.0, 20.0).time.size == int(events)
    assert round(20 / 0.1) == int(steps)
