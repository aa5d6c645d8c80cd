"""What a docstring, a comment or a page refers to is there: files, and dotted names of this package."""

import ast
import importlib
import re
from functools import cache
from pathlib import Path

import pytest

pytestmark = pytest.mark.slow  # with its like, left out of --quick

ROOT = Path(__file__).resolve().parents[1]
FOLDERS = ("course", "tests", "docs", "benchmarks", "solutions", "lessons", ".ci")
PATH = re.compile(
    r"(?<![\w/.:-])(?:"
    r"(?:docs|course|tests|solutions|lessons|benchmarks|\.ci|\.github)/[\w./*-]*[\w*/]"
    r"|[\w./-]+\.(?:py|md|toml|ipynb|cfg|lock|ya?ml)\b)"
)
DOTTED = re.compile(r"(?<![\w./-])course(?:\.[A-Za-z_]\w*)+")
LINK = re.compile(r"\]\(([^)#\s]+)")
# Names of files that are nowhere in the project, and are not meant to be.
ELSEWHERE = {"json.py", "numpy.py"}  # what may lie about in a student's folder
MADE_UP = {
    "course.exercises.definitions.toy_lessons",  # a name under which tests load theirs
}
PLACEHOLDER = re.compile(r"NN|^work/|^lessons/99-|^solutions/00-x")


def pages():
    return [*ROOT.glob("*.md"), *ROOT.glob("docs/**/*.md")]


def modules():
    return sorted(p for f in ("course", "benchmarks", "tests") for p in ROOT.glob(f"{f}/**/*.py"))  # fmt: skip


def prose(path: Path) -> str:
    """The docstrings and comments of a module; the whole of any other file."""
    source = path.read_text(encoding="utf-8")
    if path.suffix != ".py":
        return source
    kinds = (ast.Module, ast.ClassDef, ast.FunctionDef, ast.AsyncFunctionDef)
    docs = [
        ast.get_docstring(node) or ""
        for node in ast.walk(ast.parse(source))
        if isinstance(node, kinds)
    ]
    comments = re.findall(r"(?:^|\s)#.*$", source, flags=re.M)
    return "\n\n".join(docs + comments)


@cache
def file_names():
    """The names of all files, with the folder they lie in, for references by these alone."""
    paths = [p for folder in FOLDERS for p in (ROOT / folder).rglob("*")]
    return {p.name for p in paths} | {f"{p.parent.name}/{p.name}" for p in paths}


@cache
def leads_somewhere(reference: str, path: Path) -> bool:
    """Whether a file is there, seen from the root, from beside the page, or by its name."""
    if reference in ELSEWHERE or PLACEHOLDER.search(reference):
        return True
    if any(True for base in (ROOT, path.parent, ROOT / "course") for _ in base.glob(reference)):  # fmt: skip
        return True
    by_name_alone = reference.count("/") < 2 and not reference.startswith(FOLDERS)
    return by_name_alone and reference in file_names()


@cache
def is_known(dotted: str) -> bool:
    """Whether ``course.a.b`` is a module or something that can be got from one."""
    parts = dotted.split(".")
    for cut in range(len(parts), 0, -1):
        try:
            found = importlib.import_module(".".join(parts[:cut]))
        except ModuleNotFoundError:
            continue
        for name in parts[cut:]:
            found = getattr(found, name, None)
        return found is not None
    return False


def dead_references(text: str, path: Path) -> list[str]:
    dead = [ref for ref in PATH.findall(text) if not leads_somewhere(ref, path)]
    dead += [name for name in set(DOTTED.findall(text)) - MADE_UP if not is_known(name)]
    if path.suffix == ".md":
        links = [link for link in LINK.findall(text) if "://" not in link]
        dead += [link for link in links if not (path.parent / link).exists()]
    return dead


def test_every_reference_leads_somewhere():
    dead = {
        str(path.relative_to(ROOT)): found
        for path in [*pages(), *modules()]
        if path != Path(__file__) and (found := dead_references(prose(path), path))
    }
    assert dead == {}


@pytest.mark.parametrize(
    "text",
    [
        "see docs/no-such-page.md",
        "as TRUTHS-OF-NOBODY.md says",
        "in course/overlap/no_such.py",
        "`tests/no_such_folder/` holds it",
        "by course.dynamics.no_such_function",
        "by course.no_such_room",
        "[here](docs/nowhere.png)",
    ],
)
def test_a_dead_reference_is_found(text):
    assert len(dead_references(text, ROOT / "README.md")) >= 1


@pytest.mark.parametrize(
    "text",
    [
        "docs/architecture.md, tests/nbval_sanitize.cfg and course/dynamics/",
        "exercises/answer.py or answer.py alone",
        "solutions/*.ipynb, solutions/NN-name.ipynb and work/10-impulse.ipynb",
        "course.dynamics.impulse_central and course.cli",
        "https://example.org/tests/none.py and [there](https://example.org/a.md)",
    ],
)
def test_a_living_reference_is_not_reported(text):
    assert dead_references(text, ROOT / "README.md") == []
