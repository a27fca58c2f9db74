"""How the window looks: its theme, and full screen with large type for presenting."""

from PySide6.QtCore import QObject, Signal, Slot
from PySide6.QtWidgets import QApplication, QWidget

from widgets.basics.style_sheet import apply_theme
from widgets.basics.theme import DARK, LIGHT, PRESENTER, current_theme

THEMES = {"light": LIGHT, "dark": DARK, "presenter": PRESENTER}


def the_application() -> QApplication:
    """Return the application of this process, made at the first call."""
    found = QApplication.instance()
    return found if isinstance(found, QApplication) else QApplication(["rasterscope"])


class Appearance(QObject):
    """Changes the theme, and goes to full screen and back."""

    theme_changed = Signal(str)
    """Name of the theme, of ``THEMES``."""

    def __init__(self, window: QWidget) -> None:
        super().__init__(window)
        self._theme_before = ""

    @Slot(str)
    def set_theme(self, name: str) -> None:
        """Show the window in a theme by its name."""
        apply_theme(the_application(), THEMES[name])
        self.theme_changed.emit(name)

    def toggle_theme(self) -> None:
        """Change between light and dark."""
        self.set_theme("light" if current_theme() == DARK else "dark")

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
            self._theme_before = next(name for name in THEMES if THEMES[name] == current_theme())
            window.showFullScreen()
            self.set_theme("presenter")
