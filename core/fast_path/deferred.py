"""Deferred colour: attributes and light once for every visible pixel."""

from core.fast_path.draw_context import DrawContext
from core.fast_path.fragment_colors import FragmentColors
from core.framebuffer.nearest import NearestFragments


def shade_visible(context: DrawContext, nearest: NearestFragments) -> int:
    """Write the pixels that something is seen at, and return how many there are; the others keep what they have."""
    colors = FragmentColors(context)
    seen_count = 0
    with context.timed("depth"):
        for place, primitive in nearest.seen():
            seen_count += len(place)
            colors.write(place, primitive)
    return seen_count
