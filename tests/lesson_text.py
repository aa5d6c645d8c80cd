"""What a lesson says: its text as one string, a number read from a sentence of it, and whether a value rounds to it."""

import json
import re
from functools import cache
from pathlib import Path

SOLUTIONS = Path(__file__).resolve().parents[1] / "solutions"


@cache
def prose(lesson):
    """All text cells of a lesson, "05" or "05-more", in one string of single spaces."""
    found = SOLUTIONS.glob(f"{lesson[:2]}-*.ipynb")
    deeper = lesson.endswith("-more")
    (path,) = (p for p in found if p.stem.endswith("-more") == deeper)
    cells = json.loads(path.read_text(encoding="utf-8"))["cells"]
    texts = ("".join(c["source"]) for c in cells if c["cell_type"] == "markdown")
    return " ".join(" ".join(texts).split())


def said(lesson, sentence):
    """The numbers of a sentence, as they are written; each stands as ``#`` in what is given.

    The sentence must stand in the lesson exactly once.
    """
    number = r"([-\N{MINUS SIGN}]?[\d,]*\.?\d+(?:e-?\d+)?)"
    pattern = re.escape(" ".join(sentence.split())).replace(r"\#", number)
    found = re.findall(pattern, prose(lesson))
    assert len(found) == 1, f"lesson {lesson} says {len(found)} times {sentence!r}"
    return [found[0]] if isinstance(found[0], str) else list(found[0])


def rounds_to(value, written):
    """Whether a value, rounded to the last digit written, is what is written."""
    plain = written.replace(",", "").replace("\N{MINUS SIGN}", "-")
    mantissa, _, power = plain.partition("e")
    last = len(mantissa.partition(".")[2]) - int(power or 0)
    zeros = len(mantissa) - len(mantissa.rstrip("0")) if "," in written else 0
    return abs(value - float(plain)) <= 0.5000001 * 10.0 ** (zeros - last)
