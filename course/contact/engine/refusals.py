"""What is said where there is nothing to find: no force exists, A is indefinite, no method converged."""

from __future__ import annotations

from typing import Any

import numpy as np

from course.arrays import Array, failure
from course.contact.engine.regularization import regularized
from course.contact.solution import ContactSolution, NoContactForce, NotConverged
from course.contact.solvers.arguments import dense

#: Eigenvalues below minus this are no rounding, in units of A's diagonal.
INDEFINITE = 1e-9
#: Sparse matrices beyond this many contacts are factored sparse.
FACTORED_DENSE_UP_TO = 128
#: Up to how many contacts A's eigenvalues are computed.
EIGENVALUES_UP_TO = 2000


def require_solution(proof: Array, bias: Array) -> None:
    """NoContactForce where there is a proof y; both (..., c), 0 for systems of a batch that have a solution."""
    if not np.any(proof):
        return
    which, y, b = "", proof, bias
    if proof.ndim > 1:
        rows = proof.reshape(-1, proof.shape[-1])
        k = int(np.argmax(rows.any(axis=1)))
        which, y, b = (
            f" of system {k} of the batch",
            rows[k],
            bias.reshape(rows.shape)[k],
        )
    raise NoContactForce(
        f"no contact forces keep these contacts{which} from approaching: forces y on contacts "
        f"{np.flatnonzero(y)[:8].tolist()} move no body (A y = 0), yet b.y = {b @ y:.3g} m/s^2 is below 0 "
        "(y is in .certificate). Something is squeezed or pried apart by its own motion; let the bodies "
        "collide instead, or take contacts away",
        proof,
    )


def require_semidefinite(matrix: Any, *, least: float = INDEFINITE) -> None:
    """ValueError for A with an eigenvalue below -least, in units of its diagonal.

    Cholesky factors of A + least are much cheaper than eigenvalues, which are
    computed only to be named. A may be one matrix, sparse or dense, or a batch.
    """
    if matrix.ndim > 2:
        for one in matrix.reshape(-1, *matrix.shape[-2:]):
            require_semidefinite(one, least=least)
        return
    root = np.sqrt(matrix.diagonal())
    if not root.size:
        return
    scale = np.divide(1.0, root, out=np.zeros_like(root), where=root > 0)
    bare = np.flatnonzero(root == 0)
    if bare.size and abs(matrix[bare]).max() > 0:
        raise _indefinite("entries beside a 0 on its diagonal")
    if matrix.shape[0] > FACTORED_DENSE_UP_TO and hasattr(matrix, "tocsr"):
        good = _has_sparse_factor(matrix, scale, least)
    else:
        a = dense(matrix)
        from scipy.linalg.lapack import dpotrf

        unit = (a * scale[:, None]) * scale
        unit.flat[:: root.size + 1] += np.where(root > 0, least, 1.0)
        good = not dpotrf(unit.T, lower=1, overwrite_a=1, clean=0)[1]
    if good:
        return
    got = f"an eigenvalue below {-least:.0e} in units of its diagonal"
    if matrix.shape[0] <= EIGENVALUES_UP_TO:
        a = dense(matrix)
        value = float(np.linalg.eigvalsh((a * scale[:, None]) * scale)[0])
        if value >= -least:
            return
        got = f"eigenvalue {value:.3g} in units of its diagonal"
    raise _indefinite(got)


def _indefinite(got: str) -> ValueError:
    return failure("A", "a positive semidefinite matrix", got)


def _has_sparse_factor(matrix: Any, scale: Array, least: float) -> bool:
    from scipy.sparse import csr_array, diags_array

    unit = diags_array(scale)
    try:
        regularized(csr_array(unit @ matrix @ unit)).factor(
            np.where(scale > 0, 1 / least, 0.0)
        )
    except np.linalg.LinAlgError:
        return False
    return True


def require_convergence(solution: ContactSolution, tolerance: float) -> None:
    """NotConverged where the tolerance was missed, or where forces are so large that it does not say enough."""
    if np.all(solution.converged):
        return
    kept = "(what was reached is in .solution)"
    worst = float(np.max(solution.residual))
    if worst > tolerance:
        raise NotConverged(
            f"no method reached the tolerance {tolerance:g}: the best residual is {worst:.3g} {kept}",
            solution,
        )
    raise NotConverged(
        "contacts approach, or part although they push, under forces so large that the residual, "
        f"{worst:.3g}, does not see it; A is too nearly singular to tell in double precision whether "
        f"forces exist {kept}",
        solution,
    )
