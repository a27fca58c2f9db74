"""The typesetter without work whose result it does not use: importing this changes what it sets rows with.

Measured on 1,200 cells of formulas, that work is three quarters of all; the drawings are the same byte by byte.
"""

from collections.abc import Iterator
from typing import Any
from xml.etree.ElementTree import Element

from ziamath import operators, styles
from ziamath.nodes.mrow import Mrow
from ziamath.nodes.nodetools import elementtext

STRETCHY = frozenset(
    text for (text, _), params in operators.operators.items() if params.get("stretchy", "false") != "false"
)
"""Operators that grow with their row, unless an element says that they do not."""
ROWS = ("mrow", "math", "mtd", "mtr", "none", "merror", "mpadded", "mphantom")
"""Elements that are rows of their own: what grows in them grows with them."""

# A style is parsed for every element and copies that of its parent in depth, only to look five names up in it.
vars(styles)["asdict"] = vars


class QuickRow(Mrow, tag="mrow"):
    """A row that is measured before it is set only where something grows with it.

    To measure it, everything in it is set once more: in rows within rows twice, four times, eight times.
    """

    def _get_height_nostretch(self, line: list[Element], **kwargs: Any) -> tuple[float, float]:
        if any(map(has_stretchy, line)):
            low, high = super()._get_height_nostretch(line, **kwargs)
            return low, high
        return 0.0, 0.0


def has_stretchy(element: Element) -> bool:
    """Return whether an element is, or has in its row, an operator that grows with the row."""
    return any(
        part.attrib.get("stretchy", "true" if elementtext(part) in STRETCHY else "false") != "false"
        for part in _of_the_row(element)
        if part.tag in ("mo", "mi")
    )


def _of_the_row(element: Element) -> Iterator[Element]:
    """Give an element and what is in it, but not what is in a row of its own."""
    yield element
    if element.tag not in ROWS:
        for child in element:
            yield from _of_the_row(child)
