"""What is said of steps, tables and pixels is what was recorded: other words are a difference that someone reads.

From the top of the project, ``python -m tests.core.explain.test_recorded`` records all of it afresh. Each kind of
sentence stands in one section, the first that has it; what is new comes after all that was recorded, and changes none.
"""

import re
from collections.abc import Iterable, Iterator
from difflib import unified_diff
from itertools import product
from pathlib import Path
from typing import Any

import numpy as np

from core import STAGES, ClipScene, Settings, Trace, trace
from core.depth.told import passes
from core.edits.edit import Edit, apply_edit, original
from core.explain.latex import plain_text
from core.explain.stage_texts import initial_sentence, summary_sentence
from core.explain.step_tables import step_table
from core.explain.step_values import StepValues
from core.explain.steps import account
from core.methods import table
from core.pixel_history import told, why
from core.pixel_history.fragments import Link, PixelHistory
from core.records.steps import Level
from core.scene import AnyScene
from core.trace.source import TraceSource
from core.trace.stage_trace import Explanation, StageTrace
from lessons.lectures.scenes import ALL_SCENES, clipped, degenerate, frustum_segments
from lessons.scenes import built_in_scene, make_scene
from lessons.window_scenes import window_triangle
from tests.core.explain.explained_steps import (
    ROWS,
    Step,
    line_trace,
    places_in,
    places_of,
    rare_trace,
    step_at,
    traces,
)
from tests.core.shaders.scenes import BRANCHES, square_scene, tutorial_scene
from tests.core.strategies import clip_of_window

RECORDED = Path(__file__).with_name("recorded.txt")
NUMBER = re.compile(r"[−+]?[\d∞][\d.,/]*(?:e−?\d+)?|[⁰¹²³⁴-⁹⁻]+|NaN")
REMAINDER = re.compile(r"e−1\d")
"""What rounding leaves of a 0, which another machine may round otherwise."""
LOWER_LEFT = [(2, 2), (10, 2), (2, 10)]
SIZE = (16, 12)
FOUR_DEPTHS = np.array([[0.0] * 3, [0.5] * 3, [0.0] * 3, [-0.5] * 3])
DIVIDING = ("after-divide", "project-first")
REGIONS = {"shared-edge": (12, 5, 4, 3), "cube": (240, 240, 2, 2)}
"""Which part of the picture of a scene is traced, where that is not all of it."""
MOST_ROWS = 64
"""Rows of a stage that are said."""


def said_of(steps: Iterable[Step], said: set[tuple[str, str]]) -> Iterator[str]:
    """Yield sentences and formulas of kinds not yet ``said``: of steps that differ in numbers only, the shortest."""
    found: dict[tuple[str, str], tuple[int, str]] = {}
    for explanation, triangle, pixel in steps:
        text, made = account(explanation, triangle, pixel)
        kind = explanation.key, NUMBER.sub("#", text)
        if kind not in said and not REMAINDER.search(text):
            lines = [] if made is None else [plain_text(made.symbolic), plain_text(made.substituted)]
            whole = "\n    ".join([f"{explanation.key}: {text}", *lines])
            found[kind] = min(found.get(kind, (len(whole), whole)), (len(whole), whole))
    said |= set(found)
    return (whole for _, (_, whole) in sorted(found.items()))


def steps_of_rows(stage: StageTrace) -> Iterator[Step]:
    """Yield the steps of the first rows of a stage."""
    for row in range(min(MOST_ROWS, stage.steps.row_count)):
        column, line = stage.pixel[row].tolist()
        for position in range(stage.steps.starts[row] + 1, stage.steps.starts[row + 1] + 1):
            explanation = stage.explain(int(position))
            assert explanation is not None
            yield explanation, int(stage.triangle[row]), (column, line)


def edited(part: str, of: str, old: str, new: str, scene: str = "shared-edge", **choices: Any) -> Trace:
    """Trace a few pixels with one place of a listing changed."""
    text = original(part, of).source
    assert old in text
    settings = apply_edit(Settings(**choices), Edit(part, of, text.replace(old, new)))
    return trace(make_scene(scene), settings, region=REGIONS.get(scene))


def of_window(corners: list[Any], size: tuple[int, int], z: Any = 0.0, **choices: Any) -> Trace:
    """Trace triangles with these corners in the window."""
    return trace(ClipScene(clip_of_window(corners, size, 1.0, z), None, size), Settings(**choices))


def stages() -> Iterator[tuple[str, StageTrace]]:
    """Yield stages of which many rows are said: numbers that can be worked out by hand, and rare sentences."""
    by_hand = {"fill": "brute-force"}
    at_corners = by_hand | {"pixel_center": "integer"}
    ties: dict[str, list[dict[str, Any]]] = {
        "raster": [
            *({}, by_hand, at_corners, {"fill": "scanline"}, by_hand | {"fill_rule": "inclusive"}),
            at_corners | {"fill_rule": "exclusive"},
        ],
        "bin": [{}, {"fill": "blocks", "block_size": 2}],
        "edges": [{}],
        "depth": [{"depth": "fixed-38"}],
    }
    for stage, choices in ties.items():
        for choice in choices:
            yield f"grid-ties {choice}", rare_trace("grid-ties", Settings(**choice)).stage(stage)
    for name in ("all-behind", "outside-left", "degenerate", "clockwise"):
        yield f"{name}, back faces culled", rare_trace(name, Settings(cull="back")).stage("cull")
    yield "clockwise", rare_trace("clockwise", Settings()).stage("cull")
    yield "through-eye", rare_trace("through-eye", Settings(clipping="sutherland-hodgman")).stage("clip")
    for line in table.names("line"):
        yield line, line_trace(Settings(polygon_mode="wireframe", line=line)).stage("raster")
    # The left edge stands at x = 1.501 and is snapped to 1.5, where the centre of pixel (1, 3) lies.
    snapped = of_window([[(1.501, 1), (7, 1), (1.501, 7)]], (8, 8), **by_hand)
    yield "snapped", snapped.stage("raster")
    for depth in ("z-float32", "fixed-38", "z-24", "inverse-w"):
        four = of_window([LOWER_LEFT] * 4, SIZE, FOUR_DEPTHS, depth=depth)
        yield f"depth {depth}", four.stage("depth")
    pale = [[(-9.0, 5.7), (40.0, 5.7), (15.0, 40.0)], [(-9.0, 6.2), (40.0, 6.2), (15.0, -40.0)]]
    for way in ("ray-casting", "z-buffer", "last-drawn"):
        wu = {"polygon_mode": "wireframe", "line": "wu", "visibility": way}
        yield f"pale {way}", of_window(pale, (9, 12), np.array([[0.5], [-0.5]]), **wu).stage("depth")
    beyond = of_window(
        [[(5.5, 3.5), (4.5, 5.75), (5, 4.5)]],
        (6, 6),
        [0.6, 0.6, -0.5],
        fill="scanline-lecture",
        depth="fixed-38",
    )
    yield "a depth outside of the triangle", beyond.stage("depth")
    corners = np.array([(-2, -0.5), (2, -0.5), (3, 0), (2, 0.5), (-2, 0.5), (-3, 0)])
    polygon = np.concatenate([corners, np.tile([0.0, 1.0], (6, 1))], axis=1)[None]
    yield "polygon", trace(ClipScene(polygon, size=(8, 8), kind="polygons", rings=[0])).stage("cull")
    for name, interpolation in product(("segment", "points"), ("perspective", "affine", "flat")):
        traced = trace(make_scene(name), Settings(interpolation=interpolation))
        yield f"{name} {interpolation}", traced.stage("interpolate")
        yield f"{name} {interpolation}", traced.stage("raster")
    window = built_in_scene("polygon-window")
    yield "polygon-window", trace(window.make(), Settings(**window.settings)).stage("raster")
    wireframe = trace(make_scene("single-triangle"), Settings(polygon_mode="wireframe"))
    yield "along an edge", wireframe.stage("interpolate")
    yield "a vertex that faces share", trace(make_scene("textured-floor")).stage("transform")
    shaded = trace(ALL_SCENES["zwicker-perspective"].make(), Settings(fill="bounding-box"), 0, (4, 4, 6, 4))
    yield "textured", shaded.stage("interpolate")
    yield "textured", shaded.stage("shade")
    yield "an inverse", trace(ALL_SCENES["zwicker-4x3"].make(), Settings(coverage="inverse")).stage("edges")
    yield "n[0]", edited("interpolation", "perspective", "n[k] / total", "n[k] / n[0]").stage("interpolate")
    affine = edited("interpolation", "affine", "n[k] / total", "n[k] / n[1]", interpolation="affine")
    yield "n[1]", affine.stage("interpolate")
    box = {"fill": "bounding-box"}
    yield "value >= 0", edited("fill", "bounding-box", "value > 0", "value >= 0", **box).stage("raster")
    yield "a < 0", edited("fill_rule", "shared-edge", "a > 0", "a < 0", **box).stage("raster")
    yield "a >= 0", edited("fill_rule", "shared-edge", "a > 0", "a >= 0", **box).stage("edges")
    yield (
        "new <= old",
        edited("depth_test", "z-float32", "new < old", "new <= old", "intersecting").stage("depth"),
    )
    yield "1 for 1 - alpha", edited("blend", "over", "1 - alpha", "1", blend="over").stage("blend")
    for line, old, new in (("bresenham", "D >= 0", "D > 0"), ("dda", "0.5", "0.25")):
        yield f"{line} {new}", edited("line", line, old, new, "segment", line=line).stage("raster")

    unset = "float k;\nif (vUv.x > 0.5) k += 1.0;\nc = vec4((vUv.xyxy * (k + 2.0)).xyz, 1.0);"
    for name, body in (("branches", BRANCHES), ("read before it has a value", unset)):
        yield name, trace(square_scene(body), Settings(), 0).stage("shade")
    yield "vertex shader", trace(tutorial_scene(), Settings(), 0).stage("transform")
    light = edited("shading", "phong", "max(n_dot_h, 0.0)", "max(n_dot_l, 0.0)", "cube")
    yield "n_dot_l", light.stage("shade")


def depths() -> Iterator[str]:
    """Yield what is said of depths that are close, far, or no numbers."""
    near = float(np.float32(0.88571429))
    far = float(np.nextafter(np.float32(near), np.float32(1)))
    numbers = {
        "depth": 0.25,
        "inverse_w": 0.5,
        "stored": 0.25,
        "before": 0.125,
        "after": 0.25,
        "column": 5,
        "row": 6,
    }
    numbers |= {"passes": False, "writes": False, "larger_is_nearer": False, "quantity": "z"}
    for operation, changes in (
        *[("test.compare", {"before": before}) for before in (0.125, 0.25, float("nan"))],
        ("test.compare", {"stored": 14860001.0, "before": 14860000.0, "scale": 16777215.0}),
        ("test.compare", {"stored": far, "before": near}),
        ("test.compare", {"larger_is_nearer": True, "quantity": "inverse-w", "passes": True}),
        *[("out-of-range.range", {"depth": depth}) for depth in (1.5, -0.5, float("nan"))],
        *[(f"{kind}.write", {"after": 1.0, "before": 1.0}) for kind in ("test", "store")],
    ):
        made = Explanation(f"depth.{operation}", {**numbers, **changes}, (), (), None, 0)
        yield f"{account(made, 3, (5, 6))[0]} {asked.text if (asked := passes(StepValues(made, 3))) else ''}"
    values = {"stored": far, "before": near, "against": 2, "scale": 1.0}
    yield told.link_sentence(Link("depth", "failed", values))


def window(*triangles: Any, z: Any = 0.0, w: Any = 1.0, colors: Any = None) -> ClipScene:
    """Return triangles with these corners in the window."""
    return ClipScene(clip_of_window(triangles, SIZE, w, z), colors, SIZE)


BEHIND = [[-0.9, -0.9, 0, 1], [0.9, -0.9, 0, 1], [0, 0.5, -2, 1]]
THROUGH_EYE = [[-0.5, -0.5, 0, 1], [0.5, -0.5, 0, 1], [0, 0.9, 0, -1]]
IN_FRONT = [[-0.5, -0.5, -2, 1], [0.5, -0.5, 0, 1], [0, 0.9, 0, 1]]
PIXELS: list[tuple[AnyScene, list[tuple[int, ...]], dict[str, Any]]] = [
    (window(LOWER_LEFT), [(3, 3), (7, 6), (14, 10), (14, 10, 0)], {}),
    (window(LOWER_LEFT), [(7, 6), (5, 6, 0)], {"fill": "bounding-box"}),
    (window(LOWER_LEFT), [(7, 6)], {"fill": "scanline"}),
    (window(LOWER_LEFT), [(9, 9, 0)], {"fill": "blocks", "block_size": 4}),
    (window(LOWER_LEFT), [(3, 3)], {"cull": "front"}),
    (window(LOWER_LEFT), [(8, 8, 0), (2, 10)], {"fill": "scanline-lecture"}),
    (window(LOWER_LEFT), [(6, 6), (4, 4, 0), (14, 2, 0)], {"polygon_mode": "wireframe"}),
    (window([(2, 2), (6, 8), (10, 2)]), [(6, 3, 0)], {"fill": "scanline-lecture"}),
    (window([(2, 2), (10, 2), (2, 9.875)]), [(5, 6, 0)], {"fill": "bounding-box"}),
    (window([(11, 2), (11, 11), (2, 11)]), [(7, 5)], {"fill": "bounding-box"}),
    (window([(0, 0), (15, 0), (0, 11)]), [(13, 10)], {"fill": "blocks", "block_size": 4}),
    (window([(-40, -40), (60, -40), (0, 60)]), [(5, 5)], {"fill": "hierarchy", "block_size": 2}),
    (window(LOWER_LEFT, LOWER_LEFT[::-1]), [(3, 3), (8, 8), (15, 11)], {"cull": "back"}),
    (window(LOWER_LEFT, LOWER_LEFT[::-1]), [(3, 3), (8, 8)], {"cull": "front"}),
    (window(LOWER_LEFT[::-1]), [(3, 3)], {"cull": "back"}),
    (window(LOWER_LEFT, LOWER_LEFT[::-1], LOWER_LEFT), [(15, 11)], {"cull": "back"}),
    # A triangle 1/2000 pixel high faces the eye, but its snapped corners are in a line.
    (window([(2, 5.5), (10, 5.5), (6, 5.5005)]), [(6, 5, 0)], {}),
    (window([(1, 1), (5, 5), (9, 9)], [(20, 2), (30, 2), (20, 9)]), [(4, 4)], {}),
    (window(LOWER_LEFT, z=np.full((1, 3), 3.0)), [(4, 4), (4, 4, 0)], {}),
    (window(LOWER_LEFT, w=-1.0), [(4, 4), (4, 4, 0)], {}),
    # One corner in range, so that the triangle is not culled as a whole.
    *[(window([(0, 0), (16, 0), (8, 12)], z=[[z, z, 0.0]]), [(8, 0)], {}) for z in (-1.5, 1.5)],
    (window(*[LOWER_LEFT] * 4, z=FOUR_DEPTHS), [(3, 3), *((3, 3, k) for k in range(4))], {}),
    (window(*[LOWER_LEFT] * 4, z=FOUR_DEPTHS), [(3, 3)], {"visibility": "last-drawn"}),
    (window(*[LOWER_LEFT] * 3, z=[[-0.5] * 3, [0.0] * 3, [0.5] * 3]), [(3, 3)], {"visibility": "painters"}),
    (
        window(*[LOWER_LEFT] * 3, colors=np.ones((3, 3, 4)) * np.array([0.5, 1, 0.25])[:, None, None]),
        [(3, 3), (3, 3, 1)],
        {"visibility": "last-drawn", "blend": "over"},
    ),
    (ClipScene([BEHIND], size=SIZE), [(8, 1), (8, 8, 0)], {"clipping": "sutherland-hodgman"}),
    (ClipScene([THROUGH_EYE], size=SIZE), [(8, 1, 0)], {"interpolation": "affine"}),
    (ClipScene([THROUGH_EYE], size=SIZE), [(8, 8)], {"fill": "bounding-box"}),
    (ClipScene([THROUGH_EYE, IN_FRONT], size=SIZE), [(9, 4, 1)], {"interpolation": "affine"}),
    *[(ClipScene([THROUGH_EYE], size=SIZE), [(8, 1, 0)], {"clipping": way}) for way in DIVIDING],
    # Outside of two planes, each corner inside of one of them.
    (
        ClipScene([[[-3, 0.5, 0, 1], [-0.5, 3, 0, 1], [-3, 3, 0, 1]]], size=SIZE),
        [(1, 10, 0), (9, 3)],
        {"clipping": "sutherland-hodgman"},
    ),
    *[
        (window([(3.5, 0.5), (7.5, 0.5), (3.5, 6.5)]), [(3, 1)], {"fill": fill, "fill_rule": rule})
        for fill, rule in product(("spans", "scanline", "brute-force"), ("shared-edge", "inclusive"))
    ],
    *[(make_scene("segment"), [(3, 2)], {"line": line}) for line in table.names("line")],
    # In the window the centre of pixel (1, 3) has weights 3/8, 3/16 and 7/16.
    (
        ClipScene(
            np.array([window_triangle([0, 8, 0], [0, 0, 8], [0.5] * 3, [1, 1, 2], (8, 8))]), size=(8, 8)
        ),
        [(1, 3)],
        {},
    ),
    (ClipScene(np.empty((0, 3, 4)), size=SIZE), [(0, 0)], {}),
]
"""Scenes, pixels or pixels and a triangle, and settings: every reason for which a triangle is seen there or not."""


def told_of(history: PixelHistory) -> Iterator[str]:
    """Yield what became of a pixel, or of a triangle there."""
    yield f"\nPIXEL ({history.column}, {history.row}): {history.verdict.key}: {told.verdict_sentence(history)}"
    for event in history.events[2:]:
        chain = ", ".join(f"{link.stage} {link.key}" for link in event.chain)
        yield f"{told.event_title(event)}, {event.kind}: {told.event_reason(event)} ({chain})"
    yield from told.count_sentences(history)


def histories() -> Iterator[str]:
    """Yield what became of pixels, and of triangles at them."""
    for scene, pixels, choice in PIXELS:
        for pixel in pixels:
            yield from told_of(why(TraceSource(scene, Settings(**choice)), *pixel))
    for limit, column, row in ((">= 0", 12, 6), ("> 300", 18, 28)):
        settings = edited(
            "fill", "bounding-box", "value > 0", f"value {limit}", fill="bounding-box"
        ).source.settings
        yield from told_of(why(TraceSource(make_scene("shared-edge"), settings), column, row))


def tables() -> Iterator[str]:
    """Yield tables of clippers, after each of their groups of rows, and of polygons."""
    ends = [(-2, 1, 6, 5), (3, 3, 3, 3), (-2, -1, 10, 8)]
    found: list[tuple[StageTrace, list[int]]] = []
    for clipper in ("cohen-sutherland", "liang-barsky", "cyrus-beck"):
        scenes = [clipped(*each)() for each in ends] + [degenerate()]
        for scene in scenes:
            stage = trace(scene, Settings(line_clipping=clipper)).stage("raster")
            found.append((stage, stage.steps.starts[stage.steps.group_ends].tolist()))
    sutherland_hodgman = Settings(clipping="sutherland-hodgman")
    cull = trace(frustum_segments(), sutherland_hodgman).stage("cull")
    found.append((cull, cull.steps.starts[cull.steps.triangle_ends].tolist()))
    for corner, z in ((-3.0, 0.0), (-0.5, -1.0)):
        corners = np.array([[[corner, 0, z, 1], [0.5, 0, z, 1], [0.5, 0.5, z, 1]]])
        for name in ("cull", "clip"):
            stage = trace(ClipScene(corners, size=(8, 8)), sutherland_hodgman).stage(name)
            found.append((stage, stage.steps.starts[stage.steps.group_ends].tolist()))
    holes = trace(make_scene("polygon-holes"), triangle=0).stage("raster")
    found.append((holes, [22, 220]))
    for stage, positions in found:
        for position in positions:
            shown = step_table(stage, int(position))
            if shown is not None:
                yield f"{shown.text()}\n{shown.note}"


def summaries() -> Iterator[str]:
    """Yield what is said before a stage begins, and of its rows together."""
    for choice in ({}, {"fill": "blocks"}, {"fill": "scanline"}, {"polygon_mode": "wireframe"}):
        traced = rare_trace("unsnapped", Settings(**choice))
        for name, level in product(STAGES, (Level.STAGE, Level.TRIANGLE, Level.GROUP, Level.PIXEL)):
            stage = traced.stage(name)
            counts = stage.summary(0, stage.steps.row_count)
            yield summary_sentence(name, level, counts, 0, 3, stage.method)
    yield from map(initial_sentence, STAGES)


def said_of_steps() -> Iterator[str]:
    """Yield what is said of steps: of those that are made by hand, and of every other operation."""
    by_hand = {f"{stage.stage.upper()}: {name}": stage for name, stage in stages()}
    traced = {f"TRACE: {name}": each for group in traces().values() for name, each in group.items()}
    keys = {
        f"TRACE: {name}": {key for key, *_ in places}
        for group in traces()
        for name, places in places_in(group).items()
    }
    lines = RECORDED.read_text(encoding="utf-8").splitlines()
    places = {line: place for place, line in enumerate(lines)}
    said: set[tuple[str, str]] = set()
    operations: set[str] = set()
    for name in sorted([*by_hand, *traced], key=lambda name: places.get(name, len(lines))):
        if name in by_hand:
            yield f"\n{name}"
            yield from said_of(steps_of_rows(by_hand[name]), said)
        elif not keys[name] <= operations:
            operations |= keys[name]
            yield f"\n{name}"
            yield from said_of(map(step_at, places_of(traced[name], ROWS)), said)


def recorded() -> Iterator[str]:
    """Yield all of it."""
    yield from said_of_steps()
    yield from histories()
    yield from ("\nDEPTHS", *depths())
    yield from (f"\nTABLE {each}" for each in tables())
    yield from ("\nSUMMARIES", *dict.fromkeys(summaries()))


def test_all_is_said_as_it_was_recorded() -> None:
    old, new = RECORDED.read_text(encoding="utf-8").splitlines(), "\n".join(recorded()).splitlines()
    assert not "\n".join(unified_diff(old, new, "recorded", "said", n=0, lineterm=""))


if __name__ == "__main__":
    RECORDED.write_text("\n".join(recorded()) + "\n", encoding="utf-8")
