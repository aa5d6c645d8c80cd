"""Showing things where the code runs: in a notebook as HTML, in a terminal as text."""

from __future__ import annotations

import os
import sys
from typing import Any

from course.exercises.message import Message

#: Set for the kernels of the JupyterLab that ``course open`` starts.
OURS = "COURSE_LAB"
#: The role, in an output's metadata, of what is shown and never saved.
UNSAVED = "buttons"


def in_notebook() -> bool:
    """Whether a Jupyter kernel runs this code (IPython in a terminal is not one)."""
    ipython = sys.modules.get("IPython")
    shell = ipython.get_ipython() if ipython is not None else None
    return shell is not None and hasattr(shell, "kernel")


def in_our_lab() -> bool:
    """Whether a student runs this in the JupyterLab of ``course open``: what answers a
    click can be shown there, and is not saved. Tests, graders and exports are elsewhere.
    """
    # the second: a session of the server's, not a program started in one of its terminals
    return in_notebook() and {OURS, "JPY_SESSION_NAME"} <= os.environ.keys()


def display_message(message: Message) -> None:
    """Show a message where the student sees it."""
    if in_notebook():
        from IPython.display import display

        display(message)
    else:
        print(message)


def display_value(value: Any) -> None:
    """Show a value as the last line of a cell would."""
    from IPython.display import display

    display(value)


def display_html(html: str, text: str) -> None:
    """Show HTML in a notebook, its text elsewhere."""
    if in_notebook():
        from IPython.display import display

        bundle: dict[str, Any] = {"text/html": html, "text/plain": text}
        display(bundle, raw=True)
    else:
        print(text)
