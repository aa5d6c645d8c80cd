"""What an exercise is: arguments, reference, inputs, planted mistakes, hints, as data.

A definitions module, ``course/exercises/definitions/lesson_NN_name.py``, makes one
``LESSON``, and where a second notebook goes deeper, ``MORE``. Everything that needs to
know an exercise (the check, the grader, the syllabus, the tests) reads it from there.
"""

from __future__ import annotations

import difflib
import importlib
import pkgutil
import zlib
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, field
from functools import cache
from types import MappingProxyType
from typing import Any, Literal

import numpy as np

CaseKind = Literal["single", "batch", "edge"]

#: How the number, and the file's name, of a notebook that goes deeper ends.
DEEPER = "-more"


@dataclass(frozen=True)
class Value:
    """A declared argument or result: name, shape, type, unit and, for a result,
    tolerance.

    ``shape`` is the shape in words, ``"(..., 3)"`` or ``"scalar"``; ``dtype`` one of
    float, int, bool, str. A float result passes where ``|got - expected| <= absolute +
    relative * scale``, ``scale`` being the largest magnitude in the expected element
    (so that a zero component of a long vector is not judged by itself).
    """

    name: str
    shape: str
    unit: str = ""
    meaning: str = ""
    dtype: Literal["float", "int", "bool", "str"] = "float"
    relative: float = 1e-9
    absolute: float = 1e-12

    @property
    def own_axes(self) -> int:
        """How many last axes make one element.

        None for ``(...)``, one for ``(..., 3)``, two for ``(..., 3, 3)`` and ``(n,
        3)``.
        """
        if not self.shape.startswith("("):
            return 0
        return sum(
            bool(part.strip()) and part.strip() != "..."
            for part in self.shape.strip("()").split(",")
        )


@dataclass(frozen=True)
class Case:
    """One call of the student's function: a label, the arguments by name, its kind of
    case.
    """

    label: str
    arguments: Mapping[str, Any]
    kind: CaseKind = "single"

    def __post_init__(self) -> None:
        object.__setattr__(
            self,
            "arguments",
            MappingProxyType({k: _frozen(v) for k, v in self.arguments.items()}),
        )


@dataclass(frozen=True)
class Mistake:
    """A wrong version that a student is likely to write, and what to say about it."""

    name: str
    function: Callable[..., Any]
    message: str


@dataclass(frozen=True)
class Property:
    """Something true of every right answer.

    ``residual(arguments, answer)`` returns numbers that are zero for a right answer;
    ``tolerance`` bounds their magnitude; ``message`` says in words what is violated.
    """

    name: str
    residual: Callable[[Mapping[str, Any], Any], Any]
    message: str
    tolerance: float = 1e-9


@dataclass(frozen=True)
class Exercise:
    """An exercise: a function of arrays that the student writes, or an expression in
    SymPy.

    ``reference`` is the function of ``course.formulas`` that bears the exercise's name.
    For ``kind="expression"`` the arguments are the expression's symbols, ``reference``
    makes the expression from them, and both are evaluated at the cases' values.
    ``judged_by="properties"`` is for answers that are not unique: then ``sample`` gives
    an array of the right shape, and the judge never runs the reference.
    """

    name: str
    rows: tuple[int, ...]
    points: int
    minutes: int
    task: str
    arguments: tuple[Value, ...]
    results: tuple[Value, ...]
    reference: Callable[..., Any]
    cases: Callable[[np.random.Generator], Sequence[Case]]
    mistakes: tuple[Mistake, ...]
    hints: tuple[str, str, str]
    level: Literal["core", "stretch"] = "core"
    kind: Literal["function", "expression"] = "function"
    judged_by: Literal["reference", "properties"] = "reference"
    properties: tuple[Property, ...] = ()
    sample: Callable[..., Any] | None = None

    def __post_init__(self) -> None:
        if not self.mistakes:
            raise ValueError(
                f"mistakes: expected at least one planted mistake in {self.name}; got none"
            )
        if len(self.hints) != 3:
            raise ValueError(
                f"hints: expected three tiers in {self.name}; got {len(self.hints)}"
            )
        if self.judged_by == "properties" and not self.properties:
            raise ValueError(
                f"properties: expected at least one in {self.name}, which is judged by them; got none"
            )
        if (self.sample is not None) != (self.judged_by == "properties"):
            raise ValueError(
                f"sample: expected one in an exercise judged by properties, and in no other; {self.name} "
                f"is judged by {self.judged_by}"
            )

    @property
    def signature(self) -> str:
        """The call as a student writes it."""
        return f"{self.name}({', '.join(a.name for a in self.arguments)})"

    def draw(self, seed: int | None = None) -> tuple[Case, ...]:
        """The cases for a seed.

        Without one, for the seed every notebook's check uses.
        """
        if seed is None:
            seed = zlib.crc32(self.name.encode())
        return tuple(self.cases(np.random.default_rng(seed)))


@dataclass(frozen=True)
class Prediction:
    """A question the student answers before the experiment that decides it.

    ``outcome()`` computes the truth with the reference code. With ``choices`` (key ->
    text) the answer is a key, and ``outcome`` returns one; otherwise it is a number in
    ``unit``, right within the relative ``tolerance``. ``wrong`` maps a frequent wrong
    answer to the reason why it is tempting. ``later`` says where the lesson answers it:
    until then the answer is only recorded, and ``predict(name)`` shows the outcome
    there.
    """

    name: str
    question: str
    outcome: Callable[[], Any]
    explanation: str
    choices: Mapping[str, str] = field(default_factory=dict)
    unit: str = ""
    tolerance: float = 0.05
    wrong: Mapping[Any, str] = field(default_factory=dict)
    later: str = ""


@dataclass(frozen=True)
class Lesson:
    """A notebook of the course: its number, name, question, minutes, exercises and
    predictions.

    The number of the notebook that goes deeper into lesson 05 is "05-more", its name
    that of the lesson. All of its exercises are stretch ones.
    """

    number: str
    name: str
    title: str
    question: str
    minutes: int
    exercises: tuple[Exercise, ...]
    predictions: tuple[Prediction, ...] = ()

    @property
    def file_name(self) -> str:
        """The notebook's file name in lessons/ and solutions/."""
        return f"{self.stem}.ipynb"

    @property
    def stem(self) -> str:
        """That name without its ending."""
        return f"{self.number[:2]}-{self.name}{DEEPER if self.deeper else ''}"

    @property
    def deeper(self) -> bool:
        """Whether it is the notebook that goes deeper, which no other one needs."""
        return self.number.endswith(DEEPER)

    @property
    def core(self) -> tuple[Exercise, ...]:
        """The exercises that the course's progress counts."""
        return tuple(e for e in self.exercises if e.level == "core")

    @property
    def counted(self) -> tuple[Exercise, ...]:
        """The exercises that the notebook's own bar counts: core ones, or where it goes
        deeper all.
        """
        return self.exercises if self.deeper else self.core


@cache
def all_lessons() -> tuple[Lesson, ...]:
    """Every notebook that a definitions module describes, in order."""
    from course.exercises import definitions

    names = sorted(
        m.name
        for m in pkgutil.iter_modules(definitions.__path__)
        if m.name.startswith("lesson_")
    )
    modules = [importlib.import_module(f"{definitions.__name__}.{n}") for n in names]
    lessons = tuple(
        lesson
        for module in modules
        for lesson in (module.LESSON, getattr(module, "MORE", None))
        if lesson is not None
    )
    _require_unique(
        [e.name for lesson in lessons for e in lesson.exercises], "exercise"
    )
    _require_unique(
        [p.name for lesson in lessons for p in lesson.predictions], "prediction"
    )
    return lessons


def find_lesson(number: str) -> Lesson:
    """The lesson with this number, "10"."""
    for lesson in all_lessons():
        if lesson.number == number:
            return lesson
    raise _unknown("lesson", number, [lesson.number for lesson in all_lessons()])


def find_exercise(name: str) -> tuple[Lesson, Exercise]:
    """The exercise of this name and its lesson.

    A ``ValueError`` names the nearest one.
    """
    for lesson in all_lessons():
        for exercise in lesson.exercises:
            if exercise.name == name:
                return lesson, exercise
    raise _unknown(
        "exercise", name, [e.name for lesson in all_lessons() for e in lesson.exercises]
    )


def find_prediction(name: str) -> tuple[Lesson, Prediction]:
    """The prediction of this name and its lesson."""
    for lesson in all_lessons():
        for prediction in lesson.predictions:
            if prediction.name == name:
                return lesson, prediction
    raise _unknown(
        "prediction",
        name,
        [p.name for lesson in all_lessons() for p in lesson.predictions],
    )


def _unknown(what: str, name: str, known: Sequence[str]) -> ValueError:
    near = difflib.get_close_matches(str(name), known, n=1, cutoff=0.5)
    advice = (
        f"; did you mean {near[0]!r}?"
        if near
        else f"; known: {', '.join(known) or 'none yet'}"
    )
    return ValueError(
        f"name: expected the name of {'an' if what[0] in 'ae' else 'a'} {what}; got {name!r}{advice}"
    )


def _require_unique(names: Sequence[str], what: str) -> None:
    repeated = sorted({name for name in names if names.count(name) > 1})
    if repeated:
        raise ValueError(
            f"{what} names must be unique over all lessons; repeated: {', '.join(repeated)}"
        )


def _frozen(value: Any) -> Any:
    """Arrays and lists as read-only arrays, so that using a case cannot change it."""
    if isinstance(value, tuple):
        return tuple(_frozen(part) for part in value)
    if isinstance(value, (list, np.ndarray)):
        array = np.array(value)
        array.flags.writeable = False
        return array
    return value
