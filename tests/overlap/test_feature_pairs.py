"""Corners, faces, edges and spheres of two bodies by hand; their rates are tested on the moving pairs."""

import numpy as np
import pytest

from course.overlap import FeaturePair

X, Y, Z = np.eye(3)
APART = np.array([[0.2, 0.3, 1.5], [0, 0, 0]])
LEVEL = np.stack([np.eye(3)] * 2)


@pytest.mark.parametrize(
    ("pair", "gap", "normal"),
    [
        (FeaturePair("face_b", -Z, 0.25 * Z, X, Z), 0.25, Z),
        (FeaturePair("face_a", -Z, 0.25 * Z, -Z, X), 0.25, Z),
        (FeaturePair("edges", -Z, 0.25 * Z, X, Y), 0.25, Z),
        (FeaturePair("curved", -Z, 0.25 * Z, X, X, 0.1, 0.2), None, None),
    ],
    ids=lambda value: getattr(value, "kind", ""),
)
def test_gap_and_normal(pair, gap, normal):
    found = pair.contacts(APART, LEVEL)
    if gap is None:  # spheres about (.2, .3, .5) and (0, 0, .25)
        between = np.array([0.2, 0.3, 0.25])
        gap = np.linalg.norm(between) - 0.3
        normal = between / np.linalg.norm(between)
    assert found.separation[0] == pytest.approx(gap, abs=1e-15)
    np.testing.assert_allclose(found.normal[0], normal, atol=1e-15)
    assert found.feature.tolist() == [pair.kind]


def test_edges_meet_where_they_cross():
    """One along x through (.2, .3, .5), the other along y through (0, 0, .25): halfway over (0, .3)."""
    found = FeaturePair("edges", -Z, 0.25 * Z, X, Y).contacts(APART, LEVEL)
    np.testing.assert_allclose(found.point[0], [0, 0.3, 0.375], atol=1e-15)
    np.testing.assert_allclose([found.edge_a[0], found.edge_b[0]], [X, Y])


def test_the_bodies_may_be_turned():
    """A quarter turn of B about y: its face z looks along x."""
    quarter = np.array([[0, 0, 1.0], [0, 1, 0], [-1, 0, 0]])
    turned = np.stack([np.eye(3), quarter])
    found = FeaturePair("face_b", -X, 0 * Z, X, Z).contacts(APART, turned)
    np.testing.assert_allclose(found.normal[0], X, atol=1e-15)
    assert found.separation[0] == pytest.approx(-0.8)


def test_other_words_are_refused():
    with pytest.raises(ValueError, match="kind: expected one of 'face_b'"):
        FeaturePair("corner", X, Y, Z, Z)
