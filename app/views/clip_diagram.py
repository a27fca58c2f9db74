"""Clip space drawn: the view volume, the triangle, and what each plane leaves of it up to the cursor.

Where all corners have w > 0 they are divided by w and drawn in the NDC cube. A corner at w <= 0 has no place
there, so such a triangle is drawn in clip space itself, seen along one of its four axes: along y the axes
x, z and w remain, and the planes z = ±w and x = ±w, which contain the direction of view, stay planes; for
y = ±w it is seen along x.
"""

from collections.abc import Callable
from dataclasses import dataclass, field, replace

import numpy as np

from core.clipping.sutherland_hodgman import distance_from
from core.culling.culling import PLANES, REASONS
from core.records.arrays import Floats, Integers
from core.records.words import nouns
from core.trace import Trace
from core.trace.stage_trace import StageTrace
from widgets.space.diagram import CUBE, Diagram, Patch, Spot, Stroke, Word
from widgets.space.orbit import Orbit

EQUATIONS = ("z = −w", "z = w", "x = −w", "x = w", "y = −w", "y = w")
NDC_EQUATIONS = ("z = −1", "z = 1", "x = −1", "x = 1", "y = −1", "y = 1")
SEEN_OUTSIDE = 2.5
"""A corner outside the cube is seen whole up to here: farther ones would make the cube small."""
SLICE_REACH = 1.15
"""The volume of clip space is drawn up to so many times the largest \\|w\\|."""


@dataclass(frozen=True, eq=False)
class ClipState:
    """One triangle between two steps of clipping."""

    triangle: int
    before: Floats = field(repr=False)
    """(3, 4) clip positions of the triangle."""
    polygon: Floats = field(repr=False)
    """(M, 4) what is left of it so far."""
    emitted: Floats = field(repr=False)
    """(E, 4) new corners that the planes up to now have made."""
    plane: int
    """The plane that is being worked on or has just been done, -1: none."""
    edge: Floats | None = field(repr=False)
    """(2, 4) the edge just looked at, where its plane is not done yet."""
    corner: Floats | None = field(repr=False)
    """(4,) the new corner that the step just done has made."""
    sentence: str = ""
    is_kept_whole: bool = False
    """Whether the step just done has let the triangle pass as it is."""
    corner_count: int = 3
    """Corners of what is drawn: 2 of a segment, 1 of a point."""
    sides: Integers = field(default_factory=lambda: np.array([[1, 2], [2, 0], [0, 1]]), repr=False)
    """(S, 2) the corners that sides run between, see ``VertexStage``."""
    colors: tuple[int, ...] = (0, 1, 2)
    """Of corners and sides."""


def clip_state(trace: Trace, triangle: int, position: int | None) -> ClipState:
    """Return a triangle at a position of the stage ``clip``; ``None``: after its end."""
    corner_count = trace.source.scene.corner_count
    state = _state_of(trace, triangle, position)
    vertices = trace.source.geometry.vertices
    if vertices.rings is not None:
        # Its rings are drawn as sides: they are no single line.
        state = replace(state, polygon=np.empty((0, 4)), is_kept_whole=False)
    sentence = nouns(corner_count).text(state.sentence)
    return replace(
        state, corner_count=corner_count, sentence=sentence, sides=vertices.sides, colors=vertices.colors
    )


def _state_of(trace: Trace, triangle: int, position: int | None) -> ClipState:
    geometry = trace.source.geometry
    stage = trace.stage("clip")
    before = geometry.vertices.clip[geometry.vertices.corners_of(triangle)]
    none = np.empty((0, 4))
    row = -1 if position is None else stage.steps.row_at(position)[0]
    is_now = row >= 0 and stage.triangle[row] == triangle
    kept = np.flatnonzero(geometry.kept.triangle == triangle)
    if geometry.kept_pieces is not None and is_now and stage.columns["kept"][row] >= 0:
        # The piece of the tree that the step is about.
        kept = stage.columns["kept"][[row]]
        before = geometry.kept_pieces.clip[kept[0]]

    def still(polygon: Floats, sentence: str) -> ClipState:
        return ClipState(triangle, before, polygon, none, -1, None, None, sentence, is_now)

    if not len(kept):
        index = np.flatnonzero(geometry.assembled.triangle == triangle)
        reason = REASONS[int(geometry.culled.verdict[index[0]])] if len(index) else "not traced"
        return still(before, f"{{One}} {triangle} was culled ({reason}) and does not get here.")
    clipped = geometry.clipped
    if clipped is None:
        return still(before, "Clipping is off: homogeneous rasterization needs none.")
    found = np.flatnonzero(clipped.clipped == kept[0])
    if not len(found):
        return still(before, "No plane crosses the {one}: it passes unchanged.")
    if clipped.is_divided:
        # From here on the triangle is what the division made of it.
        if not clipped.counts[0][found[0]]:
            return still(before, "A corner cannot be divided by w: the {one} is dropped.")
        before = clipped.polygons[0][found[0], :3, :4]
        if not clipped.planes:
            return still(before, "The {one} after the division by w: no plane clips it.")
    return _clipped_state(trace, stage, int(found[0]), int(kept[0]), triangle, before, position)


def _clipped_state(
    trace: Trace,
    stage: StageTrace,
    which: int,
    kept: int,
    triangle: int,
    before: Floats,
    position: int | None,
) -> ClipState:
    clipped = trace.source.geometry.clipped
    assert clipped is not None
    own = np.flatnonzero(clipped.rows.polygon == which)
    # The trace's rows stand triangle by triangle in the same order within a triangle.
    is_its = (stage.triangle == triangle) & (stage.columns["kept"] == kept)
    rows = np.flatnonzero(is_its & (stage.columns["plane"] != ""))
    done = len(own) if position is None else int(np.searchsorted(rows, stage.steps.rows_done(position)))
    current = -1 if position is None else stage.steps.row_at(position)[0]
    is_current = current >= 0 and len(rows) > 0 and rows[0] <= current <= rows[-1]
    looked_at = int(np.searchsorted(rows, current)) if is_current else done - 1
    if looked_at < 0:
        return ClipState(
            triangle, before, before, np.empty((0, 4)), -1, None, None, "Before the first plane."
        )
    plane = int(clipped.rows.plane[own[looked_at]])
    place = clipped.planes.index(plane)
    of_plane = np.flatnonzero(clipped.rows.plane[own] == plane)
    is_plane_done = done > of_plane[-1]
    level = place + 1 if is_plane_done else place
    polygon = clipped.polygons[level][which, : int(clipped.counts[level][which]), :4]
    corners = clipped.rows.corner[own[:done], :4]
    emitted = corners[np.isfinite(corners).all(axis=1)]
    edge = corner = None
    if not is_plane_done or is_current:
        at = own[looked_at]
        edge = np.stack([clipped.rows.start[at, :4], clipped.rows.end[at, :4]])
        made = clipped.rows.corner[at, :4]
        if np.isfinite(made).all() and done > looked_at:
            corner = made
    count = len(polygon)
    name = PLANES[plane]
    sentence = (
        f"After the {name} plane {count} corners are left."
        if is_plane_done and count
        else f"After the {name} plane nothing is left."
        if is_plane_done
        else f"The {name} plane: edge {int(clipped.rows.edge[own[looked_at]]) + 1} of {len(of_plane)}."
    )
    return ClipState(triangle, before, polygon, emitted, plane, edge, corner, sentence)


def is_in_ndc(state: ClipState) -> bool:
    """Return whether every corner of the triangle can be divided by w."""
    return bool((state.before[:, 3] > 0).all())


def clip_diagram(state: ClipState) -> Diagram:
    """Draw a triangle in clip space."""
    return _ndc_diagram(state) if is_in_ndc(state) else _slice_diagram(state)


def _ndc_diagram(state: ClipState) -> Diagram:
    def place(clip: Floats) -> Floats:
        with np.errstate(divide="ignore", invalid="ignore", over="ignore"):
            return np.asarray(clip[:, :3] / clip[:, 3:] * [1, 1, -1])

    faces = [_cube_face(plane) for plane in range(6)]
    strokes = cube_strokes()
    words = [Word(np.array([1.0, -1.0, 1.0]), "near"), Word(np.array([1.0, -1.0, -1.0]), "far")]
    shapes = _shapes(state, place, faces[state.plane] if state.plane >= 0 else None, NDC_EQUATIONS)
    axes = _axes(np.array([-1.0, -1.0, 1.0]), np.diag([0.5, 0.5, -0.5]), ("x", "y", "z"))
    corners = place(state.before)
    close = corners[(np.abs(corners) <= SEEN_OUTSIDE).all(axis=1)]
    return Diagram(
        patches=shapes.patches,
        strokes=(*strokes, *axes.strokes, *shapes.strokes),
        spots=shapes.spots,
        words=(*shapes.words, *axes.words, *words),
        frame=np.concatenate([CUBE, close]) * 1.05,
        azimuth=0.55,
        elevation=0.35,
        caption=f"{state.sentence} All w > 0, so clip space is shown divided by w: the view volume is "
        "the cube −1 ≤ x, y, z ≤ 1, its near face in front.",
    )


def cube_strokes() -> tuple[Stroke, ...]:
    """Return the edges of the view volume in NDC, its near face in front and a little thicker."""
    near, far = _cube_face(0), _cube_face(1)
    return (
        Stroke(near, "muted_text", 1.4, is_closed=True),
        Stroke(far, "muted_text", 1.0, is_closed=True),
        *(Stroke(np.stack([near[k], far[k]]), "muted_text", 1.0) for k in range(4)),
    )


def _slice_diagram(state: ClipState) -> Diagram:
    across = 1 if state.plane in (4, 5) else 0
    chosen, name = [across, 2, 3], "xy"[across]
    reach = SLICE_REACH * float(np.abs(state.before[:, 3]).max())
    scale = 1 / max(reach, 1e-12)

    def place(clip: Floats) -> Floats:
        # Across to the right, w up, z away from the viewer.
        a, z, w = (clip[:, k] * scale for k in chosen)
        return np.stack([a, w, -z], axis=1)

    base = np.array([[-1.0, 1.0, 1.0], [1.0, 1.0, 1.0], [1.0, 1.0, -1.0], [-1.0, 1.0, -1.0]])
    strokes = [Stroke(base, "muted_text", 1.0, "dash", is_closed=True)]
    strokes += [Stroke(np.stack([np.zeros(3), corner]), "muted_text", 1.3) for corner in base]
    sides = {0: (0, 1), 1: (2, 3), 2: (3, 0), 3: (1, 2), 4: (3, 0), 5: (1, 2)}
    face = None
    if state.plane >= 0:
        i, j = sides[state.plane]
        face = np.stack([np.zeros(3), base[i], base[j]])
    ground = np.array([[-1.0, 0.0, 1.0], [1.0, 0.0, 1.0], [1.0, 0.0, -1.0], [-1.0, 0.0, -1.0]])
    shapes = _shapes(state, place, face, EQUATIONS)
    axes = _axes(np.zeros(3), np.array([[0.6, 0, 0], [0, 0, -0.6], [0, 0.85, 0]]), (name, "z", "w"))
    return Diagram(
        patches=(Patch(ground, "muted_text", 0.08), *shapes.patches),
        strokes=(*strokes, *axes.strokes, *shapes.strokes),
        spots=(*shapes.spots, Spot(np.zeros(3), "text", radius=3.0, label="eye")),
        words=(*shapes.words, *axes.words, Word(ground[1], "w = 0", "muted_text")),
        frame=np.concatenate([base, place(state.before), ground]),
        azimuth=open_azimuth(place(state.before), 0.2),
        elevation=0.2,
        caption=f"{state.sentence} A corner has w ≤ 0 and so no place in the NDC cube: this is clip space "
        f"itself seen along {'x' if across else 'y'}; {name}, z and w remain. Inside are −w ≤ z ≤ w and "
        f"−w ≤ {name} ≤ w, the upright pyramid; below the plane w = 0 lies what is behind the eye.",
    )


def open_azimuth(triangle: Floats, elevation: float) -> float:
    """Return the direction, of a few to the right and the left, from which a triangle (3, 3) looks largest."""
    best, largest = 0.5, 0.0
    for azimuth in (0.5, -0.5, 0.25, -0.25, 0.85, -0.85):
        seen = triangle @ Orbit(azimuth, elevation).axes()[:2].T
        first, second = seen[1] - seen[0], seen[2] - seen[0]
        area = abs(float(first[0] * second[1] - first[1] * second[0]))
        if area > 1.1 * largest:
            best, largest = azimuth, area
    return best


def _shapes(
    state: ClipState, place: Callable[[Floats], Floats], face: Floats | None, equations: tuple[str, ...]
) -> Diagram:
    """Return triangle, polygon, corners and the current plane, which both drawings share."""
    before = place(state.before)
    patches: list[Patch] = []
    strokes: list[Stroke] = []
    spots: list[Spot] = []
    words: list[Word] = []
    if face is not None:
        patches.append(Patch(face, "accent", 0.16))
        strokes.append(Stroke(face, "accent", 1.6, is_closed=True))
        words.append(Word(face.mean(axis=0), f"{PLANES[state.plane]}: {equations[state.plane]}", "accent"))
    is_whole = state.plane < 0
    for ends, color in zip(before[state.sides], state.colors, strict=True):
        strokes.append(
            Stroke(ends, f"vertex {color}", 2.2 if is_whole else 1.4, "solid" if is_whole else "dash")
        )
    if state.is_kept_whole:
        strokes.insert(0, Stroke(before, "accent", 8.0, is_closed=True, opacity=0.6))
    if len(state.polygon):
        polygon = place(state.polygon)
        patches.append(Patch(polygon, "covered", 0.4))
        if not is_whole:
            strokes.append(Stroke(polygon, "text", 2.0, is_closed=True))
    if state.edge is not None:
        strokes.append(Stroke(place(state.edge), "accent", 3.0))
    for clip, corner in zip(state.emitted, place(state.emitted), strict=True):
        is_new = abs(float(distance_from(clip, state.plane))) < 1e-9 * float(np.abs(clip).max())
        is_left = is_new or bool((state.polygon == clip).all(axis=1).any())
        spots.append(Spot(corner, "text" if is_left else "outline", "square", 3.5 if is_left else 2.5))
    if state.corner is not None:
        spots.append(Spot(place(state.corner[None])[0], "accent", "square", 5.0, label="new corner"))
    for k in range(state.corner_count):
        label = f"{k}" if state.before[k, 3] > 0 else f"{k}, w = {state.before[k, 3]:.3g}".replace("-", "−")
        spots.append(Spot(before[k], f"vertex {state.colors[k]}", label=label))
    return Diagram(tuple(patches), tuple(strokes), tuple(spots), tuple(words))


def _axes(origin: Floats, directions: Floats, names: tuple[str, str, str]) -> Diagram:
    strokes = tuple(Stroke(np.stack([origin, origin + d]), "text", 1.6) for d in directions)
    words = tuple(Word(origin + d, n, "text") for d, n in zip(directions, names, strict=True))
    return Diagram(strokes=strokes, words=words)


def _cube_face(plane: int) -> Floats:
    """Return (4, 3) corners of the face of the cube that lies in a plane, z turned towards the viewer."""
    axis = (2, 2, 0, 0, 1, 1)[plane]
    sign = -1.0 if plane % 2 == 0 else 1.0
    if axis == 2:
        sign = -sign
    square = np.array([[-1.0, -1.0], [1.0, -1.0], [1.0, 1.0], [-1.0, 1.0]])
    return np.insert(square, axis, sign, axis=1)
