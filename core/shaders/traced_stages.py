"""Stages Transform and Shade of a scene with shaders: their statements, vertex by vertex and fragment by fragment."""

from functools import partial
from typing import Any

import numpy as np

from core.lanes.program import LaneStep
from core.records.arrays import Integers
from core.records.listing import listing
from core.records.steps import Steps, ends_of
from core.scene import Scene
from core.shaders.lane_steps import record_lane
from core.shaders.shader import Shader
from core.shaders.stages import OUT, FragmentLanes, lanes_of, run_lanes, run_vertices
from core.shaders.traced import (
    STATEMENT,
    LaneRows,
    ShaderStageTrace,
    live_lanes,
    occurring_names,
    order_together,
    record_rows,
    remembered,
    shader_listing,
    side_by_side,
    statement_lines,
)
from core.trace.source import TraceSource
from core.trace.stage_trace import BufferTrack, StageTrace, no_pixels
from core.transform.traced import divide_and_map, trace_spaces


def trace_vertex_shader(source: TraceSource) -> StageTrace:
    """Return one row for each statement of each corner's vertex, and its way from clip space to the window."""
    scene = source.scene
    assert isinstance(scene, Scene)
    assert scene.program is not None
    shader, divided = scene.program.shaders[0], trace_spaces(source)
    corners = divided.columns["vertex"][::2]
    mesh, own = _vertices_of_meshes(scene, corners)
    parts = []
    for number in np.unique(mesh):
        at = np.flatnonzero(mesh == number)
        run = partial(_run_corners, scene, int(number), own[at])
        parts.append((at, record_rows(len(at), np.arange(len(at)), run, shader)))
    rows, owner = side_by_side(parts), divided.triangle[::2]
    if source.lanes == "together":
        rows = rows.ordered(order_together(owner[rows.lane], rows.number, rows.lane))

    def steps_of(corner: int) -> tuple[LaneStep, ...]:
        run = partial(_run_corners, scene, int(mesh[corner]), own[corner : corner + 1])
        return _without_prelude(record_lane(run, 0), shader)

    # Statements of a corner, or of a triangle's corners together, then the two divisions of each corner.
    count, kinds = len(rows.lane), len(STATEMENT)
    corner = np.concatenate([rows.lane, np.repeat(np.arange(len(corners)), 2)])
    after = np.arange(len(corner)) >= count
    if source.lanes == "together":
        group = owner[corner] if len(owner) == 0 else np.searchsorted(ends_of(owner), corner, "right")
        order = np.lexsort((np.arange(len(corner)), after, group))
    else:
        order = np.lexsort((np.arange(len(corner)), corner))
    columns = {name: _after_nothing(count, values)[order] for name, values in divided.columns.items()}
    for name, values in _statement_columns(rows, owner[rows.lane], owner).items():
        columns[name] = np.concatenate([values, _missing(values, 2 * len(corners))])[order]
    columns["vertex"], columns["corner"] = (
        np.concatenate([divided.columns[name][::2][rows.lane], divided.columns[name]])[order]
        for name in ("vertex", "corner")
    )
    first = divided.steps.kinds.index("divide")
    kind = np.concatenate([np.zeros(count, np.int64), divided.steps.kind - first + kinds])[order]
    projection = listing(divide_and_map)
    nan = np.concatenate([rows.undefined, divided.marks["nan"]])
    unset = np.concatenate([rows.unset, np.zeros(2 * len(corners), bool)])
    triangle = owner[corner][order]
    return ShaderStageTrace(
        stage="transform",
        method="",
        steps=Steps(
            kinds=("statement", "divide", "viewport"),
            kind=kind,
            operations={**STATEMENT, **{k: divided.steps.operations[k] for k in ("divide", "viewport")}},
            triangle_ends=ends_of(triangle),
            group_ends=_group_ends(source, triangle, corner[order], columns["lane_number"]),
        ),
        columns=columns,
        triangle=triangle,
        pixel=no_pixels(len(order)),
        listings={
            "statement": shader_listing(shader.source, "vertex"),
            "divide": projection,
            "viewport": projection,
        },
        marks={"nan": nan[order]},
        extra={**divided.extra, "corners": corner[order], "unset": unset[order]},
        constants=divided.constants,
        lane_rows=rows,
        steps_of=remembered(steps_of),
        names=occurring_names(shader),
        lines=statement_lines(shader),
    )


def _group_ends(source: TraceSource, triangle: Integers, lane: Integers, number: Integers) -> Integers:
    """Return the ends of groups among rows (R,): of lanes, or of the statements that lanes run together.

    ``number`` is that of the statement, -1 of rows that run none.
    """
    if source.lanes == "together":
        return ends_of(triangle, number, np.where(number < 0, lane, -1))
    return ends_of(lane)


def _run_corners(scene: Scene, number: int, vertex: Integers, watch: Any) -> object:
    assert scene.program is not None
    return run_vertices(scene, scene.program.shaders[0], number, vertex, watch)


def _vertices_of_meshes(scene: Scene, vertex: Integers) -> tuple[Integers, Integers]:
    """Return the mesh of vertices of the scene, and their numbers in it."""
    ends = np.cumsum([len(mesh.positions) for mesh in scene.meshes])
    mesh = np.searchsorted(ends, vertex, "right")
    return mesh, vertex - np.concatenate([[0], ends])[mesh]


def trace_fragment_shader(source: TraceSource) -> StageTrace:
    """Return one row for each statement of each fragment; statements of helpers are in no row."""
    scene, fragments = source.scene, source.fragments
    assert isinstance(scene, Scene)
    assert scene.program is not None
    shader, geometry = scene.program.shaders[1], source.geometry
    lanes = lanes_of(shader, geometry, source.raster, fragments, source.interpolated[1])
    mesh = geometry.primitives.mesh[fragments.primitive]
    parts = []
    for number in np.unique(mesh) if len(mesh) else (0,):  # Without fragments it runs on no lanes.
        at = np.flatnonzero(mesh == number)
        chosen = np.flatnonzero(geometry.primitives.mesh[lanes.primitive] == number)
        place = np.searchsorted(chosen, lanes.lane[at])
        run = partial(_run_fragments, source, lanes, chosen)
        parts.append((at, record_rows(len(chosen), place, run, shader)))
    rows, owner = side_by_side(parts), source.triangle_of_fragment
    if source.lanes == "together":
        rows = rows.ordered(order_together(owner[rows.lane], rows.number, rows.lane))

    def steps_of(fragment: int) -> tuple[LaneStep, ...]:
        lane = int(lanes.lane[fragment])
        chosen = lane // 4 * 4 + np.arange(4) if lanes.in_quads else np.array([lane])
        run = partial(_run_fragments, source, lanes, chosen)
        return _without_prelude(record_lane(run, int(np.searchsorted(chosen, lane))), shader)

    color = source.surface.color
    triangle = owner[rows.lane]
    columns = _statement_columns(rows, triangle, owner)
    columns |= {
        "column": fragments.column[rows.lane],
        "row": fragments.row[rows.lane],
        "primitive": fragments.primitive[rows.lane],
        "color": color[rows.lane],
    }
    pixel = np.stack([columns["column"], columns["row"]], axis=1)
    return ShaderStageTrace(
        stage="shade",
        method="",
        steps=Steps(
            kinds=("statement",),
            kind=np.zeros(len(rows.lane), np.int64),
            operations=STATEMENT,
            triangle_ends=ends_of(triangle),
            group_ends=_group_ends(source, triangle, rows.lane, rows.number),
        ),
        columns=columns,
        triangle=triangle,
        pixel=pixel,
        listings={"statement": shader_listing(shader.source, "fragment")},
        marks={"nan": rows.undefined},
        buffers=_buffers(source, shader, rows, columns["live"], color),
        extra={"mesh": mesh, "unset": rows.unset},
        lane_rows=rows,
        steps_of=remembered(steps_of),
        names=occurring_names(shader),
        lines=statement_lines(shader),
    )


def _run_fragments(source: TraceSource, lanes: FragmentLanes, chosen: Any, watch: Any) -> object:
    assert isinstance(source.scene, Scene)
    return run_lanes(source.scene, source.geometry, source.raster, lanes, chosen, watch)


def _without_prelude(steps: tuple[LaneStep, ...], shader: Shader) -> tuple[LaneStep, ...]:
    """Leave out the declarations of global variables, which have no rows."""
    prelude = {node.place for node in shader.syntax.prelude}
    return tuple(step for step in steps if step.statement.place not in prelude)


def _statement_columns(rows: LaneRows, triangle: Integers, lanes_of: Integers) -> dict[str, Any]:
    live, lanes = live_lanes(rows.number, triangle, lanes_of)
    return {
        "lane": rows.lane,
        "lane_step": rows.step,
        "lane_number": rows.number,
        "line": rows.line,
        "live": live,
        "lanes": lanes,
        "result": rows.result,
    }


def _missing(values: Any, count: int) -> Any:
    return np.full((count, *values.shape[1:]), np.nan if values.dtype.kind == "f" else -1, values.dtype)


def _after_nothing(count: int, values: Any) -> Any:
    """Return a column that has nothing in its first ``count`` rows."""
    return np.concatenate([_missing(values, count), values])


def _buffers(
    source: TraceSource, shader: Shader, rows: LaneRows, live: Any, color: Any
) -> tuple[BufferTrack, ...]:
    """Return the colour, how many lanes run together, every variable that some line stores, and those given."""
    place, shape = source.place, source.raster.shape
    _, before_end = np.unique(rows.lane[::-1], return_index=True)
    last = np.sort(len(rows.lane) - 1 - before_end)
    shown = last[source.goes_on[rows.lane[last]]]

    def track(name: str, at: Integers, values: Any, kind: str) -> BufferTrack:
        initial = np.full((*shape, *values.shape[1:]), np.nan)
        return BufferTrack(name, initial, at, place[rows.lane[at]], values, kind)

    every = np.arange(len(rows.lane))
    tracks = [
        track("fragment color", shown, color[rows.lane[shown]], "color"),
        track("lanes together", every, live.astype(float), "scalar"),
    ]
    _, first = np.unique(rows.lane, return_index=True)
    first.sort()
    layout = source.geometry.primitives.layout
    given = {
        variable.name: (first, source.interpolated[1][rows.lane[first]][:, layout[OUT + variable.name]])
        for variable in shader.inputs
        if variable.qualifier == "in"
        and not variable.name.startswith("gl_")
        and not variable.of.startswith("mat")
    }
    for name, (at, values) in {**rows.stored, **given}.items():
        width = values.shape[1]
        if width >= 3:
            whole = values if width == 4 else np.column_stack([values, np.ones(len(values))])
            tracks.append(track(name, at, whole, "color"))
        elif width == 2:
            tracks += [track(f"{name}.{letter}", at, values[:, k], "scalar") for k, letter in enumerate("xy")]
        else:
            tracks.append(track(name, at, values[:, 0], "scalar"))
    return tuple(tracks)
