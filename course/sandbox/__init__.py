"""Where what students wrote is read and run: away from here, within limits, on Linux in a box (bubblewrap).

A submission has one box. In it ``serving`` reads the notebook, then forks once an exercise; the fork (``runner``) runs
the cells and calls the answer. What comes back are arrays and text, and they are data from a stranger. Nothing in the
box knows a reference, a seed or a verdict.

The grader's side: ``running`` (a submission's session), ``box`` (how its process is shut in), ``reply`` (what came
back, checked). Nothing is imported here, because ``child`` and what it imports load inside the box.
"""
