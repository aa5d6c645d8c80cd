"""What ``course test`` runs: stages, each in a process of its own, summed up in the last line.

A stage that fails does not hide the ones after it. Tests write nothing to work/ (they run elsewhere) and nothing to
the user's home: Jupyter, IPython and matplotlib get folders of their own. BLAS runs on one thread.
"""

from __future__ import annotations

import os
import subprocess
import sys
import tempfile
import time
from collections.abc import Callable
from dataclasses import dataclass
from pathlib import Path
from typing import Literal
from xml.etree import ElementTree

Tier = Literal["quick", "standard", "all"]
TIERS: tuple[Tier, ...] = ("quick", "standard", "all")
#: Each film at both ends of its knobs: they wait for nobody else, so that two can run at once.
FILMS = "tests/browser/test_films_in_browser.py"
ELSEWHERE = "browser or node or peers or fresh or long"  # markers of the tests that only --all runs
CELL_SECONDS = 60
NOTHING_COLLECTED = 5  # pytest's exit code


@dataclass(frozen=True)
class Stage:
    """A stage: its command (after the interpreter), the first tier that runs it, and what it needs to have a sense."""

    name: str
    command: tuple[str, ...]
    tier: Tier = "standard"
    needs: str = (
        ""  # a glob below the project; without a match the stage is passed over
    )
    may_be_empty: bool = False  # whether it may collect no test

    @property
    def by_pytest(self) -> bool:
        """Whether pytest counts (any other command counts as one)."""
        return self.command[:2] == ("-m", "pytest")


@dataclass(frozen=True)
class Count:
    """How many passed, failed, were skipped."""

    passed: int = 0
    failed: int = 0
    skipped: int = 0

    def __add__(self, other: Count) -> Count:
        return Count(
            self.passed + other.passed,
            self.failed + other.failed,
            self.skipped + other.skipped,
        )

    def __str__(self) -> str:
        return f"{self.passed} passed, {self.failed} failed, {self.skipped} skipped"


def _commands() -> tuple[tuple[str, ...], tuple[str, ...], tuple[str, ...]]:
    """How pytest is started, in several processes, and for notebooks."""
    processes = ("-n", str(min(2, os.cpu_count() or 1)))
    workers = (
        *processes,
        "--dist",
        "worksteal",
        "--durations",
        "5",
        "--durations-min",
        "2",
        "--timeout-method=thread",  # ends a compiled loop too; xdist starts a worker anew
    )
    notebook_runner = ("-m", "pytest", "-q", "--no-header", "-rs")
    pytest = (
        *notebook_runner,
        "-p",
        "no:nbval",
    )  # its import takes longer than many a test
    notebooks = (*notebook_runner, *processes, "--dist", "loadfile", "-p", "no:doctest", "--nbval-current-env",
                 "--nbval-cell-timeout", str(CELL_SECONDS),
                 "--nbval-sanitize-with", "tests/nbval_sanitize.cfg")  # fmt: skip
    return pytest, workers, notebooks


def stages(tier: Tier) -> list[Stage]:
    """The stages of a tier, the quick ones first."""
    pytest, workers, notebooks = _commands()
    unit = f"not ({ELSEWHERE} or slow)" if tier == "quick" else f"not ({ELSEWHERE})"
    everything = [
        Stage("lint", ("-m", "ruff", "check", "."), "quick"),
        Stage("format", ("-m", "ruff", "format", "--check", "."), "quick"),
        Stage("unit tests", (*pytest, *workers, "-m", unit, "tests"), "quick"),
        Stage("doctests", (*pytest, "--doctest-modules", "course")),
        Stage("types", ("-m", "mypy"), "standard"),
        Stage("lessons as built", ("-m", "course", "build", "--check")),
        Stage("solutions, strict", (*notebooks, "--nbval", "solutions"), needs="solutions/*.ipynb"),
        Stage("lessons, as handed out", (*notebooks, "--nbval-lax", "lessons"), needs="lessons/*.ipynb"),
        Stage("long tests", (*pytest, *workers, "-m", f"long and not ({ELSEWHERE.removesuffix(' or long')})",
                             "tests"), "all", may_be_empty=True),
        Stage("the stage's program", (*pytest, "-m", "node", "tests"), "all", may_be_empty=True),
        Stage("films in a browser", (*pytest, *workers, "-m", "browser", FILMS), "all", may_be_empty=True),
        Stage("browser", (*pytest, "-m", "browser", "tests", f"--ignore={FILMS}"), "all", may_be_empty=True),
        Stage("peers", (*pytest, "-m", "peers", "tests"), "all", may_be_empty=True),
        Stage("fresh clone", (*pytest, "-m", "fresh", "tests"), "all", may_be_empty=True),
    ]  # fmt: skip
    return [
        stage for stage in everything if TIERS.index(stage.tier) <= TIERS.index(tier)
    ]


def run_tests(root: Path, tier: Tier, *, chosen: list[Stage] | None = None,
              say: Callable[[str], None] | None = None) -> int:  # fmt: skip
    """Run a tier (or the ``chosen`` stages); returns 0 when nothing failed, else 1. The last line sums up."""
    say = say or (lambda line: print(line, flush=True))
    total, times = Count(), []
    with tempfile.TemporaryDirectory(
        prefix="course-test-", ignore_cleanup_errors=True
    ) as scratch:
        for stage in stages(tier) if chosen is None else chosen:
            if stage.needs and not any(root.glob(stage.needs)):
                say(f"== {stage.name}: nothing at {stage.needs} yet")
                continue
            say(f"== {stage.name}")
            started = time.monotonic()
            count = run_stage(stage, root, Path(scratch))
            total += count
            times.append(
                f"{stage.name:<24}{time.monotonic() - started:7.1f} s   {count}"
            )
            say(f"   {times[-1]}\n")
    for line in times:
        say(line)
    say(str(total))
    return 1 if total.failed else 0


def run_stage(stage: Stage, root: Path, scratch: Path) -> Count:
    """Run one stage with its output passed through, and count."""
    report = scratch / "report.xml"
    report.unlink(missing_ok=True)
    command = [sys.executable, *stage.command]
    if stage.by_pytest:
        command.append(f"--junitxml={report}")
    code = subprocess.run(
        command, cwd=root, env=environment_for_tests(root, scratch), check=False
    ).returncode
    if not stage.by_pytest:
        return Count(passed=1) if code == 0 else Count(failed=1)
    if code == NOTHING_COLLECTED and stage.may_be_empty:
        return Count()
    count = read_report(report)
    return (
        count if code == 0 or count.failed else count + Count(failed=1)
    )  # pytest itself broke down


def read_report(report: Path) -> Count:
    """Sum the suites of a JUnit report; none at all where pytest did not come to write it."""
    try:
        suites = list(ElementTree.parse(report).getroot().iter("testsuite"))
    except (OSError, ElementTree.ParseError):
        return Count()
    tests, failures, errors, skipped = (
        sum(int(suite.get(key, 0)) for suite in suites)
        for key in ("tests", "failures", "errors", "skipped")
    )
    return Count(tests - failures - errors - skipped, failures + errors, skipped)


def environment_for_tests(root: Path, scratch: Path) -> dict[str, str]:
    """One BLAS thread; this checkout and this interpreter's kernel first; nothing kept in the user's home."""
    threads = dict.fromkeys(("OPENBLAS_NUM_THREADS", "OMP_NUM_THREADS", "MKL_NUM_THREADS",
                             "VECLIB_MAXIMUM_THREADS", "NUMEXPR_NUM_THREADS"), "1")  # fmt: skip
    folders = {name: str(scratch / name.lower()) for name in
               ("JUPYTER_CONFIG_DIR", "JUPYTER_DATA_DIR", "JUPYTER_RUNTIME_DIR", "IPYTHONDIR")}  # fmt: skip
    # nbval minds the first; without the second pytest rewrites every test file anew.
    left_out = ("MPLBACKEND", "PYTHONDONTWRITEBYTECODE")
    kept = {name: v for name, v in os.environ.items() if name not in left_out}
    path = os.pathsep.join(filter(None, [str(root), os.environ.get("PYTHONPATH", "")]))
    return {**kept, **threads, **folders, "PYTHONPATH": path, "JUPYTER_PREFER_ENV_PATH": "1",
            "MPLCONFIGDIR": str(root / ".pytest_cache" / "matplotlib")}  # fmt: skip
