"""Steps to be explained: every method on a built-in scene, and on rare triangles together."""

from collections.abc import Iterator
from dataclasses import replace
from functools import cache
from heapq import nsmallest
from typing import NamedTuple
from zlib import crc32

import numpy as np

from core import STAGES, ClipScene, Settings, Trace, render, trace
from core.explain.records import Formula, Variable
from core.explain.steps import account, formula, variables
from core.methods import table
from core.records.motion import Motion
from core.scene import AnyScene
from core.settings import families
from core.stages.needs import refusal
from core.trace.stage_trace import Explanation, StageTrace
from lessons.scenes import make_scene, scene_names
from tests.core.shaders.scenes import square_scene
from tests.core.strategies import clip_of_window
from tests.core.trace.trace_cases import LEFT_OUT, name_of
from tests.covering import fewest, is_everything

Step = tuple[Explanation, int, tuple[int, int]]
"""An explanation, its triangle and its pixel."""

WINDOW = (4, 3)
"""Columns and rows that are traced of a built-in scene."""
ROWS = 2
"""Rows of a kind that are explained of a trace, spread over it; with --all twice as many."""
ALIKE = 4
"""Steps of one key that are explained of a group of traces, any of them; with --all every one."""

SCENES = (
    *("single-triangle", "shared-edge", "segment", "clipped-segment", "line-strip", "points"),
    *("polygon-holes", "weiler-atherton", "connecting-edges", "pentagram", "near-plane", "intersecting"),
    *("circle-of-bars", "depth-table", "four-layers", "textured-floor", "cube"),
)
"""Built-in scenes on which methods are tried. Not all that there are: one more would move methods between them."""

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
    "grid-ties": [[-0.75, -0.75, 0, 1], [0.75, -0.75, 0, 1], [-0.75, 0.75, 0, 1]],
    "unsnapped": [[-0.7513, -0.7411, 0, 1], [0.7507, -0.6222, 0, 2], [-0.7507, 0.7591, 0, 1.5]],
}
"""Triangles in clip space on an 8 x 8 raster."""
CORNERS = [(1.5, 1.5), (9.5, 3.5), (5.5, 8.5)]
"""A triangle on pixel centres of a 12 x 10 raster, for lines."""


@cache
def rare_trace(name: str, settings: Settings) -> Trace:
    clip = np.array([RARE_CLIP[name]], float)
    return trace(ClipScene(clip, np.eye(3)[None], (8, 8)), settings)


@cache
def line_trace(settings: Settings) -> Trace:
    return trace(ClipScene(clip_of_window([CORNERS], (12, 10)), np.eye(3)[None], (12, 10)), settings)


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
    wireframe = {"polygon_mode": "wireframe"}
    found += [Settings(**wireframe, line=name) for name in table.names("line")]
    found += [Settings(**wireframe, line_clipping=name) for name in table.names("line_clipping")[1:]]
    found += [Settings(**wireframe, line="wu", blend=name) for name in table.names("blend")]
    for texture_filter in ("bilinear", "trilinear", "mipmap-nearest"):
        for interpolation in ("perspective", "affine", "flat"):
            mixed = {"texture_filter": texture_filter, "interpolation": interpolation, "shading": "unlit"}
            found += [Settings(**mixed), Settings(**mixed, **wireframe)]
    found += [
        Settings(fill="blocks", block_size=2, interpolation="affine", texture_filter="nearest"),
        Settings(fill="scanline", fill_rule="exclusive", blend="over", depth="inverse-w"),
        Settings(clipping="sutherland-hodgman", coverage="float64", shading="flat", wrap="mirror"),
        Settings(clipping="sutherland-hodgman", fill="scanline", cull="back"),
        Settings(fill="scanline-lecture", interpolation="affine", cull="front", blend="over"),
        Settings(fill="brute-force", fill_rule="inclusive", depth="inverse-w", visibility="last-drawn"),
        Settings(fill="blocks", block_size=2, fill_rule="exclusive", coverage="float64"),
        Settings(interpolation="affine-n", correction_interval=1),
        Settings(interpolation="affine-n", correction_interval=3),
        *[Settings(depth=name, visibility="last-drawn") for name in table.names("depth")],
        Settings(**wireframe, depth="reversed-z"),
        Settings(**wireframe, depth="fixed-38", line="wu"),
        Settings(fill="spans", fill_rule="exclusive", depth="fixed-38"),
        Settings(visibility="ray-casting", cull="none"),
    ]
    return found


def is_refused(settings: Settings, scene: AnyScene) -> bool:
    """Return whether one of the methods cannot draw the scene."""
    return any(refusal(family, getattr(settings, family), scene) for family in families())


Place = tuple[str, StageTrace, int, int]
"""The key of an operation, its stage, its row and its position."""


def places_of(
    traced: Trace | StageTrace, count: int = 2 * ROWS if is_everything() else ROWS
) -> Iterator[Place]:
    """Yield where all operations are of some rows of every kind, of one stage or of all."""
    stages = [traced.stage(name) for name in STAGES] if isinstance(traced, Trace) else [traced]
    for stage in stages:
        for number, kind in enumerate(stage.steps.kinds):
            rows = np.flatnonzero(stage.steps.kind == number)
            for row in rows[np.unique(np.linspace(0, len(rows) - 1, count).astype(int))] if rows.size else []:
                for position, operation in enumerate(
                    stage.steps.operations[kind], stage.steps.starts[row] + 1
                ):
                    yield f"{stage.stage}.{kind}.{operation.name}", stage, int(row), int(position)


def step_at(place: Place) -> Step:
    """Explain an operation."""
    key, stage, row, position = place
    explanation = stage.explain(position)
    assert explanation is not None
    assert explanation.key == key
    column, line = stage.pixel[row].tolist()
    return explanation, int(stage.triangle[row]), (column, line)


def steps_of(traced: Trace | StageTrace) -> Iterator[Step]:
    """Yield all operations of some rows of every kind, of one stage or of all."""
    return map(step_at, places_of(traced))


def draw(*names: object) -> int:
    """Return a number that looks random, by names: what is added to a list changes no other choice."""
    return crc32(" ".join(map(str, names)).encode())


@cache
def traces() -> dict[str, dict[str, Trace]]:
    """Return the traces of built-in scenes, each method on one of them, and of the rare triangles together."""
    # The others have no step of another kind.
    scenes = {name: scene_and_window(name) for name in scene_names() if name not in LEFT_OUT}
    choices = {name_of(Settings().differences(settings)): settings for settings in every_choice()}
    cases = [(name, "first", Settings()) for name in scenes]
    for choice, settings in choices.items():
        drawn = (name for name in SCENES if not is_refused(settings, scenes[name][0]))
        cases.append((max(drawn, key=lambda name: draw(name, choice)), choice, settings))
    windows = {}
    for name, choice, settings in cases:
        scene, triangle, window = scenes[name]
        windows[f"{name} {choice}"] = trace(scene, settings, triangle, window, before="cleared")
    boxes = make_scene("boxes-around")
    for name in table.names("hierarchy"):
        asked = Settings(object_culling="frustum", hierarchy=name, leaf_size=16, octree_depth=2)
        windows[f"boxes {name}"] = trace(boxes, asked, 50, (30, 20, *WINDOW), before="cleared")
    behind = Settings(object_culling="occlusion", hierarchy="none", occluders=1)
    for settings in (behind, replace(behind, depth="inverse-w"), replace(behind, blend="over")):
        wall = make_scene("boxes-behind-wall")
        windows[f"wall {name_of(settings.differences(behind))}"] = trace(
            wall, settings, 24, (30, 20, *WINDOW)
        )
    for name in table.names("shadow")[1:]:
        shaded = Settings(shadow=name, map_size=16)
        windows[f"shadow {name}"] = trace(make_scene("box-in-light"), shaded, 0, (22, 26, 8, 1))
    for name in table.names("environment")[1:]:
        mirrored = Settings(environment=name, environment_size=16)
        windows[f"environment {name}"] = trace(make_scene("mirror-cube"), mirrored, None, (18, 31, 8, 1))
    for name in table.names("skinning"):
        windows[f"bent {name}"] = trace(make_scene("bent-bar"), Settings(skinning=name), 7, (0, 0, *WINDOW))
    windows["blended"] = trace(make_scene("blended-bar"), Settings(), 7, (0, 0, *WINDOW))
    for name in table.names("tessellation"):
        cut = Settings(tessellation=name, segments=3, curve_tolerance=64)
        for scene in ("curve-in-depth", "hill"):
            windows[f"{scene} {name}"] = trace(make_scene(scene), cut, 2, (0, 0, *WINDOW), before="cleared")
    few = replace(make_scene("cube"), size=(32, 24))
    in_tree = Settings(visibility="ray-casting-tree", hierarchy="bvh", leaf_size=2)
    windows["rays in a tree"] = trace(few, in_tree, None, (0, 0, 32, 24), before="cleared")
    # Polygons are clipped in scenes of their own.
    comb = make_scene("connecting-edges")
    for name in table.names("polygon_clipping")[1:]:
        windows[name] = trace(comb, Settings(polygon_clipping=name), 0, (0, 8, 8, 4))
    together = ClipScene(np.array([*RARE_CLIP.values(), RARE_CLIP["grid-ties"]], float), size=(8, 8))
    rare = {choice: trace(together, settings) for choice, settings in choices.items()}
    # Covered by its snapped corners only: the exact determinant is 0.
    edge_on = [[-0.5, -0.5, 0, 1], [0.5, 0.5005, 0.5, 1], [1.5, 1.501, 1, 1]]
    with_edge_on = ClipScene(np.array([RARE_CLIP["grid-ties"], edge_on], float), size=(8, 8))
    rare["edge-on"] = trace(with_edge_on, Settings(visibility="ray-casting", cull="none"))
    corners = np.array([[[-0.8, -0.7, 0, 1], [0.9, -0.4, 0, 1], [0.1, 0.8, 0, 1]]])
    alone = ClipScene(corners, np.eye(3)[None], (16, 12))
    rare["smoothed"] = trace(alone, Settings(antialiasing="fxaa"))
    turned = replace(make_scene("textured-floor"), size=(8, 6), motion=Motion(camera=(0.4, 0.1, 0.0)))
    for history in ("kept", "reprojected", "clamped"):
        mixed = Settings(antialiasing="temporal", pictures=3, blend_share=40, history=history)
        rare[f"mixed, {history}"] = trace(turned, mixed, region=(0, 0, 8, 6))
    layered = Settings(visibility="scan-line", blend="over")
    rare["layers"] = trace(make_scene("crossing-glass"), layered, region=(26, 28, 8, 3))
    rare["layers and a tie"] = trace(ClipScene(np.tile(corners, (2, 1, 1)), size=(16, 12)), layered)
    lists = Settings(visibility="hit-lists", blend="over")
    rare["lists"] = trace(make_scene("crossing-glass"), lists, region=(26, 28, 8, 3))
    rare["lists that end early"] = trace(make_scene("intersecting"), lists, region=(26, 28, 2, 1))
    pale = replace(lists, polygon_mode="wireframe", line="wu")
    rare["lists of lines"] = trace(make_scene("intersecting"), pale, region=(20, 28, 20, 6))
    # A shader that discards half of a square, and calls a function.
    square = square_scene("if (vUv.x > 0.5) discard; c = vec4(length(vUv));", (4, 4))
    rare["shader"] = trace(square, Settings(), 0)
    return {"scenes": windows, "rare": rare}


@cache
def places_in(group: str) -> dict[str, tuple[Place, ...]]:
    """Return where all operations are of some rows of every kind, by trace of a group."""
    return {name: tuple(places_of(traced)) for name, traced in traces()[group].items()}


@cache
def fewest_traces() -> list[Trace]:
    """Return few traces that do every operation."""
    every = traces()["scenes"] | traces()["rare"]
    found = places_in("scenes") | places_in("rare")
    return [every[name] for name in fewest({name: [key for key, *_ in found[name]] for name in found})]


@cache
def explained(group: str) -> tuple[Step, ...]:
    """Return the steps of the built-in ``scenes`` or of the ``rare`` triangles."""
    found: dict[str, list[Place]] = {}
    numbers = {}
    for name, of_trace in places_in(group).items():
        for place in of_trace:
            found.setdefault(place[0], []).append(place)
            numbers[place] = draw(name, *place[::2])
    most = len(numbers) if is_everything() else ALIKE
    chosen = (nsmallest(most, places, key=numbers.__getitem__) for places in found.values())
    return tuple(step_at(place) for places in chosen for place in places)


def all_steps() -> tuple[Step, ...]:
    """Return the steps of both groups."""
    return explained("scenes") + explained("rare")


class Said(NamedTuple):
    """All that is said of a step."""

    explanation: Explanation
    sentence: str
    own: Formula | None
    """The step's own formula."""
    formula: Formula | None
    """The formula that is shown: its own, or the last one of its row."""
    variables: tuple[Variable, ...]


@cache
def said(group: str) -> tuple[Said, ...]:
    """Return what is said of the steps of a group, made once for all laws on it."""
    return tuple(
        Said(
            explanation, *account(explanation, triangle, pixel), formula(explanation), variables(explanation)
        )
        for explanation, triangle, pixel in explained(group)
    )


def all_said() -> tuple[Said, ...]:
    """Return what is said of the steps of both groups."""
    return said("scenes") + said("rare")
