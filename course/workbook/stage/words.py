"""A film in words: what moves, what is drawn, how it ends; the alternative to looking."""

from __future__ import annotations

from collections import Counter

import numpy as np

from course.workbook.stage.film import Film
from course.workbook.stage.panes import Arrows, Pane


def description(film: Film, time: float | None = None) -> str:
    """Alternative text of the film, or of its picture at a time [s]."""
    times = np.asarray(film.times)
    said = [_sentence(film.title), _sentence(film.caption)]
    said.append(_sentence(" Beside it, ".join(_bodies(pane) for pane in film.panes)))
    if film.moves and time is None:
        said.append(f"Plays {times[-1] - times[0]:.3g} s of motion.")
    elif film.moves:
        said.append(f"The picture is of {time:.3g} s.")
    drawn = {a.name: scale_in_words(a) for pane in film.panes for a in pane.arrows}
    if drawn:
        listed = "; ".join(f"{name}, {words}" for name, words in drawn.items())
        said.append(f"Arrows: {listed}.")
    said.append(_sentence(film.ending))
    for number in film.numbers:
        values = ", ".join(shown_number(v, number.digits) for v in number.values)
        said.append(f"{number.name}: {values} {number.unit}".rstrip() + ".")
    return " ".join(s for s in said if s)


def scale_in_words(arrows: Arrows) -> str:
    """How long an arrow is drawn: "0.2 m for 1 m/s"."""
    if not arrows.unit:
        return "unit vectors"
    longest = float(np.linalg.norm(arrows.vector, axis=-1).max(initial=0.0))
    tenth = 10.0 ** np.floor(np.log10(longest)) if 0 < longest < 0.5 else 1.0
    return f"{tenth * float(arrows.scale or 1):.3g} m for {tenth:g} {arrows.unit}"


def shown_number(value: float, digits: int) -> str:
    """A number for reading: ``digits`` significant ones, a true minus, never -0.

    What is below 1e-12 is rounding, and written as 0.
    """
    if np.isnan(value):
        return "–"
    if np.isinf(value):
        return "∞" if value > 0 else "−∞"
    if abs(value) < 1e-12:
        return "0"
    if value and not 1e-4 <= abs(value) < 1e8:
        text = f"{value:.{digits}g}"
    else:  # an exponent is nothing to read aloud
        text = np.format_float_positional(
            value, precision=digits, unique=False, fractional=False, trim="-"
        )
    return text.replace("-", "\N{MINUS SIGN}")


def _sentence(text: str) -> str:
    text = text.strip()
    return text if not text or text.endswith((".", "?", "!")) else f"{text}."


def _bodies(pane: Pane) -> str:
    counted = Counter(s.what for s in pane.solids)
    listed = [
        f"{n} {_several(what)}" if n > 1 else f"a {what}" for what, n in counted.items()
    ]
    title = f"{pane.title}: " if pane.title else "The picture shows "
    return title + (", ".join(listed) or "no bodies")


def _several(what: str) -> str:
    return f"{what}es" if what.endswith(("x", "sh")) else f"{what}s"
