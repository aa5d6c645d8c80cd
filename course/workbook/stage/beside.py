"""What stands beside a film's panes: curves, paths, and its key numbers."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field

import numpy as np

from course.arrays import (
    ArrayLike,
    failure,
    written,
)


@dataclass(frozen=True, eq=False)
class Curves:
    """A chart beside the film: curves over time, through which the cursor runs.

    Args:
        title: what is drawn, "kinetic energy".
        unit: of all curves.
        curves: (t,) numbers by name; NaN where there is none.
        stacked: whether the curves are drawn as areas on top of each other.
        limits: lowest and highest value shown; none: from the curves.
        colors: names of the palette, one a curve; none: the bodies' order of colours.
        logarithmic: whether equal steps upward are equal factors; what is not above 0
            is left out.
    """

    title: str
    unit: str
    curves: Mapping[str, ArrayLike]
    stacked: bool = False
    limits: tuple[float, float] | None = None
    colors: Sequence[str] = ()
    logarithmic: bool = False

    def __post_init__(self) -> None:
        if not self.logarithmic:
            return
        if self.stacked:
            raise failure(f"charts {self.title}", "stacked or logarithmic", "both")
        if self.limits is not None and not 0 < self.limits[0] < self.limits[1]:
            raise failure(
                f"charts {self.title}, limits",
                "0 < lowest < highest",
                written(np.array(self.limits)),
            )


@dataclass(frozen=True, eq=False)
class Path:
    """A chart of one number against another as time goes: a circle of equal energy.

    Args:
        title: what is drawn.
        across, up: names of the two axes, unit included, "v1 [m/s]".
        x, y: (t,) numbers.
        guides: other lines in the same plane by name, each (k, 2): the circle itself.
        equal: whether both axes have the same scale.
        limits: left, bottom, right, top of the axes; none: all that ever shows.
        answers: whether it answers the exhibit's question at once: it then waits until
            the film has been played, or the answer is shown.
    """

    title: str
    across: str
    up: str
    x: ArrayLike
    y: ArrayLike
    guides: Mapping[str, ArrayLike] = field(default_factory=dict)
    equal: bool = True
    limits: tuple[float, float, float, float] | None = None
    answers: bool = False


@dataclass(frozen=True)
class Number:
    """A key number of the film, one value a pane, for the table and the text alternative.

    Args:
        name: "impulse p̂".
        values: one for each pane, or one for all.
        unit: "N s".
        digits: significant ones that are shown.
    """

    name: str
    values: tuple[float, ...]
    unit: str = ""
    digits: int = 3


def require_length(chart: Curves | Path, count: int) -> None:
    """Refuse a chart whose numbers are not one for each of the film's moments."""
    numbers = (
        {"x": chart.x, "y": chart.y} if isinstance(chart, Path) else dict(chart.curves)
    )
    for name, values in numbers.items():
        shape = np.asarray(values, dtype=float).shape
        if shape != (count,):
            raise failure(
                f"charts {chart.title}, {name}", f"shape ({count},)", f"shape {shape}"
            )
