"""Which passes a scene needs, drawn and kept: scenes never change, so neither do their passes."""

from dataclasses import replace
from functools import lru_cache
from importlib import import_module

import numpy as np

from core.depth.early_depth import LEFT
from core.families import mirrors_of
from core.numeric.large_arrays import ScratchBuffers
from core.records.arrays import Floats, read_only
from core.records.passes import PlannedPass, without_passes
from core.resolved import resolve
from core.scene import AnyScene, Camera, DirectionalLight, Mesh, Scene
from core.settings import Settings, no_effect
from core.shading.shadow_rays import RayHits
from core.shading.shadows import BIAS_STEPS, Lamp, MapTests
from core.stages.before_matrices import before_matrices, still
from core.stages.environment import environment_passes
from core.transform.matrices import camera_axes, projection, viewport, world_to_camera
from core.transform.vertex_stage import place_meshes

ROOM = 1 / 16
"""Room before and behind the scene in the depth of a map, of its largest side."""


def planned_passes(scene: AnyScene, settings: Settings) -> tuple[PlannedPass, ...]:
    """Return what is drawn before the picture, in this order; empty for most scenes."""
    if scene.program is not None:
        return ()
    scene = before_matrices(scene, settings)
    found, shadow = [], resolve(settings).shadow
    if (
        isinstance(scene, Scene)
        and shadow is not None
        and shadow.traits == "map"
        and scene.casting_light >= 0
    ):
        light = scene.lights[scene.casting_light]
        assert isinstance(light, DirectionalLight)
        found.append(shadow_pass(scene.meshes, light, scene.casting_light, settings.map_size))
    environment = resolve(settings).environment
    if isinstance(scene, Scene) and environment is not None and environment.traits == "map":
        for number in mirrors_of(scene):
            found += environment_passes(scene, settings, number)
    if resolve(settings).shades == LEFT:
        plain = replace(without_passes(settings), shading="unlit")
        found.append(PlannedPass("prepass", "Depth alone", scene, plain))
    if hides(scene, settings):
        from core.stages.occluders import choose_occluders  # Only culling behind occluders waits for it.

        made = before_matrices(scene, settings)
        assert isinstance(made, Scene)
        chosen = choose_occluders(made, resolve(settings).settings)
        found += [chosen.planned] if chosen.planned is not None else []
    return tuple(found)


def hides(scene: AnyScene, settings: Settings) -> bool:
    """Return whether boxes of a scene are compared with occluders."""
    is_chosen = resolve(settings).method("object_culling").traits == "occlusion"
    return is_chosen and not no_effect(settings, "object_culling", scene)


def shadow_tests(scene: Scene, settings: Settings, position: Floats) -> MapTests | RayHits | None:
    """Find what arrives of the light that casts shadows at points (F, 3) in world space; ``None``: none does."""
    shadow = resolve(settings).shadow
    if shadow is None or scene.casting_light < 0:
        return None
    found: MapTests | RayHits = shadow.function(position, lamp_of(scene, settings))
    return found


def lamp_of(scene: Scene, settings: Settings) -> Lamp:
    """Return the light that casts shadows, with what the chosen method asks of it."""
    shadow, number = resolve(settings).shadow, scene.casting_light
    assert shadow is not None
    light, looks = scene.lights[number], shadow.traits == "map"
    assert isinstance(light, DirectionalLight)
    planned = shadow_pass(scene.meshes, light, number, settings.map_size if looks else 1)
    camera = map_camera(planned)
    in_texels = camera.view_height / planned.scene.size[0] / (camera.far - camera.near)
    return Lamp(
        number,
        map_matrix(planned),
        drawn_depth(planned) if looks else None,
        settings.shadow_bias / BIAS_STEPS * in_texels,
        None if looks else triangles_in_map(planned),
    )


@lru_cache(maxsize=8)
def shadow_pass(meshes: tuple[Mesh, ...], light: DirectionalLight, number: int, size: int) -> PlannedPass:
    """Return the pass of a shadow map: the meshes as light ``number`` sees them, on ``size`` times ``size`` texels.

    Half a texel is left free around them.
    """
    sides = Scene(tuple(map(still, meshes)), light_camera(meshes, light, size), (), (size, size))
    return PlannedPass("shadow-map", f"What light {number} sees", sides, Settings(shading="unlit"))


def light_camera(meshes: tuple[Mesh, ...], light: DirectionalLight, size: int) -> Camera:
    """Return the orthographic camera that looks along a light and sees all of the meshes."""
    unit = light.direction / np.abs(light.direction).max()
    unit /= np.linalg.norm(unit)
    up = np.array([0.0, 0.0, -1.0] if abs(unit[1]) > 0.99 else [0.0, 1.0, 0.0])
    axes = camera_axes(Camera(np.zeros(3), unit, up))
    world = place_meshes(meshes).world[:, :3]
    across = np.stack([world @ axis for axis in axes], axis=1)
    low, high = across.min(axis=0), across.max(axis=0)
    largest = float((high - low).max()) or 1.0
    middle = (low + high) / 2
    room = largest * ROOM
    eye = axes[0] * middle[0] + axes[1] * middle[1] + axes[2] * (high[2] + room)
    far = float(high[2] - low[2]) + 1.5 * room
    side = float((high - low)[:2].max()) * (1 + 1 / size) or room
    return Camera(eye, eye + unit * far, up, "orthographic", view_height=side, near=room / 2, far=far)


def map_camera(planned: PlannedPass) -> Camera:
    """Return the camera of a pass of meshes."""
    assert isinstance(planned.scene, Scene)
    return planned.scene.camera


@lru_cache(maxsize=8)
def map_matrix(planned: PlannedPass) -> Floats:
    """Return the (3, 4) matrix from world space to column, row and depth of a pass of an orthographic camera."""
    camera, (width, height) = map_camera(planned), planned.scene.size
    whole = viewport(width, height) @ projection(camera, width / height) @ world_to_camera(camera)
    return read_only(whole[:3])


@lru_cache(maxsize=4)
def drawn_depth(planned: PlannedPass) -> Floats:
    """Return the depth (H, W) float64 that a pass leaves."""
    # By its name: drawing asks for passes, in the midst of a picture that works in the memory of the thread.
    draw_picture = import_module("core.fast_path.draw").draw_picture
    picture = draw_picture(planned.scene, planned.settings, with_depth=True, scratch=ScratchBuffers())
    return read_only(picture.depth.astype(np.float64))


@lru_cache(maxsize=4)
def triangles_in_map(planned: PlannedPass) -> Floats:
    """Return the corners (T, 3, 3) of all triangles in the space of a pass of an orthographic camera."""
    assert isinstance(planned.scene, Scene)
    world, matrix = place_meshes(planned.scene.meshes), map_matrix(planned)
    places = world.world[:, :3] @ matrix[:, :3].T + matrix[:, 3]
    return read_only(places[world.corners])
