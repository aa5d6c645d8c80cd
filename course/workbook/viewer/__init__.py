"""Bodies in three dimensions: ``viewer.show(...)`` is a film to turn where widgets run,
and a picture elsewhere.

Everything flat is drawn by ``course.workbook.plots``.
"""

from __future__ import annotations

from collections.abc import Sequence

from course.arrays import ArrayLike, failure, scalar, written
from course.workbook.viewer.scene import CAMERAS, Arrows, Scene, make_scene
from course.workbook.viewer.solids import Solid, box, capsule, joined, mesh, sphere
from course.workbook.viewer.still import draw, film
from course.workbook.viewer.widget import Viewer

__all__ = [
    "CAMERAS", "Arrows", "Scene", "Solid", "Viewer", "box", "capsule", "draw", "film", "joined", "make_scene", "mesh",
    "show", "sphere",
]  # fmt: skip


def show(
    solids: Solid | Sequence[Solid] | Scene,
    position: ArrayLike | None = None,
    orientation: ArrayLike | None = None,
    *,
    times: ArrayLike | None = None,
    arrows: Sequence[Arrows] = (),
    ground: float | None = None,
    camera: str = "corner",
    caption: str = "",
    still: float | None = None,
    speed: float = 1.0,
    height: int = 420,
) -> Viewer:
    """Show bodies that stand or move; the last line of a cell.

    In JupyterLab and Voila a widget: turn it with the mouse, play it, drag its time,
    choose a view. In a saved notebook a picture of one moment, with alternative text.
    ``viewer.draw`` gives that picture for any moment, ``viewer.film`` several side by
    side.

    Args:
        solids: what the n bodies look like (``viewer.box``, ``sphere``, ``capsule``,
            ``mesh``, ``joined``); or a whole ``Scene``, and then nothing up to
            ``caption``.
        position: of their centres, (n, 3), or (t, n, 3) where they move [m].
        orientation: unit quaternions, scalar last, (n, 4) or (t, n, 4); none: not
            turned.
        times: (t,) [s], ascending; needed where anything moves.
        arrows: ``viewer.Arrows``; their scale is given below the picture.
        ground: height z of a ground plane [m]; default: none.
        camera: "corner", "front", "side" or "top".
        caption: a sentence on what there is to see; it begins the alternative text.
        still: the time of the picture [s]; default: the first.
        speed: seconds of motion shown in a second.
        height: of the widget [pixels].
    Raises:
        ValueError: shapes that do not fit together, times that do not ascend, an
            unknown camera or colour.
    """
    if not scalar("speed", speed) > 0:
        raise failure("speed", "a number above 0", written(speed))
    if isinstance(solids, Scene):
        scene = solids
    elif position is None:
        raise failure("position", "shape (n, 3) or (t, n, 3)", "none")
    else:
        scene = make_scene(
            solids,
            position,
            orientation,
            times=times,
            arrows=arrows,
            ground=ground,
            camera=camera,
            caption=caption,
        )
    return Viewer(scene, still=still, speed=float(speed), height=height)
