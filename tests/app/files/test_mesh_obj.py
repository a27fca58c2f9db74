"""OBJ with MTL and textures: order, polygons, seams, relative numbers, and what a file lacks."""

import numpy as np
import pytest

from app.files.mesh_files import load_meshes
from app.files.mesh_formats.reading import MeshFileError
from core.framebuffer.display import linear_light
from tests.app.files.mesh_writing import SQUARE, write, write_image

RED, BLUE = (255, 0, 0), (0, 0, 255)
TEXTURED = SQUARE + "vt 0 0\nvt 1 0\nvt 1 1\nvt 0 1\n"


def one(path):
    loaded = load_meshes(path)
    assert loaded.warnings == ()
    (mesh,) = loaded.meshes
    return mesh


def test_triangles_and_polygons_keep_the_order_of_the_file(tmp_path):
    text = SQUARE + "v 2 0 0\nv 2 1 0\nf 1 2 3 4\nf 2 5 6\nf 1 2 5 6 3\n"
    mesh = one(write(tmp_path / "a.obj", text))
    assert mesh.triangles.tolist() == [[0, 1, 2], [0, 2, 3], [1, 4, 5], [0, 1, 4], [0, 4, 5], [0, 5, 2]]
    assert mesh.faces.tolist() == [0, 0, 1, 2, 2, 2]
    assert mesh.positions.tolist()[:2] == [[0, 0, 0], [1, 0, 0]]
    assert mesh.normals is None
    assert mesh.uvs is None
    assert mesh.colors is None
    assert mesh.name == "a"


def test_a_concave_polygon_is_cut_into_triangles_that_face_one_way(tmp_path):
    # An arrow head: a fan from its first corner would leave the polygon.
    text = "v 2 1 0\nv 0 2 0\nv 0.5 1 0\nv 0 0 0\nf 2 3 4 1\n"
    mesh = one(write(tmp_path / "arrow.obj", text))
    a, b, c = (mesh.positions[mesh.triangles[:, k]] for k in range(3))
    areas = np.cross(b - a, c - a)[:, 2] / 2
    assert (areas > 0).all()
    assert areas.sum() == pytest.approx(1.5)


def test_relative_numbers_count_back_from_their_line(tmp_path):
    mesh = one(write(tmp_path / "a.obj", SQUARE + "f -4 -3 -2\nv 5 5 5\nf -5 -2 -1\n"))
    assert mesh.positions[mesh.triangles[1]].tolist() == [[0, 0, 0], [0, 1, 0], [5, 5, 5]]


def test_a_seam_of_uvs_splits_vertices_but_not_the_shading(tmp_path):
    folded = "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 0 1\nvt 0 0\nvt 1 0\nvt 1 1\nvt .5 .5\n"
    mesh = one(write(tmp_path / "a.obj", folded + "f 1/1 2/2 3/3\nf 1/4 4/2 2/1\n"))
    assert len(mesh.positions) == 6
    assert mesh.uvs[mesh.triangles[1]].tolist() == [[0.5, 0.5], [1, 0], [0, 0]]
    first, again = mesh.triangles[0, 0], mesh.triangles[1, 0]
    assert first != again
    assert mesh.normals[first].tolist() == mesh.normals[again].tolist() == [0, 1, 1]


def test_normals_of_the_file_are_kept(tmp_path):
    mesh = one(write(tmp_path / "a.obj", SQUARE + "vn 0 0 1\nvn 0 1 0\nf 1//1 2//2 3//1\n"))
    assert mesh.normals[mesh.triangles[0]].tolist() == [[0, 0, 1], [0, 1, 0], [0, 0, 1]]


@pytest.mark.parametrize(
    "face", ["f 1/1/1 2/2/1 3/3/1", "f 1/1 2/2/1 3/3/1", "f 1/1/ 2/2/ 3/3/", "f 1/1/1 2/2/1 3/3/1 # corners"]
)
def test_corners_may_be_written_in_several_ways(tmp_path, face):
    loaded = load_meshes(write(tmp_path / "a.obj", TEXTURED + "vn 0 0 1\n" + face + "\n"))
    (mesh,) = loaded.meshes
    assert mesh.triangles.tolist() == [[0, 1, 2]]
    assert mesh.uvs.tolist() == [[0, 0], [1, 0], [1, 1]]


def test_lines_may_continue_and_end_the_windows_way(tmp_path):
    text = SQUARE.replace("\n", "\r\n") + "f 1 2 \\\r\n3\r\n# the end"
    assert one(write(tmp_path / "a.obj", text.encode())).triangles.tolist() == [[0, 1, 2]]


def test_vertex_colors_count_as_srgb(tmp_path):
    mesh = one(write(tmp_path / "a.obj", "v 0 0 0 1 0.5 0\nv 1 0 0 0 0 0\nv 0 1 0 1 1 1\nf 1 2 3\n"))
    assert mesh.colors[0].tolist() == [1, float(linear_light(np.array(0.5))), 0, 1]


def test_materials_give_colour_texture_and_highlight(tmp_path):
    write_image(tmp_path / "wood grain.png", [[RED], [BLUE]])
    write(
        tmp_path / "looks.mtl",
        "newmtl plain\nKd 1 0 0\nd 0.5\nKs 0.5 0.5 0.5\nNs 80\n"
        "newmtl Wood #1\nKd 0 0 0\nmap_Kd -s 1 1 1 -clamp on wood grain.png\n",
    )
    text = "mtllib looks.mtl\n" + TEXTURED + "usemtl plain\nf 1/1 2/2 3/3\nusemtl Wood #1\nf 1/1 3/3 4/4\n"
    loaded = load_meshes(write(tmp_path / "a.obj", text))
    assert loaded.warnings == ()
    plain, wood = loaded.meshes
    assert (plain.name, wood.name) == ("plain", "Wood #1")
    assert plain.colors[0].tolist() == [1, 0, 0, 0.5]
    assert plain.texture is None
    assert plain.material.specular == 0.5
    assert plain.material.shininess == 80
    # Row 0 of a texture is its bottom: the last row of the image.
    assert wood.texture.pixels.tolist() == [[[0, 0, 1]], [[1, 0, 0]]]
    assert (wood.colors == 1).all()
    assert (plain.faces.tolist(), wood.faces.tolist()) == ([0], [1])


def test_runs_of_materials_stay_in_the_order_of_the_file(tmp_path):
    write(tmp_path / "m.mtl", "newmtl a\nnewmtl b\n")
    text = (
        "mtllib m.mtl\n"
        + SQUARE
        + "usemtl a\nf 1 2 3\nusemtl b\nf 2 3 4\nusemtl a\nf 3 4 1\nusemtl a\nf 4 1 2\n"
    )
    loaded = load_meshes(write(tmp_path / "a.obj", text))
    assert [mesh.name for mesh in loaded.meshes] == ["a", "b", "a"]
    assert [mesh.faces.tolist() for mesh in loaded.meshes] == [[0], [1], [2, 3]]


@pytest.mark.parametrize("name", ["a_texture.png", "a.png"])
def test_an_image_beside_the_file_is_its_texture_if_it_names_none(tmp_path, name):
    write_image(tmp_path / name, [[RED]])
    mesh = one(write(tmp_path / "a.obj", TEXTURED + "f 1/1 2/2 3/3\n"))
    assert mesh.texture.name == name
    assert mesh.texture.pixels.dtype == np.float32
    assert mesh.texture.pixels.tolist() == [[[1, 0, 0]]]


def test_paths_of_another_machine_lead_to_the_file_beside(tmp_path):
    write_image(tmp_path / "skin.png", [[RED]])
    write(tmp_path / "m.mtl", "newmtl a\nmap_Kd C:\\models\\skin.png\n")
    text = "mtllib m.mtl\n" + TEXTURED + "usemtl a\nf 1/1 2/2 3/3\n"
    assert one(write(tmp_path / "a.obj", text)).texture is not None


@pytest.mark.parametrize(
    ("materials", "wanted"),
    [
        (None, "material file looks.mtl does not exist; its materials are left out"),
        ("newmtl a\nmap_Kd gone.png\n", "texture gone.png of material a does not exist"),
        ("newmtl a\nmap_Kd a.obj\n", "texture a.obj of material a is not an image"),
        ("newmtl b\n", "material a is in no material file"),
        ("newmtl a\nKd red\n", "line 2 of looks.mtl cannot be read: Kd red"),
    ],
)
def test_what_a_material_lacks_is_a_warning_and_the_model_loads(tmp_path, materials, wanted):
    if materials is not None:
        write(tmp_path / "looks.mtl", materials)
    text = "mtllib looks.mtl\n" + TEXTURED + "usemtl a\nf 1/1 2/2 3/3\n"
    loaded = load_meshes(write(tmp_path / "a.obj", text))
    (warning,) = loaded.warnings
    assert wanted in warning
    assert loaded.meshes[0].triangles.tolist() == [[0, 1, 2]]
    assert loaded.meshes[0].texture is None


def test_a_material_without_a_library_is_a_warning(tmp_path):
    loaded = load_meshes(write(tmp_path / "a.obj", SQUARE + "usemtl gold\nf 1 2 3\n"))
    assert "gold" in loaded.warnings[0]


def test_corners_without_what_others_have_are_a_warning(tmp_path):
    loaded = load_meshes(
        write(tmp_path / "a.obj", TEXTURED + "vn 0 0 1\nf 1/1/1 2/2/1 3//1\nf 1/1 2/2 3/3\n")
    )
    assert len(loaded.warnings) == 2
    (mesh,) = loaded.meshes
    assert mesh.uvs[mesh.triangles[0, 2]].tolist() == [0, 0]
    assert mesh.normals.tolist() == [[0, 0, 2]] * 4


@pytest.mark.parametrize(
    ("lines", "wanted"),
    [
        ("f 1 2 9\n", "line 5: a face names vertex 9, the file has 4"),
        ("f 0 1 2\n", "line 5: a face names vertex 0"),
        ("f -9 1 2\n", "line 5: corner -9 counts back beyond the first vertex"),
        ("f 1 2 3\nf 1/1 2/1 3/1\n", "line 6: a face names texture coordinate 1, the file has 0"),
        ("f 1//7 2//7 3//7\n", "line 5: a face names normal 7"),
        ("f 1 2\n", "line 5: a face needs at least 3 corners, got 2"),
        ("f 1 2 3\nf 1 x 3\n", "line 6: x is not a corner of a face"),
        ("f 1 2 3/1/1/1\n", "line 5: 3/1/1/1 is not a corner of a face"),
        ("v 1 2\n", "line 5: a vertex needs 3 numbers, got 2"),
        ("v 1 2 x\n", "line 5: expected a number, got x"),
        ("vn 1 2\n", "line 5"),
        ("v nan 0 0\nf 1 2 5\n", "vertex 5 is at [nan, 0.0, 0.0]"),
        ("v 1e999 0 0\nf 1 2 3\n", "vertex 5 is at [inf, 0.0, 0.0]"),
        (
            "v 1e300 0 0\nf 1 2 5\n",
            "vertex 5 is at [1e+300, 0.0, 0.0], which is not a number or beyond 3.4e+38",
        ),
        ("f 1 1 2\nf 3 3 3\n", "only degenerate faces"),
        ("f 1 2 99999999999999999999\n", "line 5: 99999999999999999999 is not a corner of a face"),
        ("vt\n", "line 5: a texture coordinate needs 1 number or more, got 0"),
    ],
)
def test_a_broken_file_says_where(tmp_path, lines, wanted):
    with pytest.raises(MeshFileError) as problem:
        load_meshes(write(tmp_path / "a.obj", SQUARE + lines))
    assert wanted in str(problem.value)
    assert "a.obj" in str(problem.value)
    assert "\n" not in str(problem.value)


def test_the_models_beside_the_project(shared_folder):
    teapot = one(shared_folder / "meshes" / "teapot.obj")
    assert (len(teapot.positions), len(teapot.triangles)) == (3644, 6320)
    suzanne = one(shared_folder / "meshes" / "suzanne.obj")
    assert (len(suzanne.triangles), suzanne.faces.max()) == (968, 499)
    spot = one(shared_folder / "meshes" / "spot.obj")
    assert len(spot.triangles) == 5856
    assert spot.texture.pixels.shape == (1024, 1024, 3)
