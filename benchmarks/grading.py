"""How long a grader waits for a thousand submissions of lesson 10, each in a box, and where the time goes."""

from __future__ import annotations

import json
import sys
import tempfile
import time
from pathlib import Path

from benchmarks.measure import Row, seconds
from course.exercises.definition import find_lesson
from course.grading.grade import grade_folder
from course.grading.judge import Judge
from course.sandbox.limits import Limits
from course.sandbox.running import Sandbox, find_isolation

SOLUTIONS = Path(__file__).resolve().parents[1] / "solutions"
SUBMISSIONS, WORKERS, WAIT = 1000, 2, 360.0
#: Every so many is wrong in its first exercise: a diagnosis costs more than a pass.
WRONG = 4


def rows() -> list[Row]:
    """Six minutes against the time taken by two workers; then the parts of one submission."""
    found = find_isolation(Limits())
    with tempfile.TemporaryDirectory() as folder:
        base = Path(folder)
        _hand_in(base / "handed-in", SUBMISSIONS)
        before = _peak_mb()
        started = time.perf_counter()
        summary = grade_folder(
            base / "handed-in", base / "t.csv", seed=1, workers=WORKERS
        )
        took = time.perf_counter() - started
        grown = _peak_mb() - before
    told = (
        f"{SUBMISSIONS} submissions, one in {WRONG} wrong, {WORKERS} workers, {found}: {took:.0f} s, "
        f"{60 * SUBMISSIONS / took:.0f} a minute, {summary.marked} marked; memory grew by {grown:.0f} MB"
    )
    return [
        Row("six minutes / 1,000 submissions of lesson 10", WAIT / took, 1.0, told),
        Row("one submission alone [s]", _alone(found.boxed), None, _parts(found.boxed)),
    ]


def _hand_in(folder: Path, count: int) -> None:
    right = (SOLUTIONS / "10-impulse.ipynb").read_text(encoding="utf-8")
    wrong = right.replace("(1 + restitution)", "(1 - restitution)")
    for k in range(count):
        place = folder / f"student_{k:04d}" / "10-impulse.ipynb"
        place.parent.mkdir(parents=True)
        text = wrong if k % WRONG == 0 else right
        told = json.loads(text)
        told["metadata"]["number"] = k  # no two are the same file
        place.write_text(json.dumps(told), encoding="utf-8")


def _content() -> bytes:
    return (SOLUTIONS / "10-impulse.ipynb").read_bytes()


def _alone(boxed: bool) -> float:
    judge = Judge(1, Sandbox(Limits(), boxed))
    return seconds(lambda: list(judge.rows(_content(), "10-impulse.ipynb")[1]))


def _parts(boxed: bool) -> str:
    """Seconds of one submission by part: until it is read, then the runs, as the process itself counts them."""
    judge = Judge(1, Sandbox(Limits(), boxed))
    began = time.perf_counter()
    lesson, rows = judge.rows(_content(), "10-impulse.ipynb")
    read = time.perf_counter() - began
    made = list(rows)
    whole = time.perf_counter() - began
    runs = sum(row.seconds for row in made)
    assert lesson.number == find_lesson("10").number
    return (
        f"started and read {read:.2f} s, {len(made)} runs {runs:.2f} s, "
        f"packages and judging {whole - read - runs:.2f} s"
    )


def _peak_mb() -> float:
    """The most memory this process has had; Linux counts it in kB, macOS in bytes."""
    import resource  # POSIX has it

    unit = 1e6 if sys.platform == "darwin" else 1e3
    return float(resource.getrusage(resource.RUSAGE_SELF).ru_maxrss) / unit
