"""Which of many boxes overlap: the broad phases, each the same question answered another way."""

from course.detection.brute_force import all_pairs
from course.detection.sweeping import CoherentSweep, sweep_and_prune

__all__ = [
    "CoherentSweep",
    "all_pairs",
    "sweep_and_prune",
]
