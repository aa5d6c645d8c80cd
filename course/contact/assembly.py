"""The contact system d_ddot = A f + b assembled for all contacts at once (syllabus rows 21-24), and their wrench."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from course.arrays import (
    Array,
    ArrayLike,
    BoolArray,
    failure,
    non_negative,
    scalar,
    scalars,
    shaped,
    vectors,
)
from course.contact.gap_terms import signed_terms
from course.contact.gaps import separation_rate
from course.contact.systems import ContactSystem
from course.dynamics.bodies import Bodies
from course.overlap.contact_arrays import Contacts

if TYPE_CHECKING:
    from scipy.sparse import csr_array

#: An entry of b below this times the sum of its terms' magnitudes is rounding noise.
BIAS_NOISE = 1e-14
#: Rounding of an entry of the Jacobian or of M^-1, relative to the numbers it was computed from.
ENTRY_ROUNDING = 4 * np.finfo(float).eps


def contact_system(
    bodies: Bodies,
    contacts: Contacts,
    force: ArrayLike,
    torque: ArrayLike,
    *,
    rate_tolerance: float = 1e-6,
) -> ContactSystem:
    """The matrix A and the vector b that tie contact forces to the accelerations of the separations.

    d_ddot_i = b_i + sum_j a_ij f_j (syllabus row 21), A = J M^-1 J'. Row i of
    J holds N and r_A x N at body A, -N and -(r_B x N) at body B (row 22).
    b is ``separation_acceleration`` under the external force and torque: it
    holds I^-1 (tau_external + L x omega), the centripetal terms,
    2 (p_A_dot - p_B_dot).N_dot and the curvature (rows 23 and 24; the slide
    leaves open where the external torque belongs, misprint 9).
    ``course.formulas.contact_matrix_entry`` has one entry of A as the slide has it.

    Args:
        bodies: n bodies.
        contacts: c contacts that rest: d_dot = 0.
        force, torque: external, on each body, (n, 3), the torque about the
            centre of mass, world axes [N, N m].
        rate_tolerance: how large |d_dot| may be, [m/s].
    Returns:
        The system; entries of b below 1e-14 of the sum of their terms'
        magnitudes are rounding noise and set to 0.
    Raises:
        ValueError: a contact that approaches or parts, a contact between two
            fixed bodies, wrong shapes, or as ``normal_rate``.
    """
    tolerance = scalar(
        "rate_tolerance",
        non_negative("rate_tolerance", rate_tolerance, infinite=True),
        infinite=True,
    )
    _refuse_fixed_pairs(bodies, contacts)
    _refuse_moving(separation_rate(bodies, contacts), tolerance)
    terms = signed_terms(bodies, contacts, force, torque).values()
    b = np.sum([value for value, _ in terms], axis=0)
    b[np.abs(b) <= BIAS_NOISE * np.sum([size for _, size in terms], axis=0)] = 0.0
    jacobian, inverse_mass = (
        contact_jacobian(bodies, contacts),
        inverse_mass_matrix(bodies),
    )
    a = jacobian @ (inverse_mass @ jacobian.T)
    return ContactSystem(
        (0.5 * (a + a.T)).tocsr(),
        b,
        jacobian,
        inverse_mass,
        free_acceleration(bodies, force, torque),
    )


def contact_jacobian(bodies: Bodies, contacts: Contacts) -> csr_array:
    """J with d_dot = J v (syllabus row 22), sparse (c, 6n); at most 12 entries a row, none for fixed bodies.

    What is only rounding (r x N of a ball) is left out, so that J is as
    sparse as the contacts are simple.
    """
    from scipy.sparse import csr_array

    c, n = len(contacts), len(bodies)
    values, columns = np.zeros((c, 2, 6)), np.empty((c, 2, 6), dtype=np.int64)
    for side, (body, point, sign) in enumerate(contacts.sides):
        position, free = bodies.position[body], ~bodies.fixed[body]
        lever = np.cross(point - position, contacts.normal)
        size = np.abs(point).max(axis=1, initial=0.0) + np.abs(position).max(
            axis=1, initial=0.0
        )
        lever[np.abs(lever) <= ENTRY_ROUNDING * size[:, None]] = 0.0
        normal = np.where(
            np.abs(contacts.normal) <= ENTRY_ROUNDING, 0.0, contacts.normal
        )
        values[:, side] = sign * free[:, None] * np.concatenate([normal, lever], axis=1)
        columns[:, side] = 6 * body[:, None] + np.arange(6)
    kept = values != 0
    start = np.concatenate([[0], np.cumsum(kept.sum(axis=(1, 2)))])
    # Body A's columns may come after body B's: csr_array does not ask for order.
    jacobian = csr_array((values[kept], columns[kept], start), shape=(c, 6 * n))
    jacobian.sort_indices()
    return jacobian


def inverse_mass_matrix(bodies: Bodies) -> csr_array:
    """M^-1, sparse (6n, 6n): 1/m three times and the world inverse inertia, body by body; zero where fixed."""
    from scipy.sparse import csr_array

    n = len(bodies)
    blocks = np.zeros((n, 6, 6))
    blocks[:, [0, 1, 2], [0, 1, 2]] = bodies.inverse_mass[:, None]
    inverse = bodies.world_inverse_inertia
    size = np.abs(inverse).max(axis=(1, 2), keepdims=True, initial=0.0)
    blocks[:, 3:, 3:] = np.where(np.abs(inverse) <= ENTRY_ROUNDING * size, 0.0, inverse)
    body, row, column = np.nonzero(blocks)
    entries = (blocks[body, row, column], (6 * body + row, 6 * body + column))
    return csr_array(entries, shape=(6 * n, 6 * n))


def free_acceleration(bodies: Bodies, force: ArrayLike, torque: ArrayLike) -> Array:
    """Acceleration of all bodies without contact forces, (6n,): F/m, then I^-1 (tau + L x omega) (row 23)."""
    f, tau = vectors("force", force), vectors("torque", torque)
    shaped("force", f, (len(bodies), 3))
    shaped("torque", tau, (len(bodies), 3))
    total = tau + np.cross(bodies.angular_momentum, bodies.angular_velocity)
    alpha = np.einsum("nij,nj->ni", bodies.world_inverse_inertia, total)
    return np.concatenate([f * bodies.inverse_mass[:, None], alpha], axis=1).ravel()


def contact_wrench(
    bodies: Bodies, contacts: Contacts, force: ArrayLike
) -> tuple[Array, Array]:
    """What contact forces do to each body: the sums of +-f N and of r x (+-f N) (syllabus rows 20 and 22).

    Args:
        bodies: n bodies.
        contacts: c contacts between them.
        force: f of each contact, (c,) [N]; f >= 0 pushes A along +N and B along -N.
    Returns:
        Force and torque about the centre of mass on each body, (n, 3) both, world
        axes [N, N m]; a fixed body's are what its support carries.
    Raises:
        ValueError: force of another shape, a contact with a body that is not there.
    """
    f = scalars("force", force)
    shaped("force", f, (len(contacts),))
    contacts.require_bodies(len(bodies))
    push = f[:, None] * contacts.normal
    total, torque = np.zeros((len(bodies), 3)), np.zeros((len(bodies), 3))
    for body, point, sign in contacts.sides:
        np.add.at(total, body, sign * push)
        np.add.at(torque, body, sign * np.cross(point - bodies.position[body], push))
    return total, torque


def _refuse_fixed_pairs(bodies: Bodies, contacts: Contacts) -> None:
    contacts.require_bodies(len(bodies))
    both: BoolArray = bodies.fixed[contacts.body_a] & bodies.fixed[contacts.body_b]
    if np.any(both):
        i = int(np.argmax(both))
        raise failure("contacts", "at least one body that can move", f"bodies {contacts.body_a[i]} and "
                      f"{contacts.body_b[i]} in entry {i}, both fixed: no force changes d_ddot there")  # fmt: skip


def _refuse_moving(rate: Array, tolerance: float) -> None:
    for name, bad, worst, advice in (
        ("approaches", rate < -tolerance, np.argmin, "resolve the collision first (resolve_collisions)"),
        ("parts", rate > tolerance, np.argmax, "leave it out (it takes no force): contacts[resting(bodies, contacts)]"),
    ):  # fmt: skip
        if np.any(bad):
            i = int(worst(rate))
            raise failure("contacts", f"|d_dot| of at most {tolerance:g} m/s",
                          f"d_dot = {rate[i]:.3g} m/s in entry {i}, and {np.count_nonzero(bad)} in all: "
                          f"a contact that {name}; {advice}")  # fmt: skip
