"""Tables of whole-number depths with infinities: their depth test, and the scenes that they are."""

from collections.abc import Callable
from dataclasses import dataclass, replace
from typing import Any, ClassVar

import numpy as np

from core.depth.depth import DepthFormat, DepthQuantity, Stored, as_float32
from core.methods import Method
from core.records.arrays import Flags, Floats
from core.records.depth_table import DEPTH_TESTS, DepthTable, cleared_for
from core.scene import ClipScene

# Depths in whole numbers with infinities: what the depth buffer of a table of depths holds, and its tests.


WHOLE_STEPS = 2.0**14
"""Steps of window depth, each a whole number; the last one, z = 1, stands for infinity."""


def window_depth(depth: Floats) -> Floats:
    """Return the window depths (...) of whole numbers and infinities (...); no rounding takes place."""
    return np.where(np.isinf(depth), 1.0, depth / WHOLE_STEPS)


def whole_depth(z: Floats, near: float, far: float) -> Floats:
    """Return the whole number, or infinity, of window depths (F,)."""
    return np.where(z >= 1, np.inf, np.rint(z * WHOLE_STEPS))


WHOLE_DEPTH = DepthQuantity("whole depth", "z", whole_depth)
WHOLE_INVERSE_W = replace(WHOLE_DEPTH, name="whole 1/w")


def less_passes(new: float, old: float) -> tuple[float, bool]:
    """Listing of the depth test of a table where smaller depths pass: what the buffer holds then, and whether."""
    passes = new < old  #: compare
    if passes:
        return new, True  #: store
    return old, False  #: reject


def less_equal_passes(new: float, old: float) -> tuple[float, bool]:
    """Listing of the depth test of a table where smaller depths and equal ones pass."""
    passes = new <= old  #: compare
    if passes:
        return new, True  #: store
    return old, False  #: reject


def greater_passes(new: float, old: float) -> tuple[float, bool]:
    """Listing of the depth test of a table where larger depths pass."""
    passes = new > old  #: compare
    if passes:
        return new, True  #: store
    return old, False  #: reject


def greater_equal_passes(new: float, old: float) -> tuple[float, bool]:
    """Listing of the depth test of a table where larger depths and equal ones pass."""
    passes = new >= old  #: compare
    if passes:
        return new, True  #: store
    return old, False  #: reject


COMPARED: dict[str, tuple[np.ufunc, Callable[..., Any]]] = {
    "less": (np.less, less_passes),
    "less-equal": (np.less_equal, less_equal_passes),
    "greater": (np.greater, greater_passes),
    "greater-equal": (np.greater_equal, greater_equal_passes),
}
"""Each of `DEPTH_TESTS`: its rule and its listing."""


@dataclass(frozen=True)
class TableFormat(DepthFormat):
    """Whole numbers and infinities as float32, with a test of one's choice."""

    test: str = "less"
    """One of ``core.records.depth_table.DEPTH_TESTS``."""

    keeps_nearest: ClassVar[bool] = False

    @property
    def comparison(self) -> str:
        """How a depth must compare with the buffer's to pass."""
        return DEPTH_TESTS[self.test]

    @property
    def listing(self) -> Callable[..., Any]:
        """The test at one pixel."""
        return COMPARED[self.test][1]

    def is_nearer(self, new: Stored, old: Stored) -> Flags:
        """Decide the depth test of stored values (F,)."""
        return np.asarray(COMPARED[self.test][0](new, old))


def _depths_of_table(test: str) -> Method:
    """Return what stands in place of the chosen depth method where a scene is a table of depths."""
    is_smaller = test.startswith("less")
    what, holds = ("depth", "∞") if is_smaller else ("1/w", "0")
    made = TableFormat(
        WHOLE_DEPTH if is_smaller else WHOLE_INVERSE_W,
        f"Whole numbers, {holds} where cleared: a fragment passes if its {what} is {DEPTH_TESTS[test]} the buffer's.",
        cleared_for(test),
        not is_smaller,
        as_float32,
        test=test,
    )
    return Method(
        "depth",
        "z-float32",
        f"Whole numbers and infinities, {DEPTH_TESTS[test]}",
        lambda: made,
        source="Jubair, Z-buffer Algorithm; Pellacini; LMU 2020, Frame and Depth Buffers",
        exact_for="whole numbers from 0 to 9999, and infinity",
    )


TABLE_DEPTHS = {test: _depths_of_table(test) for test in DEPTH_TESTS}
"""By depth test."""


# Tables of depths as scenes: every cell of a patch is a fragment, which enters the pipeline at the depth
# test.


def table_scene(table: DepthTable) -> ClipScene:
    """Return the scene of a table: one fragment for each cell with a depth, patch by patch, the top row first.

    Examples
    --------
    >>> nan = float("nan")
    >>> scene = table_scene(DepthTable([[[5, nan]], [[3, 7]]], np.ones((2, 4))))
    >>> scene.numbers.tolist(), scene.size
    ([0, 1, 1], (2, 1))
    """
    width, height = table.size
    upside_down = table.depths[:, ::-1]
    patch, line, column = np.nonzero(~np.isnan(upside_down))
    depth = window_depth(upside_down[patch, line, column])
    clip = np.ones((len(patch), 1, 4))
    clip[:, 0, 0] = (2 * column + 1) / width - 1
    clip[:, 0, 1] = (2 * (height - 1 - line) + 1) / height - 1
    clip[:, 0, 2] = 2 * depth - 1
    colors = table.colors[patch][:, None]
    return ClipScene(clip, colors, table.size, shared=patch[:, None], kind="fragments", table=table)
