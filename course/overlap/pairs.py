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
from course.overlap.moving import swept, swept_polytopes
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
        time_by: how the time of impact in straight motion is found, in words.
        closest: (a, b) to the nearest points of the broadcast batch.
        contacts: (a, b, near, margin, limit) to the contacts of k pairs that are within
            the margin, ``pair`` counting those.
        time: (a, b, velocity of A as seen from B, horizon) to the time of impact.
        overlaps: (a, b) to the verdict, where that is quicker than gap <= 0.
        gap: (a, b) to the gap, where that is quicker than the nearest points.
        all_contacts: (a, b, margin, limit) to the contacts of k pairs, near or not, where
            that is quicker than the nearest points first.
    """

    gap_by: str
    contacts_by: str
    time_by: str
    closest: Callable[[Any, Any], Closest]
    contacts: Callable[[Any, Any, Closest, float, int | None], Contacts]
    time: Callable[[Any, Any, Array, Array], Array]
    overlaps: Callable[[Any, Any], BoolArray] | None = None
    gap: Callable[[Any, Any], Array] | None = None
    all_contacts: Callable[[Any, Any, float, int | None], Contacts] | None = None


CORNERS, ENDS = (
    "corners of what lies against what",
    "one, or the two ends of a common stretch",
)
RAY, TO_PLANE = "a ray against the rounded sum", "support along the plane's normal"
#: What any two polytopes are served by.
CONVEX = PairTest(
    "distance by GJK, depth by EPA or separating axes", CORNERS, "all separating axes",
    convex_pairs.closest_convex, convex_pairs.contacts_convex, swept_polytopes.swept_convex,
)  # fmt: skip
#: And any two shapes of which the first is a sphere or a capsule.
BALL = replace(CONVEX, contacts_by="one", time_by=RAY)
ROD = replace(CONVEX, contacts_by=ENDS, time_by=RAY)
FLAT_ON_PLANE = PairTest(
    TO_PLANE, "the vertices within the margin", TO_PLANE,
    planes.closest_to_half_space, planes.contacts_of_polytope, swept.swept_to_half_space,
)  # fmt: skip

TABLE: dict[tuple[str, str], PairTest] = {
    ("sphere", "sphere"): PairTest(
        "distance of the centres", "one", "a ray against one sphere",
        spheres.closest_spheres, curved_contacts.contacts_of_spheres, swept.swept_spheres,
        spheres.two_spheres_overlap, spheres.two_spheres_gap,
    ),
    ("sphere", "capsule"): replace(
        BALL, gap_by="distance of the centre and a segment",
        closest=capsules.closest_sphere_capsule,
        contacts=curved_contacts.contacts_of_sphere_capsule,
    ),
    ("sphere", "aabb"): replace(
        BALL, gap_by="distance of the centre and its clamp to the box, or its inset",
        closest=boxes.closest_sphere_upright_box,
    ),
    ("sphere", "obb"): replace(
        BALL, gap_by="the same in the box's axes", closest=boxes.closest_sphere_box
    ),
    ("sphere", "kdop"): BALL,
    ("sphere", "convex_hull"): BALL,
    ("capsule", "capsule"): replace(
        ROD, gap_by="distance of two segments",
        closest=capsules.closest_capsules, gap=capsules.two_capsules_gap,
    ),
    ("capsule", "aabb"): ROD,
    ("capsule", "obb"): ROD,
    ("capsule", "kdop"): ROD,
    ("capsule", "convex_hull"): ROD,
    ("aabb", "aabb"): replace(
        CONVEX, gap_by="gaps along the three axes", time_by="the three axes",
        closest=boxes.closest_upright_boxes, time=swept.swept_upright_boxes,
        overlaps=boxes.upright_boxes_overlap,
    ),
    ("aabb", "obb"): replace(
        CONVEX, time_by="the fifteen axes", time=swept_polytopes.swept_boxes
    ),
    ("obb", "obb"): replace(
        CONVEX, time_by="the fifteen axes", time=swept_polytopes.swept_boxes,
        overlaps=oriented_boxes_overlap, all_contacts=convex_pairs.contacts_of_boxes,
    ),
    ("sphere", "half_space"): replace(
        FLAT_ON_PLANE, gap_by="height of the centre", contacts_by="one",
        contacts=planes.contacts_of_sphere,
    ),
    ("capsule", "half_space"): replace(
        FLAT_ON_PLANE, gap_by="height of the lower end",
        contacts_by="the ends within the margin", contacts=planes.contacts_of_capsule,
    ),
    ("aabb", "half_space"): FLAT_ON_PLANE,
    ("obb", "half_space"): FLAT_ON_PLANE,
    ("kdop", "half_space"): FLAT_ON_PLANE,
    ("convex_hull", "half_space"): FLAT_ON_PLANE,
    ("half_space", "half_space"): PairTest(
        "finite only if they face each other", "none", "the gap over its rate",
        planes.closest_half_spaces, planes.no_contacts, swept.swept_half_spaces,
    ),
}  # fmt: skip
for _pair in combinations_with_replacement(("aabb", "obb", "kdop", "convex_hull"), 2):
    TABLE.setdefault(_pair, CONVEX)


def served(a: Shape, b: Shape) -> tuple[PairTest, Shape, Shape, bool]:
    """The test of two shapes, the shapes in its order, and whether that is the other one."""
    if KINDS.index(a.kind) > KINDS.index(b.kind):
        return TABLE[b.kind, a.kind], b, a, True
    return TABLE[a.kind, b.kind], a, b, False


def table_in_markdown() -> str:
    """The table of docs/overlap.md."""
    rows = ["| A | B | gap | contacts | time of impact |", "|---|---|---|---|---|"]
    for a, b in combinations_with_replacement(KINDS, 2):
        test = TABLE[a, b]
        names = (f"`{kind}`" for kind in (a, b))
        rows.append(
            f"| {' | '.join([*names, test.gap_by, test.contacts_by, test.time_by])} |"
        )
    return "\n".join(rows)
