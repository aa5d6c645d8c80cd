"""The separation d of two bodies at a contact, its rate and its acceleration (syllabus rows 19, 20, 22, 23)."""

from __future__ import annotations

import numpy as np

from course import formulas
from course.arrays import (
    Array,
    ArrayLike,
    BoolArray,
    broadcast,
    non_negative,
    scalar,
    unit_vectors,
    vectors,
)
from course.contact.gap_terms import signed_terms
from course.contact.moving_points import (
    carried_normal_rate,
    contact_motion,
    of_feature,
)
from course.dynamics.bodies import Bodies
from course.dynamics.impulses_at_points import normal_velocity
from course.overlap.contact_arrays import Contacts


def separation(point_a: ArrayLike, point_b: ArrayLike, normal: ArrayLike) -> Array:
    """How far two points are apart along the normal.

    d = (p_A - p_B) . N (syllabus row 19): d > 0 apart, d = 0 touching, d < 0
    penetrating. Whether the bodies approach or part is the sign of d_dot;
    the slide's "d > 0 moving, d = 0 stay" mixes the two (misprint 5).

    Args:
        point_a, point_b: p_A on body A and p_B on body B, (..., 3) [m].
        normal: N, unit, out of B toward A, (..., 3).
    Returns:
        d, (...) [m].
    Raises:
        ValueError: a wrong shape, NaN or infinity, a normal that is not of unit length.
    Example:
        >>> float(separation([0.0, 0.0, 1.5], [0.0, 0.0, 1.0], [0.0, 0.0, 1.0]))
        0.5
    """
    p_a, p_b = vectors("point_a", point_a), vectors("point_b", point_b)
    n = unit_vectors("normal", normal)
    broadcast(point_a=(p_a, 1), point_b=(p_b, 1), normal=(n, 1))
    return formulas.separation(p_a, p_b, n)


def separation_rate(bodies: Bodies, contacts: Contacts) -> Array:
    """How fast the separation of each contact changes.

    d_dot = N . (p_A_dot - p_B_dot) + N_dot . (p_A - p_B) with
    p_dot = v + omega x r (syllabus rows 20 and 22). The second term is zero
    at every contact: p_A - p_B = d N, and N_dot is at right angles to N.

    Args:
        bodies: n bodies.
        contacts: c contacts between them.
    Returns:
        d_dot, (c,) [m/s]; below 0 the bodies approach, above 0 they part.
    Raises:
        ValueError: a contact with a body that is not there.
    """
    return normal_velocity(bodies, contacts)


def normal_rate(bodies: Bodies, contacts: Contacts) -> Array:
    """How the normal of each contact turns.

    A face carries its normal with it: N_dot = omega_B x N for a face of B,
    omega_A x N for a face of A (syllabus row 20). Two edges: N is along
    u = e_A x e_B, with u_dot = (omega_A x e_A) x e_B + e_A x (omega_B x e_B),
    so N_dot is the part of +-u_dot/|u| at right angles to N. Curved surfaces:
    see ``course.contact.curved``, where the contact also moves over them.

    Args:
        bodies: n bodies.
        contacts: c contacts between them.
    Returns:
        N_dot, (c, 3) [1/s].
    Raises:
        ValueError: a contact with a body that is not there; two edges that are
            parallel or whose normal is not their common perpendicular; curved
            surfaces that touch along a line which is about to tip.
    """
    motion = contact_motion(bodies, contacts)
    rate = carried_normal_rate(motion, contacts)
    if motion.curved is not None:
        rate[of_feature(contacts, "curved")] = motion.curved.normal_rate
    return rate


def separation_acceleration(
    bodies: Bodies, contacts: Contacts, force: ArrayLike, torque: ArrayLike
) -> Array:
    """How the rate of the separation of each contact changes under forces that are known.

    d_ddot = (p_A - p_B).N_ddot + 2 (p_A_dot - p_B_dot).N_dot + (p_A_ddot - p_B_ddot).N
    (syllabus row 20; the repeats of the slide swap its terms, misprint 7),
    with p_ddot = v_dot + omega_dot x r + omega x (omega x r) and
    omega_dot = I^-1 (torque + L x omega) (row 23, misprint 9). As p_A - p_B =
    d N, the first term is -d |N_dot|^2, zero where the bodies touch.

    Two curved surfaces touch at other material points a moment later, so
    their curvature enters (misprint 8): d_ddot = N.(p_A_ddot - p_B_ddot) +
    2 (p_A_dot - p_B_dot).(omega_B x N) + the terms of
    ``course.contact.curved``.

    Args:
        bodies: n bodies.
        contacts: c contacts between them.
        force, torque: on each body, (n, 3), world axes, the torque about the
            centre of mass [N, N m]. A fixed body does not feel them.
    Returns:
        d_ddot, (c,) [m/s^2]. It is b of the contact system where force and
        torque are the external ones.
    Raises:
        ValueError: as ``normal_rate``, or force and torque of another shape.
    """
    terms = separation_acceleration_terms(bodies, contacts, force, torque)
    return sum(terms.values(), np.zeros(len(contacts)))


def separation_acceleration_terms(
    bodies: Bodies, contacts: Contacts, force: ArrayLike, torque: ArrayLike
) -> dict[str, Array]:
    """The terms whose sum is d_ddot, each (c,) [m/s^2] (syllabus rows 20, 23 and 24).

    Args:
        bodies, contacts, force, torque: as in ``separation_acceleration``.
    Returns:
        "force"        N.(F_A/m_A - F_B/m_B)
        "torque"       N.((I_A^-1 tau_A) x r_A - (I_B^-1 tau_B) x r_B)
        "gyroscopic"   N.((I_A^-1 (L_A x omega_A)) x r_A - (I_B^-1 (L_B x omega_B)) x r_B)
        "centripetal"  N.(omega_A x (omega_A x r_A) - omega_B x (omega_B x r_B))
        "normal"       2 (p_A_dot - p_B_dot).N_dot, where curved with omega_B x N for N_dot
        "curvature"    zero where nothing is curved
        "gap"          (p_A - p_B).N_ddot = -d |N_dot|^2, zero where curved (it is in the curvature)
    """
    return {
        name: value
        for name, (value, _) in signed_terms(bodies, contacts, force, torque).items()
    }


def resting(
    bodies: Bodies, contacts: Contacts, *, rate_tolerance: float = 1e-6
) -> BoolArray:
    """Which contacts neither approach nor part: |d_dot| <= rate_tolerance (syllabus row 20).

    A contact that approaches is a collision and has to be resolved first; one
    that parts takes no force. Whether it touches (d = 0) is not asked.

    Args:
        bodies: n bodies.
        contacts: c contacts between them.
        rate_tolerance: [m/s], at or above 0.
    Returns:
        Mask (c,), to be used as ``contacts[resting(bodies, contacts)]``.
    Raises:
        ValueError: a negative tolerance, a contact with a body that is not there.
    """
    tolerance = scalar("rate_tolerance", non_negative("rate_tolerance", rate_tolerance))
    return np.abs(separation_rate(bodies, contacts)) <= tolerance
