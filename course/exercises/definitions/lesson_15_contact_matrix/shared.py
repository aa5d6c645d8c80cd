"""What the exercises of this lesson share: values, draws, small algebra."""

from __future__ import annotations

from course.exercises.definition import Value

# contact_matrix_entry and contact_matrix: the slips that both can have, in words.

TOGETHER = (
    ("sign of body B", {"sign_b": 1.0}, "Body B is pushed along -N_j, and its motion is subtracted in d: B has the "
     "opposite sign, both when it is pushed and when it answers."),
    ("body B forgotten", {"meet": lambda i, j: i == j == 0}, "Body B is missing. It may be a body that moves: it is "
     "pushed as hard as A and answers as well."),
    ("A with A, B with B", {"meet": lambda i, j: i == j}, "A body can be A of one contact and B of the other, like the "
     "middle box of a stack: such pairs are missing."),
    ("one arm for both bodies", {"arms": lambda p, q, x, x_a, _: (p - x_a, q - x_a)}, "The arms of A are used for B "
     "too. Each body has its own arm, from its own centre: r = p - x."),
    ("A's arm for both bodies of a contact", {"arms": lambda p, q, x, x_a, x_a_j: (p - x_a, q - x_a_j)}, "You measure "
     "the arm of body B from the centre of A. A contact has two arms, one from the centre of each of its bodies."),
    ("arms from the origin", {"arms": lambda p, q, x, x_a, _: (p, q)}, "Your arms are places of points. They are "
     "measured from the centre of mass: r = p - x."),
    ("one point for both", {"arms": lambda p, q, x, x_a, _: (q - x, q - x)}, "Both arms go to the point that is "
     "pushed. The answer is that of the other contact's point, r_i = p_i - x."),
    ("no turning", {"turning": 0.0}, "Only N_i.N_j/m is there. A push off the centre turns the body, and the turning "
     "moves the other point."),
    ("mass forgotten", {"divided": False}, "The mass is missing in the first part: N_i.N_j/m."),
    ("a cross product turned round", {"turning": -1.0}, "The part that turns has the wrong sign. With r_i x N_i and "
     "r_j x N_j on both sides of I^-1 there is no minus."),
    ("inertia in body axes", {"frame": "body"}, "The inverse inertia is given in body axes and used as if in world "
     "axes: R I^-1 R' with the rotation of the body."),
    ("rotation turned round", {"frame": "back"}, "You have R' I^-1 R, which turns world axes into body axes. It is "
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
