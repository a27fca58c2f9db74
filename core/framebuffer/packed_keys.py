"""Listings of the depth test on packed keys: depth above, number of the triangle below, and the least key wins."""

from core.framebuffer.fixed_depth import GREATEST, LEAST, SCALE, SLACK

NUMBER_BITS = 24
"""Bits of a key that hold the triangle's number plus one; 0 is the empty buffer."""


def packed_depth_test(
    origin: int, across: int, up: int, column: int, row: int, number: int, old: int
) -> tuple[int, bool]:
    """Listing of the test where depth is an integer plane; ``old`` is the key in the buffer."""
    depth = min(max(origin + column * across + row * up, LEAST), GREATEST)  #: depth
    key = ((depth + SLACK) << NUMBER_BITS) | (number + 1)  #: key
    passes = key < old  #: minimum
    return min(key, old), passes  #: store


def rounded_depth_test(z: float, number: int, old: int, writes: bool = True) -> tuple[int, bool]:
    """Listing of the test where a triangle or line has no such plane: z in [0, 1] is rounded at every pixel."""
    depth = round(z * SCALE)  #: depth
    key = ((depth + SLACK) << NUMBER_BITS) | (number + 1)  #: key
    passes = key < old  #: minimum
    return min(key, old) if writes else old, passes  #: store
