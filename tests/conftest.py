"""What every test stands on: Qt without a display, reproducible hypothesis runs, and an orderly end."""

import os
import sys
from pathlib import Path

import pytest
from hypothesis import settings

ROOT = Path(__file__).resolve().parent.parent

# Windows that nobody watches; QT_QPA_PLATFORM=xcb (or wayland, cocoa, windows) shows them.
os.environ.setdefault("QT_QPA_PLATFORM", "offscreen")

settings.register_profile("local", deadline=None)
settings.register_profile("ci", deadline=None, derandomize=True, database=None, print_blob=True)
settings.load_profile("ci" if os.environ.get("CI") else "local")


@pytest.fixture(scope="session")
def shared_folder() -> Path:
    """Return the folder of meshes and recorded cases beside the project; skip where there is none."""
    folder = ROOT.parent / "shared"
    if not folder.is_dir():
        pytest.skip("there is no folder of meshes and recorded cases beside the project")
    return folder


@pytest.hookimpl(trylast=True)
def pytest_sessionfinish() -> None:
    """Close what is still open while Python is whole, so that the process ends with its own exit code."""
    if "PySide6.QtWidgets" not in sys.modules:
        return
    from PySide6.QtCore import QThreadPool
    from PySide6.QtWidgets import QApplication

    application = QApplication.instance()
    if not isinstance(application, QApplication):
        return
    # Closed, not deleted: the menus of pyqtgraph are windows too, and deleting those first crashes.
    for window in application.topLevelWidgets():
        window.close()
    QThreadPool.globalInstance().waitForDone(5000)
    application.processEvents()
