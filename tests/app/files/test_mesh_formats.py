"""PLY, OFF, STL and glTF: what comes out, and what a broken file says."""

import json
import struct
from contextlib import suppress
from io import BytesIO

import numpy as np
import pytest
from hypothesis import HealthCheck, given, settings
from hypothesis import strategies as st
from PIL import Image

from app.files.mesh_files import load_meshes
from app.files.mesh_formats.reading import MeshFileError, fan, share_vertices
from core.framebuffer.display import linear_light
from tests.app.files.mesh_writing import (
    GltfWriter,
    ply_binary,
    ply_text,
    stl_binary,
    stl_text,
    write,
    write_image,
)

POINTS = np.array([[0, 0, 0], [1, 0, 0], [1, 1, 0], [0, 1, 0], [2, 0, 0], [2, 1, 0]], float)
LINES = [" ".join(map(str, point)) for point in POINTS.tolist()]
MIXED = [[0, 1, 2, 3], [1, 4, 5], [0, 1, 4, 5, 2]]
MIXED_LINES = [" ".join(map(str, [len(polygon), *polygon])) for polygon in MIXED]
MIXED_TRIANGLES = [[0, 1, 2], [0, 2, 3], [1, 4, 5], [0, 1, 4], [0, 4, 5], [0, 5, 2]]
OFF = "OFF\n6 3 0\n" + "\n".join(LINES + MIXED_LINES) + "\n"
CORNERS = POINTS[[[0, 1, 2], [1, 4, 5]]]


def one(path):
    loaded = load_meshes(path)
    assert loaded.warnings == ()
    (mesh,) = loaded.meshes
    return mesh


def refusal(path):
    with pytest.raises(MeshFileError) as problem:
        load_meshes(path)
    assert path.name in str(problem.value)
    assert "\n" not in str(problem.value)
    return str(problem.value)


def plain_gltf():
    writer = GltfWriter()
    writer.primitive([[0, 1, 2], [0, 2, 3]], POSITION=POINTS[:4].astype(np.float32))
    return writer


def png(color):
    stream = BytesIO()
    Image.new("RGB", (1, 1), color).save(stream, "PNG")
    return stream.getvalue()


def test_a_fan_keeps_polygons_together():
    corners, faces = fan(np.array([4, 3, 5]))
    assert corners.tolist() == [[0, 1, 2], [0, 2, 3], [4, 5, 6], [7, 8, 9], [7, 9, 10], [7, 10, 11]]
    assert faces.tolist() == [0, 0, 1, 2, 2, 2]


def test_vertices_are_shared_where_all_their_numbers_agree():
    v, vt = np.array([[0, 1, 2], [2, 1, 0]]), np.array([[0, 0, 0], [0, 5, 0]])
    triangles, (of_v, of_vt) = share_vertices(v, vt)
    assert of_v[triangles].tolist() == v.tolist()
    assert of_vt[triangles].tolist() == vt.tolist()
    assert len(of_v) == 4
    assert of_v.tolist() == sorted(of_v.tolist())


@pytest.mark.parametrize(
    ("name", "content"),
    [
        ("text.ply", ply_text(LINES, MIXED_LINES)),
        ("little.ply", ply_binary(POINTS, MIXED)),
        ("big.ply", ply_binary(POINTS, MIXED, ">")),
        ("polygons.off", OFF),
    ],
)
def test_polygons_of_any_size_keep_their_order(tmp_path, name, content):
    mesh = one(write(tmp_path / name, content))
    assert mesh.positions.tolist() == POINTS.tolist()
    assert mesh.triangles.tolist() == MIXED_TRIANGLES
    assert mesh.faces.tolist() == [0, 0, 1, 2, 2, 2]
    assert mesh.normals is None


@pytest.mark.parametrize("order", ["<", ">"])
def test_a_binary_ply_of_triangles_only(tmp_path, order):
    mesh = one(write(tmp_path / "a.ply", ply_binary(POINTS, [[0, 1, 2], [1, 4, 5]], order)))
    assert mesh.triangles.tolist() == [[0, 1, 2], [1, 4, 5]]


def test_ply_colours_normals_and_uvs_of_vertices(tmp_path):
    vertices = [f"{line} 0 0 1 255 128 0 51 0.25 0.5" for line in LINES]
    names = "x y z nx ny nz red green blue alpha s t"
    mesh = one(write(tmp_path / "a.ply", ply_text(vertices, MIXED_LINES, names)))
    assert mesh.normals[0].tolist() == [0, 0, 1]
    assert mesh.colors[0].tolist() == [1, float(linear_light(np.array(128 / 255))), 0, 0.2]
    assert mesh.uvs[0].tolist() == [0.25, 0.5]


def test_ply_colours_of_faces_split_vertices(tmp_path):
    text = ply_text(LINES, ["3 0 1 2 255 0 0", "3 0 2 3 0 0 255"]).replace(
        "end_header", "property uchar red\nproperty uchar green\nproperty uchar blue\nend_header"
    )
    mesh = one(write(tmp_path / "a.ply", text))
    assert mesh.colors[mesh.triangles].tolist() == [[[1, 0, 0, 1]] * 3, [[0, 0, 1, 1]] * 3]
    assert mesh.positions[mesh.triangles[1]].tolist() == POINTS[[0, 2, 3]].tolist()


def test_ply_uvs_of_corners_split_vertices_and_bring_their_texture(tmp_path):
    write_image(tmp_path / "skin.png", [[(0, 255, 0)]])
    text = ply_text(
        LINES, ["3 0 1 2 6 0 0 1 0 1 1", "3 0 2 3 6 .5 .5 1 1 0 1"], more="comment TextureFile skin.png\n"
    ).replace("end_header", "property list uchar float texcoord\nend_header")
    mesh = one(write(tmp_path / "a.ply", text))
    assert len(mesh.positions) == 5
    assert mesh.uvs[mesh.triangles[1]].tolist() == [[0.5, 0.5], [1, 1], [0, 1]]
    # The two vertices of a seam are shaded alike.
    assert mesh.normals[mesh.triangles[0, 0]].tolist() == [0, 0, 2]
    assert mesh.normals[mesh.triangles[1, 0]].tolist() == [0, 0, 2]
    assert mesh.texture.pixels.tolist() == [[[0, 1, 0]]]


def test_a_missing_texture_of_a_ply_is_a_warning(tmp_path):
    text = ply_text(
        [f"{line} 0 0" for line in LINES], MIXED_LINES, "x y z u v", "comment TextureFile no.png\n"
    )
    loaded = load_meshes(write(tmp_path / "a.ply", text))
    assert loaded.warnings == ("texture no.png does not exist; it is left out",)
    assert loaded.meshes[0].texture is None
    assert loaded.meshes[0].uvs is not None


@pytest.mark.parametrize(
    ("content", "wanted"),
    [
        (b"\x89PNG\r\n\x1a\n" + bytes(range(256)), "does not begin with the line ply"),
        ("ply\nformat ascii 1.0\nelement vertex 3\n", "its header has no end"),
        ("ply\nformat ascii 1.0\nelement vertex many\nend_header\n", "element vertex many"),
        ("ply\nformat ascii 1.0\nproperty float x\nend_header\n", "property float x"),
        ("ply\nformat ascii 1.0\nelement vertex 1\nproperty quad x\nend_header\n", "property quad x"),
        ("ply\nformat squeezed 1.0\nend_header\n", "format squeezed"),
        ("ply\nformat ascii 1.0\nelement vertex 0\nproperty float x\nend_header\n", "no vertices"),
        (ply_text(LINES, ["3 0 1 6"]), "face 0 names vertex 6, the file has 6, counted from 0"),
        (ply_text(LINES, ["3 0 1 2", "3 0 1 -1"]), "face 1 names vertex -1"),
        (ply_text(LINES, ["3 0 1 2.5"]), "face 0 names vertex 2.5"),
        (ply_text(LINES, ["2 0 1"]), "face 0 needs at least 3 corners, got 2"),
        (ply_text(LINES, MIXED_LINES)[:-8], "cut short"),
        (ply_text(LINES, ["3 0 1 two"]), "expected a number, got two"),
        (ply_text(["nan 0 0", *LINES], MIXED_LINES), "vertex 0 is at [nan, 0.0, 0.0]"),
        (ply_text(LINES, ["3 0 0 1"]), "only degenerate faces"),
        (ply_binary(POINTS, MIXED)[:-3], "cut short"),
        (ply_binary(POINTS, MIXED)[:-60], "cut short"),
        (ply_text(LINES, MIXED_LINES).replace("element face 3", "element face 3000000000"), "cut short"),
    ],
)
def test_a_broken_ply_is_refused(tmp_path, content, wanted):
    assert wanted in refusal(write(tmp_path / "a.ply", content))


def test_off_colours_and_normals(tmp_path):
    vertices = [f"{line} 0 0 1 255 128 0" for line in LINES]
    text = "# a comment\nCNOFF 6 1 0\n\n" + "\n".join([*vertices, "3 0 1 2"])
    mesh = one(write(tmp_path / "a.off", text))
    assert mesh.colors[0].tolist() == [1, float(linear_light(np.array(128 / 255))), 0, 1]
    assert mesh.normals[5].tolist() == [0, 0, 1]
    floats = "COFF\n3 1 0\n0 0 0 1 0.5 0 0.5\n1 0 0 1 1 1 1\n0 1 0 1 1 1 1\n3 0 1 2\n"
    colors = one(write(tmp_path / "b.off", floats)).colors
    assert colors[0].tolist() == [1, float(linear_light(np.array(0.5))), 0, 0.5]


def test_off_colours_of_faces_are_left_out_with_a_warning(tmp_path):
    loaded = load_meshes(write(tmp_path / "a.off", OFF.replace("3 1 4 5", "3 1 4 5 255 0 0")))
    assert loaded.warnings == ("colours of 1 faces are left out",)


@pytest.mark.parametrize(
    ("content", "wanted"),
    [
        ("4OFF\n1 1 1\n", "not an OFF file"),
        ("STOFF\n1 1 1\n", "STOFF"),
        (b"OFF BINARY\n\0\0\0", "not text"),
        ("OFF\nsix 3 0\n", "line 2"),
        (OFF[:-5], "needs 3 or more"),
        (OFF[:-30], "cut short"),
        (OFF.replace("3 1 4 5", "3 1 4 6"), "face 1 names vertex 6"),
        ("OFF\n0 0 0\n", "no vertices"),
        ("OFF\n3 0 0\n0 0 0\n1 0 0\n0 1 0\n", "no faces"),
        ("OFF\n3 1 0\n0 0 0\n1 0\n0 1 0\n3 0 1 2\n", "line 4: a vertex needs 3 numbers, got 2"),
    ],
)
def test_a_broken_off_is_refused(tmp_path, content, wanted):
    assert wanted in refusal(write(tmp_path / "a.off", content))


@pytest.mark.parametrize("content", [stl_binary(CORNERS), stl_text(CORNERS)], ids=["binary", "text"])
def test_stl_triangles_keep_their_order(tmp_path, content):
    mesh = one(write(tmp_path / "a.stl", content))
    assert mesh.positions[mesh.triangles].tolist() == CORNERS.tolist()
    assert mesh.normals is None


def test_a_text_stl_may_be_in_capitals_and_a_binary_one_begin_with_solid(tmp_path):
    for name, content in (
        ("a", "\n " + stl_text(CORNERS).upper()),
        ("b", b"SOLID" + stl_binary(CORNERS)[5:]),
    ):
        mesh = one(write(tmp_path / f"{name}.stl", content))
        assert mesh.positions[mesh.triangles].tolist() == CORNERS.tolist()
    cut = write(tmp_path / "c.stl", b"solid" + stl_binary(CORNERS)[5:-10])
    assert "cut short: it counts 2 triangles and ends after 1" in refusal(cut)


def test_each_solid_of_a_text_stl_is_a_mesh(tmp_path):
    loaded = load_meshes(
        write(tmp_path / "a.stl", stl_text(CORNERS[:1], "left") + stl_text(CORNERS[1:], "right"))
    )
    assert [mesh.name for mesh in loaded.meshes] == ["left", "right"]


@pytest.mark.parametrize(
    ("content", "wanted"),
    [
        (stl_binary(CORNERS)[:-10], "cut short: it counts 2 triangles and ends after 1"),
        (stl_text(CORNERS)[:-60], "cut short"),
        (stl_text(CORNERS[:1]) + stl_text(CORNERS[1:])[:-60], "1 of its 2 triangles"),
        (stl_text(CORNERS).replace("vertex 2.0", "vertex two"), "cannot be read as STL"),
        (b"\x89PNG\r\n\x1a\n" + bytes(range(256)), "not an STL file"),
        (stl_binary(CORNERS[:0]), "no faces"),
        (stl_text(CORNERS[:0]), "no faces"),
        (stl_binary(np.full((1, 3, 3), np.nan)), "vertex 0 is at [nan, nan, nan]"),
        (stl_binary(np.zeros((4, 3, 3))), "only degenerate faces"),
        (b"solid", "no faces"),
    ],
)
def test_a_broken_stl_is_refused(tmp_path, content, wanted):
    assert wanted in refusal(write(tmp_path / "a.stl", content))


def test_glb_and_gltf_give_the_same(tmp_path):
    packed = one(write(tmp_path / "a.glb", plain_gltf().glb()))
    loose = one(write(tmp_path / "a.gltf", plain_gltf().gltf(tmp_path / "a.bin")))
    for mesh in (packed, loose):
        assert mesh.positions.tolist() == POINTS[:4].tolist()
        assert mesh.triangles.tolist() == [[0, 1, 2], [0, 2, 3]]
        assert (mesh.normals, mesh.uvs, mesh.colors, mesh.texture) == (None, None, None, None)


def test_gltf_nodes_place_their_meshes(tmp_path):
    writer = plain_gltf()
    writer.header["scenes"][0]["nodes"] = [0]
    writer.header["nodes"] = [
        {"name": "parent", "translation": [5, 0, 0], "children": [1, 2]},
        {"name": "child", "mesh": 0, "scale": [2, 2, 2]},
        {"name": "mirrored", "mesh": 0, "scale": [-1, 1, 1]},
    ]
    meshes = {mesh.name: mesh for mesh in load_meshes(write(tmp_path / "a.glb", writer.glb())).meshes}
    assert meshes["child"].transform.tolist() == [[2, 0, 0, 5], [0, 2, 0, 0], [0, 0, 2, 0], [0, 0, 0, 1]]
    assert meshes["child"].triangles.tolist() == [[0, 1, 2], [0, 2, 3]]
    assert meshes["mirrored"].triangles.tolist() == [[2, 1, 0], [3, 2, 0]]


def test_gltf_materials_textures_colours_and_normals(tmp_path):
    writer = GltfWriter()
    position, normal = POINTS[:3].astype(np.float32), np.tile(np.float32([0, 0, 1]), (3, 1))
    uv = np.float32([[0, 0], [1, 0], [1, 0.75]])
    color = np.array([[255, 0, 0, 255]] * 3, np.uint8)
    writer.primitive([[0, 1, 2]], 0, POSITION=position, NORMAL=normal, TEXCOORD_0=uv)
    writer.primitive([[0, 1, 2]], 1, POSITION=position)
    writer.primitive([[0, 1, 2]], None, POSITION=position, COLOR_0=color)
    writer.header["materials"] = [
        {"pbrMetallicRoughness": {"baseColorTexture": {"index": 0}}},
        {"pbrMetallicRoughness": {"baseColorFactor": [0.2, 0.4, 0.6, 1.0]}},
    ]
    writer.header["textures"] = [{"source": 0}]
    writer.header["images"] = [{"bufferView": writer.view(png((0, 255, 0))), "mimeType": "image/png"}]
    loaded = load_meshes(write(tmp_path / "a.glb", writer.glb()))
    assert loaded.warnings == ()
    textured, plain, painted = loaded.meshes
    assert textured.texture.pixels.tolist() == [[[0, 1, 0]]]
    assert textured.normals.tolist() == normal.tolist()
    # The file counts v from the top, the core from the bottom.
    assert textured.uvs.tolist() == [[0, 1], [1, 1], [1, 0.25]]
    assert plain.colors[0].tolist() == pytest.approx([0.2, 0.4, 0.6, 1], abs=1e-9)
    assert painted.colors[0].tolist() == [1, 0, 0, 1]


@pytest.mark.parametrize(
    ("image", "wanted"),
    [
        ({"uri": "gone.png"}, "gone.png of material 0 does not exist"),
        ({"uri": "data:image/png;base64,AAAA"}, "texture 0 of material 0 is not an image"),
    ],
)
def test_a_texture_that_a_gltf_lacks_is_a_warning(tmp_path, image, wanted):
    writer = GltfWriter()
    uv = np.zeros((3, 2), np.float32)
    writer.primitive([[0, 1, 2]], 0, POSITION=POINTS[:3].astype(np.float32), TEXCOORD_0=uv)
    writer.header |= {
        "materials": [{"pbrMetallicRoughness": {"baseColorTexture": {"index": 0}}}],
        "textures": [{"source": 0}],
        "images": [image],
    }
    loaded = load_meshes(write(tmp_path / "a.glb", writer.glb()))
    assert wanted in " ".join(loaded.warnings)
    assert len(loaded.warnings) == 1
    assert loaded.meshes[0].texture is None


def test_points_and_lines_of_a_gltf_are_left_out_with_a_warning(tmp_path):
    writer = plain_gltf()
    writer.primitive([[0, 1, 2]], POSITION=POINTS[:3].astype(np.float32))
    writer.header["meshes"][0]["primitives"][1]["mode"] = 6
    loaded = load_meshes(write(tmp_path / "a.glb", writer.glb()))
    assert len(loaded.meshes) == 1
    assert loaded.warnings[0].startswith("1 of its parts are points, lines or triangle fans")


def changed(change):
    writer = plain_gltf()
    change(writer.header)
    return writer.glb()


@pytest.mark.parametrize(
    ("content", "wanted"),
    [
        (plain_gltf().glb()[:-20], "cut short"),
        (plain_gltf().glb()[:15], "cut short"),
        (b"\x89PNG\r\n\x1a\n" + bytes(range(256)), "does not begin with glTF"),
        (
            struct.pack("<4sIII4s", b"glTF", 2, 24, 4, b"JSON") + b"nope",
            "not a valid glTF file: its header is not JSON",
        ),
        (changed(lambda header: header["accessors"][0].update(count=10**12)), "too large"),
        (changed(lambda header: header["accessors"][0].pop("type")), "not a valid glTF file"),
        (changed(lambda header: header["accessors"][0].update(sparse={})), "sparse accessors"),
        (changed(lambda header: header["accessors"][0].update(bufferView=9)), "cannot be read as GLB"),
        (changed(lambda header: header["bufferViews"][0].update(byteLength=10**6)), "cannot be read as GLB"),
        (
            changed(lambda header: header.update(extensionsRequired=["KHR_draco_mesh_compression"])),
            "compressed",
        ),
        (changed(lambda header: header["asset"].update(version="1.0")), "is glTF 1.0; only glTF 2"),
        (changed(lambda header: header["nodes"].clear()), "a.glb"),
        (changed(lambda header: header.update(meshes=[])), "a.glb"),
    ],
)
def test_a_broken_glb_is_refused(tmp_path, content, wanted):
    assert wanted in refusal(write(tmp_path / "a.glb", content))


def test_an_index_out_of_range_in_a_glb_is_refused(tmp_path):
    writer = GltfWriter()
    writer.primitive([[0, 1, 9]], POSITION=POINTS[:3].astype(np.float32))
    assert "9" in refusal(write(tmp_path / "a.glb", writer.glb()))


def test_a_gltf_without_its_buffer_says_which(tmp_path):
    path = write(tmp_path / "a.gltf", plain_gltf().gltf(tmp_path / "a.bin"))
    (tmp_path / "a.bin").unlink()
    assert "its file a.bin does not exist" in refusal(path)
    assert "not a valid glTF file" in refusal(write(tmp_path / "b.gltf", json.dumps([1, 2])))


SAMPLES = {
    "a.ply": ply_text(LINES, MIXED_LINES).encode(),
    "b.ply": ply_binary(POINTS, MIXED),
    "c.ply": ply_binary(POINTS, [[0, 1, 2], [1, 4, 5]], ">"),
    "a.off": OFF.encode(),
    "a.stl": stl_binary(CORNERS),
    "b.stl": stl_text(CORNERS).encode(),
    "a.glb": plain_gltf().glb(),
    "a.obj": ("".join(f"v {line}\n" for line in LINES) + "f 1 2 3 4\nf 2//1 5//1 6//1\nvn 0 0 1\n").encode(),
}


@pytest.mark.parametrize("name", [name for name in SAMPLES if name != "a.obj"])
def test_no_beginning_of_a_file_loads_as_less(tmp_path, name):
    whole = one(write(tmp_path / name, SAMPLES[name]))
    for end in range(1, len(SAMPLES[name]), 1 if len(SAMPLES[name]) < 300 else 7):
        path = write(tmp_path / f"cut{name[1:]}", SAMPLES[name][:end])
        try:
            loaded = load_meshes(path)
        except MeshFileError:
            continue
        assert loaded.meshes[0].triangles.tolist() == whole.triangles.tolist()


@pytest.mark.parametrize("name", SAMPLES)
@given(data=st.data())
@settings(suppress_health_check=[HealthCheck.function_scoped_fixture])
def test_a_damaged_file_loads_or_is_refused(tmp_path, name, data):
    content = bytearray(SAMPLES[name])
    for _ in range(data.draw(st.integers(1, 4))):
        place = data.draw(st.integers(0, len(content) - 1))
        content[place : place + data.draw(st.integers(0, 3))] = data.draw(st.binary(max_size=4))
    # Any other exception than this one fails the test.
    with suppress(MeshFileError):
        loaded = load_meshes(write(tmp_path / name, bytes(content)))
        assert all(np.isfinite(mesh.positions).all() for mesh in loaded.meshes)
