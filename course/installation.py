"""Make ``.venv`` from the lock: create, install, link the project, compile, stamp.

Standard library only. Every step may be interrupted: the stamp is written last,
a folder without one is made anew by the next call, and one that only lags
behind its lock is brought up to date in place (pip fetches everything before it
changes anything, so that without a network the old packages stay whole).
"""

from __future__ import annotations

import contextlib
import errno
import importlib.util
import json
import os
import re
import shutil
import subprocess
import sys
import time
from collections.abc import Iterator
from pathlib import Path

from course.environment import (
    LOCK,
    LOCK_WITH_EXTRAS,
    MARKER,
    STAMP,
    START,
    SetupError,
    is_ours,
    read_stamp,
    stamp_for,
    state,
    venv_python,
)

LOG = "setup.log"
PYTHON = f"{sys.version_info.major}.{sys.version_info.minor}"
BEGINNING = {
    "absent": "Setting up",
    "unfinished": "Completing the set-up of",
    "stale": "Renewing",
}
SPACE_NEEDED = 1.7e9  # bytes: 1.3 GB stay, the rest is pip's while it unpacks
LONGEST_FILE = (
    160  # characters below .venv on Windows (JupyterLab's fonts), see test_environment
)
WINDOWS_LIMIT = 259
COMPILE_NOT = r"[\\/](tests|benchmarks)[\\/]"

MODULES = (
    f"on Debian and Ubuntu run sudo apt install python{PYTHON}-venv, elsewhere install Python from "
    "https://www.python.org"
)
IN_USE = (
    "Files in {venv} are in use or may not be changed: close every JupyterLab of this workbook and leave the "
    "environment (deactivate); if the project lies where you may not write, copy it to your home folder."
)

# What pip's output tells, in the order in which it is looked for, and the sentence for it.
FAILURES = [
    (
        r"No space left on device|\[Errno 28\]|WinError 112|not enough space on the disk|[Qq]uota exceeded",
        "The disk is full: the set-up needs about 1.7 GB in {venv} and some in the temporary folder. "
        "Make room and run {start} again.",
    ),
    (
        r"DO NOT MATCH THE HASHES",
        "A downloaded package is not the one this project was tested with ({detail}), so nothing was installed. "
        "Run {start} again; if it stays, your package index serves altered files: use another.",
    ),
    (
        r"[Ll]ong [Pp]ath support|WinError 206|[Ff]ile ?name too long",
        "The folder's path is too long: move the project to a shorter one, such as {short}, and run {start} again.",
    ),
    (
        r"Failed to establish a new connection|NameResolutionError"
        r"|Temporary failure in name resolution|getaddrinfo failed"
        r"|ConnectionError|Connection refused|Connection reset|ConnectTimeout|ReadTimeout|Read timed out|ProxyError"
        r"|CERTIFICATE_VERIFY_FAILED|SSLError",
        "The package index could not be reached: connect to the network (behind a proxy set HTTPS_PROXY) "
        "and run {start} again. Only the first start needs it.",
    ),
    (
        r"satisfies the requirement (?P<detail>\S+) [^\n]*from versions: none",
        "Nothing was found of {detail}: check the network and run {start} again; if that is well, start with 64-bit "
        "Python 3.11 to 3.13 from https://www.python.org instead of {python}.",
    ),
    (
        r"No matching distribution found for (?P<detail>\S+)",
        "There is no ready-made package of {detail} for this Python ({python}): start with 64-bit Python 3.11 to 3.13 "
        "from https://www.python.org.",
    ),
    (
        r"ensurepip is not available|No module named '?(ensurepip|venv)|ensurepip is disabled",
        "This Python cannot make virtual environments: {modules}, then run {start} again.",
    ),
    (
        r"WinError 5|WinError 32|Access is denied|Permission denied",
        "{in_use} Then run {start} again.",
    ),
]


def make(root: str | Path, extras: bool = False) -> None:
    """Bring ``.venv`` of the checkout ``root`` to the state "complete", or raise SetupError with the cure."""
    root = Path(root)
    venv = root / ".venv"
    refuse_foreign(venv)
    require_modules()
    require_short_path(venv)
    try:
        venv.mkdir(exist_ok=True)
        with only_one(venv):
            now = state(str(root), extras)
            if (
                now != "complete"
            ):  # another set-up may have finished while this one waited
                _set_up(root, venv, now, extras)
    except KeyboardInterrupt:
        say(f"\nThe set-up was interrupted. {START} completes it.")
        raise
    except OSError as problem:
        raise SetupError(sentence_for(problem, venv)) from problem


def _set_up(root: Path, venv: Path, now: str, extras: bool) -> None:
    """The steps, in order; the stamp goes first when it would become untrue and comes back last."""
    stamp = read_stamp(str(venv)) or {}
    extras = extras or stamp.get("extras", False)
    want = stamp_for(str(root), extras)
    in_place = (
        now == "stale"
        and same_place(stamp, want)
        and os.path.exists(venv_python(str(venv)))
    )
    started = time.monotonic()
    if in_place:
        say(
            f"Bringing {venv} up to date with the packages that this version of the project needs."
        )
    else:
        require_space(venv)
        say(
            f"{BEGINNING[now]} {venv}: about 1 GB of packages, one to three minutes, only this once. "
            "Ctrl-C is safe, the next start completes it."
        )
        create(venv, want["base"])
    lock = root / (LOCK_WITH_EXTRAS if extras else LOCK)
    python = Path(venv_python(str(venv)))
    install(venv, python, lock, stamp if in_place else None)
    link_project(venv, python, root)
    compile_ahead(venv, python, root)
    warm_kernels(venv, python)
    write_stamp(venv, want)
    say(f"Ready after {time.monotonic() - started:.0f} s.")


def same_place(stamp: dict, want: dict) -> bool:
    """Whether an environment was made here by the Python that would make it now (under whatever name)."""
    same_python = os.path.realpath(stamp.get("base", "")) == os.path.realpath(
        want["base"]
    )
    return same_python and all(
        stamp.get(key) == want[key] for key in ("folder", "python")
    )


# Before anything is touched


def refuse_foreign(venv: Path) -> None:
    """Raise SetupError for a ``.venv`` that this project did not make."""
    if is_ours(str(venv)):
        return
    activate = (
        rf"{venv}\Scripts\activate" if os.name == "nt" else f". {venv}/bin/activate"
    )
    raise SetupError(
        f"{venv} was not made by this project and is left alone. Rename or delete it and run {START} again, "
        f'or, to use it, install the project into it yourself: {activate} && pip install -e ".[workbook,test]"'
    )


def require_modules() -> None:
    """Raise SetupError where Debian and its kin left the venv module out."""
    if all(importlib.util.find_spec(name) for name in ("venv", "ensurepip")):
        return
    raise SetupError(
        f"This Python cannot make virtual environments: {MODULES}, then run {START} again."
    )


def require_short_path(venv: Path, *, windows: bool = os.name == "nt") -> None:
    """Raise SetupError where Windows could not hold the longest file name."""
    excess = len(str(venv)) + LONGEST_FILE - WINDOWS_LIMIT
    if windows and excess > 0 and not long_paths_enabled():
        raise SetupError(
            f"The path {venv.parent} is {excess} characters too long for Windows. Move the project to "
            rf"a shorter one, such as C:\course, and run {START} again."
        )


def long_paths_enabled() -> bool:
    """Whether this Windows was told to allow long paths."""
    try:
        import winreg

        where = r"SYSTEM\CurrentControlSet\Control\FileSystem"
        with winreg.OpenKey(winreg.HKEY_LOCAL_MACHINE, where) as key:  # type: ignore[attr-defined]
            return bool(winreg.QueryValueEx(key, "LongPathsEnabled")[0])  # type: ignore[attr-defined]
    except (ImportError, OSError):
        return False


def require_space(venv: Path) -> None:
    """Raise SetupError when the disk has too little room to begin with."""
    free = shutil.disk_usage(venv).free
    if free < SPACE_NEEDED:
        raise SetupError(
            f"The set-up needs {SPACE_NEEDED / 1e9:.1f} GB and the disk that holds {venv.parent} has "
            f"{free / 1e9:.1f} GB free. Make room and run {START} again."
        )


@contextlib.contextmanager
def only_one(venv: Path) -> Iterator[None]:
    """Hold the marker file's lock: a second set-up waits. The system frees it when its holders end."""
    with open(venv / MARKER, "a+b") as marker:
        waiting = False
        while not _locked(marker):
            if not waiting:
                say("Another set-up of this checkout is running. Waiting for it.")
            waiting = True
            time.sleep(0.3)
        if os.name != "nt":
            os.set_inheritable(
                marker.fileno(), True
            )  # so that pip, should we be killed, keeps the lock
        yield


def _locked(marker) -> bool:
    """Try to lock; a file system that has no locks counts as locked."""
    try:
        if os.name == "nt":
            import msvcrt

            marker.seek(0)
            msvcrt.locking(marker.fileno(), msvcrt.LK_NBLCK, 1)  # type: ignore[attr-defined]
        else:
            import fcntl

            fcntl.flock(marker, fcntl.LOCK_EX | fcntl.LOCK_NB)
    except OSError as problem:
        return problem.errno not in (errno.EAGAIN, errno.EACCES, errno.EDEADLK)
    return True


# The steps


def create(venv: Path, base: str) -> None:
    """An empty environment in ``venv``; all but the marker that was there goes."""
    for entry in venv.iterdir():
        if entry.name == MARKER:
            continue
        if entry.is_dir() and not entry.is_symlink():
            shutil.rmtree(entry)
        else:
            entry.unlink()
    run(venv, [base, "-I", "-m", "venv", "--without-pip", str(venv)])
    run(
        venv, [venv_python(str(venv)), "-I", "-m", "ensurepip", "--default-pip"]
    )  # apart, so that it can say why not


def install(
    venv: Path, python: Path, lock: Path, old_stamp: dict | None = None
) -> None:
    """Install the lock with hashes from the index that the user's pip knows.

    ``old_stamp``, where packages are replaced in place, is taken away meanwhile
    and put back when pip gave up before it changed anything.
    """
    pip = [
        str(python),
        "-I",
        "-u",
        "-m",
        "pip",
        "install",
        "--require-hashes",
        "--only-binary",
        ":all:",
        "--no-compile",
        "--no-input",
        "--disable-pip-version-check",
        "--progress-bar",
        "off",
        "-r",
        str(lock),
    ]
    progress = Progress(lock, python)
    (venv / STAMP).unlink(missing_ok=True)
    try:
        run(venv, pip, progress=progress)
    except BaseException:
        if old_stamp is not None and not progress.changing:
            write_stamp(venv, old_stamp)
        raise


def link_project(venv: Path, python: Path, root: Path) -> None:
    """Install the project itself, editable; its build backend came with the lock."""
    run(
        venv,
        [
            str(python),
            "-I",
            "-m",
            "pip",
            "install",
            "--no-deps",
            "--no-build-isolation",
            "--no-index",
            "--no-input",
            "--disable-pip-version-check",
            "-e",
            str(root),
        ],
    )


def compile_ahead(venv: Path, python: Path, root: Path) -> None:
    """Compile what was installed; without it every first import is two to six times slower.

    A package may hold a file that does not compile on purpose: no reason to stop.
    """
    show("compiling")
    run(
        venv,
        [
            str(python),
            "-I",
            "-m",
            "compileall",
            "-q",
            "-j",
            "0",
            "-x",
            COMPILE_NOT,
            str(site_packages(python)),
            str(root / "course"),
        ],
        may_fail=True,
    )
    show("compiled", end=True)


def warm_kernels(venv: Path, python: Path) -> None:
    """Compile the loops of course/jit.py, some seconds; a failure only means that the first use does it."""
    show("compiling loops")
    run(venv, [str(python), "-I", "-m", "course.warming"], may_fail=True)
    show("compiled loops", end=True)


def write_stamp(venv: Path, stamp: dict) -> None:
    """Say that the set-up is complete: written beside, then moved into place at once."""
    beside = venv / (STAMP + ".new")
    beside.write_text(json.dumps(stamp, indent=1), encoding="utf-8")
    os.replace(beside, venv / STAMP)


def site_packages(python: Path) -> Path:
    """The packages' folder of the environment that ``python`` belongs to."""
    if os.name == "nt":
        return python.parent.parent / "Lib" / "site-packages"
    return python.parent.parent / "lib" / f"python{PYTHON}" / "site-packages"


# Running pip, seeing how far it is, and what went wrong


def run(
    venv: Path,
    command: list[str],
    *,
    progress: Progress | None = None,
    may_fail: bool = False,
) -> None:
    """Run a step with its whole output in the log; SetupError with the cure when it fails."""
    log = venv / LOG
    with open(log, "ab") as out:
        begin = out.tell()
        # close_fds=False: the child inherits the marker's lock, so that no second set-up starts beside
        # a pip that has outlived us. Python's other files are not inheritable.
        child = subprocess.Popen(
            command,
            stdin=subprocess.DEVNULL,
            stdout=out,
            stderr=subprocess.STDOUT,
            env=quiet_environment(),
            close_fds=os.name == "nt",
        )
        try:
            while child.poll() is None:
                time.sleep(0.2)
                if progress is not None:
                    progress.update(_text(log, begin))
        except BaseException:
            child.terminate()
            child.wait()
            raise
        finally:
            if progress is not None:
                progress.update(_text(log, begin))
                progress.end()
    if child.returncode and not may_fail:
        raise SetupError(f"{explain(_text(log, begin), venv)} (The log is {log}.)")


def quiet_environment() -> dict[str, str]:
    """The user's environment, with the index that pip knows, without what would install elsewhere."""
    drop = {
        "PYTHONDONTWRITEBYTECODE",
        "PYTHONHOME",
        "PYTHONPATH",
        "__PYVENV_LAUNCHER__",
        "VIRTUAL_ENV",
        "PIP_TARGET",
        "PIP_PREFIX",
        "PIP_ROOT",
        "PIP_REQUIRE_VIRTUALENV",
    }
    kept = {key: value for key, value in os.environ.items() if key not in drop}
    return {**kept, "PIP_USER": "0", "PIP_REQUIRE_HASHES": "0"}


def _text(log: Path, begin: int) -> str:
    with open(log, "rb") as file:
        file.seek(begin)
        return file.read().decode("utf-8", "replace")


def explain(output: str, venv: Path) -> str:
    """The sentence for what pip said."""
    words = {
        "venv": venv,
        "start": START,
        "python": PYTHON,
        "short": r"C:\course" if os.name == "nt" else "a folder in your home",
        "modules": MODULES,
        "in_use": IN_USE.format(venv=venv),
    }
    for pattern, sentence in FAILURES:
        found = re.search(pattern, output)
        if found:
            detail = (
                found.groupdict().get("detail")
                or _first(r"^\s+(\S+==\S+) from", output)
                or "see the log"
            )
            return sentence.format(detail=detail.split("==")[0], **words)
    return f"The set-up of {venv} failed. Run {START} again."


def _first(pattern: str, text: str) -> str | None:
    found = re.search(pattern, text, flags=re.MULTILINE)
    return found.group(1) if found else None


def sentence_for(problem: OSError, venv: Path) -> str:
    """The sentence for an error of the file system."""
    if problem.errno in (errno.EACCES, errno.EPERM, errno.EROFS):
        return explain("Permission denied", venv)
    return explain(str(problem), venv)


class Progress:
    """How far pip is, read from what it says and from what lies in the packages' folder."""

    def __init__(self, lock: Path, python: Path) -> None:
        self.locked = len(
            re.findall(
                r"^[A-Za-z0-9._-]+==",
                lock.read_text(encoding="utf-8"),
                flags=re.MULTILINE,
            )
        )
        self.packages = site_packages(python)
        self.shown = ""
        self.changing = False

    def update(self, output: str) -> None:
        """Show a new line when something moved."""
        total = self.locked - len(re.findall(r"^Ignoring ", output, flags=re.MULTILINE))
        fetched = re.findall(
            r"^(?:Collecting|Processing|Requirement already satisfied:?) (\S+)",
            output,
            flags=re.MULTILINE,
        )
        if "Installing collected packages" in output:
            self.changing = True
            done = min(total, sum(1 for _ in self.packages.glob("*.dist-info")))
            self.show(f"installing {done} of {total} packages")
        elif fetched:
            name = re.split(r"[=<>\[]", os.path.basename(fetched[-1]))[0].split("-")[0]
            self.show(
                f"fetching {min(len(fetched), total)} of {total} packages: {name}"
            )

    def show(self, line: str) -> None:
        if line != self.shown:
            show(line)
            self.shown = line

    def end(self) -> None:
        if self.shown:
            show(self.shown.split(":")[0], end=True)


def say(text: str) -> None:
    """A line for the person at the keyboard, on stderr: stdout is the command's own."""
    print(text, file=sys.stderr, flush=True)


def show(text: str, end: bool = False) -> None:
    """A line that the next one replaces; where nobody watches, only the last of them."""
    if sys.stderr.isatty():
        width = shutil.get_terminal_size().columns - 1
        print(
            "\r  " + text[: width - 2].ljust(width - 2),
            end="\n" if end else "",
            file=sys.stderr,
            flush=True,
        )
    elif end:
        say("  " + text)
