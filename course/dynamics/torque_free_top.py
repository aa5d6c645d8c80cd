"""The torque-free top, exactly: Jacobi's elliptic functions, the orientation included.

No torque acts, so L in space and T are constant. In the principal axes l = R'L moves
along the curve where the sphere |l|^2 = L^2 intersects the ellipsoid sum l_i^2/I_i = 2T
(Landau and Lifshitz, *Mechanics*, section 37). The curve encircles the axis of the
largest moment where L^2 > 2T I2, that of the smallest where L^2 < 2T I2, and on the
separatrix between them it ends at the middle axis. With k the axis it encircles and j
the third one,

    l_j = a cn(u), l_2 = b sn(u), l_k = B dn(u), each with its sign, u = u0 + lambda t.
"""

from __future__ import annotations

from dataclasses import dataclass, replace

import numpy as np

from course import rotations
from course.arrays import (
    Array,
    ArrayLike,
    BoolArray,
    broadcast,
    failure,
    positive,
    scalar,
    scalars,
    vectors,
)
from course.dynamics.bodies import Bodies
from course.dynamics.elliptic import first_integral, jacobi_functions, quarter_period
from course.dynamics.mass_properties import principal_axes

#: Gauss-Legendre nodes for an interval of u of at most 1. The nearest pole of the
#: precession's rate is at least pi/4 from the real axis, so the error of 16 nodes is
#: below 1e-16.
_NODES, _WEIGHTS = np.polynomial.legendre.leggauss(16)

#: From here on sech^2(u) is negligible beside 1.
_FAR = 45.0


@dataclass(frozen=True)
class _Orbit:
    """The curve of l in the axes (j, 2, k) of a top or a batch; letters as in the
    module docstring.
    """

    axes: Array  # (..., 3, 3) rows j, 2, k in the given principal axes, right-handed
    moments: Array  # (..., 3)
    signs: Array  # (..., 3)
    sizes: Array  # (..., 3) a, b, B
    start: Array  # u0
    rate: Array  # lambda
    complement: Array  # m1
    still: BoolArray  # omega stays along l
    about_k: BoolArray  # the precession is counted from axis k, else from axis j

    def momentum(self, u: Array) -> Array:
        """l in the axes (j, 2, k)."""
        sn, cn, dn = jacobi_functions(u, self.complement)
        return self.signs * self.sizes * np.stack([cn, sn, dn], axis=-1)

    def precession_rate(self, u: Array) -> Array:
        """How fast the plane of L and the reference axis turns about L.

        L (sum l_i^2/I_i)/(sum l_i^2), the sums over the other two axes.
        """
        squares = self.momentum(u) ** 2
        counted = np.where(self.about_k[..., None], [1.0, 1.0, 0.0], [0.0, 1.0, 1.0])
        size = np.sqrt(squares.sum(axis=-1))
        across = np.sum(counted * squares, axis=-1)
        return (
            size
            * np.sum(counted * squares / self.moments, axis=-1)
            / np.where(across > 0, across, 1.0)
        )


def torque_free_rotation(
    moments: ArrayLike, angular_momentum: ArrayLike, time: ArrayLike
) -> tuple[Array, Array]:
    """Where a top without torque is after a time, exactly, as it sees itself.

    Source: the head of this module. The orientation follows from L in space,
    which does not turn, and the angle of precession about it, the integral of
    L (sum l_i^2/I_i)/(sum l_i^2) over the two axes that it is not counted
    from; it is a smooth function of period 2K in u and is integrated by
    Gauss's rule to rounding.

    Args:
        moments: principal, in any order, (..., 3) [kg m^2].
        angular_momentum: l at time 0, in the principal axes, (..., 3) [kg m^2/s].
        time: (...) [s], of either sign.
    Returns:
        l at that time, in the principal axes then, (..., 3), and the turn
        since time 0 as a unit quaternion Q in the principal axes of time 0,
        (..., 4): R(t) = R(0) Q, and Q l(t) = l(0).
    Raises:
        ValueError: a moment that is not positive, a wrong shape, NaN or infinity.
    """
    moment = positive("moments", vectors("moments", moments))
    before = vectors("angular_momentum", angular_momentum)
    t = scalars("time", time)
    batch = broadcast(moments=(moment, 1), angular_momentum=(before, 1), time=(t, 0))
    moment, before = (
        np.broadcast_to(moment, (*batch, 3)),
        np.broadcast_to(before, (*batch, 3)),
    )
    t = np.broadcast_to(t, batch)
    orbit = _orbit(moment, before)
    span = orbit.rate * t
    local = np.where(
        orbit.still[..., None],
        np.einsum("...ij,...j->...i", orbit.axes, before),
        orbit.momentum(orbit.start + span),
    )
    later = np.einsum("...ji,...j->...i", orbit.axes, local)
    with np.errstate(invalid="ignore", divide="ignore"):
        angle = np.where(orbit.still, 0.0, _precession(orbit, span) / orbit.rate)
    turn = _turn(orbit, before, later, angle)
    steady = rotations.from_rotation_vector(before / moment * t[..., None])
    return later, np.where(orbit.still[..., None], steady, turn)


def torque_free_motion(bodies: Bodies, time: float) -> Bodies:
    """The bodies after a time in which no force and no torque acts on them, exactly.

    Centres move uniformly, L and p are constant, orientations follow
    ``torque_free_rotation``.

    Args:
        bodies: n bodies; fixed ones do not change.
        time: [s], of either sign.
    """
    if not isinstance(bodies, Bodies):
        raise failure("bodies", "Bodies", type(bodies).__name__)
    t, fixed = scalar("time", time), bodies.fixed
    moments, axes = principal_axes(
        np.where(fixed[:, None, None], np.eye(3), bodies.inertia)
    )
    to_world = bodies.rotation @ axes
    _, turn = torque_free_rotation(
        moments, np.einsum("nji,nj->ni", to_world, bodies.angular_momentum), t
    )
    later = rotations.from_matrix(
        to_world @ rotations.to_matrix(turn) @ np.swapaxes(axes, -1, -2)
    )
    return replace(
        bodies,
        position=bodies.position + bodies.velocity * t,
        orientation=np.where(fixed[:, None], bodies.orientation, later),
    )


def middle_axis_growth_rate(moments: ArrayLike, spin: ArrayLike) -> Array:
    """How fast a wobble grows on a top that spins about its middle axis.

    As exp(sigma t) with sigma = Omega sqrt((I2 - I1)(I3 - I2)/(I1 I3)) (from
    the Euler equations near the axis; Landau and Lifshitz, *Mechanics*, section 37).

    Args:
        moments: principal, in any order, (..., 3) [kg m^2].
        spin: Omega, (...) [rad/s].
    Returns:
        sigma >= 0, (...) [1/s].
    """
    ordered = np.sort(positive("moments", vectors("moments", moments)), axis=-1)
    omega = scalars("spin", spin)
    broadcast(moments=(ordered, 1), spin=(omega, 0))
    least, middle, largest = np.moveaxis(ordered, -1, 0)
    return np.abs(omega) * np.sqrt(
        (middle - least) * (largest - middle) / (least * largest)
    )


def _orbit(moments: Array, momentum: Array) -> _Orbit:
    axes = _ordered_axes(moments, momentum)
    moment = np.einsum("...ij,...j->...i", np.abs(axes), moments)
    local = np.einsum("...ij,...j->...i", axes, momentum)
    j, two, k = np.moveaxis(moment, -1, 0)
    l_j, l_2, l_k = np.moveaxis(local, -1, 0)
    outer, inner, near = np.abs(k - j), np.abs(k - two), np.abs(two - j)
    with np.errstate(invalid="ignore", divide="ignore"):
        ratio = np.sqrt(j * inner / (two * outer))  # a/b
        a = np.hypot(l_j, ratio * l_2)
        big = np.hypot(l_k, l_2 * np.sqrt(near * k / (two * outer)))  # B
        rate = big / k * np.sqrt(inner * outer / (j * two))
        still = (
            np.all(np.cross(local, local / moment) == 0, axis=-1)
            | ~(rate > 0)
            | ~(a > 0)
        )
        complement = (inner * j * l_k**2 - near * k * l_j**2) / (inner * j * big**2)
        signs = np.where(local < 0, -1.0, 1.0)
        signs[..., 1] = np.where(k > j, 1.0, -1.0) * signs[..., 0] * signs[..., 2]
        complement = np.where(still, 1.0, np.clip(complement, 0.0, 1.0))
        sine, cosine = signs[..., 1] * ratio * l_2 / a, np.abs(l_j) / a
        start = first_integral(
            np.where(still, 0.0, sine), np.where(still, 1.0, cosine), complement
        )
        sizes = np.where(still[..., None], 1.0, np.stack([a, a / ratio, big], axis=-1))
    return _Orbit(
        axes,
        moment,
        signs,
        sizes,
        start,
        np.where(still, 0.0, rate),
        complement,
        still,
        a > big,
    )


def _ordered_axes(moments: Array, momentum: Array) -> Array:
    """Rows j, 2, k as a rotation.

    Smallest, middle, largest where the curve encircles the last, else in reverse.
    """
    order = np.argsort(moments, axis=-1, kind="stable")
    least, middle, largest = np.moveaxis(np.take_along_axis(moments, order, -1), -1, 0)
    first, _, last = np.moveaxis(np.take_along_axis(momentum, order, -1), -1, 0)
    # L^2 - 2T I2, with the common terms left out.
    excess = (
        last**2 * (largest - middle) / largest - first**2 * (middle - least) / least
    )
    order = np.where((excess >= 0)[..., None], order, order[..., ::-1])
    axes = np.eye(3)[order]
    return axes * np.linalg.det(axes)[..., None, None]


def _precession(orbit: _Orbit, span: Array) -> Array:
    """The integral of the precession's rate over u, from u0 for the span."""
    half = quarter_period(orbit.complement)
    closed = np.isfinite(half)
    half = np.where(closed, half, 1.0)
    periods = np.where(closed, np.round(0.5 * span / half), 0.0)
    rest = np.where(periods != 0, span - 2 * periods * half, span)
    total = _integral(orbit, orbit.start, rest)
    if np.any(periods):
        # The rate depends on sn^2: its period is twice the way from 0 to K.
        total = total + 2 * periods * _integral(orbit, np.zeros(half.shape), half)
    return total


def _integral(orbit: _Orbit, lower: Array, span: Array) -> Array:
    """From lower for the span, by panels of length up to 1."""
    beyond = np.zeros(span.shape)
    if np.any(orbit.complement == 0):
        # Far out on the separatrix the rate is constant.
        low, high = np.clip(lower, -_FAR, _FAR), np.clip(lower + span, -_FAR, _FAR)
        cut = (orbit.complement == 0) & ((low != lower) | (high != lower + span))
        beyond = np.where(
            cut,
            (span - (high - low)) * orbit.precession_rate(np.full(low.shape, _FAR)),
            0.0,
        )
        lower, span = np.where(cut, low, lower), np.where(cut, high - low, span)
    panels = max(1, int(np.ceil(np.max(np.abs(span), initial=0.0))))
    # From the span itself: a difference of limits would cancel the digits of a short
    # one.
    half = 0.5 * span / panels
    total = beyond
    for panel in range(panels):
        middle = lower + (2 * panel + 1) * half
        for node, weight in zip(_NODES, _WEIGHTS, strict=True):
            total = total + weight * half * orbit.precession_rate(middle + node * half)
    return total


def _turn(orbit: _Orbit, before: Array, after: Array, angle: Array) -> Array:
    """Q: the frame of L and the reference axis before and after, and the precession
    between.
    """
    axis = np.where(
        orbit.about_k[..., None], orbit.axes[..., 2, :], orbit.axes[..., 0, :]
    )
    size = np.linalg.norm(before, axis=-1, keepdims=True)
    with np.errstate(invalid="ignore", divide="ignore"):
        precession = rotations.from_rotation_vector(
            np.where(size > 0, before / size, 0.0) * angle[..., None]
        )
    first, second = (
        _frame(axis, momentum, orbit.still) for momentum in (before, after)
    )
    relative = rotations.from_matrix(first @ np.swapaxes(second, -1, -2))
    return rotations.from_matrix(
        rotations.to_matrix(precession) @ rotations.to_matrix(relative)
    )


def _frame(axis: Array, momentum: Array, still: BoolArray) -> Array:
    """Columns: across axis and l, across that and l, along l; any frame if l is 0."""
    momentum = np.where(still[..., None], np.roll(axis, 1, axis=-1), momentum)
    along = momentum / np.linalg.norm(momentum, axis=-1, keepdims=True)
    node = np.cross(axis, along)
    node /= np.linalg.norm(node, axis=-1, keepdims=True)
    return np.stack([node, np.cross(along, node), along], axis=-1)
