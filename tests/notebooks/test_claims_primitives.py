"""What lesson 02 says in numbers, computed; each number is read from its sentence."""

import numpy as np
import pytest
from lesson_text import rounds_to, said

from course import study
from course.shapes import bounding_sphere, capsule_around
from course.shapes.mesh_makers import dumbbell_mesh
from course.workbook.films.growing_dops import growing_dop
from course.workbook.films.turning_rods import turning_rod

#: Seconds together: left out of the minute's run.
pytestmark = pytest.mark.slow


@pytest.fixture(scope="module")
def costs():
    rows = study.fit_costs(peers=False).table()
    return {(r["method"], int(r["knob"])): r for r in rows}


def test_the_rod_grows_51_fold_and_passes_ten_at_5_degrees():
    (most,) = said("02", "with $q = 0.01$: #. A cube doubles")
    assert rounds_to(study.turned_rod([45.0]).growth[0], most)
    passed, at_45 = said("02", "ten times the volume is passed at #°, and # reached at 45°")  # fmt: skip
    assert rounds_to(study.angle_of_growth(10.0, 0.01), passed)
    assert rounds_to(study.turned_rod([45.0]).growth[0], at_45)


def test_the_rectangle_by_hand():
    (times,) = said("02", "it has # times the area")
    e = np.array([3.0, 2.0, 1.0])
    turned = study.turned_rod([np.degrees(np.arccos(0.8))], e)
    assert rounds_to(turned.growth[0], times)
    assert np.allclose(2 * turned.extents[0, :2], [7.2, 6.8])


def test_thick_rods_grow_less():
    thin, thick, cube = said("02", "falls from # to # for a rod of 10 cm, and to # for a cube")  # fmt: skip
    for said_, thickness in ((thin, 0.01), (thick, 0.1), (cube, 1.0)):
        film = turning_rod().made(thickness=thickness)
        assert rounds_to(film.numbers[1].values[0], said_)


def test_the_dumbbell_in_many_sides():
    diagonal = {"turn": 45.0, "tilt": 35.0}
    six, fourteen, eighteen, between = said(
        "02-more",
        "the box has # times the dumbbell's volume, and 14 sides have #. 18 sides have #: three of their directions, "
        "$(1, -1, 0)$ and the like, are at right angles to $(1, 1, 1)$. In the pose in which the film opens, "
        "26 sides still have #.",
    )
    numbers = [n.values[0] for n in growing_dop().made(**diagonal).numbers]
    for value, written in zip(numbers, (six, fourteen, eighteen), strict=False):
        assert rounds_to(value, written)
    assert rounds_to(growing_dop().made().numbers[3].values[0], between)


def test_the_list_of_the_slides_goes_up_twice():
    told = said(
        "02",
        "from # for the capsule to # for the AABB, and from # for the oriented box to # for 14 sides",
    )
    kinds = study.collider_kinds()
    ratio = {k.name: k.ratio for k in kinds}
    for name, written in zip(
        ("capsule", "AABB", "OBB", "k-DOP, 14 sides"), told, strict=True
    ):
        assert rounds_to(ratio[name], written)
    # In the figure's order, which is the slides'; the half space has no volume.
    assert [k.name for k in kinds][-1] == "half space"
    steps = np.diff([k.ratio for k in kinds][:-1])
    assert np.flatnonzero(steps > 0).tolist() == [1, 3]


def test_two_sides_of_the_turned_rod_s_box_are_as_long():
    (side,) = said("02", "At 45° two sides of its box are # m long")
    extents = study.turned_rod([45.0]).extents[0]
    assert rounds_to(2 * extents[0], side) and rounds_to(2 * extents[1], side)


def test_what_kinds_cost(costs):
    n = len(study.turned_dumbbell().vertices)
    (corners,) = said("02", "of 60 cm, turned in space, has # corners")
    assert int(corners) == n
    air, looks = said("02", "to # at 26 sides and # looks a point")
    assert rounds_to(costs["k-DOP, 14, 18, 26 sides", 26]["error"], air)
    assert costs["k-DOP, 14, 18, 26 sides", 26]["count"] == int(looks) * n
    looks, air, hull = said(
        "02", "takes # looks a point and comes to #, close to the hull's #,"
    )
    assert costs["capsule", 1]["count"] == int(looks) * n
    assert rounds_to(costs["capsule", 1]["error"], air)
    assert rounds_to(costs["convex hull", 1]["error"], hull)
    ratio = costs["convex hull", 1]["count"] / costs["capsule", 1]["count"]
    assert 35 < ratio < 45, "forty times as much"
    assert 7.5 < costs["AABB", 1]["error"] < 8, "nearly eight times as much air"
    (looks,) = said("02", "takes three looks a point, # in all")
    assert costs["AABB", 1]["count"] == 3 * n == int(looks.replace(",", ""))
    front = [
        key
        for key, row in costs.items()
        if not any(
            other["count"] <= row["count"]
            and other["error"] <= row["error"]
            and other is not row
            for other in costs.values()
        )
    ]
    assert front == [("AABB", 1), ("compound of three", 1)], "only these two"
    compound = costs["compound of three", 1]
    assert compound["count"] < 1.2 * costs["AABB", 1]["count"]
    assert compound["error"] == min(r["error"] for r in costs.values())


def test_fewer_numbers_can_be_closer():
    kinds = {k.name: k for k in study.collider_kinds()}
    assert (kinds["capsule"].numbers, kinds["OBB"].numbers) == (7, 15)
    assert kinds["capsule"].ratio < kinds["OBB"].ratio
    assert kinds["compound"].numbers == kinds["OBB"].numbers
    finite = [k.ratio for k in kinds.values()]
    assert kinds["compound"].ratio == min(finite)


def test_the_capsule_and_more_sides_around_the_rod():
    (capsule,) = said("02", "The capsule has # times the rod's volume at every angle")
    found = study.rod_volumes(np.linspace(0, 90, 46), ["capsule", "OBB"])
    assert rounds_to(found["capsule"].max(), capsule)
    assert rounds_to(found["capsule"].min(), capsule)
    assert np.allclose(found["OBB"], 1.0)
    many, few = said("02-more", "26 sides still hold # times the rod's volume, where six hold #.")  # fmt: skip
    found = study.rod_volumes([22.5, 45.0], ["26-DOP", "AABB", "18-DOP"])
    assert rounds_to(found["26-DOP"][0], many) and rounds_to(found["AABB"][0], few)
    assert found["18-DOP"][1] == pytest.approx(1.0), "nothing is lost at 45 degrees"


def test_which_kind_a_scene_needs():
    ratio = {n: study.fitted_volumes(m) for n, m in study.scene_meshes().items()}
    ball = ratio["a ball"]
    assert [k for k in ball if ball[k] < ball["sphere"] - 1e-9] == ["convex_hull"]
    assert ratio["a crate on the floor"]["aabb"] == pytest.approx(1.0)
    (times,) = said("02", "though its AABB has only # times its volume")
    assert ratio["a crate that tumbles"]["aabb"] == pytest.approx(float(times), rel=0.02)  # fmt: skip
    rod = ratio["a rod that tumbles"]
    assert rod["capsule"] < 1.1 and rod["sphere"] > 5000


def test_how_good_ritter_s_sphere_is():
    box, ritter = said("02-more", "# percent too large against #.")
    rows = {(r["method"], int(r["knob"])): r for r in study.sphere_costs().table()}
    assert rounds_to(100 * rows["about the box's middle", 1]["error"], box)
    assert rounds_to(100 * rows["Ritter's", 1]["error"], ritter)
    assert rows["Ritter's", 1]["count"] == rows["about the box's middle", 1]["count"]
    assert 4 <= rows["smallest", 1]["count"] / 200 <= 6, "about five looks a point"
    slow, fast = rows["k steps", 30]["error"], rows["k steps", 300]["error"]
    assert 5 < slow / fast < 20, "as 1/k"
    for n in (5, 20, 100, 500):
        excess = study.ritter_excess(100, points=n, seed=2)
        assert 0.05 < excess.mean() < 0.09 and -1e-12 <= excess.min()
        assert excess.max() < 0.2, "at most a fifth in those tried"


def test_a_corner_near_the_rim_keeps_the_round_end_outside():
    (out,) = said("02-more", "each round end # mm outside of the ball's centre")
    points = dumbbell_mesh().vertices
    found = capsule_around(points)
    assert np.allclose(np.abs([found.start[0], found.end[0]]), 0.2 + float(out) / 1000, atol=4e-4)  # fmt: skip
    assert 0.0998 < found.radius < 0.1, "by a hair"
    # The corner that is met: as far from the end's centre as the radius, and near the rim.
    ahead = points[points[:, 0] > 0.2]
    far = np.linalg.norm(ahead - np.maximum(found.start, found.end), axis=-1)
    met = ahead[np.isclose(far, found.radius, atol=1e-9)]
    assert len(met) and (np.linalg.norm(met[:, 1:], axis=-1) > 0.95 * found.radius).all()  # fmt: skip


def test_few_points_fix_the_smallest_sphere():
    clouds = np.random.default_rng(2).normal(size=(200, 50, 3))
    least = bounding_sphere(clouds)
    away = np.linalg.norm(clouds - least.center[:, None], axis=-1)
    on = np.sum(np.abs(away - least.radius[:, None]) < 1e-9, axis=-1)
    assert set(on.tolist()) == {2, 3, 4}


def test_a_fifth_of_the_points_makes_the_box_half_as_large_again():
    _, principal, faces = study.crowded_boxes([0.2, 0.95])
    assert principal[0] == pytest.approx(1.5, abs=0.06)
    assert principal[1] == pytest.approx(2.0, abs=0.02) and np.allclose(faces, 1.0)


def test_few_degrees_make_a_thin_rod_s_box_large():
    (half,) = said("02", "It rises at once: #° give the thin rod half of the top")
    fifteen, top = study.turned_rod([float(half), 45.0]).growth
    assert fifteen / top == pytest.approx(0.5, abs=0.02)
