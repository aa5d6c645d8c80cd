"""What the viewer is given: bodies that stand or move, arrows, a camera and a ground,
checked and in words.
"""

from __future__ import annotations

from collections import Counter
from collections.abc import Sequence
from dataclasses import dataclass, field

import numpy as np

from course import rotations
from course.arrays import (
    Array,
    ArrayLike,
    choice,
    failure,
    read_only,
    scalar,
    scalars,
    unit_quaternions,
    vectors,
    written,
)
from course.workbook.plots.figure import PALETTE
from course.workbook.viewer.solids import Solid

#: The presets: where the camera looks from (a direction), and what is up in its
#: picture.
CAMERAS = {
    "corner": ((0.62, -0.72, 0.42), (0.0, 0.0, 1.0)),
    "front": ((0.0, -1.0, 0.0), (0.0, 0.0, 1.0)),
    "side": ((1.0, 0.0, 0.0), (0.0, 0.0, 1.0)),
    "top": ((0.0, 0.0, 1.0), (0.0, 1.0, 0.0)),
}
ARROW_COLORS = ("vermillion", "green", "purple", "black", "orange", "sky")


@dataclass(frozen=True, eq=False)
class Arrows:
    """Arrows of one kind: velocities, L, omega, normals, forces.

    Args:
        name: as the legend has it, "L".
        vector: (m, 3), or (t, m, 3) where they change, in ``unit``.
        unit: of the vector, "kg m²/s"; empty for a unit vector.
        at: where they start, (m, 3) or (t, m, 3) [m]; default: the bodies' centres.
        scale: how many metres are drawn for one unit; default: such that the longest
            arrow fits the scene. The legend shows it.
        color: a name of the palette; default: the next of a list.
    """

    name: str
    vector: ArrayLike
    unit: str = ""
    at: ArrayLike | None = None
    scale: float | None = None
    color: str = ""


@dataclass(frozen=True, eq=False)
class PlacedArrows:
    """Arrows as a scene holds them: origin and drawn length (t, m, 3) [m], t or 1."""

    name: str
    unit: str
    scale: float
    color: str
    origin: Array
    length: Array


@dataclass(frozen=True, eq=False)
class Scene:
    """Bodies over time; ``show`` makes one. One time where nothing moves.

    Args:
        solids: n of them.
        times: (t,) [s], ascending.
        position: (t, n, 3) [m].
        rotation: (t, n, 3, 3).
        arrows: placed, with t or 1 along the first axis.
        ground: height z of a ground plane [m]; None: there is none.
        camera: a preset.
        caption: a sentence on what there is to see.
    """

    solids: tuple[Solid, ...]
    times: Array
    position: Array
    rotation: Array
    arrows: tuple[PlacedArrows, ...] = ()
    ground: float | None = None
    camera: str = "corner"
    caption: str = ""
    bounds: tuple[Array, Array] = field(init=False)

    def __post_init__(self) -> None:
        object.__setattr__(self, "bounds", _bounds(self))

    @property
    def moves(self) -> bool:
        """Whether there is more than one moment to show."""
        return len(self.times) > 1

    @property
    def center(self) -> Array:
        """The middle of all that is ever to be seen, (3,) [m]."""
        return 0.5 * (self.bounds[0] + self.bounds[1])

    @property
    def radius(self) -> float:
        """Half the diagonal of all that is ever to be seen [m]."""
        return 0.5 * float(np.linalg.norm(self.bounds[1] - self.bounds[0]))

    @property
    def reach(self) -> float:
        """How far from its centre anything is ever to be seen [m].

        Less than ``radius`` where a body turns.
        """
        far = [
            a.origin + part * a.length - self.center
            for a in self.arrows
            for part in (0.0, 1.0)
        ]
        farthest = max(
            (float(np.linalg.norm(p, axis=-1).max(initial=0.0)) for p in far),
            default=0.0,
        )
        if self.solids:
            away = np.linalg.norm(self.position - self.center, axis=-1) + [
                s.reach for s in self.solids
            ]
            farthest = max(farthest, float(away.max()))
        return farthest

    @property
    def arrow_width(self) -> float:
        """Radius of an arrow's shaft [m]."""
        return 0.011 * self.radius

    def index_at(self, time: float) -> int:
        """The moment nearest to a time [s]."""
        return int(np.argmin(np.abs(self.times - scalar("time", time))))

    def vertices(self, index: int) -> list[Array]:
        """Each body's vertices in the world at a moment."""
        placed = zip(
            self.solids, self.rotation[index], self.position[index], strict=True
        )
        return [s.vertices @ turn.T + x for s, turn, x in placed]

    def legend(self) -> list[tuple[str, str]]:
        """Colour and words for each kind of arrow, its scale included."""
        return [(a.color, f"{a.name}: {_scale_in_words(a)}") for a in self.arrows]

    def description(self, index: int | None = 0) -> str:
        """Alternative text for the picture of a moment.

        None: of no moment in particular.
        """
        counted = Counter(s.what for s in self.solids)
        bodies = (
            " and ".join(
                f"{n} {_several(what)}" if n > 1 else f"a {what}"
                for what, n in counted.items()
            )
            or "no bodies"
        )
        when = (
            f" at {self.times[index]:.3g} s of {self.times[0]:.3g} to {self.times[-1]:.3g} s"
            if self.moves and index is not None
            else ""
        )
        ground = " above the ground plane" if self.ground is not None else ""
        told = "; ".join(words for _, words in self.legend())
        shown = f" Arrows: {told}." if self.arrows else ""
        caption = f"{self.caption.rstrip('.')}. " if self.caption else ""
        return f"{caption}Three-dimensional picture of {bodies}{ground}{when}.{shown}"


def make_scene(
    solids: Solid | Sequence[Solid],
    position: ArrayLike,
    orientation: ArrayLike | None = None,
    *,
    times: ArrayLike | None = None,
    arrows: Sequence[Arrows] = (),
    ground: float | None = None,
    camera: str = "corner",
    caption: str = "",
) -> Scene:
    """A scene from arrays; arguments as ``viewer.show`` has them."""
    known = (solids,) if isinstance(solids, Solid) else tuple(solids)
    for solid in known:
        if not isinstance(solid, Solid):
            raise failure(
                "solids", "solids, as viewer.box(...) makes them", type(solid).__name__
            )
    t = _times(times)
    x = _over_time("position", vectors("position", position), len(known), t)
    q = (
        rotations.identity(len(known))
        if orientation is None
        else unit_quaternions("orientation", orientation)
    )
    q = _over_time("orientation", q, len(known), t)
    turn = rotations.to_matrix(np.broadcast_to(q, (len(t), *q.shape[1:])))
    x = np.broadcast_to(x, (len(t), *x.shape[1:]))
    height = None if ground is None else scalar("ground", ground)
    choice("camera", camera, tuple(CAMERAS))
    bare = Scene(known, t, read_only(x), read_only(turn), (), height, camera, caption)
    placed = tuple(_place(a, i, bare) for i, a in enumerate(arrows))
    return Scene(
        known, t, bare.position, bare.rotation, placed, height, camera, caption
    )


def _times(times: ArrayLike | None) -> Array:
    if times is None:
        return np.zeros(1)
    t = scalars("times", times)
    if t.ndim != 1 or not t.size or np.any(np.diff(t) <= 0):
        raise failure("times", "ascending numbers of shape (t,)", written(t))
    return t


def _over_time(name: str, array: Array, count: int, times: Array) -> Array:
    """Given once or for each time -> (1 or t, count, ...)."""
    core = array.shape[-1:]
    if array.shape == (count, *core):
        return array[None]
    if array.shape != (len(times), count, *core):
        moving = f" or ({len(times)}, {count}, {core[0]})" if len(times) > 1 else ""
        raise failure(
            name, f"shape ({count}, {core[0]}){moving}", f"shape {array.shape}"
        )
    return array


def _place(arrows: Arrows, number: int, scene: Scene) -> PlacedArrows:
    if not isinstance(arrows, Arrows):
        raise failure("arrows", "viewer.Arrows(...)", type(arrows).__name__)
    vector = vectors(f"arrows {arrows.name}", arrows.vector)
    at = (
        scene.position
        if arrows.at is None
        else vectors(f"arrows {arrows.name}, at", arrows.at)
    )
    if vector.ndim < 2:
        raise failure(
            f"arrows {arrows.name}",
            "shape (m, 3) or (t, m, 3)",
            f"shape {vector.shape}",
        )
    count = vector.shape[-2]
    vector = _over_time(f"arrows {arrows.name}", vector, count, scene.times)
    at = _over_time(f"arrows {arrows.name}, at", at, count, scene.times)
    scale = (
        _nice_scale(vector, scene)
        if arrows.scale is None
        else scalar(f"arrows {arrows.name}, scale", arrows.scale)
    )
    if not scale > 0:
        raise failure(
            f"arrows {arrows.name}, scale", "a number above 0", written(scale)
        )
    color = arrows.color or ARROW_COLORS[number % len(ARROW_COLORS)]
    choice(f"arrows {arrows.name}, color", color, tuple(PALETTE))
    length = scale * vector
    shape = np.broadcast_shapes(at.shape, length.shape)
    return PlacedArrows(
        arrows.name,
        arrows.unit,
        scale,
        color,
        np.broadcast_to(at, shape),
        np.broadcast_to(length, shape),
    )


def _nice_scale(vector: Array, scene: Scene) -> float:
    """Metres for one unit, 1, 2 or 5 times a power of ten, such that the longest is at
    most half the scene.
    """
    longest = float(np.linalg.norm(vector, axis=-1).max(initial=0.0))
    if longest == 0.0:
        return 1.0
    wanted = 0.9 * max(scene.radius, 1e-9) / longest
    power = 10.0 ** np.floor(np.log10(wanted))
    return float(
        power * max(s for s in (1.0, 2.0, 5.0) if s * power <= wanted * (1 + 1e-9))
    )


def _several(what: str) -> str:
    """A solid's word where there are several: boxes, meshes, spheres."""
    return f"{what}es" if what.endswith(("x", "sh")) else f"{what}s"


def _scale_in_words(arrows: PlacedArrows) -> str:
    if not arrows.unit:
        return f"unit vectors, drawn {arrows.scale:.3g} m long"
    # For one unit, or for a tenth, a hundredth ... where all arrows are far less than
    # one.
    longest = (
        float(np.linalg.norm(arrows.length, axis=-1).max(initial=0.0)) / arrows.scale
    )
    amount = (
        1.0 if longest == 0.0 or longest >= 0.5 else 10.0 ** np.floor(np.log10(longest))
    )
    return f"{amount * arrows.scale:.3g} m drawn for {amount:g} {arrows.unit}"


def _bounds(scene: Scene) -> tuple[Array, Array]:
    points = []
    if scene.solids:
        reach = np.array([s.reach for s in scene.solids])[:, None]
        points += [scene.position - reach, scene.position + reach]
    for a in scene.arrows:
        points += [a.origin, a.origin + a.length]
    if not points:
        raise failure("solids", "at least one body or arrow to show", "none")
    flat = np.concatenate([p.reshape(-1, 3) for p in points])
    low, high = flat.min(axis=0), flat.max(axis=0)
    if scene.ground is not None:
        low, high = (
            np.minimum(low, [np.inf, np.inf, scene.ground]),
            np.maximum(high, [-np.inf, -np.inf, scene.ground]),
        )
    return low, high
