"""Once a submission is answered for: a fork of its process tries repairs of an answer, watched from here.

The fork runs what a student wrote, and changes of it. All marks are decided by then, and all it can do to the grader is
to give a wrong cause.
"""

from __future__ import annotations

import contextlib
import gc
import os
import select
import signal
import sys
import time
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace
from typing import Any, NoReturn

from course.exercises.notebook_file import NotebookFile
from course.exercises.repair.recipe import Recipe, expression_recipe, function_recipe
from course.sandbox import guard, messages, stand_ins, trying, wire
from course.sandbox.limits import apply_limits, resident_mb
from course.sandbox.notebook_shell import Surroundings
from course.sandbox.watching import LOOK_SECONDS, Abandoned, watches_memory

#: For one reply.
REPLY_SECONDS = 15.0
#: Processor seconds of a search; it is over long before, unless its process runs wild.
SEARCH_SECONDS = 60.0
#: A request but the first goes through a pipe that nobody may read [bytes].
LONGEST_REQUEST = 30_000


@dataclass
class Fork:
    """A running fork, and the pipes to and from it."""

    process: int
    inlet: int
    outlet: int

    def end(self) -> None:
        """End it and all in its group."""
        for target in (-self.process, self.process):
            with contextlib.suppress(ProcessLookupError, PermissionError):
                os.kill(target, signal.SIGKILL)
        os.waitpid(self.process, 0)
        os.close(self.inlet)
        os.close(self.outlet)


class Repairs:
    """Serves a grader's requests about repairs; ``grader`` and ``outlet`` are the pipes from and to it."""

    def __init__(
        self, notebook: NotebookFile, around: Surroundings, grader: int, outlet: int
    ) -> None:
        self._notebook, self._around = notebook, around
        self._grader, self._outlet = grader, outlet
        self._fork: Fork | None = None

    def answer(self, request: Mapping[str, Any]) -> None:
        """Reply to one request; a fork that is gone, or does not reply, is ended and reported as a fault."""
        reply = None
        if "index" in request:
            self.close()
            recipe = self._recipe(request)
            if recipe is None:
                words = "its source is not found"
                reply = wire.pack({"error": words, "outcomes": []})
            else:
                opening = {**request, "source": recipe.source, "prelude": recipe.prelude,
                           "values": {}, "elementwise": recipe.elementwise}  # fmt: skip
                self._fork = self._begin(opening)
                reply = self._reply()
        elif self._fork is not None:
            packed = wire.pack(dict(request))
            if len(packed) <= LONGEST_REQUEST:
                with contextlib.suppress(BrokenPipeError):
                    messages.send(self._fork.inlet, messages.ASK, packed)
                    reply = self._reply()
        if reply is None:
            self.close()
            messages.send(self._outlet, messages.FAULT)
        else:
            messages.send(self._outlet, messages.REPLY, reply)

    def close(self) -> None:
        """End the fork."""
        if self._fork is not None:
            self._fork.end()
        self._fork = None

    def _recipe(self, request: Mapping[str, Any]) -> Recipe | None:
        name = request["name"]
        if request["kind"] == "expression":
            cell = self._notebook.cells[request["index"]].source
            return expression_recipe(cell, name, request["arguments"])
        return function_recipe([cell.source for cell in self._notebook.code], name)

    def _begin(self, opening: Mapping[str, Any]) -> Fork:
        requests, inlet = os.pipe()
        outlet, replies = os.pipe()
        process = os.fork()
        if process == 0:
            others = [self._grader, self._outlet, inlet, outlet]
            _become_repairs(opening, self._around, requests, replies, others)
        os.close(requests)
        os.close(replies)
        return Fork(process, inlet, outlet)

    def _reply(self) -> bytes | None:
        """What the fork replies; None where it does not, in time and within its memory."""
        assert self._fork is not None
        incoming = messages.Incoming()
        deadline = time.monotonic() + REPLY_SECONDS
        while time.monotonic() < deadline:
            watched = [self._fork.outlet, self._grader]
            ready, _, _ = select.select(watched, [], [], LOOK_SECONDS)
            if self._grader in ready:  # it waits for this reply: it is gone
                raise Abandoned
            if self._fork.outlet in ready:
                data = os.read(self._fork.outlet, 1 << 16)
                if not data:
                    return None
                try:
                    for letter, payload in incoming.feed(data):
                        return payload if letter == messages.REPLY else None
                except messages.Garbled:
                    return None
            elif watches_memory() and resident_mb(self._fork.process) > self._around.limits.memory_mb:  # fmt: skip
                return None
        return None


def _become_repairs(
    opening: Mapping[str, Any],
    around: Surroundings,
    requests: int,
    replies: int,
    others: Sequence[int],
) -> NoReturn:
    try:
        os.setpgid(0, 0)
        for pipe in others:
            os.close(pipe)
        nowhere = os.open(os.devnull, os.O_RDWR)
        for stream in (0, 1, 2):
            os.dup2(nowhere, stream)
        os.chdir(around.work)
        apply_limits(replace(around.limits, seconds=SEARCH_SECONDS))
        sys.path[:] = [around.work, *around.path]
        if around.filter is not None:
            around.filter.close()
        stand_ins.install_stand_ins(lambda *_, **__: None)
        guard.install_guard(around.work, around.closed, around.path, lambda _: None)
        gc.enable()
        trying.serve_one(opening, requests, replies)
    except BaseException:
        pass  # the grader misses a reply
    finally:
        os._exit(70)
