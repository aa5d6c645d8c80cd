"""Lesson 03, Bounding volume hierarchies: boxes around boxes, and what a question to
them costs.

A tree is three arrays: its nodes' bounds, lower and upper (m, 3) [m], and children (m, 2)
ints, which stand behind their parent; a leaf has (-1, k) and bounds box k. Node 0 is the
root.
"""

import numpy as np


def break_even(n):
    """The share p at which one cut of n boxes costs what it saves, as an expression.

    2 + p n = n:  p = 1 - 2/n    (syllabus row 8)

    Both halves are tested, 2, and the n/2 boxes of each with the probability p, instead
    of all n. n of boxes [1]; returns p [1].
    Source: Ericson, "Real-Time Collision Detection", section 6.1.
    """
    return 1 - 2 / n


def enclose(lower, upper):
    """The smallest box along the axes around some.

    l = min l_k, u = max u_k    (syllabus row 8)

    lower, upper (..., n, 3) [m]; returns lower and upper (..., 3) [m].
    Source: Ericson, "Real-Time Collision Detection", section 6.5.
    """
    return np.min(lower, axis=-2), np.max(upper, axis=-2)


def median_split(lower, upper):
    """The two halves of some boxes, by their centres along the axis on which these are
    farthest apart.

    n // 2 boxes with the smallest c_a, the others,  a = argmax (max c - min c)
    (syllabus row 8)

    lower, upper (n, 3) [m]; returns the numbers of the boxes of each half, ints, in the
    order of their centres.
    Source: Ericson, "Real-Time Collision Detection", section 6.2.1.
    """
    center = (lower + upper) / 2
    axis = np.argmax(np.max(center, axis=0) - np.min(center, axis=0))
    order = np.argsort(center[:, axis], kind="stable")
    return order[: len(order) // 2], order[len(order) // 2 :]


def query_tree(children, lower, upper, query_lower, query_upper):
    """Which boxes of a tree meet a box, and how many tests that took.

    test a node; if it meets the box, ask its children    (syllabus row 8)

    children (m, 2) ints, lower, upper (m, 3) [m], query_lower, query_upper (3,) [m];
    returns the numbers of the boxes, ascending, and the tests, at most 2 n - 1 for n boxes.
    Source: Ericson, "Real-Time Collision Detection", section 6.3.
    """
    found, tests, waiting = [], 0, [0]
    while waiting:
        node = waiting.pop()
        tests += 1
        apart = (lower[node] > query_upper) | (upper[node] < query_lower)
        if not np.any(apart):
            left, right = children[node]
            if left < 0:
                found.append(right)
            else:
                waiting += [left, right]
    return np.array(sorted(found), dtype=int), tests


def surface_area_cost(lower, upper):
    """What a cut of a row of boxes costs, in expected tests, for every place of the cut.

    C_k = (A_k k + B_k (n - k))/A    (syllabus row 8)

    A, A_k and B_k are the surface areas of the boxes around all, around the first k and
    around the others: a small box that meets the whole meets a part with about the
    probability of the areas' ratio.

    lower, upper (n, 3) [m]; returns (n - 1,), of k = 1 to n - 1.
    Source: Goldsmith and Salmon, "Automatic Creation of Object Hierarchies for Ray
    Tracing", 1987.
    """

    def areas(lower, upper):
        x, y, z = np.moveaxis(
            np.maximum.accumulate(upper) - np.minimum.accumulate(lower), -1, 0
        )
        return 2 * (x * y + y * z + z * x)

    first, last = areas(lower, upper), areas(lower[::-1], upper[::-1])[::-1]
    k = np.arange(1, len(lower))
    return (first[:-1] * k + last[1:] * (len(lower) - k)) / first[-1]


def refit(children, lower, upper):
    """The bounds of a tree whose leaves have moved, from the leaves up.

    l = min(l_left, l_right), u = max(u_left, u_right)    (syllabus row 8)

    children (m, 2) ints, lower, upper (m, 3) [m], those of the leaves right; returns both
    (m, 3) [m].
    Source: van den Bergen, "Efficient Collision Detection of Complex Deformable Models
    using AABB Trees", 1997.
    """
    lower, upper = lower.copy(), upper.copy()
    for node in reversed(range(len(children))):
        if children[node, 0] >= 0:
            lower[node] = np.min(lower[children[node]], axis=0)
            upper[node] = np.max(upper[children[node]], axis=0)
    return lower, upper
