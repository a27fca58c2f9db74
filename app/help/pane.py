"""Help in the window: a pane that is made when it is first asked for, its HTML, its links, and what texts ask."""

from collections.abc import Callable, Iterable, Mapping
from dataclasses import dataclass
from functools import partial
from html import escape
from typing import TYPE_CHECKING

from PySide6.QtCore import QObject, QPoint, Qt, QTimer, Slot
from PySide6.QtGui import QCursor, QGuiApplication
from PySide6.QtWidgets import QApplication, QComboBox, QDockWidget, QLabel, QMenu, QTabBar, QWidget

from app.window.parts import WindowParts
from core.methods import table
from core.settings import FIELDS
from core.stages.declared import STAGES
from lessons.help import Term, find_terms

if TYPE_CHECKING:
    from widgets.help import HelpView


# HTML of the pages of Help: escaped text, links, and words of the glossary as links.


@dataclass(frozen=True)
class HelpPage:
    """One page."""

    title: str
    html: str
    """Its body, without the title."""


def link(address: str, text: str) -> str:
    """Return a link: ``help:`` shows another page, ``do:`` does something in the window."""
    return f'<a href="{escape(address)}">{escape(text)}</a>'


def linked(text: str, seen: set[str] | None = None) -> str:
    """Return plain text as HTML in which terms are links where they come first.

    ``seen``: keys of terms that get no link, with those that got one from now on.
    """
    parts, end, seen = [], 0, set() if seen is None else seen
    for first, last, term in find_terms(text):
        if term.key not in seen:
            seen.add(term.key)
            parts += [escape(text[end:first]), link(f"help:term/{term.key}", text[first:last])]
            end = last
    return "".join([*parts, escape(text[end:])])


def bullets(items: Iterable[str]) -> str:
    """Return pieces of HTML as a list; nothing if there are none."""
    rows = "".join(f"<li>{item}</li>" for item in items)
    return f"<ul>{rows}</ul>" if rows else ""


def facts(rows: Iterable[tuple[str, str]]) -> str:
    """Return names with pieces of HTML, one a paragraph as the pane may be narrow, without those that say nothing."""
    return "".join(f"<p><b>{escape(name)}</b>: {said}</p>" for name, said in rows if said)


def sentence(text: str) -> str:
    """Return words of the methods table as a sentence."""
    return f"{text[:1].upper()}{text[1:]}{'' if text.endswith('.') else '.'}"


# What a text on screen is about: its terms, for F1 and for the menu that asks what each of them is.


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


# Help in the window: a pane at its right side that is made when it is first asked for, and what its links
# do.


class HelpPane(QObject):
    """Shows the pane, and runs its links in the window."""

    def __init__(self, window: WindowParts, body: Callable[[str], tuple[str, str]]) -> None:
        """``body`` returns title and HTML of the page at an address."""
        super().__init__(window)
        self._body = body
        self.dock: QDockWidget | None = None
        self._is_aside = False
        """Whether the pane comes back when presenting ends."""
        page = window.page
        page.card.set_markup(linked)
        # Its menu is the window's, as that of all other texts; it copies too.
        page.sentence.setContextMenuPolicy(Qt.ContextMenuPolicy.NoContextMenu)
        page.card.link_chosen.connect(self._open_link)
        page.variables.meaning_requested.connect(self._explain_variable)
        page.settings_panel.reference_requested.connect(self._explain_setting)

    @property
    def window(self) -> WindowParts:
        """The window; not an attribute, since a window in a cycle would not be deleted when it is released."""
        return self.parent()  # type: ignore[return-value]

    @property
    def view(self) -> "HelpView":
        """What is in the pane."""
        view: HelpView = self._made().widget()  # type: ignore[assignment]
        return view

    def show_page(self, address: str) -> None:
        """Show a page by its address, as ``term/depth-buffer``."""
        is_new = self.dock is None
        self.view.show_page(address)
        self._made().show()
        if is_new:
            # Only a dock that is laid out takes a width.
            QTimer.singleShot(0, self, self._widen)

    def toggle(self) -> None:
        """Show what the widget with the keyboard or under the pointer is about, or else the contents; or close."""
        address = address_of(self.window)
        if self.is_visible() and (not address or self._has_focus()):
            self.close()
            return
        self.show_page(address or "home")
        self.view.search.setFocus(Qt.FocusReason.ShortcutFocusReason)

    def is_visible(self) -> bool:
        """Return whether the pane is shown."""
        return self.dock is not None and self.dock.isVisible()

    def open_menu(self, place: QPoint, widget: QWidget | None) -> bool:
        """Ask what the terms of a widget are, in a menu at a place on the screen; return whether it has any."""
        if widget is None:
            return False
        menu = term_menu(widget, widget.mapFromGlobal(place), self._show_term, self.window)
        if menu is not None:
            menu.popup(place)
        return menu is not None

    def _show_term(self, address: str, is_checked: bool = False) -> None:
        """Show a page that a menu's entry names; Qt says whether it is checked."""
        self.show_page(address)

    @Slot()
    def close(self) -> None:
        """Close the pane; the page has the keyboard again."""
        if self.dock is not None:
            self.dock.hide()
            self.window.pages.current.take_focus()

    def put_aside(self, is_presenting: bool) -> None:
        """Leave the screen to what is presented, and come back after it."""
        if is_presenting:
            self._is_aside = self.is_visible()
            if self._is_aside:
                self.close()
        elif self._is_aside:
            self._made().show()

    def dismiss(self) -> bool:
        """Close the pane if it has the keyboard; return whether it did."""
        if not self._has_focus():
            return False
        self.close()
        return True

    def _has_focus(self) -> bool:
        focus = QApplication.focusWidget()
        return self.is_visible() and focus is not None and self.view.isAncestorOf(focus)

    def _made(self) -> QDockWidget:
        if self.dock is None:
            from widgets.help import HelpView

            view = HelpView(self._body)
            view.link_chosen.connect(self.follow)
            view.closed.connect(self.close)
            self.dock = QDockWidget("Help", self.window)
            self.dock.setObjectName("help")
            self.dock.setFeatures(QDockWidget.DockWidgetFeature.NoDockWidgetFeatures)
            self.dock.setTitleBarWidget(QWidget(self.dock))  # The view has a row of its own for closing.
            self.dock.setWidget(view)
            self.window.addDockWidget(Qt.DockWidgetArea.RightDockWidgetArea, self.dock)
        return self.dock

    @Slot()
    def _widen(self) -> None:
        width = min(self.view.sizeHint().width(), self.window.width() // 3)
        self.window.resizeDocks([self._made()], [width], Qt.Orientation.Horizontal)

    # What is asked for on the page.

    @Slot(str)
    def _open_link(self, link: str) -> None:
        self.show_page(link.partition(":")[2])

    @Slot(str, str)
    def _explain_variable(self, name: str, meaning: str) -> None:
        self.show_page(f"variable/{name}/{meaning}")

    @Slot(str, str)
    def _explain_setting(self, name: str, value: str) -> None:
        is_method = name in table.families
        self.show_page(f"method/{name}/{value}" if is_method else f"family/{FIELDS[name].taken_by}")

    # Links.

    @Slot(str)
    def follow(self, link: str) -> None:
        """Do what a link says, as ``stage/raster``."""
        kind, *names = link.split("/")
        self._links()[kind](*names)

    def _links(self) -> Mapping[str, Callable[..., object]]:
        return {
            "action": self._act,
            "stage": lambda name: self._act(f"stage_{STAGES.index(name)}"),
            "view": self._show_view,
            "scene": self._open_scene,
            "use": self._use,
            "exercise": self._ask,
            "lesson": self._open_lesson,
            "plan": lambda: self.window.pages.show_page("plan"),
            "printed": self.window.show_printed,
            "compare": lambda name: self._show_result("compare", name),
            "stability": lambda name: self._show_result("stability", name),
        }

    def _act(self, name: str) -> None:
        """Run an action of the keys, on its page."""
        entry = next(entry for entry in self.window.overlays.keys.actions if entry.name == name)
        if entry.page:
            self.window.pages.show_page(entry.page)
        self.window.run_action(name)

    def _show_view(self, name: str) -> None:
        self.window.pages.show_page("step")
        self.window.page.show_view(name)

    def _open_scene(self, name: str) -> None:
        self.window.pages.show_page("step")
        self.window.open_path(name)

    def _ask(self, name: str) -> None:
        self.window.pages.show_page("exercises")
        self.window.pages.current.open_named(name)  # type: ignore[attr-defined]

    def _open_lesson(self, name: str) -> None:
        self.window.pages.show_page("step")
        self.window.page.lessons.open(name)

    def _use(self, family: str, method: str) -> None:
        self.window.pages.show_page("step")
        self.window.session.set_setting(family, method)

    def _show_result(self, page: str, name: str) -> None:
        self.window.pages.show_page(page)
        self.window.pages.current.show_named(name)  # type: ignore[attr-defined]


def address_of(window: QWidget) -> str:
    """Return the page of what the widget under the pointer shows, or else the one with the keyboard."""
    pointed = QApplication.widgetAt(QCursor.pos())
    for widget in (pointed, window.focusWidget()):
        if widget is not None and window.isAncestorOf(widget):
            if isinstance(widget, QComboBox) and widget.objectName() in table.families:
                return f"method/{widget.objectName()}/{widget.currentData()}"
            keys = [term.key for term in terms_of(widget)]
            if keys:
                return f"term/{keys[0]}" if len(keys) == 1 else f"here/{','.join(keys)}"
    return ""
