"""The predictions of this lesson, and how each is computed."""

from __future__ import annotations

import numpy as np

from course.exercises.definition import Prediction


def _feet() -> str:
    from course.scenes import table

    column = table().system().A.toarray()[1:, 0]
    if np.all(np.abs(column) < 1e-9):
        return "none"
    return "mixed" if column.min() < 0 < column.max() else "all"


def _top() -> float:
    from course.scenes import ladder

    return float(ladder(np.radians(60)).system().A.toarray()[1, 1])


def _legs() -> int:
    from course.scenes import table

    return int(np.linalg.matrix_rank(table(8).system().A.toarray()))


PREDICTIONS = (
    Prediction(
        "feet",
        "The floor pushes up on foot 1 a little harder. What happens at once at the other three feet?",
        _feet,
        "All three feel it: the neighbours rise, and the foot across is driven down, because there the turning is "
        "stronger than the lift.",
        choices={
            "none": "nothing: only foot 1 is pushed",
            "all": "all three begin to rise with it",
            "mixed": "some begin to rise, at least one begins to go down",
        },
        later="See",
        wrong={
            "none": "A table is one body: push it, and all of it but one line at most is accelerated.",
            "all": "The table rises as a whole, that is right. But it also turns about its centre of mass.",
        },
    ),
    Prediction(
        "ladder_diagonal",
        "The same ladder, 10 kg, 4 m, 60 degrees: what is a_22, what a unit of force at the top adds to d_ddot there?",
        _top,
        "The lever of the top is w_2 = 1.732 m, so a_22 = 1/10 + 3/13.33 = 0.325 1/kg: nearly twice a_11.",
        unit="1/kg",
        tolerance=0.01,
        wrong={
            0.1: "That is 1/m, as if the ladder could not turn. The push at the top acts off the centre.",
            0.175: "That is the foot's. At the top the normal is horizontal: another part of the arm lies across it.",
            0.4: "That is the whole arm, 2 m. Only the part of it that lies across N_2 counts: its z.",
            0.225: "That is the turning alone. The centre of mass is accelerated too, by 1/m.",
        },
    ),
    Prediction(
        "eight_legs",
        "A table on eight legs, all on one floor. How many of the eight columns of A are independent (its rank)?",
        _legs,
        "3. All normals are parallel, so the floor can only lift the table and tilt it about two axes. "
        "More legs add columns and nothing new.",
        tolerance=1e-9,
        wrong={
            8: "Each leg has its own column, but they depend on each other: the feet lie in one plane.",
            6: "A body can move in six ways. Pushes that all go up cannot make it slide or turn about the vertical.",
            4: "Three points carry a plane: the fourth foot's acceleration follows from the others.",
        },
    ),
)
