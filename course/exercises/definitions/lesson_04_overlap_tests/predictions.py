"""The predictions of this lesson, and how each is computed."""

from __future__ import annotations

PREDICTIONS = ()
DEEPER_PREDICTIONS = ()
