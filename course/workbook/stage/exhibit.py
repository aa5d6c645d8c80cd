"""A film that answers: knobs, hands and presets, and the function that makes the film of
their values.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, field
from typing import Any

from course.arrays import failure, scalar, written
from course.workbook.stage.encoding import encoded
from course.workbook.stage.film import Film


@dataclass(frozen=True)
class Knob:
    """A number on a slider.

    Args:
        name: the film's argument.
        label: beside the slider, "mass 1".
        value, low, high: at the start, and the ends.
        step: between values; none: a hundredth of the range.
        unit: of the value.
        logarithmic: whether the slider runs over powers of ten.
    """

    name: str
    label: str
    value: float
    low: float
    high: float
    step: float | None = None
    unit: str = ""
    logarithmic: bool = False

    def __post_init__(self) -> None:
        for name in ("value", "low", "high"):
            scalar(f"knob {self.name}, {name}", getattr(self, name))
        if not self.low <= self.value <= self.high or self.low >= self.high:
            raise failure(
                f"knob {self.name}",
                "low <= value <= high, low < high",
                f"{written(self.low)}, {written(self.value)}, {written(self.high)}",
            )
        if self.logarithmic and not self.low > 0:
            raise failure(f"knob {self.name}, low", "above 0", written(self.low))


@dataclass(frozen=True)
class Hand:
    """Something in the picture that can be taken hold of and moves knobs.

    Args:
        knobs: the world's direction in which a knob grows, by the knob's name, (3,).
        body: the number of the body that is held; or
        arrows, index: the name of the arrows, and which of them is held at its tip.
        until: the last time of the film at which it can be held [s]; none: at any.
    """

    knobs: Mapping[str, Sequence[float]]
    body: int | None = None
    arrows: str = ""
    index: int = 0
    until: float | None = None


@dataclass(frozen=True)
class Preset:
    """Values under one button."""

    label: str
    values: Mapping[str, float]


@dataclass(frozen=True)
class Exhibit:
    """A question that moves.

    Args:
        film: makes the film of the knobs' values, by keyword.
        knobs, hands, presets: what can be changed, and how.
        question: to vote on; the answer is shown when it is asked for.
        answer: one or two sentences.
        height: the most a picture may be high [pixels].
    """

    film: Callable[..., Film]
    knobs: Sequence[Knob] = ()
    hands: Sequence[Hand] = ()
    presets: Sequence[Preset] = ()
    question: str = ""
    answer: str = ""
    height: int = 440
    values: Mapping[str, float] = field(init=False)

    def __post_init__(self) -> None:
        values = {knob.name: knob.value for knob in self.knobs}
        object.__setattr__(self, "values", values)
        for what, used in (
            *(("hands", hand.knobs) for hand in self.hands),
            *(("presets", preset.values) for preset in self.presets),
        ):
            if unknown := set(used) - set(values):
                raise failure(
                    what,
                    f"names of knobs: {', '.join(values)}",
                    ", ".join(sorted(unknown)),
                )

    def made(self, **values: float) -> Film:
        """The film of some values; the others stand where the knobs began."""
        return self.film(**{**self.values, **values})


def exhibit_json(
    exhibit: Exhibit, *, large: bool = False, films: bool = False
) -> dict[str, Any]:
    """The exhibit for the browser.

    Args:
        large: for a lecture room.
        films: whether each preset's film is in it, for a page that cannot ask.
    """
    return {
        "film": encoded(exhibit.made()),
        "knobs": [_knob(knob) for knob in exhibit.knobs],
        "hands": [
            {
                "knobs": [
                    {"knob": name, "direction": [float(v) for v in direction]}
                    for name, direction in hand.knobs.items()
                ],
                "body": hand.body,
                "arrows": hand.arrows,
                "index": hand.index,
                "until": hand.until,
            }
            for hand in exhibit.hands
        ],
        "presets": [
            {"label": preset.label, "values": dict(preset.values)}
            | ({"film": encoded(exhibit.made(**preset.values))} if films else {})
            for preset in exhibit.presets
        ],
        "question": exhibit.question,
        "answer": exhibit.answer,
        "height": None if large else exhibit.height,
        "large": large,
    }


def _knob(knob: Knob) -> dict[str, Any]:
    return {
        "name": knob.name,
        "label": knob.label,
        "unit": knob.unit,
        "value": knob.value,
        "low": knob.low,
        "high": knob.high,
        "step": knob.step or (knob.high - knob.low) / 100,
        "log": knob.logarithmic,
    }


def as_exhibit(shown: Film | Exhibit) -> Exhibit:
    """A film alone as an exhibit without knobs."""
    return shown if isinstance(shown, Exhibit) else Exhibit(lambda: shown)
