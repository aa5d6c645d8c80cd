"""JupyterLab over the workbook: its command line, its one kernel, and the whole in a real browser."""

import json
import os
import subprocess
import sys
from pathlib import Path

import pytest

from course.workbook import lab

ROOT = Path(__file__).resolve().parents[2]


def options(tmp_path, **more):
    said = lab.options(tmp_path, **{"notebook": tmp_path / "work" / "10-impulse (new 2).ipynb", **more})
    return dict(option[2:].split("=", 1) for option in said)


def test_it_is_rooted_at_the_project_and_opens_the_notebook(tmp_path):
    said = options(tmp_path)
    assert said["ServerApp.root_dir"] == str(tmp_path)
    assert said["LabApp.default_url"] == "/lab/tree/work/10-impulse%20%28new%202%29.ipynb"
    assert said["LabApp.workspaces_dir"].startswith(str(tmp_path / "work"))
    assert said["ServerApp.open_browser"] == "True" and "ServerApp.port" not in said


def test_port_and_browser(tmp_path):
    said = options(tmp_path, port=8899, browser=False)
    assert (said["ServerApp.port"], said["ServerApp.open_browser"]) == ("8899", "False")
    assert "ServerApp.port_retries" not in said               # Jupyter's own default: the next ones are tried
    assert "LabApp.default_url" not in options(tmp_path, notebook=None)


def test_its_only_kernel_is_this_interpreter(tmp_path, monkeypatch):
    wrong = tmp_path / "kernels" / "python3"
    wrong.mkdir(parents=True)
    (wrong / "kernel.json").write_text(json.dumps({"argv": ["/no/such/python"], "display_name": "x", "language": "python"}))
    monkeypatch.setenv("JUPYTER_PATH", str(tmp_path))
    monkeypatch.setenv("JUPYTER_DATA_DIR", str(tmp_path))
    from jupyter_client.kernelspec import KernelSpecManager

    assert KernelSpecManager().get_kernel_spec("python3").argv[0] == "/no/such/python"      # the trap is set
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
    settings = json.loads((folder / "labconfig" / "default_setting_overrides.json").read_text())
    assert set(page) == {"disabledExtensions"}
    schemas = Path(sys.prefix) / "share" / "jupyter" / "lab" / "schemas"
    if not schemas.is_dir():
        pytest.skip("JupyterLab's settings are not in this interpreter's own folder")
    known = json.loads((schemas / "@jupyterlab" / "apputils-extension" / "notification.json").read_text())["properties"]
    assert set(settings) == {"@jupyterlab/apputils-extension:notification"}
    assert set(settings["@jupyterlab/apputils-extension:notification"]) <= set(known)


@pytest.mark.slow
def test_all_that_ships_is_found_where_it_is_looked_for():
    """JupyterLab itself reads our settings from the folder that is put first."""
    code = (
        "from pathlib import Path; from course.workbook import lab; lab.put_first('JUPYTER_CONFIG_PATH', lab.CONFIGURATION)\n"
        "from jupyterlab_server.settings_utils import _get_overrides; print(_get_overrides('/nowhere')[0])"
    )
    out = subprocess.run([sys.executable, "-c", code], cwd=ROOT, capture_output=True, text=True, check=True).stdout
    assert "'fetchNews': 'false'" in out
