"""Which pixel the stage views are about, and which triangle covers it."""

from dataclasses import dataclass

import numpy as np

from app.session.moment import Moment, Pixel
from core.records.steps import Level
from core.trace import TraceSource


@dataclass(frozen=True)
class PointedPixel:
    """A pixel of the traced raster."""

    column: int
    row: int
    role: str
    """``pin``, ``hover`` or ``step``."""

    @property
    def name(self) -> str:
        """What a person reads."""
        kind = {"pin": "pinned", "hover": "hovered", "step": "current"}[self.role]
        return f"{kind} pixel ({self.column}, {self.row})"


def pointed_pixels(moment: Moment) -> tuple[PointedPixel, ...]:
    """Return the pinned and the hovered pixel; where there is neither, the one of the step just done.

    While the user predicts there are none: what a view tells of a pixel may be the answer.
    """
    if moment.is_predicting:
        return ()
    found: list[PointedPixel] = []
    seen: set[Pixel] = set()
    for role, pixel in (("pin", moment.pin), ("hover", moment.hover)):
        if pixel is not None and pixel not in seen and moment.has_pixel(pixel):
            found.append(PointedPixel(*pixel, role))
            seen.add(pixel)
    if not found and moment.cursor.level >= Level.PIXEL and moment.pixel is not None:
        found.append(PointedPixel(*moment.pixel, "step"))
    return tuple(found)


def shown_triangle(moment: Moment) -> int:
    """Return the triangle that a view of one triangle shows.

    That is the one in focus, else that of the step just done, else the one seen at the pinned pixel, unless
    that is to be predicted, else 0.
    """
    document = moment.document
    if document.triangle is not None:
        return document.triangle
    if moment.triangle >= 0:
        return moment.triangle
    if moment.pin is not None and not moment.is_predicting:
        column, line = moment.place_of(moment.pin)
        seen = int(moment.trace.source.picture.primitive[line, column])
        return max(seen, 0)
    return 0


def fragment_at(
    source: TraceSource, column: int, row: int, preferred: int = -1, is_required: bool = False
) -> int:
    """Return the fragment that counts at a pixel, -1: none.

    Parameters
    ----------
    preferred : int
        A triangle: its fragment is taken if it has one here. Otherwise it is the last one that passed the
        depth test, or else the last one.
    is_required : bool
        Whether only a fragment of the preferred triangle counts.
    """
    fragments = source.fragments
    here = np.flatnonzero((fragments.column == column) & (fragments.row == row))
    if not len(here):
        return -1
    of_preferred = here[source.triangle_of_fragment[here] == preferred]
    if len(of_preferred):
        return int(of_preferred[-1])
    if is_required:
        return -1
    passed = here[source.depth_tests.passes[here]]
    return int(passed[-1]) if len(passed) else int(here[-1])
