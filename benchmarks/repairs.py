"""How many wrong answers are told their cause, by planted mistakes, by repair and by facts; how long a repair takes.

Reads batches of wrong answers, modules with a list ``WRONG`` of dicts (exercise, id, cause, code), from the folder in
the environment variable WRONG_ANSWERS; none are kept here, so that nothing can be fitted to them.

    WRONG_ANSWERS=folder python -m benchmarks.repairs [batch ...]
"""

from __future__ import annotations

import importlib
import linecache
import os
import sys
import time
import warnings
from collections.abc import Mapping
from pathlib import Path
from typing import Any

import numpy as np

from course.exercises.answer import as_function, call_all
from course.exercises.definition import find_exercise
from course.exercises.inputs import inputs_of
from course.exercises.repair.recipe import Recipe, expression_recipe
from course.exercises.verdict import judge
from course.sandbox.repairing import repair_of
from course.workbook.facts import facts_told

PRELUDE = (
    "import numpy as np\nimport scipy\nimport scipy.linalg\n"
    "from scipy.spatial.transform import Rotation\n"
)
SYMBOLIC = "import sympy as sp\nimport sympy\n"
PROGRAMMES = "import cvxpy as cp\n"


def main(names: list[str]) -> None:
    """Print one line for each answer that no planted mistake names, then the totals of each batch."""
    warnings.simplefilter("ignore")
    folder = Path(os.environ["WRONG_ANSWERS"])
    sys.path.insert(0, str(folder))
    for name in names or sorted(p.stem for p in folder.glob("batch_*.py")):
        planted = repaired = facts = count = 0
        times = []
        for wrong in importlib.import_module(name).WRONG:
            count += 1
            told, seconds = _told(wrong)
            if told == "planted":
                planted += 1
                continue
            facts += told.startswith("(")
            repaired += told[0] not in "-("
            times.append(seconds)
            print(
                f"{wrong['id']:32} {seconds:5.2f} s | {wrong['cause'][:90]} | {told}",
                flush=True,
            )
        quartiles = np.percentile(times, [50, 95]) if times else [0, 0]
        print(
            f"{name}: {count} answers, {planted} by planted mistakes, {repaired} by repair, {facts} by facts, "
            f"{(planted + repaired + facts) / count:.0%} named; "
            f"median {quartiles[0]:.2f} s, 95 % under {quartiles[1]:.2f} s"
        )


def _told(wrong: Mapping[str, Any]) -> tuple[str, float]:
    _, exercise = find_exercise(wrong["exercise"])
    cases = exercise.draw()
    prelude = PRELUDE + (PROGRAMMES if "cp." in wrong["code"] else "")
    space: dict[str, Any] = {}
    exec(prelude + SYMBOLIC, space)
    file, code = f"<ipython-input-{wrong['id']}>", wrong["code"]
    linecache.cache[file] = (len(code), None, code.splitlines(keepends=True), file)
    exec(compile(code, file, "exec"), space)
    arguments = [a.name for a in exercise.arguments]
    function = as_function(
        space[exercise.name], exercise.kind, exercise.name, arguments
    )
    outcomes = call_all(function, [c.arguments for c in cases], len(exercise.results))
    verdict = judge(exercise, cases, outcomes)
    if verdict.mistake:
        return "planted", 0.0
    if not verdict.unexplained:
        return "(told by its outcome)", 0.0
    recipe: Recipe | None = Recipe(wrong["code"], prelude)
    if exercise.kind == "expression":
        recipe = expression_recipe(wrong["code"], exercise.name, arguments)
    if recipe is None:
        return "-", 0.0
    began = time.perf_counter()
    repair = repair_of(inputs_of(exercise), recipe, verdict.outcomes)
    seconds = time.perf_counter() - began
    if repair is None:
        words = [r for r in verdict.reason if "answer each element" in r]
        if words or any(o.kind == "wrote" for o in verdict.outcomes):
            return "(told by its outcome)", seconds
        told = [
            fact
            for some in facts_told(exercise, space[exercise.name], verdict)
            for fact in some
        ]
        return f"({' '.join(told)})" if told else "-", seconds
    steps = "; then ".join(
        f"{s.kind}: {s.old[:80]} -> {s.new[:90]}" for s in repair.steps
    )
    return steps + (" (or elsewhere)" if repair.elsewhere else ""), seconds


if __name__ == "__main__":
    main(sys.argv[1:])
