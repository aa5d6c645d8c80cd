"""The proof that there is no contact force, and that it is never given where there is one."""

import numpy as np
import pytest
from scipy.sparse import csr_array

from course.contact import solve
from course.contact.engine.certificates import certificate
from course.scenes import (
    random_scene,
    side_by_side,
    spinning_between_pins,
    stack,
    table,
    wall,
)

pytestmark = pytest.mark.slow  # with its like, left out of --quick


def proves(system, y):
    np.testing.assert_allclose(system.A @ y, 0, atol=1e-12)
    assert np.all(y >= 0) and y.max() == 1 and system.b @ y < 0


@pytest.mark.parametrize("rate", [1e-3, 1.0, 30.0])
def test_pins_with_and_without_a_guess(rate):
    system = side_by_side([stack(3), spinning_between_pins(rate), table()]).system()
    proves(system, certificate(system.A, system.b))
    guess = np.zeros(len(system))
    guess[12:14] = 1e9 + np.array([0.0, 3.0])
    proves(system, certificate(system.A, system.b, guess + 0.1, search=False))
    dense = certificate(system.A.toarray(), system.b)
    assert system.b @ dense < 0


def test_found_in_a_large_system():
    system = side_by_side([wall(8, 8), spinning_between_pins(0.1)]).system()
    proves(system, certificate(system.A, system.b))


@pytest.mark.parametrize("seed", range(15))
def test_never_where_there_is_a_solution(seed):
    """Farkas: one of the two exists, not both."""
    system = random_scene([83, seed], contacts=40).system()
    if len(system):
        force = solve(system).force
        assert certificate(system.A, system.b, force) is None
        assert certificate(system.A, system.b, force * 1e9) is None


def test_a_contact_that_nothing_moves():
    assert certificate(np.diag([0.0, 1]), np.array([-1.0, -1])).tolist() == [1, 0]
    assert certificate(np.diag([0.0, 1]), np.array([1.0, -1])) is None
    assert certificate(csr_array(np.eye(2)), np.array([-1.0, -1])) is None
