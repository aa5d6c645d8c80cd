"""JupyterLab over this workbook: rooted at the project, opened at a notebook, quiet, with this Python's kernel only.

Nothing is written outside work/ but what Jupyter itself keeps (the student's own settings, the server's run-time
files): the arrangement of tabs lives in work/.jupyter, so that other projects' tabs do not turn up here.
"""

from __future__ import annotations

import os
import warnings
from pathlib import Path
from urllib.parse import quote

from jupyter_client.kernelspec import KernelSpecManager
from traitlets import default


class ThisPython(KernelSpecManager):
    """Knows one kernel, ``python3``: the running interpreter, whatever kernels the user has installed elsewhere."""

    ensure_native_kernel = True

    @default("kernel_dirs")
    def _no_other_kernels(self) -> list[str]:
        return []


def start(root: Path, notebook: Path | None, *, port: int | None, browser: bool) -> None:
    """Serve JupyterLab until Ctrl-C. ``notebook`` (below ``root``) is opened; a taken port gets the next one."""
    from jupyterlab.labapp import LabApp

    let_kernels_find_course(root)
    warnings.filterwarnings("ignore", message="ServerApp.token config is deprecated")   # Jupyter's own affair
    LabApp.launch_instance(argv=options(root, notebook, port=port, browser=browser))


def let_kernels_find_course(root: Path) -> None:
    """Put this checkout first for every kernel: their folder is the notebook's, not the project's."""
    before = os.environ.get("PYTHONPATH", "")
    if before.split(os.pathsep)[0] != str(root):
        os.environ["PYTHONPATH"] = os.pathsep.join(filter(None, [str(root), before]))


def options(root: Path, notebook: Path | None, *, port: int | None = None, browser: bool = True) -> list[str]:
    """JupyterLab's command line; what stands there is stronger than the user's own configuration files."""
    chosen = {
        "Application.log_level": "WARN",        # the address and how to end it are logged above that
        "ServerApp.root_dir": root,
        "ServerApp.open_browser": browser,
        "ServerApp.answer_yes": True,           # Ctrl-C ends it without asking back
        "ServerApp.kernel_spec_manager_class": f"{__name__}.{ThisPython.__name__}",
        "LabApp.news_url": None,                # no pop-up that asks about announcements, no fetching of them
        "LabApp.check_for_updates_class": "jupyterlab.handlers.announcements.NeverCheckForUpdate",
        "LabApp.workspaces_dir": root / "work" / ".jupyter" / "workspaces",
    }
    if port is not None:
        chosen["ServerApp.port"] = port
    if hasattr(os, "geteuid") and os.geteuid() == 0:
        chosen["ServerApp.allow_root"] = True   # in a container everybody is root
    if notebook is not None:
        chosen["LabApp.default_url"] = "/lab/tree/" + quote(notebook.relative_to(root).as_posix())
    return [f"--{name}={value}" for name, value in chosen.items()]
