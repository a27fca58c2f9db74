"""Edits of a scene, each to a new one or with what is wrong; and a digest by which its shapes are known again."""

from collections.abc import Mapping
from dataclasses import replace
from hashlib import sha256
from math import radians

import numpy as np

from core.families import has_curves
from core.records.arrays import Floats
from core.records.clip_region import region_in_window, region_of_window
from core.records.deformations import Blend, Skin
from core.records.motion import Motion
from core.scene import AnyScene, Camera, ClipScene, DirectionalLight, Light, Mesh, Scene
from core.transform.vertex_stage import transform_vertices

# Edits of a scene: each takes a frozen scene and returns the edited one, or says what was wrong.


WINDOW_NAMES = ("x", "y", "depth", "w")
BORDERS = ("left", "bottom", "right", "top")


def window_of_clip(clip: Floats, size: tuple[int, int]) -> Floats:
    """Return x, y, depth, w (..., 4) of clip positions (..., 4); NaN where w = 0."""
    width, height = size
    w = clip[..., 3]
    with np.errstate(divide="ignore", invalid="ignore"):
        x, y, z = (clip[..., k] / w for k in range(3))
    window = np.stack([(x + 1) * width / 2, (y + 1) * height / 2, (z + 1) / 2, w], axis=-1)
    window[w == 0, :3] = np.nan
    return window


def clip_of_window(window: Floats, size: tuple[int, int]) -> Floats:
    """Return clip positions (..., 4) of x, y, depth, w (..., 4)."""
    width, height = size
    x, y, depth, w = (window[..., k] for k in range(4))
    return np.stack([(2 * x / width - 1) * w, (2 * y / height - 1) * w, (2 * depth - 1) * w, w], axis=-1)


def move_corner(
    scene: AnyScene, triangle: int, corner: int, position: tuple[float, float], size: tuple[int, int]
) -> AnyScene:
    """Move a corner to a window position; its depth and w stay, and corners that are shared move along.

    Parameters
    ----------
    position : (x, y)
        Window position in pixels of a raster of ``size`` (width, height).

    Raises
    ------
    ValueError
        If the corner is not in front of the eye: such a corner has no window position. If a vertex shader places it.
    """
    x, y = position
    check_not_made(scene)
    if isinstance(scene, ClipScene):
        window = window_of_clip(scene.clip[triangle, corner], size)
        window[:2] = x, y
        return set_clip_corner(scene, triangle, corner, clip_of_window(window, size))
    if scene.program is not None:
        raise ValueError(
            "the vertex shader places this corner: change the shader, or the vertex in the Scene pane"
        )
    vertices = transform_vertices(replace(scene, size=size))
    vertex = int(vertices.corners[triangle, corner])
    clip = vertices.clip[vertex]
    if clip[3] <= 0:
        raise ValueError("a corner behind the eye cannot be dragged in the window")
    window = window_of_clip(clip, size)
    window[:2] = x, y
    mesh_index, local = _mesh_of_vertex(scene, vertex)
    assert vertices.projection is not None
    assert vertices.view is not None
    matrix = vertices.projection @ vertices.view @ scene.meshes[mesh_index].transform
    target = np.linalg.solve(matrix, clip_of_window(window, size))
    positions = scene.meshes[mesh_index].positions.copy()
    positions[local] = target[:3] / target[3]
    return _with_mesh(scene, mesh_index, replace(scene.meshes[mesh_index], positions=positions))


def check_not_made(scene: AnyScene) -> None:
    """Refuse to move a vertex that is a point of a curve or patch, or that a deformation places: ValueError."""
    if has_curves(scene):
        raise ValueError("this vertex is a point of a curve or patch, which its control points make")
    if scene.makes_positions:
        raise ValueError(
            "bones or shapes place this vertex: change their angles or weights in the Scene pane"
        )


def set_clip_corner(scene: ClipScene, triangle: int, corner: int, clip: Floats) -> ClipScene:
    """Put a corner, and those that share its place, at a clip position (4,)."""
    check_not_made(scene)
    corners = scene.clip.copy()
    if scene.shared is None:
        corners[triangle, corner] = clip
    else:
        corners[scene.shared == scene.shared[triangle, corner]] = clip
    return replace(scene, clip=corners)


def split_shared(scene: AnyScene) -> AnyScene:
    """Return the scene with every corner moving by itself."""
    return replace(scene, shared=None) if isinstance(scene, ClipScene) else scene


def join_shared(scene: AnyScene) -> AnyScene:
    """Return the scene with corners at the same clip position moving together."""
    if not isinstance(scene, ClipScene):
        return scene
    _, names = np.unique(scene.clip.reshape(-1, 4), axis=0, return_inverse=True)
    return replace(scene, shared=names.reshape(-1, scene.corner_count))


def set_value(scene: AnyScene, path: str, value: float, size: tuple[int, int]) -> AnyScene:
    """Return the scene with the value at ``path`` of its outline replaced.

    Raises ValueError if the scene would not be valid.
    """
    kind, *names = path.split("/")
    if kind == "motion":
        return replace(scene, motion=_with_way(scene.motion, names[0], "xyz".index(names[1]), value))
    if isinstance(scene, ClipScene) and kind == "clip-window":
        return _set_clip_window(scene, {path: value}, size)
    if isinstance(scene, ClipScene):
        triangle, corner, name = int(names[0]), int(names[1]), names[2]
        held = scene.clip if scene.curves is None else scene.curves.control
        window = window_of_clip(held[triangle, corner], size)
        window[WINDOW_NAMES.index(name)] = value
        if window[3] == 0 or not np.isfinite(window).all():
            raise ValueError("w must not be 0: such a corner has no place in the window")
        moved = clip_of_window(window, size)
        if scene.curves is not None:
            control = scene.curves.control.copy()
            control[triangle, corner] = moved
            return replace(scene, curves=replace(scene.curves, control=control))
        return set_clip_corner(scene, triangle, corner, moved)
    if kind == "camera":
        return replace(scene, camera=_set_camera(scene.camera, names, value))
    if kind == "light":
        lights, index = list(scene.lights), int(names[0])
        lights[index] = _with_light_value(lights[index], names[1], names[2], value)
        return replace(scene, lights=tuple(lights))
    index, name = int(names[0]), names[-1]
    mesh = scene.meshes[index]
    if kind in ("bone", "shape"):
        return _with_mesh(scene, index, _with_deformation(mesh, int(names[1]), value))
    return _with_mesh(scene, index, replace(mesh, material=replace(mesh.material, **{name: value})))


def _with_light_value(light: Light, row: str, name: str, value: float) -> Light:
    """Return a light with a number of a vector replaced, or with whether it may cast shadows."""
    if isinstance(light, DirectionalLight) and name == "casts_shadow":
        return replace(light, casts_shadow=bool(value))
    vector = np.array(getattr(light, row))
    vector["xyzrgb".index(name) % 3] = value
    return replace(light, **{row: vector})  # type: ignore[arg-type]


def _with_way(motion: Motion | None, what: str, axis: int, value: float) -> Motion | None:
    """Return a motion with a number of the way of the camera, or of an object, replaced; ``None``: nothing moves."""
    held = motion or Motion()
    ways = dict(held.objects)
    way = list(held.camera if what == "camera" else ways.get(int(what), (0.0, 0.0, 0.0)))
    way[axis] = value
    x, y, z = way
    if what == "camera":
        found = Motion((x, y, z), held.objects)
    else:
        ways[int(what)] = (x, y, z)
        found = Motion(held.camera, tuple(sorted((number, way) for number, way in ways.items() if any(way))))
    return None if found.is_rest else found


def set_values(scene: AnyScene, values: Mapping[str, float], size: tuple[int, int]) -> AnyScene:
    """Return the scene with several values replaced, the borders of a clip window together."""
    of_window = {path: value for path, value in values.items() if path.startswith("clip-window/")}
    for path in values.keys() - of_window.keys():
        scene = set_value(scene, path, values[path], size)
    if of_window and isinstance(scene, ClipScene):
        return _set_clip_window(scene, of_window, size)
    return scene


def _set_clip_window(scene: ClipScene, values: Mapping[str, float], size: tuple[int, int]) -> ClipScene:
    """Return the scene with numbers of its clip window, by their paths, replaced; the raster itself is none."""
    window = clip_window(scene, size)
    for path, value in values.items():
        _, row, name = path.split("/")
        place = BORDERS.index(name) if window.ndim == 1 else (int(row), "xy".index(name))
        window[place] = value
    is_raster = np.array_equal(window, (0, 0, *size))
    return replace(scene, clip_region=None if is_raster else region_of_window(window, size))


def clip_window(scene: ClipScene, size: tuple[int, int]) -> Floats:
    """Return left, bottom, right, top (4,), or corners (M, 2), in pixels."""
    if scene.clip_region is None:
        return np.array([0.0, 0.0, *size])
    return region_in_window(scene.clip_region, size)


def _set_camera(camera: Camera, names: list[str], value: float) -> Camera:
    if names[0] in ("eye", "target", "up"):
        vector = getattr(camera, names[0]).copy()
        vector["xyz".index(names[1])] = value
        return replace(camera, **{names[0]: vector})
    if names[-1] == "field_of_view":
        return replace(camera, field_of_view=radians(value))
    return replace(camera, **{names[-1]: value})  # type: ignore[arg-type]


def _with_deformation(mesh: Mesh, number: int, value: float) -> Mesh:
    """Return a mesh with the angle of a bone, in degrees, or the weight of a shape replaced."""
    held = mesh.deformation
    if isinstance(held, Skin):
        angles = held.angles.copy()
        angles[number] = radians(value)
        return replace(mesh, deformation=replace(held, angles=angles))
    assert isinstance(held, Blend)
    weights = held.weights.copy()
    weights[number] = value
    return replace(mesh, deformation=replace(held, weights=weights))


def _mesh_of_vertex(scene: Scene, vertex: int) -> tuple[int, int]:
    """Return which mesh a vertex of the whole scene belongs to, and its number there."""
    for index, mesh in enumerate(scene.meshes):
        if vertex < len(mesh.positions):
            return index, vertex
        vertex -= len(mesh.positions)
    raise ValueError(f"the scene has no vertex {vertex}")


def _with_mesh(scene: Scene, index: int, mesh: Mesh) -> Scene:
    meshes = list(scene.meshes)
    meshes[index] = mesh
    return replace(scene, meshes=tuple(meshes))


# A short text for the shapes of a scene: by it the open scene is known as the one that is asked about.


def scene_digest(scene: AnyScene) -> str:
    """Return a text that two scenes have in common which show the same shapes, whatever their rasters and colours."""
    if isinstance(scene, ClipScene):
        shapes = scene.clip if scene.curves is None else scene.curves.control
        parts = [scene.kind, shapes, scene.rings, scene.clip_region]
        if scene.table is not None:
            # A table's fragments have a place; their depths are in the table.
            parts += [scene.table.depths, scene.table.test]
    else:
        parts = [*vars(scene.camera).values(), *(mesh.positions for mesh in scene.meshes)]
    digest = sha256()
    for part in parts:
        digest.update(part.encode() if isinstance(part, str) else np.asarray(part, float).tobytes())
        digest.update(b";")
    return digest.hexdigest()[:16]
