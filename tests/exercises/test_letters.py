"""Names as they are written: prose set in letters, code left as it is."""

import re
import unicodedata

import pytest

from course.exercises.definition import all_lessons
from course.exercises.letters import with_letters
from course.exercises.message import Message, Part


def nfc(text):
    return unicodedata.normalize("NFC", text)


@pytest.mark.parametrize(
    ("typed", "written"),
    [
        ("add p_hat n, at most p_hat/m_1", "add p̂ n, at most p̂/m₁"),
        ("d_dot, d_ddot and N_dot; d_ddot_i, p_A_ddot, d_2_dot", "ḋ, d̈ and Ṅ; d̈ᵢ, p̈_A, ḋ₂"),
        ("omega_dot = I^-1 (tau + L x omega)", "ω̇ = I⁻¹ (τ + L × ω)"),
        ("in m/s^2, e^2 of it, |q|^2, (1 - e)^2, twice e^k", "in m/s², e² of it, |q|², (1 - e)², twice eᵏ"),
        ("f >= 0 where w <= 0; f_i <- 0", "f ≥ 0 where w ≤ 0; fᵢ ← 0"),
        ("v.n, L.omega/2, omega.omega, (v1' - v2').n, N_i.N_j/m", "v·n, L·ω/2, ω·ω, (v₁' - v₂')·n, Nᵢ·Nⱼ/m"),
        ("N.(p_A_dot - p_B_dot) + N_dot.(p_A - p_B)", "N·(ṗ_A - ṗ_B) + Ṅ·(p_A - p_B)"),
        ("(omega_A x e_A) x e_B", "(ω_A × e_A) × e_B"),
        ("(A p)_i, max_j |b_j|", "(A p)ᵢ, maxⱼ |bⱼ|"),
        ("of *all* axes, the *new* one", "of all axes, the new one"),
        ("3 * (-0.5), t_0 = sqrt(2 h/g), exp(sigma t)", "3 · (-0.5), t₀ = √(2 h/g), exp(σ t)"),
        ("ln(1/delta)/sigma", "ln(1/δ)/σ"),
        ("a factor of pi", "a factor of π"),
    ],
)  # fmt: skip
def test_prose_is_set_in_letters(typed, written):
    assert nfc(with_letters(typed)) == nfc(written)
    assert with_letters(with_letters(typed)) == with_letters(typed)


@pytest.mark.parametrize(
    "code",
    [
        "np.sum(a * b, axis=-1) and np.cross(omega, r)", "check(p_hat, \"p_hat\") or hint('p_hat')", "`d_dot <= omega`",
        "impulse[..., None] * normal", "mass_2 may be infinite", "Rotation.from_rotvec(theta).as_matrix()",
        "f.T @ a @ f", "np.linalg.norm(theta)", '"...ij,...j->...i"', "* multiplies entry by entry", "step * velocity",
        "I_body acts", "e.g. a sum, i.e. it adds", "of the sum. The rest", "R' I R", "an x for each",
        "axis=-1, rate_2=omega",
    ],
)  # fmt: skip
def test_code_and_plain_words_are_left(code):
    assert with_letters(code) == code


def texts():
    for lesson in all_lessons():
        for e in lesson.exercises:
            yield from (e.task, *e.hints[:2])
            yield from (rule.message for rule in (*e.mistakes, *e.properties))
        for p in lesson.predictions:
            yield from (p.question, p.explanation)
            yield from (*p.choices.values(), *p.wrong.values())


TYPED = re.compile(
    r"(?<![\w.(])(?:omega|sigma|theta|[a-zA-Z]_(?:hat|dot|ddot))(?![\w(,])"
    r"|\^\d|(?<=\w )(?:<=|>=)(?= \w)"
)


def test_no_lesson_s_prose_is_left_half_set():
    """What still looks typed, outside code, is what the table does not know."""
    assert sum(bool(TYPED.search(text)) for text in texts()) > 100
    assert [t for t in texts() if TYPED.search(with_letters(t))] == []


def test_units_are_written_with_letters():
    units = {v.unit for le in all_lessons() for e in le.exercises for v in (*e.arguments, *e.results)}  # fmt: skip
    assert {unit for unit in units if with_letters(unit) != unit} == set()


def test_only_prose_is_set_and_only_where_it_is_shown():
    parts = (Part("a", "p_hat", "prose"), Part("b", "p_hat"), Part("c", "p_hat", "code"))  # fmt: skip
    message = Message("wrong", "Not yet: p_hat", parts)
    assert [line.split()[-1] for line in str(message).splitlines()] == ["p_hat", "p̂", "p_hat", "p_hat"]  # fmt: skip
    assert message.html().count("p_hat") == 3 and message.html().count("p̂") == 1
    assert message.parts == parts
