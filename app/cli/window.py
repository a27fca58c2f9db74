"""The window, opened from the command line."""

import os
import sys
from importlib import import_module

BEFORE_QT = ("app.files.open_any", "core.fast_path.workers", "core.trace.tracers", "core.pixel_history")
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
    for module in BEFORE_QT:
        import_module(module)
    load_qt()
    from app.window.start import run_window

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
