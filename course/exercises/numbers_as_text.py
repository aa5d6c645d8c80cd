"""Values as text: as code that gives them again, or short, to be read."""

from __future__ import annotations

from typing import Any

import numpy as np


def code(value: Any) -> str:
    """A value as code that reproduces it exactly, where NumPy is imported as ``np``."""
    if isinstance(value, tuple):
        return f"({', '.join(code(part) for part in value)}{',' if len(value) == 1 else ''})"
    if isinstance(value, np.ndarray) and value.ndim:
        if not value.size:
            return f"np.zeros({value.shape}, dtype={value.dtype.name!r})"
        form: Any = {"float_kind": _number} if value.dtype.kind == "f" else None
        text = np.array2string(
            value,
            separator=", ",
            threshold=10_000,
            max_line_width=100,
            formatter=form,
            prefix="np.array(",
        )
        return f"np.array({text})"
    plain = value.item() if isinstance(value, (np.ndarray, np.generic)) else value
    return _number(plain) if isinstance(plain, float) else repr(plain)


def short(value: Any) -> str:
    """A value for reading: ten digits."""
    array = np.asarray(value)
    if array.dtype.kind == "f":
        if array.ndim == 0:
            return f"{float(array):.10g}"
        return np.array2string(
            array, separator=", ", precision=10, threshold=12, max_line_width=90
        )
    return repr(value.item()) if isinstance(value, np.generic) else str(value)


def _number(value: float) -> str:
    if np.isfinite(value):
        return repr(float(value))
    return "np.nan" if np.isnan(value) else "np.inf" if value > 0 else "-np.inf"
