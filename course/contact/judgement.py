"""Whether what a method found is to be believed, and what is said where there is nothing to find."""

from __future__ import annotations

from typing import Any

import numpy as np

from course.arrays import Array, BoolArray, failure
from course.contact.contact_system import ContactSystem
from course.contact.solution import ContactSolution, NoContactForce, NotConverged
from course.contact.solvers.residual import runs_away

#: |A| f above this times the largest |b| is taken for forces that have run away, until no proof of it is found.
HUGE = 1e9
#: No contact may approach, or part and push, by this times the largest |b|, however large the forces.
SEEN = 1e-3
#: Up to how many contacts A's eigenvalues are looked at where all goes wrong.
CHECKED_UP_TO = 2000


def doubtful(
    product: Array, size: Array, bias: Array, largest: Array | None = None
) -> BoolArray:
    """Contacts that approach by more than rounding (``runs_away``), or whose forces are too large to be so sure.

    From A f, |A| f and b, each (..., c), and max |b| if it is not that of
    these b. Forces within the tolerance and without doubt pass
    ``require_convergence``: rounding is far below SEEN up to HUGE.
    """
    if largest is None:
        largest = np.abs(bias).max(axis=-1, keepdims=True, initial=0)
    return runs_away(product, size, bias, largest) | (size > HUGE * largest)


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


def require_semidefinite(matrix: Any) -> None:
    """ValueError for A with an eigenvalue below 0; looked at only where methods fail, as it costs more than they do."""
    if matrix.shape[0] > CHECKED_UP_TO:
        return
    a = matrix.toarray() if hasattr(matrix, "toarray") else matrix
    root = np.sqrt(a.diagonal())
    scale = np.divide(1.0, root, out=np.zeros_like(root), where=root > 0)
    least = float(np.linalg.eigvalsh(a * (scale[:, None] * scale))[0])
    if least < -1e-9:
        raise failure(
            "A",
            "a positive semidefinite matrix",
            f"eigenvalue {least:.3g} in units of its diagonal",
        )


def require_convergence(
    system: ContactSystem, solution: ContactSolution, tolerance: float
) -> None:
    """NotConverged where the tolerance was missed, or where forces are so large that it does not say enough."""
    kept = "(what was reached is in .solution)"
    if not np.all(solution.converged):
        worst = float(np.max(solution.residual))
        raise NotConverged(
            f"no method reached the tolerance {tolerance:g}: the best residual is {worst:.3g} {kept}",
            solution,
        )
    a = system.A
    diagonal = a.diagonal() if a.ndim == 2 else np.diagonal(a, axis1=-2, axis2=-1)
    violation = np.abs(np.minimum(diagonal * solution.force, solution.acceleration))
    hidden = violation > SEEN * np.abs(system.b).max(
        axis=-1, keepdims=True, initial=0.0
    )
    if np.any(hidden):
        raise NotConverged(
            f"{np.count_nonzero(hidden)} contacts approach, or part although they push, at up to "
            f"{violation.max():.3g} m/s^2, under forces so large that the residual, "
            f"{float(np.max(solution.residual)):.3g}, does not see it; A is too nearly singular to tell in double "
            f"precision whether forces exist {kept}",
            solution,
        )
