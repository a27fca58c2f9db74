"""What a student holds for covered, and how the grid shows it: nothing of the answer but what was asked for."""

from collections.abc import Collection
from dataclasses import dataclass, replace
from typing import TYPE_CHECKING

import numpy as np

from core.records.arrays import Flags
from widgets.grid.buffer import GridBuffer
from widgets.grid.overlay import Mark, MaskOverlay, Overlay

if TYPE_CHECKING:
    from lessons.exercises.answers.pixels import Pixel, PixelAnswer, Pixels


@dataclass(frozen=True, eq=False)
class Guesses:
    """Pixels that are held for covered, and those that are."""

    clicked: "Pixels"
    """Pixels that were clicked."""
    answer: "PixelAnswer"
    """Which pixels are covered."""
    is_revealed: bool = False
    """Whether the pixels that were not clicked are shown too."""

    def _mask(self, pixels: Collection["Pixel"]) -> Flags:
        columns, rows = self.answer.size
        mask = np.zeros((rows, columns), bool)
        if pixels:
            column, row = np.array(sorted(pixels)).T
            mask[row, column] = True
        return mask

    @property
    def hidden(self) -> Flags | None:
        """(H, W) bool, the pixels that are not judged yet; ``None``: all are."""
        return None if self.is_revealed else ~self._mask(self.clicked)

    def buffer(self, coverage: GridBuffer) -> GridBuffer:
        """Return the coverage buffer with what is judged, and nothing else, in its values."""
        covered, hidden = self._mask(self.answer.reference), self.hidden
        judged = np.ones_like(covered) if hidden is None else ~hidden
        return replace(coverage, kind="bool", range=None, values=covered & judged, known=judged)

    def overlays(self) -> list[Overlay]:
        """Return a mark for each outcome; what is missing shows when the answer is revealed."""
        marks = self.answer.check(self.clicked).marks
        missing = marks["missing"] if self.is_revealed else frozenset()
        return [
            MaskOverlay("right", Mark.RIGHT, self._mask(marks["right"])),
            MaskOverlay("extra", Mark.EXTRA, self._mask(marks["extra"])),
            MaskOverlay("missing", Mark.MISSING, self._mask(missing)),
        ]
