"""Lesson 16: the quadratic programme of the slide, in cvxpy."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import Any

import numpy as np

from course import formulas
from course.exercises.definition import Case, Exercise, Mistake, Property, Value
from course.exercises.definitions.lesson_16_contact_forces.shared import (
    LEVER,
    PAIR,
    ROW,
    TWICE,
    A,
    B,
    drawn_system,
    pulled_open,
)
from course.exercises.slips import slip

#: Singular but for its last digits: they leave an eigenvalue of -1e-9, which cvxpy
#: takes for a real one.
ROUNDED = np.array([[1e4, 1e4], [1e4, 1e4 - 2e-9]])
DOWN = np.array([-9.81, -9.81])


# A mistake that changes what the programme asks is written by what then comes out. An
# edit of the formula would say it as well, but the judge would wait for cvxpy eight
# times for each. Those that cvxpy refuses are edits.


def _solution(a: Any, b: Any) -> np.ndarray:
    """The least forces that solve; the shift makes them unique without being seen."""
    from course.contact.solvers.pivot import solve_pivot

    return solve_pivot(np.asarray(a) + 1e-11 * np.trace(a) * np.eye(len(b)), b).force


def _unlimited(a: Any, b: Any) -> np.ndarray:
    return np.linalg.lstsq(a, -np.asarray(b), rcond=1e-12)[0]


def _forced(a: Any, b: Any) -> Any:
    """What cvxpy leaves where d_ddot = 0 is a limit as well: None where no f >= 0 meets
    it.
    """
    f = _solution(a, b)
    return (
        f
        if np.abs(np.asarray(a) @ f + b).max() < 1e-6 * max(1.0, np.abs(b).max())
        else None
    )


def _least_squares(a: Any, b: Any) -> np.ndarray:
    return _solution(np.asarray(a) @ a, np.asarray(a) @ b)


def _limited_by_contacts(a: Any, b: Any) -> np.ndarray:
    """The least q with A f <= b: f = f_unlimited - y, where y solves the three
    conditions for A and 2 b.
    """
    return _unlimited(a, b) - _solution(a, 2.0 * np.asarray(b))


def _quadratic_programmes(rng: np.random.Generator) -> Sequence[Case]:
    drawn = drawn_system(rng, 3)[0]
    down = -np.round(rng.uniform(2, 9, 3), 1)
    down[0] = -20.0  # much more than the others, of which one may lift
    return [
        Case("a book of 1.5 kg", {"a": np.array([[1 / 1.5]]), "b": np.array([-9.81])}),
        Case("two contacts", {"a": PAIR, "b": np.array([-1.0, -1.0])}),
        Case("one foot lifts", {"a": LEVER, "b": np.array([-1.0, -2.0])}),
        Case("three contacts in a row", {"a": ROW, "b": np.array([-9.0, -1.0, -2.0])}),
        Case("three drawn contacts", {"a": drawn, "b": down}),
        Case("nothing pushes", {"a": PAIR, "b": np.array([0.5, 0.2])}, "edge"),
        Case(
            "one contact given twice",
            {"a": TWICE, "b": np.array([-9.81, -9.81])},
            "edge",
        ),
        Case(
            "a crumb of 0.1 g, its contact given twice and A rounded",
            {"a": ROUNDED, "b": DOWN},
            "edge",
        ),
        *pulled_open(rng),
    ]


def _rows(given: Mapping[str, Any], f: Any) -> tuple[Any, Any]:
    """D f and w, over max |b|."""
    a, b = given["a"], given["b"]
    if np.shape(f) != np.shape(b):
        raise ValueError("another shape")
    return np.diagonal(a) * f / np.abs(b).max(), (a @ f + b) / np.abs(b).max()


#: Clarabel comes within 2e-7 of max |b| with f >= 0 alone, and within 5e-4 where a student also writes d_ddot >= 0 as
#: a limit, which is right but repeats what comes out anyway: it then only loses digits, most of them where a contact
#: is given twice and A is rounded. Every planted mistake is off by a hundredth or more.
NEAR = 1e-3

CONDITIONS = (
    Property("f >= 0", lambda given, f: np.minimum(_rows(given, f)[0], 0),
             "A force is below 0: a contact that pulls.", NEAR),
    Property("d_ddot >= 0", lambda given, f: np.minimum(_rows(given, f)[1], 0),
             "d_ddot = A f + b is below 0: bodies sink into each other.", NEAR),
    Property("f d_ddot = 0", lambda given, f: np.maximum(np.minimum(*_rows(given, f)), 0),
             "A contact pushes, f > 0, where the bodies part, d_ddot > 0.", NEAR),
)  # fmt: skip

SOLVE_CONTACT_QP = Exercise(
    name="solve_contact_qp",
    rows=(25,),
    points=3,
    minutes=12,
    task="Return the f that minimises f'A f/2 + b'f subject to f >= 0, by cvxpy with the solver CLARABEL.",
    arguments=(A, B),
    results=(Value("f", "(c,)", "N", "contact forces", relative=5e-4, absolute=5e-4),),
    reference=formulas.solve_contact_qp,
    judged_by="properties",
    sample=lambda a, b: np.zeros(len(b)),
    properties=CONDITIONS,
    cases=_quadratic_programmes,
    mistakes=(
        Mistake("not limited", _unlimited,
                "f is not limited to f >= 0: this is the force that makes every d_ddot = 0, and some contacts pull."),
        Mistake("clamped after solving", lambda a, b: np.maximum(_unlimited(a, b), 0.0),
                "Solved without the limit, and what pulled set to 0 afterwards. The other forces were found for "
                "a contact that pulls, and do not fit once it is gone. The limit belongs in the programme."),
        Mistake("the lowest q", lambda a, b: 0.5 * np.dot(b, _solution(a, b)),
                "One number came: solve() returns the lowest q. The forces are in the variable: its .value."),
        Mistake("d_ddot = 0 as a limit", _forced,
                "With d_ddot = 0 as a limit there may be no f >= 0 at all; cvxpy then leaves None in f.value. It is "
                "f d_ddot = 0 that holds, and it comes out by itself."),
        Mistake("half forgotten", lambda a, b: 0.5 * _solution(a, b),
                "All forces are half of what they should be: the 1/2 before f'A f is missing, so its slope is 2 A f."),
        Mistake("sign of b", lambda a, b: _solution(a, -np.asarray(b)),
                "The sign of b is reversed: the objective has + b'f."),
        Mistake("f <= 0", lambda a, b: -_solution(a, -np.asarray(b)),
                "The limit is reversed: f <= 0. On the slide's form A x <= b it is -f <= 0."),
        Mistake("A and b of the contacts in the limit", _limited_by_contacts,
                "The limit is A f <= b with the A and b of the contacts. The slide's letters mean two things: the "
                "limit on the forces is -f <= 0."),
        Mistake("A and b of the contacts in a second limit",
                slip(formulas.solve_contact_qp, "[f >= 0]", "[f >= 0, a @ f <= b]"),
                "Where None came, no f meets all your limits: cvxpy then leaves None in f.value. f >= 0 is the only "
                "limit. The slide's A x <= b says that as -f <= 0: its letters are not those of the contacts."),
        Mistake("as printed", lambda a, b: np.zeros(len(b)),
                "f = 0 everywhere: it satisfies f >= 0 and f d_ddot = 0, and all that lies on something falls through. "
                "A constraint f <= 0 may end here too."),
        Mistake("least squares of d_ddot", _least_squares,
                "You minimise |A f + b|^2, which makes the d_ddot small. It is f'A f/2 + b'f whose slope is d_ddot; "
                "where a foot lifts, d_ddot is to be above 0, not small."),
        Mistake("A left out", lambda a, b: np.maximum(-np.asarray(b), 0.0),
                "The quadratic part is f.f/2, without A: every contact is treated as a body of 1 kg by itself."),
        Mistake("numpy's dot", slip(formulas.solve_contact_qp, "b @ f", "np.dot(b, f)"),
                "The error speaks of a sequence: np.dot does not know cvxpy's variables. The linear term is b @ f."),
        Mistake("numpy's sum", slip(formulas.solve_contact_qp, "b @ f", "np.sum(cp.multiply(b, f))"),
                "np.sum does not know cvxpy's variables. The linear term is b @ f, or cp.sum(cp.multiply(b, f))."),
        Mistake("f'A f written out",
                slip(formulas.solve_contact_qp, "cp.quad_form(f, cp.psd_wrap(a))", "f.T @ a @ f"),
                "cvxpy does not see that f.T @ a @ f is convex, and refuses it (DCP: its rules for convex programmes). "
                "Write it as cp.quad_form(f, cp.psd_wrap(a))."),
        Mistake("no promise", slip(formulas.solve_contact_qp, "cp.psd_wrap(a)", "a"),
                "psd_wrap is missing. Where contacts are redundant A has an eigenvalue 0, and rounding may leave it "
                "just below: cvxpy then refuses the programme, unless cp.psd_wrap(a) promises that all is well."),
        Mistake("each contact alone", lambda a, b: np.maximum(-np.asarray(b) / np.diagonal(a), 0.0),
                "Only the diagonal of A is used: each contact is solved as if there were no other."),
    ),
    hints=(
        "Four steps: a variable, an objective, one constraint, solve. Your function returns f.value.",
        "f = cp.Variable(len(b)). The objective is cp.Minimize(...) of half cp.quad_form(f, cp.psd_wrap(a)) plus "
        "b @ f. The list of constraints holds f >= 0.",
        "f = cp.Variable(len(b))\nobjective = cp.Minimize(____ * cp.quad_form(f, cp.psd_wrap(a)) + b @ f)\n"
        "cp.Problem(objective, [____]).solve(solver=cp.CLARABEL)\nreturn f.value",
    ),
)  # fmt: skip
