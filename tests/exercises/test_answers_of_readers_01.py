"""Wrong answers that readers of lesson 01 gave: each fails with every seed, and what is said of it is true."""

import numpy as np
import pytest

from course.exercises.definition import find_exercise, find_prediction
from course.exercises.explanation import verdict_message
from course.exercises.inputs import answers_of
from course.exercises.verdict import judge
from course.workbook.predicting import _outcome_message

#: Seconds together: left out of the minute's run.
pytestmark = pytest.mark.slow


def told(name, function, seed=None):
    """What is said of an answer; "passed" where it passes."""
    exercise = find_exercise(name)[1]
    cases = exercise.draw(seed)
    verdict = judge(exercise, cases, answers_of(function, exercise, cases))
    said = str(verdict_message(exercise, verdict)).replace("\n", " ")
    return "passed" if verdict.passed else " ".join(said.split())


# contact_state


def written_into(start, dtype=None):
    """The words written one over the other into an array of the first one."""

    def state(gap, gap_rate, slip_speed, tolerance):
        distance, speed = tolerance
        out = np.full(np.shape(gap), start, dtype=dtype)
        out[...] = "resting"
        out[slip_speed > speed] = "sliding"
        out[gap_rate > speed] = "separating"
        out[gap_rate < -speed] = "colliding"
        out[gap < -distance] = "penetrating"
        out[gap > distance] = "apart"
        return out

    return state


def asked_in(*order):
    def state(gap, gap_rate, slip_speed, tolerance):
        distance, speed = tolerance
        asked = {
            "apart": gap > distance,
            "penetrating": gap < -distance,
            "colliding": gap_rate < -speed,
            "separating": gap_rate > speed,
            "sliding": slip_speed > speed,
            "either": np.abs(gap_rate) > speed,
        }
        words = ["colliding" if word == "either" else word for word in order]
        return np.select([asked[word] for word in order], words, default="resting")

    return state


slip_first = asked_in("apart", "penetrating", "sliding", "colliding", "separating")
size_of_rate = asked_in("apart", "penetrating", "either", "separating", "sliding")


# place


def reversed_axes(points, rotation, translation):
    return points @ rotation.T + translation


def matrix_for_each(points, rotation, translation):
    return (rotation @ points[..., None])[..., 0] + translation


def matrix_and_axis(points, rotation, translation):
    return (rotation @ points[..., None])[..., 0] + translation[..., None, :]


def one_axis(points, rotation, translation):
    return points @ np.swapaxes(rotation, -1, -2) + translation[:, None]


def axis_behind(points, rotation, translation):
    return points @ np.swapaxes(rotation, -1, -2) + translation[..., None]


def as_columns(points, rotation, translation):
    return rotation @ points + translation


def looped(points, rotation, translation):
    return np.array([rotation @ point + translation for point in points])


# contact_state that stops


def six_and_no_default(gap, gap_rate, slip_speed, tolerance):
    distance, speed = tolerance
    asked = [gap > distance, gap < -distance, gap_rate < -speed, gap_rate > speed]
    words = ["apart", "penetrating", "colliding", "separating", "sliding", "resting"]
    return np.select([*asked, slip_speed > speed, slip_speed <= speed], words)


def whole_pair(gap, gap_rate, slip_speed, tolerance):
    asked = [gap < -tolerance, gap > tolerance, gap_rate < -tolerance]
    return np.select(asked, ["penetrating", "apart", "colliding"], default="resting")


def pair_above(gap, gap_rate, slip_speed, tolerance):
    return np.select([gap > tolerance], ["apart"], default="resting")


ANSWERS = {
    "cut to 'resting'": ("contact_state", written_into("resting"), "NumPy has cut your words"),
    "cut to 'apart'": ("contact_state", written_into("apart"), "NumPy has cut your words"),
    "cut to a letter": ("contact_state", written_into("", "U1"), "NumPy has cut your words"),
    "slip before rate": ("contact_state", slip_first, "it comes down askew (single)"),
    "slip, and why": ("contact_state", slip_first, "You ask for the slip before the rate"),
    "size of the rate": ("contact_state", size_of_rate, "Compare without abs"),
    ".T and no axis": ("place", reversed_axes, ".T on a batch reverses all axes"),
    "a matrix a point": ("place", matrix_for_each, "rotation[..., None, :, :]"),
    "and an axis": ("place", matrix_and_axis, "rotation[..., None, :, :]"),
    "[:, None]": ("place", one_axis, "right only for a batch of one axis"),
    "[..., None]": ("place", axis_behind, "stands before the last one"),
    "columns": ("place", as_columns, "takes the points for columns"),
    "a loop": ("place", looped, "goes along the first axis"),
    "no default": ("contact_state", six_and_no_default, "a word for what is left"),
    "-tolerance": ("contact_state", whole_pair, "Take it apart first"),
    "> tolerance": ("contact_state", pair_above, "Take it apart first"),
    "//": ("tightness", lambda c, v: v // c, "One slash divides"),
    "float": ("tightness", lambda c, v: float(v) / float(c), "float() takes one number"),
}  # fmt: skip


@pytest.mark.parametrize("seed", [None, 1, 2, 3, 4, 5])
@pytest.mark.parametrize("answer", ANSWERS)
def test_it_fails_and_is_told_why(answer, seed):
    name, function, why = ANSWERS[answer]
    said = told(name, function, seed)
    assert why in said, said
    assert "Right for one, wrong for many" not in said


def test_right_answers_written_otherwise_pass():
    """The cures that the messages name."""

    def with_axes(points, rotation, translation):
        turned = (rotation[..., None, :, :] @ points[..., None])[..., 0]
        return turned + translation[..., None, :]

    for seed in (None, 1, 2, 3):
        whole = written_into("resting", "U11")
        assert told("contact_state", whole, seed) == "passed"
        assert told("place", with_axes, seed) == "passed"


@pytest.mark.parametrize(
    ("name", "answer", "right"),
    [
        ("fixed_tolerance", 50, "it rests"),
        ("fixed_tolerance", 49, ""),
        ("fixed_tolerance", 49.05, ""),
        ("lift", 0.2, "not the least"),
        ("lift", 0.196, "it never rests"),
        ("lift", 0.033, "gravity's comes on top"),
        ("air_in_the_hull", "half", "The wall is thin"),
        ("air_in_the_hull", "most", "The wall is thin"),
        ("lift", 11.81 / 60, ""),
        ("lift", 0.197, ""),
    ],
)
def test_a_prediction_of_an_edge_is_on_its_right_side(name, answer, right):
    """g h is 0.2 m/s at 49.05 steps a second, and 0.197 m/s in the lift."""
    message = _outcome_message(find_prediction(name)[1], answer)
    assert (message.state == "passed") == (right == "")
    assert right in str(message).replace("\n", " ")


def test_missing_brackets_are_named_beside_the_time():
    """s**2 / 2 * g stands for s**2 / (2 * g), or for the speed put in the place of the time."""
    said = told("hidden_drop", lambda s, g: s**2 / 2 * g)
    assert "brackets are missing" in said and "The time is s/g" in said
