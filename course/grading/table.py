"""The table of marks on disk: a row per submission, written as soon as it is judged.

An interrupted batch keeps its rows. The table is its own memory: its last column,
``key``, is a digest of everything the marks depend on, and a row whose key still fits
is not made again. A finished row survives the end of the program in any form, ``kill
-9`` too; a power failure may take the last ones, because rows are not flushed to the
disk one by one.
"""

from __future__ import annotations

import csv
import io
import os
import re
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path

from course.grading.report import AGAIN, FIRST, LAST, columns, exercises_of
from course.grading.writing import CannotWrite, write_whole

KEY = re.compile(rf"(?:{AGAIN})?[0-9a-f]{{64}}")
BYTE_ORDER_MARK = "\ufeff"  # by it Excel recognizes UTF-8
SEPARATORS = ",;\t"
LINE = re.compile(r"[^\r\n]*(?:\r\n|\r|\n)|[^\r\n]+")
# bytes of one row: a comment may have several lines, a damaged row has no end
MOST_LINES = 200


@dataclass(frozen=True)
class Found:
    """What a table held: its exercises, the columns somebody added, and its complete
    rows.
    """

    exercises: tuple[str, ...] = ()
    more: tuple[str, ...] = ()
    rows: tuple[dict[str, str], ...] = ()


def read_table(path: Path) -> Found:
    """The contents of an existing table, even if Excel has saved it; empty for a new
    file.

    An incomplete row (the last one, if a program was killed while writing it) is left
    out. Raises ``ValueError`` for a file that holds something else: it is not ours to
    overwrite.
    """
    wanted = f"out: expected a table of marks or a new file; {path}"
    try:
        content = path.read_bytes() if path.exists() else b""
    except OSError as error:
        raise ValueError(
            f"{wanted} cannot be read ({error.strerror or error})"
        ) from None
    if not content:
        return Found()
    text = _decoded(content)
    header, separator = _header(text)
    if not header:
        raise ValueError(f"{wanted} holds something else")
    exercises = tuple(exercises_of(dict.fromkeys(header, "")))
    known = columns(exercises)
    rows = {row["key"]: row for row in _rows(text, header, separator)}
    return Found(
        exercises, tuple(c for c in header if c not in known), tuple(rows.values())
    )


def is_table(first: bytes) -> bool:
    """Whether a file with this beginning is a table of marks."""
    return bool(_header(_decoded(first))[0])


def _decoded(content: bytes) -> str:
    """The text: ours is UTF-8; Excel also saves in its country's code page, or in
    UTF-16.
    """
    if content[:2] in (b"\xff\xfe", b"\xfe\xff"):
        return content.decode("utf-16", "replace")
    try:
        return content.decode("utf-8-sig")
    except UnicodeDecodeError as error:
        # UTF-8 that is cut off within its last character is still UTF-8.
        near_end = error.start >= len(content) - 4
        kind = "utf-8-sig" if near_end else "cp1252"
        return content.decode(kind, "replace")


def _header(text: str) -> tuple[list[str], str]:
    """The columns and their separator; both empty where it is no table of marks."""
    first = re.split(r"[\r\n]", text, maxsplit=1)[0]
    for separator in SEPARATORS:
        cells = _cells(first, separator)
        # A table of an older version has fewer columns; an edited one may have more.
        if cells[:3] == list(FIRST[:3]) and {*FIRST[:-1], "seed", LAST[-1]} <= {*cells}:
            return cells, separator
    return [], ""


def _rows(text: str, header: Sequence[str], separator: str) -> list[dict[str, str]]:
    """The complete rows.

    A line that is complete by itself ends a damaged row before it, whatever quotes that
    left open.
    """
    found: list[dict[str, str]] = []
    pending: list[str] = []
    for line in LINE.findall(text.replace("\0", ""))[1:]:
        for lines in ([line], [*pending, line]):
            row = _whole("".join(lines), header, separator)
            if row:
                found.append(row)
                pending = []
                break
        else:
            pending = [*pending, line][-MOST_LINES:]
    return found


def _whole(text: str, header: Sequence[str], separator: str) -> dict[str, str] | None:
    cells = _cells(text, separator)
    if len(cells) != len(header):
        return None
    row = dict.fromkeys((*FIRST, *LAST), "") | dict(zip(header, cells, strict=True))
    return row if KEY.fullmatch(row["key"]) else None


def _cells(text: str, separator: str) -> list[str]:
    """The cells of one row; none where the text is not exactly one."""
    try:
        lines = io.StringIO(text, newline="")
        rows = list(csv.reader(lines, delimiter=separator, strict=True))
    except csv.Error:
        return []
    return rows[0] if len(rows) == 1 else []


def _place(row: Mapping[str, str]) -> tuple[str, str]:
    return row["file"], row["key"]


class Table:
    """The table on disk: first the complete rows, then one more with every ``add``.

    ``close`` sorts them. ``order`` is the order of the exercises' columns; an exercise
    gets its columns with the first row that has it. ``stale`` are rows of submissions
    that are being marked again: each stays until its successor is there.
    """

    def __init__(
        self,
        path: Path,
        order: Sequence[str],
        rows: Sequence[Mapping[str, str]],
        *,
        stale: Sequence[Mapping[str, str]] = (),
        more: Sequence[str] = (),
    ) -> None:
        self.path, self.order, self.more = path, tuple(order), tuple(more)
        self.rows = [dict(row) for row in rows]
        self.stale = [dict(row) for row in stale]
        self._before = {row["file"]: row for row in self.stale}
        self._number = -1
        self.columns: tuple[str, ...] = ()
        self._write_whole()

    def add(self, cells: Mapping[str, str]) -> None:
        """Append a row; the system has it when this returns.

        Raises ``CannotWrite``, and then the file is as before.
        """
        before = self._before.get(cells["file"], {})
        row = {**cells, **{name: before.get(name, "") for name in self.more}}
        self.rows.append(row)
        try:
            if set(exercises_of(row)) <= set(self.columns) and self._is_there():
                self._append(self._text([row]).encode("utf-8", "replace"))
            else:
                self._write_whole()
        except OSError as error:
            self.rows.pop()
            kept = f"the {len(self.rows)} rows made so far are kept"
            cause = error.__cause__ if isinstance(error, CannotWrite) else error
            assert isinstance(cause, OSError)
            raise CannotWrite(self.path, cause, kept) from error

    def close(self) -> None:
        """Sort the rows by file: they were added in the order in which they were
        finished.
        """
        new = {row["file"] for row in self.rows}
        self.stale = [row for row in self.stale if row["file"] not in new]
        self.rows.sort(key=_place)
        try:
            self._write_whole()
        except OSError:
            pass  # every row is in it, in the order of arrival
        finally:
            self._let_go()

    def _is_there(self) -> bool:
        """Whether the open file still has this name.

        An editor that saves may replace it, or somebody may delete it.
        """
        try:
            return os.path.samestat(os.stat(self.path), os.fstat(self._number))
        except OSError:
            return False

    def _append(self, line: bytes) -> None:
        """Write the whole line or nothing."""
        size = os.fstat(self._number).st_size
        try:
            while line:
                line = line[os.write(self._number, line) :]
        except BaseException:
            os.ftruncate(self._number, size)
            raise

    def _write_whole(self) -> None:
        self._let_go()
        rows = sorted([*self.stale, *self.rows], key=_place)
        used = {name for row in rows for name in exercises_of(row)}
        known = [name for name in self.order if name in used]
        others = sorted(used - set(known))
        self.columns = columns([*known, *others], self.more)
        text = BYTE_ORDER_MARK + self._text([dict(zip(self.columns, self.columns, strict=True)), *rows])  # fmt: skip
        try:
            write_whole(self.path, text, lasting=True)
        finally:
            if self.path.exists():
                flags = os.O_WRONLY | os.O_APPEND
                for name in ("O_BINARY", "O_CLOEXEC"):
                    flags |= getattr(os, name, 0)
                self._number = os.open(self.path, flags)

    def _text(self, rows: Sequence[Mapping[str, str]]) -> str:
        text = io.StringIO(newline="")
        writer = csv.DictWriter(
            text, self.columns, restval="", extrasaction="ignore", lineterminator="\n"
        )
        writer.writerows(rows)
        return text.getvalue()

    def _let_go(self) -> None:
        if self._number >= 0:
            os.close(self._number)
        self._number = -1
