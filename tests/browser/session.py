"""A JupyterLab of the project's own, or a Voila, in the system's Chromium: what a student sees, driven by a test."""

from __future__ import annotations

import atexit
import contextlib
import functools
import os
import re
import shutil
import signal
import socket
import subprocess
import sys
import time
from collections.abc import Iterator
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]
FLAGS = [
    "--no-sandbox", "--disable-quic", "--no-first-run", "--disable-background-networking",
    "--disable-component-update", "--disable-sync",
]  # fmt: skip


def chromium() -> str | None:
    """The system's Chromium or Chrome; None where there is none."""
    names = ("chromium", "chromium-browser", "google-chrome", "chrome")
    return next((found for name in names if (found := shutil.which(name))), None)


def free_port() -> int:
    """A port that nobody listens on at this moment."""
    with socket.socket() as probe:
        probe.bind(("127.0.0.1", 0))
        return int(probe.getsockname()[1])


def checkout(folder: Path) -> Path:
    """A copy of the project in ``folder`` (code and lessons, no work/), so that a test's work is not the student's."""
    for name in (
        "course",
        "lessons",
        "pyproject.toml",
        "requirements.lock",
        "requirements-all.lock",
    ):
        source = ROOT / name
        if source.is_dir():
            shutil.copytree(
                source, folder / name, ignore=shutil.ignore_patterns("__pycache__")
            )
        else:
            shutil.copy(source, folder / name)
    return folder


@contextlib.contextmanager
def served(arguments: list[str], root: Path) -> Iterator[str]:
    """``python -m course ARGUMENTS`` at ``root``, until its address is known; yields the address, ends it after."""
    environment = dict(
        os.environ, PYTHONPATH=str(root), JUPYTER_RUNTIME_DIR=str(root / ".runtime")
    )
    log = root / "server.log"
    with log.open("w") as sink:
        server = subprocess.Popen(
            [sys.executable, "-m", "course", *arguments], cwd=root, env=environment, stdout=sink,
            stderr=subprocess.STDOUT, start_new_session=True,
        )  # fmt: skip
    try:
        yield _address(server, log)
    finally:
        os.killpg(server.pid, signal.SIGINT)
        try:
            server.wait(15)
        except subprocess.TimeoutExpired:
            os.killpg(server.pid, signal.SIGKILL)


def _address(server: subprocess.Popen[bytes], log: Path) -> str:
    deadline = time.monotonic() + 240
    while time.monotonic() < deadline:
        text = log.read_text(errors="replace")
        found = re.search(r"http://(?:127\.0\.0\.1|localhost):\d+/\S*", text)
        if found:
            return found.group(0)
        if server.poll() is not None:
            raise RuntimeError(
                f"the server ended with code {server.returncode}:\n{text}"
            )
        time.sleep(0.1)
    raise TimeoutError(f"no address within 240 s:\n{log.read_text(errors='replace')}")


@contextlib.contextmanager
def page(width: int = 1280, height: int = 1000):
    """A page of a new browser profile; what it logs as errors is in ``page.console_errors``."""
    browser = _playwright().chromium.launch(executable_path=chromium(), args=FLAGS)
    try:
        opened = browser.new_page(
            viewport={"width": width, "height": height}, device_scale_factor=1
        )
        opened.set_default_timeout(120_000)
        opened.console_errors = []
        opened.on(
            "console",
            lambda m: (
                opened.console_errors.append(m.text) if m.type == "error" else None
            ),
        )
        yield opened
    finally:
        browser.close()


@functools.cache
def _playwright():
    """The one driver of this process: two at once in a thread refuse each other, and pages here overlap."""
    from playwright.sync_api import sync_playwright

    driver = sync_playwright().start()
    atexit.register(driver.stop)
    return driver


class Lab:
    """An open notebook in JupyterLab: find a cell by what it says, write into it, run it, read what comes."""

    def __init__(self, opened, address: str) -> None:
        self.page = opened
        opened.goto(address)
        opened.wait_for_selector(".jp-Notebook .jp-Cell", timeout=240_000)
        opened.keyboard.press(
            "Control+b"
        )  # the file browser away: room for the notebook
        opened.wait_for_selector(".jp-NotebookPanel-toolbar", timeout=120_000)
        # It says "idle" before there is a kernel too, and who runs a cell then is asked to choose one.
        opened.wait_for_function(
            "document.querySelector('.jp-Notebook-ExecutionIndicator')?.dataset.status === 'idle' && "
            "!/No Kernel/.test(document.querySelector('.jp-Toolbar-kernelName')?.innerText ?? 'No Kernel')"
        )

    def run_all(self, *, seconds: float = 400) -> None:
        """Run every cell; the first try after loading is sometimes lost, so it is repeated until a prompt shows."""
        ran = "[...document.querySelectorAll('.jp-InputPrompt')].some(p => /\\[(\\*|\\d+)\\]/.test(p.innerText))"
        for _ in range(5):
            if self.page.locator(
                "dialog"
            ).count():  # a kernel that starts slowly may have brought one up
                self.page.keyboard.press("Escape")
            self.page.click(".lm-MenuBar-itemLabel:text-is('Run')")
            self.page.click(
                ".lm-Menu-itemLabel:text-is('Run All Cells')"
            )  # not "Restart Kernel and Run All Cells"
            with contextlib.suppress(
                Exception
            ):  # playwright's own time-out class is not imported here
                self.page.wait_for_function(ran, timeout=40_000)
                break
        self.wait_idle(seconds)

    def wait_idle(self, seconds: float = 200) -> None:
        """Until nothing runs or waits to run."""
        self.page.wait_for_timeout(400)
        self.page.wait_for_function(
            "document.querySelector('.jp-Notebook-ExecutionIndicator').dataset.status === 'idle' && "
            "![...document.querySelectorAll('.jp-InputPrompt')].some(p => p.innerText.includes('*'))",
            timeout=seconds * 1000,
        )

    def cell(self, text: str):
        """The code cell of the notebook in front that contains ``text``, scrolled into view."""
        front = ".jp-NotebookPanel:not(.lm-mod-hidden) .jp-CodeCell"
        found = self.page.locator(front, has_text=text).first
        found.scroll_into_view_if_needed()
        return found

    def write_and_run(self, text: str, source: str, *, seconds: float = 200):
        """Replace the source of the cell that contains ``text``, run it, and return the cell."""
        cell = self.cell(text)
        cell.locator(".cm-content").click()
        self.page.keyboard.press("Control+a")
        self.page.keyboard.insert_text(source)
        self.page.keyboard.press("Control+Enter")
        self.wait_idle(seconds)
        return cell
