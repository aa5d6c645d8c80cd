"""Print the table of ratios; ``python -m benchmarks [NAME ...]`` measures only the modules named."""

from __future__ import annotations

import os

for _variable in ("OPENBLAS_NUM_THREADS", "MKL_NUM_THREADS", "OMP_NUM_THREADS"):
    os.environ[_variable] = (
        "1"  # before NumPy is loaded: two threads make small solves slower, and ratios random
    )

import importlib  # noqa: E402
import math  # noqa: E402
import pkgutil  # noqa: E402
import sys  # noqa: E402
from pathlib import Path  # noqa: E402

from rich.console import Console  # noqa: E402
from rich.table import Table  # noqa: E402

NOT_MEASUREMENTS = {"__main__", "measure"}


def main(names: list[str]) -> None:
    """Measure every module of this folder that has ``rows()``, one after the other."""
    found = sorted(m.name for m in pkgutil.iter_modules([str(Path(__file__).parent)]))
    wanted = names or [n for n in found if n not in NOT_MEASUREMENTS]
    table = Table(
        "what",
        "ratio",
        "goal",
        "",
        "remark",
        title="ratios measured in one run, one BLAS thread",
    )
    for name in wanted:
        for row in importlib.import_module(f"benchmarks.{name}").rows():
            measured = "" if math.isnan(row.ratio) else f"{row.ratio:.3g}"
            met = (
                ""
                if row.goal is None or not measured
                else ("✓" if row.ratio >= row.goal else "below")
            )
            table.add_row(
                f"{name}: {row.name}",
                measured,
                "" if row.goal is None else f"{row.goal:g}",
                met,
                row.remark,
            )
    Console(width=150).print(table)


if __name__ == "__main__":
    main(sys.argv[1:])
