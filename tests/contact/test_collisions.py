"""Many collisions at once: what every law must keep, what tells the laws apart, and where it stops."""

from fractions import Fraction

import numpy as np
import pytest
from scipy.spatial.transform import Rotation

from course.contact import CollisionsUnresolved, collisions, resolve_collisions
from course.dynamics import Bodies, impulse_at_point, normal_velocity
from course.overlap import Contacts

LAWS = ("simultaneous", "sequential", "reflection")


def row(velocity, mass=1.0):
    """Touching balls along x, body A of each contact on the left."""
    v = np.asarray(velocity, dtype=float)
    n = v.size
    bodies = Bodies.balls(
        mass, 0.5, np.arange(n)[:, None] * [1.0, 0, 0], v[:, None] * [1.0, 0, 0]
    )
    left = np.arange(n - 1)
    points = (left[:, None] + 0.5) * [1.0, 0, 0]
    return bodies, Contacts(
        left, left + 1, points, np.tile([-1.0, 0, 0], (n - 1, 1)), np.zeros(n - 1)
    )


def along(velocity, e, law, mass=1.0):
    return resolve_collisions(*row(velocity, mass), e, law=law).velocity[:, 0]


def cluster(rng, *, decades, fixed, spin):
    """Bodies with random contacts between any of them: more contacts than motion can tell apart."""
    n = rng.integers(2, 8)
    mass = 10 ** rng.uniform(-decades / 2, decades / 2, n)
    mass[rng.random(n) < fixed] = np.inf
    moving = np.isfinite(mass)[:, None]
    weight = np.where(moving[:, 0], mass, 0.0)[:, None]
    x, v, omega = rng.normal(size=(3, n, 3))
    if spin:
        d = rng.uniform(0.1, 1, (n, 3))
        inertia = (
            np.where(moving, weight, 1)[:, :, None]
            * 0.1
            * np.eye(3)
            * (d.sum(axis=1)[:, None] - d)[:, None]
        )
        q = Rotation.random(n, random_state=rng).as_quat()
        bodies = Bodies(mass, inertia, x, q, weight * v, 0.1 * weight * omega)
    else:
        bodies = Bodies.balls(mass, 0.5, x, v * moving)
    count = rng.integers(1, 3 * n + 1)
    a = rng.integers(0, n, count)
    b = (a + rng.integers(1, n, count)) % n
    normal = x[a] - x[b] + (0.5 * rng.normal(size=(count, 3)) if spin else 0)
    normal /= np.linalg.norm(normal, axis=1, keepdims=True)
    point = 0.5 * (x[a] + x[b]) + (0.3 * rng.normal(size=(count, 3)) if spin else 0)
    return bodies, Contacts(a, b, point, normal, np.zeros(count))


def energy(bodies):
    spin = np.einsum("ni,ni->n", bodies.angular_momentum, bodies.angular_velocity)
    return 0.5 * (np.einsum("ni,ni->n", bodies.momentum, bodies.velocity) + spin)


def check_outcome(before, contacts, after, e):
    """The promises made for every law; gives back whether energy was lost."""
    start, end = energy(before).sum(), energy(after).sum()
    assert end <= start * (1 + 1e-12)
    if e == 1:
        assert end == pytest.approx(start, rel=1e-12)
    u = normal_velocity(before, contacts)
    assert (
        normal_velocity(after, contacts).min()
        >= -1e-12 * max(-u.min(), 0) - 8e-16 * abs(before.velocity).max()
    )
    fixed = before.fixed
    assert not after.momentum[fixed].any() and not after.angular_momentum[fixed].any()
    if not fixed.any():
        for total in (
            lambda b: b.momentum,
            lambda b: np.cross(b.position, b.momentum) + b.angular_momentum,
        ):
            scale = (
                np.abs(total(before)).sum()
                + np.abs(np.cross(before.position, before.momentum)).sum()
            )
            assert (
                np.abs(total(after).sum(axis=0) - total(before).sum(axis=0)).max()
                <= 1e-12 * scale
            )
    untouched = np.setdiff1d(
        np.arange(len(before)), np.concatenate([contacts.body_a, contacts.body_b])
    )
    assert np.array_equal(after.momentum[untouched], before.momentum[untouched])
    assert after.position is before.position and after.orientation is before.orientation
    if u.min() >= 0:
        assert np.array_equal(after.momentum, before.momentum)
        assert np.array_equal(after.angular_momentum, before.angular_momentum)


@pytest.mark.parametrize("law", LAWS)
@pytest.mark.parametrize("spin", [False, True])
@pytest.mark.parametrize("decades", [1, 6])
@pytest.mark.parametrize("trials", [18, pytest.param(120, marks=pytest.mark.slow)])
def test_promises_on_random_clusters(law, spin, decades, trials):
    rng = np.random.default_rng(41)
    for trial in range(trials):
        bodies, contacts = cluster(
            rng, decades=decades, fixed=0.0 if trial % 3 else 0.3, spin=spin
        )
        e = (0.0, 1.0, rng.random())[trial % 3 if trial % 2 else (trial // 2) % 3]
        after = resolve_collisions(bodies, contacts, e, law=law)
        check_outcome(bodies, contacts, after, e)


@pytest.mark.parametrize("law", LAWS)
def test_a_contact_alone_is_impulse_at_point(law):
    rng = np.random.default_rng(42)
    parts, contacts, shift = [], [], 0
    for _ in range(30):
        body, contact = cluster(rng, decades=2, fixed=0.2, spin=True)
        parts.append(body)
        one = contact[[0]]
        contacts.append(
            Contacts(
                one.body_a + shift,
                one.body_b + shift,
                one.point,
                one.normal,
                one.separation,
            )
        )
        shift += len(body)
    bodies = Bodies(
        *(
            np.concatenate([getattr(p, f) for p in parts])
            for f in Bodies.__dataclass_fields__
        )
    )
    joined = Contacts.concatenate(contacts)
    after = resolve_collisions(bodies, joined, 0.6, law=law)
    change = np.linalg.norm(after.momentum - bodies.momentum, axis=1)
    p_hat = impulse_at_point(bodies, joined, 0.6)
    for body in (joined.body_a, joined.body_b):
        free = ~bodies.fixed[body]
        assert np.allclose(change[body][free], p_hat[free], rtol=1e-12, atol=1e-15)
    assert (p_hat > 0).sum() > 5 and (p_hat == 0).sum() > 5


def test_cradle():
    # One ball onto two touching, e = 1; both outcomes keep momentum and energy.
    assert np.allclose(
        along([1, 0, 0], 1, "simultaneous"), [-1 / 3, 2 / 3, 2 / 3], atol=1e-15
    )
    assert np.allclose(along([1, 0, 0], 1, "sequential"), [0, 0, 1], atol=1e-15)
    assert np.allclose(along([1, 0, 0], 1, "reflection"), [0, 0, 1], atol=1e-15)


@pytest.mark.parametrize("n", [2, 5, 12])
def test_longer_cradles(n):
    one = np.eye(n)[0]
    # All of the row is pushed at once: impulse 2/(1 + 1/(n-1)) against a block of n - 1 balls.
    assert np.allclose(
        along(one, 1, "simultaneous"),
        [1 - 2 * (n - 1) / n] + [2 / n] * (n - 1),
        atol=1e-14,
    )
    for law in ("sequential", "reflection"):
        assert np.allclose(along(one, 1, law), one[::-1], atol=1e-14)
        assert np.allclose(
            along(one + np.eye(n)[1], 1, law), (one + np.eye(n)[1])[::-1], atol=1e-14
        )
    for law in LAWS:  # nothing is left of the relative motion at e = 0
        assert np.allclose(along(one, 0, law), np.full(n, 1 / n), atol=1e-11)


def test_parting_contact_that_ends_approaching():
    # Three balls (1, 0, .1): solving only the approaching pair leaves the middle one faster than the last.
    # Clamping instead gives (-.3, .7, .7) and gains energy; repeating keeps it.
    assert np.allclose(along([1, 0, 0.1], 1, "simultaneous"), [0, 0.1, 1], atol=1e-15)
    clamped = np.array([-0.3, 0.7, 0.7])
    assert clamped.sum() == pytest.approx(1.1) and (clamped**2).sum() > 1.01


def test_reflection_mixes_plastic_and_elastic():
    # (1 - e) (1/3, 1/3, 1/3) + e (0, 0, 1)
    assert np.allclose(
        along([1, 0, 0], 0.25, "reflection"), [0.25, 0.25, 0.5], atol=1e-15
    )


def test_reflection_keeps_symmetry_where_one_pair_at_a_time_does_not():
    # A ball falls between two that touch nothing else: equal and opposite for all but the sequence.
    s = np.sqrt(0.75)
    bodies = Bodies.balls(
        1.0,
        0.5,
        [[0, s, 0], [-0.5, 0, 0], [0.5, 0, 0]],
        [[0, -1, 0], [0, 0, 0], [0, 0, 0]],
    )
    normals = np.array([[0.5, s, 0], [-0.5, s, 0]])
    points = bodies.position[[1, 2]] + 0.5 * normals
    contacts = Contacts([0, 0], [1, 2], points, normals, [0.0, 0.0])
    for law in ("simultaneous", "reflection"):
        v = resolve_collisions(bodies, contacts, 1, law=law).velocity
        assert np.allclose(v[1] * [-1, 1, 1], v[2], atol=1e-15) and abs(v[0, 0]) < 1e-15
    turned = [
        resolve_collisions(bodies, contacts[order], 1, law="sequential").velocity
        for order in ([0, 1], [1, 0])
    ]
    assert (
        np.abs(turned[0] - turned[1]).max() > 0.1
    )  # the order of the pairs changes the answer
    assert np.allclose(turned[0] * [-1, 1, 1], turned[1][[0, 2, 1]], atol=1e-15)


def rational_row(velocity, e):
    """One pair at a time in fractions, until none approaches or 400 rounds have passed; impacts counted."""
    v, e, count = [Fraction(x) for x in velocity], Fraction(e), 0
    for _ in range(400):
        hit = False
        for i in range(len(v) - 1):
            if v[i] > v[i + 1]:
                p = (1 + e) * (v[i] - v[i + 1]) / 2
                v[i], v[i + 1], hit, count = v[i] - p, v[i + 1] + p, True, count + 1
        if not hit:
            return v, count, True
    return v, count, False


def test_three_balls_need_infinitely_many_impacts_below_the_threshold():
    threshold = 7 - 4 * np.sqrt(3)
    assert threshold == pytest.approx(0.0717968, abs=5e-8)
    exact, impacts, ends = rational_row([1, 0, 0], Fraction(719, 10000))
    assert ends and impacts < 100
    assert np.allclose(
        along([1, 0, 0], 0.0719, "sequential"), [float(x) for x in exact], atol=1e-12
    )
    _, _, ends = rational_row([1, 0, 0], Fraction(7, 100))
    assert not ends
    assert np.allclose(
        along([1, 0, 0], 0.07, "sequential"), np.full(3, 1 / 3), atol=1e-11
    )  # and still an answer


def test_light_ball_between_wall_and_heavy_ball_counts_with_pi():
    # Wall, 1 kg, 10^6 kg, all touching: 3141 impacts. Velocities from fractions.
    v_1, v_2, ratio, count = Fraction(0), Fraction(-1), 10**6, 0
    while v_2 < v_1 or v_1 < 0:
        if v_2 < v_1:
            p = 2 * (v_1 - v_2) / (1 + Fraction(1, ratio))
            v_1, v_2 = v_1 - p, v_2 + p / ratio
            v_1, v_2 = (
                Fraction(int(x * 10**60), 10**60) for x in (v_1, v_2)
            )  # keeps the fractions short
        else:
            v_1 = -v_1
        count += 1
    assert count == 3141
    bodies, contacts = row([0, 0, -1], [np.inf, 1.0, 1e6])
    after = resolve_collisions(bodies, contacts, 1, law="sequential").velocity[:, 0]
    # The kinetic energy of the heavy ball is 10^6 times that of the light one, so 1e-16 of it is 1e-10 here.
    assert np.allclose(after, [0, float(v_1), float(v_2)], atol=1e-9)


@pytest.mark.parametrize("law", LAWS)
def test_box_dropped_flat_on_four_corners_does_not_turn(law):
    bodies = Bodies(
        [2.0, np.inf],
        [np.diag([0.3, 0.4, 0.5]), np.zeros((3, 3))],
        [[0, 0, 0.5], [0, 0, 0]],
        [[0, 0, 0, 1]] * 2,
        [[0.4, 0, -6.0], [0, 0, 0]],
        np.zeros((2, 3)),
    )
    corners = [[x, y, 0.0] for x in (-0.5, 0.5) for y in (-0.3, 0.3)]
    contacts = Contacts([0] * 4, [1] * 4, corners, [[0, 0, 1.0]] * 4, np.zeros(4))
    after = resolve_collisions(bodies, contacts, 0.5, law=law)
    check_outcome(bodies, contacts, after, 0.5)
    if law != "sequential":  # one corner after the other makes it tumble
        assert np.allclose(after.velocity[0], [0.2, 0, 1.5], atol=1e-14)
        assert np.allclose(after.angular_momentum[0], 0, atol=1e-14)


@pytest.mark.parametrize("law", LAWS)
def test_a_common_velocity_changes_nothing(law):
    rng = np.random.default_rng(43)
    bodies, contacts = cluster(rng, decades=1, fixed=0.0, spin=True)
    drift = np.array([300.0, -200.0, 100.0])
    moving = Bodies(
        bodies.mass, bodies.inertia, bodies.position, bodies.orientation,
        bodies.momentum + bodies.mass[:, None] * drift, bodies.angular_momentum,
    )  # fmt: skip
    still, moved = (
        resolve_collisions(b, contacts, 0.7, law=law) for b in (bodies, moving)
    )
    assert np.allclose(moved.velocity - drift, still.velocity, atol=1e-11)


@pytest.mark.parametrize("law", LAWS)
def test_groups_do_not_feel_each_other(law):
    rng = np.random.default_rng(44)
    first, second = (cluster(rng, decades=1, fixed=0.2, spin=True) for _ in range(2))
    bodies = Bodies(
        *(
            np.concatenate([getattr(p[0], f) for p in (first, second)])
            for f in Bodies.__dataclass_fields__
        )
    )
    shift = len(first[0])
    moved = second[1]
    later = Contacts(
        moved.body_a + shift,
        moved.body_b + shift,
        moved.point,
        moved.normal,
        moved.separation,
    )
    both = resolve_collisions(
        bodies, Contacts.concatenate([later, first[1]]), 0.4, law=law
    )
    for part, here in ((first, slice(0, shift)), (second, slice(shift, None))):
        alone = resolve_collisions(*part, 0.4, law=law)
        assert np.allclose(both.momentum[here], alone.momentum, atol=1e-13)


def pinned():
    bodies = Bodies.balls(
        [np.inf, 1, np.inf],
        0.5,
        [[-1.0, 0, 0], [0, 0, 0], [1.0, 0, 0]],
        np.eye(3)[[1, 0, 1]] * [1, 0, 0],
    )
    contacts = Contacts(
        [0, 1], [1, 2], [[-0.5, 0, 0], [0.5, 0, 0]], [[-1.0, 0, 0]] * 2, [0.0, 0.0]
    )
    return bodies, contacts


@pytest.mark.parametrize("law", LAWS)
def test_a_ball_pinned_between_walls_stops_at_the_cap_with_the_state_reached(
    law, monkeypatch
):
    monkeypatch.setattr(collisions, "MAX_ROUNDS", 200)
    bodies, contacts = pinned()
    with pytest.raises(
        CollisionsUnresolved, match=f"1 group.* after 200 rounds, law '{law}', e = 1"
    ) as caught:
        resolve_collisions(bodies, contacts, 1, law=law)
    assert np.allclose(
        np.abs(caught.value.bodies.velocity[1]), [1, 0, 0], atol=1e-13
    )  # its energy is kept


@pytest.mark.parametrize("law", ["simultaneous", "sequential"])
def test_a_pinned_ball_that_loses_energy_comes_to_rest(law):
    bodies, contacts = pinned()
    assert (
        np.abs(resolve_collisions(bodies, contacts, 0.9, law=law).velocity[1]).max()
        <= 1e-12
    )


def test_the_cap_does_not_stop_the_other_groups(monkeypatch):
    monkeypatch.setattr(collisions, "MAX_ROUNDS", 50)
    (stuck, stuck_contacts), (other, other_contacts) = pinned(), row([1, 0, 0])
    bodies = Bodies(
        *(
            np.concatenate([getattr(p, f) for p in (stuck, other)])
            for f in Bodies.__dataclass_fields__
        )
    )
    more = Contacts(
        other_contacts.body_a + 3, other_contacts.body_b + 3, other_contacts.point,
        other_contacts.normal, other_contacts.separation,
    )  # fmt: skip
    with pytest.raises(CollisionsUnresolved) as caught:
        resolve_collisions(bodies, Contacts.concatenate([stuck_contacts, more]), 1)
    assert np.allclose(caught.value.bodies.velocity[3:, 0], [-1 / 3, 2 / 3, 2 / 3])


def test_nothing_happens_without_contacts_between_fixed_bodies_and_to_bodies_that_part():
    bodies, contacts = row([-1, 0, 2])
    for law in LAWS:
        assert np.array_equal(
            resolve_collisions(bodies, contacts, 0.5, law=law).momentum, bodies.momentum
        )
        assert resolve_collisions(bodies, contacts[[]], 0.5, law=law) is bodies
    walls, touching = row([0, 0, 0], np.inf)
    assert not resolve_collisions(walls, touching, 1).momentum.any()


@pytest.mark.parametrize(
    "change, message",
    [
        (dict(restitution=1.5), "restitution: expected numbers from 0 to 1; got 1.5"),
        (dict(restitution=-0.1), "restitution: expected numbers from 0 to 1"),
        (dict(restitution=np.nan), "restitution: expected finite numbers from 0 to 1"),
        (dict(restitution=[0.5, 0.5]), r"restitution: expected one number for all contacts; got shape \(2,\)"),
        (dict(law="elastic"), "law: expected one of 'simultaneous', 'sequential', 'reflection'; got 'elastic'"),
        (dict(contacts=row([0, 0, 0, 0])[1]), r"contacts.body_b: expected whole numbers from 0 to 2; got 3"),
    ],
)  # fmt: skip
def test_refuses(change, message):
    bodies, contacts = row([1, 0, 0])
    arguments = {"bodies": bodies, "contacts": contacts, "restitution": 1.0, **change}
    with pytest.raises(ValueError, match=message):
        resolve_collisions(**arguments)
