"""Every lesson begins by importing the workbook: it must cost little more than NumPy."""

import subprocess
import sys

HEAVY = (
    "nbformat",
    "nbclient",
    "sympy",
    "scipy",
    "matplotlib",
    "ipywidgets",
    "jinja2",
    "IPython",
    "jupyterlab",
)


def test_the_workbook_imports_nothing_heavy():
    code = f"import sys, course.workbook; print([m for m in {HEAVY!r} if m in sys.modules])"
    done = subprocess.run(
        [sys.executable, "-c", code], capture_output=True, text=True, check=True
    )
    assert done.stdout.strip() == "[]"
