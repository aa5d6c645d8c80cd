"""The package as pip installs it: what the wheel holds, and what it asks for."""

import re
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
        if path.is_file() and path.suffix != ".pyc"
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
    assert extras == {"workbook", "test", "peers", "browser"}
