"""A figure that redraws as sliders move: in JupyterLab, in Voila, and as a still
picture where no widget runs.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping
from typing import Any

import ipywidgets
import matplotlib.pyplot as plt
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from course.workbook.plots.figure import figure_html

Draw = Callable[..., Axes]


class Panel(ipywidgets.VBox):
    """Controls above a figure drawn by ``draw(**values)``.

    ``values`` are the controls' by name.

    The figure is one HTML image, so that it keeps its alternative text, and is redrawn
    at each change. A saved notebook holds it as a still picture of the controls' first
    values.
    """

    def __init__(
        self, draw: Draw, controls: Mapping[str, ipywidgets.Widget], *, columns: int = 3
    ) -> None:
        self._draw, self._controls = draw, dict(controls)
        self._image = ipywidgets.HTML()
        rows = [
            tuple(self._controls.values())[i : i + columns]
            for i in range(0, len(self._controls), columns)
        ]
        super().__init__([*(ipywidgets.HBox(row) for row in rows), self._image])
        for control in self._controls.values():
            control.observe(self._redraw, names="value")
        self._redraw()

    @property
    def values(self) -> dict[str, Any]:
        """The controls' values by name."""
        return {name: control.value for name, control in self._controls.items()}

    @property
    def picture(self) -> str:
        """The figure as it stands: an ``<img>`` with alternative text."""
        return str(self._image.value)

    def _redraw(self, _: Any = None) -> None:
        ax = self._draw(**self.values)
        figure = ax.get_figure(root=True)
        assert isinstance(figure, Figure)
        self._image.value = figure_html(figure, dots_per_inch=150)
        plt.close(figure)

    def _repr_mimebundle_(self, **options: Any) -> Any:
        return {
            **super()._repr_mimebundle_(**options),
            "text/html": self.picture,
            "text/plain": "[widget]",
        }


def slider(
    label: str, value: float, low: float, high: float, step: float, unit: str = ""
) -> ipywidgets.FloatSlider:
    """A slider whose label is wide enough to be read."""
    return ipywidgets.FloatSlider(
        value, min=low, max=high, step=step, description=f"{label} [{unit}]" if unit else label,
        style={"description_width": "13em"}, layout={"width": "30em"}, readout_format=".2f",
    )  # fmt: skip


def log_slider(
    label: str, value: float, low: float, high: float, unit: str = ""
) -> ipywidgets.FloatLogSlider:
    """A slider over powers of ten, from 10^low to 10^high."""
    return ipywidgets.FloatLogSlider(
        value, base=10, min=low, max=high, step=0.1, description=f"{label} [{unit}]" if unit else label,
        style={"description_width": "13em"}, layout={"width": "30em"}, readout_format=".3g",
    )  # fmt: skip
