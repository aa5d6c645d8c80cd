"""The predictions of this lesson, and how each is computed."""

from __future__ import annotations

import numpy as np

from course.exercises.definition import Prediction


def _counted_twice() -> str:
    from course.dynamics import Dome

    dome = Dome()
    theta = dome.leaving_angle
    excess = dome.bias_as_printed(theta) - dome.bias(theta)
    parts = {
        "surface": dome.speed(theta) ** 2 / dome.radius,
        "gravity": -dome.gravity * np.cos(theta),
    }
    return min(parts, key=lambda name: abs(parts[name] - excess))


def _ladder_top() -> float:
    from course.contact import separation_acceleration
    from course.scenes import ladder

    scene = ladder(np.radians(60), rate=-0.5)
    return float(
        separation_acceleration(
            scene.bodies, scene.contacts, scene.force, scene.torque
        )[1]
    )


PREDICTIONS = (
    Prediction(
        "dome",
        "The printed formula lets the particle leave the dome at 37 degrees, nature at 48. Something in the formula is "
        "counted twice. What?",
        _counted_twice,
        "v^2/R, by which the surface falls away under the particle: once because the normal turns, and once more "
        "because the point of the dome that was touched is left behind.",
        choices={
            "gravity": "the pull of gravity",
            "speed": "the kinetic energy: the v^2 it gives is twice too large",
            "surface": "the falling away of the surface under the particle",
        },
        later="Where it breaks",
        wrong={
            "gravity": "Gravity pulls the particle onto the dome: counted twice, it would leave later, not earlier.",
            "speed": "The energy gives the same v^2 in both. What is doubled is the whole term that v^2 stands in.",
        },
    ),
    Prediction(
        "ladder_top",
        "The same sliding ladder: 4 m, 60 degrees, theta decreasing at 0.5 rad/s, no contact forces. What is b_2, "
        "the acceleration of the gap at its top?",
        _ladder_top,
        "a_y = 0 and alpha = 0, so b_2 = (4/2) * 0.25 * cos(60 degrees) = 0.25 m/s^2: without forces the top would "
        "leave the wall.",
        unit="m/s²",
        tolerance=1e-6,
        wrong={
            0: "Gravity acts along the wall, that is right. But the ladder turns: its top is drawn toward the centre.",
            -0.25: "The top is accelerated toward the centre of the ladder, away from the wall: the gap opens.",
            0.4330127: "That is the sine. The part of the arm that lies across the wall is its cosine.",
            -9.81: "That is gravity, which acts along the wall here.",
        },
    ),
)
