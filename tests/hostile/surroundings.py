"""What lies around a batch and must stay as it is: secrets, canaries, listeners, a copy of the course.

Every attack aims at these places and at nothing else, so that one that succeeds is seen
and does no harm.
"""

from __future__ import annotations

import contextlib
import hashlib
import os
import shutil
import socket
import sqlite3
import stat
import subprocess
from pathlib import Path

COURSE = Path(__file__).resolve().parents[2] / "course"
TOYS = Path(__file__).resolve().parents[1] / "grading" / "toy_lessons.py"
SECRET = "KEEP-this-to-yourself-4f1d7a"
SEED = "2718281828"
KEPT = "as it was"
#: Shared memory of System V, which outlives every process.
SHARED = [Path("/proc/sysvipc", kind) for kind in ("sem", "shm", "msg")]


class Surroundings:
    """The places around a batch below one folder, and whether they are as they were."""

    def __init__(self, root: Path) -> None:
        self.root = root
        self.handed_in = root / "handed in"
        self.table = root / "out" / "grades.csv"
        self.pages = root / "out" / "grades-feedback"
        self.home, self.site = root / "home", root / "site"
        self.checkout, self.tmp = root / "checkout", root / "tmp"
        for folder in (self.handed_in, self.table.parent, self.home / ".ssh", self.site,
                       self.tmp, self.checkout / "solutions", root / "canaries"):  # fmt: skip
            folder.mkdir(parents=True)
        for file in (".ssh/id_ed25519", ".netrc", ".bashrc"):
            (self.home / file).write_text(SECRET)
        with contextlib.closing(sqlite3.connect(self.home / ".db")) as base:
            base.execute(f"create table t as select '{SECRET}' as a")
            base.commit()
        (self.checkout / "solutions" / "90-toy.ipynb").write_text(
            '{"cells": [{"source": "twice = lambda x: 2 * x"}], "x": "' + SECRET + '"}'
        )
        shutil.copytree(COURSE, self.checkout / "course")
        shutil.copy(TOYS, self.checkout / "course" / "exercises" / "definitions")

    def places(self, name: str) -> dict[str, str]:
        """Where the attack of this name finds what it aims at; its canary is its own."""
        canary = self.root / "canaries" / name
        canary.mkdir(exist_ok=True)
        (canary / "kept").write_text(KEPT)
        ports = self.listeners.addresses
        return {
            "secret": str(self.home / ".ssh" / "id_ed25519"), "canary": str(canary),
            "neighbour": str(self.handed_in / "Nina" / "90-toy.ipynb"),
            "table": str(self.table), "pages": str(self.pages), "home": str(self.home),
            "handed_in": str(self.handed_in), "checkout": str(self.checkout),
            "site": str(self.site), "tmp": str(self.tmp), "seed": SEED,
            "won": self.won(name), "pids": _pid_space(), "word": f"heard-{name}", **ports,
        }  # fmt: skip

    def won(self, name: str) -> str:
        """The word by which the attack of this name tells that it succeeded."""
        return "won-" + hashlib.sha256(name.encode()).hexdigest()[:12]

    def listen(self) -> None:
        """Open the listeners; addresses are in ``places`` from then on."""
        self.listeners = Listeners(self.home / "socket")

    def watched(self) -> dict[str, str]:
        """Every file that must not change, with a digest of what it is."""
        folders = (self.handed_in, self.home, self.site, self.checkout,
                   self.root / "canaries")  # fmt: skip
        found = {}
        for top in folders:
            for place, names, files in os.walk(top):
                for name in (*names, *files):
                    path = Path(place, name)
                    found[str(path.relative_to(self.root))] = _digest(path)
        return found

    def left(self) -> list[str]:
        """What lies in the folder for temporary files, and shared memory of System V."""
        return sorted(os.listdir(self.tmp)) + shared_segments()


def _pid_space() -> str:
    """The name of this process's PID namespace, where there is such a thing."""
    try:
        return os.readlink("/proc/self/ns/pid")
    except OSError:
        return "none"


def remove(folder: Path) -> None:
    """Remove a folder, however deep folders in it lie: Python's own way ends at a thousand."""
    subprocess.run(["rm", "-rf", str(folder)], check=False)


def shared_segments() -> list[str]:
    """One line for each semaphore, segment and queue that the system keeps."""
    lines = []
    for file in SHARED:
        with contextlib.suppress(OSError):
            lines += [
                f"{file.name} {' '.join(line.split()[:2])}"
                for line in file.read_text().splitlines()[1:]
            ]
    return lines


def _digest(path: Path) -> str:
    told = path.lstat()
    kind = f"{stat.filemode(told.st_mode)} {told.st_nlink if path.is_file() else ''}"
    if stat.S_ISREG(told.st_mode) and os.access(path, os.R_OK):
        return f"{kind} {told.st_mtime} {hashlib.sha256(path.read_bytes()).hexdigest()}"
    return kind


class Listeners:
    """Sockets of five kinds that ought to hear nothing."""

    def __init__(self, path: Path) -> None:
        abstract = f"hostile-{os.getpid()}-{id(self)}"
        self.streams, self.datagrams, self.addresses = [], [], {}
        for kind, open_ones in (
            (socket.SOCK_STREAM, self.streams),
            (socket.SOCK_DGRAM, self.datagrams),
        ):
            over_ip = socket.socket(socket.AF_INET, kind)
            over_ip.bind(("127.0.0.1", 0))
            open_ones.append(over_ip)
            ending = "" if kind == socket.SOCK_STREAM else "-datagram"
            for address in (f"{path}{ending}", f"\0{abstract}{ending}"):
                with contextlib.suppress(OSError, AttributeError):
                    one = socket.socket(socket.AF_UNIX, kind)
                    one.bind(address)
                    open_ones.append(one)
        for one in self.streams:
            one.listen(50)
        for one in self.streams + self.datagrams:
            one.setblocking(False)
        self.addresses = {
            "port": str(self.streams[0].getsockname()[1]),
            "udp": str(self.datagrams[0].getsockname()[1]),
            "unix": str(path),
            "abstract": abstract,
        }

    def heard(self) -> list[str]:
        """What came in since the last call; a connection alone counts too."""
        words = []
        for one in self.streams:
            with contextlib.suppress(BlockingIOError):
                while True:
                    connection, _ = one.accept()
                    connection.settimeout(0.2)
                    with contextlib.suppress(OSError):
                        words.append("connection: " + repr(connection.recv(200)))
                    connection.close()
        for one in self.datagrams:
            with contextlib.suppress(BlockingIOError):
                while True:
                    words.append("datagram: " + repr(one.recv(200)))
        return words

    def close(self) -> None:
        for one in self.streams + self.datagrams:
            one.close()
