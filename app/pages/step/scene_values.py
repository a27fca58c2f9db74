"""What the Scene pane lists of a scene: its values, each under the path by which `lessons.scene_edits` changes it."""

from collections.abc import Mapping, Sequence
from dataclasses import replace
from math import degrees

import numpy as np

from core.records.arrays import Floats
from core.records.deformations import Skin
from core.records.motion import Motion
from core.records.words import nouns
from core.scene import AnyScene, Camera, ClipScene, DirectionalLight, Mesh, PointLight, Scene
from core.transform.vertex_stage import transform_vertices
from lessons.scene_edits import BORDERS, WINDOW_NAMES, clip_window, window_of_clip
from widgets.scene.outline import OutlineGroup, OutlineRow, OutlineValue

TYPED_TRIANGLES = 24
"""Triangles whose corners the outline lists."""


def outline(scene: AnyScene, triangle: int | None, size: tuple[int, int]) -> tuple[OutlineGroup, ...]:
    """Return the typed values of a scene; window coordinates are those of a raster of ``size``."""
    if isinstance(scene, ClipScene):
        return _clip_outline(scene, triangle, size)
    names = [mesh.name for mesh in scene.meshes]
    moving = _motion_outline(scene.motion, dict(enumerate(names)), "in world units", has_camera=True)
    return (_camera_outline(scene.camera), *_light_outline(scene), *_mesh_outline(scene), moving)


def _clip_window_outline(scene: ClipScene, size: tuple[int, int]) -> OutlineGroup:
    window = clip_window(scene, size)
    if window.ndim == 1:
        rows = [_vector_row("clip-window/0", "borders", window, BORDERS)]
    else:
        rows = [
            _vector_row(f"clip-window/{k}", f"corner {k}", corner, "xy") for k, corner in enumerate(window)
        ]
    return OutlineGroup("clip-window", "Clip window", tuple(rows))


def _clip_outline(scene: ClipScene, triangle: int | None, size: tuple[int, int]) -> tuple[OutlineGroup, ...]:
    if scene.table is not None:
        return ()
    places, corners = scene.clip, scene.corner_count
    colors: Sequence[int | None] = transform_vertices(scene).colors
    one, vertex = nouns(scene.corner_count).one, "vertex"
    if scene.curves is not None:
        places, one, vertex, triangle = scene.curves.control, "curve", "control point", None
        corners = places.shape[1]
        colors = [None] * corners
    shown = range(min(len(places), TYPED_TRIANGLES)) if triangle is None else [triangle]
    window = window_of_clip(places, size)
    groups = []
    for index in shown:
        rows = []
        for corner in range(corners):
            path = f"corner/{index}/{corner}"
            if not np.isfinite(window[index, corner]).all():
                rows.append(
                    OutlineRow(
                        path,
                        f"{vertex} {corner}",
                        vertex=colors[corner],
                        note="at w = 0: no place in the window",
                    )
                )
                continue
            values = tuple(
                OutlineValue(name, float(number))
                for name, number in zip(WINDOW_NAMES, window[index, corner], strict=True)
            )
            rows.append(OutlineRow(path, f"{vertex} {corner}", values, vertex=colors[corner]))
        title = f"{one.capitalize()} {index}"
        groups.append(OutlineGroup(f"triangle/{index}", title, tuple(rows)))
    if scene.corner_count == 2 or scene.corner_count > 3 or scene.clip_region is not None:
        groups.append(_clip_window_outline(scene, size))
    if scene.corner_count == 3:
        named = {index: f"triangle {index}" for index in shown}
        groups.append(_motion_outline(scene.motion, named, "in NDC", has_camera=False))
    return tuple(groups)


def _vector_row(path: str, label: str, vector: Floats, names: Sequence[str] = "xyz") -> OutlineRow:
    values = tuple(OutlineValue(name, float(number)) for name, number in zip(names, vector, strict=True))
    return OutlineRow(path, label, values)


def _camera_outline(camera: Camera) -> OutlineGroup:
    angle = OutlineValue("field_of_view", degrees(camera.field_of_view))
    height = OutlineValue("view_height", camera.view_height)
    is_perspective = camera.projection == "perspective"
    rows = [
        _vector_row("camera/eye", "eye", camera.eye),
        _vector_row("camera/target", "target", camera.target),
        _vector_row("camera/up", "up", camera.up),
        OutlineRow(
            "camera/lens",
            "view angle, °" if is_perspective else "view height",
            (angle if is_perspective else height,),
        ),
        OutlineRow(
            "camera/range", "near, far", (OutlineValue("near", camera.near), OutlineValue("far", camera.far))
        ),
    ]
    return OutlineGroup("camera", f"Camera, {camera.projection}", tuple(rows))


def _light_outline(scene: Scene) -> list[OutlineGroup]:
    groups = []
    for index, light in enumerate(scene.lights):
        where = "direction" if isinstance(light, DirectionalLight) else "position"
        vector = light.position if isinstance(light, PointLight) else light.direction
        rows = [
            _vector_row(f"light/{index}/{where}", where, vector),
            _vector_row(f"light/{index}/color", "colour", light.color, "rgb"),
        ]
        if isinstance(light, DirectionalLight):
            casts = OutlineValue("casts_shadow", light.casts_shadow, is_flag=True)
            note = "Whether it may cast shadows: of several lights the first that may does."
            rows.append(OutlineRow(f"light/{index}/shadow", "casts shadow", (casts,), note=note))
        title = "Directional light" if isinstance(light, DirectionalLight) else "Point light"
        groups.append(OutlineGroup(f"light/{index}", f"{title} {index}", tuple(rows), is_open=False))
    return groups


def _mesh_outline(scene: Scene) -> list[OutlineGroup]:
    groups = []
    for index, mesh in enumerate(scene.meshes):
        counts = f"{len(mesh.triangles):,} triangles, {len(mesh.positions):,} vertices"
        texture = (
            f"texture {mesh.texture.pixels.shape[1]}×{mesh.texture.pixels.shape[0]}" if mesh.texture else ""
        )
        rows = [OutlineRow(f"mesh/{index}/counts", counts, note=texture)]
        rows += [
            OutlineRow(
                f"mesh/{index}/{name}",
                name,
                (OutlineValue(name, getattr(mesh.material, name), 0, 10000 if name == "shininess" else 1),),
            )
            for name in ("ambient", "diffuse", "specular", "shininess", "mirror")
        ]
        groups.append(OutlineGroup(f"mesh/{index}", mesh.name, tuple(rows), is_open=False))
        groups += _deformation_outline(index, mesh)
    return groups


def _deformation_outline(index: int, mesh: Mesh) -> list[OutlineGroup]:
    """Return the angles of the bones of a mesh, or the weights of the shapes that it is blended with."""
    held = mesh.deformation
    if held is None:
        return []
    kind, label, name, reach, numbers = "shape", "shape {}", "weight", 2, held.weights
    if isinstance(held, Skin):
        kind, label, name, reach, numbers = "bone", "bone {}, °", "angle", 360, np.degrees(held.angles)
    rows = [
        OutlineRow(f"{kind}/{index}/{k}", label.format(k), (OutlineValue(name, number, -reach, reach),))
        for k, number in enumerate(numbers.tolist())
    ]
    return [OutlineGroup(f"{kind}/{index}", f"{kind.capitalize()}s of {mesh.name}", tuple(rows))]


def _motion_outline(
    motion: Motion | None, names: Mapping[int, str], unit: str, has_camera: bool
) -> OutlineGroup:
    """Return the way of the camera and of objects, by number and name, from picture to picture."""
    held, note = (
        motion or Motion(),
        f"Way from one picture to the next, {unit}: temporal antialiasing mixes pictures.",
    )
    ways = dict(held.objects)
    labels = {"camera": "camera"} if has_camera else {}
    labels |= {str(number): name for number, name in names.items()}
    rows = []
    for key, label in labels.items():
        way = held.camera if key == "camera" else ways.get(int(key), (0.0, 0.0, 0.0))
        row = _vector_row(f"motion/{key}", label, np.array(way))
        rows.append(replace(row, note=note))
    return OutlineGroup("motion", "Motion between pictures", tuple(rows), is_open=False)
