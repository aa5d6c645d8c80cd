"""The gaps of a ladder; its forces are tested on the scene."""

import numpy as np

from course.dynamics import (
    ladder_gaps,
)


def test_gaps_of_a_batch():
    found = ladder_gaps(
        np.array([-2.0, -3.0]), 1.0, np.array([0.0, np.pi / 2]), length=2.0
    )
    np.testing.assert_allclose(found, [[1.0, 1.0], [0.0, 3.0]], atol=1e-15)
