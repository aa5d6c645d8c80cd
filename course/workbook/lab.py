"""JupyterLab over this workbook: rooted at the project, opened at a notebook, quiet, with this Python's kernel only.

What JupyterLab is told to leave out (the question about news, Voila's button) stands in the folder ``jupyter`` beside
this file. Nothing of ours is written outside work/: the arrangement of tabs is kept in work/.jupyter, so that the
tabs of other projects do not turn up here. Jupyter's own files (the student's settings, run-time files) stay where
they are.
"""

from __future__ import annotations

import os
import signal
from pathlib import Path
from typing import Any
from urllib.parse import quote

from jupyter_client.kernelspec import KernelSpec, KernelSpecManager
from traitlets import default

CONFIGURATION = Path(__file__).with_name("jupyter")


class ThisPython(KernelSpecManager):
    """Knows one kernel, ``python3``: the running interpreter, whatever kernels the user has installed elsewhere."""

    @default("kernel_dirs")
    def _no_other_kernels(self) -> list[str]:
        return []

    def get_kernel_spec(self, kernel_name: str) -> KernelSpec:
        """The kernel, told to keep remarks about its own transport off the student's terminal."""
        spec = super().get_kernel_spec(kernel_name)
        spec.argv = [*spec.argv, "--log-level=ERROR"]
        return spec


def start(
    root: Path, notebook: Path | None, *, port: int | None, browser: bool
) -> None:
    """Serve JupyterLab until Ctrl-C. ``notebook`` (below ``root``) is opened; a taken port gets the next one."""
    # While it loads there is nothing to tidy up, and an interrupt in the midst of imports can get lost.
    signal.signal(signal.SIGINT, lambda number, frame: os._exit(130))
    from jupyterlab.labapp import LabApp

    put_first(
        "PYTHONPATH", root
    )  # kernels start in the notebook's folder, not in the project's
    put_first("JUPYTER_CONFIG_PATH", CONFIGURATION)
    server = LabApp.initialize_server(
        argv=options(root, notebook, port=port, browser=browser)
    )
    # Jupyter's own handler asks back, and without a terminal it leaves the interrupt to wherever it strikes.
    signal.signal(signal.SIGINT, lambda number, frame: server.stop(from_signal=True))
    server.start()


def put_first(variable: str, folder: Path) -> None:
    """Put a folder before the others that an environment variable lists."""
    others = [
        path
        for path in os.environ.get(variable, "").split(os.pathsep)
        if path and path != str(folder)
    ]
    os.environ[variable] = os.pathsep.join([str(folder), *others])


def options(
    root: Path, notebook: Path | None, *, port: int | None = None, browser: bool = True
) -> list[str]:
    """JupyterLab's command line; what stands there is stronger than the user's own configuration files."""
    chosen: dict[str, Any] = {
        "Application.log_level": "ERROR",  # the address is logged above that
        "ServerApp.root_dir": root,
        "ServerApp.open_browser": browser,
        "ServerApp.kernel_spec_manager_class": f"{__name__}.{ThisPython.__name__}",
        "LabApp.news_url": None,
        "LabApp.check_for_updates_class": "jupyterlab.handlers.announcements.NeverCheckForUpdate",
        "LabApp.workspaces_dir": root / "work" / ".jupyter" / "workspaces",
    }
    if port is not None:
        chosen["ServerApp.port"] = port
    if hasattr(os, "geteuid") and os.geteuid() == 0:
        chosen["ServerApp.allow_root"] = True  # in a container everybody is root
    if notebook is not None:
        chosen["LabApp.default_url"] = "/lab/tree/" + quote(
            notebook.relative_to(root).as_posix()
        )
    return [f"--{name}={value}" for name, value in chosen.items()]
