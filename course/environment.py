"""Find the Python that has everything this workbook needs, or have it made.

Standard library only, nothing of the house. ``ensure`` decides, in this order:

1. a complete ``.venv`` that this project made wins: the program goes on in it;
2. where every requirement of ``pyproject.toml`` is met already (conda, Colab,
   an environment of one's own), the running interpreter is used as it is;
3. otherwise ``.venv`` is made, completed or renewed first, by the ``make`` it is given.

Written so that Python 3.6 can read it: a ``.venv`` made by a newer Python
serves even where ``python3`` is an old one, and where there is none the old one
can say in a sentence what is missing.
"""

import hashlib
import json
import os
import re
import shutil
import subprocess
import sys

OLDEST_PYTHON = (3, 11)
LOCK = "requirements.lock"
LOCK_WITH_EXTRAS = "requirements-all.lock"
MARKER = "made-by-collision-course"  # says that a .venv is ours; also locked while one is set up
STAMP = "collision-course.json"  # written last: the set-up is complete
ENTERED = "COLLISION_COURSE_ENTERED"  # set on the way into .venv, so that a broken one cannot loop
START = "py -m course" if os.name == "nt" else "python3 -m course"


class SetupError(Exception):
    """What is wrong and how it is cured, in one sentence for the person at the keyboard."""


def ensure(arguments, make, root=None):
    """Return when the running interpreter can serve; otherwise go on in ``.venv`` and do not return.

    ``arguments`` are the command line's; ``test --all`` also needs the optional
    packages. ``make(root, extras)`` makes a complete ``.venv`` (``installation.make``).
    ``root`` is the checkout (found from this file). Raises SetupError.
    """
    root = root or project_root()
    if root is None:  # installed as a library: pip has seen to the requirements
        return
    extras = "test" in arguments and "--all" in arguments
    venv = os.path.join(root, ".venv")
    entered = os.environ.pop(ENTERED, None)
    inside = os.path.realpath(sys.prefix) == os.path.realpath(venv)
    if not inside and entered == venv:
        raise SetupError(
            "%s starts a Python that does not belong to it. Delete that folder and run %s again."
            % (venv_python(venv), START)
        )
    if state(root, extras) != "complete":
        renew_inside = inside and is_ours(venv)
        if (
            not renew_inside
            and is_new_enough()
            and not unmet_requirements(root, extras)
        ):
            return
        require_python()
        make(root, extras)
    elif inside:
        activate(venv)
        return
    go_on_in(venv, arguments)


def project_root():
    """The checkout this file lies in, or None where the package was installed without one."""
    root = os.path.dirname(os.path.dirname(os.path.abspath(__file__)))
    return root if os.path.exists(os.path.join(root, LOCK)) else None


def venv_python(venv):
    """The interpreter of a virtual environment."""
    return (
        os.path.join(venv, "Scripts", "python.exe")
        if os.name == "nt"
        else os.path.join(venv, "bin", "python")
    )


def is_ours(venv):
    """Whether this project made the folder (or may: it is not there, or empty)."""
    if not os.path.lexists(venv):
        return True
    if os.path.islink(venv) or not os.path.isdir(venv):
        return False
    inside = os.listdir(venv)
    return not inside or MARKER in inside


def state(root, extras=False):
    """How ``.venv`` stands: "absent", "foreign", "unfinished", "stale" or "complete"."""
    venv = os.path.join(root, ".venv")
    if not is_ours(venv):
        return "foreign"
    if not os.path.isdir(venv) or set(os.listdir(venv)) <= {MARKER}:
        return "absent"
    stamp = read_stamp(venv)
    if stamp is None:
        return "unfinished"
    interpreters = [venv_python(venv), stamp.get("base", "")]
    if not (
        all(os.path.exists(path) for path in interpreters)
        and stamp_matches(stamp, root)
    ):
        return "stale"
    return "complete" if stamp["extras"] or not extras else "stale"


def stamp_for(root, extras):
    """What the stamp of a ``.venv`` made here and now would say."""
    base = os.path.abspath(getattr(sys, "_base_executable", None) or sys.executable)
    return {
        "lock": lock_hash(root, extras),
        "extras": bool(extras),
        "folder": os.path.realpath(root),
        "base": base,
        "python": "%d.%d" % tuple(sys.version_info[:2]),
    }


def stamp_matches(stamp, root):
    """Whether the stamp was written for this lock and this place (and, seen from inside, this Python)."""
    now = stamp_for(root, stamp.get("extras"))
    same = ["lock", "folder"]
    if os.path.realpath(sys.prefix) == os.path.realpath(os.path.join(root, ".venv")):
        same.append(
            "python"
        )  # an upgrade of the system's Python shows only from inside
    return all(stamp.get(key) == now[key] for key in same)


def read_stamp(venv):
    """The stamp as a dict, or None where there is none that can be read."""
    try:
        with open(os.path.join(venv, STAMP), encoding="utf-8") as file:
            stamp = json.load(file)
    except (OSError, ValueError):
        return None
    return (
        stamp
        if isinstance(stamp, dict) and isinstance(stamp.get("extras"), bool)
        else None
    )


def lock_hash(root, extras):
    """SHA-256 of the lock, the same for either kind of line ending."""
    with open(os.path.join(root, LOCK_WITH_EXTRAS if extras else LOCK), "rb") as file:
        return hashlib.sha256(file.read().replace(b"\r\n", b"\n")).hexdigest()


def is_new_enough():
    """Whether the running Python can run the workbook."""
    return tuple(sys.version_info[:2]) >= OLDEST_PYTHON


def require_python():
    """Raise SetupError when the running Python is too old, naming a newer one where there is one."""
    if is_new_enough():
        return
    wanted, found = "%d.%d" % OLDEST_PYTHON, "%d.%d" % tuple(sys.version_info[:2])
    newer = [
        name
        for name in ("python3.%d" % minor for minor in (13, 12, 14, 11))
        if works(name)
    ]
    cure = (
        "This machine has a newer one: run %s -m course" % newer[0]
        if newer
        else "Get one from https://www.python.org/downloads and start with it: "
        + (
            "py -%s -m course" % wanted
            if os.name == "nt"
            else "python%s -m course" % wanted
        )
    )
    raise SetupError(
        "Python %s or newer is needed and this is Python %s. %s" % (wanted, found, cure)
    )


def works(name):
    """Whether a program of this name is there and starts (a version manager leaves names that do not)."""
    path = shutil.which(name)
    try:
        return (
            bool(path)
            and subprocess.call([path, "-c", ""], stderr=subprocess.DEVNULL) == 0
        )
    except OSError:
        return False


def unmet_requirements(root, extras=False):
    """The requirements of ``pyproject.toml`` that the running interpreter does not meet."""
    from importlib import metadata

    unmet = []
    for requirement in requirements(root, extras):
        name, bounds = parse_requirement(requirement)
        try:
            version = metadata.version(name)
        except metadata.PackageNotFoundError:
            version = None
        if version is None or not within(version, bounds):
            unmet.append(requirement)
    return unmet


def requirements(root, extras=False):
    """The requirements of ``pyproject.toml`` that apply here, with those of its extras where asked."""
    import tomllib

    with open(os.path.join(root, "pyproject.toml"), "rb") as file:
        project = tomllib.load(file)["project"]
    optional = project.get("optional-dependencies", {}) if extras else {}
    lines = project["dependencies"] + [
        line for lines in optional.values() for line in lines
    ]
    parts = [line.partition(";") for line in lines]
    return [name.strip() for name, _, marker in parts if applies(marker)]


def applies(marker):
    """Whether an environment marker holds here; ValueError for a form this project does not use."""
    import platform

    here = {
        "sys_platform": sys.platform,
        "platform_machine": platform.machine(),
        "python_version": "%d.%d" % tuple(sys.version_info[:2]),
    }
    clause = r"(python_version|sys_platform|platform_machine)\s*(==|!=|<=|>=|<|>)\s*'([^']*)'"

    def truth(match):
        name, operator, wanted = match.groups()
        if name == "python_version":
            return str(within(here[name], [(operator, release(wanted))]))
        if operator not in ("==", "!="):
            raise ValueError(
                "marker: expected == or != for %s, got %r" % (name, marker)
            )
        return str((here[name] == wanted) == (operator == "=="))

    words = re.sub(clause, truth, marker)
    if re.search(r"[^\s()]", re.sub(r"\b(True|False|and|or)\b", "", words)):
        raise ValueError(
            "marker: expected clauses with and, or, brackets, got %r" % marker
        )
    # Nothing is left but True, False, and, or and brackets.
    return not words.strip() or bool(eval(words, {"__builtins__": {}}))


def parse_requirement(requirement):
    """("name", [(">=", (1, 2)), ...]) from "name>=1.2,<2"; ValueError for a form this project does not use."""
    match = re.match(
        r"^([A-Za-z0-9._-]+)\s*((?:(?:>=|<=|==|!=|<|>)\s*[0-9.]+\s*,?\s*)*)$",
        requirement,
    )
    if match is None:
        raise ValueError("requirement: expected name>=X,<Y, got %r" % requirement)
    bounds = re.findall(r"(>=|<=|==|!=|<|>)\s*([0-9.]+)", match.group(2))
    return match.group(1), [
        (operator, release(version)) for operator, version in bounds
    ]


def release(version):
    """The release numbers at the start of a version, trailing zeros gone: "2.10.0rc1" -> (2, 10)."""
    numbers = [
        int(part) for part in re.sub(r"[^0-9.].*", "", version).split(".") if part
    ]
    while numbers and numbers[-1] == 0:
        numbers.pop()
    return tuple(numbers)


def within(version, bounds):
    """Whether a version keeps every bound."""
    here = release(version)
    compare = {
        ">=": here.__ge__,
        "<=": here.__le__,
        "==": here.__eq__,
        "!=": here.__ne__,
        "<": here.__lt__,
        ">": here.__gt__,
    }
    return all(compare[operator](bound) for operator, bound in bounds)


def activate(venv):
    """Let what is started from here (kernels, ``!pip`` in a notebook) find ``.venv`` first.

    IPython would add the packages of any other environment that VIRTUAL_ENV names.
    """
    os.environ["VIRTUAL_ENV"] = venv
    programs = os.path.dirname(venv_python(venv))
    before = os.environ.get("PATH", "")
    if before.split(os.pathsep)[0] != programs:
        os.environ["PATH"] = programs + os.pathsep + before


def go_on_in(venv, arguments):
    """Go on in ``.venv``: this process becomes it (on Windows: waits for it and ends with its code)."""
    activate(venv)
    os.environ[ENTERED] = venv
    for leak in ("PYTHONHOME", "PYTHONPATH", "__PYVENV_LAUNCHER__"):
        os.environ.pop(
            leak, None
        )  # they would mix another Python's packages into the locked ones
    # -P: the current folder may hold a student's json.py. The Python of .venv is new
    # enough to know it.
    command = [venv_python(venv), "-P", "-m", "course"] + list(arguments)
    sys.stdout.flush()
    sys.stderr.flush()
    if os.name != "nt":
        os.execv(command[0], command)
    child = subprocess.Popen(command)
    while True:
        try:
            sys.exit(child.wait())
        except (
            KeyboardInterrupt
        ):  # Ctrl-C reaches the child as well, which ends in its own way
            continue
