"""What lesson 01 says in numbers, computed; each number is read from its sentence."""

import numpy as np
import pytest
from lesson_text import rounds_to, said

from course import formulas
from course.study import (
    COLLIDERS,
    comparisons,
    filled,
    floor_errors,
    highest_hidden_drop,
    inside,
    mug,
    mug_collider,
    probes,
    share_without_rest,
    step_tolerance,
    stepped_box,
)

#: Seconds together: left out of the minute's run.
pytestmark = pytest.mark.slow


def end_of(speed):
    tolerance = step_tolerance(speed, 60.0)
    return stepped_box(formulas.contact_state, tolerance=tolerance)


def test_the_step_of_gravity():
    (each,) = said("01", "- g h = -9.81/60 = -#$ m/s.")
    assert rounds_to(9.81 / 60, each)
    (half,) = said("01", "the rate is reversed and halved, $+#$ m/s.")
    assert rounds_to(0.5 * 9.81 / 60, half)


def test_where_the_boxes_of_the_film_come_to_rest():
    (second,) = said("01", "with twice $g h$ the box rests # mm above")
    assert rounds_to(1000 * end_of(0.33).gap[-1], second)
    third, within = said(
        "01",
        "it hangs # mm above the floor, because it was called resting as soon as it "
        "came within # mm",
    )
    assert rounds_to(1000 * end_of(4.0).gap[-1], third)
    assert rounds_to(1000 * step_tolerance(4.0, 60.0)[0], within)
    assert end_of(0.05).share("resting", 0.5) == 0.0


def test_twice_g_h_is_enough_for_half_the_speed_and_livelier_bodies_need_more():
    said(
        "01",
        "after each bounce, twice $g h$ is enough for all of them; livelier bodies need more",
    )
    options = dict(steps_per_second=60, drops=np.linspace(0.01, 0.5, 400), duration=6.0)
    twice = [2 * 9.81 / 60]
    assert share_without_rest(twice, **options)[0] == 0.0
    assert share_without_rest(twice, restitution=0.8, **options)[0] > 0.5
    assert share_without_rest([1.5 * 9.81 / 60], **options)[0] > 0.5


def test_the_sizes_of_the_mug():
    high, wide, thick = said(
        "01", "# cm high and # cm wide, wall and bottom # mm thick"
    )
    points = 100 * mug().vertices
    across = points.max(axis=0) - points.min(axis=0)
    assert across == pytest.approx([float(wide), float(wide), float(high)], abs=1e-6)
    radius = np.unique(np.round(np.hypot(points[:, 0], points[:, 1]), 6))
    levels = np.unique(np.round(points[:, 2], 6))
    assert 10 * (radius[-1] - radius[-2]) == pytest.approx(float(thick))
    assert 10 * (levels[1] - levels[0]) == pytest.approx(float(thick))


def test_edges_that_the_steps_make():
    (edge,) = said("01", "at 240 steps a second the edge is at # m/s")
    assert rounds_to(9.81 / 240, edge)
    low, high = said("01", "the safe choice is between twice $g h$, # m/s, and # m/s")
    assert rounds_to(2 * 9.81 / 60, low) and rounds_to(np.sqrt(2 * 9.81 * 0.01), high)
    (hidden,) = said("01", "with 240 a second, twice $g h$ hides # mm")
    assert rounds_to(1000 * formulas.hidden_drop(2 * 9.81 / 240, 9.81), hidden)


def test_dots_below_the_formula_and_where_they_pass_ten_millimetres():
    there, low, high = said(
        "01",
        "on the dotted line they are at # mm, and pass 10 mm at # to # m/s",
    )
    speeds = np.array([0.4429, float(low), float(high)])
    drops = [1000 * highest_hidden_drop(s, steps_per_second=60) for s in speeds]
    assert rounds_to(drops[0], there) and drops[1] < 10 < drops[2]
    said("01", "once a step, and never above the formula")
    for s in np.geomspace(0.17, 3.0, 25):
        lies = highest_hidden_drop(s, steps_per_second=60)
        assert lies <= formulas.hidden_drop(s, 9.81)


def test_comparisons_and_tightness():
    one, six, hull, first, last = said(
        "01", "the work grows from # to # to # comparisons, and the tightness from # to #"
    )  # fmt: skip
    counts = [comparisons(mug_collider(kind)) for kind in COLLIDERS]
    assert counts[:3] == [int(one), int(six), int(hull)]
    tight = [mug().volume() / float(mug_collider(kind).volume()) for kind in COLLIDERS]
    assert rounds_to(tight[0], first) and rounds_to(tight[2], last)
    (all_parts,) = said("01", "The compound takes # comparisons and has no air")
    assert counts[3] == int(all_parts) and tight[3] == pytest.approx(1.0)


def test_points_in_the_hull_that_are_in_the_clay():
    right, wrong = said(
        "01",
        "of points spread evenly in the hull, # in 100 are in the clay. Of the other # "
        "the program says",
    )
    assert int(right) + int(wrong) == 100
    points = probes(20_000, seed=1)
    clay = filled(mug(), points)
    for kind in COLLIDERS:
        shape = mug_collider(kind)
        share = clay[inside(shape, points)].mean()
        assert share == pytest.approx(mug().volume() / float(shape.volume()), abs=0.01)
        if kind == "hull":
            assert rounds_to(100 * share, right)


def test_what_a_tolerance_of_one_metre_a_second_hides():
    (hidden,) = said("01", "By your formula whatever falls up to # mm lands")
    assert rounds_to(1000 * formulas.hidden_drop(1.0, 9.81), hidden)


def test_the_box_is_tighter_than_the_sphere_and_a_little_worse_over_a_floor():
    said("01", "The box, though tighter than the sphere, is a little worse there")
    sphere, box = (floor_errors(kind).mean() for kind in ("sphere", "box"))
    assert sphere < box < 1.2 * sphere and floor_errors("hull").max() < 1e-9
