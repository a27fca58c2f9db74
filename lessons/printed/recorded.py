"""Runs of a printed line listing: its pixels, and the sum that decided each as the lines before have left it."""

from collections.abc import Callable
from dataclasses import replace
from typing import Any

import numpy as np

from core.edits.typed import Typed
from core.lanes.limits import LISTING
from core.lanes.masks import Some
from core.lanes.nodes import Statement
from core.lanes.run import Frame
from core.raster.lines.records import STEP_LIMIT
from core.records.arrays import Floats
from core.records.listing import source_listing

_ADVANCED = ("first-sum", "advance", "advance-step", "evaluate")
_LIMITS = replace(LISTING, rounds=STEP_LIMIT + 1)


class _Pixels:
    """Looks on while a listing runs for L lines, and notes what its labelled lines store."""

    def __init__(self, labels: dict[int, str], lanes: int) -> None:
        self._labels = labels
        self._sums = np.full((4, lanes), np.nan)
        """The sum as it is; of the pixel that comes: before it, after it was corrected, and after it was advanced."""
        self.drawn = [np.empty((7, 0))]
        """Of every draw: the lines (P,) that draw, column, row and decision, and the three sums of the pixel."""

    def begin(self, statement: Statement, mask: Some, frame: Frame) -> None:
        """Note nothing."""

    def end(self, statement: Statement, mask: Some, frame: Frame, value: Any) -> None:
        """Note a pixel, or what a sum is now."""
        label = self._labels.get(statement.place.line)
        here = np.arange(self._sums.shape[1]) if mask is None else np.flatnonzero(mask)
        if label == "draw":
            pixel = [np.broadcast_to(number, self._sums.shape[1:])[here] for number in value]
            self.drawn.append(np.array([here, *pixel, *self._sums[1:, here]], float))
            self._sums[1, here], self._sums[2:, here] = self._sums[0, here], np.nan
        elif label == "correct" or label in _ADVANCED:
            new = np.broadcast_to(value, self._sums.shape[1:])[here]
            self._sums[0, here] = self._sums[2 if label == "correct" else 3, here] = new


def recorded(function: Callable[..., Any], ends: np.ndarray, last_pixel: bool) -> Floats:
    """Run a listing for lines with ends (L, 2, 2), in step.

    Returns
    -------
    pixels : (7, P) float64
        Line, column, row and decision of each pixel, line by line; and the sum that decides: before it, after it was
        corrected, and after it was advanced; NaN: it was not.
    """
    shown, columns = source_listing(function), ends.reshape(-1, 4).T
    watch = _Pixels({line: label for label, line in shown.lines.items()}, len(ends))
    program = Typed(function, shown.source).program
    program.run([*map(np.ascontiguousarray, columns), last_pixel], len(ends), limits=_LIMITS, watch=watch)
    pixels = np.concatenate(watch.drawn, axis=1)
    return np.asarray(pixels[:, np.argsort(pixels[0], kind="stable")])
