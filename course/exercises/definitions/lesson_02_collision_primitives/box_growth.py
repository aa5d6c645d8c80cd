"""The exercise ``box_growth``, the last step of the derivation: inputs and planted mistakes."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from course import formulas
from course.exercises.definition import Case, Exercise, Mistake, Value
from course.exercises.slips import slip

_BARS = "c, s = abs(sp.cos(theta)), abs(sp.sin(theta))"
_FORMULA = "(e_1 * c + e_2 * s) * (e_1 * s + e_2 * c) / (e_1 * e_2)"


def _rods(rng: np.random.Generator) -> Sequence[Case]:
    """Turns into all four quarters: in the first alone nobody misses the bars."""
    theta = np.radians(rng.uniform(10.0, 80.0, 8) + 90.0 * (np.arange(8) % 4)).round(3)
    drawn = {
        "e_1": rng.uniform(0.5, 3.0, 8).round(2),
        "e_2": rng.uniform(0.1, 0.4, 8).round(2),
        "theta": theta,
    }
    by_hand = {"e_1": 3.0, "e_2": 2.0, "theta": float(np.arccos(0.8))}
    return [
        Case("the numbers worked by hand", by_hand),
        Case("eight drawn rods", drawn, "batch"),
    ]


def _slip(name: str, *edits: str, message: str) -> Mistake:
    return Mistake(name, slip(formulas.box_growth, *edits), message)


BOX_GROWTH = Exercise(
    name="box_growth",
    kind="expression",
    rows=(4,),
    points=2,
    minutes=7,
    task="Give the volume of the upright box around the turned rod over the rod's own, in e_1, e_2 and theta.",
    arguments=(
        Value("e_1", "scalar", "m", "half the rod's length"),
        Value("e_2", "scalar", "m", "half its thickness in the plane of the turn"),
        Value("theta", "scalar", "rad", "by which it is turned, any angle"),
    ),
    results=(Value("box_growth", "(...)", "", "how many times the rod's volume"),),
    reference=formulas.box_growth,
    cases=_rods,
    mistakes=(
        _slip(
            "no bars",
            _BARS,
            "c, s = sp.cos(theta), sp.sin(theta)",
            message="Right up to 90 degrees. Beyond, a cosine or a sine is below 0 and shortens the box; but each "
            "corner's signs are chosen so that both terms add up. The bars belong around each.",
        ),
        _slip(
            "bars around the sum",
            _BARS,
            "c, s = sp.cos(theta), sp.sin(theta)",
            _FORMULA,
            "abs(e_1 * c + e_2 * s) * abs(e_1 * s + e_2 * c) / (e_1 * e_2)",
            message="The bars are around a sum, so it is one corner or the one across. The other two corners reach "
            "farther in some quarters: each term has its own bars.",
        ),
        _slip(
            "one corner",
            _BARS,
            "c, s = sp.cos(theta), sp.sin(theta)",
            _FORMULA,
            "(e_1 * c - e_2 * s) * (e_1 * s + e_2 * c) / (e_1 * e_2)",
            message="You took both sides from the same corner, (e_1, e_2). The corner that reaches farthest along x "
            "is not the one that reaches farthest along y.",
        ),
        _slip(
            "one side only",
            _FORMULA,
            "(e_1 * c + e_2 * s) / e_1",
            message="That is how many times longer the box is along x. The volume needs the other side of the box "
            "as well; only the third one is as it was.",
        ),
        _slip(
            "no thickness",
            _FORMULA,
            "e_1 * c * s / e_2",
            message="You took the rod for a line: at 45 degrees that gives 50, not 51.005. A corner lies off the "
            "rod's middle line by e_2.",
        ),
        _slip(
            "the other way up",
            _FORMULA,
            "(e_1 * e_2) / ((e_1 * c + e_2 * s) * (e_1 * s + e_2 * c))",
            message="That is the rod over the box, below 1. Asked is the box over the rod.",
        ),
        _slip(
            "box at any angle",
            _FORMULA,
            "(e_1**2 + e_2**2) / (e_1 * e_2)",
            message="theta does not occur in it: that is the square that holds the rod at every angle, with the "
            "diagonal as its side.",
        ),
        _slip(
            "whole over half",
            "/ (e_1 * e_2)",
            "* 4 / (e_1 * e_2)",
            message="Four times too large: whole sides of the box over half sides of the rod. Take halves, or wholes, "
            "in both.",
        ),
        _slip(
            "volume of the box",
            " / (e_1 * e_2)",
            "",
            message="That is an area, a quarter of the box's. Divide it by the rod's own, e_1 e_2.",
        ),
        _slip(
            "degrees",
            _BARS,
            "c, s = abs(sp.cos(sp.pi * theta / 180)), abs(sp.sin(sp.pi * theta / 180))",
            message="You turn theta from degrees to radians, but it is in radians already: sp.cos and sp.sin take it "
            "as it is.",
        ),
        _slip(
            "minus along x",
            _FORMULA,
            "(e_1 * c - e_2 * s) * (e_1 * s + e_2 * c) / (e_1 * e_2)",
            message="With its bars each term is how far one side reaches. The farthest corner has both terms added, "
            "along x as along y: there is no minus.",
        ),
        _slip(
            "minus along y",
            _FORMULA,
            "(e_1 * c + e_2 * s) * (e_1 * s - e_2 * c) / (e_1 * e_2)",
            message="With its bars each term is how far one side reaches. The farthest corner has both terms added, "
            "along y as along x: there is no minus.",
        ),
        _slip(
            "one side squared",
            _FORMULA,
            "(e_1 * c + e_2 * s) ** 2 / (e_1 * e_2)",
            message="You take the reach along x for both sides of the box. Along y the sine and the cosine change "
            "places.",
        ),
        _slip(
            "three sides",
            _FORMULA,
            "(e_1 * c + e_2 * s) ** 2 * (e_1 * s + e_2 * c) / (e_1**2 * e_2)",
            message="One side is in it twice. The turn is in a plane: two sides change, and the third cancels.",
        ),
    ),
    hints=(
        "How far does the box reach along x, and how far along y? Take each from the corner that reaches farthest, "
        "whose signs you may choose. SymPy writes a size sp.Abs(x).",
        "Along x the corner (±e_1, ±e_2) lands at ±e_1 cos(theta) ∓ e_2 sin(theta). The largest of the four has both "
        "terms above 0: sp.Abs, around each of them. Multiply both half sides and divide by e_1 e_2.",
        "c, s = abs(sp.cos(theta)), abs(sp.sin(theta))\n"
        "box_growth = (e_1 * c + ____) * (____) / (e_1 * e_2)",
    ),
)
