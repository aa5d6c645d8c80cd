"""The stage in a real browser, without a network: a view into space is drawn, plays, scrubs, looks from elsewhere."""

import os
import signal
import subprocess
import sys
import time
import urllib.request

import nbformat
import pytest
from browser.session import ROOT, Lab, checkout, chromium, free_port, page, served

pytestmark = [
    pytest.mark.browser,
    pytest.mark.skipif(
        chromium() is None, reason="no Chromium or Chrome on this machine"
    ),
]
pytest.importorskip("playwright", reason="the extra 'browser' is not installed")

SCENE = """\
import numpy as np
from course import rotations
from course.workbook import stage
from course.workbook.stage import Arrows, Film, Knob, Exhibit, Pane, Space, box

times = np.linspace(0.0, 1.0, 25)
turn = rotations.from_rotation_vector(np.outer(times, [0.0, 0.0, 1.2]))[:, None]
place = np.stack([times, 0 * times, 0.5 + 0 * times], axis=-1)[:, None]
spin = Arrows("omega", [[0.0, 0.0, 1.2]], "rad/s", at=place)
bodies = Pane([box([0.3, 0.2, 0.1], color=("blue", "orange", "sky"))], place, turn, arrows=[spin])
stage.show(Film([bodies], times, Space(ground=0.0), caption="A box slides and turns."), still=0.5)
"""
LOCAL = (
    "http://localhost",
    "http://127.0.0.1",
    "ws://localhost",
    "ws://127.0.0.1",
    "data:",
    "blob:",
)


def notebook(path, source=SCENE):
    kernel = {"display_name": "Python 3", "language": "python", "name": "python3"}
    cells = [nbformat.v4.new_code_cell(source)]
    nbformat.write(
        nbformat.v4.new_notebook(cells=cells, metadata={"kernelspec": kernel}), path
    )


def cut_off(opened):
    """No host but this one can be reached; what was asked of others is kept."""
    opened.asked_outside = []

    def decide(route):
        if route.request.url.startswith(LOCAL):
            route.continue_()
        else:
            opened.asked_outside.append(route.request.url)
            route.abort()

    opened.route("**/*", decide)


class Stage:
    """The stage on a page."""

    def __init__(self, opened):
        self.page = opened
        opened.wait_for_selector(".stage canvas", timeout=240_000)
        self.canvas = opened.locator(".stage canvas").first
        self.canvas.scroll_into_view_if_needed()

    def picture(self):
        """The canvas once it has stopped changing, as a PNG's bytes."""
        last, deadline = b"", time.monotonic() + 30
        while time.monotonic() < deadline:
            self.page.wait_for_timeout(500)
            shot = self.canvas.screenshot()
            if shot == last:
                return shot
            last = shot
        raise TimeoutError("the picture keeps changing")

    def colors(self):
        """How many pixels of the canvas are of other colours than its paper."""
        return self.canvas.evaluate(
            """c => { const d = c.getContext("2d").getImageData(0, 0, c.width, c.height).data; let n = 0;
            for (let i = 0; i < d.length; i += 4) {
              const c = d.slice(i, i + 3); n += Math.max(...c) - Math.min(...c) > 60; }
            return n; }"""
        )  # fmt: skip

    def time(self):
        return self.page.locator(".stage .now").first.inner_text().split()[0]

    def press(self, key, times=1):
        self.page.locator(".stage").first.focus()
        for _ in range(times):
            self.page.keyboard.press(key)


def plays_and_scrubs(opened):
    stage = Stage(opened)
    start = stage.picture()
    assert stage.time() == "0.00" and stage.colors() > 1000, "no box is seen"
    stage.press("ArrowRight", 15)  # a thirtieth of a second each
    middle = stage.picture()
    assert stage.time() == "0.50" and middle != start
    stage.press("r")
    assert stage.picture() == start and stage.time() == "0.00"
    stage.press(" ")
    opened.wait_for_function(
        "document.querySelector('.stage .now').innerText.startsWith('1.00 s')",
        timeout=240_000,
    )
    end = stage.picture()
    assert end not in (start, middle)
    opened.locator(".stage select[aria-label='view from']").first.select_option("top")
    assert stage.picture() != end
    assert opened.console_errors == [] and opened.asked_outside == []


@pytest.fixture
def lab(tmp_path):
    root = checkout(tmp_path)
    notebook(root / "lessons" / "10-impulse.ipynb")
    with (
        served(
            ["open", "10", "--no-browser", "--port", str(free_port())], root
        ) as address,
        page() as opened,
    ):
        cut_off(opened)
        session = Lab(opened, address)
        session.run_all()
        yield session


def test_in_jupyterlab(lab):
    plays_and_scrubs(lab.page)
    # Keys that in JupyterLab make a heading, a raw cell, a cell above, and run a cell.
    for key in ("1", "r", "a", " ", "ArrowRight"):
        Stage(lab.page).press(key)
    lab.page.wait_for_timeout(500)
    assert lab.page.locator(".jp-CodeCell").count() == 1
    assert lab.page.locator(".jp-Cell").count() == 1
    said = lab.page.locator(".stage canvas").first.get_attribute("aria-label")
    assert "A box slides and turns. " in said and "m for 1 rad/s" in said


def test_in_voila(tmp_path):
    notebook(tmp_path / "scene.ipynb")
    port = free_port()
    template = ROOT / "course" / "workbook" / "demos" / "share"
    server = subprocess.Popen(
        [sys.executable, "-m", "voila", "scene.ipynb", "--template=course", "--no-browser", f"--port={port}"],
        cwd=tmp_path, env=dict(os.environ, JUPYTER_PATH=str(template), PYTHONPATH=str(ROOT)),
        stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL, start_new_session=True,
    )  # fmt: skip
    try:
        _answers(port)
        with page() as opened:
            cut_off(opened)
            opened.goto(f"http://localhost:{port}/", timeout=240_000)
            plays_and_scrubs(opened)
    finally:
        os.killpg(server.pid, signal.SIGINT)
        try:
            server.wait(15)
        except subprocess.TimeoutExpired:
            os.killpg(server.pid, signal.SIGKILL)


def _answers(port):
    deadline = time.monotonic() + 60
    while time.monotonic() < deadline:
        try:
            urllib.request.urlopen(f"http://localhost:{port}/voila/static/", timeout=5)
            return
        except urllib.error.HTTPError:
            return
        except OSError:
            time.sleep(0.3)
    raise TimeoutError("Voila does not answer")


def test_a_saved_notebook_shows_the_picture_before_anything_runs(tmp_path):
    from course.workbook.building import execute

    root = checkout(tmp_path)
    path = root / "lessons" / "10-impulse.ipynb"
    notebook(path)
    execute(path)
    assert (
        path.stat().st_size < 300_000
        and "widgets" not in nbformat.read(path, 4).metadata
    )
    with (
        served(
            ["open", "10", "--no-browser", "--port", str(free_port())], root
        ) as address,
        page() as opened,
    ):
        cut_off(opened)
        Lab(opened, address)
        alt = opened.locator(".jp-OutputArea img").first.get_attribute(
            "alt", timeout=120_000
        )
        assert (
            alt.startswith("A box slides and turns. ")
            and "The picture is of 0.5 s" in alt
        )
        assert "Error displaying widget" not in opened.inner_text("body")
