"""Trace of the vertex stage: every vertex from space to space; and which geometry there is after a step."""

from collections.abc import Callable, Sequence
from dataclasses import replace

import numpy as np

from core.culling.culling import KEPT
from core.families import has_bones, has_curves
from core.records.arrays import Flags, Integers
from core.records.listing import RETURN, Operation, listing
from core.records.steps import Steps, ends_of
from core.scene import Scene
from core.stages.declared import STAGES
from core.stages.fragment_color import has_program
from core.trace import Trace
from core.trace.source import TraceSource
from core.trace.stage_trace import InsertedRows, StageTrace, insert_rows, no_pixels
from core.transform.matrices import transform_component

# Which geometry there is after a step: the spaces that corners have reached, and the triangles that are
# dropped.


SPACES = ("object", "world", "camera", "clip", "NDC", "window")
"""Spaces of a corner, in the order in which it goes through them."""
CLIP, WINDOW = SPACES.index("clip"), SPACES.index("window")
WAY_COUNT = len(SPACES) - 1
"""Kinds of rows from one space to the next: the first ones of a trace."""


def spaces_reached(trace: Trace, stage: str, position: int) -> Integers:
    """Return (T, k) int64, the space of `SPACES` that each of the k corners of a primitive is in after a step.

    A scene given in clip space starts there. A row counts when its last operation is done.
    """
    shape = len(trace.source.geometry.assembled), trace.source.scene.corner_count
    if stage != STAGES[0]:
        return np.full(shape, WINDOW)
    traced = trace.stage(stage)
    done = traced.steps.rows_done(position)
    if "statement" in traced.steps.kinds:
        return _behind_shader(traced, done, shape)
    first = 0 if trace.source.geometry.vertices.object is not None else CLIP
    rows = WINDOW - first
    # What is done in front of the matrices leaves a corner where it is.
    done = int(np.count_nonzero(traced.steps.kind[:done] < WAY_COUNT))
    reached: Integers = first + np.clip(done - rows * np.arange(shape[0] * shape[1]), 0, rows)
    return reached.reshape(shape)


def _behind_shader(traced: StageTrace, done: int, shape: tuple[int, int]) -> Integers:
    """Return the spaces (T, k) of corners that a vertex shader takes to clip space, after ``done`` rows."""
    runs = traced.steps.kind == traced.steps.kinds.index("statement")
    corner, count = traced.extra["corners"], shape[0] * shape[1]
    left = np.bincount(corner[done:][runs[done:]], minlength=count)
    divided = np.bincount(corner[:done][~runs[:done]], minlength=count)
    return np.where(left == 0, CLIP + divided, 0).reshape(shape)


def is_dropped(trace: Trace, stage: str, position: int) -> Flags:
    """Return (T,) bool, whether culling has dropped each assembled triangle by now."""
    geometry = trace.source.geometry
    if STAGES.index(stage) < STAGES.index("cull"):
        return np.zeros(len(geometry.assembled), bool)
    dropped: Flags = geometry.culled.verdict != KEPT
    if stage == "cull":
        dropped = dropped & (np.arange(len(dropped)) < triangles_done(trace.stage(stage), position))
    return dropped


def triangles_done(found: StageTrace, position: int) -> int:
    """Return how many triangles have their verdict: the last row of each is done, and the rows before all of them.

    The first end is 0 where there are no rows.
    """
    steps = found.steps
    done = int(np.searchsorted(steps.triangle_ends, steps.rows_done(position), "right"))
    has_front = steps.row_count > 0 and found.triangle[0] < 0
    return max(done - 1, 0) if has_front else done


# Trace of the vertex stage: every vertex from space to space, one component after the other.


AXES = ("x", "y", "z", "w")
MATRIX_SPACES = (("model", "object", "world"), ("view", "world", "camera"), ("projection", "camera", "clip"))


def divide_and_map(clip: np.ndarray, width: int, height: int) -> tuple[float, float, float]:
    """Listing of the way from clip space to the window."""
    x, y, z, w = clip
    ndc_x, ndc_y, ndc_z = x / w, y / w, z / w  #: divide
    window_x = (ndc_x + 1) * (width / 2)  #: window_x
    window_y = (ndc_y + 1) * (height / 2)  #: window_y
    depth = (ndc_z + 1) * 0.5  #: depth
    return window_x, window_y, depth


def trace_transform(source: TraceSource) -> StageTrace:
    """Return the rows of every vertex: the statements of the scene's vertex shader, or one row for every space.

    What makes positions before the matrices has its rows in front of those of the corner.
    """
    if has_program(source.scene):
        from core.shaders.traced_stages import trace_vertex_shader

        return trace_vertex_shader(source)
    found = trace_spaces(source)
    if has_curves(source.scene):
        from core.tessellation.traced import tessellation_rows  # Only scenes of curves wait for it.

        found = in_front(found, source, tessellation_rows)
        given = dict.fromkeys(("mix", "mix-row", "mix-column"), ("s", "t"))
        found = replace(found, method=f"tessellation={source.settings.tessellation}", given=given)
    if isinstance(source.scene, Scene) and any(mesh.rest is not None for mesh in source.scene.meshes):
        from core.deformation.traced import deformation_rows  # Only scenes of bones and shapes wait for it.

        found = in_front(found, source, deformation_rows)
        if has_bones(source.scene):
            found = replace(found, method=f"skinning={source.settings.skinning}")
    return found


FrontRows = Callable[[TraceSource, Integers, Integers], Sequence[InsertedRows]]
"""From the vertices and triangles (G,) of the corners that are traced to the rows in front of them.

``before`` and ``group`` of these count the corners; of several records the last one comes first.
"""


def in_front(found: StageTrace, source: TraceSource, front: FrontRows) -> StageTrace:
    """Return a trace of `trace_spaces` with rows (I,) in front of those of its corners (G,), in their groups."""
    first = np.concatenate([[0], found.steps.group_ends[:-1]])
    for rows in front(source, found.columns["vertex"][first], found.triangle[first]):
        ends = found.steps.group_ends
        group = np.repeat(np.arange(len(ends)), np.diff(ends, prepend=0))
        begins = np.concatenate([[0], ends[:-1]])
        found = insert_rows(found, group, replace(rows, before=begins[rows.before]))
    return found


def trace_spaces(source: TraceSource) -> StageTrace:
    """Return one row for every vertex and space; a scene given in clip space starts at the division."""
    vertices = source.geometry.vertices
    triangle = source.geometry.assembled.triangle
    count = vertices.corner_count
    corners = vertices.all_corners[triangle].ravel()
    owner = np.repeat(triangle, count)
    corner = np.tile(np.arange(count), len(triangle))
    kinds = (*(f"{a}-to-{b}" for _, a, b in MATRIX_SPACES), "divide", "viewport")
    first = 0 if vertices.object is not None else 3
    columns = {
        "vertex": np.repeat(corners, 5 - first),
        "corner": np.repeat(corner, 5 - first),
        "before": np.full((len(corners) * (5 - first), 4), np.nan),
        "after": np.full((len(corners) * (5 - first), 4), np.nan),
        "matrix": np.full((len(corners) * (5 - first), 4, 4), np.nan),
    }
    ones = np.ones((len(corners), 1))
    ndc = np.hstack([vertices.ndc[corners], ones])
    window = np.hstack([vertices.window[corners], ones])
    stages = [(vertices.clip[corners], ndc, None), (ndc, window, vertices.viewport)]
    if vertices.object is not None:
        assert vertices.world is not None
        assert vertices.camera is not None
        assert vertices.model is not None
        model = vertices.model[vertices.mesh[owner]]
        spaces = [vertices.object, vertices.world, vertices.camera, vertices.clip]
        matrices = [model, vertices.view, vertices.projection]
        ways = zip(spaces, spaces[1:], matrices, strict=False)
        stages = [(before[corners], after[corners], matrix) for before, after, matrix in ways] + stages
    for place, (before, after, matrix) in enumerate(stages):
        at = slice(place, None, 5 - first)
        columns["before"][at], columns["after"][at] = before, after
        if matrix is not None:
            columns["matrix"][at] = matrix
    by_matrix = tuple(Operation(axis, "fourth", {f"after_{axis}": RETURN}) for axis in AXES)
    by_division = tuple(Operation(axis, "divide", {f"after_{axis}": f"ndc_{axis}"}) for axis in AXES[:3])
    to_window = tuple(
        Operation(axis, label, {f"after_{axis}": label})
        for axis, label in zip(AXES, ("window_x", "window_y", "depth"), strict=False)
    )
    for k, axis in enumerate(AXES):
        columns[f"before_{axis}"], columns[f"after_{axis}"] = columns["before"][:, k], columns["after"][:, k]
    operations = dict.fromkeys(kinds[:3], by_matrix) | {"divide": by_division, "viewport": to_window}
    rows = len(columns["vertex"])
    steps = Steps(
        kinds=kinds,
        kind=np.tile(np.arange(first, 5), len(corners)),
        operations=operations,
        triangle_ends=ends_of(np.repeat(owner, 5 - first)),
        group_ends=ends_of(np.repeat(np.arange(len(corners)), 5 - first)),
    )
    projection = listing(divide_and_map)
    return StageTrace(
        stage="transform",
        method="",
        steps=steps,
        columns=columns,
        triangle=np.repeat(owner, 5 - first),
        pixel=no_pixels(rows),
        listings={kind: listing(transform_component) for kind in kinds[:3]}
        | {"divide": projection, "viewport": projection},
        marks={"nan": ~np.isfinite(columns["after"]).all(axis=1)},
        extra={"vertices": vertices},
        constants={"width": source.scene.size[0], "height": source.scene.size[1]},
    )
