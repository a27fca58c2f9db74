"""Depth: what is stored for a fragment, which of two is nearer, and the test in drawing order.

References
----------
M. Zwicker, *Computergrafik*, lecture "Z-buffering" (1/w, larger is nearer), Bern 2016.
F. Pellacini, *Computer Graphics*, "which z distance"; LMU 2020, "Frame and depth buffers".
E. Catmull, *A subdivision algorithm for computer display of curved surfaces*, 1974.
"""

from collections.abc import Callable
from dataclasses import dataclass

import numpy as np

from core.arrays import Flags, Floats, Integers, Singles
from core.methods import method

FLOAT_INFINITY = 0x7F800000
"""Bits of the float32 infinity; the bits of positive floats are in the order of their values."""


@dataclass(frozen=True)
class DepthFormat:
    """How a depth is kept."""

    quantity: str
    """``z`` (window depth) or ``inverse-w``."""
    cleared: float
    """Value of the empty buffer: nothing is farther."""
    larger_is_nearer: bool
    store: Callable[[Floats], Singles]
    """Depth of a fragment (F,) float64 to the stored value (F,) float32."""

    def nearness_key(self, stored: Singles) -> Integers:
        """Return (F,) int64 keys below 2^31: smaller is nearer, equal where the stored values (0 or more) are equal."""
        bits = stored.view(np.int32).astype(np.int64)
        return FLOAT_INFINITY - bits if self.larger_is_nearer else bits

    def stored_of_key(self, key: Integers) -> Singles:
        """Return the stored values (F,) float32 of keys."""
        bits = FLOAT_INFINITY - key if self.larger_is_nearer else key
        return bits.astype(np.int32).view(np.float32)

    def is_nearer(self, new: Singles, old: Singles) -> Flags:
        """Decide the depth test of stored values (F,); a tie keeps what is there."""
        return np.asarray(new > old if self.larger_is_nearer else new < old)


def as_float32(depth: Floats) -> Singles:
    """Round depths (F,) to float32; -0 becomes 0, so that equal values have equal bits."""
    with np.errstate(over="ignore"):
        return depth.astype(np.float32) + np.float32(0)


def not_behind_eye(inverse_w: Floats) -> Singles:
    """Round 1/w (F,) to float32, 0 where it is negative or NaN."""
    return as_float32(np.fmax(inverse_w, 0.0))


@method(
    "depth",
    "z-float32",
    "z in [0, 1], float32",
    source="OpenGL 4.6, DEPTH_COMPONENT32F; Pellacini, which z distance",
    exact_for="order, to the spacing of float32",
    breaks_where="near the far plane: the values crowd towards 1",
)
def z_float32() -> DepthFormat:
    """Store the window depth."""
    return DepthFormat("z", 1.0, False, as_float32)


@method(
    "depth",
    "inverse-w",
    "1/w, float32",
    source="Zwicker 2016, Z-buffering",
    exact_for="order, to the spacing of float32",
    breaks_where="orthographic cameras: it is constant",
    needs=("perspective",),
)
def inverse_w() -> DepthFormat:
    """Store 1/w, which is linear over the window; larger is nearer.

    Notes
    -----
    At a pixel that only the snapped corners cover 1/w may come out negative: behind the eye, stored as 0, not seen.
    """
    return DepthFormat("inverse-w", 0.0, True, not_behind_eye)


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


def layers(pixel: Integers) -> list[Integers]:
    """Split fragments in drawing order into layers: the first of every pixel, the second, and so on.

    A layer names each pixel at most once, so it can be tested and blended as one array.
    """
    order = np.argsort(pixel, kind="stable")
    ordered = pixel[order]
    starts = np.flatnonzero(np.diff(ordered, prepend=-1))
    count = np.diff(starts, append=len(pixel))
    found = []
    for layer in range(int(count.max(initial=0))):
        found.append(np.sort(order[starts[count > layer] + layer]))
    return found


@dataclass(frozen=True, eq=False)
class DepthTests:
    """F fragments at the depth test, in drawing order."""

    before: Singles
    """(F,) float32, what the buffer held."""
    passes: Flags
    """(F,) bool."""


def run_depth_tests(
    stored: Singles, pixel: Integers, initial: Singles, depth_format: DepthFormat, is_tested: bool
) -> DepthTests:
    """Test fragments one layer after another: the result is that of drawing them one by one.

    Parameters
    ----------
    stored : (F,) float32
    pixel : (F,) int64, index into ``initial``
    initial : (H*W,) float32, the buffer before
    depth_format : DepthFormat
    is_tested : bool
        False: every fragment passes and is stored.
    """
    buffer = initial.copy()
    before = np.empty(len(stored), np.float32)
    passes = np.ones(len(stored), bool)
    for layer in layers(pixel):
        before[layer] = buffer[pixel[layer]]
        if is_tested:
            passes[layer] = depth_format.is_nearer(stored[layer], before[layer])
        passed = layer[passes[layer]]
        buffer[pixel[passed]] = stored[passed]
    return DepthTests(before, passes)


def depth_test(new: np.float32, old: np.float32, larger_is_nearer: bool) -> tuple[np.float32, bool]:
    """Listing of the depth test at one pixel."""
    nearer = new > old if larger_is_nearer else new < old  #: compare
    if not nearer:  #: decide
        return old, False  #: reject
    return new, True  #: store
