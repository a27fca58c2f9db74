"""What methods of visibility that decide without the depth test are given, and what they answer.

Picture, trace and history of a pixel ask all of them in the same words: `core.stages.hidden_surfaces` makes the case.
"""

from collections.abc import Callable, Mapping
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any, ClassVar, Protocol

import numpy as np
from numpy.typing import NDArray

from core.records.arrays import Flags, Floats, Integers, cached_property

if TYPE_CHECKING:
    from core.coverage.fills import Fragments
    from core.depth.depth import DepthFormat, PixelStacks, Stored
    from core.visibility.ray_casting import RayPlanes
    from core.visibility.rays_in_tree import TreeRays


@dataclass(frozen=True, eq=False)
class ExactCase:
    """F fragments in drawing order, of which the nearest are looked for at U pixels."""

    planes: "RayPlanes"
    fragments: "Fragments"
    triangle: Integers
    """(F,) int64, numbers of the scene."""
    stacks: "PixelStacks"
    """The fragments of every pixel."""
    initial: Integers
    """(U,) int64, the triangle that is seen at pixels before, -1: none."""
    center: float
    """Where in a pixel its centre lies: 0 or 1/2."""
    writes: Flags | None
    """(F,) bool, fragments that later ones are compared with if they pass; ``None``: all."""
    tree: "TreeRays | None"
    """The rays among boxes, where the method walks a tree and the fragments are those of filled triangles."""
    is_mixed: bool
    """Whether fragments are mixed with what is there, so that what is behind them shows."""
    is_outlined: bool
    """Whether the fragments are pixels of lines, which have no spans."""
    keeps_visits: bool
    """Whether the boxes that rays ask are listed, see `core.visibility.tree_walk`."""
    stored: "Stored"
    """(F,) what the depth buffer gets of each fragment."""
    initial_depth: "Stored"
    """(U,) what it holds before."""
    depth_format: "DepthFormat"

    @cached_property
    def rays(self) -> tuple[Floats, Floats]:
        """M and n (F,) of the rays that meet the fragments."""
        return self.planes.rays(self.fragments.column, self.fragments.row, self.center)

    @cached_property
    def pixel(self) -> Integers:
        """(F,) int64, index of each fragment's pixel in ``initial``."""
        order, count = np.argsort(self.stacks.bottom), len(self.stacks.fragment)
        found = np.empty(count, np.int64)
        heights = np.diff(self.stacks.bottom[order], append=count)
        found[self.stacks.fragment] = np.repeat(self.stacks.pixel[order], heights)
        return found


class ExactTests(Protocol):
    """How F fragments were compared, exactly or by their stored depths."""

    tracer: ClassVar[str]
    """What makes the rows of the stage depth of it, ``module.function``, given a ``TraceSource`` and this."""

    @property
    def work(self) -> Mapping[str, int]:
        """What was done for it, as ``depths computed``, for studies; empty: a test for each fragment."""

    @property
    def turn(self) -> Integers | None:
        """(D,) int64, the fragments that pass in the order in which they are drawn; ``None``: as they stand."""

    def told(self) -> tuple[NDArray[Any], Mapping[str, Integers]]:
        """Return what is said of F fragments of one pixel in its history: a key (F,) each, and its numbers (F,)."""


Decide = Callable[[ExactCase], tuple[Flags, ExactTests]]
"""Decides which fragments (F,) pass, and how."""
