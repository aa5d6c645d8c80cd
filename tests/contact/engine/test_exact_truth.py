"""Every method judged by the exact answer, on thousands of small systems made to mislead it.

What is asked of an answer. Data: each entry of A may be off by a few units in
its last place, b by as many of max |b|. Forces of "auto" solve a system within
that of the stored one (backward error of a few c eps), and where they are large
beside b, so that this says little, they are right to 1e-9; where A is singular
to rounding the tolerance is enough. A proof that there are none holds for the
stored A to one unit in the last place. Only where A is nearly singular may a
method fail.
"""

import warnings
from dataclasses import dataclass

import numpy as np
import pytest
from contact.exact_truth import moved, truth_of, violations
from scipy.linalg import block_diag
from scipy.sparse import csr_array

from course.contact import ContactSystem, NoContactForce, NotConverged, solve
from course.contact.engine.certificates import certificate
from course.contact.engine.least_distance import solve_nnls
from course.contact.solvers.pivot import solve_pivot

#: Seconds together: left out of the minute's run.
pytestmark = pytest.mark.slow

EPS = np.finfo(float).eps
METHODS = ("auto", "nnls", "pivot", "projected_gauss_seidel", "gauss")


def heavy_on_light(rng, c):
    """A stack of blocks with masses from 1e-8 to 1e8: a light one carries all above it."""
    inverse = 10.0 ** -rng.uniform(-8, 8, c)
    a = np.diag(inverse + np.append(0.0, inverse[:-1]))
    a -= np.diag(inverse[:-1], 1) + np.diag(inverse[:-1], -1)
    b = np.append(-9.81, np.zeros(c - 1))
    return a, b if rng.uniform() < 0.5 else b + rng.normal(size=c)


def graded(rng, c):
    """Masses and arms from 1e-12 to 1e12."""
    j = rng.normal(size=(c, c + 1)) * 10.0 ** rng.uniform(-6, 6, (c, 1))
    return j @ j.T, rng.normal(size=c)


def redundant(rng, c):
    """Fewer freedoms than contacts, rounded: b that bodies can obey, or not."""
    j = rng.normal(size=(c, int(rng.integers(1, c + 1))))
    j = j[rng.integers(c, size=c)]
    b = j @ rng.normal(size=j.shape[1])
    return j @ j.T, b if rng.uniform() < 0.5 else rng.normal(size=c)


def whole_numbers(rng, c):
    """Small whole numbers: singular exactly or not at all."""
    g = rng.integers(-3, 4, (int(rng.integers(1, c + 2)), c)).astype(float)
    b = (
        -g.T @ rng.integers(-3, 4, len(g))
        if rng.uniform() < 0.5
        else rng.integers(-3, 4, c)
    )
    return g.T @ g, b.astype(float)


def nearly_whole(rng, c):
    """The same with entries of the diagonal a little larger, and b a little off."""
    a, b = whole_numbers(rng, c)
    size = 10.0 ** -rng.uniform(2, 17)
    a = a + np.diag(size * rng.integers(0, 2, c))
    return a, b + 10.0 ** -rng.uniform(2, 20) * rng.integers(-1, 2, c)


def nearly_parallel(rng, c):
    """Rows of J that differ by 1e-1 to 1e-9."""
    j = rng.normal(size=(1, c)) + 10.0 ** -rng.uniform(1, 9) * rng.normal(size=(c, c))
    return j @ j.T, rng.normal(size=c)


def indefinite(rng, c):
    """A semidefinite A with something taken off."""
    a, b = whole_numbers(rng, c)
    if rng.uniform() < 0.5:
        a[0, 1] = a[1, 0] = a[0, 1] + 10.0 ** -rng.uniform(-1, 12)
    else:
        v = rng.normal(size=c)
        a = a - 10.0 ** -rng.uniform(-1, 12) * np.outer(v, v)
    a = (a + a.T) / 2
    np.fill_diagonal(a, np.maximum(a.diagonal(), 0))
    return a, b


FAMILIES = (
    heavy_on_light,
    graded,
    redundant,
    whole_numbers,
    nearly_whole,
    nearly_parallel,
    indefinite,
)


@dataclass
class Case:
    a: np.ndarray
    b: np.ndarray

    def __post_init__(self):
        self.truth = truth_of(self.a, self.b)
        self.count = len(self.b)
        self.noise = 16 * self.count * EPS

    def system(self, kind="dense"):
        return ContactSystem(csr_array(self.a) if kind == "sparse" else self.a, self.b)

    def with_jacobian(self):
        """Rows whose products are A, by eigenvectors, with masses of 1."""
        values, columns = np.linalg.eigh(self.a)
        width = 6 * ((self.count + 5) // 6)
        j = np.zeros((self.count, width))
        j[:, : self.count] = columns * np.sqrt(np.maximum(values, 0.0))
        one = csr_array(np.eye(width))
        return ContactSystem(self.a, self.b, csr_array(j), one, np.zeros(width))


def drawn(family, seed):
    rng = np.random.default_rng([FAMILIES.index(family), *np.atleast_1d(seed)])
    return Case(*family(rng, int(rng.integers(2, 5))))


def judge_error(case, error):
    truth = case.truth
    if isinstance(error, ValueError):
        assert truth.verdict == "indefinite", "A is semidefinite"
    elif isinstance(error, NoContactForce):
        judge_certificate(case, error.certificate)
        if truth.verdict == "forces":
            _, size, largest = violations(case.a, case.b, truth.force)
            assert max(size) > 1e11 * largest, "there are forces"
    else:
        assert isinstance(error, NotConverged)
        if truth.verdict == "forces" and truth.gap > 1e-11:
            _, size, largest = violations(case.a, case.b, truth.force)
            assert max(size) > 1e12 * largest, "there are forces"
        # What is impossible by more than the tolerance is proved, where A is singular beyond doubt.
        assert not (truth.verdict == "none" and truth.gap > 1e-8), "no proof"


def judge_certificate(case, y):
    truth = case.truth
    # Where A y = 0 exactly, f'A y = 0 for every f: a proof, whatever the rest of A is as
    # long as it is not an A that is refused.
    least = -1e-12 * case.count if moved(case.a, y) else -1.1e-9
    assert truth.verdict != "indefinite" or truth.least > least
    assert np.all(y >= 0) and y.max() > 0 and case.b @ y < 0
    # The proof holds to a unit in the last place; so does its own rounding.
    assert moved(case.a, y) <= 2.1 * EPS


def judge_forces(case, solution):
    """Forces of "auto"."""
    truth, a, b = case.truth, case.a, case.b
    assert solution.converged and solution.residual <= 1e-10
    assert truth.verdict != "indefinite" or truth.least > -1.1e-9
    off, size, largest = violations(a, b, solution.force)
    backward = max((float(o / s) for o, s in zip(off, size, strict=True) if s), default=0.0)  # fmt: skip
    if backward > case.noise:
        assert truth.least <= case.noise and backward <= 1e-10
        assert max(off) <= 1.01e-8 * largest
    if truth.verdict == "none":
        assert max(off) <= 1.01e-8 * largest
    if determined(case) and max(size) > 1e4 * largest:
        f = np.array([float(x) for x in truth.force])
        np.testing.assert_allclose(solution.force, f, rtol=0, atol=1e-9 * f.max())


def determined(case):
    """Whether A is regular beyond rounding, so that the stored numbers say what the forces are."""
    return case.truth.verdict == "forces" and case.truth.least > case.noise


def judge_named(case, solution):
    """Forces of any other method: right to 1e-4 where it says that it has converged, or to what rounding of A allows.

    A changed by units in the last place changes its least eigenvalue by as
    many, and forces by their ratio; "gauss" knows A only as J J' besides.
    """
    assert np.all(np.isfinite(solution.force)) and np.all(solution.force >= 0)
    if not solution.converged:
        return
    assert solution.residual <= 1e-10
    off, size, largest = violations(case.a, case.b, solution.force)
    assert max(off) <= 1.2e-6 * largest
    truth = case.truth
    if determined(case) and max(size) > 1e4 * largest:
        f = np.array([float(x) for x in truth.force])
        units = 2 if solution.method == "gauss" else 1
        pushed = float(max(d * x for d, x in zip(case.a.diagonal(), f, strict=True)))
        seen = 2e-8 * float(largest) / pushed  # what is within the tolerance of b
        near = 1e-4 + (units * case.noise + seen) / truth.least
        np.testing.assert_allclose(solution.force, f, rtol=0, atol=near * f.max())


def judged(case, system, method="auto"):
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        try:
            limit = 100 if method == "projected_gauss_seidel" else None
            solution = solve(system, method=method, max_iterations=limit)
        except (ValueError, NoContactForce, NotConverged) as error:
            assert method == "auto" or isinstance(error, ValueError)
            judge_error(case, error)
            return
    if case.truth.verdict == "indefinite" and system.jacobian is None:
        assert case.truth.least > -1.1e-9, "A is indefinite"
    (judge_forces if method == "auto" else judge_named)(case, solution)


def of_ray(case, ray):
    """What the certificate makes of the pivots' ray, which is as good as their rounding."""
    return None if ray is None else certificate(case.a, case.b, ray, search=False)


def judge_all(family, seed, slow=False):
    case = drawn(family, seed)
    for kind in ("dense", "sparse"):
        judged(case, case.system(kind))
    for method in METHODS[1:4] + (("qp",) if slow else ()):
        judged(case, case.system(), method)
    if case.truth.verdict == "indefinite":
        return
    judged(case, case.with_jacobian(), "gauss")
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        proofs = [
            certificate(case.a, case.b),
            of_ray(case, solve_pivot(case.a, case.b).ray),
            solve_nnls(case.a, case.b).certificate,
        ]
    for y in proofs:
        if y is not None:
            judge_certificate(case, y)


@pytest.mark.parametrize("family", FAMILIES, ids=lambda f: f.__name__)
@pytest.mark.parametrize("seed", range(40))
def test_every_method_by_the_exact_answer(family, seed):
    judge_all(family, seed)


def test_a_contact_that_moves_nothing_is_a_proof_though_the_rest_is_rounded():
    judge_all(indefinite, [1661588976, 67])


@pytest.mark.slow
@pytest.mark.parametrize("family", FAMILIES, ids=lambda f: f.__name__)
def test_the_quadratic_programme_as_well(family):
    for seed in range(40, 60):
        judge_all(family, seed, slow=True)


@pytest.mark.long
@pytest.mark.parametrize("family", FAMILIES, ids=lambda f: f.__name__)
def test_with_a_seed_of_today(family):
    today = int(np.random.SeedSequence().entropy % 2**32)
    for k in range(1000):
        try:
            judge_all(family, [today, k], slow=k % 20 == 0)
        except Exception as error:
            raise AssertionError(f"drawn({family.__name__}, {[today, k]})") from error


@pytest.mark.parametrize("family", FAMILIES, ids=lambda f: f.__name__)
def test_batches_answer_as_one_by_one(family):
    """A batch of those that have forces is judged as each; one without, or an indefinite one, is told of."""
    rng = np.random.default_rng([99, FAMILIES.index(family)])
    cases = [Case(*family(rng, 3)) for _ in range(60)]
    good, bad = [], []
    for case in cases:
        try:
            solve(case.system())
        except (ValueError, NoContactForce, NotConverged) as error:
            bad.append((case, type(error)))
        else:
            good.append(case)
    found = solve(batch_of(good))
    for k, case in enumerate(good):
        off, size, largest = violations(case.a, case.b, found.force[k])
        assert found.converged[k] and found.residual[k] <= 1e-10
        assert max(off) <= 1.01e-8 * largest + 1e-14 * max(size)
    for case, kind in bad[:8]:
        with pytest.raises(kind):
            solve(batch_of([*good[:9], case, *good[9:20]]))


def batch_of(cases):
    return ContactSystem(np.stack([c.a for c in cases]), np.stack([c.b for c in cases]))


@pytest.mark.parametrize("seed", range(6))
def test_many_small_systems_in_one(seed):
    """Up to 160 contacts that fall apart into four each, in any order: what holds for each holds for all."""
    rng = np.random.default_rng([98, seed])
    cases = []
    while len(cases) < 10 * (1 + seed % 4):
        case = Case(*FAMILIES[int(rng.integers(6))](rng, 4))
        try:
            solve(case.system())
        except (ValueError, NoContactForce, NotConverged):
            continue
        cases.append(case)
    order = rng.permutation(4 * len(cases))
    whole = block_diag(*(c.a for c in cases))[np.ix_(order, order)]
    b = np.concatenate([c.b for c in cases])[order]
    for a in (whole, csr_array(whole)):
        found = solve(ContactSystem(a, b))
        force = np.empty(b.size)
        force[order] = found.force
        for case, f in zip(cases, force.reshape(-1, 4), strict=True):
            off, size, _ = violations(case.a, case.b, f)
            assert max(off) <= 1.01e-8 * np.abs(b).max() + 1e-14 * max(size)


@pytest.mark.parametrize("ratio", [1e4, 1e6, 1e8, 1e9, 1e10, 1e11, 1e12, 1e13, 1e14, 1e15, 1e16])  # fmt: skip
def test_a_heavy_block_on_a_light_one(ratio):
    """A = [[1, -1], [-1, 1 + 1/M]], b = (-9.81, 0): f = 9.81 (1 + d, d) / d of the d that 1 + d was rounded to."""
    a, b = np.array([[1.0, -1.0], [-1.0, 1 + 1 / ratio]]), np.array([-9.81, 0.0])
    d = a[1, 1] - 1
    right = np.array([9.81 * (1 + d) / d, 9.81 / d]) if d else None
    for system, back in (
        (ContactSystem(a, b), slice(None)),
        (ContactSystem(csr_array(a), b), slice(None)),
        (ContactSystem(4 * a, 4 * b), slice(None)),
        (ContactSystem(a[::-1, ::-1], b[::-1]), slice(None, None, -1)),
    ):
        try:
            force = solve(system).force[back]
        except NotConverged as error:
            assert ratio > 2e12
            np.testing.assert_allclose(error.solution.force[back], right, rtol=1e-13)
        except NoContactForce as error:
            assert d == 0 and error.certificate.tolist() == [1, 1]
        else:
            np.testing.assert_allclose(force, right, rtol=1e-13)
    for method in METHODS[1:]:
        case = Case(a, b)
        system = case.with_jacobian() if method == "gauss" else case.system()
        found = solve(system, method=method, max_iterations=200)
        if found.converged:
            np.testing.assert_allclose(found.force, right, rtol=1e-5)


THREE = [
    # By hand: contacts 1 and 2 are opposite, so f_0 - f_1 = .999001 with f_2 = 0; and
    # .0001 f_0 = 2 with f_2 - f_1 = f_0 + 2.
    ([[1.001, -1.001, 1], [-1.001, 1.001, -1], [1, -1, 1]], [-1, 1, 1], [1 / 1.001, 0, 0]),
    ([[1.0001, 1, -1], [1, 1, -1], [-1, -1, 1]], [0, 2, -2], [20000, 0, 20002]),
]  # fmt: skip


@pytest.mark.parametrize("a,b,right", THREE)
@pytest.mark.parametrize("method", ["auto", "nnls", "pivot"])
def test_three_contacts_of_which_two_are_opposite(a, b, right, method):
    found = solve(ContactSystem(np.array(a, float), np.array(b, float)), method=method)
    assert found.converged
    np.testing.assert_allclose(found.force, right, rtol=1e-9)
    assert solve_nnls(a, b).certificate is None


@pytest.mark.parametrize("method", [*METHODS, "qp"])
@pytest.mark.parametrize("count", [2, 5])
def test_an_unloaded_contact_takes_no_force(method, count):
    """A = 1, b = (0, ..., 0, -1): f = w = 0 at the others, which an interior point comes no nearer than its root."""
    b = np.zeros(count)
    b[-1] = -1
    case = Case(np.eye(count), b)
    system = case.with_jacobian() if method == "gauss" else case.system()
    found = solve(system, method=method)
    assert found.converged and np.abs(found.force + b).max() <= 1e-15


@pytest.mark.parametrize("method", [*METHODS[:4], "qp"])
@pytest.mark.parametrize(
    "a",
    [
        [[1.0, 2.0], [2.0, 1.0]],
        [[0.0, 1.0], [1.0, 1.0]],
        [[1.0, -1.0 - 1e-6], [-1.0 - 1e-6, 1.0]],
        [[1e12, 2.0], [2.0, 1e-12]],
    ],
)
@pytest.mark.parametrize("b", [[-1.0, -1.0], [-1.0, 1.0], [1.0, 1.0]])
def test_an_indefinite_matrix_is_an_error_for_every_method(method, a, b):
    a, b = np.array(a), np.array(b)
    good = np.eye(2) * a.diagonal().max()
    for system in (
        ContactSystem(a, b),
        ContactSystem(csr_array(a), b),
        ContactSystem(np.stack([good, a]), np.stack([b, b])),
        ContactSystem(np.stack([good] * 20 + [a]), np.stack([b] * 21)),
    ):
        with pytest.raises(ValueError, match="A: expected a positive semidefinite"):
            solve(system, method=method)


@pytest.mark.parametrize("method", ["auto", "projected_gauss_seidel", "nnls"])
def test_an_indefinite_block_in_a_large_sparse_matrix(method):
    """300 contacts in a chain, the last two indefinite together."""
    a = 2.1 * np.eye(300) - np.eye(300, k=1) - np.eye(300, k=-1)
    a[-1, -2] = a[-2, -1] = -2.2
    with pytest.raises(ValueError, match="A: expected a positive semidefinite"):
        solve(ContactSystem(csr_array(a), -np.ones(300)), method=method)
