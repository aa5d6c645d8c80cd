"""What travels between judge and child: everything comes back as it was, and nothing else is taken."""

import json
import struct

import numpy as np
import pytest

from course.exercises.answer import Outcome
from course.exercises.question import Question
from course.exercises.untrusted_text import clean
from course.sandbox import wire
from course.sandbox.reply import checked_reply


def message(header, body=b""):
    head = header if isinstance(header, bytes) else json.dumps(header).encode()
    return struct.pack("<Q", len(head)) + head + body


@pytest.mark.parametrize(
    "value",
    [
        None, True, 7, 2.5, "text", float("inf"), (1, (2.0, "a")), [1, [2]], {"a": {"b": (1,)}},
        np.arange(6.0).reshape(2, 3), np.zeros((0, 3)), np.array(1.5), np.array([True, False]), np.array(["a", "bcd"]),
        np.arange(4, dtype=">i2"), np.array([1 + 2j]), np.float64(3.5), np.arange(12.0).reshape(3, 4).T, np.float32(1),
    ],
    ids=repr,
)  # fmt: skip
def test_values_come_back_as_they_were(value):
    back = wire.unpack(wire.pack({"v": value}))["v"]
    assert type(back) is type(value)
    if isinstance(value, np.ndarray):
        assert back.dtype == value.dtype and back.shape == value.shape
    assert (
        np.array_equal(back, value)
        if isinstance(value, (np.ndarray, np.generic))
        else back == value
    )


def test_nan_and_several_arrays_keep_their_places():
    a, b, c = wire.unpack(
        wire.pack((np.array([np.nan, 1.0]), np.array([True]), np.array([2.0, 3.0])))
    )
    assert np.isnan(a[0]) and a[1] == 1.0 and b[0] and c.tolist() == [2.0, 3.0]


@pytest.mark.parametrize(
    "value",
    [object(), {1}, np.array([None]), b"bytes", 1j],
    ids=["object", "set", "object array", "bytes", "complex"],
)
def test_nothing_else_is_sent(value):
    with pytest.raises((TypeError, wire.Unreadable)):
        wire.unpack(wire.pack({"v": value}))


@pytest.mark.parametrize(
    "bad",
    [
        b"", b"abc", struct.pack("<Q", 2**60) + b"{}", message(b"\xff\xfe"), message(b"{"), message({"x": 1, "y": 2}),
        message({"what": []}), message({"array": ["|O", [1], 0]}, b"12345678"),
        message({"array": ["<f8", [2], 0]}, b"1234"),
        message({"array": ["<f8", [-1], 0]}), message({"array": ["<f8", [1], -8]}, b"12345678"),
        message({"array": ["<f8", [2**62, 2**62], 0]}), message({"array": ["<f8", [10**9, 10**9, 0, 10**30], 0]}),
        message({"array": ["<f8", [True], 0]}, b"12345678"), message({"array": ["<f8", [1.0], 0]}, b"12345678"),
        message({"array": ["<f8", "1", 0]}, b"12345678"), message({"array": ["f8,f8", [1], 0]}, b"1" * 16),
        message({"array": ["<M8[s]", [1], 0]}, b"12345678"), message({"array": ["<f8", [1] * 40, 0]}, b"12345678"),
        message({"array": ["<U1", [1], 0]}, b"\xff\xff\xff\xff"), message({"tuple": 3}), message({"dict": []}),
        message(b"[" * 100_000), message(b"9" * 10_000), message({"array": ["<U9999", [1], 0]}, b"1" * 39996),
        message({"array": ["<U0", [2**30], 0]}),
    ],
    ids=lambda b: repr(b[8:48]),
)  # fmt: skip
def test_what_pack_does_not_write_is_refused(bad):
    with pytest.raises(wire.Unreadable):
        wire.unpack(bad)


@pytest.mark.parametrize("seed", [1, 2])
def test_damaged_messages_raise_unreadable_and_nothing_else(seed):
    rng = np.random.default_rng(seed)
    whole = np.frombuffer(
        wire.pack({"v": [np.arange(3.0), "text", (1, True)]}), np.uint8
    )
    refused = 0
    for _ in range(2000):
        damaged = whole.copy()
        places = rng.integers(0, len(damaged), rng.integers(1, 6))
        damaged[places] = rng.integers(0, 256, len(places))
        try:
            wire.unpack(damaged.tobytes()[: rng.integers(1, len(damaged) + 1)])
        except wire.Unreadable:
            refused += 1
    assert refused > 500


QUESTION = Question("f", "function", ("x",), 1, ({"x": 1.0},), (9,))
GOOD = {
    "outcomes": [
        {"kind": "value", "text": "", "printed": "", "values": [np.array(1.0)]}
    ],
    "held": ["memory", "x"],
}


def test_a_good_reply_is_read():
    reply = checked_reply(GOOD, QUESTION)
    assert reply.answer.outcomes == (
        Outcome("value", (np.array(1.0),)),
    ) and reply.held == ("memory",)


@pytest.mark.parametrize(
    "change",
    [
        {"outcomes": []}, {"outcomes": None}, {"outcomes": [1]}, {"outcomes": [{"kind": "passed"}]},
        {"outcomes": [{"kind": "value", "values": [1.0]}]}, {"outcomes": [{"kind": "value", "values": []}]},
        {"outcomes": [{"kind": "value", "values": np.array(1.0)}]}, {"held": {"memory": 1}},
        {"outcomes": [{"kind": "value", "values": [np.zeros(10)]}]},
    ],
    ids=repr,
)  # fmt: skip
def test_a_reply_that_is_none_is_refused(change):
    with pytest.raises(wire.Unreadable):
        checked_reply(GOOD | change, QUESTION)


def test_text_of_a_stranger_is_made_plain():
    assert (
        clean("a\x1b[31mb\n\ud800\x00", 100)
        == "a\N{REPLACEMENT CHARACTER}[31mb\n?\N{REPLACEMENT CHARACTER}"
    )
    assert clean("x" * 50, 10) == "x" * 10 and clean(3, 10) == ""


def test_no_two_arrays_share_bytes():
    # Each is a copy: 40 of them would be 40 times the message in the reader's memory.
    one = {"array": ["|u1", [1000], 0]}
    with pytest.raises(wire.Unreadable, match="does not follow"):
        wire.unpack(message([one] * 40, bytes(1000)))
