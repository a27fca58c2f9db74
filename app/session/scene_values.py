"""What the Scene pane lists of a scene: its values, each under the path by which `lessons.scene_edits` changes it."""

from collections.abc import Sequence
from math import degrees

import numpy as np

from core.geometry.vertex_stage import transform_vertices
from core.records.arrays import Floats
from core.records.nouns import nouns
from core.scene import AnyScene, Camera, ClipScene, DirectionalLight, PointLight, Scene
from lessons.scene_edits import BORDERS, WINDOW_NAMES, clip_window, window_of_clip
from widgets.basics.scene_outline import OutlineGroup, OutlineRow, OutlineValue

TYPED_TRIANGLES = 24
"""Triangles whose corners the outline lists."""


def outline(scene: AnyScene, triangle: int | None, size: tuple[int, int]) -> tuple[OutlineGroup, ...]:
    """Return the typed values of a scene; window coordinates are those of a raster of ``size``."""
    if isinstance(scene, ClipScene):
        return _clip_outline(scene, triangle, size)
    return (_camera_outline(scene.camera), *_light_outline(scene), *_mesh_outline(scene))


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
    shown = range(min(len(scene.clip), TYPED_TRIANGLES)) if triangle is None else [triangle]
    window, colors = window_of_clip(scene.clip, size), transform_vertices(scene).colors
    groups = []
    for index in shown:
        rows = []
        for corner in range(scene.corner_count):
            path = f"corner/{index}/{corner}"
            if not np.isfinite(window[index, corner]).all():
                rows.append(
                    OutlineRow(
                        path,
                        f"vertex {corner}",
                        vertex=colors[corner],
                        note="at w = 0: no place in the window",
                    )
                )
                continue
            values = tuple(
                OutlineValue(name, float(number))
                for name, number in zip(WINDOW_NAMES, window[index, corner], strict=True)
            )
            rows.append(OutlineRow(path, f"vertex {corner}", values, vertex=colors[corner]))
        title = f"{nouns(scene.corner_count).one.capitalize()} {index}"
        groups.append(OutlineGroup(f"triangle/{index}", title, tuple(rows)))
    if scene.corner_count == 2 or scene.corner_count > 3 or scene.clip_region is not None:
        groups.append(_clip_window_outline(scene, size))
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
        rows = (
            _vector_row(f"light/{index}/{where}", where, vector),
            _vector_row(f"light/{index}/color", "colour", light.color, "rgb"),
        )
        title = "Directional light" if isinstance(light, DirectionalLight) else "Point light"
        groups.append(OutlineGroup(f"light/{index}", f"{title} {index}", rows, is_open=False))
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
            for name in ("ambient", "diffuse", "specular", "shininess")
        ]
        groups.append(OutlineGroup(f"mesh/{index}", mesh.name, tuple(rows), is_open=False))
    return groups
