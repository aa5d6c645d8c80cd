"""The Contacts class: its fields, its checks, picking and joining."""

from dataclasses import fields

import numpy as np
import pytest

from course.overlap import Contacts


def some(count=3, **more):
    fields = dict(
        body_a=np.arange(count),
        body_b=np.arange(count) + 1,
        point=np.arange(3.0 * count).reshape(count, 3),
        normal=np.tile([0.0, 0.0, 1.0], (count, 1)),
        separation=np.linspace(-0.1, 0.1, count),
    )
    return Contacts(**{**fields, **more})


def test_point_lies_halfway_and_separation_comes_back():
    contacts = some()
    apart = np.sum((contacts.point_a - contacts.point_b) * contacts.normal, axis=-1)
    assert np.allclose(apart, contacts.separation)  # d = (p_A - p_B).N, syllabus row 19
    assert np.allclose(0.5 * (contacts.point_a + contacts.point_b), contacts.point)


def test_feature_is_a_face_of_b_when_nothing_is_said():
    contacts = some()
    assert contacts.feature.tolist() == ["face_b"] * 3
    assert (
        contacts.edge_a is None
        and contacts.curvature_b is None
        and contacts.pair is None
    )


def test_picking_by_mask_indices_slice_and_int():
    contacts = some(pair=[7, 8, 9])
    assert contacts[np.array([True, False, True])].pair.tolist() == [7, 9]
    assert contacts[[2, 0]].body_a.tolist() == [2, 0]
    assert len(contacts[1:]) == 2 and len(contacts[-1]) == 1 and len(contacts[[]]) == 0
    with pytest.raises(
        ValueError, match=r"contacts\[mask\]: expected shape \(3,\); got shape \(2,\)"
    ):
        contacts[[True, False]]
    with pytest.raises(ValueError, match="a mask, whole numbers or a slice"):
        contacts[0.5]


def test_an_index_selects_the_optional_fields_too():
    rng = np.random.default_rng(0)
    curvature = rng.normal(size=(3, 3, 3))
    contacts = some(
        feature=["edges", "curved", "face_a"],
        edge_a=rng.normal(size=(3, 3)),
        edge_b=rng.normal(size=(3, 3)),
        curvature_a=curvature + np.swapaxes(curvature, 1, 2),
        curvature_b=np.zeros((3, 3, 3)),
        pair=[7, 8, 9],
        key=np.arange(12).reshape(3, 4),
    )
    picked = contacts[[2, 0]]
    for field in fields(Contacts):
        rows = getattr(contacts, field.name)[[2, 0]]
        assert np.array_equal(getattr(picked, field.name), rows)
    everything = contacts[:]
    assert not np.shares_memory(everything.point, contacts.point)
    with pytest.raises(IndexError, match=r"contacts\[...\]: expected an index below 3"):
        contacts[3]


def test_sides_are_those_of_a_and_of_b():
    contacts = some()
    side_a, side_b = contacts.sides
    assert np.array_equal(side_a.body, contacts.body_a) and side_a.sign == 1.0
    assert np.array_equal(side_b.body, contacts.body_b) and side_b.sign == -1.0
    # d = (p_A - p_B).N, syllabus row 19
    apart = sum(sign * point for _, point, sign in contacts.sides)
    assert np.allclose(apart, contacts.separation[:, None] * contacts.normal)


def test_concatenate_fills_what_a_part_lacks_with_nan():
    edges = some(
        2,
        feature=["edges", "face_a"],
        edge_a=[[1, 0, 0], [0, 0, 0]],
        edge_b=[[0, 1, 0], [0, 0, 0]],
    )
    curved = some(
        1,
        feature=["curved"],
        curvature_a=np.eye(3)[None],
        curvature_b=np.zeros((1, 3, 3)),
    )
    joined = Contacts.concatenate([some(), edges, curved])
    assert joined.feature.tolist() == ["face_b"] * 3 + ["edges", "face_a", "curved"]
    assert np.isnan(joined.edge_a[:3]).all() and joined.edge_a[3].tolist() == [1, 0, 0]
    assert (
        np.array_equal(joined.curvature_a[5], np.eye(3))
        and np.isnan(joined.curvature_a[:5]).all()
    )
    again = joined[3:]
    assert again.edge_b[0].tolist() == [0, 1, 0]


def test_concatenate_keeps_pair_only_if_every_part_has_it():
    both = Contacts.concatenate([some(pair=[0, 0, 1]), some(pair=[2, 2, 2])])
    assert both.pair.tolist() == [0, 0, 1, 2, 2, 2]
    assert Contacts.concatenate([some(pair=[0, 0, 1]), some()]).pair is None
    with pytest.raises(
        ValueError, match="parts: expected at least one Contacts; got none"
    ):
        Contacts.concatenate([])
    with pytest.raises(ValueError, match=r"parts\[1\]: expected Contacts; got int"):
        Contacts.concatenate([some(), 3])


def test_concatenate_keeps_keys_only_if_every_part_has_them():
    key = np.arange(12).reshape(3, 4)
    both = Contacts.concatenate([some(key=key), some(2, key=key[:2] + 20)])
    assert both.key.tolist() == [*key.tolist(), *(key[:2] + 20).tolist()]
    assert both[[4, 0]].key.tolist() == [[24, 25, 26, 27], [0, 1, 2, 3]]
    assert Contacts.concatenate([some(key=key), some()]).key is None


def test_arrays_of_a_loop_are_taken_as_they_are():
    checked = some(key=np.zeros((3, 4), dtype=int))
    given = {f.name: getattr(checked, f.name) for f in fields(Contacts)}
    given["point"] = np.ones((3, 3))
    loose = Contacts.unchecked(**given)
    assert loose.point is given["point"] and loose.pair is None
    with pytest.raises(ValueError, match="read-only"):
        loose.point[0] = 2


def test_fields_are_copies_that_cannot_be_written():
    point = np.zeros((3, 3))
    contacts = some(point=point)
    point[0] = 1
    assert not contacts.point.any()
    with pytest.raises(ValueError, match="read-only"):
        contacts.normal[0, 0] = 1


@pytest.mark.parametrize(
    "fields, message",
    [
        (dict(body_b=[0, 2, 3]), r"body_b: expected another body than body_a; got body 0 twice in entry 0"),
        (dict(body_a=[-1, 1, 2]), "body_a: expected whole numbers from 0; got -1"),
        (dict(body_a=[0.0, 1.0, 2.0]), "body_a: expected whole numbers"),
        (dict(body_b=[1]), r"body_b: expected shape \(3,\); got shape \(1,\)"),
        (dict(body_a=[[0, 1, 2]]), r"body_a: expected shape \(c,\)"),
        (dict(normal=np.tile([0.0, 0.0, 2.0], (3, 1))), "normal: expected unit vectors"),
        (dict(normal=[0.0, 0.0, 1.0]), r"normal: expected shape \(3, 3\); got shape \(3,\)"),
        (dict(point=np.full((3, 3), np.nan)), "point: expected finite vectors"),
        (dict(separation=[0.0, np.inf, 0.0]), "separation: expected finite real numbers"),
        (dict(separation=0.0), r"separation: expected shape \(3,\)"),
        (dict(feature=["face_b", "face", "face_b"]), "feature: expected one of 'face_b', .*; got 'face'"),
        (dict(feature=["edges"] * 3), "edge_a: expected an array, as a feature is 'edges'; got None"),
        (dict(feature=["curved"] * 3), "curvature_a: expected an array, as a feature is 'curved'; got None"),
        (
            dict(feature=["edges"] * 3, edge_a=np.zeros((3, 3)), edge_b=np.ones((3, 3))),
            "edge_a: expected directions that are not zero",
        ),
        (
            dict(feature=["curved"] * 3, curvature_a=[np.eye(3, k=1)] * 3, curvature_b=np.zeros((3, 3, 3))),
            "curvature_a: expected symmetric tensors",
        ),
        (dict(pair=[0, 1]), r"pair: expected shape \(3,\)"),
        (dict(key=np.zeros((3, 3), dtype=int)), r"key: expected shape \(3, 4\); got shape \(3, 3\)"),
        (dict(key=np.full((3, 4), -1)), "key: expected whole numbers from 0; got -1"),
        (dict(key=np.zeros((3, 4))), "key: expected whole numbers from 0"),
    ],
)  # fmt: skip
def test_refuses(fields, message):
    with pytest.raises(ValueError, match=message):
        some(**fields)


def test_data_of_features_nobody_reads_is_not_checked():
    contacts = some(edge_a=np.full((3, 3), np.nan), edge_b=np.zeros((3, 3)))
    assert np.isnan(contacts.edge_a).all()


def test_no_contact_is_a_valid_answer():
    empty = some(0)
    assert len(empty) == 0 and len(Contacts.concatenate([empty, some()])) == 3


def test_bodies_that_are_not_there_are_refused():
    one = Contacts(
        np.array([0, 4]), np.array([1, 2]), np.zeros((2, 3)), np.eye(3)[[2, 2]], np.zeros(2)
    )  # fmt: skip
    one.require_bodies(5)
    with pytest.raises(
        ValueError, match="contacts.body_a: .* 0 to 3; got 4 in entry 1"
    ):
        one.require_bodies(4)
    with pytest.raises(ValueError, match="contacts.body_a: .* none exists"):
        one.require_bodies(0)
