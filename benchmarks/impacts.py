"""Time of impact: 10,000 pairs of moving boxes against a loop over python-fcl's continuous test."""

from __future__ import annotations

import math
from typing import Any

import numpy as np
from scipy.spatial.transform import Rotation

from benchmarks.measure import Row, ratio
from course.arrays import Array
from course.overlap import time_of_impact
from course.shapes import OBB

COUNT, SAMPLE = 10_000, 1_000
NAME = f"{COUNT} pairs of boxes in straight motion: loop of python-fcl / one batch"


def rows() -> list[Row]:
    """The rows of this module."""
    a, b, velocity = moving_boxes(COUNT)
    try:
        import fcl
    except ImportError:
        return [Row(NAME, math.nan, 5.0, "python-fcl is not installed")]
    some = slice(SAMPLE)
    theirs = FclLoop(fcl, a[some], b[some], velocity[some])
    still = np.zeros(3)
    found, theirs_took, ours_took = ratio(
        theirs, lambda: time_of_impact(a, b, velocity, still, horizon=1.0)
    )
    each = theirs_took / SAMPLE, ours_took / COUNT
    remark = f"{1e6 * each[0]:.1f} us each against {1e6 * each[1]:.2f}"
    return [Row(NAME, found * COUNT / SAMPLE, 5.0, remark)]


def moving_boxes(count: int, seed: int = 0) -> tuple[OBB, OBB, Array]:
    """Boxes of about 1 m, 7 m apart, of which most meet within a second."""
    rng = np.random.default_rng(seed)
    a, b = (
        OBB(
            rng.normal(0, 4, (count, 3)),
            Rotation.from_quat(rng.normal(size=(count, 4))).as_matrix(),
            rng.uniform(0.2, 1.5, (count, 3)),
        )
        for _ in range(2)
    )
    return a, b, 0.9 * (b.center - a.center) + rng.normal(0, 0.3, (count, 3))


class FclLoop:
    """One call of python-fcl for each pair; its objects are made ahead."""

    def __init__(self, fcl: Any, a: OBB, b: OBB, velocity: Array) -> None:
        self.fcl, self.pairs = fcl, []
        for i in range(len(velocity)):
            pair: list[Any] = []
            for box, way in (a[i], velocity[i]), (b[i], np.zeros(3)):
                solid = fcl.Box(*(2 * box.half_extents))
                start = fcl.Transform(box.rotation, box.center)
                end = fcl.Transform(box.rotation, box.center + way)
                pair += [fcl.CollisionObject(solid, start), end]
            self.pairs.append(pair)
        self.request = fcl.ContinuousCollisionRequest(
            ccd_motion_type=fcl.CCDMotionType.CCDM_TRANS,
            ccd_solver_type=fcl.CCDSolverType.CCDC_CONSERVATIVE_ADVANCEMENT,
        )

    def __call__(self) -> None:
        for one, end, other, last in self.pairs:
            result = self.fcl.ContinuousCollisionResult()
            self.fcl.continuousCollide(one, end, other, last, self.request, result)
