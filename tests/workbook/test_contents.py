"""The workbook's files as JupyterLab sees them: copies made by a link, nothing saved in what is handed out."""

import asyncio

import nbformat
import pytest
from tornado import web

from course.workbook.contents import WorkbookContents
from course.workbook.work_folder import READ_ONLY

LESSON = nbformat.writes(nbformat.v4.new_notebook())


@pytest.fixture
def root(tmp_path):
    for folder in ("lessons", "solutions"):
        (tmp_path / folder).mkdir()
        (tmp_path / folder / "10-impulse.ipynb").write_text(LESSON)
    return tmp_path


@pytest.fixture
def files(root):
    return WorkbookContents(root_dir=str(root))


def run(task):
    return asyncio.run(task)


@pytest.mark.parametrize("content", [True, False])
def test_a_link_to_a_lesson_makes_its_working_copy(files, root, content):
    model = run(files.get("work/10-impulse.ipynb", content=content))
    assert model["type"] == "notebook" and model["writable"]
    assert (root / "work" / "10-impulse.ipynb").read_text() == LESSON
    assert (
        "10-impulse.ipynb"
        in (root / "work" / ".course" / "started-from").read_text().split()
    )


def test_a_copy_that_is_there_is_left(files, root):
    run(files.get("work/10-impulse.ipynb"))
    mine = nbformat.writes(
        nbformat.v4.new_notebook(cells=[nbformat.v4.new_code_cell("1")])
    )
    (root / "work" / "10-impulse.ipynb").write_text(mine)
    (root / "lessons" / "10-impulse.ipynb").write_text(LESSON + " ")
    run(files.get("/work/10-impulse.ipynb"))
    assert (root / "work" / "10-impulse.ipynb").read_text() == mine
    assert [p.name for p in (root / "work").glob("*.ipynb")] == ["10-impulse.ipynb"]


@pytest.mark.parametrize(
    "path", ["work/99-none.ipynb", "work/impulse.ipynb", "work/../10-impulse.ipynb", "10-impulse.ipynb",
             "work/sub/10-impulse.ipynb"],
)  # fmt: skip
def test_only_names_that_are_lessons_are_copied(files, root, path):
    with pytest.raises(web.HTTPError) as told:
        run(files.get(path))
    assert told.value.status_code == 404
    assert not (root / "work").exists()


def test_a_working_folder_that_cannot_be_made_says_that_there_is_no_such_file(
    files, root
):
    (root / "work").write_text("in the way")
    with pytest.raises(web.HTTPError) as told:
        run(files.get("work/10-impulse.ipynb"))
    assert told.value.status_code == 404


def test_the_page_of_all_lessons_is_made(files, root):
    model = run(files.get("work/Lessons.md"))
    assert "[10 Impulse](10-impulse.ipynb)" in model["content"]


@pytest.mark.parametrize("folder", READ_ONLY)
def test_what_is_handed_out_is_read_and_not_written(files, root, folder):
    path = f"{folder}/10-impulse.ipynb"
    model = run(files.get(path))
    assert not model["writable"] and not run(files.get(folder))["writable"]
    run(files.get("work/10-impulse.ipynb"))
    tries = [
        files.save(model, path),
        files.save({"type": "file", "format": "text", "content": ""}, f"{folder}/new"),
        files.rename_file(path, "work/mine.ipynb"),
        files.rename_file("work/10-impulse.ipynb", f"{folder}/mine.ipynb"),
        files.delete_file(path),
        files.new_untitled(folder, type="notebook"),
    ]
    for attempt in tries:
        with pytest.raises(web.HTTPError, match="nothing in .* is kept: open work/"):
            run(attempt)
    assert (root / path).read_text() == LESSON
    assert [p.name for p in (root / folder).iterdir()] == ["10-impulse.ipynb"]


def test_a_saved_notebook_holds_nothing_of_the_buttons(files, root):
    shown = nbformat.v4.new_output("display_data", {"text/plain": "said"})
    buttons = nbformat.v4.new_output(
        "display_data", {"text/plain": ""}, metadata={"course": {"role": "buttons"}}
    )
    cell = nbformat.v4.new_code_cell("check(f)", outputs=[shown, buttons, shown])
    odd = nbformat.v4.new_code_cell("1", outputs=[shown])
    odd.outputs[0].metadata["course"] = "not notes"
    notebook = nbformat.v4.new_notebook(
        cells=[nbformat.v4.new_markdown_cell("x"), cell, odd]
    )
    (root / "work").mkdir()
    model = {"type": "notebook", "format": "json", "content": notebook}
    run(files.save(model, "work/10-impulse.ipynb"))
    saved = nbformat.read(root / "work" / "10-impulse.ipynb", as_version=4)
    assert [len(c.get("outputs", ())) for c in saved.cells] == [0, 2, 1]
