"""Skinning and blending against laws that know nothing of matrices added up: widths, hulls, rigid images."""

from dataclasses import replace
from fractions import Fraction

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from core import Mesh, Settings, render, trace
from core.deformation.deform import blended_shape, deform
from core.deformation.measured import BEND, TWIST, kept_width, tube_scene
from core.deformation.skinning import (
    added_quaternion,
    blended_component,
    joints_of,
    moved_by_quaternion,
    turned_normal,
)
from core.records.deformations import Blend, Skin
from core.stages.before_matrices import before_matrices
from core.transform.matrices import transform_component
from core.transform.vertex_stage import vertex_normals
from lessons.bone_scenes import bent_bar, blended_bar, flat_bar, posed
from lessons.scenes import make_scene

METHODS = ("linear", "dual-quaternion")
TRIANGLE = np.array([[0, 1, 2]])


def random_skin(seed: int, joints: int, count: int = 12) -> tuple[Skin, np.ndarray]:
    source = np.random.default_rng(seed)
    weights = source.random((count, joints))
    axes = source.normal(size=(joints, 3))
    heads = source.normal(size=(joints, 3))
    parents = np.array([source.integers(-1, j) if j else -1 for j in range(joints)])
    skin = Skin(
        weights / weights.sum(axis=1)[:, None], heads, heads + 1, parents, axes, source.uniform(-3, 3, joints)
    )
    return skin, source.normal(size=(count, 3))


def skinned(skin: Skin, positions: np.ndarray, method: str) -> np.ndarray:
    return deform(Mesh(positions, TRIANGLE, deformation=skin), Settings(skinning=method)).positions


def of_one_bone(skin: Skin, bone: int) -> Skin:
    return replace(skin, weights=np.eye(skin.joint_count)[[bone] * skin.vertex_count])


@settings(deadline=None, max_examples=30)
@given(st.integers(0, 10**6), st.integers(1, 5), st.sampled_from(METHODS))
def test_the_rest_pose_stays_and_one_bone_is_rigid(seed: int, joints: int, method: str) -> None:
    skin, positions = random_skin(seed, joints)
    rest = skinned(replace(skin, angles=np.zeros(joints)), positions, method)
    assert np.allclose(rest, positions, rtol=1e-15, atol=1e-15)
    chosen = seed % joints
    moved = skinned(of_one_bone(skin, chosen), positions, method)
    lengths, before = (np.linalg.norm(p[:, None] - p, axis=2) for p in (moved, positions))
    assert np.allclose(lengths, before, atol=1e-12)
    if skin.parents[chosen] < 0:
        at_head = np.tile(skin.heads[chosen], (len(positions), 1))
        assert np.allclose(skinned(of_one_bone(skin, chosen), at_head, method), at_head, atol=1e-12)


@settings(deadline=None, max_examples=30)
@given(st.integers(0, 10**6), st.integers(2, 5))
def test_linear_lies_in_the_hull_of_the_rigid_images(seed: int, joints: int) -> None:
    skin, positions = random_skin(seed, joints)
    made = skinned(skin, positions, "linear")
    images = np.stack([skinned(of_one_bone(skin, j), positions, "linear") for j in range(joints)])
    assert np.allclose(np.einsum("nj,jnk->nk", skin.weights, images), made, atol=1e-12)
    direction = np.random.default_rng(seed + 1).normal(size=3)
    assert (made @ direction <= (images @ direction).max(axis=0) + 1e-12).all()


@settings(deadline=None, max_examples=30)
@given(st.floats(-180, 180), st.sampled_from([BEND, TWIST]))
def test_width_at_the_joint(angle: float, axis: np.ndarray) -> None:
    mesh = tube_scene(angle, axis, 2.0).meshes[0]
    kept = {
        how: kept_width(mesh.positions, deform(mesh, Settings(skinning=how)).positions) for how in METHODS
    }
    assert kept["linear"] == pytest.approx(abs(np.cos(np.radians(angle) / 2)), abs=1e-9)
    assert kept["dual-quaternion"] == pytest.approx(1, abs=1e-9)


def test_the_numbers_of_the_catalogue() -> None:
    triangles = flat_bar().triangles
    for degrees, method, ends, width, area in (
        (90, "linear", [(4.5, -0.5), (3.5, 0.5)], 2**0.5, 15.0),
        (150, "linear", [(4.25, -0.067), (3.75, 0.067)], 0.5176, 14.134),
        (90, "dual-quaternion", [(4.7071, -0.7071), (3.2929, 0.7071)], 2.0, 15.4142),
        (150, "dual-quaternion", [(4.9659, -0.2588), (3.0341, 0.2588)], 2.0, 14.5176),
    ):
        found = posed(bent_bar(degrees), method)
        assert found[8:10, :2] == pytest.approx(np.array(ends), abs=1e-4)
        assert np.linalg.norm(found[8] - found[9]) == pytest.approx(width, abs=1e-4)
        sides = found[triangles[:, 1:]] - found[triangles[:, :1]]
        assert np.cross(sides[:, 0], sides[:, 1])[:, 2].sum() / 2 == pytest.approx(area, abs=1e-4)
    halfway = before_matrices(blended_bar(), Settings()).meshes[0].positions
    assert np.linalg.norm(halfway[16:].mean(axis=0)) == pytest.approx(8 * 0.5**0.5)


@pytest.mark.parametrize("method", METHODS)
def test_normals_are_those_of_the_surface_where_weights_do_not_change(method: str) -> None:
    mesh = tube_scene(70.0, BEND, 2.0).meshes[0]
    skin = mesh.deformation
    alike = replace(skin, weights=np.tile([0.3, 0.7], (skin.vertex_count, 1)))
    made = deform(replace(mesh, normals=None, deformation=alike), Settings(skinning=method))
    faces = vertex_normals(made.positions, made.triangles)
    faces /= np.linalg.norm(faces, axis=1)[:, None]
    assert (made.normals * faces).sum(axis=1)[16:-16] == pytest.approx(1, abs=1e-3)


@settings(deadline=None, max_examples=20)
@given(st.lists(st.integers(-8, 8), min_size=1, max_size=4), st.integers(0, 99))
def test_blending_is_exact_on_whole_numbers(weights: list[int], seed: int) -> None:
    source = np.random.default_rng(seed)
    rest, targets = source.integers(-9, 9, (3, 3)), source.integers(-9, 9, (len(weights), 3, 3))
    mesh = Mesh(rest, TRIANGLE, deformation=Blend(targets, np.array(weights) / 4))
    exact = np.array(rest.tolist(), object)
    for weight, target in zip(weights, targets.tolist(), strict=True):
        exact = exact + Fraction(weight, 4) * (np.array(target, object) - rest)
    assert deform(mesh, Settings()).positions.tolist() == exact.astype(float).tolist()


@pytest.mark.parametrize("method", METHODS)
@pytest.mark.parametrize("name", ["bent-bar", "twisted-tube", "blended-bar"])
def test_rows_are_the_listings_and_end_at_the_vertex(name: str, method: str) -> None:
    found = trace(make_scene(name), Settings(skinning=method), triangle=8).stage("transform")
    held = make_scene(name).meshes[0].deformation
    last = {}
    for row in range(found.steps.row_count):
        kind, values = found.kind_of(row), found.variables(row)
        if kind in ("skin", "move", "blend"):
            last[values["vertex"]] = values["after"][:3]
        for k in range(3) if kind in ("bone", "skin", "blend") else ():
            got = {
                "bone": lambda k, v: transform_component(v["matrix"][k], v["before"]),
                "skin": lambda k, v: blended_component(v["weights"], v["moved"][:, k]),
                "blend": lambda k, v: blended_shape(v["rest"][k], [v["weight"]], [v["shape"][k]]),
            }[kind](k, values)
            assert got == values["after"][k]
        if kind == "skin":
            assert turned_normal(values["blended"], values["rest_normal"]) == pytest.approx(values["normal"])
        elif kind == "quaternion":
            pivot = values["side"] * joints_of(held).rotations[values["bone"]]
            before = values["real_before"], values["dual_before"]
            got = added_quaternion(values["weight"], values["rotation"], values["dual"], pivot, *before)
            assert got[0] == values["side"]
            assert np.array_equal(got[1], values["sum_real"])
            assert np.array_equal(got[2], values["sum_dual"])
        elif kind == "move":
            got = moved_by_quaternion(values["sum_real"], values["sum_dual"], values["before"][:3])
            assert got == pytest.approx(values["after"][:3], abs=1e-14)
    placed = before_matrices(make_scene(name), Settings(skinning=method)).meshes[0].positions
    assert len(last) == 3
    for vertex, place in last.items():
        assert np.array_equal(placed[vertex], place)


def test_turns_of_two_hemispheres_go_the_short_way() -> None:
    skin, positions = random_skin(3, 2)
    both = replace(
        skin, parents=np.array([-1, -1]), axes=np.array([[0, 0, 1.0]] * 2), angles=np.array([0.5, 0.5])
    )
    around = replace(both, angles=np.array([0.5, 0.5 + 2 * np.pi]))
    short, long = (skinned(each, positions, "dual-quaternion") for each in (both, around))
    assert long == pytest.approx(short)


def test_a_deformed_scene_is_drawn_as_its_deformed_mesh() -> None:
    scene = make_scene("bent-bar")
    mesh = deform(scene.meshes[0], Settings())
    drawn = replace(scene, meshes=(replace(mesh, rest=None, deformation=None),))
    assert np.array_equal(render(scene).color, render(drawn).color)


GOOD = {
    "weights": np.full((3, 2), 0.5),
    "heads": np.zeros((2, 3)),
    "tails": np.ones((2, 3)),
    "parents": np.array([-1, 0]),
    "axes": np.eye(3)[:2],
    "angles": np.zeros(2),
}


@pytest.mark.parametrize(
    ("wrong", "sentence"),
    [
        ({"weights": np.array([[0.5, 0.5], [0.48, 0.5], [1, 0]])}, "of vertex 1 sum to 0.98"),
        ({"weights": np.array([[0.5, 0.5], [1.5, -0.5], [1, 0]])}, "vertex 1 has -0.5 of bone 1"),
        ({"weights": np.full((3, 3), 1 / 3)}, "weights name 3 bones, there are 2"),
        ({"parents": np.array([-1, 4])}, "bone 1 hangs on bone 4, there are 2"),
        ({"parents": np.array([1, -1])}, "bone 0 hangs on bone 1, which must come before it"),
        ({"axes": np.zeros((2, 3))}, "the axis of bone 0 must not be"),
        ({"angles": np.zeros(3)}, "angles must be those of 2 bones, got 3"),
    ],
)
def test_bad_skins_are_refused_with_a_sentence(wrong: dict, sentence: str) -> None:
    with pytest.raises(ValueError, match=sentence):
        Skin(**GOOD | wrong)


def test_a_deformation_of_another_mesh_is_refused() -> None:
    with pytest.raises(ValueError, match="must be one of 4 vertices, got 3"):
        Mesh(np.zeros((4, 3)), TRIANGLE, deformation=Skin(**GOOD))
