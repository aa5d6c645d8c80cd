"""How bodies collide and rest on each other: reference code and workbook.

Conventions, stated once and kept everywhere
--------------------------------------------
Units and axes
    SI units, right-handed axes, z up, float64.
Arrays
    A vector is the last axis: shape ``(..., 3)``. Everything geometric is
    batched over leading axes by broadcasting, so the same function serves one
    pair and a hundred thousand. Inputs are never written to.
Orientation
    A body's is a unit quaternion, scalar last ``(x, y, z, w)``, shape
    ``(..., 4)``; a shape's is a rotation matrix ``(..., 3, 3)`` whose columns
    are the shape's axes.
Contact normal
    ``N`` (``n`` where impulses are meant) is a unit vector out of body B
    toward body A. The separation is ``d = (p_A - p_B) . N``: ``d > 0`` apart,
    ``0`` touching, ``< 0`` penetrating. A force ``f`` or an impulse ``p_hat``
    at or above zero pushes A along ``+N`` and B along ``-N``. Body 1 of the
    lecture's impulse slides is A.
Solids
    are closed: they overlap exactly when their gap is ``<= 0``.
Fixed bodies
    have mass infinity and do not move; their inertia is not read (inverse
    mass and inverse inertia are zero).
Words and letters
    Words in signatures, the lecture's letters in equations and short bodies.
Errors
    A wrong argument raises ``ValueError`` that names the argument, what was
    expected and what came. Nothing is silently repaired.

This module imports only the standard library: ``python3 -m course`` must run
before anything is installed.
"""

__version__ = "0.1.0"
