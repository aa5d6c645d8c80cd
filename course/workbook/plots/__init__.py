"""Pictures of results: ``plots.<what>(result, *, ax=None) -> Axes``.

Every function draws into ``ax`` (a new one in the house's style when none is given),
writes the alternative text of what it drew, and returns the Axes, so that a student can
go on drawing. Nothing is worked out here: results come from ``course.study`` and from
the closed forms of ``course.dynamics``. ``plots.show()`` shows what was drawn.
"""

from course.workbook.plots.ball_impacts import ball_row, billiard_break, impact
from course.workbook.plots.bar_and_plank import (
    contact_velocities,
    marked_point,
    turning_pair,
)
from course.workbook.plots.blocks import block_paths, blocks_and_wall, velocity_circle
from course.workbook.plots.bounces import (
    bouncing_errors,
    energy_over_time,
    heights,
    reflection,
)
from course.workbook.plots.box_landings import (
    box_outcomes,
    mass_over_face,
    spins_by_order,
)
from course.workbook.plots.colliders import collider_kinds, turned_box
from course.workbook.plots.contact_matrix import (
    matrix_costs,
    matrix_pattern,
    pushed_table,
)
from course.workbook.plots.corners import passing_a_corner
from course.workbook.plots.difference_quotients import (
    difference_errors,
    errors_by_looks,
)
from course.workbook.plots.domes import dome, dome_bias, old_point
from course.workbook.plots.error_and_cost import work_precision
from course.workbook.plots.figure import (
    PALETTE,
    axes,
    describe,
    figure_html,
    show,
    side_by_side,
    style,
)
from course.workbook.plots.ladders import ladder_forces, ladder_picture
from course.workbook.plots.maps import course_map, falling_boxes
from course.workbook.plots.motion import energies, energy_contours, seen_from_body
from course.workbook.plots.moving import point_and_sphere
from course.workbook.plots.overlap_tests import foot_of_point, number_steps
from course.workbook.plots.rods import (
    rod_impact,
    rod_impulses,
    rod_on_pegs,
    spin_by_pegs,
)
from course.workbook.plots.separating import difference_body, notch
from course.workbook.plots.solver_comparison import leg_forces, solver_growth
from course.workbook.plots.sweeps import stability_sweep
from course.workbook.plots.terms_of_b import bias_terms
from course.workbook.plots.tightness import tightness_against_cost
from course.workbook.plots.two_contacts import force_plane, plank_and_forces

__all__ = [
    "PALETTE",
    "axes",
    "ball_row",
    "bias_terms",
    "billiard_break",
    "block_paths",
    "blocks_and_wall",
    "bouncing_errors",
    "box_outcomes",
    "collider_kinds",
    "contact_velocities",
    "course_map",
    "describe",
    "difference_body",
    "difference_errors",
    "dome",
    "dome_bias",
    "energies",
    "energy_contours",
    "energy_over_time",
    "errors_by_looks",
    "falling_boxes",
    "figure_html",
    "foot_of_point",
    "force_plane",
    "heights",
    "impact",
    "ladder_forces",
    "ladder_picture",
    "leg_forces",
    "marked_point",
    "mass_over_face",
    "matrix_costs",
    "matrix_pattern",
    "notch",
    "number_steps",
    "old_point",
    "passing_a_corner",
    "plank_and_forces",
    "point_and_sphere",
    "pushed_table",
    "reflection",
    "rod_impact",
    "rod_impulses",
    "rod_on_pegs",
    "seen_from_body",
    "show",
    "side_by_side",
    "solver_growth",
    "spin_by_pegs",
    "spins_by_order",
    "stability_sweep",
    "style",
    "tightness_against_cost",
    "turned_box",
    "turning_pair",
    "velocity_circle",
    "work_precision",
]
