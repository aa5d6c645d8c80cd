"""The way through the workbook, in a real browser: links, the page of all lessons, the button, what is read only."""

import nbformat
import pytest
from browser.session import Lab, checkout, chromium, free_port, page, served

from course.exercises.definition import all_lessons

pytestmark = [
    pytest.mark.browser,
    pytest.mark.skipif(
        chromium() is None, reason="no Chromium or Chrome on this machine"
    ),
]
expect = pytest.importorskip(
    "playwright.sync_api", reason="the extra 'browser' is not installed"
).expect

#: The lesson after the first one.
NEXT = all_lessons()[1]
TITLE = f"{NEXT.number} {NEXT.title}"
RIGHT = """\
def speed_along(velocity, normal):
    return np.sum(velocity * normal, axis=-1)


check(speed_along)"""
#: The characters of the longest line of text, and the line.
LONGEST = """() => {
  let worst = "";
  for (const block of document.querySelectorAll(".jp-RenderedMarkdown p, .jp-RenderedMarkdown li")) {
    const range = document.createRange(), lines = {};
    const walker = document.createTreeWalker(block, NodeFilter.SHOW_TEXT);
    for (let node; (node = walker.nextNode()); ) {
      if (node.parentElement.closest("mjx-container, .MathJax, pre")) continue;
      for (let i = 0; i < node.length; i++) {
        range.setStart(node, i);
        range.setEnd(node, i + 1);
        const box = range.getBoundingClientRect();
        if (box.width) lines[Math.round(box.bottom / 8)] = (lines[Math.round(box.bottom / 8)] || "") + node.data[i];
      }
    }
    for (const line of Object.values(lines)) if (line.length > worst.length) worst = line;
  }
  return worst;
}"""


@pytest.fixture(scope="module")
def lab(tmp_path_factory):
    root = checkout(tmp_path_factory.mktemp("checkout"))
    arguments = ["open", "00", "--no-browser", "--port", str(free_port())]
    with served(arguments, root) as address, page(1920, 1000) as opened:
        session = Lab(opened, address)
        session.root, session.address = root, address.split("/lab/")[0]
        session.run_all()
        yield session


def names(lab):
    return sorted(path.name for path in (lab.root / "work").glob("[!.]*"))


def follow(lab, text):
    """Click a link at the beginning of the notebook in front."""
    lab.page.evaluate(
        "document.querySelectorAll('.jp-WindowedPanel-outer').forEach(e => e.scrollTo(0, 0))"
    )
    front = ".jp-NotebookPanel:not(.lm-mod-hidden) .jp-RenderedMarkdown"
    lab.page.locator(f"{front} a:has-text('{text}')").first.click()


def in_front(lab, name):
    lab.page.locator(f".lm-TabBar-tabLabel:text-is('{name}')").first.click()
    lab.page.wait_for_timeout(500)


def test_a_button_gives_hints_by_keyboard_and_is_not_saved(lab):
    button = lab.cell("def speed_along").get_by_role("button", name="hint", exact=True)
    assert button.get_attribute("title") == "the next hint for speed_along"
    cell = lab.page.locator(".jp-CodeCell", has_text="def speed_along").first
    for tier in (1, 2):
        button.focus()
        lab.page.keyboard.press("Enter")
        expect(cell).to_contain_text(f"Hint {tier} of 3: speed_along")
    assert cell.inner_text().count("Hint") == 1  # the second in the first one's place
    lab.page.keyboard.press("Control+s")
    lab.page.wait_for_timeout(2000)
    saved = nbformat.read(lab.root / "work" / "00-start-here.ipynb", as_version=4)
    kinds = {k for c in saved.cells for o in c.get("outputs", ()) for k in o.get("data", ())}  # fmt: skip
    assert kinds == {"text/plain", "text/html"}


def test_a_link_to_the_next_lesson_makes_its_copy(lab):
    assert names(lab) == ["00-start-here.ipynb", "Lessons.md"]
    follow(lab, TITLE)
    lab.page.wait_for_selector(f".jp-RenderedMarkdown h1:has-text('{TITLE}')")
    assert names(lab) == ["00-start-here.ipynb", NEXT.file_name, "Lessons.md"]
    in_front(lab, "00-start-here.ipynb")


def test_the_page_of_all_lessons_follows_what_is_done(lab):
    follow(lab, "all lessons")
    bar = lab.page.locator(".jp-MarkdownViewer progress").first
    assert bar.get_attribute("value") == "0"
    in_front(lab, "00-start-here.ipynb")
    told = lab.write_and_run("def speed_along", RIGHT).inner_text()
    assert "✓ Right: speed_along" in told
    follow(lab, "all lessons")
    expect(bar).to_have_attribute("value", "1")
    shown = lab.page.locator(".jp-MarkdownViewer")
    expect(shown).to_contain_text(f"Next: {TITLE}, exercise {NEXT.core[0].name}.")
    shown.get_by_role("link", name=TITLE).first.click()
    expect(lab.page.locator(".lm-mod-current .lm-TabBar-tabLabel").first).to_have_text(
        NEXT.file_name
    )
    in_front(lab, "00-start-here.ipynb")


def test_lines_of_text_can_be_read_on_a_wide_screen(lab):
    longest = lab.page.evaluate(LONGEST)
    assert 60 < len(longest) <= 90, longest


def test_a_table_that_is_printed_keeps_its_columns_on_a_narrow_one(lab):
    lab.page.set_viewport_size({"width": 800, "height": 900})
    try:
        table = lab.cell("progress()").locator("table.course-progress")
        box, bars = table.bounding_box(), table.locator("progress")
        assert box["x"] + box["width"] <= 800
        assert bars.count() == len(all_lessons())
        heights = {round(row.bounding_box()["height"]) for row in table.locator("tr").all()}  # fmt: skip
        assert max(heights) < 60
        speeds = lab.cell("tabulate(").locator("table").last.bounding_box()
        assert speeds["x"] + speeds["width"] <= 800
        printed = lab.cell("a number for each vector").locator("pre").last
        assert printed.evaluate("e => getComputedStyle(e).whiteSpace") == "pre"
    finally:
        lab.page.set_viewport_size({"width": 1920, "height": 1000})


def test_what_is_handed_out_is_read_only_and_says_so(lab):
    lesson = lab.root / "lessons" / "00-start-here.ipynb"
    before = lesson.read_bytes()
    events = (lab.root / "work" / ".course" / "progress.jsonl").read_text()
    with page() as opened:
        # The tab's own token came with the first address; another profile needs it again.
        token = (lab.root / "server.log").read_text().split("token=")[1].split()[0]
        other = Lab(opened, f"{lab.address}/lab/tree/lessons/00-start-here.ipynb?reset&token={token}")  # fmt: skip
        other.run_all()
        told = "lies in lessons/: nothing of it is saved or recorded"
        expect(other.cell("def speed_along")).to_contain_text(told)
        assert "notebook is read-only" in opened.inner_text(".jp-NotebookPanel-toolbar")
        opened.keyboard.press("Control+s")
        opened.wait_for_timeout(1500)
    assert lesson.read_bytes() == before
    assert (lab.root / "work" / ".course" / "progress.jsonl").read_text() == events
