"""Showing things where the code runs: in a notebook as HTML, in a terminal as text."""

from __future__ import annotations

import sys
from typing import Any

from course.exercises.message import Message


def in_notebook() -> bool:
    """Whether a Jupyter kernel runs this code (IPython in a terminal is not one)."""
    ipython = sys.modules.get("IPython")
    shell = ipython.get_ipython() if ipython is not None else None
    return shell is not None and hasattr(shell, "kernel")


def display_message(message: Message) -> None:
    """Show a message where the student sees it."""
    if in_notebook():
        from IPython.display import display

        display(message)
    else:
        print(message)


def display_html(html: str, text: str) -> None:
    """Show HTML in a notebook, its text elsewhere."""
    if in_notebook():
        from IPython.display import display

        bundle: dict[str, Any] = {"text/html": html, "text/plain": text}
        display(bundle, raw=True)
    else:
        print(text)
