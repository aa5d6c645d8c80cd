"""The predictions of this lesson, and how each is computed."""

from __future__ import annotations

import numpy as np

from course import contact, formulas
from course.dynamics import point_velocity
from course.exercises.definition import Prediction
from course.exercises.definitions.lesson_13_separation.shared import UP, ZERO


def _closing() -> float:
    from course.scenes import bar_over_plank

    pair = bar_over_plank()
    return float(contact.separation_rate(pair.bodies, pair.contacts)[0])


def _left_corner() -> float:
    body = (
        np.array([0.0, 0.0, 1.0]),
        np.array([0.0, 0.0, -1.0]),
        np.array([3.0, 0.0, 0.0]),
    )
    p = np.array([0.0, -0.5, 0.7])
    floor = (ZERO, ZERO, ZERO)
    below = p * (1, 1, 0)
    return float(formulas.separation_rate(p, below, body, floor, UP, ZERO))


def _top_speed() -> float:
    from course.scenes import ladder

    scene = ladder(np.radians(60), rate=-1.0)
    bodies, (foot, top) = scene.bodies, scene.contacts.point
    x, v, omega = bodies.position[0], bodies.velocity[0], bodies.angular_velocity[0]
    along, down = (
        float(np.linalg.norm(point_velocity(v, omega, p - x))) for p in (foot, top)
    )
    return down / along


def _turning_of_the_normal() -> float:
    step, gap = 1e-9, 1e-3
    return float(np.arctan2(step, gap) / step)


PREDICTIONS = (
    Prediction(
        "closing",
        "The bar turns at 1.5 rad/s, the plank at 0.5 rad/s, both against the clock; the corner is 0.8 m left of the "
        "bar's centre and 1 m right of the plank's. At what rate does the gap change, in m/s? (Below 0: it closes.)",
        _closing,
        "The corner comes down at 1.5 * 0.8 = 1.2 m/s and the plank comes up at 0.5 * 1.0 = 0.5 m/s. What moves "
        "are the material points, not the centres.",
        unit="m/s",
        tolerance=0.01,
        later="See",
        wrong={
            0: "That is the rate at which the centres approach. The points that meet are elsewhere.",
            -1.2: "That is the bar alone. The plank turns too, and its face comes up.",
            -0.7: "The bar comes down and the plank comes up: their speeds add.",
            1.7: "The size is right. The gap gets smaller, so its rate is below 0.",
        },
    ),
    Prediction(
        "left_corner",
        "The same box: v = (0, 0, -1), omega = (3, 0, 0), but the left corner, r = (0, -0.5, -0.3). What is d_dot over "
        "a fixed floor, N = (0, 0, 1)?",
        _left_corner,
        "The z component of omega x r is 3 * (-0.5) = -1.5, and the centre adds -1: -2.5 m/s.",
        unit="m/s",
        tolerance=1e-9,
        wrong={
            0.5: "That is the right corner. With r_y = -0.5 the turning brings this one down.",
            -1: "That is the centre. The corner turns besides.",
            -0.1: "You took r_z for r_y: the z component of omega x r is omega_x r_y.",
        },
    ),
    Prediction(
        "top_speed",
        "The ladder slides down, touching both. At 60 degrees its foot moves away from the wall at 1 m/s. How fast "
        "does its top come down?",
        _top_speed,
        "Both d_dot are 0. The foot moves at ell omega sin(60 deg) and the top at ell omega cos(60 deg): their ratio "
        "is tan(60 deg).",
        unit="m/s",
        tolerance=0.01,
        wrong={
            1: "Only at 45 degrees. The ladder keeps its length, not the sum of its reaches along floor and wall.",
            1.7320508: "Turned round: a steep ladder's top comes down slowly while its foot runs.",
        },
    ),
    Prediction(
        "corner_normal",
        "A point passes 1 mm over the corner of a box at 1 m/s; the box lies still. N points from the nearest point of "
        "the box to the point. How fast does N turn just past the corner? The size of its rate, in rad/s.",
        _turning_of_the_normal,
        "It turns about the corner at v/gap = 1/0.001. Nothing turns but the question which point is nearest, and that "
        "changes the faster the nearer they are.",
        unit="rad/s",
        wrong={
            0: "The box does not turn. But its nearest point is the corner now, and N follows the moving point.",
            -1000: "The rate is right for one way of looking. Its size, which is asked, is above 0.",
        },
    ),
)
