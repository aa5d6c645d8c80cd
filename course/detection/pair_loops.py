"""What the loops of all broad phases share: the test of two boxes, lists that grow, sorted pairs.

Boxes are rows of one array (n, 6) here, l in the first three columns and u in the last
three, so that one box is one piece of memory. What is found is collected in an array
(capacity, 2) that doubles when it is full.

A kernel module (``course.jit``): import it where it is called.
"""

from __future__ import annotations

from typing import Any

import numpy as np
from numpy.typing import NDArray

from course.arrays import Array
from course.jit import compiled

#: Whole numbers of any width, as the kernels of all broad phases take and give them.
Whole = NDArray[Any]

#: Above this length a row of partners is sorted by NumPy, below it by insertion.
SHORT = 32
#: Bits of a key that one pass of the radix sort looks at.
DIGIT = 11


@compiled
def overlap(a: Array, i: int, b: Array, j: int) -> bool:
    """Whether box i of a and box j of b have a point in common: l_a <= u_b and l_b <= u_a on each axis.

    All six comparisons, joined by &: a processor guesses wrongly where ``and`` ends them.
    """
    return (
        (a[i, 0] <= b[j, 3])
        & (b[j, 0] <= a[i, 3])
        & (a[i, 1] <= b[j, 4])
        & (b[j, 1] <= a[i, 4])
        & (a[i, 2] <= b[j, 5])
        & (b[j, 2] <= a[i, 5])
    )


@compiled
def new_list(n: int) -> Whole:
    """Room for the first pairs of n boxes, (capacity, 2)."""
    return np.empty((2 * n + 16, 2), dtype=np.int32)


@compiled
def room_for(found: Whole, count: int) -> Whole:
    """The list itself if one more pair fits behind the first ``count``, else a copy twice as long."""
    if count < found.shape[0]:
        return found
    longer = np.empty((2 * count + 16, 2), dtype=found.dtype)
    longer[:count] = found
    return longer


@compiled
def sort_row(row: Whole) -> None:
    """Sort a few whole numbers in place, by insertion where they are few."""
    if row.size > SHORT:
        row[:] = np.sort(row)
        return
    for k in range(1, row.size):
        value, place = row[k], k
        while place > 0 and row[place - 1] > value:
            row[place] = row[place - 1]
            place -= 1
        row[place] = value


@compiled
def sorted_pairs(found: Whole, n: int) -> Whole:
    """Pairs of n boxes, each found once and either way round, as (m, 2) with i < j, sorted.

    A counting sort by i; then each i sorts its own few partners.
    """
    m = found.shape[0]
    start = np.zeros(n + 2, dtype=np.int64)
    for k in range(m):
        start[min(found[k, 0], found[k, 1]) + 2] += 1
    for i in range(2, n + 2):
        start[i] += start[i - 1]
    partner = np.empty(m, dtype=found.dtype)
    for k in range(m):
        i = min(found[k, 0], found[k, 1])
        partner[start[i + 1]] = max(found[k, 0], found[k, 1])
        start[i + 1] += 1
    pairs = np.empty((m, 2), dtype=np.intp)
    for i in range(n):
        begin, end = start[i], start[i + 1]
        if end - begin > 1:
            sort_row(partner[begin:end])
        for k in range(begin, end):
            pairs[k, 0] = i
            pairs[k, 1] = partner[k]
    return pairs


@compiled
def radix_order(keys: Whole, bits: int) -> Whole:
    """The stable order of whole numbers from 0 below 2^bits, by their digits, the lowest first.

    Source: Knuth, *The Art of Computer Programming*, volume 3, section 5.2.5.
    """
    n, buckets = keys.size, 1 << DIGIT
    key, order = keys.copy(), np.arange(n).astype(np.int32)
    next_key, next_order = np.empty_like(key), np.empty_like(order)
    for shift in range(0, bits, DIGIT):
        place = np.zeros(buckets + 1, dtype=np.int64)
        for k in range(n):
            place[((key[k] >> shift) & (buckets - 1)) + 1] += 1
        for b in range(buckets):
            place[b + 1] += place[b]
        for k in range(n):
            digit = (key[k] >> shift) & (buckets - 1)
            next_key[place[digit]], next_order[place[digit]] = key[k], order[k]
            place[digit] += 1
        key, next_key = next_key, key
        order, next_order = next_order, order
    return order


def warm() -> None:
    """Call the kernels once (``course.jit``)."""
    sorted_pairs(np.array([[1, 0]], dtype=np.int32), 2)
    radix_order(np.zeros(2, dtype=np.int64), 22)
