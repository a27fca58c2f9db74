"""Depth: what is stored for a fragment, the test in drawing order, layer by layer, and the nearest found in batches.

A layer has at most one fragment of a pixel: the first of every pixel, the second, and so on. So it can be tested and
blended as one array, and the result is that of drawing the fragments one by one.

References
----------
M. Zwicker, *Computergrafik*, lecture "Z-buffering" (1/w, larger is nearer), Bern 2016.
F. Pellacini, *Computer Graphics*, "which z distance"; LMU 2020, "Frame and depth buffers".
E. Catmull, *A subdivision algorithm for computer display of curved surfaces*, 1974.

Notes
-----
The key is (nearness << bits) | (primitive + 1), so that the least key of a pixel is its nearest fragment, and of
equally near ones the one drawn first: exactly what testing them one by one keeps. With the depth test off it is
(later primitives first << bits) | nearness. ``numpy.minimum.at`` takes about 2 ns a fragment.
"""

from collections.abc import Callable, Iterator
from dataclasses import dataclass
from functools import cache
from typing import Any, ClassVar, Literal

import numpy as np
from numpy.typing import NDArray

from core.methods import method
from core.numeric.large_arrays import largest_first, radix_order
from core.records.arrays import Flags, Floats, Integers, Singles
from core.records.listing import TypedText

# Fragments stacked on their pixels: what has to be done in drawing order is done one layer after another.


@dataclass(frozen=True, eq=False)
class PixelStacks:
    """F fragments on the U pixels that they fall on."""

    fragment: Integers
    """(F,) int64, index of the fragments, pixel by pixel, in drawing order on each."""
    pixel: Integers
    """(U,) int64, the pixels; those with most fragments first."""
    bottom: Integers
    """(U,) int64, place in ``fragment`` of the first fragment of each pixel."""
    higher: list[int]
    """Element k: how many pixels have more than k fragments."""

    def layers(self) -> Iterator[tuple[int, Integers]]:
        """Yield from the bottom up: n, and for the first n pixels their fragment (n,) in this layer."""
        for layer, count in enumerate(self.higher):
            yield count, self.fragment.take(self.bottom[:count] + layer)


def stack_fragments(pixel: Integers) -> PixelStacks:
    """Stack fragments on pixels (F,) int64, which are given in drawing order."""
    order = radix_order(pixel)
    return stacks_of(pixel.take(order), order)


def stacks_of(pixel: Integers, fragment: Integers) -> PixelStacks:
    """Return the stacks of fragments (F,) that are sorted by pixel (F,), then by drawing order."""
    begins = np.empty(len(pixel), bool)
    begins[:1] = True
    np.not_equal(pixel[1:], pixel[:-1], out=begins[1:])
    bottom = np.flatnonzero(begins)
    height = np.diff(bottom, append=len(pixel))
    order, higher = largest_first(height)
    bottom = bottom.take(order)
    return PixelStacks(fragment, pixel.take(bottom), bottom, higher)


# Depth: what is stored for a fragment, which of two is nearer, and the test in drawing order.


FLOAT_INFINITY = 0x7F800000
"""Bits of the float32 infinity; the bits of positive floats are in the order of their values."""


PLANES = ("z", "inverse-w", "reversed-z")
"""Numbers that are linear over the window: z, 1/w, and a depth that is 1 at the near and 0 at the far plane."""

Stored = NDArray[Any]
"""Depths as a method stores them: float32, or whole numbers in float64."""


@dataclass(frozen=True)
class DepthQuantity:
    """A number that grows or falls with the distance: interpolated over the window, then converted at every pixel."""

    name: str
    """As explanations know it."""
    plane: Literal["z", "inverse-w", "reversed-z"]
    """What is interpolated, one of `PLANES`. With 1/w, pixels where it is not positive are behind the eye and fail."""
    convert: Callable[[Floats, float, float], Floats] | None = None
    """From interpolated values (F,), near and far to the number (F,); ``None``: it is that value itself."""
    listing: Callable[..., Any] | None = None
    """How it is found at a pixel; ``None``: nothing more is shown than the interpolated value."""
    line_listing: Callable[..., Any] | None = None
    """The same along an outline, where it differs."""

    def __post_init__(self) -> None:
        if self.plane not in PLANES:
            raise ValueError(f"plane must be one of {', '.join(PLANES)}, got {self.plane}")

    @property
    def is_window_depth(self) -> bool:
        """Whether it is the window depth z itself."""
        return self.plane == "z" and self.convert is None


WINDOW_DEPTH = DepthQuantity("z", "z")
INVERSE_W = DepthQuantity("inverse-w", "inverse-w")


@dataclass(frozen=True)
class DepthFormat:
    """How a depth is kept: as a float32 that is 0 or more."""

    quantity: DepthQuantity
    description: str
    """What the buffer holds, in one sentence: range, cleared value, and which of two is nearer."""
    cleared: float
    """Value of the empty buffer: nothing is farther."""
    larger_is_nearer: bool
    store: Callable[[Floats], Stored]
    """Depth of a fragment (F,) float64 to the stored value (F,) of ``stored_type``."""
    scale: float = 1.0
    """What depth 1 is stored as where whole numbers are; 1: it stays a fraction."""
    unit: str = ""
    """Of the stored numbers, behind each on screen."""
    test_listing: TypedText | None = None
    """An edited listing that tests, and says what is stored; ``None``: the test is `is_nearer`."""

    stored_type: ClassVar[type[np.floating[Any]]] = np.float32
    nearness_bits: ClassVar[int] = 31
    """Bits of a nearness key."""
    keeps_nearest: ClassVar[bool] = True
    """Whether the nearest fragment stays, and of equal ones the first, so that they need not be tested in order."""
    is_planar: ClassVar[bool] = False
    """Whether the stored value of most triangles is an integer plane (``fixed_depth``), not rounded pixel by pixel."""

    @property
    def comparison(self) -> str:
        """How a depth must compare with the buffer's to pass."""
        return ">" if self.larger_is_nearer else "<"

    @property
    def listing(self) -> Callable[..., Any] | TypedText:
        """The test at one pixel."""
        return self.test_listing or depth_test

    def nearness_key(self, stored: Stored) -> Integers:
        """Return (F,) int64 keys: smaller is nearer, equal where the stored values (0 or more) are equal."""
        bits = stored.view(np.int32).astype(np.int64)
        return FLOAT_INFINITY - bits if self.larger_is_nearer else bits

    def stored_of_key(self, key: Integers) -> Stored:
        """Return the stored values (F,) of keys."""
        bits = FLOAT_INFINITY - key if self.larger_is_nearer else key
        return bits.astype(np.int32).view(np.float32)

    def is_nearer(self, new: Stored, old: Stored) -> Flags:
        """Decide the depth test of stored values (F,); a tie keeps what is there."""
        return np.asarray(new > old if self.larger_is_nearer else new < old)

    def try_depths(self, new: Stored, old: Stored, writes: Flags | None) -> Flags:
        """Return which of F depths pass; ``old`` (F,) becomes what the buffer holds then.

        ``writes`` (F,) is False for fragments that are not stored; ``None``: all are.
        """
        nearer = self.is_nearer(new, old)
        np.copyto(old, new, where=nearer if writes is None else nearer & writes)
        return nearer


def as_float32(depth: Floats) -> Singles:
    """Round depths (F,) to float32; -0 becomes 0, so that equal values have equal bits."""
    with np.errstate(over="ignore"):
        return depth.astype(np.float32) + np.float32(0)


def not_behind_eye(inverse_w: Floats) -> Singles:
    """Round 1/w (F,) to float32, 0 where it is negative or NaN."""
    return as_float32(np.fmax(inverse_w, 0.0))


def depth_as_float32(depth: float) -> np.float32:
    """Listing of a window depth as it is stored."""
    return np.float32(depth)  #: round


def inverse_w_as_float32(inverse_w: float) -> np.float32:
    """Listing of 1/w as it is stored: behind the eye it is 0."""
    return np.float32(inverse_w if inverse_w > 0 else 0.0)  #: round


@method(
    "depth",
    "z-float32",
    "z in [0, 1], float32",
    source="OpenGL 4.6, DEPTH_COMPONENT32F; Pellacini, which z distance",
    exact_for="depth order, to the spacing of float32",
    breaks_where="surfaces near the far plane: values crowd towards 1",
    listing=depth_as_float32,
)
def z_float32() -> DepthFormat:
    """Store the window depth."""
    description = "Window depth z as float32, from 0 (near) to 1 (far and cleared): smaller is nearer."
    return DepthFormat(WINDOW_DEPTH, description, 1.0, False, as_float32)


@method(
    "depth",
    "inverse-w",
    "1/w, float32",
    source="Zwicker 2016, Z-buffering",
    exact_for="depth order, to the spacing of float32",
    breaks_where="orthographic cameras: 1/w is constant",
    needs=("perspective",),
    listing=inverse_w_as_float32,
)
def inverse_w() -> DepthFormat:
    """Store 1/w, which is linear over the window; larger is nearer.

    Notes
    -----
    At a pixel that only the snapped corners cover 1/w may come out negative: behind the eye, stored as 0, not seen.
    """
    description = "1/w as float32, in one over scene units, 0 where cleared: larger is nearer."
    return DepthFormat(INVERSE_W, description, 0.0, True, not_behind_eye)


def clamp_depth(depth: Floats, is_in_range: Flags) -> tuple[Floats, Flags]:
    """Clamp the depth of fragments whose triangle is in range as a whole; test the others.

    Parameters
    ----------
    depth : (F,) float64, window depth
    is_in_range : (F,) bool, every corner of the triangle has -w <= z <= w and w > 0

    Returns
    -------
    depth : (F,) float64
    keeps : (F,) bool, False where the fragment lies before the near or behind the far plane
    """
    keeps = is_in_range | ((depth >= 0) & (depth <= 1))
    return np.where(is_in_range, np.minimum(np.maximum(depth, 0.0), 1.0), depth), keeps


@dataclass(frozen=True, eq=False)
class DepthTests:
    """F fragments at the depth test, in drawing order."""

    before: Stored
    """(F,) what the buffer held."""
    passes: Flags
    """(F,) bool."""
    left: Stored | None = None
    """(F,) what it holds after each; ``None``: the fragment's depth where it passes and is written, else ``before``."""


def run_depth_tests(
    stored: Stored,
    stacks: PixelStacks,
    initial: Stored,
    depth_format: DepthFormat,
    is_tested: bool,
    writes: Flags | None = None,
) -> DepthTests:
    """Test fragments one layer after another: the result is that of drawing them one by one.

    Parameters
    ----------
    stored : (F,) of the format's ``stored_type``
    stacks : PixelStacks
        Of the F fragments.
    initial : (H*W,) like ``stored``, the buffer before
    is_tested : bool
        False: every fragment passes.
    writes : (F,) bool, optional
        Fragments that are stored if they pass; ``None``: all.
    """
    before, passes = np.empty_like(stored), np.ones(len(stored), bool)
    left = np.empty_like(stored) if is_tested and depth_format.test_listing is not None else None
    there = initial.take(stacks.pixel)
    for count, fragment in stacks.layers():
        new, old = stored.take(fragment), there[:count]
        before[fragment] = old
        is_written = None if writes is None else writes.take(fragment)
        if is_tested:
            passes[fragment] = depth_format.try_depths(new, old, is_written)
            if left is not None:
                left[fragment] = old
        else:
            np.copyto(old, new, where=True if is_written is None else is_written)
    return DepthTests(before, passes, left)


def replay_depths(stored: Stored, stacks: PixelStacks, initial: Stored, kept: Flags) -> Stored:
    """Return what the buffer held before each of F fragments, (F,), where another test decided which are kept.

    Arguments as in `run_depth_tests`; ``kept`` is (F,) bool.
    """
    before = np.empty_like(stored)
    there = initial.take(stacks.pixel)
    for count, fragment in stacks.layers():
        old = there[:count]
        before[fragment] = old
        np.copyto(old, stored.take(fragment), where=kept.take(fragment))
    return before


def depth_test(new: float, old: float, larger_is_nearer: bool, writes: bool = True) -> tuple[float, bool]:
    """Listing of the depth test at one pixel; ``writes`` is false for the pale pixels of lines."""
    nearer = new > old if larger_is_nearer else new < old  #: compare
    if not nearer:
        return old, False  #: reject
    return new if writes else old, True  #: store


def store_depth(new: float, old: float, writes: bool = True) -> float:
    """Listing of a depth that is stored without a test; ``writes`` is false for the pale pixels of lines."""
    return new if writes else old  #: store


def depth_in_range(depth: float, is_in_range: bool) -> tuple[float, bool]:
    """Listing of the depth range: a triangle with all corners in range is clamped, any other loses fragments."""
    if is_in_range:
        return min(max(depth, 0.0), 1.0), True
    return depth, 0 <= depth <= 1  #: range


# The nearest fragment of every pixel, found in batches: depth and drawing order packed into one integer
# key.


BLOCK = 1 << 15
"""Pixels that are worked on together: their numbers stay in the processor's cache."""
READ_AT_ONCE = 8 * BLOCK
"""Pixels among which those are looked for that something is seen at."""


class NearestFragments:
    """Least key per pixel over all fragments added so far; primitives are numbered in drawing order.

    Raises ValueError if the key has too few bits for the number of primitives.
    """

    def __init__(
        self,
        pixel_count: int,
        primitive_count: int,
        depth_format: DepthFormat,
        uses_depth_test: bool,
        memory: Integers | None = None,
    ) -> None:
        self._format = depth_format
        self._uses_depth_test = uses_depth_test
        self._last = primitive_count - 1
        self.primitive_bits = 63 - depth_format.nearness_bits
        if primitive_count >= 1 << self.primitive_bits:
            raise ValueError(
                f"this depth method takes at most {(1 << self.primitive_bits) - 1} triangles, got {primitive_count}"
            )
        cleared = _cleared_key(depth_format)
        if uses_depth_test:
            self._cleared = cleared << self.primitive_bits
        else:
            self._cleared = (primitive_count << depth_format.nearness_bits) | cleared
        self.keys = np.empty(pixel_count, np.int64) if memory is None else memory
        self.keys.fill(self._cleared)

    def add(self, pixel: Integers, primitive: Integers, stored: Stored) -> None:
        """Take fragments in: pixel index (F,), primitive (F,), stored depth (F,)."""
        nearness = self._format.nearness_key(stored)
        if self._uses_depth_test:
            key = (nearness << self.primitive_bits) | (primitive + 1)
        else:
            key = ((self._last - primitive) << self._format.nearness_bits) | nearness
        np.minimum.at(self.keys, pixel, key)

    def seen(self) -> Iterator[tuple[Integers, Integers]]:
        """Yield the places that something is seen at (V,), and the primitive there (V,), up to `BLOCK` at a time.

        They come from the first to the last, in few parts even where little is seen: work on a part has its fixed cost.
        """
        for first in range(0, len(self.keys), READ_AT_ONCE):
            place, primitive = self.seen_in(slice(first, first + READ_AT_ONCE))
            part_count = -(-len(place) // BLOCK)
            for part in range(part_count):
                at = slice(len(place) * part // part_count, len(place) * (part + 1) // part_count)
                yield place[at], primitive[at]

    def seen_in(self, part: slice) -> tuple[Integers, Integers]:
        """Return the places, within ``part``, that something is seen at (V,), and the primitive there (V,)."""
        place = np.flatnonzero(self.keys[part] != self._cleared)
        place += part.start or 0
        return place, self.primitive_at(place)

    def primitive_at(self, place: Integers) -> Integers:
        """Return the primitive that is seen at places (V,) where something is."""
        seen = self.keys.take(place)
        if self._uses_depth_test:
            seen &= (1 << self.primitive_bits) - 1
            seen -= 1
        else:
            seen >>= self._format.nearness_bits
            np.subtract(self._last, seen, out=seen)
        return seen

    def number_in(self, part: slice, number: Integers) -> Integers:
        """Write the primitive plus one that is seen in ``part`` of the buffer (F,), 0 for none, and return it."""
        keys = self.keys[part]
        if self._uses_depth_test:
            return np.bitwise_and(keys, (1 << self.primitive_bits) - 1, out=number)
        np.right_shift(keys, self._format.nearness_bits, out=number)
        return np.subtract(self._last + 1, number, out=number)

    def resolve(self) -> tuple[Integers, Integers, Stored]:
        """Return the pixels that something is seen at (V,), the primitive there (V,), and the depth buffer (H*W,)."""
        return *self.seen_in(slice(None)), self.depth()

    def depth(self) -> Stored:
        """Return the depth buffer (H*W,)."""
        depth = np.empty(len(self.keys), self._format.stored_type)
        for first in range(0, len(depth), BLOCK):
            part = slice(first, first + BLOCK)
            depth[part] = self._stored(self.keys[part])
        return depth

    def depth_at(self, place: Integers) -> Stored:
        """Return the depth at places in the buffer (N,)."""
        return self._stored(self.keys.take(place))

    def _stored(self, keys: Integers) -> Stored:
        if self._uses_depth_test:
            return self._format.stored_of_key(keys >> self.primitive_bits)
        return self._format.stored_of_key(keys & ((1 << self._format.nearness_bits) - 1))


@cache
def _cleared_key(depth_format: DepthFormat) -> int:
    """Return the nearness key of the cleared buffer."""
    cleared = np.array([depth_format.cleared], depth_format.stored_type)
    return int(depth_format.nearness_key(cleared)[0])
