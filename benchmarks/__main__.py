"""Print the table of ratios beside the stored ones; ``python -m benchmarks [NAME ...]`` measures the modules named.

``--csv FILE`` also writes the table, with the machine, as ``baseline.csv`` was written.
"""

from __future__ import annotations

import os

for _variable in ("OPENBLAS_NUM_THREADS", "MKL_NUM_THREADS", "OMP_NUM_THREADS"):
    os.environ[_variable] = (
        "1"  # before NumPy is loaded: two threads make small solves slower, and ratios random
    )

import argparse  # noqa: E402
import csv  # noqa: E402
import datetime  # noqa: E402
import importlib  # noqa: E402
import importlib.metadata  # noqa: E402
import math  # noqa: E402
import pkgutil  # noqa: E402
import platform  # noqa: E402
from pathlib import Path  # noqa: E402

from rich.console import Console  # noqa: E402
from rich.table import Table  # noqa: E402

from benchmarks.measure import Row  # noqa: E402

NOT_MEASUREMENTS = {"__main__", "measure"}
BASELINE = Path(__file__).with_name("baseline.csv")
COLUMNS = ("module", "what", "ratio", "goal", "remark", "machine", "versions", "date")


def main() -> None:
    """Measure every module of this folder that has ``rows()``, one after the other."""
    found = sorted(m.name for m in pkgutil.iter_modules([str(Path(__file__).parent)]))
    modules = [n for n in found if n not in NOT_MEASUREMENTS]
    parser = argparse.ArgumentParser(prog="python -m benchmarks")
    parser.add_argument("names", nargs="*", metavar="NAME", choices=[[], *modules])
    parser.add_argument("--csv", type=Path)
    told = parser.parse_args()
    measured = [
        (name, row)
        for name in told.names or modules
        for row in importlib.import_module(f"benchmarks.{name}").rows()
    ]
    Console(width=160).print(_table(measured, _stored()))
    if told.csv:
        _write(told.csv, measured)


def _table(
    measured: list[tuple[str, Row]], stored: dict[tuple[str, str], str]
) -> Table:
    title = "ratios measured in one run, one BLAS thread"
    table = Table("what", "ratio", "stored", "goal", "", "remark", title=title)
    for module, row in measured:
        ratio = "" if math.isnan(row.ratio) else f"{row.ratio:.3g}"
        met = "✓" if row.goal is not None and row.ratio >= row.goal else "below"
        table.add_row(
            f"{module}: {row.name}",
            ratio,
            stored.get((module, row.name), ""),
            "" if row.goal is None else f"{row.goal:g}",
            met if ratio and row.goal is not None else "",
            row.remark,
        )
    return table


def _stored() -> dict[tuple[str, str], str]:
    with BASELINE.open(encoding="utf-8", newline="") as file:
        return {(r["module"], r["what"]): r["ratio"] for r in csv.DictReader(file)}


def _write(path: Path, measured: list[tuple[str, Row]]) -> None:
    about = (_machine(), _versions(), datetime.date.today().isoformat())
    with path.open("w", encoding="utf-8", newline="") as file:
        writer = csv.writer(file, lineterminator="\n")
        writer.writerow(COLUMNS)
        for module, row in measured:
            goal = "" if row.goal is None else f"{row.goal:g}"
            writer.writerow(
                [module, row.name, f"{row.ratio:.3g}", goal, row.remark, *about]
            )


def _machine() -> str:
    name = platform.processor() or platform.machine()
    told = Path("/proc/cpuinfo")
    if told.exists():
        models = [
            li for li in told.read_text().splitlines() if li.startswith("model name")
        ]
        name = models[0].partition(":")[2].strip() if models else name
    return f"{name}, {os.cpu_count()} cores, {platform.system()}"


def _versions() -> str:
    numbers = [f"{n} {importlib.metadata.version(n)}" for n in ("numpy", "scipy")]
    return ", ".join([f"Python {platform.python_version()}", *numbers])


if __name__ == "__main__":
    main()
