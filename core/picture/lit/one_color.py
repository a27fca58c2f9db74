"""Phong's shading of one colour: what it needs of a pixel is a direction (``normals``).

The direction to the eye follows from the pixel alone. Then the lighting rule is evaluated in float32 (``pixel_light``),
and linear light becomes bytes through a table.

Used where the bytes stay within `TOLERANCE` of those of ``render`` before both are rounded: see ``light_errors``.
"""

from dataclasses import dataclass
from typing import ClassVar

from core.arrays import Integers
from core.framebuffer.nearest import NearestFragments
from core.picture.job import Job
from core.picture.lit.corner_places import CornerPlaces, corner_places
from core.picture.lit.light_errors import light_error, normal_error
from core.picture.lit.light_visible import LitPlanes
from core.picture.lit.normals import normal_planes
from core.picture.lit.pixel_light import PixelLight, pixel_light
from core.picture.lit.planes import corner_w
from core.picture.lit.vertex_facts import Color, VertexFacts, vertex_facts
from core.picture.record import Coloring
from core.scene import DirectionalLight, Scene

TOLERANCE = 1.0
"""Bytes that a colour may be away from the exact one before both are rounded."""


@dataclass(frozen=True, eq=False)
class LitNormals:
    """Normals of P triangles of one colour, and what lights them."""

    planes: LitPlanes
    albedo: Color
    """Linear grey, or red, green and blue, of everything."""
    name: ClassVar[Coloring] = "normals"
    stage = "shade"
    for_layer: ClassVar[None] = None
    """None: they light what is seen once it is known, so a picture has its depth first."""

    def look_up(self, job: Job, nearest: NearestFragments) -> int:
        """Write the lit colour of what is seen at every pixel, and return how many there are; the others stay."""
        return self.planes.light_visible(job, nearest, self._albedo)

    def _albedo(self, primitive: Integers, column: Integers, row: Integers) -> Color:
        """Return the colour, which is that of all primitives (F,) at all pixels."""
        return self.albedo


def lit_normals(job: Job) -> LitNormals | None:
    """Return the lit normals of all primitives, or ``None`` where some pixel could be off by more than the tolerance.

    The scene is one mesh of one colour without a texture, lit from far away, all of it in front of the eye.
    """
    mesh = None if job.has_texture else lit_mesh(job)
    planes = lit_planes(job, mesh, corner_places(job.geometry)) if mesh else None
    return LitNormals(planes, mesh.color) if mesh and planes else None


@dataclass(frozen=True, eq=False)
class LitMesh:
    """A mesh whose pixels differ in nothing but their normals, and maybe in what a texture shows there."""

    scene: Scene
    light: PixelLight
    facts: VertexFacts
    color: Color
    """Linear grey, or red, green and blue, of all vertices."""


def lit_mesh(job: Job) -> LitMesh | None:
    """Return the one mesh of a scene, or ``None`` where something else differs from pixel to pixel.

    It is opaque, of one colour, shaded by Phong's method, lit from far away, all of it in front of the eye.
    """
    scene, geometry, settings = job.scene, job.geometry, job.settings
    if not isinstance(scene, Scene) or settings.shading != "phong" or len(scene.meshes) != 1:
        return None
    if settings.interpolation != "perspective" or not geometry.is_projected.all():
        return None
    light = pixel_light(scene)
    facts = vertex_facts(geometry.primitives.values, scene.meshes[0])
    if light is None or facts.color is None:
        return None
    return LitMesh(scene, light, facts, facts.color)


def lit_planes(job: Job, mesh: LitMesh, places: CornerPlaces, texture_error: float = 0.0) -> LitPlanes | None:
    """Return the normals of all primitives, or ``None`` where some pixel could be off by more than the tolerance.

    Parameters
    ----------
    texture_error : float
        Bytes that what the light is multiplied with may be off.
    """
    lights = [light for light in mesh.scene.lights if isinstance(light, DirectionalLight)]
    w = corner_w(job.geometry)
    turn, brightest = normal_error(places, w), float(max(mesh.color))
    error = light_error(turn, mesh.light.material, lights, brightest, job.encoding) + texture_error
    if not error <= TOLERANCE:
        return None
    found = normal_planes(job, mesh.light.camera, mesh.facts, w, places)
    if found is None:
        return None
    normals, is_unlike = found
    return LitPlanes(normals, mesh.light, turn, places.is_thin | is_unlike)
