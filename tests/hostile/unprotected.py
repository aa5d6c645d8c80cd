"""A grader without any protection, to try that the attacks of the corpus are attacks.

A script, run inside an outer box by ``test_attacks``: its arguments are a folder and the
seed. For every attack it forks a parent, which forks a neighbour and the attacker, each
with a folder as a grader makes it. It writes which harm each of them did.
"""

from __future__ import annotations

import contextlib
import ctypes
import json
import os
import resource
import signal
import sys
import time
from pathlib import Path

import numpy as np

sys.path.insert(0, str(Path(__file__).resolve().parents[1]))
from hostile.reaper import PR_SET_CHILD_SUBREAPER, remaining
from hostile.submission import filled_in
from hostile.surroundings import SECRET, Surroundings, remove, shared_segments

SECONDS = 8.0
MEMORY = 3_000_000_000


def main(root: Path) -> None:
    ctypes.CDLL(None).prctl(PR_SET_CHILD_SUBREAPER, 1, 0, 0, 0)
    attacks = json.loads((root / "attacks").read_text())
    done = {}
    for index, (name, source) in enumerate(attacks.items()):
        around = Surroundings(root / str(index))
        around.listen()
        done[name] = _try(name, source, around)
        around.listeners.close()
        remove(around.root)
    (root / "done").write_text(json.dumps(done))


def _try(name: str, source: str, around: Surroundings) -> dict[str, str]:
    """The harms that an attack did, each with a word on it."""
    source = filled_in(source, around.places(name))
    nina = around.handed_in / "Nina" / "90-toy.ipynb"
    nina.parent.mkdir()
    text = f"def twice(x): return 2 * x  # {SECRET}"
    nina.write_text(json.dumps({"cells": [{"source": text}]}))
    around.table.write_text(
        f"file,seed,total\n{name},{around.places(name)['seed']},0,7,marked"
    )
    around.pages.mkdir()
    (around.pages / "Nina--90-toy.html").touch()
    before, table, shared = (
        around.watched(),
        around.table.read_text(),
        shared_segments(),
    )
    parent = os.fork()
    if parent == 0:
        os.setsid()
        try:
            _parent(source, around)
        except BaseException:
            os._exit(1)
    code = _wait(parent, SECONDS + 2)
    harms = {}
    if left := remaining(0.8):
        harms["left"] = left[0]
    if shared_segments() != shared:
        harms["left"] = "shared memory"
    said = (around.root / "said").read_text(errors="replace")
    if SECRET in said or around.won(name) in said:
        harms["told"] = said
    if code != 0:
        harms["parent" if code != 7 else "neighbour"] = f"{code}"
    after = around.watched()
    changed = [p for p in before.keys() | after.keys() if before.get(p) != after.get(p)]
    if not around.table.exists() or around.table.read_text() != table:
        changed.append("the table")
    if os.stat(around.pages / "Nina--90-toy.html").st_size:
        changed.append("the pages")
    if set(os.listdir(around.tmp)) - {"course-a", "course-b"}:
        changed.append("the folder for temporary files")
    if changed:
        harms["changed"] = str(changed[:3])
    if heard := around.listeners.heard():
        harms["heard"] = str(heard[:2])
    return harms | {"said": said[-300:]}


def _parent(source: str, around: Surroundings) -> None:
    """The grader: starts a neighbour and the attacker, and ends with what became of it."""
    folders = [around.tmp / f"course-{letter}" for letter in "ab"]
    for folder in folders:
        (folder / "work").mkdir(parents=True)
        (folder / "job").write_text("the job")
        (folder / "stage").write_text("ready")
        (folder / "reply").write_text("the reply")
    neighbour = os.fork()
    if neighbour == 0:
        _neighbour(folders[0])
    attacker = os.fork()
    if attacker == 0:
        _attacker(source, folders[1], around)
    _wait(attacker, SECONDS)
    (folders[0].parent.parent / "go").touch()
    os._exit(7 if _wait(neighbour, 3.0) else 0)


def _neighbour(folder: Path) -> None:
    for _ in range(200):
        time.sleep(0.05)
        if (folder.parent.parent / "go").exists():
            break
    with contextlib.suppress(OSError):
        if [(folder / n).read_text() for n in ("job", "reply")] == [
            "the job",
            "the reply",
        ]:
            (folder / "reply").write_text("a longer reply")
            bytes(10**7)
            os._exit(0)
    os._exit(1)


def _attacker(source: str, folder: Path, around: Surroundings) -> None:
    os.setsid()
    os.chdir(folder / "work")
    os.environ["TMPDIR"] = str(folder / "work")
    said = os.open(around.root / "said", os.O_WRONLY | os.O_CREAT)
    for number in (1, 2):
        os.dup2(said, number)
    resource.setrlimit(resource.RLIMIT_AS, (MEMORY, MEMORY))
    resource.setrlimit(resource.RLIMIT_CORE, (0, 0))
    names = {"np": np, "__name__": "__main__"}
    try:
        exec(source, names)
        result = repr(names["twice"](np.array([1.0, 2.0, 4.0])))
    except BaseException as error:
        result = f"{type(error).__name__}: {error}"
    sys.stdout.flush()
    os.write(said, result[:5000].encode("utf-8", "replace"))
    os._exit(0)


def _wait(pid: int, seconds: float) -> int:
    """The exit code of a child, negative for a signal, -99 where it was ended here."""
    deadline = time.monotonic() + seconds
    while time.monotonic() < deadline:
        done, status = os.waitpid(pid, os.WNOHANG)
        if done:
            return os.waitstatus_to_exitcode(status)
        time.sleep(0.01)
    os.kill(pid, signal.SIGKILL)
    os.waitpid(pid, 0)
    return -99


if __name__ == "__main__":
    main(Path(sys.argv[1]))
