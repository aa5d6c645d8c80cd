"""Names as they are written: d_ddot and m/s^2 in a sentence become d̈ and m/s².

Messages are written with the keys that every keyboard has; this is the one place that
sets them in letters. It knows a closed list of words and signs, and leaves alone what is
code: anything in backticks or quotes, calls, indices, dotted names, assignments.
"""

from __future__ import annotations

import re
import unicodedata

GREEK = {
    "alpha": "α", "delta": "δ", "epsilon": "ε", "theta": "θ", "lambda": "λ", "mu": "μ", "pi": "π", "rho": "ρ",
    "sigma": "σ", "tau": "τ", "phi": "φ", "omega": "ω", "Omega": "Ω",
}  # fmt: skip
ACCENTS = {"dot": "\N{COMBINING DOT ABOVE}", "ddot": "\N{COMBINING DIAERESIS}",
           "hat": "\N{COMBINING CIRCUMFLEX ACCENT}"}  # fmt: skip
SIGNS = {"<=": "≤", ">=": "≥", "!=": "≠", "<-": "←", "->": "→"}
RAISED = str.maketrans("0123456789-+ijknt", "⁰¹²³⁴⁵⁶⁷⁸⁹⁻⁺ⁱʲᵏⁿᵗ")
LOWERED = str.maketrans("0123456789ijk", "₀₁₂₃₄₅₆₇₈₉ᵢⱼₖ")

_GREEK = "|".join(GREEK)
_FUNCTION = r"(?:exp|sin|cos|tan|sqrt|max|min|abs|log|ln)"
_BRACKETS = r"\((?:[^()]|\((?:[^()]|\([^()]*\))*\))*\)"
#: What is left as it is.
_CODE = re.compile(
    rf"""`[^`]*`
    | "[^"]*"
    | (?<!\w)'\w+'(?!\w)                                       # quoted; R' is no quote
    | (?<![\w.])(?!{_FUNCTION}\()[A-Za-z_][\w.]*\w{_BRACKETS}  # a call
    | [A-Za-z_][\w.]*(?:\[[^\]]*\])+                           # an index
    | (?<!\w)(?!(?:{_GREEK})\.)[a-z]\w+(?:\.\w+)+              # np.sum
    | (?<![\w.])\w+=\S+                                        # axis=-1
    | \S+\s@\s\S+(?:\s@\s\S+)*                                 # A @ b
    """,
    re.VERBOSE,
)
_INDEX = r"(?:\d+|[ijk]{1,2}|[A-Zxyz])"
_ANY_NAME = rf"(?:{_GREEK}|[A-Za-z])(?:_{_INDEX})?(?:_(?:dot|ddot|hat))?(?:_{_INDEX})?"
_NAME = re.compile(
    rf"(?<![\w.])(?P<base>{_GREEK}|max|min|[A-Za-z])(?:_(?P<first>{_INDEX}))?"
    rf"(?:_(?P<accent>dot|ddot|hat))?(?:_(?P<second>{_INDEX}))?(?!\w)"
)
_DOT_PRODUCT = re.compile(
    rf"(?:(?<![\w.])({_ANY_NAME}'?)|(?<=\)))\.(?!T\b|g\.|e\.)(?={_ANY_NAME}(?!\w)|\()"
)
#: One letter with what belongs to it, once names are set.
_ATOM = r"(?<![\w.])[^\W\d_](?:[\u0300-\u036f₀-₉ᵢⱼₖ]|_[A-Zxyz])*'?"


def with_letters(text: str) -> str:
    """A sentence with its names and signs as they are written; its code as it was."""
    parts, end = [], 0
    for code in _CODE.finditer(text):
        parts += [_set(text[end : code.start()]), code.group()]
        end = code.end()
    return "".join([*parts, _set(text[end:])])


def _set(text: str) -> str:
    """Prose alone: first the names, then what stands at and between them."""
    text = re.sub(r"(?<![\w*])\*(\w[\w ]*)\*(?![\w*])", r"\1", text)  # *all*
    text = re.sub(r"(?<![\w.])([mpv])(\d)(?!\w)", r"\1_\2", text)
    text = _DOT_PRODUCT.sub(lambda m: f"{m.group(1) or ''}·", text)
    text = _NAME.sub(_name, text)
    text = re.sub(r"(?<=\))_([ijk\d])(?!\w)", lambda m: _low(m.group(1)), text)
    text = re.sub(
        r"(?<=[\w)\]'|])\^(-?\d+|[ijknt](?!\w))",
        lambda m: m.group(1).translate(RAISED),
        text,
    )
    text = re.sub(
        rf"({_ATOM}|\)|(?<!\w)\d) x (?=[^\W\d_](?:\W|_[A-Z]|\d|[ᵢⱼₖ])|\(|\d)",
        r"\1 × ",
        text,
    )
    text = re.sub(r"(?<=[\d)]) \* (?=\(|\d|[a-z]{3}\()", " · ", text)
    text = re.sub(r"(?<![\w.])sqrt(?=\()", "√", text)
    return re.sub(r"(?<=\s)(?:<=|>=|!=|<-|->)(?=\s)", lambda m: SIGNS[m.group()], text)


def _name(found: re.Match[str]) -> str:
    base, first, accent, second = found.group("base", "first", "accent", "second")
    if not (first or accent or second) and base not in GREEK:
        return base
    letter = unicodedata.normalize(
        "NFC", GREEK.get(base, base) + ACCENTS.get(accent or "", "")
    )
    return letter + _low(first) + _low(second)


def _low(index: str | None) -> str:
    if index is None:
        return ""
    return index.translate(LOWERED) if index[0] in "0123456789ijk" else f"_{index}"
