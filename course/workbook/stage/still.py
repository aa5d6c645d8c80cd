"""One moment of a film as SVG, written here: for saved notebooks and where nothing runs."""

from __future__ import annotations

import base64
import html

import numpy as np

from course.workbook.plots.figure import PALETTE
from course.workbook.stage import marks
from course.workbook.stage.film import Film
from course.workbook.stage.flat_still import plane_picture, window_of
from course.workbook.stage.perspective import space_picture
from course.workbook.stage.views import Flat
from course.workbook.stage.words import description, scale_in_words

WIDTH = 720.0  # of the whole picture, and the least a pane is high


def svg(film: Film, *, time: float | None = None) -> str:
    """The film at a time [s] (default: its first): panes side by side, or one below the
    other where they are wide, with a legend of the arrows.
    """
    index = 0 if time is None else film.index_at(time)
    count = len(film.panes)
    aspect = _aspect(film)
    stacked = aspect > 1.9
    width = WIDTH if stacked else WIDTH / count
    height = min(width / aspect, 460.0)
    head = 22.0 if any(pane.title for pane in film.panes) else 0.0
    drawn = []
    for k, pane in enumerate(film.panes):
        x, y = (0.0, k * (height + head)) if stacked else (k * width, 0.0)
        body = plane_picture(film, pane, index, width, height) if isinstance(film.view, Flat) else \
            space_picture(film, pane, index, width, height)  # fmt: skip
        drawn.append(
            f'<g transform="translate({x:.1f} {y:.1f})">{_title(pane.title, width)}'
            f'<svg y="{head}" width="{width:.1f}" height="{height:.1f}">{body}</svg></g>'
        )
    foot = (height + head) * (count if stacked else 1)
    legend, rows = _legend(film, foot)
    total = foot + 20 * rows + 6
    said = html.escape(description(film, float(np.asarray(film.times)[index])))
    return (
        f'<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 {WIDTH:.0f} {total:.0f}" width="{WIDTH:.0f}" '
        f'height="{total:.0f}" font-family="system-ui, sans-serif" font-size="14" role="img"><title>{said}</title>'
        f'<rect width="100%" height="100%" fill="#fff"/>{"".join(drawn)}{legend}</svg>'
    )


def image(film: Film, *, time: float | None = None) -> str:
    """The same as an ``<img>`` with alternative text, for an HTML output."""
    text = svg(film, time=time)
    data = base64.b64encode(text.encode()).decode("ascii")
    at = None if time is None and not film.moves else (time or 0.0)
    alt = html.escape(description(film, at), quote=True)
    return f'<img alt="{alt}" style="max-width: 100%" src="data:image/svg+xml;base64,{data}">'


def _aspect(film: Film) -> float:
    if not isinstance(film.view, Flat):
        return 1.35
    left, bottom, right, top = window_of(film)
    return float(np.clip((right - left) / (top - bottom), 0.6, 6.0))


def _title(words: str, width: float) -> str:
    if not words:
        return ""
    most = int(width / 7)  # letters of 14 px
    seen = words if len(words) <= most else f"{words[: most - 1].rstrip()}…"
    return (
        f'<text x="{width / 2:.0f}" y="16" text-anchor="middle" font-weight="600">'
        f"{html.escape(seen)}</text>"
    )


def _legend(film: Film, top: float) -> tuple[str, int]:
    """One row for each kind of arrow that is shown, with its scale."""
    kinds = {a.name: a for pane in film.panes for a in pane.arrows if a.shown}
    rows = []
    for row, (name, arrows) in enumerate(kinds.items()):
        y = top + 20 * row + 12
        color = PALETTE[arrows.color[0]] if len(set(arrows.color)) == 1 else marks.SOFT
        sample = marks.arrow(np.array([14.0, y]), np.array([40.0, y]), color)
        words = f"{name}: {scale_in_words(arrows)}"
        rows.append(
            sample + marks.text(np.array([48.0, y]), words, marks.SOFT, "400", "start")
        )
    return "".join(rows), len(rows)
