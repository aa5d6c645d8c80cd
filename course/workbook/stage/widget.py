"""An exhibit as a widget of JupyterLab and Voila, and as a still where none runs."""

from __future__ import annotations

from typing import Any

import anywidget
import traitlets

from course.workbook.stage.encoding import encoded
from course.workbook.stage.exhibit import Exhibit, exhibit_json
from course.workbook.stage.module import program, style
from course.workbook.stage.still import image


class StageWidget(anywidget.AnyWidget):
    """A film in the browser; asks ``exhibit`` for another when a knob or a hand moves.

    Args:
        exhibit: what is shown.
        still: the time of the picture in a saved notebook [s].
        large: for a lecture room.
    """

    _esm = program()
    _css = style()
    exhibit = traitlets.Dict().tag(sync=True)
    answers = traitlets.Bool().tag(sync=True)

    def __init__(
        self, exhibit: Exhibit, *, still: float | None = None, large: bool = False
    ) -> None:
        self.shown, self._still = exhibit, still
        self.values = dict(exhibit.values)
        self._answered: tuple[Any, dict[str, Any]] | None = None
        super().__init__(
            exhibit=exhibit_json(exhibit, large=large), answers=bool(exhibit.knobs)
        )
        self.on_msg(self._asked)

    def _asked(self, _: Any, content: Any, __: Any) -> None:
        """A question from the browser: the film of these values, or why there is none.

        One that is asked again, because its answer was lost or is late, gets the same.
        """
        question = (content.get("id"), content["values"])
        if self._answered is None or self._answered[0] != question:
            self._answered = question, self._answer(content["values"])
        self.send({**self._answered[1], "id": question[0]})

    def _answer(self, values: Any) -> dict[str, Any]:
        try:
            self.values |= {k: float(v) for k, v in values.items() if k in self.values}
            return {"kind": "film", "film": encoded(self.shown.made(**self.values))}
        except Exception as error:  # a student's function may raise anything
            return {"kind": "failed", "words": f"{type(error).__name__}: {error}"}

    @property
    def picture(self) -> str:
        """The film of the present values at ``still``: an ``<img>`` with its text."""
        return image(self.shown.made(**self.values), time=self._still)

    def _repr_mimebundle_(self, **options: Any) -> Any:
        shown = super()._repr_mimebundle_(**options)
        data, *rest = shown if isinstance(shown, tuple) else (shown, {})
        data = {**(data or {}), "text/html": self.picture, "text/plain": "[stage]"}
        return (data, *rest) if isinstance(shown, tuple) else data
