"""A checkout in small, for tests of the set-up: the real starting code, one tiny package, no network.

The package index is a folder of wheels, and the project builds itself, so that a set-up takes seconds.
"""

import hashlib
import os
import shutil
import subprocess
import sys
import zipfile
from pathlib import Path

ROOT = Path(__file__).resolve().parents[1]
BACKEND = """
import zipfile
from pathlib import Path

def build_editable(folder, config_settings=None, metadata_directory=None):
    name = "tiny_course-1.0-py3-none-any.whl"
    with zipfile.ZipFile(Path(folder) / name, "w") as wheel:
        wheel.writestr("tiny_course.pth", str(Path.cwd()))
        info = "tiny_course-1.0.dist-info/"
        wheel.writestr(info + "METADATA", "Metadata-Version: 2.1\\nName: tiny-course\\nVersion: 1.0\\n")
        wheel.writestr(info + "WHEEL", "Wheel-Version: 1.0\\nRoot-Is-Purelib: true\\nTag: py3-none-any\\n")
        wheel.writestr(info + "RECORD", "")
    return name

def build_wheel(*arguments):
    raise NotImplementedError
"""
CLI = """
import sys

def run(arguments):
    import tiny_dependency
    print("ran", tiny_dependency.__version__, sys.executable, *arguments)
    return 7
"""


def make(folder, *, requirement="tiny-dependency>=1"):
    """A project folder whose one requirement is ``tiny_dependency`` 1.0; returns it."""
    course = folder / "course"
    course.mkdir(parents=True)
    for name in ("__init__.py", "__main__.py", "environment.py", "installation.py"):
        shutil.copy(ROOT / "course" / name, course / name)
    (course / "cli.py").write_text(CLI)
    (folder / "pyproject.toml").write_text(
        '[build-system]\nrequires = []\nbuild-backend = "backend"\nbackend-path = ["."]\n'
        '[project]\nname = "tiny-course"\nversion = "1.0"\ndependencies = []\n'
        f'[project.optional-dependencies]\nworkbook = ["{requirement}"]\n'
        'more = ["tiny-extra>=1"]\n'
    )
    (folder / "backend.py").write_text(BACKEND)
    lock(folder, {"tiny-dependency": "1.0"})
    return folder


def lock(folder, packages):
    """Write both locks; the one with extras holds tiny-extra as well."""
    lines = [f"{name}=={version} \\\n    --hash=sha256:{wheel(folder, name, version)}\n"
             for name, version in packages.items()]  # fmt: skip
    absent = (
        "absent==1.0 ; sys_platform == 'nowhere' \\\n    --hash=sha256:"
        + "0" * 64
        + "\n"
    )
    (folder / "requirements.lock").write_text("".join(lines) + absent)
    extra = (
        f"tiny-extra==1.0 \\\n    --hash=sha256:{wheel(folder, 'tiny-extra', '1.0')}\n"
    )
    (folder / "requirements-all.lock").write_text("".join(lines) + extra + absent)


def wheel(folder, name, version):
    """Put a wheel of one module into the folder that pip looks into; returns its SHA-256."""
    module = name.replace("-", "_")
    path = folder / "wheels" / f"{module}-{version}-py3-none-any.whl"
    path.parent.mkdir(exist_ok=True)
    info = f"{module}-{version}.dist-info"
    with zipfile.ZipFile(path, "w") as file:
        file.writestr(zipfile.ZipInfo(f"{module}.py"), f"__version__ = {version!r}\n")
        file.writestr(
            zipfile.ZipInfo(f"{info}/METADATA"),
            f"Metadata-Version: 2.1\nName: {name}\nVersion: {version}\n",
        )
        file.writestr(zipfile.ZipInfo(f"{info}/WHEEL"),
                      "Wheel-Version: 1.0\nRoot-Is-Purelib: true\nTag: py3-none-any\n")  # fmt: skip
        file.writestr(zipfile.ZipInfo(f"{info}/RECORD"), "")
    return hashlib.sha256(path.read_bytes()).hexdigest()


def environment(folder, **more):
    """The environment in which pip finds the folder's wheels and nothing else."""
    kept = {
        k: v
        for k, v in os.environ.items()
        if not k.startswith(("PIP_", "PYTHON", "COLLISION_", "VIRTUAL_ENV"))
    }
    return {**kept, "PIP_CONFIG_FILE": os.devnull, "PIP_NO_INDEX": "1", "PIP_FIND_LINKS": str(folder / "wheels"),
            "PIP_CACHE_DIR": str(folder / "cache"), **more}  # fmt: skip


def start(folder, *arguments, python=sys.executable, **more):
    """Start the project as a user does; returns the running process."""
    return subprocess.Popen([python, "-m", "course", *arguments], cwd=folder, env=environment(folder, **more),
                            stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True,
                            start_new_session=os.name != "nt")  # fmt: skip


def run(folder, *arguments, **more):
    """Start the project and wait; returns (exit code, stdout, stderr)."""
    process = start(folder, *arguments, **more)
    out, err = process.communicate(timeout=180)
    return process.returncode, out, err
