"""Labels of logarithmic axes."""

from __future__ import annotations

import numpy as np
from matplotlib import ticker
from matplotlib.axis import Axis


def label_decades(axis: Axis) -> None:
    """Label the powers of ten of a logarithmic axis, and 2 and 5 where it has only one.

    Left alone, matplotlib labels 2, 3, 4 and 6 of an axis under two decades, one over
    the other. An axis with not even two of 1, 2 and 5 gets a few evenly spaced labels.
    """
    low, high = np.log10(axis.get_view_interval())
    ticks: ticker.Locator = ticker.LogLocator()
    if np.floor(high) - np.ceil(low) < 1:
        marks = np.log10([1, 2, 5]) + np.arange(np.floor(low), high + 1)[:, None]
        several = np.sum((low <= marks) & (marks <= high)) > 1
        ticks = ticker.LogLocator(subs=(1, 2, 5)) if several else ticker.MaxNLocator(3)
    axis.set_major_locator(ticks)
    axis.set_major_formatter(
        ticker.LogFormatterSciNotation(minor_thresholds=(np.inf, np.inf))
    )
    axis.set_minor_formatter(ticker.NullFormatter())
