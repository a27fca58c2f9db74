"""The samples of magnified pixels: a dot at each place, filled in the colour of the triangle that has it, or hollow."""

from dataclasses import dataclass, field

import numpy as np
from numpy.typing import NDArray
from PySide6.QtCore import QPointF, Qt
from PySide6.QtGui import QColor, QPainter, QPen

from core.records.words import numbered
from widgets.basics.colormaps import id_table
from widgets.grid.view import GridPlacement

LEAST_CELL = 12.0
"""Side of a cell in logical pixels from which one sample is drawn; of n x n samples n times as much."""
LIGHT_RING = 4.0
"""By how much the diameter of a dot's light ring is more than that of what is filled."""
MOST_NAMED = 4
"""Samples that a tooltip names one by one; of more it counts them."""


@dataclass(frozen=True, eq=False)
class SampleDots:
    """S samples in every pixel of a grid of H x W pixels."""

    position: NDArray[np.float64] = field(repr=False)
    """(S, 2) places inside of a pixel, 0 to 1, y up."""
    shown: NDArray[np.integer] = field(repr=False)
    """(S, H, W) number of the triangle that has the sample, -1 for none."""

    def __post_init__(self) -> None:
        if self.position.ndim != 2 or self.position.shape[1] != 2:
            raise ValueError(f"position must be (S, 2), got {self.position.shape}")
        if self.shown.ndim != 3 or len(self.shown) != len(self.position):
            raise ValueError(f"shown must be ({len(self.position)}, H, W), got {self.shown.shape}")

    def text_at(self, column: int, row: int) -> str:
        """Say what the samples of a pixel show: ``Samples 0 and 2 show triangle 3, samples 1 and 3 none``."""
        shown = self.shown[:, row, column]
        parts: list[str] = []
        for triangle in sorted({int(number) for number in shown}, key=lambda number: (number < 0, number)):
            samples = np.flatnonzero(shown == triangle).tolist()
            if len(shown) <= MOST_NAMED:
                subject = numbered("sample", samples)
            else:
                subject = f"{len(samples)} of {len(shown)} samples"
            what = f"triangle {triangle}" if triangle >= 0 else "none"
            verb = "" if parts else " shows" if len(samples) == 1 else " show"
            parts.append(f"{subject}{verb} {what}")
        text = ", ".join(parts)
        return text[0].upper() + text[1:]


def between_samples(placement: GridPlacement, dots: SampleDots) -> tuple[float, float]:
    """Return where a number stands best in a cell: between two rows of dots, near the middle.

    Returns
    -------
    below : float
        How far below the cell's middle, in logical pixels.
    room : float
        Height that is free of dots there, in logical pixels.
    """
    heights = np.unique(dots.position[:, 1])
    middle, gap = (heights[1:] + heights[:-1]) / 2, np.diff(heights)
    chosen = int(np.abs(middle - 0.5).argmin())
    dot = _fill_of(placement, dots) + LIGHT_RING
    return float(0.5 - middle[chosen]) * placement.cell, float(gap[chosen]) * placement.cell - dot


def has_room(placement: GridPlacement, dots: SampleDots) -> bool:
    """Return whether the dots of a pixel stand clearly apart at this zoom."""
    return bool(placement.cell >= LEAST_CELL * len(dots.position) ** 0.5)


def paint_samples(
    painter: QPainter, placement: GridPlacement, dots: SampleDots, cells: tuple[int, int, int, int]
) -> None:
    """Paint the samples of cells (column0, row0, column1, row1), where there is room for them.

    A dot has a dark ring within a light one, so that it is seen on every colour. A sample that nothing has is a small
    dark dot: it differs by its form from one that a dark triangle has.
    """
    column0, row0, column1, row1 = cells
    if not has_room(placement, dots) or column1 <= column0 or row1 <= row0:
        return
    rows, columns = np.mgrid[row0:row1, column0:column1]
    x = placement.left + (columns + dots.position[:, 0, None, None]) * placement.cell
    y = placement.bottom - (rows + dots.position[:, 1, None, None]) * placement.cell
    shown = dots.shown[:, row0:row1, column0:column1]
    fill = _fill_of(placement, dots)
    painter.save()
    painter.setRenderHint(QPainter.RenderHint.Antialiasing)
    is_had = shown >= 0
    _paint_points(painter, x[~is_had], y[~is_had], (("#ffffff", 3.6), ("#000000", 2.0)))
    _paint_points(painter, x[is_had], y[is_had], (("#ffffff", fill + LIGHT_RING), ("#000000", fill + 2.4)))
    colors = id_table()
    for triangle in np.unique(shown[is_had]).tolist():
        color = QColor(*colors[triangle % len(colors)].tolist())
        _paint_points(painter, x[shown == triangle], y[shown == triangle], ((color, fill),))
    painter.restore()


def _fill_of(placement: GridPlacement, dots: SampleDots) -> float:
    """Return the diameter of what is filled of a dot, in logical pixels."""
    return float(min(max(placement.cell / len(dots.position) ** 0.5 * 0.14, 3.0), 9.0))


def _paint_points(
    painter: QPainter,
    x: NDArray[np.float64],
    y: NDArray[np.float64],
    discs: tuple[tuple[str | QColor, float], ...],
) -> None:
    """Paint discs of a colour and diameter each, one over the other, at all places (K,)."""
    points = [QPointF(*place) for place in np.stack((x, y), axis=1).tolist()]
    for color, width in discs:
        painter.setPen(QPen(QColor(color), width, Qt.PenStyle.SolidLine, Qt.PenCapStyle.RoundCap))
        painter.drawPoints(points)
