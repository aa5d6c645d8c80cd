"""Where a box of the operating system can be had."""

import shutil
import subprocess
import sys

import pytest

PROBE = ["bwrap", "--unshare-all", "--die-with-parent", "--ro-bind", "/", "/", "true"]


def why_no_box() -> str:
    """Why no box of the operating system can be had here; empty where one can."""
    if not sys.platform.startswith("linux") or shutil.which("bwrap") is None:
        return "bubblewrap is not there"
    tried = subprocess.run(PROBE, capture_output=True, text=True, timeout=60)
    return (
        "bubblewrap cannot run here: " + tried.stderr.strip()
        if tried.returncode
        else ""
    )


@pytest.fixture(scope="session")
def box():
    """Skips what only a box of the operating system can stop, where there is none."""
    if reason := why_no_box():
        pytest.skip(reason)
