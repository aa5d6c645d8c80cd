"""Buttons below a check, and what is said in a notebook that keeps nothing: in our JupyterLab only."""

import json
import subprocess
import sys
from pathlib import Path

import pytest
from jupyter_client.manager import KernelManager

from course.workbook import buttons, checking, notebook

ROOT = Path(__file__).resolve().parents[2]
WRONG = "from course.workbook import check\ndef speed_along(velocity, normal): ...\ncheck(speed_along)"


@pytest.mark.parametrize(
    "named, there",
    [((), False), (("COURSE_LAB",), False), (("JPY_SESSION_NAME",), False), (("COURSE_LAB", "JPY_SESSION_NAME"), True)],
)  # fmt: skip
def test_only_a_session_of_our_lab_shows_them(monkeypatch, named, there):
    for name in ("COURSE_LAB", "JPY_SESSION_NAME"):
        monkeypatch.delenv(name, raising=False)
    for name in named:
        monkeypatch.setenv(name, "x")
    assert not notebook.in_our_lab()  # no kernel
    monkeypatch.setattr(notebook, "in_notebook", lambda: True)
    assert notebook.in_our_lab() == there


def test_elsewhere_no_widget_is_even_imported(monkeypatch):
    monkeypatch.setitem(sys.modules, "ipywidgets", None)
    buttons.show_buttons([("hint", "the next hint", pytest.fail)])
    monkeypatch.setattr(buttons, "in_our_lab", lambda: True)
    buttons.show_buttons([])


def outputs(code, folder, **environment):
    """What a kernel in a folder displays."""
    manager = KernelManager(kernel_name="python3")
    own = {"PYTHONPATH": str(ROOT), "PATH": "/usr/bin:/bin", **environment}
    manager.start_kernel(cwd=str(folder), env=own)
    client = manager.client()
    client.start_channels()
    client.wait_for_ready(timeout=60)
    came = []
    try:
        reply = client.execute_interactive(
            code, timeout=120, output_hook=lambda m: came.append(m)
        )
        assert reply["content"]["status"] == "ok", reply["content"]
    finally:
        client.stop_channels()
        manager.shutdown_kernel(now=True)
    return [m["content"] for m in came if m["msg_type"] == "display_data"]


LAB = {"COURSE_LAB": "1", "JPY_SESSION_NAME": "x"}


@pytest.mark.slow
def test_a_failed_check_is_followed_by_a_button_that_is_marked(tmp_path):
    verdict, shown = outputs(WRONG, tmp_path, **LAB)
    assert "Not attempted: speed_along" in verdict["data"]["text/plain"]
    assert (shown["data"]["text/plain"], shown["data"]["text/html"]) == ("", "")
    assert "application/vnd.jupyter.widget-view+json" in shown["data"]
    assert shown["metadata"] == {"course": {"role": "buttons"}}


@pytest.mark.slow
def test_graders_and_strict_runs_see_what_they_saw(tmp_path):
    (verdict,) = outputs(WRONG, tmp_path)
    assert sorted(verdict["data"]) == ["text/html", "text/plain"]


@pytest.mark.slow
def test_a_button_does_what_calling_does_and_keeps_its_place(tmp_path):
    click = """
import gc, ipywidgets
row = [w for w in gc.get_objects() if type(w) is ipywidgets.Button]
assert [(b.description, b.tooltip) for b in row] == [("hint", "the next hint for speed_along")]
"""
    work = tmp_path / "work"
    work.mkdir()
    (tmp_path / "lessons").mkdir()
    code = f"{WRONG}\n{click}\nrow[0].click()\nrow[0].click()"
    outputs(code, work, **LAB)
    events = [
        json.loads(line)
        for line in (work / ".course" / "progress.jsonl").read_text().splitlines()
    ]
    assert [(e["kind"], e.get("tier")) for e in events] == [("check", None), ("hint", 1), ("hint", 2)]  # fmt: skip


@pytest.mark.parametrize("folder", ["lessons", "solutions", "work", "elsewhere"])
def test_a_notebook_that_keeps_nothing_says_so_once(
    tmp_path, monkeypatch, capsys, folder
):
    (tmp_path / folder).mkdir()
    monkeypatch.chdir(tmp_path / folder)
    monkeypatch.setattr(checking, "in_our_lab", lambda: True)
    checking.say_that_nothing_is_kept.cache_clear()
    for _ in range(2):
        checking.say_that_nothing_is_kept()
    said = capsys.readouterr().out
    handed_out = folder in ("lessons", "solutions")
    assert said.count(f"lies in {folder}/: nothing of it is saved") == int(handed_out)
    checking.say_that_nothing_is_kept.cache_clear()
    monkeypatch.setattr(checking, "in_our_lab", lambda: False)
    checking.say_that_nothing_is_kept()
    assert capsys.readouterr().out == ""
    checking.say_that_nothing_is_kept.cache_clear()


def test_the_modules_a_lesson_loads_bring_no_server():
    code = (
        "import course.workbook, sys\n"
        "print([m for m in ('jupyter_server', 'ipywidgets', 'tornado') if m in sys.modules])"
    )
    out = subprocess.run(
        [sys.executable, "-c", code],
        cwd=ROOT,
        capture_output=True,
        text=True,
        check=True,
    )
    assert out.stdout.strip() == "[]"
