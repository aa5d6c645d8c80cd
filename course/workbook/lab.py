"""JupyterLab for this workbook: rooted at the project, opened at a notebook, quiet.

It offers this Python's kernel only. The folder ``jupyter`` beside this file turns off
the rest (the question about news, Voila's button), renders a page of text that is opened,
and keeps lines to a width that can be read. The files are served by ``contents``: a link
to a lesson makes its working copy. Nothing of ours is written outside
work/: the arrangement of tabs is kept in work/.course, so that tabs of other projects
do not appear here. Jupyter's own files (the student's settings, runtime files) stay
where they are.
"""

from __future__ import annotations

import contextlib
import os
import signal
from pathlib import Path
from typing import Any
from urllib.parse import quote

from jupyter_client.kernelspec import KernelSpec, KernelSpecManager
from traitlets import default

from course.workbook.course_folder import kept
from course.workbook.notebook import OURS

CONFIGURATION = Path(__file__).with_name("jupyter")


class ThisPython(KernelSpecManager):
    """Knows one kernel, ``python3``: the running interpreter, whatever the user
    installed.
    """

    @default("kernel_dirs")
    def _no_other_kernels(self) -> list[str]:
        return []

    def get_kernel_spec(self, kernel_name: str) -> KernelSpec:
        """The kernel, with remarks about its own transport kept off the student's
        terminal.
        """
        spec = super().get_kernel_spec(kernel_name)
        spec.argv = [*spec.argv, "--log-level=ERROR"]
        return spec


def start(
    root: Path, notebook: Path | None, *, port: int | None, browser: bool
) -> None:
    """Serve JupyterLab until Ctrl-C. ``notebook`` (below ``root``) is opened.

    If the port is taken, the next free one is used.
    """
    # While it loads there is nothing to clean up, and an interrupt during imports can
    # get lost.
    signal.signal(signal.SIGINT, lambda number, frame: os._exit(130))
    from jupyterlab.labapp import LabApp

    put_first(
        "PYTHONPATH", root
    )  # kernels start in the notebook's folder, not in the project's
    put_first("JUPYTER_CONFIG_PATH", CONFIGURATION)
    os.environ[OURS] = "1"
    with contextlib.suppress(OSError):
        (root / "work").mkdir(exist_ok=True)  # the file browser opens there
    server = LabApp.initialize_server(
        argv=options(root, notebook, port=port, browser=browser)
    )
    # Jupyter's own handler asks first; without a terminal the interrupt then hits an
    # arbitrary place.
    signal.signal(signal.SIGINT, lambda number, frame: server.stop(from_signal=True))
    server.start()


def put_first(variable: str, folder: Path) -> None:
    """Put a folder before the others in an environment variable's list."""
    others = [
        path
        for path in os.environ.get(variable, "").split(os.pathsep)
        if path and path != str(folder)
    ]
    os.environ[variable] = os.pathsep.join([str(folder), *others])


def options(
    root: Path, notebook: Path | None, *, port: int | None = None, browser: bool = True
) -> list[str]:
    """JupyterLab's command line, which overrides the user's own configuration files."""
    chosen: dict[str, Any] = {
        "Application.log_level": "ERROR",  # the address is logged above that
        "ServerApp.root_dir": root,
        "ServerApp.open_browser": browser,
        "ServerApp.kernel_spec_manager_class": f"{__name__}.{ThisPython.__name__}",
        "ServerApp.kernel_websocket_connection_class": "course.workbook.prompt_channel.PromptChannel",
        "ServerApp.contents_manager_class": "course.workbook.contents.WorkbookContents",
        "ServerApp.tornado_settings": {
            "static_custom_path": [str(CONFIGURATION / "custom")]
        },
        "LabApp.custom_css": True,
        "LabApp.extra_labextensions_path": CONFIGURATION / "labextensions",
        "LabApp.news_url": None,
        "LabApp.check_for_updates_class": "jupyterlab.handlers.announcements.NeverCheckForUpdate",
        "LabApp.workspaces_dir": kept(root / "work", "workspaces"),
    }
    if (root / "work").is_dir():
        chosen["FileContentsManager.preferred_dir"] = "work"
    if port is not None:
        chosen["ServerApp.port"] = port
    if hasattr(os, "geteuid") and os.geteuid() == 0:
        chosen["ServerApp.allow_root"] = True  # in a container everybody is root
    if notebook is not None:
        chosen["LabApp.default_url"] = "/lab/tree/" + quote(
            notebook.relative_to(root).as_posix()
        )
    return [f"--{name}={value}" for name, value in chosen.items()]
