"""Steps to be explained: all built-in scenes under every method, around one pixel, and the rare cases."""

from collections.abc import Iterator
from functools import cache

import numpy as np

from core import STAGES, ClipScene, Settings, Trace, render, trace
from core.methods import table
from core.scene import AnyScene
from core.settings import families
from core.trace import Explanation
from lessons.scenes import make_scene, scene_names

Step = tuple[Explanation, int, tuple[int, int]]
"""An explanation, its triangle and its pixel."""

WINDOW = (4, 3)
"""Columns and rows that are traced of a built-in scene."""

RARE_CLIP = {
    "all-behind": [[0, 0, 0, -1], [1, 0, 0, -2], [0, 1, 0, -1]],
    "side-below": [[-0.75, -1.5, 0, 1], [0.5, -1.5, 0, 1], [1.25, 0.5, 0, 1]],
    "past-a-corner": [[-0.5, -0.5, 0, 1], [1.75, 0.5, 0, 1], [0.5, 1.75, 0, 1]],
    "outside-left": [[-3, 0, 0, 1], [-2, 1, 0, 1], [-4, -1, 0, 1]],
    "degenerate": [[-1, -1, 0, 1], [0, 0, 0, 1], [1, 1, 0, 1]],
    "clockwise": [[-1, -1, 0, 1], [-1, 1, 0, 1], [1, -1, 0, 1]],
    "through-far": [[-1, -1, -0.5, 1], [1, -1, 1.5, 1], [-1, 1, 1.5, 1]],
    "through-eye": [[-1, -1, 0, 1], [1, -1, 0, 1], [0, 0.5, -1.5, -1]],
    "w-is-zero": [[-1, -1, 0, 1], [1, -1, 0, 1], [0, 1, 0, 0]],
    "far-away": [[-1, -1, 0, 1], [1e6, -1, 0, 1], [-1, 1, 0, 1]],
    "lattice-ties": [[-0.75, -0.75, 0, 1], [0.75, -0.75, 0, 1], [-0.75, 0.75, 0, 1]],
    "unsnapped": [[-0.7513, -0.7411, 0, 1], [0.7507, -0.6222, 0, 2], [-0.7507, 0.7591, 0, 1.5]],
}
"""Triangles in clip space on an 8 x 8 raster."""


@cache
def rare_trace(name: str, settings: Settings) -> Trace:
    clip = np.array([RARE_CLIP[name]], float)
    return trace(ClipScene(clip, np.eye(3)[None], (8, 8)), settings)


@cache
def scene_and_window(name: str) -> tuple[AnyScene, int, tuple[int, int, int, int]]:
    """Return a scene, the triangle seen nearest to the middle, and a region around that pixel."""
    scene = make_scene(name)
    identity = render(scene).primitive
    rows, columns = np.nonzero(identity >= 0)
    height, width = identity.shape
    nearest = int(np.argmin(np.hypot(rows - height / 2, columns - width / 2)))
    column, row = int(columns[nearest]), int(rows[nearest])
    return scene, int(identity[row, column]), (column - 1, row - 1, *WINDOW)


def every_choice() -> list[Settings]:
    """Return settings that choose every method, one family at a time, and a few together."""
    found = [Settings()]
    for family in families():
        default = getattr(found[0], family)
        found += [Settings(**{family: name}) for name in table.names(family) if name != default]
    found.append(Settings(fill="blocks", block_size=2, interpolation="affine", texture_filter="nearest"))
    found.append(Settings(fill="scanline", fill_rule="exclusive", blend="over", depth="inverse-w"))
    found.append(Settings(clipping="sutherland-hodgman", coverage="float64", shading="flat", wrap="mirror"))
    for texture_filter, interpolation in (("trilinear", "affine"), ("mipmap-nearest", "flat")):
        mipmapped = {"texture_filter": texture_filter, "interpolation": interpolation}
        found.append(Settings(shading="unlit", **mipmapped))
        found.append(Settings(shading="unlit", polygon_mode="wireframe", **mipmapped))
    found.append(Settings(texture_filter="trilinear", polygon_mode="wireframe", shading="unlit"))
    found.append(Settings(interpolation="affine-n", correction_interval=1))
    return found


def steps_of(traced: Trace, most: int = 110) -> Iterator[Step]:
    """Yield the steps of all stages; of a long stage, ``most`` spread over it."""
    for stage in STAGES:
        of_stage = traced.stage(stage)
        count = of_stage.steps.count
        positions = np.unique(np.linspace(1, count, min(count, most)).astype(int)) if count else []
        for position in positions:
            explanation = of_stage.explain(int(position))
            assert explanation is not None
            row, _ = of_stage.steps.row_at(int(position))
            column, line = of_stage.pixel[row]
            yield explanation, int(of_stage.triangle[row]), (int(column), int(line))


@cache
def steps_of_scene(name: str) -> tuple[Step, ...]:
    """Return steps of a built-in scene under every method."""
    scene, triangle, window = scene_and_window(name)
    found: list[Step] = []
    for settings in every_choice():
        found += steps_of(trace(scene, settings, triangle, window, before="cleared"), 60)
    return tuple(found)


@cache
def rare_steps() -> tuple[Step, ...]:
    """Return steps of the rare triangles under the settings that treat them differently."""
    choices = [
        Settings(block_size=2),
        Settings(clipping="sutherland-hodgman", fill="scanline", cull="back"),
        Settings(fill="scanline-lecture", interpolation="affine", cull="front", blend="over"),
        Settings(fill="brute-force", fill_rule="inclusive", depth="inverse-w", visibility="last-drawn"),
        Settings(fill="blocks", block_size=2, fill_rule="exclusive", coverage="float64"),
        *[Settings(polygon_mode="wireframe", line=line) for line in table.names("line")],
        Settings(polygon_mode="wireframe", interpolation="affine"),
        *[Settings(polygon_mode="wireframe", line="wu", blend=blend) for blend in table.names("blend")],
        Settings(interpolation="affine-n", correction_interval=3),
        *[Settings(depth=depth, visibility="last-drawn") for depth in ("z-24", "reversed-z", "logarithmic")],
        Settings(polygon_mode="wireframe", depth="reversed-z"),
        *[
            Settings(polygon_mode="wireframe", line_clipping=name)
            for name in table.names("line_clipping")[1:]
        ],
        Settings(fill="spans", depth="fixed-38"),
        Settings(clipping="after-divide"),
        Settings(clipping="sutherland-hodgman-lecture"),
        Settings(fill="spans", fill_rule="exclusive", depth="fixed-38", visibility="last-drawn"),
    ]
    alone = [rare_trace(name, choice) for name in RARE_CLIP for choice in choices]
    return tuple(step for traced in (*alone, *rays_of_all()) for step in steps_of(traced))


def rays_of_all() -> list[Trace]:
    """Return traces of ray casting: all rare triangles, those of one plane and one in whose plane the eye lies."""
    together = np.array([*RARE_CLIP.values(), RARE_CLIP["lattice-ties"]], float)
    # Covered by its snapped corners only: the exact determinant is 0.
    edge_on = [[-0.5, -0.5, 0, 1], [0.5, 0.5005, 0.5, 1], [1.5, 1.501, 1, 1]]
    with_edge_on = np.array([RARE_CLIP["lattice-ties"], edge_on], float)
    settings = Settings(visibility="ray-casting", cull="none")
    return [trace(ClipScene(clip, size=(8, 8)), settings) for clip in (together, with_edge_on)]


ALL_SCENES = [*scene_names(), "rare"]


def explained(name: str) -> tuple[Step, ...]:
    """Return the steps of a built-in scene, or of the rare triangles."""
    return rare_steps() if name == "rare" else steps_of_scene(name)
