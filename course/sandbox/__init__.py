"""Read and run what students wrote, in a limited process, on Linux in a bubblewrap box.

A submission gets one box. In it, ``serving`` reads the notebook and forks once per
exercise; the fork (``runner``) runs the cells and calls the answer. What comes back is
arrays and text from an untrusted process. Nothing in the box knows a reference, a seed
or a verdict.

The grader's side: ``running`` (a submission's session), ``box`` (how its process is
isolated), ``reply`` (checks what comes back). Nothing is imported here, because
``child`` and its imports load inside the box.
"""
