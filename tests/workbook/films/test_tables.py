"""The pushed table: forces against statics, lifting against the conditions, the picture against both."""

from __future__ import annotations

import numpy as np
import pytest

from course import rotations, study
from course.study.lifted_tables import lifted_table
from course.workbook.films.tables import KNOBS, PRESETS, WINDOW, pushed_table

ENDS = [
    {**{k.name: k.value for k in KNOBS}, k.name: end}
    for k in KNOBS
    for end in (k.low, k.high)
]


def draw(seed):
    rng = np.random.default_rng(seed)
    return {k.name: rng.uniform(k.low, k.high) for k in KNOBS}


CASES = ENDS + [draw(seed) for seed in range(20)]


@pytest.mark.parametrize("values", CASES)
def test_forces_and_accelerations_are_newtons(values):
    """Sum and moments of the ground's forces, weight and push are those of the acceleration."""
    t = lifted_table(**values)
    rising = t.rise + t.slope @ t.centre
    assert t.force.sum() + values["push"] - 9.81 == pytest.approx(rising, abs=1e-9)
    arms = t.feet[:, :2] - t.centre
    moment = t.force @ arms + values["push"] * (t.place - t.centre)
    # About x and y: I_x omega_x' = sum y F, I_y omega_y' = -sum x F; the slope is (-omega_y', omega_x').
    assert moment == pytest.approx([0.3 * t.slope[0], 0.2 * t.slope[1]], abs=1e-9)
    assert t.rise + t.feet[:, :2] @ t.slope == pytest.approx(t.acceleration, abs=1e-9)
    assert t.force.min() >= 0 and t.acceleration.min() > -1e-9
    assert np.abs(t.force * t.acceleration).max() < 1e-9
    assert study.pushed_table(
        **{k: values[k] for k in values if k != "push"}
    ).response == pytest.approx(t.response)


def test_of_all_forces_the_shortest_is_drawn():
    for seed in range(20):
        f = lifted_table(**draw(seed) | {"push": 1.0}).force
        for t in (-1e-3, 1e-3):
            other = f + t * np.array([1, -1, 1, -1])
            assert other.min() < 0 or np.linalg.norm(other) >= np.linalg.norm(f)


def test_what_the_lecturer_is_told_to_try_shows_what_it_says():
    """Key 1: foot 3 presses more for the push; key 2: it does not notice; key 3: it lifts."""
    start = {k.name: k.value for k in KNOBS}
    rest = lifted_table(**start | {"push": 0.0})
    at_foot, on_the_line, harder, centre = (lifted_table(**p.values) for p in PRESETS)
    assert at_foot.force[2] > rest.force[2] and at_foot.response[2] < -0.2
    assert np.all(np.delete(at_foot.force, 2) < np.delete(rest.force, 2))
    assert abs(on_the_line.response[2]) < 0.02
    assert harder.lifting[0] and not harder.lifting[2]
    assert not centre.lifting.any() and centre.response == pytest.approx(np.ones(4))


def test_at_a_foot_the_response_is_its_row_of_A():
    from course.scenes import table

    matrix = table().system().A.toarray()
    for foot, (x, y, _) in enumerate(table().contacts.point):
        assert lifted_table(x, y, 1.0).response == pytest.approx(matrix[foot])


@pytest.mark.parametrize("values", ENDS + [p.values for p in PRESETS])
def test_the_film_moves_feet_as_they_accelerate_and_stays_in_its_window(values):
    film = pushed_table().made(**values)
    t = lifted_table(**values)
    pane = film.panes[0]
    place, times = np.asarray(pane.position), np.asarray(film.times)
    rise = place[:, 2:, 2] - place[0, 2:, 2]
    expected = 0.5 * times[:, None] ** 2 * t.acceleration
    assert np.abs(rise - expected).max() < 0.02 * max(expected.max(), 1e-9) + 1e-9
    turn = rotations.to_matrix(np.asarray(pane.orientation)[-1, 0])
    assert np.degrees(np.arccos(np.clip(turn[2, 2], -1, 1))) < 8
    arrows = {a.name: a for a in pane.arrows}
    assert np.asarray(arrows["force f"].vector)[0, :, 2] == pytest.approx(t.force)
    low, high = np.array(WINDOW)
    assert np.all(place >= low - 0.02) and np.all(place <= high + 0.02)
    assert ("lift" in film.ending or "rises" in film.ending) == bool(t.lifting.any())
    for line in pane.segments:
        for end in (line.start, line.end):
            p = np.asarray(end)[0, 0, :2]
            arm, push = p - t.centre, t.place - t.centre
            assert 1 + arm[1] * push[1] / 0.2 + arm[0] * push[0] / 0.3 == pytest.approx(
                0, abs=1e-9
            )
