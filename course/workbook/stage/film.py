"""What the stage plays: bodies with their poses over time, arrows, gaps and curves,
checked, and described in words.

A film is plain data. Whoever makes one has computed everything that is to be seen; the
stage interpolates between its moments, in the browser, and draws. Where something jumps,
a velocity at an impact, the same time stands twice: before and after.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field

import numpy as np

from course.arrays import (
    Array,
    ArrayLike,
    failure,
    read_only,
    scalar,
    scalars,
    written,
)
from course.workbook.stage.beside import Curves, Number, Path, require_length
from course.workbook.stage.panes import Pane, bounding_points, over_time, pane_over
from course.workbook.stage.views import Flat, Space


@dataclass(frozen=True, eq=False)
class Film:
    """Everything that is played together; ``stage.show`` plays it.

    Args:
        panes: at least one; all have the film's times.
        times: (t,) [s], not descending; a time that stands twice is a jump.
        view: ``Flat()`` or ``Space()``, for all panes.
        title: one line.
        caption: a sentence on what there is to see: what moves.
        ending: a sentence on how it ends.
        charts: ``Curves`` and ``Path``, beside the panes.
        counters: (t,) numbers by name that count something, "collisions".
        numbers: the key numbers.
        events: times to which single steps go besides the film's moments [s]; the jumps
            are among them anyway.
        speed: seconds of motion in a second of playing.
    Raises:
        ValueError: what does not fit together, named.
    """

    panes: Sequence[Pane]
    times: ArrayLike
    view: Flat | Space = field(default_factory=Flat)
    title: str = ""
    caption: str = ""
    ending: str = ""
    charts: Sequence[Curves | Path] = ()
    counters: Mapping[str, ArrayLike] = field(default_factory=dict)
    numbers: Sequence[Number] = ()
    events: Sequence[float] = ()
    speed: float = 1.0

    def __post_init__(self) -> None:
        times = scalars("times", self.times)
        if times.ndim != 1 or not times.size or np.any(np.diff(times) < 0):
            raise failure(
                "times", "numbers of shape (t,) that do not descend", written(times)
            )
        if not self.panes:
            raise failure("panes", "at least one", "none")
        if not scalar("speed", self.speed) > 0:
            raise failure("speed", "a number above 0", written(self.speed))
        object.__setattr__(self, "times", read_only(times))
        object.__setattr__(
            self, "panes", tuple(pane_over(p, times) for p in self.panes)
        )
        for chart in self.charts:
            require_length(chart, len(times))
        for name, values in self.counters.items():
            over_time(f"counters {name}", scalars(name, values), (), times)
        for number in self.numbers:
            if len(number.values) not in (1, len(self.panes)):
                raise failure(
                    f"numbers {number.name}",
                    f"one value, or {len(self.panes)}",
                    f"{len(number.values)}",
                )

    @property
    def moves(self) -> bool:
        """Whether there is more than one moment."""
        times = np.asarray(self.times)
        return bool(times[-1] > times[0])

    @property
    def bounds(self) -> tuple[Array, Array]:
        """The lowest and highest corner of all that is ever seen, (3,) each [m]."""
        if isinstance(self.view, Space) and self.view.window is not None:
            low, high = np.asarray(self.view.window, dtype=float)
            return low, high
        flat = np.concatenate([bounding_points(pane) for pane in self.panes])
        return flat.min(axis=0), flat.max(axis=0)

    @property
    def middle(self) -> Array:
        """The middle of all that is ever seen, (3,) [m]: positions travel from here."""
        low, high = self.bounds
        return np.asarray(0.5 * (low + high))

    def index_at(self, time: float) -> int:
        """The last moment that is not after a time [s]."""
        after = np.searchsorted(
            np.asarray(self.times), scalar("time", time), side="right"
        )
        return max(0, int(after) - 1)
