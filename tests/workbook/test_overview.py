"""All lessons at a glance: text, HTML, and the page beside the lessons."""

import pytest

from course.exercises.definition import all_lessons
from course.workbook import recording
from course.workbook.overview import OURS, PAGE, page, table, write_page

TEN = next(le for le in all_lessons() if le.number == "10")
FIRST = TEN.core[0].name


@pytest.fixture
def work(tmp_path, monkeypatch):
    (tmp_path / "lessons").mkdir()
    (tmp_path / "lessons" / TEN.file_name).write_text("{}")
    folder = tmp_path / "work"
    folder.mkdir()
    monkeypatch.chdir(folder)
    monkeypatch.setattr(recording, "_session", [])
    return folder


def test_text_html_and_page_say_the_same():
    shown = table({FIRST})
    (row,) = (row for row in shown.rows if row.number == "10")
    assert (row.done, row.total, row.following) == (1, 5, TEN.core[1].name)
    assert row.minutes == sum(e.minutes for e in TEN.core[1:])
    line = next(t for t in str(shown).splitlines() if t.startswith("10"))
    assert "█░░░░ 1/5" in line and f"{row.minutes} min left" in line
    html, markdown = shown._repr_html_(), page({TEN.file_name}, {FIRST})
    for said in (
        '<progress max="5" value="1">',
        "1 of 5",
        f"{row.minutes}\N{NO-BREAK SPACE}min",
    ):
        assert said in html and said in markdown
    assert f"[10 Impulse]({TEN.file_name})" in markdown
    assert f"exercise `{row.following}`" in markdown


def test_the_page_names_only_lessons_that_are_there():
    assert page(set(), set()).count("ipynb") == 0
    assert page({TEN.file_name}, set()).count("(1") == 2  # the next one, and its row
    done = page({TEN.file_name}, {e.name for e in TEN.core})
    assert "All core exercises have passed." in done and "| done |" in done


def test_as_handed_out_it_has_no_bars():
    assert "<progress" not in page({TEN.file_name})
    assert "about 40" in page({TEN.file_name})


def test_whatever_is_recorded_brings_the_page_up_to_date(work):
    recording.record("hint", FIRST, tier=1)
    assert "0 of 5" in (work / PAGE).read_text()
    recording.record("check", FIRST, state="passed")
    assert "1 of 5" in (work / PAGE).read_text()
    assert sorted(p.name for p in work.iterdir()) == [".course", PAGE]


def test_an_unchanged_page_is_not_written_again(work):
    write_page(work, set())
    before = (work / PAGE).stat()
    write_page(work, set())
    after = (work / PAGE).stat()
    assert (before.st_ino, before.st_mtime_ns) == (after.st_ino, after.st_mtime_ns)


def test_a_file_of_the_student_s_by_that_name_is_left(work):
    for content in (b"my notes", b"\xff\xfe"):
        (work / PAGE).write_bytes(content)
        write_page(work, set())
        assert (work / PAGE).read_bytes() == content
    (work / PAGE).write_text(OURS)
    write_page(work, set())
    assert "All lessons" in (work / PAGE).read_text()


def test_a_folder_that_cannot_be_written_stops_nothing(work):
    (work / PAGE).mkdir()
    write_page(work, set())
    write_page(work / "nowhere", set())
    assert [p.name for p in work.iterdir()] == [PAGE]
