"""Diagnosis by repair: which one small change of a student's own code makes it right.

``edits`` finds the changes of a source, ``search`` tries them in order: something too many, something taken for
something else, something missing. Nothing here runs a student's code, and nothing knows what a student was told: the
runs are made elsewhere (``course.sandbox.repairing``), and the answers judged with the exercise's own cases.
"""
