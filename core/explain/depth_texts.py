"""What the numbers in the depth buffer are: unit and description for every depth method, and for rays."""

from collections.abc import Mapping
from typing import NamedTuple


class DepthText(NamedTuple):
    """How a buffer of depths is shown."""

    unit: str
    """Behind every number."""
    description: str
    """One sentence: range, cleared value, and which of two is nearer."""


DEPTH_TEXTS: Mapping[str, DepthText] = {
    "z-float32": DepthText(
        "", "Window depth z as float32, from 0 (near) to 1 (far and cleared): smaller is nearer."
    ),
    "inverse-w": DepthText("", "1/w as float32, in one over scene units, 0 where cleared: larger is nearer."),
    "z-24": DepthText(
        "steps", "Window depth z in steps of 1/16,777,215, all of them where cleared: smaller is nearer."
    ),
    "z-16": DepthText(
        "steps", "Window depth z in steps of 1/65,535, all of them where cleared: smaller is nearer."
    ),
    "fixed-38": DepthText(
        "× 2⁻³⁸", "Window depth z in steps of 2⁻³⁸, 2³⁸ of them where cleared: smaller is nearer."
    ),
    "reversed-z": DepthText(
        "", "Reversed z as float32, from 1 (near) to 0 (far and cleared): larger is nearer."
    ),
    "logarithmic": DepthText(
        "", "Octaves of w from near (0) to far (1 and cleared), as a share, float32: smaller is nearer."
    ),
}
"""Depth method to what its buffer holds."""

NEARNESS = DepthText(
    "",
    "1/w of a perspective scene, else −z/w, where the ray meets the nearest triangle so far: larger is nearer.",
)
"""What rays compare, in float64."""


def depth_text(buffer: str, method: str) -> DepthText | None:
    """Return the text of a buffer of the stage depth under a depth method; ``None``: it holds no depths."""
    if buffer == "nearness":
        return NEARNESS
    return DEPTH_TEXTS.get(method) if buffer == "depth" else None
