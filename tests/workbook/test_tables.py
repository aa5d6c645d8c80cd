"""Tables: aligned text that every processor makes the same, and HTML that anybody can read."""

import html
import re
from html.parser import HTMLParser

import numpy as np
import pytest

from course.workbook import tabulate


class Cells(HTMLParser):
    """The tags that are opened, and the text of each cell by its tag."""

    def __init__(self, text):
        super().__init__()
        self.tags, self.cells, self.open = [], [], []
        self.feed(text)

    def handle_starttag(self, tag, attrs):
        self.tags.append((tag, dict(attrs)))
        self.open.append(tag)
        if tag in ("th", "td", "caption"):
            self.cells.append([tag, ""])

    def handle_endtag(self, tag):
        assert self.open.pop() == tag

    def handle_data(self, text):
        if self.open and self.open[-1] in ("th", "td", "caption"):
            self.cells[-1][1] += text


def column(values, **options):
    return [row[1] for row in tabulate(["", "x"], list(enumerate(values)), **options).rows]  # fmt: skip


def test_columns_and_rows_make_the_same_table():
    names, numbers = ["one", "two"], np.array([0.25, -1.5])
    columns = tabulate({"": names, "x [m]": numbers, "law": "Hooke", "n": 2})
    rows = tabulate(
        ["", "x [m]", "law", "n"],
        [(n, x, "Hooke", 2) for n, x in zip(names, numbers, strict=True)],
    )
    assert columns == rows
    assert str(columns) == repr(columns) == (
        "      x [m]   law     n\n"
        "one    0.25   Hooke   2\n"
        "two   -1.50   Hooke   2"
    )  # fmt: skip
    assert tabulate({"a": 1, "b": 2.5}).rows == (("1", "2.5"),)


def test_names_and_units_are_set_in_letters_and_accents_take_no_place():
    text = str(tabulate({"omega_dot [rad/s^2]": [20.0, 1.5], "": ["d_ddot", "face_b"]},
                        caption="of p_hat"))  # fmt: skip
    assert text == (
        "of p̂\n"
        "ω̇ [rad/s²]\n"
        "      20.0   d̈\n"
        "       1.5   face_b"
    )  # fmt: skip


@pytest.mark.parametrize(
    ("values", "options", "texts"),
    [
        ((0.5, 1.0, 20.07), {}, ["0.5", "1.0", "20.1"]),
        ((0.5, 1.0, 1.5), {"digits": 4}, ["0.5", "1.0", "1.5"]),
        ((1.18, 1.0), {"digits": 2}, ["1.2", "1.0"]),
        ((39.0, 1.11), {}, ["39.0", "1.11"]),
        ((123456.0, 1.5), {}, ["123000", "1.5"]),
        ((1e-5, 0.5, 1.0), {}, ["1e-05", "0.5", "1"]),  # no place in common
        ((0.0, -1e-13, 0.5), {}, ["below 1e-12", "below 1e-12", "0.5"]),
        ((3e-7, 2.0), {"noise": 1e-6, "digits": 1}, ["below 1e-06", "2"]),
        ((-1e-17, 2.5, -0.0004), {"decimals": 3}, ["0.000", "2.500", "0.000"]),
        ((1, 2.0), {"decimals": 1}, ["1", "2.0"]),
        ((1, True, None, "so"), {}, ["1", "True", "", "so"]),
        ((np.int64(3), np.float64(0.25), np.array(0.125)), {}, ["3", "0.250", "0.125"]),
        ((np.nan, np.inf), {"decimals": 2}, ["nan", "inf"]),
        ((np.array([0.5, 1e-14]), [1, 2]), {}, ["[0.5, 0. ]", "[1, 2]"]),
    ],
)
def test_numbers_as_text(values, options, texts):
    assert column(values, **options) == texts


def test_each_column_has_its_places():
    row = (1.0, 0.123456, 0.123456, "word")
    one = tabulate(
        list("abcd"), [row], digits=(2, 2, 4, 1), decimals=(None, 5, None, None)
    )
    assert one.rows == (("1", "0.12346", "0.1235", "word"),)


@pytest.mark.parametrize("value", (0.125, 0.0625, -2.5, 3.4335, 12.345, 99.95))
@pytest.mark.parametrize("options", ({"digits": 2}, {"decimals": 1}, {"decimals": 3}))
def test_a_number_on_the_edge_of_rounding_is_written_one_way(value, options):
    near = [value, np.nextafter(value, -np.inf), np.nextafter(value, np.inf)]
    assert len(set(column(near, **options))) == 1


def test_columns_of_numbers_are_aligned_right_and_words_left():
    table = tabulate({
        "name": ["a", "b"], "10,000": ["1,000", "0.5"], "error": ["below 1e-12", 2.0],
        "mixed": [1.0, "never"], "share": ["5%", ""],
    })  # fmt: skip
    sides = re.findall(r'<th scope="col" style="text-align: (\w+)', table._repr_html_())
    assert sides == ["left", "right", "right", "left", "right"]


def test_html_is_a_table_with_headings_of_columns_and_rows():
    shown = Cells(
        tabulate(
            {"h [s]": [0.5, 0.25], "error [m/s^2]": [-1.5e-6, 0.5]}, caption="of b_1"
        )._repr_html_()
    )
    assert shown.open == []
    assert [text for tag, text in shown.cells if tag == "caption"] == ["of b₁"]
    assert [text for tag, text in shown.cells if tag != "caption"] == [
        "h\N{NO-BREAK SPACE}[s]", "error\N{NO-BREAK SPACE}[m/s²]", "0.50", "\N{MINUS SIGN}1.5 × 10⁻⁶", "0.25", "0.5",
    ]  # fmt: skip
    scopes = [attrs["scope"] for tag, attrs in shown.tags if tag == "th"]
    assert scopes == ["col", "col", "row", "row"]
    assert [tag for tag, _ in shown.tags].count("td") == 2


@pytest.mark.parametrize(
    ("number", "shown"),
    [
        ("1e-05", "10⁻⁵"),
        ("below 1e-12", "below 10⁻¹²"),
        ("-2.5e+08", "\N{MINUS SIGN}2.5 × 10⁸"),
        ("0e+00", "0"),
        ("-0.5", "\N{MINUS SIGN}0.5"),
        ("1: 2e-05, so - so", "1: 2 × 10⁻⁵, so - so"),
        ("file1e3 of v1.2e5", "file1e3 of v1.2e5"),
    ],
)
def test_powers_of_ten_have_no_e_in_html(number, shown):
    assert Cells(tabulate({"": "x", "y": number})._repr_html_()).cells[-1][1] == shown


def test_units_are_not_torn_from_what_is_before_them():
    shown = tabulate({"after 0.5 s, at [kg m/s]": 1, "2 of three": 2})._repr_html_()
    space = "\N{NO-BREAK SPACE}"
    headings = [f"after 0.5{space}s, at{space}[kg{space}m/s]", f"2{space}of three"]
    assert [text for tag, text in Cells(shown).cells[:2]] == headings


def test_words_are_never_markup():
    evil = '<img src=x onerror="alert(1)">&'
    shown = tabulate({evil: [evil], "2": [evil]}, caption=evil)._repr_html_()
    parsed = Cells(shown)
    assert {tag for tag, _ in parsed.tags} <= set("div table caption thead tbody tr th td".split())  # fmt: skip
    assert shown.count(html.escape(evil)) == 4
    assert all(set(attrs) <= {"style", "scope"} for _, attrs in parsed.tags)


def test_colours_are_the_page_s_own():
    shown = tabulate({"a": [1], "b": ["c"]}, caption="d")._repr_html_()
    assert "background" not in shown and not re.search("#[0-9a-f]{3}|rgb", shown)


@pytest.mark.parametrize(
    ("call", "fault"),
    [
        (lambda: tabulate({"a": [1, 2], "b": [1]}), r"columns: expected .* 'b': 1"),
        (lambda: tabulate(["a", "b"], [(1, 2), (1,)]), "rows: .* got 1 in entry 1"),
        (lambda: tabulate(["a", "b"], []), "rows: expected at least one row"),
        (lambda: tabulate(["a", "b"]), "rows: expected at least one row; got None"),
        (lambda: tabulate({"a": [1, 2]}, digits=(1, 2)), "digits: .* or 1 of them"),
        (lambda: tabulate({"a": []}), "columns: expected at least one row"),
        (lambda: tabulate({}), "columns: expected at least one row"),
        (lambda: tabulate("a", [(1,)]), "columns: expected columns by heading"),
        (lambda: tabulate({"a": [0.5]}, digits=0), "digits: expected a whole number"),
        (lambda: tabulate({"a": [0.5]}, decimals=-1), "decimals: expected a whole"),
        (lambda: tabulate({"a": [0.5]}, decimals="2"), "decimals: expected a whole"),
    ],
)
def test_what_makes_no_table_is_told(call, fault):
    with pytest.raises(ValueError, match=fault):
        call()
