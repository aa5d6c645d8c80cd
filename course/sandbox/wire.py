"""What travels between the grader and the process that runs student code: a tree of plain values and raw arrays.

One message is the length of its header, the header in JSON, then the bytes of all arrays behind each other. There
is no pickle and no compression, so what a message can do to its reader is bounded by its length. Reading checks
everything: a reply is data from a stranger.
"""

from __future__ import annotations

import json
import math
import re
import struct
from typing import Any

import numpy as np

HEADER_LIMIT = 8_000_000
BODY_LIMIT = 64_000_000
_LENGTH = struct.Struct("<Q")
_DTYPE = re.compile(
    r"[<>|=]?(?:b1|[iu][1248]|f(?:2|4|8|12|16)|c(?:8|16|24|32)|U[1-9]\d{0,2})"
)


class Unreadable(ValueError):
    """A message that does not say what it should; the text says what is wrong with it."""


def pack(value: Any) -> bytes:
    """A tree of None, bool, int, float, str, arrays, tuples, lists and dicts (keys are str) as one message."""
    body = bytearray()
    header = json.dumps(
        _encoded(value, body), ensure_ascii=False, separators=(",", ":")
    )
    head = header.encode("utf-8", "replace")
    return _LENGTH.pack(len(head)) + head + bytes(body)


def unpack(message: bytes, header: int = HEADER_LIMIT) -> Any:
    """The tree of a message; raises ``Unreadable`` for anything that ``pack`` does not write.

    ``header`` is the most bytes of all but its arrays: what is read of them takes a
    hundred times their number.
    """
    if len(message) < _LENGTH.size:
        raise Unreadable("too short")
    (length,) = _LENGTH.unpack_from(message)
    body = message[_LENGTH.size + length :]
    if (
        length > header
        or length > len(message) - _LENGTH.size
        or len(body) > BODY_LIMIT
    ):
        raise Unreadable("lengths out of bounds")
    try:
        tree = json.loads(message[_LENGTH.size : _LENGTH.size + length].decode("utf-8"))
        return _Decoder(body).decoded(tree)
    except RecursionError:
        raise Unreadable("nested too deeply") from None
    except Unreadable:
        raise
    except (ValueError, TypeError, OverflowError, MemoryError) as error:
        raise Unreadable(str(error)[:200]) from None


def _encoded(value: Any, body: bytearray) -> Any:
    if isinstance(value, (np.ndarray, np.generic)):
        array = np.ascontiguousarray(value)
        spec = [array.dtype.str, list(np.shape(value)), len(body)]
        body += array.tobytes()
        return {"scalar" if isinstance(value, np.generic) else "array": spec}
    if isinstance(value, tuple):
        return {"tuple": [_encoded(part, body) for part in value]}
    if isinstance(value, list):
        return [_encoded(part, body) for part in value]
    if isinstance(value, dict):
        return {"dict": {name: _encoded(part, body) for name, part in value.items()}}
    if value is None or isinstance(value, (bool, int, float, str)):
        return value
    raise TypeError(
        f"value: expected arrays, numbers, text and tuples of them; got {type(value).__name__}"
    )


class _Decoder:
    """Decodes a tree whose arrays lie in ``body`` end to end.

    Each byte belongs to one array: many that shared the same bytes would be copied to
    many times the length of the message.
    """

    def __init__(self, body: bytes) -> None:
        self._body, self._used = body, 0

    def decoded(self, tree: Any) -> Any:
        if isinstance(tree, list):
            return [self.decoded(part) for part in tree]
        if not isinstance(tree, dict):
            return tree
        if len(tree) != 1:
            raise Unreadable("an object with other than one key")
        ((kind, inside),) = tree.items()
        if kind in ("array", "scalar"):
            array = self._array(inside)
            return array[()] if kind == "scalar" else array
        if kind == "tuple" and isinstance(inside, list):
            return tuple(self.decoded(part) for part in inside)
        if kind == "dict" and isinstance(inside, dict):
            return {name: self.decoded(part) for name, part in inside.items()}
        raise Unreadable(f"an object of unknown kind {kind[:40]!r}")

    def _array(self, spec: Any) -> np.ndarray:
        array = _array(spec, self._body)
        if spec[2] != self._used:
            raise Unreadable("an array that does not follow the one before it")
        self._used += array.nbytes
        return array


def _array(spec: Any, body: bytes) -> np.ndarray:
    """The array of a spec [dtype, shape, offset], all of it inside the body."""
    if not isinstance(spec, list) or len(spec) != 3:
        raise Unreadable("an array without dtype, shape and offset")
    name, shape, offset = spec
    if not isinstance(name, str) or not _DTYPE.fullmatch(name):
        raise Unreadable("an array of a type that is not sent")
    if (
        not isinstance(shape, list)
        or len(shape) > 32
        or not all(_is_count(n) for n in [*shape, offset])
    ):
        raise Unreadable("an array of a shape that is none")
    dtype = np.dtype(name)
    count = math.prod(shape)
    if offset + count * dtype.itemsize > len(body):
        raise Unreadable("an array that is longer than the message")
    if count == 0:
        return np.zeros(shape, dtype)
    raw = np.frombuffer(body, np.uint8, count * dtype.itemsize, offset)
    if dtype.kind == "b":
        return (raw != 0).reshape(shape)
    array = np.frombuffer(raw.tobytes(), dtype).reshape(shape)
    if (
        dtype.kind == "U"
        and np.frombuffer(raw.tobytes(), dtype.str[0] + "u4").max() > 0x10FFFF
    ):
        raise Unreadable("text with characters that are none")
    return array


def _is_count(value: Any) -> bool:
    return isinstance(value, int) and not isinstance(value, bool) and 0 <= value < 2**48
