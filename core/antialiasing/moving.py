"""A scene some pictures ago, and where what a pixel shows was in the picture before."""

from dataclasses import replace

import numpy as np

from core.records.arrays import Floats
from core.records.motion import Way
from core.scene import AnyScene, Camera, ClipScene, Scene
from core.transform.matrices import projection, world_to_camera


def scene_before(scene: AnyScene, age: int) -> AnyScene:
    """Return a scene as it was ``age`` pictures ago; the very same where nothing moves."""
    motion = scene.motion
    if age == 0 or motion is None:
        return scene
    if isinstance(scene, ClipScene):
        clip = scene.clip.copy()
        for number, way in motion.objects:
            if number < len(clip):
                clip[number, :, :3] -= age * np.array(way) * clip[number, :, 3:]
        return replace(scene, clip=clip)
    meshes = list(scene.meshes)
    for number, way in motion.objects:
        if number < len(meshes):
            transform = meshes[number].transform.copy()
            transform[:3, 3] -= age * np.array(way)
            meshes[number] = replace(meshes[number], transform=transform)
    return replace(scene, meshes=tuple(meshes), camera=camera_before(scene.camera, motion.camera, age))


def camera_before(camera: Camera, way: Way, age: int) -> Camera:
    """Return a camera as it was ``age`` pictures ago: eye and target move together."""
    if not any(way):
        return camera
    moved = age * np.array(way)
    return replace(camera, eye=camera.eye - moved, target=camera.target - moved)


def moves_camera(scene: AnyScene) -> bool:
    """Return whether the camera moves between pictures."""
    return isinstance(scene, Scene) and scene.motion is not None and any(scene.motion.camera)


def place_before(scene: Scene, age: int, x: Floats, y: Floats, depth: Floats) -> tuple[Floats, Floats]:
    """Return where points were seen in the picture before that of ``age``, x and y (...) float64, in the window.

    Parameters
    ----------
    x, y, depth : (...) float64
        Window positions and depths in the picture of ``age``.

    Notes
    -----
    The depth tells where in the world a point lies, and so where the camera before saw it: right where only the camera
    moves. NaN behind that camera.
    """
    assert scene.motion is not None
    (width, height), way = scene.size, scene.motion.camera
    lens = projection(scene.camera, width / height)
    now, before = (lens @ world_to_camera(camera_before(scene.camera, way, turn)) for turn in (age, age + 1))
    ndc = np.stack([2 * x / width - 1, 2 * y / height - 1, 2 * depth - 1, np.ones_like(x)])
    world = np.tensordot(np.linalg.inv(now), ndc, 1)
    clip = np.tensordot(before, world / world[3], 1)
    with np.errstate(divide="ignore", invalid="ignore"):
        w = np.where(clip[3] > 0, clip[3], np.nan)
        return (clip[0] / w + 1) / 2 * width, (clip[1] / w + 1) / 2 * height
