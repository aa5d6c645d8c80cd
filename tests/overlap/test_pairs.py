"""The table of pairs, and the page that is made from it."""

import itertools
from pathlib import Path

from course.overlap.pairs import KINDS, TABLE, served, table_in_markdown
from course.shapes import Capsule, Sphere

PAGE = Path(__file__).resolve().parents[2] / "docs" / "overlap.md"


def test_every_pair_of_kinds_has_one_row():
    assert set(TABLE) == set(itertools.combinations_with_replacement(KINDS, 2))


def test_shapes_in_the_other_order_change_places():
    ball, rod = Sphere([0, 0, 0], 1.0), Capsule([0, 0, 0], [1, 0, 0], 1.0)
    row = TABLE["sphere", "capsule"]
    assert served(ball, rod) == (row, ball, rod, False)
    assert served(rod, ball) == (row, ball, rod, True)


def test_the_page_shows_the_table_as_it_is():
    """If it does not: put what ``table_in_markdown()`` gives between the marks."""
    page = PAGE.read_text(encoding="utf-8")
    shown = page.partition("<!-- table -->\n")[2].partition(
        "\n<!-- end of the table -->"
    )[0]
    assert shown == table_in_markdown()
