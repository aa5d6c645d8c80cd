"""Serve one demo full screen, by Voila."""

from __future__ import annotations

import os
import subprocess
import sys
import tempfile
from pathlib import Path

import nbformat

from course.workbook.demos.registry import Demo, find_demo

SHARE = Path(__file__).with_name(
    "share"
)  # the page template, which fetches nothing from outside


def notebook_of(demo: Demo) -> nbformat.NotebookNode:
    """A notebook that shows the demo and nothing else."""
    large = "large=True" if demo.on_stage else ""
    shown = f"from course.workbook import demos\n\ndemos.{demo.name}({large})"
    cells = [nbformat.v4.new_code_cell(shown)]
    if not demo.on_stage:  # the stage has a title of its own
        words = f"# {demo.title}\n\n{demo.try_this}"
        cells.insert(0, nbformat.v4.new_markdown_cell(words))
    metadata = {
        "kernelspec": {
            "display_name": "Python 3",
            "language": "python",
            "name": "python3",
        }
    }
    return nbformat.v4.new_notebook(cells=cells, metadata=metadata)


def serve(name: str, *, browser: bool = True, port: int | None = None) -> int:
    """Serve the demo of this name until interrupted.

    Returns Voila's exit code. A taken port gets the next one.
    """
    demo = find_demo(name)
    print(f"{demo.title}. {demo.try_this}", flush=True)
    with tempfile.TemporaryDirectory(prefix="course-demo-") as folder:
        path = Path(folder) / f"{demo.name}.ipynb"
        nbformat.write(notebook_of(demo), path)
        command = [
            sys.executable,
            "-m",
            "voila",
            str(path),
            "--theme=light",
            "--template=course",
        ]
        command += [] if browser else ["--no-browser"]
        command += [f"--port={port}"] if port else []
        shares = [str(SHARE), *filter(None, [os.environ.get("JUPYTER_PATH")])]
        environment = dict(os.environ, JUPYTER_PATH=os.pathsep.join(shares))
        try:
            return subprocess.call(command, env=environment)
        except KeyboardInterrupt:
            return 0
