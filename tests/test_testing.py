"""What `course test` runs and how it adds up; tried on made-up projects."""

import os
import subprocess
import sys
from pathlib import Path

import pytest

from course import testing
from course.testing import (
    FILMS,
    Count,
    Stage,
    environment_for_tests,
    read_report,
    run_tests,
    stages,
)

ROOT = Path(__file__).resolve().parents[1]
PYTEST = (
    "-m",
    "pytest",
    "-q",
    "--no-header",
    "-p",
    "no:cacheprovider",
    "-p",
    "no:nbval",
)


def names(tier):
    return [stage.name for stage in stages(tier)]


def test_the_tiers_hold_what_the_design_says():
    assert names("quick") == ["lint", "format", "unit tests"]
    assert set(names("standard")) == {*names("quick"), "doctests", "types", "lessons as built", "solutions, strict",
                                      "lessons, as handed out"}  # fmt: skip
    assert set(names("all")) == {
        *names("standard"),
        "long tests",
        "the stage's program",
        "films in a browser",
        "browser",
        "peers",
        "fresh clone",
    }


def command(tier, name):
    return next(stage.command for stage in stages(tier) if stage.name == name)


def test_markers_choose_the_tests_of_a_tier():
    assert "not (browser or node or peers or fresh or long or slow)" in command(
        "quick", "unit tests"
    )
    assert "not (browser or node or peers or fresh or long)" in command(
        "standard", "unit tests"
    )
    for name, marker in (
        ("the stage's program", "node"),
        ("browser", "browser"),
        ("peers", "peers"),
        ("fresh clone", "fresh"),
    ):
        given = command("all", name)
        assert given[given.index("-m", 1) :][:3] == ("-m", marker, "tests")
    assert command("all", "browser")[-1] == f"--ignore={FILMS}"
    assert command("all", "films in a browser")[-3:] == ("-m", "browser", FILMS)


@pytest.mark.slow
def test_every_marker_is_declared_and_run_by_some_stage():
    lines = subprocess.run([sys.executable, "-m", "pytest", "-p", "no:nbval", "--markers"], cwd=ROOT,
                           capture_output=True, text=True, check=True).stdout  # fmt: skip
    for marker in ("slow", "long", "browser", "node", "peers", "fresh"):
        assert f"@pytest.mark.{marker}: " in lines


def test_notebooks_are_run_as_the_design_says():
    strict, lax = (
        command("standard", "solutions, strict"),
        command("standard", "lessons, as handed out"),
    )
    assert (
        "--nbval" in strict and "--nbval-lax" not in strict
    )  # both together would be lax
    assert "--nbval-lax" in lax and "--nbval" not in lax
    for notebooks in (strict, lax):
        assert (
            notebooks[notebooks.index("--dist") + 1] == "loadfile"
        )  # else a notebook's cells are split up
        assert notebooks[notebooks.index("--nbval-cell-timeout") + 1] == "60"
        sanitize = notebooks[notebooks.index("--nbval-sanitize-with") + 1]
        assert (ROOT / sanitize).is_file()


@pytest.fixture
def project(tmp_path):
    (tmp_path / "test_good.py").write_text(
        "import pytest\ndef test_a(): pass\ndef test_b(): pass\n"
        "def test_c(): pytest.skip('because')\n"
    )
    (tmp_path / "test_bad.py").write_text(
        "import pytest\ndef test_a(): assert 0\n"
        "@pytest.fixture\ndef broken(): raise OSError\ndef test_b(broken): pass\n"
    )
    (tmp_path / "test_unreadable.py").write_text("this is not Python")
    return tmp_path


def run(project, *chosen):
    said = []
    code = run_tests(project, "quick", chosen=list(chosen), say=said.append)
    return code, said


GOOD = Stage("good", (*PYTEST, "test_good.py"))
BAD = Stage("bad", (*PYTEST, "test_bad.py"))


@pytest.mark.slow
def test_a_failing_stage_hides_none_after_it(project, capfd):
    code, said = run(
        project,
        BAD,
        Stage("fine", ("-c", "pass")),
        Stage("lint", ("-c", "raise SystemExit(3)")),
        GOOD,
    )
    assert code == 1
    assert said[-1] == "3 passed, 3 failed, 1 skipped"
    assert [line for line in said if line.startswith("== ")] == [
        "== bad",
        "== fine",
        "== lint",
        "== good",
    ]
    assert any(
        "0 passed, 2 failed, 0 skipped" in line and " s " in line for line in said
    )
    assert "because" not in said[-1]


@pytest.mark.slow
def test_all_well_ends_with_0(project, capfd):
    code, said = run(project, GOOD)
    assert code == 0 and said[-1] == "2 passed, 0 failed, 1 skipped"


@pytest.mark.slow
def test_pytest_breaking_down_counts_as_a_failure(project, capfd):
    for stage in (
        Stage("unreadable", (*PYTEST, "test_unreadable.py")),
        Stage("no such option", (*PYTEST, "--bogus")),
    ):
        code, said = run(project, stage)
        assert code == 1 and said[-1] == "0 passed, 1 failed, 0 skipped"


@pytest.mark.slow
def test_a_stage_that_collects_nothing(project, capfd):
    nothing = (*PYTEST, "-k", "no_such_test", "test_good.py")
    assert run(project, Stage("required", nothing))[0] == 1
    code, said = run(project, Stage("optional", nothing, may_be_empty=True))
    assert code == 0 and said[-1] == "0 passed, 0 failed, 0 skipped"


def test_a_stage_without_its_files_is_passed_over(project, capfd):
    code, said = run(
        project,
        Stage("solutions", ("-c", "raise SystemExit(1)"), needs="solutions/*.ipynb"),
    )
    assert code == 0 and "== solutions: nothing at solutions/*.ipynb yet" in said
    (project / "solutions").mkdir()
    (project / "solutions" / "10-impulse.ipynb").write_text("{}")
    assert (
        run(
            project,
            Stage(
                "solutions", ("-c", "raise SystemExit(1)"), needs="solutions/*.ipynb"
            ),
        )[0]
        == 1
    )


def test_reports_add_up(tmp_path):
    report = tmp_path / "report.xml"
    report.write_text(
        '<testsuites><testsuite tests="5" failures="1" errors="1" skipped="1"/>'
        '<testsuite tests="2" failures="0" errors="0" skipped="0"/></testsuites>'
    )
    assert read_report(report) == Count(4, 2, 1)
    assert read_report(tmp_path / "none.xml") == Count()
    report.write_text("<cut o")
    assert read_report(report) == Count()


def test_tests_run_on_one_blas_thread_and_keep_nothing_in_the_home(
    tmp_path, monkeypatch
):
    monkeypatch.setenv("MPLBACKEND", "agg")
    monkeypatch.setenv("PYTHONPATH", "/other")
    kept = environment_for_tests(ROOT, tmp_path)
    assert kept["OPENBLAS_NUM_THREADS"] == kept["OMP_NUM_THREADS"] == "1"
    assert "MPLBACKEND" not in kept  # inline figures fail under it
    assert kept["PYTHONPATH"].split(os.pathsep)[0] == str(ROOT)
    for name in (
        "JUPYTER_CONFIG_DIR",
        "JUPYTER_DATA_DIR",
        "JUPYTER_RUNTIME_DIR",
        "IPYTHONDIR",
    ):
        assert kept[name].startswith(str(tmp_path))


@pytest.mark.slow
def test_running_a_lesson_leaves_no_trace_in_work_or_home(tmp_path):
    """A notebook run as the stages run it: the home and the place to work are as they were."""
    home, work = tmp_path / "home", ROOT / "work"
    home.mkdir()
    before = sorted(work.rglob("*")) if work.exists() else None
    lesson = next(iter(sorted((ROOT / "lessons").glob("*.ipynb"))), None)
    if lesson is None:
        pytest.skip("no lesson yet")
    kept = {**environment_for_tests(ROOT, tmp_path / "scratch"), "HOME": str(home)}
    options = command("standard", "lessons, as handed out")
    lax = [
        option
        for option in options
        if option not in ("-n", "--dist", "loadfile", options[options.index("-n") + 1])
    ]
    done = subprocess.run([sys.executable, *lax[:-1], str(lesson)], cwd=ROOT, env=kept, capture_output=True, text=True,
                          check=False)  # fmt: skip
    assert done.returncode == 0, done.stdout
    assert list(home.rglob("*")) == []
    assert (sorted(work.rglob("*")) if work.exists() else None) == before


def test_the_interpreter_of_the_stages_is_this_one(project, capfd):
    code, _ = run(
        project,
        Stage(
            "which", ("-c", f"import sys; assert sys.executable == {sys.executable!r}")
        ),
    )
    assert code == 0
    assert testing.TIERS == ("quick", "standard", "all")
