"""A notebook of the small lessons run in a kernel, as its author did, and what its last check said."""

import os
from pathlib import Path

import nbformat
from nbclient import NotebookClient

TESTS = Path(__file__).resolve().parents[1]
#: Before the first cell: the lessons are the small ones, and every verdict is kept. It leaves no name behind.
STARTUP = """
def _prepare():
    import builtins
    import course.exercises.definition as definition
    import course.workbook.checking
    import course.workbook.recording as recording
    from grading.toy_lessons import LESSONS

    def lessons():
        return LESSONS

    def record(kind, name, **details):
        if kind == "check" and name == "thrice":
            builtins.verdicts_kept.append(details["state"])

    builtins.verdicts_kept = []
    definition.all_lessons = recording.all_lessons = lessons
    recording.record = record
    recording.record_unrecognised = lambda *_, **__: None
    get_ipython().kernel.raw_input = lambda prompt="": "3"  # who is asked types that

_prepare()
del _prepare
"""
#: After the last: what was never checked is judged with what is there.
ENDING = """
import builtins
if not set(builtins.verdicts_kept) - {{"not attempted"}}:
    from course.exercises.definition import find_exercise
    from course.workbook.judging import judge_here
    builtins.verdicts_kept.append(judge_here(find_exercise("thrice")[1], thrice).state)
with open({place!r}, "w") as told:
    told.write(builtins.verdicts_kept[-1])
"""


def verdict_in_kernel(content: bytes, folder: Path) -> str:
    """The state that the last check of ``thrice`` ended with."""
    startup = folder / "ipython" / "profile_default" / "startup"
    startup.mkdir(parents=True)
    (startup / "first.py").write_text(STARTUP)
    work = folder / "work"
    work.mkdir()
    notebook = nbformat.reads(content.decode("utf-8-sig"), as_version=4)
    last = nbformat.v4.new_code_cell(ENDING.format(place=str(folder / "verdict")))
    if notebook.nbformat_minor < 5:
        del last["id"]
    notebook.cells.append(last)
    environment = {
        **os.environ,
        "IPYTHONDIR": str(folder / "ipython"),
        "PYTHONPATH": os.pathsep.join([str(TESTS.parent), str(TESTS)]),
        "HOME": str(folder),
    }
    NotebookClient(
        notebook, timeout=20, allow_errors=True, interrupt_on_timeout=True, kernel_name="python3",
        resources={"metadata": {"path": str(work)}},
    ).execute(env=environment)  # fmt: skip
    # A busy machine loses what a kernel prints, but no file.
    return (folder / "verdict").read_text()
