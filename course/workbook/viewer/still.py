"""One moment of a scene drawn in matplotlib: for saved notebooks, for rows of moments,
for where no widget runs.
"""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

import matplotlib as mpl
import matplotlib.pyplot as plt
import numpy as np

from course.arrays import Array, failure
from course.workbook.plots.figure import PALETTE, describe, style
from course.workbook.viewer.scene import CAMERAS, Scene
from course.workbook.viewer.solids import arrow_triangles, arrow_vertices

_LIGHT = np.array([0.35, -0.5, 0.79])
_FINE = 1000  # triangles, at least


def draw(scene: Scene, *, time: float | None = None, ax: Any = None) -> Any:
    """The scene at a time [s] (default: its first) on matplotlib's 3D axes;
    returns them.

    ``ax`` needs ``projection="3d"``; a new figure, with the legend and the caption,
    where none is given.
    """
    index = 0 if time is None else scene.index_at(time)
    with style():
        alone = ax is None
        if alone:
            figure = plt.figure(figsize=(6.6, 4.6), layout="none")
            rows = -(-len(scene.legend()) // 2)  # of the legend, below the axis labels
            foot = 0.09 + 0.05 * rows
            ax = figure.add_axes(
                (0.0, foot, 1.0, 0.97 - foot), projection="3d", computed_zorder=False
            )
            _legend(figure, scene, index)
        _draw(ax, scene, index)
        if not alone and scene.moves:
            _title(ax, scene, index)
    describe(ax, scene.description(index))
    return ax


def film(scene: Scene, times: Sequence[float], *, columns: int = 4) -> Any:
    """The scene at several times [s] side by side, ``columns`` a row.

    Returns the figure.
    """
    if not len(times):
        raise failure("times", "at least one", "none")
    rows = -(-len(times) // columns)
    with style():
        figure = plt.figure(figsize=(2.3 * columns, 2.3 * rows + 0.4), layout="none")
        for k, time in enumerate(times):
            row, column = divmod(k, columns)
            place = (column / columns, 0.4 / (2.3 * rows + 0.4) + (rows - 1 - row) * 2.3 / (2.3 * rows + 0.4),
                     1 / columns, 2.2 / (2.3 * rows + 0.4))  # fmt: skip
            ax: Any = figure.add_axes(place, projection="3d", computed_zorder=False)
            index = scene.index_at(time)
            _draw(ax, scene, index)
            _title(ax, scene, index)
            ax.set_axis_off()
            ax.set_box_aspect((1, 1, 1), zoom=1.35)
        _legend(figure, scene, None)
    shown = ", ".join(f"{scene.times[scene.index_at(time)]:.2f}" for time in times)
    describe(ax, f"{scene.description(None)} Shown side by side at {shown} s.")
    return figure


def _draw(ax: Any, scene: Scene, index: int) -> None:
    _triangles(ax, scene, index)
    if scene.ground is not None:
        _ground(ax, scene)
    _frame(ax, scene)


def _title(ax: Any, scene: Scene, index: int) -> None:
    ax.set_title(f"{scene.times[index]:.2f} s", fontsize=10, loc="center", y=0.94)


def _triangles(ax: Any, scene: Scene, index: int) -> None:
    """Bodies and arrows as one collection, so that matplotlib sorts all their triangles
    by depth.
    """
    from mpl_toolkits.mplot3d.art3d import Poly3DCollection

    corners, colors = [], []
    for solid, vertices in zip(scene.solids, scene.vertices(index), strict=True):
        corners.append(vertices[solid.triangles])
        colors.append(
            np.array(
                [
                    mpl.colors.to_rgb(PALETTE[solid.colors[k]])
                    for k in solid.triangles[:, 0]
                ]
            )
        )
    for arrows in scene.arrows:
        here = min(index, len(arrows.origin) - 1)
        vertices = arrow_vertices(
            arrows.origin[here], arrows.length[here], scene.arrow_width
        ).reshape(-1, 3)
        triangles = vertices[arrow_triangles(arrows.origin.shape[1])]
        corners.append(triangles)
        colors.append(
            np.broadcast_to(
                mpl.colors.to_rgb(PALETTE[arrows.color]), (len(triangles), 3)
            )
        )
    faces, paint = np.concatenate(corners), np.concatenate(colors)
    while len(faces) < _FINE:
        faces, paint = _quartered(faces), np.repeat(paint, 4, axis=0)
    shaded = paint * _brightness(faces)[:, None]
    ax.add_collection3d(
        Poly3DCollection(
            faces, facecolors=shaded, edgecolors=shaded, linewidths=0.3, zorder=1
        )
    )


def _quartered(faces: Array) -> Array:
    """Each triangle as four: matplotlib sorts whole triangles by depth, and errs less
    with small ones.
    """
    a, b, c = np.moveaxis(faces, 1, 0)
    ab, bc, ca = 0.5 * (a + b), 0.5 * (b + c), 0.5 * (c + a)
    four = [(a, ab, ca), (ab, b, bc), (ca, bc, c), (ab, bc, ca)]
    return np.stack([np.stack(corners, axis=1) for corners in four], axis=1).reshape(
        -1, 3, 3
    )


def _brightness(faces: Array) -> Array:
    normal = np.cross(faces[:, 1] - faces[:, 0], faces[:, 2] - faces[:, 0])
    length = np.linalg.norm(normal, axis=-1, keepdims=True)
    normal = np.divide(normal, length, out=np.zeros_like(normal), where=length > 0)
    return 0.62 + 0.38 * np.clip(normal @ (_LIGHT / np.linalg.norm(_LIGHT)), -0.6, 1.0)


def ground_lines(scene: Scene, *, lines: int = 9) -> Array:
    """The grid of the ground plane: segments (2 * lines, 2, 3) [m]."""
    assert scene.ground is not None
    half = 0.95 * max(scene.reach, 1e-9)
    at = np.linspace(-half, half, lines)
    segments = np.zeros((2 * lines, 2, 3))
    segments[:lines, :, 0], segments[:lines, 0, 1], segments[:lines, 1, 1] = (
        at[:, None],
        -half,
        half,
    )
    segments[lines:, :, 1], segments[lines:, 0, 0], segments[lines:, 1, 0] = (
        at[:, None],
        -half,
        half,
    )
    middle = scene.center
    return segments + np.array([middle[0], middle[1], scene.ground])


def _ground(ax: Any, scene: Scene) -> None:
    from mpl_toolkits.mplot3d.art3d import Line3DCollection

    ax.add_collection3d(
        Line3DCollection(ground_lines(scene), colors="0.75", linewidths=0.7, zorder=0.5)
    )


def _frame(ax: Any, scene: Scene) -> None:
    direction, up = (np.array(v) for v in CAMERAS[scene.camera])
    elevation = np.degrees(np.arcsin(direction[2] / np.linalg.norm(direction)))
    azimuth = np.degrees(np.arctan2(direction[1], direction[0])) if up[2] else -90.0
    ax.view_init(elev=elevation, azim=azimuth)
    if scene.camera != "corner":
        ax.set_proj_type("ortho")
    half = max(scene.reach, 1e-9)
    for set_limits, middle in zip(
        (ax.set_xlim, ax.set_ylim, ax.set_zlim), scene.center, strict=True
    ):
        set_limits(middle - half, middle + half)
    ax.set_box_aspect((1, 1, 1), zoom=1.05)
    labels = ("x [m]", "y [m]", "z [m]")
    for axis, label, along in zip(
        (ax.xaxis, ax.yaxis, ax.zaxis), labels, np.abs(direction), strict=True
    ):
        seen = along < 0.99  # an axis that points at the camera has no length
        axis.set_label_text(label if seen else "")
        axis.set_major_locator(
            mpl.ticker.MaxNLocator(4) if seen else mpl.ticker.NullLocator()
        )
        axis.pane.set_facecolor((1, 1, 1, 0))
        axis.set_tick_params(labelsize=8)


def _legend(figure: Any, scene: Scene, index: int | None) -> None:
    """The arrows' colours and scales in one line at the foot, the time at the top."""
    handles = [
        mpl.lines.Line2D(
            [], [], color=PALETTE[color], lw=2.5, marker=">", ls="-", label=words
        )
        for color, words in scene.legend()
    ]
    if handles:
        figure.legend(
            handles=handles,
            loc="lower center",
            ncols=2 if len(handles) > 1 else 1,
            fontsize=9,
        )
    if index is not None and scene.moves:
        figure.suptitle(
            f"t = {scene.times[index]:.2f} s", x=0.02, y=0.97, ha="left", fontsize=11
        )
