"""Which test serves which pair of kinds: the table that ``course.overlap.asking`` looks into.

It holds each pair of kinds once, the kinds in the order of ``KINDS``; shapes that come the
other way round change places. A compound has no row of its own: it is asked part by part.
docs/overlap.md is made from it.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, replace
from itertools import combinations_with_replacement
from typing import Any

from course.arrays import Array, BoolArray
from course.overlap import boxes, planes
from course.overlap.contact_arrays import Contacts
from course.overlap.convex import convex_pairs
from course.overlap.convex.closest import Closest
from course.overlap.curved import capsules, curved_contacts, spheres
from course.overlap.oriented_boxes import oriented_boxes_overlap
from course.shapes import Shape

#: The kinds in the table's order; two shapes are asked in this order.
KINDS = (
    "sphere", "capsule", "aabb", "obb", "kdop", "convex_hull", "half_space",
)  # fmt: skip


@dataclass(frozen=True)
class PairTest:
    """What serves a pair of kinds.

    Args:
        gap_by: how the gap is found, in words, for the table in docs/overlap.md.
        contacts_by: what the contacts are, in words.
        closest: (a, b) to the nearest points of the broadcast batch.
        contacts: (a, b, near, margin, limit) to the contacts of k pairs that are within
            the margin, ``pair`` counting those.
        overlaps: (a, b) to the verdict, where that is quicker than gap <= 0.
        gap: (a, b) to the gap, where that is quicker than the nearest points.
        all_contacts: (a, b, margin, limit) to the contacts of k pairs, near or not, where
            that is quicker than the nearest points first.
    """

    gap_by: str
    contacts_by: str
    closest: Callable[[Any, Any], Closest]
    contacts: Callable[[Any, Any, Closest, float, int | None], Contacts]
    overlaps: Callable[[Any, Any], BoolArray] | None = None
    gap: Callable[[Any, Any], Array] | None = None
    all_contacts: Callable[[Any, Any, float, int | None], Contacts] | None = None


#: What any two convex shapes are served by, and what their contacts are, by kind of the first.
CONVEX = PairTest(
    "distance by GJK, depth by EPA or separating axes",
    "corners of what lies against what",
    convex_pairs.closest_convex,
    convex_pairs.contacts_convex,
)
ROUND = {"sphere": "one", "capsule": "one, or the two ends of a common stretch"}
FLAT_ON_PLANE = PairTest(
    "support along the plane's normal",
    "the vertices within the margin",
    planes.closest_to_half_space,
    planes.contacts_of_polytope,
)

TABLE: dict[tuple[str, str], PairTest] = {
    ("sphere", "sphere"): PairTest(
        "distance of the centres", "one",
        spheres.closest_spheres, curved_contacts.contacts_of_spheres,
        spheres.two_spheres_overlap, spheres.two_spheres_gap,
    ),
    ("sphere", "capsule"): PairTest(
        "distance of the centre and a segment", "one",
        capsules.closest_sphere_capsule, curved_contacts.contacts_of_sphere_capsule,
    ),
    ("sphere", "aabb"): PairTest(
        "distance of the centre and its clamp to the box, or its inset", "one",
        boxes.closest_sphere_upright_box, convex_pairs.contacts_convex,
    ),
    ("sphere", "obb"): PairTest(
        "the same in the box's axes", "one",
        boxes.closest_sphere_box, convex_pairs.contacts_convex,
    ),
    ("capsule", "capsule"): PairTest(
        "distance of two segments", ROUND["capsule"],
        capsules.closest_capsules, convex_pairs.contacts_convex,
        gap=capsules.two_capsules_gap,
    ),
    ("aabb", "aabb"): PairTest(
        "gaps along the three axes", CONVEX.contacts_by,
        boxes.closest_upright_boxes, convex_pairs.contacts_convex,
        boxes.upright_boxes_overlap,
    ),
    ("obb", "obb"): replace(
        CONVEX, overlaps=oriented_boxes_overlap, all_contacts=convex_pairs.contacts_of_boxes
    ),
    ("sphere", "half_space"): PairTest(
        "height of the centre", "one",
        planes.closest_to_half_space, planes.contacts_of_sphere,
    ),
    ("capsule", "half_space"): PairTest(
        "height of the lower end", "the ends within the margin",
        planes.closest_to_half_space, planes.contacts_of_capsule,
    ),
    ("aabb", "half_space"): FLAT_ON_PLANE,
    ("obb", "half_space"): FLAT_ON_PLANE,
    ("kdop", "half_space"): FLAT_ON_PLANE,
    ("convex_hull", "half_space"): FLAT_ON_PLANE,
    ("half_space", "half_space"): PairTest(
        "finite only if they face each other", "none",
        planes.closest_half_spaces, planes.no_contacts,
    ),
}  # fmt: skip
for _pair in combinations_with_replacement(KINDS[:6], 2):
    _points = ROUND.get(_pair[0], CONVEX.contacts_by)
    TABLE.setdefault(_pair, replace(CONVEX, contacts_by=_points))


def served(a: Shape, b: Shape) -> tuple[PairTest, Shape, Shape, bool]:
    """The test of two shapes, the shapes in its order, and whether that is the other one."""
    if KINDS.index(a.kind) > KINDS.index(b.kind):
        return TABLE[b.kind, a.kind], b, a, True
    return TABLE[a.kind, b.kind], a, b, False


def table_in_markdown() -> str:
    """The table of docs/overlap.md."""
    rows = ["| A | B | gap | contacts |", "|---|---|---|---|"]
    for a, b in combinations_with_replacement(KINDS, 2):
        test = TABLE[a, b]
        names = (f"`{kind}`" for kind in (a, b))
        rows.append(f"| {' | '.join([*names, test.gap_by, test.contacts_by])} |")
    return "\n".join(rows)
