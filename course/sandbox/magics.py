"""The shell that reads cells: IPython's own, with the magics of a kernel, and without a machine to command."""

from __future__ import annotations

import contextlib
import re
from collections.abc import Callable
from typing import Any

from course.sandbox.attempts import Attempts

#: Magics that draw, ask or install, and bind nothing that an answer could need.
IDLE = (
    "matplotlib pip conda mamba micromamba uv pinfo pinfo2 debug pdb html javascript js latex svg "
    "autosave clear cls less more man edit connect_info qtconsole subshell notebook"
).split()
#: Magics whose cell is for another program.
SCRIPTS = "bash sh script python python2 python3 pypy perl ruby cmd".split()
#: Options by which such a cell hands over what it said.
HANDS_OVER = re.compile(r"--(out|err|proc)\b")


def kernel_shell(attempts: Attempts) -> Any:
    """IPython's shell under the name that it has in a kernel, by which programs tell where they are."""
    from IPython.core.interactiveshell import InteractiveShell
    from traitlets.config import Config

    config = Config()
    config.HistoryManager.enabled = False
    config.IPKernelApp.parent_appname = "notebook"
    named: Any = type("ZMQInteractiveShell", (InteractiveShell,), {})
    shell: Any = named.instance(config=config)
    shell.display_formatter.active_types = ["text/plain"]
    _without_commands(shell, attempts)
    _with_magics(shell, attempts)
    return shell


def _without_commands(shell: Any, attempts: Attempts) -> None:
    from IPython.utils.text import SList

    def unheard(command: str, *_: Any, **__: Any) -> None:
        attempts.command(command, wanted=False)

    def nothing(command: str, *_: Any, **__: Any) -> Any:
        attempts.command(command, wanted=True)
        return SList()

    shell.system = shell.system_raw = shell.system_piped = unheard
    shell.getoutput = nothing


def _with_magics(shell: Any, attempts: Attempts) -> None:
    def script(line: str, cell: str = "") -> None:
        attempts.command(cell or line, wanted=HANDS_OVER.search(line) is not None)

    running = shell.magics_manager.registry["ExecutionMagics"]
    own: dict[str, Callable[..., Any]] = dict.fromkeys(IDLE, _idle)
    own |= dict.fromkeys(SCRIPTS, script)
    own |= {"prun": _quietly(running.prun), "timeit": _once(running)}
    for name, function in own.items():
        for kind in ("line", "cell"):
            shell.register_magic_function(function, magic_kind=kind, magic_name=name)
    with contextlib.suppress(Exception):  # its folder cannot be made: no more than that
        shell.extension_manager.load_extension("storemagic")


def _idle(*_: Any, **__: Any) -> None:
    return None


def _quietly(profiled: Callable[..., Any]) -> Callable[..., Any]:
    def prun(line: str, cell: str | None = None) -> Any:
        return profiled(f"-q {line}", cell)

    return prun


def _once(running: Any) -> Callable[..., Any]:
    """A measurement takes seconds and binds nothing, but where its result is asked for: that one is made once."""

    def timeit(line: str, cell: str | None = None) -> Any:
        options, statement = running.parse_options(
            line, "n:r:tcp:qov:", posix=False, strict=False, preserve_non_opts=True
        )
        if "o" not in options and "v" not in options:
            return None
        name = f"-v {options['v']} " if "v" in options else ""
        return running.timeit(f"-q -o -n1 -r1 {name}{statement}", cell)

    return timeit
