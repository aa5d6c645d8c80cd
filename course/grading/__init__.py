"""Marking submissions: student code runs in a separate, limited process; verdicts are made here, in the parent.

``child`` and what it imports (``wire``, ``limits``, ``guard``, ``stand_ins``) load inside that process, so nothing
is imported here.
"""
