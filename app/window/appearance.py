"""The look of the window: light or dark, at a desk or for presenting, and the size of its text."""

from PySide6.QtCore import QObject, Signal, Slot
from PySide6.QtGui import QFontDatabase, QFontInfo
from PySide6.QtWidgets import QApplication, QWidget

from app.files.state_models import TextSize
from widgets.basics.style_sheet import apply_theme
from widgets.basics.theme import (
    DARK,
    LIGHT,
    PRESENTER,
    PRESENTER_DARK,
    Theme,
    current_theme,
    for_screen,
    with_text_size,
)

THEMES = {"light": LIGHT, "dark": DARK, "presenter": PRESENTER, "presenter-dark": PRESENTER_DARK}
DESK_THEMES = ("light", "dark")
"""Those that the menu offers; the others come with the presenter's arrangement."""
TEXT_SIZES: tuple[TextSize, ...] = (100, 110, 125, 150, 175, 200)
"""Sizes of the text in percent of 13 pixels."""


def the_application() -> QApplication:
    """Return the application of this process, made at the first call."""
    found = QApplication.instance()
    return found if isinstance(found, QApplication) else QApplication(["rasterscope"])


def system_text_size() -> TextSize:
    """Return the size of the desktop's text in percent of the program's own: the nearest of `TEXT_SIZES`."""
    system = QFontDatabase.systemFont(QFontDatabase.SystemFont.GeneralFont)
    percent = 100 * QFontInfo(system).pixelSize() / LIGHT.text_px
    return min(TEXT_SIZES, key=lambda size: abs(size - percent))


def sized_theme(name: str, text_size: int) -> Theme:
    """Return a theme by its name, with text of a size in percent; 0: as large as the desktop's."""
    return with_text_size(THEMES[name], text_size or system_text_size())


class Appearance(QObject):
    """Changes the theme of a window and the size of its text; a presenter's type follows the window's height."""

    theme_changed = Signal(str)
    """Name of the theme, of ``THEMES``."""
    text_size_changed = Signal(int)
    """Percent; 0: as large as the desktop's text."""

    def __init__(self, window: QWidget) -> None:
        super().__init__(window)
        self._name = current_theme().name
        self._text_size: TextSize = 100
        self._presented_size: TextSize = 100
        """Percent of the type that a screen needs, while presenting."""

    @property
    def name(self) -> str:
        """Name of the theme, of ``THEMES``."""
        return self._name

    @property
    def text_size(self) -> TextSize:
        """Percent that was chosen; 0: as large as the desktop's text."""
        return self._text_size

    @Slot(str)
    def set_theme(self, name: str) -> None:
        """Show the window in a theme by its name."""
        if self._is_at_desk:
            self._presented_size = 100
        self._name = name
        self._apply()
        self.theme_changed.emit(name)

    @Slot(int)
    def set_text_size(self, percent: TextSize) -> None:
        """Write everything in a size in percent; 0: as large as the desktop's text."""
        self._text_size = percent
        self._apply()
        self.text_size_changed.emit(percent)

    def change_text_size(self, steps: int) -> None:
        """Go so many places up or down the list of sizes; a presenter's type has a size of its own, for this time."""
        before = (self._text_size or system_text_size()) if self._is_at_desk else self._presented_size
        place = TEXT_SIZES.index(before) + steps
        size = TEXT_SIZES[min(max(place, 0), len(TEXT_SIZES) - 1)]
        if self._is_at_desk:
            self.set_text_size(size)
        else:
            self._presented_size = size
            self._apply()

    def grow_text_to(self, percent: TextSize) -> None:
        """Write everything at least as large as another window did; smaller text is for the user alone to choose."""
        if (percent or system_text_size()) > (self._text_size or system_text_size()):
            self.set_text_size(percent)

    def toggle_theme(self) -> None:
        """Change between light and dark; at a desk and presenting each has its own."""
        places = list(THEMES)
        self.set_theme(places[places.index(self._name) ^ 1])

    def follow_height(self) -> None:
        """Give a presenter's type the size that the window's height wants now."""
        if not self._is_at_desk:
            self._apply()

    @property
    def _is_at_desk(self) -> bool:
        return self._name in DESK_THEMES

    def _apply(self) -> None:
        window = (
            self.parent()
        )  # Not an attribute: a window in a cycle would not be deleted when it is released.
        assert isinstance(window, QWidget)
        if self._is_at_desk:
            theme = sized_theme(self._name, self._text_size)
        else:
            theme = with_text_size(for_screen(THEMES[self._name], window.height()), self._presented_size)
        apply_theme(the_application(), theme)
