"""check, hint, predict and use, as a student meets them (outside a notebook they print)."""

import json
import re
import subprocess
import sys
import threading

import numpy as np
import pytest
import sympy as sp

from course.dynamics import impulse_central as of_the_course
from course.exercises.definition import all_lessons, find_exercise, find_lesson
from course.exercises.letters import with_letters
from course.workbook import check, hint, predict, progress, use
from course.workbook.checking import whats_next
from course.workbook.judging import judge_here

#: Seconds together: left out of the minute's run.
pytestmark = pytest.mark.slow

NAME = "impulse_central"


def right(mass_1, mass_2, velocity_1, velocity_2, normal, restitution):
    closing = np.sum((velocity_2 - velocity_1) * normal, axis=-1)
    return np.where(
        closing > 0, (1 + restitution) * closing / (1 / mass_1 + 1 / mass_2), 0.0
    )


def named(function, name=NAME):
    function.__name__ = name
    return function


def progress_module_itself():
    return sys.modules[
        "course.workbook.recording"
    ]  # as an attribute of the package it is the function


@pytest.fixture(autouse=True)
def a_session_of_its_own(monkeypatch, tmp_path):
    monkeypatch.setattr(progress_module_itself(), "_session", [])
    monkeypatch.chdir(tmp_path)


@pytest.fixture
def work(tmp_path, monkeypatch):
    (tmp_path / "lessons").mkdir()
    folder = tmp_path / "work"
    (folder / ".course").mkdir(parents=True)
    monkeypatch.chdir(folder)
    return folder


def said(capsys) -> str:
    return re.sub(r"\s+", " ", capsys.readouterr().out)


def test_right_answer_names_the_next_exercise_and_the_minutes_left(capsys):
    check(named(right))
    text = said(capsys)
    assert text.startswith("✓ Right: impulse_central")
    assert "kinetic_energy_lost" in text and "minutes" in text


def test_an_answer_that_runs_on_is_told_of_while_it_runs(monkeypatch):
    """In a notebook, where a cell that stays busy would say nothing; a quick answer is told of nothing."""
    module, shown, told = sys.modules["course.workbook.judging"], threading.Event(), []

    def display(message):
        told.append(str(message))
        shown.set()

    monkeypatch.setattr(module, "display_message", display)
    monkeypatch.setattr(module, "in_notebook", lambda: True)
    monkeypatch.setattr(module, "RUNS_ON", 0.3)
    exercise = find_exercise(NAME)[1]
    assert judge_here(exercise, named(right)).passed
    assert not shown.wait(0.6)

    def waits(*given):
        assert shown.wait(20)
        return right(*given)

    assert judge_here(exercise, named(waits)).passed
    assert (
        len(told) == 1
        and "still running after" in told[0]
        and "loop that never ends" in told[0]
    )


def test_wrong_answer_gives_a_counterexample_that_can_be_pasted(capsys):
    def impulse_central(mass_1, mass_2, velocity_1, velocity_2, normal, restitution):
        return restitution * right(mass_1, mass_2, velocity_1, velocity_2, normal, 0.0)

    check(impulse_central)
    out = capsys.readouterr().out
    assert "✗ Not yet" in out and "The factor is e where it must be 1 + e" in re.sub(
        r"\s+", " ", out
    )
    call = out[out.index("impulse_central(\n") : out.index("expected")].strip()
    value = eval(call, {"np": np, "impulse_central": impulse_central})
    got = float(re.search(r"got\s+([-\d.]+) N s", out).group(1))
    assert value == pytest.approx(got, rel=1e-9)


@pytest.mark.parametrize(
    ("body", "words"),
    [
        (lambda *a: None, "returned None"),
        (lambda *a: np.nan, "NaN"),
        (lambda *a: np.inf, "infinity"),
        (
            lambda *a: np.zeros((2, 2, 2)),
            "shape (2, 2, 2) where () (a single number) is expected",
        ),
        (lambda *a: "four", "where numbers are expected"),
        (lambda *a: 1 / 0, "ZeroDivisionError"),
        (lambda *a: [[1.0], [1.0, 2.0]], "ragged"),
        (lambda *a: 1.0, "the same in every case"),
        (lambda *a: exit(), "SystemExit"),
    ],
)
def test_broken_answers_are_told_in_plain_words(capsys, body, words):
    def impulse_central(mass_1, mass_2, velocity_1, velocity_2, normal, restitution):
        return body()

    check(impulse_central)
    text = said(capsys)
    assert "✗ Not yet" in text and words in text


CALLING = """
def free_point_acceleration(acceleration, angular_acceleration, angular_velocity, arm):
    {point}

def contact_bias(p, n, face, body_a, body_b):
    (x_a, v_a, w_a, *a), (x_b, v_b, w_b, *b) = body_a, body_b
    n_dot = np.cross(w_b if face == "face_b" else w_a, n)
    p_dot = v_a + np.cross(w_a, p - x_a) - v_b - np.cross(w_b, p - x_b)
    p_ddot = free_point_acceleration(*a, w_a, p - x_a) - free_point_acceleration(*b, w_b, p - x_b)
    return np.sum(p_ddot * n, axis=-1) + {factor} * np.sum(p_dot * n_dot, axis=-1)
"""
POINT = "return acceleration + np.cross(angular_acceleration, arm) + {} * np.cross(angular_velocity, {})"
TWICE = "np.cross(angular_velocity, arm)"


@pytest.mark.parametrize(
    ("point", "factor", "told"),
    [
        ("...", 2, True),  # the stub: contact_bias stops at NoneType - NoneType
        (POINT.format(1, "arm"), 2, True),
        (POINT.format(1, TWICE), 1, False),  # the slip is contact_bias's own
    ],
)
def test_an_earlier_function_that_is_called_and_not_right_is_named(
    capsys, point, factor, told
):
    cell = {"np": np, "__name__": "__main__"}
    exec(CALLING.format(point=point, factor=factor), cell)
    check(cell["contact_bias"])
    text = said(capsys)
    assert (
        "It calls your free_point_acceleration, which does not pass its own check yet"
        in text
    ) == told
    assert "Right" not in text


def test_an_earlier_function_that_is_only_named_alike_is_not_blamed(capsys):
    """An attribute of the same name is no call of the student's function."""
    cell = {"np": np, "__name__": "__main__"}
    own = "def contact_bias(p, n, face, body_a, body_b):\n    return p.free_point_acceleration\n"
    exec("def free_point_acceleration(a, b, c, d):\n    ...\n" + own, cell)
    check(cell["contact_bias"])
    assert "It calls" not in said(capsys)


def test_writing_into_an_input_is_told(capsys):
    def impulse_central(mass_1, mass_2, velocity_1, velocity_2, normal, restitution):
        velocity_2 -= velocity_1
        return 0.0

    check(impulse_central)
    assert "it wrote into its input (velocity_2)" in said(capsys)


def test_wrong_signature_is_told(capsys):
    check(named(lambda mass, velocity: 0.0))
    assert "yours takes (mass, velocity)" in said(capsys)


def test_if_on_a_batch_is_told(capsys):
    def impulse_central(mass_1, mass_2, velocity_1, velocity_2, normal, restitution):
        value = right(mass_1, mass_2, velocity_1, velocity_2, normal, restitution)
        if value > 0:
            return value
        return 0.0

    check(impulse_central)
    assert "np.where(condition, this, that)" in said(capsys)


def test_a_stub_is_not_attempted_and_no_error(capsys):
    def impulse_central(mass_1, mass_2, velocity_1, velocity_2, normal, restitution):
        """Words."""
        ...

    check(impulse_central)
    assert said(capsys).startswith("○ Not attempted: impulse_central")
    check(..., "p_hat")
    assert said(capsys).startswith("○ Not attempted: p_hat")


def test_functions_that_are_not_ones_own_are_refused(capsys):
    with pytest.raises(ValueError, match="got one of course.dynamics.central_impulses"):
        check(of_the_course)
    used = use(named(right))
    with pytest.raises(ValueError, match="got what use"):
        check(used)


def test_unknown_names_say_the_nearest():
    with pytest.raises(ValueError, match="did you mean 'impulse_central'"):
        check(named(lambda: 0, "impulse_centrl"))
    with pytest.raises(ValueError, match="expected the exercise's name"):
        check(sp.Symbol("e") + 1)


def test_expressions_are_judged_by_their_values(capsys):
    m_1, m_2, v_1, v_2, e = sp.symbols("m_1 m_2 v_1 v_2 e", positive=True)
    check(m_1 * m_2 * (1 + e) * (v_2 - v_1) / (m_1 + m_2), "p_hat")
    assert said(capsys).startswith("✓ Right: p_hat")
    check((1 - e) * (v_2 - v_1) / (1 / m_1 + 1 / m_2), "p_hat")
    assert "as the slide prints it" in said(capsys)
    check([m_1], "p_hat")
    assert "take its entry" in said(capsys)
    check(sp.Eq(m_1, m_2), "p_hat")
    assert "right-hand side" in said(capsys)
    check(m_1 * sp.Symbol("k"), "p_hat")
    assert "yours also contains k" in said(capsys)


def test_use_falls_back_to_the_reference_and_says_so(capsys):
    given = dict(mass_1=2.0, mass_2=1.0, velocity_1=np.array([-3.0, 0, 0]), velocity_2=np.array([1.0, 0, 0]),
                 normal=np.array([1.0, 0, 0]), restitution=0.5)  # fmt: skip
    assert use(named(right))(**given) == pytest.approx(4.0)
    assert "yours" in said(capsys)
    assert use(named(lambda a, b, c, d, n, e: 0.0))(**given) == pytest.approx(4.0)
    assert "the reference for now" in said(capsys)


def test_use_can_be_run_twice_on_what_it_returned(capsys):
    for function, words in (
        (right, "yours"),
        (lambda a, b, c, d, n, e: 0.0, "the reference for now"),
    ):
        once = use(named(function))
        assert use(once) is once
        assert said(capsys).count(words) == 2


def test_a_right_expression_is_ones_own_although_the_reference_was_lent_before(capsys):
    """SymPy keeps the expressions it built: the student's would be the lent one if that were not a copy."""
    symbols = m_1, m_2, v_1, v_2, e = sp.symbols("m_1 m_2 v_1 v_2 e")
    lent = use(..., "p_hat", symbols=symbols)
    own = (1 + e) * (v_2 - v_1) / (1 / m_1 + 1 / m_2)
    check(own, "p_hat")
    assert "✓ Right: p_hat" in said(capsys)
    assert use(own, "p_hat", symbols=symbols) is own and "yours" in said(capsys)
    assert use(lent, "p_hat", symbols=symbols) is lent and "the reference" in said(
        capsys
    )
    with pytest.raises(ValueError, match="got what use"):
        check(lent, "p_hat")
    with pytest.raises(
        ValueError,
        match="symbols: expected those for m_1, m_2, v_1, v_2, e, in this order; got 0",
    ):
        use(..., "p_hat")


def test_hints_go_up_in_three_tiers_then_the_reference(work, capsys):
    seen = []
    for _ in range(4):
        hint(NAME)
        seen.append(said(capsys))
    assert ["Hint 1 of 3" in seen[0], "Hint 2 of 3" in seen[1], "____" in seen[2]] == [
        True
    ] * 3
    assert "def impulse_central" in seen[3] and "def impulse_central" not in "".join(
        seen[:3]
    )
    events = [
        json.loads(line)
        for line in (work / ".course" / "progress.jsonl").read_text().splitlines()
    ]
    assert [e["tier"] for e in events] == [1, 2, 3, 4]


def test_after_the_tiers_a_hint_shows_the_formula_s_own_lines(capsys):
    """The function with its equation and source, or for an expression what it returns."""
    for name, lines in (
        ("effective_mass", ("1/mu = 1/m1", "Source: Baraff", "return 1 / inverse")),
        ("rod_impulse", ("rod_impulse = (1 + e) * v / (1 / m",)),
    ):
        for _ in range(4):
            hint(name)
        shown = said(capsys)
        assert f"The reference: {name}" in shown
        assert all(line in shown for line in lines), shown


def test_a_hint_shows_those_before_it_again(capsys):
    first, second, third = find_exercise(NAME)[1].hints
    for expected in ([first], [first, second], [first, second]):
        hint(NAME)
        text = said(capsys)
        assert all(
            re.sub(r"\s+", " ", with_letters(words)) in text for words in expected
        )
    assert "____" in text
    with pytest.raises(ValueError, match="expected an exercise's name or function"):
        hint(sp.Symbol("e") + 1)


def test_after_a_restart_a_hint_shows_again_what_was_seen(work, capsys, monkeypatch):
    hint(NAME)
    hint(NAME)
    monkeypatch.setattr(sys.modules["course.workbook.recording"], "_session", [])
    said(capsys)
    hint(NAME)
    assert "Hint 2 of 3" in said(capsys)
    hint(NAME)
    assert "Hint 3 of 3" in said(capsys)


def test_a_prediction_that_was_not_made_keeps_its_outcome(capsys):
    predict("blocks")
    asked = said(capsys)
    assert "commit first" in asked and "314" not in asked
    predict("blocks", 2)
    assert "Noted: you said 2" in (noted := said(capsys)) and "314" not in noted
    predict("blocks")
    assert "it is 314" in said(capsys)


def test_progress_is_recorded_only_in_work(work, tmp_path, monkeypatch, capsys):
    check(named(right))
    assert "1/5" in str(progress()).split("10  ")[1].split("\n")[0]
    before = (work / ".course" / "progress.jsonl").read_bytes()
    monkeypatch.chdir(tmp_path)
    check(named(right))
    assert (work / ".course" / "progress.jsonl").read_bytes() == before
    assert sorted(p.name for p in tmp_path.iterdir()) == ["lessons", "work"]


def test_a_cut_off_line_loses_nothing_else(work, capsys):
    check(named(right))
    with (work / ".course" / "progress.jsonl").open("a") as file:
        file.write('{"kind": "check", "na')
    assert "1/5" in str(progress())


def test_what_follows_a_cut_off_line_is_kept(work, monkeypatch, capsys):
    (work / ".course" / "progress.jsonl").write_text('{"kind": "check", "na')
    check(named(right))
    monkeypatch.setattr(progress_module_itself(), "_session", [])
    assert "1/5" in str(progress())


@pytest.mark.parametrize("tier", ('"two"', "null", "[]", "{}"))
def test_a_damaged_file_stops_nothing(work, tier, capsys):
    event = f'{{"kind": "hint", "name": "{NAME}", "tier": {tier}}}'
    lines = [event, "[" * 100_000, "\xff", "3", '{"name": 1, "kind": 2}']
    (work / ".course" / "progress.jsonl").write_text(
        "\n".join(lines), encoding="latin-1"
    )
    check(named(right))
    assert "1/5" in str(progress())


def test_a_folder_that_cannot_be_written_stops_nothing(work, capsys):
    (work / ".course" / "progress.jsonl").mkdir()
    check(named(right))
    assert said(capsys).startswith("✓") and "1/5" in str(progress())


def test_two_kernels_lose_nothing_of_each_other(work):
    """Each appends in one write; neither holds the file."""
    code = "from course.workbook.recording import record\nfor i in range(200): record('check', f'{who}{i}', state='')"
    both = [
        subprocess.Popen([sys.executable, "-c", f"who = {who!r}\n{code}"], cwd=work)
        for who in "ab"
    ]
    assert [p.wait(60) for p in both] == [0, 0]
    names = [
        json.loads(line)["name"]
        for line in (work / ".course" / "progress.jsonl").read_text().splitlines()
    ]
    assert sorted(names) == sorted(f"{who}{i}" for who in "ab" for i in range(200))


def test_wrong_answers_that_match_nothing_are_kept_here(work, capsys):
    check(named(lambda a, b, c, d, n, e: 17.0 + np.sum(c * n, axis=-1)))
    check(named(lambda a, b, c, d, n, e: e * right(a, b, c, d, n, 0.0)))
    kept = [
        json.loads(line)
        for line in (work / ".course" / "unrecognised.jsonl").read_text().splitlines()
    ]
    assert [k["exercise"] for k in kept] == [NAME]
    assert "17.0" in kept[0]["source"]


def test_an_answer_stopped_by_hand_is_told_so_and_stops_the_run(capsys):
    def loops(*arguments):
        raise KeyboardInterrupt

    with pytest.raises(KeyboardInterrupt):
        check(named(loops))
    assert "Stopped by hand" in said(capsys)


def test_predictions_show_the_outcome_only_after_an_answer(capsys):
    predict("parting", ...)
    asked = said(capsys)
    assert "○ Your prediction" in asked and "it is" not in asked
    predict("parting", 2)
    answered = said(capsys)
    assert (
        "Not what you predicted" in answered
        and "-1 m/s" in answered
        and "tempting" in answered
    )
    predict("parting", -1.0)
    assert "✓ As you predicted" in said(capsys)
    predict("parting", np.inf)
    assert "Not what you predicted" in said(capsys)
    for name, answer, expected in (
        ("parting", "fast", "expected a number in m/s; got 'fast'"),
        ("parting", np.nan, "expected a number in m/s; got nan"),
        ("parting", 10**400, "expected a number in m/s"),
        ("cradle", 3, 'expected "stands" or "back" or "on"; got 3'),
        ("cradle", ["stands"], "got ['stands']"),
    ):
        predict(name, answer)
        told = said(capsys)
        assert (
            "○ Not an answer yet" in told and expected in told and "it is" not in told
        )


def test_a_check_leaves_numpys_random_state_alone(capsys):
    np.random.seed(5)
    expected = np.random.random()
    np.random.seed(5)
    check(named(lambda a, b, c, d, n, e: np.random.random()))
    assert np.random.random() == expected


def test_judging_takes_no_printing_from_the_student(capsys):
    def impulse_central(mass_1, mass_2, velocity_1, velocity_2, normal, restitution):
        print("debug " * 1000)
        return right(mass_1, mass_2, velocity_1, velocity_2, normal, restitution)

    assert judge_here(find_exercise(NAME)[1], impulse_central).passed
    assert capsys.readouterr().out == ""


def test_a_notebook_variable_that_an_answer_takes_is_told_before_all_else(capsys):
    made = {"np": np, "j_hat": -3.0}
    exec(
        "def impulse_central(mass_1, mass_2, velocity_1, velocity_2, normal, restitution):\n"
        "    return j_hat * np.ones(np.shape(restitution))\n",
        made,
    )
    check(made["impulse_central"])
    told = said(capsys)
    assert "takes j_hat, a variable" in told and "pulls" not in told


def test_a_lesson_symbol_that_an_answer_takes_is_told(capsys):
    made = {"np": np, "e": sp.Symbol("e")}
    exec(
        "def wall_bounce(velocity, normal, restitution):\n"
        "    along = np.sum(velocity * normal, axis=-1)[..., None]\n"
        "    return np.where(along < 0, velocity - (1 + e) * along * normal, velocity)\n",
        made,
    )
    check(made["wall_bounce"])
    told = said(capsys)
    assert "takes e, a variable" in told and "SymPy" in told


def test_the_last_core_exercise_is_news_once_and_never_a_stretch_one():
    for lesson in all_lessons():
        everything = frozenset(e.name for e in lesson.counted)
        last = "the last exercise of" if lesson.deeper else "the last core exercise"
        for exercise in lesson.exercises:
            before = everything - {exercise.name}
            news = whats_next(lesson, exercise, before, everything | {exercise.name})
            again = whats_next(lesson, exercise, everything, everything)
            assert (last in news) == (exercise in lesson.counted)
            assert last not in again and "have passed" in again


def test_what_is_next_is_the_next_core_exercise():
    lesson = find_lesson("10")
    first, second = lesson.core[:2]
    passed = frozenset({first.name})
    assert second.name in whats_next(lesson, first, frozenset(), passed)
