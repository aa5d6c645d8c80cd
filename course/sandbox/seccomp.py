"""Refuse system calls for good, by a filter in the Linux kernel (seccomp, classic BPF).

It closes what namespaces leave open: new processes (whose memory no limit of one
process counts), files that live in memory alone, tracing, keys, other schedulers. A
call is refused by its number, so the numbers are listed here, from the kernel's tables
for x86-64 and the generic one that 64-bit ARM uses. Source: seccomp(2), bpf(4) of the
Linux manual pages; linux/filter.h, linux/seccomp.h.
"""

from __future__ import annotations

import ctypes
import errno
import os
import platform
import struct
import sys
from collections.abc import Callable

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
    "settimeofday": (164, 170), "clock_settime": (227, 112), "adjtimex": (159, 171), "sethostname": (170, 161),
}  # fmt: skip
CLONE, CLONE3 = (56, 220), (435, 435)
KILL, TGKILL, PRLIMIT = (62, 129), (234, 131), (302, 261)
CLONE_THREAD = 0x0001_0000
MACHINES = {"x86_64": (0, 0xC000_003E), "aarch64": (1, 0xC000_00B7), "arm64": (1, 0xC000_00B7)}  # fmt: skip
X32 = 0x4000_0000  # numbers from here on are x86-64's second table

_LOAD, _EQUAL, _ABOVE, _SET, _RETURN = 0x20, 0x15, 0x35, 0x45, 0x06
_ALLOW, _ERROR, _KILL = 0x7FFF_0000, 0x0005_0000, 0x8000_0000
_PR_SET_NO_NEW_PRIVS, _PR_SET_SECCOMP, _MODE_FILTER = 38, 22, 2
_NUMBER, _ARCH, _FIRST, _THIRD = 0, 4, 16, 32  # offsets in struct seccomp_data


def filter_installer() -> Callable[[], bool] | None:
    """A function that installs the filter in its process; None on unsupported machines.

    What it needs is loaded here, because a guarded process may not load it.
    """
    if not sys.platform.startswith("linux") or struct.calcsize("P") != 8:
        return None
    machine = MACHINES.get(platform.machine())
    if machine is None:
        return None
    try:
        prctl = ctypes.CDLL(None, use_errno=True).prctl
    except (OSError, AttributeError):
        return None

    def install() -> bool:
        code = ctypes.create_string_buffer(program(*machine, own=os.getpid()))
        count = (len(code) - 1) // 8
        described = struct.pack("HxxxxxxP", count, ctypes.addressof(code))
        holder = ctypes.create_string_buffer(described)
        zero = ctypes.c_ulong(0)
        if prctl(_PR_SET_NO_NEW_PRIVS, ctypes.c_ulong(1), zero, zero, zero):
            return False
        return not prctl(
            _PR_SET_SECCOMP, ctypes.c_ulong(_MODE_FILTER), holder, zero, zero
        )

    return install


def program(column: int, architecture: int, own: int) -> bytes:
    """The filter: the calls in ``CALLS`` fail with EPERM, all others are allowed,
    except:

    clone makes threads but no processes; clone3 does not exist (the C library then uses
    clone); signals reach only the process itself, whose number is ``own``; limits can
    be read but not set.
    """
    lines: list[tuple[int, int, int, int]] = []
    refuse = (_RETURN, 0, 0, _ERROR | errno.EPERM)
    allow = (_RETURN, 0, 0, _ALLOW)
    lines += [(_LOAD, 0, 0, _ARCH), (_EQUAL, 1, 0, architecture), (_RETURN, 0, 0, _KILL)]  # fmt: skip
    lines += [(_LOAD, 0, 0, _NUMBER), (_ABOVE, 0, 1, X32), refuse]
    for numbers in CALLS.values():
        number = numbers[column]
        if number is not None:
            lines += [(_EQUAL, 0, 1, number), refuse]
    absent = (_RETURN, 0, 0, _ERROR | errno.ENOSYS)
    lines += [(_EQUAL, 0, 1, CLONE3[column]), absent]
    # Where the number does not match, each of these skips its own four lines.
    for numbers in (KILL, TGKILL):
        lines += [(_EQUAL, 0, 4, numbers[column]), (_LOAD, 0, 0, _FIRST),
                  (_EQUAL, 1, 0, own), refuse, allow]  # fmt: skip
    lines += [(_EQUAL, 0, 4, CLONE[column]), (_LOAD, 0, 0, _FIRST),
              (_SET, 1, 0, CLONE_THREAD), refuse, allow]  # fmt: skip
    lines += [(_EQUAL, 0, 4, PRLIMIT[column]), (_LOAD, 0, 0, _THIRD),
              (_EQUAL, 1, 0, 0), refuse, allow]  # fmt: skip
    lines.append(allow)
    return b"".join(struct.pack("HBBI", *line) for line in lines)
