"""The import contracts bite: each forbidden import, put into a small copy of the layers, is found."""

import os
import shutil
import subprocess
import sys
from pathlib import Path

import pytest

import bootstrap

STAGES = ("core/fragments", "core/framebuffer", "core/geometry", "core/raster", "core/visibility")
CONTRACTS = dict(bootstrap.checks(bootstrap.ROOT, []))["import contracts"][1:]


def check_layers(folder: Path, package: str, statement: str) -> "subprocess.CompletedProcess[str]":
    shutil.copy(bootstrap.ROOT / "pyproject.toml", folder)
    for name in ("app", "core", "lessons", "widgets", *STAGES):
        (folder / name).mkdir()
        (folder / name / "__init__.py").touch()
    (folder / "core" / "pipeline.py").touch()
    (folder / package / "module.py").write_text(f"{statement}\n")
    environment = {key: value for key, value in os.environ.items() if key != "PYTHONPATH"}
    command = [sys.executable, *CONTRACTS, "--no-cache"]
    return subprocess.run(command, cwd=folder, capture_output=True, text=True, env=environment)


@pytest.mark.parametrize(
    ("package", "statement"),
    [
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
        ("core/geometry", "import core.raster"),
        ("core/raster", "import core.framebuffer"),
    ],
)
def test_forbidden_import_is_found(tmp_path: Path, package: str, statement: str) -> None:
    done = check_layers(tmp_path, package, statement)
    assert done.returncode == 1, done.stdout + done.stderr
    assert "BROKEN" in done.stdout


@pytest.mark.parametrize(
    ("package", "statement"),
    [
        ("core", "import numpy"),
        ("lessons", "import core"),
        ("widgets", "import core, PySide6, pyqtgraph"),
        ("core", "import core.geometry, core.raster, core.fragments"),
        ("app", "import core, lessons, widgets, PySide6, trimesh, PIL"),
    ],
)
def test_allowed_import_is_kept(tmp_path: Path, package: str, statement: str) -> None:
    done = check_layers(tmp_path, package, statement)
    assert done.returncode == 0, done.stdout + done.stderr
