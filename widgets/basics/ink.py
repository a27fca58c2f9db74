"""Names of colours in drawings: a field of the theme, ``vertex 0`` to ``vertex 2``, or ``#rrggbb``."""

from PySide6.QtGui import QColor

from widgets.basics.theme import Theme, current_theme


def ink_color(ink: str, theme: Theme | None = None) -> str:
    """Return the colour ``#rrggbb`` of an ink for lines and fills."""
    theme = theme or current_theme()
    if ink.startswith("#"):
        return ink
    if ink.startswith("vertex "):
        return theme.vertex[int(ink[7:])]
    return str(getattr(theme, ink))


def ink_text_color(ink: str, theme: Theme | None = None) -> str:
    """Return the shade of an ink that is readable as text."""
    theme = theme or current_theme()
    if ink.startswith("vertex "):
        return theme.vertex_text[int(ink[7:])]
    return theme.accent_text if ink == "accent" else ink_color(ink, theme)


def faded(color: str, opacity: float) -> QColor:
    """Return a colour ``#rrggbb`` with an opacity from 0 to 1."""
    result = QColor(color)
    result.setAlphaF(opacity)
    return result
