"""The package as pip installs it: what the wheel holds, and what it asks for."""

import re
import subprocess
import sys
import zipfile
from pathlib import Path

import flit_core.buildapi
import pytest

from course.environment import parse_requirement

ROOT = Path(__file__).resolve().parents[1]


@pytest.fixture(scope="module")
def wheel(tmp_path_factory):
    """The wheel of this checkout, as its build backend makes it; nothing is written here."""
    folder = tmp_path_factory.mktemp("wheel")
    with pytest.MonkeyPatch.context() as patch:
        patch.chdir(ROOT)
        name = flit_core.buildapi.build_wheel(str(folder))
    with zipfile.ZipFile(folder / name) as opened:
        yield opened


def test_the_wheel_holds_all_of_the_package_and_nothing_else(wheel):
    names = {name for name in wheel.namelist() if ".dist-info/" not in name}
    there = {
        path.relative_to(ROOT).as_posix()
        for path in (ROOT / "course").rglob("*")
        if path.is_file() and "__pycache__" not in path.parts
    }
    assert names == there
    assert "course/py.typed" in names


def test_the_library_alone_asks_for_little(wheel):
    (name,) = (n for n in wheel.namelist() if n.endswith(".dist-info/METADATA"))
    text = wheel.read(name).decode()
    asked = re.findall(r"^Requires-Dist: ([^;\n]+?)\s*(?:;(.*))?$", text, flags=re.M)
    plain = {parse_requirement(r.strip())[0] for r, marker in asked if "extra" not in marker}  # fmt: skip
    assert plain <= {"numpy", "scipy", "numba"}
    extras = set(re.findall(r"^Provides-Extra: (\S+)$", text, flags=re.M))
    assert extras == {"workbook", "test", "peers", "meshes", "browser"}


LIBRARY_ALONE = """
import importlib.abc, pkgutil, sys
ALLOWED = {"course", "numpy", "scipy", "numba", "llvmlite", *sys.stdlib_module_names}

class Nothing(importlib.abc.MetaPathFinder):
    def find_spec(self, name, path=None, target=None):
        room = name.split(".")[0]
        if room not in ALLOWED and not room.startswith("_"):
            raise ModuleNotFoundError(f"No module named {name!r}", name=name)

sys.meta_path.insert(0, Nothing())
import course
ROOMS = ("formulas", "shapes", "overlap", "dynamics", "detection", "contact", "scenes",
         "simulation", "study", "exercises")
seen = 0
for found in pkgutil.walk_packages(course.__path__, "course."):
    if found.name.split(".")[1] in ROOMS:
        importlib.import_module(found.name)
        seen += 1
assert seen > 50, seen

import numpy as np
from course.contact import ContactSystem, solve
from course.dynamics import impulse_central

A, b = np.array([[2.0, 1.0], [1.0, 2.0]]), np.array([-3.0, -3.0])
assert np.allclose(solve(ContactSystem(A, b)).force, [1.0, 1.0])
e = np.array([1.0, 0, 0])
print(impulse_central(2.0, 1.0, np.array([-3.0, 0, 0]), e, e, 0.5))
"""


@pytest.mark.slow
def test_the_library_works_with_numpy_and_scipy_alone():
    """Every module of the numerics is imported; the README's example, 4 N s, is run."""
    done = subprocess.run(
        [sys.executable, "-c", LIBRARY_ALONE],
        cwd=ROOT,
        capture_output=True,
        text=True,
        check=False,
    )
    assert done.returncode == 0, done.stderr
    assert float(done.stdout) == 4.0
