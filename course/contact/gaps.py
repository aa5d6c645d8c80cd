"""The separation d of two bodies at a contact, its rate and its acceleration (syllabus rows 19, 20, 22, 23)."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from course import formulas
from course.arrays import (
    Array,
    ArrayLike,
    BoolArray,
    IntArray,
    broadcast,
    failure,
    non_negative,
    scalar,
    shaped,
    unit_vectors,
    vectors,
)
from course.contact.curved import CurvedTerms, curved_terms
from course.dynamics.bodies import Bodies
from course.dynamics.contact_points import require_body_indices
from course.dynamics.impulse import normal_velocity
from course.overlap.contact_arrays import Contacts

#: |e_A x e_B| / (|e_A| |e_B|) below which two edges count as parallel.
PARALLEL = 1e-9
#: How far the normal of two edges may point off their common perpendicular (the sine of the angle).
OFF_PERPENDICULAR = 1e-6


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
    motion = _motion(bodies, contacts)
    rate = _carried_normal_rate(motion, contacts)
    if motion.curved is not None:
        rate[_which(contacts, "curved")] = motion.curved.normal_rate
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


@dataclass(frozen=True)
class _Motion:
    """Which bodies meet at each contact, and how their material points p_A and p_B move there.

    ``relative`` is p_A_dot - p_B_dot; where curved, p_A and p_B are the common
    point of ``CurvedTerms``.
    """

    a: IntArray
    b: IntArray
    arm_a: Array
    arm_b: Array
    omega_a: Array
    omega_b: Array
    relative: Array
    curved: CurvedTerms | None


def _motion(bodies: Bodies, contacts: Contacts) -> _Motion:
    require_body_indices(contacts, bodies)
    a, b = contacts.body_a, contacts.body_b
    point_a, point_b, curved = contacts.point_a, contacts.point_b, None
    rows = _which(contacts, "curved")
    if np.any(rows):
        curved = curved_terms(bodies, contacts, rows)
        point_a[rows] = point_b[rows] = curved.point
    arm_a, arm_b = point_a - bodies.position[a], point_b - bodies.position[b]
    v, omega = bodies.velocity, bodies.angular_velocity
    relative = v[a] - v[b] + np.cross(omega[a], arm_a) - np.cross(omega[b], arm_b)
    return _Motion(a, b, arm_a, arm_b, omega[a], omega[b], relative, curved)


def _carried_normal_rate(motion: _Motion, contacts: Contacts) -> Array:
    """N_dot of the normals that a face or two edges carry; omega_B x N where curved."""
    omega = np.where(
        _which(contacts, "face_a")[:, None], motion.omega_a, motion.omega_b
    )
    rate = np.cross(omega, contacts.normal)
    edges = np.flatnonzero(_which(contacts, "edges"))
    if edges.size:
        rate[edges] = _edge_normal_rate(
            contacts[edges], motion.omega_a[edges], motion.omega_b[edges], edges
        )
    return rate


def _which(contacts: Contacts, feature: str) -> BoolArray:
    """The mask of one feature."""
    return np.asarray(np.asarray(contacts.feature) == feature)


def _edge_normal_rate(
    contacts: Contacts, omega_a: Array, omega_b: Array, rows: IntArray
) -> Array:
    assert (
        contacts.edge_a is not None and contacts.edge_b is not None
    )  # Contacts has checked it
    n = contacts.normal
    e_a = contacts.edge_a / np.linalg.norm(contacts.edge_a, axis=1, keepdims=True)
    e_b = contacts.edge_b / np.linalg.norm(contacts.edge_b, axis=1, keepdims=True)
    u = np.cross(e_a, e_b)
    length = np.linalg.norm(u, axis=1)
    if np.any(length <= PARALLEL):
        i = int(np.argmin(length))
        raise failure("contacts.edge_a", "an edge that crosses edge_b", f"parallel edges, sine {length[i]:.1e}",
                      (rows[i],))  # fmt: skip
    off = np.linalg.norm(np.cross(n, u), axis=1) / length
    if np.any(off > OFF_PERPENDICULAR):
        i = int(np.argmax(off))
        raise failure("contacts.normal", "the common perpendicular of edge_a and edge_b",
                      f"{n[i]}, off by {off[i]:.1e} rad", (rows[i],))  # fmt: skip
    u_dot = np.cross(np.cross(omega_a, e_a), e_b) + np.cross(
        e_a, np.cross(omega_b, e_b)
    )
    turned = u_dot * (np.sign(np.sum(u * n, axis=1)) / length)[:, None]
    return turned - np.sum(turned * n, axis=1, keepdims=True) * n


def signed_terms(
    bodies: Bodies, contacts: Contacts, force: ArrayLike, torque: ArrayLike
) -> dict[str, tuple[Array, Array]]:
    """The terms of ``separation_acceleration_terms``, each with the sum of the magnitudes it was added up from.

    A sum whose value is some 1e-16 of those magnitudes is rounding noise.
    """
    f, tau = vectors("force", force), vectors("torque", torque)
    shaped("force", f, (len(bodies), 3))
    shaped("torque", tau, (len(bodies), 3))
    motion, n = _motion(bodies, contacts), contacts.normal
    inverse, omega, momentum = (
        bodies.world_inverse_inertia,
        bodies.angular_velocity,
        bodies.angular_momentum,
    )
    tau = np.where(bodies.fixed[:, None], 0.0, tau)
    gyroscopic = np.cross(momentum, omega)  # L x omega
    gyroscopic_size = _cross_size(momentum, omega)
    terms = {
        name: np.zeros((2, len(contacts)))
        for name in ("force", "torque", "gyroscopic", "centripetal")
    }
    for body, arm, sign in (
        (motion.a, motion.arm_a, 1.0),
        (motion.b, motion.arm_b, -1.0),
    ):
        lever = np.cross(arm, n)  # N.(alpha x r) = alpha.(r x N)
        lever_size = _cross_size(arm, n)
        acceleration = (f * bodies.inverse_mass[:, None])[body]
        terms["force"] += _dot(sign * n, acceleration, np.abs(n), np.abs(acceleration))
        for name, moment, moment_size in (
            ("torque", tau, np.abs(tau)), ("gyroscopic", gyroscopic, gyroscopic_size)
        ):  # fmt: skip
            alpha = np.einsum("nij,nj->ni", inverse, moment)[body]
            alpha_size = np.einsum("nij,nj->ni", np.abs(inverse), moment_size)[body]
            terms[name] += _dot(sign * alpha, lever, alpha_size, lever_size)
        w = omega[body]
        inward = np.cross(w, np.cross(w, arm))
        terms["centripetal"] += _dot(
            sign * n, inward, np.abs(n), _cross_size(w, _cross_size(w, arm))
        )
    result = {name: (value[0], value[1]) for name, value in terms.items()}
    return result | _turning_terms(motion, contacts)


def _turning_terms(
    motion: _Motion, contacts: Contacts
) -> dict[str, tuple[Array, Array]]:
    """The terms that come from the normal's turning: "normal", "curvature", "gap"."""
    n_dot = _carried_normal_rate(motion, contacts)
    curved, curvature = _which(contacts, "curved"), np.zeros((2, len(contacts)))
    if motion.curved is not None:
        curvature[:, curved] = motion.curved.curvature, motion.curved.curvature_size
    normal = 2 * _dot(motion.relative, n_dot, np.abs(motion.relative), np.abs(n_dot))
    gap = np.where(curved, 0.0, -contacts.separation * np.sum(n_dot**2, axis=1))
    return {
        "normal": (normal[0], normal[1]),
        "curvature": (curvature[0], curvature[1]),
        "gap": (gap, np.abs(gap)),
    }


def _dot(x: Array, y: Array, x_size: Array, y_size: Array) -> Array:
    """Rows (2, c): the scalar products, and the sums of the magnitudes of what they were added up from."""
    return np.stack([np.sum(x * y, axis=1), np.sum(x_size * y_size, axis=1)])


def _cross_size(x: Array, y: Array) -> Array:
    """The magnitudes that each component of x cross y was added up from."""
    x, y = np.abs(x), np.abs(y)
    return x[:, [1, 2, 0]] * y[:, [2, 0, 1]] + x[:, [2, 0, 1]] * y[:, [1, 2, 0]]
