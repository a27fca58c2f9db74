"""What a text on screen is about: its terms, for F1 and for the menu that asks what each of them is."""

from collections.abc import Callable
from functools import partial

from PySide6.QtCore import QPoint, Qt
from PySide6.QtGui import QCursor, QGuiApplication
from PySide6.QtWidgets import QLabel, QMenu, QTabBar, QWidget

from lessons.glossary import Term, find_terms

MOST_TERMS = 12
"""Entries of a menu."""


def terms_of(widget: QWidget, point: QPoint | None = None) -> list[Term]:
    """Return the terms of what a widget says; ``point``: where it is pointed at, in the widget."""
    return list(dict.fromkeys(term for text in texts_of(widget, point) for _, _, term in find_terms(text)))


def texts_of(widget: QWidget, point: QPoint | None = None) -> list[str]:
    """Return what a widget says: the tab that is pointed at, its text or choice, its tip, and its name."""
    if isinstance(widget, QTabBar):
        index = widget.tabAt(widget.mapFromGlobal(QCursor.pos()) if point is None else point)
        index = index if index >= 0 else widget.currentIndex()
        return [widget.tabText(index), widget.tabToolTip(index)]
    values = (widget.property(name) for name in ("text", "currentText", "toolTip", "accessibleName"))
    return [value for value in values if isinstance(value, str) and value]


def term_menu(
    widget: QWidget, point: QPoint, show_page: Callable[[str], None], parent: QWidget
) -> QMenu | None:
    """Return the menu of a text: what each of its terms is, and Copy where it can be selected; nothing to ask: None."""
    terms = terms_of(widget, point)[:MOST_TERMS]
    if not terms:
        return None
    menu = QMenu(parent)
    menu.setAttribute(Qt.WidgetAttribute.WA_DeleteOnClose)
    for term in terms:
        menu.addAction(f"What is “{term.name}”?").triggered.connect(partial(show_page, f"term/{term.key}"))
    if (
        isinstance(widget, QLabel)
        and widget.textInteractionFlags() & Qt.TextInteractionFlag.TextSelectableByMouse
    ):
        menu.addSeparator()
        copied = widget.selectedText() or widget.text()
        menu.addAction("Copy").triggered.connect(partial(QGuiApplication.clipboard().setText, copied))
    return menu
