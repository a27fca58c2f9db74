"""A typed text as a contender: it draws in the lanes what a rule of the core draws."""

import numpy as np

from app.bench.records import Bytes, Contender, Prepared, TypedPicture, Work, random_triangles
from app.bench.workloads import clip_scene
from core import Frame, Settings, render
from core.edits.edit import Edit, apply_edit, original
from core.scene import AnyScene, Scene
from core.shaders.presets import preset_program
from lessons.scenes import make_scene
from lessons.small_scenes import pixel_segments

LIBRARY = "Edited text"
DISTRIBUTION = "numpy"
LINES = 30
OF = {"fill": "bounding-box", "line": "bresenham"}
"""Part to the method whose listing is typed."""


def contender(work: Work) -> Contender | None:
    """Return a text drawing ``work``, if that is a picture which has one."""
    if not isinstance(work, TypedPicture):
        return None
    return Contender(LIBRARY, "text", lambda _: prepare(*by_text(work)))


def prepare(scene: AnyScene, settings: Settings) -> Prepared:
    """Hold scene and settings; every run draws all buffers."""
    return Prepared(lambda: render(scene, settings), picture=pixels_of)


def pixels_of(frame: Frame) -> Bytes:
    """Return the colours of a frame as bytes (H, W, 3)."""
    return np.rint(255 * np.clip(frame.color[..., :3].astype(np.float64), 0, 1)).astype(np.uint8)


def by_rule(work: TypedPicture) -> tuple[AnyScene, Settings]:
    """Return scene and settings that draw a picture by the rules of the core."""
    if work.part == "shaders":
        width, height = work.size
        scene = make_scene("sphere")
        assert isinstance(scene, Scene)
        return Scene(scene.meshes, scene.camera, scene.lights, (width, height), scene.background), Settings()
    if work.part == "line":
        rng = np.random.default_rng(47)
        ends = rng.integers(0, min(work.size), (LINES, 2, 2)).tolist()
        pairs = [((x0, y0), (x1, y1)) for (x0, y0), (x1, y1) in ends]
        return pixel_segments(pairs, work.size), Settings(line=OF["line"])
    area = work.size[0] * work.size[1] / 20
    return clip_scene(random_triangles(48, 40, work.size, area)), Settings(fill=OF["fill"])


def by_text(work: TypedPicture) -> tuple[AnyScene, Settings]:
    """Return scene and settings that draw the same by a text: an unedited listing, or Phong in GLSL."""
    scene, settings = by_rule(work)
    if work.part == "shaders":
        assert isinstance(scene, Scene)
        program = preset_program("phong", scene)
        return Scene(
            scene.meshes, scene.camera, scene.lights, scene.size, scene.background, program=program
        ), settings
    of = OF[work.part]
    return scene, apply_edit(settings, Edit(work.part, of, original(work.part, of).source))
