"""Figures in the house's style, with alternative text, shown as one HTML image each.

JupyterLab shows a PNG output without its alternative text, so figures are shown as
``<img alt=...>``.
"""

from __future__ import annotations

import base64
import html
import io
from contextlib import AbstractContextManager
from pathlib import Path
from typing import Any

import matplotlib as mpl
import matplotlib.pyplot as plt
import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from course.arrays import ArrayLike
from course.workbook.notebook import display_html

STYLE = Path(__file__).with_name("house.mplstyle")
PALETTE = {
    "blue": "#0072B2",
    "vermillion": "#D55E00",
    "green": "#009E73",
    "purple": "#CC79A7",
    "orange": "#E69F00",
    "sky": "#56B4E9",
    "black": "#000000",
    "grey": "#8c8c8c",
}
COLOURS = tuple(name for name in PALETTE if name not in ("black", "grey"))
MARKERS = "os^DvPX*"
LINES = ("-", "--", "-.", ":")
SPEED_SCALE = 0.22  # metres of a picture for a speed of 1 m/s
HATCHES = ("", "//", "..", "xx", "\\\\", "--")
_ALT = "_course_alternative_text"


def style() -> AbstractContextManager[None]:
    """The house's style, for as long as the ``with`` block lasts.

    A student's own settings are left alone.
    """
    return mpl.rc_context(fname=str(STYLE))


def axes(
    ax: Axes | None = None, *, size: tuple[float, float] | None = None, **options: Any
) -> Axes:
    """``ax`` itself, or the Axes of a new figure.

    ``size`` is in inches; options are those of ``plt.subplots``.
    """
    if ax is not None:
        return ax
    with style():
        _, made = plt.subplots(figsize=size, **options)
    return made


def side_by_side(columns: int, *, size: tuple[float, float]) -> tuple[Figure, Any]:
    """A figure with several Axes in a row, in the house's style, and those Axes."""
    with style():
        figure, several = plt.subplots(1, columns, figsize=size)
    return figure, several


def arrow(
    ax: Axes,
    start: ArrayLike,
    tip: ArrayLike,
    colour: str = "black",
    *,
    label: str = "",
    beyond: float = 0.16,
    lw: float = 1.8,
    head: float = 11.0,
    style: str = "-|>",
    **options: Any,
) -> None:
    """An arrow between two places of the picture; none where they are the same.

    Args:
        label: what is written beyond the tip.
        beyond: its distance from the tip in units of the axes; where this is negative,
            the label stands before the start.
        head: length of the head in points.
        style: "<->" for a measure with two heads.
        options: of matplotlib's arrows: ``connectionstyle``, ``shrinkA``, ``zorder``.
    """
    tail, end = (np.asarray(p, dtype=float)[:2] for p in (start, tip))
    length = float(np.linalg.norm(end - tail))
    if length < 1e-9:
        return
    look = {"arrowstyle": style, "lw": lw, "color": PALETTE[colour]}
    look |= {"shrinkA": 0, "shrinkB": 0, "mutation_scale": head} | options
    ax.annotate("", tuple(end), tuple(tail), arrowprops=look)
    if label:
        x, y = (end if beyond > 0 else tail) + beyond * (end - tail) / length
        behind = {"fc": "white", "ec": "none", "pad": 1.0, "alpha": 0.8}
        ax.text(
            x, y, label, color=PALETTE[colour], ha="center", va="center", bbox=behind
        )


def line(
    ax: Axes,
    points: ArrayLike,
    colour: str = "0.3",
    *,
    ls: str = "-",
    lw: float | None = None,
    **options: Any,
) -> None:
    """A line through places of the picture, (k, 2), without marks.

    Args:
        colour: a name of the palette, or any other of matplotlib's.
        ls, lw: its dashes and its width in points.
        options: of ``Axes.plot``, ``label``, ``zorder``.
    """
    x, y = np.asarray(points, dtype=float)[:, :2].T
    look = {"color": PALETTE.get(colour, colour), "ls": ls, "lw": lw, "marker": ""}
    ax.plot(x, y, **look | options)


def centre_mark(ax: Axes, place: ArrayLike, **options: Any) -> None:
    """A white cross with a black edge: a centre of mass, or an axle."""
    look: dict[str, Any] = {
        "marker": "P",
        "ms": 10,
        "mfc": "white",
        "mec": "black",
        "ls": "none",
    }
    ax.plot(*np.asarray(place, dtype=float)[:2], **look | options)


def bare(ax: Axes) -> None:
    """Take ticks, grid and frame away."""
    ax.set(xticks=[], yticks=[])
    ax.grid(False)
    for side in ax.spines.values():
        side.set_visible(False)


def legend_beside(ax: Axes, **options: Any) -> Any:
    """The legend to the right of the axes, from their upper edge down."""
    return ax.legend(loc="upper left", bbox_to_anchor=(1.0, 1.0), **options)


def describe(ax: Axes, text: str) -> None:
    """Add a sentence of alternative text to the figure that ``ax`` is in."""
    figure = ax.get_figure(root=True)
    assert figure is not None
    known = getattr(figure, _ALT, ())
    setattr(figure, _ALT, (*known, text) if text not in known else known)


def alternative_text(figure: Figure) -> str:
    """The alternative text of a figure, made of what each drawing function wrote."""
    return " ".join(getattr(figure, _ALT, ()))


def figure_html(figure: Figure, *, dots_per_inch: int = 160) -> str:
    """A figure as one ``<img>`` with its alternative text.

    Raises:
        ValueError: a figure that has none.
    """
    text = alternative_text(figure)
    if not text:
        raise ValueError(
            "figure: expected alternative text, plots.describe(ax, '...'); got none"
        )
    buffer = io.BytesIO()
    figure.savefig(
        buffer,
        format="png",
        dpi=dots_per_inch,
        facecolor="white",
        metadata={"Software": None},
    )
    data = base64.b64encode(buffer.getvalue()).decode()
    width = round(figure.get_figwidth() * 100)
    return (
        f'<img alt="{html.escape(text)}" src="data:image/png;base64,{data}" '
        f'style="width: {width}px; max-width: 100%; background: white">'
    )


def show() -> None:
    """Show every open figure with its alternative text, and close it.

    A figure without such a text is closed and refused.
    """
    for number in plt.get_fignums():
        figure = plt.figure(number)
        try:
            display_html(figure_html(figure), f"[figure] {alternative_text(figure)}")
        finally:
            plt.close(figure)
