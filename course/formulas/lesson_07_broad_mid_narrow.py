"""Lesson 07, Broad, mid and narrow phase: which of many boxes meet, with how few tests.

Boxes stand along the axes; boxes that touch meet. Pairs are rows (i, j) with i < j, sorted.
"""

import numpy as np


def axis_share(s, L):
    """The share of pairs whose shadows on one axis overlap, as an expression.

    P(|x - y| <= s) = 1 - (1 - s/L)^2    (syllabus row 13)

    for centres x, y that are anywhere between 0 and L; boxes of side s [m], L [m];
    returns P [1].
    Source: the area of the square [0, L]^2 without its two corners, over L^2.
    """
    return 1 - (1 - s / L) ** 2


def all_pairs(lower, upper):
    """The pairs of boxes that meet, by brute force.

    l_i <= u_j and l_j <= u_i on every axis, for all i < j    (syllabus row 13)

    lower, upper (n, 3) [m]; returns pairs (m, 2), ints.
    Source: Ericson, "Real-Time Collision Detection", section 4.2.1.
    """
    meets = (lower[:, None] <= upper) & (lower <= upper[:, None])
    return np.argwhere(np.triu(np.all(meets, axis=-1), 1))


def sweep_and_prune(order, lower, upper):
    """The pairs of boxes that meet, by a sweep along x, and how many were tested.

    in the order of l_x, test i with those after it until l_x > u_x of i
    (syllabus row 13)

    order (n,) ints, the boxes by ascending lower x; lower, upper (n, 3) [m]; returns pairs
    (m, 2), ints, and the number of tests of two boxes.
    Source: Ericson, "Real-Time Collision Detection", section 7.5.
    """
    pairs, tests = [], 0
    for place, i in enumerate(order):
        for j in order[place + 1 :]:
            if lower[j, 0] > upper[i, 0]:
                break
            tests += 1
            if np.all(lower[i] <= upper[j]) and np.all(lower[j] <= upper[i]):
                pairs.append((min(i, j), max(i, j)))
    return np.array(sorted(pairs), dtype=int).reshape(-1, 2), tests


def resort_swaps(order, keys):
    """The last step's order made right for new places, and how many swaps that took.

    while a neighbour on the left is larger, change places    (syllabus row 13)

    order (n,) ints, keys (n,) [m], one a box; returns the order by ascending keys, (n,)
    ints, and the swaps: as many as there are pairs in the wrong order.
    Source: Baraff, "Dynamic Simulation of Non-penetrating Rigid Bodies", 1992; Knuth, "The
    Art of Computer Programming" 3, section 5.2.1.
    """
    order, swaps = order.copy(), 0
    for place in range(1, len(order)):
        while place > 0 and keys[order[place - 1]] > keys[order[place]]:
            order[[place - 1, place]] = order[[place, place - 1]]
            place, swaps = place - 1, swaps + 1
    return order, swaps
