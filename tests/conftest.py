"""What every test stands on: Qt without a display, one font, reproducible examples, and an orderly end."""

import contextlib
import gc
import importlib.util
import locale
import os
import random
import sys
import tempfile
from pathlib import Path

import pytest
from hypothesis import HealthCheck, settings
from hypothesis.internal.conjecture import providers
from pytestqt.qtbot import QtBot

from tests.families import in_families
from tests.patience import PatientBot

# Rewriting the assertions of hundreds of files makes millions of objects: until the tests are collected nothing
# searches for garbage, which took a third of the time.
gc.disable()

ROOT = Path(__file__).resolve().parent.parent
FONTS_CONF = """<?xml version="1.0"?><!DOCTYPE fontconfig SYSTEM "fonts.dtd">
<fontconfig><dir>{fonts}</dir><cachedir>{cache}</cachedir></fontconfig>
"""

# Windows that nobody watches; QT_QPA_PLATFORM=xcb (or wayland, cocoa, windows) shows them.
os.environ.setdefault("QT_QPA_PLATFORM", "offscreen")

try:
    locale.setlocale(locale.LC_CTYPE, "")
except locale.Error:  # It is not on this machine: Qt would say so in every program that is started.
    os.environ["LC_ALL"] = "C.UTF-8"

if "PYTEST_XDIST_WORKER" not in os.environ:  # a worker has it from the process that starts it
    # The only font of the tests, and of the programs that they start, is the one that ziafont brings along.
    font_folder = tempfile.TemporaryDirectory(prefix="rasterscope-fonts-")
    ziafont = importlib.util.find_spec("ziafont")
    assert ziafont is not None
    assert ziafont.origin is not None
    fonts_conf = Path(font_folder.name, "fonts.conf")
    fonts_conf.write_text(
        FONTS_CONF.format(fonts=Path(ziafont.origin).with_name("fonts"), cache=font_folder.name)
    )
    os.environ["FONTCONFIG_FILE"] = str(fonts_conf)
    # Nor does a test see or change what the user of this machine has set.
    os.environ["RASTERSCOPE_CONFIG"] = str(Path(font_folder.name, "config"))

# Every day the same few examples; with --all many, from a seed that is printed. None is remembered: a
# counterexample is pinned by name in its test. No example fails for the time it takes, on a busy machine above all.
PATIENT = settings(deadline=None, database=None, suppress_health_check=[HealthCheck.too_slow])
settings.register_profile("everyday", PATIENT, max_examples=12, derandomize=True)
settings.register_profile("all", PATIENT, max_examples=300, print_blob=True)


def pytest_addoption(parser: pytest.Parser) -> None:
    """Add --all."""
    parser.addoption(
        "--all", action="store_true", help="every combination, slow tests too, and many random examples"
    )


@pytest.hookimpl(tryfirst=True)
def pytest_configure(config: pytest.Config) -> None:
    """Choose how many examples are drawn, before a test file is imported that asks."""
    settings.load_profile("all" if config.getoption("--all") else "everyday")
    if not config.getoption("--all"):
        # Hypothesis also draws numbers that stand in the modules imported by then: in another order of the tests
        # it would draw other examples.
        providers._get_local_constants = lambda: providers._local_constants
    if config.getoption("--all") and config.getoption("--hypothesis-seed") is None:
        config.option.hypothesis_seed = str(random.SystemRandom().getrandbits(32))


def pytest_collection(session: pytest.Session) -> None:
    """Import all tests from the end in the second worker: what one has compiled by then, the other need not."""
    folders = [Path(argument).resolve() for argument in session.config.args]
    if os.environ.get("PYTEST_XDIST_WORKER") == "gw1" and folders == [ROOT / "tests"]:
        for path in sorted(ROOT.glob("tests/**/test_*.py"), reverse=True):
            with contextlib.suppress(Exception):  # which is told when the file is collected
                importlib.import_module(".".join(path.relative_to(ROOT).with_suffix("").parts))


@pytest.hookimpl(trylast=True)
def pytest_collection_modifyitems(config: pytest.Config, items: list[pytest.Item]) -> None:
    """Leave slow tests to --all, and else run cases together where several processes share the tests."""
    if not config.getoption("--all"):
        slow = [item for item in items if item.get_closest_marker("slow")]
        config.hook.pytest_deselected(items=slow)
        items[:] = [item for item in items if not item.get_closest_marker("slow")]
        if "PYTEST_XDIST_WORKER" in os.environ:
            items[:] = in_families(items)


def pytest_collection_finish() -> None:
    """Keep what is imported by now out of every later search for garbage: it lives to the end."""
    gc.enable()
    gc.collect()
    gc.freeze()
    # Tests make many short-lived objects, few of them in rings: to search less often saves a twentieth of the time.
    gc.set_threshold(10_000, 10, 10)


def pytest_terminal_summary(config: pytest.Config) -> None:
    """Say how random examples can be drawn again."""
    if config.getoption("--all"):
        seed = config.getoption("--hypothesis-seed")
        print(f"\nDraw these random examples again with: --all --hypothesis-seed={seed}")


@pytest.fixture
def qtbot(qapp: object, request: pytest.FixtureRequest) -> QtBot:
    """Return pytest-qt's robot, with more patience."""
    return PatientBot(request)


@pytest.fixture(scope="session")
def shared_folder() -> Path:
    """Return the folder of meshes and recorded cases beside the project; skip where there is none."""
    folder = ROOT.parent / "shared"
    if not folder.is_dir():
        pytest.skip("there is no folder of meshes and recorded cases beside the project")
    return folder


@pytest.hookimpl(trylast=True)
def pytest_runtest_teardown() -> None:
    """Release the mouse button that a double click of QTest leaves pressed: arrows do something else with it."""
    if "PySide6.QtTest" not in sys.modules:
        return
    from PySide6.QtCore import Qt
    from PySide6.QtTest import QTest
    from PySide6.QtWidgets import QApplication, QWidget

    for button in Qt.MouseButton:
        if button in QApplication.mouseButtons():
            QTest.mouseRelease(QWidget(), button)


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
