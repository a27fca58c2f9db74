"""A widget on the screen, as long as its test runs, and what it tells."""

from typing import TypeVar

from PySide6.QtCore import QObject
from PySide6.QtWidgets import QWidget
from pytestqt.qtbot import QtBot

Shown = TypeVar("Shown", bound=QWidget)
Told = list[tuple[object, ...]]
"""Names of signals, each with its arguments, in the order in which they came."""


def shown(qtbot: QtBot, widget: Shown, *size: int) -> Shown:
    """Show a widget, of a size in logical pixels where one is given, and wait until it is there."""
    qtbot.addWidget(widget)
    if size:
        widget.resize(*size)
    widget.show()
    qtbot.waitExposed(widget)
    return widget


def told(widget: QObject, *signals: str) -> Told:
    """Return what a widget tells from now on by these signals."""
    heard: Told = []
    for name in signals:
        getattr(widget, name).connect(lambda *arguments, name=name: heard.append((name, *arguments)))
    return heard
