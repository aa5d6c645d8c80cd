"""The mug's colliders: against Qhull's simplices, the library's overlaps, and lengths by hand."""

import numpy as np
import pytest
from scipy.spatial import Delaunay

from course.overlap import overlaps
from course.shapes import Sphere
from course.study import (
    COLLIDERS,
    comparisons,
    filled,
    floor_errors,
    inside,
    marble_distance,
    marble_height,
    mug,
    mug_collider,
    mug_costs,
    probes,
)


@pytest.fixture(scope="module")
def points():
    return probes(3000, seed=2)


def test_the_solid_angle_says_what_simplices_of_the_parts_say(points):
    parts = [Delaunay(part.vertices) for part in mug().parts()]
    by_simplices = np.any([part.find_simplex(points) >= 0 for part in parts], axis=0)
    assert np.array_equal(filled(mug(), points), by_simplices)
    assert 50 < by_simplices.sum() < 500


@pytest.mark.parametrize("kind", COLLIDERS)
@pytest.mark.slow
def test_a_point_is_inside_where_the_library_finds_an_overlap(kind, points):
    shape = mug_collider(kind)
    found = inside(shape, points)
    assert np.array_equal(found, overlaps(Sphere(points, np.full(len(points), 1e-12)), shape))  # fmt: skip
    assert np.all(found[filled(mug(), points)]), "it encloses the mug"


def test_comparisons_by_hand():
    """A box has 6 faces, a prism over 16 corners 18, and a stave of the wall 6."""
    assert [comparisons(mug_collider(k)) for k in COLLIDERS] == [1, 6, 18, 18 + 16 * 6]


@pytest.mark.slow
def test_costs_count_comparisons_and_err_by_the_air(points):
    measured = mug_costs(points, library=False)
    assert measured.count.tolist() == [1, 6, 18, 114]
    tight = [mug().volume() / float(mug_collider(k).volume()) for k in COLLIDERS]
    # Of some hundred points inside, a standard deviation or two.
    assert 1 - measured.error == pytest.approx(tight, abs=0.06)
    assert measured.error[-1] == 0.0


@pytest.mark.slow
def test_the_library_s_verdicts_are_the_same():
    measured = mug_costs(probes(300, seed=3))
    rows = {r["method"]: r["error"] for r in measured.table()}
    for name, error in rows.items():
        assert error == rows[name.split(",")[0]]


@pytest.mark.slow
def test_where_marbles_stop():
    """The mug is 100 mm high with a bottom of 5 mm, its staves' sides 40 cos(pi/16) mm away."""
    assert marble_height("compound") == pytest.approx(0.005, abs=1e-8)
    assert marble_height("hull") == marble_height("box") == pytest.approx(0.1, abs=1e-8)
    ball = mug_collider("sphere")
    assert marble_height("sphere") == pytest.approx(float(ball.center[2] + ball.radius))
    for kind in ("hull", "compound"):
        assert marble_distance(kind) == pytest.approx(0.04 * np.cos(np.pi / 16))
    assert marble_distance("sphere") > marble_distance("box") > 0.04


@pytest.mark.slow
def test_no_collider_is_farther_from_the_floor_than_the_mug():
    errors = {kind: floor_errors(kind, 200) for kind in COLLIDERS}
    assert all(np.all(e > -1e-12) for e in errors.values())
    assert errors["hull"].max() < 1e-9 and errors["compound"].max() < 1e-9
    # A sphere around all of it is off by its radius less the mug's reach, at most.
    assert errors["sphere"].max() < float(mug_collider("sphere").radius)
