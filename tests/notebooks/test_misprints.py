"""docs/misprints.md: fifteen entries, each leading to the cells that show it."""

import re
from pathlib import Path

import nbformat
import pytest

from course.workbook.syllabus import read_syllabus

ROOT = Path(__file__).resolve().parents[2]
PAGE = (ROOT / "docs" / "misprints.md").read_text(encoding="utf-8")
ENTRIES = {
    int(number): text
    for number, text in re.findall(
        r"^## (\d+)\. (.+?)(?=^## |\Z)", PAGE, flags=re.M | re.S
    )
}
PLACES = [
    (number, line)
    for number, text in ENTRIES.items()
    for line in re.findall(r"^- Shown: (.+)$", text, flags=re.M)
]
NOT_BUILT = ", not built yet"


def test_there_are_fifteen_in_order_and_each_is_whole():
    assert list(ENTRIES) == list(range(1, 16))
    for number, text in ENTRIES.items():
        for part in ("Row: ", "Printed", "Right: ", "Shown: "):
            assert f"\n- {part}" in text, f"entry {number} does not say {part!r}"


def test_the_rows_are_rows_of_the_syllabus():
    known = {row.number for row in read_syllabus()}
    for number, text in ENTRIES.items():
        named = re.search(r"^- Row: (.+)$", text, flags=re.M).group(1)
        assert set(map(int, named.split(", "))) <= known, f"entry {number}: {named}"


def fault_of_place(line: str, root: Path = ROOT) -> str:
    """What is wrong with a place, empty when a reader finds it: a part of a lesson in
    which a text begins with the words and a code cell with an output comes after it."""
    built = re.fullmatch(r'lesson (\d\d), ([^,"]+), "(.+)"', line)
    if not built:
        lesson = re.fullmatch(rf"lesson (\d\d){NOT_BUILT}", line)
        if lesson is None:
            return "expected: lesson NN, part, words in quotes"
        found = list(root.glob(f"solutions/{lesson.group(1)}-*.ipynb"))
        return f"{found[0].name} is built by now" if found else ""
    number, part, words = built.groups()
    found = root.glob(f"solutions/{number}-*.ipynb")
    files = [path for path in found if not path.stem.endswith("-more")]
    if not files:
        return f"there is no lesson {number}"
    cells, inside = nbformat.read(files[0], as_version=4).cells, False
    for index, cell in enumerate(cells):
        heading = re.match(r"## (.+)", cell.source)
        if cell.cell_type != "markdown":
            continue
        inside = heading.group(1).strip() == part if heading else inside
        if inside and any(
            paragraph.lstrip("*").startswith(words)
            for paragraph in cell.source.split("\n\n")
        ):
            after = [c for c in cells[index + 1 :] if c.cell_type == "code"]
            shown = any(c.outputs for c in after[:3])
            return "" if shown else "no code cell with an output comes after it"
    return f"no text in {part!r} begins with {words!r}"


@pytest.mark.parametrize(("number", "line"), PLACES)
def test_the_place_where_it_is_shown_is_there(number, line):
    assert fault_of_place(line) == ""


@pytest.mark.parametrize(
    ("line", "fault"),
    [
        ('lesson 10, On the slide, "First: no such words"', "begins with"),
        ('lesson 10, Recap, "First: momentum does not"', "begins with"),
        ('lesson 99, Recap, "x"', "no lesson 99"),
        ("lesson 10, not built yet", "is built by now"),
        ("somewhere in lesson 10", "expected: lesson NN"),
    ],
)
def test_a_place_that_leads_nowhere_is_told(line, fault):
    assert fault in fault_of_place(line)


def test_docstrings_refer_to_entries_that_are_there():
    numbers = {
        int(number)
        for path in (ROOT / "course").rglob("*.py")
        for number in re.findall(
            r"\bmisprint\s+(\d+)", path.read_text(encoding="utf-8")
        )
    }
    assert numbers and numbers <= set(ENTRIES)
