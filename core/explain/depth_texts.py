"""What the numbers in the depth buffer are: unit and description for every depth method, and for rays."""

from typing import NamedTuple

from core.methods import table


class DepthText(NamedTuple):
    """How a buffer of depths is shown."""

    unit: str
    """Behind every number."""
    description: str
    """One sentence: range, cleared value, and which of two is nearer."""


NEARNESS = DepthText(
    "",
    "1/w of a perspective scene, else −z/w, where the ray meets the nearest triangle so far: larger is nearer.",
)
"""What rays compare, in float64."""


def depth_text(buffer: str, method: str) -> DepthText | None:
    """Return the text of a buffer of the stage depth under a depth method; ``None``: it holds no depths."""
    if buffer == "nearness":
        return NEARNESS
    if buffer != "depth":
        return None
    kept = table.get("depth", method).function()
    return DepthText(kept.unit, kept.description)
