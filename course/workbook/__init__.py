"""What a notebook calls: check, hint, predict, use, watch, progress, show, tabulate, and the
plots and demos.
"""

from course.workbook.checking import check
from course.workbook.hints import hint
from course.workbook.lending import use
from course.workbook.numbers import show
from course.workbook.predicting import predict
from course.workbook.recording import progress
from course.workbook.tables import tabulate
from course.workbook.watching import watch

__all__ = ["check", "hint", "predict", "progress", "show", "tabulate", "use", "watch"]
