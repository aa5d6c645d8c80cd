"""How soon the stage shows what is dragged, and how many pictures a second it plays, in Chromium."""

from __future__ import annotations

import os
import signal
import subprocess
import sys
import tempfile
import time
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path
from typing import Any

import numpy as np

from benchmarks.measure import Row
from course import rotations
from course.workbook.demos.full_screen import CHANNEL
from course.workbook.films.listing import find_film
from course.workbook.stage import Arrows, Film, Flat, Pane, Space, as_exhibit, ball, box
from course.workbook.stage import page as html_page

ALONE, ASKED, DRAGS, SECONDS = 50.0, 150.0, 40, 4.0
#: From an event to the frame that shows it: the message comes after all of a frame's callbacks.
WATCH = """([name, counted]) => { window.told = new Promise((resolve) => {
  const root = document.querySelector(".stage"); const before = root[counted];
  addEventListener(name, () => { const start = performance.now(); const channel = new MessageChannel();
    channel.port1.onmessage = () => {
      if (root[counted] > before) resolve(performance.now() - start); else look(); };
    const look = () => requestAnimationFrame(() => channel.port2.postMessage(0));
    look(); }, { once: true }); }); }"""
FRAMES = """(seconds) => new Promise((resolve) => { let frames = 0; const start = performance.now();
  const root = document.querySelector(".stage"); const before = root ? root.paints : 0;
  const go = () => { frames += 1; const passed = (performance.now() - start) / 1000;
    if (passed < seconds) requestAnimationFrame(go);
    else resolve((root ? root.paints - before : frames) / passed); };
  requestAnimationFrame(go); })"""


def rows() -> list[Row]:
    """Goal over the median of what was measured, and frames over those of a page that draws nothing."""
    from tests.browser.session import page

    with page() as opened, tempfile.TemporaryDirectory() as folder:
        base = Path(folder)
        return [
            *_alone(opened, base),
            _asked("Voila", opened, _voila, base / "voila"),
            _asked("JupyterLab", opened, _lab, base / "lab"),
            *_frames(opened, base),
        ]


def _alone(opened: Any, base: Path) -> list[Row]:
    _open(opened, html_page(find_film("impulse").exhibit()), base)
    scrubbed = [_scrubbed(opened, k) for k in range(DRAGS)]
    _open(opened, html_page(find_film("pushed_table").exhibit()), base)
    x, y = _middle(opened)
    turned = list(_dragged(opened, x, y, "paints"))
    return [
        _row("scrub a flat film", scrubbed, ALONE),
        _row("turn the camera", turned, ALONE),
    ]


def _scrubbed(opened: Any, k: int) -> float:
    opened.evaluate(WATCH, ["input", "paints"])
    opened.evaluate(
        "v => { const s = document.querySelector('.stage .time'); s.value = v; "
        "s.dispatchEvent(new Event('input', { bubbles: true })); }",
        20 * k + 10,
    )
    return float(opened.evaluate("window.told"))


def _asked(name: str, opened: Any, server: Any, folder: Path) -> Row:
    """The tip of a velocity of ``impulse``, and the film that comes for it."""
    folder.mkdir()
    with server(opened, folder):
        opened.wait_for_selector(".stage canvas")
        opened.locator(".stage canvas").first.scroll_into_view_if_needed()
        opened.wait_for_function("document.querySelector('.stage').paints > 0")
        opened.wait_for_timeout(1500)
        canvas = opened.locator(".stage canvas").first.bounding_box()
        x, y = opened.evaluate("document.querySelector('.stage').hands[0][1]")
        return _row(
            f"drag a velocity, {name}",
            list(_dragged(opened, canvas["x"] + x, canvas["y"] + y, "films")),
            ASKED,
        )


def _dragged(opened: Any, x: float, y: float, counted: str) -> Iterator[float]:
    """Milliseconds from each step of a drag to the frame that shows it."""
    opened.mouse.move(x, y)
    opened.mouse.down()
    for k in range(DRAGS):
        opened.evaluate(WATCH, ["pointermove", counted])
        opened.mouse.move(x + (40 if k % 2 == 0 else -20) + k % 5, y)
        yield float(opened.evaluate("window.told"))
        opened.wait_for_timeout(250)  # until what is asked once more has come
    opened.mouse.up()


def _frames(opened: Any, base: Path) -> list[Row]:
    opened.goto("about:blank")
    plain = float(opened.evaluate(FRAMES, SECONDS))
    rows = []
    for name, film in (
        ("200 bodies and 500 arrows in space", _crowd_in_space()),
        ("700 discs, flat", _crowd_of_discs()),
    ):
        _open(opened, html_page(as_exhibit(film)), base)
        opened.keyboard.press("Tab")
        opened.evaluate("stage.clock.play()")
        shown = float(opened.evaluate(FRAMES, SECONDS))
        remark = f"{shown:.0f} a second, {plain:.0f} on an empty page; {_load()}"
        rows.append(Row(f"frames, {name}", shown / plain, None, remark))
    return rows


def _crowd_in_space() -> Film:
    rng = np.random.default_rng(1)
    times = np.linspace(0.0, 10.0, 101)
    start, way = rng.uniform(-2, 2, (200, 3)), rng.uniform(-0.2, 0.2, (200, 3))
    place = start + times[:, None, None] * way
    spin = rng.uniform(-1, 1, (200, 3))
    turn = rotations.from_rotation_vector(times[:, None, None] * spin)
    arrows = [Arrows("v", way, "m/s", scale=2.0), Arrows("w", spin, "rad/s", scale=0.3)]
    more = Arrows("f", spin[:100], "N", at=place[:, :100] + 0.1, scale=0.2)
    boxes = [box((0.1, 0.07, 0.05))] * 100 + [ball(0.08)] * 100
    return Film([Pane(boxes, place, turn, arrows=[*arrows, more])], times, Space())


def _crowd_of_discs() -> Film:
    rng = np.random.default_rng(2)
    times = np.linspace(0.0, 10.0, 101)
    start, way = rng.uniform(-2, 2, (700, 3)), rng.uniform(-0.2, 0.2, (700, 3))
    place = start + times[:, None, None] * way
    return Film([Pane([ball(0.05)] * 700, place)], times, Flat("xz", (-4, -4, 4, 4)))


def _row(name: str, taken: list[float], goal: float) -> Row:
    median, late = np.percentile(taken, [50, 95])
    remark = (
        f"median {median:.0f} ms, 95 % {late:.0f} ms, goal {goal:.0f} ms; {_load()}"
    )
    return Row(name, float(goal / median), 1.0, remark)


def _load() -> str:
    return f"load {os.getloadavg()[0]:.1f}" if hasattr(os, "getloadavg") else ""


def _open(opened: Any, text: str, base: Path) -> None:
    path = base / "film.html"
    path.write_text(text, "utf-8")
    opened.goto(path.as_uri())
    opened.wait_for_function("window.stage && window.stage.root.paints > 0")


def _middle(opened: Any) -> tuple[float, float]:
    at = opened.locator(".stage canvas").first.bounding_box()
    return at["x"] + 0.5 * at["width"], at["y"] + 0.5 * at["height"]


def _notebook(folder: Path) -> Path:
    import nbformat

    cell = nbformat.v4.new_code_cell(
        "from course.workbook import demos\n\ndemos.impulse()"
    )
    kernel = {"display_name": "Python 3", "language": "python", "name": "python3"}
    made = nbformat.v4.new_notebook(cells=[cell], metadata={"kernelspec": kernel})
    path = folder / "impulse.ipynb"
    nbformat.write(made, path)
    return path


@contextmanager
def _served(module: str, arguments: list[str], folder: Path) -> Iterator[None]:
    root = Path(__file__).resolve().parents[1]
    share = root / "course" / "workbook" / "demos" / "share"
    server = subprocess.Popen(
        [sys.executable, "-m", module, *arguments], cwd=folder, stdout=subprocess.DEVNULL,
        stderr=subprocess.DEVNULL, start_new_session=True,
        env=dict(os.environ, PYTHONPATH=str(root), JUPYTER_PATH=str(share)),
    )  # fmt: skip
    try:
        yield
    finally:
        os.killpg(server.pid, signal.SIGINT)
        try:
            server.wait(15)
        except subprocess.TimeoutExpired:
            os.killpg(server.pid, signal.SIGKILL)


@contextmanager
def _voila(opened: Any, folder: Path) -> Iterator[None]:
    from tests.browser.session import free_port

    port = free_port()
    given = [
        _notebook(folder).name,
        "--template=course",
        "--no-browser",
        f"--port={port}",
    ]
    given.append(f"--Voila.kernel_websocket_connection_class={CHANNEL}")
    with _served("voila", given, folder):
        _goto(opened, f"http://localhost:{port}/")
        yield


@contextmanager
def _lab(opened: Any, folder: Path) -> Iterator[None]:
    from tests.browser.session import Lab, free_port

    port = free_port()
    _notebook(folder)
    given = [
        "--no-browser",
        f"--port={port}",
        "--IdentityProvider.token=",
        "--allow-root",
    ]
    given.append(f"--ServerApp.kernel_websocket_connection_class={CHANNEL}")
    with _served("jupyterlab", given, folder):
        address = f"http://localhost:{port}/lab/tree/impulse.ipynb"
        _goto(opened, address)
        Lab(opened, address).run_all()
        yield


def _goto(opened: Any, address: str) -> None:
    deadline = time.monotonic() + 60
    while True:
        try:
            opened.goto(address, timeout=120_000)
            return
        except Exception:  # playwright's own class, which is not imported here
            if time.monotonic() > deadline:
                raise
            time.sleep(0.5)
