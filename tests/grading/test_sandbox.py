"""The process an answer runs in: limits, what it may not do, and that nothing of it is left."""

import os
import signal
import subprocess
import sys
import tempfile
import threading
import time

import numpy as np
import pytest

from course.grading import sandbox
from course.grading.limits import Limits
from course.grading.sandbox import Cancelled, Job, SandboxFailure, isolation, run_job

POSIX = pytest.mark.skipif(sys.platform == "win32", reason="POSIX processes")
LINUX = pytest.mark.skipif(
    not sys.platform.startswith("linux"), reason="Linux limits the memory of a process"
)


def run(
    source, *, case=None, results=1, seconds=5.0, memory_mb=2000, file_mb=100, **options
):
    job = Job(
        ((source, False),),
        "f",
        "function",
        ("x",),
        results,
        ({"x": 1.0} if case is None else case,),
    )
    return run_job(job, Limits(seconds, memory_mb, file_mb), **options)


def outcome(source, **options):
    result = run(source, **options)
    assert result.end == "replied", result
    return result.reply.outcomes[0]


def value(source, **options):
    told = outcome(source, **options)
    assert told.kind == "value", told
    return told.values[0]


@pytest.fixture(autouse=True)
def nothing_left(tmp_path, monkeypatch):
    """Every test leaves the folder for temporary files as it was."""
    monkeypatch.setattr(tempfile, "tempdir", str(tmp_path))
    yield
    assert [p.name for p in tmp_path.iterdir() if p.name.startswith("course-")] == []


def test_every_kind_of_argument_arrives_as_it_was_sent():
    case = {"x": (np.arange(6.0).reshape(2, 3), 2, True, "word", np.inf)}
    told = outcome("def f(x):\n    a, n, t, w, i = x\n    return a * n, [t, i > 1, w == 'word', type(n) is int]",
                   case=case, results=2)  # fmt: skip
    assert told.values[0].tolist() == [[0, 2, 4], [6, 8, 10]]
    assert told.values[1].tolist() == [True] * 4


@pytest.mark.slow
@LINUX
def test_memory_is_limited_and_the_report_says_so():
    small = "import numpy as np\ndef f(x):\n    return np.ones(3 * 10**7)[:3]"
    assert "Memory" in outcome(small, memory_mb=300).text
    assert value(small).tolist() == [1.0] * 3
    held = isolation(Limits())
    assert {
        "separate process",
        "clock",
        "memory",
        "processor time",
        "audit hook",
    } <= set(held)


def test_the_environment_of_the_grader_does_not_travel(monkeypatch):
    monkeypatch.setenv("TOKEN_OF_THE_GRADER", "secret")
    source = "import os\ndef f(x):\n    return [int('TOKEN_OF_THE_GRADER' in os.environ), len(os.environ)]"
    seen = value(source)
    assert seen[0] == 0 and seen[1] < 20


@pytest.mark.slow
def test_course_is_a_stand_in_and_the_reference_cannot_be_read():
    source = """
from course.workbook import *
from course.workbook import check, use, plots
import course.dynamics as dynamics
import course.exercises.definitions.lesson_10_impulse as definitions
@use
def f(x):
    with plots.figure() as figure:
        figure.draw()
    return x + 1
check(f); hint(f); predict("a", 3); progress(); show(f, 3)
"""
    assert value(source) == 2.0
    told = outcome(
        "from course.dynamics import impulse_central\ndef f(x):\n    return impulse_central(x)"
    )
    assert (told.kind, told.text) == (
        "unreadable",
        "expected numbers; got StandInForCourse",
    )
    folder = sandbox.PACKAGE / "exercises" / "definitions"
    told = outcome(
        f"def f(x):\n    return len(open({str(folder / '__init__.py')!r}).read())"
    )
    assert told.kind == "raised" and "cannot be read" in told.text
    around = f"""
import sys
def f(x):
    sys.meta_path[:] = [m for m in sys.meta_path if type(m).__name__ != '_Finder']
    sys.path.insert(0, {str(sandbox.PACKAGE.parent)!r})
    for name in [n for n in sys.modules if n.startswith('course')]: del sys.modules[name]
    import course.exercises.definition
"""
    assert "cannot be read" in outcome(around).text


REFUSED = """
os.fork()
os.system('true')
subprocess.run(['true'])
os.kill(os.getppid(), 9)
os.killpg(os.getpgid(os.getppid()), 9)
os.posix_spawn('/bin/true', ['true'], {})
os.execv('/bin/true', ['true'])
multiprocessing.get_context('spawn').Process(target=print).start()
socket.create_connection(('127.0.0.1', 9))
ctypes.CDLL(None).getpid()
resource.setrlimit(resource.RLIMIT_AS, (-1, -1))
open(PLACE, 'w')
os.open(PLACE, os.O_RDWR)
os.remove(PLACE)
os.rename('a', PLACE)
os.rename(PLACE, 'a')
os.link(PLACE, 'b')
os.mkdir(PLACE + '2')
os.truncate(PLACE, 0)
shutil.rmtree(os.path.dirname(PLACE))
"""


@pytest.mark.slow
@POSIX
def test_what_an_answer_may_not_do(tmp_path):
    place = tmp_path / "kept" / "file"
    place.parent.mkdir()
    place.write_text("mine")
    source = f"""
import ctypes, multiprocessing, os, resource, shutil, socket, subprocess
PLACE = {str(place)!r}
open('a', 'w').close()
def f(x):
    refused = []
    for line in {REFUSED.strip().splitlines()!r}:
        try:
            exec(line)
        except PermissionError as error:
            refused.append('not allowed' in str(error))
        else:
            refused.append(False)
    return refused
"""
    done = dict(zip(REFUSED.strip().splitlines(), value(source).tolist(), strict=True))
    assert [line for line, refused in done.items() if not refused] == []
    assert place.read_text() == "mine"


@pytest.mark.slow
@POSIX
def test_its_own_folder_can_be_written_to_and_is_gone_afterwards():
    folder = "import os, pathlib, tempfile\ndef f(x):\n    pathlib.Path('a').write_text('b')\n"
    told = outcome(
        folder
        + "    with tempfile.NamedTemporaryFile() as t:\n        t.write(b'1')\n    print(os.getcwd())\n    return x"
    )
    assert told.kind == "value", told
    assert not os.path.exists(told.printed.strip())
    assert (
        outcome(
            "import os\ndef f(x):\n    os.mkdir('d'); os.chmod('d', 0); return x"
        ).kind
        == "value"
    )


@pytest.mark.slow
@POSIX
def test_files_are_limited_in_size_and_number():
    large = run(
        "def f(x):\n    open('big', 'wb').write(b'0' * 8_000_000)\n    return x",
        seconds=30.0,
        file_mb=5,
    )
    assert (
        large.end == "files" or "File too large" in large.reply.outcomes[0].text
    )  # whichever comes first
    many = "def f(x):\n    for i in range(3000): open(str(i), 'w').close()\n    while True: pass"
    assert run(many, seconds=30.0).end == "files"


FORGED = """
import os
def f(x):
    for i in range(3, 20):
        try:
            os.write(i, b'passed' * 9)
        except OSError:
            pass
    os._exit(0)
"""


@pytest.mark.slow
@POSIX
def test_what_was_written_to_the_reply_from_outside_is_no_reply():
    result = run(FORGED)
    assert (result.end, result.stage, result.reply) == ("unreadable", "ready", None), (
        result
    )


@pytest.mark.slow
@POSIX
def test_recursion_without_end():
    # Without Python's own limit it ends by memory, by the clock or by a crash, as the version of Python has it.
    deep = run(
        "import sys\nsys.setrecursionlimit(10**9)\ndef f(x):\n    return f(x)",
        seconds=1.0,
        memory_mb=300,
    )
    assert deep.end in ("crashed", "time") or deep.reply.outcomes[0].kind == "raised"


@POSIX
def test_limits_are_set_on_the_process():
    """The processor's is for what the clock does not see: a judge that was stopped itself looks at no clock."""
    source = (
        "import resource as r\nfrom course.grading.limits import Limits, apply_limits\n"
        "apply_limits(Limits(seconds=4.5, memory_mb=900, file_mb=7))\n"
        "print([r.getrlimit(k) for k in (r.RLIMIT_CPU, r.RLIMIT_FSIZE, r.RLIMIT_CORE)])"
    )
    told = subprocess.run(
        [sys.executable, "-c", source], capture_output=True, text=True, timeout=60
    ).stdout
    assert told.strip() == "[(7, 9), (7000000, 7000000), (0, 0)]"
    assert sandbox._ended(-signal.SIGXCPU, "case", 3) == sandbox.Run("time", "case", 3)


@pytest.mark.slow
def test_a_thread_that_goes_on_holds_nothing_up():
    source = "import threading, time\ndef f(x):\n    threading.Thread(target=time.sleep, args=(60,)).start()\n"
    source += "    return x"
    started = time.monotonic()
    assert value(source) == 1.0
    assert time.monotonic() - started < 20


@pytest.mark.slow
def test_a_batch_that_is_stopped_stops_its_answers():
    cancel = threading.Event()
    threading.Timer(0.7, cancel.set).start()
    started = time.monotonic()
    with pytest.raises(Cancelled):
        run("while True: pass", seconds=30.0, cancel=cancel)
    assert time.monotonic() - started < 20


@pytest.mark.slow
@POSIX
def test_processes_left_in_the_group_are_ended(monkeypatch, tmp_path):
    """Even a process that slipped past the guard ends with the one that started it."""
    slipped = "import pathlib, subprocess, sys\n" + (
        "p = subprocess.Popen(['sleep', '60'])\n"
        f"pathlib.Path({str(tmp_path / 'pid')!r}).write_text(str(p.pid))\n"
        "pathlib.Path(sys.argv[1], 'stage').write_text('case 0')\n"
    )
    monkeypatch.setattr(
        sandbox, "command", lambda folder: [sys.executable, "-c", slipped, str(folder)]
    )
    assert run("def f(x): return x").end == "ended"
    pid = int((tmp_path / "pid").read_text())
    for _ in range(100):
        told = subprocess.run(
            ["ps", "-o", "stat=", "-p", str(pid)], capture_output=True, text=True
        )
        if told.stdout.strip()[:1] in ("", "Z"):
            return
        time.sleep(0.05)
    os.kill(pid, 9)
    pytest.fail("a process was left")


@pytest.mark.slow
@POSIX
def test_memory_is_watched_where_it_cannot_be_limited(monkeypatch):
    """As on macOS: the memory that ps tells of is looked at while the answer runs."""
    monkeypatch.setattr(sandbox, "_watches_memory", lambda: True)
    assert run("import time\ndef f(x):\n    time.sleep(0.6); return x").end == "replied"
    monkeypatch.setattr(sandbox, "_resident_mb", lambda pid: 2001.0)
    assert run("import time\ndef f(x):\n    time.sleep(5); return x").end == "memory"


@POSIX
def test_memory_of_a_process_is_told():
    assert 10 < sandbox._resident_mb(os.getpid()) < 100_000
    assert sandbox._resident_mb(2**22 + 1) == 0.0


def test_a_machine_that_cannot_run_answers_says_so(monkeypatch):
    monkeypatch.setattr(
        sandbox,
        "command",
        lambda folder: [sys.executable, "-c", "raise SystemError('no numpy here')"],
    )
    with pytest.raises(SandboxFailure, match="no numpy here"):
        isolation(Limits())
    monkeypatch.setattr(sandbox, "command", lambda folder: [str(folder / "nothing")])
    with pytest.raises(SandboxFailure, match="no process for an answer"):
        isolation(Limits())


@pytest.mark.parametrize(
    "bad",
    [dict(seconds=0), dict(seconds=float("nan")), dict(memory_mb=10), dict(file_mb=0)],
)
def test_limits_that_cannot_be_are_refused(bad):
    with pytest.raises(ValueError, match=r"expected .*; got"):
        Limits(**bad)


@pytest.mark.slow
def test_packages_for_pictures_load_only_when_they_are_used():
    source = """
import matplotlib.pyplot as plt
import sympy
import scipy.optimize
import sys
def f(x):
    before = sum(name.split(".")[0] in ("matplotlib", "sympy", "scipy") for name in sys.modules)
    solved = scipy.optimize.nnls([[2.0]], [x])[0][0]
    plt.plot([x])
    plt.show()
    return before, solved, len(plt.get_fignums())
"""
    assert [float(v) for v in outcome(source, results=3, seconds=60.0).values] == [
        0.0,
        0.5,
        1.0,
    ]
