"""The appearance of the program as one frozen record: named colours, text sizes and the 4-px rhythm.

One colour means one thing. Vertices, edges and weights 0, 1, 2 are blue, orange and green of the Okabe-Ito
palette in every theme; the accent marks the step just done and nothing else; focus and selection are neutral.
"""

from collections.abc import Iterator
from contextlib import contextmanager
from dataclasses import dataclass, replace
from functools import cache, lru_cache

import numpy as np
from PySide6.QtCore import QObject, Signal
from PySide6.QtGui import QColor, QFont, QFontDatabase, QFontMetricsF
from PySide6.QtWidgets import QApplication

from core.framebuffer.display import linear_light

CLEAR = 3.0
"""Contrast that whatever must be seen has with what is beside it (WCAG 2, 1.4.11)."""
LUMINANCE = np.array([0.2126, 0.7152, 0.0722])
"""Shares of linear red, green and blue in the luminance of a colour (WCAG 2)."""
VERTEX_COLORS = ("#0072B2", "#E69F00", "#009E73")
"""Colours of vertices, edges and barycentric weights 0, 1, 2 (Okabe and Ito), for lines, fills and marks."""


@dataclass(frozen=True)
class Theme:
    """Named colours (``#rrggbb``), text sizes (logical pixels) and spacing of one look."""

    name: str
    is_dark: bool
    window: str
    """Background between panels."""
    panel: str
    """Background of panels, text fields and lists."""
    raised: str
    """Background of buttons and headers."""
    outline: str
    """Border of controls: at least 3:1 against the panel, so that a control can be found."""
    text: str
    muted_text: str
    """Secondary text: units, hints, coordinates."""
    focus: str
    """Keyboard focus ring (neutral: the accent is taken)."""
    selection: str
    """Background of selected rows and text."""
    accent: str
    """The step just done, and nothing else."""
    accent_text: str
    """A shade of the accent that is readable as text."""
    canvas: str
    """Background of a pixel grid around and behind the pixels."""
    empty: str
    """A pixel that holds nothing: false, no primitive."""
    grid_line: str
    covered: str
    rejected: str
    tie: str
    nan_light: str
    """Lighter square of the NaN checker."""
    nan_dark: str
    """Darker square of the NaN checker."""
    infinite: str
    """An infinite value."""
    hidden: str
    """A cell whose value is covered until it has been predicted."""
    good: str
    """Text and marks for what is right; always with a tick or a word."""
    bad: str
    """Text and marks for what is wrong or failed; always with a cross or a word."""
    vertex_text: tuple[str, str, str]
    """Shades of the three vertex colours that are readable as text."""
    vertex: tuple[str, str, str] = VERTEX_COLORS
    """Vertices, edges and weights 0, 1, 2 as lines, fills and marks."""
    edge_casing: str = "#000000"
    """Around coloured edges and vertices: 3:1 against each of the three colours."""
    edge_rim: str = "#ffffff"
    """Around the casing: seen where the cells are as dark as the casing."""
    text_px: int = 13
    """Text of everything."""
    small_px: int = 11
    """Rulers and values in cells."""
    title_px: int = 15
    """Names of pages and panels."""
    code_px: int = 13
    """Listings."""
    formula_scale: float = 1.32
    """Size of formulas relative to the text."""
    formula_shrink: float = 0.85
    """A formula shrinks by this much before it wraps."""
    unit: int = 4
    """The rhythm: every margin and gap is a multiple of it."""

    def __hash__(self) -> int:
        """Return a hash quickly: fonts and layouts are looked up by theme some hundred times a picture."""
        return hash(self.name)

    def halo(self) -> str:
        """Colour that sets thin lines off from any pixel behind them."""
        return "#000000" if self.is_dark else "#ffffff"


LIGHT = Theme(
    name="light",
    is_dark=False,
    window="#eceef0",
    panel="#fafbfb",
    raised="#ffffff",
    outline="#868c92",
    text="#1b1f23",
    muted_text="#5a6269",
    focus="#1b1f23",
    selection="#d3d8dd",
    accent="#d6006c",
    accent_text="#b8005c",
    canvas="#dfe2e5",
    empty="#f4f5f6",
    grid_line="#7d848a",
    covered="#56b4e9",
    rejected="#d55e00",
    tie="#f0e442",
    nan_light="#ffffff",
    nan_dark="#5c5c5c",
    infinite="#000000",
    hidden="#b9bfc5",
    good="#00694c",
    bad="#a84300",
    vertex_text=("#0068a3", "#875c00", "#00734f"),
)
"""Dark text on light grey: the look for daylight."""

DARK = Theme(
    name="dark",
    is_dark=True,
    window="#16181a",
    panel="#202326",
    raised="#2b2f33",
    outline="#757c83",
    text="#e8eaec",
    muted_text="#a5adb4",
    focus="#e8eaec",
    selection="#3d444b",
    accent="#ff4fa0",
    accent_text="#ff6fb1",
    canvas="#121415",
    empty="#2a2d30",
    grid_line="#82898f",
    covered="#56b4e9",
    rejected="#f07b23",
    tie="#f0e442",
    nan_light="#d8d8d8",
    nan_dark="#4a4a4a",
    infinite="#ffffff",
    hidden="#4b525a",
    good="#3ccb9c",
    bad="#ff9455",
    vertex_text=("#4ba9e0", "#f0ac1e", "#2bc495"),
    edge_rim="#c8ccd0",
)
"""Light text on dark grey: the look for a dim room."""

PRESENTER = replace(
    LIGHT,
    name="presenter",
    window="#ffffff",
    panel="#ffffff",
    raised="#ffffff",
    outline="#4a4f54",
    text="#000000",
    muted_text="#2f3439",
    focus="#000000",
    selection="#c3c9cf",
    canvas="#e6e8ea",
    text_px=20,
    small_px=16,
    title_px=26,
    code_px=17,
)
"""High contrast and large type for a projector; `for_screen` has the type that a screen needs."""

PRESENTER_DARK = replace(
    DARK,
    name="presenter-dark",
    window="#000000",
    panel="#0c0d0e",
    raised="#1c1f21",
    outline="#a9afb5",
    text="#ffffff",
    muted_text="#d3d8dc",
    focus="#ffffff",
    canvas="#000000",
    text_px=20,
    small_px=16,
    title_px=26,
    code_px=17,
)
"""The same for a dark room."""

THEMES = (LIGHT, DARK, PRESENTER, PRESENTER_DARK)
"""Every theme, in the order of a menu."""


def with_text_size(theme: Theme, percent: int) -> Theme:
    """Return a theme whose text has so many percent of its usual size."""
    sizes = (theme.text_px, theme.small_px, theme.title_px, theme.code_px)
    text, small, title, code = (round(size * percent / 100) for size in sizes)
    return replace(theme, text_px=text, small_px=small, title_px=title, code_px=code)


class ThemeNotifier(QObject):
    """Tells widgets that paint themselves when the look changes."""

    theme_changed = Signal(object)
    """The new :class:`Theme`."""

    def __init__(self) -> None:
        super().__init__()
        self.theme = LIGHT


@cache
def theme_notifier() -> ThemeNotifier:
    """Return the one notifier; connect its ``theme_changed`` to a bound method."""
    return ThemeNotifier()


def current_theme() -> Theme:
    """Return the theme that widgets paint with now."""
    return theme_notifier().theme


@contextmanager
def paint_as(theme: Theme) -> Iterator[None]:
    """Let widgets that are made and painted meanwhile use ``theme``; those on the screen stay as they are."""
    notifier = theme_notifier()
    before, notifier.theme = notifier.theme, theme
    try:
        yield
    finally:
        notifier.theme = before


TEXT_CAPITALS, CODE_CAPITALS = 0.022, 0.018
"""Least height of a presenter's capitals, of text and of listings, as a part of the screen's height."""


SMALL_PART = 0.9
"""Size of a presenter's numbers on axes and in cells relative to the text."""
FORMULA_SCALE = 1.14
"""Size of a presenter's formulas relative to the text: their capitals are lower."""


def for_screen(theme: Theme, height: int) -> Theme:
    """Return a presenter's theme with type that can be read across a room, on a screen of ``height`` pixels."""
    code = QFontDatabase.systemFont(QFontDatabase.SystemFont.FixedFont)
    text = size_of_capitals(text_font(theme), TEXT_CAPITALS * height)
    return replace(
        theme,
        text_px=text,
        small_px=round(SMALL_PART * text),
        title_px=round(1.25 * text),
        code_px=size_of_capitals(code, CODE_CAPITALS * height),
        formula_scale=FORMULA_SCALE,
        formula_shrink=1.0,
    )


def size_of_capitals(font: QFont, height: float) -> int:
    """Return the least size of a font, in pixels, whose capitals are so many pixels high."""
    sized, size = QFont(font), max(round(height), 1)
    sized.setPixelSize(size)
    while QFontMetricsF(sized).tightBoundingRect("H").height() < height:
        size += 1
        sized.setPixelSize(size)
    return size


def text_font(theme: Theme, pixels: int | None = None) -> QFont:
    """Return the interface font with tabular figures, at ``pixels`` (default: the theme's text size)."""
    font = QFont(QApplication.font())
    font.setPixelSize(pixels or theme.text_px)
    font.setBold(False)
    font.setFeature(QFont.Tag("tnum"), 1)
    return font


def contrast(first: str, second: str) -> float:
    """Return the contrast ratio of two colours as WCAG 2 defines it: 1 (the same) to 21 (black on white)."""
    lighter, darker = sorted((relative_luminance(first), relative_luminance(second)), reverse=True)
    return (lighter + 0.05) / (darker + 0.05)


@lru_cache(maxsize=256)
def relative_luminance(color: str) -> float:
    """Return the luminance of an sRGB colour, 0 (black) to 1 (white)."""
    parsed = QColor(color)
    light = linear_light(np.array([parsed.redF(), parsed.greenF(), parsed.blueF()]))
    return float(light @ LUMINANCE)


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
