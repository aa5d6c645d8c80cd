"""Which mutants of a formula pass its exercise's cases, found out in a process that may be lost."""

import json
import os
import queue
import subprocess
import sys
import threading
from collections.abc import Sequence
from pathlib import Path

from exercises.mutants import Mutant

from course.exercises.definition import Exercise

ROOT = Path(__file__).resolve().parents[2]
WORKER = Path(__file__).with_name("mutant_worker.py")
SEEDS = (None, 1, 20_261, 987_654_321)
PATIENCE = 60.0  # seconds without a line, for what the process cannot end by itself


def passing(
    exercise: Exercise,
    mutants: Sequence[Mutant],
    seeds: Sequence[int | None] = SEEDS,
    patience: float = PATIENCE,
) -> dict[tuple[str, str], str]:
    """The mutants that pass with at least one of the seeds: key -> a digit a seed, 1 where it passes."""
    lines: list[str] = []
    while len(lines) < len(mutants):
        sources = [m.source for m in mutants[len(lines) :]]
        got = _answers(exercise, sources, seeds, patience)
        if not got and not _answers(exercise, sources[1:2], seeds, patience):
            raise RuntimeError(f"no mutant of {exercise.name} could be run")
        lines += got
        if len(lines) < len(mutants):
            lines.append("0" * len(seeds))  # the one that stopped the process
    return {m.key: line for m, line in zip(mutants, lines, strict=True) if "1" in line}


def _answers(exercise, sources, seeds, patience) -> list[str]:
    """The lines of one process, as many as it came to write."""
    work = {"exercise": exercise.name, "seeds": seeds, "sources": sources}
    paths = os.pathsep.join([str(ROOT), os.environ.get("PYTHONPATH", "")])
    threads = dict.fromkeys(("OPENBLAS_NUM_THREADS", "OMP_NUM_THREADS"), "1")
    with subprocess.Popen(
        [sys.executable, str(WORKER)],
        stdin=subprocess.PIPE,
        stdout=subprocess.PIPE,
        stderr=subprocess.DEVNULL,
        env={**os.environ, "PYTHONPATH": paths, **threads},
        text=True,
    ) as process:
        process.stdin.write(json.dumps(work) + "\n")
        process.stdin.close()
        written: queue.Queue = queue.Queue()

        def read() -> None:
            for line in process.stdout:
                written.put(line.strip())
            written.put(None)

        threading.Thread(target=read, daemon=True).start()
        lines: list[str] = []
        try:
            while (line := written.get(timeout=patience)) is not None:
                lines.append(line)
        except queue.Empty:
            pass
        process.kill()
    return lines
