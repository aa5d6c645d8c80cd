"""Non-negative least squares: the optimality conditions, and what is refused."""

import numpy as np
import pytest

from course.contact.solvers import nonnegative_least_squares


def test_least_squares_meet_their_optimality_conditions():
    rng = np.random.default_rng(33)
    for _ in range(200):
        m, c = rng.integers(1, 12, 2)
        f, t = (
            rng.normal(size=(m, c)) * 10 ** rng.uniform(-4, 4, size=c),
            rng.normal(size=m),
        )
        x = nonnegative_least_squares(f, t)
        gradient = f.T @ (f @ x - t)
        length = np.linalg.norm(f, axis=0)
        assert x.min() >= 0
        assert np.abs(
            np.minimum(x * length, gradient / length)
        ).max() < 1e-12 * np.linalg.norm(t) * (1 + (x * length).max())


def test_columns_of_zeros_and_none_at_all():
    assert nonnegative_least_squares(np.zeros((3, 2)), np.ones(3)).tolist() == [0, 0]
    assert nonnegative_least_squares(np.empty((0, 2)), np.empty(0)).tolist() == [0, 0]
    assert nonnegative_least_squares(np.empty((3, 0)), np.ones(3)).shape == (0,)
    assert nonnegative_least_squares([[2.0, 0.0]], [4.0]).tolist() == [2, 0]


@pytest.mark.parametrize(
    "call, message",
    [
        (lambda: nonnegative_least_squares(np.eye(2), [1.0]), r"target: expected shape \(2,\)"),
        (lambda: nonnegative_least_squares([1.0, 2.0], [1.0]), r"columns: expected shape \(m, c\)"),
    ],
)  # fmt: skip
def test_refuses(call, message):
    with pytest.raises(ValueError, match=message):
        call()
