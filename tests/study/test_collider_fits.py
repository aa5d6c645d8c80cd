"""Fits and the turning rod: against closed forms, samples, trimesh where it is here."""

import numpy as np
import pytest

from course.shapes import bounding_sphere, capsule_around, oriented_box
from course.study import (
    ROD,
    angle_of_growth,
    crowd_says,
    crowded_boxes,
    fit_costs,
    fitted_volumes,
    predicted_growth,
    ritter_excess,
    rod_volumes,
    turned_dumbbell,
    turned_rod,
)
from course.study.boxed_bodies import BAR, boxed_body, hammer_points
from course.study.collider_fits import PLATE, crowded_plate, sphere_looks


@pytest.mark.slow
def test_the_rod_grows_as_predicted_and_the_cures_do_not():
    degrees = np.linspace(0, 90, 19)
    found = rod_volumes(degrees)
    assert np.allclose(found["AABB"], predicted_growth(degrees, 0.01), rtol=1e-12)
    assert np.allclose(found["AABB"], turned_rod(degrees).growth, rtol=1e-12)
    assert np.allclose(found["OBB"], 1.0) and np.ptp(found["capsule"]) < 1e-7
    # A capsule through the corners: radius sqrt(2)/2 cm about a rod of 1 cm by 1 cm.
    assert found["capsule"][0] == pytest.approx(np.pi / 2, rel=0.02)
    assert found["18-DOP"][9] == pytest.approx(1.0), "it has a direction at 45 degrees"


def test_the_angle_of_a_growth_is_where_the_growth_is_reached():
    for growth in (2.0, 10.0, 40.0):
        theta = angle_of_growth(growth, 0.01)
        assert turned_rod([theta]).growth[0] == pytest.approx(growth)
    assert angle_of_growth(10.0, 0.01) == pytest.approx(5.184, abs=1e-3)
    assert ROD[1] / ROD[0] == pytest.approx(0.01)


def test_the_dumbbell_has_the_volume_of_its_parts():
    """Two balls less their caps, and a bar: pi r^2 (2/3 r)(1 + cos)... within 2 percent."""
    mesh = turned_dumbbell()
    cut = 0.1 * np.sqrt(1 - 0.3**2)
    cap = np.pi * (0.1 - cut) ** 2 * (3 * 0.1 - (0.1 - cut)) / 3
    exact = 2 * (4 / 3 * np.pi * 0.1**3 - cap) + np.pi * 0.03**2 * (0.4 - 2 * cut)
    assert mesh.volume() == pytest.approx(exact, rel=0.03) and mesh.volume() < exact


@pytest.mark.slow
def test_volumes_of_fits_by_what_holds_what():
    ratio = fitted_volumes()
    order = ["compound", "convex_hull", "capsule", "kdop26", "kdop14", "aabb", "sphere"]
    assert [ratio[k] for k in order] == sorted(ratio[k] for k in order)
    # The hull of two balls is a capsule, and the mesh is inside it.
    capsule = np.pi * 0.1**2 * (0.4 + 4 / 3 * 0.1) / turned_dumbbell().volume()
    assert ratio["convex_hull"] < capsule < 1.02 * ratio["capsule"]
    assert ratio["sphere"] == pytest.approx(4 / 3 * np.pi * 0.3**3 / turned_dumbbell().volume())  # fmt: skip


@pytest.mark.slow
def test_what_is_counted():
    measured = fit_costs(peers=False)
    rows = {(r["method"], r["knob"]): r for r in measured.table()}
    n = len(turned_dumbbell().vertices)
    assert rows["AABB", 1.0]["count"] == 3 * n
    counts = [rows["k-DOP, 14, 18, 26 sides", k]["count"] for k in (14.0, 18.0, 26.0)]
    assert counts == [7 * n, 9 * n, 13 * n]
    assert rows["convex hull", 1.0]["count"] > 20 * counts[-1]
    ratio = fitted_volumes()
    assert rows["capsule", 1.0]["error"] == pytest.approx(ratio["capsule"] - 1)


def test_the_rounds_of_the_smallest_sphere_are_few():
    points = np.random.default_rng(0).normal(size=(500, 3))
    looks = sphere_looks(points)
    assert looks % 500 == 0 and 2 <= looks / 500 <= 12


@pytest.mark.slow
def test_trimesh_and_scipy_agree_where_they_are_here():
    pytest.importorskip("trimesh", reason="peers are not installed")
    rows = {r["method"]: r for r in fit_costs().table()}
    assert rows["SciPy, hull"]["error"] == pytest.approx(rows["convex hull"]["error"])
    own = rows["sphere, smallest"]["error"]
    assert rows["trimesh, sphere"]["error"] == pytest.approx(own, rel=1e-6)
    points = turned_dumbbell().vertices
    least = oriented_box(points, method="face_directions").volume()
    theirs = (1 + rows["trimesh, OBB"]["error"]) * turned_dumbbell().volume()
    assert float(least) == pytest.approx(theirs, rel=0.05)


def test_ritter_is_never_smaller_and_seldom_a_quarter_larger():
    excess = ritter_excess(40, points=60, seed=1)
    assert excess.min() >= -1e-12 and np.median(excess) < 0.15
    few = np.random.default_rng(3).normal(size=(20, 3))
    quick, least = bounding_sphere(few, method="ritter"), bounding_sphere(few)
    assert float(quick.radius) >= float(least.radius) - 1e-12


def test_a_crowd_turns_the_principal_axes_as_the_covariance_says():
    shares = [0.0, 0.2, 0.5, 0.8]
    _, principal, faces = crowded_boxes(shares)
    assert np.allclose(principal, crowd_says(shares), rtol=0.01)
    assert np.allclose(faces, 1.0) and principal[-1] > 1.9
    assert np.allclose(np.abs(crowded_plate(0.5)).max(axis=0), PLATE)


def test_the_bar_and_the_hammer_turn_about_their_origin():
    body = boxed_body("support", lambda x, d: x[np.argmax(x @ d)], np.linspace(0, 3, 7), 0.0)  # fmt: skip
    assert np.allclose(np.linalg.norm(body.points, axis=-1), np.linalg.norm(BAR))
    assert body.outside.max() < 1e-12 and body.loose.max() < 1e-12
    turn = np.eye(3)[[1, 2, 0]]
    assert np.allclose(hammer_points(turn), hammer_points(np.eye(3)) @ turn.T)
    assert float(capsule_around(body.points[0]).radius) > 0
