"""The core as a contender."""

from collections.abc import Callable

import numpy as np

from app.bench import records
from app.bench.typed_text import by_rule, prepare
from app.bench.workloads import clip_scene, lights_of, mesh_of, method_names, prepare_reading, view_of
from app.files.mesh_files import load_meshes
from app.files.mesh_formats.reading import LoadedMeshes
from core import Picture, Settings, draw_picture

LIBRARY = "Rasterscope"
DISTRIBUTION = "numpy"
FAST = {"cull": "back", "fill": "spans", "depth": "fixed-38"}
ROW_FILLING = 16
"""Pixels that fill up the rows of a picture of lines: rows of 4096 bytes would compete for places in the cache."""


def contender(work: records.Work) -> records.Contender | None:
    """Return the core drawing ``work``."""
    if isinstance(work, records.Lines):
        return records.Contender(LIBRARY, "ours", lambda _: prepare_lines(work))
    if isinstance(work, records.WindowTriangles):
        return records.Contender(LIBRARY, "ours", lambda _: prepare_triangles(work))
    if isinstance(work, records.ViewedMesh):
        return records.Contender(LIBRARY, "ours", lambda _: prepare_mesh(work))
    if isinstance(work, records.MeshFile):
        return records.Contender(
            LIBRARY, "ours", lambda stack: prepare_reading(work, stack, load_meshes, arrays_of)
        )
    if isinstance(work, records.TypedPicture):
        return records.Contender(LIBRARY, "ours", lambda _: prepare(*by_rule(work)))
    return None


def arrays_of(loaded: LoadedMeshes) -> tuple[records.Floats, records.Integers]:
    """Return positions and triangles of a file of one mesh."""
    (mesh,) = loaded.meshes
    return mesh.positions, mesh.triangles


def settings_of(work: records.WindowTriangles | records.ViewedMesh) -> Settings:
    """Return the fast methods and those that the picture asks for."""
    return Settings(**FAST, **method_names(work))  # type: ignore[arg-type]


def prepare_triangles(work: records.WindowTriangles) -> records.Prepared:
    """Hold the scene, as an OpenGL program holds its vertex buffer."""
    scene, settings = clip_scene(work), settings_of(work)

    def draw() -> Picture:
        return draw_picture(scene, settings, encoding="linear")

    return records.Prepared(lambda: draw().pixels, lambda: account(draw()))


def prepare_mesh(
    work: records.ViewedMesh, draw_with: Callable[..., Picture] = draw_picture
) -> records.Prepared:
    """Hold mesh and lights; camera and scene are new in every picture, as in an orbit.

    Parameters
    ----------
    draw_with : callable
        `core.draw_picture`, or what draws the same picture in another way.
    """
    mesh, lights, settings = mesh_of(work), lights_of(work), settings_of(work)

    def draw() -> Picture:
        return draw_with(view_of(work, mesh, lights), settings, encoding="linear")

    return records.Prepared(lambda: draw().pixels, lambda: account(draw()))


def account(picture: Picture) -> str:
    """Return which way a picture was drawn, and where the time went."""
    route = picture.route
    seconds = {name: count.seconds for name, count in picture.statistics.items() if count.seconds >= 5e-5}
    stages = ", ".join(f"{name} {1000 * value:.1f}" for name, value in seconds.items())
    return f"{route.visibility}, {route.color}, depth complexity {route.depth_complexity:.2f}; ms: {stages}"


def prepare_lines(work: records.Lines) -> records.Prepared:
    """Hold the colours packed as the picture has them."""
    from core.lines.many_lines import paint_lines

    (width, height), columns = work.size, work.size[0] + ROW_FILLING
    opaque = np.full((len(work.colors), 4), 255, np.uint8)
    opaque[:, :3] = work.colors
    colors = opaque.view(np.uint32)[:, 0]

    def run() -> records.Bytes:
        words = np.zeros((height, columns), np.uint32)
        paint_lines(words, work.ends, colors, width, last_pixel=True)
        return words.view(np.uint8).reshape(height, columns, 4)[:, :width]

    return records.Prepared(run)
