"""What a notebook calls: check, hint, predict, use, progress, show, and the plots and
demos.
"""

from course.workbook.checking import check, predict, use
from course.workbook.hints import hint
from course.workbook.numbers import show
from course.workbook.recording import progress

__all__ = ["check", "hint", "predict", "progress", "show", "use"]
