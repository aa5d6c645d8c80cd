"""Right expressions that look like nobody's: solved, summed, integrated, in pieces, with symbols of any assumption."""

from collections.abc import Callable

import pytest
import sympy as sp

from course.exercises.definition import find_exercise
from course.workbook.judging import judge_here

S = sp.Symbol
POSITIVE = {"positive": True}


def sigma_of_eigenvalues():
    """The growing eigenvalue of the two equations of the wobble."""
    a, b, c, w = sp.symbols("I_1 I_2 I_3 Omega", **POSITIVE)
    rates = sp.Matrix([[0, (b - c) * w / a], [(a - b) * w / c, 0]])
    growing = [v for v in rates.eigenvals() if not v.could_extract_minus_sign()]
    return growing[0]


def sigma_by_powers():
    a, b, c, w = sp.symbols("I_1 I_2 I_3 Omega", real=True)
    return ((w / a) * (b - a)) ** sp.Rational(1, 2) * (w * (c - b) / c) ** 0.5


def sigma_of_the_slide():
    a, b, c, w = sp.symbols("I_1 I_2 I_3 Omega")
    return sp.Abs(w) * sp.sqrt(sp.expand((b - a) * (c - b))) / sp.sqrt(a * c)


def sigma_by_exponent():
    a, b, c, w = sp.symbols("I_1 I_2 I_3 Omega", **POSITIVE)
    return w * sp.exp((sp.log((b - a) / a) + sp.log((c - b) / c)) / 2)


def sigma_solved():
    a, b, c, w, s = sp.symbols("I_1 I_2 I_3 Omega s", **POSITIVE)
    square = sp.solve(sp.Eq(a * c * s, (b - a) * (c - b) * w**2), s)[0]
    return sp.Max(sp.sqrt(square), -sp.sqrt(square))


def p_solved():
    m, n, v, u, e, a, b, p = sp.symbols("m_1 m_2 v_1 v_2 e a b p")
    after = [a - v - p / m, b - u + p / n, a - b + e * (v - u)]
    return sp.solve(after, [a, b, p])[p]


def p_by_linsolve():
    m, n, v, u, e, p = sp.symbols("m_1 m_2 v_1 v_2 e p")
    speed = (v + p / m) - (u - p / n) + e * (v - u)
    return next(iter(sp.linsolve([speed], p)))[0]


def p_of_momentum():
    m, n, v, u, e = sp.symbols("m_1 m_2 v_1 v_2 e")
    common = (m * v + n * u) / (m + n)
    return m * (common - v) * (1 + e)


def p_in_pieces():
    m, n, v, u, e = sp.symbols("m_1 m_2 v_1 v_2 e", real=True)
    whole = (1 + e) * (u - v) * m * n / (m + n)
    return sp.Piecewise((whole, m > 0), (0, True))


def p_of_floats():
    m, n, v, u, e = sp.symbols("m_1 m_2 v_1 v_2 e")
    return -1.0 * (1.0 + e) * (v - u) / (n**-1 + m**-1)


def rest_by_summation():
    h, e, g = sp.symbols("h e g", **POSITIVE)
    k = S("k", integer=True)
    fall = sp.sqrt(2 * h / g)
    return fall + sp.summation(2 * fall * e**k, (k, 1, sp.oo))


def rest_by_sum_done():
    h, e, g = sp.symbols("h e g")
    k = S("k")
    return sp.sqrt(2 * h / g) * (2 * sp.Sum(e**k, (k, 0, sp.oo)).doit() - 1)


def rest_in_pieces():
    h, e, g = sp.symbols("h e g")
    rest = sp.sqrt(2 * h / g) * (1 + e) / (1 - e)
    return sp.Piecewise((rest, e < 1), (sp.oo, True))


def rest_by_speed():
    h, e, g = sp.symbols("h e g", **POSITIVE)
    v = sp.sqrt(2 * g * h)
    return v / g + 2 * v * e / g / (1 - e)


def rest_by_limit():
    h, e, g, n = sp.symbols("h e g n", **POSITIVE)
    flights = 2 * e * (1 - sp.exp(-n)) / (1 - e)
    return sp.sqrt(2 * h / g) * (1 + sp.limit(flights, n, sp.oo))


def rod_solved():
    m, v, t, e, ell, p = sp.symbols("m v theta e ell p")
    arm, inertia = ell / 2 * sp.cos(t), m * ell**2 / 12
    after = -v + p / m + p * arm**2 / inertia
    return sp.solve(sp.Eq(after, e * v), p)[0]


def rod_simplified():
    m, v, t, e = sp.symbols("m v theta e")
    return m * v * (1 + e) / (1 + 3 * sp.cos(t) ** 2)


def rod_by_double_angle():
    m, v, t, e = sp.symbols("m v theta e")
    return 2 * m * v * (1 + e) / (5 + 3 * sp.cos(2 * t))


def rod_by_matrices():
    m, v, t, e, ell = sp.symbols("m v theta e ell", **POSITIVE)
    r = sp.Matrix([ell / 2 * sp.cos(t), 0, -ell / 2 * sp.sin(t)])
    lever = r.cross(sp.Matrix([0, 0, 1]))
    return (1 + e) * v / (1 / m + lever.dot(lever) * 12 / (m * ell**2))


def rod_by_integral():
    m, v, t, e, ell, x = sp.symbols("m v theta e ell x", **POSITIVE)
    inertia = sp.integrate(m / ell * x**2, (x, -ell / 2, ell / 2))
    return (1 + e) * v / (1 / m + (ell * sp.cos(t) / 2) ** 2 / inertia)


def rate_of_gap(order: int) -> sp.Expr:
    """The gap of the ladder's top, differentiated as functions of time, and the rates put in."""
    time, ell = S("t"), S("ell")
    y, angle = sp.Function("y")(time), sp.Function("q")(time)
    rate = sp.diff(-y - ell / 2 * sp.cos(angle), time, order)
    names = [(y, "v_y", "a_y"), (angle, "omega", "alpha")]
    for function, first, second in names:
        rate = rate.subs(sp.diff(function, time, 2), S(second))
        rate = rate.subs(sp.diff(function, time), S(first))
    return rate.subs(angle, S("theta"))


def top_rate_by_chain():
    v, w, t, ell = sp.symbols("v_y omega theta ell")
    return -v + sp.diff(-ell / 2 * sp.cos(t), t) * w


def top_rate_by_cosine():
    v, w, t, ell = sp.symbols("v_y omega theta ell")
    return -v + w * ell * sp.cos(sp.pi / 2 - t) / 2


def top_rate_by_half_angles():
    v, w, t, ell = sp.symbols("v_y omega theta ell", real=True)
    return -(v - ell * w * sp.sin(t / 2) * sp.cos(t / 2))


def top_rate_by_cross():
    v, w, t, ell = sp.symbols("v_y omega theta ell")
    spin, arm = sp.Matrix([w, 0, 0]), ell / 2 * sp.Matrix([0, sp.cos(t), sp.sin(t)])
    return -v - spin.cross(arm)[1]


def acceleration_by_chain():
    a, al, w, t, ell = sp.symbols("a_y alpha omega theta ell")
    rate = ell / 2 * w * sp.sin(t)
    return -a + sp.diff(rate, w) * al + sp.diff(rate, t) * w


def acceleration_by_series():
    a, al, w, t, ell, h = sp.symbols("a_y alpha omega theta ell h")
    angle = t + h * w + h**2 * al / 2
    return -a - sp.diff(ell / 2 * sp.cos(angle), h, 2).subs(h, 0)


def acceleration_expanded():
    a, al, w, t, ell = sp.symbols("a_y alpha omega theta ell", real=True)
    return sp.expand((al * sp.sin(t) + w * w * sp.cos(t)) * ell * 0.5 - a)


def acceleration_as_amplitude():
    a, al, w, t, ell = sp.symbols("a_y alpha omega theta ell", real=True)
    size = sp.sqrt(al**2 + w**4)
    return ell / 2 * size * sp.cos(t - sp.atan2(al, w**2)) - a


def ladder_by_levers():
    m, t, ell = sp.symbols("mass theta ell", **POSITIVE)
    return (-ell / 2 * sp.cos(t)) * (ell / 2 * sp.sin(t)) / (m * ell**2 / 12)


def ladder_by_double_angle():
    m, t = sp.symbols("mass theta")
    return sp.Rational(-3, 2) * sp.sin(2 * t) / m


def ladder_by_vectors():
    m, t, ell = sp.symbols("mass theta ell", **POSITIVE)
    foot = sp.Matrix([0, -ell * sp.cos(t), -ell * sp.sin(t)]) / 2
    top = -foot
    n_1, n_2 = sp.Matrix([0, 0, 1]), sp.Matrix([0, -1, 0])
    turning = (top.cross(n_2) * 12 / (m * ell**2)).cross(foot)
    return sp.simplify(n_1.dot(n_2 / m + turning))


def ladder_by_tangent():
    m, t = sp.symbols("mass theta")
    return -3 * sp.tan(t) / (1 + sp.tan(t) ** 2) / m


def ladder_by_exponentials():
    m, t = sp.symbols("mass theta", real=True)
    return -3 * sp.im(sp.exp(2 * sp.I * t)) / (2 * m)


def quadratic() -> tuple[sp.Expr, sp.Symbol]:
    a, b, c, f, g, k, n = sp.symbols("a_11 a_12 a_22 f_1 f_2 b_1 b_2")
    return (a * f**2 + 2 * b * f * g + c * g**2) / 2 + k * f + n * g, f


def slope_by_matrix():
    a, b, c, f, g, k, n = sp.symbols("a_11 a_12 a_22 f_1 f_2 b_1 b_2")
    return (sp.Matrix([[a, b], [b, c]]) @ sp.Matrix([f, g]) + sp.Matrix([k, n]))[0]


def slope_by_difference():
    q, f = quadratic()
    h = S("h")
    return sp.simplify((q.subs(f, f + h) - q.subs(f, f - h)) / (2 * h))


def slope_by_limit():
    q, f = quadratic()
    h = S("h")
    return sp.limit(sp.expand((q.subs(f, f + h) - q) / h), h, 0)


def slope_by_coefficients():
    q, f = quadratic()
    whole = sp.Poly(q, f)
    return 2 * f * whole.coeff_monomial(f**2) + whole.coeff_monomial(f)


RIGHT: dict[str, list[Callable[[], sp.Expr]]] = {
    "sigma": [
        sigma_of_eigenvalues,
        sigma_by_powers,
        sigma_of_the_slide,
        sigma_by_exponent,
        sigma_solved,
    ],
    "p_hat": [p_solved, p_by_linsolve, p_of_momentum, p_in_pieces, p_of_floats],
    "rest_time": [
        rest_by_summation,
        rest_by_sum_done,
        rest_in_pieces,
        rest_by_speed,
        rest_by_limit,
    ],
    "rod_impulse": [
        rod_solved,
        rod_simplified,
        rod_by_double_angle,
        rod_by_matrices,
        rod_by_integral,
    ],
    "top_rate": [
        lambda: rate_of_gap(1),
        top_rate_by_chain,
        top_rate_by_cosine,
        top_rate_by_half_angles,
        top_rate_by_cross,
    ],
    "top_acceleration": [
        lambda: rate_of_gap(2),
        acceleration_by_chain,
        acceleration_by_series,
        acceleration_expanded,
        acceleration_as_amplitude,
    ],
    "ladder_entry": [
        ladder_by_levers,
        ladder_by_double_angle,
        ladder_by_vectors,
        ladder_by_tangent,
        ladder_by_exponentials,
    ],
    "slope_1": [
        lambda: sp.diff(*quadratic()),
        slope_by_matrix,
        slope_by_difference,
        slope_by_limit,
        slope_by_coefficients,
    ],
}


@pytest.mark.parametrize(("name", "number"), [(n, i) for n in RIGHT for i in range(5)])
@pytest.mark.slow
def test_it_passes(name, number):
    exercise = find_exercise(name)[1]
    verdict = judge_here(exercise, RIGHT[name][number]())
    assert verdict.passed, (verdict.reason, verdict.difference)
