"""The command line: ``python3 -m course COMMAND``, also installed as ``course``.

Each command is a thin call; what it needs is imported when it runs, so that opening the workbook waits for nothing
else.
Exit codes: 0 done, 1 something was found wrong (a test, a check, a drift), 2 the request could not be carried out.
"""

from __future__ import annotations

import sys
from collections.abc import Callable, Iterator
from contextlib import contextmanager, suppress
from pathlib import Path
from typing import TYPE_CHECKING, Annotated, Any, NoReturn, TextIO

import typer

from course import environment

if TYPE_CHECKING:
    from course.grading.judge import Row

app = typer.Typer(
    help="How bodies collide and rest on each other: the workbook. Without a command, opens it in JupyterLab.",
    invoke_without_command=True, add_completion=False, pretty_exceptions_enable=False, rich_markup_mode=None,
)  # fmt: skip
Browser = Annotated[
    bool,
    typer.Option(
        "--browser/--no-browser", help="Open the browser, or only print the address."
    ),
]
Port = Annotated[
    int | None,
    typer.Option(min=1, max=65535, help="Port to serve on; a taken one gets the next."),
]


def run(arguments: list[str]) -> int:
    """Carry out a command line; returns its exit code."""
    # jsonschema, which Jupyter imports, would build 28 grammars to check addresses in other scripts than Latin:
    # two seconds at every start, for a check that no notebook asks for. Without the module it leaves it out.
    sys.modules.setdefault("rfc3987_syntax", None)  # type: ignore[arg-type]
    try:
        app(args=arguments, prog_name=environment.START)
    except SystemExit as end:
        return end.code if isinstance(end.code, int) else 1 if end.code else 0
    return 0


@app.callback()
def main(context: typer.Context, browser: Browser = True, port: Port = None) -> None:
    """Without a command: open the workbook. Options before a command are that command's defaults."""
    context.default_map = dict.fromkeys(
        ("open", "demo"), {"browser": browser, "port": port}
    )
    if context.invoked_subcommand is None:
        open_workbook(None, browser=browser, port=port)


@app.command("open")
def open_workbook(
    lesson: Annotated[str | None, typer.Argument(help='"10" or "impulse"; default: the first unfinished.')] = None,
    browser: Browser = True, port: Port = None,
) -> None:  # fmt: skip
    """Open a lesson in JupyterLab. It is copied to work/ first; what you saved there is never overwritten."""
    from course.workbook import lab
    from course.workbook.work_folder import open_lesson

    root = checkout()
    notebook = None
    with plainly():
        name = lesson or lesson_to_open(root)
        if name is None:
            typer.echo(
                "There is no lesson in lessons/ yet; JupyterLab opens at the project."
            )
        else:
            opened = open_lesson(name, root)
            notebook = opened.path
            for line in filter(
                None, [opened.message, f"JupyterLab opens work/{notebook.name}."]
            ):
                typer.echo(line)
    typer.echo("Ctrl-C in this window ends it.")
    lab.start(root, notebook, port=port, browser=browser)


def lesson_to_open(root: Path) -> str | None:
    """The first lesson where nothing was begun; afterwards the first of those there are that is unfinished."""
    from course.exercises.definition import all_lessons
    from course.workbook.recording import state
    from course.workbook.work_folder import lesson_files

    files = [path.stem for path in lesson_files(root)]
    begun = any((root / "work" / f"{name}.ipynb").exists() for name in files)
    passed = state(root / "work").passed if begun else frozenset()
    unfinished = {
        le.stem for le in all_lessons() if any(e.name not in passed for e in le.core)
    }
    wanted = files if not begun else [name for name in files if name in unfinished]
    return next(iter([*wanted, *files]), None)


@app.command()
def test(
    quick: Annotated[
        bool, typer.Option("--quick", help="Under a minute: unit tests, floors, lint.")
    ] = False,
    everything: Annotated[
        bool,
        typer.Option("--all", help="Also browser, peers, fresh clone, the long ones."),
    ] = False,
) -> None:
    """Run the project's tests, stage by stage."""
    from course.testing import run_tests

    if quick and everything:
        fail("--quick and --all exclude each other")
    raise typer.Exit(
        run_tests(checkout(), "quick" if quick else "all" if everything else "standard")
    )


@app.command()
def check(
    notebook: Annotated[
        Path, typer.Argument(help="A notebook, or the number of a lesson in work/.")
    ],
) -> None:
    """Check a notebook's exercises. Exit code 1 unless all are right, 2 if the file cannot be used."""
    from course.grading.grade import check_notebook
    from course.sandbox.session import SandboxFailure

    with plainly(SandboxFailure), bar("checking") as advance:
        done: list[str] = []

        def tell(row: Row) -> None:
            done.append(row.exercise.name)
            advance(len(done), None, row.exercise.name)

        report = check_notebook(notebook_named(notebook), on_row=tell)
    typer.echo(str(report))
    raise typer.Exit(0 if report.passed else 1)


@app.command()
def progress() -> None:
    """Show how far you are."""
    from course.workbook.recording import progress as table

    typer.echo(str(table(checkout() / "work")))


@app.command()
def build(
    check: Annotated[
        bool,
        typer.Option(
            "--check", help="Write nothing; exit code 1 where lessons/ differs."
        ),
    ] = False,
) -> None:
    """Make lessons/ from solutions/."""
    from course.workbook.building import build as build_lessons

    with plainly():
        drift = build_lessons(check=check)
    for line in drift:
        typer.echo(line)
    typer.echo(
        f"{len(drift)} lessons {'differ' if check else 'written'}"
        if drift
        else "lessons/ is as it should be"
    )
    raise typer.Exit(1 if check and drift else 0)


@app.command()
def grade(
    folder: Annotated[Path, typer.Argument(help="The folder with the submitted notebooks.")],
    out: Annotated[Path, typer.Option(help="The table to write; the pages are put beside it.")] = Path("grades.csv"),
    feedback: Annotated[Path | None, typer.Option(help="The folder for the feedback pages.")] = None,
    seed: Annotated[int | None, typer.Option(min=0, help="Draw the same inputs as an earlier batch.")] = None,
    time_limit: Annotated[float, typer.Option(min=0.1, help="Seconds an exercise may take.")] = 10.0,
    memory: Annotated[int, typer.Option(min=100, help="Megabytes an exercise may take.")] = 2000,
    workers: Annotated[int | None, typer.Option(min=1, help="Notebooks at a time; default: one a processor.")] = None,
    require_sandbox: Annotated[bool, typer.Option("--require-sandbox", help="Run nothing without a box.")] = False,
    repair_seconds: Annotated[float, typer.Option(min=0.0, help="For causes of a submission's wrong answers.")] = 2.0,
    force: Annotated[bool, typer.Option("--force", help="Mark all again, also what is as it was.")] = False,
) -> None:  # fmt: skip
    """Grade every notebook in a folder: a CSV table, and a page of feedback a student. A batch cut off goes on.

    Exit code 1 where the same command has something to make up for (a page that had no
    room, a process that did not start); 130, 129, 143 where Ctrl-C, SIGHUP or SIGTERM
    cut it off.
    """
    from course.grading.grade import grade_folder
    from course.grading.stopping import Stopped
    from course.sandbox.session import SandboxFailure

    try:
        with plainly(SandboxFailure), bar("grading") as advance:
            summary = grade_folder(folder, out, feedback=feedback, seed=seed, time_limit=time_limit, memory_mb=memory,
                                   workers=workers, force=force, require_sandbox=require_sandbox,
                                   repair_seconds=repair_seconds, on_progress=advance)  # fmt: skip
    except Stopped as stop:
        with suppress(OSError):  # the terminal may be gone
            typer.echo(
                f"{stop}: what is marked is in {out}, and the same command goes on from there",
                err=True,
            )
        raise typer.Exit(128 + stop.number) from None
    typer.echo(str(summary))
    raise typer.Exit(1 if summary.again or summary.unwritten else 0)


@app.command()
def syllabus() -> None:
    """Show slide -> lesson section -> reference code -> exercise -> test, row by row."""
    from course.workbook.syllabus import syllabus_table

    typer.echo(syllabus_table(checkout()))


@app.command()
def demo(
    name: Annotated[str | None, typer.Argument(help="The demo's name.")] = None,
    listing: Annotated[bool, typer.Option("--list", help="Name the demos, with slide and minutes.")] = False,
    browser: Browser = True, port: Port = None,
) -> None:  # fmt: skip
    """Serve a lesson's demo full screen, for a lecture room."""
    from course.workbook import demos

    if listing or name is None:
        typer.echo(demos.table())
        return
    from course.workbook.demos import full_screen

    with plainly():
        code = full_screen.serve(name, port=port, browser=browser)
    raise typer.Exit(code)


@app.command()
def film(
    name: Annotated[str | None, typer.Argument(help="The film's name.")] = None,
    listing: Annotated[bool, typer.Option("--list", help="Name the films, with slide and minutes.")] = False,
    out: Annotated[Path | None, typer.Option(help="The file: .html, .svg or .gif.")] = None,
    time: Annotated[float | None, typer.Option(help="The moment that an .svg shows [s].")] = None,
    large: Annotated[bool, typer.Option("--large", help="Text and controls for a lecture room.")] = False,
) -> None:  # fmt: skip
    """Write a film as one file: HTML that plays from disk, without a network; SVG; or GIF."""
    from course.workbook.films import listing as films

    if listing or name is None:
        typer.echo(films.table())
        return
    from course.workbook.stage.files import export

    target = out or Path(f"{name}.html")
    with plainly(RuntimeError):
        shown = films.find_film(name)
        size = export(
            shown.exhibit(), target, time=shown.still if time is None else time, large=large
        )  # fmt: skip
        typer.echo(f"{target}: {size / 1000:,.0f} kB")


def checkout() -> Path:
    """The project's folder; a sentence and exit code 2 where only the library is installed."""
    root = environment.project_root()
    if root is None:
        fail(
            "this needs the project's folder (lessons, solutions, work): clone it and start there"
        )
    return Path(root)


def notebook_named(name: Path) -> Path:
    """A notebook's path as given, or the copy in work/ of the lesson of that name."""
    if name.exists() or name.suffix == ".ipynb":
        return name
    from course.workbook.work_folder import find_lesson

    root = checkout()
    return root / "work" / find_lesson(name, root).name


def fail(sentence: str) -> NoReturn:
    """Say why the request cannot be carried out, and end with 2."""
    typer.echo(sentence, err=True)
    raise typer.Exit(2)


@contextmanager
def plainly(*more: type[Exception]) -> Iterator[None]:
    """Turn a bad argument, an unusable file (or one of ``more``) into its sentence and exit code 2."""
    kinds: tuple[type[Exception], ...] = (ValueError, OSError, *more)
    try:
        yield
    except kinds as problem:
        fail(str(problem))


@contextmanager
def bar(what: str) -> Iterator[Callable[[int, int | None, str], None]]:
    """A progress bar; the function it gives is called with how many are done, of how many, and the current name."""
    from rich.console import Console
    from rich.progress import (
        BarColumn,
        MofNCompleteColumn,
        Progress,
        TextColumn,
        TimeElapsedColumn,
    )

    columns = (
        TextColumn("{task.description}"),
        BarColumn(),
        MofNCompleteColumn(),
        TimeElapsedColumn(),
    )
    console = Console(file=_MayBeGone(sys.stderr))  # type: ignore[arg-type]
    with Progress(*columns, console=console, transient=True) as shown:
        task = shown.add_task(what, total=None)
        yield lambda done, total, name: shown.update(
            task, completed=done, total=total, description=f"{what} {name}"
        )


class _MayBeGone:
    """A stream to a terminal that may be closed meanwhile: a bar is no reason to fail."""

    def __init__(self, stream: TextIO) -> None:
        self._stream = stream

    def write(self, text: str) -> int:
        with suppress(OSError):
            self._stream.write(text)
        return len(text)

    def flush(self) -> None:
        with suppress(OSError):
            self._stream.flush()

    def __getattr__(self, name: str) -> Any:
        return getattr(self._stream, name)
