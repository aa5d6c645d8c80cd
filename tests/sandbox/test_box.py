"""How a box is built: which folders are seen in it."""

from course.sandbox import box


def test_an_interpreter_below_tmp_leaves_that_folder_as_it_is(monkeypatch):
    """A link could not be made in its place, and there would be no box at all."""
    monkeypatch.setattr(box, "_readable", lambda: ("/usr", "/tmp/clone/.venv"))
    walls = box._walls(1)
    assert "/tmp" not in walls and "/tmp/clone/.venv" in walls
    monkeypatch.setattr(box, "_readable", lambda: ("/usr",))
    assert "/tmp" in box._walls(1)
