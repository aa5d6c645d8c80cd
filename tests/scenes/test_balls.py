"""Balls about to hit one another."""

import numpy as np
import pytest

from course.scenes import rack


def test_rack_is_fifteen_touching_balls():
    x = rack(radius=0.5)
    distance = np.linalg.norm(x[:, None] - x, axis=-1)[np.triu_indices(15, 1)]
    assert x.shape == (15, 3) and distance.min() == pytest.approx(1)
    assert (
        np.count_nonzero(distance < 1 + 1e-9) == 30
    )  # 10 + 10 + 10 along the three directions
    assert np.all(x[0] == 0) and x[:, 0].max() == pytest.approx(4 * np.sqrt(0.75))
