"""An answer in a film: its pane beside the right one, or a sentence on why it moves nothing."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, replace
from typing import Any, TypeVar

import numpy as np

from course.arrays import failure
from course.study.asking import UnusableResult
from course.workbook.lending import MARK
from course.workbook.stage import Pane

Motion = TypeVar("Motion")


@dataclass(frozen=True)
class Stopped:
    """An answer that made no motion.

    Args:
        why: the rest of a sentence that begins with whose it is.
    """

    why: str


class Attempt:
    """Asks an answer for its motion, again for each film; not any more once it was interrupted.

    Args:
        title: above its pane, "your function", or of one that ``use`` lends whose it is.
        short: the same in one word, for the curves beside it.
        whose: the same within a sentence; without it the title.
    """

    def __init__(
        self, title: str, short: str = "yours", whose: str | None = None
    ) -> None:
        self.title = title
        self.short = short
        self.whose = whose or title
        self._interrupted: Stopped | None = None

    @property
    def names(self) -> tuple[str, str]:
        """Of the right one's curve and the answer's."""
        return "right", self.short

    def motion(self, make: Callable[[], Motion]) -> Motion | Stopped:
        """What ``make`` gives; whatever it raises is told, an interrupt as well."""
        if self._interrupted is not None:
            return self._interrupted
        try:
            return make()
        except UnusableResult as error:
            said = str(error)
            short = said.removeprefix("it ")
            return Stopped(short if short != said else f"moves nothing here: {said}")
        except KeyboardInterrupt:
            self._interrupted = Stopped("was interrupted before it was done")
            return self._interrupted
        except (Exception, SystemExit) as error:
            said = " ".join(str(error).split())[:120]
            return Stopped(f"raised {type(error).__name__}{': ' * bool(said)}{said}")

    def sentence(self, stopped: Stopped) -> str:
        """The answer and what became of it."""
        return f"{self.whose} {stopped.why}"

    def panes(
        self, title: str, pane: Callable[[str, Any], Pane], right: Any, other: Any
    ) -> list[Pane]:
        """The right one's pane and the answer's, or its bodies as they stood at the start."""
        shown = pane(title, right)
        if not isinstance(other, Stopped):
            return [shown, pane(self.title, other)]
        return [shown, standing_still(shown, self.sentence(other))]


def asked_of(
    against: Any, printed: Callable[..., Any] | None = None, words: str = "as the slide prints it"
) -> tuple[Any, Attempt]:  # fmt: skip
    """The function that plays beside the right one, and its attempt.

    Args:
        against: a function, "printed", or None: nothing plays beside it.
        printed: the formula of the slide; None: it is right there, or is no motion.
        words: above the printed one's pane.
    Raises:
        ValueError: "printed" where there is none, and what is no function.
    """
    if isinstance(against, str) and against == "printed" and printed is not None:
        return printed, Attempt(words, "printed", "the printed formula")
    if against is not None and not callable(against):
        also = ', or "printed"' if printed is not None else ""
        raise failure("against", f"a function{also}", repr(against))
    lent = getattr(against, MARK, "yours") != "yours"
    if lent:
        return against, Attempt(
            "the workbook's, lent", "lent", "the workbook's function"
        )
    return against, Attempt("your function")


def standing_still(pane: Pane, title: str) -> Pane:
    """A pane whose bodies stay where they begin, without arrows."""
    place = np.asarray(pane.position)
    turn = pane.orientation
    if turn is not None:
        turn = np.asarray(turn)
        turn = turn if turn.ndim == 2 else turn[0]
    start = place if place.ndim == 2 else place[0]
    return replace(
        pane, position=start, orientation=turn, title=title,
        arrows=(), segments=(), trails=(),
    )  # fmt: skip


def moved(*motions: Any) -> list[Any]:
    """Those that are motions."""
    return [m for m in motions if not isinstance(m, Stopped)]
