"""The pane of Help: one page at a time, with the way back, and a field that finds."""

import re
from collections.abc import Callable
from html import escape, unescape
from typing import Any

from PySide6.QtCore import QSize, Qt, QUrl, Signal, Slot
from PySide6.QtGui import QTextDocument
from PySide6.QtWidgets import QLineEdit, QTextBrowser, QWidget

from widgets.basics.accessibility import KeyClaim
from widgets.basics.controls import closing_button, column_layout, flat_button, row_layout
from widgets.basics.theme import current_theme, theme_notifier

SCHEME = "help"
"""Of addresses of pages; those of any other scheme do something."""
HOME = "home"
FIND = "find/"
LINK = re.compile('href="((?!do:action/)[^"]+)"')
"""Of what is found, but for actions: these are done only where they are clicked."""
Body = tuple[str, str]
"""Title and HTML of a page."""


class HelpBrowser(QTextBrowser):
    """Shows pages that a function makes of their addresses."""

    def __init__(self, make: Callable[[str], Body], parent: QWidget | None = None) -> None:
        super().__init__(parent)
        self._make = make
        self.setOpenLinks(False)
        self.setAccessibleName("Help page")
        KeyClaim(
            self, (Qt.Key.Key_Up, Qt.Key.Key_Down, Qt.Key.Key_PageUp, Qt.Key.Key_PageDown, Qt.Key.Key_Return)
        )

    def loadResource(self, kind: int, name: QUrl | str) -> Any:
        """Return the HTML of a page."""
        address = QUrl(name).path(QUrl.ComponentFormattingOption.FullyDecoded)
        if kind != QTextDocument.ResourceType.HtmlResource.value or not address:
            return None
        return self.html_of(address)

    def html_of(self, address: str) -> str:
        """Return the HTML of a page with its title."""
        title, body = self._make(address)
        return f"<html><head><title>{escape(title)}</title></head><body><h1>{escape(title)}</h1>{body}</body></html>"


class HelpView(QWidget):
    """Buttons, search field and page."""

    link_chosen = Signal(str)
    """A link that does something, without its scheme: ``stage/raster``."""
    closed = Signal()

    def __init__(self, make: Callable[[str], Body], parent: QWidget | None = None) -> None:
        super().__init__(parent)
        self.setProperty("role", "panel")
        self.setAttribute(Qt.WidgetAttribute.WA_StyledBackground)
        self.setAccessibleName("Help")
        self.back_button = flat_button("←", "Back", "Back to the page before", self)
        self.forward_button = flat_button("→", "Forward", "Forward again", self)
        self.home_button = flat_button("⌂", "Contents of Help", "Contents: guide, glossary, methods", self)
        self.search = QLineEdit(self)
        self._first = ""
        """Where the first link of what is found leads."""
        self.search.setPlaceholderText("Find in Help")
        self.search.setAccessibleName("Find in Help")
        self.search.setClearButtonEnabled(True)
        self.close_button = closing_button("Help", self)
        self.browser = HelpBrowser(make, self)
        bar = row_layout(spacing=4)
        for button in (self.back_button, self.forward_button, self.home_button):
            button.setMinimumSize(28, 28)
            bar.addWidget(button)
        bar.addWidget(self.search, 1)
        bar.addWidget(self.close_button)
        self.close_button.setMinimumSize(28, 28)
        layout = column_layout(self, 4, margins=(8, 8, 8, 8))
        layout.addLayout(bar)
        layout.addWidget(self.browser, 1)
        self.setMinimumWidth(260)
        self.back_button.clicked.connect(self.browser.backward)
        self.forward_button.clicked.connect(self.browser.forward)
        self.home_button.clicked.connect(self.show_home)
        self.close_button.clicked.connect(self.closed)
        self.browser.anchorClicked.connect(self._follow)
        self.browser.historyChanged.connect(self._show_history)
        self.search.textChanged.connect(self._find)
        self.search.returnPressed.connect(self._open_first)
        theme_notifier().theme_changed.connect(self._follow_theme)
        self._style()
        self._show_history()

    def sizeHint(self) -> QSize:
        """Return a width of some fifty letters a line."""
        return QSize(27 * current_theme().text_px, 600)

    def show_page(self, address: str) -> None:
        """Show a page by its address, as ``term/depth-buffer``."""
        url = QUrl()
        url.setScheme(SCHEME)
        url.setPath(address)
        self.browser.setSource(url)

    @Slot()
    def show_home(self) -> None:
        """Show the contents."""
        self.show_page(HOME)

    def address(self) -> str:
        """Return the address of the page that is shown; that of a search is not kept."""
        return self.browser.source().path(QUrl.ComponentFormattingOption.FullyDecoded)

    @Slot(QUrl)
    def _follow(self, url: QUrl) -> None:
        path = url.path(QUrl.ComponentFormattingOption.FullyDecoded)
        if url.scheme() == SCHEME:
            self.show_page(path)
        else:
            self.link_chosen.emit(path)

    @Slot(str)
    def _find(self, text: str) -> None:
        """Show what is found while one types; the page before comes back with an empty field."""
        if text.strip():
            found = self.browser.html_of(FIND + text.strip())
            links = LINK.search(found)
            self._first = unescape(links[1]) if links else ""
            self.browser.setHtml(found)
        else:
            self.browser.reload()

    @Slot()
    def _open_first(self) -> None:
        """Follow the first link of what is found."""
        if self.search.text().strip() and self._first:
            self._follow(QUrl(self._first))

    @Slot()
    def _show_history(self) -> None:
        self.back_button.setEnabled(self.browser.isBackwardAvailable())
        self.forward_button.setEnabled(self.browser.isForwardAvailable())

    @Slot()
    def _follow_theme(self) -> None:
        self._style()
        self._find(self.search.text())

    def _style(self) -> None:
        theme = current_theme()
        self.browser.document().setDefaultStyleSheet(
            "h1 { font-size: x-large; font-weight: 600; }"
            "h2 { font-size: large; font-weight: 600; margin-top: 12px; }"
            "p, li { line-height: 130%; }"
            f"a {{ color: {theme.vertex_text[0]}; }}"
            "pre { white-space: pre-wrap; }"
        )
