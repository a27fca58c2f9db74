"""The fragment shader on fragments: in whole quads where it compares neighbours."""

from dataclasses import dataclass
from functools import partial
from typing import Any

import numpy as np

from core.fragments.interpolation import Interpolator, plane_value
from core.fragments.mipmap_samples import mipmap_colors
from core.fragments.textures import texture_colors, uses_mipmaps
from core.framebuffer.depth import clamp_depth
from core.lanes.problem import Problem
from core.lanes.run import Watch, bounded
from core.raster.coverage import Fragments
from core.raster.lines.wireframe import LineFragments
from core.raster.pixel_runs import Raster
from core.records.arrays import Flags, Floats, Integers, Singles
from core.records.primitives import interpolation_form
from core.resolved import resolve
from core.scene import Scene, Texture
from core.settings import Settings
from core.shaders.glsl_types import GlslValue, component_count, from_rows
from core.shaders.record import ShaderProblem
from core.shaders.samplers import Sampler
from core.shaders.shader import SECONDS, Outcome, Shader
from core.shaders.vertex_stage import OUT, uniform_values
from core.stages.geometry import Geometry


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
        from core.raster.lines.wireframe import interpolate_outlines

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
