"""Contact forces: ``solve`` against general solvers of quadratic programmes, at the same tolerance.

A peer may take either form of the problem, in forces (the lecture's, what
``auto`` is given too) or in accelerations (Gauss). Walls are timed in both,
piles in the one that the peer is faster with. Its matrices are laid out before
the clock starts.
"""

from __future__ import annotations

import importlib
import time
from collections.abc import Callable
from dataclasses import dataclass
from functools import partial
from typing import Any

import numpy as np
from scipy.sparse import csc_matrix, eye_array

from benchmarks.measure import Row, ratio
from course.contact import ContactSystem, solve
from course.contact.engine.mass_weighting import mass_weighted_jacobian
from course.contact.solvers import complementarity_residual
from course.contact.solvers.qp import solve_qp
from course.scenes import pile, shaken, stack, table, wall

TOLERANCE, SYSTEMS = 1e-10, 10_000


def rows() -> list[Row]:
    """The rows of this module."""
    rng = np.random.default_rng(15)
    small = [("table", table()), ("stack of 16, shaken", shaken(stack(16), rng))]
    made = [
        _against_cvxpy(name, s.system(), goal)
        for (name, s), goal in zip(small, (15.0, 8.0), strict=True)
    ]
    bricks = wall(24, 24)
    for name, scene in (("wall", bricks), ("wall, shaken", shaken(bricks, rng))):
        made += _against_peers(
            name, scene.system(), {"clarabel": 5.0, "piqp": 1.5}, both=True
        )
    heaps = [pile(count, rng) for count in (310, 1430)]
    for change, scenes in (("", heaps), (", shaken", [shaken(p, rng) for p in heaps])):
        systems = [s.system() for s in scenes]
        for system in systems:
            made += _against_peers(
                f"pile{change}", system, {"clarabel": 1.0, "piqp": None}
            )
        made.append(_growth(f"pile{change}", systems))
    return [*made, _batch()]


def _against_cvxpy(name: str, system: ContactSystem, goal: float) -> Row:
    lecture = partial(solve_qp, system.A, system.b, tolerance=TOLERANCE)
    quotient, theirs, ours = ratio(lecture, partial(solve, system), repeats=30)
    remark = f"{theirs * 1e3:.2f} ms against {ours * 1e3:.2f} ms"
    return Row(
        f"{name}, {len(system)} contacts: CVXPY with Clarabel / auto",
        quotient,
        goal,
        remark,
    )


def _against_peers(
    name: str,
    system: ContactSystem,
    goals: dict[str, float | None],
    *,
    both: bool = False,
) -> list[Row]:
    """A row a peer: in the form it is faster with, or in ``both``."""
    made, name = [], f"{name}, {len(system)} contacts"
    forms = {"forces": _in_forces(system), "accelerations": _in_accelerations(system)}
    for peer, goal in goals.items():
        if not _installed(peer):
            made.append(_skipped(f"{name}: {peer} / auto", goal, peer))
            continue
        run = _PEERS[peer]
        once = {
            form: _seconds(partial(run, problem)) for form, problem in forms.items()
        }
        for form in forms if both else [min(once, key=once.__getitem__)]:
            quotient, theirs, ours = ratio(
                partial(run, forms[form]), partial(solve, system), repeats=5
            )
            reached = complementarity_residual(
                system.A, np.maximum(run(forms[form]), 0.0), system.b
            )
            remark = (
                f"{theirs * 1e3:.0f} ms, residual {reached:.0e}; "
                f"auto {ours * 1e3:.0f} ms, {solve(system).residual:.0e}"
            )
            made.append(Row(f"{name}: {peer} in {form} / auto", quotient, goal, remark))
    return made


def _growth(name: str, systems: list[ContactSystem]) -> Row:
    few, many = systems
    quotient, more, less = ratio(partial(solve, many), partial(solve, few), repeats=7)
    power = float(np.log(quotient) / np.log(len(many) / len(few)))
    remark = f"n^{power:.2f}: {less * 1e3:.0f} ms for {len(few)}, {more * 1e3:.0f} ms for {len(many)}"
    return Row(
        f"{name}: 1.7 / exponent of the growth of the time", 1.7 / power, 1.0, remark
    )


def _batch() -> Row:
    """Tables on four legs, their centres of mass and loads at random."""
    name = f"{SYSTEMS} systems of 4 contacts: loop of daqp / one batch"
    if not _installed("daqp"):
        return _skipped(name, 8.0, "daqp")
    rng = np.random.default_rng(16)
    feet = 0.5 * np.array([[1, 1], [-1, 1], [-1, -1], [1, -1]]) + rng.uniform(
        -0.4, 0.4, (SYSTEMS, 1, 2)
    )
    directions = np.concatenate(
        [np.ones((SYSTEMS, 4, 1)), feet * rng.uniform(1, 3, (SYSTEMS, 1, 2))], axis=2
    )
    free = rng.normal(size=(SYSTEMS, 3)) - [9.81, 0, 0]
    matrix = directions @ np.swapaxes(directions, 1, 2)
    system = ContactSystem(matrix, np.einsum("scm,sm->sc", directions, free))
    loop = partial(_daqp_loop, directions, free)
    accelerations = free + np.einsum("scm,sc->sm", directions, solve(system).force)
    off = float(np.abs(np.array(loop()) - accelerations).max())
    quotient, theirs, ours = ratio(loop, partial(solve, system), repeats=5)
    each = f"{theirs / SYSTEMS * 1e6:.1f} us each against {ours / SYSTEMS * 1e6:.1f}"
    remark = f"{each}; accelerations agree to {off:.0e}"
    return Row(name, quotient, 8.0, remark)


def _daqp_loop(directions: np.ndarray, free: np.ndarray) -> list[np.ndarray]:
    """Gauss' principle, one call a system; in forces daqp would have to regularise the singular A."""
    import daqp

    one, up, kind = np.eye(3), np.full(4, 1e30), np.zeros(4, dtype=np.int32)
    zeros = np.zeros(4)
    return [
        daqp.solve(one, -a, g, up, zeros, kind)[0]
        for g, a in zip(directions, free, strict=True)
    ]


@dataclass(frozen=True)
class _Programme:
    """minimise x'P x/2 + q.x with R x >= s, and the forces from x and the multipliers of R x >= s."""

    P: Any
    q: np.ndarray
    R: Any
    s: np.ndarray
    force: Callable[[np.ndarray, np.ndarray], np.ndarray]


def _in_forces(system: ContactSystem) -> _Programme:
    count = len(system)
    return _Programme(
        csc_matrix(system.A),
        system.b,
        csc_matrix(eye_array(count)),
        np.zeros(count),
        lambda x, _: x,
    )


def _in_accelerations(system: ContactSystem) -> _Programme:
    """In units of the masses, a = M^-1/2 x from the free ones: P = 1; only what moves."""
    factor = mass_weighted_jacobian(system).tocsc()
    rows = csc_matrix(factor[:, np.flatnonzero(np.diff(factor.indptr))])
    size = rows.shape[1]
    return _Programme(
        csc_matrix(eye_array(size)), np.zeros(size), rows, -system.b, lambda _, z: z
    )


def _clarabel(problem: _Programme) -> np.ndarray:
    import clarabel

    settings = clarabel.DefaultSettings()
    settings.verbose, settings.max_threads = False, 1
    settings.tol_gap_abs = settings.tol_gap_rel = settings.tol_feas = TOLERANCE
    cones = [clarabel.NonnegativeConeT(len(problem.s))]
    found = clarabel.DefaultSolver(
        problem.P, problem.q, -problem.R, -problem.s, cones, settings
    ).solve()
    return problem.force(np.array(found.x), np.array(found.z))


def _piqp(problem: _Programme) -> np.ndarray:
    import piqp

    solver = piqp.SparseSolver()
    s = solver.settings
    s.eps_abs = s.eps_rel = s.eps_duality_gap_abs = s.eps_duality_gap_rel = TOLERANCE
    if problem.R.nnz == len(problem.q):  # bounds, which it takes as such
        solver.setup(problem.P, problem.q, x_l=problem.s)
        solver.solve()
        return problem.force(solver.result.x, solver.result.z_bl)
    solver.setup(problem.P, problem.q, G=problem.R, h_l=problem.s)
    solver.solve()
    return problem.force(solver.result.x, solver.result.z_l)


_PEERS: dict[str, Callable[[_Programme], np.ndarray]] = {
    "clarabel": _clarabel,
    "piqp": _piqp,
}


def _seconds(work: Callable[[], object]) -> float:
    start = time.perf_counter()
    work()
    return time.perf_counter() - start


def _installed(name: str) -> bool:
    try:
        importlib.import_module(name)
    except ImportError:
        return False
    return True


def _skipped(name: str, goal: float | None, peer: str) -> Row:
    return Row(
        name, float("nan"), goal, f"skipped: {peer} is not installed (extra 'peers')"
    )
