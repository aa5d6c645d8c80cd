"""Mark submissions: rows, table, feedback pages. Student code runs in
``course.sandbox``.

Verdicts are made here, in the grader's process.
"""
