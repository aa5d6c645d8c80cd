"""The widget for lesson 09: a handle that tumbles with no torque on it."""

from __future__ import annotations

from typing import Any

from course.workbook import stage
from course.workbook.films.tumbling import handle


def tumbling() -> Any:
    """A handle that spins about one of its axes, a little tilted: which spins last, and
    where the energy goes.
    """
    return stage.show(handle(), still=1.56)
