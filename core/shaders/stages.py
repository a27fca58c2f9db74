"""The stages that a scene's shaders run: the vertex shader on every vertex, the fragment shader in whole quads."""

from dataclasses import dataclass
from functools import lru_cache, partial
from typing import Any

import numpy as np

from core.coverage.fills import Fragments
from core.coverage.pixel_runs import Raster
from core.depth.depth import clamp_depth
from core.interpolation.interpolation import Interpolator, plane_value
from core.lanes.problem import Problem
from core.lanes.run import Watch, bounded
from core.lines.wireframe import LineFragments
from core.records.arrays import Flags, Floats, Integers, Singles, read_only
from core.records.primitives import ShadedVertices, interpolation_form
from core.resolved import resolve
from core.scene import COORDINATE_LIMIT, Mesh, Scene, Texture
from core.settings import Settings
from core.shaders.glsl_types import GlslValue, component_count, from_rows, rows_of
from core.shaders.linking import scene_uniforms
from core.shaders.record import ShaderProblem, ShaderProgram
from core.shaders.rules import Sampler
from core.shaders.shader import SECONDS, Outcome, Shader
from core.stages.geometry import Geometry
from core.textures.look_up import texture_colors, uses_mipmaps
from core.textures.mipmaps import mipmap_colors
from core.transform.matrices import projection, transform, world_to_camera
from core.transform.vertex_stage import VertexStage, transform_vertices, unit, vertex_normals

# The vertex shader on every vertex of a scene.


OUT = "out "
"""Begins the names of a vertex shader's outs in the layout of what is interpolated."""


@lru_cache(maxsize=2)
def shade_vertices(scene: Scene) -> VertexStage:
    """Run the vertex shader of a scene on every vertex.

    Scenes never change, so the result of the last ones is kept.

    Raises
    ------
    ShaderProblem
        With its place: an endless loop, too much time.
    """
    assert scene.program is not None
    plain, shader = transform_vertices(scene), scene.program.shaders[0]
    outcomes = [_run_mesh(scene, shader, number) for number in range(len(scene.meshes))]
    clip = np.concatenate([rows_of(outcome.values["gl_Position"], lanes) for outcome, lanes in outcomes])
    # A position that is no number, or beyond all limits, has no place: as GLSL leaves it open, it is (0, 0, 0, 0).
    clip = clip.astype(np.float64)
    clip[~np.all(np.abs(clip) <= COORDINATE_LIMIT, axis=1)] = 0
    layout, flat, at = {}, [], 0
    for variable in shader.outputs:
        width = component_count(variable.of)
        layout[OUT + variable.name] = slice(at, at + width)
        if variable.is_flat:
            flat.append(slice(at, at + width))
        at += width
    rows = np.concatenate([_out_rows(shader, outcome, lanes) for outcome, lanes in outcomes])
    return VertexStage(
        clip=read_only(np.ascontiguousarray(clip.T)).T,
        corners=plain.corners,
        mesh=plain.mesh,
        size=scene.size,
        world=_placed_in_world(scene, clip, plain),
        shaded=ShadedVertices(read_only(rows), layout, tuple(flat)),
    )


def _placed_in_world(scene: Scene, clip: Floats, plain: VertexStage) -> Floats:
    """Return where in the world clip positions (N, 4) are seen by the camera, (N, 4); without one the mesh's own."""
    assert plain.world is not None
    width, height = scene.size
    back = np.linalg.inv(projection(scene.camera, width / height) @ world_to_camera(scene.camera))
    moved = transform(np.asarray(back, np.float64), clip)
    with np.errstate(divide="ignore", invalid="ignore", over="ignore"):
        placed = moved / moved[:, 3:]
    return read_only(np.where(np.isfinite(placed).all(axis=1, keepdims=True), placed, plain.world))


def _out_rows(shader: Shader, outcome: Outcome, lanes: int) -> Floats:
    """Return the outs (N, K) of a mesh's vertices; what is not finite becomes 0."""
    columns = []
    for variable in shader.outputs:
        parts: Any = outcome.values[variable.name].parts
        if variable.of.startswith("mat"):
            parts = sum(parts, ())
        columns += [np.broadcast_to(part, (lanes,)) for part in parts]
    rows = np.stack(columns, axis=1).astype(np.float64) if columns else np.zeros((lanes, 0))
    return np.where(np.abs(rows) <= COORDINATE_LIMIT, rows, 0.0)


def _run_mesh(scene: Scene, shader: Shader, number: int) -> tuple[Outcome, int]:
    """Run the shader on all vertices of a mesh."""
    lanes = len(scene.meshes[number].positions)
    return run_vertices(scene, shader, number, np.arange(lanes)), lanes


def run_vertices(
    scene: Scene, shader: Shader, number: int, vertex: Integers, watch: Watch | None = None
) -> Outcome:
    """Run the vertex shader on some vertices (L,) of one of the scene's meshes."""
    mesh = scene.meshes[number]
    given = uniform_values(scene, number) | {
        "gl_VertexID": from_rows("int", vertex[:, None]),
        **attribute_values(mesh, vertex, shader),
    }
    try:
        with bounded(SECONDS):
            return shader.run(given, len(vertex), watch=watch)
    except Problem as problem:
        raise ShaderProblem("vertex", problem.place, problem.sentence) from None


def attribute_values(mesh: Mesh, vertex: Integers, shader: Shader) -> dict[str, GlslValue]:
    """Return the attributes of vertices (L,) of a mesh, in the types that the shader declares."""
    found = {}
    for variable in shader.inputs:
        if variable.qualifier == "in" and not variable.name.startswith("gl_"):
            found[variable.name] = from_rows(variable.of, _attribute(mesh, variable.name)[vertex])
    return found


@lru_cache(maxsize=16)
def _attribute(mesh: Mesh, name: str) -> Floats:
    count = len(mesh.positions)
    if name == "position":
        return np.column_stack([mesh.positions, np.ones(count)])
    if name == "normal":
        given = mesh.normals if mesh.normals is not None else vertex_normals(mesh.positions, mesh.triangles)
        return unit(given)
    if name == "uv":
        return np.zeros((count, 2)) if mesh.uvs is None else mesh.uvs
    return np.ones((count, 4)) if mesh.colors is None else mesh.colors


def uniform_values(scene: Scene, number: int) -> dict[str, GlslValue]:
    """Return the uniforms of a mesh: the scene's matrices, and those of the program."""
    view = world_to_camera(scene.camera)
    model = scene.meshes[number].transform
    both = view @ model
    with np.errstate(all="ignore"):
        upper = both[:3, :3]
        normal = np.linalg.inv(upper).T if abs(np.linalg.det(upper)) > 0 else np.zeros((3, 3))
    width, height = scene.size
    found = {
        "modelMatrix": from_rows("mat4", model),
        "viewMatrix": from_rows("mat4", view),
        "modelViewMatrix": from_rows("mat4", both),
        "projectionMatrix": from_rows("mat4", projection(scene.camera, width / height)),
        "normalMatrix": from_rows("mat3", normal),
        "cameraPosition": from_rows("vec3", scene.camera.eye),
        "isOrthographic": from_rows("bool", scene.camera.projection == "orthographic"),
    }
    assert scene.program is not None
    return found | _own_values(scene, scene.program, number)


def _own_values(scene: Scene, program: ShaderProgram, number: int) -> dict[str, GlslValue]:
    """Return what the user has given the uniforms, and the scene's light and material where he has not."""
    from core.shaders.linking import own_uniforms

    found, values = {}, scene_uniforms(scene, number) | program.values
    for name, of in own_uniforms(program).items():
        numbers = values.get(name, ())
        if len(numbers) != component_count(of):
            continue
        shaped: Any = np.array(numbers)
        if of.startswith("mat"):
            size = int(of[3])
            shaped = shaped.reshape(size, size).T
        found[name] = from_rows(of, shaped)
    return found


# The fragment shader on fragments: in whole quads where it compares neighbours.


@dataclass(frozen=True, eq=False)
class FragmentLanes:
    """The lanes that a fragment shader runs on: L of them, for F fragments."""

    primitive: Integers
    """(L,) int64."""
    column: Integers
    """(L,) int64; of helpers beside the triangle, too."""
    row: Integers
    """(L,) int64."""
    values: Floats
    """(L, K) float64, what was interpolated."""
    lane: Integers
    """(F,) int64, the lane of every fragment."""
    in_quads: bool = False
    """Whether lanes come four by four."""

    def __len__(self) -> int:
        return len(self.primitive)


@dataclass(frozen=True, eq=False)
class ShadedFragments:
    """What a fragment shader gave F fragments."""

    color: Singles
    """(F, 4) float32."""
    discarded: Flags
    """(F,) bool."""


def program_of(scene: object) -> Shader | None:
    """Return the fragment shader of a scene that has one."""
    return scene.program.shaders[1] if isinstance(scene, Scene) and scene.program is not None else None


def run_fragments(
    scene: Scene, geometry: Geometry, raster: Raster, fragments: Fragments, values: Floats
) -> ShadedFragments:
    """Run the scene's fragment shader on F fragments with interpolated ``values`` (F, K).

    Raises
    ------
    ShaderProblem
        With its place: an endless loop, too much time.
    """
    shader = program_of(scene)
    assert shader is not None
    lanes = lanes_of(shader, geometry, raster, fragments, values)
    color, discarded = np.empty((len(lanes), 4), np.float32), np.zeros(len(lanes), bool)
    out = shader.outputs[0].name
    with bounded(SECONDS):
        for start in range(0, len(lanes), shader.block):
            chosen = slice(start, min(start + shader.block, len(lanes)))
            for part in _by_mesh(shader, scene, geometry, lanes, chosen):
                outcome = run_lanes(scene, geometry, raster, lanes, part)
                for k, component in enumerate(outcome.values[out].parts):
                    color[part, k] = component
                discarded[part] = outcome.discarded
    if len(lanes) == len(fragments):
        return ShadedFragments(color, discarded)
    return ShadedFragments(color.take(lanes.lane, axis=0), discarded.take(lanes.lane))


def discarded_fragments(
    scene: object, geometry: Geometry, raster: Raster, fragments: Fragments
) -> Flags | None:
    """Return (F,) bool, which fragments the shader discards, before the depth test; ``None``: it discards none.

    Notes
    -----
    The shader of a pixel runs at its centre, also where several samples are tested.
    """
    shader = program_of(scene)
    if shader is None or not shader.discards:
        return None
    assert isinstance(scene, Scene)
    if any(geometry.shift):
        geometry = geometry.moved(-geometry.shift[0], -geometry.shift[1])
    values = _values_at(geometry, raster, fragments)
    return run_fragments(scene, geometry, raster, fragments, values).discarded


def _values_at(geometry: Geometry, raster: Raster, fragments: Fragments) -> Floats:
    if _along_outline(geometry, fragments):
        from core.lines.wireframe import interpolate_outlines

        assert isinstance(fragments, LineFragments)
        assert geometry.outlines is not None
        varyings = geometry.primitives.varyings
        mode = geometry.settings.interpolation
        return interpolate_outlines(geometry.outlines, varyings, fragments, raster.center, mode)[1]
    interpolator = Interpolator(
        geometry.planes, geometry.primitives.values, *resolve(geometry.settings).interpolation
    )
    return interpolator.values(fragments.primitive, *raster.centers(fragments.column, fragments.row))


def _along_outline(geometry: Geometry, fragments: Fragments) -> bool:
    is_flat = interpolation_form(geometry.settings.interpolation) == "flat"
    return isinstance(fragments, LineFragments) and not is_flat


def lanes_of(
    shader: Shader, geometry: Geometry, raster: Raster, fragments: Fragments, values: Floats
) -> FragmentLanes:
    """Return the lanes of fragments: one each, or whole quads; the pixels of lines have no quads."""
    if not shader.needs_quads or isinstance(fragments, LineFragments):
        return FragmentLanes(
            fragments.primitive, fragments.column, fragments.row, values, np.arange(len(fragments))
        )
    across = int(fragments.column.max(initial=0)) // 2 + 1
    rows = int(fragments.row.max(initial=0)) // 2 + 1
    quad = (fragments.primitive * rows + fragments.row // 2) * across + fragments.column // 2
    every, number = np.unique(quad, return_inverse=True)
    place, column = np.divmod(every, across)
    primitive, row = np.divmod(place, rows)
    primitive = np.repeat(primitive, 4)
    columns = (2 * column[:, None] + (0, 1, 0, 1)).ravel()
    in_rows = (2 * row[:, None] + (0, 0, 1, 1)).ravel()
    whole = _values_at(geometry, raster, Fragments(primitive, columns, in_rows))
    lane = 4 * number.reshape(-1) + 2 * (fragments.row & 1) + (fragments.column & 1)
    # What is known of the fragments themselves stays as it is.
    whole[lane] = values
    return FragmentLanes(primitive, columns, in_rows, whole, lane, True)


def _by_mesh(
    shader: Shader, scene: Scene, geometry: Geometry, lanes: FragmentLanes, chosen: slice
) -> list[Any]:
    """Return the lanes of a block in parts whose uniforms are the same."""
    if len(scene.meshes) == 1:
        return [chosen]
    mesh = geometry.primitives.mesh[lanes.primitive[chosen]]
    return [chosen.start + np.flatnonzero(mesh == number) for number in np.unique(mesh)]


def run_lanes(
    scene: Scene,
    geometry: Geometry,
    raster: Raster,
    lanes: FragmentLanes,
    chosen: Any,
    watch: Watch | None = None,
) -> Outcome:
    """Run the fragment shader on chosen lanes of one mesh."""
    shader = program_of(scene)
    assert shader is not None
    primitive = lanes.primitive[chosen]
    number = int(geometry.primitives.mesh[primitive[0]]) if len(primitive) else 0
    given = uniform_values(scene, number)
    _add_ins(given, shader, geometry, lanes.values[chosen])
    _add_own(given, shader, geometry, raster, primitive, lanes.column[chosen], lanes.row[chosen])
    for variable in shader.inputs:
        if variable.of == "sampler2D":
            colors_of = partial(texture_colors_of, geometry.settings)
            sampler = Sampler((scene.meshes[number].texture,), colors_of)
            given[variable.name] = GlslValue("sampler2D", (sampler,))
    try:
        return shader.run(given, len(primitive), watch=watch)
    except Problem as problem:
        raise ShaderProblem("fragment", problem.place, problem.sentence) from None


def texture_colors_of(settings: Settings, texture: Texture, uv: Floats, slopes: Floats | None) -> Floats:
    """Return the colours (L, 4) of a texture by the filter and wrap of the settings."""
    if not uses_mipmaps(settings.texture_filter):
        return texture_colors(texture, uv, settings.texture_filter, settings.wrap)
    if slopes is None:
        slopes = np.zeros((4, len(uv)))
    return mipmap_colors(texture, uv, slopes, settings.texture_filter, settings.wrap)


def _add_ins(given: dict[str, GlslValue], shader: Shader, geometry: Geometry, values: Floats) -> None:
    """Put the interpolated in variables into what is given."""
    layout = geometry.primitives.layout
    for variable in shader.inputs:
        if variable.qualifier != "in" or variable.name.startswith("gl_"):
            continue
        of_variable = values[:, layout[OUT + variable.name]]
        if variable.of.startswith("mat"):
            size = int(variable.of[3])
            parts = np.ascontiguousarray(of_variable.T.astype(np.float32))
            columns = tuple(tuple(parts[size * c : size * c + size]) for c in range(size))
            given[variable.name] = GlslValue(variable.of, columns)
        else:
            whole = np.rint(of_variable) if variable.of.startswith("i") else of_variable
            assert whole.shape[1] == component_count(variable.of)
            given[variable.name] = from_rows(variable.of, whole)


def _add_own(
    given: dict[str, GlslValue],
    shader: Shader,
    geometry: Geometry,
    raster: Raster,
    primitive: Integers,
    column: Integers,
    row: Integers,
) -> None:
    """Put gl_FragCoord and gl_FrontFacing into what is given, if the shader reads them."""
    if "gl_FragCoord" in shader.mentioned:
        x, y = raster.centers(column, row)
        depth, _ = clamp_depth(
            plane_value(geometry.depth_plane, primitive, x, y), geometry.is_in_range[primitive]
        )
        inverse_w = plane_value(geometry.inverse_w_plane, primitive, x, y)
        given["gl_FragCoord"] = from_rows("vec4", np.stack([x, y, depth, inverse_w], axis=1))
    if "gl_FrontFacing" in shader.mentioned:
        given["gl_FrontFacing"] = from_rows("bool", (geometry.doubled_area[primitive] > 0)[:, None])
