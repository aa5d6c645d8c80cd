"""What the filter of system calls refuses, in a process that has nothing but the filter."""

import os
import subprocess
import sys

import pytest

from course.sandbox.box import ROOT
from course.sandbox.seccomp import filter_for_this_machine

FILTERED = pytest.mark.skipif(
    filter_for_this_machine() is None,
    reason="no filter of system calls for this machine",
)
BEGIN = """
import fcntl, os, socket
from course.sandbox.seccomp import filter_for_this_machine
open("own", "w").close()
number = os.open("own", os.O_RDONLY)
reader, writer = os.pipe()
before = os.fstat(number)
assert filter_for_this_machine().close()
"""


def filtered(tmp_path, code):
    """What the code printed, run where the filter is."""
    command = [sys.executable, "-c", BEGIN + code]
    done = subprocess.run(
        command, cwd=tmp_path, capture_output=True, text=True, timeout=60,
        env={**os.environ, "PYTHONPATH": str(ROOT)},
    )  # fmt: skip
    assert done.returncode == 0, done.stderr
    return done.stdout


@FILTERED
@pytest.mark.parametrize(
    "call",
    [
        "fcntl.fcntl(number, fcntl.F_SETLEASE, fcntl.F_WRLCK)",
        "fcntl.fcntl(number, fcntl.F_NOTIFY, fcntl.DN_ACCESS)",
        "fcntl.fcntl(reader, fcntl.F_SETOWN, os.getppid())",
        "fcntl.fcntl(reader, 10, 9)",
        "fcntl.fcntl(reader, 15, bytes(8))",
        "fcntl.fcntl(reader, 1031, 1 << 20)",
        "fcntl.ioctl(socket.socketpair()[0], 0x8901, bytes(4))",
        "os.setxattr('own', 'user.a', b'a')",
    ],
    ids="lease notify owner signal owner-ex pipe-size ioctl-owner xattr".split(),
)
@pytest.mark.slow
def test_what_reaches_past_the_process_is_refused(tmp_path, call):
    code = f"try: {call}\nexcept PermissionError: print('refused')"
    assert filtered(tmp_path, code) == "refused\n"


@FILTERED
def test_what_programs_need_of_these_calls_is_left(tmp_path):
    code = """
fcntl.fcntl(reader, fcntl.F_SETFL, fcntl.fcntl(reader, fcntl.F_GETFL) | os.O_NONBLOCK)
fcntl.lockf(os.open("own", os.O_RDWR), fcntl.LOCK_EX | fcntl.LOCK_NB)
print(len(fcntl.ioctl(reader, 0x541B, bytes(4))), os.get_blocking(reader))
"""
    assert filtered(tmp_path, code) == "4 False\n"


@FILTERED
def test_modes_owners_and_times_stay_and_copying_works(tmp_path):
    code = """
import shutil
os.chmod("own", 0); os.fchmod(number, 0); os.utime("own", (1, 1))
shutil.copy2("own", "copy")
after = os.fstat(number)
print(after.st_mode == before.st_mode, after.st_mtime_ns == before.st_mtime_ns)
"""
    assert filtered(tmp_path, code) == "True True\n"
