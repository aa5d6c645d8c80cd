"""The table on disk: rows that survive a cut, a full disk and a spreadsheet."""

import csv
import errno
import os
import subprocess
import sys

import pytest
from grading.toy_lessons import LESSONS, OTHER, submission, write

from course.grading.grade import grade_folder
from course.grading.report import cells_of
from course.grading.table import Table, is_table, read_table
from course.grading.writing import CannotWrite

NAMES = ["twice", "split", "area"]


def made(path, names, *, order=NAMES):
    table = Table(path, order, [])
    for index, name in enumerate(names):
        done = submission("passed", "wrong", "error", file=name, key=f"{index:064x}")
        table.add(cells_of(done, 4, "clock, memory"))
    return table


def files(path):
    return [row["file"] for row in read_table(path).rows]


def test_rows_are_in_the_file_as_they_come_and_a_cut_one_is_left_out(tmp_path):
    path = tmp_path / "grades.csv"
    table = made(path, ['ben, "x".ipynb', 'ann, "x".ipynb'])
    # Not closed, as after a crash: both rows are there.
    assert read_table(path).exercises == tuple(NAMES)
    assert [name[:3] for name in files(path)] == ["ben", "ann"]
    whole = path.read_bytes()
    for length in range(len(whole) - 2, whole.index(b'"ann'), -7):
        path.write_bytes(whole[:length])
        assert [name[:3] for name in files(path)] == ["ben"], whole[:length]
    path.write_bytes(whole)
    table.close()
    assert [name[:3] for name in files(path)] == ["ann", "ben"]


def test_a_damaged_row_takes_no_other_with_it(tmp_path):
    """Cut off within quotes it would swallow what was written after it."""
    path = tmp_path / "grades.csv"
    made(path, ["ann", 'ben, "x"', "cal", "dan"])
    lines = path.read_text().splitlines(keepends=True)
    ben = next(i for i, line in enumerate(lines) if "ben" in line)
    for cut in range(1, len(lines[ben]) - 1, 5):
        for end in ("\n", ""):
            damaged = [*lines[:ben], lines[ben][:cut] + end, *lines[ben + 1 :]]
            path.write_text("".join(damaged))
            assert "dan" in files(path) and "ann" in files(path), lines[ben][:cut]
    path.write_bytes(b"".join(line.encode() for line in lines) + b"\0" * 512)
    assert len(files(path)) == 4, "zeros at the end, as after a failure of power"


@pytest.mark.skipif(sys.platform == "win32", reason="open files cannot be replaced")
def test_rows_are_there_though_the_file_was_replaced_or_taken_away(tmp_path):
    path = tmp_path / "grades.csv"
    table = made(path, ["ann"])
    (tmp_path / "saved.csv").write_bytes(path.read_bytes())
    os.replace(tmp_path / "saved.csv", path)  # as editors save
    table.add(
        cells_of(
            submission("passed", "wrong", "error", file="ben", key="2" * 64), 4, ""
        )
    )
    assert files(path) == ["ann", "ben"]
    path.unlink()
    table.add(cells_of(submission(*["wrong"] * 3, file="cal", key="1" * 64), 4, ""))
    assert files(path) == ["ann", "ben", "cal"]


def test_a_file_that_is_no_table_is_not_written_over(tmp_path):
    other = tmp_path / "other.csv"
    for content in (b"name,mark\nann,3\n", b"\x89PNG\r\n", b"\n", b"file,student\n"):
        other.write_bytes(content)
        with pytest.raises(ValueError, match="out: expected a table of marks or a new"):
            read_table(other)
    assert read_table(tmp_path / "new.csv").rows == ()


def test_columns_are_the_union_of_old_and_new_in_the_lessons_order(tmp_path):
    path = tmp_path / "grades.csv"
    first = cells_of(submission("passed", lesson=OTHER), 4, "")
    order = [*NAMES, "thrice"]
    Table(path, order, [first]).close()
    found = read_table(path)
    assert found.exercises == ("thrice",)
    table = Table(path, order, found.rows)
    later = submission("passed", "wrong", "error", file="ben", key="1" * 64)
    table.add(cells_of(later, 4, ""))
    assert read_table(path).exercises == (*NAMES, "thrice"), "with the row, not later"
    table.close()
    with path.open(newline="", encoding="utf-8-sig") as file:
        ann, ben = csv.DictReader(file)
    assert (ann["thrice"], ann["twice"], ben["thrice"], ben["twice"]) == (
        "1",
        "",
        "",
        "2",
    )


def test_excel_is_told_that_the_text_is_utf_8(tmp_path):
    made(tmp_path / "grades.csv", ["Zo\u00eb.ipynb"]).close()
    assert (tmp_path / "grades.csv").read_bytes().startswith(b"\xef\xbb\xbffile,")


@pytest.mark.parametrize("encoding", ["utf-8-sig", "utf-8", "cp1252", "utf-16"])
@pytest.mark.parametrize("separator", [";", ",", "\t"])
@pytest.mark.parametrize("end", ["\r\n", "\n", "\r"])
@pytest.mark.slow
def test_a_table_that_a_spreadsheet_saved_is_read_again(
    tmp_path, encoding, separator, end
):
    path = tmp_path / "grades.csv"
    made(path, ["Zo\u00eb; a, b.ipynb", 'she said "no".ipynb']).close()
    before = read_table(path)
    with path.open(newline="", encoding="utf-8-sig") as file:
        rows = list(csv.reader(file))
    for quoting in (csv.QUOTE_MINIMAL, csv.QUOTE_ALL):
        with path.open("w", newline="", encoding=encoding) as file:
            writer = csv.writer(
                file, delimiter=separator, lineterminator=end, quoting=quoting
            )
            writer.writerows(rows)
        assert read_table(path) == before
        assert is_table(path.read_bytes()[:8192])


def test_a_table_of_an_older_version_is_read(tmp_path):
    path = tmp_path / "grades.csv"
    path.write_text(
        "file,student,lesson,total,out_of,state,reason,twice,twice_state,twice_reason,seed,isolation,key\n"
        f"a.ipynb,a,90-toy,2,7,marked,,2,passed,,5,clock,{'0' * 64}\n"
    )
    found = read_table(path)
    assert found.exercises == ("twice",) and found.more == ()
    assert (found.rows[0]["twice"], found.rows[0]["page"]) == ("2", "")


def test_a_column_that_somebody_added_stays(tmp_path):
    path = tmp_path / "grades.csv"
    made(path, ["ann", "ben"]).close()
    with path.open(newline="", encoding="utf-8-sig") as file:
        rows = list(csv.reader(file))
    noted = [[*rows[0], "note"], [*rows[1], "asked,\ntwice"], [*rows[2], ""]]
    with path.open("w", newline="", encoding="utf-8-sig") as file:
        csv.writer(file, delimiter=";").writerows(noted)
    found = read_table(path)
    assert found.more == ("note",) and found.rows[0]["note"] == "asked,\ntwice"
    table = Table(path, NAMES, found.rows[1:], stale=found.rows[:1], more=found.more)
    again = submission("passed", "passed", "passed", file="ann", key="9" * 64)
    table.add(cells_of(again, 4, ""))
    assert files(path) == ["ann", "ben", "ann"], "the old row stays until the end"
    table.close()
    ann, ben = read_table(path).rows
    assert (ann["key"], ann["note"], ben["note"]) == ("9" * 64, "asked,\ntwice", "")


FULL = """
import resource, sys
from pathlib import Path
sys.path.insert(0, sys.argv[1])
from grading.test_table import made
from grading.toy_lessons import submission
from course.grading.report import cells_of
path = Path(sys.argv[2])
table = made(path, ["ann"])
size = path.stat().st_size
resource.setrlimit(resource.RLIMIT_FSIZE, (size + 100, size + 100))
for name in ("ben", "cal"):
    try:
        table.add(cells_of(submission("passed", "wrong", "error", file=name, key="b" * 64), 4, "x" * 90))
    except OSError as error:
        print(error)
table.close()
"""


@pytest.mark.skipif(sys.platform == "win32", reason="limits of POSIX")
@pytest.mark.slow
def test_a_row_that_has_no_room_leaves_the_file_as_it_was(tmp_path):
    path = tmp_path / "grades.csv"
    tests = os.path.dirname(os.path.dirname(__file__))
    told = subprocess.run(
        [sys.executable, "-c", FULL, tests, str(path)], capture_output=True, text=True,
        check=True,
    ).stdout.splitlines()  # fmt: skip
    assert len(told) == 2 and str(path) in told[0] and "ulimit -f" in told[0]
    assert "the 1 rows made so far are kept" in told[1]
    assert files(path) == ["ann"] and path.read_bytes().endswith(b"\n")
    assert [p.name for p in tmp_path.iterdir()] == ["grades.csv"]


NO_ROOM = """
import resource, sys
from pathlib import Path
sys.path.insert(0, sys.argv[1])
from grading.toy_lessons import LESSONS
from course.grading.grade import grade_folder
resource.setrlimit(resource.RLIMIT_FSIZE, (1200, resource.RLIM_INFINITY))
print(grade_folder(Path(sys.argv[2]), Path(sys.argv[3]), lessons=LESSONS))
"""


@pytest.mark.slow
@pytest.mark.skipif(sys.platform == "win32", reason="limits of POSIX")
def test_a_page_that_has_no_room_costs_no_row(tmp_path):
    """The rows of two are under the limit, a page is over it."""
    for name in ("ann", "ben"):
        write(tmp_path / "in" / f"{name}.ipynb", f"{name}: no notebook")
    out, tests = tmp_path / "grades.csv", os.path.dirname(os.path.dirname(__file__))
    command = [sys.executable, "-c", NO_ROOM, tests, str(tmp_path / "in"), str(out)]
    told = subprocess.run(command, capture_output=True, text=True, check=True).stdout
    assert "2 cannot be used" in told and "3 pages are missing: " in told
    named = [f"{tmp_path}/grades-feedback/{name}--" in told for name in ("ann", "ben")]
    assert any(named) and "ulimit -f" in told
    assert len(files(out)) == 2
    assert [p.suffix for p in (tmp_path / "grades-feedback").iterdir()] == [".txt"]
    again = grade_folder(tmp_path / "in", out, lessons=LESSONS)
    assert (again.kept, again.unusable, again.unwritten) == (0, 2, ())


@pytest.mark.parametrize(
    "number, cure",
    [(errno.ENOSPC, "free some room"), (errno.EACCES, "close it where it is open"),
     (errno.EROFS, "choose a place"), (errno.EIO, "see to that")],
)  # fmt: skip
def test_what_cannot_be_written_is_named_with_its_cure(tmp_path, number, cure):
    told = str(CannotWrite(tmp_path / "x.csv", OSError(number, os.strerror(number))))
    assert str(tmp_path / "x.csv") in told and cure in told
    assert os.strerror(number) in told and "same command again" in told
