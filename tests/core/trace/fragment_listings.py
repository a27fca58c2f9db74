"""The listings of interpolation, textures and shading, executed on the rows."""

from collections.abc import Callable
from functools import cache
from itertools import chain
from typing import Any

import numpy as np

from core.edits.fragments import GIVEN
from core.edits.typed import parameters_of
from core.interpolation.barycentric import NO_AREA
from core.interpolation.interpolation import ValuePlaces
from core.lines.wireframe_fragments import affine_line_slopes_at, line_slopes_at
from core.methods import table
from core.shading.lighting import blinn_phong, plain_lights, plain_material
from core.shading.shading import shaded_color, unlit_color
from core.shading.traced import slope_kind
from core.stages.environment import surroundings
from core.stages.passes import lamp_of
from core.stages.vertex_light import viewpoint
from core.textures.footprints import slopes_at, slopes_of_one_value
from core.textures.look_up import bilinear_color, nearest_color, uses_mipmaps
from core.textures.mipmaps import level_of_detail, mipmap_color, mipmap_levels, nearest_mipmap_color
from core.trace import Trace
from core.trace.stage_trace import StageTrace
from tests.core.trace.executed_rows import check_marks, equal, lines_that_run, rows_of_kind


def check_interpolate(traced: Trace) -> None:
    found, settings = traced.stage("interpolate"), traced.source.settings
    c, provoking = found.columns, 0 if settings.provoking == "first" else 2
    planes, centers = traced.source.geometry.planes, (c["x"], c["y"])
    at = ValuePlaces(planes, c["primitive"], *centers, provoking, settings.correction_interval)
    listed = table.get("interpolation", settings.interpolation).listing
    kinds = [kind for kind in (settings.interpolation, NO_AREA) if kind in found.steps.kinds]
    for row in chain.from_iterable(rows_of_kind(found, kind) for kind in kinds):
        names = [name for name in parameters_of(listed) if name != "values"]
        given = {name: only(GIVEN[name](at, slice(row, row + 1))) for name in names}
        for k in range(c["values"].shape[1]):
            with np.errstate(all="ignore"):
                weights, *total, value = listed(**given, values=c["corner_values"][row][:, k])
            assert equal(total, [c["total"][row]] if total else [])
            assert equal(weights, c["weights"][row])
            assert equal(value, c["values"][row, k])


def only(value: Any) -> Any:
    """Return the one number of an array (1,), and so of lists of them."""
    if isinstance(value, list):
        return [only(part) for part in value]
    return value[0] if isinstance(value, np.ndarray) else value


def check_shade(traced: Trace) -> None:
    found = traced.stage("shade")
    source, c = traced.source, found.columns
    filters = {"nearest": nearest_color, "bilinear": bilinear_color}
    textures, mesh = found.extra["textures"], found.extra["mesh"]
    values, layout = source.interpolated[1], source.geometry.primitives.layout
    for kind in ("textured", "textured-lit", "textured-mirror"):
        for row in rows_of_kind(found, kind):
            pixels = textures[mesh[row]].pixels.astype(np.float64).tolist()
            u, v = values[row, layout["uv"]].tolist()
            if uses_mipmaps(source.settings.texture_filter):
                color = check_mipmaps(traced, found, row)
            else:
                color = filters[source.settings.texture_filter](pixels, u, v, source.settings.wrap)
            assert equal(color, c["texture_color"][row][: len(color)])
            assert c["texture_color"][row][3] == 1 or len(color) == 4
    for kind in ("lit", "textured-lit"):
        for row in rows_of_kind(found, kind):
            color = shaded_color(c["albedo"][row], c["diffuse_light"][row], c["specular_light"][row])
            assert equal(color, c["color"][row])
    for kind in ("mirror", "textured-mirror"):
        mirrored_color = color_of_mirror(traced)
        for row in rows_of_kind(found, kind):
            own = shaded_color(c["albedo"][row], c["diffuse_light"][row], c["specular_light"][row])
            assert equal(own, c["own_color"][row])
            assert equal(mirrored_color(row, own), c["color"][row])
    for row in rows_of_kind(found, "plain"):
        assert equal(unlit_color(c["albedo"][row]), c["color"][row])
    rows = list(rows_of_kind(found, "textured"))
    assert equal(c["albedo"][rows], c["color"][rows])
    if "normal" in layout:
        check_light(traced, found)


def color_of_mirror(traced: Trace) -> Callable[[int, tuple[float, ...]], tuple[float, ...]]:
    """Return what executes the listing of what is around a mirror at a row, with the fragment's own colour."""
    source, c = traced.source, traced.stage("shade").columns
    listed = table.get("environment", source.settings.environment).listing
    positions = source.interpolated[1][:, source.geometry.primitives.layout.get("position", slice(0))]

    @cache
    def around_of(mirror: int) -> tuple[Any, ...]:
        around = surroundings(source.scene, source.settings, mirror)
        if around.faces:
            return ([face.pixels.astype(np.float64).tolist() for face in around.faces],)

        def shade(triangle: int, weights: list[float], origin: list[float]) -> list[float]:
            return around.shade(np.array([triangle]), np.array([weights]), np.array([origin]))[0].tolist()

        return around.triangles.tolist(), around.least, shade, around.background.tolist()

    def color(row: int, own: tuple[float, ...]) -> tuple[float, ...]:
        given = around_of(int(c["mirror"][row]))
        first = () if len(given) == 1 else (positions[row].tolist(),)
        directions = c["normal"][row].tolist(), c["to_eye"][row].tolist()
        return listed(*first, *directions, *given, own, float(c["mirror_share"][row]))

    return color


def slopes_of(traced: Trace, c, row: int):
    """Return what the listing of the slopes gives for a row."""
    kind, uv = slope_kind(traced.source), c["uv"][row].tolist()
    if kind == "flat":
        return slopes_of_one_value()
    if kind == "area":
        rises = (c[name][row] for name in ("slope_a", "slope_b", "slope_n"))
        return slopes_at(*rises, *uv, *c["corner_uv"][row].T)
    ends, length = c["end_uv"][row], c["length"][row]
    if kind == "affine-line":
        slope = affine_line_slopes_at(length, *ends)
    else:
        _, slope = line_slopes_at(c["t"][row], *c["end_w"][row], length, *ends)
    none = [0.0, 0.0]
    return [*none, *slope] if c["is_steep"][row] else [*slope, *none]


def check_mipmaps(traced: Trace, found: StageTrace, row: int) -> tuple[float, ...]:
    """Execute the listings of slopes and level of detail; return what that of the filter gives."""
    settings, c = traced.source.settings, found.columns
    texture = found.extra["textures"][found.extra["mesh"][row]]
    with np.errstate(all="ignore"):
        slopes = slopes_of(traced, c, row)
        assert equal(slopes, c["uv_slopes"][row])
        *lengths, lod = level_of_detail(*map(float, slopes), *c["texture_size"][row].tolist())
    assert equal(lengths, c["lengths"][row])
    assert equal(lod, c["lod"][row])
    levels = [level.pixels.astype(np.float64).tolist() for level in mipmap_levels(texture)]
    mix = {"trilinear": mipmap_color, "mipmap-nearest": nearest_mipmap_color}[settings.texture_filter]
    for name, number in zip(("near", "far"), c["levels"][row].tolist(), strict=True):
        if name == "near" or settings.texture_filter == "trilinear":
            color = bilinear_color(levels[number], *c["uv"][row].tolist(), settings.wrap)
            assert equal(color, c[f"{name}_color"][row][: len(color)])
    return mix(levels, *c["uv"][row].tolist(), lod, settings.wrap)


def check_light(traced: Trace, found: StageTrace) -> None:
    source, scene = traced.source, traced.source.scene
    values, layout = source.interpolated[1], source.geometry.primitives.layout
    for row in range(0, found.steps.row_count, max(found.steps.row_count // 40, 1)):
        position = values[row : row + 1, layout["position"]]
        eye = np.broadcast_to(viewpoint(scene.camera, position), (1, 3))[0]
        normal = values[row, layout["normal"]]
        material = scene.meshes[found.extra["mesh"][row]].material
        # In a shadow less arrives of a light than its colour.
        arriving = zip(plain_lights(scene.lights), found.columns["light_colors"][row].tolist(), strict=True)
        lights_here = [[place, is_point, color] for (place, is_point, _), color in arriving]
        if "light_share" in found.columns:
            check_shadow(traced, row, tuple(position[0].tolist()))
        with lines_that_run() as ran:
            lights = blinn_phong(
                tuple(position[0].tolist()),
                tuple(normal.tolist()),
                tuple(eye.tolist()),
                lights_here,
                plain_material(material),
                False,
            )
        check_marks(found, row, ran)
        assert equal(lights[0], found.columns["diffuse_light"][row])
        assert equal(lights[1], found.columns["specular_light"][row])


def check_shadow(traced: Trace, row: int, position: tuple[float, ...]) -> None:
    """Execute the listing of the shadow test at a row."""
    found, settings = traced.stage("shade"), traced.source.settings
    lamp, listed = lamp_of(traced.source.scene, settings), table.get("shadow", settings.shadow).listing
    given = (lamp.triangles.tolist(),) if lamp.depth is None else (lamp.depth.tolist(), lamp.bias)
    with lines_that_run() as ran:
        share = listed(position, lamp.to_map.tolist(), *given)
    check_marks(found, row, ran)
    assert equal(share, found.columns["light_share"][row])
