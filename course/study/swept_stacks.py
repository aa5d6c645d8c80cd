"""Projected Gauss-Seidel through a stack of boxes, step by step, beside the forces that are right."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from course.arrays import Array
from course.scenes import stack


@dataclass(frozen=True, eq=False)
class SweptStack:
    """A stack's contacts, c of them from below, after each single step of the sweeps.

    Args:
        path: forces from 0 on, (k, c) [N].
        truth: each carries all that stands above it, (c,) [N].
        residual: of the contact conditions after each step, (k,).
        factor: by which a sweep shrinks the error in the end.
    """

    path: Array
    truth: Array
    residual: Array
    factor: float


def swept_stack(count: int, top: float, relaxation: float, sweeps: int) -> SweptStack:
    """Boxes of 1 kg, each on one point of that below, the topmost of ``top`` [kg]; swept from below."""
    from course.contact.solvers.projected_gauss_seidel import (
        gauss_seidel_path,
        predicted_gauss_seidel_factor,
    )
    from course.contact.solvers.residual import complementarity_residual

    mass = np.ones(count)
    mass[-1] = top
    scene = stack(count, mass=mass, corners=1)
    system = scene.system()
    matrix = system.A.toarray()
    path = gauss_seidel_path(matrix, system.b, sweeps, relaxation=relaxation)
    every = np.broadcast_to(matrix, (len(path), *matrix.shape))
    residual = complementarity_residual(
        every, path, np.broadcast_to(system.b, path.shape)
    )
    factor = predicted_gauss_seidel_factor(matrix, relaxation=relaxation)
    return SweptStack(path, np.asarray(scene.truth), residual, factor)
