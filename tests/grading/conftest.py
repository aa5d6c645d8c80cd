"""For the tests of grading: a folder with a few small submissions."""

import pytest
from grading.toy_lessons import OTHER, blank, notebook, write


@pytest.fixture
def folder(tmp_path):
    """Four submissions that need no process and one that does."""
    for name in ("ann", "ben", "dan", "eve"):
        write(tmp_path / "in" / f"{name}.ipynb", blank())
    write(tmp_path / "in" / "cal.ipynb", notebook(OTHER))
    return tmp_path / "in"
