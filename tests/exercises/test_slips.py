"""A planted mistake is one edit of a formula: it must find what it changes, once, and
be readable afterwards."""

import inspect
import traceback
from dataclasses import replace

import numpy as np
import pytest

from course import formulas
from course.exercises.definition import find_exercise
from course.exercises.formula_source import body, expression
from course.exercises.inputs import answers_of
from course.exercises.slips import slip
from course.exercises.verdict import judge


def test_a_slip_is_the_formula_with_one_edit():
    given = 1.0, 2.0, np.array([-1.0, 0, 0]), np.zeros(3), np.array([1.0, 0, 0]), 0.5
    right = formulas.impulse_central
    half = slip(right, "(1 + restitution)", "restitution")
    assert half(*given) == pytest.approx(right(*given) / 3)
    assert half.__name__ == "impulse_central" and half.__doc__ == right.__doc__
    assert formulas.impulse_central is right
    assert "impulse = restitution * closing" in inspect.getsource(half)


def test_slips_may_follow_each_other():
    once = slip(formulas.p_hat, "1 + e", "1 - e")
    twice = slip(once, "v_2 - v_1", "v_1 - v_2")
    together = slip(formulas.p_hat, "1 + e", "1 - e", "v_2 - v_1", "v_1 - v_2")
    given = 1.0, 2.0, -3.0, 4.0, 0.25
    assert twice(*given) == together(*given) == -once(*given) != 0


def test_helpers_of_the_formula_s_module_are_found():
    """contact_bias calls free_point_acceleration, which stands beside it."""
    given = find_exercise("contact_bias")[1].draw()[2].arguments.values()
    wrong = slip(formulas.contact_bias, "+ 2 *", "- 2 *")
    assert np.isfinite(wrong(*given)) and wrong(*given) != formulas.contact_bias(*given)


@pytest.mark.parametrize(
    ("edits", "message"),
    [
        (("1 + f", "1"), "occurs once in p_hat; got '1 \\+ f', which occurs 0 times"),
        (("v_", "w_"), "occurs 2 times"),
        (("p_hat", "q_hat"), "occurs 0 times"),
        (("syllabus row", "x"), "occurs 0 times"),
        (("1 + e", "1 + e"), "expected another text than old"),
        (("1 + e",), "expected pairs of old and new; got 1 texts"),
        ((), "expected pairs of old and new; got 0 texts"),
        (("1 + e", "1 - e", "1 + e", "e"), "got '1 \\+ e', which occurs 0 times"),
    ],
)
def test_an_edit_that_is_not_one_is_refused(edits, message):
    """Neither the docstring nor the name counts as code."""
    with pytest.raises(ValueError, match=message):
        slip(formulas.p_hat, *edits)


def test_an_edit_that_is_no_python_is_refused():
    with pytest.raises(SyntaxError):
        slip(formulas.p_hat, "(1 + e)", "(1 + e")


def test_an_error_shows_the_slip_s_own_line():
    wrong = slip(formulas.impulse_central, "1 + restitution", "1 + nothing")
    with pytest.raises(NameError) as caught:
        wrong(1.0, 1.0, np.zeros(3), np.zeros(3), np.zeros(3), 0.5)
    shown = "".join(traceback.format_tb(caught.tb))
    assert "(1 + nothing) * closing" in shown
    assert "slip of impulse_central: 1 + restitution -> 1 + nothing" in shown


def test_planted_mistakes_can_be_read():
    """Each but those that no edit says shows its changed source."""
    for name in ("effective_mass", "pivot", "contact_matrix_entry", "sigma"):
        exercise = find_exercise(name)[1]
        sources = [inspect.getsource(m.function) for m in exercise.mistakes]
        assert len({inspect.getsource(exercise.reference), *sources}) == 1 + len(
            sources
        )


def test_the_body_is_what_a_student_writes():
    assert body(formulas.speed_along) == (
        "    return np.sum(velocity * normal, axis=-1)"
    )
    assert body(formulas.solve_contact_qp).startswith("    f = cp.Variable(len(b))")
    assert body(formulas.contact_bias, 3).startswith("    p_a_dot, p_b_dot = ")
    assert body(formulas.rk4_step).startswith("    def rate_of(l):\n        return")
    with pytest.raises(ValueError, match="expected fewer than speed_along has; got 1"):
        body(formulas.speed_along, 1)
    assert expression(formulas.ladder_entry) == (
        "-3 * sp.sin(theta) * sp.cos(theta) / mass"
    )


@pytest.mark.parametrize("name", ["solve_contact_qp", "simultaneous_impulses"])
def test_where_properties_judge_the_formula_is_not_run(name):
    def never(*_):
        raise AssertionError("the judge ran the formula")

    exercise = find_exercise(name)[1]
    cases = exercise.draw()
    answers = answers_of(exercise.reference, exercise, cases)
    assert judge(replace(exercise, reference=never), cases, answers).passed
    with pytest.raises(ValueError, match="sample: expected one in an exercise judged"):
        replace(exercise, sample=None)
    with pytest.raises(ValueError, match="sample: expected one in an exercise judged"):
        replace(find_exercise("p_hat")[1], sample=lambda *_: 0.0)
