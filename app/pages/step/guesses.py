"""What a student holds for covered, and how the grid shows it: nothing of the answer but what was asked for."""

from dataclasses import dataclass, replace

import numpy as np

from core.records.arrays import Flags
from widgets.grid.buffer import GridBuffer
from widgets.grid.overlay import Mark, MaskOverlay, Overlay


@dataclass(frozen=True, eq=False)
class Guesses:
    """Pixels that are held for covered, and those that are."""

    clicked: Flags
    """(H, W) bool, pixels that were clicked."""
    covered: Flags
    """(H, W) bool, the right answer."""
    is_revealed: bool = False
    """Whether the pixels that were not clicked are shown too."""

    @property
    def hidden(self) -> Flags | None:
        """(H, W) bool, the pixels that are not judged yet; ``None``: all are."""
        return None if self.is_revealed else ~self.clicked

    def buffer(self, coverage: GridBuffer) -> GridBuffer:
        """Return the coverage buffer with what is judged, and nothing else, in its values."""
        judged = np.ones_like(self.clicked) if self.is_revealed else self.clicked
        return replace(coverage, kind="bool", range=None, values=self.covered & judged, known=judged)

    def overlays(self) -> list[Overlay]:
        """Return a mark for each outcome; what is missing shows when the answer is revealed."""
        missing = self.covered & ~self.clicked & self.is_revealed
        return [
            MaskOverlay("right", Mark.RIGHT, self.clicked & self.covered),
            MaskOverlay("extra", Mark.EXTRA, self.clicked & ~self.covered),
            MaskOverlay("missing", Mark.MISSING, missing),
        ]
