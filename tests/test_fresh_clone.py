"""The two first commands as a new user gives them: an empty folder, an empty package cache, a network."""

import os
import re
import shutil
import subprocess
import sys
import time
from pathlib import Path

import pytest

from course import environment

ROOT = Path(__file__).resolve().parents[1]
pytestmark = pytest.mark.fresh


@pytest.fixture(scope="module")
def clone(tmp_path_factory):
    """A clone of what is committed here, and the environment of someone who has installed nothing."""
    if subprocess.run(
        ["git", "rev-parse", "HEAD"], cwd=ROOT, capture_output=True, check=False
    ).returncode:
        pytest.skip("this is no git checkout")
    folder = (
        tmp_path_factory.mktemp("new user") / "collision course"
    )  # with blanks, as folders have
    subprocess.run(
        ["git", "clone", "--quiet", "--no-hardlinks", str(ROOT), str(folder)],
        check=True,
    )
    drop = (
        "COLLISION_",
        "JUPYTER_",
        "PYTHONPATH",
        "PYTHONHOME",
        "VIRTUAL_ENV",
        "IPYTHON",
        "MPLCONFIG",
        "PYTEST_",
    )
    kept = {
        name: value for name, value in os.environ.items() if not name.startswith(drop)
    }
    kept["PATH"] = os.pathsep.join(
        part
        for part in kept["PATH"].split(os.pathsep)
        if ".venv" not in Path(part).parts
    )
    kept["PIP_CACHE_DIR"] = str(tmp_path_factory.mktemp("cache"))
    yield folder, kept
    for large in (folder, kept["PIP_CACHE_DIR"]):
        shutil.rmtree(large, ignore_errors=True)


def first_python():
    """The interpreter that the running environment was made from: it has none of the packages."""
    return getattr(sys, "_base_executable", sys.executable)


def start(clone, *arguments, seconds):
    folder, kept = clone
    return subprocess.run([first_python(), "-m", "course", *arguments], cwd=folder, env=kept, capture_output=True,
                          text=True, timeout=seconds, check=False)  # fmt: skip


def test_the_first_command_sets_everything_up(clone):
    done = start(clone, "--help", seconds=1200)
    assert done.returncode == 0, done.stderr
    assert "Usage: " in done.stdout
    folder, _ = clone
    if (folder / ".venv").exists():  # else this interpreter had everything already
        assert "Setting up" in done.stderr and re.search(
            r"installing (\d+) of \1 packages", done.stderr
        )
        assert environment.state(str(folder)) == "complete"


def test_the_second_start_sets_nothing_up(clone):
    started = time.monotonic()
    done = start(clone, "--help", seconds=60)
    assert done.returncode == 0 and done.stderr == "" and "Usage: " in done.stdout
    assert (
        time.monotonic() - started < 20
    )  # a set-up takes longer on any machine; how fast it is, is measured


def test_the_quick_tests_pass_there(clone):
    done = start(clone, "test", "--quick", seconds=2400)
    assert done.returncode == 0, done.stdout[-4000:] + done.stderr[-2000:]
    assert re.fullmatch(
        r"\d{2,} passed, 0 failed, \d+ skipped", done.stdout.strip().splitlines()[-1]
    )


def test_the_clone_is_as_it_was(clone):
    folder, _ = clone
    changed = subprocess.run(
        ["git", "status", "--porcelain"],
        cwd=folder,
        capture_output=True,
        text=True,
        check=True,
    )
    assert changed.stdout == ""
    assert not (folder / "work").exists()
