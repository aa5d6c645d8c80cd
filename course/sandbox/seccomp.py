"""Refuse system calls for good, by a filter in the Linux kernel (seccomp with classic BPF).

Namespaces leave what this closes: new processes (whose memory no limit of one process counts), files that live in
memory alone, tracing, keys, other schedulers. A call is refused by its number, so the numbers stand here, from the
kernel's tables for x86-64 and the generic one that 64-bit ARM uses. Source: seccomp(2), bpf(4) of the Linux manual
pages; linux/filter.h, linux/seccomp.h.
"""

from __future__ import annotations

import ctypes
import errno
import os
import platform
import struct
import sys
from dataclasses import dataclass
from typing import Any

#: System call -> number on (x86-64, 64-bit ARM); None where there is no such call.
CALLS: dict[str, tuple[int | None, int | None]] = {
    # new processes and programs
    "fork": (57, None), "vfork": (58, None), "execve": (59, 221), "execveat": (322, 281),
    # memory outside the process: no limit counts it
    "memfd_create": (319, 279), "memfd_secret": (447, 447), "shmget": (29, 194), "msgget": (68, 186),
    "semget": (64, 190), "mq_open": (240, 180), "userfaultfd": (323, 282), "io_uring_setup": (425, 425),
    "io_uring_enter": (426, 426), "io_uring_register": (427, 427), "bpf": (321, 280), "perf_event_open": (298, 241),
    "fanotify_init": (300, 262), "inotify_init1": (294, 26), "inotify_init": (253, None),
    # other processes
    "ptrace": (101, 117), "process_vm_readv": (310, 270), "process_vm_writev": (311, 271), "kcmp": (312, 272),
    "pidfd_open": (434, 434), "pidfd_getfd": (438, 438), "pidfd_send_signal": (424, 424), "tkill": (200, 130),
    "rt_sigqueueinfo": (129, 138), "rt_tgsigqueueinfo": (297, 240), "process_madvise": (440, 440),
    # namespaces and mounts
    "unshare": (272, 97), "setns": (308, 268), "mount": (165, 40), "umount2": (166, 39), "pivot_root": (155, 41),
    "chroot": (161, 51), "open_tree": (428, 428), "move_mount": (429, 429), "fsopen": (430, 430),
    "fsconfig": (431, 431), "fsmount": (432, 432), "fspick": (433, 433), "mount_setattr": (442, 442),
    "name_to_handle_at": (303, 264), "open_by_handle_at": (304, 265), "mknod": (133, None), "mknodat": (259, 33),
    # the network, beyond pairs of sockets
    "socket": (41, 198), "bind": (49, 200), "listen": (50, 201), "connect": (42, 203), "accept": (43, 202),
    "accept4": (288, 242),
    # limits, schedulers, keys, the machine
    "setrlimit": (160, 164), "setpriority": (141, 140), "sched_setscheduler": (144, 119),
    "sched_setparam": (142, 118), "sched_setattr": (314, 274), "sched_setaffinity": (203, 122),
    "ioprio_set": (251, 30), "add_key": (248, 217), "request_key": (249, 218), "keyctl": (250, 219),
    "init_module": (175, 105), "finit_module": (313, 273), "delete_module": (176, 106), "kexec_load": (246, 104),
    "kexec_file_load": (320, 294), "reboot": (169, 142), "swapon": (167, 224), "swapoff": (168, 225),
    "acct": (163, 89), "quotactl": (179, 60), "personality": (135, 92), "syslog": (103, 116),
    # what stands beside a file's content
    "setxattr": (188, 5), "lsetxattr": (189, 6), "fsetxattr": (190, 7), "setxattrat": (463, 463),
    "removexattr": (197, 14), "lremovexattr": (198, 15), "fremovexattr": (199, 16),
    "removexattrat": (466, 466), "file_setattr": (469, 469),
    # what the whole machine has to wait for, or has a fixed number of
    "sync": (162, 81), "syncfs": (306, 267), "io_setup": (206, 0),
    "settimeofday": (164, 170), "clock_settime": (227, 112), "adjtimex": (159, 171), "sethostname": (170, 161),
}  # fmt: skip
#: Calls that do nothing and say that it is done. The devices are the machine's own:
#: where root is the grader, a submission owns them. Nobody needs a mode, an owner or a
#: time of a file in the box, but to copy a file sets all three.
IDLE: dict[str, tuple[int | None, int | None]] = {
    "chmod": (90, None), "fchmod": (91, 52), "fchmodat": (268, 53), "fchmodat2": (452, 452),
    "chown": (92, None), "lchown": (94, None), "fchown": (93, 55), "fchownat": (260, 54),
    "utime": (132, None), "utimes": (235, None), "futimesat": (261, None), "utimensat": (280, 88),
}  # fmt: skip
CLONE, CLONE3 = (56, 220), (435, 435)
FCNTL, IOCTL = (72, 25), (16, 29)
#: Commands of fcntl that reach past the process: signals to another (F_SETOWN, F_SETSIG,
#: F_SETOWN_EX), files that others must wait to open or that tell of them (F_SETLEASE,
#: F_NOTIFY, F_SETDELEG), buffers that all of a user's pipes share (F_SETPIPE_SZ).
FCNTL_COMMANDS = (8, 10, 15, 1024, 1026, 1040, 1031)
#: Those of ioctl: signals to another (FIOSETOWN, SIOCSPGRP).
IOCTL_COMMANDS = (0x8901, 0x8902)
KILL, TGKILL, PRLIMIT = (62, 129), (234, 131), (302, 261)
SECCOMP = (317, 277)
FORKS = ("fork", "vfork")
CLONE_THREAD = 0x0001_0000
MACHINES = {"x86_64": (0, 0xC000_003E), "aarch64": (1, 0xC000_00B7), "arm64": (1, 0xC000_00B7)}  # fmt: skip
X32 = 0x4000_0000  # numbers from here on are x86-64's second table

_LOAD, _EQUAL, _ABOVE, _SET, _RETURN = 0x20, 0x15, 0x35, 0x45, 0x06
_ALLOW, _ERROR, _KILL, _ASK = 0x7FFF_0000, 0x0005_0000, 0x8000_0000, 0x7FC0_0000
_PR_SET_NO_NEW_PRIVS, _MODE_FILTER, _NEW_LISTENER = 38, 1, 8
# Offsets in struct seccomp_data.
_NUMBER, _ARCH, _FIRST, _SECOND, _THIRD = 0, 4, 16, 24, 32


@dataclass(frozen=True)
class Filter:
    """The filter for this machine. What it needs is loaded when it is made: a guarded process may not load it."""

    column: int
    architecture: int
    library: Any

    def close(self) -> bool:
        """Refuse, in the calling process and for good, all that ``program`` refuses; whether that worked."""
        return (
            self._install(program(self.column, self.architecture, own=os.getpid()), 0)
            == 0
        )

    def close_but_ask(self) -> int | None:
        """The same, but a new process is asked for: the number of the open file that is asked (``forks``)."""
        code = program(self.column, self.architecture, own=os.getppid(), ask=True)
        listener = self._install(code, _NEW_LISTENER)
        return listener if listener >= 0 else None

    def _install(self, code: bytes, flags: int) -> int:
        lines = ctypes.create_string_buffer(code)
        described = struct.pack("HxxxxxxP", len(code) // 8, ctypes.addressof(lines))
        holder = ctypes.create_string_buffer(described)
        zero = ctypes.c_ulong(0)
        one = ctypes.c_ulong(1)
        if self.library.prctl(_PR_SET_NO_NEW_PRIVS, one, zero, zero, zero):
            return -1
        number = ctypes.c_long(SECCOMP[self.column])
        mode = ctypes.c_uint(_MODE_FILTER)
        return int(self.library.syscall(number, mode, ctypes.c_uint(flags), holder))


def filter_for_this_machine() -> Filter | None:
    """The filter; None where there is none for this machine."""
    if not sys.platform.startswith("linux") or struct.calcsize("P") != 8:
        return None
    machine = MACHINES.get(platform.machine())
    if machine is None:
        return None
    try:
        library = ctypes.CDLL(None, use_errno=True)
        library.prctl, library.syscall  # noqa: B018
    except (OSError, AttributeError):
        return None
    return Filter(*machine, library)


def program(column: int, architecture: int, own: int, *, ask: bool = False) -> bytes:
    """The filter: what stands in ``CALLS`` is refused with EPERM, everything else but these is allowed.

    clone makes threads, no processes; clone3 is not there (the C library then takes clone); signals reach the
    process itself, whose number is ``own``, and no other; limits can be read; of fcntl and ioctl single commands are
    refused. With ``ask`` a new process is not refused: whoever listens decides; and signals reach all but ``own``,
    here the process that watches.
    """
    lines: list[tuple[int, int, int, int]] = []
    refuse = (_RETURN, 0, 0, _ERROR | errno.EPERM)
    allow = (_RETURN, 0, 0, _ALLOW)
    lines += [(_LOAD, 0, 0, _ARCH), (_EQUAL, 1, 0, architecture), (_RETURN, 0, 0, _KILL)]  # fmt: skip
    lines += [(_LOAD, 0, 0, _NUMBER), (_ABOVE, 0, 1, X32), refuse]
    process = (_RETURN, 0, 0, _ASK) if ask else refuse
    for calls, instead in ((CALLS, refuse), (IDLE, (_RETURN, 0, 0, _ERROR))):
        for name, numbers in calls.items():
            number = numbers[column]
            if number is not None:
                verdict = process if name in FORKS else instead
                lines += [(_EQUAL, 0, 1, number), verdict]
    absent = (_RETURN, 0, 0, _ERROR | errno.ENOSYS)
    lines += [(_EQUAL, 0, 1, CLONE3[column]), absent]
    # Where the number is not theirs, each of these jumps over its own four lines.
    for numbers in (KILL, TGKILL):
        if ask:  # it has processes of its own: others are who watches it, the first of all, and groups
            lines += [(_EQUAL, 0, 6, numbers[column]), (_LOAD, 0, 0, _FIRST), (_EQUAL, 2, 0, own),
                      (_EQUAL, 1, 0, 1), (_SET, 0, 1, 0x8000_0000), refuse, allow]  # fmt: skip
        else:
            lines += [(_EQUAL, 0, 4, numbers[column]), (_LOAD, 0, 0, _FIRST),
                      (_EQUAL, 1, 0, own), refuse, allow]  # fmt: skip
    lines += [(_EQUAL, 0, 4, CLONE[column]), (_LOAD, 0, 0, _FIRST),
              (_SET, 1, 0, CLONE_THREAD), process, allow]  # fmt: skip
    lines += [(_EQUAL, 0, 4, PRLIMIT[column]), (_LOAD, 0, 0, _THIRD),
              (_EQUAL, 1, 0, 0), refuse, allow]  # fmt: skip
    for numbers, commands in ((FCNTL, FCNTL_COMMANDS), (IOCTL, IOCTL_COMMANDS)):
        each = [line for c in commands for line in ((_EQUAL, 0, 1, c), refuse)]
        lines += [(_EQUAL, 0, len(each) + 2, numbers[column]), (_LOAD, 0, 0, _SECOND),
                  *each, allow]  # fmt: skip
    lines.append(allow)
    return b"".join(struct.pack("HBBI", *line) for line in lines)
