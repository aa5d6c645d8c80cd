"""Bodies that fly, and the closed-form geometry of the surfaces they carry, to compare d, d_dot and d_ddot with."""

from dataclasses import dataclass

import numpy as np
from scipy.integrate import solve_ivp

from course import rotations
from course.dynamics import Bodies
from course.overlap import Contacts

EYE = np.eye(3)


def unit(x):
    return x / np.linalg.norm(x)


@dataclass
class Touch:
    """One contact as closed-form geometry finds it: where each surface is nearest, N, d, and the feature's data."""

    point_a: np.ndarray
    point_b: np.ndarray
    normal: np.ndarray
    feature: str
    data: dict

    @property
    def gap(self):
        return float((self.point_a - self.point_b) @ self.normal)

    def contacts(self, body_a=0, body_b=1):
        data = {name: value[None] for name, value in self.data.items()}
        halfway = 0.5 * (self.point_a + self.point_b)
        return Contacts(np.array([body_a]), np.array([body_b]), halfway[None], self.normal[None],
                        np.array([self.gap]), np.array([self.feature]), **data)  # fmt: skip


def nearest_on_lines(p, d, q, e):
    """The points nearest to each other of the lines p + s d and q + t e."""
    s, t = np.linalg.lstsq(np.stack([d, -e], axis=1), q - p, rcond=None)[0]
    return p + s * d, q + t * e


def curved(centre_a, centre_b, r_a, r_b, k_a, k_b):
    """Round surfaces about two centres (of a ball, or nearest on a capsule's axis)."""
    n = unit(centre_a - centre_b)
    return Touch(
        centre_a - r_a * n,
        centre_b + r_b * n,
        n,
        "curved",
        {"curvature_a": k_a, "curvature_b": k_b},
    )


def ball(r):
    return EYE / r


def rod(r, axis):
    axis = unit(axis)
    return (EYE - np.outer(axis, axis)) / r


# Each takes the poses (x_A, R_A, x_B, R_B) and numbers drawn once; the body's own geometry turns with R.
def face_b(x_a, r_a, x_b, r_b, g):
    p, n = x_a + r_a @ g["corner"], r_b @ g["normal"]
    d = (p - x_b - r_b @ g["on_face"]) @ n
    return Touch(p, p - d * n, n, "face_b", {})


def face_a(x_a, r_a, x_b, r_b, g):
    p, n = x_b + r_b @ g["corner"], -r_a @ g["normal"]
    d = (x_a + r_a @ g["on_face"] - p) @ n
    return Touch(p + d * n, p, n, "face_a", {})


def edges(x_a, r_a, x_b, r_b, g):
    e_a, e_b = r_a @ g["edge_a"], r_b @ g["edge_b"]
    n = unit(np.cross(e_a, e_b)) * np.sign(g["normal"][0])
    p, q = nearest_on_lines(x_a + r_a @ g["corner"], e_a, x_b + r_b @ g["on_face"], e_b)
    return Touch(p, q, n, "edges", {"edge_a": e_a, "edge_b": e_b})


def sphere_plane(x_a, r_a, x_b, r_b, g):
    centre, n = x_a + r_a @ g["corner"], r_b @ g["normal"]
    foot = centre - ((centre - x_b - r_b @ g["on_face"]) @ n) * n
    zero = np.zeros((3, 3))
    return Touch(
        centre - 0.7 * n,
        foot,
        n,
        "curved",
        {"curvature_a": ball(0.7), "curvature_b": zero},
    )


def plane_sphere(x_a, r_a, x_b, r_b, g):
    centre, n = x_b + r_b @ g["corner"], -r_a @ g["normal"]
    foot = centre - ((centre - x_a - r_a @ g["on_face"]) @ n) * n
    zero = np.zeros((3, 3))
    return Touch(
        foot,
        centre + 0.7 * n,
        n,
        "curved",
        {"curvature_a": zero, "curvature_b": ball(0.7)},
    )


def sphere_sphere(x_a, r_a, x_b, r_b, g):
    return curved(
        x_a + r_a @ g["corner"],
        x_b + r_b @ g["on_face"],
        0.7,
        0.6,
        ball(0.7),
        ball(0.6),
    )


def sphere_capsule(x_a, r_a, x_b, r_b, g):
    axis, start = r_b @ unit(g["edge_b"]), x_b + r_b @ g["on_face"]
    centre = x_a + r_a @ g["corner"]
    return curved(
        centre,
        start + ((centre - start) @ axis) * axis,
        0.7,
        0.6,
        ball(0.7),
        rod(0.6, axis),
    )


def capsules(x_a, r_a, x_b, r_b, g):
    e_a, e_b = r_a @ g["edge_a"], r_b @ g["edge_b"]
    p, q = nearest_on_lines(x_a + r_a @ g["corner"], e_a, x_b + r_b @ g["on_face"], e_b)
    return curved(p, q, 0.7, 0.6, rod(0.7, e_a), rod(0.6, e_b))


def vertex_sphere(x_a, r_a, x_b, r_b, g):
    """A corner as the limit of a ball of radius 0."""
    return curved(
        x_a + r_a @ g["corner"],
        x_b + r_b @ g["on_face"],
        0.0,
        0.9,
        1e12 * EYE,
        ball(0.9),
    )


def vertex_capsule(x_a, r_a, x_b, r_b, g):
    touch = sphere_capsule(x_a, r_a, x_b, r_b, g)
    data = {"curvature_a": 1e12 * EYE, "curvature_b": touch.data["curvature_b"]}
    return Touch(
        touch.point_a + 0.7 * touch.normal, touch.point_b, touch.normal, "curved", data
    )


def ball_in_bowl(x_a, r_a, x_b, r_b, g):
    """A hollow of radius 2.5 has the curvature -1/2.5."""
    centre, bowl = x_a + r_a @ g["corner"], x_b + r_b @ g["on_face"]
    n = unit(bowl - centre)
    return Touch(
        centre - 0.3 * n,
        bowl - 2.5 * n,
        n,
        "curved",
        {"curvature_a": ball(0.3), "curvature_b": -EYE / 2.5},
    )


KINDS = [face_b, face_a, edges, sphere_plane, plane_sphere, sphere_sphere, sphere_capsule, capsules,
         vertex_sphere, vertex_capsule, ball_in_bowl]  # fmt: skip


def draw_numbers(rng):
    """The points, edges and face that a kind of contact reads, in the bodies' own axes."""
    return {
        name: rng.normal(size=3) for name in ("corner", "on_face", "edge_a", "edge_b")
    } | {"normal": unit(rng.normal(size=3))}


def drawn_inertias(rng, count):
    """Moments of 1 kg m^2 and more, by second moments S: I = tr(S) 1 - S (H. Goldstein, section 5.3), as of a body.

    A positive matrix drawn as I itself may have a principal moment above the sum of the other two: no body has that.
    """
    root = rng.normal(size=(count, 3, 3))
    second = 0.5 * (root @ np.swapaxes(root, 1, 2) + EYE)
    return np.trace(second, axis1=1, axis2=2)[:, None, None] * EYE - second


class Flight:
    """n bodies under forces and torques, integrated to 1e-13; ``wrench(t)`` gives both, (n, 3)."""

    def __init__(self, rng, count):
        self.count = count
        self.mass = rng.uniform(0.5, 3, count)
        self.inertia = drawn_inertias(rng, count)
        quaternion = np.array([unit(q) for q in rng.normal(size=(count, 4))])
        push = rng.normal(size=(4, count, 3))
        self.wrench = lambda t: (push[0] + t * push[1], push[2] + t * push[3])
        momenta = 0.3 * rng.normal(
            size=(2 * count, 3)
        )  # slow enough that differences over 5e-6 s are good to 1e-9
        self.start = np.concatenate(
            [x.ravel() for x in (rng.normal(size=(count, 3)), quaternion, momenta)]
        )

    def bodies(self, state):
        n = self.count
        x, q, p, spin = np.split(state, [3 * n, 7 * n, 10 * n])
        q = q.reshape(n, 4)
        q = q / np.linalg.norm(q, axis=1, keepdims=True)
        return Bodies(
            self.mass,
            self.inertia,
            x.reshape(n, 3),
            q,
            p.reshape(n, 3),
            spin.reshape(n, 3),
        )

    def touch(self, kind, numbers, state, a=0, b=1):
        bodies = self.bodies(state)
        r = rotations.to_matrix(bodies.orientation)
        return kind(bodies.position[a], r[a], bodies.position[b], r[b], numbers)

    def rate(self, t, state):
        n, bodies = self.count, self.bodies(state)
        force, torque = self.wrench(t)
        w, q = bodies.angular_velocity, state[3 * n : 7 * n].reshape(n, 4)
        q_dot = 0.5 * np.concatenate(
            [
                w * q[:, 3:] + np.cross(w, q[:, :3]),
                -np.sum(w * q[:, :3], axis=1, keepdims=True),
            ],
            axis=1,
        )
        return np.concatenate(
            [x.ravel() for x in (bodies.velocity, q_dot, force, torque)]
        )

    def at(self, t):
        if t == 0:
            return self.start
        run = solve_ivp(
            self.rate, (0, t), self.start, method="DOP853", rtol=1e-13, atol=1e-15
        )
        assert run.success
        return run.y[:, -1]
