"""Set Rasterscope up and start it, or run the whole check.

    python3 bootstrap.py run [arguments of the program]
    python3 bootstrap.py test [--all] [arguments of pytest]
    python3 bootstrap.py bench [arguments of rasterscope bench]

All make the environment .venv beside this file when it is missing, and install the pinned packages into it.
What is installed is stamped with a hash of the pins, so a second start needs no network. On Linux the loader
finds out which system libraries Qt lacks. Each kind of problem is reported in one sentence and has its own exit
code.
"""

import sys
from enum import IntEnum


class Exit(IntEnum):
    """Exit codes of this script; 0, 1 and 2 are also the program's own."""

    CHECK_FAILED = 1
    USAGE = 2
    OLD_PYTHON = 10
    NO_VENV = 11
    NO_NETWORK = 12
    INSTALL_FAILED = 13
    NO_SYSTEM_LIBRARIES = 14
    NO_DISPLAY = 15
    NOT_WRITABLE = 16
    INTERRUPTED = 130


# An old Python must be able to read this file, so its syntax is that of Python 3.7.
if sys.version_info < (3, 11):
    sys.stderr.write(
        "Rasterscope needs Python 3.11 or newer, and this is Python %d.%d: start it with a newer one, "
        "for example python3.11 bootstrap.py run\n" % (sys.version_info[0], sys.version_info[1])
    )
    sys.exit(Exit.OLD_PYTHON)

import argparse
import hashlib
import importlib
import os
import shutil
import socket
import subprocess
import tempfile
import time
from collections.abc import Callable, Sequence
from pathlib import Path

ROOT = Path(__file__).resolve().parent
SYSTEM: str = sys.platform
UNIX_SOCKETS: int = getattr(socket, "AF_UNIX", 0)  # Windows has none, and is not asked for a display
RUN_PINS = ("requirements/run.txt",)
TEST_PINS = ("requirements/run.txt", "requirements/gpu.txt", "requirements/test.txt")
BENCH_PINS = ("requirements/run.txt", "requirements/gpu.txt", "requirements/bench.txt")
QT_COMMANDS = ("screenshot", "study", "stress", "bench", "lesson")
HEADLESS_COMMANDS = (
    *("render", "trace", "methods", "scenes", "slides", "opengl-check", "plan", "exercise", "diagnose"),
    *QT_COMMANDS,
)
ANSWERING_OPTIONS = ("-h", "--help", "--version")
USAGE = """usage: python3 bootstrap.py run [FILE | arguments of the program]
       python3 bootstrap.py test [--all] [arguments of pytest]
       python3 bootstrap.py bench [--quick] [--workload NAME ...] [--rounds N] [-o DIR]

run    starts Rasterscope (run --help lists what it can do)
test   checks format, lint, types and import contracts and runs the tests in a few minutes;
       with --all every combination, the slow tests and many random examples (half an hour or so)
bench  measures Rasterscope against other libraries, which it installs
"""

# What pip writes when it is the connection that failed, not the package.
NETWORK_SIGNS = (
    *("Retrying (", "ConnectionError", "TimeoutError", "timed out", "Max retries", "NameResolution"),
    *("ProxyError", "SSLError", "Connection broken", "IncompleteRead", "Failed to establish"),
)
# The files of PySide6 whose needs are everybody's needs: its modules, and the plugins that bring a window up.
QT_FILES = (
    *("QtWidgets.*.so", "QtSvg.*.so", "QtTest.*.so", "Qt/plugins/platforms/libqoffscreen.so"),
    *("Qt/plugins/platforms/libqxcb.so", "Qt/plugins/platforms/libqwayland.so"),
    *("Qt/plugins/xcbglintegrations/*.so", "Qt/plugins/wayland-shell-integration/libxdg-shell.so"),
)
FONT_FOLDERS = (
    *("/usr/share/fonts", "/usr/local/share/fonts", "/usr/share/X11/fonts", "~/.fonts"),
    *("~/.local/share/fonts", "/run/current-system/sw/share/X11/fonts"),
)
FONT_SUFFIXES = (".ttf", ".otf", ".ttc", ".pfb", ".pcf.gz")
FONT_PACKAGE = "fonts-dejavu-core"


class SetupError(Exception):
    """What stands in the way: one sentence for the user and the exit code."""

    def __init__(self, code: Exit, sentence: str) -> None:
        super().__init__(sentence)
        self.code = code


def note(text: str) -> None:
    """Tell what is going on, where somebody may be watching: stdout belongs to the program."""
    if sys.stderr.isatty() or os.environ.get("CI"):
        print(text, file=sys.stderr, flush=True)


# --- the environment and its packages ----------------------------------------------------------------------


def venv_python(root: Path) -> Path:
    """Return where the environment's Python is, or will be."""
    return root / ".venv" / ("Scripts/python.exe" if os.name == "nt" else "bin/python")


def is_stamped(root: Path, pins: str) -> bool:
    """Return whether the packages of a pins file were installed, all of them, with these very pins."""
    stamp = stamp_of(root, pins)
    return stamp.is_file() and stamp.read_text() == hashlib.sha256((root / pins).read_bytes()).hexdigest()


def stamp_of(root: Path, pins: str) -> Path:
    """Return the file that says which pins of a pins file were installed."""
    return root / ".venv" / (Path(pins).stem + ".sha256")


def has_environment(root: Path) -> bool:
    """Return whether .venv is there, its Python is new enough and still present, and it has pip."""
    settings, python = root / ".venv" / "pyvenv.cfg", venv_python(root)
    if not (settings.is_file() and python.is_file()):
        return False
    lines = settings.read_text(encoding="utf-8").splitlines()
    values = {key.strip(): value.strip() for key, _, value in (line.partition("=") for line in lines)}
    version = values.get("version_info") or values.get("version", "0.0")
    if [int(part) for part in version.split(".")[:2]] < [3, 11]:
        return False
    # A stamp proves that pip once worked here, so that a second start does not have to ask pip itself.
    if is_stamped(root, RUN_PINS[0]):
        return True
    return subprocess.run([str(python), "-I", "-m", "pip", "--version"], capture_output=True).returncode == 0


def make_environment(root: Path) -> None:
    """Make .venv from nothing; a broken one is replaced."""
    name = "python%d.%d-venv" % sys.version_info[:2]
    no_venv = SetupError(
        Exit.NO_VENV,
        "This Python cannot make environments (it lacks venv or ensurepip): install them, "
        "on Debian and Ubuntu with: %sapt-get install -y %s" % (sudo(), name),
    )
    for module in ("venv", "ensurepip"):
        try:
            importlib.import_module(module)
        except ImportError:
            raise no_venv from None
    folder = root / ".venv"
    note("Making the environment %s" % folder)
    command = [sys.executable, "-I", "-m", "venv", "--clear", str(folder)]
    made = subprocess.run(command, capture_output=True, text=True)
    if made.returncode != 0:
        shutil.rmtree(folder, ignore_errors=True)
        if "ensurepip" in made.stdout + made.stderr:
            raise no_venv
        reason = last_line(made.stderr or made.stdout)
        raise SetupError(Exit.NOT_WRITABLE, "The environment %s could not be made: %s" % (folder, reason))


def run_pip(root: Path, arguments: Sequence[str]) -> tuple[int, str]:
    """Run the environment's pip; return its exit status and all that it wrote."""
    settings = dict(os.environ, PIP_USER="0", PIP_NO_INPUT="1", PIP_DISABLE_PIP_VERSION_CHECK="1")
    options = ("-I", "-m", "pip", "install", "--progress-bar", "off", "--retries", "2")
    command = [str(venv_python(root)), *options, *arguments]
    lines = []
    with subprocess.Popen(
        command,
        env=settings,
        cwd=root,
        stdin=subprocess.DEVNULL,
        stdout=subprocess.PIPE,
        stderr=subprocess.STDOUT,
        encoding="utf-8",
        errors="replace",
    ) as process:
        assert process.stdout is not None
        for line in process.stdout:
            lines.append(line)
            if line.startswith(("Collecting", "Installing collected")):
                note("  " + " ".join(line.split()[:2]))
    return process.returncode, "".join(lines)


def install(root: Path, pins_files: Sequence[str]) -> None:
    """Install what the pins files name, unless the stamps say that it is there already."""
    if all(is_stamped(root, pins) for pins in pins_files):
        return
    note("Installing the packages of %s (once)" % ", ".join(pins_files))
    arguments = [part for pins in pins_files for part in ("-r", pins)]
    # The check imports few of its packages' files, and compiles those: all of them take three times as long.
    arguments += ["--no-compile"] if pins_files == TEST_PINS else []
    status, report = run_pip(root, [*arguments, "--only-binary", ":all:"])
    if status != 0:
        log = root / ".venv" / "install.log"
        log.write_text(report, encoding="utf-8")
        if any(sign in report for sign in NETWORK_SIGNS):
            raise SetupError(
                Exit.NO_NETWORK,
                "The packages could not be downloaded because the package index did not answer: "
                "connect to the network and run the same command again (pip's report is in %s)" % log,
            )
        errors = [line for line in report.splitlines() if line.startswith("ERROR")]
        reason = errors[-1] if errors else last_line(report)
        raise SetupError(
            Exit.INSTALL_FAILED,
            "pip could not install the packages: %s (its report is in %s)" % (reason, log),
        )
    for pins in pins_files:
        digest = hashlib.sha256((root / pins).read_bytes()).hexdigest()
        stamp_of(root, pins).write_text(digest)


def last_line(text: str) -> str:
    """Return the last line that says something."""
    return next((line.strip() for line in reversed(text.splitlines()) if line.strip()), "no reason given")


# --- what Qt needs of a Linux system -----------------------------------------------------------------------


def is_root() -> bool:
    """Return whether this user may install system packages."""
    return sys.platform != "win32" and os.geteuid() == 0


def sudo() -> str:
    """Return the word that a user who is not root must put before a command."""
    return "" if is_root() else "sudo "


def missing_libraries(root: Path) -> list[str]:
    """Ask the loader which shared libraries PySide6 needs and does not find, by the names it asks for."""
    loader = shutil.which("ldd")
    folder = next((root / ".venv").glob("lib*/python3*/site-packages/PySide6"), None)
    if loader is None or folder is None:
        return []
    files = [str(path) for pattern in QT_FILES for path in sorted(folder.glob(pattern))]
    settings = dict(os.environ, LC_ALL="C")
    answer = subprocess.run([loader, *files], capture_output=True, text=True, env=settings)
    return sorted({line.split()[0] for line in answer.stdout.splitlines() if "=> not found" in line})


def has_font() -> bool:
    """Return whether the system has any font: without one Qt draws text as empty boxes."""
    for folder in FONT_FOLDERS:
        for _, _, names in os.walk(os.path.expanduser(folder)):
            if any(name.endswith(FONT_SUFFIXES) for name in names):
                return True
    return False


def packages_for(root: Path, libraries: Sequence[str], font: bool) -> list[str]:
    """Return the Debian packages that hold these libraries, and a font where there is none."""
    lines = (root / "requirements" / "debian.txt").read_text(encoding="utf-8").splitlines()
    table = dict(line.split() for line in lines if line and not line.startswith("#"))
    packages = {table[library] for library in libraries if library in table}
    return sorted(packages | (set() if font else {FONT_PACKAGE}))


def install_command(root: Path, libraries: Sequence[str], font: bool) -> str:
    """Return the one command that installs what is missing, or "" where the package manager is not known."""
    for manager in ("apt-get", "dnf", "zypper"):
        if shutil.which(manager):
            names = packages_for(root, libraries, font)
            if manager != "apt-get":  # these two find a package by the library's own name
                names = ["'%s()(64bit)'" % library for library in libraries]
                names += [] if font else ["dejavu-sans-fonts"]
            return "%s%s install -y %s" % (sudo(), manager, " ".join(names)) if names else ""
    return ""


def apt_install(packages: Sequence[str]) -> str:
    """Install Debian packages as root; return why that failed, "" if it did not."""
    settings = dict(os.environ, DEBIAN_FRONTEND="noninteractive", LC_ALL="C.UTF-8")
    install = ["apt-get", "install", "-y", "--no-install-recommends", *packages]
    reason = ""
    for command in (install, ["apt-get", "update"], install):
        done = subprocess.run(command, env=settings, stdin=subprocess.DEVNULL, capture_output=True, text=True)
        if done.returncode == 0 and command is install:
            return ""
        reason = last_line(done.stderr)
    return reason


def provide_libraries(root: Path, needed: bool) -> None:
    """Install what Qt lacks where that is allowed; where it is needed, refuse to go on without it."""
    libraries, font = missing_libraries(root), has_font()
    if not libraries and font:
        return
    command, reason = install_command(root, libraries, font), ""
    packages = packages_for(root, libraries, font)
    if packages and shutil.which("apt-get") and is_root():
        note("Installing what Qt needs of the system: %s" % " ".join(packages))
        reason = apt_install(packages)
        libraries, font = missing_libraries(root), has_font()
    if libraries and needed:
        advice = "install them with: %s" % command if command else "install the packages that hold them"
        because = " (apt-get: %s)" % reason if reason else ""
        raise SetupError(
            Exit.NO_SYSTEM_LIBRARIES,
            "Qt lacks system libraries (%s)%s: %s" % (", ".join(libraries), because, advice),
        )
    if not font and needed:
        advice = command or "install any font"
        print("No font was found, so text may show as empty boxes: %s" % advice, file=sys.stderr)


# --- the display -------------------------------------------------------------------------------------------


def needs_window(arguments: Sequence[str]) -> bool:
    """Return whether the program, started with these arguments, opens a window on a display."""
    return not (set(arguments[:1]) & set(HEADLESS_COMMANDS) or set(arguments) & set(ANSWERING_OPTIONS))


def answers(family: int, address: str | tuple[str, int]) -> bool:
    """Return whether somebody listens at a Unix socket's path or at a host and port."""
    with socket.socket(family) as probe:
        probe.settimeout(2.0)
        try:
            probe.connect(address)
        except (OSError, ValueError):
            return False
    return True


def has_display(environment: dict[str, str]) -> bool:
    """Return whether the X or Wayland display that these variables name is really there."""
    wayland = os.path.join(environment.get("XDG_RUNTIME_DIR", ""), environment.get("WAYLAND_DISPLAY", ""))
    if environment.get("WAYLAND_DISPLAY") and answers(UNIX_SOCKETS, wayland):
        return True
    host, _, screen = environment.get("DISPLAY", "").rpartition(":")
    number = screen.partition(".")[0]
    if not number.isdigit():
        return False
    if host not in ("", "unix"):
        return answers(socket.AF_INET, (host, 6000 + int(number)))
    path = "/tmp/.X11-unix/X" + number
    return answers(UNIX_SOCKETS, path) or answers(UNIX_SOCKETS, "\0" + path)


def require_display(environment: dict[str, str]) -> None:
    """Refuse to open a window where there is no display, and say what can be done instead."""
    platform = environment.get("QT_QPA_PLATFORM", "").partition(":")[0].partition(";")[0]
    if SYSTEM in ("win32", "darwin") or platform not in ("", "xcb", "wayland"):
        return
    if has_display(environment):
        return
    name = environment.get("WAYLAND_DISPLAY") or environment.get("DISPLAY")
    found = "The display %s does not answer" % name if name else "There is no display to open a window on"
    raise SetupError(
        Exit.NO_DISPLAY,
        found + "; to render to a file instead: python3 bootstrap.py run render FILE -o out.png",
    )


# --- the commands ------------------------------------------------------------------------------------------


def prepare(root: Path, pins_files: Sequence[str], needs_qt: bool) -> None:
    """Bring the environment, its packages and the system's libraries to where the program can start."""
    if not has_environment(root):
        make_environment(root)
    install(root, pins_files)
    if SYSTEM == "linux":
        provide_libraries(root, needs_qt)


def clean_environment(root: Path) -> dict[str, str]:
    """Return the environment variables with the project, and nothing else, on Python's path."""
    environment = {key: value for key, value in os.environ.items() if key != "PYTHONHOME"}
    return dict(environment, PYTHONPATH=str(root))


def run(root: Path, arguments: Sequence[str]) -> int:
    """Start the program with these arguments, in the user's folder."""
    window = needs_window(arguments)
    if window:
        require_display(dict(os.environ))
    prepare(root, RUN_PINS, needs_qt=window or bool(set(arguments[:1]) & set(QT_COMMANDS)))
    return start_program(root, arguments)


def make_output_folder(arguments: Sequence[str]) -> None:
    """Make the folder that ``bench -o`` names, or refuse, before anything is installed for it."""
    parser = argparse.ArgumentParser(prog="bootstrap.py bench", add_help=False, allow_abbrev=False)
    parser.add_argument("-o", "--output")
    folder = parser.parse_known_args(arguments)[0].output
    if folder is None or set(arguments) & set(ANSWERING_OPTIONS):
        return
    try:
        os.makedirs(folder, exist_ok=True)
    except OSError as error:
        raise SetupError(Exit.USAGE, "The folder %s cannot be made: %s" % (folder, error.strerror)) from error


def bench(root: Path, arguments: Sequence[str]) -> int:
    """Run the program's command bench with the libraries that it compares with."""
    make_output_folder(arguments)
    prepare(root, BENCH_PINS, needs_qt=True)
    return start_program(root, ["bench", *arguments])


def start_program(root: Path, arguments: Sequence[str]) -> int:
    """Start the program with these arguments; on POSIX it takes this process over."""
    environment = clean_environment(root)
    # -P: a folder named app or core where the user stands must not be taken for ours.
    command = [str(venv_python(root)), "-P", "-m", "app", *arguments]
    if os.name == "nt":
        return subprocess.call(command, env=environment)
    sys.stdout.flush()
    os.execve(command[0], command, environment)


def checks(root: Path, arguments: Sequence[str]) -> list[tuple[str, list[str]]]:
    """Return the parts of the whole check, each a name and a command."""
    python = str(venv_python(root))
    contracts = "from importlinter.cli import lint_imports_command; lint_imports_command()"
    # Without searching for garbage mypy takes a quarter less time: it keeps nearly all that it makes. Beside the tests
    # it gives way, and works while they wait for something.
    types = "import gc, os; gc.disable(); gc.enable = gc.disable; getattr(os, 'nice', abs)(10); "
    types += "from mypy.__main__ import console_entry as run; run()"
    workers = str(min(4, os.cpu_count() or 1))
    return [
        ("format", [python, "-m", "ruff", "format", "--check", "."]),
        ("lint", [python, "-m", "ruff", "check", "."]),
        ("import contracts", [python, "-c", contracts, "--no-logo"]),
        ("tests", [python, "-m", "pytest", "-q", "-n", workers, "--dist", "worksteal", *arguments]),
        ("types", [python, "-c", types, "--strict", "bootstrap.py", "core", "widgets", "lessons", "app"]),
    ]


def test(root: Path, arguments: Sequence[str]) -> int:
    """Run every part of the check and say which failed.

    The types are checked beside the rest: mypy keeps one core busy for as long as half of the tests do.
    """
    prepare(root, TEST_PINS, needs_qt=True)
    environment = clean_environment(root)
    # Compiled once, not again by each of the hundred programs that the tests start.
    environment.pop("PYTHONDONTWRITEBYTECODE", None)
    *parts, (beside, command) = checks(root, arguments)
    failed = []
    with tempfile.TemporaryFile() as report:
        process = subprocess.Popen(
            command, cwd=root, env=environment, stdin=subprocess.DEVNULL, stdout=report, stderr=report
        )
        try:
            for name, part in parts:
                print("--- %s" % name, flush=True)
                start = time.monotonic()
                status = subprocess.call(part, cwd=root, env=environment, stdin=subprocess.DEVNULL)
                outcome = "failed" if status else "passed"
                print("--- %s %s in %.1f s" % (name, outcome, time.monotonic() - start), flush=True)
                failed += [name] if status else []
            print("--- %s" % beside, flush=True)
            status = process.wait()
        finally:
            process.kill()
        report.seek(0)
        print(report.read().decode("utf-8", "replace"), end="")
        print("--- %s %s" % (beside, "failed" if status else "passed"), flush=True)
        failed += [beside] if status else []
    if failed:
        print("The check failed: %s" % ", ".join(failed), file=sys.stderr)
        return Exit.CHECK_FAILED
    print("The check passed.")
    return 0


COMMANDS: dict[str, Callable[[Path, Sequence[str]], int]] = {"run": run, "test": test, "bench": bench}


def main(arguments: Sequence[str], root: Path = ROOT) -> int:
    """Do what the command line asks; return the exit code."""
    if not arguments or arguments[0] not in COMMANDS:
        is_question = bool(arguments) and arguments[0] in ANSWERING_OPTIONS
        print(USAGE, end="", file=sys.stdout if is_question else sys.stderr)
        return 0 if is_question else Exit.USAGE
    try:
        return COMMANDS[arguments[0]](root, arguments[1:])
    except SetupError as error:
        print(error, file=sys.stderr)
        return error.code
    except OSError as error:
        print("The set-up stopped: %s" % error, file=sys.stderr)
        return Exit.NOT_WRITABLE
    except KeyboardInterrupt:
        return Exit.INTERRUPTED


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
