"""Repair: which changes a source has, what is found with them, and that nothing is told which was not tried."""

import ast

import numpy as np
import pytest

from course.exercises.answer import call_all
from course.exercises.definition import find_exercise
from course.exercises.inputs import inputs_of
from course.exercises.repair.changes import ChangedSource
from course.exercises.repair.edits import Code, edits_of
from course.exercises.repair.recipe import expression_recipe
from course.exercises.repair.search import Search
from course.exercises.repair.wording import in_words

#: Seconds together: left out of the minute's run.
pytestmark = pytest.mark.slow

HEAD = "def speed_along(velocity, normal):\n    return "
AXES = {"velocity": 1, "normal": 1}


class Here(ChangedSource):
    """Runs changed sources in this process: for sources that end."""

    def __init__(self, inputs, source, axes, hidden=""):
        super().__init__(Code(source, axes), hidden)
        self._inputs, self._source = inputs, source
        drawn = (inputs, *inputs.others)
        self.cases = [case.arguments for one in drawn for case in one.cases]

    def ran(self, source, cases):
        space = {"np": np}
        exec(source, space)
        question = self._inputs.question
        arguments = [self.cases[i] for i in cases]
        return call_all(space[question.name], arguments, question.results)

    def unchanged(self):
        return self.ran(self._source, range(len(self._inputs.cases)))

    def outcomes(self, numbers, cases, *, after=-1, left=False):
        return [self.ran(self.source(n, after), cases) for n in numbers]


def repair_of_source(name, source, axes, seconds=20.0, answer=Here, **more):
    inputs = inputs_of(find_exercise(name)[1])
    answer = answer(inputs, source, axes, **more)
    return Search(inputs, answer, seconds).find(answer.unchanged())


@pytest.mark.parametrize(
    ("wrong", "kind"),
    [
        ("np.abs(np.sum(velocity * normal, axis=-1))", "abs() too many"),
        ("2 * np.sum(velocity * normal, axis=-1)", "a factor too many"),
        ("np.sum(velocity * normal, axis=-1) + 1", "a term too many"),
        ("np.sum(velocity * normal)", "sum() without axis=-1"),
        ("np.sum(velocity * normal, axis=0)", "the axis"),
        ("np.sum(velocity + normal, axis=-1)", "+ where * belongs"),
        ("np.max(velocity * normal, axis=-1)", "max() where sum() belongs"),
        ("np.sum(velocity * velocity, axis=-1)", "another name"),
        ("-np.sum(velocity * normal, axis=-1)", "a sign"),
        ("-np.sum((velocity - 0) * normal, axis=-1)", "a sign"),
        ("velocity * normal", "* where a dot product belongs"),
        ("np.sum(velocity * normal / 2 - 1, axis=-1)", "brackets"),
        ("np.sum(velocity * normal, axis=-1).astype(int)", "astype() too many"),
        (
            "np.sum(velocity * normal, axis=-1, keepdims=True) * normal",
            "a factor too many",
        ),
    ],
)
def test_the_kind_of_a_slip_is_found(wrong, kind):
    repair = repair_of_source("speed_along", HEAD + wrong + "\n", AXES)
    assert [step.kind for step in repair.steps] == [kind]
    assert repair.steps[0].line == f"return {wrong}"


def test_two_slips_are_found_one_after_the_other():
    source = (
        "def momentum_after(momentum_1, momentum_2, impulse, normal):\n"
        "    push = np.asarray(impulse)[..., None] * normal\n"
        "    return momentum_1 + 3 * push, np.abs(momentum_2 - push)\n"
    )
    repair = repair_of_source("momentum_after", source, {})
    kinds = [step.kind for step in repair.steps]
    assert kinds == ["abs() too many", "a factor too many"]
    source = (
        "def bouncing_ball_step(height, velocity, step, restitution, gravity):\n"
        "    hit = (height < 0) & (velocity < 0)\n"
        "    new = np.where(hit, restitution * velocity, velocity + gravity * step)\n"
        "    return height + step * new, new\n"
    )
    axes = dict.fromkeys("height velocity step restitution gravity hit new".split(), 0)
    repair = repair_of_source("bouncing_ball_step", source, axes)
    assert len(repair.steps) == 2
    assert all("sign" in step.kind for step in repair.steps)


def test_nothing_is_found_for_what_no_small_change_makes_right():
    assert (
        repair_of_source("speed_along", HEAD + "np.cosh(velocity[..., 0])\n", AXES)
        is None
    )


@pytest.mark.parametrize(
    "last",
    [
        "np.clip(1 - seen / way, 0, 1)",
        "np.maximum(1 - seen / way, 0)",
        "max(1 - seen / way, 0)",
        "1 - np.minimum(seen / way, 1)",
    ],
)
def test_making_a_number_numpys_is_no_cure_of_a_division_by_0(last):
    """abs() around a divisor turns the error into infinity, and the answer passes."""
    source = (
        "def miss_probability(thickness, radius, speed, step):\n"
        "    seen, way = thickness + 2 * radius, speed * step\n"
        f"    return {last}\n"
    )
    axes = dict.fromkeys("thickness radius speed step seen way".split(), 0)
    assert repair_of_source("miss_probability", source, axes) is None


def test_a_division_by_0_is_mended_where_nothing_is_converted():
    source = (
        "def miss_probability(thickness, radius, speed, step):\n"
        "    seen = thickness + 2 * radius\n"
        "    return 1 - seen / np.maximum(speed * step, seen) + 1 / (0 * step)\n"
    )
    axes = dict.fromkeys("thickness radius speed step seen".split(), 0)
    repair = repair_of_source("miss_probability", source, axes)
    assert [step.kind for step in repair.steps] == ["a term too many"]


def test_nothing_is_found_after_the_time_is_over():
    source = HEAD + "2 * np.sum(velocity * normal, axis=-1)\n"
    assert repair_of_source("speed_along", source, AXES, seconds=-1.0) is None


def test_a_change_that_only_the_notebooks_cases_allow_is_not_told():
    """The change passes the notebook's cases and is made to fail the first of another seed."""

    class WrongElsewhere(Here):
        def ran(self, source, cases):
            own = len(self._inputs.cases)
            assert len(self.cases) > own
            came = super().ran(source, cases)
            spoilt = call_all(lambda v, n: np.float64(np.nan), [self.cases[own]], 1)[0]
            return [spoilt if i >= own else o for i, o in zip(cases, came, strict=True)]

    source = HEAD + "2 * np.sum(velocity * normal, axis=-1)\n"
    assert repair_of_source("speed_along", source, AXES, 5.0) is not None
    assert (
        repair_of_source("speed_along", source, AXES, 5.0, answer=WrongElsewhere)
        is None
    )


@pytest.mark.parametrize(
    "source",
    [
        "def f(a, b):\n    return (a +  # é\n        b) * a\n",
        "def f(a, b):\n    for i in range(3):\n        a += b[i]\n    return a\n",
        "def f(a, b):\n    x_a = a + b\n    x_b = a - b\n    if a < 0 and b > 1:\n"
        "        return x_a, x_b\n    return f'{a}', [a, b]\n",
        "def f(a, b):\n    g = lambda x: np.sum(x ** 2, axis=-1) / b\n    return g(a) if b > 0 else -g(b)\n",
    ],
)
def test_every_change_is_python_and_a_change(source):
    edits = edits_of(Code(source))
    changed = [e.applied(source) for e in edits]
    assert len(edits) > 30 and len({e.patches for e in edits}) == len(edits)
    for text in changed:
        assert ast.dump(ast.parse(text)) and text != source


def test_an_expression_becomes_a_function_of_numbers():
    cell = 'h, e, g = sp.symbols("h e g")\nt_0 = sp.sqrt(2 * h / g)\nrest_time = t_0 * (\n    1 + e\n)\n'
    recipe = expression_recipe(cell, "rest_time", ["h", "e", "g"])
    space = {}
    exec(recipe.prelude + recipe.source, space)
    assert space["rest_time"](2.0, 0.5, 1.0) == 3.0
    assert expression_recipe("rest_time = ", "rest_time", ["h"]) is None


@pytest.mark.parametrize(
    ("name", "body", "kind", "new"),
    [
        # a count is a number, not a name that happens to hold one
        (
            "speed_along",
            "total = 0\n    for i in range(1, 3):\n"
            "        total += velocity[..., i] * normal[..., i]\n    return total",
            "a number",
            "0",
        ),
        # the dot product is there; what follows it is too many
        (
            "speed_along",
            "dot = np.sum(velocity * normal, axis=-1)\n    return dot[..., None] * normal",
            "a factor too many",
            "dot",
        ),
        (
            "speed_along",
            "a = velocity * normal\n    b = a\n    b[..., 0] = 0.0\n    return np.sum(a, axis=-1)",
            "a second name where a copy belongs",
            "np.array(a)",
        ),
        # mirrored, with e as a factor
        (
            "wall_bounce",
            "u = np.sum(velocity * normal, axis=-1)[..., None]\n"
            "    e = np.asarray(restitution)[..., None]\n"
            "    return np.where(u < 0, velocity - 2 * e * u * normal, velocity)",
            "a number times it where 1 + it belongs",
            "1 + e",
        ),
        # both cross products have the same order: brackets are the likelier cause
        (
            "separation_rate",
            "x_a, v_a, w_a = body_a\n    x_b, v_b, w_b = body_b\n"
            "    rate = v_a + np.cross(w_a, p_a - x_a) - v_b + np.cross(w_b, p_b - x_b)\n"
            "    return np.sum(rate * n + (p_a - p_b) * n_dot, axis=-1)",
            "brackets",
            "v_a + np.cross(w_a, p_a - x_a) - (v_b + np.cross(w_b, p_b - x_b))",
        ),
    ],
)
def test_of_several_changes_the_likeliest_is_told(name, body, kind, new):
    exercise = find_exercise(name)[1]
    head = f"def {exercise.signature}:\n    "
    (step,) = repair_of_source(name, head + body + "\n", {}).steps
    assert (step.kind, step.new) == (kind, new)


def test_the_same_slip_in_two_twin_lines_is_one_change_in_both():
    source = (
        "def separation_rate(p_a, p_b, body_a, body_b, n, n_dot):\n"
        "    x_a, v_a, w_a_now = body_a\n    x_b, v_b, w_b_now = body_b\n"
        "    p_a_dot = v_a + np.cross(p_a - x_a, w_a_now)\n"
        "    p_b_dot = v_b + np.cross(p_b - x_b, w_b_now)\n"
        "    return np.sum((p_a_dot - p_b_dot) * n + (p_a - p_b) * n_dot, axis=-1)\n"
    )
    (step,) = repair_of_source("separation_rate", source, {}).steps
    assert step.kind == "the order of the arguments of cross()"
    lines = source.splitlines()
    assert step.line.splitlines() == [lines[3].strip(), lines[4].strip()]


def test_a_slip_and_a_sign_are_found_together():
    source = HEAD + "-3 * np.sum(velocity * normal, axis=-1)\n"
    repair = repair_of_source("speed_along", source, AXES)
    kinds = {step.kind for step in repair.steps}
    assert len(repair.steps) <= 2 and kinds <= {"a factor too many", "a sign"}


def test_the_second_line_is_told_as_the_student_wrote_it():
    """The changed line would show the first change, which only a hint may."""
    line = "return momentum_1 + 3 * push, np.abs(momentum_2 - push)"
    source = (
        "def momentum_after(momentum_1, momentum_2, impulse, normal):\n"
        f"    push = np.asarray(impulse)[..., None] * normal\n    {line}\n"
    )
    repair = repair_of_source("momentum_after", source, {})
    assert [step.line for step in repair.steps] == [line, line]


def test_no_line_is_told_that_only_the_search_wrote():
    cell = 'a, b = sp.symbols("a b")\np_hat = (1 + e) * (v_2 - v_1) * m_1 * m_2\n'
    names = ["m_1", "m_2", "v_1", "v_2", "e"]
    recipe = expression_recipe(cell, "p_hat", names)
    assert "    p_hat = (1 + e) * (v_2 - v_1) * m_1 * m_2\n" in recipe.source
    repair = repair_of_source("p_hat", recipe.source, {}, hidden="return p_hat")
    told = [*(s.line for s in repair.steps), *repair.elsewhere]
    assert all(line in cell for line in told)


def test_rates_multiplied_are_told_as_the_product_rule():
    source = (
        "def edge_normal_rate(e_a, e_b, omega_a, omega_b, n):\n"
        "    q = np.cross(e_a, e_b)\n"
        "    q_dot = np.cross(np.cross(omega_a, e_a), np.cross(omega_b, e_b))\n"
        "    s = np.sign(np.sum(q * n, axis=-1, keepdims=True))\n"
        "    rate = s * q_dot / np.linalg.norm(q, axis=-1, keepdims=True)\n"
        "    return rate - np.sum(rate * n, axis=-1, keepdims=True) * n\n"
    )
    (step,) = repair_of_source("edge_normal_rate", source, {}).steps
    assert step.kind == "a product of two rates where the product rule belongs"


@pytest.mark.parametrize(
    ("name", "body", "words"),
    [
        # the right two vectors, and letters that fit one shape of batch only
        (
            "speed_along",
            'return np.einsum("ij,ij->i", velocity, normal)',
            "the letters of einsum()",
        ),
        # the slip is the helper's: of np.dot nothing is said
        (
            "speed_along",
            "def dot(a, b):\n        return np.einsum('...i,...j->...', a, b)\n"
            "    return dot(velocity, normal)",
            "the letters of einsum()",
        ),
        (
            "speed_along",
            "def dot(a, b):\n        return np.hypot(a, b)\n    return dot(velocity, normal)",
            "what comes of dot() where the dot product of vectors belongs",
        ),
        # a difference of the same two vectors, which is no product of others
        (
            "normal_rate",
            'omega = omega_a if face == "face_a" else omega_b\n'
            "    return omega - np.sum(omega * n, axis=-1, keepdims=True) * n",
            "an expression, where the cross product of two vectors in it belongs",
        ),
        # size is no vector
        (
            "speed_along",
            "size = np.linalg.norm(velocity, axis=-1)\n"
            "    return size * np.sign(np.sum(velocity * normal, axis=-1))",
            "an expression, where the dot product of two vectors in it belongs",
        ),
        # no brackets alone make it right: n has to move
        (
            "separation",
            "return np.sum(p_a * n - p_b, axis=-1)",
            "something done to a part of an expression that belongs to the whole of it, or the other way round",
        ),
        # I is the matrix: the sign between is the slip
        (
            "angular_acceleration",
            "w = np.linalg.solve(I, L[..., None])[..., 0]\n"
            "    return np.linalg.solve(I, (torque + np.cross(I * w, w))[..., None])[..., 0]",
            "* where @ belongs",
        ),
    ],
)
def test_what_is_said_of_a_repair_holds_of_the_answer(name, body, words):
    exercise = find_exercise(name)[1]
    axes = {a.name: a.own_axes for a in exercise.arguments if a.dtype == "float"}
    source = f"def {exercise.signature}:\n    {body}\n"
    repair = repair_of_source(name, source, axes)
    assert [in_words(step.kind) for step in repair.steps] == [words]


def test_a_condition_made_narrower_is_not_said_to_be_turned_round():
    def kind(wrong, right):
        head = "def f(i, k):\n    return np.where("
        changed = _changed(f"{head}{wrong}, i, k)\n")
        return next(e.kind for text, e in changed if f"({right})" in text)

    assert kind("i != k", "i < k") == "a condition of another kind"
    assert kind("i == k", "i >= k") == "a condition of another kind"
    assert kind("i < k", "i <= k") == "a condition at its edge"
    assert (
        kind("i < k", "i > k") == kind("i == k", "i != k") == "a condition turned round"
    )


def test_more_terms_are_no_repair_of_a_sum_that_is_cut_off():
    """Fewer than ten may be those of a vector: range(2) for range(3) is a slip."""
    head = "def f(e):\n    return "
    long = "sum(e**k for k in range(1, 50))"
    assert all(
        "50" in text for text, e in _changed(head + long) if e.kind == "a number"
    )
    short = "sum(e[k] for k in range(2))"
    assert any("(3)" in text for text, _ in _changed(head + short))


def _changed(source):
    edits = edits_of(Code(source))
    return [(e.applied(source), e) for e in edits]
