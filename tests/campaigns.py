"""How long the random campaigns are: a part of them every time, whole with COURSE_CAMPAIGNS=whole.

The whole ones take the better part of an hour; run them after a change of what they try.
"""

import os

WHOLE = os.environ.get("COURSE_CAMPAIGNS") == "whole"


def drawn_of(whole: int, everyday: int) -> int:
    """How many are drawn."""
    return whole if WHOLE else everyday
