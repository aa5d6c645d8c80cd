"""Other people's libraries, asked the same questions where they are installed: python-fcl and coal."""

from __future__ import annotations

from collections.abc import Callable
from importlib.util import find_spec

import numpy as np

from course.arrays import Array, BoolArray


def installed_engines() -> dict[str, Callable[..., BoolArray]]:
    """The libraries that are here, by name; each is asked one pair at a time."""
    known = {"python-fcl": ("fcl", by_fcl), "coal": ("coal", by_coal)}
    return {name: asked for name, (module, asked) in known.items() if find_spec(module)}


def by_fcl(*boxes: Array) -> BoolArray:
    """Verdicts (p,) of python-fcl's ``collide``; arguments of ``oriented_boxes_overlap``."""
    import fcl

    request, objects = fcl.CollisionRequest(), []
    for center, rotation, e in (boxes[:3], boxes[3:]):
        objects.append([
            fcl.CollisionObject(fcl.Box(*(2 * s)), fcl.Transform(r, c))
            for c, r, s in zip(center, rotation, e, strict=True)
        ])  # fmt: skip
    return np.array(
        [
            fcl.collide(a, b, request, fcl.CollisionResult()) > 0
            for a, b in zip(*objects, strict=True)
        ]
    )


def by_coal(*boxes: Array) -> BoolArray:
    """Verdicts (p,) of coal's ``collide``; arguments of ``oriented_boxes_overlap``."""
    import coal

    request, found = coal.CollisionRequest(), []
    for c_a, r_a, e_a, c_b, r_b, e_b in zip(*boxes, strict=True):
        result = coal.CollisionResult()
        coal.collide(
            coal.Box(*(2 * e_a)), coal.Transform3s(r_a, c_a),
            coal.Box(*(2 * e_b)), coal.Transform3s(r_b, c_b), request, result,
        )  # fmt: skip
        found.append(result.isCollision())
    return np.array(found)


def installed_sphere_engines() -> dict[str, Callable[..., BoolArray]]:
    """The libraries that are here, by name; each is asked one pair at a time."""
    known = {
        "python-fcl": ("fcl", spheres_by_fcl),
        "coal": ("coal", spheres_by_coal),
    }
    return {name: asked for name, (module, asked) in known.items() if find_spec(module)}


def spheres_by_fcl(
    center_a: Array, radius_a: Array, center_b: Array, radius_b: Array
) -> BoolArray:
    """Verdicts (p,) of python-fcl's ``collide``; arguments of ``spheres_overlap``."""
    import fcl

    request, turn, said = fcl.CollisionRequest(), np.eye(3), []
    for x_a, r_a, x_b, r_b in zip(center_a, radius_a, center_b, radius_b, strict=True):
        a = fcl.CollisionObject(fcl.Sphere(r_a), fcl.Transform(turn, x_a))
        b = fcl.CollisionObject(fcl.Sphere(r_b), fcl.Transform(turn, x_b))
        said.append(fcl.collide(a, b, request, fcl.CollisionResult()) > 0)
    return np.array(said)


def spheres_by_coal(
    center_a: Array, radius_a: Array, center_b: Array, radius_b: Array
) -> BoolArray:
    """Verdicts (p,) of coal's ``collide``; arguments of ``spheres_overlap``."""
    import coal

    request, turn, said = coal.CollisionRequest(), np.eye(3), []
    for x_a, r_a, x_b, r_b in zip(center_a, radius_a, center_b, radius_b, strict=True):
        result = coal.CollisionResult()
        coal.collide(
            coal.Sphere(r_a), coal.Transform3s(turn, x_a),
            coal.Sphere(r_b), coal.Transform3s(turn, x_b), request, result,
        )  # fmt: skip
        said.append(result.isCollision())
    return np.array(said)


# Moving balls: arguments of ``swept_spheres_time``, one pair at a time.


def swept_engines() -> dict[str, Callable[..., BoolArray]]:
    """Ways of the libraries that are here to ask whether balls meet.

    coal has no motion to ask about: its gaps are asked in a loop that advances.
    """
    known = {
        "python-fcl, 100 looks": ("fcl", lambda *balls: _moved_by_fcl(*balls, naive=True)),
        "python-fcl, advancement": ("fcl", lambda *balls: _moved_by_fcl(*balls, naive=False)),
        "coal, advanced by its gaps": ("coal", _advanced_by_coal),
    }  # fmt: skip
    return {name: asked for name, (module, asked) in known.items() if find_spec(module)}


def _moved_by_fcl(*balls: Array | float, naive: bool) -> BoolArray:
    """Verdicts (n,) of ``continuousCollide`` for balls that do not turn."""
    import fcl

    solver = fcl.CCDSolverType
    request = fcl.ContinuousCollisionRequest(
        num_max_iterations=100,
        ccd_motion_type=fcl.CCDMotionType.CCDM_TRANS,
        ccd_solver_type=solver.CCDC_NAIVE if naive else solver.CCDC_CONSERVATIVE_ADVANCEMENT,
    )  # fmt: skip
    step, unturned, said = balls[6], np.eye(3), []
    for x, r, v, y, s, w in zip(*(np.asarray(b) for b in balls[:6]), strict=True):
        result = fcl.ContinuousCollisionResult()
        fcl.continuousCollide(
            fcl.CollisionObject(fcl.Sphere(r), fcl.Transform(unturned, x)), fcl.Transform(unturned, x + step * v),
            fcl.CollisionObject(fcl.Sphere(s), fcl.Transform(unturned, y)), fcl.Transform(unturned, y + step * w),
            request, result,
        )  # fmt: skip
        said.append(result.is_collide)
    return np.array(said)


def _advanced_by_coal(*balls: Array | float, tolerance: float = 1e-6) -> BoolArray:
    """Verdicts (n,) by conservative advancement over coal's gap of two balls.

    t' = t + d(t)/|v_A - v_B|, until d <= tolerance

    No gap closes faster, so that no impact is passed; for balls that do not turn.
    """
    import coal

    step, request, unturned, said = balls[6], coal.DistanceRequest(), np.eye(3), []
    for x, r, v, y, s, w in zip(*(np.asarray(b) for b in balls[:6]), strict=True):
        a, b, t = coal.Sphere(r), coal.Sphere(s), 0.0
        gap, fastest = np.inf, max(float(np.linalg.norm(v - w)), 1e-300)
        while t <= step and gap > tolerance:
            gap = coal.distance(
                a, coal.Transform3s(unturned, x + t * v),
                b, coal.Transform3s(unturned, y + t * w), request, coal.DistanceResult(),
            )  # fmt: skip
            t += gap / fastest if gap > tolerance else 0.0
        said.append(gap <= tolerance)
    return np.array(said)
