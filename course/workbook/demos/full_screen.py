"""Serve one demo full screen, by Voila."""

from __future__ import annotations

import os
import subprocess
import sys
import tempfile
from pathlib import Path

import nbformat

from course.workbook.films.listing import Listed, find_film

#: Sends at once what a kernel answers.
CHANNEL = "course.workbook.prompt_channel.PromptChannel"
SHARE = Path(__file__).with_name(
    "share"
)  # the page template, which fetches nothing from outside


def notebook_of(film: Listed) -> nbformat.NotebookNode:
    """A notebook that shows the film, large, and nothing else."""
    shown = f"from course.workbook import demos\n\ndemos.{film.name}(large=True)"
    cells = [nbformat.v4.new_code_cell(shown)]
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
    film = find_film(name)
    print(f"{film.title}. {film.look}", flush=True)
    with tempfile.TemporaryDirectory(prefix="course-demo-") as folder:
        path = Path(folder) / f"{film.name}.ipynb"
        nbformat.write(notebook_of(film), path)
        command = [
            sys.executable,
            "-m",
            "voila",
            str(path),
            "--theme=light",
            "--template=course",
            f"--Voila.kernel_websocket_connection_class={CHANNEL}",
        ]
        command += [] if browser else ["--no-browser"]
        command += [f"--port={port}"] if port else []
        shares = [str(SHARE), *filter(None, [os.environ.get("JUPYTER_PATH")])]
        environment = dict(os.environ, JUPYTER_PATH=os.pathsep.join(shares))
        try:
            return subprocess.call(command, env=environment)
        except KeyboardInterrupt:
            return 0
