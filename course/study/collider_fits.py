"""How tight each kind of collider lies around a mesh, and what it takes to fit it."""

from __future__ import annotations

from collections.abc import Callable
from importlib import import_module
from importlib.util import find_spec
from typing import Any

import numpy as np

from course import rotations
from course.arrays import Array
from course.shapes import (
    Compound,
    Mesh,
    bounding_box,
    bounding_sphere,
    capsule_around,
    hull_around,
    k_dop,
    oriented_box,
    polytopes,
)
from course.shapes.mesh_makers import (
    box_mesh,
    dumbbell_mesh,
    icosphere_mesh,
    rod_mesh,
)
from course.study.precision import Method, Problem, WorkPrecision, work_precision

#: How the dumbbell is turned: about no axis of the world [rad].
TURN = (0.3, -0.5, 0.6)


def turned_dumbbell() -> Mesh:
    """Two balls of 10 cm on a bar of 3 cm, their centres 40 cm apart, turned in space."""
    q = rotations.from_rotation_vector(np.array(TURN))
    return dumbbell_mesh().moved(rotations.to_matrix(q), np.zeros(3))


#: A fit to a mesh by name; each returns a shape with a volume.
FITS: dict[str, Callable[[Mesh], Any]] = {
    "sphere": lambda mesh: bounding_sphere(mesh.vertices),
    "aabb": lambda mesh: bounding_box(mesh.vertices),
    "kdop14": lambda mesh: k_dop(mesh.vertices, 14),
    "kdop18": lambda mesh: k_dop(mesh.vertices, 18),
    "kdop26": lambda mesh: k_dop(mesh.vertices, 26),
    "obb": lambda mesh: oriented_box(mesh.vertices),
    "capsule": lambda mesh: capsule_around(mesh.vertices),
    "convex_hull": lambda mesh: hull_around(mesh.vertices),
}


def of_kinds(ball: Array, bar: Array, other: Array) -> Compound:
    """A compound around three parts: a sphere, a capsule and a sphere."""
    return Compound((bounding_sphere(ball), capsule_around(bar), bounding_sphere(other)))  # fmt: skip


def fitted_volumes(mesh: Mesh | None = None) -> dict[str, float]:
    """Volumes of the colliders in ``FITS``, and of a compound of three parts, over the mesh's own."""
    seen = turned_dumbbell() if mesh is None else mesh
    own = seen.volume()
    found = {name: float(fit(seen).volume()) / own for name, fit in FITS.items()}
    parts = [part.vertices for part in seen.parts()]
    if len(parts) == 3:
        found["compound"] = float(of_kinds(*parts).volume()) / own
    return found


def scene_meshes() -> dict[str, Mesh]:
    """Shapes that a scene is made of: lying along the axes, and turned in space."""
    turn = rotations.to_matrix(rotations.from_rotation_vector(np.array(TURN)))
    crate = box_mesh(np.array([-0.5, -0.4, -0.3]), np.array([0.5, 0.4, 0.3]))
    still = np.zeros(3)
    return {
        "a ball": icosphere_mesh(0.5),
        "a crate on the floor": crate,
        "a crate that tumbles": crate.moved(turn, still),
        "a rod that tumbles": rod_mesh().moved(turn, still),
        "a dumbbell that tumbles": turned_dumbbell(),
    }


def sphere_looks(points: Array) -> int:
    """How many looks the smallest sphere takes: n a round.

    The farthest point joins the few whose smallest sphere is known, until it is in it.
    Source: Badoiu, Clarkson, "Smaller core-sets for balls", SODA 2003.
    """
    few, rounds = points[:1], 0
    while True:
        ball, rounds = bounding_sphere(few), rounds + 1
        away = np.linalg.norm(points - ball.center, axis=-1)
        if away.max() <= ball.radius * (1 + 1e-9) + 1e-15:
            return rounds * len(points)
        few = np.concatenate([few, points[[away.argmax()]]])


def capsule_looks(points: Array) -> int:
    """How many looks the capsule along the longest principal axis takes.

    Three a point for the covariance, three for the places along its axes, and those of
    the smallest circle, seen along the longest one.
    """
    across = (points @ oriented_box(points).rotation)[:, 1:]
    return 6 * len(points) + sphere_looks(np.insert(across, 0, 0.0, axis=1))


def hull_looks(points: Array) -> int:
    """How many looks a hull takes at least: no point may stick out of any of its sides."""
    return len(points) * len(polytopes(hull_around(points)).normals)


def fit_costs(*, peers: bool = True) -> WorkPrecision:
    """Volume over the mesh's own, less 1, against the cost of the fit, for every kind.

    The counted unit is a look: the place of one point along one direction, or its
    distance from one place. What libraries count inside is not known: their count is 0.
    """
    mesh = turned_dumbbell()
    points, own = mesh.vertices, mesh.volume()
    ball, bar, other = (part.vertices for part in mesh.parts())
    n, looks = len(points), [sphere_looks(ball), capsule_looks(bar), sphere_looks(other)]  # fmt: skip
    problem = Problem(
        "A dumbbell turned in space",
        lambda shape: max(0.0, float(shape.volume()) / own - 1),
        "volume ratio less 1",
        "the volume of the mesh",
    )

    def method(name: str, fit: Callable[[Array], Any], count: int) -> Method:
        return Method(name, lambda _: (fit(points), count), (1,))

    methods = [
        method("sphere, Ritter's", lambda x: bounding_sphere(x, method="ritter"), 4 * n),
        method("sphere, smallest", bounding_sphere, sphere_looks(points)),
        method("AABB", bounding_box, 3 * n),
        Method("k-DOP, 14, 18, 26 sides", lambda k: (k_dop(points, int(k)), int(k) * n // 2), (14, 18, 26), "sides"),
        method("OBB, principal axes", oriented_box, 6 * n),
        method("capsule", capsule_around, capsule_looks(points)),
        method("convex hull", hull_around, hull_looks(points)),
        method("compound of three", lambda _: of_kinds(ball, bar, other), sum(looks)),
        *(_peers(points) if peers else ()),
    ]  # fmt: skip
    return work_precision(problem, methods, count_unit="looks at a point")


class Measured:
    """A volume alone, as other people's libraries give it."""

    def __init__(self, volume: float) -> None:
        self._volume = volume

    def volume(self) -> float:
        """[m^3]."""
        return self._volume


def _peers(points: Array) -> list[Method]:
    """trimesh and SciPy, where they are here."""
    from scipy.spatial import ConvexHull

    known = [Method("SciPy, hull", lambda _: (Measured(ConvexHull(points).volume), 0), (1,))]  # fmt: skip
    if find_spec("trimesh"):
        trimesh: Any = import_module("trimesh")
        import_module("trimesh.nsphere")

        def cloud() -> Any:
            return trimesh.PointCloud(points)

        def box(_: float) -> tuple[Measured, int]:
            _, extents = trimesh.bounds.oriented_bounds(points)
            return Measured(float(np.prod(extents))), 0

        def ball(_: float) -> tuple[Measured, int]:
            _, radius = trimesh.nsphere.minimum_nsphere(cloud())
            return Measured(4 / 3 * np.pi * float(radius) ** 3), 0

        known.append(Method("trimesh, OBB", box, (1,)))
        known.append(Method("trimesh, sphere", ball, (1,)))
    return known


# What goes deeper: Ritter's sphere against the smallest, and a box that crowds mislead.


def ritter_excess(count: int, *, points: int, seed: int) -> Array:
    """By how much Ritter's radius exceeds the smallest, less 1, for drawn clouds, (count,)."""
    clouds = np.random.default_rng(seed).normal(size=(count, points, 3))
    quick = bounding_sphere(clouds, method="ritter").radius
    return np.asarray(quick / bounding_sphere(clouds).radius - 1)


def sphere_steps(points: Array, steps: int) -> tuple[Array, float]:
    """A sphere whose centre goes toward the farthest point, less far each time: centre, radius.

    c' = c + (x - c)/(i + 1), x the farthest of the points from c.
    Source: Badoiu, Clarkson, "Smaller core-sets for balls", SODA 2003.
    """
    center = points[0]
    for i in range(1, steps + 1):
        away = np.linalg.norm(points - center, axis=-1)
        center = center + (points[away.argmax()] - center) / (i + 1)
    return center, float(np.linalg.norm(points - center, axis=-1).max())


def sphere_costs(
    clouds: int = 20, *, points: int = 200, seed: int = 2
) -> WorkPrecision:
    """How much a sphere's radius exceeds the smallest, less 1, on average over clouds, against looks."""
    drawn = np.random.default_rng(seed).normal(size=(clouds, points, 3))
    least = bounding_sphere(drawn).radius
    n = points

    def about(centers: Array) -> Array:
        return np.linalg.norm(drawn - centers[:, None], axis=-1).max(axis=-1)

    def middles() -> Array:
        return about(0.5 * (drawn.min(axis=1) + drawn.max(axis=1)))

    def stepped(k: float) -> tuple[list[float], int]:
        return [sphere_steps(cloud, int(k))[1] for cloud in drawn], n * (int(k) + 1)

    looks = int(np.mean([sphere_looks(cloud) for cloud in drawn]))
    problem = Problem(
        f"{clouds} clouds of {points} points",
        lambda radius: max(0.0, float(np.mean(np.asarray(radius) / least - 1))),
        "radius over the smallest, less 1",
        "the smallest sphere",
    )
    methods = [
        Method("about the mean", lambda _: (about(drawn.mean(axis=1)), 2 * n), (1,)),
        Method("about the box's middle", lambda _: (middles(), 4 * n), (1,)),
        Method("Ritter's", lambda _: (bounding_sphere(drawn, method="ritter").radius, 4 * n), (1,)),
        Method("k steps", stepped, (1, 3, 10, 30, 100, 300, 1000), "steps"),
        Method("smallest", lambda _: (bounding_sphere(drawn).radius, looks), (1,)),
    ]  # fmt: skip
    return work_precision(problem, methods, count_unit="looks at a point, a cloud")


#: Half the sides of a plate [m].
PLATE = np.array([0.6, 0.4, 0.02])


def crowded_plate(share: float, *, fine: int = 60) -> Array:
    """A plate's points, evenly spread, but for a share of them that lies along one diagonal, (n, 3) [m]."""
    even = np.linspace(-1.0, 1.0, fine)
    grid = np.stack(np.meshgrid(even, even, [-1.0, 1.0]), axis=-1).reshape(-1, 3)
    crowd = round(len(grid) * share / (1 - share))
    along = np.linspace(-1.0, 1.0, crowd)
    line = np.stack([along, along, np.zeros(crowd)], axis=-1)
    return np.asarray(np.concatenate([grid, line]) * PLATE)


def crowd_says(shares: Any) -> Array:
    """The principal box over the plate, from the covariance in closed form.

    C = (1/3) [[a^2, p a b], [p a b, b^2]]: the axis turns by tan(2 phi) = 2 p a b/(a^2 - b^2),
    and the box grows as an upright one around a plate turned by phi.
    """
    a, b = PLATE[:2]
    p = np.asarray(shares, dtype=float)
    phi = 0.5 * np.arctan2(2 * p * a * b, a**2 - b**2)
    c, s = np.cos(phi), np.sin(phi)
    return np.asarray((a * c + b * s) * (a * s + b * c) / (a * b))


def crowded_boxes(shares: Any) -> tuple[Array, Array, Array]:
    """Shares, and the volumes over the plate's of the box along the principal axes and of the one along a face."""
    p = np.asarray(shares, dtype=float)
    own = 8 * np.prod(PLATE)
    found = [
        [
            float(oriented_box(crowded_plate(share), method=method).volume()) / own
            for share in p
        ]
        for method in ("principal_axes", "face_directions")
    ]
    return p, np.array(found[0]), np.array(found[1])
