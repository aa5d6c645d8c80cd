"""Serve one demo full screen, by Voila."""

from __future__ import annotations

import subprocess
import sys
import tempfile
from pathlib import Path

import nbformat

from course.workbook.demos import Demo


def notebook_of(demo: Demo) -> nbformat.NotebookNode:
    """A notebook that shows the demo and nothing else."""
    heading = nbformat.v4.new_markdown_cell(f"# {demo.title}\n\n{demo.try_this}")
    code = nbformat.v4.new_code_cell(f"from course.workbook import demos\n\ndemos.{demo.name}()")
    metadata = {"kernelspec": {"display_name": "Python 3", "language": "python", "name": "python3"}}
    return nbformat.v4.new_notebook(cells=[heading, code], metadata=metadata)


def serve(demo: Demo, *, browser: bool = True, port: int | None = None) -> int:
    """Serve until interrupted; returns Voila's exit code."""
    with tempfile.TemporaryDirectory(prefix="course-demo-") as folder:
        path = Path(folder) / f"{demo.name}.ipynb"
        nbformat.write(notebook_of(demo), path)
        command = [sys.executable, "-m", "voila", str(path), "--theme=light"]
        command += [] if browser else ["--no-browser"]
        command += [f"--port={port}"] if port else []
        try:
            return subprocess.call(command)
        except KeyboardInterrupt:
            return 0
