"""The vertex shader on every vertex of a scene."""

from functools import lru_cache
from typing import Any

import numpy as np

from core.geometry.matrices import projection, transform, world_to_camera
from core.geometry.vertex_stage import VertexStage, transform_vertices, unit, vertex_normals
from core.lanes.problem import Problem
from core.lanes.run import Watch, bounded
from core.records.arrays import Floats, Integers, read_only
from core.records.shaded import ShadedVertices
from core.scene import COORDINATE_LIMIT, Mesh, Scene
from core.shaders.glsl_types import GlslValue, component_count, from_rows, rows_of
from core.shaders.record import ShaderProblem, ShaderProgram
from core.shaders.scene_uniforms import scene_uniforms
from core.shaders.shader import SECONDS, Outcome, Shader

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
