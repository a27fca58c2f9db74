"""The command line: which commands there are, how one is chosen, how errors are reported; else the window.

A command is a module with ``add_arguments(parser)`` and ``run(options) -> int``; it is imported when it is
called, so that no command waits for what another one needs.
"""

import argparse
import gc
import importlib
import io
import os
import sys
from collections.abc import Callable, Sequence
from contextlib import AbstractContextManager, nullcontext
from dataclasses import dataclass
from importlib import import_module
from pathlib import Path
from typing import Any, NoReturn

from app import __version__
from app.usage import PROGRAM, UsageError
from lessons.os_errors import problem_text

# The window, opened from the command line.


BEFORE_QT = ("app.files.open_any", "core.fast_path.workers.band_workers", "core.trace.tracers")
"""Modules that the window needs and that need no Qt. Once PySide6 is loaded, it reads the source of every module that
is imported from then on, to look for its own features: some 0.1 ms for each of several hundred."""


def run(target: str | None, allows_outside: bool = False) -> int:
    """Show the window until it is closed; return the exit code.

    ``allows_outside``: files that the target names may be read from outside its folder. Raises ValueError if there is
    no display, or Qt cannot be loaded.
    """
    if is_display_missing():
        raise ValueError(
            "there is no display to open a window on; to render to a file: rasterscope render FILE -o out.png"
        )
    # What is imported stays, and is not garbage: looking through it again and again takes a tenth of the start.
    gc.disable()
    try:
        for module in BEFORE_QT:
            import_module(module)
        load_qt()
        from app.window.start import run_window
    finally:
        gc.freeze()  # Without it a full pass of the collector takes 45 ms in place of 8.
        gc.enable()
    return run_window(target, allows_outside)


def is_display_missing() -> bool:
    """Return whether Qt would find nothing to show a window on, which ends the process without a word."""
    if not sys.platform.startswith("linux") or os.environ.get("QT_QPA_PLATFORM"):
        return False
    return not (os.environ.get("DISPLAY") or os.environ.get("WAYLAND_DISPLAY"))


def load_qt() -> None:
    """Load Qt, or raise ValueError with what it lacks."""
    try:
        import PySide6.QtSvg
        import PySide6.QtWidgets  # noqa: F401
    except ImportError as problem:
        raise ValueError(f"the window and its charts need Qt, which cannot be loaded: {problem}") from problem


# The command line: which commands there are, how one is chosen, and how errors are reported.


MOST_ROUNDS = 1000
MOST_SEED = 999_999_999
USAGE_ERROR = 2
INTERRUPTED = 130


@dataclass(frozen=True)
class Command:
    """One command without a window, or one that needs none to be seen."""

    name: str
    summary: str
    module: str


COMMANDS = (
    Command("render", "draw a scene into a PNG file, and its buffers into an npz file", "app.cli.render"),
    Command("trace", "write what one stage did, row by row, as text, JSON, CSV or npz", "app.cli.trace"),
    Command("methods", "list the methods that settings choose from", "app.cli.methods"),
    Command("scenes", "list the built-in scenes", "app.cli.scenes"),
    Command("slides", "list the lectures' numbers and listings, and check them", "app.cli.slides"),
    Command("screenshot", "save a picture of the window without showing it", "app.cli.screenshot"),
    Command("opengl-check", "compare the core with the OpenGL of this machine", "app.cli.opengl_check"),
    Command("study", "measure the methods of a family: speed against accuracy", "app.cli.study"),
    Command("stress", "map where methods fail, and make failing cases small", "app.cli.stress"),
    Command("plan", "choose the cheapest methods that a scene needs, within a tolerance", "app.cli.plan"),
    Command("lesson", "list the lessons of the course, print one, check lesson files", "app.cli.lesson"),
    Command("exercise", "ask questions by seed, check answers and exercise files", "app.cli.exercise"),
    Command("diagnose", "say which mistake or method makes a picture", "app.cli.diagnose"),
    Command("bench", "measure the core against other libraries", "app.cli.bench"),
)

EXAMPLES = """examples:
  rasterscope                         open the window with the last scene
  rasterscope teapot.obj              open a mesh
  rasterscope lesson.rasterscope      open a saved state
  rasterscope shared-edge             open a built-in scene
  rasterscope render cube -o cube.png --size 640x480 --set shading=gouraud
  rasterscope trace cube --triangle 3 --stage raster --format csv
"""

FILES = """FILE is a mesh (OBJ, PLY, STL, OFF, GLB, glTF, XYZ, DXF), a state file (.rasterscope) or the name of a
built-in scene; a file with the name of a command or scene opens as ./name.
"""


def add_allow_outside(parser: argparse.ArgumentParser) -> None:
    """Let a command take ``--allow-outside``."""
    parser.add_argument(
        "--allow-outside", action="store_true", help="read files that FILE names from outside its folder, too"
    )


def whole_number(low: int, high: int | None = None) -> Callable[[str], int]:
    """Return what reads the whole number of an option."""

    def read(text: str) -> int:
        digits = 19 if high is None else max(len(str(high)), 10)
        is_number = text.isascii() and text.isdecimal() and len(text) <= digits
        if not is_number or int(text) < low or (high is not None and int(text) > high):
            limits = f"from {low}" if high is None else f"from {low} to {high}"
            raise argparse.ArgumentTypeError(f"must be a whole number {limits}, got {text}")
        return int(text)

    return read


def output_folder(options: argparse.Namespace) -> Path | None:
    """Return the folder that ``-o`` names, ``None`` without it, or raise UsageError where it cannot be written to."""
    folder = None if options.output is None else Path(options.output)
    if folder is not None and not folder.is_dir():
        raise UsageError(f"argument -o: there is no folder {folder}")
    if folder is not None and not os.access(folder, os.W_OK):
        raise UsageError(f"argument -o: {folder} may not be written to")
    return folder


class Parser(argparse.ArgumentParser):
    """A parser whose errors are one line."""

    def error(self, message: str) -> NoReturn:
        """Raise UsageError instead of writing several lines."""
        raise UsageError(f"{message} ({self.prog} --help explains)")


def run_command_line(arguments: Sequence[str]) -> int:
    """Run the command, or open the window; return the exit code.

    Returns
    -------
    int
        0: all went well; 1: something could not be done; 2: the command line is wrong; 130: Ctrl+C.
        What went wrong is one line on stderr.
    """
    for stream in (sys.stdout, sys.stderr):
        if isinstance(stream, io.TextIOWrapper):
            stream.reconfigure(errors="replace")
    program = PROGRAM
    try:
        command = next((c for c in COMMANDS if arguments and c.name == arguments[0]), None)
        program = f"{PROGRAM} {command.name}" if command else PROGRAM
        code = _run_command(command, arguments[1:]) if command else _run_window(arguments)
        if sys.stdout is not None:  # as without a console
            sys.stdout.flush()
        return code
    except KeyboardInterrupt:
        return INTERRUPTED
    except BrokenPipeError:
        # Whoever reads the output has gone, as ``head`` does.
        _silence_stdout()
        return 1
    except UsageError as problem:
        return _fail(program, problem, USAGE_ERROR)
    except MemoryError:
        return _fail(program, "there is not enough memory for this", 1)
    except OSError as problem:
        _silence_stdout()
        is_output = problem.strerror is not None and problem.filename is None
        return _fail(
            program, f"{'the output cannot be written: ' if is_output else ''}{problem_text(problem)}", 1
        )
    except (ValueError, ImportError) as problem:
        return _fail(program, problem, 1)


def _run_command(command: Command, arguments: Sequence[str]) -> int:
    module: Any = importlib.import_module(command.module)
    parser = Parser(
        prog=f"{PROGRAM} {command.name}",
        description=module.DESCRIPTION,
        epilog=module.EXAMPLES,
        formatter_class=argparse.RawDescriptionHelpFormatter,
        allow_abbrev=False,
    )
    module.add_arguments(parser)
    options = _parse(parser, arguments)
    if options is None:
        return 0
    with _watched():
        code: int = module.run(options)
    return code


def _watched() -> AbstractContextManager[None]:
    """Say what takes long, where the command has loaded NumPy: bench sets the number of threads before."""
    if "numpy" not in sys.modules:
        return nullcontext()
    watched: Callable[..., AbstractContextManager[None]] = import_module("core.numeric.watched").watched
    return watched(show_work)


def show_work(fraction: float | None, doing: str) -> None:
    """Say once on stderr what takes long, before it begins; a terminal shows how far it is, too."""
    if fraction is None:
        print(f"{PROGRAM}: {doing}", file=sys.stderr, flush=True)
    elif sys.stderr is not None and sys.stderr.isatty():
        print(f"\r\x1b[K{100 * fraction:.0f} %", end="\r", file=sys.stderr, flush=True)


def _run_window(arguments: Sequence[str]) -> int:
    rows = "".join(f"  {command.name:<14}{command.summary}\n" for command in COMMANDS)
    parser = Parser(
        prog=PROGRAM,
        usage=f"{PROGRAM} [FILE]\n       {PROGRAM} COMMAND ...",
        description="Step through the rasterization pipeline, pixel by pixel, forwards and backwards.",
        epilog=f"commands ({PROGRAM} COMMAND --help explains each):\n{rows}\n{EXAMPLES}\n{FILES}\n"
        "Exit code: 0 done, 1 failed (stderr has the reason in one line), 2 wrong usage, 130 Ctrl+C.",
        formatter_class=argparse.RawDescriptionHelpFormatter,
        allow_abbrev=False,
    )
    named = [argument for argument in arguments if argument not in ("--allow-outside", "--")]
    if len(named) > 1 and not {"-h", "--help", "--version"} & set(arguments):
        names = ", ".join(command.name for command in COMMANDS)
        parser.error(f"expected one FILE or a command ({names}), got {' '.join(arguments)}")
    parser.add_argument("file", metavar="FILE", nargs="?", help="what to open in the window")
    add_allow_outside(parser)
    parser.add_argument("--version", action="version", version=f"{PROGRAM} {__version__}")
    options = _parse(parser, arguments)
    if options is None:
        return 0

    return run(options.file, options.allow_outside)


def _parse(parser: Parser, arguments: Sequence[str]) -> argparse.Namespace | None:
    """Return the options, or ``None`` if help or version were asked for and have been written."""
    try:
        return parser.parse_args(arguments)
    except SystemExit:
        return None


def _fail(program: str, problem: object, code: int) -> int:
    text = " ".join(str(problem).split()) or type(problem).__name__
    print(f"{program}: {text}", file=sys.stderr)
    return code


def _silence_stdout() -> None:
    """Drop what is still to be written, so that the end of the process does not fail on it again."""
    if isinstance(sys.stdout, io.TextIOWrapper):
        with open(os.devnull, "wb") as nothing:
            os.dup2(nothing.fileno(), sys.stdout.fileno())
