"""A film with a kernel behind it: what is dragged stays under the pointer, keys act, errors are shown."""

import json
import os
import re
import signal
import subprocess
import sys

import pytest
from browser.session import ROOT, chromium, free_port, page
from browser.test_stage_in_browser import _answers, cut_off, notebook

pytestmark = [
    pytest.mark.browser,
    pytest.mark.skipif(
        chromium() is None, reason="no Chromium or Chrome on this machine"
    ),
]
pytest.importorskip("playwright", reason="the extra 'browser' is not installed")

FILMS = ("impulse", "wall", "plank", "pushed_table", "touching", "shadows", "throws")
#: Held where they do not follow the pointer: what turns, and what moves along a line.
TURNED = ("turning_rod", "growing_dop", "far_spheres")
#: Which hand is dragged, and ways it goes [pixels]; the knob's step is a few pixels long.
DRAGS = {
    "impulse": (1, [(40, 0), (-60, 5), (75, -4)]),
    "wall": (0, [(-40, -30), (90, 10), (-30, 40)]),
    "plank": (0, [(80, 0), (-210, 3), (120, 0)]),
    "pushed_table": (0, [(-40, 6), (60, -12), (-120, 10)]),
    "touching": (0, [(40, -30), (-90, 20), (30, 25)]),
    "shadows": (0, [(30, 20), (20, 30), (-25, -10)]),
    "throws": (1, [(-30, -20), (-20, 30), (25, -15)]),
}
#: A student's function that raises, beside the right one; and a film that cannot be made.
RAISES = """\
from course.workbook import stage
from course.workbook.films.central_impacts import impulse


def impulse_of_mine(mass_1, mass_2, velocity_1, velocity_2, normal, restitution):
    if restitution < 0.5:
        raise ZeroDivisionError("no e is that small")
    return 1.0


stage.show(impulse(against=impulse_of_mine))
"""
NO_FILM = """\
from course.workbook import stage
from course.workbook.stage import Exhibit, Film, Flat, Knob, Pane, ball


def film(side):
    if side < 0.5:
        raise ZeroDivisionError("no side is that small")
    place = [[[0, 0, 0]], [[side, 0, 0]]]
    return Film([Pane([ball(0.2)], place)], [0.0, 0.5], Flat("xz"), caption=f"A side of {side:g} m.")


stage.show(Exhibit(film, [Knob("side", "side", 1.0, 0.0, 2.0, 0.25, "m")]))
"""
#: The first messages of a kind are lost on their way to the kernel ("sent") or from it ("received").
LOSSY = """([way, kind, most]) => {
  let lost = 0;
  const told = (data) => typeof data === "string" ? data : new TextDecoder().decode(data);
  const loses = (data) => new RegExp(`"kind": ?"${kind}"`).test(told(data)) && lost < most && (lost += 1);
  window.lostMessages = () => lost;
  window.WebSocket = class extends WebSocket {
    send(data) { if (way !== "sent" || !loses(data)) super.send(data); }
    set onmessage(act) {
      super.onmessage = (event) => { if (way !== "received" || !loses(event.data)) act.call(this, event); };
    }
  };
}"""

#: A page of another colour, whatever lies on it: the body comes last, and is looked at.
PAPER = """color => { for (let node = document.querySelector(".stage").parentElement; node; node = node.parentElement) {
  node.style.background = color; if (node === document.body) return; } }"""


@pytest.fixture(scope="module")
def voila(tmp_path_factory):
    folder = tmp_path_factory.mktemp("voila")
    for name in FILMS + TURNED:
        shown = f"from course.workbook import demos\n\ndemos.{name}()"
        notebook(folder / f"{name}.ipynb", shown)
    notebook(folder / "raises.ipynb", RAISES)
    notebook(folder / "no_film.ipynb", NO_FILM)
    port = free_port()
    template = ROOT / "course" / "workbook" / "demos" / "share"
    server = subprocess.Popen(
        [sys.executable, "-m", "voila", ".", "--template=course", "--no-browser", f"--port={port}"],
        cwd=folder, env=dict(os.environ, JUPYTER_PATH=str(template), PYTHONPATH=str(ROOT)),
        stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL, start_new_session=True,
    )  # fmt: skip
    try:
        _answers(port)
        yield f"http://localhost:{port}/voila/render"
    finally:
        os.killpg(server.pid, signal.SIGINT)
        try:
            server.wait(15)
        except subprocess.TimeoutExpired:
            os.killpg(server.pid, signal.SIGKILL)


class Played:
    """A stage on a page, with hands."""

    def __init__(self, opened, address):
        self.page = opened
        opened.goto(address, timeout=240_000)
        opened.wait_for_selector(".stage canvas", timeout=60_000)
        opened.wait_for_function("document.querySelector('.stage').paints > 0")
        self.root = opened.locator(".stage").first

    def hand(self, number):
        """Where it is on the page."""
        x, y = self.root.evaluate("(root, k) => root.hands[0][k]", number)
        box = self.page.locator(".stage canvas").first.bounding_box()
        return box["x"] + x, box["y"] + y

    def settled(self):
        """Until nothing is painted any more."""
        last = None
        for _ in range(100):
            self.page.wait_for_timeout(250)
            now = self.root.evaluate("root => root.paints")
            if now == last:
                return
            last = now
        raise TimeoutError("the stage keeps painting")

    def knobs(self):
        return self.page.locator(".stage .knobs output").all_inner_texts()

    def now(self):
        self.page.wait_for_timeout(100)  # two frames
        return self.page.locator(".stage .now").inner_text()

    def numbers(self):
        return self.page.locator(".stage .numbers").inner_text()

    def press(self, key):
        self.root.focus()
        self.page.keyboard.press(key)


@pytest.mark.parametrize("name", FILMS)
def test_what_is_dragged_stays_under_the_pointer(voila, name):
    number, ways = DRAGS[name]
    with page() as opened:
        cut_off(opened)
        played = Played(opened, f"{voila}/{name}.ipynb")
        before = played.knobs()
        for way in ways:
            x, y = played.hand(number)
            opened.mouse.move(x, y)
            opened.mouse.down()
            for part in (0.2, 0.5, 0.7, 1.0):  # the last of these wins
                opened.mouse.move(x + part * way[0], y + part * way[1])
            played.settled()
            there = played.hand(number)
            opened.mouse.up()
            free = (0,) if name in ("impulse", "plank") else (0, 1)
            off = [there[k] - (x, y)[k] - way[k] for k in free]
            assert max(map(abs, off)) < 8, f"{way}: {off} px from the pointer"
        assert played.knobs() != before
        assert opened.console_errors == [] and opened.asked_outside == []


@pytest.mark.parametrize("name", TURNED)
def test_what_is_turned_by_hand_has_other_numbers(voila, name):
    with page() as opened:
        cut_off(opened)
        played = Played(opened, f"{voila}/{name}.ipynb")
        before, said = played.knobs(), played.numbers()
        x, y = played.hand(0)
        opened.mouse.move(x, y)
        opened.mouse.down()
        for part in (0.3, 0.6, 1.0):
            opened.mouse.move(x + part * 20, y - part * 45)
        played.settled()
        opened.mouse.up()
        assert played.knobs() != before
        assert played.numbers() != said
        assert opened.console_errors == [] and opened.asked_outside == []


def test_what_a_students_function_raises_is_shown_and_ends_nothing(voila):
    with page() as opened:
        cut_off(opened)
        played = Played(opened, f"{voila}/raises.ipynb")
        slider = opened.locator(".stage .knobs input").last
        pictures = opened.locator(".stage .pictures")
        slider.fill("0")
        opened.wait_for_function(
            "document.querySelector('.stage .pictures').innerText.includes('your function raised')"
        )
        said = "your function raised ZeroDivisionError: no e is that small"
        assert said in pictures.inner_text()
        slider.fill("1000")
        opened.wait_for_function(
            "!document.querySelector('.stage .pictures').innerText.includes('raised')"
        )
        assert "your function" in pictures.inner_text()
        played.press(" ")
        opened.wait_for_function(
            "document.querySelector('.stage .now').innerText.startsWith('0.520')"
        )


def test_why_there_is_no_film_is_said_and_ends_nothing(voila):
    with page() as opened:
        cut_off(opened)
        played = Played(opened, f"{voila}/no_film.ipynb")
        slider = opened.locator(".stage .knobs input").last
        caption = opened.locator(".stage .caption")
        assert caption.inner_text() == "A side of 1 m."
        slider.fill("0")
        _says(opened, "ZeroDivisionError: no side is that small")
        slider.fill("1000")
        _says(opened, "A side of 2 m.")
        played.press(" ")
        opened.wait_for_function(
            "document.querySelector('.stage .now').innerText.startsWith('0.500')"
        )


def _says(opened, words):
    """Until the caption is this."""
    opened.wait_for_function(
        "words => document.querySelector('.stage .caption')?.innerText === words",
        arg=words, timeout=30_000,
    )  # fmt: skip


@pytest.mark.parametrize("way, kind", [("sent", "ask"), ("received", "film")])
def test_a_message_that_is_lost_hangs_no_hand(voila, way, kind):
    """Once: the same is asked again. Three times: that no answer comes is said, and it comes after all."""
    for most in (1, 3):
        with page() as opened:
            cut_off(opened)
            lossy = f"({LOSSY})({json.dumps([way, kind, most])})"
            opened.add_init_script(lossy)
            Played(opened, f"{voila}/no_film.ipynb")
            slider = opened.locator(".stage .knobs input").last
            slider.fill("1000")
            if most > 1:
                opened.wait_for_function(
                    "document.querySelector('.stage .caption').innerText.startsWith('Python has not answered yet')"
                )
            _says(opened, "A side of 2 m.")
            assert opened.evaluate("lostMessages()") == most
            slider.fill("500")
            _says(opened, "A side of 1 m.")


def test_a_question_as_soon_as_the_stage_appears_is_answered(voila):
    with page() as opened:
        cut_off(opened)
        opened.add_init_script("""new MutationObserver(() => {
          const slider = !window.asked && document.querySelector(".stage .knobs input");
          if (!slider) return;
          window.asked = true;
          slider.value = 1000;
          slider.dispatchEvent(new Event("input"));
        }).observe(document, { childList: true, subtree: true });""")
        opened.goto(f"{voila}/no_film.ipynb", timeout=240_000)
        _says(opened, "A side of 2 m.")


def test_the_keyboard_alone_does_everything(voila):
    with page() as opened:
        cut_off(opened)
        opened.emulate_media(reduced_motion="reduce")
        played = Played(opened, f"{voila}/impulse.ipynb")
        opened.wait_for_timeout(500)
        assert played.now() == "0.000 s", "it began by itself"
        played.press(" ")
        opened.wait_for_function(
            "document.querySelector('.stage .now').innerText === '0.520 s'"
        )
        played.press("r")
        played.press("ArrowRight")
        played.press("ArrowRight")
        assert played.now() == "0.013 s"
        played.press("ArrowLeft")
        assert played.now() == "0.007 s"
        answer = opened.locator(".stage .answer")
        assert not answer.is_visible()
        played.press("a")
        assert answer.is_visible()
        for key, masses in (("1", ["1 kg", "1 kg"]), ("3", ["0.1 kg", "10 kg"])):
            played.press(key)
            assert played.knobs()[:2] == masses
        played.settled()
        before = played.numbers()
        _tab_to(opened, "restitution e")
        opened.keyboard.press("ArrowLeft")
        played.settled()
        assert played.knobs()[-1] == "0.95" and played.numbers() != before
        shown = opened.locator(".stage .overlays input")
        shown.first.focus()
        opened.keyboard.press("Space")
        assert not shown.first.is_checked()
        assert "velocity" in opened.locator(".stage .overlays label").first.inner_text()


def _tab_to(opened, name):
    """Press Tab until the control of this name has the focus."""
    for _ in range(60):
        opened.keyboard.press("Tab")
        if opened.evaluate("document.activeElement.ariaLabel") == name:
            return
    raise AssertionError(f"no {name} on the way")


def test_every_control_has_a_name(voila):
    with page() as opened:
        cut_off(opened)
        Played(opened, f"{voila}/pushed_table.ipynb")
        for role in ("button", "slider", "combobox", "checkbox", "img"):
            every = opened.locator(".stage").get_by_role(role)
            # A name with a letter in it: those without one are missing here.
            named = opened.locator(".stage").get_by_role(role, name=re.compile(r"\w"))
            assert every.count() == named.count() > 0, role


def test_it_follows_the_page_into_the_dark(voila):
    with page() as opened:
        cut_off(opened)
        opened.emulate_media(color_scheme="light")
        played = Played(opened, f"{voila}/plank.ipynb")
        theme = "document.querySelector('.stage').dataset.theme === '%s'"
        opened.wait_for_function(theme % "light")
        opened.evaluate(PAPER, "#111")
        opened.wait_for_function(theme % "dark")
        played.settled()
        corner = (
            "c => [...c.getContext('2d').getImageData(2, 2, 1, 1).data].slice(0, 3)"
        )
        paper = opened.locator(".stage canvas").first.evaluate(corner)
        assert max(paper) < 60
        opened.evaluate(PAPER, "#fff")
        opened.wait_for_function(theme % "light")
