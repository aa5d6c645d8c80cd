"""Contacts of curved surfaces: how the point of contact moves over both, and what that adds to d_ddot.

A surface turns its outward normal by K x when one moves by x over it: K is
its curvature tensor in the tangent plane (I/R on a sphere, 1/r across the
axis of a capsule and 0 along it, 0 on a face, large at a vertex). Let s be
the tangential part of p_A_dot - p_B_dot (material points), u =
(omega_A - omega_B) x N, K = K_A + K_B. The normals stay opposite, so the
contact moves over B with K^-1 (u + K_A s), and

    N_dot = omega_B x N + K_B K^-1 (u + K_A s)
    d_ddot = N.(p_A_ddot - p_B_ddot) + 2 (p_A_dot - p_B_dot).(omega_B x N)
             + s'K_A s + 2 u.s - (u + K_A s)' K^-1 (u + K_A s)

(the kinematics of rolling and sliding contact: D. J. Montana, "The kinematics
of contact and grasp", International Journal of Robotics Research 7(3), 1988).
The second line is computed as s'K_A K^-1 K_B s + 2 u'K^-1 K_B s - u'K^-1 u,
which is the same without the cancellation at a vertex, where K_A is large.

Surfaces at a distance d touch once one of them is moved outward by d, which
changes its curvature to K (1 + d K)^-1 and d_ddot not at all: so the formula
holds for d other than 0 as well. The flatter one is moved, as a vertex inside
its opponent could not be moved inward.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from course.arrays import Array, BoolArray, IntArray, failure, written
from course.dynamics.bodies import Bodies
from course.overlap.contact_arrays import Contacts

#: Curvature below this times the largest counts as flat.
FLAT = 1e-14
#: Turning below this times the bodies' angular speeds counts as none.
STILL = 1e-9


@dataclass(frozen=True)
class CurvedTerms:
    """What the curvature of k contacts adds.

    Args:
        normal_rate: N_dot, (k, 3) [1/s].
        point: where the surfaces touch once the flatter one is moved, (k, 3) [m].
        curvature: the terms of d_ddot beyond the material ones, (k,) [m/s^2].
        curvature_size: sum of the magnitudes these were added up from, (k,).
    """

    normal_rate: Array
    point: Array
    curvature: Array
    curvature_size: Array


def curved_terms(bodies: Bodies, contacts: Contacts, which: BoolArray) -> CurvedTerms:
    """The terms of the contacts that the mask picks; their bodies have been checked.

    Raises:
        ValueError: surfaces that touch along a line (parallel capsules, a capsule
            lying on a face) while one tips against the other; a hollow that is
            curved more than the body in it; a penetration as deep as the radius.
    """
    rows = np.flatnonzero(which)
    picked = contacts[rows]
    tangent = tangents(picked.normal)
    k_a, k_b, point = _touching(picked, tangent, rows)
    a, b = picked.body_a, picked.body_b
    v, omega = bodies.velocity, bodies.angular_velocity
    relative = (
        v[a]
        - v[b]
        + np.cross(omega[a], point - bodies.position[a])
        - np.cross(omega[b], point - bodies.position[b])
    )
    s = np.einsum("kti,ki->kt", tangent, relative)
    u = np.einsum("kti,ki->kt", tangent, np.cross(omega[a] - omega[b], picked.normal))
    speed = np.linalg.norm(omega[a], axis=1) + np.linalg.norm(omega[b], axis=1)
    inverse = _inverse(
        k_a + k_b, np.abs(k_a).max((1, 2)) + np.abs(k_b).max((1, 2)), u, speed, rows
    )
    follow = inverse @ k_b  # K^-1 K_B
    both = k_a @ follow  # K_A K^-1 K_B
    parts = [_form(s, both, s), 2 * _form(u, follow, s), -_form(u, inverse, u)]
    turning = _apply(np.swapaxes(follow, 1, 2), u) + _apply(np.swapaxes(both, 1, 2), s)
    return CurvedTerms(
        normal_rate=np.cross(omega[b], picked.normal)
        + np.einsum("kti,kt->ki", tangent, turning),
        point=point,
        curvature=parts[0] + parts[1] + parts[2],
        curvature_size=np.abs(parts[0]) + np.abs(parts[1]) + np.abs(parts[2]),
    )


def tangents(normal: Array) -> Array:
    """Two unit vectors at right angles to each normal and to each other, (k, 2, 3)."""
    axis = np.eye(3)[np.argmin(np.abs(normal), axis=1)]
    first = np.cross(normal, axis)
    first /= np.linalg.norm(first, axis=1, keepdims=True)
    return np.stack([first, np.cross(normal, first)], axis=1)


def _touching(
    contacts: Contacts, tangent: Array, rows: IntArray
) -> tuple[Array, Array, Array]:
    """Curvatures (k, 2, 2) and the common point once the flatter surface is moved outward by d."""
    assert (
        contacts.curvature_a is not None and contacts.curvature_b is not None
    )  # Contacts has checked it
    k_a, k_b = (
        tangent @ k @ np.swapaxes(tangent, 1, 2)
        for k in (contacts.curvature_a, contacts.curvature_b)
    )
    move_b = np.abs(k_b).max((1, 2)) <= np.abs(k_a).max((1, 2))
    point = np.where(move_b[:, None], contacts.point_a, contacts.point_b)
    moved = np.eye(2) + contacts.separation[:, None, None] * np.where(
        move_b[:, None, None], k_b, k_a
    )
    if np.any(deep := np.linalg.eigvalsh(moved)[:, 0] <= 0):
        i = int(np.argmax(deep))
        raise failure("contacts.separation", "a penetration less deep than the radius of curvature",
                      written(contacts.separation[i]), (rows[i],))  # fmt: skip
    k_b = np.where(move_b[:, None, None], np.linalg.solve(moved, k_b), k_b)
    k_a = np.where(move_b[:, None, None], k_a, np.linalg.solve(moved, k_a))
    return k_a, k_b, point


def _inverse(k: Array, size: Array, u: Array, speed: Array, rows: IntArray) -> Array:
    """K^-1; where the surfaces are flat in one direction and do not tip there, zero in that direction."""
    values, axes = np.linalg.eigh(k)
    if np.any(hollow := values[:, 0] < -FLAT * size):
        i = int(np.argmax(hollow))
        raise failure("contacts.curvature_a", "two surfaces that touch at one point (K_A + K_B not negative)",
                      f"least curvature of K_A + K_B {written(values[i, 0])}", (rows[i],))  # fmt: skip
    flat = values <= FLAT * size[:, None]
    tipping = np.abs(np.einsum("kti,kt->ki", axes, u))  # in the axes' directions
    if np.any(bad := flat & (tipping > STILL * speed[:, None])):
        i = int(np.argmax(bad.any(axis=1)))
        raise failure("contacts.curvature_a", "two surfaces that touch at one point, or do not tip along their line",
                      f"parallel surfaces tipping at {tipping[i].max():.3g} rad/s in entry {rows[i]} "
                      "(give the two ends of the line as two contacts)")  # fmt: skip
    inverse = np.where(flat, 0.0, 1.0 / np.where(flat, 1.0, values))
    return np.einsum("kti,ki,kri->ktr", axes, inverse, axes)


def _form(x: Array, matrix: Array, y: Array) -> Array:
    return np.einsum("ki,kij,kj->k", x, matrix, y)


def _apply(matrix: Array, x: Array) -> Array:
    return np.einsum("kij,kj->ki", matrix, x)
