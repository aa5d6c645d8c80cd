"""Finding or making the environment: every state a .venv can be in, every way a set-up can be cut off or fail."""

import ast
import errno
import json
import os
import re
import shutil
import signal
import subprocess
import sys
import time
from collections import namedtuple
from pathlib import Path

import pytest
import tiny_project

from course import environment, installation
from course.environment import MARKER, SetupError

ROOT = Path(__file__).resolve().parents[1]
OLD_PYTHON = ["course/__init__.py", "course/__main__.py", "course/environment.py"]


# Requirements and locks


@pytest.mark.parametrize(
    "requirement, version, met",
    [
        ("a>=1.2", "1.2", True),
        ("a>=1.2", "1.2.0", True),
        ("a>=1.2.0", "1.2", True),
        ("a>=1.2", "1.10", True),
        ("a>=1.2", "1.1.9", False),
        ("a>=3.11,<4", "3.12.1", True),
        ("a>=3.11,<4", "4.0", False),
        ("a>=2", "2.1rc1", True),
        ("a==1.5", "1.5.0", True),
        ("a!=1.5", "1.5", False),
        ("a<=1.5, >1", "1.5", True),
        ("a", "0.1", True),
    ],
)
def test_a_version_keeps_its_bounds(requirement, version, met):
    name, bounds = environment.parse_requirement(requirement)
    assert name == "a"
    assert environment.within(version, bounds) is met


@pytest.mark.parametrize(
    "requirement",
    [
        "a~=1.2",
        "a[more]>=1; python_version < '3.12'",
        "a[more]>=1",
        "a @ file:///x",
        ">=1",
    ],
)
def test_a_requirement_in_a_form_not_used_here_is_refused(requirement):
    with pytest.raises(ValueError, match="expected name>=X,<Y, got"):
        environment.parse_requirement(requirement)


@pytest.mark.parametrize(
    "marker, asked",
    [
        ("python_version < '3.12'", False),
        ('python_version<"3.12"', False),
        ("python_version >= '3.9'", True),
        ("python_version < '3.13' and sys_platform == 'darwin'", True),
        ("python_version < '3.13' and sys_platform != 'darwin'", False),
        ("sys_platform != 'darwin' or platform_machine == 'arm64'", True),
        ("sys_platform != 'darwin' or platform_machine != 'arm64'", False),
    ],
)
def test_a_marker_says_where_a_requirement_is_asked(monkeypatch, marker, asked):
    monkeypatch.setattr(sys, "version_info", (3, 12, 4, "final", 0))
    monkeypatch.setattr(sys, "platform", "darwin")
    monkeypatch.setattr("platform.machine", lambda: "arm64")
    assert environment.is_asked_here(f"a>=1; {marker}") is asked
    assert environment.parse_requirement(f"a>=1; {marker}") == ("a", [(">=", (1,))])
    assert environment.unmet([f"no-such-thing; {marker}"]) == (
        [f"no-such-thing; {marker}"] if asked else []
    )


@pytest.mark.parametrize(
    "marker",
    ["os_name == 'nt'", "(python_version < '3')", "sys_platform < 'win32'", "extra"],
)
def test_a_marker_in_a_form_not_used_here_is_refused(marker):
    with pytest.raises(ValueError, match="expected a plain marker, got"):
        environment.is_asked_here(f"a>=1; {marker}")


def test_unmet_requirements_are_those_missing_or_too_old(tmp_path):
    (tmp_path / "pyproject.toml").write_text(
        '[project]\ndependencies = ["pytest>=1", "numpy>=999", "no-such-thing>=1"]\n'
        "[project.optional-dependencies]\n"
        'more = ["another-missing"]\ntest = ["pytest>=998"]\nworkbook = ["pip>=997"]\n'
    )
    everyday = ["numpy>=999", "no-such-thing>=1", "pytest>=998", "pip>=997"]
    assert environment.unmet_requirements(tmp_path) == everyday
    found = environment.unmet_requirements(tmp_path, extras=True)
    assert sorted(found) == sorted([*everyday, "another-missing"])


def test_the_everyday_extras_are_extras_of_the_project():
    import tomllib

    project = tomllib.loads((ROOT / "pyproject.toml").read_text())["project"]
    assert set(environment.EVERYDAY) < set(project["optional-dependencies"])


def test_this_interpreter_meets_the_project_s_requirements():
    assert environment.unmet_requirements(ROOT) == []


def locked(name):
    text = (ROOT / name).read_text(encoding="utf-8")
    pins = re.findall(r"^([A-Za-z0-9._-]+)==([^\s;]+)", text, flags=re.MULTILINE)
    return text, pins


@pytest.mark.parametrize(
    "name, extras", [("requirements.lock", False), ("requirements-all.lock", True)]
)
def test_the_lock_holds_what_the_project_requires(name, extras):
    text, pins = locked(name)
    versions = {}
    for package, version in pins:
        versions.setdefault(package.lower().replace("_", "-"), []).append(version)
    for requirement in environment.requirements(ROOT, extras):
        package, bounds = environment.parse_requirement(requirement)
        found = versions.get(package.lower().replace("_", "-"), [])
        assert found, f"{requirement} is not in {name}"
        assert all(environment.within(version, bounds) for version in found), (
            f"{requirement}: {name} has {found}"
        )
    assert text.count("--hash=sha256:") >= len(pins)
    assert "://" not in text  # no index addresses
    assert "--index" not in text
    for system in ("'win32'", "'darwin'"):  # universal: for Windows and macOS as well
        assert system in text


def test_the_lock_with_extras_holds_the_other():
    assert set(locked("requirements.lock")[1]) <= set(
        locked("requirements-all.lock")[1]
    )


# Old Pythons


@pytest.mark.parametrize("name", OLD_PYTHON)
def test_an_old_python_can_read_the_starting_code(name):
    source = (ROOT / name).read_text(encoding="utf-8")
    tree = ast.parse(source, feature_version=(3, 6))
    newer = (ast.NamedExpr, ast.Match, ast.TryStar)
    assert not [node for node in ast.walk(tree) if isinstance(node, newer)]
    top_level = {
        alias.name
        for node in tree.body
        if isinstance(node, ast.Import)
        for alias in node.names
    }
    assert top_level <= {"hashlib", "json", "os", "re", "shutil", "subprocess", "sys"}
    annotated = [
        node
        for node in ast.walk(tree)
        if isinstance(node, ast.FunctionDef) and node.returns
    ]
    assert not annotated  # `X | None` would be evaluated


def test_even_python_2_can_read_what_it_meets_first():
    tree = ast.parse((ROOT / "course/__main__.py").read_text(encoding="utf-8"))
    assert not [
        node
        for node in ast.walk(tree)
        if isinstance(node, (ast.JoinedStr, ast.AnnAssign))
    ]
    for name in ("__init__", "__main__"):
        (ROOT / f"course/{name}.py").read_bytes().decode("ascii")


def test_a_python_that_is_too_old_is_told_in_a_sentence(monkeypatch):
    monkeypatch.setattr(sys, "version_info", (3, 9, 18, "final", 0))
    monkeypatch.setattr(environment, "works", lambda name: name == "python3.12")
    with pytest.raises(SetupError) as said:
        environment.require_python()
    assert str(said.value) == ("Python 3.11 or newer is needed and this is Python 3.9. "
                               "This machine has a newer one: run python3.12 -m course")  # fmt: skip
    monkeypatch.setattr(environment, "works", lambda name: False)
    with pytest.raises(
        SetupError, match="Get one from https://www.python.org/downloads"
    ):
        environment.require_python()


@pytest.mark.slow
@pytest.mark.parametrize("version", ["2.7", "3.6", "3.8", "3.10"])
def test_a_real_old_python_says_it_without_a_traceback(version, tmp_path):
    python = next((p for p in old_pythons(version) if environment.works(str(p))), None)
    if python is None:
        pytest.skip(f"no Python {version} on this machine")
    folder = tiny_project.make(tmp_path / "project")
    code, out, err = tiny_project.run(folder, "--help", python=str(python))
    assert (code, out) == (2, "")
    assert err.startswith("Python 3.11 or newer is needed") and "Traceback" not in err
    assert len(err.splitlines()) == 1
    assert not (folder / ".venv").exists()


def old_pythons(version):
    yield from sorted(Path.home().glob(f".pyenv/versions/{version}.*/bin/python"))
    found = shutil.which(f"python{version}")
    if found:
        yield Path(found)


# The states of .venv


@pytest.fixture
def project(tmp_path):
    return tiny_project.make(tmp_path / "project")


def pretend_complete(project, **changed):
    """A .venv as a finished set-up leaves it, as far as ``state`` looks."""
    venv = project / ".venv"
    python = Path(environment.venv_python(str(venv)))
    python.parent.mkdir(parents=True, exist_ok=True)
    python.write_text("not really")
    (venv / MARKER).write_text("")
    stamp = {**environment.stamp_for(str(project), False), **changed}
    installation.write_stamp(venv, stamp)
    return venv


def test_states(project):
    state = lambda **options: environment.state(str(project), **options)  # noqa: E731
    venv = project / ".venv"
    assert state() == "absent"
    venv.mkdir()
    assert state() == "absent"  # killed between mkdir and the marker
    (venv / MARKER).write_text("")
    assert state() == "absent"
    (venv / "pyvenv.cfg").write_text("")
    assert state() == "unfinished"
    pretend_complete(project)
    assert state() == "complete"
    assert state(extras=True) == "stale"
    (venv / environment.STAMP).write_text('{"lock": "cut o')
    assert state() == "unfinished"
    (venv / environment.STAMP).write_text("[]")
    assert state() == "unfinished"


@pytest.mark.parametrize(
    "changed",
    [{"lock": "0" * 64}, {"folder": "/somewhere/else"}, {"base": "/no/such/python"}],
    ids=["lock", "moved", "base gone"],
)
def test_a_stale_environment_is_seen(project, changed):
    pretend_complete(project, **changed)
    assert environment.state(str(project)) == "stale"


def test_a_lost_interpreter_and_a_changed_lock_make_it_stale(project):
    venv = pretend_complete(project)
    with open(project / "requirements.lock", "a") as file:
        file.write("# more\n")
    assert environment.state(str(project)) == "stale"
    pretend_complete(project)
    assert environment.state(str(project)) == "complete"
    Path(environment.venv_python(str(venv))).unlink()
    assert environment.state(str(project)) == "stale"


def test_from_inside_another_python_version_is_seen(project, monkeypatch):
    venv = pretend_complete(project, python="3.99")
    assert (
        environment.state(str(project)) == "complete"
    )  # from outside it cannot be seen
    monkeypatch.setattr(sys, "prefix", str(venv))
    assert environment.state(str(project)) == "stale"


def test_line_endings_do_not_make_a_lock_another(project):
    before = environment.lock_hash(str(project), False)
    lock = project / "requirements.lock"
    lock.write_bytes(lock.read_bytes().replace(b"\n", b"\r\n"))
    assert environment.lock_hash(str(project), False) == before


def make_foreign(project, kind):
    venv = project / ".venv"
    if kind == "file":
        venv.write_text("mine")
    elif kind == "link":
        (project / "elsewhere").mkdir()
        venv.symlink_to(project / "elsewhere")
    else:
        venv.mkdir()
        (venv / "pyvenv.cfg").write_text("mine")
    return venv


@pytest.mark.parametrize("kind", ["folder", "file", "link"])
def test_a_foreign_environment_is_never_touched(project, kind, monkeypatch):
    venv = make_foreign(project, kind)
    before = snapshot(project)
    monkeypatch.setattr(environment, "unmet_requirements", lambda *arguments: ["tiny"])
    with pytest.raises(
        SetupError,
        match="was not made by this project and is left alone. Rename or delete it",
    ):
        environment.ensure([], installation.make, root=str(project))
    assert environment.state(str(project)) == "foreign"
    assert snapshot(project) == before and os.path.lexists(venv)


def snapshot(folder):
    return {
        path: path.read_bytes() if path.is_file() else None
        for path in sorted(folder.rglob("*"))
    }


# What ensure decides


@pytest.fixture
def decided(monkeypatch):
    """Replaces the ways on by notes of which was taken."""
    taken = []
    monkeypatch.setattr(
        environment, "go_on_in", lambda venv, arguments: taken.append(("enter", venv))
    )
    monkeypatch.setattr(
        installation, "make", lambda root, extras: taken.append(("make", extras))
    )
    monkeypatch.setattr(environment, "unmet_requirements", lambda root, extras: [])
    for name in ("VIRTUAL_ENV", "PATH"):
        monkeypatch.setenv(name, os.environ.get(name, ""))
    return taken


def test_a_complete_environment_of_ours_wins(project, decided):
    venv = pretend_complete(project)
    environment.ensure([], installation.make, root=str(project))
    assert decided == [("enter", str(venv))]


def test_where_all_is_met_the_running_interpreter_is_used(project, decided):
    environment.ensure([], installation.make, root=str(project))
    assert decided == []
    make_foreign(project, "folder")
    environment.ensure([], installation.make, root=str(project))
    assert decided == []


def test_otherwise_it_is_made_and_entered(project, decided, monkeypatch):
    monkeypatch.setattr(
        environment, "unmet_requirements", lambda root, extras: ["tiny"]
    )
    environment.ensure(["test", "--all"], installation.make, root=str(project))
    assert decided == [("make", True), ("enter", str(project / ".venv"))]


def test_inside_a_complete_one_the_program_just_goes_on(project, decided, monkeypatch):
    venv = pretend_complete(project)
    monkeypatch.setattr(sys, "prefix", str(venv))
    environment.ensure([], installation.make, root=str(project))
    assert decided == [] and os.environ["VIRTUAL_ENV"] == str(venv)
    assert os.environ["PATH"].startswith(
        str(Path(environment.venv_python(str(venv))).parent)
    )


def test_inside_a_stale_one_it_is_renewed(project, decided, monkeypatch):
    venv = pretend_complete(project, lock="0")
    monkeypatch.setattr(sys, "prefix", str(venv))
    environment.ensure([], installation.make, root=str(project))
    assert decided == [("make", False), ("enter", str(venv))]


def test_an_environment_whose_python_is_another_s_does_not_loop(
    project, decided, monkeypatch
):
    venv = pretend_complete(project)
    monkeypatch.setenv(environment.ENTERED, str(venv))
    with pytest.raises(
        SetupError,
        match="starts a Python that does not belong to it. Delete that folder",
    ):
        environment.ensure([], installation.make, root=str(project))
    assert environment.ENTERED not in os.environ


@pytest.mark.skipif(os.name == "nt", reason="Windows waits for a child instead")
def test_going_on_leaves_other_pythons_behind(project, monkeypatch):
    called = []

    def execv(*command):
        called.append((command, dict(os.environ)))
        raise SystemExit  # the real one does not return either

    monkeypatch.setattr(os, "execv", execv)
    for name in ("PYTHONHOME", "PYTHONPATH", "VIRTUAL_ENV", environment.ENTERED):
        monkeypatch.setenv(name, "/other")
    monkeypatch.setenv("PATH", os.environ["PATH"])
    with pytest.raises(SystemExit):
        environment.go_on_in(str(project / ".venv"), ["open", "10"])
    (python, command), kept = called[0]
    assert python == str(project / ".venv" / "bin" / "python")
    assert command == [python, "-P", "-m", "course", "open", "10"]
    assert "PYTHONHOME" not in kept and "PYTHONPATH" not in kept
    assert kept["VIRTUAL_ENV"] == str(project / ".venv")


# The set-up, step by step, with fakes

STEPS = ["venv", "ensurepip", "install", "link", "compile", "warm"]


class FakeRun:
    """Stands for ``installation.run``: does what a step leaves behind, fails or is interrupted where told."""

    def __init__(self, at=None, problem=None):
        self.at, self.problem, self.done = at, problem, []

    def __call__(self, venv, command, *, progress=None, may_fail=False):
        step = next(name for word, name in [("venv", "venv"), ("ensurepip", "ensurepip"), ("-e", "link"),
                                            ("compileall", "compile"), ("course.warming", "warm"),
                                            ("install", "install")]
                    if word in command)  # fmt: skip
        assert not (venv / environment.STAMP).exists(), (
            f"{step}: the stamp would be untrue meanwhile"
        )
        if step == "venv":
            python = Path(environment.venv_python(str(venv)))
            python.parent.mkdir(parents=True)
            python.write_text("")
        self.done.append(step)
        if step == self.at:
            if progress is not None:
                progress.changing = getattr(self.problem, "changing", False)
            raise self.problem


@pytest.fixture
def fake(monkeypatch):
    def use(**options):
        run = FakeRun(**options)
        monkeypatch.setattr(installation, "run", run)
        return run

    return use


def test_the_steps_and_the_stamp(project, fake, capsys):
    run = fake()
    installation.make(project)
    assert run.done == STEPS
    assert environment.state(str(project)) == "complete"
    assert "Setting up" in capsys.readouterr().err
    installation.make(project)
    assert run.done == STEPS  # complete: nothing more is done


@pytest.mark.parametrize("step", STEPS)
@pytest.mark.parametrize(
    "problem",
    [KeyboardInterrupt(), SetupError("cut off"), OSError(errno.EIO, "cut off")],
)
def test_a_set_up_cut_off_anywhere_is_completed(project, fake, step, problem, capsys):
    fake(at=step, problem=problem)
    with pytest.raises((KeyboardInterrupt, SetupError)):
        installation.make(project)
    assert environment.state(str(project)) == "unfinished"
    run = fake()
    installation.make(project)
    assert run.done == STEPS
    assert environment.state(str(project)) == "complete"
    assert "Completing the set-up" in capsys.readouterr().err


def test_cut_off_before_the_stamp_is_in_place(project, fake, monkeypatch):
    fake()
    monkeypatch.setattr(
        os, "replace", lambda *names: (_ for _ in ()).throw(KeyboardInterrupt)
    )
    with pytest.raises(KeyboardInterrupt):
        installation.make(project)
    assert environment.state(str(project)) == "unfinished"


def test_a_changed_lock_is_followed_in_place(project, fake):
    fake()
    installation.make(project)
    tiny_project.lock(project, {"tiny-dependency": "1.1"})
    assert environment.state(str(project)) == "stale"
    run = fake()
    installation.make(project)
    assert run.done == ["install", "link", "compile", "warm"]
    assert environment.state(str(project)) == "complete"


@pytest.mark.parametrize("changing, left", [(False, "stale"), (True, "unfinished")])
@pytest.mark.slow
def test_an_update_that_fails_keeps_the_old_packages_if_they_are_whole(
    project, fake, changing, left
):
    fake()
    installation.make(project)
    tiny_project.lock(project, {"tiny-dependency": "1.1"})
    problem = SetupError("no network")
    problem.changing = changing
    fake(at="install", problem=problem)
    with pytest.raises(SetupError, match="no network"):
        installation.make(project)
    assert environment.state(str(project)) == left


@pytest.mark.parametrize(
    "changed",
    [{"folder": "/elsewhere"}, {"base": "/no/such/python"}, {"python": "3.99"}],
)
def test_a_moved_checkout_or_another_python_is_made_anew(project, fake, changed):
    venv = pretend_complete(project, lock="0", **changed)
    (venv / "left-over").mkdir()
    (venv / "left-over" / "file").write_text("")
    run = fake()
    installation.make(project)
    assert run.done == STEPS and not (venv / "left-over").exists()
    assert environment.state(str(project)) == "complete"


def test_extras_are_remembered(project, fake):
    fake()
    installation.make(project, extras=True)
    assert (
        environment.state(str(project), extras=True)
        == environment.state(str(project))
        == "complete"
    )
    tiny_project.lock(project, {"tiny-dependency": "1.1"})
    installation.make(project)
    assert environment.read_stamp(str(project / ".venv"))["extras"] is True


# What goes wrong, and its sentence


def test_without_the_venv_module_the_cure_is_named(project, monkeypatch):
    real = installation.importlib.util.find_spec
    monkeypatch.setattr(installation.importlib.util, "find_spec",
                        lambda name: None if name == "ensurepip" else real(name))  # fmt: skip
    with pytest.raises(SetupError, match=r"sudo apt install python3\.\d+-venv"):
        installation.make(project)
    assert not (project / ".venv").exists()


def test_too_little_room_is_said_before_the_start(project, fake, monkeypatch):
    run = fake()
    usage = namedtuple("usage", "total used free")
    monkeypatch.setattr(
        installation.shutil, "disk_usage", lambda path: usage(9e9, 8e9, 4e8)
    )
    with pytest.raises(
        SetupError, match=r"needs 1\.7 GB .* has 0\.4 GB free\. Make room"
    ):
        installation.make(project)
    assert run.done == []


@pytest.mark.parametrize("number, said", [(errno.ENOSPC, "The disk is full"), (errno.EDQUOT, "The disk is full"),
                                          (errno.EACCES, "may not be changed"), (errno.EROFS, "may not be changed"),
                                          (errno.ENAMETOOLONG, "path is too long")])  # fmt: skip
def test_an_error_of_the_disk_becomes_a_sentence(
    project, fake, monkeypatch, number, said
):
    fake()
    problem = OSError(number, os.strerror(number), str(project))
    monkeypatch.setattr(
        installation, "write_stamp", lambda *arguments: (_ for _ in ()).throw(problem)
    )
    with pytest.raises(SetupError, match=said):
        installation.make(project)
    assert environment.state(str(project)) == "unfinished"


@pytest.mark.parametrize(
    "output, said",
    [
        ("ERROR: Could not install packages due to an OSError: [Errno 28] No space left on device", "disk is full"),
        ("OSError: [WinError 112] There is not enough space on the disk", "disk is full"),
        ("WARNING: Retrying (Retry(total=4)) after connection broken by 'NewConnectionError('<pip._vendor>: Failed to "
         "establish a new connection: [Errno -2] Name or service not known')': /simple/numpy/\n"
         "ERROR: No matching distribution found for numpy==2.4.6", "index could not be reached: connect"),
        ("ReadTimeoutError(\"HTTPSConnectionPool(host='x', port=443): Read timed out.\")", "could not be reached"),
        ("SSLError(SSLCertVerificationError(1, '[SSL: CERTIFICATE_VERIFY_FAILED]", "could not be reached"),
        ("ERROR: THESE PACKAGES DO NOT MATCH THE HASHES FROM THE REQUIREMENTS FILE. If you have updated\n"
         "    numpy==2.4.6 from https://x (from -r requirements.lock (line 4)):\n        Expected sha256 ab",
         r"not the one this project was tested with \(numpy\)"),
        ("ERROR: Could not find a version that satisfies the requirement scipy==1.17.1 (from versions: none)\n"
         "ERROR: No matching distribution found for scipy==1.17.1", "Nothing was found of scipy: check the network"),
        ("ERROR: Could not find a version that satisfies the requirement scipy==1.17.1 (from versions: 1.16)\n"
         "ERROR: No matching distribution found for scipy==1.17.1", "no ready-made package of scipy for this Python"),
        ("OSError: [Errno 2] No such file: 'C:\\\\x'\nHINT: This error might have occurred since this system does not "
         "have Windows Long Path support enabled.", "path is too long"),
        ("ERROR: Could not install packages due to an OSError: [WinError 5] Access is denied: 'zmq.pyd'",
         "close every JupyterLab"),
        ("/usr/bin/python3: No module named ensurepip", "cannot make virtual environments"),
        ("something nobody has seen", "The set-up of .* failed. Run"),
    ],
)  # fmt: skip
def test_what_pip_says_becomes_a_sentence_with_a_cure(output, said):
    sentence = installation.explain(output, Path("/project/.venv"))
    assert re.search(said, sentence) and "{" not in sentence
    assert (
        "python3 -m course" in sentence
        or "py -m course" in sentence
        or "python.org" in sentence
    )


def test_a_path_too_long_for_windows_is_said_with_the_number(monkeypatch):
    monkeypatch.setattr(installation, "long_paths_enabled", lambda: False)
    installation.require_short_path(Path("C:/" + "x" * 60, ".venv"), windows=True)
    with pytest.raises(SetupError, match="is 1 characters too long for Windows"):
        installation.require_short_path(Path("C:/" + "x" * 91, ".venv"), windows=True)
    installation.require_short_path(Path("C:/" + "x" * 91, ".venv"), windows=False)
    monkeypatch.setattr(installation, "long_paths_enabled", lambda: True)
    installation.require_short_path(Path("C:/" + "x" * 91, ".venv"), windows=True)


@pytest.mark.slow
def test_the_longest_installed_file_is_as_reckoned():
    packages = installation.site_packages(Path(environment.venv_python(sys.prefix)))
    if not (packages / "jupyterlab").is_dir():
        pytest.skip("JupyterLab is not installed in this interpreter's own folder")
    below = len(r"\Lib\site-packages") + 1
    longest = max(
        below + len(str(path.relative_to(packages)))
        for path in packages.rglob("*")
        if path.suffix != ".pyc"
    )
    assert longest <= installation.LONGEST_FILE


def test_pip_keeps_the_user_s_index_and_loses_what_installs_elsewhere(monkeypatch):
    for name in (
        "PIP_INDEX_URL",
        "PIP_TARGET",
        "PIP_USER",
        "PYTHONPATH",
        "PYTHONDONTWRITEBYTECODE",
    ):
        monkeypatch.setenv(name, "1")
    kept = installation.quiet_environment()
    assert kept["PIP_INDEX_URL"] == "1" and kept["PIP_USER"] == "0"
    assert not {"PIP_TARGET", "PYTHONPATH", "PYTHONDONTWRITEBYTECODE"} & set(kept)


def test_progress_counts_out_of_the_lock_s_total(project, capsys):
    progress = installation.Progress(
        project / "requirements-all.lock", Path(environment.venv_python(sys.prefix))
    )
    progress.update(
        "Ignoring absent: markers\nCollecting tiny-dependency==1.0 (from -r x)\n  Downloading\n"
    )
    assert progress.shown == "fetching 1 of 2 packages: tiny"
    progress.update(
        "Ignoring absent: markers\nCollecting a==1\nProcessing /x/b_c-1.0-py3.whl (from -r x)\n"
    )
    assert progress.shown == "fetching 2 of 2 packages: b_c" and not progress.changing
    progress.update(
        "Ignoring absent: markers\nCollecting a==1\nInstalling collected packages: a\n"
    )
    assert progress.shown == "installing 2 of 2 packages" and progress.changing


# The whole, for real, on a tiny project (seconds each: a real venv and a real pip, no network)


@pytest.mark.slow
@pytest.mark.long
def test_first_start_second_start_and_a_changed_lock(project):
    code, out, err = tiny_project.run(project, "hello", PYTHONDONTWRITEBYTECODE="1")
    assert code == 7, err
    python = environment.venv_python(str(project / ".venv"))
    assert out.split() == ["ran", "1.0", python, "hello"]
    assert "Setting up" in err and "Ready after" in err
    assert any(
        (project / ".venv").rglob("tiny_dependency.*.pyc")
    )  # compiled ahead all the same
    assert tiny_project.run(project, "again") == (7, f"ran 1.0 {python} again\n", "")
    tiny_project.lock(project, {"tiny-dependency": "1.1"})
    code, out, err = tiny_project.run(project)
    assert code == 7 and out.startswith("ran 1.1") and "up to date" in err
    moved = project.rename(project.with_name("moved"))
    code, out, err = tiny_project.run(moved)
    assert code == 7 and str(moved) in out and "Renewing" in err


@pytest.mark.long
@pytest.mark.skipif(os.name == "nt", reason="kills a process group")
@pytest.mark.parametrize("when", ["bin/python", "setup.log", "collecting"])
def test_killed_at_a_real_moment_it_is_completed(project, when):
    process = tiny_project.start(project)
    venv, log = project / ".venv", project / ".venv" / "setup.log"
    for _ in range(600):
        time.sleep(0.02)
        if when == "collecting":
            if log.exists() and "tiny_dependency" in log.read_text():
                break
        elif (venv / when).exists():
            break
    os.killpg(process.pid, signal.SIGKILL)
    process.communicate()
    assert environment.state(str(project)) == "unfinished"
    code, out, err = tiny_project.run(project)
    assert code == 7 and out.startswith("ran 1.0") and "Completing" in err


@pytest.mark.slow
@pytest.mark.long
def test_two_set_ups_at_once(project):
    first = tiny_project.start(project, "first")
    for _ in range(600):
        if (project / ".venv" / "setup.log").exists():
            break
        time.sleep(0.02)
    second = tiny_project.start(project, "second")
    ends = [
        process.communicate(timeout=180) + (process.returncode,)
        for process in (first, second)
    ]
    assert [code for _, _, code in ends] == [7, 7], ends
    assert "Setting up" in ends[0][1] and "Waiting for it" in ends[1][1]
    assert "Setting up" not in ends[1][1]


@pytest.mark.slow
@pytest.mark.long
def test_a_wrong_hash_installs_nothing(project):
    lock = project / "requirements.lock"
    lock.write_text(
        re.sub(r"sha256:\w{64}", "sha256:" + "1" * 64, lock.read_text(), count=1)
    )
    code, out, err = tiny_project.run(project)
    assert code == 2 and out == "" and "Traceback" not in err
    assert "not the one this project was tested with (tiny-dependency)" in err
    assert str(project / ".venv" / "setup.log") in err


@pytest.mark.long
def test_no_network(project):
    nowhere = {"PIP_NO_INDEX": "0", "PIP_FIND_LINKS": "", "PIP_INDEX_URL": "http://127.0.0.1:9/simple",
               "PIP_RETRIES": "1"}  # fmt: skip
    code, out, err = tiny_project.run(project, **nowhere)
    assert code == 2 and out == "" and "Traceback" not in err
    assert "The package index could not be reached: connect to the network" in err
    code, out, err = tiny_project.run(project)  # the network is back
    assert code == 7 and "Completing the set-up" in err


@pytest.mark.slow
def test_an_interpreter_that_has_everything_is_used_as_it_is(tmp_path):
    folder = tiny_project.make(tmp_path / "project", requirement="pytest>=1")
    code = "import sys\ndef run(arguments):\n    return print(sys.executable) or 0\n"
    (folder / "course" / "cli.py").write_text(code)
    code, out, err = tiny_project.run(folder)
    assert (code, out.strip(), err) == (0, sys.executable, "")
    assert not (folder / ".venv").exists()


@pytest.mark.slow
@pytest.mark.skipif(os.name == "nt", reason="sends the interrupt to a process group")
def test_ctrl_c_in_a_set_up_is_said_plainly(project):
    process = tiny_project.start(project)
    for _ in range(600):
        if (project / ".venv" / "setup.log").exists():
            break
        time.sleep(0.02)
    os.killpg(process.pid, signal.SIGINT)
    out, err = process.communicate(timeout=60)
    assert process.returncode == 130 and "Traceback" not in err
    assert "The set-up was interrupted." in err


def test_the_stamp_is_json_that_a_person_can_read(project, fake):
    fake()
    installation.make(project)
    stamp = json.loads((project / ".venv" / environment.STAMP).read_text())
    assert set(stamp) == {"lock", "extras", "folder", "base", "python"}


@pytest.mark.parametrize(
    "asks, said",
    [
        (['no-such-thing>=1 ; extra == "workbook"'], "no-such-thing>=1 is not here"),
        (["pytest>=1; extra == 'workbook'", "no-such; extra == 'test'"], None),
        (None, None),
    ],
)
def test_a_command_of_the_library_alone_says_what_it_lacks(monkeypatch, asks, said):
    monkeypatch.setattr("importlib.metadata.requires", lambda name: asks)
    monkeypatch.setattr(environment, "project_root", lambda: None)
    if said is None:
        environment.ensure([], None)
        return
    with pytest.raises(SetupError, match=said) as raised:
        environment.ensure([], None)
    assert str(raised.value).endswith('pip install "collision-course[workbook]"')


def test_installed_without_a_checkout_there_is_nothing_to_do(tmp_path):
    (tmp_path / "course").mkdir()
    for name in ("__init__.py", "environment.py"):
        shutil.copy(ROOT / "course" / name, tmp_path / "course" / name)
    code = "from course import environment as e; print(e.project_root(), e.ensure([], None))"
    assert subprocess.run([sys.executable, "-c", code], cwd=tmp_path, capture_output=True,
                          text=True, check=True).stdout == "None None\n"  # fmt: skip
