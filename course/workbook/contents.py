"""The workbook's files as JupyterLab sees them.

Following a link to a lesson makes the working copy where there is none yet. What lies in
lessons/ and solutions/ can be read there and not saved. A saved notebook holds nothing of
the buttons below a check.
"""

from __future__ import annotations

import contextlib
from pathlib import Path
from typing import Any

from jupyter_server.services.contents.largefilemanager import AsyncLargeFileManager
from tornado import web

from course.workbook.notebook import UNSAVED
from course.workbook.overview import PAGE, write_page
from course.workbook.recording import state
from course.workbook.work_folder import READ_ONLY, lesson_files, open_lesson


class WorkbookContents(AsyncLargeFileManager):
    """Jupyter's files, with the lessons' own rules."""

    async def get(self, path: str, *args: Any, **options: Any) -> Any:
        """A file or folder; a lesson's working copy and the page of all lessons are made
        first where they are not there.
        """
        self._make_ready(path.strip("/"))
        return await super().get(path, *args, **options)

    def is_writable(self, path: str) -> bool:
        """Whether anything may be saved there."""
        return not _handed_out(path) and bool(super().is_writable(path))

    async def save(self, model: dict[str, Any], path: str = "") -> Any:
        """Save a file, without the buttons; raises 403 for what is handed out."""
        _refuse(path)
        if model.get("type") == "notebook":
            _leave_out_buttons(model.get("content"))
        return await super().save(model, path)

    async def rename_file(self, old_path: str, new_path: str) -> Any:
        """Rename or move a file; raises 403 from and to what is handed out."""
        for path in (old_path, new_path):
            _refuse(path)
        return await super().rename_file(old_path, new_path)

    async def delete_file(self, path: str) -> Any:
        """Delete a file; raises 403 for what is handed out."""
        _refuse(path)
        return await super().delete_file(path)

    def _make_ready(self, path: str) -> None:
        folder, _, name = path.rpartition("/")
        root = Path(self.root_dir)
        if folder != "work":
            return
        with contextlib.suppress(OSError):  # then there is no such file, and it is said
            if name == PAGE:
                (root / "work").mkdir(exist_ok=True)
                write_page(root / "work", state(root / "work").passed)
            elif not (root / path).exists() and name in {
                lesson.name for lesson in lesson_files(root)
            }:
                open_lesson(name, root)


def _handed_out(path: str) -> bool:
    return path.strip("/").split("/")[0] in READ_ONLY


def _refuse(path: str) -> None:
    if _handed_out(path):
        folder, _, name = path.strip("/").partition("/")
        raise web.HTTPError(
            403,
            f"nothing in {folder}/ is kept: open work/{name or '...'} and write there",
        )


def _leave_out_buttons(notebook: Any) -> None:
    """Take the outputs that are never saved out of a notebook's content."""
    cells = notebook.get("cells", []) if isinstance(notebook, dict) else []
    for cell in cells:
        outputs = cell.get("outputs") if isinstance(cell, dict) else None
        if isinstance(outputs, list):
            cell["outputs"] = [output for output in outputs if not _is_buttons(output)]


def _is_buttons(output: Any) -> bool:
    notes = output.get("metadata", {}) if isinstance(output, dict) else {}
    notes = notes.get("course", {}) if isinstance(notes, dict) else {}
    return isinstance(notes, dict) and notes.get("role") == UNSAVED
