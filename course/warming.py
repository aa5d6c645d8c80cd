"""``python -m course.warming``: compile every loop ahead, so that nobody waits for a compiler.

Set-up runs it. Without Numba there is nothing to compile, and it says so.
"""

from __future__ import annotations

import importlib
import time

from course import jit


def warm() -> int:
    """Call every kernel module's ``warm``; returns how many there are."""
    jit.remove_old_caches()
    names = jit.kernel_modules()
    for name in names:
        importlib.import_module(name).warm()
    return len(names)


def main() -> None:
    """What set-up runs."""
    begin = time.perf_counter()
    count = warm()
    print(f"{count} kernel modules, {time.perf_counter() - begin:.1f} s")


if __name__ == "__main__":
    main()
