"""How the window looks: its theme, and full screen with large type for presenting."""

from PySide6.QtCore import QObject, Signal, Slot
from PySide6.QtGui import QFontDatabase, QFontInfo
from PySide6.QtWidgets import QApplication, QWidget

from widgets.basics.style_sheet import apply_theme
from widgets.basics.theme import DARK, LIGHT, PRESENTER, Theme, current_theme, with_text_size

THEMES = {"light": LIGHT, "dark": DARK, "presenter": PRESENTER}
TEXT_SIZES = (100, 110, 125, 150, 175, 200)
"""Sizes of the text in percent of 13 pixels."""


def the_application() -> QApplication:
    """Return the application of this process, made at the first call."""
    found = QApplication.instance()
    return found if isinstance(found, QApplication) else QApplication(["rasterscope"])


def system_text_size() -> int:
    """Return the size of the desktop's text in percent of the program's own: the nearest of `TEXT_SIZES`."""
    system = QFontDatabase.systemFont(QFontDatabase.SystemFont.GeneralFont)
    percent = 100 * QFontInfo(system).pixelSize() / LIGHT.text_px
    return min(TEXT_SIZES, key=lambda size: abs(size - percent))


def sized_theme(name: str, text_size: int) -> Theme:
    """Return a theme by its name, with text of a size in percent; 0: as large as the desktop's.

    That of the presenter has its own size, for a projector.
    """
    theme = THEMES[name]
    return theme if name == "presenter" else with_text_size(theme, text_size or system_text_size())


class Appearance(QObject):
    """Changes the theme and the size of the text, and goes to full screen and back."""

    theme_changed = Signal(str)
    """Name of the theme, of ``THEMES``."""
    text_size_changed = Signal(int)
    """Percent, of ``TEXT_SIZES``; 0: as large as the desktop's text."""

    def __init__(self, window: QWidget) -> None:
        super().__init__(window)
        self._theme_before = ""
        self._text_size = 100
        """Percent that was chosen; 0: as large as the desktop's text."""

    @Slot(str)
    def set_theme(self, name: str) -> None:
        """Show the window in a theme by its name."""
        apply_theme(the_application(), sized_theme(name, self._text_size))
        self.theme_changed.emit(name)

    @Slot(int)
    def set_text_size(self, percent: int) -> None:
        """Write everything in a size in percent; 0: as large as the desktop's text."""
        self._text_size = percent
        apply_theme(the_application(), sized_theme(current_theme().name, percent))
        self.text_size_changed.emit(percent)

    def change_text_size(self, steps: int) -> None:
        """Go so many places up or down the list of sizes."""
        place = TEXT_SIZES.index(self._text_size or system_text_size()) + steps
        self.set_text_size(TEXT_SIZES[min(max(place, 0), len(TEXT_SIZES) - 1)])

    def toggle_theme(self) -> None:
        """Change between light and dark."""
        self.set_theme("light" if current_theme().is_dark else "dark")

    def toggle_presenter(self) -> None:
        """Fill the screen with large type, or go back to the window."""
        window = (
            self.parent()
        )  # Not an attribute: a window in a cycle would not be deleted when it is released.
        assert isinstance(window, QWidget)
        if window.isFullScreen():
            window.showNormal()
            self.set_theme(self._theme_before or "light")
        else:
            self._theme_before = current_theme().name
            window.showFullScreen()
            self.set_theme("presenter")
