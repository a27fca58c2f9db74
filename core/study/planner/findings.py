"""What a scene contains: signs of w, closedness, layers, texels, light; and how fine a tessellation is enough.

An edge of length l whose ends' normals are an angle t apart is the chord of an arc of radius l / (2 sin(t/2)); the arc
rises (l/2) tan(t/4) above it, its sagitta. A sphere of radius r with n edges around has the sagitta r (1 - cos(pi/n)).
It falls with the square of the edge, so with the number of triangles.
"""

from dataclasses import dataclass, replace
from math import acos, ceil, pi

import numpy as np

from core.coverage.pixel_runs import make_raster
from core.culling.culling import PLANE_BITS, has_bits, joined_bits, outcodes
from core.interpolation.interpolation import value_plane
from core.pipeline import draw
from core.records.arrays import Floats, Integers
from core.records.frame import StageCount
from core.records.words import counted, noun_of, nouns
from core.resolved import resolve
from core.scene import AnyScene, ClipScene, Scene, Texture
from core.settings import DEFAULTS, WHOLE_NUMBERS, Settings
from core.stages.before_matrices import before_matrices, tessellated
from core.stages.closed_meshes import is_closed
from core.stages.declared import STAGES
from core.stages.fragment_color import vertex_stage
from core.stages.geometry import Geometry
from core.stages.passes import planned_passes
from core.stages.vertices import process_geometry
from core.study.planner.records import Fact, Tessellation, figure
from core.study.planner.trials import far_triangles
from core.transform.vertex_stage import unit

# How fine a tessellation is enough: how far facets lie from the smooth surface that the normals describe.


WANTED = 0.25
"""Pixels that a facet may lie away."""


def tessellations(scene: AnyScene, settings: Settings = DEFAULTS) -> tuple[Tessellation, ...]:
    """Return advice for every mesh or curve of a scene, cut as the settings say; none where a vertex shader bends it.

    It is not applied.
    """
    scene = before_matrices(scene, settings)
    if not isinstance(scene, Scene):
        return _of_curves(scene, settings)
    if scene.program is not None:
        return ()
    vertices = vertex_stage(scene)
    assert vertices.normals is not None
    found = []
    for number, mesh in enumerate(scene.meshes):
        corners = vertices.corners[vertices.mesh == number]
        window, w = vertices.window[:, :2][corners], vertices.clip[:, 3][corners]
        in_front = (w > 0).all(axis=1)
        largest = 0.0
        for start in range(3):
            end = (start + 1) % 3
            turned = angle(vertices.normals[corners[:, start]], vertices.normals[corners[:, end]])
            length = np.linalg.norm(window[:, end] - window[:, start], axis=1)
            largest = max(largest, float(sagitta(length, turned)[in_front].max(initial=0.0)))
        found.append(_advice(mesh.name, len(corners), largest))
    return tuple(found)


def _of_curves(scene: ClipScene, settings: Settings) -> tuple[Tessellation, ...]:
    """Return advice for every curve whose points are all in front of the eye."""
    if scene.curves is None:
        return ()
    # Only scenes of curves wait for these.
    from core.tessellation.measured import deviation
    from core.tessellation.segments import TOLERANCE_PARTS

    found, made = [], tessellated(scene, settings)
    to_wanted = replace(settings, tessellation="bound", curve_tolerance=round(WANTED * TOLERANCE_PARTS))
    wanted = tessellated(scene, to_wanted)
    for number, control in enumerate(scene.curves.control):
        if not (control[:, 3] > 0).all():
            continue
        away, count, enough = (
            deviation(scene, settings, number),
            len(made.cuts[number].step) - 1,
            len(wanted.cuts[number].step) - 1,
        )
        text = (
            f"curve {number}: its {counted(count, 'segment')} {noun_of(count, 'lies', 'lie')} up to {away:.3g} pixels "
            f"away; {counted(enough, 'equal step')} of t {noun_of(enough, 'is', 'are')} surely within {WANTED:g}."
        )
        found.append(Tessellation(f"curve {number}", count, away, enough, text))
    return tuple(found)


def angle(first: Floats, second: Floats) -> Floats:
    """Return the angles (Q,) between unit vectors (Q, 3), accurate for small ones too."""
    apart, together = (np.linalg.norm(each, axis=-1) for each in (first - second, first + second))
    return np.asarray(2 * np.arctan2(apart, np.maximum(together, 1e-300)))


def sagitta(length: Floats, turned: Floats) -> Floats:
    """Return how far an arc over chords of ``length`` (E,), whose ends are ``turned`` (E,) radians, rises."""
    return np.asarray(length / 2 * np.tan(np.minimum(turned, pi / 2) / 4))


def _advice(name: str, count: int, deviation: float) -> Tessellation:
    wanted = max(ceil(count * deviation / WANTED), 1)
    if deviation == 0:
        text = f"{name}: the normals are those of flat faces, so {count:,} triangles are right."
        return Tessellation(name, count, 0.0, count, text)
    way = "fewer are enough" if wanted < count else "more look rounder"
    text = (
        f"{name}: facets lie up to {deviation:.3g} pixels from the smooth surface; {way}, about {wanted:,} triangles "
        f"for {WANTED:g} pixels instead of {count:,}."
    )
    return Tessellation(name, count, deviation, wanted, text)


# What a scene contains: signs of w, closedness, layers, texels, light. Facts to be read, and reasons'
# numbers.


OPAQUE = 1 - 1e-9
"""Alphas from here on are 1, but for rounding."""


@dataclass(frozen=True, eq=False)
class Seen:
    """What was counted and measured in a scene before anything was tried."""

    triangles: int
    behind: int
    """Triangles with a corner that is not in front of the eye."""
    cut: int
    """Triangles that cross a plane of the view volume, or lie beyond one."""
    backs: int
    """Triangles and pieces in view that face away."""
    in_view: int
    """Triangles and pieces in view."""
    w_ratio: float
    """Largest w over smallest in a triangle."""
    layers: int
    """Most fragments in a pixel, where it was looked at."""
    failing: int
    """Fragments that fail the depth test there, so that an early test leaves their shading out; 0: it may not."""
    fragments: int
    """Fragments there."""
    covered: int
    """Pixels there with a fragment."""
    overlapped: int
    """Pixels there with several."""
    pixels: int
    """Of the whole picture."""
    depth: tuple[float, float] | None
    """Least and greatest window depth; ``None``: nothing is in view."""
    far: dict[str, Integers]
    """By depth method, the triangles of which a fragment may be lost, see `far_triangles`."""
    hidden: tuple[int, int] | None
    """Triangles hidden behind the largest meshes, and how many such occluders; ``None``: there are no other meshes."""
    bias: tuple[str, float] | None
    """The shadow bias of the settings, and the share of the lit surface that needs no more; ``None``: no map."""
    reflection: tuple[float, float] | None
    """Largest error of a mirrored direction at the corners of mirrors, in degrees and texels; ``None``: no map."""
    texels: float | None
    """Longest step from pixel to pixel in a texture, at the corners of triangles; ``None``: there is none."""
    lean: float | None
    """Largest angle, in degrees, of a normal from the middle of its triangle's; ``None``: nothing is lit."""
    highlight: float | None
    """Degrees within which the narrowest highlight falls to half its light; ``None``: there is none."""
    is_moving: bool
    """Whether something moves between pictures."""
    is_translucent: bool
    """Whether some alpha is below 1."""
    closed: str
    """How many meshes are closed."""
    corner_count: int
    """Of the scene's primitives."""


def look(scene: AnyScene, everything: Settings, regions: tuple[tuple[int, int, int, int], ...]) -> Seen:
    """Count and measure; fragments are counted in some regions (column, row, columns, rows) of the picture."""
    one = replace(everything, antialiasing="none", polygon_mode="fill")
    geometry = process_geometry(scene, one, {stage: StageCount() for stage in STAGES})
    frames = [draw(scene, one, make_raster(scene.size, one.pixel_center, region)) for region in regions]
    assembled, primitives = geometry.assembled, geometry.primitives
    w = primitives.clip[..., 3]
    depth = geometry.depth[np.isfinite(geometry.depth)]
    planes = has_bits(joined_bits(outcodes(assembled.vertex_clip.T), assembled.corner), PLANE_BITS)
    return Seen(
        triangles=len(assembled),
        behind=int(np.count_nonzero((assembled.vertex_clip[3].take(assembled.corner) <= 0).any(axis=0))),
        cut=int(np.count_nonzero(planes)),
        backs=int(np.count_nonzero(geometry.doubled_area < 0)),
        in_view=len(primitives),
        w_ratio=float((w.max(axis=1) / w.min(axis=1)).max(initial=1.0)),
        layers=max(int(frame.cover_count.max(initial=0)) for frame in frames),
        failing=sum(
            frame.statistics["depth"].incoming - frame.statistics["depth"].outgoing for frame in frames
        )
        if scene.program is None and everything.polygon_mode == "fill"
        else 0,
        fragments=sum(frame.statistics["depth"].incoming for frame in frames),
        covered=sum(int(np.count_nonzero(frame.cover_count)) for frame in frames),
        overlapped=sum(int(np.count_nonzero(frame.cover_count > 1)) for frame in frames),
        pixels=scene.size[0] * scene.size[1],
        depth=(float(depth.min()), float(depth.max())) if depth.size else None,
        far=far_triangles(geometry),
        hidden=_hidden(scene, everything),
        bias=_bias(scene, everything),
        reflection=_reflection(scene, everything, geometry),
        texels=_longest_step(geometry, scene),
        lean=_lean(geometry),
        highlight=_highlight(scene) if "normal" in primitives.layout else None,
        is_moving=scene.motion is not None and not scene.motion.is_rest,
        is_translucent=_is_translucent(geometry, scene),
        closed=_closed(scene),
        corner_count=scene.corner_count,
    )


def facts_of(seen: Seen) -> tuple[Fact, ...]:
    """Return the facts in pipeline order."""
    drawn = nouns(seen.corner_count)
    many = drawn.many.capitalize()
    facts = [
        Fact("triangles", many, f"{seen.triangles:,}"),
        Fact(
            "w-signs",
            drawn.text("{Many} with {a_corner} that is not in front of the eye"),
            f"{seen.behind:,}",
        ),
        Fact(
            "cut",
            f"{many} that cross a plane of the view volume, or lie beyond one",
            f"{seen.cut:,} of {seen.triangles:,}",
        ),
        Fact("backs", f"{many} in view that face away", f"{seen.backs:,} of {seen.in_view:,}"),
        Fact("w-ratio", f"Largest ratio of w in a {drawn.one}", f"{seen.w_ratio:.4g}"),
        Fact("closed", "Closed meshes", seen.closed),
        Fact("layers", "Fragments in a pixel, at most", f"{seen.layers:,}"),
        Fact("depth-range", "Window depth", _depth_range(seen)),
    ]
    if seen.corner_count < 3:
        # Without an area nothing faces away, and nothing is closed.
        facts = [fact for fact in facts if fact.name not in ("backs", "closed")]
    if seen.hidden is not None:
        hidden, occluders = seen.hidden
        behind = f"Triangles hidden behind {counted(occluders, 'large mesh', 'large meshes')}"
        facts.append(Fact("hidden", behind, f"{hidden:,} of {seen.triangles:,}"))
    if seen.bias is not None:
        bias, share = seen.bias
        facts.append(
            Fact("bias", f"Lit surface that needs no more than a bias of {bias}", f"{100 * share:.3g} %")
        )
    if seen.reflection is not None:
        angle_off, texels = seen.reflection
        off = f"{angle_off:.3g} degrees, {texels:.3g} texels"
        facts.append(Fact("reflection", "Largest error of a mirrored direction, at corners of mirrors", off))
    if seen.texels is not None:
        facts.append(Fact("texels", "Longest step of a pixel in a texture", f"{figure(seen.texels)} texels"))
    if seen.lean is not None:
        facts.append(
            Fact(
                "normals",
                f"Largest angle of a normal from its {drawn.one}'s mean",
                f"{seen.lean:.3g} degrees",
            )
        )
    return tuple(facts)


def _hidden(scene: AnyScene, settings: Settings) -> tuple[int, int] | None:
    """Return how many triangles occlusion culling drops with their meshes, and how many occluders it draws."""
    if not isinstance(scene, Scene) or scene.program is not None or len(scene.meshes) < 2:
        return None
    if not all(mesh.is_affine for mesh in scene.meshes):
        return None
    chosen = replace(DEFAULTS, object_culling="occlusion", hierarchy="none", occluders=settings.occluders)
    culled = process_geometry(scene, chosen, {stage: StageCount() for stage in STAGES}).culled.objects
    assert culled is not None
    assert culled.occlusion is not None
    return int(np.count_nonzero(culled.is_hidden)), len(culled.occlusion.occluders)


def _bias(scene: AnyScene, settings: Settings) -> tuple[str, float] | None:
    """Return the shadow bias in words, and the share of the lit surface that it keeps out of its own shadow."""
    if not any(planned.name == "shadow-map" for planned in planned_passes(scene, settings)):
        return None
    from core.shading.measured_shadows import needed_biases  # Only scenes with a map wait for it.

    assert isinstance(scene, Scene)
    needed, share = needed_biases(scene, settings)
    return WHOLE_NUMBERS["shadow_bias"].label.format(settings.shadow_bias), float(
        share[needed <= settings.shadow_bias].sum()
    )


def _reflection(scene: AnyScene, settings: Settings, geometry: Geometry) -> tuple[float, float] | None:
    if not isinstance(scene, Scene) or resolve(settings).environment is None:
        return None
    from core.shading.measured_environment import largest_error  # Only scenes of mirrors wait for it.

    return largest_error(scene, settings, geometry.primitives)


def _depth_range(seen: Seen) -> str:
    if seen.depth is None:
        return "nothing is in view"
    nearest, farthest = seen.depth
    return f"{nearest:.6g} to {farthest:.6g}, {(farthest - nearest) * (2**16 - 1):,.0f} steps of 16 bits"


def _closed(scene: AnyScene) -> str:
    if not isinstance(scene, Scene):
        return f"not known: {nouns(scene.corner_count).many} given one by one"
    found = sum(is_closed(mesh.positions, mesh.triangles) for mesh in scene.meshes)
    return f"{found:,} of {len(scene.meshes):,}"


def _textures(scene: AnyScene) -> list[Texture | None]:
    return [mesh.texture for mesh in scene.meshes] if isinstance(scene, Scene) else [scene.texture]


def _longest_step(geometry: Geometry, scene: AnyScene) -> float | None:
    """Return the longest step in texels; ``None``: no texture is in view.

    Notes
    -----
    With U = u/w and D = 1/w linear over the window, du/dx is (U_x - u D_x) w.
    """
    primitives, longest = geometry.primitives, None
    for number, texture in enumerate(_textures(scene)):
        of_mesh = primitives.mesh == number
        if texture is None or "uv" not in primitives.layout or not of_mesh.any():
            continue
        uv = primitives.varyings[..., primitives.layout["uv"]]
        w = primitives.clip[..., 3]
        height, width = texture.pixels.shape[:2]
        for way in (0, 1):
            of_depth = geometry.inverse_w_plane[way][:, None]
            steps = [
                (value_plane(geometry.planes, uv[..., k])[way][:, None] - uv[..., k] * of_depth) * w * size
                for k, size in enumerate((width, height))
            ]
            length = np.nan_to_num(np.hypot(*steps)[of_mesh])
            longest = max(longest or 0.0, float(length.max()))
    return longest


def _lean(geometry: Geometry) -> float | None:
    primitives = geometry.primitives
    if "normal" not in primitives.layout:
        return None
    normals = unit(primitives.varyings[..., primitives.layout["normal"]])
    middle = unit(normals.mean(axis=1))
    return float(np.degrees(angle(normals, middle[:, None]).max(initial=0.0)))


def _highlight(scene: AnyScene) -> float | None:
    if not isinstance(scene, Scene):
        return None
    shiny = [mesh.material.shininess for mesh in scene.meshes if mesh.material.specular > 0]
    return float(np.degrees(half_width(max(shiny)))) if shiny else None


def half_width(shininess: float) -> float:
    """Return the angle, in radians, at which a highlight has half its light: cos(angle)^shininess = 1/2."""
    return acos(0.5 ** (1 / shininess)) if shininess > 0 else pi / 2


def _is_translucent(geometry: Geometry, scene: AnyScene) -> bool:
    primitives = geometry.primitives
    alpha = primitives.varyings[..., primitives.layout.get("color", slice(0))][..., 3:4]
    textures = (texture.pixels for texture in _textures(scene) if texture is not None)
    return bool((alpha < OPAQUE).any()) or any(
        texels.shape[2] == 4 and bool((texels[..., 3] < OPAQUE).any()) for texels in textures
    )
