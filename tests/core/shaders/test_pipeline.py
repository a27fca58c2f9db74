"""Shaders in the pipeline: vertices, interpolation, fragments, discard, derivatives, textures."""

from dataclasses import replace

import numpy as np
import pytest

from core import Settings, render, trace
from core.fast_path.draw import draw_picture
from core.framebuffer.display import to_display
from core.pixel_history import why
from core.scene import Texture
from core.shaders.presets import MINIMAL_FRAGMENT, MINIMAL_VERTEX, TASK_FRAGMENT, TASK_VERTEX
from core.shaders.record import ShaderProblem, ShaderProgram
from core.study.planner.findings import tessellations
from core.textures.look_up import texture_colors
from core.trace.source import TraceSource
from lessons.scene_edits import move_corner
from tests.core.shaders.scenes import POSITIONS, square_scene, tutorial_scene


def test_the_minimal_shaders_draw_the_same_triangle_in_yellow():
    scene = tutorial_scene(MINIMAL_VERTEX, MINIMAL_FRAGMENT)
    frame, plain = render(scene), render(replace(scene, program=None))
    np.testing.assert_array_equal(frame.primitive, plain.primitive)
    seen = frame.primitive >= 0
    assert seen.sum() > 10_000
    np.testing.assert_array_equal(frame.color[seen], np.tile(np.float32([1, 1, 0, 1]), (seen.sum(), 1)))
    np.testing.assert_array_equal(frame.color[~seen], 0)


def test_the_task_scales_the_triangle_and_hands_its_colour_on():
    frame = render(tutorial_scene(), Settings(cull="back"))
    seen = frame.primitive >= 0
    assert seen.sum() == 24_944
    np.testing.assert_array_equal(frame.color[seen][:, :3], frame.attributes[seen])
    turned = tutorial_scene(TASK_VERTEX.replace("position.x*1.5", "-position.x*1.5"))
    assert (render(turned, Settings(cull="back")).primitive >= 0).sum() == 0, "it shows its back"


def test_a_vertex_without_a_place_draws_nothing():
    for position in ("vec4(0.0)", "vec4(0.0 / 0.0)", "vec4(position, 1.0) / 0.0"):
        scene = tutorial_scene(
            f"#version 300 es\nvoid main() {{ gl_Position = {position}; }}\n", MINIMAL_FRAGMENT
        )
        assert (render(scene).primitive >= 0).sum() == 0


def test_the_3d_scene_shows_where_the_shader_puts_the_vertices():
    vertices = trace(tutorial_scene(), Settings()).source.geometry.vertices
    np.testing.assert_allclose(vertices.world[:, :3], POSITIONS * (1.5, 0.5, 2), rtol=1e-4)
    nowhere = tutorial_scene("#version 300 es\nvoid main() { gl_Position = vec4(0.0); }\n", MINIMAL_FRAGMENT)
    np.testing.assert_allclose(trace(nowhere, Settings()).source.geometry.vertices.world[:, :3], POSITIONS)


def test_discard_leaves_depth_and_colour_alone():
    scene = square_scene(
        "if (vUv.x > 0.5) discard; c = vec4(t, 0.0, 0.0, 1.0);", uniforms={"depth": (0.5,), "t": (1.0,)}
    )
    frame = render(scene)
    half = np.zeros((8, 8), bool)
    half[:, :4] = True
    np.testing.assert_array_equal(frame.primitive >= 0, half)
    np.testing.assert_array_equal(frame.depth < 1, half)
    np.testing.assert_array_equal(frame.color[..., 0], half.astype(np.float32))
    for settings in (
        Settings(antialiasing="msaa-4"),
        Settings(visibility="ray-casting"),
        Settings(blend="over"),
    ):
        np.testing.assert_array_equal(render(scene, settings).color[..., 0], half.astype(np.float32))


def test_what_lies_behind_a_discarded_fragment_is_seen():
    scene = square_scene("if (vUv.x > 0.5 && gl_FragCoord.z < 0.4) discard; c = vec4(gl_FragCoord.z);")
    vertex = scene.program.vertex.replace("depth, 1.0", "position.z + depth, 1.0")
    (near,) = scene.meshes
    far = replace(near, transform=np.eye(4), positions=near.positions + np.array([0, 0, 0.5]))
    program = replace(scene.program, vertex=vertex, uniforms=(("depth", (-0.5,)),))
    shown = render(replace(scene, meshes=(near, far), program=program)).color[0, :, 0]
    np.testing.assert_array_equal(shown, [0.25] * 4 + [0.5] * 4)


def test_derivatives_are_differences_in_quads_with_helpers():
    body = "c = vec4(dFdx(vUv.x * vUv.x), dFdy(vUv.y), fwidth(vUv.x), dFdx(gl_FragCoord.x));"
    color = render(square_scene(body)).color
    u = (np.arange(8) + 0.5) / 8
    squares = np.float32(u * u)
    np.testing.assert_allclose(color[0, :, 0], np.repeat(squares[1::2] - squares[::2], 2), rtol=1e-6)
    np.testing.assert_allclose(color[..., 1], 1 / 8, rtol=1e-6)
    np.testing.assert_allclose(color[..., 2], 1 / 8, rtol=1e-6)
    np.testing.assert_array_equal(color[..., 3], 1)


def test_helpers_beside_a_triangle_continue_its_plane():
    scene = tutorial_scene(
        fragment=TASK_FRAGMENT.replace("vec4(vColor, 1.0)", "vec4(dFdx(gl_FragCoord.x))"), size=(64, 48)
    )
    frame = render(scene)
    assert set(frame.color[frame.primitive >= 0][:, 0]) == {1.0}


def test_textures_are_looked_up_by_the_programs_own_filters():
    texels = np.random.default_rng(3).random((4, 4, 3)).astype(np.float32)
    scene = square_scene("c = texture(map, vUv * 3.0);", texture=Texture(texels))
    uv = np.stack(np.meshgrid((np.arange(8) + 0.5) / 8, (np.arange(8) + 0.5) / 8), axis=-1).reshape(-1, 2) * 3
    for name in ("nearest", "bilinear"):
        for wrap in ("repeat", "clamp"):
            color = render(scene, Settings(texture_filter=name, wrap=wrap)).color.reshape(-1, 4)
            wanted = texture_colors(Texture(texels), np.float32(uv).astype(float), name, wrap)
            np.testing.assert_allclose(color, wanted, atol=1e-6)
    coarse = render(
        square_scene("c = texture(map, vUv * 8.0);", texture=Texture(texels)),
        Settings(texture_filter="trilinear"),
    )
    np.testing.assert_allclose(
        coarse.color[..., :3], np.broadcast_to(texels.mean(axis=(0, 1)), (8, 8, 3)), atol=1e-6
    )


def test_texels_can_be_fetched():
    texels = np.random.default_rng(3).random((2, 4, 4)).astype(np.float32)
    size = "vec4(vec2(textureSize(map, 0)), 0.0, 0.0)"
    body = f"c = texelFetch(map, ivec2(gl_FragCoord.xy), 0) + {size};"
    color = render(square_scene(body, texture=Texture(texels))).color
    np.testing.assert_array_equal(color[:2, :4], texels + np.float32([4, 2, 0, 0]))
    np.testing.assert_array_equal(color[3, 5], [4, 2, 0, 0])


def test_flat_outs_are_those_of_the_provoking_vertex():
    vertex = "#version 300 es\nflat out int k;\nvoid main() { gl_Position = vec4(position, 1.0); k = gl_VertexID; }\n"
    fragment = "#version 300 es\nflat in int k;\nout vec4 c;\nvoid main() { c = vec4(float(k)); }\n"
    scene = square_scene(fragment, vertex=vertex)
    assert set(render(scene).color[..., 0].ravel()) == {2.0, 3.0}
    assert set(render(scene, Settings(provoking="first")).color[..., 0].ravel()) == {0.0}


def test_meshes_have_their_own_matrices():
    scene = tutorial_scene(size=(64, 48))
    moved = replace(scene.meshes[0], transform=np.diag([0.5, 0.5, 1, 1.0]))
    both = replace(scene, meshes=(scene.meshes[0], moved))
    assert (render(both).primitive == 1).sum() == 0, (
        "the second lies in the first's plane, and a tie keeps the first"
    )
    alone = render(replace(scene, meshes=(moved,)))
    assert 0 < (alone.primitive >= 0).sum() < (render(scene).primitive >= 0).sum()


def test_the_picture_of_the_window_is_that_of_the_frame():
    scene = tutorial_scene(size=(64, 48))
    np.testing.assert_array_equal(draw_picture(scene).pixels, to_display(render(scene).color).pixels)


def test_the_history_of_a_pixel_has_the_shaders_colour():
    scene = tutorial_scene(size=(64, 48))
    frame = render(scene)
    row, column = (int(k) for k in np.argwhere(frame.primitive >= 0)[40])
    history = why(TraceSource(scene, Settings()), column, row)
    np.testing.assert_array_equal(history.final.color, frame.color[row, column])


def test_a_discarded_fragment_says_so_in_history_and_depth_test():
    scene = square_scene("if (vUv.x > 0.5) discard; c = vec4(1.0);")
    (event,) = why(TraceSource(scene, Settings()), 6, 2).fragments
    assert [link.key for link in event.chain if link.stage == "depth"] == ["discarded"]
    depth = trace(scene, Settings(), 0).stage("depth")
    kinds = {tuple(depth.pixel[k]): depth.kind_of(k) for k in range(depth.steps.row_count)}
    assert kinds[6, 2] == "discarded"
    assert kinds[3, 2] == "test"


def test_exact_areas_and_endless_loops_are_refused():
    with pytest.raises(ValueError, match="exact areas run no shaders"):
        render(tutorial_scene(size=(64, 48)), Settings(antialiasing="area"))
    with pytest.raises(ValueError, match="exact areas run no shaders"):
        trace(tutorial_scene(size=(64, 48)), Settings(antialiasing="area")).stage("raster")
    with pytest.raises(ValueError, match="the vertex shader places this corner"):
        move_corner(tutorial_scene(), 0, 1, (3.0, 4.0), (64, 48))
    endless = "void main() {\n   while (true) { }\n}"
    scene = tutorial_scene(fragment=TASK_FRAGMENT.split("void main")[0] + endless, size=(64, 48))
    with pytest.raises(
        ShaderProblem, match="fragment shader, line 9, column 4: the loop goes on after 1,000 rounds"
    ):
        render(scene)


def test_programs_are_equal_by_their_text():
    first, second = (ShaderProgram(TASK_VERTEX, TASK_FRAGMENT, (("t", (1,)),)) for _ in range(2))
    assert first == second
    assert hash(first) == hash(second)


def test_the_planner_gives_no_advice_on_a_mesh_that_a_shader_may_bend():
    assert tessellations(tutorial_scene(size=(64, 48))) == ()
