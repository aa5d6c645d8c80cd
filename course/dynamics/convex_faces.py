"""Faces that enclose a solid: those of a convex hull, or given ones."""

from __future__ import annotations

import numpy as np

from course.arrays import Array, ArrayLike, IntArray, failure, indices

#: A hull whose thickness is below this fraction of its width is called flat: its volume
#: would be rounding.
FLATNESS = 1e-12


def require_solid(centred: Array) -> None:
    """Refuse points (..., k, 3) that span no volume; their mean is at 0."""
    widths = np.linalg.svd(centred, compute_uv=False)
    flat = widths[..., 2] <= FLATNESS * widths[..., 0]
    if np.any(flat):
        index = tuple(np.argwhere(flat)[0])
        thin, wide = widths[index][2], widths[index][0]
        what = f"flat ones (thickness to width {thin / wide if wide else 0.0:.1g})"
        raise failure("vertices", "points that span a volume", what, index)


def hull_faces(points: Array) -> IntArray:
    """The faces of one convex hull, each counterclockwise seen from outside."""
    from scipy.spatial import ConvexHull, QhullError

    if points.ndim != 2:
        raise failure(
            "vertices",
            "shape (k, 3) where no triangles are given",
            f"shape {points.shape}",
        )
    # A hull's faces are the same when its points are stretched, but Qhull's tolerances
    # are not: the widths are made equal first.
    centred = points - points.mean(axis=0)
    _, widths, axes = np.linalg.svd(centred, full_matrices=False)
    axes[2] *= np.sign(np.linalg.det(axes))
    even = centred @ axes.T / widths
    try:
        hull = ConvexHull(even)
    except QhullError as error:
        reason = str(error).splitlines()[0][:60]
        raise failure(
            "vertices", "points that span a volume", f"flat ones ({reason})"
        ) from None
    faces = hull.simplices.astype(np.intp)
    a, b, c = (even[faces[:, i]] for i in range(3))
    inward = np.sum(np.cross(b - a, c - a) * hull.equations[:, :3], axis=1) < 0
    faces[inward] = faces[inward][:, ::-1]
    return faces


def closed_faces(triangles: ArrayLike, count: int) -> IntArray:
    """The triangles given, (t, 3) indices below count, if they enclose a solid."""
    faces = indices("triangles", triangles, count)
    if faces.ndim != 2 or faces.shape[1] != 3:
        raise failure("triangles", "shape (t, 3)", f"shape {faces.shape}")
    edges = np.concatenate([faces[:, [0, 1]], faces[:, [1, 2]], faces[:, [2, 0]]])
    forward, backward = (
        edges[:, 0] * count + edges[:, 1],
        edges[:, 1] * count + edges[:, 0],
    )
    unique, times = np.unique(forward, return_counts=True)
    lonely = ~np.isin(backward, forward) | (times[np.searchsorted(unique, forward)] > 1)
    if np.any(lonely):
        start, end = (int(i) for i in edges[int(np.argmax(lonely))])
        expected = "a closed surface, each edge once in each direction"
        raise failure(
            "triangles", expected, f"edge {start}-{end} without its match (a hole?)"
        )
    return faces
