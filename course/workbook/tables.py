"""Results as a table: HTML in a notebook, aligned text elsewhere, from columns or rows."""

from __future__ import annotations

import html
import re
import unicodedata
from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np

from course.arrays import failure, written
from course.exercises.letters import with_letters
from course.workbook.columns import column_text, is_number, with_powers
from course.workbook.numbers import NOISE

#: Places after the decimal point or significant digits: of all columns, or of each.
Places = int | Sequence[int | None] | None
_UNIT = re.compile(r" ?\[[^\]]*\]|(?<=\d) (?=[A-Za-z]{1,2}\b)")


@dataclass(frozen=True)
class Table:
    """Headings and rows of text; displays itself. The first cell of a row says what it is
    about."""

    headings: tuple[str, ...]
    rows: tuple[tuple[str, ...], ...]
    caption: str = ""

    def _of_numbers(self) -> list[bool]:
        """Which columns hold nothing but numbers: these are aligned right."""
        columns = zip(*self.rows, strict=True)
        return [all(map(is_number, column)) for column in columns]

    def __str__(self) -> str:
        lines = (self.headings, *self.rows)
        widths = [max(map(_width, column)) for column in zip(*lines, strict=True)]
        shown = [
            "   ".join(
                " " * (width - _width(cell)) + cell
                if right
                else cell + " " * (width - _width(cell))
                for cell, width, right in zip(
                    line, widths, self._of_numbers(), strict=True
                )
            ).rstrip()
            for line in lines
        ]
        return "\n".join([self.caption, *shown] if self.caption else shown)

    __repr__ = __str__

    def _repr_html_(self) -> str:
        sides = ["right" if right else "left" for right in self._of_numbers()]
        head = "".join(
            f'<th scope="col" style="text-align: {side}; {_HEADING}">{_unbroken(cell)}</th>'
            for cell, side in zip(self.headings, sides, strict=True)
        )
        body = "\n".join(
            f"<tr>{''.join(map(_html_cell, row, sides, range(len(row))))}</tr>"
            for row in self.rows
        )
        caption = html.escape(self.caption)
        above = f'<caption style="{_CAPTION}">{caption}</caption>' if caption else ""
        return (
            f'<div style="overflow-x: auto"><table style="{_TABLE}">{above}\n'
            f"<thead><tr>{head}</tr></thead>\n<tbody>\n{body}\n</tbody></table></div>"
        )


# A notebook's page has no style of ours. Colours are the page's own, dark or light.
_TABLE = (
    "border-collapse: collapse; margin: 0.4em 0; color: inherit;"
    " font-size: inherit; font-variant-numeric: tabular-nums"
)
_CAPTION = "caption-side: top; text-align: left; color: inherit; padding: 0 0 0.3em"
_CELL = "padding: 0.25em 1.2em 0.25em 0.3em"
_HEADING = (
    f"{_CELL}; vertical-align: bottom; max-width: 11em; white-space: normal;"
    " border-bottom: 1px solid currentColor"
)


def tabulate(
    columns: Mapping[str, Any] | Sequence[str],
    rows: Iterable[Sequence[Any]] | None = None,
    *,
    digits: Places = 3,
    decimals: Places = None,
    noise: float = NOISE,
    caption: str = "",
) -> Table:
    """A table that a notebook shows, of columns by their headings, or of rows.

    ``tabulate({"h [s]": steps, "error [m]": errors}, digits=2)`` is given columns; one
    value is repeated in every row. ``tabulate(["h [s]", "error [m]"], rows)`` is given
    headings and rows, as a loop collects them. The first column says what a row is about.
    End a cell with it, or show several with ``display``.

    A number is rounded to significant ``digits``, as ``show`` does it, or where
    ``decimals`` says so to places after the point; either is one number or one for each
    column. Zeros at its end are kept where they are known and others of its column have
    digits there. Whole numbers stay whole, text is text, and None is left empty. Headings
    and text are set in letters: omega_dot [rad/s^2] becomes ω̇ [rad/s²].

    Raises ``ValueError`` for columns or rows that are not of one length.
    """
    if isinstance(columns, Mapping):
        headings, cells = tuple(columns), _columns(columns)
    else:
        headings, cells = tuple(columns), _transposed(columns, rows)
    texts = [
        column_text(column, places, after, noise)
        for column, places, after in zip(
            cells,
            _each("digits", digits, len(headings)),
            _each("decimals", decimals, len(headings)),
            strict=True,
        )
    ]
    return Table(
        tuple(map(with_letters, headings)),
        tuple(zip(*texts, strict=True)),
        with_letters(caption),
    )


def _columns(columns: Mapping[str, Any]) -> list[Sequence[Any]]:
    """The cells of each column; single values are repeated."""
    many = {
        heading: list(values)
        for heading, values in columns.items()
        if not isinstance(values, str) and np.ndim(values) > 0
    }
    lengths = {heading: len(values) for heading, values in many.items()}
    if len(set(lengths.values())) > 1:
        raise failure("columns", "columns of one length", str(lengths))
    count = max(lengths.values(), default=1)
    if not columns or count == 0:
        raise failure("columns", "at least one row", written(dict(columns)))
    return [many.get(h, [values] * count) for h, values in columns.items()]


def _transposed(
    headings: Sequence[str], rows: Iterable[Sequence[Any]] | None
) -> list[Sequence[Any]]:
    """The cells of each column, from rows."""
    if isinstance(headings, str):
        raise failure("columns", "columns by heading, or headings", written(headings))
    listed = [tuple(row) for row in rows or ()]
    for index, row in enumerate(listed):
        if len(row) != len(headings):
            wanted = f"{len(headings)} cells in a row"
            raise failure("rows", wanted, str(len(row)), (index,))
    if not listed or not headings:
        raise failure("rows", "at least one row", written(rows))
    return list(zip(*listed, strict=True))


def _each(name: str, places: Places, count: int) -> list[int | None]:
    """The places of each column."""
    several = isinstance(places, Sequence) and not isinstance(places, str)
    listed: list[Any] = list(places) if several else [places] * count  # type: ignore[arg-type]
    good = [n is None or (type(n) is int and 0 <= n <= 15) for n in listed]
    if len(listed) != count or not all(good):
        expected = f"a whole number from 0 to 15, or {count} of them"
        raise failure(name, expected, written(places))
    return listed


def _html_cell(cell: str, side: str, index: int) -> str:
    tag, scope = ("td", "") if index else ("th", ' scope="row"')
    weight = "" if index else "; font-weight: normal"
    nowrap = "; white-space: nowrap" if side == "right" else ""
    shown = html.escape(with_powers(cell))
    if side == "right":
        shown = shown.replace("-", "\N{MINUS SIGN}")
    style = f"text-align: {side}; {_CELL}{nowrap}{weight}"
    return f'<{tag}{scope} style="{style}">{shown}</{tag}>'


def _unbroken(heading: str) -> str:
    """A heading whose units stay with what is before them."""
    glued = _UNIT.sub(
        lambda unit: unit.group().replace(" ", "\N{NO-BREAK SPACE}"), heading
    )
    return html.escape(glued)


def _width(text: str) -> int:
    """How many columns a text takes: accents stand on their letter."""
    return sum(not unicodedata.combining(letter) for letter in text)
