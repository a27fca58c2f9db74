"""What a workload consists of, a library that draws one, and what is done for a library that lacks a stage.

NumPy alone is imported here, so that a fresh process that draws with one library pays for that library only.

NumPy alone, and none of the core's code: the reference that coverage is checked against begins here too.
"""

from collections.abc import Callable
from contextlib import ExitStack
from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray

# What a workload consists of: plain arrays that every library can be given.


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


# A contender: one library drawing one workload.


Run = Callable[[], Any]
"""Draws the picture from nothing and returns its pixels, (H, W, 3 or 4) uint8; or reads a file."""


def unchanged(pixels: Bytes) -> Bytes:
    """Return the pixels that a run returned."""
    return pixels


class UnavailableError(RuntimeError):
    """A library is not installed, or cannot draw here; the message is one sentence."""


@dataclass(frozen=True)
class Prepared:
    """What is left to do when everything that is done once has been done: data loaded, programs compiled."""

    run: Run
    tell: Callable[[], str] = str
    """Says how it was drawn: the name of an OpenGL implementation, or a route; asked once all is timed."""
    picture: Callable[[Any], Bytes] = unchanged
    """Makes pixels of what a run returned, to be compared; not timed."""


@dataclass(frozen=True)
class Contender:
    """One library drawing one workload."""

    library: str
    kind: str
    """``ours``, ``graphics`` (an OpenGL implementation), ``painter`` (draws 2D shapes), ``compiled`` (a loop) or
    ``reader`` (of files)."""
    prepare: Callable[[ExitStack], Prepared]
    """Does what is done once, untimed; what must be released at the end is left on the stack."""
    less: str = ""
    """What it does less than ours."""
    is_top_down: bool = False
    """Whether row 0 of its pixels is the top row."""


# Triangles made at random, and the two large ones: the workloads that are given in the window.


LARGE_CORNERS = ((3.3, 5.2), (1019.7, 12.6), (8.1, 1021.9))
SLENDEREST = 0.12
"""Least area of a random triangle as a fraction of the square of its longest side: no slivers."""
DARKEST = 16
"""Least value of a colour channel: what is drawn can be told from the black background."""


def snapped(points: Floats) -> Floats:
    """Round window positions (..., 2) to 1/256 pixel."""
    return np.rint(points * SUBPIXELS) / SUBPIXELS


def large_triangle(colors: tuple[tuple[int, int, int], ...]) -> WindowTriangles:
    """Return a triangle that covers half of 1024 x 1024 pixels, with these colours at its corners."""
    opaque = np.array([[(*color, 255) for color in colors]], np.uint8)
    return WindowTriangles(
        snapped(np.array([LARGE_CORNERS])), np.array([[0.2, 0.5, 0.8]]), opaque, (1024, 1024)
    )


def random_triangles(
    seed: int, count: int, size: tuple[int, int], area: float, is_blended: bool = False
) -> WindowTriangles:
    """Return ``count`` triangles of about ``area`` pixels each, spread evenly over the raster."""
    rng = np.random.default_rng(seed)
    middle = rng.uniform(0, 1, (count, 1, 2)) * size
    shape = _shapes(rng, count)
    shape *= np.sqrt(area / (doubled_areas(shape) / 2))[:, None, None]
    shape -= shape.mean(axis=1, keepdims=True)
    corners = snapped(np.clip(middle + shape, 0, size))
    depth = rng.uniform(0.05, 0.95, (count, 1)) + rng.uniform(-0.02, 0.02, (count, 3))
    colors = _flat_colors(rng, count, is_blended)
    has_area = doubled_areas(corners) > 0
    return WindowTriangles(corners[has_area], depth[has_area], colors[has_area], size, is_blended)


def doubled_areas(corners: Floats) -> Floats:
    """Return twice the signed area (T,) of triangles (T, 3, 2)."""
    first, second = corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0]
    return np.asarray(first[:, 0] * second[:, 1] - first[:, 1] * second[:, 0])


def _shapes(rng: np.random.Generator, count: int) -> Floats:
    """Return counter-clockwise triangles (count, 3, 2) of no particular size that are not too slender."""
    shape = rng.normal(size=(count, 3, 2))
    poor = np.arange(count)
    while len(poor):
        shape[poor] = rng.normal(size=(len(poor), 3, 2))
        sides = shape[poor] - np.roll(shape[poor], 1, axis=1)
        longest = (sides**2).sum(axis=2).max(axis=1)
        poor = poor[np.abs(doubled_areas(shape[poor])) / 2 < SLENDEREST * longest]
    turned = doubled_areas(shape) < 0
    shape[turned] = shape[turned][:, [0, 2, 1]]
    return shape


def _flat_colors(rng: np.random.Generator, count: int, is_blended: bool) -> Bytes:
    """Return one random colour for each triangle, at all its corners: (count, 3, 4)."""
    color = np.full((count, 4), 255, np.uint8)
    color[:, :3] = rng.integers(DARKEST, 256, (count, 3))
    if is_blended:
        color[:, 3] = rng.integers(64, 192, count)
    return np.repeat(color[:, None], 3, axis=1)


# A mesh before a camera as triangles in the window: what a library without a vertex stage is given.


@dataclass(frozen=True, eq=False)
class Projected:
    """The triangles of a mesh that face the eye; all of it must lie in front of the eye."""

    triangle: Integers
    """(P,) int64 numbers in the mesh."""
    corners: Floats
    """(P, 3, 2) float64 window x, y, snapped to 1/256 pixel."""
    depth: Floats
    """(P, 3) float64 window depth."""


def project(mesh: ViewedMesh) -> Projected:
    """Return where the triangles of ``mesh`` that face the eye are in the window.

    Raises ValueError if a vertex is not before the eye: such triangles have no place in the window.
    """
    points = np.concatenate([mesh.positions, np.ones((len(mesh.positions), 1))], axis=1)
    clip = points @ (mesh.projection @ mesh.view).T
    if (clip[:, 3] <= 0).any():
        raise ValueError("the mesh must lie in front of the eye")
    ndc = clip[:, :3] / clip[:, 3:]
    window = np.rint((ndc[:, :2] + 1) * np.array(mesh.size) / 2 * SUBPIXELS) / SUBPIXELS
    corners = window[mesh.triangles]
    front = np.flatnonzero(doubled_areas(corners) > 0)
    return Projected(front, corners[front], (ndc[:, 2] / 2 + 0.5)[mesh.triangles[front]])


def lit_colors(mesh: ViewedMesh) -> Bytes:
    """Return the colours (N, 4) uint8 of the vertices under a light without highlights."""
    color = np.ones((len(mesh.positions), 3)) if mesh.colors is None else mesh.colors
    light = mesh.lighting
    if light is not None:
        facing = np.maximum(mesh.normals @ -light.direction, 0.0)
        color = color * (light.ambient + light.diffuse * facing)[:, None]
    opaque = np.full((len(color), 4), 255, np.uint8)
    opaque[:, :3] = np.floor(np.clip(color, 0, 1) * 255 + 0.5)
    return opaque


def as_window_triangles(mesh: ViewedMesh) -> WindowTriangles:
    """Return what is left to draw of a mesh once it is transformed, culled and lit at its vertices."""
    projected = project(mesh)
    colors = lit_colors(mesh)[mesh.triangles[projected.triangle]]
    return WindowTriangles(projected.corners, projected.depth, colors, mesh.size)


# What a library that draws 2D shapes is given: an order instead of a depth test, a warp instead of a floor.


def painter(
    library: str,
    work: Work,
    prepare: tuple[
        Callable[[WindowTriangles], Prepared], Callable[[Lines], Prepared], Callable[[ViewedMesh], Prepared]
    ],
    *,
    is_top_down: bool,
    blends: bool = True,
) -> Contender | None:
    """Return a library drawing flat triangles, lines or a textured floor; ``None`` for other work."""
    triangles, lines, floor = prepare
    if isinstance(work, WindowTriangles) and work.is_flat and (blends or not work.is_blended):
        less = not_sorted(work)
        return Contender(library, "painter", lambda _: triangles(work), less, is_top_down)
    if isinstance(work, Lines):
        return Contender(library, "painter", lambda _: lines(work), "", is_top_down)
    if isinstance(work, ViewedMesh) and work.texture is not None and work.lighting is None:
        return Contender(library, "painter", lambda _: floor(work), "warps one image, no geometry", True)
    return None


def not_sorted(work: WindowTriangles) -> str:
    """Return what a painter of triangles does less than ours."""
    return "" if work.is_blended or len(work.corners) == 1 else "no depth, sorting not timed"


def back_to_front(work: WindowTriangles) -> Integers:
    """Return the order (T,) in which a painter draws: far ones first, or as given where they are blended."""
    if work.is_blended:
        return np.arange(len(work.corners))
    return np.argsort(-work.depth.mean(axis=1), kind="stable")


def floor_homography(work: ViewedMesh, center: float = 0.5) -> Floats:
    """Return (3, 3): from pixels of the picture, rows downwards, to texels of a plane's texture.

    Parameters
    ----------
    work : ViewedMesh
        Its first three vertices span the plane.
    center : float
        Where a library has the centre of pixel and texel 0.

    Notes
    -----
    A point of the plane is ``origin + u across + v along``, so that clip x, y and w are a (3, 3) matrix times
    (u, v, 1): the warp is that matrix, turned round.
    """
    assert work.uvs is not None
    assert work.texture is not None
    points = np.concatenate([work.positions[:3], np.ones((3, 1))], axis=1)
    coordinates = np.concatenate([work.uvs[:3], np.ones((3, 1))], axis=1)
    plane = np.linalg.solve(coordinates, points).T  # (4, 3): (u, v, 1) to world space
    clip = (work.projection @ work.view @ plane)[[0, 1, 3]]
    (width, height), (texels_up, texels_across) = work.size, work.texture.shape[:2]
    to_window = np.array([[width / 2, 0, width / 2], [0, -height / 2, height / 2], [0, 0, 1]])
    to_texels = np.diag([texels_across, texels_up, 1.0])
    shift = np.array([[1, 0, 0.5 - center], [0, 1, 0.5 - center], [0, 0, 1]])
    back = np.array([[1, 0, center - 0.5], [0, 1, center - 0.5], [0, 0, 1]])
    homography: Floats = back @ to_texels @ np.linalg.inv(to_window @ clip) @ shift
    return homography
