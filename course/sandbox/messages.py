"""How the processes of a submission talk: a letter, a length, and so many bytes, through a pipe.

Both ends may be a stranger's: a reader takes nothing longer than it expects.
"""

from __future__ import annotations

import os
import struct
from collections.abc import Callable

from course.sandbox.wire import BODY_LIMIT, HEADER_LIMIT

_HEAD = struct.Struct("<cI")
#: Bytes; the longest message there is (a notebook on its way in, results on their way out).
LONGEST = HEADER_LIMIT + BODY_LIMIT + 8

BEGUN = b"B"  # the child runs (child.py writes it before anything is imported)
READY, ASK, READ, UNUSABLE = b"A", b"Q", b"N", b"U"  # serving and the grader
STAGE, TRIED, REPLY, END = b"S", b"T", b"R", b"E"  # an exercise's run
NOTE, DONE = b"O", b"D"  # what a cell raised; a fork of the notebook's ended
FAULT = b"F"  # of ours, in its process


#: Bytes of a reply about repairs but its arrays.
REPAIR_HEADER = 2_000_000


class NoReply(RuntimeError):
    """The other end is gone, or says nothing in time."""


class Garbled(ValueError):
    """What came is no message."""


def send(pipe: int, letter: bytes, payload: bytes = b"") -> None:
    """Write a message whole."""
    rest = memoryview(_HEAD.pack(letter, len(payload)) + payload)
    while rest:
        rest = rest[os.write(pipe, rest) :]


def receive(read: Callable[[int], bytes]) -> tuple[bytes, bytes] | None:
    """The next message, from ``read(count)``, which blocks; None where the other end is closed."""
    head = _exactly(read, _HEAD.size)
    if head is None:
        return None
    letter, length = _HEAD.unpack(head)
    if length > LONGEST:
        raise Garbled(f"a message of {length} bytes")
    payload = _exactly(read, length)
    return None if payload is None else (letter, payload)


def _exactly(read: Callable[[int], bytes], count: int) -> bytes | None:
    parts, left = [], count
    while left:
        part = read(min(left, 1 << 20))
        if not part:
            return None
        parts.append(part)
        left -= len(part)
    return b"".join(parts)


class Incoming:
    """Messages out of bytes that come in pieces, for a reader that must not block.

    ``most`` bounds the bytes of all messages together.
    """

    def __init__(self, most: int = LONGEST) -> None:
        self._held = bytearray()
        self._left = most

    def feed(self, data: bytes) -> list[tuple[bytes, bytes]]:
        """The messages that are whole now; raises ``Garbled``."""
        self._left -= len(data)
        if self._left < 0:
            raise Garbled("more was sent than there is room for")
        self._held += data
        whole = []
        while len(self._held) >= _HEAD.size:
            letter, length = _HEAD.unpack_from(self._held)
            if length > LONGEST:
                raise Garbled(f"a message of {length} bytes")
            if len(self._held) < _HEAD.size + length:
                break
            whole.append((letter, bytes(self._held[_HEAD.size : _HEAD.size + length])))
            del self._held[: _HEAD.size + length]
        return whole
