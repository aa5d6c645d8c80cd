"""One decorator for loops: ``@compiled`` is Numba's ``njit``, or nothing where there is no Numba.

Some algorithms are loops: a sweep over contacts, an elimination, a walk through a
tree. They are written as the textbook has them, on numbers and small arrays, and
compiled when first called. No fast-math and no threads: the results are those of
the plain Python to rounding, division by zero gives inf or nan as in NumPy, and the
global random state is not to be used.

A *kernel module* has ``from course.jit import compiled`` at its top, which brings
Numba with it (about half a second), and is therefore imported inside the functions
that call it. Kernels call each other across kernel modules; what else they name are
NumPy, math, and constants of kernel modules (tests/test_floors.py checks both).
A kernel module has a function ``warm()`` that calls its kernels once, by which
``course.warming`` compiles them ahead.

Machine code is kept beside the package, in ``__pycache__/kernels-<hash>``, under
the hash of all kernel modules: Numba by itself notices a change in a function's own
file, but not in a function that it calls. Where that folder cannot be written a
copy of it serves, and where there is none every process compiles for itself.

The environment variable COURSE_COMPILED=0 (or Numba's own NUMBA_DISABLE_JIT=1)
turns the compiler off.
"""

from __future__ import annotations

import atexit
import contextlib
import hashlib
import os
import re
import shutil
import tempfile
import warnings
from collections.abc import Callable, Iterator
from functools import cache
from pathlib import Path
from typing import Any, TypeVar

Kernel = TypeVar("Kernel", bound=Callable[..., Any])

#: The environment variable that turns the compiler off, with the value 0.
SETTING = "COURSE_COMPILED"
PACKAGE = Path(__file__).resolve().parent
#: What makes a module a kernel module, at the beginning of a line.
MARK = re.compile(rb"^from course\.jit import .*\bcompiled\b", re.MULTILINE)


def compiled(function: Kernel) -> Kernel:
    """Compile a function of numbers and arrays when it is first called.

    Returns:
        The function itself where there is no Numba or the compiler is off.
    """
    numba = _numba()
    if numba is None:
        return function
    # Numba's cache does not tell code with bounds checked from code without.
    folder = None if numba.config.BOUNDSCHECK else _cache_folder()
    with _cached_in(numba, folder):
        return numba.njit(cache=folder is not None, error_model="numpy")(function)


@cache
def _numba() -> Any:
    """Numba, or None where it is switched off or missing; that is said once."""
    if os.environ.get(SETTING) == "0":
        return None
    try:
        import numba
    except (ImportError, OSError) as problem:
        warnings.warn(
            f"Numba cannot be imported ({problem}): loops run as plain Python, with "
            "the same results, but 10 to 100 times slower.",
            RuntimeWarning,
            stacklevel=3,
        )
        return None
    return numba


@contextlib.contextmanager
def _cached_in(numba: Any, folder: Path | None) -> Iterator[None]:
    """Numba's cache folder for what is decorated meanwhile; other programs' stays as it was."""
    before = numba.config.CACHE_DIR
    numba.config.CACHE_DIR = before if folder is None else str(folder)
    try:
        yield
    finally:
        numba.config.CACHE_DIR = before


def kernel_modules(package: Path = PACKAGE) -> dict[str, Path]:
    """Name and file of every kernel module, in the order of their names."""
    files = sorted(p for p in package.rglob("*.py") if MARK.search(p.read_bytes()))
    return {
        ".".join([package.name, *p.relative_to(package).with_suffix("").parts]): p
        for p in files
    }


def cache_folder(package: Path = PACKAGE) -> Path:
    """Where machine code of the kernels as they are now belongs."""
    digest = hashlib.sha256()
    for name, path in kernel_modules(package).items():
        digest.update(f"{name}\n".encode() + path.read_bytes())
    return package / "__pycache__" / f"kernels-{digest.hexdigest()[:16]}"


@cache
def _cache_folder() -> Path | None:
    """The cache folder, or a copy where it cannot be written, or None."""
    folder = cache_folder()
    try:
        folder.mkdir(parents=True, exist_ok=True)
        tempfile.TemporaryFile(dir=folder).close()
        return folder
    except OSError:
        return _copy_of(folder) if folder.is_dir() else None


def _copy_of(folder: Path) -> Path | None:
    try:
        place = tempfile.mkdtemp(prefix="course-kernels-")
    except OSError:
        return None
    atexit.register(shutil.rmtree, place, ignore_errors=True)
    try:
        return Path(shutil.copytree(folder, Path(place) / folder.name))
    except OSError:  # an incomplete copy is no harm: Numba compiles what is missing
        return None


def remove_old_caches(package: Path = PACKAGE) -> None:
    """Delete machine code of kernels as they were before."""
    now = cache_folder(package)
    for folder in now.parent.glob("kernels-*"):
        if folder != now:
            shutil.rmtree(folder, ignore_errors=True)
