"""Refuse and report what no answer needs: processes, signals, the network, other files.

An audit hook (PEP 578) is cheap and works on every platform. It raises the cost of an
attack, no more: code written to break it can. In a box it is the witness, so that an
attack is not mistaken for a crash; without a box it is the only protection, and the
report says that submissions were trusted. No mark depends on it: verdicts are not made
in this process.
"""

from __future__ import annotations

import contextlib
import importlib
import os
import sys
from collections.abc import Callable, Iterator, Sequence
from typing import Any

from course.sandbox.seccomp import FCNTL_COMMANDS, IOCTL_COMMANDS

REFUSED = frozenset(
    "os.fork os.forkpty os.exec os.posix_spawn os.spawn os.system os.startfile os.startfile/2 subprocess.Popen "
    "pty.spawn os.kill os.killpg signal.pthread_kill resource.setrlimit resource.prlimit socket.connect socket.bind "
    "socket.getaddrinfo socket.gethostbyname socket.gethostbyaddr socket.getnameinfo socket.sendto socket.sendmsg "
    "ctypes.dlopen ctypes.dlsym ctypes.dlsym/handle ctypes.call_function ctypes.cdata ctypes.PyObj_FromPtr "
    "gc.get_objects gc.get_referrers gc.get_referents cpython.PyInterpreterState_New sys.addaudithook "
    "webbrowser.open _winapi.CreateProcess _winapi.TerminateProcess winreg.CreateKey winreg.SetValue "
    "ftplib.connect http.client.connect smtplib.connect poplib.connect imaplib.open telnetlib.Telnet.open".split()
)
#: What raises no audit event, module by module.
UNTOLD = {
    "os": "mknod mkfifo pidfd_open memfd_create sched_setscheduler sched_setaffinity sched_setparam setpriority nice "
    "chroot unshare setns",
    "signal": "pidfd_send_signal",
    "_posixsubprocess": "fork_exec",
    "_xxsubinterpreters": "create run_string",
}
CHANGES = frozenset(
    "os.remove os.rename os.rmdir os.mkdir os.link os.symlink os.truncate os.chmod os.chown os.lchown os.utime "
    "os.setxattr os.removexattr os.chflags shutil.rmtree".split()
)
TWO_PATHS = frozenset({"os.rename", "os.link", "os.symlink"})
WRITING = os.O_WRONLY | os.O_RDWR | os.O_CREAT | os.O_TRUNC | os.O_APPEND
HERE = os.path.dirname(os.path.realpath(__file__))
#: What runs beside an answer in its process: its lines stand in tracebacks.
LOADED = frozenset(
    [os.path.join(HERE, name) for name in os.listdir(HERE)]
    + [os.path.join(os.path.dirname(HERE), "exercises", "answer.py")]
)
#: Numbers of Linux.
COMMANDS: dict[str, tuple[int, ...]] = (
    {"fcntl.fcntl": FCNTL_COMMANDS, "fcntl.ioctl": IOCTL_COMMANDS}
    if sys.platform.startswith("linux")
    else {}
)
#: Where Python and its packages look for what need not be there: no attempt of a student's.
HARMLESS = (
    "/dev",
    "/sys",
    "/usr",
    "/lib",
    "/etc",
    "/proc/self",
    "/proc/cpuinfo",
    "/proc/meminfo",
    "/proc/stat",
)
#: Programs by which Python and its packages learn where they are (platform, matplotlib's fonts): refused, not told.
LOOKING_UP = frozenset(
    "uname fc-list ldconfig gcc cc ld objdump lsb_release lscpu sysctl system_profiler".split()
)
#: What makes machine code has its addresses from ctypes; it is known by the file its lines stand in.
COMPILERS = ("numba", "llvmlite")
#: A student's numbers and pictures that were left at home.
DATA = tuple(".npy .npz .dat .mat .png .jpg .svg .obj .stl .off .ply .mplstyle".split())
#: Characters of a reported attempt; the rest is cut off.
TOLD = 200

Tell = Callable[[str], None]


def install_guard(
    own: str, closed: Sequence[str], packages: Sequence[str], tell: Tell
) -> _Guard:
    """From now on writing works in the folder ``own`` alone, and the folders ``closed`` cannot be read.

    ``tell`` is called with a description of each refused attempt. Failed look-ups among
    the ``packages`` are Python's own and are not reported.
    """
    guard = _Guard(own, closed, tuple(packages), tell)
    for module, names in UNTOLD.items():
        for name in names.split():
            guard.replace(module, name)
    guard.refuse_folders_by_number()
    sys.addaudithook(guard)
    return guard


class _Guard:
    """The hook: called with every event, raises ``PermissionError`` to refuse it."""

    def __init__(
        self, own: str, closed: Sequence[str], packages: tuple[str, ...], tell: Tell
    ) -> None:
        self._own = os.path.realpath(own)
        self._shut = [os.path.realpath(folder) for folder in closed]
        self._harmless = (*HARMLESS, *filter(None, packages))
        self._compilers = tuple(
            os.path.dirname(sys.modules[name].__file__ or "/dev/null/") + os.sep
            for name in COMPILERS
            if name in sys.modules
        )
        self._tell = tell
        self._aside = False

    @contextlib.contextmanager
    def aside(self) -> Iterator[None]:
        """Stand aside for what is our own to do."""
        self._aside = True
        try:
            yield
        finally:
            self._aside = False

    def __call__(self, event: str, details: tuple[Any, ...]) -> None:
        if self._aside:
            return
        if event in LOOKS and LOOKS[event](*details[:2]):
            raise PermissionError(f"{event} is not allowed while an answer is marked")
        if event.startswith("ctypes.") and self._by_compiler():
            if event == "ctypes.dlopen":  # one way of its to have threads; it has more
                raise PermissionError(f"{event} is not allowed while an answer is marked")  # fmt: skip
            return
        if event in REFUSED:
            self._refuse(event, f"{event} is not allowed while an answer is marked")
        elif event == "open":
            self._open(*details)
        elif event in COMMANDS and details[1] in COMMANDS[event]:
            words = f"{event}({details[1]}) is not allowed while an answer is marked"
            self._refuse(event, words)
        elif event in CHANGES:
            for path in details[: 2 if event in TWO_PATHS else 1]:
                if isinstance(path, (str, bytes, os.PathLike)):
                    self._require_inside(path)

    def _by_compiler(self) -> bool:
        """Whether it is a compiler's own call: the first caller beyond ctypes tells."""
        if not self._compilers:
            return False
        frame = sys._getframe(2)
        while frame.f_back and frame.f_globals.get("__name__") == "ctypes":
            frame = frame.f_back
        return frame.f_code.co_filename.startswith(self._compilers)

    def _refuse(self, attempt: str, words: str) -> None:
        self._tell(attempt[:TOLD])
        raise PermissionError(words)

    def _open(self, path: Any, mode: Any, flags: Any) -> None:
        if not isinstance(path, (str, bytes, os.PathLike)):
            return  # the descriptor of an open file
        if isinstance(flags, int) and flags & WRITING:
            self._require_inside(path)
            return
        place = os.path.realpath(os.fsdecode(path))
        if any(_is_in(place, folder) for folder in self._shut):
            words = "the course's own files cannot be read while an answer is marked"
            if place in LOADED:  # by Python, for the lines of a traceback
                raise PermissionError(words)
            self._refuse(f"reading {place}", words)
        if mode is None and os.path.isdir(place) and not _is_in(place, self._own):
            words = f"a folder outside the working folder cannot be opened: {place}"
            self._refuse(f"opening the folder {place}", words)
        if not os.path.exists(place) and not place.startswith(self._harmless):
            if not _is_in(place, self._own) and not _is_data(path):
                self._tell(f"reading {place}"[:TOLD])

    def _require_inside(self, path: Any) -> None:
        place = os.path.realpath(os.fsdecode(path))
        if place != os.devnull and not _is_in(place, self._own):
            words = "writing outside the working folder is not allowed while an answer is marked"
            self._refuse(f"writing to {place}", f"{words}: {place}")

    def replace(self, module: str, name: str) -> None:
        """Replace a function by one that refuses."""
        try:
            home = importlib.import_module(module)
        except ImportError:
            return
        for place in (home, sys.modules.get("posix"), sys.modules.get("nt")):
            if place is home or (module == "os" and hasattr(place, name)):
                if hasattr(place, name):
                    setattr(place, name, self._refusing(f"{module}.{name}"))

    def _refusing(self, name: str) -> Callable[..., Any]:
        def refused(*_: Any, **__: Any) -> Any:
            self._refuse(name, f"{name} is not allowed while an answer is marked")

        return refused

    def refuse_folders_by_number(self) -> None:
        """Refuse ``dir_fd``, a folder given by its descriptor: the events do not show
        it.
        """
        import shutil

        shutil._use_fd_functions = False  # type: ignore[attr-defined]
        for function in os.supports_dir_fd - {os.stat, os.access, os.readlink}:
            name = function.__name__
            for place in (os, sys.modules.get("posix")):
                if getattr(place, name, None) is function:
                    setattr(place, name, self._without_folders(function))

    def _without_folders(self, function: Callable[..., Any]) -> Callable[..., Any]:
        def plain(*given: Any, **named: Any) -> Any:
            if any(k.endswith("dir_fd") and v is not None for k, v in named.items()):
                words = f"{function.__name__} by dir_fd is not allowed while an answer is marked"
                self._refuse(f"os.{function.__name__} by dir_fd", words)
            return function(*given, **named)

        plain.__name__ = function.__name__
        return plain


def _looks_up(program: Any, words: Any) -> bool:
    """Whether a program that is to be started tells of the machine alone."""
    first = program or (words[0] if isinstance(words, (list, tuple)) and words else "")
    told = isinstance(first, (str, bytes, os.PathLike))
    return told and os.path.basename(os.fsdecode(first)) in LOOKING_UP


def _tries_address(_: Any, address: Any) -> bool:
    """Whether a free port of this machine is asked for, to see what kinds of address there are."""
    own = ("::1", "127.0.0.1", "localhost")
    return isinstance(address, tuple) and address[0] in own and address[1] == 0


#: What packages do to learn where they are: refused, not told.
LOOKS: dict[str, Callable[[Any, Any], bool]] = {
    "subprocess.Popen": _looks_up,
    "socket.bind": _tries_address,
}


def _is_data(path: Any) -> bool:
    """Whether a path leads from the notebook's own folder to numbers or a picture."""
    name = os.fsdecode(path)
    return not os.path.isabs(name) and name.lower().endswith(DATA)


def _is_in(place: str, folder: str) -> bool:
    return place == folder or place.startswith(folder + os.sep)
