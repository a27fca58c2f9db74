"""Compare a picture with the reference."""

from dataclasses import dataclass

import numpy as np

from app.bench.records import Bytes
from app.bench.reference import Reference

COLOR_TOLERANCE = 2
"""Steps of 1/255 that a channel may be off: implementations round in different places."""


@dataclass(frozen=True)
class Difference:
    """How a picture differs from the reference."""

    covered: int
    """Pixels that are drawn on one side only."""
    colored: int
    """Other pixels with a channel that is off by more than ``COLOR_TOLERANCE``."""

    @property
    def is_none(self) -> bool:
        """Whether the pictures are the same."""
        return self.covered == self.colored == 0


def compare(pixels: Bytes, is_top_down: bool, reference: Reference) -> Difference:
    """Compare pixels (H, W, 3 or 4) with the reference; what is black is not drawn.

    Raises
    ------
    ValueError
        If the picture has another size.
    """
    colors = (pixels[::-1] if is_top_down else pixels)[..., :3]
    if colors.shape != reference.colors.shape:
        raise ValueError(f"the picture must be {reference.colors.shape}, got {colors.shape}")
    is_off = colors.any(axis=2) != reference.covered
    step = np.abs(colors.astype(np.int16) - reference.colors).max(axis=2)
    return Difference(
        int(np.count_nonzero(is_off)), int(np.count_nonzero((step > COLOR_TOLERANCE) & ~is_off))
    )
