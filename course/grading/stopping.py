"""Ctrl-C, SIGTERM and SIGHUP as an exception, raised when nothing is half done."""

from __future__ import annotations

import signal
import threading
from collections.abc import Iterator
from contextlib import contextmanager
from types import FrameType
from typing import Any


class Stopped(KeyboardInterrupt):
    """A signal stopped the batch; ``number`` is the signal's."""

    def __init__(self, number: int) -> None:
        super().__init__(f"stopped by {signal.Signals(number).name}")
        self.number = number


class Stopping:
    """While entered, a signal raises ``Stopped``; inside ``put_off`` only in ``check``.

    A second Ctrl-C is not put off. Ignored signals (``nohup``) stay ignored, and
    outside the main thread, where Python cannot catch any, nothing is done.
    """

    def __init__(self) -> None:
        self.number = 0
        self._put_off = False
        self._before: dict[int, Any] = {}

    def __enter__(self) -> Stopping:
        if threading.current_thread() is threading.main_thread():
            for name in ("SIGINT", "SIGTERM", "SIGHUP", "SIGBREAK"):
                number = getattr(signal, name, None)
                if number and signal.getsignal(number) not in (signal.SIG_IGN, None):
                    self._before[number] = signal.signal(number, self._told)
        return self

    def __exit__(self, *_: object) -> None:
        for number, handler in self._before.items():
            signal.signal(number, handler)

    @contextmanager
    def put_off(self) -> Iterator[None]:
        """Hold signals back until the end of the block, except in ``check``."""
        self._put_off = True
        try:
            yield
        finally:
            self._put_off = False

    def check(self) -> None:
        """Raise ``Stopped`` if a signal has come."""
        if self.number:
            raise Stopped(self.number)

    def _told(self, number: int, frame: FrameType | None) -> None:
        again = bool(self.number)
        self.number = self.number or number
        if not self._put_off or (again and number == signal.SIGINT):
            raise Stopped(number)
