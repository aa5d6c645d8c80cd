"""What makes ``solve(method="auto")`` fast and sure, from the methods of ``solvers`` up.

It imports ``course.contact.solvers``, which imports nothing from here.
"""
