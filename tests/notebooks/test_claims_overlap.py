"""What lesson 04 says in numbers, computed; each number is read from its sentence."""

import numpy as np
import pytest
from lesson_text import rounds_to, said

from course import formulas
from course.study import (
    DECIDED,
    LOST_BELOW,
    far_meeting,
    feet_apart,
    nearly_touching,
    rods_side_by_side,
    safe_until,
    spacing,
    sphere_pairs,
    sphere_verdict_bytes,
    tenths,
    with_margin,
    wrong_far_out,
)

#: Seconds together: left out of the minute's run.
pytestmark = pytest.mark.slow
VERDICT = formulas.spheres_overlap


def test_how_wrong_so_many_bytes_are():
    as_they_are, from_a = said(
        "04",
        "4 bytes give # percent of wrong verdicts, and only 8 bytes give none. Seen from "
        "$A$ first, 2 bytes give # percent and 4 bytes none.",
    )
    pairs = sphere_pairs(10_000, 1e6, seed=4, clear=1e-3)
    assert 1 / 3 < np.mean(np.abs(pairs.gap) < 0.01) < 0.4, "over a third below 1 cm"
    found = sphere_verdict_bytes(pairs).error
    assert rounds_to(100 * found[1], as_they_are) and rounds_to(100 * found[3], from_a)
    assert found[2] == found[4] == 0.0 and found[0] > 0.45
    assert 45 < found[1] / found[3] < 60, "fifty times fewer"


def test_where_verdicts_go_wrong_far_out():
    line, fine, coarse = said(
        "04",
        "up to the line at # km no verdict is wrong, as computed: $\\sqrt3\\cdot#$ mm are "
        "less than 1 cm, $\\sqrt3\\cdot#$ mm are more",
    )
    assert rounds_to(safe_until(0.01) / 1000, line)
    for place, step in ((65e3, fine), (66e3, coarse)):
        assert rounds_to(1e3 * spacing(place), step)
    assert np.sqrt(3) * spacing(65e3) < 0.01 < np.sqrt(3) * spacing(66e3)
    (first,) = said("04", "the first wrong ones come with the next step, at # km.")
    assert rounds_to(2.0**17 / 1000, first)
    assert list(wrong_far_out(VERDICT, [1.30e5, 1.32e5]) > 0) == [False, True]
    places = 10.0 ** np.arange(1, 9.1, 0.25)
    shares = wrong_far_out(VERDICT, places)
    at_1000, at_10000 = said(
        "04",
        "At 1,000 km # percent are wrong (not 21: the pairs below 1 cm are left out), at "
        "10,000 km # percent",
    )
    for place, number in ((1e6, at_1000), (1e7, at_10000)):
        assert rounds_to(100 * wrong_far_out(VERDICT, [place])[0], number)
    assert np.all(shares[places > 9e7] > 0.47), "a coin would do as well"
    assert np.all(wrong_far_out(VERDICT, places, first_from_a=True) == 0.0)
    (power,) = said(
        "04", "With 8 bytes throughout the line lies at $3.5\\cdot10^{#}$ m"
    )
    assert safe_until(0.01, 8) == pytest.approx(3.5 * 10 ** int(power), rel=0.01)


def test_where_the_spheres_of_the_question_are_stopped():
    times = np.linspace(0, 6, 361)
    early, late = said(
        "04",
        "at $10^8$ m the true gap is # m when $B$ stops. Stored, the distance of the "
        "centres goes from 16 m to 8 m at once, and 8 m is less than both radii together. "
        "With $B$ aside by 5 m it ends # m deep in $A$ instead",
    )
    for lane, number, sign in ((0.0, early, 1), (5.0, late, -1)):
        found = far_meeting(1e8, lane, times, 4, VERDICT)
        assert rounds_to(sign * found.gap[-1], number)
    assert spacing(1e8) == 8.0 and spacing(1e7) == 1.0


def test_how_many_tenths_touch():
    apart, strict = said(
        "04", "with `<=` # of them are called apart, and with `<` still # are called"
    )
    x_a, r_a, x_b, r_b = tenths().arguments
    assert np.sum(~VERDICT(x_a, r_a, x_b, r_b)) == int(apart)
    less = np.sum((x_a - x_b) ** 2, axis=-1) < (r_a + r_b) ** 2
    assert np.sum(less) == int(strict)
    assert with_margin(VERDICT, 1e-9)(x_a, r_a, x_b, r_b).all()
    (share,) = said("04-more", "beyond $#\\cdot10^{-16}$ of the sum of the radii")
    assert rounds_to(1e16 * DECIDED, share)


def test_where_touching_is_decided_wrongly():
    low, high = said(
        "04-more",
        "wrong verdicts lie at gaps from about $#\\cdot10^{-16}$ to $#\\cdot10^{-16}$, "
        "nearly all above 0",
    )
    pairs = nearly_touching(4000)
    gap = 1e16 * pairs.gap / (pairs.radius_a + pairs.radius_b)
    wrong = gap[VERDICT(*pairs.arguments) != pairs.overlap]
    assert rounds_to(wrong.min(), low) and rounds_to(wrong.max(), high)
    assert np.mean(wrong > 0) > 0.9


def test_up_to_which_radii_2_bytes_serve():
    least, most, far, step = said(
        "04", "here of # to # m. At # m steps of 2 bytes are # cm."
    )
    pairs = sphere_pairs(10_000, 1e6, seed=4)
    for radii in (pairs.radius_a, pairs.radius_b):
        assert float(least) < radii.min() and radii.max() < float(most)
    assert rounds_to(100 * spacing(float(far), 2), step)
    assert wrong_far_out(VERDICT, [1e6], size=2, first_from_a=True)[0] == 0.0


def test_how_wrong_feet_alone_are():
    (angle,) = said("04-more", "at an angle of $2^{-26.5} = #\\cdot10^{-8}$ both")
    assert rounds_to(1e8 * LOST_BELOW, angle)
    (worst,) = said("04-more", "their distance is wrong by up to # m.")
    angles = 10.0 ** np.arange(-11, -2.9, 0.5)
    wrong = [np.abs(feet_apart(*rods_side_by_side(a)) - 0.5).max() for a in angles]
    assert max(wrong) == pytest.approx(float(worst), rel=0.1)
    assert all(w < 1e-3 for w, a in zip(wrong, angles, strict=True) if a > LOST_BELOW)
