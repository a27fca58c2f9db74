"""Shapes and words of a chart as SVG elements."""

from collections.abc import Sequence
from xml.sax.saxutils import escape

TEXT, QUIET, GRID = "#202020", "#606060", "#DCDCDC"
CHARACTER = 0.62
"""Mean width of a character, of the size of the text: on the safe side for the fonts that charts use."""


def text(
    x: float,
    y: float,
    words: str,
    *,
    size: int,
    color: str = TEXT,
    weight: int = 400,
    anchor: str = "start",
) -> str:
    """Return a line of text whose foot is at ``y``."""
    return (
        f'<text x="{x:.1f}" y="{y:.1f}" font-size="{size}" font-weight="{weight}" fill="{color}" '
        f'text-anchor="{anchor}">{escape(words)}</text>'
    )


def text_width(words: str, size: float) -> float:
    """Return about how wide a line of text is, in pixels."""
    return CHARACTER * size * len(words)


def line(x1: float, y1: float, x2: float, y2: float, color: str, width: float) -> str:
    """Return a straight line."""
    return (
        f'<line x1="{x1:.1f}" y1="{y1:.1f}" x2="{x2:.1f}" y2="{y2:.1f}" stroke="{color}" '
        f'stroke-width="{width:g}"/>'
    )


def polyline(
    places: Sequence[tuple[float, float]], color: str, width: float, opacity: float = 1.0, dashes: str = ""
) -> str:
    """Return a line through several places."""
    through = " ".join(f"{x:.1f},{y:.1f}" for x, y in places)
    broken = f' stroke-dasharray="{dashes}"' if dashes else ""
    return (
        f'<polyline points="{through}" fill="none" stroke="{color}" stroke-width="{width:g}" '
        f'stroke-opacity="{opacity:g}"{broken}/>'
    )


def ground(x: float, y: float, width: float, height: float) -> str:
    """Return a patch of the ground, on which words can be read."""
    place = f'x="{x:.1f}" y="{y:.1f}" width="{width:.1f}" height="{height:.1f}"'
    return f'<rect {place} fill="#FFFFFF" fill-opacity="0.8"/>'


def circle(x: float, y: float, radius: float, color: str, *, filled: bool) -> str:
    """Return a mark; one that is not filled shows the ground."""
    inside = color if filled else "#FFFFFF"
    return f'<circle cx="{x:.1f}" cy="{y:.1f}" r="{radius:g}" fill="{inside}" stroke="{color}" stroke-width="1.5"/>'
