"""A pass: another scene with settings of its own, drawn before the picture, which takes what was drawn as an input.

It is a scene like any other: it opens, steps and is saved as one.
"""

from dataclasses import dataclass
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from core.scene import Scene
    from core.settings import Settings

PASS_FAMILIES = ("shadow",)
"""Families of methods that ask for passes; each calls its method without one ``none``."""


@dataclass(frozen=True, eq=False)
class PlannedPass:
    """What is drawn first. ValueError where it needs a pass itself: the first picture would never come."""

    title: str
    """What it shows, as ``What light 0 sees``."""
    scene: "Scene"
    settings: "Settings"

    def __post_init__(self) -> None:
        for family in PASS_FAMILIES:
            if (method := getattr(self.settings, family)) != "none":
                raise ValueError(f"a pass must need no pass itself, got one with {family} {method}")
