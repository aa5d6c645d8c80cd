"""Compiled loops: the same numbers without the compiler, no stale machine code, and no need of a cache or of Numba."""

import importlib
import json
import os
import shutil
import subprocess
import sys
from pathlib import Path

import numpy as np
import pytest

from course import jit, warming

#: Seconds together: left out of the minute's run.
pytestmark = pytest.mark.slow

ROOT = Path(jit.PACKAGE).parent

#: Everything that is compiled, on systems large enough that an index could go astray.
SCRIPT = """
import json, sys
import numpy as np
{before}
from course.contact import ContactSystem, solve
from course.study.impact_laws import impulses_in_turn
from course.overlap import closest_points, oriented_boxes_overlap
from course.shapes import OBB, ConvexHull, polytopes
from course.scenes import pile, shaken, stack, wall

rng = np.random.default_rng(3)
numbers = []
for scene in (stack(3), shaken(wall(5, 4), rng)):
    found = solve(scene.system(), method="projected_gauss_seidel", max_iterations=20, tolerance=1e-30)
    numbers += found.force.tolist()
root = rng.normal(size=(12, 20))
numbers += impulses_in_turn(root @ root.T, rng.normal(size=12) - 1, 0.5, passes=5)[0].tolist()
factor = rng.normal(size=(200, 6, 9))
batch = ContactSystem(np.swapaxes(factor, 1, 2) @ factor, -np.einsum("smc,sm->sc", factor, rng.normal(size=(200, 6))))
numbers += solve(batch).acceleration.ravel().tolist()
heap = pile(150, rng).system()
numbers += (solve(heap).acceleration + 1.0).tolist()
points, each = rng.normal(size=(2, 30, 6, 3)), np.arange(30)
found = closest_points(*(polytopes(ConvexHull(p)) for p in points), each, each)
numbers += found.gap.tolist() + found.point_a.ravel().tolist()
box = OBB(points[0, :, 0], np.broadcast_to(np.eye(3), (30, 3, 3)), np.abs(points[0, :, 1]))
numbers += oriented_boxes_overlap(box, box.reshaped(30, 1)).astype(float).ravel().tolist()
print(json.dumps(numbers))
"""


def python(code, *, cwd=ROOT, **environment):
    """What a fresh process prints last and says on the error stream."""
    done = subprocess.run(
        [sys.executable, "-c", code],
        cwd=cwd,
        env={**os.environ, "PYTHONPATH": str(cwd), **environment},
        capture_output=True,
        text=True,
        timeout=600,
    )
    assert done.returncode == 0, done.stderr
    return done.stdout.strip().splitlines()[-1], done.stderr


@pytest.fixture(scope="module")
def numbers():
    return np.array(json.loads(python(SCRIPT.format(before=""))[0]))


@pytest.mark.slow
@pytest.mark.parametrize(
    "environment, before",
    [
        ({"COURSE_COMPILED": "0"}, ""),
        ({"NUMBA_DISABLE_JIT": "1"}, ""),
        pytest.param({"NUMBA_BOUNDSCHECK": "1"}, "", marks=pytest.mark.long),
        ({}, "sys.modules['numba'] = None"),
    ],
    ids=["off", "off for all of Numba", "bounds checked", "no Numba"],
)
def test_the_same_numbers_however_they_are_made(numbers, environment, before):
    printed, said = python(SCRIPT.format(before=before), **environment)
    np.testing.assert_allclose(json.loads(printed), numbers, rtol=1e-9, atol=1e-9)
    assert said.count("Numba cannot be imported") == (1 if before else 0)


def test_switched_off_numba_is_not_even_imported():
    code = (
        "import sys; from course.contact.solvers import projected_gauss_seidel as m; "
        "m.warm(); print('numba' in sys.modules)"
    )
    assert python(code, COURSE_COMPILED="0")[0] == "False"
    assert python(code)[0] == "True"


# A package of two kernel modules, to be edited, locked and broken.

CALLEE = """
from course.jit import compiled
@compiled
def inner(x):
    return x + {added}
"""
CALLER = """
from course.jit import compiled
from course.callee import inner
@compiled
def outer(x):
    return 2.0 * inner(x)
"""
CALL = "from course.caller import outer; print(outer(1.0))"


@pytest.fixture
def small(tmp_path):
    package = tmp_path / "course"
    package.mkdir()
    (package / "__init__.py").touch()
    shutil.copy(jit.PACKAGE / "jit.py", package)
    (package / "callee.py").write_text(CALLEE.format(added="1.0"))
    (package / "caller.py").write_text(CALLER)
    return tmp_path


def machine_code(home):
    return sorted(home.glob("course/__pycache__/kernels-*/**/*.nbc"))


def test_an_edit_of_a_callee_in_another_file_is_noticed(small):
    assert python(CALL, cwd=small)[0] == "4.0"
    before = machine_code(small)
    assert len(before) == 2
    (small / "course/callee.py").write_text(CALLEE.format(added="2.0"))
    assert python(CALL, cwd=small)[0] == "6.0"
    assert len(machine_code(small)) == 4
    # The old code goes when the new is made ahead, and the new is used again.
    jit.remove_old_caches(small / "course")
    after = machine_code(small)
    assert len(after) == 2 and not set(after) & set(before)
    times = [path.stat().st_mtime_ns for path in after]
    assert python(CALL, cwd=small)[0] == "6.0"
    assert [path.stat().st_mtime_ns for path in after] == times


def test_without_a_folder_to_write_there_is_no_cache(small):
    (small / "course/__pycache__").write_text("a file where the folder would be")
    assert python(CALL, cwd=small, PYTHONDONTWRITEBYTECODE="1")[0] == "4.0"
    assert machine_code(small) == []


def test_a_folder_that_can_only_be_read_is_copied(monkeypatch, tmp_path):
    folder = tmp_path / "kernels-0"
    (folder / "sub").mkdir(parents=True)
    (folder / "sub/one.nbc").write_bytes(b"code")

    def refuse(**_):
        raise OSError(30, "Read-only file system")

    monkeypatch.setattr(jit.tempfile, "TemporaryFile", refuse)
    monkeypatch.setattr(jit, "cache_folder", lambda: folder)
    copy = jit._cache_folder.__wrapped__()
    assert copy != folder and (copy / "sub/one.nbc").read_bytes() == b"code"
    shutil.rmtree(copy.parent)
    monkeypatch.setattr(jit, "cache_folder", lambda: tmp_path / "none" / "kernels-1")
    monkeypatch.setattr(Path, "mkdir", refuse_mkdir)
    assert jit._cache_folder.__wrapped__() is None


def refuse_mkdir(*_, **__):
    raise OSError(30, "Read-only file system")


def test_with_bounds_checked_nothing_is_taken_from_the_cache(small):
    (small / "course/caller.py").write_text(
        "from course.jit import compiled\n@compiled\ndef outer(x):\n    return x[9]\n"
    )
    call = (
        "import numpy as np\nfrom course.caller import outer\n"
        "try:\n    outer(np.zeros(3)); print('unseen')\n"
        "except IndexError:\n    print('seen')\n"
    )
    assert python(call, cwd=small)[0] == "unseen"
    assert python(call, cwd=small, NUMBA_BOUNDSCHECK="1")[0] == "seen"


def test_every_kernel_is_made_ahead_and_for_the_types_that_are_used():
    """After ``warm`` nobody waits for the compiler: use adds no signature."""
    pytest.importorskip("numba")
    assert warming.warm() == len(jit.kernel_modules()) > 1
    kernels = {
        f"{name}.{attribute}": value
        for name in jit.kernel_modules()
        for attribute, value in vars(importlib.import_module(name)).items()
        if hasattr(value, "signatures")
    }
    made = {name: len(kernel.signatures) for name, kernel in kernels.items()}
    # What only other kernels call is part of their machine code.
    called = {
        n for kernel in kernels.values() for n in kernel.py_func.__code__.co_names
    }
    assert all(
        count == 1 or (count == 0 and name.rpartition(".")[2] in called)
        for name, count in made.items()
    ), made
    exec(SCRIPT.format(before="").replace("print(", "("), {})
    assert {name: len(kernel.signatures) for name, kernel in kernels.items()} == made
