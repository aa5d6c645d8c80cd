"""What a film refuses, and what the browser gets of it."""

from __future__ import annotations

import base64
import json
import shutil
import subprocess
import xml.etree.ElementTree as ElementTree
from pathlib import Path

import numpy as np
import pytest

from course.workbook import stage
from course.workbook.stage.encoding import encoded
from course.workbook.stage.module import PARTS, program
from course.workbook.stage.words import description, shown_number

T = np.array([0.0, 1.0, 1.0, 2.0])


def a_film(**changes):
    x = np.zeros((4, 2, 3))
    x[:, 1, 0] = [3.0, 2.0, 2.0, 4.0]
    pane = stage.Pane(
        [stage.ball(0.5), stage.box((0.1, 0.2, 0.3), color="vermillion")],
        x,
        arrows=[
            stage.Arrows("velocity", np.ones((4, 2, 3)), "m/s"),
            stage.Arrows("normal", [[0, 0, 1.0]], at=[[0, 0, 0]], color="black"),
        ],
        segments=[stage.Segments("gap d", [[0, 0, 0]], [[1, 0, 0]], [1.0])],
    )
    return stage.Film(
        **{"panes": [pane], "times": T, "title": "two", "ending": "they part"} | changes
    )


def unpacked(packed):
    kind = np.dtype("<" + packed["kind"])
    array = np.frombuffer(base64.b64decode(packed["bytes"]), kind)
    return array.reshape(packed["shape"])


@pytest.mark.parametrize(
    ("changes", "words"),
    [
        ({"times": [0.0, 2.0, 1.0, 3.0]}, "times: expected numbers of shape"),
        ({"panes": []}, "panes: expected at least one"),
        ({"speed": 0.0}, "speed: expected a number above 0"),
        ({"counters": {"hits": [1.0]}}, "counters hits: expected"),
        (
            {"charts": [stage.Curves("v", "m/s", {"a": [1.0, 2.0]})]},
            r"charts v, a: expected shape \(4,\)",
        ),
        (
            {"numbers": [stage.Number("p", (1.0, 2.0, 3.0))]},
            "numbers p: expected one value",
        ),
    ],
)
def test_a_film_names_what_does_not_fit(changes, words):
    with pytest.raises(ValueError, match=words):
        a_film(**changes)


def test_a_pane_names_what_does_not_fit():
    def film(**changes):
        stage.Film(
            [stage.Pane([stage.ball(1.0)], **{"position": np.zeros((1, 3))} | changes)],
            T,
        )

    film()
    with pytest.raises(ValueError, match=r"position: expected shape \(1, 3\) or shape"):
        film(position=np.zeros((2, 3)))
    with pytest.raises(ValueError, match="orientation"):
        film(orientation=[[0, 0, 0, 2.0]])
    with pytest.raises(ValueError, match="trails: expected numbers of bodies"):
        film(trails=[1])
    with pytest.raises(ValueError, match=r"arrows v: expected shape \(m, 3\)"):
        film(arrows=[stage.Arrows("v", [1.0, 0, 0])])
    with pytest.raises(ValueError, match="arrows v, color"):
        film(arrows=[stage.Arrows("v", [[1.0, 0, 0]], color="pink")])


def test_flat_windows_and_cameras_are_checked():
    with pytest.raises(ValueError, match="window: expected left < right"):
        stage.Flat(window=(1, 0, -1, 2))
    with pytest.raises(ValueError, match="plane"):
        stage.Flat("zx")
    with pytest.raises(ValueError, match="camera"):
        stage.Space("behind")


def test_places_keep_a_metre_far_from_the_origin():
    """Two boxes at x = 1e8 and 1e8 + 1 are 1 m apart in the browser too."""
    film = stage.Film(
        [stage.Pane([stage.box((0.1, 0.1, 0.1))] * 2, [[1e8, 0, 0], [1e8 + 1, 0, 0]])],
        [0.0],
    )
    sent = encoded(film)
    place = unpacked(sent["panes"][0]["position"])
    assert place.dtype == np.float32
    assert place[0, 1, 0] - place[0, 0, 0] == pytest.approx(1.0, abs=1e-7)
    assert sent["view"]["middle"][0] == pytest.approx(1e8 + 0.5)


def test_what_stands_still_is_sent_once_and_json_can_hold_it_all():
    sent = encoded(a_film())
    arrows = sent["panes"][0]["arrows"]
    assert arrows[1]["vector"]["still"] and arrows[1]["vector"]["shape"] == [1, 1, 3]
    assert not arrows[0]["vector"]["still"]
    assert unpacked(sent["times"]).tolist() == T.tolist()
    json.dumps(sent, allow_nan=False)


def test_the_description_says_what_moves_how_it_ends_and_the_numbers():
    film = a_film(numbers=[stage.Number("impulse", (-4.0,), "N s")])
    said = description(film)
    for words in ("two.", "a ball, a box", "they part.", "impulse: −4 N s.", "2 s"):
        assert words in said
    assert "The picture is of 1 s." in description(film, 1.0)


@pytest.mark.parametrize(
    ("value", "words"),
    [
        (-0.0, "0"),
        (-2e-16, "0"),
        (np.inf, "∞"),
        (-np.inf, "−∞"),
        (np.nan, "–"),
        (-2.5, "−2.5"),
        (1234.5, "1230"),
        (100.0, "100"),
        (0.00051, "0.00051"),
    ],
)
def test_numbers_are_written_for_reading(value, words):
    assert shown_number(value, 3) == words


@pytest.mark.parametrize("view", [stage.Flat(), stage.Space(ground=0.0)])
def test_a_still_is_svg_with_its_words(view):
    film = a_film(view=view)
    root = ElementTree.fromstring(stage.svg(film, time=1.5))
    assert root.tag.endswith("svg")
    title = root.find("{http://www.w3.org/2000/svg}title")
    assert title is not None and "they part" in (title.text or "")
    shapes = [e.tag.split("}")[1] for e in root.iter()]
    assert shapes.count("polygon") + shapes.count("circle") >= 3
    shown = stage.image(film, time=1.5)
    assert shown.startswith('<img alt="two.') and "svg+xml;base64," in shown


def test_a_still_shows_the_moment_it_is_asked_for():
    assert stage.svg(a_film(), time=0.0) != stage.svg(a_film(), time=2.0)
    assert stage.svg(a_film()) == stage.svg(a_film(), time=0.0)


def test_the_program_is_one_module_without_imports():
    text = program()
    assert "import " not in [line[:7] for line in text.splitlines()]
    assert text.count("export default") == 1
    folder = Path(stage.__file__).parent / "js"
    assert {p.stem for p in folder.glob("*.js")} == set(PARTS)


@pytest.mark.skipif(not shutil.which("node"), reason="node is not installed")
def test_the_program_can_be_read_by_node(tmp_path):
    """No name stands twice, which joining could bring about."""
    path = tmp_path / "program.mjs"
    path.write_text(program(), "utf-8")
    done = subprocess.run(
        ["node", "--check", path], capture_output=True, text=True, timeout=60
    )
    assert done.returncode == 0, done.stderr


def test_exhibits_name_a_knob_that_is_not_there():
    with pytest.raises(ValueError, match="hands: expected names of knobs: a; got b"):
        stage.Exhibit(
            a_film,
            [stage.Knob("a", "a", 0, -1, 1)],
            [stage.Hand({"b": (1.0, 0, 0)}, body=0)],
        )
    with pytest.raises(ValueError, match="knob a: expected low <= value <= high"):
        stage.Knob("a", "a", 3.0, -1.0, 1.0)
    with pytest.raises(ValueError, match="knob a, low: expected above 0"):
        stage.Knob("a", "a", 1.0, 0.0, 2.0, logarithmic=True)


def test_a_page_needs_nothing_from_outside():
    text = stage.page(stage.Exhibit(a_film))
    assert "http://" not in text.replace("http://www.w3.org/2000/svg", "")
    assert "https://" not in text
    assert text.count("</script>") == 2


def test_a_widget_keeps_a_still_and_constant_text_and_answers():
    exhibit = stage.Exhibit(
        lambda a: a_film(title=f"a is {a:g}"), [stage.Knob("a", "a", 0, -1, 1)]
    )
    widget = stage.show(exhibit, still=1.0)
    data = widget._repr_mimebundle_()
    data = data[0] if isinstance(data, tuple) else data
    assert data["text/plain"] == "[stage]"
    assert data["text/html"].startswith('<img alt="a is 0.')
    sent = []
    widget.send = lambda message, buffers=None: sent.append(message)
    widget._asked(widget, {"kind": "ask", "id": 7, "values": {"a": 0.5, "x": 1}}, [])
    assert sent[0]["id"] == 7 and sent[0]["film"]["title"] == "a is 0.5"


def test_a_widget_says_what_a_function_raised():
    def fails(a):
        if a:
            raise ZeroDivisionError("no mass")
        return a_film()

    widget = stage.show(stage.Exhibit(fails, [stage.Knob("a", "a", 0, -1, 1)]))
    sent = []
    widget.send = lambda message, buffers=None: sent.append(message)
    widget._asked(widget, {"kind": "ask", "id": 1, "values": {"a": 1.0}}, [])
    assert sent == [{"kind": "failed", "id": 1, "words": "ZeroDivisionError: no mass"}]
