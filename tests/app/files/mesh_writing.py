"""Mesh files that tests write: small ones by hand, large ones by formula."""

import json
import struct
from pathlib import Path

import numpy as np
from PIL import Image

SQUARE = "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\n"
"""OBJ vertices of the unit square."""


def write(path: Path, content: str | bytes) -> Path:
    if isinstance(content, str):
        path.write_text(content, encoding="utf-8")
    else:
        path.write_bytes(content)
    return path


def write_image(path: Path, pixels: list[list[tuple[int, ...]]]) -> Path:
    Image.fromarray(np.array(pixels, np.uint8)).save(path)
    return path


def ply_text(vertices: list[str], faces: list[str], names: str = "x y z", more: str = "") -> str:
    properties = "".join(
        f"property {'uchar' if name in ('red', 'green', 'blue', 'alpha') else 'float'} {name}\n"
        for name in names.split()
    )
    return (
        f"ply\nformat ascii 1.0\n{more}element vertex {len(vertices)}\n{properties}"
        f"element face {len(faces)}\nproperty list uchar int vertex_indices\nend_header\n"
        + "\n".join([*vertices, *faces])
        + "\n"
    )


def ply_binary(positions: np.ndarray, polygons: list[list[int]], order: str = "<") -> bytes:
    name = {"<": "little", ">": "big"}[order]
    header = (
        f"ply\nformat binary_{name}_endian 1.0\nelement vertex {len(positions)}\n"
        "property float x\nproperty double y\nproperty float z\n"
        f"element face {len(polygons)}\nproperty list uchar uint vertex_index\n"
        "property uchar flag\nend_header\n"
    )
    vertices = b"".join(struct.pack(order + "fdf", *position) for position in positions)
    faces = b"".join(
        struct.pack(order + f"B{len(polygon)}IB", len(polygon), *polygon, 7) for polygon in polygons
    )
    return header.encode() + vertices + faces


def stl_binary(triangles: np.ndarray) -> bytes:
    """Triangles (T, 3, 3)."""
    rows = np.zeros(len(triangles), [("normal", "<f4", 3), ("corners", "<f4", (3, 3)), ("more", "<u2")])
    rows["corners"] = triangles
    return b"written by a test".ljust(80) + struct.pack("<I", len(triangles)) + rows.tobytes()


def stl_text(triangles: np.ndarray, name: str = "solid of a test") -> str:
    facets = [
        "facet normal 0 0 1\nouter loop\n"
        + "".join("vertex {} {} {}\n".format(*corner) for corner in triangle.tolist())
        + "endloop\nendfacet\n"
        for triangle in triangles
    ]
    return f"solid {name}\n{''.join(facets)}endsolid {name}\n"


SEGMENT = "0\nLINE\n10\n0.0\n20\n0.0\n11\n4.0\n21\n3.0\n"
POLYLINE = "0\nLWPOLYLINE\n70\n1\n10\n0.0\n20\n0.0\n10\n4\n20\n0\n10\n4\n20\n3\n"
CIRCLE = "0\nCIRCLE\n10\n1\n20\n1\n40\n2\n"
BLOCK = f"0\nBLOCK\n2\nB\n10\n0\n20\n0\n{SEGMENT}0\nENDBLK\n"
INSERT = "0\nINSERT\n2\nB\n10\n5\n20\n5\n"
ENTITIES = (SEGMENT, POLYLINE, CIRCLE, INSERT)


def dxf_text(*entities: str) -> str:
    return f"0\nSECTION\n2\nBLOCKS\n{BLOCK}0\nENDSEC\n0\nSECTION\n2\nENTITIES\n{''.join(entities)}0\nENDSEC\n0\nEOF\n"


class GltfWriter:
    """Collects accessors in one buffer."""

    def __init__(self) -> None:
        self.buffer = b""
        self.header: dict = {
            "asset": {"version": "2.0"},
            "scene": 0,
            "scenes": [{"nodes": [0]}],
            "nodes": [{"mesh": 0, "name": "first"}],
            "meshes": [{"primitives": []}],
            "accessors": [],
            "bufferViews": [],
        }

    def view(self, content: bytes) -> int:
        self.buffer += b"\0" * (-len(self.buffer) % 4)
        self.header["bufferViews"].append(
            {"buffer": 0, "byteOffset": len(self.buffer), "byteLength": len(content)}
        )
        self.buffer += content
        return len(self.header["bufferViews"]) - 1

    def accessor(self, values: np.ndarray) -> int:
        kinds = {"float32": 5126, "uint32": 5125, "uint8": 5121, "uint16": 5123}
        shapes = {1: "SCALAR", 2: "VEC2", 3: "VEC3", 4: "VEC4"}
        self.header["accessors"].append(
            {
                "bufferView": self.view(values.tobytes()),
                "componentType": kinds[values.dtype.name],
                "count": len(values),
                "type": shapes[values.shape[1] if values.ndim == 2 else 1],
            }
        )
        return len(self.header["accessors"]) - 1

    def primitive(
        self, indices: list[list[int]], material: int | None = None, **attributes: np.ndarray
    ) -> None:
        part: dict = {
            "attributes": {name: self.accessor(values) for name, values in attributes.items()},
            "indices": self.accessor(np.array(indices, np.uint32).ravel()),
        }
        if material is not None:
            part["material"] = material
        self.header["meshes"][0]["primitives"].append(part)

    def glb(self) -> bytes:
        self.header["buffers"] = [{"byteLength": len(self.buffer)}]
        text = json.dumps(self.header).encode()
        text += b" " * (-len(text) % 4)
        binary = self.buffer + b"\0" * (-len(self.buffer) % 4)
        chunks = (
            struct.pack("<I4s", len(text), b"JSON")
            + text
            + struct.pack("<I4s", len(binary), b"BIN\0")
            + binary
        )
        return struct.pack("<4sII", b"glTF", 2, 12 + len(chunks)) + chunks

    def gltf(self, buffer: Path) -> str:
        buffer.write_bytes(self.buffer)
        self.header["buffers"] = [{"byteLength": len(self.buffer), "uri": buffer.name}]
        return json.dumps(self.header)
