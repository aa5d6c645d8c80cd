"""Block pivoting of many small systems at once."""

import numpy as np
import pytest

from course.contact.engine.block_pivots import block_pivot, block_pivot_one
from course.contact.solvers import complementarity_residual


def systems(count, contacts, rank, seed):
    rng = np.random.default_rng(seed)
    g = rng.normal(size=(count, rank, contacts)) * 10.0 ** rng.uniform(
        -2, 2, (count, 1, contacts)
    )
    return np.swapaxes(g, 1, 2) @ g, -np.einsum(
        "skc,sk->sc", g, rng.normal(size=(count, rank))
    )


@pytest.mark.parametrize("contacts", [1, 2, 4, 7, 12])
@pytest.mark.parametrize("spare", [2, 0, -1])
@pytest.mark.slow
def test_batches_reach_rounding(contacts, spare):
    """Full rank, just full rank, and one contact too many."""
    a, b = systems(300, contacts, max(contacts + spare, 1), [contacts, spare + 1])
    found = block_pivot(a, b)
    residual = complementarity_residual(a, found.force, b)
    assert np.all(found.force >= 0) and np.mean(residual <= 1e-10) > 0.99
    np.testing.assert_allclose(found.residual, residual, atol=1e-14)
    assert np.all(found.iterations >= 1)


def test_one_by_one_is_the_same_as_together():
    a, b = systems(40, 5, 7, 3)
    together = block_pivot(a, b)
    for k in range(40):
        alone = block_pivot(a[k : k + 1], b[k : k + 1])
        np.testing.assert_allclose(
            together.force[k], alone.force[0], atol=1e-9 * np.abs(alone.force).max()
        )
        by_lapack = block_pivot_one(a[k], b[k]).force
        np.testing.assert_allclose(
            together.force[k], by_lapack, atol=1e-9 * by_lapack.max()
        )


def test_a_batch_in_any_layout():
    """The compiled loop asks for C order; what is given may be a view of anything."""
    a, b = systems(30, 4, 6, 8)
    expected = block_pivot(a, b).force
    turned = np.asfortranarray(a[::-1])[::-1], np.asfortranarray(b)
    assert np.array_equal(block_pivot(*turned).force, expected)


@pytest.mark.parametrize("spare", [2, 0, -1])
def test_what_the_forces_do_comes_with_them(spare):
    """A f and |A| f of the forces as they are returned, clipped at 0, in a batch and alone."""
    a, b = systems(200, 6, 6 + spare, [5, spare + 1])
    found = block_pivot(a, b)
    np.testing.assert_allclose(
        found.product,
        np.einsum("sij,sj->si", a, found.force),
        atol=1e-14 * found.size.max(),
    )
    np.testing.assert_allclose(
        found.size, np.einsum("sij,sj->si", np.abs(a), found.force), rtol=1e-13
    )
    one = block_pivot_one(a[0], b[0])
    assert np.array_equal(one.product, a[0] @ one.force)
    assert np.array_equal(one.size, np.abs(a[0]) @ one.force)
    assert one.residual == complementarity_residual(a[0], one.force, b[0])


def test_sweeps_are_a_good_second_guess():
    """Where not all push, a batch goes on with fewer rounds than by exchanges alone (measured: 0.4 times as many)."""
    a, b = systems(300, 12, 14, 23)
    together = block_pivot(a, b).iterations
    alone = [block_pivot_one(a[k], b[k]).iterations for k in range(300)]
    assert np.mean(together) - 1 <= 0.7 * (np.mean(alone) - 1)


def test_any_first_guess_leads_there():
    rng = np.random.default_rng(2)
    a, b = systems(30, 8, 10, 17)
    for k in range(30):
        whole = block_pivot_one(a[k], b[k])
        guess = rng.uniform(size=8) < 0.5
        other = block_pivot_one(a[k], b[k], pushing=guess.copy())
        np.testing.assert_allclose(
            other.force, whole.force, atol=1e-9 * whole.force.max()
        )
        again = block_pivot_one(a[k], b[k], pushing=whole.force > 0)
        assert again.iterations == 1 and again.residual <= 1e-12


def test_large_systems_by_lapack():
    a, b = systems(3, 90, 100, 9)
    found = block_pivot(a, b)
    assert found.residual.max() <= 1e-12
    np.testing.assert_allclose(
        complementarity_residual(a, found.force, b), found.residual, atol=1e-14
    )


def test_nothing_to_do_and_nothing_that_helps():
    empty = block_pivot(np.zeros((0, 4, 4)), np.zeros((0, 4)))
    assert empty.force.shape == (0, 4)
    assert (
        block_pivot(np.zeros((9, 0, 0)), np.zeros((9, 0))).residual.tolist()
        == [0.0] * 9
    )
    a = np.zeros((10, 2, 2))
    a[:, 1, 1] = 2.0
    found = block_pivot(a, np.full((10, 2), -1.0))
    np.testing.assert_allclose(found.force, np.tile([0, 0.5], (10, 1)))
    still = [block_pivot(m, np.zeros((len(m), 2))).force for m in (a, a[:1])] + [
        block_pivot_one(a[0], np.zeros(2)).force
    ]
    assert not any(np.any(f) or np.any(np.signbit(f)) for f in still)
    assert np.all(found.residual == 1), (
        "a contact that no force moves approaches for ever"
    )


def test_a_limit_ends_it():
    a, b = systems(50, 8, 5, 12)
    limited = block_pivot(a, b, max_iterations=1)
    assert limited.iterations.max() <= 2 and limited.residual.max() > 1e-10
    assert np.all(np.isfinite(limited.force))
