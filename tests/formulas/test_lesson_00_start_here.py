"""Lesson 00 against the cosine."""

import numpy as np

from course import formulas


def test_speed_along_is_the_speed_times_the_cosine():
    rng = np.random.default_rng(1)
    normal, across = np.linalg.qr(rng.normal(size=(4, 5, 3, 2)))[0].transpose(
        3, 0, 1, 2
    )
    angle, speed = rng.uniform(0, np.pi, (4, 5)), rng.uniform(1, 3, (4, 5))
    velocity = speed[..., None] * (
        np.cos(angle)[..., None] * normal + np.sin(angle)[..., None] * across
    )
    found = formulas.speed_along(velocity, normal)
    np.testing.assert_allclose(found, speed * np.cos(angle), atol=1e-14)
