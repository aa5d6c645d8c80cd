"""Stepping down a dome against where a particle leaves it in closed form."""

import pytest

from course.dynamics import Dome
from course.study import slide_off
from course.study.domes import RULES


def test_stepping_finds_the_angles():
    dome = Dome(start=0.1)
    late = [slide_off(dome, h)[0] - dome.leaving_angle for h in (0.01, 0.0025)]
    assert (
        0 <= late[1] < 0.0025 * 4 and 0 <= late[0] < 0.01 * 4
    )  # theta_dot is below 4 rad/s there
    located = [
        abs(slide_off(dome, h, rule=RULES[2])[0] - dome.leaving_angle)
        for h in (0.02, 0.0025)
    ]
    assert located[0] < 2e-3 and located[1] < 3e-5
    printed = slide_off(dome, 1e-3, rule="as printed")[0]
    assert printed == pytest.approx(dome.leaving_angle_as_printed, abs=5e-3)
    assert (
        slide_off(dome, 0.01)[1] % 4 == 0
        and slide_off(dome, 0.005)[1] > slide_off(dome, 0.01)[1]
    )
