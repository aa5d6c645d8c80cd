"""Visual meshes: triangles that enclose what is seen, beside the colliders that stand for it.

A mesh is made in code (``mesh_makers``) or read from a student's file. It is refused, by
what is wrong with it, unless it encloses a volume.
"""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np

from course.arrays import (
    Array,
    ArrayLike,
    IntArray,
    failure,
    indices,
    instances,
    read_only,
    rotations,
    vectors,
    written,
)
from course.shapes.compound import Compound
from course.shapes.fitting import compound_around

#: The mesh files that are read.
ENDINGS = (".obj", ".stl")
#: A mesh with less volume than this, in cubes of its size, encloses none.
NO_VOLUME = 1e-12


@dataclass(frozen=True, eq=False)
class Mesh:
    """A closed surface of triangles, in one or more connected parts.

    Args:
        vertices: (n, 3) [m].
        triangles: (t, 3) rows of vertices, counterclockwise seen from outside.
    Raises:
        ValueError: NaN or infinity, no triangles, a triangle with a corner twice, an open
            surface (it says how many edges are open), neighbours that face opposite ways,
            a part that is inside out or has no volume.
    """

    vertices: Array
    triangles: IntArray

    def __post_init__(self) -> None:
        points = vectors("vertices", self.vertices)
        if points.ndim != 2:
            raise failure("vertices", "shape (n, 3)", f"shape {points.shape}")
        rows = indices("triangles", self.triangles, len(points))
        if rows.size == 0:
            raise failure("triangles", "at least one triangle", "none")
        if rows.ndim != 2 or rows.shape[1] != 3:
            raise failure("triangles", "shape (t, 3)", f"shape {rows.shape}")
        _require_closed(rows)
        object.__setattr__(self, "vertices", read_only(points))
        object.__setattr__(self, "triangles", read_only(rows))
        for i, part in enumerate(connected(rows)):
            _require_volume(points, rows[part], i)

    def volume(self) -> float:
        """What the parts enclose [m^3]: sum of a.(b x c)/6; overlaps count twice."""
        return signed_volume(self.vertices, self.triangles)

    def parts(self) -> tuple[Mesh, ...]:
        """The connected parts, each a mesh with its own vertices alone."""
        found = []
        for part in connected(self.triangles):
            used, number = np.unique(self.triangles[part], return_inverse=True)
            rows = number.reshape(-1, 3).astype(np.intp)
            found.append(Mesh(self.vertices[used], rows))
        return tuple(found)

    def moved(self, rotation: ArrayLike, translation: ArrayLike) -> Mesh:
        """The mesh turned about the origin, then shifted: x' = R x + t.

        Args:
            rotation: R, (3, 3).
            translation: t, (3,) [m].
        """
        turn, shift = (
            rotations("rotation", rotation),
            vectors("translation", translation),
        )
        for name, array, shape in (
            ("rotation", turn, (3, 3)),
            ("translation", shift, (3,)),
        ):
            if array.shape != shape:
                raise failure(name, f"shape {shape}", f"shape {array.shape}")
        return Mesh(self.vertices @ turn.T + shift, self.triangles)

    @staticmethod
    def joined(parts: Iterable[Mesh]) -> Mesh:
        """One mesh of several, each a part (or more) of its own."""
        given = instances("parts", parts, Mesh)
        first = np.cumsum([0, *(len(part.vertices) for part in given)])
        rows = [part.triangles + n for part, n in zip(given, first[:-1], strict=True)]
        points = [part.vertices for part in given]
        return Mesh(np.concatenate(points), np.concatenate(rows).astype(np.intp))


def mesh_colliders(mesh: Mesh, *, kind: str = "convex_hull") -> Compound:
    """One collider a connected part of a mesh; syllabus rows 1 and 7.

    Args:
        mesh: the visual.
        kind: of the colliders, as ``compound_around`` takes it.
    """
    parts = instances("mesh", [mesh], Mesh)[0].parts()
    return compound_around([part.vertices for part in parts], kind=kind)


def read_mesh(path: str | Path) -> Mesh:
    """The mesh in an OBJ or STL file, read by trimesh.

    Points that coincide are made one where the surface would else be open: parts that
    touch should stand in an OBJ file, each with points of its own.

    Args:
        path: of a file that ends in .obj or .stl.
    Raises:
        ValueError: no such file, another ending, a file that cannot be read, and all that
            ``Mesh`` refuses.
        ModuleNotFoundError: trimesh is not installed.
    """
    place = Path(path)
    if place.suffix.lower() not in ENDINGS:
        expected = f"a file that ends in {' or '.join(ENDINGS)}"
        raise failure("path", expected, written(str(path)))
    if not place.is_file():
        raise failure("path", "a file that exists", written(str(path)))
    loaded = _loaded(place)
    if len(loaded.faces) == 0:
        raise failure("path", "a file with triangles", f"none in {place.name}")
    try:
        return Mesh(loaded.vertices, loaded.faces)
    except ValueError:
        # Each triangle of an STL file has corners of its own, and so have the faces of
        # an OBJ file along a seam; where the surface is closed without, parts that
        # touch stay apart.
        if np.all(np.isfinite(loaded.vertices)):
            loaded.merge_vertices(merge_tex=True, merge_norm=True)
    try:
        return Mesh(loaded.vertices, loaded.faces)
    except ValueError as error:
        raise ValueError(f"{place.name}: {error}") from None


def _loaded(place: Path) -> Any:
    """What trimesh reads: vertices and faces, as they stand in the file."""
    try:
        import trimesh
    except ModuleNotFoundError:
        message = "read_mesh needs trimesh: install collision-course[meshes]"
        raise ModuleNotFoundError(message, name="trimesh") from None
    try:
        loaded: Any = trimesh.load(place, force="mesh", process=False)
        if not hasattr(loaded, "faces"):
            raise ValueError("no mesh in it")
    except Exception as error:  # whatever a parser raises on a broken file
        reason = str(error).splitlines()[0][:60] if str(error) else type(error).__name__
        expected = f"a readable {place.suffix[1:].upper()} file"
        raise failure("path", expected, f"{place.name} ({reason})") from None
    return loaded


def connected(triangles: IntArray) -> list[IntArray]:
    """The triangles of each connected part, parts in the order of their first triangle."""
    from scipy.sparse import coo_array
    from scipy.sparse.csgraph import connected_components

    count = int(triangles.max()) + 1
    ends = triangles, np.roll(triangles, -1, axis=1)
    places = ends[0].ravel(), ends[1].ravel()
    edges = coo_array((np.ones(triangles.size), places), shape=(count, count))
    _, part_of = connected_components(edges, directed=False)
    label = part_of[triangles[:, 0]]
    _, first = np.unique(label, return_index=True)
    return [np.flatnonzero(label == label[i]) for i in np.sort(first)]


def signed_volume(vertices: Array, triangles: IntArray) -> float:
    """What triangles enclose [m^3], below 0 where they face inward.

    V = 1/6 sum a.(b x c), seen from a point of the mesh (divergence theorem).
    """
    local = vertices - vertices[triangles[0, 0]]
    a, b, c = (local[triangles[:, i]] for i in range(3))
    return float(np.sum(a * np.cross(b, c))) / 6


def _require_closed(triangles: IntArray) -> None:
    """Refuse triangles that do not enclose: each edge must run once each way."""
    i, j, k = triangles.T
    twice = (i == j) | (j == k) | (k == i)
    if np.any(twice):
        got = f"{int(twice.sum())} with a corner twice"
        raise failure("triangles", "three different corners", got)
    count = int(triangles.max()) + 1
    start, end = np.concatenate([i, j, k]), np.concatenate([j, k, i])
    runs, back = start * count + end, end * count + start
    once, times = np.unique(np.minimum(runs, back), return_counts=True)
    if np.any(times == 1):
        got = f"{int(np.sum(times == 1))} open edges (a hole?)"
        raise failure("triangles", "a closed surface", got)
    if np.any(times > 2):
        got = f"{int(np.sum(times > 2))} edges that more than two triangles share"
        raise failure("triangles", "a surface that encloses a solid", got)
    same_way = once.size - np.sum(np.unique(runs, return_counts=True)[1] == 1) // 2
    if same_way:
        got = f"{int(same_way)} edges whose two triangles face opposite ways"
        raise failure("triangles", "triangles that all face outward", got)


def _require_volume(vertices: Array, triangles: IntArray, part: int) -> None:
    """Refuse a part that is inside out or flat."""
    volume = signed_volume(vertices, triangles)
    size = float(np.ptp(vertices[np.unique(triangles)], axis=0).max())
    if abs(volume) <= NO_VOLUME * size**3:
        raise failure("triangles", "parts with a volume", f"part {part} that is flat")
    if volume < 0:
        got = f"part {part} inside out, volume {written(volume)}"
        raise failure("triangles", "counterclockwise rows seen from outside", got)
