"""The notebooks as files: built from their source, comparable by nbval, in the shape every lesson has."""

import ast
import io
import re
import tokenize
from pathlib import Path

import nbformat
import pytest
from nbval.plugin import get_sanitize_patterns

from course.exercises.definition import DEEPER, all_lessons
from course.exercises.message import SYMBOLS, Message
from course.workbook.building import BrokenSource, blank, build, lesson_text
from course.workbook.links import is_link, link_line, title_of, with_links
from course.workbook.work_folder import in_order

ROOT = Path(__file__).resolve().parents[2]
SOLUTIONS = in_order((ROOT / "solutions").glob("*.ipynb"))
#: The parts of a lesson, in order.
SECTIONS = (
    "The question",
    "Derive",
    "Build",
    "On the slide",
    "See",
    "Speed against accuracy",
    "Where it breaks",
    "No more than needed",
    "Recap",
)
#: Lessons that stand in their first edition: the slide first, and no second notebook.
FIRST_EDITION = ("00", "09", "10", "11", "12", "13", "14", "15", "16")
FIRST_SECTIONS = ("On the slide", "Derive", "Build", *SECTIONS[4:])
#: Of a core: words of prose, checks, and minutes of exercises; of everything together.
WORDS, CHECKS, EXERCISE_MINUTES, MINUTES = 2600, 5, 35, 75
# What may differ from run to run, and so is shown but not compared; each such cell says which in its tags.
REASONS = {"measured", "widget"}
each = pytest.mark.parametrize("path", SOLUTIONS, ids=lambda p: p.stem)


def code_cells(path):
    return [c for c in nbformat.read(path, as_version=4).cells if c.cell_type == "code"]


def uncompared(cell) -> str:
    """Why nbval would run this cell without comparing it, or would compare too much; empty if neither."""
    tags = set(cell.metadata.get("tags", []))
    if cell.execution_count is None:
        return "it was not run before it was saved"
    if "raises-exception" in tags or any(
        o.output_type == "error" for o in cell.outputs
    ):
        return "it raises"
    if "nbval-skip" in tags:
        return "it is skipped"
    if "nbval-ignore-output" in tags and not tags & REASONS:
        return (
            "its output is ignored without a reason among its tags (measured, widget)"
        )
    if tags & REASONS and "nbval-ignore-output" not in tags:
        return "its tags say that its output differs from run to run, but nbval compares it"
    if cell.source.rstrip().endswith(";"):
        return "a trailing ; hides what nbval shows"
    return ""


def test_there_are_lessons():
    assert [p.name for p in SOLUTIONS] == [lesson.file_name for lesson in all_lessons()]


def test_lessons_are_what_their_solutions_make():
    assert build(check=True) == []


@each
def test_every_cell_is_compared(path):
    faults = [
        f"cell {i}: {fault}"
        for i, c in enumerate(code_cells(path))
        if (fault := uncompared(c))
    ]
    assert faults == []


@pytest.mark.parametrize(
    ("cell", "fault"),
    [
        (dict(execution_count=None), "not run"),
        (dict(metadata={"tags": ["raises-exception"]}), "raises"),
        (
            dict(
                outputs=[
                    nbformat.v4.new_output("error", ename="E", evalue="", traceback=[])
                ]
            ),
            "raises",
        ),
        (dict(metadata={"tags": ["nbval-ignore-output"]}), "without a reason"),
        (dict(metadata={"tags": ["measured"]}), "compares it"),
        (dict(source="x;"), "trailing"),
    ],
)
def test_a_cell_that_would_not_be_compared_is_found(cell, fault):
    assert fault in uncompared(
        nbformat.v4.new_code_cell(**({"source": "x", "execution_count": 1} | cell))
    )
    assert uncompared(nbformat.v4.new_code_cell("x", execution_count=1)) == ""


def test_nbval_compares_words_and_not_how_they_are_drawn():
    """nbval compares HTML to the letter: a picture in it, or a message's colours, must not count."""
    patterns = get_sanitize_patterns(
        (ROOT / "tests" / "nbval_sanitize.cfg").read_text()
    )

    def compared(text):
        for pattern, instead in patterns:
            text = re.sub(pattern, instead, text)
        return text

    picture = (
        '<img alt="Speed 1.5 m/s" src="data:image/png;base64,{}" style="width: 100px">'
    )
    assert compared(picture.format("iVBORw0+/==")) == compared(picture.format("Zm9v"))
    assert compared(picture.format("Zm9v")) != compared(
        picture.format("Zm9v").replace("1.5", "1.6")
    )
    one, other = (Message(state, "Right: f").html() for state in ("passed", "wrong"))
    assert one != other and compared(one) == compared(other)
    assert compared(str(Message("passed", "Right: f"))) != compared(
        str(Message("wrong", "Right: f"))
    )


@each
def test_figures_are_shown_with_alternative_text(path):
    for i, cell in enumerate(code_cells(path)):
        for output in cell.outputs:
            data = output.get("data", {})
            assert "image/png" not in data, (
                f"cell {i}: no alternative text; end the cell with plots.show()"
            )
            for image in re.findall(r"<img[^>]*>", "".join(data.get("text/html", ""))):
                alt = re.search(r'alt="([^"]*)"', image)
                assert alt and len(alt.group(1)) > 40, (
                    f"cell {i}: alternative text of a few words says nothing"
                )


@each
def test_parts_stand_in_order(path):
    headings = re.findall(r"^## (.+)$", "\n".join(_markdown(path)), flags=re.M)
    sections = FIRST_SECTIONS if path.name[:2] in FIRST_EDITION else SECTIONS
    expected = [s for s in sections if s in headings]
    assert [h for h in headings if h in sections] == expected
    if not path.name.startswith("00-") and not path.stem.endswith(DEEPER):
        assert tuple(expected) == sections


CORES = [le for le in all_lessons() if le.number not in FIRST_EDITION and not le.deeper]


@pytest.mark.parametrize("lesson", CORES, ids=lambda lesson: lesson.number)
def test_a_core_takes_the_time_it_says(lesson):
    """The exercises' own minutes, and words and pictures between a glance and a study.

    A glance: 100 words a minute, a minute a figure or film. A reader who works through
    all of it takes 70 words a minute and two minutes a figure.
    """
    path = ROOT / "solutions" / lesson.file_name
    words = sum(map(words_of_prose, _markdown(path)))
    figures = sum(
        "text/html" in output.get("data", {}) and "<img" in output.data["text/html"]
        for cell in code_cells(path)
        for output in cell.outputs
    )
    exercises = sum(e.minutes for e in lesson.exercises)
    assert all(e.level == "core" for e in lesson.exercises)
    assert words <= WORDS and exercises <= EXERCISE_MINUTES
    assert len(lesson.exercises) <= CHECKS
    quick, slow = words / 100 + figures, words / 70 + 2 * figures
    assert quick - 5 <= lesson.minutes - exercises <= slow + 5
    assert lesson.minutes <= MINUTES
    assert f"{lesson.minutes} minutes" in "\n".join(_markdown(path)[:3])


def words_of_prose(text: str) -> int:
    """Words of a text cell; tables, formulas and code are read otherwise."""
    text = re.sub(r"\$\$.*?\$\$|```.*?```|^\|.*?$", "", text, flags=re.S | re.M)
    text = re.sub(r"\$[^$]*?\$|`[^`]*`", "x", text)
    return len(re.findall(r"[A-Za-z0-9][\w'.,-]*", re.sub(r"\]\(.*?\)", "]", text)))


def test_words_of_prose_are_counted():
    text = "## Two boxes\n| a | b |\nTurn `a` by $x + y$:\n$$\na\n$$\n[see](x.ipynb)."
    assert words_of_prose(text) == 7


@each
def test_style_that_can_be_counted(path):
    for text in _markdown(path):
        for paragraph in re.split(r"\n\s*\n", text):
            prose = re.sub(
                r"\$\$.*?\$\$|\$.*?\$|`.*?`|\[.*?\]\(.*?\)", "x", paragraph, flags=re.S
            )
            if prose.lstrip().startswith(
                ("|", "-", "1.", "#", "*")
            ) and not prose.lstrip().startswith("**"):
                continue
            if prose.startswith("**Read next"):
                continue
            prose = re.sub(
                r"^\*\*.*?\*\*", "", prose, count=1
            )  # a heading in the line is no sentence
            sentences = len(
                re.findall(
                    r"[.!?:](?=\s|$|\*)", prose.replace("...", "").replace(":", "")
                )
            )
            assert sentences <= 4, (
                f"a long paragraph ({sentences} sentences): {paragraph[:80]!r}"
            )
    for cell in code_cells(path):
        if cell.metadata.get("course", {}).get("exercise") is None:
            assert logical_lines(cell.source) <= 16, (
                f"a long cell: {cell.source[:60]!r}"
            )


def logical_lines(code) -> int:
    """How many lines Python counts: a statement wrapped over several counts once."""
    tokens = tokenize.generate_tokens(io.StringIO(code).readline)
    return sum(token.type == tokenize.NEWLINE for token in tokens)


def test_a_wrapped_statement_is_one_line():
    assert logical_lines("x = (\n    1 + 1\n)\n\n# said\nif x:\n    y = x") == 3


@each
def test_no_line_of_code_is_wider_than_the_formatter_s(path):
    """The formatter leaves long texts and comments alone; the page does not."""
    lines = [line for c in code_cells(path) for line in c.source.splitlines()]
    assert [line for line in lines if len(line) > 88] == []


COMMANDS = frozenset(
    """
    alpha approx arctan begin big bigl bigr boldsymbol boxed cdot circ cos dddot ddot delta Delta dfrac dot dots ell end
    frac ge hat infty lambda le left leftarrow ln mathbf mathrm mathsf max min mu neq omega Omega overline partial perp
    pi pm qquad quad rho right sigma sin sqrt sum tau text tfrac theta times to underbrace varepsilon varphi
""".split()
)


@each
def test_formulas_are_written_in_commands_that_are_known(path):
    """A slip like cdotJ prints red letters on the page and fails nowhere else. A new command is added above."""
    for text in _markdown(path):
        for formula in re.findall(r"\$\$.*?\$\$|\$[^$]*?\$", text, flags=re.S):
            unknown = set(re.findall(r"\\([A-Za-z]+)", formula)) - COMMANDS
            assert not unknown, f"{sorted(unknown)} in {formula}"


@each
def test_student_code_is_called_only_through_use(path):
    """A cell that is no exercise names a student's function only as what use, check or hint is given."""
    names = {
        e.name
        for lesson in all_lessons()
        if lesson.file_name == path.name
        for e in lesson.exercises
    }
    for i, cell in enumerate(code_cells(path)):
        if "exercise" in cell.metadata.get("course", {}):
            continue
        tree = ast.parse(cell.source)
        allowed = {
            id(arg)
            for node in ast.walk(tree)
            if isinstance(node, ast.Call)
            and getattr(node.func, "id", "") in ("use", "check", "hint")
            for arg in node.args
        }
        for node in ast.walk(tree):
            if (
                isinstance(node, ast.Name)
                and node.id in names
                and isinstance(node.ctx, ast.Load)
            ):
                assert id(node) in allowed, f"cell {i} calls {node.id} directly"


@each
def test_every_exercise_has_its_cell_and_its_check(path):
    lesson = next(le for le in all_lessons() if le.file_name == path.name)
    own = [c for c in code_cells(path) if "exercise" in c.metadata.get("course", {})]
    cells = {c.metadata.course.exercise: c.source for c in own}
    assert list(cells) == [e.name for e in lesson.exercises]
    for exercise in lesson.exercises:
        named = f', "{exercise.name}"' if exercise.kind == "expression" else ""
        call = f"check({exercise.name}{named})"
        assert call in cells[exercise.name]
        assert "# BEGIN SOLUTION" in cells[exercise.name]
    predicted = re.findall(
        r'predict\(\s*"(\w+)",', "\n".join(c.source for c in code_cells(path))
    )
    assert predicted == [p.name for p in lesson.predictions]


@each
def test_a_notebook_says_which_lesson_it_is(path):
    """Marking believes it: one copied from another lesson's file is marked as that."""
    lesson = next(le for le in all_lessons() if le.file_name == path.name)
    said = nbformat.read(path, as_version=4).metadata.course.lesson
    assert said == lesson.number


@each
def test_checks_pass_in_the_solution_as_stored(path):
    for cell in code_cells(path):
        if "exercise" in cell.metadata.get("course", {}):
            shown = "".join(
                "".join(o.get("data", {}).get("text/plain", "")) for o in cell.outputs
            )
            assert shown.startswith(SYMBOLS["passed"])


def test_blank_replaces_what_is_marked_and_refuses_unpaired_markers():
    code = "def f(x):\n    # BEGIN SOLUTION\n    y = x\n    return y\n    # END SOLUTION\n\n\ncheck(f)"
    assert blank(code) == "def f(x):\n    ...\n\n\ncheck(f)"
    for broken in (
        "# BEGIN SOLUTION\nx",
        "x\n# END SOLUTION",
        "# BEGIN SOLUTION\n# BEGIN SOLUTION\n# END SOLUTION",
    ):
        with pytest.raises(BrokenSource, match="cell 3"):
            blank(broken, where="cell 3")


@pytest.mark.parametrize(
    "marker",
    ("### {} SOLUTION", "#{} SOLUTION", "# {} Solution", "x = 1  # {} SOLUTION"),
)
def test_a_misspelt_marker_hands_no_answer_out(marker):
    with pytest.raises(BrokenSource, match="alone in a line"):
        blank(f"{marker.format('BEGIN')}\nanswer\n{marker.format('END')}")


def test_a_solution_in_a_text_cell_is_refused(tmp_path):
    source = tmp_path / "00-x.ipynb"
    cell = nbformat.v4.new_markdown_cell(
        "Words.\n# BEGIN SOLUTION\nthe answer\n# END SOLUTION"
    )
    source.write_text(nbformat.writes(nbformat.v4.new_notebook(cells=[cell])))
    with pytest.raises(
        BrokenSource, match="cell 0: expected solutions in code cells only"
    ):
        lesson_text(source)


def test_blank_keeps_the_rest_as_it_is():
    for code in (
        "x\n",
        "x",
        "",
        "\n\nx",
        "s = 'a\u2028b\x0c'",
        "\tdef f(): ...",
        "a\x0bb",
    ):
        assert blank(code) == code == blank(blank(code))
    assert (
        blank("a\r\n# BEGIN SOLUTION\r\nb\r\n# END SOLUTION\r\nc\r\n") == "a\n...\nc\n"
    )
    assert blank("\t# BEGIN SOLUTION\n\tb\n\t# END SOLUTION") == "\t..."


def test_drift_is_reported(tmp_path):
    (tmp_path / "solutions").mkdir()
    source = tmp_path / "solutions" / "00-x.ipynb"
    cell = nbformat.v4.new_code_cell(
        "# BEGIN SOLUTION\n1\n# END SOLUTION", execution_count=3
    )
    source.write_text(nbformat.writes(nbformat.v4.new_notebook(cells=[cell])))
    assert build(check=True, root=tmp_path) == [
        "lessons/00-x.ipynb: missing",
        "lessons/Lessons.md: missing",
    ]
    assert not (tmp_path / "lessons").exists()
    build(root=tmp_path)
    assert build(check=True, root=tmp_path) == []
    lesson = tmp_path / "lessons" / "00-x.ipynb"
    assert (
        lesson.read_text() == lesson_text(source, "[all lessons](Lessons.md)")
        and "BEGIN" not in lesson.read_text()
    )
    lesson.write_text(lesson.read_text().replace("...", "1"))
    (tmp_path / "lessons" / "99-y.ipynb").write_text("{}")
    assert build(check=True, root=tmp_path) == [
        "lessons/00-x.ipynb: differs from what its solution makes",
        "lessons/99-y.ipynb: has no solution to be made from",
    ]


def _markdown(path) -> list[str]:
    return [
        c.source
        for c in nbformat.read(path, as_version=4).cells
        if c.cell_type == "markdown"
    ]


def test_every_lesson_begins_and_ends_with_the_same_links_and_each_leads_somewhere():
    names = [path.name for path in SOLUTIONS]
    for name in names:
        cells = nbformat.read(ROOT / "lessons" / name, as_version=4).cells
        assert is_link(cells[0]) and is_link(cells[-1])
        assert sum(is_link(cell) for cell in cells) == 2
        assert cells[0].source == cells[-1].source
        led = re.findall(r"\]\(([^)]+)\)", cells[0].source)
        assert led == led_to(names, name)
        assert all((ROOT / "lessons" / file).is_file() for file in led)


def led_to(names, name):
    """The core before (of a deeper one its own), the page of all, what is deeper, the core after."""
    ending = f"{DEEPER}.ipynb"
    cores = [each for each in names if not each.endswith(ending)]
    core = name.replace(ending, ".ipynb")
    at = cores.index(core)
    before = [core] if name != core else cores[at - 1 : at]
    deeper = [core.replace(".ipynb", ending)] if name == core else []
    deeper = [each for each in deeper if each in names]
    return [*before, "Lessons.md", *deeper, *cores[at + 1 : at + 2]]


def test_links_of_an_earlier_build_are_replaced():
    cells = [nbformat.v4.new_markdown_cell("# A [B] title")]
    titles = {"00-a.ipynb": title_of(cells, "00-a"), "01-b.ipynb": "01 b"}
    once = with_links(cells, "old")
    line = link_line(titles, "01-b.ipynb")
    assert line == r"[← A \[B\] title](00-a.ipynb) · [all lessons](Lessons.md)"
    assert [c.source for c in with_links(once, line)] == [line, "# A [B] title", line]
    assert title_of([], "00-a") == "00-a"
