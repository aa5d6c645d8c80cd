"""Contact manifolds: all points at which two convex solids can bear on one another.

What one point does as the bodies move is decided by the two features that meet in it, so
every point has its own label, normal, separation and key (``labels`` says why):

    patches      the face, edge or vertex of each solid that looks along the normal
    references   which normal that is, where several directions are as good
    clipping     where two polygons overlap, each corner named by what makes it
    meeting      which features meet: a polygon, a crossing, two ends, or one point
    labels       of each point N, d, the word for it and what goes with the word
    thinning     at most so many points: the deepest and the widest
    loops        all that for many pairs;  box_loops, box_patches: for boxes, faster
    points       the call and its arrays;  box_points: for boxes

**Keys do not shake.** What is decided by comparing is decided with a bias of ``BIAS`` (1e-6)
times the smaller solid, always the same way: a vertex that close to a border is inside,
two vertices that close are one (that of the upper solid), a face that close to being the
direction of least depth is it. A face or an edge belongs to the manifold with all its
corners if it leans by less than ``FLAT_ANGLE`` (0.02 rad); of these points those with
d <= margin are kept, so that the angle decides nothing that the margin does not. Which of
two faces was the reference, or which of two solids is called A, decides nothing either.
"""

from course.overlap.manifold.box_points import box_contact_points
from course.overlap.manifold.points import Manifolds, contact_points

__all__ = ["Manifolds", "box_contact_points", "contact_points"]
