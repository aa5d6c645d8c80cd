"""Batches that are ended from outside, in every way: what was told as done is in the
table, and the rest goes on.
"""

import contextlib
import os
import re
import signal
import subprocess
import sys
import time
from concurrent.futures import ThreadPoolExecutor

import pytest
from grading.toy_lessons import (
    LESSONS,
    RIGHT,
    blank,
    only,
    rows_in,
    write,
)
from sandbox.runs import descendants, is_running

from course.grading.grade import grade_folder
from course.grading.lock import Lock, Locked

pytestmark = [
    pytest.mark.slow,
    pytest.mark.skipif(sys.platform == "win32", reason="signals of POSIX"),
]
TESTS = os.path.dirname(os.path.dirname(__file__))

#: The command line on the two small lessons; every file that is done is printed.
GRADER = """
import sys
sys.path.insert(0, sys.argv[1])
from contextlib import contextmanager
from sandbox.runs import descendants, is_running
from grading.toy_lessons import LESSONS
from course import cli
from course.grading import grade

@contextmanager
def bar(what):
    yield lambda done, total, file: print(file, flush=True)

cli.bar = bar
grade.all_lessons = lambda: LESSONS
sys.exit(cli.run(["grade", *sys.argv[2:]]))
"""
SLEEPS = "import time\ndef twice(x):\n    time.sleep(4)"
NEVER = "def twice(x):\n    while True: pass"


@pytest.fixture
def temporary(tmp_path):
    (tmp_path / "temporary").mkdir()
    return tmp_path / "temporary"


def start(folder, out, temporary, *options):
    return subprocess.Popen(
        [sys.executable, "-c", GRADER, TESTS, str(folder), "--out", str(out), *options],
        text=True, stdout=subprocess.PIPE, stderr=subprocess.PIPE, start_new_session=True,
        env=os.environ | {"TMPDIR": str(temporary)},
    )  # fmt: skip


def read_until(process, count):
    """The files told as done, once there are so many."""
    told = []
    for line in process.stdout:
        told += [line.strip()] if line.strip() else []
        if len(told) == count:
            break
    return told


@pytest.mark.parametrize("name", ["SIGTERM", "SIGHUP", "SIGINT"])
def test_a_signal_ends_a_batch_cleanly(folder, tmp_path, temporary, name):
    write(folder / "zoe.ipynb", only("twice", NEVER))
    out = tmp_path / "grades.csv"
    process = start(folder, out, temporary, "--time-limit", "60", "--workers", "2")
    told = read_until(process, 5)
    time.sleep(0.3)  # by now the endless one runs
    running = descendants(process.pid)
    assert running
    process.send_signal(getattr(signal, name))
    _, errors = process.communicate(timeout=20)
    assert process.returncode == 128 + getattr(signal, name), errors
    assert f"stopped by {name}: what is marked is in {out}" in errors
    assert "Traceback" not in errors
    assert list(rows_in(out)) == sorted(told), "closed: in order"
    assert list(temporary.iterdir()) == []
    assert not [p for p in running if is_running(p)]
    assert sorted(p.name for p in tmp_path.iterdir()) == [
        "grades-feedback", "grades.csv", "in", "temporary"
    ]  # fmt: skip
    write(folder / "zoe.ipynb", blank())
    again = grade_folder(folder, out, lessons=LESSONS, time_limit=60.0)
    assert (again.kept, again.marked) == (5, 6)


def test_rows_outlive_a_kill(folder, tmp_path, temporary):
    """By -9, with a row in work; the lock that stays behind holds up nobody."""
    write(folder / "zoe.ipynb", only("twice", SLEEPS))
    out = tmp_path / "grades.csv"
    process = start(folder, out, temporary, "--workers", "2")
    told = read_until(process, 5)
    process.kill()
    process.communicate()
    lock = tmp_path / "grades.csv.lock"
    assert lock.exists() and sorted(rows_in(out)) == sorted(told)
    whole = out.read_bytes()
    out.write_bytes(whole[:-20])  # as if in the middle of its last row
    again = grade_folder(folder, out, lessons=LESSONS)
    assert (again.kept, again.marked) == (4, 6) and not lock.exists()
    assert len(rows_in(out)) == 6


@pytest.mark.long
def test_killed_again_and_again_a_batch_comes_to_its_end(tmp_path, temporary):
    """At whatever moment: in the start, in a row, in the end."""
    for index in range(12):
        right = f"# {index}\n{RIGHT['twice']}"
        write(tmp_path / "in" / f"{index:02}.ipynb", only("twice", right))
    out, seen = tmp_path / "grades.csv", {}
    options = ("--workers", "2", "--seed", "5")
    for moment in range(40):
        process = start(tmp_path / "in", out, temporary, *options)
        with contextlib.suppress(subprocess.TimeoutExpired):
            process.communicate(timeout=0.4 + 0.15 * moment)
        process.kill()
        process.communicate()
        if not out.exists():
            continue
        now = rows_in(out)
        assert all(now[file] == row for file, row in seen.items()), moment
        seen = now
        if process.returncode == 0:
            break
    assert process.returncode == 0 and moment > 1
    assert len(seen) == 12 and {row["twice"] for row in seen.values()} == {"2"}


@pytest.mark.long
def test_two_graders_do_not_write_to_one_table(folder, tmp_path, temporary):
    write(folder / "zoe.ipynb", only("twice", SLEEPS))
    out = tmp_path / "grades.csv"
    process = start(folder, out, temporary, "--workers", "2")
    read_until(process, 3)
    who = f"another grader \\(process {process.pid} on .*, since"
    with pytest.raises(Locked, match=who):
        grade_folder(folder, out, lessons=LESSONS)
    pages = tmp_path / "grades-feedback"
    with pytest.raises(Locked, match=f"{re.escape(str(pages))} is being written"):
        grade_folder(folder, tmp_path / "x.csv", lessons=LESSONS, feedback=pages)
    second = start(folder, out, temporary)
    _, errors = second.communicate(timeout=20)
    assert second.returncode == 2 and "choose another --out" in errors
    assert "Traceback" not in errors
    process.communicate(timeout=60)
    assert process.returncode == 0 and len(rows_in(out)) == 6
    assert grade_folder(folder, out, lessons=LESSONS).kept == 6


def test_a_lock_is_left_by_the_dead_only(tmp_path, monkeypatch):
    """With the system's locks, and where a file system has none."""
    path, here = tmp_path / "x.lock", os.uname().nodename
    dead = subprocess.Popen([sys.executable, "-c", ""])
    dead.wait()
    from course.grading import lock as module

    for has_locks in (True, False):
        if not has_locks:
            monkeypatch.setattr(module, "_take", lambda number: module.UNKNOWN)
        for text in ("nonsense", f"{module.FIRST_LINE}\n{dead.pid}\n{here}\nnow\n"):
            path.write_text(text)
            with Lock(path, "x"), pytest.raises(Locked, match=f"process {os.getpid()}"):
                Lock(path, "x").__enter__()
            assert not path.exists()
        path.write_text(f"{module.FIRST_LINE}\n{dead.pid}\nanother machine\nnow\n")
        with pytest.raises(Locked, match="on another machine, since now.* delete"):
            Lock(path, "x").__enter__()
        path.unlink()


@pytest.mark.parametrize("has_locks", [True, False])
def test_of_many_that_want_a_lock_one_has_it(tmp_path, monkeypatch, has_locks):
    """Also over a lock that a dead process left; each adds one to a number in a file."""
    from course.grading import lock as module

    if not has_locks:
        monkeypatch.setattr(module, "_take", lambda number: module.UNKNOWN)
    path, number = tmp_path / "x.lock", tmp_path / "number"
    number.write_text("0")
    dead = subprocess.Popen([sys.executable, "-c", ""])
    dead.wait()
    here = os.uname().nodename
    path.write_text(f"{module.FIRST_LINE}\n{dead.pid}\n{here}\nnow\n")

    def add(_):
        for _ in range(2000):
            with contextlib.suppress(Locked), Lock(path, "x"):
                value = int(number.read_text())
                time.sleep(0.001)
                number.write_text(str(value + 1))
                return 1
            time.sleep(0.002)
        return 0

    with ThreadPoolExecutor(8) as pool:
        assert list(pool.map(add, range(24))) == [1] * 24
    assert number.read_text() == "24" and not path.exists()


@contextlib.contextmanager
def small_disk(path, size):
    """A file system of so many bytes; skips where none can be mounted."""
    path.mkdir()
    mount = ["mount", "-t", "tmpfs", "-o", f"size={size}", "none", str(path)]
    if os.geteuid() or subprocess.run(mount, capture_output=True).returncode:
        pytest.skip("a small disk cannot be mounted here")
    try:
        yield path
    finally:
        subprocess.run(["umount", str(path)], check=True)


def grow(path, size):
    subprocess.run(["mount", "-o", f"remount,size={size}", str(path)], check=True)


@pytest.mark.long
def test_a_full_disk_under_the_table(tmp_path, temporary):
    for index in range(40):
        write(tmp_path / "in" / f"{index:02}{'n' * 200}.ipynb", "no notebook" * index)
    with small_disk(tmp_path / "disk", "16k") as disk:
        out = disk / "grades.csv"
        options = ("--feedback", str(tmp_path / "pages"), "--workers", "1")
        process = start(tmp_path / "in", out, temporary, *options)
        told, errors = process.communicate(timeout=60)
        assert process.returncode == 2 and "Traceback" not in errors
        told = told.split()
        assert f"{out} cannot be written (No space left on device)" in errors
        assert "free some room on its disk, then give the same command" in errors
        assert 3 < len(told) < 40 and f"the {len(told)} rows made so far are" in errors
        assert sorted(rows_in(out)) == sorted(told)
        grow(disk, "1m")
        again = grade_folder(
            tmp_path / "in", out, lessons=LESSONS, feedback=tmp_path / "pages"
        )
        assert (again.kept, again.unusable) == (len(told), 40)


def test_a_full_disk_under_the_pages(tmp_path, temporary):
    for index in range(12):
        write(tmp_path / "in" / f"{index:02}.ipynb", f"no notebook {index}")
    out = tmp_path / "grades.csv"
    with small_disk(tmp_path / "disk", "32k") as disk:
        options = ("--feedback", str(disk / "pages"), "--workers", "1")
        process = start(tmp_path / "in", out, temporary, *options)
        told, errors = process.communicate(timeout=60)
        assert process.returncode == 1, errors
        missing = int(re.search(r"(\d+) pages are missing: ", told)[1])
        assert 2 < missing < 12
        assert re.search(r"disk/pages/\d\d--\w+.html cannot be written \(No sp", told)
        assert "free some room on its disk, then give the same command again" in told
        assert len(rows_in(out)) == 12, "a page without room costs no row"
        assert not list((disk / "pages").glob("*.part"))
        grow(disk, "1m")
        again = grade_folder(
            tmp_path / "in", out, lessons=LESSONS, feedback=disk / "pages"
        )
        assert again.unwritten == () and again.kept == 12 - (missing - 1)  # and index
        assert len(list((disk / "pages").glob("*.html"))) == 13


@pytest.mark.parametrize("workers", [1, 2, 4])
@pytest.mark.long
def test_one_seed_gives_one_table_with_any_number_of_workers(folder, tmp_path, workers):
    write(folder / "half.ipynb", only("twice", "def twice(x):\n    return -2 * x"))
    late = f"import time; time.sleep(0.5)\n{RIGHT['twice']}"
    write(folder / "aa.ipynb", only("twice", late))
    texts = []
    for index, count in enumerate((1, workers)):
        out = tmp_path / f"{index}.csv"
        told = grade_folder(folder, out, lessons=LESSONS, seed=3, workers=count)
        pages = {p.name: p.read_text() for p in told.feedback.glob("*.html")}
        texts.append((out.read_text(), pages))
    assert texts[0] == texts[1]


def test_a_terminal_that_is_closed_ends_a_batch_cleanly(folder, tmp_path, temporary):
    """With the bar drawn on it, which nothing can be written to any more."""
    import pty

    write(folder / "zoe.ipynb", only("twice", NEVER))
    out, code = tmp_path / "grades.csv", GRADER.replace("cli.bar = bar", "")
    command = [sys.executable, "-c", code, TESTS, str(folder), "--out", str(out)]
    pid, terminal = pty.fork()
    if pid == 0:
        os.environ["TMPDIR"] = str(temporary)
        os.execv(sys.executable, command)
    deadline = time.monotonic() + 30
    while not (out.exists() and len(rows_in(out)) == 5) and time.monotonic() < deadline:
        os.read(terminal, 10_000)
    os.close(terminal)
    _, status = os.waitpid(pid, 0)
    assert os.waitstatus_to_exitcode(status) == 128 + signal.SIGHUP
    assert len(rows_in(out)) == 5 and list(temporary.iterdir()) == []
    assert not (tmp_path / "grades.csv.lock").exists()
