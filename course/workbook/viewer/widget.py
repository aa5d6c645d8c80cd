"""A scene as a widget: k3d draws it in the browser, a slider and a play button move it,
without a network.
"""

from __future__ import annotations

import html
from typing import Any

import ipywidgets
import matplotlib.pyplot as plt
import numpy as np

from course.workbook.plots.figure import PALETTE, figure_html
from course.workbook.viewer.scene import CAMERAS, Scene
from course.workbook.viewer.solids import arrow_triangles, arrow_vertices
from course.workbook.viewer.still import draw, ground_lines

#: The most pictures of a film: each body's place is sent once per picture.
MOST_FRAMES = 300
_FRAMES_A_SECOND = 30
_VIEW_ANGLE = 32.0  # degrees from foot to top of the picture
_LIGHT = 2.4  # k3d's own is 1.5, which leaves the palette's blue almost black


class Viewer(ipywidgets.VBox):
    """A scene to turn with the mouse and to play, or, where no widget runs, a picture
    of one moment.

    Made by ``viewer.show``. The slider and the play button work in the browser alone;
    the kernel is asked only for a camera preset.
    """

    def __init__(
        self,
        scene: Scene,
        *,
        still: float | None = None,
        speed: float = 1.0,
        height: int = 420,
    ) -> None:
        self.scene, self._still, self._speed = scene, still, speed
        self.frames = _frames(scene, speed)
        self.plot = _plot(scene, self.frames, height)
        self.camera = ipywidgets.Dropdown(
            options=list(CAMERAS),
            value=scene.camera,
            description="view from",
            layout={"width": "14em"},
        )
        self.camera.observe(self._look, names="value")
        controls: list[Any] = [self.camera]
        if scene.moves:
            self.slider = _time_slider(scene, self.frames)
            self.play = _play(scene, self.frames, speed)
            self._links = (
                ipywidgets.jslink((self.play, "value"), (self.slider, "index")),
                ipywidgets.jslink((self.slider, "index"), (self.plot, "time")),
            )
            controls = [self.play, self.slider, self.camera]
        self._look(None)
        self._words = ipywidgets.HTML(_legend(scene, speed))
        super().__init__([self.plot, ipywidgets.HBox(controls), self._words])

    def update(self, scene: Scene) -> None:
        """Show another motion of the same bodies, with the same kinds of arrows, at the
        same times.
        """
        alike = len(scene.solids) == len(self.scene.solids) and np.array_equal(
            scene.times, self.scene.times
        )
        if not alike or [a.name for a in scene.arrows] != [
            a.name for a in self.scene.arrows
        ]:
            raise ValueError(
                "scene: expected the same number of bodies, kinds of arrows and times as before"
            )
        self.scene = scene
        drawn = self.plot.objects
        for number in range(len(scene.solids)):
            drawn[number].model_matrix = _matrices(scene, number, self.frames)
        for body, arrows in zip(drawn[len(scene.solids) :], scene.arrows, strict=False):
            body.vertices = _arrow_film(scene, arrows, self.frames)
        self._words.value = _legend(scene, self._speed)

    @property
    def picture(self) -> str:
        """One moment as an ``<img>`` with alternative text."""
        ax = draw(self.scene, time=self._still)
        figure = ax.get_figure(root=True)
        try:
            return figure_html(figure, dots_per_inch=110)
        finally:
            plt.close(figure)

    def _look(self, _: Any) -> None:
        self.plot.camera = camera_of(self.scene, str(self.camera.value))

    def _repr_mimebundle_(self, **options: Any) -> Any:
        text = f"[3D scene] {self.scene.description(0)}"
        return {
            **super()._repr_mimebundle_(**options),
            "text/html": self.picture,
            "text/plain": text,
        }


def camera_of(scene: Scene, preset: str) -> list[float]:
    """k3d's camera for a preset: where it is, what it looks at, what is up.

    Nine numbers.
    """
    direction, up = (np.array(v) for v in CAMERAS[preset])
    distance = 1.08 * max(scene.reach, 1e-6) / np.sin(np.radians(_VIEW_ANGLE / 2))
    place = scene.center + distance * direction / np.linalg.norm(direction)
    return [float(c) for c in (*place, *scene.center, *up)]


def _frames(scene: Scene, speed: float) -> Any:
    """The moments that are shown: as many as a smooth film at this speed needs, evenly
    spread in time.
    """
    if not scene.moves:
        return np.zeros(1, dtype=int)
    duration = scene.times[-1] - scene.times[0]
    wanted = int(
        np.clip(
            np.ceil(_FRAMES_A_SECOND * duration / speed) + 1,
            2,
            min(MOST_FRAMES, len(scene.times)),
        )
    )
    even = np.linspace(scene.times[0], scene.times[-1], wanted)
    after = np.clip(np.searchsorted(scene.times, even), 1, len(scene.times) - 1)
    nearer = np.where(
        even - scene.times[after - 1] <= scene.times[after] - even, after - 1, after
    )
    return np.unique(nearer)


def _plot(scene: Scene, frames: Any, height: int) -> Any:
    import k3d

    plot = k3d.plot(
        height=height, camera_auto_fit=False, grid_auto_fit=False, grid_visible=False, menu_visibility=False,
        camera_fov=_VIEW_ANGLE, lighting=_LIGHT, axes_helper=0.8, time_interpolation=False, name="scene",
    )  # fmt: skip
    low, high = scene.bounds
    plot.grid = [float(v) for v in (*low, *high)]
    for number, solid in enumerate(scene.solids):
        body = k3d.mesh(
            solid.vertices.astype(np.float32), solid.triangles.astype(np.uint32),
            colors=[_rgb(name) for name in solid.colors], flat_shading=not solid.smooth, side="double",
        )  # fmt: skip
        body.model_matrix = _matrices(scene, number, frames)
        plot += body
    for arrows in scene.arrows:
        plot += k3d.mesh(
            _arrow_film(scene, arrows, frames), arrow_triangles(arrows.origin.shape[1]).astype(np.uint32),
            color=_rgb(arrows.color), flat_shading=True, side="double", name=arrows.name,
        )  # fmt: skip
    if scene.ground is not None:
        for segment in ground_lines(scene).astype(np.float32):
            plot += k3d.line(segment, color=0xB5B5B5, shader="simple")
    return plot


def _matrices(scene: Scene, number: int, frames: Any) -> Any:
    """A body's place as 4x4 matrices: one where nothing moves, else one for each
    picture by its number.
    """
    matrix = np.zeros((len(frames), 4, 4), dtype=np.float32)
    matrix[:, :3, :3], matrix[:, :3, 3] = (
        scene.rotation[frames, number],
        scene.position[frames, number],
    )
    matrix[:, 3, 3] = 1.0
    return {str(k): m for k, m in enumerate(matrix)} if scene.moves else matrix[0]


def _arrow_film(scene: Scene, arrows: Any, frames: Any) -> Any:
    shape = (len(scene.times), *arrows.origin.shape[1:])
    origin, length = (
        np.broadcast_to(a, shape)[frames] for a in (arrows.origin, arrows.length)
    )
    vertices = arrow_vertices(origin, length, scene.arrow_width).astype(np.float32)
    vertices = vertices.reshape(len(frames), -1, 3)
    still = arrows.origin.shape[0] == 1 or not scene.moves
    return vertices[0] if still else {str(k): v for k, v in enumerate(vertices)}


def _time_slider(scene: Scene, frames: Any) -> ipywidgets.SelectionSlider:
    digits = max(2, 1 - int(np.floor(np.log10(scene.times[-1] - scene.times[0]))))
    options = [
        (f"{scene.times[k]:.{digits}f} s", number) for number, k in enumerate(frames)
    ]
    return ipywidgets.SelectionSlider(
        options=options,
        index=0,
        description="time",
        layout={"width": "26em"},
        style={"description_width": "3em"},
    )


def _play(scene: Scene, frames: Any, speed: float) -> ipywidgets.Play:
    duration = scene.times[frames[-1]] - scene.times[frames[0]]
    interval = 1000 * duration / speed / (len(frames) - 1)
    return ipywidgets.Play(
        min=0,
        max=len(frames) - 1,
        step=1,
        interval=max(15, round(interval)),
        show_repeat=True,
    )


def _legend(scene: Scene, speed: float) -> str:
    parts = [
        f'<span style="white-space: nowrap; margin-right: 2em"><b style="color: {PALETTE[color]}">&#10230;</b> '
        f"{html.escape(words)}</span>"
        for color, words in scene.legend()
    ]
    if scene.moves and speed != 1.0:
        parts.append(f"<span>played at {speed:.3g} times real speed</span>")
    if scene.caption:
        parts.append(f"<div>{html.escape(scene.caption)}</div>")
    return f'<div role="note" aria-label="{html.escape(scene.description(0))}">{"".join(parts)}</div>'


def _rgb(name: str) -> int:
    return int(PALETTE[name][1:], 16)
