"""Small files of every format, which fuzz.py damages."""

from io import BytesIO
from pathlib import Path

import numpy as np
from PIL import Image

from app.files.mesh_files import frame_meshes
from app.files.open_any import open_any
from app.files.state_files import State, save_state
from app.files.state_models import Bookmark, Breakpoints, GridLook, Look, OrbitRecord
from app.session.document import Document, open_document
from core.depth.whole_depths import table_scene
from core.scene import Mesh
from lessons.window_scenes import depth_table
from tests.app.files.mesh_writing import (
    ENTITIES,
    GltfWriter,
    dxf_text,
    ply_binary,
    ply_text,
    stl_binary,
    stl_text,
)

EARLIER = Path(__file__).resolve().parents[1] / "app/files/earlier"
POINTS = np.array([[0, 0, 0], [1, 0, 0], [1, 1, 0], [0, 1, 0], [2, 0, 0], [2, 1, 0]], float)
LINES = [" ".join(map(str, point)) for point in POINTS.tolist()]
POLYGONS = [[0, 1, 2, 3], [1, 4, 5], [0, 1, 4, 5, 2]]
POLYGON_LINES = [" ".join(map(str, [len(polygon), *polygon])) for polygon in POLYGONS]
OBJ = (
    "mtllib a.mtl\n"
    + "".join(f"v {line} 1 0.5 0\n" for line in LINES)
    + "vt 0 0\nvt 1 0\nvt 1 1\nvn 0 0 1\nusemtl a\nf 1/1/1 2/2/1 3/3/1 4/1/1\n"
    "usemtl b\nf -5/-1/-1 5/1/1 6/2/1\nf 1//1 2//1 \\\n5//1 6//1 3//1\n"
)
ALIKE = "".join(f"v {k} {k * k % 7} {k % 3}\n" for k in range(40)) + "".join(
    f"f {k} {k + 1} {k + 2}\n" for k in range(1, 38)
)
MTL = "newmtl a\nKd 1 0 0\nKs 0.5 0.5 0.5\nNs 30\nd 0.5\nmap_Kd -s 1 1 1 a.png\nnewmtl b\nTr 0.25\nKd 0 1 0\n"


def picture(kind: str, mode: str = "RGB") -> bytes:
    """Return a picture of 8 x 8 pixels."""
    values = np.random.default_rng(1).integers(0, 256, (8, 8, 3), np.uint8)
    stream = BytesIO()
    Image.fromarray(values).convert(mode).save(stream, kind)
    return stream.getvalue()


def gltf_writer() -> GltfWriter:
    """Return a glTF file with a textured, a plain and a coloured part in two places."""
    writer = GltfWriter()
    positions, uvs = POINTS.astype(np.float32), POINTS[:, :2].astype(np.float32)
    normals = np.tile(np.float32([0, 0, 1]), (6, 1))
    colors = np.tile(np.uint8([255, 128, 0, 255]), (6, 1))
    writer.primitive([[0, 1, 2], [0, 2, 3]], 0, POSITION=positions, NORMAL=normals, TEXCOORD_0=uvs)
    writer.primitive([[1, 4, 5]], None, POSITION=positions, COLOR_0=colors)
    writer.header |= {
        "materials": [
            {"pbrMetallicRoughness": {"baseColorTexture": {"index": 0}, "baseColorFactor": [1, 1, 0.5, 1]}}
        ],
        "textures": [{"source": 0}],
        "images": [{"bufferView": writer.view(picture("PNG")), "mimeType": "image/png"}],
        "nodes": [
            {"name": "parent", "translation": [1, 0, 0], "children": [1, 2]},
            {"name": "child", "mesh": 0, "scale": [2, 2, 2], "rotation": [0, 0, 0.6, 0.8]},
            {"mesh": 0, "matrix": [-1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1]},
        ],
    }
    return writer


def state_of(document: Document, folder: Path) -> bytes:
    """Return the state file of a document."""
    path = folder / "a.rasterscope"
    state = State(
        document,
        bookmarks=[Bookmark(stage="raster", position=3, note="here")],
        breakpoints=Breakpoints(pixels=[(1, 2)], lines=[("cover", 3)], condition="E0 < 0.5"),
        look=Look(
            views={"raster": "clip"},
            grid=GridLook(buffers={"raster": "color"}, ranges={"depth": (0.0, 0.5)}, zoom=2.0),
            orbits={"scene": OrbitRecord(azimuth=1.0, elevation=0.5, target=(0.0, 0.0, 0.0), extent=2.0)},
            other={"fill": "scanline"},
        ),
    )
    save_state(path, state)
    return path.read_bytes()


def seed_files(folder: Path) -> list[dict[str, bytes]]:
    """Return the files to damage; those that the program itself writes are made in a new ``folder``."""
    folder.mkdir()
    obj = {"a.obj": OBJ.encode(), "a.mtl": MTL.encode(), "a.png": picture("PNG")}
    faces = ply_text(LINES, [f"{line} 255 0 0" for line in POLYGON_LINES[:1] + POLYGON_LINES[2:]])
    colors = "property uchar red\nproperty uchar green\nproperty uchar blue\nend_header"
    named = "x y z nx ny nz red green blue alpha s t"
    rows = [f"{line} 0 0 1 255 128 0 51 0.25 0.5" for line in LINES]
    gltf = gltf_writer()
    text = gltf.gltf(folder / "a.bin")
    found = [
        obj,
        {"b.obj": ALIKE.encode()},
        {
            "a.ply": ply_text(rows, POLYGON_LINES, named, "comment TextureFile a.png\n").encode(),
            "a.png": obj["a.png"],
        },
        {"b.ply": ply_binary(POINTS, POLYGONS)},
        {"c.ply": ply_binary(POINTS, [[0, 1, 2], [1, 4, 5]], ">")},
        {"d.ply": faces.replace("end_header", colors).encode()},
        {"a.off": ("OFF\n6 3 0\n" + "\n".join(LINES + POLYGON_LINES) + "\n").encode()},
        {
            "b.off": (
                "COFF\n6 3 0\n" + "".join(f"{p} 1 0.5 0 1\n" for p in LINES) + "\n".join(POLYGON_LINES)
            ).encode()
        },
        {"a.stl": stl_binary(POINTS[[[0, 1, 2], [1, 4, 5]]])},
        {"b.stl": stl_text(POINTS[[[0, 1, 2], [1, 4, 5]]]).encode()},
        {"a.xyz": "".join(f"{line} 255 128 0\n" for line in LINES).encode()},
        {"a.dxf": dxf_text(*ENTITIES).encode()},
        {"a.glb": gltf_writer().glb()},
        {"a.gltf": text.encode(), "a.bin": (folder / "a.bin").read_bytes()},
        {"study.json": (EARLIER / "study-cull-closed.json").read_bytes()},
        {"atlas.json": (EARLIER / "stress-precision-dial.json").read_bytes()},
        {"a.rasterscope": (EARLIER / "typed-clip.rasterscope").read_bytes()},
        {"b.rasterscope": (EARLIER / "edited-cube.rasterscope").read_bytes()},
    ]
    for file, content in obj.items():
        (folder / file).write_bytes(content)
    found.append({"c.rasterscope": state_of(open_any(str(folder / "a.obj")).document, folder)} | obj)
    corners = np.random.default_rng(1).random((450, 3))
    loose = frame_meshes((Mesh(corners, np.arange(450).reshape(-1, 3)),))
    found.append({"d.rasterscope": state_of(open_document(loose, "loose"), folder)})
    table = open_document(table_scene(depth_table("- 4", "- -")), "table")
    found.append({"e.rasterscope": state_of(table, folder)})
    kinds = (
        ("JPEG", "L"),
        ("BMP", "P"),
        ("GIF", "P"),
        ("TGA", "RGBA"),
        ("TIFF", "RGB"),
        ("WEBP", "RGBA"),
        ("PNG", "1"),
    )
    found += [obj | {"a.png": picture(kind, mode)} for kind, mode in kinds]
    return found
