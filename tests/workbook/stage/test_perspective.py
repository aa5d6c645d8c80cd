"""Stills of a view into space: the camera shows the window, far is behind near, shadows fall."""

from __future__ import annotations

import re

import numpy as np
import pytest

from course.workbook import stage
from course.workbook.stage.encoding import encoded
from course.workbook.stage.perspective import LIGHT, eye_of, lit, space_picture
from course.workbook.stage.views import CAMERAS

SIZE = (600.0, 440.0)


def film_of(solids, position, **options):
    view = {k: options.pop(k) for k in ("camera", "ground", "window") if k in options}
    pane = stage.Pane(solids, position, **options)
    return stage.Film([pane], [0.0], stage.Space(**view))


@pytest.mark.parametrize("camera", sorted(CAMERAS))
@pytest.mark.parametrize("high", [(1, 1, 1), (5, 1, 1), (1, 1, 8), (1, 9, 2)])
def test_every_corner_of_the_window_is_seen_and_one_is_near_the_edge(camera, high):
    window = np.array([[-1.0, -1.0, -1.0], high]) + [3.0, -7.0, 20.0]
    film = film_of([stage.ball(0.1)], [[3, -7, 20]], camera=camera, window=window)
    eye = eye_of(film, *SIZE)
    corners = np.array(np.meshgrid(*window.T)).reshape(3, -1).T
    seen = eye.screen(corners) / SIZE
    assert seen.min() > 0 and seen.max() < 1
    assert eye.screen(window.mean(axis=0)) == pytest.approx(np.array(SIZE) / 2)
    assert max(np.ptp(seen[:, 0]), np.ptp(seen[:, 1])) > 0.7


def test_up_is_up_and_near_is_large():
    eye = eye_of(film_of([stage.ball(1.0)], [[0, 0, 0]], camera="front"), *SIZE)
    above, right = eye.screen([0, 0, 0.5]), eye.screen([0.5, 0, 0])
    assert above[1] < SIZE[1] / 2 and right[0] > SIZE[0] / 2
    near, far = np.array([0, -1.0, 0]), np.array([0, 1.0, 0])
    assert eye.pixels(0.1, near) / eye.pixels(0.1, far) == pytest.approx(
        eye.depth(far) / eye.depth(near)
    )


def test_what_is_near_is_painted_last():
    window = ((-2, -2, -2), (2, 2, 2))
    for order in ([0, 1], [1, 0]):
        where = np.array([[0, -1.0, 0], [0, 1.0, 0]])[order]
        colors = np.array(["blue", "orange"])[order]
        film = film_of(
            [stage.box([0.3, 0.3, 0.3], color=str(c)) for c in colors],
            where, camera="front", window=window,
        )  # fmt: skip
        painted = re.findall(
            r'fill="(#\w+)"', space_picture(film, film.panes[0], 0, *SIZE)
        )
        assert painted[0] != painted[-1]
        blue = int(painted[-1][5:], 16) > int(painted[-1][1:3], 16)
        assert blue, "the near one is the blue one"


def test_an_arrow_out_of_a_box_begins_behind_its_face():
    """The piece inside the box is painted before the face in front of it."""
    arrow = stage.Arrows("v", [[0, 0, 2.0]], "m/s", scale=1.0, color="green")
    film = film_of([stage.box([0.5] * 3)], [[0, 0, 0]], arrows=[arrow], camera="front")
    drawn = space_picture(film, film.panes[0], 0, *SIZE)
    pieces = [m.start() for m in re.finditer("<polyline", drawn)]
    faces = [m.start() for m in re.finditer("<polygon", drawn)]
    assert pieces[0] < max(faces) and len(pieces) > 3


def test_a_shadow_falls_along_the_light():
    film = film_of([stage.box([0.2] * 3)], [[0, 0, 3.0]], ground=0.0, camera="top",
                   window=((-3, -3, 0), (3, 3, 4)))  # fmt: skip
    drawn = space_picture(film, film.panes[0], 0, *SIZE)
    shadow = re.search(r'<polygon points="([^"]*)" fill="#d1d1d1"', drawn)
    points = np.array(
        [[float(v) for v in p.split(",")] for p in shadow.group(1).split()]
    )
    expected = np.array([0, 0, 3.0]) - 3.0 / LIGHT[2] * LIGHT
    assert points.mean(axis=0) == pytest.approx(
        eye_of(film, *SIZE).screen(expected), abs=3.0
    )
    assert "#d1d1d1" not in space_picture(
        *(lambda f: (f, f.panes[0]))(film_of([stage.standing(stage.box([0.2] * 3))], [[0, 0, 3.0]], ground=0.0)),
        0, *SIZE,
    )  # fmt: skip


def test_faces_toward_the_light_are_lightest():
    assert (
        lit(-LIGHT)
        > lit(np.array([0, 0, 1.0]))
        > lit(np.array([1.0, 0, 0]))
        > lit(LIGHT)
    )


def test_equal_meshes_are_sent_once_and_flat_films_send_none():
    balls = [stage.ball(0.5), stage.ball(0.5, color="orange"), stage.ball(0.5)]
    film = film_of(balls, np.eye(3))
    sent = encoded(film)["panes"][0]
    assert len(sent["meshes"]) == 2 and [s["mesh"] for s in sent["solids"]] == [0, 1, 0]
    flat = stage.Film([stage.Pane(balls, np.eye(3))], [0.0])
    assert encoded(flat)["panes"][0]["meshes"] == []


def test_a_window_is_checked_and_holds_the_picture_still():
    with pytest.raises(ValueError, match="window: expected lowest < highest"):
        stage.Space(window=((0, 0, 0), (1, 1, 0)))
    with pytest.raises(ValueError, match=r"window: expected shape \(2, 3\)"):
        stage.Space(window=(0, 0, 1))
    window = ((-1, -1, -1), (1, 1, 2))
    for x in (0.0, 0.7):
        film = film_of([stage.ball(0.1)], [[x, 0, 0]], window=window)
        assert film.middle == pytest.approx([0, 0, 0.5])
