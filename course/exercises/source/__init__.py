"""Read what students wrote, without running it.

Is a cell blank, what does it define, which cells does it need? This is the one place where a student's source is
parsed: ``parsing`` makes the tree, ``cells`` takes IPython's own lines away, ``statements`` looks at what is defined or
left blank, ``names`` at what is bound and used. The source may be anything: if it does not parse, for whatever reason,
it is "not Python" and never an error here.
"""

from course.exercises.source.cells import cell_tree, python_only, syntax_error
from course.exercises.source.names import (
    DYNAMIC,
    Facts,
    closure,
    defined_names,
    definitions_only,
    facts_of,
    mentions,
    modules_used,
    names_of,
    needed_cells,
)
from course.exercises.source.parsing import MAXIMUM_CELL, tree_of
from course.exercises.source.statements import is_blank, is_left_blank

__all__ = [
    "DYNAMIC",
    "MAXIMUM_CELL",
    "Facts",
    "cell_tree",
    "closure",
    "defined_names",
    "definitions_only",
    "facts_of",
    "is_blank",
    "is_left_blank",
    "mentions",
    "modules_used",
    "names_of",
    "needed_cells",
    "python_only",
    "syntax_error",
    "tree_of",
]
