"""The process in which a submission's code runs: reads a job, runs the cells, calls the answer, writes what came back.

Started by ``sandbox`` as a file, by its path. It knows the inputs and nothing else: no reference, no seed, no
verdict. The student's code can do to this process what it likes; the worst it can send is a wrong answer.
"""

from __future__ import annotations

import ast
import contextlib
import gc
import linecache
import os
import sys
from collections.abc import Iterator, Mapping, Sequence
from typing import Any

MISSING = object()


class Stage:
    """Where the run stands, in a small file that outlives it: the judge reads it when the process was ended."""

    WIDTH = 16

    def __init__(self, path: str) -> None:
        self.number = os.open(path, os.O_WRONLY | os.O_CREAT)

    def __call__(self, what: str, index: int = 0) -> None:
        os.lseek(self.number, 0, os.SEEK_SET)
        os.write(self.number, f"{what} {index}".ljust(self.WIDTH).encode())


def main(folder: str) -> None:
    """Do the job in the folder. Ends the process itself: nothing a student left running holds it up."""
    import json

    with open(os.path.join(folder, "path.json"), encoding="utf-8") as file:
        told = json.load(file)
    sys.path[:] = [told["root"], *told["path"]]
    from course.grading import guard, limits, stand_ins, wire

    with open(os.path.join(folder, "job"), "rb") as message:
        job = wire.unpack(message.read())
    work = os.path.join(folder, "work")
    reply = os.open(
        os.path.join(folder, "reply"),
        os.O_WRONLY | os.O_CREAT | getattr(os, "O_BINARY", 0),
    )
    stage = Stage(os.path.join(folder, "stage"))
    os.chdir(work)
    run = _Run(job)
    held = limits.apply_limits(limits.Limits(*job["limits"]))
    sys.path[:] = told["path"]
    stand_ins.install_stand_ins()
    _silence()
    guard.install_guard(work, told["closed"])
    gc.freeze()
    stage("ready")
    answer = run(stage)
    answer["held"] = held
    message_out = memoryview(wire.pack(answer))
    while message_out:
        message_out = message_out[os.write(reply, message_out) :]
    os._exit(0)


class _Run:
    """A job, and everything of the course that its run needs, imported before the stand-ins take its place."""

    def __init__(self, job: Mapping[str, Any]) -> None:
        from course.exercises import answer
        from course.grading import stand_ins
        from course.grading.wire import BODY_LIMIT

        self.job, self.answer, self.stand_ins, self.body_limit = (
            job,
            answer,
            stand_ins,
            BODY_LIMIT,
        )
        self._load_slow_packages()

    def __call__(self, stage: Stage) -> dict[str, Any]:
        """Run the cells, call the answer, and tell what came of both."""
        nothing = self.stand_ins.StandInForCourse()
        namespace: dict[str, Any] = {
            "__name__": "__main__", "exit": sys.exit, "quit": sys.exit, "display": nothing,
            "get_ipython": nothing, self.stand_ins.LATER_NAME: self.stand_ins.Later,
        }  # fmt: skip
        notes = []
        for index, (source, tolerant) in enumerate(self.job["cells"]):
            stage("cell", index)
            error = self._execute(source, index, namespace, tolerant)
            if error is not None:
                notes.append([index, self.answer.describe(error)])
        return {
            "notes": notes,
            **self._call(stage, namespace.get(self.job["name"], MISSING)),
        }

    def _load_slow_packages(self) -> None:
        """Their seconds of loading are not the student's."""
        import importlib

        from course.grading.needed import modules_used

        cells = self.job["cells"]
        preamble, answers = (
            [source for source, kept in cells if kept == tolerant]
            for tolerant in (True, False)
        )
        for name in modules_used(preamble, answers, self.stand_ins.SLOW):
            importlib.import_module(name)
        if self.job["kind"] == "expression":
            import sympy  # noqa: F401

    def _execute(
        self, source: str, index: int, namespace: dict[str, Any], tolerant: bool
    ) -> BaseException | None:
        """Run one cell and give back what it raised; a tolerant one goes on after a statement that fails."""
        name, printed = f"<cell {index}>", self.answer.Printed
        linecache.cache[name] = (
            len(source),
            None,
            [line + "\n" for line in source.splitlines()],
            name,
        )
        first: BaseException | None = None
        with (
            contextlib.redirect_stdout(printed()),
            contextlib.redirect_stderr(printed()),
        ):
            try:
                tree = self.stand_ins.with_later_imports(ast.parse(source, name))
                for part in [[node] for node in tree.body] if tolerant else [tree.body]:
                    try:
                        exec(
                            compile(
                                ast.Module(part, []), name, "exec", dont_inherit=True
                            ),
                            namespace,
                        )
                    except (
                        BaseException
                    ) as error:  # SystemExit too: a notebook goes on with its next cell
                        first = first or error
            except BaseException as error:
                first = first or error
        return first

    def _call(self, stage: Stage, value: Any) -> dict[str, Any]:
        """What the answer gave for each case, or why it was not called."""
        job, answer = self.job, self.answer
        if value is MISSING:
            return {"missing": True}
        if answer.is_stub(value, job["cells"][-1][0]):
            return {"blank": True}
        try:
            function = answer.as_function(
                value, job["kind"], job["name"], job["arguments"]
            )
        except Exception as error:
            return {"fault": str(error)[: answer.TEXT_LIMIT]}
        try:
            outcomes = answer.call_all(
                function, _told(stage, job["cases"]), job["results"]
            )
        except BaseException as error:  # KeyboardInterrupt goes through call_all: a student can raise it too
            return {"fault": "it stopped with " + answer.describe(error)}
        return {"outcomes": _sendable(outcomes, self.body_limit)}


def _told(
    stage: Stage, cases: Sequence[Mapping[str, Any]]
) -> Iterator[Mapping[str, Any]]:
    for index, case in enumerate(cases):
        stage("case", index)
        yield case


def _sendable(outcomes: Sequence[Any], limit: int) -> list[dict[str, Any]]:
    """The outcomes as plain values; arrays past the limit are told, not sent."""
    sent, plain = 0, []
    for outcome in outcomes:
        size = sum(array.nbytes for array in outcome.values)
        sent += size
        if sent > limit:
            text = f"expected a few numbers; got {size:,} bytes of them"
            plain.append(
                {"kind": "unreadable", "text": text, "printed": "", "values": []}
            )
            sent -= size
            continue
        plain.append(
            {
                "kind": outcome.kind,
                "text": outcome.text,
                "printed": outcome.printed,
                "values": list(outcome.values),
            }
        )
    return plain


def _silence() -> None:
    """Send what is printed past Python's own streams nowhere."""
    nowhere = os.open(os.devnull, os.O_WRONLY)
    os.dup2(nowhere, 1)
    os.dup2(nowhere, 2)


if __name__ == "__main__":
    main(sys.argv[1])
