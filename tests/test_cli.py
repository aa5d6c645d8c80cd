"""The command line: what each command calls, what it prints, how it ends."""

import json
import os
import subprocess
import sys
from collections import namedtuple
from pathlib import Path

import pytest

from course import cli, environment
from course.__main__ import main
from course.exercises.definition import all_lessons
from course.workbook import lab

ROOT = Path(__file__).resolve().parents[1]


@pytest.fixture
def project(tmp_path, monkeypatch):
    """A project folder with two lessons, in place of this checkout; starting JupyterLab is noted, not done."""
    (tmp_path / "lessons").mkdir()
    for name in ("00-start-here", "10-impulse"):
        (tmp_path / "lessons" / f"{name}.ipynb").write_text("{}")
    monkeypatch.setattr(environment, "project_root", lambda: str(tmp_path))
    monkeypatch.chdir(tmp_path)
    return tmp_path


@pytest.fixture
def started(monkeypatch):
    calls = []
    Call = namedtuple("Call", "root notebook port browser")
    monkeypatch.setattr(lab, "start", lambda root, notebook, *, port, browser: calls.append(
        Call(root, notebook and notebook.relative_to(root).as_posix(), port, browser)))  # fmt: skip
    return calls


# open


def test_without_a_command_the_first_lesson_is_opened(project, started, capsys):
    assert cli.run([]) == 0
    assert started == [(project, "work/00-start-here.ipynb", None, True)]
    assert (project / "work" / "00-start-here.ipynb").exists()
    assert "JupyterLab opens work/00-start-here.ipynb." in capsys.readouterr().out


@pytest.mark.parametrize(
    "arguments, port, browser",
    [
        (["--no-browser"], None, False),
        (["--port", "8899", "--no-browser"], 8899, False),
        (["open", "10", "--port", "8899"], 8899, True),
        (["--no-browser", "open", "10"], None, False),
        (
            ["--no-browser", "--port", "8899", "open", "10", "--port", "9000"],
            9000,
            False,
        ),
    ],
)
def test_options_stand_before_or_after_the_command(
    project, started, arguments, port, browser
):
    assert cli.run(arguments) == 0
    assert (started[0].port, started[0].browser) == (port, browser)


def test_afterwards_the_first_unfinished_lesson_is_opened(project, started):
    cli.run([])
    passed = [
        exercise.name
        for lesson in all_lessons()
        if lesson.number == "00"
        for exercise in lesson.exercises
    ]
    lines = [
        json.dumps({"kind": "check", "name": name, "state": "passed"})
        for name in passed
    ]
    (project / "work" / ".course" / "progress.jsonl").write_text(
        "\n".join(lines) + "\n"
    )
    cli.run([])
    assert [call.notebook for call in started] == [
        "work/00-start-here.ipynb",
        "work/10-impulse.ipynb",
    ]


def test_when_the_unfinished_lesson_is_not_there_the_first_is_opened(project, started):
    cli.run([])
    (project / "lessons" / "10-impulse.ipynb").unlink()
    everything = [
        exercise.name for lesson in all_lessons() for exercise in lesson.exercises
    ]
    lines = [
        json.dumps({"kind": "check", "name": name, "state": "passed"})
        for name in everything
    ]
    (project / "work" / ".course" / "progress.jsonl").write_text(
        "\n".join(lines) + "\n"
    )
    cli.run([])
    assert started[1].notebook == "work/00-start-here.ipynb"


def test_a_newer_lesson_is_told(project, started, capsys):
    cli.run(["open", "10"])
    (project / "lessons" / "10-impulse.ipynb").write_text('{"new": 1}')
    cli.run(["open", "10"])
    assert "work/10-impulse (new 2).ipynb" in capsys.readouterr().out
    assert started[1].notebook == "work/10-impulse.ipynb"


def test_without_lessons_jupyterlab_opens_all_the_same(project, started, capsys):
    for path in (project / "lessons").iterdir():
        path.unlink()
    assert cli.run([]) == 0
    assert (
        started[0].notebook is None
        and "no lesson in lessons/ yet" in capsys.readouterr().out
    )


def test_an_unknown_lesson_ends_with_2_and_a_sentence(project, started, capsys):
    assert cli.run(["open", "inpulse"]) == 2
    said = capsys.readouterr().err
    assert (
        "did you mean 'impulse'?" in said and "Traceback" not in said and started == []
    )


def test_a_place_to_work_that_cannot_be_made_is_a_sentence(project, started, capsys):
    (project / "work").write_text("a file where the folder should be")
    assert cli.run(["open", "10"]) == 2
    assert "work" in capsys.readouterr().err


@pytest.mark.parametrize("port", ["0", "70000", "many"])
def test_a_port_that_is_none_is_refused(project, started, port):
    assert cli.run(["--port", port]) == 2
    assert started == []


# The others


@pytest.mark.parametrize("arguments", [["--help"], *[[name, "--help"] for name in
                         ("open", "test", "check", "progress", "build", "grade", "syllabus", "demo")]])  # fmt: skip
def test_help(arguments, capsys):
    assert cli.run(arguments) == 0
    assert "Usage: " in capsys.readouterr().out


def test_an_unknown_command_ends_with_2(capsys):
    assert cli.run(["bogus"]) == 2
    assert "bogus" in capsys.readouterr().err


def test_the_tiers_of_test(monkeypatch):
    from course import testing

    ran = []
    monkeypatch.setattr(
        testing,
        "run_tests",
        lambda root, tier: ran.append((root, tier)) or len(ran) - 1,
    )
    assert [
        cli.run(["test"]),
        cli.run(["test", "--quick"]),
        cli.run(["test", "--all"]),
    ] == [0, 1, 2]
    assert ran == [(ROOT, "standard"), (ROOT, "quick"), (ROOT, "all")]
    assert cli.run(["test", "--quick", "--all"]) == 2


@pytest.mark.slow
def test_check_ends_with_0_1_or_2(tmp_path, capsys):
    assert cli.run(["check", str(ROOT / "solutions" / "10-impulse.ipynb")]) == 0
    assert "impulse_central" in capsys.readouterr().out
    assert cli.run(["check", str(ROOT / "lessons" / "10-impulse.ipynb")]) == 1
    assert "Not attempted" in capsys.readouterr().out
    empty = tmp_path / "empty.ipynb"
    empty.write_text("")
    for unusable in (empty, tmp_path / "nowhere.ipynb", tmp_path):
        assert cli.run(["check", str(unusable)]) == 2
        said = capsys.readouterr().err
        assert said and "Traceback" not in said


def test_check_by_number_reads_the_copy_in_work(project, monkeypatch):
    assert cli.notebook_named(Path("10")) == project / "work" / "10-impulse.ipynb"
    (project / "mine.ipynb").write_text("{}")
    assert cli.notebook_named(Path("mine.ipynb")) == Path("mine.ipynb")


def test_progress_reads_the_place_to_work(project, capsys):
    (project / "work" / ".course").mkdir(parents=True)
    line = json.dumps({"kind": "check", "name": "impulse_central", "state": "passed"})
    (project / "work" / ".course" / "progress.jsonl").write_text(line + "\n")
    assert cli.run(["progress"]) == 0
    ten = next(
        line for line in capsys.readouterr().out.splitlines() if line.startswith("10")
    )
    assert "1/5" in ten


def test_build_reports_drift(monkeypatch, capsys):
    from course.workbook import building

    drift = ["lessons/10-impulse.ipynb: missing"]
    asked = []
    monkeypatch.setattr(
        building, "build", lambda *, check: asked.append(check) or drift
    )
    assert cli.run(["build", "--check"]) == 1
    assert cli.run(["build"]) == 0
    assert (
        asked == [True, False]
        and "lessons/10-impulse.ipynb: missing" in capsys.readouterr().out
    )
    drift.clear()
    assert cli.run(["build", "--check"]) == 0


@pytest.mark.slow
def test_grade_writes_the_table_and_says_what_it_did(tmp_path, capsys):
    folder = tmp_path / "submitted"
    folder.mkdir()
    (folder / "broken.ipynb").write_text("not a notebook")
    (folder / "ann.ipynb").write_bytes(
        (ROOT / "lessons" / "10-impulse.ipynb").read_bytes()
    )
    assert (
        cli.run(
            ["grade", str(folder), "--out", str(tmp_path / "grades.csv"), "--seed", "1"]
        )
        == 0
    )
    table = (tmp_path / "grades.csv").read_text()
    assert "broken" in table and "ann" in table
    assert "2 submissions" in capsys.readouterr().out


def test_grade_hands_on_what_is_asked(monkeypatch, capsys):
    from course.grading import grade

    asked, told = [], [(0, ()), (0, ()), (1, ()), (0, ("a page has no room",))]
    Told = namedtuple("Told", "again unwritten")
    monkeypatch.setattr(
        grade, "grade_folder", lambda *a, **k: asked.append((a, k)) or Told(*told.pop(0))
    )  # fmt: skip
    assert cli.run(["grade", "in", "--force", "--seed", "4", "--workers", "3"]) == 0
    ((folder, out), options) = asked[0]
    assert (folder, out) == (Path("in"), Path("grades.csv"))
    assert (options["force"], options["seed"], options["workers"]) == (True, 4, 3)
    assert cli.run(["grade", "in"]) == 0 and asked[1][1]["force"] is False
    assert [cli.run(["grade", "in"]), cli.run(["grade", "in"])] == [1, 1]
    assert "Told(again=1, unwritten=())" in capsys.readouterr().out


def test_grade_of_no_folder_ends_with_2(tmp_path, capsys):
    assert (
        cli.run(
            ["grade", str(tmp_path / "nowhere"), "--out", str(tmp_path / "grades.csv")]
        )
        == 2
    )
    assert "nowhere" in capsys.readouterr().err


SPY = """
import os, sys
with open(os.environ["SPY"], "a") as told:
    told.write(__file__ + " ")
"""
SCRIPT = """
import sys
from course.__main__ import main
if __name__ == "__main__":
    sys.exit(main())
"""


@pytest.mark.slow
@pytest.mark.parametrize(
    "start, package, path",
    [
        (["script"], True, ""),
        (["script"], False, os.pathsep + "."),
        (["-P", "-m", "course"], True, ""),
        # Without -P a folder called course in the current one is what Python runs.
        (["-m", "course"], False, ""),
        (["-m", "course"], False, os.pathsep),
        (["-m", "course"], False, os.pathsep + "." + os.pathsep),
    ],
)
@pytest.mark.long
def test_grading_the_current_folder_imports_nothing_of_it(
    tmp_path, start, package, path
):
    """A student's json.py, numpy.py or course/ would run with all the rights of the grader."""
    folder, bin_ = tmp_path / "handed in", tmp_path / "bin"
    (folder / "course").mkdir(parents=True)
    bin_.mkdir()
    (bin_ / "course").write_text(SCRIPT)
    names = ["json", "numpy", "csv", "typer", "rich", "sympy", "secrets", "runpy", "re"]
    for name in (*names, "sitecustomize", "course/__init__", "course/__main__"):
        if package or not name.startswith("course"):
            (folder / f"{name}.py").write_text(SPY)
    (folder / "ann.ipynb").write_bytes(
        (ROOT / "solutions" / "10-impulse.ipynb").read_bytes()
    )
    # An empty entry of PYTHONPATH holds while Python itself starts; what starts from there is the user's.
    if path:
        for name in ("sitecustomize", "runpy", "re"):
            (folder / f"{name}.py").unlink()
    told = tmp_path / "told"
    first = [str(bin_ / "course")] if start == ["script"] else start
    done = subprocess.run(
        [sys.executable, *first, "grade", ".", "--out", str(tmp_path / "grades.csv")],
        cwd=folder, capture_output=True, text=True,
        env={**os.environ, "PYTHONPATH": str(ROOT) + path, "SPY": str(told)},
    )  # fmt: skip
    assert done.returncode == 0, done.stderr
    assert not told.exists(), told.read_text()
    assert "1 marked" in done.stdout


def test_the_project_s_own_folder_comes_last(tmp_path, monkeypatch):
    from course.__main__ import leave_current_folder

    before = [p for p in sys.path if p and Path(p).resolve() != ROOT]
    for here, first in ((ROOT, ""), (ROOT, str(ROOT)), (tmp_path, str(tmp_path)), (tmp_path, ".")):  # fmt: skip
        monkeypatch.chdir(here)
        monkeypatch.setattr(sys, "path", [first, *before])
        leave_current_folder()
        assert sys.path == [*before, str(ROOT)]
    gone = tmp_path / "gone"
    gone.mkdir()
    monkeypatch.chdir(gone)
    gone.rmdir()
    monkeypatch.setattr(sys, "path", [str(gone), *before])
    leave_current_folder()
    assert sys.path == [str(gone), *before, str(ROOT)]


def test_syllabus_and_demos_are_listed(capsys):
    assert cli.run(["syllabus"]) == 0
    assert cli.run(["demo", "--list"]) == 0
    assert cli.run(["demo", "no-such-demo"]) == 2
    told = capsys.readouterr()
    assert (
        "row 25, slide 24" in told.out
        and "impulse" in told.out
        and "Traceback" not in told.err
    )


def test_without_a_checkout_it_is_said(monkeypatch, capsys):
    monkeypatch.setattr(environment, "project_root", lambda: None)
    assert cli.run(["progress"]) == 2
    assert "clone it and start there" in capsys.readouterr().err


def test_main_ends_with_the_code_of_the_command(monkeypatch):
    monkeypatch.setattr(environment, "ensure", lambda arguments, make: None)
    monkeypatch.setattr(cli, "run", lambda arguments: 3)
    assert main(["anything"]) == 3

    def fail(arguments, make):
        raise environment.SetupError("no network")

    monkeypatch.setattr(environment, "ensure", fail)
    assert main([]) == 2

    def interrupted(arguments, make):
        raise KeyboardInterrupt

    monkeypatch.setattr(environment, "ensure", interrupted)
    assert main([]) == 130


def test_help_waits_for_no_heavy_library():
    code = (
        "import sys; from course import cli; cli.run(['--help']); "
        "print([n for n in ('numpy', 'scipy', 'matplotlib', 'jupyterlab', 'nbformat') if n in sys.modules])"
    )
    out = subprocess.run([sys.executable, "-c", code], cwd=ROOT, capture_output=True, text=True, check=True,
                         env={**os.environ, "COLUMNS": "80"}).stdout  # fmt: skip
    assert out.splitlines()[-1] == "[]"
