"""JupyterLab over the workbook: its command line, its one kernel, a real start and its end by Ctrl-C.

What it looks like in a browser is tested in tests/browser.
"""

import json
import os
import re
import shutil
import signal
import socket
import subprocess
import sys
import time
import urllib.error
import urllib.request
from pathlib import Path

import pytest

from course.workbook import lab

ROOT = Path(__file__).resolve().parents[2]


def options(tmp_path, **more):
    said = lab.options(
        tmp_path, **{"notebook": tmp_path / "work" / "10-impulse (new 2).ipynb", **more}
    )
    return dict(option[2:].split("=", 1) for option in said)


def test_it_is_rooted_at_the_project_and_opens_the_notebook(tmp_path):
    said = options(tmp_path)
    assert said["ServerApp.root_dir"] == str(tmp_path)
    assert (
        said["LabApp.default_url"] == "/lab/tree/work/10-impulse%20%28new%202%29.ipynb"
    )
    assert said["LabApp.workspaces_dir"].startswith(str(tmp_path / "work"))
    assert said["ServerApp.open_browser"] == "True" and "ServerApp.port" not in said


def test_port_and_browser(tmp_path):
    said = options(tmp_path, port=8899, browser=False)
    assert (said["ServerApp.port"], said["ServerApp.open_browser"]) == ("8899", "False")
    assert (
        "ServerApp.port_retries" not in said
    )  # Jupyter's own default: the next ones are tried
    assert "LabApp.default_url" not in options(tmp_path, notebook=None)


def test_its_only_kernel_is_this_interpreter(tmp_path, monkeypatch):
    wrong = tmp_path / "kernels" / "python3"
    wrong.mkdir(parents=True)
    (wrong / "kernel.json").write_text(
        '{"argv": ["/no/such/python"], "display_name": "x", "language": "python"}'
    )
    monkeypatch.setenv("JUPYTER_PATH", str(tmp_path))
    monkeypatch.setenv("JUPYTER_DATA_DIR", str(tmp_path))
    from jupyter_client.kernelspec import KernelSpecManager

    assert (
        KernelSpecManager().get_kernel_spec("python3").argv[0] == "/no/such/python"
    )  # the trap is set
    kernels = lab.ThisPython()
    assert list(kernels.get_all_specs()) == ["python3"]
    assert kernels.get_kernel_spec("python3").argv[0] == sys.executable


def test_a_folder_is_put_first_once(monkeypatch, tmp_path):
    monkeypatch.setenv("PYTHONPATH", os.pathsep.join(["/other", str(tmp_path)]))
    for _ in range(2):
        lab.put_first("PYTHONPATH", tmp_path)
    assert os.environ["PYTHONPATH"] == os.pathsep.join([str(tmp_path), "/other"])
    monkeypatch.delenv("PYTHONPATH")
    lab.put_first("PYTHONPATH", tmp_path)
    assert os.environ["PYTHONPATH"] == str(tmp_path)


def test_what_it_leaves_out_is_named_as_jupyterlab_names_it():
    """A plugin renamed by a later JupyterLab would come back unnoticed."""
    folder = lab.CONFIGURATION
    page = json.loads((folder / "labconfig" / "page_config.json").read_text())
    settings = json.loads(
        (folder / "labconfig" / "default_setting_overrides.json").read_text()
    )
    assert set(page) == {"disabledExtensions"}
    schemas = Path(sys.prefix) / "share" / "jupyter" / "lab" / "schemas"
    if not schemas.is_dir():
        pytest.skip("JupyterLab's settings are not in this interpreter's own folder")
    for setting, values in settings.items():
        package, _, plugin = setting.partition(":")
        known = json.loads((schemas / package / f"{plugin}.json").read_text())
        assert values and set(values) <= set(known["properties"]), setting


def test_the_files_it_serves_are_the_workbook_s(tmp_path):
    said = options(tmp_path)
    assert said["ServerApp.contents_manager_class"].endswith(".WorkbookContents")
    assert "FileContentsManager.preferred_dir" not in said  # there is no work/ yet
    (tmp_path / "work").mkdir()
    assert options(tmp_path)["FileContentsManager.preferred_dir"] == "work"


@pytest.mark.slow
def test_all_that_ships_is_found_where_it_is_looked_for():
    """JupyterLab itself reads our settings from the folder that is put first."""
    code = (
        "from course.workbook import lab; lab.put_first('JUPYTER_CONFIG_PATH', lab.CONFIGURATION)\n"
        "from jupyterlab_server.settings_utils import _get_overrides; print(_get_overrides('/nowhere')[0])"
    )
    out = subprocess.run(
        [sys.executable, "-c", code],
        cwd=ROOT,
        capture_output=True,
        text=True,
        check=True,
    ).stdout
    assert "'fetchNews': 'false'" in out and "'Markdown Preview'" in out


def asked(address):
    """What the server answers; it prints its address a moment before it listens."""
    for _ in range(50):
        try:
            with urllib.request.urlopen(address, timeout=20) as answer:
                return json.load(answer)
        except urllib.error.URLError as problem:
            if not isinstance(problem.reason, ConnectionRefusedError):
                raise
            time.sleep(0.1)
    raise TimeoutError(address)


@pytest.mark.slow
@pytest.mark.skipif(os.name == "nt", reason="sends Ctrl-C to a process group")
def test_a_real_start_on_a_taken_port_and_its_end(tmp_path):
    """A home of its own with a kernel that would not start; the port is taken; Ctrl-C ends it without a word."""
    root, home = tmp_path / "project", tmp_path / "home"
    shutil.copytree(
        ROOT / "course", root / "course", ignore=shutil.ignore_patterns("__pycache__")
    )
    for name in ("pyproject.toml", "requirements.lock", "requirements-all.lock"):
        shutil.copy(ROOT / name, root / name)
    (root / "lessons").mkdir()
    empty = '{"cells": [], "metadata": {}, "nbformat": 4, "nbformat_minor": 5}'
    for name in ("10-impulse", "11-x"):
        (root / "lessons" / f"{name}.ipynb").write_text(empty)
    wrong = home / ".local" / "share" / "jupyter" / "kernels" / "python3"
    wrong.mkdir(parents=True)
    (wrong / "kernel.json").write_text(
        '{"argv": ["/no/such/python"], "display_name": "x", "language": "python"}'
    )
    kept = {
        k: v
        for k, v in os.environ.items()
        if not k.startswith(("JUPYTER_", "IPYTHONDIR", "PYTHONPATH"))
    }
    with socket.socket() as taken:
        taken.bind(("127.0.0.1", 0))
        taken.listen()
        port = taken.getsockname()[1]
        command = [
            sys.executable,
            "-m",
            "course",
            "open",
            "10",
            "--no-browser",
            "--port",
            str(port),
        ]
        server = subprocess.Popen(command, cwd=root, env={**kept, "HOME": str(home)}, text=True, start_new_session=True,
                                  stdout=subprocess.PIPE, stderr=subprocess.STDOUT)  # fmt: skip
        said = []
        for line in server.stdout:
            said.append(line)
            address = re.search(r"(http://127\.0\.0\.1:(\d+))/(\S*)\?token=(\w+)", line)
            if address:
                break
        assert address, "".join(said)
        assert (
            int(address[2]) != port and address[3] == "lab/tree/work/10-impulse.ipynb"
        )
        specs = asked(f"{address[1]}/api/kernelspecs?token={address[4]}")
        content = asked(f"{address[1]}/api/contents/work?token={address[4]}")
        other = asked(f"{address[1]}/api/contents/work/11-x.ipynb?token={address[4]}")
        with urllib.request.urlopen(f"{address[1]}/custom/custom.css") as answer:
            style = answer.read().decode()
    os.killpg(server.pid, signal.SIGINT)
    rest, _ = server.communicate(timeout=30)
    assert server.returncode == 0 and "Traceback" not in rest
    assert list(specs["kernelspecs"]) == ["python3"]
    assert specs["kernelspecs"]["python3"]["spec"]["argv"][0] == sys.executable
    assert [entry["name"] for entry in content["content"]] == ["10-impulse.ipynb"]
    assert other["path"] == "work/11-x.ipynb" and other["writable"]
    assert style == (lab.CONFIGURATION / "custom" / "custom.css").read_text()
    assert not (
        home / ".jupyter" / "lab"
    ).exists()  # no settings of ours in the user's home
