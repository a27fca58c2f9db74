"""The record that stages hand on: triangles in clip space with everything that is to be interpolated."""

from dataclasses import dataclass, replace

import numpy as np

from core.arrays import Floats, Integers


@dataclass(frozen=True, eq=False)
class Primitives:
    """P triangles, or pieces of triangles made by clipping, in drawing order."""

    clip: Floats
    """(P, 3, 4) float64, clip space."""
    varyings: Floats
    """(P, 3, K) float64, values at the corners."""
    triangle: Integers
    """(P,) int64, number of the triangle in drawing order; pieces keep it."""
    mesh: Integers
    """(P,) int64, the mesh it belongs to (0 for triangles given in clip space)."""
    layout: dict[str, slice]
    """Which of the K values are ``color``, ``uv``, ``normal``, ``position``, ``diffuse_light``, ``specular_light``."""

    def __len__(self) -> int:
        return len(self.clip)

    def take(self, index: Integers) -> "Primitives":
        """Return the primitives of ``index`` (Q,), in that order."""
        return replace(
            self,
            clip=self.clip.take(index, axis=0),
            varyings=self.varyings.take(index, axis=0),
            triangle=self.triangle[index],
            mesh=self.mesh[index],
        )

    def select(self, keep: np.ndarray) -> "Primitives":
        """Return the primitives where ``keep`` (P,) bool holds."""
        return self if keep.all() else self.take(np.flatnonzero(keep))


@dataclass(frozen=True, eq=False)
class DrawingOrder:
    """In which order primitives are drawn, and whether the depth test decides."""

    order: Integers
    """(P,) int64, the primitives from the first drawn to the last."""
    uses_depth_test: bool
