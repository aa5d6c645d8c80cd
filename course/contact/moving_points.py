"""How the material points and the normals of contacts move with their bodies (syllabus rows 20 and 22)."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from course.arrays import Array, BoolArray, IntArray, failure
from course.contact.curved import CurvedTerms, curved_terms
from course.dynamics.bodies import Bodies
from course.overlap.contact_arrays import Contacts

#: |e_A x e_B| / (|e_A| |e_B|) below which two edges count as parallel.
PARALLEL = 1e-9
#: How far the normal of two edges may point off their common perpendicular (the sine of the angle).
OFF_PERPENDICULAR = 1e-6


@dataclass(frozen=True)
class ContactMotion:
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


def contact_motion(bodies: Bodies, contacts: Contacts) -> ContactMotion:
    contacts.require_bodies(len(bodies))
    a, b = contacts.body_a, contacts.body_b
    point_a, point_b, curved = contacts.point_a, contacts.point_b, None
    rows = of_feature(contacts, "curved")
    if np.any(rows):
        curved = curved_terms(bodies, contacts, rows)
        point_a[rows] = point_b[rows] = curved.point
    arm_a, arm_b = point_a - bodies.position[a], point_b - bodies.position[b]
    v, omega = bodies.velocity, bodies.angular_velocity
    relative = v[a] - v[b] + np.cross(omega[a], arm_a) - np.cross(omega[b], arm_b)
    return ContactMotion(a, b, arm_a, arm_b, omega[a], omega[b], relative, curved)


def carried_normal_rate(motion: ContactMotion, contacts: Contacts) -> Array:
    """N_dot of the normals that a face or two edges carry; omega_B x N where curved."""
    omega = np.where(
        of_feature(contacts, "face_a")[:, None], motion.omega_a, motion.omega_b
    )
    rate = np.cross(omega, contacts.normal)
    edges = np.flatnonzero(of_feature(contacts, "edges"))
    if edges.size:
        rate[edges] = _edge_normal_rate(
            contacts[edges], motion.omega_a[edges], motion.omega_b[edges], edges
        )
    return rate


def of_feature(contacts: Contacts, feature: str) -> BoolArray:
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
