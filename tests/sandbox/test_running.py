"""The process a submission runs in: limits, what it may not do, and that nothing of it is left."""

import json
import os
import signal
import subprocess
import sys
import tempfile
import threading
import time
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest
from sandbox.runs import (
    BOXED,
    EITHER_WAY,
    LINUX,
    POSIX,
    descendants,
    is_running,
    notebook_of,
    outcome,
    run,
    value,
)

from course.exercises.notebook_file import UnusableNotebook
from course.exercises.question import Question
from course.sandbox import box, running, watching, wire
from course.sandbox.box import Start, start_in_box, start_plain
from course.sandbox.ending import end_of
from course.sandbox.findings import checked_run
from course.sandbox.limits import Limits, resident_mb
from course.sandbox.running import Sandbox, find_isolation
from course.sandbox.session import MOST_WAITING, Cancelled, SandboxFailure, Session

#: Seconds together: left out of the minute's run.
pytestmark = pytest.mark.slow


@pytest.fixture(autouse=True)
def nothing_left(tmp_path, monkeypatch):
    """Every test leaves the folder for temporary files as it was."""
    monkeypatch.setattr(tempfile, "tempdir", str(tmp_path))
    yield
    assert [p.name for p in tmp_path.iterdir() if p.name.startswith("course-")] == []


@EITHER_WAY
def test_every_kind_of_argument_arrives_as_it_was_sent(boxed):
    case = {"x": (np.arange(6.0).reshape(2, 3), 2, True, "word", np.inf)}
    told = outcome(
        "def f(x):\n    a, n, t, w, i = x\n"
        "    return a * n, [t, i > 1, w == 'word', type(n) is int]",
        case=case, results=2, boxed=boxed,
    )  # fmt: skip
    assert told.values[0].tolist() == [[0, 2, 4], [6, 8, 10]]
    assert told.values[1].tolist() == [True] * 4


@EITHER_WAY
def test_arguments_come_back_as_the_answer_left_them(boxed):
    """What compares could be patched where the answer runs: the comparison is not made there."""
    source = "import numpy as np\nnp.array_equal = lambda *a, **k: True\n"
    source += "def f(x):\n    x *= 3\n    return x"
    told = outcome(source, case={"x": np.arange(3.0)}, boxed=boxed)
    assert told.given["x"].tolist() == [0, 3, 6]


@pytest.mark.slow
@LINUX
@EITHER_WAY
def test_memory_is_limited(boxed):
    small = "import numpy as np\ndef f(x):\n    return np.ones(3 * 10**7)[:3]"
    assert "Memory" in outcome(small, memory_mb=300, boxed=boxed).text
    assert value(small, boxed=boxed).tolist() == [1.0] * 3


@LINUX
def test_the_report_says_what_holds():
    found = find_isolation(Limits())
    assert {"clock", "memory", "processor time", "audit hook"} <= set(found.parts)
    assert str(found).startswith("trusted: ") != found.boxed
    assert bool(found.reason) != found.boxed


@BOXED
def test_in_the_box_system_calls_are_closed_too():
    assert {"bubblewrap", "system calls"} <= set(find_isolation(Limits()).parts)


@EITHER_WAY
def test_the_environment_of_the_grader_does_not_travel(monkeypatch, boxed):
    monkeypatch.setenv("TOKEN_OF_THE_GRADER", "secret")
    source = "import os\ndef f(x):\n    return [int('TOKEN_OF_THE_GRADER' in os.environ), len(os.environ)]"
    seen = value(source, boxed=boxed)
    assert seen[0] == 0 and seen[1] < 20


@pytest.mark.slow
@EITHER_WAY
def test_course_is_a_stand_in_and_the_reference_cannot_be_read(boxed):
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
    assert value(source, boxed=boxed) == 2.0
    told = outcome(
        "from course.dynamics import impulse_central\ndef f(x):\n    return impulse_central(x)",
        boxed=boxed,
    )
    assert (told.kind, told.text) == (
        "raised",
        "CourseNotHere: It calls the course itself, which is not there while an answer is marked.",
    )
    folder = box.PACKAGE / "exercises" / "definitions"
    place = str(folder / "__init__.py")
    told = outcome(f"def f(x):\n    return len(open({place!r}).read())", boxed=boxed)
    words = "No such file" if boxed else "cannot be read"
    assert told.kind == "raised" and words in told.text
    around = f"""
import sys
def f(x):
    sys.meta_path[:] = [m for m in sys.meta_path if type(m).__name__ != '_Finder']
    sys.path[:0] = [{str(box.ROOT)!r}, {box.FILES_IN_BOX!r}]
    for name in [n for n in sys.modules if n.startswith('course')]: del sys.modules[name]
    import course.exercises.definitions.lesson_10_impulse
"""
    words = "No module named" if boxed else "cannot be read"
    assert words in outcome(around, boxed=boxed).text


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
os.open(os.path.dirname(PLACE), os.O_RDONLY)
os.open('x', os.O_RDONLY, dir_fd=3)
os.unlink('x', dir_fd=3)
os.mknod('x')
os.mkfifo('x')
os.nice(1)
os.sched_setaffinity(0, {0})
os.pidfd_open(os.getppid())
gc.get_objects()
gc.get_referrers(os)
"""


@pytest.mark.slow
@POSIX
@EITHER_WAY
def test_what_an_answer_may_not_do_is_refused_and_told(tmp_path, boxed):
    place = tmp_path / "kept" / "file"
    place.parent.mkdir()
    place.write_text("mine")
    lines = [
        line
        for line in REFUSED.strip().splitlines()
        if hasattr(os, line.split("(")[0].removeprefix("os."))
        or not line.startswith("os.")
    ]
    source = f"""
import ctypes, gc, multiprocessing, os, resource, shutil, socket, subprocess, sys
PLACE = {str(place)!r}
open('a', 'w').close()
def f(x):
    refused = []
    for line in {lines!r}:
        try:
            exec(line)
        except PermissionError as error:
            refused.append('allowed' in str(error) or 'cannot be opened' in str(error))
        except FileNotFoundError:
            refused.append({boxed})
        else:
            refused.append(False)
    return refused
"""
    ended = run(source, boxed=boxed)
    (told,) = ended.reply.answer.outcomes
    done = dict(zip(lines, told.values[0].tolist(), strict=True))
    assert [line for line, refused in done.items() if not refused] == []
    assert place.read_text() == "mine"
    told = {"os.fork", "os.system"} | (set() if boxed else {f"writing to {place}"})
    assert told <= set(ended.refused)


#: What the hook cannot stop: each gives 1 where it works. SECRET and PLACE are files outside.
ESCAPES = {
    "a system call for a fork": "libc.syscall(57 if x86 else 220, 17, 0, 0, 0, 0)",
    "a new process past Python": "libc.system(b'true') == 0",
    "a file in memory": "libc.syscall(319 if x86 else 279, b'm', 0)",
    "a signal to its parent": "libc.kill(libc.getppid(), 0) == 0",
    "reading a file": "libc.open(SECRET.encode(), 0)",
    "writing a file": "libc.open(PLACE.encode(), 0o1102, 0o600)",
    "a socket": "libc.socket(2, 1, 0)",
    "shared memory": "libc.shmget(7, 4096, 0o1600)",
    "a namespace": "libc.unshare(0x10000000) == 0",
    "a trace of its parent": "libc.ptrace(16, libc.getppid(), 0, 0) == 0",
    "another limit": "libc.setpriority(0, 0, 5) == 0",
    "what the kernel tells of processes": "libc.open(b'/proc/1/environ', 0)",
}


@pytest.mark.slow
@BOXED
@pytest.mark.parametrize("name", ESCAPES)
def test_past_the_hook_the_box_still_holds(name, tmp_path):
    """The hook is disarmed first, through what it put in the place of functions."""
    secret, place = tmp_path / "secret", tmp_path / "place"
    secret.write_text("secret")
    source = f"""
import platform, sys
import os
import numpy.ctypeslib
cells = [c.cell_contents for c in os.mknod.__closure__]
guard = next(c for c in cells if hasattr(c, '_tell'))
type(guard).__call__ = lambda *_: None
libc = sys.modules['ctypes'].CDLL(None)
x86, SECRET, PLACE = platform.machine() == 'x86_64', {str(secret)!r}, {str(place)!r}
def f(x):
    done = {ESCAPES[name]}
    return float(done is True or (done is not False and done >= 0))
"""
    told = outcome(source, boxed=True)
    assert told.kind == "value" and told.values[0] == 0.0, told
    assert not place.exists()


@pytest.mark.slow
@POSIX
@EITHER_WAY
def test_its_own_folder_can_be_written_to_and_is_gone_afterwards(boxed):
    folder = "import os, pathlib, tempfile\ndef f(x):\n    pathlib.Path('a').write_text('b')\n"
    told = outcome(
        folder
        + "    with tempfile.NamedTemporaryFile() as t:\n        t.write(b'1')\n"
        + "    with tempfile.TemporaryDirectory() as d:\n        open(d + '/b', 'w').close()\n"
        + "    print(os.getcwd())\n    return x",
        boxed=boxed,
    )
    assert told.kind == "value", told
    assert not os.path.exists(told.printed.strip())
    locked = "import os\ndef f(x):\n    os.mkdir('d'); os.chmod('d', 0); return x"
    assert outcome(locked, boxed=boxed).kind == "value"


@pytest.mark.slow
@POSIX
@EITHER_WAY
def test_files_are_limited_in_size_and_number(boxed):
    large = "def f(x):\n    open('big', 'wb').write(b'0' * 8_000_000)\n    return x"
    ended = run(large, seconds=30.0, file_mb=5, boxed=boxed)
    words = ("File too large", "No space left")
    assert ended.end == "files" or any(
        w in ended.reply.answer.outcomes[0].text for w in words
    )
    several = "def f(x):\n    for i in range(9): open(str(i), 'wb').write(b'0' * 10**6)\n    while True: pass"
    ended = run(several, seconds=30.0, file_mb=5, boxed=boxed)
    assert ended.end == "files" or words[1] in ended.reply.answer.outcomes[0].text
    many = "def f(x):\n    for i in range(3000): open(str(i), 'w').close()\n    while True: pass"
    assert run(many, seconds=30.0, boxed=boxed).end == "files"


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
@EITHER_WAY
def test_what_was_written_to_the_reply_from_outside_is_no_reply(boxed):
    result = run(FORGED, boxed=boxed)
    assert result.reply is None and result.end in ("unreadable", "ended"), result


@pytest.mark.slow
@POSIX
@EITHER_WAY
def test_recursion_without_end(boxed):
    # Without Python's own limit it ends by memory, by the clock or by a crash, as the version of Python has it.
    source = "import sys\nsys.setrecursionlimit(10**9)\ndef f(x):\n    return f(x)"
    deep = run(source, seconds=1.0, memory_mb=300, boxed=boxed)
    assert (
        deep.end in ("crashed", "time")
        or deep.reply.answer.outcomes[0].kind == "raised"
    )


@POSIX
def test_limits_are_set_on_the_process():
    """The processor's is for what the clock does not see: a watcher that was stopped itself looks at no clock."""
    source = (
        "import resource as r\nfrom course.sandbox.limits import Limits, apply_limits\n"
        "apply_limits(Limits(seconds=4.5, memory_mb=900, file_mb=7))\n"
        "print([r.getrlimit(k) for k in (r.RLIMIT_CPU, r.RLIMIT_FSIZE, r.RLIMIT_CORE)])"
    )
    command = [sys.executable, "-c", source]
    told = subprocess.run(command, capture_output=True, text=True, timeout=60).stdout
    assert told.strip() == "[(7, 9), (7000000, 7000000), (1, 1)]"


@POSIX
@pytest.mark.parametrize(
    "code, end",
    [
        (-signal.SIGXCPU, ("time", "")),
        (-signal.SIGSEGV, ("crashed", "SIGSEGV")),
        (-signal.SIGKILL, ("killed", "SIGKILL")),
        (3, ("ended", "exit code 3")),
        (-99, ("crashed", "signal 99")),
    ],
)
def test_an_exit_code_tells_an_end(code, end):
    assert end_of(code) == end


@pytest.mark.slow
@EITHER_WAY
def test_a_thread_that_goes_on_holds_nothing_up(boxed):
    source = "import threading, time\ndef f(x):\n    threading.Thread(target=time.sleep, args=(60,)).start()\n"
    started = time.monotonic()
    assert value(source + "    return x", boxed=boxed) == 1.0
    assert time.monotonic() - started < 20


@pytest.mark.slow
@EITHER_WAY
def test_a_batch_that_is_stopped_stops_its_answers(boxed):
    cancel = threading.Event()
    threading.Timer(0.7, cancel.set).start()
    started = time.monotonic()
    with pytest.raises(Cancelled):
        run("def f(x):\n    while True: pass", seconds=30.0, cancel=cancel, boxed=boxed)
    assert time.monotonic() - started < 20


@pytest.mark.slow
@POSIX
@EITHER_WAY
def test_nothing_survives_a_grader_that_is_killed(boxed, tmp_path):
    """kill -9 gives the grader no time for anything: its children see that it is gone."""
    source = f"""
import sys, tempfile
sys.path[:0] = {[str(box.ROOT), str(box.ROOT / "tests")]!r}
tempfile.tempdir = {str(tmp_path)!r}
from sandbox.runs import run
print("now", flush=True)
print(run('def f(x):\\n    while True: pass', seconds=600.0, boxed={boxed}))
"""
    deadline = time.monotonic() + 30
    grader = subprocess.Popen([sys.executable, "-c", source], stdout=subprocess.PIPE)
    try:
        assert grader.stdout is not None and grader.stdout.readline() == b"now\n"
        while (
            len(descendants(grader.pid)) < 2 + 2 * boxed and time.monotonic() < deadline
        ):
            time.sleep(0.1)
        time.sleep(0.5)
        started = descendants(grader.pid)
        assert len(started) >= 2
    finally:
        grader.send_signal(signal.SIGKILL)
        grader.wait()
        grader.stdout.close()
    while any(map(is_running, started)) and time.monotonic() < deadline:
        time.sleep(0.1)
    assert not any(map(is_running, started))
    while any(tmp_path.iterdir()) and time.monotonic() < deadline:
        time.sleep(0.1)
    assert list(tmp_path.iterdir()) == []


@pytest.mark.slow
@POSIX
def test_memory_is_watched_where_it_cannot_be_limited(monkeypatch, tmp_path):
    """As on macOS: the memory that ps tells of is looked at while the answer runs."""
    assert 10 < resident_mb(os.getpid()) < 100_000
    assert resident_mb(2**22 + 1) == 0.0
    limits, place = Limits(seconds=99.0), str(tmp_path)
    seen = watching.Watch(
        os.getpid(), 0, 0, None, place, limits, boxed=False, seconds=99.0
    )
    seen._looked -= 1.0
    assert seen._passed() is None
    monkeypatch.setattr(watching, "watches_memory", lambda: True)
    monkeypatch.setattr(watching, "resident_mb", lambda pid: 2001.0)
    seen._looked -= 1.0
    assert seen._passed() == "memory"


@pytest.mark.parametrize("way", ["start_plain", "start_in_box"])
def test_a_machine_that_cannot_run_answers_says_so(monkeypatch, way):
    broken = (sys.executable, "-c", "raise SystemError('no numpy here')")
    absent = (str(Path(sys.executable).with_name("nothing")),)
    monkeypatch.setattr(running, "bubblewrap", lambda: "bwrap")
    plain, words = (broken, "no numpy here") if way == "start_plain" else (absent, "no process")  # fmt: skip
    for name in ("start_plain", "start_in_box"):
        monkeypatch.setattr(running, name, lambda *_: Start(plain, {}, "."))
    with pytest.raises(SandboxFailure, match=words):
        find_isolation(Limits())


@BOXED
def test_where_the_box_fails_submissions_are_said_to_be_trusted(monkeypatch):
    monkeypatch.setattr(box, "_walls", lambda _: ["--no-such-option"])
    found = find_isolation(Limits())
    assert not found.boxed and str(found).startswith("trusted: ")
    assert "no-such-option" in found.reason


@EITHER_WAY
@pytest.mark.parametrize(
    "content, words",
    [
        (b"", "the file is empty"),
        (b'{"nbformat": 4}', "it has no list of cells"),
        (b"[" * 10**6, "nested too deeply"),
    ],
)
def test_what_is_no_notebook_is_told_from_inside(boxed, content, words):
    sandbox = running.Sandbox(Limits(), boxed)
    with pytest.raises(UnusableNotebook, match=words):
        with sandbox.submission(content, "f.ipynb", []):
            pass


@pytest.mark.parametrize(
    "bad",
    [dict(seconds=0), dict(seconds=float("nan")), dict(memory_mb=10), dict(file_mb=0)],
)
def test_limits_that_cannot_be_are_refused(bad):
    with pytest.raises(ValueError, match=r"expected .*; got"):
        Limits(**bad)


@pytest.mark.slow
@EITHER_WAY
def test_packages_for_pictures_load_only_when_they_are_used(boxed):
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
    told = outcome(source, results=3, seconds=60.0, boxed=boxed)
    assert [float(v) for v in told.values] == [0.0, 0.5, 1.0], told


def test_the_box_holds_what_the_child_imports_and_no_more():
    """The files are bound one by one: nothing else of the course is there."""
    code = (
        "import sys, json; sys.path.insert(0, sys.argv[1]); "
        "import course.sandbox.serving_repairs, course.sandbox.child, course.sandbox.serving; print(json.dumps(sorted("
        "m.__file__ for n, m in sys.modules.items() if n.split('.')[0] == 'course')))"
    )
    command = [sys.executable, "-c", code, str(box.ROOT)]
    told = subprocess.run(command, capture_output=True, text=True).stdout
    loaded = [Path(p).relative_to(box.ROOT).as_posix() for p in json.loads(told)]
    assert tuple(loaded) == box.CHILD_FILES


@BOXED
def test_thousands_of_threads_are_ended_before_the_machine_has_no_numbers_left():
    source = """import _thread
_thread.stack_size(32768)
lock = _thread.allocate_lock()
lock.acquire()
for _ in range(20_000): _thread.start_new_thread(lock.acquire, ())
def f(x): return x"""
    assert run(source, boxed=True).end == "threads"


@BOXED
def test_some_hundred_threads_are_nobodys_business():
    source = """import threading, time
def f(x):
    for _ in range(300):
        t = threading.Thread(target=time.sleep, args=(0.002,))
        t.start()
        t.join()
    return x"""
    assert run(source, boxed=True).end == "replied"


SILENT = "import os, time; os.write(1, b'B' + bytes(4)); time.sleep(60)"


@POSIX
@EITHER_WAY
def test_a_child_that_began_and_never_is_ready_is_ended_at_once(boxed, tmp_path):
    start = start_in_box(2000, 100) if boxed else start_plain(tmp_path)
    places = start.command.index("-X")
    silent = replace(start, command=(*start.command[: places + 2], "-c", SILENT))
    session = Session(silent, Limits(), boxed=boxed)
    assert session._begun.wait(30)
    started = [session._process.pid, *descendants(session._process.pid)]
    assert len(started) >= 1 + boxed
    before = time.monotonic()
    session.close()
    assert time.monotonic() - before < 2
    time.sleep(0.1)
    assert not any(map(is_running, started))


@POSIX
@pytest.mark.parametrize("boxed", [False, True])
def test_a_box_that_is_half_built_ends_by_itself(boxed):
    """bubblewrap that is killed while it starts leaves a process behind; a plain process does not."""
    slow = (sys.executable, "-c", "import time; time.sleep(0.5); raise SystemExit(7)")
    session = Session(Start(slow, dict(os.environ), "/"), Limits(), boxed=boxed)
    session.close()
    assert session._process.returncode == (7 if boxed else -signal.SIGKILL)


@BOXED
@pytest.mark.parametrize("moment", [0.0, 0.01, 0.03])
def test_nothing_is_left_of_a_box_that_is_not_wanted_while_it_starts(moment):
    session = Session(start_in_box(2000, 100), Limits(), boxed=True)
    time.sleep(moment)
    started = [session._process.pid, *descendants(session._process.pid)]
    session.close()
    time.sleep(0.1)
    assert not any(map(is_running, started))


class Compromised(Sandbox):
    """A process that is a stranger's from its start."""

    def _start(self, stack):
        return Start((sys.executable, "-c", self.program), dict(os.environ), "/")


def compromised(program):
    sandbox = Compromised(Limits(1.0))
    object.__setattr__(sandbox, "program", BEGIN + program)
    return sandbox


BEGIN = """
import os, struct, sys, time
def send(letter, payload): os.write(1, struct.pack('<cI', letter, len(payload)) + payload)
send(b'A', b'')
"""


@POSIX
def test_a_process_that_never_stops_sending_fills_no_memory():
    sandbox = compromised("while True: send(b'N', bytes(50_000))")
    session = Session(sandbox._start(None), sandbox.limits)
    time.sleep(0.5)
    assert session._inbox.qsize() <= MOST_WAITING + 1
    session.close()
    assert not session._listener.is_alive()


@POSIX
def test_a_process_that_takes_nothing_is_not_waited_for(monkeypatch):
    monkeypatch.setattr("course.sandbox.session.SEND_SECONDS", 0.5)
    large = notebook_of("#" * 1_000_000)
    with pytest.raises((UnusableNotebook, SandboxFailure)):
        with compromised("time.sleep(30)").submission(large, "f.ipynb", []):
            pass


@POSIX
def test_a_reader_that_somebody_ends_is_no_fault_of_the_notebook():
    with pytest.raises(SandboxFailure, match="ended from outside"):
        program = "os.read(0, 100); os.kill(os.getpid(), 9)"
        with compromised(program).submission(notebook_of("1"), "f.ipynb", []):
            pass


def test_a_reply_of_a_million_nothings_is_not_taken_apart():
    question = Question("f", "function", ("x",), 1, ({"x": 1.0},), (1,))
    reply = np.frombuffer(wire.pack([[]] * 1_000_000), np.uint8)
    ended = checked_run({"end": "replied", "reply": reply}, question)
    assert (ended.end, ended.detail) == ("unreadable", "lengths out of bounds")
