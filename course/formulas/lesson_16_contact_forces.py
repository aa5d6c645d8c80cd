"""Lesson 16, Contact forces: f >= 0 with w = A f + b >= 0 and f_i w_i = 0 (an LCP)."""

import numpy as np


def slope_1(a_11, a_12, f_1, f_2, b_1):
    """Slope of q = f'A f/2 + b.f along f_1 for two contacts, as an expression.

    a_11 f_1 + a_12 f_2 + b_1, which is d_ddot of contact 1    (syllabus row 25)

    a [1/kg], f [N], b [m/s^2]; returns [m/s^2].
    Source: the derivative of a quadratic form with a symmetric matrix.
    """
    return a_11 * f_1 + a_12 * f_2 + b_1


def complementarity_residual(a, f, b):
    """Residual of the contact conditions (complementarity), 0 for a solution.

    max_i |min(D_i f_i, w_i)| / ((|A| f)_i + max_j |b_j|),  w = A f + b,  D = diag A
    (syllabus rows 20 and 25, misprint 14); a row 0/0 is 0

    a (..., c, c) [1/kg], f (..., c) [N], b (..., c) [m/s^2]; returns (...).
    Source: the natural residual of Cottle, Pang and Stone, "The Linear Complementarity
    Problem", made independent of units.
    """
    d = np.diagonal(a, axis1=-2, axis2=-1)
    w = np.einsum("...ij,...j->...i", a, f) + b
    wrong = np.abs(np.minimum(d * f, w))
    largest = np.abs(b).max(axis=-1, keepdims=True)
    scale = np.einsum("...ij,...j->...i", np.abs(a), f) + largest
    rows = np.divide(wrong, scale, out=np.zeros(wrong.shape), where=scale > 0)
    return rows.max(axis=-1)


def solve_contact_qp(a, b):
    """Contact forces by the lecture's quadratic programme (QP).

    minimise f'A f/2 + b.f subject to f >= 0    (syllabus row 25, misprint 13)

    a (c, c) [1/kg], b (c,) [m/s^2]; returns (c,) [N].
    Source: Boyd and Vandenberghe, "Convex Optimization", section 5.5.3: f >= 0,
    A f + b >= 0 and f (A f + b) = 0 are its optimality conditions.
    """
    import cvxpy as cp

    f = cp.Variable(len(b))
    objective = cp.Minimize(0.5 * cp.quad_form(f, cp.psd_wrap(a)) + b @ f)
    cp.Problem(objective, [f >= 0]).solve(solver=cp.CLARABEL)
    return f.value


def projected_gauss_seidel(a, b, start, sweeps):
    """Contact forces by projected Gauss-Seidel (PGS): sweeps over the contacts.

    f_i <- max(0, f_i - w_i/a_ii),  w_i = (A f + b)_i of the newest forces
    (an answer to syllabus row 25)

    a (c, c) [1/kg], b (c,) [m/s^2], start (c,) [N], sweeps a number; returns (c,) [N].
    Source: Cottle, Pang and Stone, "The Linear Complementarity Problem", chapter 5.
    """
    f = np.array(start, dtype=float)
    for _ in range(sweeps):
        for i in range(len(b)):
            w = a[i] @ f + b[i]
            f[i] = max(0.0, f[i] - w / a[i, i])
    return f


def pivot(a, b):
    """Contact forces by Baraff's pivoting: one by one, each grows until its w is 0.

    While f_k grows by 1, those that push answer by -A_CC^-1 A_Ck and keep their w at 0.
    Whose force or w reaches 0 first leaves or joins them. Where two stops coincide, k has
    a force before it is listed, and goes on until it is.
    (an answer to syllabus rows 20 and 25)

    a (c, c) [1/kg] positive definite, b (c,) [m/s^2]; returns (c,) [N].
    Source: Baraff, "Fast Contact Force Computation for Nonpenetrating Rigid Bodies",
    SIGGRAPH 1994.
    """
    f, w = np.zeros(len(b)), np.array(b, dtype=float)
    pushing = []
    for k in range(len(b)):
        for _ in range(100):
            if w[k] >= -1e-12 and (k in pushing or f[k] == 0):
                break
            change = np.zeros(len(b))
            change[k] = 1.0
            block = a[np.ix_(pushing, pushing)]
            change[pushing] = -np.linalg.solve(block, a[pushing, k])
            rate = a @ change
            resting = [i for i in range(k) if i not in pushing]
            stops = [(-w[k] / rate[k], k)]
            stops += [(-f[i] / change[i], i) for i in pushing if change[i] < 0]
            stops += [(-w[i] / rate[i], i) for i in resting if rate[i] < 0]
            step, who = min(stops)
            f, w = f + step * change, w + step * rate
            if who in pushing:
                pushing.remove(who)
                f[who] = 0.0
            else:
                pushing.append(who)
                w[who] = 0.0
        else:
            raise RuntimeError(f"contact {k}: no end after 100 stops")
    return f
