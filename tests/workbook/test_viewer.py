"""The 3D viewer: its solids, its scenes in words and numbers, the picture without a widget, the widget's films."""

import html
import re

import matplotlib.pyplot as plt
import numpy as np
import pytest
from course.workbook.viewer.solids import arrow_triangles, arrow_vertices

from course import rotations
from course.workbook import viewer
from course.workbook.plots.figure import figure_html
from course.workbook.viewer.still import _quartered
from course.workbook.viewer.widget import MOST_FRAMES, camera_of

TIMES = np.linspace(0.0, 2.0, 41)


def turning_box(**options):
    turn = rotations.from_rotation_vector(np.outer(TIMES, [0.0, 0.0, 1.5]))[:, None]
    place = np.stack([TIMES, 0 * TIMES, 1 + 0 * TIMES], axis=-1)[:, None]
    spin = viewer.Arrows(
        "omega", np.broadcast_to([0.0, 0.0, 1.5], (41, 1, 3)), "rad/s", scale=0.5
    )
    given = (
        dict(times=TIMES, arrows=[spin], ground=0.0, caption="A box slides and turns.")
        | options
    )
    return viewer.make_scene(viewer.box([0.3, 0.2, 0.1]), place, turn, **given)


def volume(vertices, triangles):
    """By the divergence theorem; positive where the triangles are anticlockwise from outside."""
    a, b, c = np.moveaxis(vertices[triangles], 1, 0)
    return float(np.sum(np.cross(a, b) * c) / 6)


def edges_match(triangles, vertices):
    """Whether each edge is run through once in each direction; corners at one place count as one."""
    _, same = np.unique(vertices.round(9), axis=0, return_inverse=True)
    corners = same.ravel()[triangles]
    corners = corners[
        [len(set(t)) == 3 for t in corners]
    ]  # at a pole, triangles shrink to an edge
    edges = np.concatenate([corners[:, [0, 1]], corners[:, [1, 2]], corners[:, [2, 0]]])
    there, back = sorted(map(tuple, edges)), sorted(map(tuple, edges[:, ::-1]))
    return there == back


@pytest.mark.parametrize(
    ("solid", "expected", "tolerance"),
    [
        (viewer.box([0.5, 1.0, 1.5]), 6.0, 1e-12),
        (
            viewer.box(
                [0.5, 1.0, 1.5], center=[1, 2, 3], rotation=np.eye(3)[[1, 2, 0]]
            ),
            6.0,
            1e-12,
        ),
        (
            viewer.sphere(2.0, center=[1, 0, 0]),
            4 / 3 * np.pi * 8,
            0.03,
        ),  # what 24 by 12 facets cut off
        (
            viewer.capsule([0, 1, 0], [0, 4, 0], 0.5),
            np.pi * 0.25 * 3 + 4 / 3 * np.pi / 8,
            0.03,
        ),
        (viewer.capsule([1, 1, 1], [1, 1, 1], 0.5), 4 / 3 * np.pi / 8, 0.03),
    ],
)
def test_solids_are_closed_and_face_outward(solid, expected, tolerance):
    assert volume(solid.vertices, solid.triangles) == pytest.approx(
        expected, rel=tolerance
    )
    assert edges_match(solid.triangles, solid.vertices)


def test_a_capsule_lies_about_its_segment():
    solid = viewer.capsule([1.0, 2.0, 3.0], [1.0, 2.0, 7.0], 0.5)
    assert solid.vertices.min(axis=0) == pytest.approx([0.5, 1.5, 2.5])
    assert solid.vertices.max(axis=0) == pytest.approx([1.5, 2.5, 7.5])
    slanted = viewer.capsule([0, 0, 0], [3.0, 4.0, 0.0], 0.1).vertices
    along = np.clip(slanted @ [0.6, 0.8, 0.0], 0.0, 5.0)
    assert np.linalg.norm(
        slanted - along[:, None] * [0.6, 0.8, 0.0], axis=-1
    ) == pytest.approx(0.1)


def test_three_colours_paint_the_pairs_of_faces():
    solid = viewer.box([1.0, 2.0, 3.0], color=("blue", "orange", "sky"))
    for axis, name in enumerate(("blue", "orange", "sky")):
        own = solid.vertices[[c == name for c in solid.colors]]
        assert np.all(np.abs(own[:, axis]) == axis + 1.0) and len(own) == 8


def test_joined_solids_keep_their_triangles():
    one, two = (
        viewer.box([1, 1, 1]),
        viewer.sphere(0.5, center=[0, 0, 3], color="green"),
    )
    both = viewer.joined(one, two, what="lamp")
    assert volume(both.vertices, both.triangles) == pytest.approx(
        volume(one.vertices, one.triangles) + volume(two.vertices, two.triangles)
    )
    assert (
        both.what == "lamp"
        and set(both.colors) == {"blue", "green"}
        and both.reach == pytest.approx(3.5)
    )


def test_arrows_are_closed_end_at_their_tip_and_shrink_to_nothing():
    rng = np.random.default_rng(3)
    origin, arrow = rng.normal(size=(2, 5, 3))
    arrow[4] = 0.0
    vertices = arrow_vertices(origin, arrow, 0.02)
    for i in range(4):
        assert edges_match(arrow_triangles(1), vertices[i])
        assert volume(vertices[i] - origin[i], arrow_triangles(1)) > 0
        far = np.linalg.norm(vertices[i] - origin[i], axis=-1)
        assert vertices[i][far.argmax()] == pytest.approx(origin[i] + arrow[i])
    assert np.abs(vertices[4] - origin[4]).max() == 0.0
    together = vertices.reshape(-1, 3)[arrow_triangles(5)]
    assert together.reshape(5, -1, 3, 3)[2] == pytest.approx(
        vertices[2][arrow_triangles(1)]
    )


def test_a_scene_places_its_bodies():
    scene = turning_box()
    index = scene.index_at(1.0)
    assert scene.times[index] == pytest.approx(1.0)
    turn = rotations.to_matrix(rotations.from_rotation_vector([0.0, 0.0, 1.5]))
    assert scene.vertices(index)[0] == pytest.approx(
        scene.solids[0].vertices @ turn.T + [1.0, 0.0, 1.0]
    )
    assert scene.arrows[0].length[index, 0] == pytest.approx([0.0, 0.0, 0.75])
    assert scene.arrows[0].origin[index, 0] == pytest.approx([1.0, 0.0, 1.0])
    assert scene.bounds[0][2] == 0.0 and scene.bounds[1][0] >= 2.3


def test_the_legend_states_the_scale_and_chooses_one_where_none_is_given():
    assert turning_box().legend() == [("vermillion", "omega: 0.5 m drawn for 1 rad/s")]
    scene = turning_box(
        arrows=[
            viewer.Arrows("force", [[0, 0, 300.0]], "N"),
            viewer.Arrows("n", [[0, 0, 1.0]]),
        ]
    )
    force, normal = scene.arrows
    assert 0.2 * scene.radius < force.length[0, 0, 2] < 1.1 * scene.radius
    assert float(f"{force.scale:.0e}") == force.scale and force.color != normal.color
    assert scene.legend()[0][1] == f"force: {force.scale:.3g} m drawn for 1 N"
    assert scene.legend()[1][1].startswith("n: unit vectors, drawn ")


@pytest.mark.parametrize(
    ("size", "told"),
    [
        (0.0128, "0.4 m drawn for 0.01 kg m²/s"),
        (0.9, "40 m drawn for 1 kg"),
        (0.0, "40 m drawn for 1 kg"),
    ],
)
def test_the_scale_is_told_for_as_much_as_there_is(size, told):
    scene = turning_box(
        arrows=[viewer.Arrows("L", [[0, 0, size]], "kg m²/s", scale=40.0)]
    )
    assert told in scene.legend()[0][1]


def test_the_reach_is_the_farthest_that_anything_comes():
    """The box slides from 0 to 2 m and reaches 0.374 m from its centre; its arrow ends at 1.75 m."""
    half = np.sqrt(0.3**2 + 0.2**2 + 0.1**2)
    scene = turning_box(ground=None)
    low, high = np.array([-half, -half, 1 - half]), np.array([2 + half, half, 1.75])
    assert scene.center == pytest.approx((low + high) / 2)
    tip = np.linalg.norm([1.0, 0.0, 1.75 - scene.center[2]])
    box = np.linalg.norm([1.0, 0.0, 1.0 - scene.center[2]]) + half
    assert scene.reach == pytest.approx(max(tip, box)) and scene.reach < scene.radius


def test_quartered_triangles_cover_what_they_covered():
    solid = viewer.box([0.3, 0.2, 0.1])
    faces = solid.vertices[solid.triangles]
    fine = _quartered(faces)
    area = lambda f: np.cross(f[:, 1] - f[:, 0], f[:, 2] - f[:, 0]) / 2  # noqa: E731
    assert fine.shape == (4 * len(faces), 3, 3)
    assert area(fine).reshape(-1, 4, 3).sum(axis=1) == pytest.approx(area(faces))
    assert area(fine) == pytest.approx(np.repeat(area(faces) / 4, 4, axis=0))


def test_nothing_that_moves_is_a_picture_without_play():
    shown = viewer.show(viewer.sphere(1.0), [[0, 0, 0]])
    assert not shown.scene.moves and not hasattr(shown, "play")
    assert "at " not in shown.scene.description()


def test_the_alternative_text_tells_bodies_time_and_arrows():
    text = turning_box().description(20)
    assert text.startswith("A box slides and turns. ")
    for part in (
        "a box above the ground plane",
        "at 1 s of 0 to 2 s",
        "0.5 m drawn for 1 rad/s",
    ):
        assert part in text
    several = viewer.make_scene(
        [viewer.sphere(1.0), viewer.sphere(1.0), viewer.box([1, 1, 1])],
        np.zeros((3, 3)),
    )
    assert "2 spheres" in several.description() and "a box" in several.description()


def test_a_saved_notebook_gets_a_picture_with_alternative_text():
    shown = viewer.show(turning_box(), still=1.0)
    bundle = shown._repr_mimebundle_()
    assert "application/vnd.jupyter.widget-view+json" in bundle
    alt = html.unescape(
        re.search(
            r'<img alt="([^"]*)" src="data:image/png;base64,', bundle["text/html"]
        ).group(1)
    )
    assert alt == shown.scene.description(20)
    assert bundle["text/plain"].startswith("[3D scene] A box slides")
    assert plt.get_fignums() == []


@pytest.mark.slow
def test_the_picture_is_of_the_moment_asked_for():
    first, later = (
        viewer.show(turning_box()).picture,
        viewer.show(turning_box(), still=1.0).picture,
    )
    assert first != later and later == viewer.show(turning_box(), still=1.0).picture


def test_draw_and_film_draw_into_figures_with_alternative_text():
    ax = viewer.draw(turning_box(), time=0.5)
    assert ax.name == "3d" and (ax.get_xlabel(), ax.get_zlabel()) == ("x [m]", "z [m]")
    figure = viewer.film(
        turning_box(camera="top"), [0.0, 0.5, 1.0, 1.5, 2.0], columns=3
    )
    assert len(figure.axes) == 5
    assert [a.get_title() for a in figure.axes] == [
        "0.00 s",
        "0.50 s",
        "1.00 s",
        "1.50 s",
        "2.00 s",
    ]
    text = figure_html(figure).split('"')[1]
    assert text.count("A box slides and turns.") == 1 and text.endswith(
        "at 0.00, 0.50, 1.00, 1.50, 2.00 s."
    )
    plt.close("all")
    with pytest.raises(ValueError, match="times: expected at least one"):
        viewer.film(turning_box(), [])


def test_the_film_has_the_places_of_its_moments():
    shown = viewer.show(turning_box(), speed=1.0)
    assert list(shown.frames) == list(
        range(41)
    )  # all there are: fewer than 30 a second
    body, arrow = shown.plot.objects[:2]
    assert (
        list(body.model_matrix) == [str(k) for k in range(41)] == list(arrow.vertices)
    )
    matrix = body.model_matrix["20"]
    assert matrix[:3, :3] == pytest.approx(shown.scene.rotation[20, 0], abs=1e-6)
    assert matrix[:3, 3] == pytest.approx([1.0, 0.0, 1.0]) and list(matrix[3]) == [
        0,
        0,
        0,
        1,
    ]
    assert arrow.vertices["20"].max(axis=0)[2] == pytest.approx(1.75)
    assert shown.slider.options[20] == ("1.00 s", 20) and shown.play.max == 40


def test_another_motion_of_the_same_bodies_takes_the_place_of_the_first():
    shown = viewer.show(turning_box(), still=1.0)
    before = shown.picture
    drawn = [id(o) for o in shown.plot.objects]
    place = np.stack([0 * TIMES, TIMES, 1 + 0 * TIMES], axis=-1)[:, None]
    arrows = [viewer.Arrows("omega", np.zeros((41, 1, 3)), "rad/s", scale=0.25)]
    shown.update(
        viewer.make_scene(
            viewer.box([0.3, 0.2, 0.1]), place, times=TIMES, arrows=arrows, ground=0.0
        )
    )
    body, arrow = shown.plot.objects[:2]
    assert drawn == [id(o) for o in shown.plot.objects]
    assert body.model_matrix["20"][:3, 3] == pytest.approx([0.0, 1.0, 1.0])
    assert arrow.vertices["20"] == pytest.approx(
        np.broadcast_to([0.0, 1.0, 1.0], arrow.vertices["20"].shape)
    )
    assert "0.25 m drawn" in shown.children[-1].value and shown.picture != before
    for other in (
        turning_box(arrows=[]),
        viewer.make_scene(viewer.sphere(1.0), [[0, 0, 0]]),
    ):
        with pytest.raises(
            ValueError, match="scene: expected the same number of bodies"
        ):
            shown.update(other)


def test_a_long_or_fine_film_is_thinned_evenly():
    times = np.sort(np.concatenate([np.linspace(0, 50, 4001), [1e-6, 2e-6, 3e-6]]))
    scene = viewer.make_scene(viewer.sphere(1.0), np.zeros((1, 3)), times=times)
    frames = viewer.show(scene).frames
    assert (
        len(frames) == MOST_FRAMES and frames[0] == 0 and frames[-1] == len(times) - 1
    )
    assert np.diff(times[frames]).max() < 50 / (MOST_FRAMES - 1) + 0.013
    slow = viewer.show(turning_box(), speed=0.1)
    assert (
        slow.play.interval == pytest.approx(500, abs=1)
        and "0.1 times real speed" in slow.children[-1].value
    )


def test_camera_presets_look_at_the_middle_from_their_side():
    scene = turning_box()
    sides = {"front": (1, -1), "side": (0, 1), "top": (2, 1)}
    assert set(viewer.CAMERAS) == {*sides, "corner"}
    for name, (axis, sign) in sides.items():
        camera = np.array(camera_of(scene, name))
        assert camera[3:6] == pytest.approx(scene.center)
        away = camera[:3] - scene.center
        assert (
            sign * away[axis] == pytest.approx(np.linalg.norm(away))
            and away[axis] * sign > scene.radius
        )
        assert camera[6:] @ away == pytest.approx(0.0, abs=1e-9)
    shown = viewer.show(scene)
    shown.camera.value = "top"
    assert list(shown.plot.camera) == pytest.approx(camera_of(scene, "top"))


def test_inputs_are_left_alone():
    place, turn = np.zeros((1, 3)), rotations.identity(1)
    viewer.show(viewer.box([1, 1, 1]), place, turn, arrows=[viewer.Arrows("n", place)])
    place += 1.0
    turn *= 2.0


@pytest.mark.parametrize(
    ("change", "message"),
    [
        (
            dict(position=np.zeros((2, 3))),
            r"position: expected shape \(1, 3\); got shape \(2, 3\)",
        ),
        (
            dict(position=np.zeros((3, 1, 3))),
            r"position: expected shape \(1, 3\); got shape \(3, 1, 3\)",
        ),
        (
            dict(position=np.zeros((3, 1, 3)), times=[0.0, 1.0]),
            r"position: .* or \(2, 1, 3\)",
        ),
        (dict(position=None), "position: expected shape"),
        (dict(orientation=[[0, 0, 0, 2.0]]), "orientation: expected unit quaternions"),
        (dict(times=[0.0, 0.0]), "times: expected ascending"),
        (dict(solids="box"), "solids: expected solids"),
        (dict(camera="back"), "camera: expected one of 'corner', 'front'"),
        (dict(arrows=[np.zeros((1, 3))]), r"arrows: expected viewer.Arrows"),
        (
            dict(arrows=[viewer.Arrows("v", np.zeros(3))]),
            r"arrows v: expected shape \(m, 3\) or \(t, m, 3\)",
        ),
        (
            dict(arrows=[viewer.Arrows("v", np.zeros((1, 3)), scale=0.0)]),
            "arrows v, scale: expected a number above 0",
        ),
        (
            dict(arrows=[viewer.Arrows("v", np.zeros((1, 3)), color="pink")]),
            "arrows v, color: expected one of",
        ),
        (dict(speed=0.0), "speed: expected a number above 0"),
        (
            dict(solids=[], position=np.zeros((0, 3))),
            "solids: expected at least one body or arrow",
        ),
    ],
)
def test_what_does_not_fit_is_refused_by_name(change, message):
    given = dict(solids=viewer.box([1, 1, 1]), position=np.zeros((1, 3))) | change
    with pytest.raises(ValueError, match=message):
        viewer.show(given.pop("solids"), given.pop("position"), **given)


@pytest.mark.parametrize(
    ("make", "message"),
    [
        (lambda: viewer.box([1, 1]), "half_extents"),
        (lambda: viewer.box([1, 1, 0]), "half_extents: expected positive"),
        (
            lambda: viewer.box([1, 1, 1], color=("blue", "sky")),
            "color: expected one name or three",
        ),
        (lambda: viewer.box([1, 1, 1], color="pink"), "colors: expected one of"),
        (lambda: viewer.sphere(-1.0), "radius: expected positive"),
        (lambda: viewer.capsule([0, 0], [1, 1, 1], 1.0), "start"),
        (
            lambda: viewer.mesh(np.zeros((3, 3)), [[0, 1, 3]]),
            "triangles: expected whole numbers from 0 to 2",
        ),
        (
            lambda: viewer.mesh(np.zeros((3, 3)), [[0, 1]]),
            r"triangles: expected shape \(f, 3\)",
        ),
        (lambda: viewer.joined(), "solids: expected at least one"),
    ],
)
def test_solids_refuse_what_does_not_fit(make, message):
    with pytest.raises(ValueError, match=message):
        make()
