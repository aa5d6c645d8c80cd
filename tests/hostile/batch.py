"""Hand in a family beside honest neighbours, grade it in a process of its own, and look at all that came of it."""

from __future__ import annotations

import contextlib
import csv
import json
import os
import re
import stat
import subprocess
import sys
import tempfile
from collections.abc import Iterator, Sequence
from dataclasses import dataclass, field
from html.parser import HTMLParser
from pathlib import Path

from grading.toy_lessons import BLANK, blank, cell, notebook
from hostile.reaper import end_all
from hostile.submission import Hostile
from hostile.surroundings import SECRET, SEED, Surroundings, remove

HERE = Path(__file__).parent
GRADE = """
import sys
from pathlib import Path
sys.modules.setdefault("rfc3987_syntax", None)  # seconds at every import of nbformat
from course.exercises.definitions.toy_lessons import LESSONS
from course.grading.grade import grade_folder
folder, out, seed, limit, memory = sys.argv[1:]
print(grade_folder(Path(folder), Path(out), seed=int(seed), time_limit=float(limit),
                   memory_mb=int(memory), workers=2, lessons=LESSONS))
"""
MEMORY_MB = 600
POINTS = {"twice": 2, "split": 2, "area": 3}
NEIGHBOURS = ("Aaron", "Nina", "Zoe")


@dataclass
class Batch:
    """What came of a batch: its rows by submission, and every fault that is nobody's own."""

    rows: dict[str, list[dict[str, str]]]
    faults: list[str] = field(default_factory=list)
    said: str = ""
    seconds: float = 0.0
    whole: bool = True


@contextlib.contextmanager
def surroundings() -> Iterator[Surroundings]:
    """Fresh surroundings; their path is short, because a socket's must be."""
    root = Path(tempfile.mkdtemp(prefix="hostile-")).resolve()
    try:
        yield Surroundings(root)
    finally:
        remove(root)


def grade(family: Sequence[Hostile], *, limit: float, bound: float) -> Batch:
    """Grade a family beside its neighbours, and gather what is wrong with the whole."""
    with surroundings() as around:
        around.listen()
        _hand_in(family, around)
        before, left = around.watched(), around.left()
        told = _run(around, limit, bound)
        rows = _rows(around.table)
        batch = Batch(_by_name(family, rows), **told)
        after = around.watched()
        batch.faults += [
            f"changed outside: {path}"
            for path in sorted(before.keys() | after.keys())
            if before.get(path) != after.get(path)
        ]
        batch.faults += [f"left: {w}" for w in around.left() if w not in left]
        batch.faults += [f"heard: {words}" for words in around.listeners.heard()]
        batch.faults += _told_too_much(family, around)
        batch.faults += _neighbours(rows)
        batch.faults += _table_and_pages(family, rows, around)
        around.listeners.close()
        return batch


def _hand_in(family: Sequence[Hostile], around: Surroundings) -> None:
    secret = cell(f"# {SECRET}")
    light = {"area": BLANK["area"]}  # SymPy takes a second to load
    for name in NEIGHBOURS:
        own = notebook(cells=[secret], **({} if name == "Nina" else light))
        _write(around.handed_in / name / "90-toy.ipynb", json.dumps(own).encode())
    _write(around.handed_in / "Blank" / "90-toy.ipynb", json.dumps(blank()).encode())
    for one in family:
        path = around.handed_in / (one.file or f"{one.name}/90-toy.ipynb")
        content = one.handed_in(around.places(one.name))
        path.parent.mkdir(parents=True, exist_ok=True)
        _special(one.special, path, around) or _write(path, content)
        if one.special == "closed":
            path.chmod(0)


def _write(path: Path, content: bytes) -> None:
    path.parent.mkdir(parents=True, exist_ok=True)
    path.write_bytes(content)


def _special(kind: str, path: Path, around: Surroundings) -> bool:
    """Put something else than a file at the path; False where a file belongs there."""
    nina = around.handed_in / "Nina"
    if kind == "folder":
        path.mkdir()
    elif kind == "link":
        path.symlink_to(nina / "90-toy.ipynb")
    elif kind == "dangling":
        path.symlink_to("nothing")
    elif kind == "loop":
        path.symlink_to(path.name)
    elif kind == "folder-link":
        path.symlink_to(around.checkout / "solutions")
    elif kind == "fifo":
        os.mkfifo(path)
    elif kind == "socket":
        os.mknod(path, stat.S_IFSOCK | 0o600)
    else:
        return False
    return True


def _run(around: Surroundings, limit: float, bound: float) -> dict:
    path = os.pathsep.join([str(around.checkout), str(around.site)])
    kept = {k: v for k, v in os.environ.items() if k in ("PATH", "LD_LIBRARY_PATH")}
    places = {"HOME": str(around.home), "TMPDIR": str(around.tmp), "PYTHONPATH": path}
    more = {"GRADER_TOKEN": SECRET, "PYTHONDONTWRITEBYTECODE": "1", "LANG": "C.UTF-8",
            "OPENBLAS_NUM_THREADS": "1"}  # fmt: skip
    command = [sys.executable, "-c", GRADE, str(around.handed_in), str(around.table), SEED,
               str(limit), str(MEMORY_MB)]  # fmt: skip
    told = {
        "command": command, "environment": kept | places | more, "seconds": 2 * bound,
        "cwd": str(around.table.parent), "said": str(around.root / "said"), "patience": 1.0,
        "answer": str(around.root / "answer"),
    }  # fmt: skip
    (around.root / "told").write_text(json.dumps(told))
    reaper = [sys.executable, str(HERE / "reaper.py"), str(around.root / "told")]
    ended = subprocess.run(reaper, check=False).returncode
    if ended:  # an answer whose parent was gone took the reaper for it
        end_all(str(around.root))
        return {"faults": [f"the grader and what ran it were killed ({ended})"],
                "said": "", "seconds": 0.0, "whole": False}  # fmt: skip
    answer = json.loads((around.root / "answer").read_text())
    said = (around.root / "said").read_text(errors="replace")
    faults = [f"left running: {words}" for words in answer["left"]]
    if answer["code"] != 0:
        faults.append(f"the batch ended with {answer['code']}: {said[-1500:]}")
    if answer["seconds"] > bound:
        faults.append(
            f"the batch took {answer['seconds']:.1f} s, more than {bound:.0f}"
        )
    return {
        "faults": faults,
        "said": said,
        "seconds": answer["seconds"],
        "whole": answer["code"] == 0,
    }


def _rows(table: Path) -> list[dict[str, str]]:
    if not table.exists():
        return []
    with table.open(encoding="utf-8-sig", newline="") as file:
        return list(csv.DictReader(file))


def _by_name(
    family: Sequence[Hostile], rows: Sequence[dict[str, str]]
) -> dict[str, list[dict[str, str]]]:
    return {
        one.name: [
            row
            for row in rows
            if re.search(
                rf"(?<![\w-]){re.escape(one.name)}(?![\w-])", row["file"] or ""
            )
        ]
        for one in family
    }


def faults_of(one: Hostile, rows: Sequence[dict[str, str]]) -> list[str]:
    """What is wrong with the rows of one submission."""
    if one.expect == "any":
        return []
    if len(rows) != 1:
        return [f"{one.name}: {len(rows)} rows"]
    row = rows[0]
    names = list(POINTS) if one.exercise == "*" else [one.exercise]
    got = [(row.get(n), row.get(f"{n}_state"), row.get(f"{n}_reason")) for n in names]
    words = (
        f"{one.name}: expected {one.expect}; got {got} {row['state']} {row['reason']}"
    )
    states = [state for _, state, _ in got]
    full = [(str(POINTS[n]), "passed") for n in names]
    right = {
        "full": [(points, state) for points, state, _ in got] == full,
        "none": all(p in ("", "0") and s != "passed" for p, s, _ in got),
        "person": states == ["needs a person"] and row["state"] == "needs a person",
        "unusable": row["state"] == "unusable" and bool(row["reason"]),
        "row": True,
    }[one.expect]
    others = [row[n] for n in POINTS if n not in names and one.content is None]
    if any(points not in ("", "0") for points in others):
        right, words = False, words + f", and {others} for exercises left blank"
    return [] if right else [words]


def _neighbours(rows: Sequence[dict[str, str]]) -> list[str]:
    wanted = {"Aaron": "4", "Blank": "0", "Nina": "7", "Zoe": "4"}
    faults = []
    for name, points in wanted.items():
        own = [row for row in rows if row["file"] == f"{name}/90-toy.ipynb"]
        if [(row["total"], row["state"]) for row in own] != [(points, "marked")]:
            faults.append(f"the neighbour {name} got {own}, not {points} points")
    return faults


def _told_too_much(family: Sequence[Hostile], around: Surroundings) -> list[str]:
    texts = {"the table": around.table.read_text("utf-8", "replace")
             if around.table.exists() else ""}  # fmt: skip
    for page in sorted(around.pages.glob("*")) if around.pages.exists() else ():
        texts[f"the page {page.name}"] = page.read_text("utf-8", "replace")
    faults = []
    for where, text in texts.items():
        if SECRET in text:
            faults.append(f"the secret is in {where}")
        faults += [
            f"{one.name} succeeded, says {where}"
            for one in family
            if around.won(one.name) in text
        ]
    return faults


class _Page(HTMLParser):
    """Counts what is live in a page."""

    def __init__(self) -> None:
        super().__init__()
        self.live: list[str] = []

    def handle_starttag(self, tag: str, attrs: list[tuple[str, str | None]]) -> None:
        if tag in ("script", "img", "svg", "iframe", "object", "form", "base", "link"):
            self.live.append(tag)
        self.live += [name for name, _ in attrs if name.startswith("on")]
        self.live += [v for _, v in attrs if v and v.strip().startswith("javascript:")]

    def handle_comment(self, data: str) -> None:
        self.live.append("comment")


def _table_and_pages(
    family: Sequence[Hostile],
    rows: Sequence[dict[str, str]],
    around: Surroundings,
) -> list[str]:
    faults = []
    wanted = sum(one.expect != "any" for one in family) + len(NEIGHBOURS) + 1
    some = sum(one.expect == "any" for one in family)
    if not wanted <= len(rows) <= wanted + some:
        faults.append(f"{len(rows)} rows for {wanted} submissions")
    for row in rows:
        for column, value in row.items():
            if not isinstance(value, str) or not isinstance(column, str):
                faults.append(f"a row with other columns: {row['file']}")
            elif value[:1] in tuple("=+-@\t\r\uff1d\uff0b\uff0d\uff20"):
                faults.append(f"a formula in {column} of {row['file']}: {value[:60]}")
            elif re.search(r"[\x00-\x1f\x7f-\x9f\u202a-\u202e\u2066-\u2069]", value):
                faults.append(f"a control character in {column}: {value[:60]!r}")
    pages = sorted(around.pages.glob("*.html")) if around.pages.exists() else []
    if len(pages) < len(rows):
        faults.append(f"{len(pages)} pages for {len(rows)} rows")
    for page in pages:
        reader = _Page()
        reader.feed(page.read_text("utf-8", "replace"))
        if reader.live:
            faults.append(f"live in the page {page.name}: {reader.live[:3]}")
    return faults
