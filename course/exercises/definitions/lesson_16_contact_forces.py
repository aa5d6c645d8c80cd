"""Lesson 16: contact forces, from complementarity to a quadratic programme and its solvers."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import Any

import numpy as np

from course.exercises.definition import Case, Exercise, Lesson, Mistake, Prediction, Property, Value

PAIR = np.array([[1.0, 0.5], [0.5, 1.0]])
LEVER = np.array([[1.0, 0.75], [0.75, 1.0]])
TWICE = np.array([[0.5, 0.5], [0.5, 0.5]])
ROW = np.array([[2.0, 1.0, 0.2], [1.0, 2.0, 1.0], [0.2, 1.0, 2.0]])

A = Value("a", "(c, c)", "1/kg", "contact matrix, symmetric and positive semidefinite")
B = Value("b", "(c,)", "m/s^2", "d_ddot without contact forces")


def _apply(matrix: Any, vector: Any) -> Any:
    return np.einsum("...ij,...j->...i", matrix, vector)


def _system(rng: np.random.Generator, count: int) -> tuple[np.ndarray, np.ndarray]:
    """A positive definite A of three decimals and b of both signs: they are shown to students."""
    root = np.round(rng.uniform(-1, 1, (count, count + 1)), 1)
    a = np.round(root @ root.T + 0.3 * np.eye(count), 3)
    return a, np.round(rng.uniform(-9, 3, count), 1)


# slope_1, the student's step of the derivation


def _slope(*, own: float = 1.0, other: float = 1.0, sign: float = 1.0, bias: float = 1.0, power: int = 1) -> Any:
    """The slope of q along f_1 with one of its parts changed."""

    def function(a_11: Any, a_12: Any, f_1: Any, f_2: Any, b_1: Any) -> Any:
        return own * a_11 * f_1**power + other * a_12 * f_2 + sign * bias * b_1

    return function


def _slopes(rng: np.random.Generator) -> Sequence[Case]:
    names = ("a_11", "a_12", "f_1", "f_2", "b_1")
    draws = {name: np.round(rng.uniform(0.5, 3.0, 8), 2) for name in names}
    one = {"a_11": 2.0, "a_12": 0.5, "f_1": 3.0, "f_2": 4.0, "b_1": -9.0}
    return [Case("one pair of forces", one), Case("eight pairs", draws, "batch")]


SLOPE = Exercise(
    name="slope_1",
    kind="expression",
    rows=(25,),
    points=2,
    minutes=6,
    task="Give the derivative of q = (a_11 f_1^2 + 2 a_12 f_1 f_2 + a_22 f_2^2)/2 + b_1 f_1 + b_2 f_2 by f_1.",
    arguments=(
        Value("a_11", "scalar", "1/kg", "entry of A"),
        Value("a_12", "scalar", "1/kg", "entry of A, and its mirror image a_21"),
        Value("f_1", "scalar", "N", "force at contact 1"),
        Value("f_2", "scalar", "N", "force at contact 2"),
        Value("b_1", "scalar", "m/s^2", "entry of b"),
    ),
    results=(Value("slope_1", "(...)", "m/s^2", "how q changes with f_1"),),
    reference=_slope(),
    cases=_slopes,
    mistakes=(
        Mistake("half kept", _slope(own=0.5, other=0.5),
                "The half stays in front of A. The square brings a 2 down, and the mixed term stands twice."),
        Mistake("half of the mixed term", _slope(other=0.5),
                "Half of the mixed term is missing: a_12 and a_21 = a_12 both bring f_1 f_2."),
        Mistake("half forgotten", _slope(own=2.0, other=2.0),
                "The half in front of f'A f is forgotten: A comes out twice as large as it is."),
        Mistake("mixed term twice", _slope(other=2.0),
                "The mixed term is twice too large: the half before the bracket and the 2 in it cancel."),
        Mistake("square left standing", _slope(power=2), "f_1 still stands squared: the derivative of f_1^2 is 2 f_1."),
        Mistake("mixed term lost", _slope(other=0.0),
                "The mixed term is missing. It is how a force at contact 2 is felt at contact 1."),
        Mistake("b lost", _slope(bias=0.0), "b_1 is missing: the term b_1 f_1 is linear, its slope is b_1."),
        Mistake("sign of b", _slope(sign=-1.0), "The sign of b_1 is turned round: q has + b_1 f_1."),
        Mistake("half of the square", _slope(own=0.5, other=1.0), "The 2 of the square is lost: (f_1^2/2)' = f_1."),
    ),
    hints=(
        "Three terms of q hold f_1; the others do not change with it.",
        "The square gives twice the half, the mixed term loses its f_1 and keeps f_2, the linear term leaves b_1.",
        "slope_1 = a_11 * ____ + a_12 * ____ + b_1",
    ),
)  # fmt: skip


# complementarity_residual


def _residual(*, judge: Any = None, scale: Any = None, diagonal: bool = True, sign: float = 1.0, best: Any = None) -> Any:
    """The residual with one of its parts changed."""

    def function(a: Any, f: Any, b: Any) -> Any:
        d = np.diagonal(a, axis1=-2, axis2=-1) if diagonal else 1.0
        push, w = d * np.asarray(f), _apply(a, f) + sign * np.asarray(b)
        wrong = judge(push, w) if judge else np.abs(np.minimum(push, w))
        size, largest = _apply(np.abs(a), f), np.abs(b).max(axis=-1, keepdims=True)
        below = scale(a, f, size, largest) if scale else size + largest
        rows = np.divide(wrong, below, out=np.zeros(np.shape(wrong)), where=below > 0)
        return best(rows) if best else rows.max(axis=-1)

    return function


def _without_guard(a: Any, f: Any, b: Any) -> Any:
    w, d = _apply(a, f) + b, np.diagonal(a, axis1=-2, axis2=-1)
    scale = _apply(np.abs(a), f) + np.abs(b).max(axis=-1, keepdims=True)
    return np.max(np.abs(np.minimum(d * f, w)) / scale, axis=-1)


def _tried_forces(rng: np.random.Generator) -> Sequence[Case]:
    def draw(shape: tuple[int, ...] = (), count: int = 3) -> dict[str, Any]:
        systems = [_system(rng, count) for _ in range(int(np.prod(shape)))]
        a, b = (np.array([s[k] for s in systems]).reshape(*shape, *np.shape(systems[0][k])) for k in (0, 1))
        return {"a": a, "f": np.round(rng.uniform(0, 6, b.shape), 1), "b": b}

    down = np.array([-1.0, -1.0])
    return [
        Case("two contacts, one force too large", {"a": PAIR, "f": np.array([1.0, 0.5]), "b": down}),
        Case("no force: both sink in", {"a": 2 * PAIR, "f": np.zeros(2), "b": np.array([-1.0, -3.0])}),
        Case("three contacts", draw()),
        Case("a force where the bodies part", {"a": ROW, "f": np.array([0.0, 1.0, 4.0]), "b": np.array([-9.0, 2, 1])}),
        Case("solved", {"a": LEVER, "f": np.array([0.0, 2.0]), "b": np.array([-1.0, -2.0])}, "edge"),
        Case("b = 0 and no force", {"a": PAIR, "f": np.zeros(2), "b": np.zeros(2)}, "edge"),
        Case("five systems of three contacts", draw((5,)), "batch"),
        Case("a 2 by 3 batch", draw((2, 3), 2), "batch"),
    ]


COMPLEMENTARITY_RESIDUAL = Exercise(
    name="complementarity_residual",
    rows=(20, 25),
    points=3,
    minutes=12,
    task="Return max_i |min(D_i f_i, w_i)| / ((|A| f)_i + max_j |b_j|), w = A f + b, D = diag A; a row 0/0 counts as 0.",
    arguments=(
        Value("a", "(..., c, c)", "1/kg", "contact matrices"),
        Value("f", "(..., c)", "N", "forces to be judged, at or above 0"),
        Value("b", "(..., c)", "m/s^2", "d_ddot without contact forces"),
    ),
    results=(Value("residual", "(...)", "", "0 for a solution"),),
    reference=_residual(),
    cases=_tried_forces,
    mistakes=(
        Mistake("no abs", _residual(judge=np.minimum),
                "Without the absolute value a contact that sinks in, w < 0, has a residual below 0, and the largest one "
                "hides it."),
        Mistake("abs too early", _residual(judge=lambda p, w: np.minimum(np.abs(p), np.abs(w))),
                "The absolute values come too early: with f = 0 and w < 0 the smaller of |D f| and |w| is 0, and the "
                "contact sinks in unseen. First the minimum, then its absolute value."),
        Mistake("product", _residual(judge=lambda p, w: np.abs(p * w)),
                "You judge the product f w. It is 0 for f = 0 whatever w is: a contact that sinks in passes."),
        Mistake("no scale", _residual(scale=lambda a, f, size, largest: np.ones_like(size)),
                "The scale is missing: m/s^2 would be judged alike for a crumb and for a ship."),
        Mistake("scale without b", _residual(scale=lambda a, f, size, largest: size),
                "max |b| is missing in the scale. Without it a row with no forces has no scale at all."),
        Mistake("scale by A f", _residual(scale=lambda a, f, size, largest: np.abs(_apply(a, f)) + largest),
                "The scale has |A f|, where terms cancel. It is |A| f: the absolute value of each entry, then the sum."),
        Mistake("one scale for all rows", _residual(scale=lambda a, f, size, largest: size.max(-1, keepdims=True) + largest),
                "All rows have the largest scale. Each row is judged against its own terms; only max |b| is common."),
        Mistake("rows added up", _residual(scale=lambda a, f, size, largest: size + largest, best=lambda r: r.sum(axis=-1)),
                "You add the rows up. The residual is the worst of them."),
        Mistake("D missing", _residual(diagonal=False),
                "The minimum is taken of newtons and m/s^2. D_i f_i = a_ii f_i is in m/s^2, as w_i is."),
        Mistake("sign of b", _residual(sign=-1.0), "The sign of b: w = A f + b is the acceleration of the gaps."),
        Mistake("0/0", _without_guard,
                "0/0 where nothing pushes and b = 0: there the residual is 0. np.divide(x, y, out=np.zeros(...), "
                "where=y > 0) leaves such rows at 0."),
    ),
    hints=(
        "Under Build: four arrays first (D f, w, |A| f, the largest |b|), then one line.",
        "D is np.diagonal(a, axis1=-2, axis2=-1). A matrix times a vector in a batch is the einsum of lesson 14. The "
        "largest |b| needs keepdims=True to be added to every row.",
        'w = np.einsum("...ij,...j->...i", a, f) + b\nwrong = np.abs(np.minimum(d * f, ____))\n'
        'scale = np.einsum("...ij,...j->...i", ____, f) + np.abs(b).max(axis=-1, keepdims=True)\n'
        "rows = np.divide(wrong, scale, out=np.zeros(wrong.shape), where=scale > 0)\nreturn rows.max(axis=-1)",
    ),
)  # fmt: skip


# solve_contact_qp


def _solution(a: Any, b: Any) -> np.ndarray:
    """The least forces that solve; the shift makes them unique without being seen."""
    from course.contact.solvers.pivot import solve_pivot

    return solve_pivot(np.asarray(a) + 1e-11 * np.trace(a) * np.eye(len(b)), b).force


def _unlimited(a: Any, b: Any) -> np.ndarray:
    return np.linalg.lstsq(a, -np.asarray(b), rcond=1e-12)[0]


def _least_squares(a: Any, b: Any) -> np.ndarray:
    return _solution(np.asarray(a) @ a, np.asarray(a) @ b)


def _quadratic_programmes(rng: np.random.Generator) -> Sequence[Case]:
    drawn = _system(rng, 3)[0]
    down = -np.round(rng.uniform(2, 9, 3), 1)
    down[0] = -20.0  # at least one of the others is crowded out or not: both happen
    return [
        Case("a book of 1.5 kg", {"a": np.array([[1 / 1.5]]), "b": np.array([-9.81])}),
        Case("two contacts", {"a": PAIR, "b": np.array([-1.0, -1.0])}),
        Case("one foot lifts", {"a": LEVER, "b": np.array([-1.0, -2.0])}),
        Case("three contacts in a row", {"a": ROW, "b": np.array([-9.0, -1.0, -2.0])}),
        Case("three drawn contacts", {"a": drawn, "b": down}),
        Case("nothing pushes", {"a": PAIR, "b": np.array([0.5, 0.2])}, "edge"),
        Case("one contact given twice", {"a": TWICE, "b": np.array([-9.81, -9.81])}, "edge"),
    ]


def _rows(given: Mapping[str, Any], f: Any) -> tuple[Any, Any]:
    """D f and w, over max |b|."""
    a, b = given["a"], given["b"]
    if np.shape(f) != np.shape(b):
        raise ValueError("another shape")
    return np.diagonal(a) * f / np.abs(b).max(), (a @ f + b) / np.abs(b).max()


CONDITIONS = (
    Property("f >= 0", lambda given, f: np.minimum(_rows(given, f)[0], 0),
             "A force is below 0: a contact that pulls.", 1e-6),
    Property("d_ddot >= 0", lambda given, f: np.minimum(_rows(given, f)[1], 0),
             "d_ddot = A f + b is below 0: bodies sink into each other.", 1e-6),
    Property("f d_ddot = 0", lambda given, f: np.maximum(np.minimum(*_rows(given, f)), 0),
             "A contact pushes, f > 0, where the bodies part, d_ddot > 0.", 1e-6),
)  # fmt: skip

SOLVE_CONTACT_QP = Exercise(
    name="solve_contact_qp",
    rows=(25,),
    points=3,
    minutes=10,
    task="Return the f that minimises f'A f/2 + b'f subject to f >= 0, by cvxpy with the solver CLARABEL.",
    arguments=(A, B),
    results=(Value("f", "(c,)", "N", "contact forces", relative=1e-5, absolute=1e-5),),
    reference=_solution,  # it shows the shape; what is right is judged by the three conditions
    judged_by="properties",
    properties=CONDITIONS,
    cases=_quadratic_programmes,
    mistakes=(
        Mistake("not limited", _unlimited,
                "f is not limited to f >= 0: this is the force that makes every d_ddot = 0, and some contacts pull."),
        Mistake("clamped after solving", lambda a, b: np.maximum(_unlimited(a, b), 0.0),
                "Solved without the limit, and what pulled set to 0 afterwards. The other forces were found for "
                "a contact that pulls, and do not fit once it is gone. The limit belongs into the programme."),
        Mistake("half forgotten", lambda a, b: 0.5 * _solution(a, b),
                "All forces are half of what they should be: the 1/2 before f'A f is missing, so its slope is 2 A f."),
        Mistake("sign of b", lambda a, b: _solution(a, -np.asarray(b)),
                "The sign of b is turned round: the objective has + b'f."),
        Mistake("f <= 0", lambda a, b: -_solution(a, -np.asarray(b)),
                "The limit is turned round: f <= 0. On the slide's form A x <= b it is -f <= 0."),
        Mistake("as printed", lambda a, b: np.zeros(len(b)),
                "f = 0 everywhere: it satisfies f >= 0 and f d_ddot = 0, and all that lies on something falls through. "
                "An objective that is f d_ddot alone, or a constraint f <= 0, ends here too."),
        Mistake("least squares of d_ddot", _least_squares,
                "You minimise |A f + b|^2, which makes the d_ddot small. It is f'A f/2 + b'f whose slope is d_ddot; "
                "where a foot lifts, d_ddot is to be above 0, not small."),
        Mistake("A left out", lambda a, b: np.maximum(-np.asarray(b), 0.0),
                "The quadratic part is f.f/2, without A: every contact is treated as a body of 1 kg by itself."),
        Mistake("each contact alone", lambda a, b: np.maximum(-np.asarray(b) / np.diagonal(a), 0.0),
                "Only the diagonal of A is used: each contact is solved as if there were no other."),
    ),
    hints=(
        "Four steps: a variable, an objective, one constraint, solve. Your function returns f.value.",
        "f = cp.Variable(len(b)). The objective is cp.Minimize(...) of half cp.quad_form(f, cp.psd_wrap(a)) plus b @ f; "
        "the list of constraints holds f >= 0.",
        "f = cp.Variable(len(b))\nobjective = cp.Minimize(____ * cp.quad_form(f, cp.psd_wrap(a)) + b @ f)\n"
        "cp.Problem(objective, [____]).solve(solver=cp.CLARABEL)\nreturn f.value",
    ),
)  # fmt: skip


# projected_gauss_seidel


def _sweeps(
    *,
    clip: str = "force",
    jacobi: bool = False,
    divide: bool = True,
    sign: float = 1.0,
    own: float = 0.0,
    backwards: bool = False,
    more: int = 0,
    warm: bool = True,
) -> Any:
    """Sweeps over the contacts with one of their parts changed."""

    def function(a: Any, b: Any, start: Any, sweeps: Any) -> Any:
        f = np.array(start, dtype=float) if warm else np.zeros(len(b))
        for _ in range(int(sweeps) + more):
            seen = f.copy() if jacobi else f
            for i in reversed(range(len(b))) if backwards else range(len(b)):
                w = a[i] @ seen + sign * b[i] + own * a[i, i] * f[i]
                change = -w / (a[i, i] if divide else 1.0)
                if clip == "change":
                    change = max(change, 0.0)
                f[i] = max(f[i] + change, 0.0) if clip == "force" else f[i] + change
        return np.maximum(f, 0.0) if clip == "end" else f

    return function


def _swept_systems(rng: np.random.Generator) -> Sequence[Case]:
    a, b = _system(rng, 3)
    b[0] = -8.5
    warm = np.round(rng.uniform(0.5, 6, 3), 1)
    down, none = np.array([-1.0, -1.0]), np.zeros(2)
    return [
        Case("two contacts, one sweep", {"a": PAIR, "b": down, "start": none, "sweeps": 1}),
        Case("two contacts, three sweeps", {"a": 2 * PAIR, "b": down, "start": none, "sweeps": 3}),
        Case("one foot lifts", {"a": 2 * LEVER, "b": np.array([-1.0, -2.0]), "start": none, "sweeps": 4}),
        Case("three contacts, a warm start", {"a": a, "b": b, "start": warm, "sweeps": 2}),
        Case("three in a row", {"a": ROW, "b": np.array([-9.0, -1.0, -6.0]), "start": np.array([0.0, 2, 1]), "sweeps": 5}),
        Case("no sweep", {"a": PAIR, "b": down, "start": np.array([0.3, 0.4]), "sweeps": 0}, "edge"),
        Case("they part", {"a": 2 * PAIR, "b": -down, "start": np.array([3.0, 1.0]), "sweeps": 2}, "edge"),
    ]  # fmt: skip


PROJECTED_GAUSS_SEIDEL = Exercise(
    name="projected_gauss_seidel",
    rows=(25,),
    points=4,
    minutes=14,
    task="Sweep over the contacts in order, f_i <- max(0, f_i - w_i/a_ii) with w_i of the newest forces; return f.",
    arguments=(
        A,
        B,
        Value("start", "(c,)", "N", "forces to begin with, at or above 0"),
        Value("sweeps", "scalar", "", "how often all contacts are gone through", dtype="int"),
    ),
    results=(Value("f", "(c,)", "N", "forces after the last sweep"),),
    reference=_sweeps(),
    cases=_swept_systems,
    mistakes=(
        Mistake("clips the change", _sweeps(clip="change"),
                "You limit the change of a force, not the force: a force can then only grow, and what was once too large "
                "stays. Add the change first, then take max(0, ...)."),
        Mistake("no limit", _sweeps(clip="none"), "No force is limited to f >= 0: these are the sweeps for A f = -b."),
        Mistake("limited at the end", _sweeps(clip="end"),
                "The limit comes only after all sweeps. Until then other contacts lean on one that pulls."),
        Mistake("Jacobi", _sweeps(jacobi=True),
                "Each sweep uses only the forces of the sweep before it. That is Jacobi's method: slower, and it may not "
                "converge. Gauss-Seidel uses each new force at once."),
        Mistake("not divided", _sweeps(divide=False), "w_i is in m/s^2. Divided by a_ii it becomes a force."),
        Mistake("sign of b", _sweeps(sign=-1.0), "The sign of b is turned round: w = A f + b."),
        Mistake("own force twice", _sweeps(own=1.0), "a_ii f_i is in w_i twice: row i of A times f holds it already."),
        Mistake("own force left out", _sweeps(own=-1.0),
                "w_i leaves out contact i's own force, and the old force is added all the same. Either f_i - w_i/a_ii "
                "with all of row i, or the rest of the row alone without the old f_i."),
        Mistake("backwards", _sweeps(backwards=True), "The contacts are taken from the last to the first."),
        Mistake("a sweep too many", _sweeps(more=1), "One sweep too many is made: with sweeps = 0 the answer is start."),
        Mistake("start ignored", _sweeps(warm=False), "The forces begin at 0 and not at start."),
    ),
    hints=(
        "Two loops, one in the other: sweeps, contacts. Begin with a copy of start.",
        "For contact i: w_i is row i of A times all forces, plus b_i. Subtract w_i / a_ii from f_i, and take the larger "
        "of that and 0.",
        "f = np.array(start, dtype=float)\nfor _ in range(sweeps):\n    for i in range(len(b)):\n"
        "        w = a[i] @ f + b[i]\n        f[i] = max(0.0, ____)\nreturn f",
    ),
)  # fmt: skip


# pivot


def _pivoting(*, leave: bool = True, join: bool = True, whole: bool = False, skip: bool = True) -> Any:
    """Baraff's method with one of its steps left out."""

    def function(a: Any, b: Any) -> Any:
        f, w = np.zeros(len(b)), np.array(b, dtype=float)
        pushing: list[int] = []
        for d in range(len(b)):
            for _ in range(50):  # a mistake may go round for ever
                if w[d] >= -1e-12 and (skip or abs(w[d]) <= 1e-12):
                    break
                change = np.zeros(len(b))
                change[d] = 1.0
                if not whole:
                    change[pushing] = -np.linalg.solve(a[np.ix_(pushing, pushing)], a[pushing, d])
                rate = a @ change
                stops = [(-w[d] / rate[d], d)]
                stops += [(-f[i] / change[i], i) for i in pushing if leave and change[i] < 0]
                stops += [(-w[i] / rate[i], i) for i in range(d) if join and i not in pushing and rate[i] < 0]
                step, who = min(stops)
                f, w = f + step * change, w + step * rate
                if who in pushing:
                    pushing.remove(who)
                    f[who] = 0.0
                else:
                    w[who] = 0.0
                    pushing += [who] if who != d else []
            if f[d] != 0:
                pushing.append(d)
        return f

    return function


def _pivot_systems(rng: np.random.Generator) -> Sequence[Case]:
    join = np.array([[1.0, -0.6, -0.6], [-0.6, 1.0, 0.8], [-0.6, 0.8, 1.0]])
    back = np.array([[1.0, 0.3, 0.3], [0.3, 1.0, -0.5], [0.3, -0.5, 1.0]])
    a, b = _system(rng, 5)
    b[:3] = -np.abs(b[:3]) - 1
    return [
        Case("two contacts", {"a": PAIR, "b": np.array([-1.0, -1.0])}),
        Case("the first leaves", {"a": LEVER, "b": np.array([-1.0, -2.0])}),
        Case("the second rests at first", {"a": ROW, "b": np.array([-9.0, -1.0, -2.0])}),
        Case("one that parts must join", {"a": join, "b": np.array([1.0, -2.0, -3.0])}),
        Case("the first parts", {"a": back, "b": np.array([2.0, -1.0, -3.0])}),
        Case("five drawn contacts", {"a": a, "b": b}),
        Case("the last parts", {"a": PAIR, "b": np.array([-1.0, 2.0])}),
        Case("nothing pushes", {"a": PAIR, "b": np.array([1.0, 0.0])}, "edge"),
    ]


PIVOT = Exercise(
    name="pivot",
    rows=(20, 25),
    points=4,
    minutes=30,
    level="stretch",
    task="Return f >= 0 with w = A f + b >= 0 and f w = 0, contact by contact, for positive definite A.",
    arguments=(A, B),
    results=(Value("f", "(c,)", "N", "contact forces", relative=1e-8, absolute=1e-9),),
    reference=_pivoting(),
    cases=_pivot_systems,
    mistakes=(
        Mistake("nobody leaves", _pivoting(leave=False),
                "A force went below 0: stop where one of the pushing forces reaches 0, and take it out of the set."),
        Mistake("nobody joins", _pivoting(join=False),
                "A contact that was dealt with sinks in: stop where one of the resting w reaches 0, and let it join."),
        Mistake("the others hold still", _pivoting(whole=True),
                "While one force grows, those that push already must change with it to keep their w at 0."),
        Mistake("contacts that part are pressed", _pivoting(skip=False),
                "You bring w_d to 0 also where it is above 0. A contact that parts takes no force: leave it alone."),
    ),
    hints=(
        "Keep f, w and the list of the contacts that push. While w_d < 0: find the direction, the first stop, go there.",
        "The pushing forces answer a unit of force at d by -A_CC^-1 A_Cd. The stops: w_d = 0; a pushing force with a "
        "falling change = 0; a resting w with a falling rate = 0. The smallest step wins.",
        "change[pushing] = -np.linalg.solve(a[np.ix_(pushing, pushing)], a[pushing, d])\nrate = a @ change\n"
        "stops = [(-w[d] / rate[d], d)]\nstops += [(____, i) for i in pushing if change[i] < 0]\n"
        "stops += [(____, i) for i in range(d) if i not in pushing and rate[i] < 0]\nstep, who = min(stops)",
    ),
)  # fmt: skip


def _what_agrees() -> str:
    """Two solvers on the table, two solutions of a ball between upright walls: what is equal every time?"""
    from course.contact import solve
    from course.study.resting_scenes import table, wedged_ball

    four, ball = table().system(), wedged_ball(0.0).system()
    pairs = [[(four, solve(four, method=m).force) for m in ("nnls", "pivot")], [(ball, np.full(2, t)) for t in (0.0, 3.0)]]
    same_motion = all(np.allclose(s.A @ (f - g), 0, atol=1e-9) for (s, f), (_, g) in pairs)
    same_sum = all(np.isclose(f.sum(), g.sum()) for (_, f), (_, g) in pairs)
    return "sum" if same_sum else "motion" if same_motion else "nothing"


def _sliding_ladder() -> float:
    from course.contact import solve
    from course.study import ladder

    return float(solve(ladder(np.radians(60), rate=-2.0).system()).force[0])


def _sweeps_at_a_mass_ratio() -> float:
    from course.contact.solvers.projected_gauss_seidel import predicted_gauss_seidel_factor
    from course.study.resting_scenes import stack

    factor = predicted_gauss_seidel_factor(stack(2, corners=1, mass=[1.0, 1000.0]).system().A)
    return float(np.log(0.1) / np.log(factor))


PREDICTIONS = (
    Prediction(
        "four_legs",
        "Five correct solvers give different forces for the same four legs. What do they agree on?",
        _what_agrees,
        "Every correct answer leads to the same d_ddot, in every scene. On this table the sum is the same as well; for a "
        "ball between two walls not even that.",
        choices={
            "nothing": "on nothing: at most one of the five is right",
            "sum": "on the sum of the forces, in every scene",
            "motion": "on how every contact accelerates, in every scene",
        },
        later="Where it breaks",
        wrong={
            "nothing": "All five satisfy the three conditions to rounding: the conditions do not say more.",
            "sum": "On this table, yes. Two walls that press a ball with t each may do so with any t.",
        },
    ),
    Prediction(
        "ladder_foot",
        "The ladder of 10 kg at 60 degrees slides so fast (2 rad/s) that the wall would have to pull. With what force "
        "does the floor push?",
        _sliding_ladder,
        "The wall lets go, f_2 = 0, and the floor alone keeps the foot: f_1 = -b_1/a_11 = 2.882/0.175.",
        unit="N",
        tolerance=0.01,
        wrong={
            10.43: "That is what the floor pushes with while the wall pulls. Without the wall it has another load: setting "
            "a force to 0 after solving is not enough.",
            98.1: "That is the weight. The foot is at the end of a turning ladder, not under its centre.",
        },
    ),
    Prediction(
        "sweeps",
        "A box of 1,000 kg lies on one of 1 kg. How many sweeps of projected Gauss-Seidel does one more digit take?",
        _sweeps_at_a_mass_ratio,
        "A sweep shrinks the error by R/(1 + R) = 0.999, and 0.999^2304 = 0.1.",
        tolerance=0.3,
        wrong={
            1: "For two contacts it looks easy. Each sweep hands the lower box only a thousandth of what is missing.",
            1000: "The right order of magnitude: the error falls by a thousandth each sweep. A digit is 2.3 times that.",
        },
    ),
)

LESSON = Lesson(
    number="16",
    name="contact-forces",
    title="Contact forces",
    question="Four legs, five correct solvers, different forces: what do they agree on?",
    minutes=75,
    exercises=(SLOPE, COMPLEMENTARITY_RESIDUAL, SOLVE_CONTACT_QP, PROJECTED_GAUSS_SEIDEL, PIVOT),
    predictions=PREDICTIONS,
)
