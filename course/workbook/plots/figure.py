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
from matplotlib.axes import Axes
from matplotlib.figure import Figure

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
_ALT = "_course_alternative_text"


def style() -> AbstractContextManager[None]:
    """The house's style, for as long as the ``with`` block lasts.

    A student's own settings are left alone.
    """
    return mpl.rc_context(fname=str(STYLE))


def axes(
    ax: Axes | None = None, *, size: tuple[float, float] | None = None, **options: Any
) -> Axes:
    """``ax`` itself, or the Axes of a new figure (``size`` in inches; options as for
    ``plt.subplots``).
    """
    if ax is not None:
        return ax
    with style():
        _, made = plt.subplots(figsize=size, **options)
    return made


def side_by_side(columns: int, *, size: tuple[float, float]) -> tuple[Figure, Any]:
    """A figure with several Axes in a row, in the house's style: (figure, array of
    Axes).
    """
    with style():
        figure, several = plt.subplots(1, columns, figsize=size)
    return figure, several


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

    Raises ``ValueError`` for a figure that has none.
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
    """Show every open figure with its alternative text, and close it, also one that has
    none and is refused.
    """
    for number in plt.get_fignums():
        figure = plt.figure(number)
        try:
            display_html(figure_html(figure), f"[figure] {alternative_text(figure)}")
        finally:
            plt.close(figure)
