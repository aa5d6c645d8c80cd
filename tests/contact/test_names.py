"""One constant, one home: a name of course/contact stands for one number only; the engine's table is complete."""

import ast
from collections import defaultdict
from pathlib import Path

import course.contact.engine as engine

CONTACT = Path(__file__).resolve().parents[2] / "course" / "contact"


def constants(source):
    """The names in capitals that a module assigns at its top."""
    return {
        name.id
        for node in ast.parse(source).body
        if isinstance(node, (ast.Assign, ast.AnnAssign))
        for target in (node.targets if isinstance(node, ast.Assign) else [node.target])
        for name in ast.walk(target)
        if isinstance(name, ast.Name) and name.id.isupper()
    }


def homes(sources):
    """The files in which each constant is assigned."""
    found = defaultdict(list)
    for path, source in sources.items():
        for name in constants(source):
            found[name].append(path)
    return found


def test_no_constant_has_two_homes():
    sources = {str(p.relative_to(CONTACT)): p.read_text(encoding="utf-8") for p in CONTACT.rglob("*.py")}  # fmt: skip
    found = homes(sources)
    assert len(found) > 50
    assert {name: paths for name, paths in found.items() if len(paths) > 1} == {}


def test_a_second_home_is_found():
    sources = {"a.py": "A, FEW = 1, 2\nb = 3", "b.py": "FEW: float = 4\nB = 1"}
    assert homes(sources)["FEW"] == ["a.py", "b.py"] and "b" not in homes(sources)


def test_the_table_of_the_engine_names_its_files():
    table = engine.__doc__.split('when "auto" uses it')[1]
    named = [line.split()[0] for line in table.strip().splitlines()]
    files = [p.stem for p in (CONTACT / "engine").glob("[a-z]*.py")]
    assert sorted(named) == sorted(files)
