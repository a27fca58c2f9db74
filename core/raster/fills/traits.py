"""What is known of a fill without running it."""

from collections.abc import Callable
from dataclasses import dataclass
from typing import Any

from core.methods import table
from core.raster.edges.edge_functions import PixelRule, covers
from core.records.listing import TypedText


@dataclass(frozen=True)
class FillTraits:
    """How a fill differs from looking at the pixels of a triangle's box."""

    looks_everywhere: bool = False
    """Whether it tests every pixel of the raster for every triangle."""
    has_lanes: bool = False
    """Whether it sets all rows of a triangle up in one lane, and draws rows of the same length of all triangles."""
    group_label: str = "Row"
    """What a step between a pixel and a triangle is, on a button."""
    rule: PixelRule | None = None
    """What decides on a pixel, where it is not the inside test."""
    test_listing: Callable[..., Any] | TypedText = covers
    """The decision on one pixel."""


def fill_traits(fill: str) -> FillTraits:
    """Return what is known of a method of the family ``fill``."""
    traits: FillTraits | None = table.get("fill", fill).traits
    return traits or FillTraits()
