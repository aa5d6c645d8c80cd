"""The floors of the house: who may import whom. Read from the source, imports inside functions included.

A room is a subpackage or a module directly in ``course``. It imports from floors below and from itself;
two rooms on one floor do not import each other. docs/architecture.md draws the same table.
"""

import ast
import subprocess
import sys
from functools import cache
from pathlib import Path

import pytest

from course import jit

ROOT = Path(__file__).resolve().parents[1]

FLOORS = [
    {"foundation"},
    {"formulas"},
    {"shapes"},
    {"overlap", "dynamics"},
    {"detection", "contact"},
    {"scenes"},
    {"simulation"},
    {"study"},
    {"exercises"},
    {"sandbox"},
    {"workbook", "grading"},
    {"entrance"},
]
FLOOR = {room: number for number, rooms in enumerate(FLOORS) for room in rooms}
SHARED = {                                               # rooms of several modules that stand directly in course/
    "arrays": "foundation", "rotations": "foundation", "jit": "foundation",
    "cli": "entrance", "__main__": "entrance", "testing": "entrance",
    "warming": "entrance",
}  # fmt: skip
GROUND = {
    "environment",
    "installation",
}  # standard library only; for the upper floors alone
NUMERICS = 7  # floors 0-7: NumPy and SciPy, no printing
NUMERIC_LIBRARIES = {"numpy", "scipy"}
#: The formulas themselves need NumPy; an expression imports SymPy, the turn of a step
#: SciPy's Rotation, each in its function.
FORMULAS = "formulas"
# What else a numeric module may import, and only inside a function.
WHEN_CALLED = {
    "course.jit": {"numba"},  # through it all kernels have Numba
    "course.contact.solvers.qp": {"cvxpy"},
    "course.formulas.lesson_16_contact_forces": {"cvxpy"},
    "course.shapes.meshes": {"trimesh"},
    "course.study.engines": {
        "fcl",
        "coal",
        "trimesh",
        "mujoco",
        "pybullet",
        "pymunk",
        "piqp",
        "daqp",
        "osqp",
    },
}
# The lecture's programme as a student writes it, and as a method of the library.
CVXPY = {"course.contact.solvers.qp", "course.formulas.lesson_16_contact_forces"}
HEAVY = {
    "scipy",
    "numba",
    "matplotlib",
    "cvxpy",
    "sympy",
    "ipywidgets",
    "IPython",
    "anywidget",
    "pandas",
    "jupyterlab",
}


#: Read once: three tests look at every module.
parsed = cache(ast.parse)
DEFERRED = (ast.FunctionDef, ast.AsyncFunctionDef, ast.Lambda)
BY_NAME = {"importlib.import_module", "__import__"}


def walked(node, top=True):
    """Every node, and whether it is carried out when the module is imported."""
    for inner in ast.iter_child_nodes(node):
        yield inner, top
        yield from walked(inner, top and not isinstance(inner, DEFERRED))


def imports(source, module, *, package=False):
    """(absolute name, whether at module level) of everything a module imports."""
    parts = module.split(".")
    found = []
    for node, top in walked(parsed(source)):
        if isinstance(node, ast.Import):
            found += [(alias.name, top) for alias in node.names]
        elif isinstance(node, ast.ImportFrom):
            home = parts[: len(parts) - node.level + package] if node.level else []
            base = ".".join([*home, *([node.module] if node.module else [])])
            # "from course import x": x may be a room; "from course.shapes import Sphere": shapes is
            found += [
                (f"{base}.{alias.name}" if base == "course" else base, top)
                for alias in node.names
            ]
        elif (
            isinstance(node, ast.Call)
            and node.args
            and isinstance(node.args[0], ast.Constant)
        ):
            if ast.unparse(node.func) in BY_NAME:
                found.append((str(node.args[0].value), top))
    return found


def room(module):
    """The room of a module: "course.contact.solvers.nnls" -> "contact"."""
    parts = module.split(".")
    first = parts[1] if len(parts) > 1 else ""
    return SHARED.get(first, first)


def faults(source, module, *, package=False):
    """What a module's source breaks, a line each."""
    here, said = room(module), []
    if here and here not in FLOOR and here not in GROUND:
        return [f"{module}: no floor is given to {here}"]
    numeric = FLOOR.get(here, 99) <= NUMERICS
    bare = here in GROUND or module in ("course", "course.__main__")
    for name, top in imports(source, module, package=package):
        outer, there = name.split(".")[0], room(name)
        if outer in ("lessons", "solutions", "tests", "benchmarks"):
            said.append(f"{module} imports from {outer}")
        elif outer == "course":
            said += house_faults(module, here, there, numeric)
        elif outer in sys.stdlib_module_names:
            continue
        elif bare:
            said.append(
                f"{module} imports {name}, which is not in the standard library"
            )
        elif (
            here == FORMULAS
            and outer != "numpy"
            and (top or not _when_called(module, outer))
        ):
            said.append(
                f"{module} imports {name}{' at module level' if top else ''}: formulas use NumPy"
            )
        elif here != FORMULAS and (
            numeric
            and outer not in NUMERIC_LIBRARIES
            and (top or outer not in WHEN_CALLED.get(module, ()))
        ):
            said.append(
                f"{module} imports {name}{' at module level' if top else ''}: numerics use NumPy and SciPy"
            )
        elif outer == "cvxpy" and (top or module not in CVXPY):
            said.append(
                f"{module} imports cvxpy; only {' and '.join(sorted(CVXPY))} may, when called"
            )
    if numeric:
        said += [f"{module} prints (line {line})" for line in prints(source)]
    return said


def _when_called(module, library):
    """Whether a module of formulas may import this inside a function."""
    return library in {"sympy", "scipy"} | WHEN_CALLED.get(module, set())


def house_faults(module, here, there, numeric):
    """What an import of ``there`` breaks in the room ``here``."""
    if module == "course":
        return [f"course/__init__ imports course.{there}"]
    if here in GROUND:
        return (
            []
            if there in GROUND | {""}
            else [f"{module} imports course.{there}: it must run before all else"]
        )
    if there in GROUND:
        return (
            [f"{module} imports course.{there}: numerics need no environment"]
            if numeric
            else []
        )
    if there == here or there == "":
        return []
    if there not in FLOOR:
        return (
            []
            if there.startswith("__")
            else [f"{module} imports course.{there}, which has no floor"]
        )
    if FLOOR[there] >= FLOOR[here]:
        return [
            f"{module} (floor {FLOOR[here]}) imports course.{there} (floor {FLOOR[there]})"
        ]
    return []


def prints(source):
    """The lines that call print."""
    return [
        node.lineno
        for node in ast.walk(parsed(source))
        if isinstance(node, ast.Call)
        and isinstance(node.func, ast.Name)
        and node.func.id == "print"
    ]


def modules():
    """(name, path) of every module of course."""
    for path in sorted((ROOT / "course").rglob("*.py")):
        parts = path.relative_to(ROOT).with_suffix("").parts
        yield ".".join(parts[:-1] if parts[-1] == "__init__" else parts), path


def told(find):
    """What a rule finds in every module of course."""
    return [
        line
        for module, path in modules()
        for line in find(
            path.read_text(encoding="utf-8"), module, package=path.name == "__init__.py"
        )
    ]


def test_floors_are_kept():
    assert told(faults) == []


KERNELS = jit.kernel_modules()


def kernel_faults(source, module, kernels=frozenset(KERNELS), *, package=False):
    """What breaks the rules of ``course.jit``: who imports a kernel module at its top, and what a kernel names.

    Machine code is kept under a hash of the kernel modules: a constant from elsewhere
    could change unseen.
    """
    said = []
    if module not in kernels:
        return [
            f"{module} imports the kernel module {name} at module level"
            for name, top in imports(source, module, package=package)
            if top and name in kernels
        ]
    tree = parsed(source)
    foreign = {
        alias.asname or alias.name: node.module
        for node in tree.body
        if isinstance(node, ast.ImportFrom) and node.module not in kernels
        for alias in node.names
    }
    for function in tree.body:
        marks = getattr(function, "decorator_list", [])
        if "compiled" not in [ast.unparse(mark) for mark in marks]:
            continue
        names = {
            n.id for s in function.body for n in ast.walk(s) if isinstance(n, ast.Name)
        }
        said += [
            f"{module}.{function.name} uses {name} of {foreign[name]}, no kernel module"
            for name in sorted(names & foreign.keys())
        ]  # fmt: skip
    if not any(isinstance(n, ast.FunctionDef) and n.name == "warm" for n in tree.body):
        said.append(f"{module} has no warm()")
    return said


def test_kernels_are_imported_where_they_are_called():
    assert told(kernel_faults) == []


def test_a_broken_rule_of_kernels_is_reported():
    kernels = {"course.a.sweeps", "course.a.steps"}
    top = "from course.jit import compiled\n"
    kernel = "@compiled\ndef f(x):\n    return x + EPS\ndef warm(): f(1.0)\n"
    for source, module, said in (
        ("from course.a.sweeps import f", "course.a.other", "at module level"),
        (top + "from course.arrays import EPS\n" + kernel, "course.a.sweeps", "uses EPS of course.arrays"),
        (top + "@compiled\ndef f(x):\n    return x\n", "course.a.sweeps", "no warm()"),
    ):  # fmt: skip
        assert any(said in line for line in kernel_faults(source, module, kernels))
    for source, module in (
        ("def g():\n    from course.a.sweeps import f", "course.a.other"),
        (top + "from course.a.steps import EPS\n" + kernel, "course.a.sweeps"),
        (top + "EPS = 1e-9\n" + kernel, "course.a.sweeps"),
    ):
        assert kernel_faults(source, module, kernels) == []


def test_solvers_stand_below_the_engine():
    """docs/architecture.md: the engine is built from the lecture's solvers, never the other way round."""
    for module, path in modules():
        if module.startswith("course.contact.solvers"):
            source = path.read_text(encoding="utf-8")
            names = {
                name
                for name, _ in imports(
                    source, module, package=path.name == "__init__.py"
                )
            }
            assert not {n for n in names if n.startswith("course.contact.engine")}, (
                module
            )


def test_every_module_is_looked_at():
    assert {
        "course",
        "course.__main__",
        "course.environment",
        "course.dynamics.central_impulses",
    } <= dict(modules()).keys()


def namesakes(source, module):
    """Functions and classes of a module that bear its name: "from package import x" would be ambiguous."""
    last = module.split(".")[-1]
    kinds = (ast.FunctionDef, ast.AsyncFunctionDef, ast.ClassDef)
    return [
        f"{module} holds {node.name}"
        for node in parsed(source).body
        if isinstance(node, kinds) and node.name == last
    ]


def test_no_module_bears_the_name_of_a_function_it_holds():
    found = [
        said
        for module, path in modules()
        for said in namesakes(path.read_text(encoding="utf-8"), module)
    ]
    assert found == []
    assert namesakes("def ladder():\n    pass", "course.scenes.ladder") == [
        "course.scenes.ladder holds ladder"
    ]


# The test above must be able to fail.


@pytest.mark.parametrize(
    "module, source, said",
    [
        (
            "course.shapes.sphere",
            "from course.overlap import gap",
            "floor 2) imports course.overlap (floor 3",
        ),
        (
            "course.overlap.boxes",
            "def f():\n    from course.contact import solve",
            "imports course.contact (floor 4",
        ),
        (
            "course.overlap.boxes",
            "import course.dynamics.bodies",
            "imports course.dynamics (floor 3",
        ),
        (
            "course.overlap.boxes",
            "from course import dynamics",
            "imports course.dynamics (floor 3",
        ),
        (
            "course.overlap.boxes",
            "from ..dynamics import Bodies",
            "imports course.dynamics (floor 3",
        ),
        (
            "course.overlap.boxes",
            "if TYPE_CHECKING:\n    from course.dynamics import Bodies",
            "imports course.dynamics",
        ),
        (
            "course.grading.judge",
            "from course.workbook import check",
            "imports course.workbook (floor 10",
        ),
        (
            "course.workbook.checking",
            "from course.cli import app",
            "imports course.entrance (floor 11",
        ),
        ("course.workbook.checking", "from course.attic import ghost", "has no floor"),
        ("course.arrays", "import course.shapes", "imports course.shapes (floor 2"),
        (
            "course.scenes.balls",
            "from course.study import roll",
            "floor 5) imports course.study (floor 7",
        ),
        (
            "course.contact.engine",
            "from course.scenes import stack",
            "imports course.scenes (floor 5",
        ),
        (
            "course.scenes.balls",
            "def f():\n    import matplotlib",
            "imports matplotlib",
        ),
        ("course.scenes.balls", "def f():\n    print(1)", "prints (line 2)"),
        ("course.attic", "import numpy", "no floor is given to attic"),
        (
            "course.contact.solvers.nnls",
            "import numba",
            "imports numba at module level",
        ),
        ("course.contact.collisions", "def f():\n    import numba", "imports numba"),
        (
            "course.dynamics.impulse",
            "def f():\n    import matplotlib.pyplot as plt",
            "imports matplotlib",
        ),
        (
            "course.study.stability",
            "from ipywidgets import IntSlider",
            "imports ipywidgets",
        ),
        ("course.study.stability", "import IPython", "imports IPython"),
        (
            "course.simulation.scene",
            "def f():\n    import anywidget",
            "imports anywidget",
        ),
        ("course.contact.solvers.qp", "import cvxpy", "imports cvxpy at module level"),
        ("course.contact.solvers.nnls", "def f():\n    import cvxpy", "imports cvxpy"),
        (
            "course.formulas.lesson_10_impulse",
            "import sympy",
            "imports sympy at module level",
        ),
        (
            "course.formulas.lesson_10_impulse",
            "def f():\n    import cvxpy",
            "formulas use NumPy",
        ),
        (
            "course.formulas.lesson_10_impulse",
            "from course.dynamics import impulse",
            "floor 1) imports course.dynamics (floor 3",
        ),
        ("course.workbook.plots", "def f():\n    import cvxpy", "imports cvxpy; only"),
        ("course.study.engines", "import pymunk", "imports pymunk at module level"),
        (
            "course.arrays",
            "from course.environment import project_root",
            "numerics need no environment",
        ),
        ("course.arrays", "def f(x):\n    print(x)", "prints (line 2)"),
        ("course", "import numpy", "not in the standard library"),
        (
            "course",
            "from course.dynamics import Bodies",
            "course/__init__ imports course.dynamics",
        ),
        (
            "course.__main__",
            "def main():\n    import typer",
            "not in the standard library",
        ),
        ("course.environment", "import packaging", "not in the standard library"),
        (
            "course.environment",
            "def f():\n    from course.cli import app",
            "it must run before all else",
        ),
        (
            "course.workbook.checking",
            "import solutions.tools",
            "imports from solutions",
        ),
        (
            "course.workbook.checking",
            "import importlib\nimportlib.import_module('lessons.x')",
            "imports from lessons",
        ),
    ],
)
def test_a_broken_floor_is_reported(module, source, said):
    assert any(said in line for line in faults(source, module)), faults(source, module)


@pytest.mark.parametrize(
    "module, source",
    [
        ("course.contact.solvers.qp", "def solve():\n    import cvxpy"),
        ("course.rotations", "from course.arrays import vectors"),
        ("course.jit", "def f():\n    import numba"),
        (
            "course.formulas.lesson_10_impulse",
            "import numpy\ndef f():\n    import sympy as sp",
        ),
        (
            "course.formulas.lesson_16_contact_forces",
            "def f():\n    import cvxpy as cp",
        ),
        ("course.dynamics.impulse", "from course import formulas"),
        ("course.contact.solving", "from course.contact.solvers.nnls import solve"),
        (
            "course.contact.collisions",
            "from course.dynamics import Bodies\nimport scipy.optimize",
        ),
        (
            "course.grading.judge",
            "from course.exercises.definition import all_lessons\nimport rich",
        ),
        (
            "course.cli",
            "import typer\nfrom course import environment\nfrom course.workbook import build",
        ),
        (
            "course.__main__",
            "from course import environment\ndef main():\n    from course import cli",
        ),
        ("course.environment", "from course import installation"),
        (
            "course.workbook.plots",
            "import matplotlib\nfrom course.workbook.numbers import show\nprint('seen')",
        ),
    ],
)
def test_what_is_allowed_is_not_reported(module, source):
    assert faults(source, module) == []


def numeric_packages():
    return [
        name
        for name, path in modules()
        if path.name == "__init__.py" and FLOOR.get(room(name), 99) <= NUMERICS
    ]


@pytest.mark.parametrize(
    "package", [*numeric_packages(), "course.arrays", "course.rotations"]
)
@pytest.mark.slow
def test_importing_numerics_loads_no_heavy_library(package):
    assert heavy_after(f"import {package}") == set()


def test_starting_loads_nothing_but_the_standard_library():
    assert (
        heavy_after(
            "import course, course.__main__, course.environment, course.installation"
        )
        == set()
    )
    loaded = loaded_after(
        "import course, course.__main__, course.environment, course.installation"
    )
    assert {name for name in loaded if name not in sys.stdlib_module_names} <= {
        "course"
    } | nothing_loaded()


def test_heavy_libraries_would_be_seen():
    assert "scipy" in heavy_after("import numpy, scipy.optimize")


def loaded_after(statement):
    code = f"{statement}\nimport sys\nprint(*{{name.split('.')[0] for name in sys.modules}})"
    return set(subprocess.run([sys.executable, "-c", code], cwd=ROOT, check=True, capture_output=True,
                              text=True).stdout.split())  # fmt: skip


def nothing_loaded():
    """What a bare start has loaded: hooks that a site may have put there."""
    return loaded_after("pass")


def heavy_after(statement):
    return loaded_after(statement) & HEAVY
