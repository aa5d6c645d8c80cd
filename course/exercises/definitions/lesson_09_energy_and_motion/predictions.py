"""What the student predicts before seeing it: the handle, its tilt, and a spring."""

from __future__ import annotations

import numpy as np

from course.dynamics import angular_kinetic_energy
from course.exercises.definition import Prediction

# The top is the lesson's handle, its truth the exact motion.


def _what_L_does() -> str:
    from course.dynamics import explicit_euler, free_tumble
    from course.scenes import spinning_handle

    # By steps, which are free to change L, half a second past the first turning over.
    start = bodies = spinning_handle().bodies
    for _ in range(200):
        bodies = explicit_euler(bodies, None, 0.01)
    turned = float(free_tumble(start, [2.0]).seen_from_body[0, 1]) < 0
    along = float(np.sum(bodies.angular_momentum * start.angular_momentum))
    size = float(np.sum(start.angular_momentum**2))
    return (
        "stays"
        if turned and along > 0.999 * size
        else "turns"
        if along < 0
        else "shrinks"
    )


def _first_turnover(degrees: float) -> float:
    from course.dynamics import free_tumble
    from course.scenes import spinning_handle

    motion = free_tumble(
        spinning_handle(tilt=np.radians(degrees)).bodies, np.linspace(0.0, 6.0, 1201)
    )
    return float(motion.turnover_times()[0])


def _spring_growth() -> str:
    from course.dynamics import explicit_euler
    from course.study import oscillator_growth

    grown = float(oscillator_growth(explicit_euler, 0.1, steps=628)) ** 628
    sizes = {"lost": 0.01, "same": 1.0, "times 7": 7.0, "times 500": 500.0}
    return min(sizes, key=lambda name: abs(np.log(grown / sizes[name])))


PREDICTIONS = (
    Prediction(
        "handle",
        "No torque acts on the handle. While it turns over, what does its angular momentum L do?",
        _what_L_does,
        "No torque, no change of L: that is what a torque is. It is the handle that turns about the L that stays.",
        choices={
            "turns": "it turns over with the handle",
            "shrinks": "it shrinks to zero and grows again, pointing the other way",
            "stays": "it stays as it is",
        },
        later="Derive",
        wrong={
            "turns": "L is not fixed to the body. It is the body's inertia times omega, and neither of them stays.",
            "shrinks": "Then something outside would have taken the angular momentum and given it back.",
        },
    ),
    Prediction(
        "half_example",
        "The body by hand, moments 1, 2 and 3 kg m^2, now with omega = (1, 0, 2) rad/s. What is T_angular?",
        lambda: float(
            angular_kinetic_energy(np.array([1.0, 0.0, 6.0]), np.array([1.0, 0.0, 2.0]))
        ),
        "L = (1, 0, 6), L.omega = 1 + 12, and half of that is 6.5 J.",
        unit="J",
        tolerance=1e-6,
        wrong={
            13.0: "The half is missing.",
            2.5: "omega.omega/2: the moments are missing.",
            5.0: "This is omega.omega: the moments and the half are missing.",
        },
    ),
    Prediction(
        "careful",
        "Tilted by 1 degree at the start, the handle lies on its side after 1.56 s. Let it go ten times more "
        "carefully, tilted by 0.1 degree. After how many seconds does it lie on its side?",
        lambda: _first_turnover(0.1),
        "A tilt that grows as exp(sigma t) needs ln(10)/sigma = 0.68 s more to become ten times larger, whatever its "
        "size, as long as it is small. Each further digit of care buys the same 0.68 s.",
        unit="s",
        tolerance=0.08,
        wrong={
            15.6: "Ten times the care is not ten times the time: the tilt grows exponentially.",
            4.93: "The root of ten would fit a tilt that grows with the square of time.",
            1.56: "The care does count, but only by its logarithm.",
        },
    ),
    Prediction(
        "spring",
        "A weight swings on a spring without friction. A program moves it by 628 steps of explicit Euler, each of "
        "them a = h w = 0.1 long: ten swings. What has become of its energy?",
        _spring_growth,
        "Each step multiplies the energy by 1 + 0.1^2 = 1.01, and 1.01 to the power 628 is 517.",
        choices={
            "same": "it is what it was, to a few percent",
            "times 7": "about 7 times what it was",
            "times 500": "about 500 times what it was",
            "lost": "most of it is lost",
        },
        wrong={
            "same": "So it should be. Explicit Euler does not know it.",
            "times 7": "628 steps of one percent each, added: but each step takes its percent of all that the ones "
            "before made.",
            "lost": "A swing that dies down is what friction does. The error of explicit Euler has the other sign.",
        },
    ),
)
