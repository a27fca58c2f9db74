"""Environment maps: six pictures around a mirror, drawn first; the mirrored direction says where to look in them.

With unit vectors N (normal) and V (to the eye), I = -V comes from the eye, and R = I - 2 (N.I) N leaves the mirror.
The face of the map is that of the largest component of R, whatever its sign; the other two over it are the place there.

The map is drawn from one point, the middle of the mirror. A point of the surface that lies s beside it, across R, and
sees an object at the distance d looks up what the middle sees along R: off by the angle atan(s / d). That is nothing
for what is infinitely far, 26.6 degrees for d = 2 s. A texel in the middle of a face of M texels is 2 / M wide in the
tangent of that angle, so the look-up is off by M s / (2 d) texels there; towards a corner a texel sees less.

References
----------
J. Blinn, M. Newell, *Texture and reflection in computer generated images*, 1976.
N. Greene, *Environment mapping and other applications of world projections*, 1986: the cube.
F. Pellacini, *Computer Graphics*, lecture "Graphics pipeline": environment mapping as an approximation.
"""

from collections.abc import Callable, Sequence
from dataclasses import dataclass

import numpy as np

from core.methods import method
from core.records.arrays import Floats, Integers
from core.records.listing import Operation
from core.scene import Texture
from core.shading.lighting import dot, inner, planes
from core.textures.look_up import bilinear_color, sample_texture

FACES = ("+x", "−x", "+y", "−y", "+z", "−z")
"""The six faces: face 2 k looks along axis k, face 2 k + 1 against it."""
ACROSS = ((2, 1), (2, -1), (0, 1), (0, 1), (0, -1), (0, 1))
"""By face, the axis of the world that runs to the right of its picture, and with which sign."""
ABOVE = ((1, 1), (1, 1), (2, 1), (2, -1), (1, 1), (1, 1))
"""By face, the axis that runs up."""


@dataclass(frozen=True, eq=False)
class Surroundings:
    """What is around a mirror, as the methods of the family ``environment`` need it."""

    faces: tuple[Texture, ...]
    """Six pictures of M x M texels from the middle of the mirror; none: the method looks into no map."""
    triangles: Floats
    """(T, 3, 3) float64 corners in world space; none: the method casts no rays."""
    least: float
    """Nearer than this, a triangle is the surface that the point lies on."""
    shade: Callable[[Integers, Floats, Floats], Floats]
    """Colours (F, 3) of triangles (F,) at weights of their corners (F, 3), seen from places (F, 3)."""
    background: Floats
    """(3,) float64, what a ray sees that meets nothing."""


@dataclass(frozen=True, eq=False)
class Mirrored:
    """What F points of a mirror show, whatever the method."""

    n_dot_i: Floats
    """(F,) float64, cosine between the normal and I."""
    direction: Floats
    """(F, 3) float64, R."""
    color: Floats
    """(F, 3) float64, linear, what is seen along R."""


@dataclass(frozen=True, eq=False)
class MapLooks(Mirrored):
    """F points that look into an environment map."""

    face: Integers
    """(F,) int64, 0 to 5."""
    place: Floats
    """(F, 2) float64, from 0 to 1 across its face and up."""
    texels: Integers
    """(F, 4, 2) int64 columns and rows, all of one face."""
    shares: Floats
    """(F, 4) float64 of each texel in the colour."""


def reflect(normal: Floats, to_eye: Floats) -> tuple[Floats, Floats]:
    """Return N.I (F,) and R (F, 3) of unit normals (F, 3) and unit directions to the eye (F, 3)."""
    n, (x, y, z) = planes(normal), planes(to_eye)
    incoming = -x, -y, -z
    n_dot_i = dot(n, incoming)
    r = [i_k - 2 * n_dot_i * n_k for i_k, n_k in zip(incoming, n, strict=True)]
    return n_dot_i, np.stack(r, axis=1)


def place_on_cube(direction: Floats) -> tuple[Integers, Floats]:
    """Return the face (F,) that a direction (F, 3) meets, and its place (F, 2) there, from 0 to 1.

    Notes
    -----
    Directions need not be unit. Of equal components the first axis has the face. The direction 0 has no place: NaN.
    """
    rows, axis = np.arange(len(direction)), np.abs(direction).argmax(axis=1)
    along = direction[rows, axis]
    face = 2 * axis + (along < 0)
    with np.errstate(divide="ignore", invalid="ignore", over="ignore"):
        place = [
            (direction[rows, way[face, 0]] * way[face, 1] / np.abs(along) + 1) / 2
            for way in (np.array(ACROSS), np.array(ABOVE))
        ]
    return face, np.stack(place, axis=1)


def direction_of(face: Integers, place: Floats) -> Floats:
    """Return the direction (F, 3), its largest component 1, to places (F, 2) of faces (F,)."""
    rows, found = np.arange(len(face)), np.empty((len(face), 3))
    found[rows, face // 2] = np.where(face % 2 == 0, 1.0, -1.0)
    for way, coordinate in zip((np.array(ACROSS), np.array(ABOVE)), place.T, strict=True):
        found[rows, way[face, 0]] = (2 * coordinate - 1) * way[face, 1]
    return found


def look_up_faces(faces: Sequence[Texture], face: Integers, place: Floats) -> tuple[Floats, Integers, Floats]:
    """Return colours (F, 3), texels (F, 4, 2) and their shares (F, 4): each face is filtered by itself."""
    count = len(face)
    color, texels, shares = np.empty((count, 3)), np.empty((count, 4, 2), np.int64), np.empty((count, 4))
    for number, of_face in enumerate(faces):
        chosen = np.flatnonzero(face == number)
        found = sample_texture(of_face, place[chosen], "bilinear", "clamp")
        color[chosen], texels[chosen], shares[chosen] = found.color[:, :3], found.texels, found.shares
    return color, texels, shares


def cube_color(
    normal: Sequence[float],
    to_eye: Sequence[float],
    faces: Sequence[Sequence[Sequence[Sequence[float]]]],
    own: Sequence[float],
    mirror: float,
) -> tuple[float, ...]:
    """Return the colour of a fragment of a mirror that looks into six pictures (listing of `cube`)."""
    incoming = [-to_eye[0], -to_eye[1], -to_eye[2]]
    n_dot_i = inner(normal, incoming)  #: cosine
    r = [incoming[k] - 2 * n_dot_i * normal[k] for k in range(3)]  #: reflect
    sizes = [abs(r[0]), abs(r[1]), abs(r[2])]
    axis = sizes.index(max(sizes))
    face = 2 * axis + (1 if r[axis] < 0 else 0)  #: face
    (across, turn), (above, tilt) = ACROSS[face], ABOVE[face]
    u, v = (r[across] * turn / sizes[axis] + 1) / 2, (r[above] * tilt / sizes[axis] + 1) / 2  #: place
    seen = bilinear_color(faces[face], u, v, "clamp")  #: look-up
    red, green, blue = (own[k] + mirror * seen[k] for k in range(3))  #: mirror
    return red, green, blue, own[3]


BEFORE = (
    Operation("cosine", "cosine", {"n_dot_i": "n_dot_i"}),
    Operation("reflect", "reflect", {"reflected": "r"}),
)
AFTER = (Operation("mirror", "mirror", {"color": "red green blue"}),)
"""What a row does before it knows what is seen along R, and then."""


@method(
    "environment",
    "none",
    "None",
    source="Pellacini, Graphics pipeline: an object-local algorithm",
    exact_for="scenes in which nothing is a mirror",
    breaks_where="wherever something is: it shows the lights only, and nothing that stands around it",
)
def no_environment(_position: Floats, normal: Floats, to_eye: Floats, _around: Surroundings) -> Mirrored:
    """Mirror nothing at points (F, 3): their colour stays."""
    return Mirrored(*reflect(normal, to_eye), np.zeros((len(normal), 3)))


@method(
    "environment",
    "cube",
    "Environment map (cube)",
    source="Blinn, Newell 1976; Greene 1986; Pellacini, environment mapping",
    exact_for="what is infinitely far, up to the texels of the map",
    breaks_where="near objects: a point s beside the middle of the mirror sees what is d away off by atan(s / d), so a "
    "reflection does not meet the floor. The mirror itself is left out of its map, shadows and other "
    "mirrors' reflections are missing in it, and colours jump at the borders of its faces",
    needs=("world-boxes",),
    takes=("environment_size",),
    listing=cube_color,
    operations={
        "mirror": (
            *BEFORE,
            Operation("face", "face", {"face": "face"}),
            Operation("place", "place", {"face_place": "u v"}),
            Operation("look-up", "look-up", {"seen": "seen"}, ("face_texels", "face_shares")),
            *AFTER,
        )
    },
    traits="map",
)
def cube(_position: Floats, normal: Floats, to_eye: Floats, around: Surroundings) -> MapLooks:
    """Look up what the middle of a mirror sees along the mirrored direction, at points (F, 3) in world space.

    Parameters
    ----------
    normal, to_eye : (F, 3) float64 unit vectors in world space
    around : Surroundings

    Returns
    -------
    MapLooks
        ``color`` (F, 3) float64 is what is seen, whatever the method; how it was found depends on it.
    """
    n_dot_i, direction = reflect(normal, to_eye)
    face, place = place_on_cube(direction)
    color, texels, shares = look_up_faces(around.faces, face, place)
    return MapLooks(n_dot_i, direction, color, face, place, texels, shares)
