"""Contact forces by least squares, with the certificate where no force exists."""

import itertools

import numpy as np
import pytest
import scipy.optimize

from course.contact.engine.least_distance import solve_nnls
from course.contact.solvers import nonnegative_least_squares

pytestmark = pytest.mark.slow  # with its like, left out of --quick


def residual(a, f, b):
    """The definition, row by row."""
    w, worst = a @ f + b, 0.0
    for i in range(len(b)):
        scale = np.abs(a[i]) @ np.abs(f) + np.abs(b).max()
        if scale > 0:
            worst = max(worst, abs(min(a[i, i] * f[i], w[i])) / scale)
    return worst


def by_enumeration(a, b):
    """All w of all solutions, by trying every set of pushing contacts; None where there is no solution."""
    for size in range(len(b) + 1):
        for push in itertools.combinations(range(len(b)), size):
            f = np.zeros(len(b))
            if push:
                block = a[np.ix_(push, push)]
                if np.linalg.matrix_rank(block) < size:
                    continue
                f[list(push)] = np.linalg.solve(block, -b[list(push)])
            w = a @ f + b
            if f.min(initial=0) >= -1e-9 and w.min(initial=0) >= -1e-9:
                return w
    return None


def systems(seed, count, kind):
    rng = np.random.default_rng(seed)
    for _ in range(count):
        c, m = rng.integers(1, 6), rng.integers(1, 7)
        g = rng.normal(size=(m, c))
        if kind == "repeated":
            g = np.concatenate([g, g[:, :1]], axis=1)
        if kind == "masses":
            g = g * 10 ** rng.uniform(-3, 3, size=(m, 1))
        if kind == "whole":
            g = np.rint(g)
        b = (
            g.T @ rng.normal(size=m)
            if rng.random() < 0.5
            else rng.normal(size=g.shape[1])
        )
        yield g, (np.rint(2 * b) if kind == "whole" else b)


@pytest.mark.parametrize("kind", ["plain", "repeated", "masses", "whole"])
@pytest.mark.parametrize("with_columns", [True, False])
def test_force_or_proof_that_there_is_none(kind, with_columns):
    answers = {"force": 0, "none": 0}
    for g, b in systems(31, 150, kind):
        a = g.T @ g
        found = solve_nnls(a, b, columns=g if with_columns else None)
        if found.certificate is None:
            answers["force"] += 1
            assert found.force.min() >= 0
            assert residual(a, found.force, b) < 1e-12
            assert found.residual == pytest.approx(
                residual(a, found.force, b), abs=1e-15
            )
        else:
            answers["none"] += 1
            y = found.certificate
            # y >= 0, A y = 0 and b.y < 0: then f.w = 0 and w >= 0 cannot both be.
            assert y.min() >= 0 and b @ y < 0
            assert np.abs(g @ y).max() <= 1e-9 * np.abs(g).max() * y.sum()
            assert not found.force.any()
    assert answers["force"] > 0 and answers["none"] > 0


@pytest.mark.parametrize("kind", ["plain", "whole"])
def test_agrees_with_trying_every_set_of_contacts(kind):
    for g, b in systems(32, 60, kind):
        a = g.T @ g
        found, w = solve_nnls(a, b), by_enumeration(a, b)
        assert (found.certificate is None) == (w is not None)
        if w is not None:  # f may differ, A f may not
            assert np.allclose(
                a @ found.force + b, w, atol=1e-7 * (1 + np.abs(w).max())
            )


def test_pair_that_clipping_increments_gets_wrong():
    # Clipped Gauss-Seidel increments answer (1, 1/2); right is (2/3, 2/3).
    found = solve_nnls([[1.0, 0.5], [0.5, 1.0]], [-1.0, -1.0])
    assert np.allclose(found.force, [2 / 3, 2 / 3], atol=1e-15)


def test_state_without_a_solution():
    found = solve_nnls([[1.0, -1.0], [-1.0, 1.0]], [-1.0, -1.0])
    assert np.allclose(found.certificate, [0.5, 0.5]) and not found.force.any()
    between_fixed = solve_nnls([[0.0, 0.0], [0.0, 2.0]], [-1.0, -1.0])
    assert between_fixed.certificate.tolist() == [1, 0]


def test_table_on_four_legs():
    # Offset centre of mass (.1, .05), half widths .5 and .3: the least-norm forces are one of many answers,
    # d_ddot and the sum are the same for all; leg 1 can carry anything in [.183333, .583333] m g.
    feet = np.array([[0.5, 0.3], [-0.5, 0.3], [-0.5, -0.3], [0.5, -0.3]]) - [0.1, 0.05]
    jacobian = np.concatenate(
        [np.ones((4, 1)), feet], axis=1
    )  # heave and two tilts, unit mass and inertias
    a, b = jacobian @ jacobian.T, -np.ones(4)
    found = solve_nnls(a, b)
    assert np.linalg.matrix_rank(a) == 3
    assert found.residual < 1e-14 and found.force.sum() == pytest.approx(1, rel=1e-14)
    assert 0.183333 - 1e-6 <= found.force[0] <= 0.583333 + 1e-6
    least_norm = np.array([0.341667, 0.241667, 0.158333, 0.258333])
    shift = (found.force - least_norm) @ np.array([1, -1, 1, -1]) / 4
    assert np.allclose(
        found.force, least_norm + shift * np.array([1, -1, 1, -1]), atol=1e-6
    )


def test_large_forces_are_told_apart_from_no_force():
    for tilt in (1e-2, 1e-4, 1e-6):
        g = np.array([[1.0, -1.0], [0.0, tilt]])  # two nearly opposite pushes
        found = solve_nnls(g.T @ g, [-1.0, -1.0], columns=g)
        assert found.certificate is None
        # By hand: A f = (1, 1) has f = (1 + 2/tilt^2, 2/tilt^2).
        assert np.allclose(
            found.force,
            [1 + 2 / tilt**2, 2 / tilt**2],
            rtol=1e-3 * (tilt / 1e-6) ** -1 + 1e-9,
        )
    assert solve_nnls([[1.0, -1.0], [-1.0, 1.0]], [-1.0, -1.0]).certificate is not None


def test_no_contacts_at_all():
    assert solve_nnls(np.empty((0, 0)), np.empty(0)).force.shape == (0,)


@pytest.mark.parametrize("failure", ["wrong", "raises"])
def test_a_wrong_answer_of_the_library_is_not_taken(monkeypatch, failure):
    # scipy issue 25389: a point that is not the minimum, with a residual reported as zero.
    def broken(matrix, target, **_):
        if failure == "raises":
            raise RuntimeError("Maximum number of iterations reached.")
        return np.full(matrix.shape[1], 0.4), 0.0

    monkeypatch.setattr(scipy.optimize, "nnls", broken)
    for g, b in systems(34, 40, "plain"):
        target = np.linalg.lstsq(g.T, -b, rcond=None)[0]
        x = nonnegative_least_squares(g, target)
        assert residual(g.T @ g, x, -g.T @ target) < 1e-9


@pytest.mark.parametrize(
    "call, message",
    [
        (lambda: solve_nnls(np.eye(3)[:2], [1.0, 1.0]), r"matrix: expected shape \(c, c\); got shape \(2, 3\)"),
        (lambda: solve_nnls(np.eye(2), [1.0]), r"bias: expected shape \(2,\)"),
        (lambda: solve_nnls([[1.0, 1.0], [0.0, 1.0]], [-1.0, -1.0]), "matrix: expected a symmetric matrix"),
        (lambda: solve_nnls([[1.0, 2.0], [2.0, 1.0]], [-1.0, -1.0]), "matrix: expected a positive semidefinite"),
        (lambda: solve_nnls([[0.0, 1.0], [1.0, 1.0]], [-1.0, -1.0]), "matrix: expected a positive semidefinite"),
        (lambda: solve_nnls([[-1.0]], [-1.0]), "matrix: expected a positive semidefinite"),
        (lambda: solve_nnls(np.eye(2), [-1.0, np.nan]), "bias: expected finite"),
        (lambda: solve_nnls(np.eye(2), [-1.0, 1.0], columns=np.eye(3)), r"columns: expected shape \(m, 2\)"),
    ],
)  # fmt: skip
def test_refuses(call, message):
    with pytest.raises(ValueError, match=message):
        call()
