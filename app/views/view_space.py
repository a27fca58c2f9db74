"""The space that the 3D view shows, and what the step just done was about, marked in it.

Both are reached from clip space by one matrix: back through camera and projection into the world, or from
NDC to a box that is as wide as the picture and has the near plane in front. A corner that is dragged in it
takes the same way back.
"""

from dataclasses import dataclass, replace
from itertools import product
from math import inf

import numpy as np

from app.session.moment import Moment
from app.views.bone_marks import bone_marks
from app.views.box_marks import SpaceMark, box_marks
from core.clipping.planes import clip_segments
from core.clipping.sutherland_hodgman import DEPTH_PLANES, clip_primitives
from core.culling.culling import KEPT, REASONS, plane_distances
from core.culling.traced import WITH_BOX
from core.records.arrays import Floats, Integers, cached_property
from core.records.primitives import Primitives, own_corners
from core.records.words import nouns
from core.scene import AnyScene, Camera, ClipScene, Scene
from core.stages.chosen_triangles import with_triangles
from core.stages.declared import GEOMETRY_STAGES, STAGES
from core.tessellation.scheme import scheme_of
from core.trace import scene_triangle_count
from core.transform.matrices import projection, transform, world_to_camera
from core.transform.traced import SPACES, is_dropped, spaces_reached, triangles_done
from core.transform.vertex_stage import VertexStage
from lessons.scene_edits import check_not_made, set_clip_corner
from widgets.space.orbit import Orbit, fitted, framed_from_eye

# The space that the 3D view shows: the world of a scene, or the view volume of triangles in clip space.


FIELD_OF_VIEW = 0.7
"""Vertical opening angle of the viewing camera, radians."""
LARGEST_WITH_CAMERA = 100
"""Triangles of a scene that is first seen together with its camera; a larger one is a model, which fills the view."""
CAMERA_ASIDE, MODEL_ASIDE = 0.9, -0.7
"""Angles from the camera's direction to where a scene is first seen from, in radians: with its camera at the side, or
a model in a three-quarter view of the front, which looks along +z as mesh files have it."""
EYE_REACH = 25.0
"""An eye farther away than so many radii of the meshes is left out of the whole view."""


@dataclass(frozen=True, eq=False)
class ViewSpace:
    """A scene to be seen from outside its own camera."""

    scene: AnyScene
    vertices: VertexStage
    from_clip: Floats
    """(4, 4) float64, clip space of the scene's own camera to the space that is shown."""
    center: tuple[float, float, float]
    radius: float
    """The whole view shows a sphere of this radius around ``center``."""
    home: Orbit
    """From where it is first seen."""
    whole: Floats
    """(N, 3) what the whole view shows: the meshes and their camera, or the box; of a model nothing, but the sphere."""

    @property
    def is_world(self) -> bool:
        """Whether it is the world of meshes, rather than the box of the view volume."""
        return isinstance(self.scene, Scene)

    @cached_property
    def drawn(self) -> AnyScene:
        """The scene with its positions as they are made: the settings of the view do not make them anew."""
        scene = self.scene
        if not scene.makes_positions:
            return scene
        if isinstance(scene, ClipScene):
            return replace(scene, curves=None)
        made = (replace(mesh, patches=None, deformation=None, rest=None) for mesh in scene.meshes)
        return replace(scene, meshes=tuple(made))

    def place(self, clip: Floats) -> Floats:
        """Return (..., 3) places of clip positions (..., 4); NaN where w <= 0 has none in the box."""
        moved = transform(self.from_clip, clip)
        with np.errstate(divide="ignore", invalid="ignore", over="ignore"):
            placed = moved[..., :3] / moved[..., 3:]
        if not self.is_world:
            placed[clip[..., 3] <= 0] = np.nan
        return np.asarray(placed)

    def corners(self, triangle: int) -> Floats:
        """Return (3, 3) places of a triangle's corners, (C, 3) of a polygon's."""
        vertices = self.vertices.corners_of(triangle)
        if self.vertices.world is not None:
            return np.array(self.vertices.world[vertices, :3])
        return self.place(self.vertices.clip[vertices])

    def volume(self) -> Floats:
        """Return (2, 4, 3): corners of the view volume's near and far face, in turn from the lower left."""
        square = [(-1.0, -1.0), (1.0, -1.0), (1.0, 1.0), (-1.0, 1.0)]
        cube = np.array([[(x, y, z, 1.0) for x, y in square] for z in (-1.0, 1.0)])
        moved = transform(self.from_clip, cube)
        return np.asarray(moved[..., :3] / moved[..., 3:])


def make_space(scene: AnyScene, vertices: VertexStage) -> ViewSpace:
    """Return the space of a scene whose vertices have been transformed."""
    width, height = scene.size
    if isinstance(scene, ClipScene):
        aspect = width / height
        radius = float(np.sqrt(aspect**2 + 2))
        box: Floats = np.diag(np.array([aspect, 1.0, -1.0, 1.0]))
        corners = np.array(list(product((-aspect, aspect), (-1.0, 1.0), (-1.0, 1.0))))
        return ViewSpace(scene, vertices, box, (0.0, 0.0, 0.0), radius, Orbit(0.55, 0.3), corners)
    camera = scene.camera
    matrix: Floats = np.asarray(
        np.linalg.inv(projection(camera, width / height) @ world_to_camera(camera)), np.float64
    )
    assert vertices.world is not None
    low, high = vertices.world[:, :3].min(axis=0), vertices.world[:, :3].max(axis=0)
    size = float(np.linalg.norm(high - low)) / 2
    whole = vertices.world[:, :3]
    if scene_triangle_count(scene) > LARGEST_WITH_CAMERA:
        whole = np.empty((0, 3))
        size = float(np.linalg.norm(vertices.world[:, :3] - (low + high) / 2, axis=1).max())
    elif np.linalg.norm(camera.eye - (low + high) / 2) < EYE_REACH * max(size, 1e-12):
        low, high = np.minimum(low, camera.eye), np.maximum(high, camera.eye)
        size = float(np.linalg.norm(high - low)) / 2
        whole = np.concatenate([whole, camera.eye[None]])
    x, y, z = ((low + high) / 2).tolist()
    back = camera.eye - camera.target
    aside = MODEL_ASIDE if scene_triangle_count(scene) > LARGEST_WITH_CAMERA else CAMERA_ASIDE
    azimuth = float(np.arctan2(back[0], back[2])) + aside
    return ViewSpace(scene, vertices, matrix, (x, y, z), max(size, 1e-9), Orbit(azimuth, 0.4), whole)


def fitted_home(space: ViewSpace, aspect: float) -> Orbit:
    """Return the orbit from which the whole space is first seen; ``aspect`` is width over height."""
    if len(space.whole) and space.radius > 1e-9:
        return framed_from_eye(space.home, space.whole, FIELD_OF_VIEW, aspect)
    return fitted(space.home, space.center, space.radius, aspect)


def viewing_camera(space: ViewSpace, orbit: Orbit) -> Camera:
    """Return the camera that looks at a space from an orbit."""
    eye = orbit.eye(FIELD_OF_VIEW)
    target = np.array(orbit.target)
    distance = float(np.linalg.norm(eye - target))
    reach = float(np.linalg.norm(target - np.array(space.center))) + 100 * space.radius
    return Camera(
        eye=eye,
        target=target,
        field_of_view=FIELD_OF_VIEW,
        near=distance * 1e-3,
        far=distance + min(reach, inf),
    )


def viewing_matrix(camera: Camera, size: tuple[int, int]) -> Floats:
    """Return (4, 4): the space that is shown to clip space of the viewing camera."""
    return np.asarray(projection(camera, size[0] / size[1]) @ world_to_camera(camera))


def viewed_scene(
    space: ViewSpace, scene: AnyScene, camera: Camera, size: tuple[int, int], background: Floats
) -> tuple[AnyScene, Integers | None]:
    """Return ``scene`` as another camera sees it, and which triangle each one drawn is (None: the same).

    Parameters
    ----------
    scene : AnyScene
        The scene of ``space`` or one with fewer of its triangles.
    size : (width, height)
    background : (4,) float64

    Notes
    -----
    A corner at w <= 0 has no place in the box of the view volume, so triangles given in clip space are cut to
    what lies between the near and the far plane. Of polygons the sides are drawn.
    """
    if isinstance(scene, Scene):
        return replace(scene, camera=camera, size=size, background=background), None
    assert scene.attributes is not None
    if scene.corner_count > 3:
        sides, owner = _as_segments(scene, space.vertices.sides)
        drawn_sides, side = viewed_scene(space, sides, camera, size, background)
        return drawn_sides, owner if side is None else owner[side]
    number, count = np.arange(len(scene.clip)), max(scene.corner_count, 1)
    corners = own_corners(np.arange(1), count)[:, 0]
    clip = scene.clip[:, corners]
    whole = Primitives(clip, scene.attributes[:, corners], number, np.zeros_like(number), {})
    by = clip_primitives if count == 3 else clip_segments
    pieces = by(whole, plane_distances(clip), DEPTH_PLANES).primitives
    pieces = pieces.select(np.asarray((pieces.clip[..., 3] > 0).all(axis=1)))
    clip = transform(viewing_matrix(camera, size) @ space.from_clip, pieces.clip)
    kind = "points" if scene.kind == "fragments" else scene.kind
    drawn = ClipScene(clip[:, :count], pieces.varyings[:, :count], size, scene.texture, background, kind=kind)
    return drawn, pieces.triangle


def _as_segments(scene: ClipScene, sides: Integers) -> tuple[ClipScene, Integers]:
    """Return the sides (S, 2) of all polygons as segments, and the polygon (L,) of each."""
    assert scene.attributes is not None
    clip, colors = scene.clip[:, sides].reshape(-1, 2, 4), scene.attributes[:, sides]
    colors = colors.reshape(-1, 2, colors.shape[-1])
    whole = ClipScene(clip, colors, scene.size, background=scene.background, kind="segments")
    return whole, np.repeat(np.arange(len(scene.clip)), len(sides))


def thinned(scene: AnyScene, limit: int) -> tuple[AnyScene, Integers]:
    """Return a scene with every k-th triangle, at most ``limit``, and their numbers (T',)."""
    total = scene_triangle_count(scene)
    chosen = np.arange(0, total, -(-total // limit))
    return with_triangles(scene, chosen), chosen


def move_corner_to(space: ViewSpace, triangle: int, corner: int, place: Floats) -> AnyScene:
    """Return the scene with a corner at a place (3,) of the space that is shown.

    In the world all triangles of the vertex move along. In the box of the view volume the corner keeps its w. Raises
    ValueError if the corner has no place there (w <= 0), or the mesh is flattened so that no vertex can get there.
    """
    scene = space.scene
    if isinstance(scene, ClipScene):
        w = scene.clip[triangle, corner, 3]
        if w <= 0:
            raise ValueError(
                "a corner with w ≤ 0 has no place in the view volume and cannot be dragged there"
            )
        ndc = np.linalg.solve(space.from_clip, np.append(place, 1.0))
        return set_clip_corner(scene, triangle, corner, ndc / ndc[3] * w)
    check_not_made(scene)
    vertex = int(space.vertices.corners[triangle, corner])
    index, local = 0, vertex
    while local >= len(scene.meshes[index].positions):
        local -= len(scene.meshes[index].positions)
        index += 1
    mesh = scene.meshes[index]
    try:
        moved = np.linalg.solve(mesh.transform, np.append(place, 1.0))
    except np.linalg.LinAlgError:
        raise ValueError(
            f"{mesh.name} is flattened by its transform: its vertices cannot be dragged"
        ) from None
    positions = mesh.positions.copy()
    positions[local] = moved[:3] / moved[3]
    meshes = list(scene.meshes)
    meshes[index] = replace(mesh, positions=positions)
    return replace(scene, meshes=tuple(meshes))


# What the step just done was about, marked in the 3D view: corners as they move on, triangles and how they
# face.


MOST_MARKS = 200
"""Corners or arrows that are marked: of more, a part would look like a shape of its own."""
ARROW = 0.16
"""Length of an arrow, as a part of the view's radius."""


def step_marks(moment: Moment, space: ViewSpace) -> list[SpaceMark]:
    """Return the marks of the step just done, the present item last and in the accent."""
    stage, position = moment.cursor.stage, moment.cursor.position
    if stage == "transform":
        return bone_marks(moment.trace.source.scene) + _corner_marks(moment, space, position)
    marks = _point_marks(moment, space)
    if stage == "cull":
        return marks + _facing_marks(moment, space, position)
    if moment.row < 0 or (stage not in GEOMETRY_STAGES and stage != "bin"):
        return marks
    return marks + _outlines(space, moment.triangle)


def is_scene_lit(moment: Moment) -> bool:
    """Return whether every fragment has its colour, so that the scene's lights are no longer future."""
    stage = moment.cursor.stage
    if stage != "shade":
        return STAGES.index(stage) > STAGES.index("shade")
    return moment.is_stage_done


def is_scene_asked(moment: Moment) -> bool:
    """Return whether an exercise asks for what the lights, the nearest surfaces or the blending make of the scene."""
    return moment.is_asked_about and STAGES.index(moment.cursor.stage) >= STAGES.index("shade")


def _point_marks(moment: Moment, space: ViewSpace) -> list[SpaceMark]:
    """Return a disc on every point that has not been dropped: the picture has a single pixel of it."""
    assembled, cursor = moment.trace.source.geometry.assembled.triangle, moment.cursor
    if moment.document.scene.corner_count != 1 or len(assembled) > MOST_MARKS:
        return []
    left = assembled[~is_dropped(moment.trace, cursor.stage, cursor.position)]
    return [SpaceMark(space.corners(number)[:1], "text", shape="disc") for number in left.tolist()]


def _corner_marks(moment: Moment, space: ViewSpace, position: int) -> list[SpaceMark]:
    """Return a dot on every corner that has left its first space, and a ring on the one of the step."""
    source, trace = moment.trace.source, moment.stage_trace
    triangles = source.geometry.assembled.triangle
    reached = spaces_reached(moment.trace, "transform", position)
    started = reached > spaces_reached(moment.trace, "transform", 0)
    marks = []
    numbers, corners = np.nonzero(started)
    vertices = source.geometry.vertices.corners_of(triangles[numbers])[np.arange(len(numbers)), corners]
    _, once = np.unique(vertices, return_index=True)
    for place in once.tolist() if len(once) <= MOST_MARKS else []:
        point = space.corners(int(triangles[numbers[place]]))[corners[place]]
        marks.append(SpaceMark(point[None], "text", shape="disc"))
    row, _ = trace.steps.row_at(position)
    scheme = scheme_of(moment.trace, trace, row)
    if scheme is not None:
        lines, made = (space.place(places) for places in scheme)
        marks += [SpaceMark(line, "text") for line in lines if np.isfinite(line).all()]
        label = "vertex" if trace.kind_of(row) == "emit" else "mixture"
        marks += [
            SpaceMark(point[None], "accent", label, "ring") for point in made if np.isfinite(point).all()
        ]
    elif row >= 0 and trace.columns["corner"][row] >= 0:
        triangle, corner = int(trace.triangle[row]), int(trace.columns["corner"][row])
        number = int(np.flatnonzero(triangles == triangle)[0])
        label = f"vertex {corner}: {SPACES[reached[number, corner]]} space"
        marks.append(SpaceMark(space.corners(triangle)[corner][None], "accent", label, "ring"))
    return marks


def _facing_marks(moment: Moment, space: ViewSpace, position: int) -> list[SpaceMark]:
    """Return an arrow on every kept triangle, and outline and verdict of the one of the step.

    An arrow stands on the front of a triangle. Its end is a disc where the camera sees the front, else a cross.
    """
    source, trace = moment.trace.source, moment.stage_trace
    culled, triangles = source.geometry.culled, source.geometry.assembled.triangle
    row, done = trace.steps.row_at(position)
    if row >= 0 and trace.triangle[row] < 0:
        return box_marks(trace, row, done == len(trace.steps.operations[trace.kind_of(row)]) - 1)
    current = -1 if row < 0 else int(np.flatnonzero(triangles == trace.triangle[row])[0])
    kept = np.flatnonzero(culled.verdict[: triangles_done(trace, position)] == KEPT)
    has_arrows = len(kept) <= MOST_MARKS and source.scene.corner_count == 3
    kept = kept[kept != current]
    marks = _arrows(space, triangles[kept], culled.side[kept], "text") if has_arrows else []
    if current < 0:
        return marks
    triangle, kind = int(triangles[current]), trace.kind_of(row)
    name = f"{nouns(source.scene.corner_count).one} {triangle}"
    marks += _outlines(space, triangle) + (box_marks(trace, row)[-1:] if kind in WITH_BOX else [])
    facing = float(culled.side[current])
    what = f"area {facing / 2:+.4g}" if culled.sight is None else f"N · V {-facing:+.4g}"
    operations = [operation.name for operation in trace.steps.operations.get(kind, ())]
    is_known = culled.sight is None or kind == "kept" or "product" in operations[: done + 1]
    side = f"front, {what}" if facing > 0 else f"back, {what}"
    if is_dropped(moment.trace, "cull", position)[current]:
        label = f"{name}: dropped, {REASONS[int(culled.verdict[current])].replace('-', ' ')}"
        marks.append(SpaceMark(space.corners(triangle).mean(axis=0)[None], "accent", label, "cross"))
    elif not is_known:
        marks.append(SpaceMark(space.corners(triangle).mean(axis=0)[None], "accent", name))
    elif kind not in ("behind", "plane", *WITH_BOX) and source.scene.corner_count == 3:
        at = slice(current, current + 1)
        marks += _arrows(space, triangles[at], culled.side[at], "accent", f"{name}: {side}")
    else:
        place = "behind the eye" if kind == "behind" else f"outside the {trace.columns['plane'][row]} plane"
        what = "kept" if kind == "kept" else f"not {place}"
        label, shape = f"{name}: {what}", "ring" if source.scene.corner_count == 1 else "none"
        marks.append(SpaceMark(space.corners(triangle).mean(axis=0)[None], "accent", label, shape))
    return marks


def _outlines(space: ViewSpace, triangle: int) -> list[SpaceMark]:
    rings = [space.corners(triangle)[ring] for ring in space.vertices.ring_slices]
    return [SpaceMark(np.concatenate([ring, ring[:1]]), "accent") for ring in rings]


def _arrows(
    space: ViewSpace, triangles: Integers, facing: Floats, ink: str, label: str = ""
) -> list[SpaceMark]:
    if not len(triangles):
        return []
    corners = np.stack([space.corners(triangle) for triangle in triangles.tolist()])
    normal = np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0])
    length = np.linalg.norm(normal, axis=1, keepdims=True)
    foot = corners.mean(axis=1)
    tip = foot + normal * (ARROW * space.radius / np.where(length > 0, length, np.inf))
    shapes = ["disc" if side > 0 else "cross" for side in facing.tolist()]
    return [
        SpaceMark(ends, ink, label, shape)
        for ends, shape in zip(np.stack([foot, tip], axis=1), shapes, strict=True)
    ]
