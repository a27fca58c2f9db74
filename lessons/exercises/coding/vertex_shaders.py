"""Vertex shaders and functions of them, with matrices of every class."""

from collections.abc import Sequence
from typing import Any

import numpy as np

from lessons.exercises.coding.fragment_shaders import DIFFUSE, matte
from lessons.exercises.coding.shader_task import HEAD, ShaderTask
from lessons.exercises.coding.task import Case, Fault


def _matrix(rows: Sequence[Sequence[float]]) -> tuple[float, ...]:
    """Return the numbers of a matrix column by column, as GLSL has them."""
    return tuple(float(one) for one in np.array(rows).T.ravel())


_SAME = [[1, 0, 0, 0], [0, 1, 0, 0], [0, 0, 1, 0], [0, 0, 0, 1]]
_MOVED = [[1, 0, 0, 1], [0, 1, 0, -2], [0, 0, 1, -5], [0, 0, 0, 1]]
_TURNED = [[0, -1, 0, 0], [1, 0, 0, 0], [0, 0, 1, -4], [0, 0, 0, 1]]
_FLAT = [[1, 0, 0, 0], [0, 4, 0, 0], [0, 0, 1, -4], [0, 0, 0, 1]]
_PROJECTION = [[1, 0, 0, 0], [0, 1, 0, 0], [0, 0, -3, -4], [0, 0, -1, 0]]
_VIEWS = {
    "all matrices change nothing": (_SAME, _SAME),
    "the mesh is moved": (_MOVED, _SAME),
    "the mesh is turned": (_TURNED, _SAME),
    "the mesh is stretched": (_FLAT, _SAME),
    "with perspective": (_MOVED, _PROJECTION),
}
"""By class: model-view matrix and projection matrix."""
_VERTICES = (
    ((1.0, 2.0, -3.0), (0.0, 0.6, 0.8), (1.0, 0.5, 0.0)),
    ((-2.0, 0.5, 1.0), (1.0, 0.0, 0.0), (0.0, 0.25, 1.0)),
)
"""Position, normal and colour."""
_ATTRIBUTES = (("vec3", "position"), ("vec3", "normal"), ("vec3", "color"))
_MATRICES = (("mat4", "modelViewMatrix"), ("mat4", "projectionMatrix"))


def _vertex_cases(*, has_normals: bool) -> dict[str, tuple[Case, ...]]:
    found = {}
    for name, (view, projection) in _VIEWS.items():
        matrices: tuple[Any, ...] = (_matrix(view), _matrix(projection))
        if has_normals:
            matrices = (*matrices, _matrix(np.linalg.inv(np.array(view, float)[:3, :3]).T.tolist()))
        cases = []
        for position, normal, color in _VERTICES:
            values = (position, normal, color) if has_normals else (position,)
            where = f"{name}: position ({position[0]:g}, {position[1]:g}, {position[2]:g})"
            cases.append(Case((*values, *matrices), where))
        found[name] = tuple(cases)
    return found


_SEEN, _NORMAL = "vec4 seen = modelViewMatrix * vec4(position, 1.0);", "vNormal = normalMatrix * normal;"
_COLOR, _PLACE = "vColor = color;", "gl_Position = projectionMatrix * seen;"
VERTEX = ShaderTask(
    "vertex-shader",
    "transform",
    "the vertex shader",
    """This vertex shader of a ShaderMaterial writes gl_Position in clip space, passes on the normal as the
    eye sees it, and the colour of the vertex. three.js declares position, normal, color and the matrices.
    Hint: Which output is wrong, and where: is the mesh moved, turned or stretched, or is there perspective?
    Hint: The matrix that acts first stands next to the position. A position has w = 1, a direction w = 0.
    Hint: vNormal and vColor are vec3. Where the matrices change nothing, gl_Position is (x, y, z, 1).""",
    f"""{HEAD}out vec3 vNormal;
out vec3 vColor;
void main() {{
   {_SEEN}
   {_NORMAL}
   {_COLOR}
   {_PLACE}
}}""",
    _vertex_cases(has_normals=True),
    (
        Fault(_SEEN, "vec4 seen = modelViewMatrix * vec4(position, 0.0);", "position-as-direction"),
        Fault(_SEEN, "vec4 seen = vec4(position, 1.0) * modelViewMatrix;"),
        Fault(_NORMAL, "vNormal = normal;", "normal-in-object-space"),
        Fault(_NORMAL, "vNormal = mat3(modelViewMatrix) * normal;"),
        Fault(_COLOR, "vColor = position;", "position-as-colour"),
        Fault(_COLOR, "vColor = vec3(0.0);", "color-not-handed-on"),
        Fault(_PLACE, "gl_Position = seen;"),
        Fault(_PLACE, "gl_Position = seen * projectionMatrix;", "matrix-on-the-right"),
    ),
    ("gl_Position = vec4(position, 1.0);", "vColor = color;", "vNormal = normal;"),
    given=(*_ATTRIBUTES, *_MATRICES, ("mat3", "normalMatrix")),
    outputs=("gl_Position", "vNormal", "vColor"),
    beside=lambda text: matte(text, DIFFUSE.text),
)
_SCALED = "vec4 scaled = vec4(position.x * 1.5, position.y * 0.5, position.z * 2.0, 1.0);"
_BOTH = "gl_Position = projectionMatrix * modelViewMatrix * scaled;"
SCALING = ShaderTask(
    "scaling-shader",
    "transform",
    "the scaling vertex shader",
    """This vertex shader of a ShaderMaterial scales the mesh: x by 1.5, y by 0.5 and z by 2. Then it writes
    gl_Position in clip space.
    Hint: Is it wrong already where all matrices change nothing?
    Hint: What acts first stands next to the vector: the mesh is scaled, then placed before the eye, then
    projected.
    Hint: With matrices that change nothing, x = 1 gives 1.5, y = 1 gives 0.5 and z = 1 gives 2; w is 1.""",
    f"""{HEAD}void main() {{
   {_SCALED}
   {_BOTH}
}}""",
    _vertex_cases(has_normals=False),
    (
        Fault(_SCALED, _SCALED.replace("y * 0.5", "y * 1.5"), "one-scale-for-all"),
        Fault(_SCALED, "vec4 scaled = vec4(position.x + 1.5, position.y + 0.5, position.z + 2.0, 1.0);"),
        Fault(_SCALED, _SCALED.replace("1.0)", "2.0)")),
        Fault(_BOTH, "gl_Position = modelViewMatrix * projectionMatrix * scaled;"),
        Fault(_BOTH, "gl_Position = projectionMatrix * scaled;"),
        Fault(_BOTH, "gl_Position = modelViewMatrix * scaled;"),
    ),
    ("gl_Position = vec4(position, 1.0);", "gl_Position = vec4(0.0);"),
    given=(("vec3", "position"), *_MATRICES),
    outputs=("gl_Position",),
)
_CLIP = (("mat4", "projection"), ("mat4", "modelView"), ("vec3", "position"))
CLIP_POSITION = ShaderTask(
    "clip-position",
    "transform",
    "the position in clip space",
    """clipPosition is given the two matrices and the position of a vertex. It returns the position in clip
    space: first modelView, then projection. Nothing is divided by w.
    Hint: A matrix of 4 x 4 takes a vector of 4 numbers. Which w has a position?
    Hint: The matrix that acts first stands next to the vector.
    Hint: With matrices that change nothing, (1, 2, -3) becomes (1, 2, -3, 1).""",
    """vec4 clipPosition(mat4 projection, mat4 modelView, vec3 position) {
   vec4 seen = modelView * vec4(position, 1.0);
   return projection * seen;
}""",
    {
        name: tuple(Case((case.values[2], case.values[1], case.values[0]), case.said) for case in cases)
        for name, cases in _vertex_cases(has_normals=False).items()
    },
    (
        Fault(
            "vec4 seen = modelView * vec4(position, 1.0);",
            "vec4 seen = modelView * vec4(position, 0.0);",
            "position-as-direction",
        ),
        Fault("vec4 seen = modelView * vec4(position, 1.0);", "vec4 seen = vec4(position, 1.0) * modelView;"),
        Fault("return projection * seen;", "return seen;"),
        Fault("return projection * seen;", "return seen * projection;"),
        Fault("return projection * seen;", "vec4 clip = projection * seen; return clip / clip.w;"),
    ),
    ("return vec4(position, 1.0);", "return vec4(0.0);"),
    given=_CLIP,
    returns="vec4",
)
TASKS = (VERTEX, SCALING, CLIP_POSITION)
