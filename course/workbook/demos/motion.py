"""The widget for lesson 09: a body that tumbles with no torque on it, L, omega, and
where its energy is.
"""

from __future__ import annotations

from typing import Any

import ipywidgets
import matplotlib.pyplot as plt
import numpy as np

from course import rotations
from course.dynamics import Tumble, free_tumble
from course.scenes import handle_mass_properties, spinning_handle
from course.scenes.spinning import HANDLE_CENTERS, HANDLE_HALF_EXTENTS
from course.workbook import viewer
from course.workbook.demos.panel import log_slider, slider
from course.workbook.plots import motion
from course.workbook.plots.figure import describe, figure_html

SECONDS, MOMENTS = 10.0, 251
#: The moment of the saved picture [s], and where the chart's axes are in their figure.
STILL, PLACE = 1.56, (0.16, 0.3, 0.8, 0.61)


def tumbling_scene(
    tumble: Tumble, *, arrows: bool = True, camera: str = "corner", caption: str = ""
) -> viewer.Scene:
    """The handle in three dimensions as it moves, with L and omega as arrows from its
    centre.
    """
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
    """Metres for one unit, to two digits, that draw a vector about this long [m]:
    longer than the handle is wide.
    """
    return float(f"{length / np.linalg.norm(vectors):.1e}")


class TumblingDemo(ipywidgets.VBox):
    """The start on sliders, the motion in three dimensions, and the energy about each
    axis over time.
    """

    def __init__(self) -> None:
        axes = list(zip(motion.AXIS_NAMES, range(3), strict=True))
        self.axis = ipywidgets.Dropdown(
            options=axes, value=1, description="spins about", layout={"width": "16em"}
        )
        self.tilt = log_slider("tilt at the start", 1.0, -2, 1.7, "°")
        self.spin = slider("spin", 6.0, 1.0, 12.0, 0.5, "rad/s")
        self.viewer = viewer.show(self._scene(), still=STILL, height=480)
        self._chart = ipywidgets.HTML()
        # A bar below the chart that ends where the film is, moved in the browser alone.
        self._now = ipywidgets.IntProgress(
            max=len(self.viewer.frames) - 1,
            layout={
                "width": f"{PLACE[2]:.0%}",
                "margin": f"0 0 0 {PLACE[0]:.0%}",
                "height": "8px",
            },
        )
        self._link = ipywidgets.jslink(
            (self.viewer.slider, "index"), (self._now, "value")
        )
        self._draw()
        self._controls = {"tilt": self.tilt, "spin": self.spin, "axis": self.axis}
        for control in self._controls.values():
            control.observe(self._start_again, names="value")
        beside = ipywidgets.VBox([self._chart, self._now], layout={"width": "43%"})
        self.viewer.layout.width, self._chart.layout.width = "56%", "100%"
        controls = ipywidgets.HBox(
            [self.axis, self.tilt, self.spin], layout={"flex_flow": "row wrap"}
        )
        super().__init__([controls, ipywidgets.HBox([self.viewer, beside])])

    @property
    def tumble(self) -> Tumble:
        """The exact motion from the start that the controls say."""
        start = spinning_handle(
            axis=self.axis.value, tilt=np.radians(self.tilt.value), spin=self.spin.value
        )
        return free_tumble(start.bodies, np.linspace(0.0, SECONDS, MOMENTS))

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
        self._chart.value = self._picture(None)

    def _picture(self, now: float | None) -> str:
        tumble = self.tumble
        parts = dict(
            zip(
                (f"about {name}" for name in motion.AXIS_NAMES),
                tumble.turning_energy.T,
                strict=True,
            )
        )
        with motion.style():
            figure = plt.figure(figsize=(5.4, 4.2), layout="none")
            ax = figure.add_axes(PLACE)
            motion.energies(
                tumble.times, parts, title="Energy of turning", now=now, ax=ax
            )
            over = ", ".join(
                f"{when:.2f}" for when in tumble.turnover_times(self.axis.value)
            )
            describe(
                ax,
                f"It lies across its axis of spin at {over} s."
                if over
                else "It never turns over.",
            )
            ax.set_ylim(0.0, 1.12 * float(tumble.turning_energy[0].sum()))
            ax.set_xlim(0.0, SECONDS)  # the bar below runs over the same time
            ax.legend(loc="upper center", bbox_to_anchor=(0.5, -0.16), ncols=2)
        # As wide as its column also where a page's style makes pictures as large as the
        # screen.
        size = "width: 100% !important; height: auto !important; max-width: 100%"
        shown = figure_html(figure, dots_per_inch=130)
        plt.close(figure)
        return shown.replace("max-width: 100%", size)

    def _repr_mimebundle_(self, **options: Any) -> Any:
        chart = self._picture(STILL)
        still = f'{self.viewer.picture}<div style="max-width: 600px">{chart}</div>'
        return {
            **super()._repr_mimebundle_(**options),
            "text/html": still,
            "text/plain": "[widget]",
        }


def tumbling() -> TumblingDemo:
    """A handle that spins about one of its axes, a little tilted: which spins last, and
    where the energy goes.
    """
    return TumblingDemo()
