"""Which slip an answer is told of: whole or in part, and no slip that it did not make."""

import warnings

import cvxpy as cp
import numpy as np
import pytest

from course import formulas
from course.exercises.definition import find_exercise
from course.exercises.inputs import answers_of
from course.exercises.verdict import judge


def verdict_of(name, function, seed=None):
    exercise = find_exercise(name)[1]
    cases = exercise.draw(seed)
    return judge(exercise, cases, answers_of(function, exercise, cases))


def closing(v, w, n):
    return np.sum((w - v) * n, axis=-1)


def mu(a, b):
    return 1 / (1 / a + 1 / b)


@pytest.mark.parametrize("seed", (None, 3, 4, 5))
@pytest.mark.parametrize("factor", [lambda e: e, lambda e: 1 - e, lambda e: -(1 + e)])
def test_a_slip_that_agrees_on_a_part_of_the_cases_is_not_named(factor, seed):
    """The guard is forgotten too: whether this slip explains the rest has not been tested."""
    verdict = verdict_of(
        "impulse_central",
        lambda a, b, v, w, n, e: factor(e) * closing(v, w, n) * mu(a, b),
        seed,
    )
    assert verdict.state == "wrong" and verdict.mistake is None
    assert not any("second slip" in r for r in verdict.reason)


def test_agreeing_on_one_passed_case_and_most_failed_ones_names_nothing():
    """The larger for the smaller agrees with the slip "sign of b" on nine cases of ten, and is another one."""

    def residual(a, f, b):
        d_ddot = np.einsum("...ij,...j->...i", a, f) + b
        larger = np.abs(np.maximum(np.diagonal(a, axis1=-2, axis2=-1) * f, d_ddot))
        scale = np.einsum("...ij,...j->...i", np.abs(a), f)
        scale = scale + np.abs(b).max(axis=-1, keepdims=True)
        zero = np.zeros(scale.shape)
        return np.divide(larger, scale, out=zero, where=scale > 0).max(axis=-1)

    assert verdict_of("complementarity_residual", residual).mistake is None


def test_a_slip_that_explains_all_says_nothing_of_a_second():
    verdict = verdict_of(
        "impulse_central",
        lambda a, b, v, w, n, e: (1 + e) * closing(v, w, n) * mu(a, b),
    )
    assert verdict.mistake.name == "no guard"
    assert not any("second slip" in r for r in verdict.reason)


def test_errors_of_one_kind_are_not_taken_for_one_slip():
    """np.dot and the missing axis both raise ValueError in a batch; they are not the same mistake."""

    def wall_bounce(v, n, e):
        along = np.dot(v, n)
        return np.where(along < 0, v - (1 + e) * along * n, v)

    verdict = verdict_of("wall_bounce", wall_bounce)
    assert verdict.mistake is None and "Right for one" in verdict.reason[0]


@pytest.mark.parametrize(
    ("wrong", "message"),
    [
        (
            lambda p, q, i, n: (p + i[..., None] * n, q - i[..., None] * n),
            "np.asarray(s)[..., None] serves",
        ),
        (
            lambda p, q, i, n: (p, q) if i > 0 else (q, p),
            "np.where(condition, this, that)",
        ),
    ],
)
def test_a_plain_number_that_is_indexed_and_an_if_on_a_batch_are_told(wrong, message):
    assert any(message in r for r in verdict_of("momentum_after", wrong).reason)


@pytest.mark.parametrize("letters", ("ij,j->i", "ij,j", "ij,...j->...i"))
def test_einsum_without_its_dots_is_told(letters):
    def spin(inverse, momentum, omega, torque):
        return np.einsum(letters, inverse, torque + np.cross(momentum, omega))

    (reason,) = verdict_of("angular_acceleration_free", spin).reason
    assert "put ... before the letters" in reason and "np.sum" not in reason


def test_einsum_that_fails_for_another_reason_is_not_told_of_dots():
    def spin(inverse, momentum, omega, torque):
        return np.einsum("...ij,...k->...i", inverse, torque[..., :2])[..., :1, 9]

    assert not any(
        "before the letters" in r
        for r in verdict_of("angular_acceleration_free", spin).reason
    )


def test_single_precision_is_told():
    def nearly(v, w, n, e):
        u = -closing(v, w, n)
        return np.float32(np.where(u < 0, -e * u, u))

    assert any("single" in r for r in verdict_of("separation_speed", nearly).reason)


@pytest.mark.parametrize("value", (np.nan, np.inf, 1j))
def test_no_property_is_said_to_be_lacking_where_there_is_no_number(value):
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        verdict = verdict_of(
            "impulse_central", lambda a, b, v, w, n, e: value * np.ones(np.shape(a))
        )
    assert not any("pulls the bodies" in r for r in verdict.reason)


@pytest.mark.parametrize(
    "answer",
    [
        lambda s: np.zeros(0),
        lambda s: np.zeros((0,) if s else ()),
        lambda s: "a" if s else 1.0,
    ],
)
def test_answers_of_odd_sizes_are_judged(answer):
    verdict = verdict_of(
        "impulse_central", lambda a, b, v, w, n, e: answer(np.shape(a))
    )
    assert verdict.state == "wrong"


def qp(limits):
    """solve_contact_qp with limits(f, a, b)."""

    def answer(a, b):
        f = cp.Variable(len(b))
        q = cp.Minimize(cp.quad_form(f, cp.psd_wrap(a)) / 2 + b @ f)
        cp.Problem(q, limits(f, a, b)).solve(solver=cp.CLARABEL)
        return f.value

    return answer


@pytest.mark.parametrize("seed", (None, 1, 2))
@pytest.mark.parametrize(
    "limits",
    [
        lambda f, a, b: [f >= 0, a @ f + b >= 0],
        lambda f, a, b: [-f <= 0, a @ f >= -b],
        lambda f, a, b: [f >= 0, f >= 0],
    ],
)
@pytest.mark.slow
def test_a_limit_that_repeats_what_comes_out_anyway_is_right(limits, seed):
    assert verdict_of("solve_contact_qp", qp(limits), seed).passed


def test_a_limit_outside_a_list_is_not_taken_for_another_error_of_its_type():
    verdict = verdict_of("solve_contact_qp", qp(lambda f, a, b: f >= 0))
    assert verdict.state == "error" and verdict.mistake is None


def test_r_is_not_said_to_be_missing_where_it_cancels():
    def cancelling(R, I_body):
        return I_body @ R @ np.swapaxes(R, -1, -2)

    told = verdict_of("world_inertia", cancelling).mistake.message
    assert "cancels" in told and "not used" not in told


@pytest.mark.parametrize(
    "answer",
    [
        lambda inertia, L, torque: np.linalg.inv(inertia) @ L,
        lambda inertia, L, torque: np.linalg.inv(inertia) @ (torque + np.cross(L, L)),
    ],
)
def test_a_matrix_times_a_batch_is_not_told_to_take_sums(answer):
    verdict = verdict_of("angular_acceleration", answer)
    assert not any("sum" in r for r in verdict.reason)


@pytest.mark.parametrize(
    ("name", "answer"),
    [
        (
            "bounce_times",
            lambda h, e, n, g: np.cumsum(
                np.sqrt(2 * np.asarray(h)[..., None] / g)
                * np.where(np.arange(n) == 0, 1, 2)
                * np.asarray(e)[..., None] ** np.arange(n)
            ),
        ),
        (
            "separation",
            lambda p, q, n: np.linalg.norm((p - q) * n),
        ),
    ],
)
def test_no_sum_is_spoken_of_where_there_is_none(name, answer):
    assert not any("np.sum" in r for r in verdict_of(name, answer).reason)


@pytest.mark.parametrize("asked", ("&", "|"))
def test_a_comparison_without_its_brackets_is_told(asked):
    condition = f"height < 0 {asked} velocity < 0"
    rest = "return np.where(hit, height, height), velocity"
    made = {"np": np}
    exec(
        "def bouncing_ball_step(height, velocity, step, restitution, gravity):\n"
        f"    hit = {condition}\n    {rest}\n",
        made,
    )
    reasons = verdict_of("bouncing_ball_step", made["bouncing_ball_step"]).reason
    assert any("(a < 0) & (b < 0)" in r for r in reasons)


def test_what_is_no_number_is_not_said_to_be_one():
    verdict = verdict_of("speed_along", lambda v, n: np.sum[v])
    assert not any("plain number" in r for r in verdict.reason)


# Sentences that were said once where they were not so.


def reasons(name, function) -> str:
    verdict = verdict_of(name, function)
    return " ".join((*verdict.reason, *verdict.violated))


def test_a_batch_is_blamed_only_where_it_is_a_batch_that_stops():
    def in_a_single_case(n, omega_a, omega_b, face):
        return np.cross(omega_b if n == "face_b" else omega_a, n)

    said = reasons("normal_rate", in_a_single_case)
    assert "batch has many" not in said and "a vector stand there" in said

    def with_an_if(velocity, normal, restitution):
        along = np.sum(velocity * normal, axis=-1, keepdims=True)
        bounced = velocity - (1 + restitution) * along * normal
        return bounced if along < 0 else velocity

    assert "batch has many answers" in reasons("wall_bounce", with_an_if)
    swapped = reasons("wall_bounce", lambda v, n, e: -with_an_if(v, n, e))
    assert swapped.startswith("Besides, it stops at batches")


def test_an_index_into_a_number_is_not_told_to_be_a_missing_axis_only():
    said = reasons("speed_along", lambda v, n: len(v)[0])
    assert "is a plain number" in said and "Where an axis is wanted" in said


def test_no_property_is_told_of_an_answer_of_another_shape():
    def outer(p_1, p_2, impulse, normal):
        change = p_1[..., None] * normal
        return p_1 - change, p_2 - change

    assert not reasons("momentum_after", outer)
    lowest = reasons("solve_contact_qp", lambda a, b: -1.0)
    assert not any(w in lowest for w in ("pulls", "sink", "part"))


def test_results_in_the_wrong_order_are_told_so():
    def turned(height, velocity, step, restitution, gravity):
        hits = height < 0 and velocity < 0
        after = -restitution * velocity if hits else velocity - gravity * step
        return after, height + step * after

    said = reasons("bouncing_ball_step", turned)
    assert "right, but for their order: return height, velocity." in said
    wrong = reasons("bouncing_ball_step", lambda h, v, *g: (v, h))
    assert "order" not in wrong


def test_of_a_recognised_slip_no_property_is_told_besides():
    """1/mu is no mass: that it would be too heavy a one is beside the point."""
    formula = find_exercise("effective_mass")[1].reference
    verdict = verdict_of("effective_mass", lambda *given: 1 / formula(*given))
    assert verdict.mistake is not None and verdict.reason == ()


def test_a_contact_that_pulls_apart_too_slowly_is_not_told_to_part_too_fast():
    def five_rounds(matrix, u, e):
        p = np.zeros(len(u))
        for _ in range(5):
            for i in range(len(p)):
                p[i] = max(0, p[i] - (matrix[i] @ p + (1 + e) * u[i]) / matrix[i, i])
        return p

    said = reasons("simultaneous_impulses", five_rounds)
    assert "is below 0" in said and "pushed although" not in said


def test_an_error_of_another_cause_is_not_taken_for_a_planted_one():
    """Both are refused by cvxpy's rules; only one is not a quad_form."""

    def highest(a, b):
        x = cp.Variable(len(b))
        q = 0.5 * cp.quad_form(x, cp.psd_wrap(a)) + b @ x
        cp.Problem(cp.Maximize(q), [x >= 0]).solve(solver=cp.CLARABEL)
        return x.value

    def written_out(a, b):
        x = cp.Variable(len(b))
        cp.Problem(cp.Minimize(0.5 * x.T @ a @ x + b @ x), [x >= 0]).solve()
        return x.value

    assert verdict_of("solve_contact_qp", highest).mistake is None
    assert verdict_of("solve_contact_qp", written_out).mistake is not None


def test_an_array_of_whole_numbers_is_told_where_decimals_are_lost():
    def cut(a, b, start, sweeps):
        f = np.array(start, dtype=int)
        for _ in range(sweeps):
            for i in range(len(b)):
                f[i] = max(0, f[i] - (a[i] @ f + b[i]) / a[i, i])
        return f

    assert "whole" in reasons("projected_gauss_seidel", cut)
    zeros = reasons("projected_gauss_seidel", lambda a, b, s, n: 0 * s)
    assert "whole" not in zeros


def clipped_impulse(v1, v2, n, mass_felt, e):
    u = np.clip(np.sum((v1 - v2) * n, axis=-1), 0, None)
    return (1 + e) * u * mass_felt


def bias_with_a_term_that_is_always_zero(p, n, face, body_a, body_b):
    (x_a, v_a, w_a, *_), (x_b, v_b, w_b, *_) = body_a, body_b
    n_dot = np.cross(w_b if face == "face_b" else w_a, n)
    slide = v_a + np.cross(w_a, p - x_a) - v_b - np.cross(w_b, p - x_b)
    whole = formulas.contact_bias(p, n, face, body_a, body_b)
    along = np.sum(slide * n, axis=-1) * np.sum(n * n_dot, axis=-1)
    return whole - 2 * np.sum(slide * n_dot, axis=-1) + 2 * along


def energy_by_vdot(L, omega):
    return 0.5 * np.vdot(L, omega)


@pytest.mark.parametrize(
    ("name", "answer", "said", "false"),
    [
        (
            "impulse_at_point",
            clipped_impulse,
            "It gives what v2 - v1 for v1 - v2 would give",
            ("Your u", "u < 0 picks"),
        ),
        (
            "contact_bias",
            bias_with_a_term_that_is_always_zero,
            "What you give lacks 2 (p_A_dot - p_B_dot).N_dot.",
            ("term with N_dot is missing", "only if"),
        ),
        ("angular_kinetic_energy", energy_by_vdot, "whole batch", ("np.sum",)),
    ],
)
def test_what_is_said_of_a_slip_holds_of_every_answer_with_its_numbers(
    name, answer, said, false
):
    mistake = verdict_of(name, answer).mistake
    assert mistake is not None and said in mistake.message
    assert not any(words in mistake.message for words in false)


def test_powers_that_begin_with_one_are_told_by_what_they_give():
    def times(height, e, count, gravity):
        fall = np.sqrt(2 * np.asarray(height) / gravity)[..., None]
        powers = np.asarray(e)[..., None] ** np.arange(count)
        return fall + 2 * fall * np.cumsum(powers, axis=-1)

    mistake = verdict_of("bounce_times", times).mistake
    assert mistake is not None and "2 t_0 too late" in mistake.message


def test_the_foots_formula_at_the_top_is_told_by_the_rate_it_is():
    mistakes = find_exercise("top_acceleration")[1].mistakes
    (message,) = (m.message for m in mistakes if m.name == "pattern of the foot")
    assert "the rate of omega cos(theta)" in message and "gap has" not in message


def test_an_infeasible_programme_is_told_from_a_return_left_out():
    def forces(a, b):
        f = cp.Variable(len(b))
        q = cp.quad_form(f, cp.psd_wrap(a)) / 2 + cp.sum(cp.multiply(f, b))
        cp.Problem(cp.Minimize(q), [cp.min(f) >= 0, a @ f <= b]).solve(
            solver=cp.CLARABEL
        )
        return f.value

    mistake = verdict_of("solve_contact_qp", forces).mistake
    assert mistake is not None and "no f meets all your limits" in mistake.message


def test_where_an_answer_holds_is_said_by_the_names_of_the_cases():
    def along_omega(acceleration, alpha, omega, r):
        turn = np.cross(alpha, r) - np.linalg.norm(omega) ** 3 * r
        return acceleration + turn

    (reason,) = verdict_of("free_point_acceleration", along_omega).reason
    assert reason == "Right in: nothing turns. What is special there?"


def test_no_answer_is_said_to_be_wrong_in_few_cases_only_where_batches_fail_too():
    def third(velocity, normal):
        return np.asarray(velocity)[..., 2]

    exercise = find_exercise("speed_along")[1]
    for seed in (None, 1, 2, 3):
        cases = exercise.draw(seed)
        outcomes = answers_of(third, exercise, cases)
        wrong = {
            c.label
            for c, o in zip(cases, outcomes, strict=True)
            if not judge(exercise, [c], [o]).passed
        }
        said = [
            r for r in verdict_of("speed_along", third, seed).reason if "only in" in r
        ]
        assert all(label in reason for reason in said for label in wrong)

    def wrong_for_five(a, b):
        f = formulas.pivot(a, b)
        return f if len(b) != 5 else 2 * f

    (reason,) = verdict_of("pivot", wrong_for_five).reason
    assert reason.startswith(
        "Wrong only in: five drawn contacts; five contacts, strongly coupled;"
    )


def test_of_a_bool_that_never_changes_no_more_is_said_than_was_seen():
    """It uses its arguments, and with other inputs it changes: nothing is said of that."""
    exercise = find_exercise("hulls_overlap")[1]

    def two_slips(vertices_a, normals_a, edges_a, vertices_b, normals_b, edges_b):
        products = np.cross(vertices_b[:, None], edges_b[None]).reshape(-1, 3)
        axes = np.concatenate([normals_a, normals_b, products])
        a, b = (formulas.project(v, axes) for v in (vertices_a, -vertices_b))
        return np.all(formulas.shadow_gap(*a, *b) <= 0)

    cases = exercise.draw()
    outcomes = answers_of(two_slips, exercise, cases)
    assert not any(o.values[0].any() for o in outcomes)
    later = exercise.draw(1)
    assert any(o.values[0].any() for o in answers_of(two_slips, exercise, later))
    reason = " ".join(judge(exercise, cases, outcomes).reason)
    assert "It says False in all the cases that were tried." in reason
    assert "does it use its arguments" not in reason
