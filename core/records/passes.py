"""A pass: another scene with settings of its own, drawn before the picture, which takes what was drawn as an input.

It is a scene like any other: it opens, steps and is saved as one.
"""

from dataclasses import dataclass, replace
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from core.scene import AnyScene
    from core.settings import Settings

ASKS_FOR_PASSES = {
    "shadow": ("map", "map-average"),
    "environment": ("cube",),
    "depth_test_time": ("prepass",),
    "object_culling": ("occlusion",),
}
"""By family, the methods that ask for a pass."""


def without_passes(settings: "Settings") -> "Settings":
    """Return settings that ask for no pass: the defaults in place of the methods that do."""
    asking = [family for family, names in ASKS_FOR_PASSES.items() if getattr(settings, family) in names]
    return replace(settings, **{family: getattr(type(settings), family) for family in asking})


@dataclass(frozen=True, eq=False)
class PlannedPass:
    """What is drawn first. ValueError where it needs a pass itself: the first picture would never come."""

    name: str
    """What it is for: ``shadow-map``, ``environment``, ``prepass`` or ``occluders``."""
    title: str
    """What it shows, as ``What light 0 sees``."""
    scene: "AnyScene"
    settings: "Settings"

    def __post_init__(self) -> None:
        for family, asking in ASKS_FOR_PASSES.items():
            if (method := getattr(self.settings, family)) in asking:
                raise ValueError(f"a pass must need no pass itself, got one with {family} {method}")
