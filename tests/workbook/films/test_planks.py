"""The plank: the law of the lever between the feet, lifting beyond, and a plane that stands still."""

from __future__ import annotations

import numpy as np
import pytest

from course.study import plank_forces
from course.workbook.films.planks import HIGH, KNOBS, LOW, PRESETS, plank

PLACES = [-1.5, -0.8, -0.75, -0.3, 0.0, 0.3, 0.75, 0.8, 1.5]


def test_the_places_are_from_end_to_end():
    (knob,) = KNOBS
    assert (knob.low, knob.high) == (PLACES[0], PLACES[-1])


@pytest.mark.parametrize("y", PLACES)
def test_forces_are_those_of_the_lever_or_of_a_plank_that_turns(y):
    """f = W (1/2 -+ c/l) while both carry; else M g I / (I + M r^2) at one foot, about which it turns."""
    film = plank().made(load_at=y)
    found = plank_forces(y)
    c = 20 * y / 30
    shown = {n.name: n.values[0] for n in film.numbers}
    f = np.array([shown["f₁"], shown["f₂"]])
    if abs(c) <= 0.5:
        assert f == pytest.approx(30 * 9.81 * np.array([0.5 - c, 0.5 + c]), abs=1e-6)
        assert "Both feet stay" in film.ending
        return
    inertia = 10 * 9 / 12 + 10 * c**2 + 20 * (y - c) ** 2
    carried = 30 * 9.81 * inertia / (inertia + 30 * (abs(c) - 0.5) ** 2)
    assert f == pytest.approx([0, carried] if y > 0 else [carried, 0], abs=1e-6)
    lifted = found.forces.acceleration.max()
    assert (
        f"The {'left' if y > 0 else 'right'} foot lifts with d̈ = {lifted:.2f}"
        in film.ending
    )


@pytest.mark.parametrize("y", PLACES)
def test_each_step_sets_one_foot_and_the_last_is_near_the_solution(y):
    film = plank().made(load_at=y)
    found = plank_forces(y).forces
    plane = film.charts[0]
    path = np.stack([plane.x, plane.y], axis=1)
    rest = path @ found.matrix.T + found.bias
    for k in range(1, len(path)):
        foot = (k - 1) % 2
        assert path[k, 1 - foot] == path[k - 1, 1 - foot]
        assert abs(rest[k, foot]) < 1e-9 or (path[k, foot] == 0 and rest[k, foot] > 0)
    start, end = np.linalg.norm(path[[0, -1]] - found.force, axis=1)
    assert end < 0.03 * start
    force = next(a for a in film.panes[0].arrows if a.name == "force f")
    assert np.asarray(force.vector)[:, :, 2] == pytest.approx(path)


@pytest.mark.parametrize("y", PLACES)
def test_lines_are_where_an_acceleration_is_0_and_the_plane_stands_still(y):
    found = plank_forces(y).forces
    guides = plank().made(load_at=y).charts[0].guides
    for k, name in enumerate(("d̈₁ = 0", "d̈₂ = 0")):
        line = np.asarray(guides[name])
        assert line @ found.matrix[k] + found.bias[k] == pytest.approx(0, abs=1e-9)
    every = np.concatenate([np.asarray(g) for g in guides.values()])
    assert (every.min(), every.max()) == (LOW, HIGH)
    assert np.all((found.force >= LOW) & (found.force <= HIGH))


def test_the_answer_and_the_presets_say_what_happens():
    assert "lifts" in plank().made(load_at=0.8).ending
    assert "stay" in plank().made(load_at=0.75).ending
    for preset in PRESETS:
        assert ("lift" in preset.label) == (
            "lifts" in plank().made(**preset.values).ending
        )
