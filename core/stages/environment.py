"""Mirrors of a scene: what each sees around it, in six pictures that are drawn first, or by rays.

Every mirror has a map of its own, drawn from its own middle. It is left out there: from inside it would hide all else.
"""

from collections.abc import Iterator, Sequence
from functools import lru_cache, partial
from importlib import import_module

import numpy as np

from core.families import mirrors_of
from core.records.arrays import Floats, Integers, read_only
from core.records.passes import PlannedPass
from core.resolved import resolve
from core.scene import Camera, Light, Mesh, Scene, Texture
from core.settings import Settings
from core.shading.environment import FACES, Mirrored, Surroundings
from core.shading.lighting import dot, planes, unit_directions
from core.shading.shading import outward_normals, shade
from core.stages.before_matrices import still
from core.stages.fragment_color import albedo_of
from core.stages.vertex_light import given_values, light, side_by_side, viewpoint
from core.transform.vertex_stage import place_meshes

UPS = ((0, 1, 0), (0, 1, 0), (0, 0, 1), (0, 0, -1), (0, 1, 0), (0, 1, 0))
"""By face, the direction that is up in its picture, see ``core.shading.environment.ABOVE``."""
NEAR = 2.0**-12
"""Of the distance of the farthest corner, that of the near plane of a map."""
OWN_SURFACE = 1e-9
"""Of the scene's largest side, how near a triangle must be to be the surface that a ray leaves."""


def mirror_looks(
    scene: Scene, settings: Settings, mesh: Integers, position: Floats, normal: Floats
) -> Iterator[tuple[Integers, Mirrored]]:
    """Yield which of F fragments are of a mirror, (C,), and what they show; one mirror after the other.

    Parameters
    ----------
    mesh : (F,) int64
    position, normal : (F, 3) float64 in world space, normals of any length
    """
    method = resolve(settings).environment
    for number in mirrors_of(scene) if method is not None else ():
        chosen = np.flatnonzero(mesh == number)
        if len(chosen) and method is not None:
            at = position[chosen]
            directions = unit_directions(at, normal[chosen], viewpoint(scene.camera, at))
            yield chosen, method.function(at, *directions, surroundings(scene, settings, number))


def surroundings(scene: Scene, settings: Settings, number: int) -> Surroundings:
    """Return what is around mesh ``number``: its map, or the triangles that rays are cast at."""
    method = resolve(settings).environment
    assert method is not None
    faces: tuple[Texture, ...] = ()
    triangles, least = np.empty((0, 3, 3)), 0.0
    if method.traits == "map":
        faces = drawn_faces(environment_passes(scene, settings, number))
    else:
        world = place_meshes(scene.meshes)
        places = world.world[:, :3]
        triangles, least = places[world.corners], OWN_SURFACE * float(np.ptp(places, axis=0).max())
    return Surroundings(faces, triangles, least, partial(_seen_colors, scene, settings), scene.background[:3])


def _pass_settings(settings: Settings) -> Settings:
    """Return what a map is drawn with, and what rays see: no pass of its own, and textures without mipmaps."""
    return Settings(wrap=settings.wrap)


def environment_passes(scene: Scene, settings: Settings, number: int) -> tuple[PlannedPass, ...]:
    """Return the six pictures around mesh ``number``: all others as its middle sees them."""
    background = tuple(scene.background.tolist())
    return _passes(
        scene.meshes, number, scene.lights, background, settings.environment_size, _pass_settings(settings)
    )


@lru_cache(maxsize=16)
def _passes(
    meshes: tuple[Mesh, ...],
    number: int,
    lights: tuple[Light, ...],
    background: Sequence[float],
    size: int,
    settings: Settings,
) -> tuple[PlannedPass, ...]:
    others = tuple(still(mesh) for place, mesh in enumerate(meshes) if place != number)
    own = place_meshes((meshes[number],)).world[:, :3]
    middle = (own.min(axis=0) + own.max(axis=0)) / 2
    away = float(np.abs(place_meshes(others).world[:, :3] - middle).max()) or 1.0
    far = 2 * away  # The corner of a cube of this half side is sqrt(3) away.
    ahead = max(far, float(np.abs(middle).max()))
    found = []
    for face, title in enumerate(FACES):
        forward = np.zeros(3)
        forward[face // 2] = -ahead if face % 2 else ahead
        up = np.array(UPS[face], float)
        camera = Camera(middle, middle + forward, up, field_of_view=np.pi / 2, near=NEAR * far, far=far)
        of_face = Scene(others, camera, lights, (size, size), np.array(background))
        name = f"What {meshes[number].name} sees along {title}"
        found.append(PlannedPass("environment", name, of_face, settings))
    return tuple(found)


@lru_cache(maxsize=4)
def drawn_faces(planned: tuple[PlannedPass, ...]) -> tuple[Texture, ...]:
    """Return the six pictures as textures of linear colour (M, M, 3)."""
    render = import_module("core.pipeline").render  # By its name: drawing asks for passes.
    pictures = (render(each.scene, each.settings).color for each in planned)
    return tuple(
        Texture(read_only(color[..., :3]), each.title) for color, each in zip(pictures, planned, strict=True)
    )


def _seen_colors(
    scene: Scene, settings: Settings, triangle: Integers, weights: Floats, origin: Floats
) -> Floats:
    """Return the colours (F, 3) of triangles (F,) at weights of their corners (F, 3), lit as seen from (F, 3)."""
    world = place_meshes(scene.meshes)
    vertex, places = world.corners[triangle], world.world[:, :3]
    parts = given_values(scene.meshes, vertex)
    parts |= {"position": places[vertex], "normal": world.normals[vertex]}
    corners, layout = side_by_side(parts)
    first, second, third = (corners[:, k] * weights[:, k, None] for k in range(3))
    values = first + second + third
    outward = outward_normals(places, world.normals, vertex)
    position = values[:, layout["position"]]
    behind = dot(planes(outward), planes(origin - position)) < 0
    normal = np.where(behind[:, None], -values[:, layout["normal"]], values[:, layout["normal"]])
    mesh, plain = world.mesh[triangle], _pass_settings(settings)
    albedo = albedo_of(scene, plain, layout, mesh, values)
    return shade(albedo, *light(scene, plain.shading, mesh, position, normal, eye=origin))[:, :3]
