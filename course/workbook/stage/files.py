"""A film as a file: HTML that plays without a network, SVG of a moment, or a GIF."""

from __future__ import annotations

import io
import shutil
import tempfile
from pathlib import Path

import numpy as np

from course.arrays import failure
from course.workbook.stage.exhibit import Exhibit
from course.workbook.stage.html_page import page
from course.workbook.stage.still import svg

SUFFIXES = (".html", ".svg", ".gif")
#: Of a GIF: pictures a second, and the most there are.
RATE, MOST = 20, 240
_FLAGS = [
    "--no-sandbox", "--disable-background-networking", "--disable-quic", "--no-first-run",
    "--use-angle=swiftshader", "--enable-unsafe-swiftshader",
]  # fmt: skip


def export(
    exhibit: Exhibit, path: Path, *, time: float | None = None, large: bool = False
) -> int:
    """Write the film to a file; its ending says in which form.

    Args:
        exhibit: what is written; its knobs stand where they began, presets stay buttons.
        path: ends with .html, .svg or .gif.
        time: of the moment that SVG shows [s]; default: the first.
        large: HTML for a lecture room.
    Returns:
        The file's size in bytes.
    Raises:
        ValueError: another ending.
        RuntimeError: a GIF where neither Chromium nor playwright is to be had.
    """
    suffix = path.suffix.lower()
    if suffix not in SUFFIXES:
        raise failure("path", f"a name that ends with {', '.join(SUFFIXES)}", path.name)
    if suffix == ".gif":
        data = _gif(exhibit)
    else:
        text = (
            page(exhibit, large=large)
            if suffix == ".html"
            else svg(exhibit.made(), time=time)
        )
        data = text.encode("utf-8")
    path.write_bytes(data)
    return len(data)


def _gif(exhibit: Exhibit) -> bytes:
    """Played in Chromium, picture by picture."""
    from PIL import Image

    pictures = [Image.open(io.BytesIO(data)).convert("RGB") for data in _shots(exhibit)]
    out = io.BytesIO()
    # One palette for all, or colours would flicker from picture to picture.
    palette = pictures[len(pictures) // 2].quantize(128)
    paletted = [p.quantize(palette=palette, dither=Image.Dither.NONE) for p in pictures]
    paletted[0].save(out, "GIF", save_all=True, append_images=paletted[1:],
                     duration=round(1000 / RATE), loop=0)  # fmt: skip
    return out.getvalue()


def _shots(exhibit: Exhibit) -> list[bytes]:
    film = exhibit.made()
    times = np.asarray(film.times)
    seconds = float(times[-1] - times[0]) / film.speed
    count = int(np.clip(np.ceil(RATE * seconds) + 1, 2 if film.moves else 1, MOST))
    chromium = next(
        filter(None, map(shutil.which, ("chromium", "chromium-browser", "google-chrome"))),
        None,
    )  # fmt: skip
    try:
        from playwright.sync_api import sync_playwright
    except ImportError:
        chromium = None
    if chromium is None:
        raise RuntimeError(
            "a GIF is drawn by Chromium through playwright (the extra 'browser'), which is not here; "
            "choose .html or .svg"
        )
    with tempfile.TemporaryDirectory() as folder, sync_playwright() as driver:
        file = Path(folder) / "film.html"
        file.write_text(page(exhibit), "utf-8")
        browser = driver.chromium.launch(executable_path=chromium, args=_FLAGS)
        tab = browser.new_page(viewport={"width": 900, "height": 700})
        tab.goto(file.as_uri())
        shots = []
        for time in np.linspace(times[0], times[-1], count):
            tab.evaluate("t => { stage.clock.seek(t); stage.paint(); }", float(time))
            shots.append(tab.locator(".pictures").screenshot())
        browser.close()
    return shots
