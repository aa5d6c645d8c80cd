"""Marks that formulas carry stay on the handle; wrong ones leave it."""

from __future__ import annotations

import numpy as np
import pytest

from course.study.carried_marks import (
    THROWN,
    by_acceleration,
    by_normal_rate,
    by_turn,
    by_velocity,
    cross_lost,
    tumbling,
)

TIMES = np.linspace(0.0, 3.0, 241)


def off(mark, body):
    return np.linalg.norm(mark(body) - body.position - body.arm, axis=1)


@pytest.mark.parametrize("tilt", [1.0, 50.0])
@pytest.mark.parametrize(
    ("mark", "most"),
    [(by_velocity(), 1e-6), (by_acceleration(), 2e-6), (by_normal_rate(), 1e-5), (by_turn(), 1e-12)],
)  # fmt: skip
@pytest.mark.slow
def test_the_right_formula_keeps_it_on_the_handle(mark, most, tilt):
    body = tumbling(TIMES, tilt=np.radians(tilt))
    assert off(mark, body).max() < most


def test_the_motion_agrees_with_itself():
    body = tumbling(TIMES, tilt=0.3)
    moving = np.gradient(body.position, TIMES, axis=0, edge_order=2)
    np.testing.assert_allclose(body.velocity, moving, atol=1e-10)
    slope = np.gradient(body.omega, TIMES, axis=0, edge_order=2)
    np.testing.assert_allclose(slope, body.omega_dot, atol=0.05)


def test_without_turning_the_mark_keeps_its_distance_from_the_start_of_the_arm():
    """v alone carries it as the centre goes: off by |r(t) - r(0)|."""
    body = tumbling(TIMES, tilt=0.3)
    alone = off(by_velocity(lambda v, omega, r: v), body)
    away = np.linalg.norm(body.arm - body.arm[0], axis=1)
    np.testing.assert_allclose(alone, away, atol=1e-9)
    assert alone.max() > 0.15 and THROWN[2] > 0


def test_with_the_cross_product_lost_it_flies_off():
    body = tumbling(TIMES, tilt=0.02)
    assert off(by_acceleration(cross_lost), body).max() > 0.1


def test_without_the_centripetal_term_it_flies_off():
    body = tumbling(TIMES, tilt=0.02)
    wrong = by_acceleration(lambda a, alpha, omega, r: a + np.cross(alpha, r))
    assert off(wrong, body)[-1] > 1.0
