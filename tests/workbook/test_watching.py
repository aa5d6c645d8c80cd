"""An answer's film: it plays beside what is right, and a check says how to see it."""

import numpy as np
import pytest

from course.workbook import check, watch
from course.workbook.watching import WATCHED


def impulse_central(mass_1, mass_2, velocity_1, velocity_2, normal, restitution):
    """As the slide prints the restitution line: right but for the sign of e."""
    closing = np.sum((velocity_2 - velocity_1) * normal, axis=-1)
    impulse = (1 - restitution) * closing / (1 / mass_1 + 1 / mass_2)
    return np.where(closing > 0, impulse, 0.0)


def test_a_wrong_answer_is_seen_beside_the_right_one():
    shown = watch(impulse_central)
    film = shown.shown.made()
    assert [pane.title for pane in film.panes][1] == "your function"
    right, wrong = film.numbers[0].values
    assert right == pytest.approx(4.8) and wrong == pytest.approx(0.2 / 1.8 * right)
    left, came = np.asarray(film.panes[1].position)[-1, :2, 0]
    assert left < came, "body 1 is left of body 2 in the end: they passed through"


def test_a_check_says_how_to_see_it(capsys):
    check(impulse_central)
    assert "watch(impulse_central) plays it" in capsys.readouterr().out


def test_an_exercise_that_moves_nothing_is_refused():
    def p_hat():
        """No motion."""

    with pytest.raises(ValueError, match="answer: expected a function that moves"):
        watch(p_hat)


def test_every_watched_exercise_has_its_film():
    from course.exercises.definition import find_exercise
    from course.workbook.films.listing import LISTED

    for exercise, film in WATCHED.items():
        assert find_exercise(exercise)[1].kind == "function"
        assert film in {listed.name for listed in LISTED} | {"wall"}
