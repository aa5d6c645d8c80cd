"""What a student and a lecturer see, in a real browser: the lesson, a wrong and a right answer, a widget, a demo."""

import json

import nbformat
import pytest
from browser.session import ROOT, Lab, checkout, chromium, free_port, page, served

pytestmark = [
    pytest.mark.browser,
    pytest.mark.skipif(
        chromium() is None, reason="no Chromium or Chrome on this machine"
    ),
]
pytest.importorskip("playwright", reason="the extra 'browser' is not installed")

WRONG = """\
def impulse_central(mass_1, mass_2, velocity_1, velocity_2, normal, restitution):
    closing = np.sum((velocity_2 - velocity_1) * normal, axis=-1)
    value = restitution * closing / (1 / mass_1 + 1 / mass_2)
    return np.where(closing > 0, value, 0.0)


check(impulse_central)"""
RIGHT = WRONG.replace("value = restitution", "value = (1 + restitution)")
PICTURE = (
    "[...document.querySelectorAll('.jp-OutputArea img, .widget-html img')].length"
)


@pytest.fixture(scope="module")
def lab(tmp_path_factory):
    root = checkout(tmp_path_factory.mktemp("checkout"))
    with (
        served(
            ["open", "10", "--no-browser", "--port", str(free_port())], root
        ) as address,
        page() as opened,
    ):
        session = Lab(opened, address)
        session.root = root
        session.run_all()
        yield session


def test_the_lesson_runs_as_handed_out(lab):
    text = lab.page.inner_text(".jp-Notebook")
    assert "Traceback" not in text and "Error" not in lab.page.inner_text(
        ".jp-OutputArea >> nth=0"
    )
    assert (
        lab.page.locator(
            ".jp-RenderedText[data-mime-type='application/vnd.jupyter.stderr']"
        ).count()
        == 0
    )


def test_nothing_asks_for_news(lab):
    lab.page.wait_for_timeout(1500)
    assert "Jupyter news" not in lab.page.inner_text("body")


def test_a_wrong_answer_is_answered_usefully_and_a_right_one_is_passed(lab):
    told = lab.write_and_run("def impulse_central", WRONG).inner_text()
    assert "✗ Not yet: impulse_central" in told
    assert (
        "The factor is e where it must be 1 + e" in told
        and "expected" in told
        and "4 N s" in told
    )
    cell = lab.cell("def impulse_central")
    cell.get_by_role("button", name="see it move").click()
    cell.locator("canvas").first.wait_for()
    told = lab.write_and_run("def impulse_central", RIGHT).inner_text()
    assert "✓ Right: impulse_central" in told
    events = [
        json.loads(line)
        for line in (lab.root / "work" / ".course" / "progress.jsonl")
        .read_text()
        .splitlines()
    ]
    assert [e["state"] for e in events if e["name"] == "impulse_central"][-2:] == [
        "wrong",
        "passed",
    ]


def test_figures_have_alternative_text_on_the_page(lab):
    texts = lab.page.eval_on_selector_all(
        ".jp-OutputArea img", "images => images.map(i => i.alt)"
    )
    lab.page.evaluate("document.querySelector('.jp-Notebook').scrollTo(0, 0)")
    assert texts and all(len(text) > 40 for text in texts)


def test_the_stage_answers_when_a_slider_is_moved_by_keys(lab):
    """The notebook, in its command mode, does not take the arrows: they would fold a section."""
    cell = lab.cell("demos.impulse()")
    stage = cell.locator(".stage").first.element_handle()
    slider = cell.locator(".stage .knobs input").nth(2)
    slider.scroll_into_view_if_needed()
    words = "root => root.labels.flat().map(label => label.text).join()"
    before = lab.page.evaluate(words, stage)
    slider.focus()
    for _ in range(5):
        lab.page.keyboard.press("ArrowRight")
    changed = f"([root, was]) => ({words})(root) !== was"
    lab.page.wait_for_function(changed, arg=[stage, before], timeout=30_000)
    assert "2 m/s" in before
    assert slider.evaluate("e => document.activeElement === e")


def test_saving_writes_to_work_and_leaves_the_lesson(lab):
    handed_out = (lab.root / "lessons" / "10-impulse.ipynb").read_bytes()
    lab.write_and_run("def impulse_central", RIGHT)
    lab.page.keyboard.press("Control+s")
    lab.page.wait_for_timeout(2000)
    saved = nbformat.read(lab.root / "work" / "10-impulse.ipynb", as_version=4)
    assert any("(1 + restitution)" in cell.source for cell in saved.cells)
    assert (lab.root / "lessons" / "10-impulse.ipynb").read_bytes() == handed_out
    assert handed_out == (ROOT / "lessons" / "10-impulse.ipynb").read_bytes()


@pytest.mark.parametrize("name", ["impulse", "wall"])
def test_a_demo_serves_the_same_widget_full_screen_without_network(name, tmp_path):
    root = checkout(tmp_path)
    with (
        served(
            ["demo", name, "--no-browser", "--port", str(free_port())], root
        ) as address,
        page() as opened,
    ):
        asked = []
        opened.on("request", lambda request: asked.append(request.url))
        opened.goto(address, timeout=240_000)
        picture = opened.locator(".stage.large canvas[role=img]").first
        picture.wait_for(timeout=240_000)
        assert len(picture.get_attribute("aria-label")) > 40
        own = ("http://localhost", "http://127.0.0.1", "data:", "blob:", "ws:")
        outside = [url for url in asked if not url.startswith(own)]
        assert outside == []
        assert "Traceback" not in opened.inner_text("body")
