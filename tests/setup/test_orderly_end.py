"""A test run that leaves windows, timers and threads behind still ends with its own exit code."""

import os
import shutil
import subprocess
import sys
from pathlib import Path

import pytest

import bootstrap

UNTIDY_TEST = """
import pyqtgraph
from PySide6.QtCore import QRunnable, QThreadPool, QTimer
from PySide6.QtWidgets import QMainWindow, QWidget

kept = []

class Work(QRunnable):
    def run(self):
        sum(range(1000000))

def test_window_is_left_open(qapp):
    window = QMainWindow()
    plot = pyqtgraph.PlotWidget()
    window.setCentralWidget(plot)
    window.show()
    timer = QTimer(window)
    timer.start(0)
    kept.extend([window, plot, timer, QWidget()])
    QThreadPool.globalInstance().start(Work())
    qapp.processEvents()
    assert EXPECTED
"""


@pytest.mark.slow
@pytest.mark.parametrize(("expected", "code"), [(True, 0), (False, 1)])
def test_exit_code_is_the_outcome(tmp_path: Path, expected: bool, code: int) -> None:
    shutil.copy(bootstrap.ROOT / "pyproject.toml", tmp_path)
    (tmp_path / "tests").mkdir()
    for name in ("conftest.py", "families.py", "patience.py"):
        shutil.copy(bootstrap.ROOT / "tests" / name, tmp_path / "tests")
    (tmp_path / "tests" / "test_untidy.py").write_text(UNTIDY_TEST.replace("EXPECTED", str(expected)))
    command = [sys.executable, "-m", "pytest", "-q", "-p", "no:cacheprovider"]
    environment = {key: value for key, value in os.environ.items() if not key.startswith("PYTEST")}
    done = subprocess.run(command, cwd=tmp_path, capture_output=True, text=True, env=environment)
    assert done.returncode == code, done.stdout + done.stderr
    assert ("1 passed" if expected else "1 failed") in done.stdout
