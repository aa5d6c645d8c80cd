"""The widget for lesson 09: a body that tumbles with no torque on it, L, omega, and where its energy is."""

from __future__ import annotations

from typing import Any

import ipywidgets
import matplotlib.pyplot as plt
import numpy as np

from course import rotations
from course.study.tumbling import (
    HANDLE_CENTERS,
    HANDLE_HALF_EXTENTS,
    Tumble,
    free_tumble,
    handle_mass_properties,
    spinning_handle,
    turnover_times,
)
from course.workbook import viewer
from course.workbook.demos.panel import log_slider, slider
from course.workbook.plots import motion
from course.workbook.plots.figure import describe, figure_html

SECONDS, MOMENTS = 10.0, 251


def tumbling_scene(
    tumble: Tumble, *, arrows: bool = True, camera: str = "corner", caption: str = ""
) -> viewer.Scene:
    """The handle in three dimensions as it moves, with L and omega as arrows from its centre."""
    center = handle_mass_properties().centre
    bar, stem = (
        viewer.box(size, center=place - center, color=color)
        for size, place, color in zip(
            HANDLE_HALF_EXTENTS, HANDLE_CENTERS, ("blue", "orange"), strict=True
        )
    )
    at, momentum, omega = (
        tumble.position[:, None],
        tumble.angular_momentum[None],
        tumble.angular_velocity[:, None],
    )
    shown = [
        viewer.Arrows(
            "L", momentum, "kg m²/s", at=at, scale=_scale(momentum, 0.17), color="green"
        ),
        viewer.Arrows(
            "ω",
            omega,
            "rad/s",
            at=at,
            scale=_scale(omega[:1], 0.14),
            color="vermillion",
        ),
    ]
    return viewer.make_scene(
        viewer.joined(bar, stem, what="handle"),
        at,
        rotations.from_matrix(tumble.rotation)[:, None],
        times=tumble.times,
        arrows=shown if arrows else [],
        camera=camera,
        caption=caption,
    )


def _scale(vectors: Any, length: float) -> float:
    """Metres for one unit, to two digits, that draw a vector about so long [m]: longer than the handle is wide."""
    return float(f"{length / np.linalg.norm(vectors):.1e}")


class TumblingDemo(ipywidgets.VBox):
    """The start on sliders, the motion in three dimensions, and the energy about each axis over time."""

    def __init__(self) -> None:
        axes = list(zip(motion.AXIS_NAMES, range(3), strict=True))
        self.axis = ipywidgets.Dropdown(
            options=axes, value=1, description="spins about", layout={"width": "16em"}
        )
        self.tilt = log_slider("tilt at the start", 1.0, -2, 1.7, "°")
        self.spin = slider("spin", 6.0, 1.0, 12.0, 0.5, "rad/s")
        self.viewer = viewer.show(self._scene(), still=1.56, height=480)
        self._chart = ipywidgets.HTML()
        self._draw()
        self._controls = {"tilt": self.tilt, "spin": self.spin, "axis": self.axis}
        for control in self._controls.values():
            control.observe(self._start_again, names="value")
        self.viewer.layout.width, self._chart.layout.width = "56%", "43%"
        controls = ipywidgets.HBox(
            [self.axis, self.tilt, self.spin], layout={"flex_flow": "row wrap"}
        )
        super().__init__([controls, ipywidgets.HBox([self.viewer, self._chart])])

    @property
    def tumble(self) -> Tumble:
        """The exact motion from the start that the controls say."""
        start = spinning_handle(
            axis=self.axis.value, tilt=np.radians(self.tilt.value), spin=self.spin.value
        )
        return free_tumble(start, np.linspace(0.0, SECONDS, MOMENTS))

    @property
    def values(self) -> dict[str, Any]:
        """The controls' values by name."""
        return {name: control.value for name, control in self._controls.items()}

    @property
    def picture(self) -> str:
        """The chart as it stands: an ``<img>`` with alternative text."""
        return str(self._chart.value)

    def _scene(self) -> viewer.Scene:
        return tumbling_scene(self.tumble)

    def _start_again(self, _: Any) -> None:
        self.viewer.update(self._scene())
        self._draw()

    def _draw(self) -> None:
        tumble = self.tumble
        parts = dict(
            zip(
                (f"about {name}" for name in motion.AXIS_NAMES),
                tumble.turning_energy.T,
                strict=True,
            )
        )
        with motion.style():
            figure, ax = plt.subplots(figsize=(5.4, 4.2))
            motion.energies(tumble.times, parts, title="Energy of turning", ax=ax)
            over = ", ".join(
                f"{when:.2f}" for when in turnover_times(tumble, self.axis.value)
            )
            describe(
                ax,
                f"It lies across its axis of spin at {over} s."
                if over
                else "It never turns over.",
            )
            ax.set_ylim(0.0, 1.12 * float(tumble.turning_energy[0].sum()))
            ax.legend(loc="upper center", bbox_to_anchor=(0.5, -0.16), ncols=2)
        # As wide as its column also where a page's style makes pictures as large as the screen.
        size = "width: 100% !important; height: auto !important; max-width: 100%"
        self._chart.value = figure_html(figure, dots_per_inch=130).replace(
            "max-width: 100%", size
        )
        plt.close(figure)

    def _repr_mimebundle_(self, **options: Any) -> Any:
        still = (
            f'{self.viewer.picture}<div style="max-width: 600px">{self.picture}</div>'
        )
        return {
            **super()._repr_mimebundle_(**options),
            "text/html": still,
            "text/plain": "[widget]",
        }


def tumbling() -> TumblingDemo:
    """A handle that spins about one of its axes, a little tilted: which spins last, and where the energy goes."""
    return TumblingDemo()
