"""Impulses between two bodies that do not turn: instantaneous, frictionless, one restitution.

Body 1 of the lecture's slides is A: n points out of body 2 toward body 1, and an
impulse p_hat >= 0 pushes body 1 along +n and body 2 along -n. Two bodies approach while
(v1 - v2).n < 0. Bodies that part, or touch without approaching, exchange no impulse.
"""

from __future__ import annotations

import numpy as np

from course import formulas
from course.arrays import (
    Array,
    ArrayLike,
    broadcast,
    in_range,
    positive,
    scalars,
    unit_vectors,
    vectors,
)

#: Masses above this are halved before they are added [kg].
LARGE = 1e300


def momentum_after(
    momentum_1: ArrayLike, momentum_2: ArrayLike, impulse: ArrayLike, normal: ArrayLike
) -> tuple[Array, Array]:
    """Momenta after an impulse: what one body gains the other loses.

    p1' = p1 + p_hat n, p2' = p2 - p_hat n (syllabus row 16), so that
    p1' + p2' = p1 + p2 whatever p_hat is (row 15). That balance alone says
    nothing about energy: the slide's energy line defines T_lost and does not
    follow from it (misprint 2).

    Args:
        momentum_1, momentum_2: (..., 3) [kg m/s].
        impulse: p_hat, (...) [N s].
        normal: n, unit, out of body 2 toward body 1, (..., 3).
    Returns:
        p1' and p2', (..., 3) [kg m/s].
    Raises:
        ValueError: a wrong shape, NaN or infinity, a normal that is not of unit length.
    Example:
        >>> momentum_after([-3.0, 0, 0], [1.0, 0, 0], 4.0, [1.0, 0, 0])
        (array([1., 0., 0.]), array([-3.,  0.,  0.]))
    """
    p_1, p_2 = vectors("momentum_1", momentum_1), vectors("momentum_2", momentum_2)
    p_hat, n = scalars("impulse", impulse), unit_vectors("normal", normal)
    broadcast(
        momentum_1=(p_1, 1), momentum_2=(p_2, 1), impulse=(p_hat, 0), normal=(n, 1)
    )
    return formulas.momentum_after(p_1, p_2, p_hat, n)


def velocity_after(
    mass_1: ArrayLike,
    mass_2: ArrayLike,
    velocity_1: ArrayLike,
    velocity_2: ArrayLike,
    impulse: ArrayLike,
    normal: ArrayLike,
) -> tuple[Array, Array]:
    """Velocities after an impulse.

    v1' = v1 + (p_hat/m1) n, v2' = v2 - (p_hat/m2) n (syllabus row 16); a body
    of infinite mass keeps its velocity.

    Args:
        mass_1, mass_2: (...) [kg], infinity for a fixed body.
        velocity_1, velocity_2: (..., 3) [m/s].
        impulse: p_hat, (...) [N s].
        normal: n, unit, out of body 2 toward body 1, (..., 3).
    Returns:
        v1' and v2', (..., 3) [m/s].
    Raises:
        ValueError: a wrong shape, mass <= 0, NaN, a normal that is not of unit length.
    """
    m_1, m_2, v_1, v_2, n = _pair(mass_1, mass_2, velocity_1, velocity_2, normal)
    p_hat = scalars("impulse", impulse)
    broadcast(
        velocity_1=(v_1, 1), velocity_2=(v_2, 1), normal=(n, 1), impulse=(p_hat, 0)
    )
    return v_1 + (p_hat / m_1)[..., None] * n, v_2 - (p_hat / m_2)[..., None] * n


def separation_speed(
    velocity_1: ArrayLike,
    velocity_2: ArrayLike,
    normal: ArrayLike,
    restitution: ArrayLike,
) -> Array:
    """How fast two bodies part along the normal after the impact, (v1' - v2').n.

    (v1' - v2').n = -e (v1 - v2).n while they approach, Newton's law of
    restitution (syllabus row 17). The slide lacks the minus sign and the
    normal (misprint 3): taken along n as printed, p_hat would have the factor
    1 - e, no impulse at all at e = 1. Bodies that do not approach go on as
    they are: (v1 - v2).n.

    Args:
        velocity_1, velocity_2: before the impact, (..., 3) [m/s].
        normal: n, unit, out of body 2 toward body 1, (..., 3).
        restitution: e, from 0 to 1, (...).
    Returns:
        The separation speed, never below 0, (...) [m/s].
    Raises:
        ValueError: a wrong shape, restitution outside 0..1, a normal that is not of
            unit length.
    """
    v_1, v_2 = vectors("velocity_1", velocity_1), vectors("velocity_2", velocity_2)
    n, e = unit_vectors("normal", normal), in_range("restitution", restitution, 0, 1)
    broadcast(
        velocity_1=(v_1, 1), velocity_2=(v_2, 1), normal=(n, 1), restitution=(e, 0)
    )
    return formulas.separation_speed(v_1, v_2, n, e)[()]


def impulse_central(
    mass_1: ArrayLike,
    mass_2: ArrayLike,
    velocity_1: ArrayLike,
    velocity_2: ArrayLike,
    normal: ArrayLike,
    restitution: ArrayLike,
) -> Array:
    """Impulse of a central impact: the centres lie on the line of impact, or the bodies
    do not turn.

    p_hat = (1 + e) (v2.n - v1.n) / (1/m1 + 1/m2) while (v1 - v2).n < 0, else
    0 (syllabus row 17). The slide's formula is right for a central impact,
    but only while the bodies approach (misprint 3). One body may have
    infinite mass; between two of them the impulse is 0. A wall is 1/m2 = 0
    and v2 = 0: p_hat = -(1 + e) m1 v1.n (row 18, misprint 4).

    Args:
        mass_1, mass_2: (...) [kg], infinity for a fixed body.
        velocity_1, velocity_2: before the impact, (..., 3) [m/s].
        normal: n, unit, out of body 2 toward body 1, (..., 3).
        restitution: e, from 0 to 1, (...).
    Returns:
        p_hat >= 0, (...) [N s].
    Raises:
        ValueError: a wrong shape, mass <= 0, restitution outside 0..1, a normal that is
            not of unit length.
    Example:
        A ball of 2 kg meets one of 1 kg at 4 m/s, nothing lost; and the same pair
        already parting.

        >>> v = np.array([[-3.0, 0, 0], [3.0, 0, 0]])
        >>> impulse_central(2.0, 1.0, v, [1.0, 0, 0], [1.0, 0, 0], 1.0).round(4)
        array([5.3333, 0.    ])
    """
    reduced_mass, closing, e = _impact(
        mass_1, mass_2, velocity_1, velocity_2, normal, restitution
    )
    return (1 + e) * (closing * reduced_mass)


def kinetic_energy_lost(
    mass_1: ArrayLike,
    mass_2: ArrayLike,
    velocity_1: ArrayLike,
    velocity_2: ArrayLike,
    normal: ArrayLike,
    restitution: ArrayLike,
) -> Array:
    """T_lost, the kinetic energy that a central impact takes away.

    T_lost = mu (1 - e^2) ((v1 - v2).n)^2 / 2 while the bodies approach, else
    0, with the reduced mass mu = 1/(1/m1 + 1/m2) (syllabus rows 15 and 17).
    It is what the energy line of the slide defines (misprint 2).

    Args:
        mass_1, mass_2: (...) [kg], infinity for a fixed body.
        velocity_1, velocity_2: before the impact, (..., 3) [m/s].
        normal: n, unit, out of body 2 toward body 1, (..., 3).
        restitution: e, from 0 to 1, (...).
    Returns:
        T_lost >= 0, (...) [J].
    Raises:
        ValueError: as ``impulse_central``.
    Example:
        >>> float(kinetic_energy_lost(2.0, 2.0, [-3.0, 0, 0], [1.0, 0, 0], [1.0, 0, 0], 0.5))
        6.0
    """
    reduced_mass, closing, e = _impact(
        mass_1, mass_2, velocity_1, velocity_2, normal, restitution
    )
    # closing times the momentum it carries: its square alone may underflow or overflow.
    return 0.5 * (1 - e) * (1 + e) * (reduced_mass * closing) * closing


def _pair(
    mass_1: ArrayLike,
    mass_2: ArrayLike,
    velocity_1: ArrayLike,
    velocity_2: ArrayLike,
    normal: ArrayLike,
) -> tuple[Array, Array, Array, Array, Array]:
    m_1, m_2 = (
        positive("mass_1", mass_1, infinite=True),
        positive("mass_2", mass_2, infinite=True),
    )
    v_1, v_2 = vectors("velocity_1", velocity_1), vectors("velocity_2", velocity_2)
    n = unit_vectors("normal", normal)
    broadcast(
        mass_1=(m_1, 0),
        mass_2=(m_2, 0),
        velocity_1=(v_1, 1),
        velocity_2=(v_2, 1),
        normal=(n, 1),
    )
    return m_1, m_2, v_1, v_2, n


def _impact(
    mass_1: ArrayLike,
    mass_2: ArrayLike,
    velocity_1: ArrayLike,
    velocity_2: ArrayLike,
    normal: ArrayLike,
    restitution: ArrayLike,
) -> tuple[Array, Array, Array]:
    """Reduced mass (0 between fixed bodies), closing speed (0 if parting) and e."""
    m_1, m_2, v_1, v_2, n = _pair(mass_1, mass_2, velocity_1, velocity_2, normal)
    e = in_range("restitution", restitution, 0, 1)
    batch = broadcast(mass_1=(m_1, 0), mass_2=(m_2, 0), velocity_1=(v_1, 1), velocity_2=(v_2, 1),
                      normal=(n, 1), restitution=(e, 0))  # fmt: skip
    light, heavy = np.minimum(m_1, m_2), np.maximum(m_1, m_2)
    # m1 m2/(m1 + m2) for any masses: neither their product nor a sum that would
    # overflow is formed.
    half = np.where(heavy > LARGE, 0.5, 1.0)
    share = np.divide(
        half * heavy,
        half * light + half * heavy,
        out=np.ones(heavy.shape),
        where=np.isfinite(heavy),
    )
    reduced_mass = np.where(np.isfinite(light), light, 0.0) * share
    closing = np.maximum(np.sum((v_2 - v_1) * n, axis=-1), 0.0)
    return (
        np.broadcast_to(reduced_mass, batch),
        np.broadcast_to(closing, batch),
        np.broadcast_to(e, batch),
    )
