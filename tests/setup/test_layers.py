"""The import contracts bite: each forbidden import, put into a small copy of the layers, is found."""

import os
import shutil
import subprocess
import sys
from pathlib import Path

import bootstrap

CORE = tuple(
    path.parent.relative_to(bootstrap.ROOT).as_posix() for path in bootstrap.ROOT.glob("core/*/__init__.py")
)
APP = (
    *("cli", "bench", "opengl_check", "window", "help", "pages", "export", "views", "files"),
    *("session", "background"),
)
CONTRACTS = dict(bootstrap.checks(bootstrap.ROOT, []))["import contracts"][1:]


FORBIDDEN = [
    ("core", "import widgets"),
    ("core", "import lessons"),
    ("core", "import app"),
    ("core", "import PySide6.QtCore"),
    ("core", "import pyqtgraph"),
    ("core", "import trimesh"),
    ("core", "from PIL import Image"),
    ("lessons", "import widgets"),
    ("lessons", "import app"),
    ("lessons", "from PySide6 import QtCore"),
    ("widgets", "import lessons"),
    ("widgets", "from app import module"),
    ("widgets", "import trimesh"),
    ("widgets", "from core.pipeline import render"),
    ("widgets", "from core.trace import case"),
    ("widgets", "from core.coverage import case"),
    ("app/session", "import app.files"),
    ("app/views", "import app.pages"),
    ("app/pages", "import app.window"),
    ("app/window", "import app.cli"),
]
ALLOWED = [
    ("core", "import numpy"),
    ("lessons", "import core"),
    ("widgets", "import core, PySide6, pyqtgraph"),
    ("core", "import core.coverage, core.depth, core.lines"),
    ("core/explain", "import numpy, core.coverage"),
    ("widgets", "import core.explain, core.records, core.framebuffer"),
    ("app", "import core, lessons, widgets, PySide6, trimesh, PIL"),
    ("app/pages", "import app.export, app.views, app.session"),
]


def check_layers(folder: Path, statements: list[tuple[str, str]]) -> "subprocess.CompletedProcess[str]":
    """Check a copy of the layers in which each statement stands in a module of its own."""
    shutil.copy(bootstrap.ROOT / "pyproject.toml", folder)
    for name in ("app", "core", "lessons", "widgets", *CORE, *(f"app/{name}" for name in APP)):
        (folder / name).mkdir()
        (folder / name / "__init__.py").touch()
    for name in ("core/pipeline.py", "app/module.py", "app/__main__.py", "app/usage.py"):
        (folder / name).touch()
    for number, (package, statement) in enumerate(statements):
        (folder / package / f"case_{number}.py").write_text(f"{statement}\n")
    environment = {key: value for key, value in os.environ.items() if key != "PYTHONPATH"}
    command = [sys.executable, *CONTRACTS, "--no-cache"]
    return subprocess.run(command, cwd=folder, capture_output=True, text=True, env=environment)


def test_forbidden_imports_are_found(tmp_path: Path) -> None:
    done = check_layers(tmp_path, FORBIDDEN)
    assert done.returncode == 1, done.stdout + done.stderr
    missed = [
        (package, statement)
        for number, (package, statement) in enumerate(FORBIDDEN)
        if f"{package.replace('/', '.')}.case_{number} -> " not in done.stdout
    ]
    assert missed == [], done.stdout


def test_allowed_imports_are_kept(tmp_path: Path) -> None:
    done = check_layers(tmp_path, ALLOWED)
    assert done.returncode == 0, done.stdout + done.stderr
