"""Polygons that are not convex are split inside, by a way whose time grows with their corners, and it is reported."""

import numpy as np
import pytest

from app.files.file_access import OutsideWarning
from app.files.mesh_files import load_meshes
from tests.app.files.mesh_writing import write, write_image

DART = ((0, 0), (2, 1), (0, 2), (0.5, 1))


def star(corners: int) -> str:
    """Return an OBJ file of one polygon with every other corner inside."""
    angle = np.linspace(0, 2 * np.pi, corners, endpoint=False)
    radius = 1 + 0.5 * (np.arange(corners) % 2)
    points = zip((radius * np.cos(angle)).tolist(), (radius * np.sin(angle)).tolist(), strict=True)
    names = " ".join(str(k + 1) for k in range(corners))
    return "".join(f"v {x} {y} 0\n" for x, y in points) + f"f {names}\n"


def area(mesh) -> float:
    a, b, c = (mesh.positions[mesh.triangles[:, k]] for k in range(3))
    turned = np.cross(b - a, c - a)[:, 2] / 2
    assert (turned > 0).all() or (turned < 0).all()
    return float(np.abs(turned).sum())


@pytest.mark.parametrize("turns", range(4))
def test_a_concave_quad_is_split_inside(tmp_path, turns):
    corners = [DART[(k + turns) % 4] for k in range(4)]
    text = "".join(f"v {x} {y} 0\n" for x, y in corners) + "f 1 2 3 4\n"
    (mesh,) = load_meshes(write(tmp_path / "a.obj", text)).meshes
    assert len(mesh.triangles) == 2
    assert area(mesh) == 1.5


@pytest.mark.parametrize("corners", [6, 20, 3000])
def test_a_star_is_split_inside(tmp_path, corners):
    (mesh,) = load_meshes(write(tmp_path / "a.obj", star(corners))).meshes
    assert len(mesh.triangles) == corners - 2
    assert area(mesh) == pytest.approx(corners / 2 * 1.5 * np.sin(2 * np.pi / corners))


def test_a_polygon_on_one_line_keeps_its_fan(tmp_path):
    text = "".join(f"v {x} 0 0\n" for x in (0, 3, 1, 4, 2)) + "v 0 1 0\nf 1 2 3 4 5\nf 1 2 6\n"
    (mesh,) = load_meshes(write(tmp_path / "a.obj", text)).meshes
    assert mesh.faces.tolist() == [0, 0, 0, 1]


def test_a_texture_is_read_once_however_often_it_is_named(tmp_path, monkeypatch):
    write_image(tmp_path / "a.png", [[(255, 0, 0)]])
    names = "".join(f"newmtl m{k}\nmap_Kd a.png\n" for k in range(2000))
    write(tmp_path / "a.mtl", names + "map_Kd a.png\n" * 2000)
    faces = "".join(f"usemtl m{k}\nf 1/1 2/1 3/1\n" for k in range(20))
    text = "mtllib a.mtl\nmtllib ./a.mtl\nv 0 0 0\nv 1 0 0\nv 0 1 0\nvt 0 0\n" + faces
    opened = []

    def noted(self, file, name):
        opened.append(name)
        return decode(self, file, name)

    from app.files.mesh_formats.images import TextureReader

    decode = TextureReader.decode
    monkeypatch.setattr(TextureReader, "decode", noted)
    loaded = load_meshes(write(tmp_path / "a.obj", text))
    assert opened == ["a.png"]
    assert len({id(mesh.texture) for mesh in loaded.meshes}) == 1
    assert len(loaded.meshes) == 20


def test_of_many_warnings_only_the_first_are_shown(tmp_path):
    names = "".join(f"newmtl m{k}\nmap_Kd ../m{k}.png\n" for k in range(30))
    write(tmp_path / "a.mtl", f"{names}Kd red\n")
    faces = "".join(f"usemtl m{k}\nf 1/1 2/1 3/1\n" for k in range(30))
    text = f"mtllib a.mtl\nv 0 0 0\nv 1 0 0\nv 0 1 0\nvt 0 0\n{faces}"
    warnings = load_meshes(write(tmp_path / "a.obj", text)).warnings
    assert len(warnings) == 21
    assert all(isinstance(warning, OutsideWarning) for warning in warnings[:20])
    assert warnings[20] == "11 more warnings are not shown"


def test_splitting_many_polygons_reports(tmp_path):
    corners = [*DART, (-1, 1.5)]
    points = "".join(f"v {x} {y} {row}\n" for row in range(6000) for x, y in corners)
    faces = "".join(f"f {' '.join(str(5 * row + k) for k in (2, 3, 5, 1, 4))}\n" for row in range(6000))
    reports = []
    load_meshes(write(tmp_path / "a.obj", points + faces), lambda fraction, doing: reports.append(doing))
    assert reports.count("splitting polygons") >= 1
