"""A small clone with a toy program in it, for the tests that really start bootstrap.py."""

import importlib.util
import os
import shutil
import subprocess
import sys
import zipfile
from collections.abc import Callable
from pathlib import Path

import pytest

import bootstrap

TOY_PROGRAM = """
import os, sys, toy
print(toy.NAME, os.getcwd(), *sys.argv[1:])
sys.exit(7 if "fail" in sys.argv else 0)
"""
FORGOTTEN = ("PYTHON", "PIP_", "DISPLAY", "WAYLAND_DISPLAY", "QT_QPA_PLATFORM", "CI")

Start = Callable[..., "subprocess.CompletedProcess[str]"]


def make_clone(folder: Path) -> Path:
    """Make a clone: bootstrap.py, its tables, pins of one toy package, and a program that uses it."""
    clone, wheels = folder / "clone", folder / "wheels"
    (clone / "app").mkdir(parents=True)
    wheels.mkdir()
    (clone / "requirements").mkdir()
    for name in ("bootstrap.py", "requirements/debian.txt"):
        shutil.copy(bootstrap.ROOT / name, clone / name)
    (clone / "requirements" / "run.txt").write_text("# one toy\ntoy==1.0\n")
    (clone / "app" / "__main__.py").write_text(TOY_PROGRAM)
    with zipfile.ZipFile(wheels / "toy-1.0-py3-none-any.whl", "w") as wheel:
        wheel.writestr("toy.py", "NAME = 'toy'\n")
        wheel.writestr("toy-1.0.dist-info/METADATA", "Metadata-Version: 2.1\nName: toy\nVersion: 1.0\n")
        wheel.writestr(
            "toy-1.0.dist-info/WHEEL", "Wheel-Version: 1.0\nRoot-Is-Purelib: true\nTag: py3-none-any\n"
        )
        wheel.writestr("toy-1.0.dist-info/RECORD", "")
    return clone


def start(
    clone: Path, *arguments: str, before: str = "", **variables: str
) -> "subprocess.CompletedProcess[str]":
    """Start a clone's bootstrap.py as a user does; `before` is Python to run first in the same process."""
    environment = {key: value for key, value in os.environ.items() if not key.startswith(FORGOTTEN)}
    environment.update(PIP_CONFIG_FILE=os.devnull, PIP_RETRIES="0", **variables)
    script = str(clone / "bootstrap.py")
    command = [sys.executable, script, *arguments]
    if before:
        code = f"import runpy, sys\n{before}\nsys.argv = {[script, *arguments]!r}\n"
        command = [sys.executable, "-c", f"{code}runpy.run_path({script!r}, run_name='__main__')"]
    return subprocess.run(
        command, capture_output=True, text=True, cwd=clone.parent, env=environment, timeout=300
    )


@pytest.fixture
def new_clone(tmp_path: Path) -> Path:
    """Return a clone that was never started."""
    return make_clone(tmp_path)


@pytest.fixture(scope="module")
def used_clone(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """Return a clone that was started once, with what it needs at hand."""
    clone = make_clone(tmp_path_factory.mktemp("used"))
    # With the pip that is here: to install one takes most of the time, and every check of the program does it.
    folder = clone / ".venv"
    subprocess.run([sys.executable, "-m", "venv", "--without-pip", str(folder)], check=True)
    here = importlib.util.find_spec("pip")
    assert here.origin is not None
    packages = next(folder.glob("[Ll]ib*/**/site-packages"))
    (packages / "pip.pth").write_text(str(Path(here.origin).parents[1]))
    first = start(clone, "run", "--version", PIP_NO_INDEX="1", PIP_FIND_LINKS=str(clone.parent / "wheels"))
    assert (first.returncode, first.stderr) == (0, "")
    assert first.stdout == f"toy {clone.parent} --version\n"
    return clone


@pytest.fixture(name="start")
def start_fixture() -> Start:
    """Return the function that starts a clone's bootstrap.py."""
    return start
