"""Normals of triangles in camera space, packed: a direction is linear over the window, three fields in one word.

A normal divided by w is linear over the window, and dividing all of it by one number does not turn it; so the three
components are packed into one 64-bit word, looked up for every visible pixel by three reads, and made a unit vector
there: perspective-correct without a division by w.
"""

import numpy as np

from core.arrays import Flags, Floats, Integers, Singles
from core.geometry.matrices import world_to_camera
from core.geometry_record import Geometry
from core.integer_planes import FieldPlane, IntegerPlanes, integer_planes, window_slopes
from core.picture.job import Job
from core.picture.lit.corner_places import CornerPlaces
from core.picture.lit.pixel_light import make_unit
from core.picture.lit.vertex_facts import VertexFacts, least_cosine
from core.raster.spans.arena import Arena
from core.scene import Camera

BITS = 19
"""Bits of the fraction of a component."""
OFFSET = 1.25
"""Added to components, from -1 to 1, so that they are positive by more than rounding."""
FIELD = 21
"""Bits from one component to the next."""
ALIKE = 0.2
"""Least cosine between the normals of a triangle: with less, those between them become too short."""
MOST_UNLIKE = 0.25
"""Part of the triangles that may have normals less alike: these are coloured in another way."""
RATIO = 2.0
"""Largest ratio of w within a triangle, likewise."""
FORWARD = np.array([[0.0], [0.0], [1.0]])
"""Any direction."""
STEEPEST = 2.0**60
"""Units of a component a pixel; steeper planes are seen edge-on."""


def corner_w(geometry: Geometry) -> list[Floats]:
    """Return w of the three corners, (P,) float64 each."""
    return [geometry.primitives.vertex_clip[3].take(index) for index in geometry.primitives.corner]


def pack_normals(
    job: Job,
    camera: Camera,
    facts: VertexFacts,
    w: list[Floats],
    places: CornerPlaces,
) -> tuple[IntegerPlanes, Flags] | None:
    """Return the normals of all primitives as words over the window, and which of them hold too different ones.

    Parameters
    ----------
    facts : VertexFacts
        Of the values at the vertices.
    w : list of three (P,) float64 arrays
        From `corner_w`; all above 0.
    places : CornerPlaces
        Where the corners lie in the window.

    Returns
    -------
    normals : IntegerPlanes
    is_unlike : (P,) bool
        Where they point anywhere: the normals at the corners are less alike than `ALIKE`.

    ``None`` is returned where w differs by more than `RATIO` in a triangle, the normals are unlike in more than
    `MOST_UNLIKE` of them, or a plane is too steep.
    """
    normal = world_to_camera(camera)[:3, :3] @ facts.normals
    corners = [normal.take(index, axis=1) for index in job.geometry.primitives.values.index]
    least = np.minimum(np.minimum(w[0], w[1]), w[2])
    greatest = np.maximum(np.maximum(w[0], w[1]), w[2])
    if not float((greatest / least).max(initial=1)) <= RATIO:
        return None
    # Where nothing is cut the triangles are some of the mesh's, which mostly are alike all over.
    is_unlike = np.zeros(len(least), bool)
    if job.geometry.clipped is not None or not facts.least_cosine >= ALIKE:
        is_unlike = ~(least_cosine(corners) >= ALIKE)
        if np.count_nonzero(is_unlike) > MOST_UNLIKE * len(is_unlike):
            return None
        for corner in corners:
            corner[:, is_unlike] = FORWARD
    unit = 2.0**BITS
    for corner, of_corner in zip(corners, w, strict=True):
        corner *= least / of_corner * unit
    across, up = window_slopes(places.x, places.y, places.doubled_area, *corners)
    if not max(float(np.abs(across).max(initial=0)), float(np.abs(up).max(initial=0))) < STEEPEST:
        return None
    fields = [
        FieldPlane(corners[0][axis] + OFFSET * unit, across[axis], up[axis], FIELD * axis)
        for axis in range(3)
    ]
    return integer_planes(places.x[0], places.y[0], job.raster.center, fields), is_unlike


def unit_normals(
    planes: IntegerPlanes, job: Job, primitive: Integers, column: Integers, row: Integers
) -> Singles:
    """Return the unit normals (3, F) float32 of primitives (F,) at pixels, in the job's arena."""
    return make_unit(_components(planes.at(primitive, column, row), job.arena), job.arena)


def _components(word: Integers, arena: Arena) -> Singles:
    """Return the components (3, F) float32 of packed normals (F,) int64."""
    components = arena("components", 3, len(word), dtype=np.float32)
    field = arena("field", len(word), dtype=np.int64)
    for axis, component in enumerate(components):
        np.right_shift(word, FIELD * axis, out=field)
        field &= (1 << FIELD) - 1
        np.copyto(component, field, casting="unsafe")
    components *= np.float32(2.0**-BITS)
    components -= np.float32(OFFSET)
    return components
