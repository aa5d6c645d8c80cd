"""An answer's film: it plays beside what is right, and a check says how to see it."""

import json
import re
from pathlib import Path

import numpy as np
import pytest

from course.exercises.definition import find_exercise
from course.workbook import check, use, watch
from course.workbook.stage.encoding import encoded
from course.workbook.watching import ELSEWHERE, MISPRINTED, WATCHED

#: Seconds together: left out of the minute's run.
pytestmark = pytest.mark.slow

#: A planted mistake of each that is seen at once.
SEEN = {
    "spheres_overlap": "sum of squares",
    "boxes_overlap": "one axis is enough",
    "closest_point_on_segment": "not limited",
    "sphere_capsule_gap": "endless",
    "capsule_gap": "feet only",
    "sphere_box_gap": "radius left out",
    "support": "against",
    "rotated_box_extents": "one corner",
    "k_dop": "sign of the lower end",
    "compound_support": "direction not turned",
    "contact_state": "no tolerance of speed",
    "place": "turned back",
    "shadow_gap": "minimum",
    "polygons_overlap": "x and y",
    "oriented_boxes_overlap": "six axes",
    "swept_spheres_time": "one radius",
    "swept_boxes_time": "axis at rest never inside",
    "conservative_advancement": "radius forgotten",
    "rotate": "the other way",
    "world_inertia": "body axes",
    "point_velocity": "r x omega",
    "normal_rate": "order",
    "free_point_acceleration": "no centripetal term",
    "angular_acceleration": "I alpha",
    "symplectic_euler_step": "explicit Euler",
    "rk4_step": "explicit Euler",
    "momentum_after": "both plus",
    "separation_speed": "as printed",
    "wall_bounce": "always 2",
    "impulse_central": "as printed",
    "bounce_times": "sqrt(h/g)",
    "bouncing_ball_step": "not turned round",
    "effective_mass": "spin left out",
    "impulse_at_point": "no e",
    "apply_impulse": "n x r",
    "simultaneous_impulses": "only e",
    "angular_acceleration_free": "L x omega forgotten",
    "contact_bias": "N_dot lost",
    "point_response": "no turning",
    "contact_matrix_entry": "no turning",
    "contact_matrix": "mass forgotten",
    "solve_contact_qp": "not limited",
    "projected_gauss_seidel": "clips the change",
    "pivot": "nobody leaves",
}


def impulse_central(mass_1, mass_2, velocity_1, velocity_2, normal, restitution):
    """As the slide prints the restitution line: right but for the sign of e."""
    closing = np.sum((velocity_2 - velocity_1) * normal, axis=-1)
    impulse = (1 - restitution) * closing / (1 / mass_1 + 1 / mass_2)
    return np.where(closing > 0, impulse, 0.0)


def film_of(name, answer, **values):
    return WATCHED[name].exhibit(name, answer).made(**values)


def apart(film):
    """The greatest difference between the two panes, of places [m] and of quaternions up to sign."""
    right, other = film.panes
    place = np.abs(np.asarray(right.position) - np.asarray(other.position)).max()
    q, r = np.asarray(right.orientation), np.asarray(other.orientation)
    turned = np.minimum(np.abs(q - r).max(axis=-1), np.abs(q + r).max(axis=-1)).max()
    return max(float(place), float(turned))


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


def test_lessons_with_films_import_watch():
    """What a check says can be typed into a cell as it stands."""
    for name in WATCHED:
        lesson, _ = find_exercise(name)
        folder = Path(__file__).parents[2] / "solutions"
        source = folder / lesson.file_name
        cells = json.loads(source.read_text("utf-8"))["cells"]
        code = "".join("".join(c["source"]) for c in cells if c["cell_type"] == "code")
        assert re.search(r"from course\.workbook import [^)]*\bwatch\b", code), source


def test_an_exercise_that_moves_nothing_is_refused():
    def speed_along():
        """No motion."""

    with pytest.raises(ValueError, match="answer: expected a function that moves"):
        watch(speed_along)


def test_of_an_expression_no_names_of_other_lessons_are_told():
    with pytest.raises(ValueError, match="got foot_share, an expression") as told:
        watch("foot_share")
    assert "solve_contact_qp" not in str(told.value)


@pytest.mark.slow
@pytest.mark.parametrize("name", WATCHED)
def test_the_right_answer_moves_as_the_right_one_does(name):
    exercise = find_exercise(name)[1]
    assert exercise.kind == "function"
    exhibit = WATCHED[name].exhibit(name, exercise.reference)
    for values in ({}, *(preset.values for preset in exhibit.presets)):
        film = exhibit.made(**values)
        assert film.panes[1].title == "your function"
        assert apart(film) < 1e-12


@pytest.mark.parametrize("name", WATCHED)
def test_a_planted_mistake_is_seen(name):
    mistakes = find_exercise(name)[1].mistakes
    mistake = next(m for m in mistakes if m.name == SEEN[name])
    assert apart(film_of(name, mistake.function)) > 0.02


@pytest.mark.slow
@pytest.mark.parametrize("name", WATCHED)
@pytest.mark.long
def test_no_planted_mistake_breaks_the_film(name):
    """Whatever a mistake gives, the film is made, and says something."""
    for mistake in find_exercise(name)[1].mistakes:
        film = film_of(name, mistake.function)
        json.dumps(encoded(film), allow_nan=False)
        assert film.ending and len(film.panes) == 2


CASES = [(case, name) for case, films in ELSEWHERE.items() for name in films]


@pytest.mark.parametrize(("case", "name"), CASES)
def test_another_case_shows_right_and_wrong_answers(case, name):
    exercise = find_exercise(name)[1]
    exhibit = ELSEWHERE[case][name].exhibit(name, exercise.reference)
    assert len(ELSEWHERE[case][name].exhibit(name, None).made().panes) == 1
    for values in ({}, *(preset.values for preset in exhibit.presets)):
        film = exhibit.made(**values)
        json.dumps(encoded(film), allow_nan=False)
        assert film.ending.startswith("Here both") and apart(film) < 1e-5
    seen = []
    for mistake in exercise.mistakes:
        film = ELSEWHERE[case][name].exhibit(name, mistake.function).made()
        json.dumps(encoded(film), allow_nan=False)
        seen.append(apart(film) > 0.02 or "function" in film.ending)
    assert any(seen)


def test_another_case_is_asked_for_by_name_and_refused_where_there_is_none():
    def pivot(a, b):
        return np.zeros(len(b))

    film = watch(pivot, on="stack").shown.made()
    assert (
        film.ending
        == "With your function box 1 sinks into what is below it, d̈ = −9.81 m/s²"
    )
    with pytest.raises(
        ValueError, match="on: expected 'stack' for your pivot; got 'cradle'"
    ):
        watch(pivot, on="cradle")
    with pytest.raises(ValueError, match="on: expected left out for impulse_central"):
        watch(impulse_central, on="stack")


@pytest.mark.parametrize("name", MISPRINTED)
def test_the_printed_formula_plays_beside_the_mended_one(name):
    film = film_of(name, "printed")
    assert film.panes[1].title.endswith(
        ("as the slide prints it", "as the slide has it", "as the slide repeats it")
    )
    assert apart(film) > 0.02


@pytest.mark.parametrize("name", sorted(set(WATCHED) - set(MISPRINTED)))
def test_where_no_motion_is_misprinted_it_is_refused(name):
    with pytest.raises(ValueError, match="against: expected a function; got 'printed'"):
        WATCHED[name].exhibit(name, "printed")


def test_a_name_plays_what_the_slide_prints_and_the_page_of_misprints_says_so():
    shown = watch("wall_bounce").shown.made()
    assert shown.panes[1].title == "v − 2 (v·n) n, as the slide has it"
    with pytest.raises(ValueError, match="answer: expected the function itself"):
        watch("rk4_step")
    page = (Path(__file__).parents[2] / "docs" / "misprints.md").read_text("utf-8")
    entries = page.split("\n## ")[1:]
    for number, entry in enumerate(entries, start=1):
        played = set(re.findall(r'`watch\("(\w+)"\)`', entry))
        assert played == {name for name, n in MISPRINTED.items() if n == number}


def raises(*given):
    raise ZeroDivisionError("float division by zero")


def interrupted(*given):
    raise KeyboardInterrupt


@pytest.mark.parametrize("name", WATCHED)
@pytest.mark.parametrize(
    ("answer", "said"),
    [
        (raises, "your function raised ZeroDivisionError: float division by zero"),
        (lambda *given: np.zeros((7, 7)), "your function returned "),
        (lambda *given: None, "your function returned nothing: is there a `return`?"),
        (lambda *given: "here", "your function returned "),
        (interrupted, "your function was interrupted before it was done"),
    ],
)  # fmt: skip
def test_what_moves_nothing_is_said_beside_the_right_one(name, answer, said):
    film = film_of(name, answer)
    json.dumps(encoded(film), allow_nan=False)
    right, other = film.panes
    assert said in other.title and said in film.ending
    place = np.asarray(other.position)
    assert np.array_equal(place[0], place[-1])
    assert np.ptp(np.asarray(right.position), axis=0).max() > 0 or apart(film) > 0


@pytest.mark.parametrize("bad", [np.nan, np.inf])
def test_what_is_no_number_is_said(bad):
    film = film_of("impulse_central", lambda *given: bad)
    assert (
        film.ending == f"your function returned {'NaN' if bad != bad else 'infinity'}"
    )


def test_an_interrupted_answer_is_not_asked_again():
    asked = []

    def endless(*given):
        asked.append(given)
        raise KeyboardInterrupt

    exhibit = WATCHED["wall_bounce"].exhibit("wall_bounce", endless)
    exhibit.made()
    exhibit.made(restitution=0.3)
    assert len(asked) == 1


def test_an_answer_cannot_write_into_what_it_is_given():
    def momentum_after(momentum_1, momentum_2, impulse, normal):
        momentum_1 += impulse * normal
        momentum_2 -= impulse * normal
        return momentum_1, momentum_2

    assert apart(film_of("momentum_after", momentum_after)) < 1e-12


def test_a_function_that_is_lent_is_not_called_yours(capsys):
    def wall_bounce(*given):
        return None

    for name in ("wall_bounce", "oriented_boxes_overlap"):
        wall_bounce.__name__ = name
        lent = use(wall_bounce, name)
        assert "the reference for now" in capsys.readouterr().out
        titles = [pane.title for pane in film_of(name, lent).panes]
        assert titles[1] == "the workbook's, lent"


def test_what_a_lent_function_draws_is_not_called_yours_either(capsys):
    """Legends, numbers and endings, of every film that a lent function plays."""
    for name in WATCHED:
        if find_exercise(name)[1].kind == "expression":
            continue

        def empty(*given):
            return None

        empty.__name__ = name
        film = film_of(name, use(empty, name))
        said = [
            word for chart in film.charts for word in getattr(chart, "curves", {})
        ] + [film.ending]
        assert not [word for word in said if "your" in word], name


def test_a_name_without_a_misprint_is_told_to_be_the_function():
    with pytest.raises(ValueError, match=r"watch\(shadow_gap\); got 'shadow_gap'"):
        watch("shadow_gap")
