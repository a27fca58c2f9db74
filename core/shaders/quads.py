"""Derivatives: differences between the lanes of a quad, 2 x 2 pixels.

Lanes of a fragment shader that needs them come in whole quads: bottom left, bottom right, top left, top right. Those
outside of the triangle, and discarded ones, are helpers: they run, and nobody sees what they give.
"""

from typing import Any

import numpy as np

from core.lanes.run import Run
from core.shaders.glsl_types import GlslValue


def across(part: Any) -> Any:
    """Return how a component (L,) changes with a pixel to the right: one difference for each row of a quad."""
    if np.ndim(part) == 0:
        return np.zeros_like(part)
    quads = part.reshape(-1, 2, 2)
    return np.repeat(quads[:, :, 1] - quads[:, :, 0], 2, axis=1).reshape(-1)


def up(part: Any) -> Any:
    """Return how a component (L,) changes with a pixel up: one difference for each column of a quad."""
    if np.ndim(part) == 0:
        return np.zeros_like(part)
    quads = part.reshape(-1, 2, 2)
    return np.tile(quads[:, 1, :] - quads[:, 0, :], 2).reshape(-1)


def differences(name: str, value: GlslValue, run: Run) -> GlslValue:
    """Return dFdx, dFdy or fwidth of a value."""
    if run.lanes % 4:
        # One lane without its quad: nothing to compare with.
        return GlslValue(value.of, tuple(np.zeros_like(part) for part in value.parts))
    rule: Any = {"dFdx": across, "dFdy": up, "fwidth": lambda part: np.abs(across(part)) + np.abs(up(part))}[
        name
    ]
    return GlslValue(value.of, tuple(rule(part) for part in value.parts))
