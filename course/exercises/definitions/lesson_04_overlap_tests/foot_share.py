"""The exercise ``foot_share``, the last step of the derivation: inputs and planted mistakes."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from course import formulas
from course.exercises.definition import Case, Exercise, Mistake, Value
from course.exercises.slips import slip

_DOT, _SQUARE = "(p_1 * b_1 + p_2 * b_2 + p_3 * b_3)", "(b_1**2 + b_2**2 + b_3**2)"
_FORMULA = f"{_DOT} / {_SQUARE}"


def _points(rng: np.random.Generator) -> Sequence[Case]:
    p, b = rng.uniform(0.5, 2.5, (2, 3, 8)) * np.where(
        rng.uniform(size=(2, 3, 8)) < 0.4, -1.0, 1.0
    )
    drawn = {f"p_{i + 1}": p[i] for i in range(3)}
    drawn |= {f"b_{i + 1}": b[i] for i in range(3)}
    by_hand = {"p_1": 3.0, "p_2": 0.0, "p_3": 3.0, "b_1": 2.0, "b_2": 1.0, "b_3": 2.0}
    return [
        Case("the numbers worked by hand", by_hand),
        Case("eight drawn points", drawn, "batch"),
    ]


def _clamped(p_1, p_2, p_3, b_1, b_2, b_3):
    import sympy as sp

    share = formulas.foot_share(p_1, p_2, p_3, b_1, b_2, b_3)
    return sp.Min(1, sp.Max(0, share))


def _wrong(name: str, message: str, *edits: str) -> Mistake:
    return Mistake(name, slip(formulas.foot_share, *edits), message)


FOOT_SHARE = Exercise(
    name="foot_share",
    kind="expression",
    rows=(3,),
    points=2,
    minutes=6,
    task="Give the s at which the place s b on the line through 0 and b is nearest to p, in p_1 to p_3 and b_1 to b_3.",
    arguments=(
        *(Value(f"p_{i}", "scalar", "m", f"coordinate {i} of the point") for i in (1, 2, 3)),
        *(Value(f"b_{i}", "scalar", "m", f"coordinate {i} of the end") for i in (1, 2, 3)),
    ),
    results=(Value("foot_share", "(...)", "", "share of the way from 0 to b"),),
    reference=formulas.foot_share,
    cases=_points,
    mistakes=(
        _wrong(
            "not divided",
            "That is p.b, in m^2. A share of the way has no unit: what does it have to be divided by?",
            _FORMULA,
            _DOT,
        ),
        _wrong(
            "no brackets",
            "Division comes before addition: only the last product is divided, and only by the first square. Put the "
            "numerator in brackets, and the denominator.",
            _FORMULA,
            f"{_DOT[1:-1]} / {_SQUARE[1:-1]}",
        ),
        _wrong(
            "denominator without brackets",
            "Division comes before addition: you divide by the first square only. Put the denominator in brackets.",
            _FORMULA,
            f"{_DOT} / {_SQUARE[1:-1]}",
        ),
        _wrong(
            "numerator without brackets",
            "Division comes before addition: only the last product is divided. Put the numerator in brackets.",
            _FORMULA,
            f"{_DOT[1:-1]} / {_SQUARE}",
        ),
        _wrong(
            "divided by the length",
            "Divided by the length of b it is a length in metres, how far along the line the foot lies. A share has "
            "no unit.",
            _SQUARE,
            f"{_SQUARE} ** 0.5",
        ),
        _wrong(
            "length by length",
            "That is how long p is, in lengths of b. It counts only how far p lies *along* b, and a dot product "
            "measures that.",
            _FORMULA,
            f"((p_1**2 + p_2**2 + p_3**2) / {_SQUARE}) ** 0.5",
        ),
        _wrong(
            "upside down",
            "That is one over the share. The further p lies along b, the larger s must be.",
            _FORMULA,
            f"{_SQUARE} / {_DOT}",
        ),
        _wrong(
            "divided by p",
            "You divide by the square of p. The way runs from 0 to b: for p = b both are the same, for p = 2 b the "
            "foot is at s = 2.",
            _SQUARE,
            "(p_1**2 + p_2**2 + p_3**2)",
        ),
        _wrong(
            "sign",
            "The sign is reversed: for p = b the nearest place is b itself, s = 1.",
            _DOT,
            f"-{_DOT}",
        ),
        _wrong(
            "twice",
            "A factor of 2 is left over. The derivative of s^2 has one, and so has the middle term: they cancel.",
            _DOT,
            f"2 * {_DOT}",
        ),
        _wrong(
            "half",
            "A factor of 1/2 is left over. The derivative of s^2 has a 2, and so has the middle term: they cancel.",
            _SQUARE,
            f"(2 * {_SQUARE})",
        ),
        Mistake(
            "clamped",
            _clamped,
            "Asked is the place on the whole *line*, which may lie before 0 or beyond b. What a segment makes of it "
            "comes in Build.",
        ),
    ),
    hints=(
        "Write |p - s b|^2 as a polynomial in s: c_0 + c_1 s + c_2 s^2. What are c_1 and c_2 in dot products?",
        "Its derivative is c_1 + 2 c_2 s, with c_1 = -2 p.b and c_2 = b.b. Set it to 0.",
        "foot_share = (p_1 * b_1 + ____ + ____) / (b_1**2 + ____)",
    ),
)  # fmt: skip
