"""What the exercises of this lesson share: values, draws, small algebra."""

from __future__ import annotations

from course.exercises.definition import Value

# contact_matrix_entry and contact_matrix: the slips that both can have, as edits of the
# one and of the other, and in words. Where the matrix has None the slip is made in each
# of its entries.

ARMS = "point[i] - position[body], point[j] - position[body]"
TURNED = "@ inverse_inertia[body] @ rotation[body].T"
ALL_TURNED = "rotation @ inverse_inertia @ np.swapaxes(rotation, -1, -2)"

Edits = tuple[str, ...]
TOGETHER: tuple[tuple[str, Edits, Edits | None, str], ...] = (
    ("sign of body B", ("(body_b[i], -1)", "(body_b[i], 1)", "(body_b[j], -1)", "(body_b[j], 1)"),
     ("(body_b, -1)", "(body_b, 1)"), "Body B is pushed along -N_j, and its motion is subtracted in d: B has the "
     "opposite sign, both when it is pushed and when it answers."),
    ("body B forgotten", ("(body_a[i], 1), (body_b[i], -1)", "(body_a[i], 1),", "(body_a[j], 1), (body_b[j], -1)",
     "(body_a[j], 1),"), ("(body_a, 1), (body_b, -1)", "(body_a, 1),"),
     "Body B is missing. It may be a body that moves: it is "
     "pushed as hard as A and answers as well."),
    ("A with A, B with B", ("body == pushed", "body == pushed and sign == push_sign"), None,
     "A body can be A of one contact and B of the other, like the "
     "middle box of a stack: such pairs are missing."),
    ("one arm for both bodies", (ARMS, "point[i] - position[body_a[i]], point[j] - position[body_a[i]]"), None,
     "The arms of A are used for B "
     "too. Each body has its own arm, from its own centre: r = p - x."),
    ("A's arm for both bodies of a contact", (ARMS, "point[i] - position[body_a[i]], point[j] - position[body_a[j]]"),
     ("position[body]", "position[body_a]"), "You measure "
     "the arm of body B from the centre of A. A contact has two arms, one from the centre of each of its bodies."),
    ("arms from the origin", (ARMS, "point[i], point[j]"), ("point - position[body]", "point"),
     "Your arms are places of points. They are "
     "measured from the centre of mass: r = p - x."),
    ("one point for both", (ARMS, "point[j] - position[body], point[j] - position[body]"), None,
     "Both arms go to the point that is "
     "pushed. The answer is that of the other contact's point, r_i = p_i - x."),
    ("no turning", ("point_response(mass[body], world, arm, push_arm, push)", "push / mass[body]"),
     ("[normal, lever]", "[normal, 0 * lever]"),
     "Only N_i.N_j/m is there. A push off the centre turns the body, and the turning "
     "moves the other point."),
    ("mass forgotten", ("mass[body], world", "1.0, world"), (" / mass[:, None]", ""),
     "The mass is missing in the first part: N_i.N_j/m."),
    ("a cross product turned round", ("world, arm", "world, -arm"), (", turned]", ", -turned]"),
     "The part that turns has the wrong sign. With r_i x N_i and "
     "r_j x N_j on both sides of I^-1 there is no minus."),
    ("inertia in body axes", ("rotation[body] " + TURNED, "inverse_inertia[body]"), (ALL_TURNED, "inverse_inertia"),
     "The inverse inertia is given in body axes and used as if in world "
     "axes: R I^-1 R' with the rotation of the body."),
    ("rotation turned round", (" " + TURNED, ".T @ inverse_inertia[body] @ rotation[body]"),
     (ALL_TURNED, "np.swapaxes(rotation, -1, -2) @ inverse_inertia @ rotation"),
     "You have R' I^-1 R, which turns world axes into body axes. It is "
     "R I^-1 R'."),
)  # fmt: skip


CONTACTS = Value(
    "contacts",
    "(body_a, body_b, point, normal)",
    "",
    "which bodies (c,), p and N (c, 3)",
)
BODIES = Value("bodies", "(mass, inverse_inertia, rotation, position)", "",
               "(n,), I^-1 in body axes (n, 3, 3), R (n, 3, 3), x (n, 3)")  # fmt: skip
