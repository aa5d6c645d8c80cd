"""Every film in a real browser, at both ends of every knob: nothing written covers anything else written."""

from dataclasses import replace

import numpy as np
import pytest
from browser.session import ROOT, chromium, page

from course import rotations
from course.workbook.films.listing import LISTED
from course.workbook.stage import (
    Arrows,
    Exhibit,
    Film,
    Flat,
    Pane,
    Space,
    as_exhibit,
    ball,
    box,
    labelled,
)
from course.workbook.stage import page as html_page
from course.workbook.stage.encoding import encoded

pytestmark = [
    pytest.mark.browser,
    pytest.mark.skipif(
        chromium() is None, reason="no Chromium or Chrome on this machine"
    ),
]
pytest.importorskip("playwright", reason="the extra 'browser' is not installed")

PARTS = (0.0, 0.25, 0.5, 1.0)
SIZES = {
    "a lecture room": (True, 1920, 1080),
    "an old projector": (True, 1280, 800),
    "a notebook": (False, 1280, 900),
    "half a screen": (False, 800, 900),
}


def values_of(exhibit):
    """What is tried of an exhibit, by name: the ends of each knob, and the presets."""
    yield "as it begins", {}
    for knob in exhibit.knobs:
        yield f"{knob.name} = {knob.low:g}", {knob.name: knob.low}
        yield f"{knob.name} = {knob.high:g}", {knob.name: knob.high}
    for preset in exhibit.presets:
        yield preset.label, dict(preset.values)


def opened_film(opened, exhibit, path, *, large):
    """The exhibit's page without the presets' films, which are handed to it one by one."""
    path.write_text(html_page(replace(exhibit, presets=()), large=large), "utf-8")
    opened.add_init_script(path=ROOT / "tests" / "browser" / "texts.js")
    opened.goto(path.as_uri())
    opened.wait_for_function("window.stage && window.stage.root.paints > 0")


@pytest.mark.parametrize("size", SIZES)
@pytest.mark.parametrize("listed", LISTED, ids=lambda f: f.name)
def test_no_text_covers_another_at_either_end_of_any_knob(listed, size, tmp_path):
    large, width, height = SIZES[size]
    exhibit = listed.exhibit()
    wrong = []
    with page(width, height) as opened:
        opened_film(opened, exhibit, tmp_path / "film.html", large=large)
        for name, values in values_of(exhibit):
            film = encoded(exhibit.made(**values))
            found = opened.evaluate(
                "([film, parts, least]) => { stage.receive(film, null); return faults(parts, least); }",
                [film, PARTS, 28 if large else 12],
            )
            wrong += [f"{name}, {words}" for words in found]
        errors = opened.console_errors
    assert not wrong, "\n".join(dict.fromkeys(wrong))
    assert errors == []


def test_what_is_wrong_would_be_found(tmp_path):
    """Two labels at one place, one outside, small letters, a wide page: each is named."""
    pane = Pane(
        [labelled(ball(0.1), "first"), labelled(ball(0.1), "second")],
        [[0.0, 0.0, 0.0], [0.001, 0.0, 0.0]],
    )
    exhibit = Exhibit(lambda: Film([pane], [0.0], Flat("xz", (-1.0, -1.0, 1.0, 1.0))))
    drawn = """() => { const { canvas } = stage.pictures[0]; const paint = stage.paint.bind(stage);
      stage.paint = () => { paint(); const c = canvas.getContext("2d"); c.font = "9px serif";
        c.fillText("outside", canvas.clientWidth - 5, 50);
        c.fillText("third", 100, 100); c.fillText("fourth", 104, 104); };
      const wide = document.createElement("p"); wide.style.width = "3000px"; wide.append("wide");
      document.body.append(wide); }"""
    with page(900, 700) as opened:
        opened_film(opened, exhibit, tmp_path / "film.html", large=False)
        assert opened.evaluate("faults([0], 12)") == []
        opened.evaluate(drawn)
        found = "\n".join(opened.evaluate("faults([0], 12)"))
    assert '"fourth" over "third"' in found and '"outside" leaves its picture' in found
    assert '"third" is 9 px high' in found and "px wide in 900" in found


def test_a_label_over_an_arrow_and_one_that_is_missing_would_be_found(tmp_path):
    push = Arrows("push", [[1.0, 0.0, 0.0]], "N", scale=0.5, numbers=True)
    pane = Pane([ball(0.1)], [[0.0, 0.0, 0.0]], arrows=[push])
    exhibit = Exhibit(lambda: Film([pane], [0.0], Flat("xz", (-1.0, -1.0, 1.0, 1.0))))
    moved = """() => { const paint = stage.paint.bind(stage);
      stage.paint = () => { paint(); const { drawn } = stage.pictures[0]; const [x, y, a, b] = drawn.lines[0];
        const [u, v] = [(x + a) / 2, (y + b) / 2];
        drawn.labels = [{ text: "1 N", box: [u - 9, v - 9, u + 9, v + 9] }]; drawn.wanted = 3; }; }"""
    with page(900, 700) as opened:
        opened_film(opened, exhibit, tmp_path / "film.html", large=False)
        assert opened.evaluate("faults([0], 12)") == []
        opened.evaluate(moved)
        found = "\n".join(opened.evaluate("faults([0], 12)"))
    assert '"1 N" over an arrow' in found
    assert "2 of 3 labels of picture 0 are not there" in found


#: How many pixels of the picture's middle have the trail's colour: the ball has gone to the right.
REDDISH = """() => { const c = stage.pictures[0].canvas; const { width, height } = c; let n = 0;
  const d = c.getContext("2d").getImageData(0.45 * width, 0, 0.1 * width, height).data;
  for (let i = 0; i < d.length; i += 4) n += d[i] - d[i + 2] > 60;
  return n; }"""


def test_a_trail_in_space_is_hidden_by_what_is_before_it(tmp_path):
    """A ball goes past behind a box, seen from the front: its line is seen above the box and not through it."""
    way = np.linspace(-1.0, 1.0, 41)
    for height, through in ((0.0, False), (1.2, True)):
        place = np.zeros((41, 2, 3))
        place[:, 0, 0], place[:, 0, 1], place[:, 0, 2] = way, 1.0, height
        pane = Pane(
            [ball(0.05, color="vermillion"), box((0.5, 0.3, 0.5), color="blue")],
            place,
            trails=[0],
        )
        exhibit = Exhibit(
            lambda pane=pane: Film(
                [pane],
                np.linspace(0.0, 1.0, 41),
                Space("front", window=[[-2, -2, -2], [2, 2, 2]]),
            )
        )
        with page(900, 700) as opened:
            opened_film(opened, exhibit, tmp_path / "film.html", large=False)
            opened.evaluate("stage.clock.seek(1)")
            opened.wait_for_timeout(800)
            seen = opened.evaluate(REDDISH)
        assert (seen > 50) == through, f"{seen} pixels of the trail before the box"


def test_panes_stand_at_one_height_however_long_their_titles_are(tmp_path):
    """Many balls bounce beside each other, to be compared: at no width does a title push one picture down."""
    exhibit = next(f for f in LISTED if f.name == "many_balls").exhibit()
    for width, large in ((800, False), (1280, True)):
        with page(width, 800) as opened:
            opened_film(opened, exhibit, tmp_path / "film.html", large=large)
            tops = [
                c.bounding_box()["y"] for c in opened.locator(".panes canvas").all()
            ]
        assert len(tops) == 3 and max(tops) - min(tops) < 1


@pytest.mark.parametrize("width", [390, 800, 1280, 1920])
def test_the_exported_page_plays_without_a_network(width, tmp_path):
    path = tmp_path / "impulse.html"
    path.write_text(html_page(next(f for f in LISTED if f.name == "impulse").exhibit()))
    with page(width, 800) as opened:
        opened.context.set_offline(True)
        opened.goto(path.as_uri())
        opened.wait_for_function("window.stage && window.stage.root.paints > 0")
        for control in opened.locator("button:visible, input:visible").all():
            control.scroll_into_view_if_needed()
            box = control.bounding_box()
            assert box["x"] >= 0 and box["x"] + box["width"] <= width
        opened.get_by_role("button", name="they stick").click()
        opened.wait_for_function("stage.clock.time === stage.clock.last")
        opened.get_by_role("cell", name="2.67 N s").wait_for(state="visible")
        opened.get_by_role("button", name="answer").click()
        assert opened.locator(".answer").is_visible()
        scrolls = "document.documentElement.scrollWidth <= innerWidth"
        assert opened.evaluate(scrolls)
        assert opened.console_errors == []


def test_it_follows_the_system_into_the_dark(tmp_path):
    path = tmp_path / "handle.html"
    path.write_text(html_page(next(f for f in LISTED if f.name == "handle").exhibit()))
    theme = "document.querySelector('.stage').dataset.theme === '%s'"
    with page() as opened:
        opened.emulate_media(color_scheme="light", reduced_motion="reduce")
        opened.goto(path.as_uri())
        for scheme in ("light", "dark", "light"):
            opened.emulate_media(color_scheme=scheme)
            opened.wait_for_function(theme % scheme)
        assert opened.evaluate("stage.clock.time") == 0, "it began by itself"


@pytest.mark.parametrize(("name", "scrolled"), [("impulse", True), ("handle", False)])
def test_a_finger_scrolls_past_a_flat_picture_and_turns_one_in_space(
    name, scrolled, tmp_path
):
    path = tmp_path / "film.html"
    path.write_text(html_page(next(f for f in LISTED if f.name == name).exhibit()))
    with page(390, 800) as opened:
        phone = opened.context.browser.new_context(
            viewport={"width": 390, "height": 500}, has_touch=True, is_mobile=True
        )
        tab = phone.new_page()
        tab.goto(path.as_uri())
        tab.wait_for_function("window.stage && window.stage.root.paints > 0")
        before = tab.evaluate("stage.pictures[0].camera?.yaw ?? 0")
        box = tab.locator(".stage canvas").first.bounding_box()
        x, y = box["x"] + 0.5 * box["width"], box["y"] + 0.5 * box["height"]
        touch = phone.new_cdp_session(tab)
        for kind, part in (("Start", 0.0), *(("Move", k / 8) for k in range(1, 9))):
            point = {"x": x + 40 * part, "y": y - 120 * part}
            touch.send(
                "Input.dispatchTouchEvent",
                {"type": f"touch{kind}", "touchPoints": [point]},
            )
        touch.send("Input.dispatchTouchEvent", {"type": "touchEnd", "touchPoints": []})
        tab.wait_for_timeout(500)
        assert (tab.evaluate("scrollY") > 50) == scrolled
        assert (
            tab.evaluate("stage.pictures[0].camera?.yaw ?? 0") != before
        ) != scrolled
        phone.close()


def test_copies_written_out_are_drawn_as_those_begun_one_by_one(tmp_path):
    """Where a processor draws, copies of small meshes are one mesh: the same picture, trails and shadows too."""
    rng = np.random.default_rng(5)
    times = np.linspace(0.0, 1.0, 21)
    way = rng.uniform(-1, 1, (12, 3))
    place = rng.uniform(-1, 1, (12, 3)) + times[:, None, None] * way
    turn = rotations.from_rotation_vector(
        times[:, None, None] * rng.uniform(-3, 3, (12, 3))
    )
    bodies = [box((0.2, 0.1, 0.1), color=("blue", "sky", "orange"))] * 12
    pane = Pane(
        bodies, place, turn, arrows=[Arrows("v", way, "m/s", scale=0.4)], trails=(0, 3)
    )
    film = as_exhibit(Film([pane], times, Space(ground=-2.0)))
    drawn = """(slow) => { const drawing = globalThis[Symbol.for("course.stage.drawing")];
      drawing.slow = slow; stage.clock.time = 0.7; stage.paint();
      const { gl } = drawing; const [w, h] = [gl.drawingBufferWidth, gl.drawingBufferHeight];
      const seen = new Uint8Array(4 * w * h); gl.readPixels(0, 0, w, h, gl.RGBA, gl.UNSIGNED_BYTE, seen);
      const known = drawing.pixels; drawing.pixels = seen;
      const spread = [...drawing.views][0].bodies.every(({ mesh }) => mesh.spread === slow);
      if (!known) return { size: [w, h], spread, colors: new Set(seen).size };
      let other = 0;
      for (let k = 0; k < seen.length; k += 4) other += Math.abs(seen[k] - known[k]) > 8 ? 1 : 0;
      return { size: [w, h], spread, other: other / (w * h) }; }"""
    with page(900, 700) as opened:
        opened_film(opened, film, tmp_path / "film.html", large=False)
        opened.evaluate("() => { stage.trails = true; }")
        dense = opened.evaluate(
            "() => { const d = globalThis[Symbol.for('course.stage.drawing')];"
            " d.begin = ((begin) => (w, h, ...rest) => begin(900, 600, ...rest))(d.begin.bind(d)); return d.slow; }"
        )
        first, second = (opened.evaluate(drawn, slow) for slow in (True, False))
    assert dense and first["spread"] and second["spread"]
    assert first["size"] == second["size"] and first["colors"] > 50
    assert second["other"] < 1e-4
