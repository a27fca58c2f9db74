"""What is to be drawn: meshes, camera, lights, textures; or triangles given in clip space."""

from dataclasses import dataclass, field
from itertools import pairwise
from math import isfinite, pi
from typing import ClassVar

import numpy as np

from core.records.arrays import Floats, Integers, Singles, cached_property, checked, checked_size, read_only
from core.records.clip_region import checked_polygon_region, checked_region
from core.records.curves import Curves, checked_patches
from core.records.deformations import Deformation
from core.records.depth_table import DepthTable
from core.records.motion import Motion
from core.records.primitives import checked_rings
from core.shaders.record import ShaderProgram

SIZE_LIMIT = 16384
"""Largest raster, in pixels each way: edge functions stay exact in float64 (see core.coverage.edges)."""

POLYGON_REACH = 8
"""How far from the middle corners of polygons may lie, in halves of the raster: crossings stay exact in int64."""

COORDINATE_LIMIT = 1e60
"""Largest coordinate: products of three of them, as in a determinant, stay far from the end of float64."""


@dataclass(frozen=True, eq=False)
class Texture:
    """An image glued onto triangles; linear colour, (0, 0) is its bottom left corner."""

    pixels: Singles
    """(h, w, C) float32 with C = 1, 3 or 4; row 0 at v = 0; linear light."""
    name: str = "texture"

    def __post_init__(self) -> None:
        pixels = checked("texture pixels", self.pixels, ("h", "w", "C"), np.float32)
        if pixels.shape[2] not in (1, 3, 4) or pixels.size == 0:
            raise ValueError(f"texture pixels must be (h, w, 1, 3 or 4) and not empty, got {pixels.shape}")
        object.__setattr__(self, "pixels", pixels)

    @cached_property
    def has_negative_light(self) -> bool:
        """Whether some texel is below 0."""
        return bool(self.pixels.min() < 0)


@dataclass(frozen=True, eq=False)
class Material:
    """Reflectances of the Blinn-Phong model; the diffuse colour is the vertex colour or the texture."""

    ambient: float = 0.12
    diffuse: float = 0.88
    specular: float = 0.25
    shininess: float = 32.0
    mirror: float = 0.0
    """Share of what it mirrors that is added to its colour, see the family ``environment``."""

    def __post_init__(self) -> None:
        for name in ("ambient", "diffuse", "specular", "mirror"):
            if not 0 <= getattr(self, name) <= 1:
                raise ValueError(f"material {name} must be from 0 to 1, got {getattr(self, name)}")
        if not 0 < self.shininess <= 10000:
            raise ValueError(f"material shininess must be above 0 and at most 10000, got {self.shininess}")


@dataclass(frozen=True, eq=False)
class Mesh:
    """Triangles that share vertices, in object space.

    Attributes of a vertex that are missing (``None``) get a default from the pipeline: white colour, (0, 0)
    texture coordinates, and normals averaged over the faces around the vertex, weighted by area.
    """

    positions: Floats
    """(N, 3) float64, object space."""
    triangles: Integers
    """(T, 3) int64 vertex indices, counter-clockwise seen from the front."""
    normals: Floats | None = None
    """(N, 3) float64, object space, need not be unit."""
    uvs: Floats | None = None
    """(N, 2) float64."""
    colors: Floats | None = None
    """(N, 4) float64, linear, straight alpha."""
    texture: Texture | None = None
    faces: Integers | None = None
    """(T,) int64, the polygon of the file that each triangle came from; ``None``: its own number."""
    patches: Floats | None = None
    """(P, 4, 4, 3) float64, object space, control points of bicubic Bezier patches.

    The triangles are made anew of them as the settings say (`core.tessellation`). Seen from the front, the first index
    runs to the right, the second up.
    """
    transform: Floats = field(default_factory=lambda: np.eye(4))
    """(4, 4) float64, M: object to world."""
    material: Material = field(default_factory=Material)
    name: str = "mesh"
    deformation: Deformation | None = None
    """What moves the vertices before M; ``None``: they stay (`core.deformation`)."""
    rest: "Mesh | None" = None
    """The mesh that this one was made of by its deformation; ``None``: it is not deformed yet."""

    def __post_init__(self) -> None:
        positions = checked("positions", self.positions, ("N", 3), limit=COORDINATE_LIMIT)
        triangles = checked("triangles", self.triangles, ("T", 3), np.int64)
        count = len(positions)
        if len(triangles) == 0:
            raise ValueError(f"{self.name} has no triangles")
        if triangles.min() < 0 or triangles.max() >= count:
            bad = int(np.argmax((triangles < 0).any(axis=1) | (triangles >= count).any(axis=1)))
            raise ValueError(
                f"triangle {bad} of {self.name} names vertex {triangles[bad].tolist()}, there are {count}"
            )
        object.__setattr__(self, "positions", positions)
        object.__setattr__(self, "triangles", triangles)
        object.__setattr__(
            self, "transform", checked("transform", self.transform, (4, 4), limit=COORDINATE_LIMIT)
        )
        for name, width in (("normals", 3), ("uvs", 2), ("colors", 4)):
            if getattr(self, name) is not None:
                values = checked(name, getattr(self, name), ("N", width))
                if len(values) != count:
                    raise ValueError(f"{name} must be ({count}, {width}), got {values.shape}")
                object.__setattr__(self, name, values)
        if self.faces is not None:
            faces = checked("faces", self.faces, ("T",), np.int64)
            if len(faces) != len(triangles):
                raise ValueError(f"faces must be ({len(triangles)},), got {faces.shape}")
            object.__setattr__(self, "faces", faces)
        if self.patches is not None:
            patches = checked_patches(self.name, self.patches, COORDINATE_LIMIT)
            object.__setattr__(self, "patches", patches)
        if self.deformation is not None:
            if self.patches is not None:
                raise ValueError(
                    f"{self.name} is made of patches, which have no vertices of their own to deform"
                )
            if self.deformation.vertex_count != count:
                raise ValueError(
                    f"the deformation of {self.name} must be one of {count} vertices, "
                    f"got {self.deformation.vertex_count}"
                )

    @property
    def makes_positions(self) -> bool:
        """Whether its vertices are made before the matrices are applied."""
        return self.patches is not None or self.deformation is not None

    @property
    def is_affine(self) -> bool:
        """Whether M leaves w at 1, as all do that are no projection themselves."""
        return bool(np.array_equal(self.transform[3], (0, 0, 0, 1)))


def triangulate(polygons: list[list[int]]) -> tuple[Integers, Integers]:
    """Fan polygons into triangles: (T, 3) vertex indices and the (T,) polygon each came from.

    Raises ValueError if a polygon has fewer than three corners.
    """
    triangles, faces = [], []
    for face, polygon in enumerate(polygons):
        if len(polygon) < 3:
            raise ValueError(f"polygon {face} must have at least 3 corners, got {len(polygon)}")
        for second, third in pairwise(polygon[1:]):
            triangles.append((polygon[0], second, third))
            faces.append(face)
    return np.array(triangles, np.int64).reshape(-1, 3), np.array(faces, np.int64)


@dataclass(frozen=True, eq=False)
class Camera:
    """Where the picture is taken from; looks along -z of its own space."""

    eye: Floats
    """(3,) float64, world space."""
    target: Floats
    """(3,) float64, world space."""
    up: Floats = field(default_factory=lambda: np.array([0.0, 1.0, 0.0]))
    projection: str = "perspective"
    """``"perspective"`` or ``"orthographic"``."""
    field_of_view: float = pi / 4
    """Vertical opening angle in radians (perspective)."""
    view_height: float = 2.0
    """Height of the view volume in world units (orthographic)."""
    near: float = 0.1
    """Distance of the near plane; positive for perspective."""
    far: float = 100.0

    def __post_init__(self) -> None:
        for name in ("eye", "target", "up"):
            object.__setattr__(self, name, checked(f"camera {name}", getattr(self, name), (3,)))
        for name in ("field_of_view", "view_height", "near", "far"):
            if not isfinite(getattr(self, name)):
                raise ValueError(f"camera {name} must be finite, got {getattr(self, name)}")
        if self.projection not in ("perspective", "orthographic"):
            raise ValueError(f"camera projection must be perspective or orthographic, got {self.projection}")
        if self.projection == "perspective":
            if not 0 < self.field_of_view < pi:
                degrees = self.field_of_view * 180 / pi
                raise ValueError(f"field of view must be between 0 and 180 degrees, got {degrees:g}")
            if self.near <= 0:
                raise ValueError(f"near must be positive for a perspective camera, got {self.near:g}")
        elif self.view_height <= 0:
            raise ValueError(f"view height must be positive, got {self.view_height:g}")
        if self.near >= self.far:
            raise ValueError(f"near must be less than far, got near {self.near:g}, far {self.far:g}")
        forward = self.target - self.eye
        if not forward.any():
            raise ValueError("camera eye and target must differ")
        if np.linalg.norm(np.cross(forward, self.up)) <= 1e-12 * np.linalg.norm(forward) * np.linalg.norm(
            self.up
        ):
            raise ValueError("camera up must not be parallel to the viewing direction")


@dataclass(frozen=True, eq=False)
class DirectionalLight:
    """Light from infinitely far away."""

    direction: Floats
    """(3,) float64, world space, the way the light travels."""
    color: Floats = field(default_factory=lambda: np.ones(3))
    """(3,) float64, linear."""
    casts_shadow: bool = True
    """Whether it may be the light of its scene that casts shadows, see `Scene.casting_light`."""

    def __post_init__(self) -> None:
        object.__setattr__(self, "direction", checked("light direction", self.direction, (3,)))
        object.__setattr__(self, "color", checked("light color", self.color, (3,)))
        if not self.direction.any():
            raise ValueError("light direction must not be (0, 0, 0)")


@dataclass(frozen=True, eq=False)
class PointLight:
    """Light from one point, without attenuation."""

    position: Floats
    """(3,) float64, world space."""
    color: Floats = field(default_factory=lambda: np.ones(3))
    """(3,) float64, linear."""

    def __post_init__(self) -> None:
        object.__setattr__(self, "position", checked("light position", self.position, (3,)))
        object.__setattr__(self, "color", checked("light color", self.color, (3,)))


Light = DirectionalLight | PointLight


@dataclass(frozen=True, eq=False)
class Scene:
    """Everything that a picture needs, in world and object space."""

    meshes: tuple[Mesh, ...]
    camera: Camera
    lights: tuple[Light, ...] = ()
    size: tuple[int, int] = (512, 512)
    """(width, height) of the raster in pixels."""
    background: Floats = field(default_factory=lambda: np.zeros(4))
    """(4,) float64 linear colour that the frame is cleared to."""
    program: ShaderProgram | None = None
    """Its shaders, which replace matrices, light and textures; ``None``: the settings say how it is lit."""
    motion: Motion | None = None
    """What moves from picture to picture; this is the last one."""
    corner_count: ClassVar[int] = 3
    """How many corners a primitive has."""

    makes_positions: bool = field(init=False)
    """Whether positions are made before the matrices are applied, see `core.stages.before_matrices`."""

    def __post_init__(self) -> None:
        if isinstance(self.meshes, Mesh):
            raise ValueError("meshes must be a sequence of meshes, got one mesh")
        object.__setattr__(self, "meshes", tuple(self.meshes))
        object.__setattr__(self, "lights", tuple(self.lights))
        if not self.meshes:
            raise ValueError("a scene needs at least one mesh")
        object.__setattr__(self, "makes_positions", any(mesh.makes_positions for mesh in self.meshes))
        object.__setattr__(self, "size", checked_size("size", self.size, SIZE_LIMIT))
        object.__setattr__(self, "background", checked("background", self.background, (4,)))

    @property
    def casting_light(self) -> int:
        """Number of the light that casts shadows: the first directional one that may; -1: none does."""
        casts = (isinstance(light, DirectionalLight) and light.casts_shadow for light in self.lights)
        return next((number for number, is_so in enumerate(casts) if is_so), -1)


CORNER_COUNTS = {"points": 1, "segments": 2, "triangles": 3, "fragments": 0}
"""Kinds of primitives and how many corners each has; `core.transform.assembly` makes them from strips, fans and quads.

``polygons`` have any number of corners from `POLYGON_CORNERS` on, in rings. Fragments have a place and a depth, but no
corner: they enter the pipeline at the depth test (`core.depth.whole_depths`).
"""
KINDS = (*CORNER_COUNTS, "polygons")
POLYGON_CORNERS = (4, 1000)
"""Least and greatest number of corners of a polygon; one of three is a triangle."""


@dataclass(frozen=True, eq=False)
class ClipScene:
    """Triangles, segments, points or polygons given in clip space. Drawn and stepped like any scene.

    Segments and points have no area: they are drawn as lines by the method of the family ``line``. The pixel of a
    segment's second end is drawn unless another segment begins at a corner of the same name.

    Polygons may be concave, have holes and cross themselves: a method of the family ``polygon_fill`` says what is
    inside. Each has the colour of its corner 0, and lies in the plane of three of its corners. A ring
    whose corners lie on one line encloses nothing and draws nothing.
    """

    program: ClassVar[None] = None
    """What is given in clip space runs no shaders."""
    clip: Floats
    """(T, 3, 4) float64 clip-space x, y, z, w of every corner; (T, 2, 4) of segments, (T, 1, 4) of points and
    fragments, (T, C, 4) of polygons with C corners each, all w above 0."""
    attributes: Floats | None = None
    """(T, 3, K) float64 to interpolate; the first four are the colour, or the first two the texture coordinates."""
    size: tuple[int, int] = (512, 512)
    texture: Texture | None = None
    background: Floats = field(default_factory=lambda: np.zeros(4))
    shared: Integers | None = None
    """(T, 3) int64 names of corners: corners of one name move together in the window. ``None``: all separate."""
    kind: str = "triangles"
    """One of `KINDS`."""
    clip_region: Floats | None = None
    """Left, bottom, right, top (4,), or the corners (M, 2) of a convex polygon, counter-clockwise, in NDC float64.

    What methods of the families ``line_clipping`` and ``polygon_clipping`` clip to; ``None``: the raster. What
    polygons are clipped to may be any polygon, with holes.
    """
    rings: Integers | None = None
    """(R,) int64, first corner of each ring of a polygon, rising from 0: outline, then holes. ``None``: one ring."""
    region_rings: Integers | None = None
    """(R,) int64, the same of ``clip_region``."""
    motion: Motion | None = None
    """What moves from picture to picture; this is the last one."""
    table: DepthTable | None = None
    """What fragments are made from (`core.depth.whole_depths.table_scene`); ``None`` of all other kinds."""
    curves: Curves | None = None
    """Curves of which the segments are made anew as the settings say (`core.tessellation`); ``None``: none."""
    corner_count: int = field(init=False)
    """How many corners a primitive has."""

    makes_positions: bool = field(init=False)
    """Whether segments are made of curves before anything else, see `core.stages.before_matrices`."""

    def __post_init__(self) -> None:
        if self.kind not in KINDS:
            raise ValueError(f"kind must be one of {', '.join(KINDS)}, got {self.kind}")
        if (self.kind == "fragments") != (self.table is not None):
            raise ValueError("a scene of the kind fragments, and no other, needs a table of depths")
        corners = CORNER_COUNTS.get(self.kind, "C") or 1
        clip = checked("clip", self.clip, ("T", corners, 4), limit=COORDINATE_LIMIT)
        corners = clip.shape[1]
        object.__setattr__(self, "corner_count", CORNER_COUNTS.get(self.kind, corners))
        object.__setattr__(self, "clip", clip)
        if self.attributes is None:
            color = np.broadcast_to(np.array([0.0, 0.0, 0.0, 1.0]), (len(clip), corners, 4))
            object.__setattr__(self, "attributes", checked("attributes", color, ("T", corners, "K")))
        else:
            attributes = checked("attributes", self.attributes, ("T", corners, "K"))
            if len(attributes) != len(clip):
                raise ValueError(f"attributes must be ({len(clip)}, {corners}, K), got {attributes.shape}")
            if self.texture is not None and attributes.shape[2] < 2:
                raise ValueError(
                    f"a texture needs attributes (T, {corners}, 2 or more), got {attributes.shape}"
                )
            object.__setattr__(self, "attributes", attributes)
        if self.shared is not None:
            shared = checked("shared", self.shared, ("T", corners), np.int64)
            if len(shared) != len(clip):
                raise ValueError(f"shared must be ({len(clip)}, {corners}), got {shared.shape}")
            object.__setattr__(self, "shared", shared)
        object.__setattr__(self, "size", checked_size("size", self.size, SIZE_LIMIT))
        object.__setattr__(self, "background", checked("background", self.background, (4,)))
        object.__setattr__(self, "makes_positions", self.curves is not None)
        if self.curves is not None and self.kind != "segments":
            raise ValueError(f"only segments are made of curves, got {self.kind}")
        if self.kind == "polygons":
            self._check_polygons()
        elif self.rings is not None or self.region_rings is not None:
            raise ValueError(f"only polygons have rings, got rings of {self.kind}")
        elif self.clip_region is not None:
            object.__setattr__(self, "clip_region", checked_region(self.clip_region, self.size))

    @cached_property
    def numbers(self) -> Integers:
        """(T,) int64, the number that each primitive goes by: of fragments that of their patch."""
        own = np.arange(len(self.clip)) if self.table is None or self.shared is None else self.shared[:, 0]
        return read_only(own)

    def _check_polygons(self) -> None:
        """Refuse polygons without a place in the window, and rings that are none."""
        least, most = POLYGON_CORNERS
        if not least <= self.corner_count <= most:
            raise ValueError(
                f"a polygon must have {least} to {most} corners (three are a triangle), got {self.corner_count}"
            )
        if self.texture is not None:
            raise ValueError("a polygon has one colour and takes no texture")
        with np.errstate(divide="ignore", invalid="ignore", over="ignore"):
            reach = np.abs(self.clip[..., :2] / self.clip[..., 3:])
        if not (self.clip[..., 3] > 0).all():
            raise ValueError("a polygon needs all w above 0: other corners have no place in the window")
        if not (reach <= POLYGON_REACH).all():
            raise ValueError(
                f"a polygon's corners must lie within {POLYGON_REACH} times half the raster from its middle, "
                f"got {float(reach.max()):g}"
            )
        object.__setattr__(self, "rings", checked_rings("rings", self.rings, self.corner_count))
        if self.clip_region is None:
            if self.region_rings is not None:
                raise ValueError("region_rings need a clip_region")
            return
        region = checked_polygon_region(self.clip_region)
        object.__setattr__(self, "clip_region", region)
        if region.ndim == 1 and self.region_rings is not None:
            raise ValueError("a rectangle has no region_rings")
        if region.ndim == 2:
            object.__setattr__(
                self, "region_rings", checked_rings("region_rings", self.region_rings, len(region))
            )


AnyScene = Scene | ClipScene
