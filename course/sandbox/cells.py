"""Cells as a kernel runs them: one namespace, one event loop for all, their numbers, and what they gave."""

from __future__ import annotations
import __future__

import ast
import asyncio
import contextlib
import inspect
import sys
from collections.abc import Iterator, Sequence
from types import CodeType, SimpleNamespace
from typing import Any

from course.exercises.answer import Printed
from course.sandbox import stand_ins
from course.sandbox.attempts import Attempts
from course.sandbox.magics import kernel_shell
from course.sandbox.plan import Step

DEEP = 5_000
#: What a kernel had and this one lacks: the rest of the cell is tried all the same.
MISSED = (ModuleNotFoundError, FileNotFoundError)
#: For tasks that a cell left running, before the next cell [s]; in a kernel they go on meanwhile.
BETWEEN_CELLS = 0.2
#: For a cell that was interrupted to come to its end [s].
TO_STOP = 0.5


class Cells:
    """IPython's reading of cells and its namespace, without a terminal."""

    def __init__(self, attempts: Attempts) -> None:
        nothing = stand_ins.StandInForCourse()
        self._shell = kernel_shell(attempts)
        self.namespace: dict[str, Any] = self._shell.user_ns
        self.namespace |= {
            "exit": sys.exit,
            "quit": sys.exit,
            "display": nothing,
            "get_ipython": lambda: self._shell,
            stand_ins.LATER_NAME: stand_ins.Later,
        }
        self._attempts = attempts
        self._flags = ast.PyCF_ALLOW_TOP_LEVEL_AWAIT
        self._loop = asyncio.new_event_loop()
        asyncio.set_event_loop(self._loop)
        sys.displayhook = self._displayed

    def execute(self, step: Step) -> BaseException | None:
        """Run one cell and give back what it raised first.

        A tolerant cell goes on after a statement that fails, and every cell after one that was refused something or
        missed what is not here: in the kernel it would have worked.
        """
        if not step.source.strip():
            return None
        self._attempts.cell = step.index
        with (
            contextlib.redirect_stdout(Printed()),
            contextlib.redirect_stderr(Printed()),
        ):
            try:
                codes = self._codes(step)
            except BaseException as error:
                return error
            task = self._loop.create_task(self._statements(codes, step.tolerant))
            try:
                return self._loop.run_until_complete(task)
            except BaseException as error:  # while it waited, or of another task
                self._stop(task)
                return error

    def _stop(self, task: asyncio.Task[Any]) -> None:
        task.cancel()
        with contextlib.suppress(BaseException):
            self._loop.run_until_complete(asyncio.wait([task], timeout=TO_STOP))

    async def _statements(
        self, codes: Sequence[CodeType], tolerant: bool
    ) -> BaseException | None:
        first: BaseException | None = None
        for code in codes:
            before = self._attempts.count
            try:
                if code.co_flags & inspect.CO_COROUTINE:
                    await eval(code, self.namespace)
                else:
                    exec(code, self.namespace)
            except (
                BaseException
            ) as error:  # SystemExit too: a notebook goes on with its next cell
                first = first or error
                if isinstance(error, MISSED):
                    self._attempts.miss(f"{type(error).__name__}: {error}"[:200])
                tolerant = tolerant or self._attempts.count > before
                stopped = isinstance(error, (KeyboardInterrupt, asyncio.CancelledError))
                if stopped or not tolerant:
                    break
        self._shell.events.trigger("post_execute")
        await asyncio.sleep(0)
        if others := asyncio.all_tasks() - {asyncio.current_task()}:
            await asyncio.wait(others, timeout=BETWEEN_CELLS)
        return first

    def _codes(self, step: Step) -> list[CodeType]:
        with _deeper():
            source = self._shell.transform_cell(step.source)
            self._begin(step, source)
            name = self._shell.compile.cache(source, step.index, raw_code=step.source)
            tree = stand_ins.with_later_imports(ast.parse(source, name))
            shown = self._shown(tree.body)
            return [self._compiled(node, name, node in shown) for node in tree.body]

    def _begin(self, step: Step, source: str) -> None:
        """Give the cell its number, keep what it says, and tell who wants to know."""
        self._shell.execution_count = step.number + 1
        self._shell.history_manager.store_inputs(step.number, source, step.source)
        self._shell.events.trigger("pre_execute")
        self._shell.events.trigger("pre_run_cell", SimpleNamespace(raw_cell=step.source))  # fmt: skip

    def _shown(self, body: Sequence[ast.stmt]) -> Sequence[ast.stmt]:
        """The statements whose value a kernel shows, and keeps as ``_``."""
        wanted = body if self._shell.ast_node_interactivity == "all" else body[-1:]
        return [node for node in wanted if isinstance(node, ast.Expr)]

    def _compiled(self, node: ast.stmt, name: str, shown: bool) -> CodeType:
        if isinstance(node, ast.ImportFrom) and node.module == "__future__":
            for alias in node.names:
                feature = getattr(__future__, alias.name, None)
                self._flags |= getattr(feature, "compiler_flag", 0)
        if shown:
            only = ast.Interactive([node])
            return compile(only, name, "single", self._flags, dont_inherit=True)
        module = ast.Module([node], [])
        return compile(module, name, "exec", self._flags, dont_inherit=True)

    def _displayed(self, value: Any) -> None:
        """Keep what a cell gave; nobody looks at it."""
        if value is not None and not self._shell.displayhook.quiet():
            self._shell.displayhook.update_user_ns(value)


@contextlib.contextmanager
def _deeper() -> Iterator[None]:
    """Compiling from a tree counts its depth: a thousand elif are a thousand blocks in each other."""
    limit = sys.getrecursionlimit()
    sys.setrecursionlimit(max(limit, DEEP))
    try:
        yield
    finally:
        sys.setrecursionlimit(limit)
