"""PLY, the polygon file format: elements of named properties, as text or binary."""

from dataclasses import dataclass
from pathlib import Path

import numpy as np

from app.files.file_access import NamedFileError, NamedFiles, left_out, open_input
from app.files.mesh_formats import reading
from app.files.mesh_formats.images import TextureReader, linear_from_srgb
from app.files.mesh_formats.ply_body import Column, Element, Property, Rows, read_body
from core.records.arrays import Floats
from core.scene import Mesh, Texture
from core.transform.vertex_stage import vertex_normals

MEMORY_PER_BYTE = 16
"""Bytes of memory that a byte of a PLY file takes at most while it is opened (measured)."""

TYPES = {
    "char": "i1", "int8": "i1", "uchar": "u1", "uint8": "u1",
    "short": "i2", "int16": "i2", "ushort": "u2", "uint16": "u2",
    "int": "i4", "int32": "i4", "uint": "u4", "uint32": "u4",
    "int64": "i8", "uint64": "u8",
    "float": "f4", "float32": "f4", "double": "f8", "float64": "f8",
}  # fmt: skip
"""NumPy's name for each type of a property."""

UV_NAMES = (("s", "t"), ("u", "v"), ("texture_u", "texture_v"), ("texture_s", "texture_t"))


@dataclass(frozen=True)
class Header:
    """What the first lines say."""

    elements: tuple[Element, ...]
    encoding: str
    texture: str
    """Name of the ``TextureFile`` comment, or empty."""
    size: int
    """Bytes up to and with the line ``end_header``."""


def read_header(path: Path) -> Header:
    """Read the header of ``path``, or raise MeshFileError."""
    elements: list[tuple[str, int, list[Property]]] = []
    encoding = texture = ""
    with open_input(path) as file:
        if file.readline(64).strip() != b"ply":
            raise reading.MeshFileError(f"{path.name} is not a PLY file: it does not begin with the line ply")
        for line in iter(lambda: file.readline(65536), b""):
            text = line.decode("utf-8", errors="replace").strip()
            words = text.split()
            try:
                if words[:1] == ["end_header"]:
                    ready = tuple(Element(name, count, tuple(has)) for name, count, has in elements)
                    return Header(ready, encoding, texture, file.tell())
                if words[:1] == ["format"]:
                    encoding = {"ascii": "", "binary_little_endian": "<", "binary_big_endian": ">"}[
                        words[1]
                    ] or "ascii"
                elif words[:1] == ["element"]:
                    elements.append((words[1], int(words[2]), []))
                elif words[:2] == ["property", "list"]:
                    elements[-1][2].append(Property(words[4], TYPES[words[3]], TYPES[words[2]]))
                elif words[:1] == ["property"]:
                    elements[-1][2].append(Property(words[2], TYPES[words[1]]))
                elif words[:2] == ["comment", "TextureFile"]:
                    texture = text.split("TextureFile", 1)[1].strip()
            except (IndexError, KeyError, ValueError) as problem:
                raise reading.MeshFileError(
                    f"{path.name} has a header line that cannot be read: {text[:80]}"
                ) from problem
    raise reading.MeshFileError(f"{path.name} is cut short: its header has no end")


def read_ply(path: Path, report: reading.Report, files: NamedFiles) -> reading.LoadedMeshes:
    """Read a PLY file: text or binary of either byte order, polygons of any size.

    Positions, normals, colours of vertices or faces, and texture coordinates of vertices or corners are read. Colours
    count as sRGB. Without faces, the element ``edge`` is read as segments; without it, vertices are points. Raises
    MeshFileError if the file is cut short, names a vertex that it does not have, or has no vertices; OSError if
    ``path`` cannot be read.
    """
    header = read_header(path)
    reading.check_memory(path, path.stat().st_size * MEMORY_PER_BYTE)
    body = read_body(path, header.elements, header.encoding, header.size, report)
    vertex, face = body.get("vertex", Rows(0, {}, {})), body.get("face", Rows(0, {}, {}))
    if not vertex.count or any(axis not in vertex.columns for axis in "xyz"):
        raise reading.MeshFileError(f"{path.name} has no vertices")
    corners = face.lists.get("vertex_indices", face.lists.get("vertex_index"))
    if corners is None or not len(corners.sizes):
        return read_wires(path, vertex, body.get("edge", Rows(0, {}, {})))
    report(None, "joining corners")
    return build_mesh(path, header, vertex, face, corners, TextureReader(files), report)


def read_wires(path: Path, vertex: Rows, edge: Rows) -> reading.LoadedMeshes:
    """Return the edges of a file without faces as segments, or else its vertices as points."""
    index = np.arange(vertex.count)[:, None]
    if edge.count and all(name in edge.columns for name in ("vertex1", "vertex2")):
        index = np.stack([edge.columns[name].astype(np.int64) for name in ("vertex1", "vertex2")], axis=1)
    return reading.load_wires(path, reading.Wires(stacked(vertex, "xyz"), index, read_colors(vertex)), [])


def build_mesh(
    path: Path,
    header: Header,
    vertex: Rows,
    face: Rows,
    polygons: Column,
    textures: TextureReader,
    report: reading.Report,
) -> reading.LoadedMeshes:
    """Make the one mesh of a PLY file."""
    positions = stacked(vertex, "xyz")
    reading.check_positions(path, positions)
    reading.check_polygons(path, polygons.sizes, polygons.items, len(positions))
    indices = polygons.items.astype(np.int64)
    corners, faces = reading.triangulate_polygons(positions, indices, polygons.sizes, report)
    triangles = indices[corners]
    warnings: list[str] = []
    normals = whole(vertex, ("nx", "ny", "nz"), warnings)
    uvs = next((found for names in UV_NAMES if (found := whole(vertex, names, warnings)) is not None), None)
    colors = read_colors(vertex)

    # What differs between the faces around a vertex makes several vertices of it.
    keys = [triangles]
    texcoord = face.lists.get("texcoord")
    corner_uvs = None
    if texcoord is not None and (texcoord.sizes == 2 * polygons.sizes).all():
        corner_uvs, key = np.unique(
            texcoord.items.astype(np.float64).reshape(-1, 2), axis=0, return_inverse=True
        )
        keys.append(key.reshape(-1)[corners])
    face_colors = read_colors(face) if colors is None else None
    if face_colors is not None:
        keys.append(np.broadcast_to(faces[:, None], (len(faces), 3)))
    if len(keys) > 1:
        if normals is None:
            normals = vertex_normals(positions, triangles)
        triangles, sources = reading.share_vertices(*keys)
        v = sources[0]
        positions, normals = positions[v], normals[v]
        uvs = corner_uvs[sources[1]] if corner_uvs is not None else None if uvs is None else uvs[v]
        colors = (
            face_colors[sources[-1]] if face_colors is not None else None if colors is None else colors[v]
        )
    texture = read_named_texture(textures, header.texture, warnings)
    mesh = Mesh(
        positions,
        triangles,
        normals,
        uvs,
        colors,
        texture if uvs is not None else None,
        faces,
        name=path.stem,
    )
    return reading.LoadedMeshes((mesh,), tuple(warnings))


def whole(rows: Rows, names: tuple[str, ...], warnings: list[str]) -> Floats | None:
    """Return columns side by side as `stacked`, ``None`` where one is missing; if only some are, that is a warning."""
    missing = [name for name in names if name not in rows.columns]
    if missing and len(missing) < len(names):
        present = ", ".join(name for name in names if name in rows.columns)
        warnings.append(f"vertices have {present} without {', '.join(missing)}; {present} is left out")
    return None if missing else stacked(rows, names)


def stacked(rows: Rows, names: str | tuple[str, ...]) -> Floats:
    """Return columns side by side, (count, len(names)) float64."""
    return np.stack([rows.columns[name].astype(np.float64) for name in names], axis=1)


def read_colors(rows: Rows) -> Floats | None:
    """Return (count, 4) linear colours, or None where there are none."""
    if any(name not in rows.columns for name in ("red", "green", "blue")):
        return None
    scale = rows.scales["red"]
    colors = np.ones((rows.count, 4))
    colors[:, :3] = linear_from_srgb(stacked(rows, ("red", "green", "blue")) / scale)
    if "alpha" in rows.columns:
        colors[:, 3] = np.clip(rows.columns["alpha"] / rows.scales["alpha"], 0, 1)
    return colors


def read_named_texture(textures: TextureReader, name: str, warnings: list[str]) -> Texture | None:
    """Return the texture of the ``TextureFile`` comment; why it cannot be had is added to ``warnings``."""
    if not name:
        return None
    try:
        return textures.read(name)
    except NamedFileError as problem:
        warnings.append(left_out(f"texture {name}", problem))
        return None
