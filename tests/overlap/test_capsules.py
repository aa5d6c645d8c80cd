"""Capsules and segments against closed cases, bounded least squares and brute force."""

import itertools

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from overlap.drawn_shapes import (
    capsules,
    depth_inside,
    distance_by_least_squares,
    spheres,
    turns,
)

from course.overlap import (
    capsule_gap,
    closest_point_on_segment,
    sphere_capsule_gap,
    spheres_overlap,
)
from course.overlap.curved.capsules import closest_capsules, closest_sphere_capsule
from course.shapes import Capsule, Sphere


def test_nearest_point_of_a_segment():
    """Beyond both ends, beside it, on it, and of a segment that is a point."""
    points = [[-3, 4, 0], [5, 1, 1], [1, 2, 3], [0.5, 0, 0]]
    found = closest_point_on_segment(points, [0, 0, 0], [2.0, 0, 0])
    assert found.tolist() == [[0, 0, 0], [2, 0, 0], [1, 0, 0], [0.5, 0, 0]]
    assert closest_point_on_segment([7, 8, 9], [1, 2, 3], [1, 2, 3]).tolist() == [
        1,
        2,
        3,
    ]


@pytest.mark.parametrize("function", [capsule_gap, sphere_capsule_gap, closest_point_on_segment])  # fmt: skip
def test_a_wrong_argument_is_named(function):
    point, one = np.zeros(3), 1.0
    count = {capsule_gap: 6, sphere_capsule_gap: 5, closest_point_on_segment: 3}[
        function
    ]
    names = {
        capsule_gap: ["start_a", "end_a", "radius_a", "start_b", "end_b", "radius_b"],
        sphere_capsule_gap: ["center", "radius", "start", "end", "capsule_radius"],
        closest_point_on_segment: ["point", "start", "end"],
    }[function]
    good = [one if "radius" in name else point for name in names]
    for i, name in enumerate(names):
        for bad in (
            ([np.nan] * 3, np.zeros(2)) if "radius" not in name else (-1.0, np.nan)
        ):
            given = [*good[:i], bad, *good[i + 1 :]]
            with pytest.raises(ValueError, match=f"^{name}: "):
                function(*given)
    batches = [np.zeros((2 + i, 3)) if "radius" not in name else one for i, name in enumerate(names)]  # fmt: skip
    with pytest.raises(ValueError, match="broadcasts with"):
        function(*batches[:count])


# The distance is |difference of the nearest points|, by eye.
CLOSED = [
    # Box2D's test of segments: squared distance 4 at parameters (.5, 1).
    ([-1, -1, 0], [-1, 1, 0], [2, 0, 0], [1, 0, 0], 2.0),
    # A public report of a library that answered differently in the two orders.
    ([0, 0, 0], [2, 0, 0], [1, 1, 0], [1, 3, 0], 1.0),
    ([0, 0, 0], [2, 0, 0], [1, -1, 0], [1, 1, 0], 0.0),  # crossing
    ([0, 0, 0], [2, 0, 0], [1, -1, 3], [1, 1, 3], 3.0),  # crossing above
    ([0, 0, 0], [2, 0, 0], [0.5, 2, 0], [1.5, 2, 0], 2.0),  # parallel, beside
    ([0, 0, 0], [2, 0, 0], [5, 4, 0], [6, 4, 0], 5.0),  # parallel, ahead
    ([0, 0, 0], [2, 0, 0], [6, 4, 0], [5, 4, 0], 5.0),  # antiparallel
    ([0, 0, 0], [2, 0, 0], [1, 0, 0], [3, 0, 0], 0.0),  # on one line, overlapping
    ([0, 0, 0], [2, 0, 0], [3, 0, 0], [4, 0, 0], 1.0),  # on one line, apart
    ([0, 0, 0], [0, 0, 0], [3, 4, 0], [3, 4, 0], 5.0),  # two points
    ([1, 3, 0], [1, 3, 0], [0, 0, 0], [2, 0, 0], 3.0),  # a point and a segment
    ([1, 0, 0], [1, 0, 0], [0, 0, 0], [2, 0, 0], 0.0),  # a point on a segment
    ([1, 2, 3], [1, 2, 3], [1, 2, 3], [1, 2, 3], 0.0),  # one point
]


@pytest.mark.parametrize("p, q, r, s, distance", CLOSED)
def test_closed_cases_in_all_orders(p, q, r, s, distance):
    for (a, b), (c, d) in itertools.product(((p, q), (q, p)), ((r, s), (s, r))):
        assert capsule_gap(a, b, 0, c, d, 0) == pytest.approx(distance, abs=1e-15)
        assert capsule_gap(c, d, 0, a, b, 0) == pytest.approx(distance, abs=1e-15)
        found = closest_capsules(Capsule(a, b, 0.25), Capsule(c, d, 0.5))
        assert found.gap == pytest.approx(distance - 0.75, abs=1e-15)
        check_witnesses(found, Capsule(a, b, 0.25), Capsule(c, d, 0.5))


def check_witnesses(found, a, b, tolerance=1e-12):
    """N is a unit vector, the points are on the surfaces, opposite to each other along N."""
    np.testing.assert_allclose(np.linalg.norm(found.normal, axis=-1), 1, rtol=1e-14)
    along = found.point_a - found.point_b
    np.testing.assert_allclose(
        along, found.gap[..., None] * found.normal, atol=tolerance
    )
    np.testing.assert_allclose(depth_inside(a, found.point_a), 0, atol=tolerance)
    np.testing.assert_allclose(depth_inside(b, found.point_b), 0, atol=tolerance)


@pytest.mark.parametrize("seed", [1, 2, 3])
@pytest.mark.slow
def test_drawn_capsules(seed):
    rng = np.random.default_rng(seed)
    a, b = capsules(rng, 300), capsules(rng, 300)
    found = closest_capsules(a, b)
    check_witnesses(found, a, b)
    for i in range(0, 300, 3):
        truth = distance_by_least_squares(a[i], b[i]) - a.radius[i] - b.radius[i]
        assert found.gap[i] == pytest.approx(truth, abs=1e-9)


@pytest.mark.parametrize("seed", [1, 2])
def test_drawn_spheres_and_capsules(seed):
    rng = np.random.default_rng(seed)
    a, b = spheres(rng, 300), capsules(rng, 300)
    found = closest_sphere_capsule(a, b)
    check_witnesses(found, a, b)
    # A sphere is a capsule of length 0.
    short = Capsule(a.center, a.center, a.radius)
    np.testing.assert_allclose(closest_capsules(short, b).gap, found.gap, atol=1e-14)
    np.testing.assert_allclose(
        sphere_capsule_gap(a.center, a.radius, b.start, b.end, b.radius), found.gap
    )


def distance_in_many_digits(p, u, q, v):
    """The distance of two segments with rational numbers, no rounding but that of the last square root."""
    from fractions import Fraction

    def exact(x):
        return [Fraction(float(c)) for c in x]

    def dot(a, b):
        return sum(x * y for x, y in zip(a, b, strict=True))

    p, u, q, v = exact(p), exact(u), exact(q), exact(v)
    w = [x - y for x, y in zip(q, p, strict=True)]
    uu, uv, vv, uw, vw, ww = dot(u, u), dot(u, v), dot(v, v), dot(u, w), dot(v, w), dot(w, w)  # fmt: skip

    def square(s, t):
        return uu * s * s - 2 * uv * s * t + vv * t * t - 2 * s * uw + 2 * t * vw + ww

    def clamp(x):
        return min(max(x, Fraction(0)), Fraction(1))

    tried = [square(Fraction(s), clamp((s * uv - vw) / (vv or 1))) for s in (0, 1)]
    tried += [square(clamp((t * uv + uw) / (uu or 1)), Fraction(t)) for t in (0, 1)]
    determinant = uu * vv - uv * uv
    if determinant:
        s, t = (uw * vv - vw * uv) / determinant, (uw * uv - vw * uu) / determinant
        if 0 < s < 1 and 0 < t < 1:
            tried.append(square(s, t))
    return float(min(tried)) ** 0.5


@pytest.mark.parametrize("angle", [0.0, *10.0 ** np.arange(-16.0, 0.0)])
@pytest.mark.parametrize("height", [0.0, 1e-9, 1e-3, 1.0])
@pytest.mark.slow
def test_nearly_parallel_segments(angle, height):
    """Turned by 1e-16 ... 0.1, crossing one above the other, or not crossing: exact to rounding."""
    rng = np.random.default_rng(int(-np.log10(angle + 1e-17)))
    turn = turns(rng, 1)[0]
    for shift in (0.0, 0.3, 1.7):
        p, u = np.array([-1.0, 0, 0]), np.array([2.0, 0, 0])
        v = 2.2 * np.array([np.cos(angle), np.sin(angle), 0])
        q = np.array([shift, 0, height]) - v / 2
        p, u, q, v = (turn @ x for x in (p, u, q, v))
        ends = p, p + u, q, q + v
        truth = distance_in_many_digits(p, ends[1] - p, q, ends[3] - q)
        assert capsule_gap(*ends[:2], 0, *ends[2:], 0) == pytest.approx(
            truth, abs=2e-15
        )
        assert capsule_gap(*ends[2:], 0, *ends[:2], 0) == pytest.approx(
            truth, abs=2e-15
        )


def test_lengths_of_all_sizes():
    """From 1e-6 to 1e6 in one pair, and 1e8 away: to 1e-15 of the coordinates' differences."""
    rng = np.random.default_rng(5)
    for _ in range(300):
        size = 10.0 ** rng.uniform(-6, 6, 3)
        p, q = rng.normal(size=(2, 3)) * size[2] + rng.choice([0.0, 1e8])
        u, v = rng.normal(size=(2, 3)) * size[:2, None]
        ends = p, p + u, q, q + v
        truth = distance_in_many_digits(p, ends[1] - p, q, ends[3] - q)
        found = capsule_gap(*ends[:2], 0, *ends[2:], 0)
        assert found == pytest.approx(
            truth, abs=4e-16 * (3 * max(size) + abs(p - q).max())
        )


SPOT = st.tuples(
    *[st.sampled_from([0.0, 1.0, -1.0, 0.5, 3.0, 1e-9, 1e6, 1 + 1e-12])] * 3
)


@given(SPOT, SPOT, SPOT, SPOT)
@settings(max_examples=300, deadline=None)
@pytest.mark.slow
def test_segments_that_line_up(p, q, r, s):
    """Equal coordinates everywhere: points, parallels, crossings. Exact to rounding, in both orders."""
    p, q, r, s = (np.array(x) for x in (p, q, r, s))
    truth = distance_in_many_digits(p, q - p, r, s - r)
    size = max(np.abs(q - p).max(), np.abs(r - p).max(), np.abs(s - p).max())
    for given_ in ((p, q, 0, r, s, 0), (r, s, 0, p, q, 0), (q, p, 0, r, s, 0)):
        assert capsule_gap(*given_) == pytest.approx(truth, rel=1e-15, abs=2e-15 * size)


def test_capsules_whose_segments_cross_are_as_deep_as_both_radii():
    """N is across both; A moved along it by the depth only touches."""
    rng = np.random.default_rng(6)
    for _ in range(100):
        u, v = rng.normal(size=(2, 3))
        x, s, t = rng.normal(size=3), *rng.uniform(0.1, 0.9, 2)
        a = Capsule(x - s * u, x + (1 - s) * u, 0.3)
        b = Capsule(x - t * v, x + (1 - t) * v, 0.2)
        found = closest_capsules(a, b)
        assert found.gap == pytest.approx(-0.5, abs=1e-14)
        assert abs(found.normal @ u) < 1e-12 and abs(found.normal @ v) < 1e-12
        moved = a.moved(np.eye(3), -found.gap * found.normal)
        assert closest_capsules(moved, b).gap == pytest.approx(0, abs=1e-13)


def test_a_sphere_on_the_axis_of_a_capsule():
    """The normal is across the axis; upward if the capsule is a sphere about the same centre."""
    found = closest_sphere_capsule(
        Sphere([1, 1, 1], 0.5), Capsule([0, 0, 0], [3, 3, 3], 1)
    )
    assert found.gap == -1.5 and abs(found.normal.sum()) < 1e-15
    same = closest_sphere_capsule(
        Sphere([1, 1, 1], 0.5), Capsule([1, 1, 1], [1, 1, 1], 1)
    )
    assert same.gap == -1.5 and same.normal.tolist() == [0, 0, 1]


def test_touching_spheres_overlap():
    """Closed solids. libccd's sphere-sphere test: hit exactly for 42 <= i <= 58."""
    x = -5 + 0.1 * np.arange(100)
    center = np.stack([x, 0 * x, 0 * x], axis=1)
    hit = np.flatnonzero(spheres_overlap(center, 0.35, [0, 0, 0], 0.5))
    assert hit.tolist() == list(range(42, 59))
    assert spheres_overlap([0, 0, 0], 1.0, [3.0, 0, 0], 2.0)
    assert not spheres_overlap([0, 0, 0], 1.0, [np.nextafter(3.0, 4), 0, 0], 2.0)
