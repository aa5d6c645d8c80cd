"""Lesson 16: what students are asked to foretell."""

from __future__ import annotations

import numpy as np

from course.exercises.definition import Prediction


def _what_agrees() -> str:
    """Two solvers on the table, two solutions of a ball between upright walls: what is
    equal every time?
    """
    from course.contact import solve
    from course.scenes import table, wedged_ball

    four, ball = table().system(), wedged_ball(0.0).system()
    legs = [(four, solve(four, method=method).force) for method in ("nnls", "pivot")]
    pairs = [legs, [(ball, np.full(2, t)) for t in (0.0, 3.0)]]
    same_motion = all(
        np.allclose(s.A @ (f - g), 0, atol=1e-9) for (s, f), (_, g) in pairs
    )
    same_sum = all(np.isclose(f.sum(), g.sum()) for (_, f), (_, g) in pairs)
    return "sum" if same_sum else "motion" if same_motion else "nothing"


def _sliding_ladder() -> float:
    from course.contact import solve
    from course.scenes import ladder

    return float(solve(ladder(np.radians(60), rate=-2.0).system()).force[0])


def _sweeps_at_a_mass_ratio() -> float:
    from course.contact.solvers.projected_gauss_seidel import (
        predicted_gauss_seidel_factor,
    )
    from course.scenes import stack

    factor = predicted_gauss_seidel_factor(
        stack(2, corners=1, mass=[1.0, 1000.0]).system().A
    )
    return float(np.log(0.1) / np.log(factor))


PREDICTIONS = (
    Prediction(
        "four_legs",
        "Five correct solvers give different forces for the same four legs. What do they agree on?",
        _what_agrees,
        "Every correct answer leads to the same d_ddot, in every scene. On this table the sum is the same as well; for "
        "a ball between two walls not even that.",
        choices={
            "nothing": "on nothing: at most one of the five is right",
            "sum": "on the sum of the forces, in every scene",
            "motion": "on how every contact accelerates, in every scene",
        },
        later="Where it breaks",
        wrong={
            "nothing": "All five satisfy the three conditions (residuals below 1e-6), which say no more.",
            "sum": "On this table, yes. Two walls that press a ball with t each may do so with any t.",
        },
    ),
    Prediction(
        "ladder_foot",
        "The ladder of 10 kg at 60 degrees slides so fast (2 rad/s) that the wall would have to pull. With what force "
        "does the floor push?",
        _sliding_ladder,
        "The wall lets go, f_2 = 0, and the floor alone keeps the foot: f_1 = -b_1/a_11 = 2.882/0.175.",
        unit="N",
        tolerance=0.01,
        wrong={
            10.43: "That is what the floor pushes with while the wall pulls. Without the wall it has another load: "
            "setting a force to 0 after solving is not enough.",
            79.7: "That is the floor's force on the ladder just let go. Now it slides: b is another, and the wall lets "
            "go.",
            0.0: "Without a force at the foot d_ddot_1 = b_1 < 0: the foot falls through the floor.",
            98.1: "That is the weight. The foot is at the end of a turning ladder, not under its centre.",
        },
    ),
    Prediction(
        "sweeps",
        "A box of 1,000 kg lies on one of 1 kg. How many sweeps of projected Gauss-Seidel does one more digit take?",
        _sweeps_at_a_mass_ratio,
        "A sweep shrinks the error by R/(1 + R) = 1000/1001; (1000/1001)^2304 = 0.1.",
        tolerance=0.3,
        wrong={
            1: "For two contacts it looks easy. Each sweep hands the lower box only a thousandth of what is missing.",
            1000: "The right order: the error falls by a thousandth each sweep. A digit is 2.3 times that.",
        },
    ),
)
