"""A limited process that answers an exercise with mutants of its formula.

Run as a program: one line of JSON comes in (exercise, seeds, sources), one line a
mutant goes out, a digit a seed: 1 where every case of that seed passed.
"""

import dataclasses
import json
import signal
import sys
import time
from collections.abc import Callable, Sequence

from course.exercises.answer import call_all
from course.exercises.definition import Case, Exercise, Mistake, find_exercise
from course.exercises.inputs import answers_of
from course.exercises.verdict import judge
from course.sandbox.limits import Limits, apply_limits

SECONDS = 0.5  # of the processor, for the cases of one seed
UNNAMED = Mistake("unnamed", lambda *given: None, "nobody asks why it fails")
Trial = list[tuple[Exercise, Case]]


class Endless(BaseException):
    """The time of one seed is over."""


def trial_of(exercise: Exercise, seed: int | None) -> Trial:
    """The cases of a seed, each with an exercise that knows its answer already."""
    cases = exercise.draw(seed)
    trial = []
    for case, outcome in zip(
        cases, answers_of(exercise.reference, exercise, cases), strict=True
    ):
        many = len(exercise.results) > 1
        known = outcome.values if many else outcome.values[0]
        changes = {"mistakes": exercise.mistakes[:1]}  # of an expression, one as well
        if exercise.kind == "function":
            changes = {"mistakes": (UNNAMED,), "reference": lambda *g, k=known: k}
        trial.append((dataclasses.replace(exercise, **changes), case))
    return trial


def passes(function: Callable, trial: Trial) -> bool:
    """Whether the cases cannot tell a function from the formula; ends at the first that can."""
    if trial[0][0].kind == "expression":
        exercise, cases = trial[0][0], [case for _, case in trial]
        return judge(exercise, cases, answers_of(function, exercise, cases)).passed
    return all(
        judge(e, [c], call_all(function, [c.arguments], len(e.results))).passed
        for e, c in trial
    )


def passes_in_time(function: Callable, trial: Trial, seconds: float) -> bool:
    """The same; without end or with an error of its own, it is told apart."""
    if hasattr(signal, "setitimer"):
        signal.setitimer(signal.ITIMER_VIRTUAL, seconds)
    try:
        return passes(function, trial)
    except BaseException:  # an expression is made before it is called, and may not be
        return False
    finally:
        if hasattr(signal, "setitimer"):
            signal.setitimer(signal.ITIMER_VIRTUAL, 0)


def answer(exercise: Exercise, seeds: Sequence[int | None], sources: Sequence[str]):
    """A line for each of the sources."""
    names = vars(sys.modules[exercise.reference.__module__])
    trials = [trial_of(exercise, seed) for seed in seeds]
    started = time.process_time()
    assert all(passes(exercise.reference, trial) for trial in trials)
    taken = (time.process_time() - started) / len(trials)
    seconds = max(SECONDS, 20 * taken)
    for source in sources:
        made: dict = {}
        exec(compile(source, "<mutant>", "exec"), dict(names), made)
        (function,) = made.values()
        yield "".join(str(int(passes_in_time(function, t, seconds))) for t in trials)


def main() -> None:
    """Limits first, then the work that stands on the standard input."""
    given = json.loads(sys.stdin.readline())
    exercise = find_exercise(given["exercise"])[1]
    apply_limits(Limits(seconds=3600, memory_mb=2000))
    if hasattr(signal, "setitimer"):
        signal.signal(signal.SIGVTALRM, _end)
    out = sys.stdout
    for line in answer(exercise, given["seeds"], given["sources"]):
        out.write(line + "\n")
        out.flush()


def _end(*_) -> None:
    raise Endless


if __name__ == "__main__":
    main()
