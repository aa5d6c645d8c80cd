"""Buttons below a check, for what can be done next: the same as calling it, by a click.

They are shown in the JupyterLab of ``course open`` only, and are not saved with the
notebook (``contents`` leaves them out): nothing else sees them.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence

from course.workbook.notebook import UNSAVED, in_our_lab

Action = tuple[str, str, Callable[[], None]]


def show_buttons(actions: Sequence[Action]) -> None:
    """Show a row of buttons, each a label, what it says of itself, and what it does.

    What an action shows appears below the row, in the place of what was there. Nothing is
    shown where no front end of ours answers.
    """
    if not actions or not in_our_lab():
        return
    import ipywidgets as widgets
    from IPython.display import display

    below = widgets.Output()

    def doing(action: Callable[[], None]) -> Callable[[object], None]:
        def do(_: object) -> None:
            below.clear_output(wait=True)
            with below:
                action()

        return do

    row = []
    for label, tip, action in actions:
        button = widgets.Button(description=label, tooltip=tip)
        button.layout.width = "auto"
        button.on_click(doing(action))
        row.append(button)
    shown = widgets.VBox([widgets.HBox(row), below])
    bundle = {
        "application/vnd.jupyter.widget-view+json": {
            "version_major": 2,
            "version_minor": 0,
            "model_id": shown.model_id,
        },
        "text/html": "",
        "text/plain": "",
    }
    display(bundle, raw=True, metadata={"course": {"role": UNSAVED}})
