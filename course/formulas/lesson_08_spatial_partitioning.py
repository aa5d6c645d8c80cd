"""Lesson 08, Spatial partitioning: space cut into cells, halves and spheres.

Boxes stand along the axes. What lies on a cut belongs to both sides: nothing is lost,
and pairs that are found twice are told once.
"""

import numpy as np


def expected_cells(s, c):
    """How many cells of a grid a cube meets on average, as an expression.

    (1 + s/c)^3    (syllabus row 13)

    side s of the cube [m] and c of the cells [m]; returns a number [1].
    Source: along each axis the cube, put down anywhere, holds s/c borders of cells.
    """
    return (1 + s / c) ** 3


def grid_cells(lower, upper, size):
    """The cells of a grid that a box meets.

    floor(l/h) <= k <= floor(u/h) on each axis    (syllabus row 13)

    lower, upper (3,) [m], size h of a cell [m]; returns (m, 3) ints, sorted.
    Source: Ericson, "Real-Time Collision Detection", section 7.1.
    """
    first = np.floor(lower / size).astype(int)
    last = np.floor(upper / size).astype(int)
    axes = [np.arange(a, b + 1) for a, b in zip(first, last, strict=True)]
    return np.stack(np.meshgrid(*axes, indexing="ij"), axis=-1).reshape(-1, 3)


def split_kd(lower, upper, axis, at):
    """Which boxes lie on either side of a cut across one axis.

    below: l_a <= c, above: u_a >= c    (syllabus row 13)

    lower, upper (n, 3) [m], axis 0, 1 or 2, at c [m]; returns the numbers of the boxes
    below and above, ints, ascending; a box that the cut meets is in both.
    Source: Ericson, "Real-Time Collision Detection", section 7.3.7.
    """
    return np.flatnonzero(lower[:, axis] <= at), np.flatnonzero(upper[:, axis] >= at)


def split_bsp(lower, upper, normal, offset):
    """Which boxes lie on either side of a plane in any direction.

    n.c - o against r = |n_x| e_x + |n_y| e_y + |n_z| e_z    (syllabus row 13)

    lower, upper (n, 3) [m], normal (3,) of length 1, offset o [m] of the plane n.x = o;
    returns the numbers of the boxes behind it, n.x <= o, and before it, ints, ascending;
    a box that the plane meets is in both.
    Source: Ericson, "Real-Time Collision Detection", sections 5.2.3 and 8.3.
    """
    distance = (lower + upper) / 2 @ normal - offset
    reach = (upper - lower) / 2 @ np.abs(normal)
    return np.flatnonzero(distance <= reach), np.flatnonzero(distance >= -reach)


def sphere_tree_levels(centers, radii):
    """A tree of spheres from its leaves up: each sphere of a level holds two of the last.

    r = (r_1 + r_2 + d)/2, c = c_1 + (r - r_1)(c_2 - c_1)/d; the larger one alone where it
    holds the other, d <= |r_1 - r_2|    (syllabus row 13)

    centers (n, 3) [m], radii (n,) [m], n a power of 2, neighbours beside each other;
    returns centres (2 n - 1, 3) and radii (2 n - 1,) of all levels, the leaves first.
    Source: Ericson, "Real-Time Collision Detection", section 6.5.2; Hubbard, "Collision
    Detection for Interactive Graphics Applications", 1995.
    """
    levels = [(centers, radii)]
    while len(radii) > 1:
        swap = (radii[1::2] > radii[::2])[:, None]
        one, two = centers[::2], centers[1::2]
        large, small = np.where(swap, two, one), np.where(swap, one, two)
        r, least = (
            np.maximum(radii[::2], radii[1::2]),
            np.minimum(radii[::2], radii[1::2]),
        )
        d = np.linalg.norm(small - large, axis=-1)
        radii = np.maximum(r, (r + least + d) / 2)
        share = (radii - r) / np.where(d > 0, d, 1.0)
        centers = large + share[:, None] * (small - large)
        levels.append((centers, radii))
    return tuple(np.concatenate(parts) for parts in zip(*levels, strict=True))
