"""Make lessons/ from solutions/: answers become ``...``, outputs are removed.

``solutions/NN-name.ipynb`` is the one source. What stands between ``# BEGIN SOLUTION``
and ``# END SOLUTION`` in a code cell becomes a single ``...`` at the marker's
indentation. Links to the lessons around it are added at its beginning and end, and a
page of all lessons beside them.
"""

from __future__ import annotations

import os
import re
import tempfile
from pathlib import Path
from typing import Any

from course.workbook.links import link_line, title_of, with_links
from course.workbook.overview import PAGE, page
from course.workbook.work_folder import in_order

BEGIN = re.compile(r"^(\s*)# BEGIN SOLUTION\s*$")
END = re.compile(r"^\s*# END SOLUTION\s*$")
ALMOST = re.compile(
    r"#.*\b(begin|end)\s+solution\b", re.IGNORECASE
)  # a misspelt marker would hand out the answer
ROOT = Path(__file__).resolve().parents[2]


class BrokenSource(ValueError):
    """A solution notebook that no lesson can be made from.

    Names the file and the cell.
    """


def build(*, check: bool = False, root: Path = ROOT) -> list[str]:
    """Make every lesson from its solution; return what differed before, a line each.

    With ``check`` nothing is written. A lesson without a solution is reported too, but
    never deleted: it may be somebody's. Raises ``BrokenSource`` for unpaired markers.
    """
    drift = []
    sources = in_order((root / "solutions").glob("*.ipynb"))
    titles = {source.name: _title(source) for source in sources}
    wanted = {
        source.name: lesson_text(source, link_line(titles, source.name))
        for source in sources
    }
    if sources:
        wanted[PAGE] = page(titles)
    for name, text in wanted.items():
        target = root / "lessons" / name
        if target.exists() and target.read_text(encoding="utf-8") == text:
            continue
        what = "differs from what its solution makes" if target.exists() else "missing"
        drift.append(f"lessons/{name}: {what}")
        if not check:
            _write(target, text)
    orphans = {p.name for p in (root / "lessons").glob("*.ipynb")} - {
        p.name for p in sources
    }
    return drift + [
        f"lessons/{name}: has no solution to be made from" for name in sorted(orphans)
    ]


def _title(source: Path) -> str:
    import nbformat

    return title_of(nbformat.read(source, as_version=4).cells, source.stem)


def lesson_text(source: Path, links: str = "") -> str:
    """The lesson that a solution makes, as the text of its file; ``links`` stand at its
    beginning and end.
    """
    import nbformat  # takes seconds, and every lesson's import cell would wait for it

    notebook = nbformat.read(source, as_version=4)
    notebook.metadata = _metadata(notebook.metadata)
    for index, cell in enumerate(notebook.cells):
        if cell.cell_type != "code":
            if ALMOST.search(cell.source):
                where = f"{source.name}, cell {index}"
                raise BrokenSource(
                    f"{where}: expected solutions in code cells only; got one in text"
                )
            continue
        cell.outputs, cell.execution_count = [], None
        cell.metadata.pop("execution", None)
        cell.source = blank(cell.source, where=f"{source.name}, cell {index}")
    if links:
        notebook.cells = with_links(notebook.cells, links)
    return str(nbformat.writes(notebook)) + "\n"


def blank(code: str, *, where: str = "the cell") -> str:
    """Code with each marked solution replaced by ``...``.

    Raises ``BrokenSource`` for unpaired or misspelt markers.
    """
    kept: list[str] = []
    inside = False
    for line in code.replace("\r\n", "\n").split(
        "\n"
    ):  # splitlines would split strings at other separators too
        begin, end = BEGIN.match(line), END.match(line)
        if ALMOST.search(line) and not (begin or end):
            wanted = "# BEGIN SOLUTION or # END SOLUTION alone in a line"
            raise BrokenSource(f"{where}: expected {wanted}; got {line.strip()!r}")
        if (begin and inside) or (end and not inside):
            raise BrokenSource(
                f"{where}: expected BEGIN SOLUTION and END SOLUTION in turn; got {line.strip()!r}"
            )
        if begin:
            kept.append(f"{begin.group(1)}...")
            inside = True
        elif end:
            inside = False
        elif not inside:
            kept.append(line)
    if inside:
        raise BrokenSource(
            f"{where}: expected # END SOLUTION before the cell ends; got none"
        )
    return "\n".join(kept)


def execute(source: Path, *, seconds_per_cell: int = 60) -> None:
    """Run a solution from top to bottom and store its outputs; on error the file is
    kept.
    """
    import nbformat
    from nbclient import NotebookClient

    notebook = nbformat.read(source, as_version=4)
    client = NotebookClient(
        notebook,
        timeout=seconds_per_cell,
        kernel_name="python3",
        resources={"metadata": {"path": str(source.parent)}},
    )
    client.execute()
    for cell in notebook.cells:
        cell.metadata.pop(
            "execution", None
        )  # times of day differ at every run and say nothing
    notebook.metadata = _metadata(notebook.metadata)
    notebook.metadata.pop("widgets", None)
    _write(source, str(nbformat.writes(notebook)) + "\n")


def _metadata(metadata: Any) -> Any:
    """The notebook's metadata, without what differs from machine to machine."""
    import nbformat

    kept = {
        "kernelspec": {
            "display_name": "Python 3 (ipykernel)",
            "language": "python",
            "name": "python3",
        },
        "language_info": {
            "file_extension": ".py",
            "mimetype": "text/x-python",
            "name": "python",
        },
    }
    if "course" in metadata:
        kept["course"] = metadata["course"]
    return nbformat.from_dict(kept)


def _write(path: Path, text: str) -> None:
    """Write whole or not at all."""
    path.parent.mkdir(parents=True, exist_ok=True)
    handle, temporary = tempfile.mkstemp(dir=path.parent, suffix=".part")
    try:
        with os.fdopen(handle, "w", encoding="utf-8", newline="\n") as file:
            file.write(text)
        os.chmod(temporary, 0o644)
        os.replace(temporary, path)
    except BaseException:
        Path(temporary).unlink(missing_ok=True)
        raise
