"""Distance of two convex hulls by the algorithm of Gilbert, Johnson and Keerthi (GJK).

The difference A - B = {a - b} of two convex sets is convex, and its point v nearest to the
origin is as long as the sets are apart. A - B is never built: a *simplex*, at most four
of its vertices, walks toward the origin. Each turn finds the vertex w furthest against
v, adds it, and keeps the fewest corners whose hull has the new nearest point.

E. G. Gilbert, D. W. Johnson, S. S. Keerthi, "A fast procedure for computing the distance
between complex objects in three-dimensional space", IEEE J. Robotics and Automation 4
(1988); G. van den Bergen, *Collision Detection in Interactive 3D Environments* (2003),
chapter 4; C. Ericson, *Real-Time Collision Detection*, section 9.5. The nearest point of a
simplex by the signs of its volumes: M. Montanari, N. Petrinic, E. Barbieri, "Improving
the GJK algorithm", ACM Trans. Graphics 36 (2017).

Every turn shortens v, all but a few, or the walk ends: there are finitely many simplices,
so that it cannot cycle. How good its end is can be read off: no point of A - B is nearer than
w.v / |v|, and none needs to be further than v.

A kernel module (``course.jit``): import it where it is called.
"""

from __future__ import annotations

import math

import numpy as np

from course.arrays import Array, IntArray
from course.jit import compiled

#: How the walk ended: the sets are apart and v is known; they are further apart than
#: was asked; the origin is inside the last simplex.
APART, BEYOND, INSIDE = 0, 1, 2

#: A number written out has machine code of its own wherever it is an argument; these have not.
ZERO, ONE, TWO, THREE = np.array([0, 1, 2, 3])
#: The corners of a tetrahedron's face across from each corner, all going round one way.
FACES = np.array([[1, 2, 3], [0, 3, 2], [0, 1, 3], [0, 2, 1]])
#: Turns after which the walk ends however it stands. Hulls of 32 vertices need five.
MOST_TURNS = 100
#: Turns that may bring v no nearer: a foot beside a vertex by 1e-9 shortens it by 1e-18.
MOST_STALLS = 4
#: Relative size of the difference of v.v and v.w that is rounding.
ROUNDING = 4e-16
#: A tetrahedron of which the volume is below this times its edges cubed is flat: which side
#: of a face the origin is on is then rounding, and it is never said to be inside.
FLAT = 1e-13
#: Twice a triangle's area, squared, below which it is taken for its sides: the vertices
#: are of order 1, and no two numbers of order 1 are so near each other.
NO_AREA = 1e-70
#: Squared sine of the angle at a triangle's corner below which it is a sliver.
SLIVER = 1e-10
#: How near each other two nearest points of a triangle are that differ by rounding, where the
#: vertices are of order 1.
SAME = 1e-14


@compiled
def support(points: Array, count: int, x: float, y: float, z: float) -> int:
    """Which of the first points is furthest along (x, y, z); the first of several."""
    best, furthest = 0, points[0, 0] * x + points[0, 1] * y + points[0, 2] * z
    for k in range(1, count):
        along = points[k, 0] * x + points[k, 1] * y + points[k, 2] * z
        if along > furthest:
            best, furthest = k, along
    return best


@compiled
def on_segment(w: Array, i: int, j: int) -> tuple[float, float, float]:
    """The point of a segment nearest the origin: (its squared distance, weights of w_i and w_j).

    t = -w_i.u / u.u with u = w_j - w_i, clamped to the segment (Ericson 5.1.2).
    """
    x, y, z = w[i, 0], w[i, 1], w[i, 2]
    ux, uy, uz = w[j, 0] - x, w[j, 1] - y, w[j, 2] - z
    length, along = ux * ux + uy * uy + uz * uz, -(x * ux + y * uy + z * uz)
    if along <= 0.0:
        return x * x + y * y + z * z, 1.0, 0.0
    if along >= length:
        return w[j, 0] ** 2 + w[j, 1] ** 2 + w[j, 2] ** 2, 0.0, 1.0
    t = along / length
    x, y, z = x + t * ux, y + t * uy, z + t * uz
    return x * x + y * y + z * z, 1.0 - t, t


@compiled
def on_triangle(w: Array, i: int, j: int, k: int) -> tuple[float, float, float, float]:
    """The point of a triangle nearest the origin: (its squared distance, three weights).

    The weights of the origin's projection are the areas n.(w_j x w_k), ... by their sum,
    n the triangle's normal. Where one is not above 0 the nearest point is on the side
    across from that corner (of several such sides, on the nearest).
    """
    ax, ay, az = w[i, 0], w[i, 1], w[i, 2]
    bx, by, bz = w[j, 0], w[j, 1], w[j, 2]
    cx, cy, cz = w[k, 0], w[k, 1], w[k, 2]
    ux, uy, uz, vx, vy, vz = bx - ax, by - ay, bz - az, cx - ax, cy - ay, cz - az
    nx, ny, nz = uy * vz - uz * vy, uz * vx - ux * vz, ux * vy - uy * vx
    p = nx * (by * cz - bz * cy) + ny * (bz * cx - bx * cz) + nz * (bx * cy - by * cx)
    q = nx * (cy * az - cz * ay) + ny * (cz * ax - cx * az) + nz * (cx * ay - cy * ax)
    r = nx * (ay * bz - az * by) + ny * (az * bx - ax * bz) + nz * (ax * by - ay * bx)
    area = nx * nx + ny * ny + nz * nz
    least, wi, wj, wk = math.inf, 1.0, 0.0, 0.0
    if area > NO_AREA and p > 0.0 and q > 0.0 and r > 0.0:
        total = p + q + r
        p, q, r = p / total, q / total, r / total
        x, y, z = p * ax + q * bx + r * cx, p * ay + q * by + r * cy, p * az + q * bz + r * cz  # fmt: skip
        least, wi, wj, wk = x * x + y * y + z * z, p, q, r
    # Of a sliver the areas are rounding, and none is far from a side.
    lengths = (ux * ux + uy * uy + uz * uz) * (vx * vx + vy * vy + vz * vz)
    if area <= SLIVER * lengths:
        p = q = r = 0.0
    if p <= 0.0:
        square, s, t = on_segment(w, j, k)
        if square < least:
            least, wi, wj, wk = square, 0.0, s, t
    if q <= 0.0:
        square, s, t = on_segment(w, i, k)
        if square < least:
            least, wi, wj, wk = square, s, 0.0, t
    if r <= 0.0:
        square, s, t = on_segment(w, i, j)
        if square < least:
            least, wi, wj, wk = square, s, t, 0.0
    return least, wi, wj, wk


@compiled
def triple(w: Array, i: int, j: int, k: int) -> float:
    """w_i . (w_j x w_k): six times the volume with the origin."""
    return (
        w[i, 0] * (w[j, 1] * w[k, 2] - w[j, 2] * w[k, 1])
        + w[i, 1] * (w[j, 2] * w[k, 0] - w[j, 0] * w[k, 2])
        + w[i, 2] * (w[j, 0] * w[k, 1] - w[j, 1] * w[k, 0])
    )


@compiled
def on_tetrahedron(w: Array, weight: Array) -> float:
    """The point of a tetrahedron nearest the origin: its squared distance, -1 if that is inside.

    The origin's weights are volumes by their sum. Where one is not above 0 the nearest point
    is on the face across from that corner, or on another such face.
    """
    total = longest = 0.0
    for m in range(4):
        # Faces go round the way that makes all four volumes those of one sign.
        weight[m] = triple(w, FACES[m, 0], FACES[m, 1], FACES[m, 2])
        total += weight[m]
        longest = max(longest, w[m, 0] ** 2 + w[m, 1] ** 2 + w[m, 2] ** 2)
    flat, inside = abs(total) <= FLAT * longest * math.sqrt(longest), True
    for m in range(4):
        weight[m] = weight[m] / total if not flat else -1.0
        inside &= weight[m] > 0.0
    if inside:
        return -1.0
    v0, v1, v2, v3 = weight[0], weight[1], weight[2], weight[3]
    least = math.inf
    for m in range(4):
        if (v0, v1, v2, v3)[m] > 0.0:
            continue
        i, j, k = FACES[m, 0], FACES[m, 1], FACES[m, 2]
        square, p, q, r = on_triangle(w, i, j, k)
        if square < least:
            least, weight[m] = square, 0.0
            weight[i], weight[j], weight[k] = p, q, r
    return least


@compiled
def on_simplex(w: Array, count: int, weight: Array) -> float:
    """The nearest point of the first one to four corners: squared distance, -1 inside; the weights are written."""
    if count == 4:
        return on_tetrahedron(w, weight)
    if count == 3:
        square, weight[0], weight[1], weight[2] = on_triangle(w, ZERO, ONE, TWO)
        return square
    if count == 2:
        square, weight[0], weight[1] = on_segment(w, ZERO, ONE)
        return square
    weight[0] = 1.0
    return w[0, 0] ** 2 + w[0, 1] ** 2 + w[0, 2] ** 2


@compiled
def keep(w: Array, pick: IntArray, weight: Array, share: Array, count: int) -> int:
    """Drop the corners without weight; how many are left. share takes the weights."""
    kept = 0
    for m in range(count):
        if weight[m] > 0.0:
            w[kept, 0], w[kept, 1], w[kept, 2] = w[m, 0], w[m, 1], w[m, 2]
            pick[kept, 0], pick[kept, 1] = pick[m, 0], pick[m, 1]
            share[kept] = weight[m]
            kept += 1
    return kept


@compiled
def nearest_point(w: Array, share: Array, count: int) -> tuple[float, float, float]:
    """v, the sum of share times w; of a triangle n (n.w) / n.n, whose direction is exact however near it is.

    Of a sliver, whose n is rounding, the sum.
    """
    x, y, z = w[0, 0], w[0, 1], w[0, 2]
    ux = uy = uz = 0.0
    for m in range(1, count):
        t = share[m]
        ux, uy, uz = ux + t * (w[m, 0] - x), uy + t * (w[m, 1] - y), uz + t * (w[m, 2] - z)  # fmt: skip
    sx, sy, sz = x + ux, y + uy, z + uz
    if count == 1:
        return sx, sy, sz
    if count == 2:
        # Once more, so that a short v is across the segment to its own rounding.
        vx, vy, vz = w[1, 0] - x, w[1, 1] - y, w[1, 2] - z
        t = (sx * vx + sy * vy + sz * vz) / (vx * vx + vy * vy + vz * vz)
        return sx - t * vx, sy - t * vy, sz - t * vz
    ux, uy, uz = w[1, 0] - x, w[1, 1] - y, w[1, 2] - z
    vx, vy, vz = w[2, 0] - x, w[2, 1] - y, w[2, 2] - z
    nx, ny, nz = uy * vz - uz * vy, uz * vx - ux * vz, ux * vy - uy * vx
    height = (nx * x + ny * y + nz * z) / (nx * nx + ny * ny + nz * nz)
    x, y, z = height * nx, height * ny, height * nz
    if abs(x - sx) + abs(y - sy) + abs(z - sz) > SAME:
        return sx, sy, sz
    return x, y, z


@compiled
def gjk_distance(
    a: Array,
    count_a: int,
    b: Array,
    count_b: int,
    v: Array,
    reach: float,
    w: Array,
    pick: IntArray,
    share: Array,
    weight: Array,
) -> tuple[int, int, float]:
    """The point v of A - B nearest to the origin, out of B toward A.

    Args:
        a, b: vertices, the first count_a and count_b rows of (..., 3) [any unit].
        v: where to begin, (3,), any vector; holds the nearest point afterwards.
        reach: stop as soon as the sets are known to be further apart.
        w, pick, share: (4, 3), (4, 2) and (4,): the last simplex is left there: corners a - b, which
            vertices they are of, and the weights of v.
        weight: (4,), room to work in.
    Returns:
        How the walk ended, how many corners the simplex has, and a distance below
        which no point of A - B is (that of the plane through w across v).
    """
    x, y, z = v[0], v[1], v[2]
    count, stalls, square, lower = 0, 0, math.inf, 0.0
    for _ in range(MOST_TURNS):
        i, j = support(a, count_a, -x, -y, -z), support(b, count_b, x, y, z)
        wx, wy, wz = a[i, 0] - b[j, 0], a[i, 1] - b[j, 1], a[i, 2] - b[j, 2]
        length = math.sqrt(x * x + y * y + z * z)
        along = x * wx + y * wy + z * wz
        lower = along / length if length > 0.0 else 0.0
        if lower > reach:
            return BEYOND, count, lower
        if count > 0:
            known = False
            for m in range(count):
                known |= pick[m, 0] == i and pick[m, 1] == j
            if known or square - along <= ROUNDING * square:
                break
        w[count, 0], w[count, 1], w[count, 2] = wx, wy, wz
        pick[count, 0], pick[count, 1] = i, j
        nearer = on_simplex(w, count + 1, weight)
        if nearer < 0.0:
            return INSIDE, keep(w, pick, weight, share, count + 1), 0.0
        if nearer >= square:
            # To rounding as near: the direction may still become better.
            stalls += 1
            if nearer > square * (1.0 + ROUNDING) or stalls > MOST_STALLS:
                break
        count, square = keep(w, pick, weight, share, count + 1), nearer
        x, y, z = nearest_point(w, share, count)
        v[0], v[1], v[2] = x, y, z
        if square == 0.0:
            return APART, count, 0.0
    return APART, count, lower


def warm() -> None:
    """Call the kernel once (``course.jit``)."""
    a, b = np.zeros((1, 3)), np.ones((1, 3))
    room = np.zeros((4, 3)), np.zeros((4, 2), np.intp), np.zeros(4), np.zeros(4)
    gjk_distance(a, 1, b, 1, np.ones(3), math.inf, *room)
