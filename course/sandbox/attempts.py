"""What a notebook's process tried and was refused, and where it is no more what the student's kernel was."""

from __future__ import annotations

from course.sandbox.messages import TRIED, send

#: Attempts told, each once; more of them say nothing new.
MOST_ATTEMPTS = 20
#: Commands that only look or install: refused like all, but nobody's attempt at anything.
LOOKING = frozenset(
    "ls dir pwd cd echo cat head tail wc which where date uname nproc free df du whoami hostname nvidia-smi lscpu "
    "pip pip3 conda mamba uv".split()
)
#: In the place of a cell's number: the answer itself.
IN_THE_ANSWER = -2
#: What is refused and yet may be a part of honest work: other programs, the network, files and libraries elsewhere.
HONEST = (
    "subprocess.", "os.system", "socket.", "the command ", "http.", "writing to ", "reading ", "opening the folder ",
    "ctypes.dlopen",
)  # fmt: skip
#: What makes more of a command than its first word.
JOINING = frozenset(";|&<>`$")


class Attempts:
    """Tells of what was tried and refused, at once: what was told cannot be taken back.

    ``unlike`` keeps for each cell what it wanted that is not here: what comes of it is not what came in the kernel.
    """

    def __init__(self, pipe: int) -> None:
        self._pipe, self._told = pipe, set[str]()
        self.count = 0
        self.cell = -1
        self.unlike: dict[int, str] = {}

    def __call__(self, attempt: str) -> None:
        """Something was tried, and refused."""
        self.count += 1
        if attempt.startswith(HONEST):
            self.miss(attempt)
        if attempt not in self._told and len(self._told) < MOST_ATTEMPTS:
            self._told.add(attempt)
            send(self._pipe, TRIED, attempt.encode("utf-8", "replace"))

    def miss(self, what: str) -> None:
        """Something is not here that may have been there for the student; it is told to nobody."""
        self.count += 1
        self.unlike.setdefault(self.cell, what)

    def command(self, command: str, *, wanted: bool) -> None:
        """A command of the shell, which is not run; ``wanted`` where its output is."""
        told = f"the command {command.strip()}"[:100]
        if not all(map(_looks, filter(str.strip, command.splitlines()))):
            self(told)
        elif wanted:
            self.miss(told)


def _looks(command: str) -> bool:
    first, *others = command.split() or [""]
    away = any(word.startswith(("/", "~")) or ".." in word for word in others)
    return first in LOOKING and not away and not JOINING.intersection(command)
