"""What a workload consists of: plain arrays that every library can be given.

NumPy alone is imported here, so that a fresh process that draws with one library pays for that library only.
"""

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

Floats = NDArray[np.float64]
Integers = NDArray[np.int64]
Bytes = NDArray[np.uint8]

SUBPIXELS = 256
"""Window coordinates are whole multiples of 1/256 pixel, what OpenGL implementations snap to.

Not the core's number: what the program is compared with stands on its own.
"""


@dataclass(frozen=True, eq=False)
class WindowTriangles:
    """Triangles that are where they will be seen: nothing is to be transformed, culled or clipped."""

    corners: Floats
    """(T, 3, 2) float64 window x, y in pixels, y up, multiples of 1/256; counter-clockwise, inside the raster."""
    depth: Floats
    """(T, 3) float64 in 0 to 1, smaller is nearer."""
    colors: Bytes
    """(T, 3, 4) uint8 colour of every corner, straight alpha; drawn as it is, without gamma."""
    size: tuple[int, int]
    """(width, height) of the raster in pixels."""
    is_blended: bool = False
    """Blend ``over`` in drawing order, without a depth test; else the nearest is seen."""

    @property
    def is_flat(self) -> bool:
        """Whether every triangle has one colour."""
        return bool((self.colors == self.colors[:, :1]).all())


@dataclass(frozen=True, eq=False)
class Lighting:
    """One white light from far away, and how the surface answers (Blinn-Phong, white ambient light)."""

    direction: Floats
    """(3,) float64 unit vector, world space, the way the light travels."""
    ambient: float
    diffuse: float
    specular: float
    shininess: float
    is_per_pixel: bool
    """Phong shading, else Gouraud."""


@dataclass(frozen=True, eq=False)
class ViewedMesh:
    """A mesh in world space before a perspective camera; back faces are not seen."""

    positions: Floats
    """(N, 3) float64 world space."""
    triangles: Integers
    """(T, 3) int64, counter-clockwise outside."""
    normals: Floats
    """(N, 3) float64 unit."""
    eye: Floats
    """(3,) float64 world space; also ``target`` and ``up``."""
    target: Floats
    up: Floats
    field_of_view: float
    """Vertical, in radians."""
    near: float
    far: float
    view: Floats
    """(4, 4) float64 world to camera, for column vectors."""
    projection: Floats
    """(4, 4) float64 camera to clip."""
    size: tuple[int, int]
    colors: Floats | None = None
    """(N, 3) float64 in 0 to 1, without gamma; ``None``: white."""
    uvs: Floats | None = None
    """(N, 2) float64."""
    texture: Bytes | None = None
    """(h, w, 3) uint8, row 0 at v = 0, repeated, filtered bilinearly."""
    lighting: Lighting | None = None
    """``None``: the colours contain their light."""


@dataclass(frozen=True, eq=False)
class Lines:
    """Lines one pixel wide from pixel to pixel, both ends drawn; later ones lie above earlier ones."""

    ends: Integers
    """(L, 4) int64 column and row of the first and of the last pixel, y up, inside the raster."""
    colors: Bytes
    """(L, 3) uint8."""
    size: tuple[int, int]


@dataclass(frozen=True, eq=False)
class ColdStart:
    """The first picture of a process that has imported nothing yet."""

    triangles: WindowTriangles


@dataclass(frozen=True, eq=False)
class MeshFile:
    """A mesh that is to be read from a file."""

    positions: Floats
    """(N, 3) float64 in -1 to 1."""
    triangles: Integers
    """(T, 3) int64."""
    extension: str
    """``.obj`` of plain text, ``.ply`` or ``.stl`` of little-endian binary numbers."""


@dataclass(frozen=True, eq=False)
class TypedPicture:
    """A picture that the core draws by a rule of its own, and by a typed text in place of that rule."""

    part: str
    """What is typed: ``fill`` (the inside test), ``line``, or ``shaders`` (Phong)."""
    size: tuple[int, int]


Work = WindowTriangles | ViewedMesh | Lines | ColdStart | MeshFile | TypedPicture
