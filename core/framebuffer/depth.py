"""Depth: what is stored for a fragment, which of two is nearer, and the test in drawing order.

References
----------
M. Zwicker, *Computergrafik*, lecture "Z-buffering" (1/w, larger is nearer), Bern 2016.
F. Pellacini, *Computer Graphics*, "which z distance"; LMU 2020, "Frame and depth buffers".
E. Catmull, *A subdivision algorithm for computer display of curved surfaces*, 1974.
"""

from collections.abc import Callable
from dataclasses import dataclass
from typing import Any, ClassVar, Literal

import numpy as np
from numpy.typing import NDArray

from core.framebuffer.stacks import PixelStacks
from core.methods import method
from core.records.arrays import Flags, Floats, Integers, Singles
from core.records.listing import TypedText

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
