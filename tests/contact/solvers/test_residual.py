"""The residual, against its definition row by row."""

import numpy as np
import pytest

from course.contact.solvers import complementarity_residual


def residual(a, f, b):
    """The definition, row by row."""
    w, worst = a @ f + b, 0.0
    for i in range(len(b)):
        scale = np.abs(a[i]) @ np.abs(f) + np.abs(b).max()
        if scale > 0:
            worst = max(worst, abs(min(a[i, i] * f[i], w[i])) / scale)
    return worst


def test_residual_by_definition_and_batched():
    rng = np.random.default_rng(35)
    g = rng.normal(size=(4, 3, 5))
    a, f, b = (
        np.swapaxes(g, -1, -2) @ g,
        rng.normal(size=(4, 5)),
        rng.normal(size=(4, 5)),
    )
    batch = complementarity_residual(a, f, b)
    assert np.allclose(batch, [residual(a[i], f[i], b[i]) for i in range(4)])
    assert complementarity_residual(np.zeros((0, 0)), np.zeros(0), np.zeros(0)) == 0
    assert complementarity_residual(np.eye(2), np.zeros(2), np.zeros(2)) == 0
    assert complementarity_residual(np.eye(1), [2.0], [-1.0]) == pytest.approx(1 / 3)
    assert complementarity_residual(np.eye(1), [-1.0], [1.0]) == pytest.approx(1 / 2)


def test_refuses_another_shape():
    with pytest.raises(ValueError, match=r"force: expected shape \(\.\.\., 2\)"):
        complementarity_residual(np.eye(2), [1.0], [1.0, 1.0])
