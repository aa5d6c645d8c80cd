"""The counted laws against the solver of the library, and springs against what they must keep."""

import numpy as np
import pytest
from scenes.parts import bodies_and_contacts

from course.contact import resolve_collisions
from course.dynamics import normal_velocity
from course.scenes import box_on_corners
from course.study import (
    box_landings,
    cradle_by_springs,
    impulses_at_once,
    impulses_by_springs,
    impulses_by_steps,
    impulses_in_turn,
    normal_response,
)

pytestmark = pytest.mark.slow  # with its like, left out of --quick

CRADLE = np.array([[2.0, -1.0], [-1.0, 2.0]]), np.array([-1.0, 0.0])


def row_after(start, impulse):
    """Three balls of 1 kg in a row after impulses at their two contacts."""
    return np.asarray(start) + [-impulse[0], impulse[0] - impulse[1], impulse[1]]


@pytest.mark.parametrize("e", [0.0, 0.4, 1.0])
@pytest.mark.parametrize(
    "law, function",
    [("sequential", impulses_in_turn), ("simultaneous", impulses_at_once)],
)
def test_counted_laws_are_those_of_the_library(law, function, e):
    rng = np.random.default_rng(6)
    for _ in range(10):
        bodies, contacts = bodies_and_contacts(
            box_on_corners(spin=[*rng.uniform(-1.2, 1.2, 2), 0.0])
        )
        u, matrix = normal_velocity(bodies, contacts), normal_response(bodies, contacts)
        assert np.all(
            u < 0
        )  # otherwise the simultaneous law is asked of some contacts only
        after = normal_velocity(
            resolve_collisions(bodies, contacts, e, law=law), contacts
        )
        assert np.allclose(u + matrix @ function(matrix, u, e)[0], after, atol=1e-9)


def test_cradle_by_every_law():
    # One ball onto two that touch, known figures: (-1/3, 2/3, 2/3) at once, (0, 0, 1) in turn, and by springs
    # (-.13026, .15023, .98003) for linear and (-.07095, .07640, .99455) for Hertz's.
    start = [1.0, 0.0, 0.0]
    assert np.allclose(
        row_after(start, impulses_at_once(*CRADLE, 1.0)[0]), [-1 / 3, 2 / 3, 2 / 3]
    )
    assert np.allclose(row_after(start, impulses_in_turn(*CRADLE, 1.0)[0]), [0, 0, 1])
    for exponent, expected in (
        (1.0, [-0.13026, 0.15023, 0.98003]),
        (1.5, [-0.07095, 0.07640, 0.99455]),
    ):
        after = row_after(start, impulses_by_springs(*CRADLE, exponent=exponent))
        assert np.allclose(after, expected, atol=5e-6)
        assert np.allclose(
            after, cradle_by_springs(start, exponent=exponent).final, atol=1e-8
        )


def test_springs_keep_energy_and_part_everywhere():
    landings = box_landings(8, seed=3)
    for u in landings.normal_velocity:
        for exponent in (1.0, 1.5):
            impulse = impulses_by_springs(landings.matrix, u, exponent=exponent)
            after = u + landings.matrix @ impulse
            assert np.all(impulse >= 0) and np.all(after >= 0)
            assert impulse @ (u + after) / 2 == pytest.approx(
                0, abs=1e-8
            )  # the work of the impulses


def test_steps_come_nearer_to_the_springs():
    landings = box_landings(6, seed=2)

    def error(step):
        off = [
            landings.matrix
            @ (
                impulses_by_steps(landings.matrix, u, step)[0]
                - impulses_by_springs(landings.matrix, u)
            )
            for u in landings.normal_velocity
        ]
        return np.abs(off).max()

    coarse, fine = error(0.1), error(0.01)
    assert coarse < 0.1 and fine < coarse / 20
    assert impulses_by_steps(landings.matrix, landings.normal_velocity[0], 0.01)[1] > 50


def test_stopped_early_a_law_breaks_its_promises():
    # A push at the second corner presses the first one down again.
    matrix, u = (
        normal_response(*bodies_and_contacts(box_on_corners())),
        np.full(4, -1.0),
    )
    impulse, used = impulses_in_turn(matrix, u, 1.0, passes=1)
    assert used == 1 and np.min(u + matrix @ impulse) < -0.5
    settled, used = impulses_in_turn(matrix, u, 1.0)
    assert used < 10 and np.min(u + matrix @ settled) >= 0
    early, sweeps = impulses_at_once(matrix, u, 1.0, sweeps=1)
    assert sweeps == 1 and abs(early @ (2 * u + matrix @ early)) > 0.1


def test_no_impulse_to_contacts_that_part():
    for function in (impulses_in_turn, impulses_at_once):
        assert not function(np.eye(2), [0.5, 0.0], 0.7)[0].any()
    assert not impulses_by_springs(np.eye(2), [0.5, 0.0]).any()


@pytest.mark.parametrize(
    "change, message",
    [
        (
            dict(matrix=np.ones((2, 3))),
            r"matrix: expected shape \(c, c\); got shape \(2, 3\)",
        ),
        (dict(normal_velocity=[1.0]), r"normal_velocity: expected shape \(2,\)"),
        (
            dict(matrix=np.zeros((2, 2))),
            "matrix: expected a positive diagonal; got 0.0",
        ),
        (dict(restitution=1.2), "restitution: expected numbers from 0 to 1; got 1.2"),
    ],
)
def test_laws_refuse(change, message):
    good = dict(matrix=np.eye(2), normal_velocity=[-1.0, -1.0], restitution=0.5)
    for function in (impulses_in_turn, impulses_at_once):
        with pytest.raises(ValueError, match=message):
            function(**(good | change))


def test_springs_refuse():
    with pytest.raises(ValueError, match="exponent: expected at least 1; got 0.5"):
        impulses_by_springs(*CRADLE, exponent=0.5)
    with pytest.raises(ValueError, match="step: expected positive"):
        impulses_by_steps(*CRADLE, 0.0)
