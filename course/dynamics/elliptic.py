"""Jacobi's elliptic functions and the first integral, by the complementary parameter.

Near the separatrix of a top or a pendulum the parameter m differs from 1 by a tiny m1 =
1 - m that decides when the motion reverses. SciPy's ``ellipj`` takes m, which rounds m1
away, and beyond m = 1 - 1e-10 expands about m = 1, where the functions have no period.
So they are computed here from m1.
"""

from __future__ import annotations

import numpy as np

from course.arrays import Array, ArrayLike

#: Enough for m1 = 1e-300: each step of the arithmetic-geometric mean doubles the
#: correct digits.
_MEANS = 14


def jacobi_functions(
    argument: ArrayLike, complement: ArrayLike
) -> tuple[Array, Array, Array]:
    """sn(u | m), cn(u | m) and dn(u | m) with m = 1 - m1.

    By the arithmetic-geometric mean of 1 and sqrt(m1), and the descent back (R.
    Bulirsch, Numer. Math. 7, 1965). At m1 = 0: tanh, sech, sech.

    Args:
        argument: u, (...).
        complement: m1, 0 to 1, (...).
    Returns:
        sn, cn, dn, each (...).
    """
    u, m1 = np.broadcast_arrays(
        np.asarray(argument, dtype=float), np.asarray(complement, dtype=float)
    )
    open_orbit = m1 == 0
    mean, root = np.ones(u.shape), np.where(open_orbit, 1.0, m1)
    means, roots = [], []
    for _ in range(_MEANS):
        root = np.sqrt(root)
        means.append(mean)
        roots.append(root)
        mean, root = 0.5 * (mean + root), root * mean
    sine, cosine = np.sin(mean * u), np.cos(mean * u)
    turning = sine != 0
    a = np.divide(cosine, sine, out=np.zeros(u.shape), where=turning)
    c, dn = mean * a, np.ones(u.shape)
    for b, root in zip(reversed(means), reversed(roots), strict=True):
        a = a * c
        c = c * dn
        dn = (root + a) / (b + a)
        a = c / b
    sn = np.copysign(1.0 / np.sqrt(c * c + 1.0), sine)
    sn, cn = np.where(turning, sn, 0.0), np.where(turning, c * sn, cosine)
    sech = 1.0 / np.cosh(np.clip(u, -700, 700))
    return (
        np.where(open_orbit, np.tanh(u), sn),
        np.where(open_orbit, sech, cn),
        np.where(open_orbit, sech, np.where(turning, dn, 1.0)),
    )


def quarter_period(complement: ArrayLike) -> Array:
    """K(m), the first u where sn is 1; infinity at m1 = 0."""
    from scipy.special import ellipkm1

    return np.asarray(ellipkm1(complement))


def first_integral(sine: ArrayLike, cosine: ArrayLike, complement: ArrayLike) -> Array:
    """u with sn(u) = sine and cn(u) = cosine >= 0, from -K to K.

    F = s R_F(c^2, c^2 + m1 s^2, 1) (B. C. Carlson, Numer. Algorithms 10, 1995).
    """
    from scipy.special import elliprf

    s, c, m1 = (np.asarray(x, dtype=float) for x in (sine, cosine, complement))
    return np.asarray(s * elliprf(c**2, c**2 + m1 * s**2, 1.0))
