"""Pictures of impacts with spin: what is drawn, and that the alternative text says the numbers."""

import numpy as np
import pytest
from scenes.parts import bodies_and_contacts
from workbook.pictures import text

from course.contact import resolve_collisions
from course.scenes import box_on_corners
from course.study import box_outcomes, outcomes_by_order, rod_landing
from course.workbook import plots

pytestmark = pytest.mark.slow  # with its like, left out of --quick


@pytest.mark.parametrize(
    ("angle", "restitution", "place", "told"),
    [
        (
            0.0,
            1.0,
            1.0,
            (
                "0.250 kg",
                "0.500 N s",
                "-0.50 m/s upward",
                "3.00 rad/s, anticlockwise",
                "100 percent",
            ),
        ),
        (
            0.0,
            1.0,
            0.0,
            ("1.000 kg", "2.000 N s", "+1.00 m/s upward", "0.00 rad/s;", "100 percent"),
        ),
        (90.0, 0.0, 1.0, ("1.000 kg", "1.000 N s", "0.00 rad/s;", "; 0 percent")),
        (
            0.0,
            0.0,
            -1.0,
            ("0.250 kg", "0.250 N s", "1.50 rad/s, clockwise", "75 percent"),
        ),
    ],
)
def test_a_rod_tells_what_happens_to_it(angle, restitution, place, told):
    # With s = place cos theta: 1/mu = 1 + 3 s^2, p = (1 + e) mu, spin = 6 p s, mu (1 - e^2)/2 of 0.5 J is lost.
    ax = plots.rod_impact(rod_landing(angle, restitution, place))
    for words in told:
        assert words in text(ax)


def test_the_question_gives_both_impulses():
    ax = plots.rod_on_pegs()
    assert "gives it 2 N s" in text(ax) and "gives it 0.5 N s" in text(ax)


def test_impulses_over_the_angle():
    ax = plots.rod_impulses(
        [0, 90], [0.5, 2.0], {"measured": ([0, 45], [0.5, 0.8])}, without_spin=2.0
    )
    assert "measured: 0.500 N s at 0 degrees, 0.800 at 45" in text(ax)
    assert [line.get_label() for line in ax.lines][-1] == "measured" and len(
        ax.lines
    ) == 4


def test_a_box_has_its_corners_speeds():
    box, corners = bodies_and_contacts(box_on_corners())
    after = {
        law: resolve_collisions(box, corners, 0.5, law=law)
        for law in ("simultaneous", "reflection")
    }
    ax = plots.box_outcomes(box_outcomes(box, corners.point, after))
    assert "before: -1.00, -1.00, -1.00, -1.00 m/s" in text(
        ax
    ) and "reflection: 0.50, 0.50, 0.50, 0.50 m/s" in text(ax)
    assert "-0.00" not in text(ax)
    minus = "\N{MINUS SIGN}1.00"
    written = [t.get_text() for t in ax.texts if t.get_text()]  # arrows have none
    assert written == [f"{i}: {minus}" for i in (1, 2, 3, 4)]
    _, bars = ax.get_figure().axes
    assert [bar.get_height() for bar in bars.patches] == pytest.approx([0.5] * 8)


def test_the_spin_of_a_box_is_told_with_its_sign():
    """Standing on its left edge: about +y the right one comes down, about -y it goes up."""
    box, corners = bodies_and_contacts(box_on_corners(spin=(0.0, 2.0, 0.0)))
    after = {"thrown back": resolve_collisions(box, corners, 1.0, law="simultaneous")}
    ax = plots.box_outcomes(box_outcomes(box, corners.point, after))
    assert "before: 0.00, 0.00, -2.00, -2.00 m/s, spin (0.00, 2.00)" in text(ax)
    assert "thrown back: 0.00, 0.00, 2.00, 2.00 m/s, spin (0.00, -2.00)" in text(ax)
    (entry,) = ax.get_figure().axes[1].get_legend().get_texts()
    assert entry.get_text() == "thrown back: (0.00, -2.00)"


def test_spins_are_drawn_one_an_order():
    box, corners = bodies_and_contacts(box_on_corners())
    orders = [(0, 1, 2, 3), (3, 2, 1, 0), (0, 2, 1, 3)]
    ax = plots.spins_by_order(
        outcomes_by_order(box, corners, 1.0, orders), {"at once": np.zeros(3)}
    )
    assert len(
        ax.lines[0].get_xdata()
    ) == 3 and "3 orders: 3 different outcomes" in text(ax)
    assert "at once: 0.00 rad/s" in text(ax) and not ax.texts


def test_orders_with_one_outcome_are_counted():
    box, corners = bodies_and_contacts(box_on_corners())
    same = outcomes_by_order(
        box, corners, 1.0, [(0, 1, 2, 3), (3, 2, 1, 0), (0, 1, 2, 3)]
    )
    ax = plots.spins_by_order(same, {})
    (label,) = ax.texts
    outward = "left" if label.xy[0] > 0 else "right"  # away from the other marks
    assert (label.get_text(), label.get_ha()) == ("2 orders", outward)
    assert "2 different outcomes" in text(ax)


def test_pegs_mark_the_threshold():
    ax = plots.spin_by_pegs(
        [0.1, 0.3], {"left": [1.0, -0.2], "right": [-1.0, 0.2]}, [0.0, 0.0], 0.289
    )
    assert "up to 1.00 rad/s" in text(ax) and "0.289 m" in text(ax)


def test_the_face_shows_where_spin_does_not_matter():
    x, y = np.linspace(-1, 1, 21), np.linspace(-1, 1, 11)
    ax = plots.mass_over_face(x, y, 1 / (1 + x**2 + y[:, None] ** 2))
    assert "0.33 at the corners" in text(ax)
    assert [t.get_text() for t in ax.get_legend().get_texts()] == [
        "1 % too large",
        "10 % too large",
        "50 % too large",
    ]
