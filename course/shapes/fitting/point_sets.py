"""What all fits share: checked sets of points, and one fit after another."""

from __future__ import annotations

from collections.abc import Callable

import numpy as np

from course.arrays import Array, ArrayLike, failure, vectors


def checked_sets(points: ArrayLike) -> Array:
    """Checked sets of points, (..., n, 3), n >= 1."""
    checked = vectors("points", points)
    if checked.ndim < 2 or checked.shape[-2] == 0:
        expected = "at least 1 point, shape (..., n, 3)"
        raise failure("points", expected, f"shape {checked.shape}")
    return checked


def each_set(
    points: Array, fit: Callable[[Array], tuple[Array, ...]], *shapes: tuple[int, ...]
) -> tuple[Array, ...]:
    """The results of a fit to every set of a batch, each result as one array.

    Args:
        points: (..., n, 3).
        fit: takes (n, 3) and gives arrays of these shapes.
        shapes: of the results, without the batch.
    """
    batch = points.shape[:-2]
    results = tuple(np.empty((*batch, *shape)) for shape in shapes)
    for index in np.ndindex(batch):
        for result, value in zip(results, fit(points[index]), strict=True):
            result[index] = value
    return results


def principal_axes(points: Array) -> Array:
    """The principal axes of sets of points as columns, the longest first, (..., 3, 3).

    Those of the covariance of the points, by SVD of the centred points; right-handed,
    each with its largest entry above 0, so that one set has one answer.

    Args:
        points: (..., n, 3).
    """
    centred = points - points.mean(axis=-2, keepdims=True)
    # Three more points in the middle: SVD then gives all three axes of one or two.
    none = np.zeros((*points.shape[:-2], 3, 3))
    even = np.concatenate([centred, none], axis=-2)
    rows = np.linalg.svd(even, full_matrices=False)[2]
    largest = np.take_along_axis(rows, np.abs(rows).argmax(axis=-1)[..., None], axis=-1)
    rows = rows * np.where(largest < 0, -1.0, 1.0)
    rows[..., 2, :] *= np.linalg.det(rows)[..., None].round()
    return np.asarray(np.swapaxes(rows, -1, -2))
