"""The stage: films that play in the browser and can be taken hold of.

``stage.show(film)`` plays a film or an exhibit in a notebook; ``stage.page`` makes one
HTML file of it; ``stage.svg`` a still.
"""

from __future__ import annotations

from typing import Any

from course.workbook.stage.beside import Curves, Number, Path
from course.workbook.stage.exhibit import Exhibit, Hand, Knob, Preset, as_exhibit
from course.workbook.stage.film import Film
from course.workbook.stage.html_page import page
from course.workbook.stage.panes import Arrows, Pane, Segments
from course.workbook.stage.solids import (
    Solid,
    ball,
    box,
    capsule,
    joined,
    labelled,
    mesh,
    standing,
)
from course.workbook.stage.still import image, svg
from course.workbook.stage.views import Flat, Space

__all__ = [
    "Arrows", "Curves", "Exhibit", "Film", "Flat", "Hand", "Knob", "Number", "Pane", "Path", "Preset", "Segments",
    "Solid", "Space",
    "ball", "box", "capsule", "image", "joined", "labelled", "mesh", "page", "show", "standing", "svg",
]  # fmt: skip


def show(
    shown: Film | Exhibit, *, still: float | None = None, large: bool = False
) -> Any:
    """Play a film or an exhibit; the last line of a cell.

    In JupyterLab and Voila a widget; in a saved notebook a picture of one moment, with
    alternative text.

    Args:
        shown: what is played.
        still: the time of the picture [s]; default: the first.
        large: text and controls for a lecture room.
    """
    from course.workbook.stage.widget import StageWidget

    return StageWidget(as_exhibit(shown), still=still, large=large)
