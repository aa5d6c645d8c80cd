"""How the process of a submission is isolated: by bubblewrap, else not at all.

bubblewrap (github.com/containers/bubblewrap) starts a program in its own namespaces: it
sees no other process, no network and no file but those named here, and it dies with the
grader. It is used on Linux wherever a probe run with it succeeds; some containers and
distributions forbid namespaces. Without it a submission runs with the grader's rights,
and ``Isolation.trusted`` says so.
"""

from __future__ import annotations

import json
import os
import shutil
import sys
import sysconfig
from collections.abc import Sequence
from dataclasses import dataclass
from functools import cache
from pathlib import Path

PACKAGE = Path(__file__).resolve().parents[1]
ROOT = PACKAGE.parent
#: All of the course that the child imports, to run answers and to try repairs, and all of it that the box contains.
CHILD_FILES = (
    "course/__init__.py",
    "course/exercises/__init__.py",
    "course/exercises/answer.py",
    "course/exercises/definition.py",
    "course/exercises/expressions.py",
    "course/exercises/notebook_file.py",
    "course/exercises/question.py",
    "course/exercises/repair/__init__.py",
    "course/exercises/repair/brackets.py",
    "course/exercises/repair/changes.py",
    "course/exercises/repair/edits.py",
    "course/exercises/repair/missing.py",
    "course/exercises/repair/names.py",
    "course/exercises/repair/places.py",
    "course/exercises/repair/recipe.py",
    "course/exercises/repair/statements.py",
    "course/exercises/repair/taken_for.py",
    "course/exercises/repair/texts.py",
    "course/exercises/repair/too_many.py",
    "course/exercises/source/__init__.py",
    "course/exercises/source/cells.py",
    "course/exercises/source/names.py",
    "course/exercises/source/parsing.py",
    "course/exercises/source/statements.py",
    "course/sandbox/__init__.py",
    "course/sandbox/attempts.py",
    "course/sandbox/cells.py",
    "course/sandbox/child.py",
    "course/sandbox/ending.py",
    "course/sandbox/forks.py",
    "course/sandbox/guard.py",
    "course/sandbox/leaning.py",
    "course/sandbox/limits.py",
    "course/sandbox/magics.py",
    "course/sandbox/messages.py",
    "course/sandbox/notebook_shell.py",
    "course/sandbox/plan.py",
    "course/sandbox/seccomp.py",
    "course/sandbox/serving.py",
    "course/sandbox/serving_repairs.py",
    "course/sandbox/stand_ins.py",
    "course/sandbox/trying.py",
    "course/sandbox/watching.py",
    "course/sandbox/wire.py",
)
#: Where these are mounted, and where the one writable folder is.
FILES_IN_BOX, WORK_IN_BOX = "/box-of-course/files", "/box-of-course/work"
DEVICES = ("/dev/null", "/dev/zero", "/dev/urandom", "/dev/random")
LIBRARIES = ("/lib", "/lib64", "/lib32", "/usr/lib", "/usr/lib64", "/usr/lib32")
KEPT_ENVIRONMENT = (
    "PATH LD_LIBRARY_PATH DYLD_LIBRARY_PATH DYLD_FALLBACK_LIBRARY_PATH "
    "SYSTEMROOT SYSTEMDRIVE WINDIR"
).split()


@dataclass(frozen=True)
class Isolation:
    """How submissions are isolated on this machine, in words.

    ``boxed`` where no submission has the grader's rights.
    """

    boxed: bool
    parts: tuple[str, ...]
    #: Why there is no box; empty where there is one.
    reason: str = ""

    def __str__(self) -> str:
        return ("" if self.boxed else "trusted: ") + ", ".join(self.parts)


@dataclass(frozen=True)
class Start:
    """How to start a child: its command line, environment and folder."""

    command: tuple[str, ...]
    environment: dict[str, str]
    folder: str


def start_in_box(memory_mb: int, file_mb: int) -> Start:
    """How to start a child in a box.

    Everything in it is read-only except one folder in memory, of ``file_mb``.
    """
    program = bubblewrap()
    if program is None:
        raise FileNotFoundError("bubblewrap (bwrap) is not installed")
    places = {"root": FILES_IN_BOX, "path": _packages(), "work": WORK_IN_BOX, "closed": [],
            "boxed": True}  # fmt: skip
    child = f"{FILES_IN_BOX}/course/sandbox/child.py"
    command = (program, *_walls(file_mb), "--", *_python(child, places))
    return Start(command, {"PATH": os.environ.get("PATH", "")}, "/")


def start_plain(work: Path, file: str = "child.py") -> Start:
    """The start of a child without a box, with ``work`` as its folder; ``file`` is what it runs."""
    places = {"root": str(ROOT), "path": _packages(), "work": str(work),
            "closed": [str(PACKAGE), str(ROOT / "solutions")], "boxed": False}  # fmt: skip
    child = str(PACKAGE / "sandbox" / file)
    kept = {name: os.environ[name] for name in KEPT_ENVIRONMENT if name in os.environ}
    environment = {**kept, **_environment(str(work))}
    return Start(_python(child, places), environment, str(work))


@cache
def bubblewrap() -> str | None:
    """Where bubblewrap is, on Linux."""
    return shutil.which("bwrap") if sys.platform.startswith("linux") else None


def _python(child: str, places: object) -> tuple[str, ...]:
    """Python without the user's settings: no site, no environment, no byte code
    written.
    """
    program = os.path.realpath(sys.executable)
    return (program, "-I", "-S", "-B", "-X", "utf8", child, json.dumps(places))


def _environment(work: str) -> dict[str, str]:
    """Every folder that programs look up in the environment is the child's own; one
    thread.
    """
    places = dict.fromkeys(
        ("HOME", "USERPROFILE", "TMPDIR", "TMP", "TEMP", "MPLCONFIGDIR"), work
    )
    threads = dict.fromkeys(
        ("OPENBLAS_NUM_THREADS", "OMP_NUM_THREADS", "MKL_NUM_THREADS"), "1"
    )
    more = {"MPLBACKEND": "Agg", "LANG": "C.UTF-8", "LC_ALL": "C.UTF-8"}
    return {**places, **threads, **more}


def _walls(file_mb: int) -> list[str]:
    """bubblewrap's options: namespaces, no capabilities, readable files, writable
    folder.
    """
    walls = ["--unshare-all", "--unshare-user", "--uid", "65534", "--gid", "65534"]
    walls += ["--hostname", "box", "--die-with-parent", "--new-session"]
    walls += ["--cap-drop", "ALL", "--clearenv"]
    for place in _readable():
        link = os.path.islink(place)  # /lib, where it is a part of /usr
        walls += ["--symlink", os.readlink(place)] if link else ["--ro-bind", place]
        walls += [place]
    for hidden in _hidden():
        walls += ["--tmpfs", hidden, "--remount-ro", hidden]
    for name in CHILD_FILES:
        walls += ["--ro-bind", str(ROOT / name), f"{FILES_IN_BOX}/{name}"]
    for device in filter(os.path.exists, DEVICES):
        walls += ["--dev-bind", device, device]
    walls += ["--size", str(file_mb * 1_000_000), "--tmpfs", WORK_IN_BOX]
    # Where the interpreter itself lies below /tmp that folder is there already, and stays empty else.
    if not any(place.startswith("/tmp/") for place in _readable()):
        walls += ["--symlink", WORK_IN_BOX, "/tmp"]
    walls += ["--remount-ro", "/"]
    for name, value in _environment(WORK_IN_BOX).items():
        walls += ["--setenv", name, value]
    if kept := os.environ.get("LD_LIBRARY_PATH"):
        walls += ["--setenv", "LD_LIBRARY_PATH", kept]
    return [*walls, "--chdir", WORK_IN_BOX]


@cache
def _readable() -> tuple[str, ...]:
    """The interpreter, its libraries and its packages, outermost folders first, no
    repeats.
    """
    program = os.path.realpath(sys.executable)
    wanted = [*LIBRARIES, program, *_packages()]
    wanted += [sysconfig.get_path("stdlib"), sysconfig.get_path("platstdlib")]
    own = os.path.join(sys.base_prefix, "lib")
    if sys.base_prefix not in ("/", "/usr", "/usr/local"):
        wanted.append(
            own
        )  # shared libraries of a separately installed interpreter (pyenv, conda)
    else:
        library = sysconfig.get_config_var("LDLIBRARY") or ""
        wanted.append(os.path.join(sysconfig.get_config_var("LIBDIR") or own, library))
    wanted += (os.environ.get("LD_LIBRARY_PATH") or "").split(os.pathsep)
    there = sorted({p.rstrip("/") for p in wanted if p and os.path.exists(p)}, key=len)
    kept: list[str] = []
    for place in there:
        if not any(place == k or place.startswith(k + "/") for k in kept):
            kept.append(place)
    return tuple(kept)


@cache
def _packages() -> list[str]:
    """Where packages are imported from: the interpreter's folders and those for
    packages.

    The checkout and the grader's working folder are left out: they hold files that a
    submission must not see.
    """
    homes = {Path(sys.prefix), Path(sys.base_prefix)}
    ours = {ROOT, PACKAGE}
    packages = [
        p
        for p in sys.path
        if p
        and Path(p).resolve() not in ours
        and (
            not homes.isdisjoint(Path(p).parents)
            or not {"site-packages", "dist-packages"}.isdisjoint(Path(p).parts)
        )
    ]
    if "site-packages" in ROOT.parts:
        packages.append(str(ROOT))
    return [p for p in packages if os.path.exists(p)]


def _hidden() -> Sequence[str]:
    """The course where it is installed among the packages."""
    return [str(PACKAGE)] if "site-packages" in ROOT.parts else []
