"""OBJ, the Wavefront text format: polygons over positions, texture coordinates and normals numbered apart."""

from dataclasses import replace
from pathlib import Path

import numpy as np

from app.files.mesh_formats.images import TextureReader, linear_from_srgb
from app.files.mesh_formats.mtl import ObjMaterial, find_materials
from app.files.mesh_formats.obj_lines import ObjLines, read_lines
from app.files.mesh_formats.polygons import share_vertices, triangulate_polygons
from app.files.mesh_formats.reading import (
    LoadedMeshes,
    MeshFileError,
    Report,
    Wires,
    check_memory,
    check_mesh_count,
    check_positions,
    check_text,
    load_wires,
)
from app.files.named_files import NamedFiles
from core.geometry.vertex_stage import vertex_normals
from core.records.arrays import Floats, Integers
from core.records.words import counted
from core.scene import Mesh

MEMORY_PER_BYTE = 16
"""Bytes of memory that a byte of an OBJ file takes at most while it is opened (measured)."""

KINDS = ("vertex", "texture coordinate", "normal")


def read_obj(path: Path, report: Report, files: NamedFiles) -> LoadedMeshes:
    """Read an OBJ file with its materials and textures.

    Each run of faces with one material is a mesh, so that triangles stay in the order of the file. Where the file names
    no material library and has texture coordinates, an image that stands beside it as ``<stem>_texture.png`` or
    ``<stem>.png`` (or ``.jpg``) is its texture. Vertex colours, ``v x y z r g b``, count as sRGB. Of a file without
    faces, ``l`` lines are segments, without those ``p`` lines are points, and without these all vertices are. Raises
    MeshFileError if a line cannot be read, a number names something that is not there, or there are no vertices;
    OSError if ``path`` cannot be read.
    """
    check_memory(path, path.stat().st_size * MEMORY_PER_BYTE)
    check_text(path, "OBJ")
    found = read_lines(path, report)
    report(None, "joining corners")
    if not found.positions:
        raise MeshFileError(f"{path.name} has no vertices: it is empty or no OBJ file")
    points, segments = np.array(found.points, np.int64), np.array(found.segments, np.int64).reshape(-1, 2)
    if not found.sizes:
        if not len(points) and not len(segments):
            points = np.arange(1, len(found.positions) // 3 + 1)
        return read_wires(path, found, points, segments)
    numbers = np.array(found.corners).reshape(-1, 3)
    check_numbers(path, found, numbers)
    loaded = build_meshes(path, found, numbers - 1, TextureReader(files), report)
    if not len(points) and not len(segments):
        return loaded
    said = f"{counted(len(segments), 'segment')} and {counted(len(points), 'point')} beside the faces are left out"
    return replace(loaded, warnings=(*loaded.warnings, said))


def read_wires(path: Path, found: ObjLines, points: Integers, segments: Integers) -> LoadedMeshes:
    """Return the segments (K, 2) of a file without faces, or else its points (K,); both count from 1."""
    positions = np.array(found.positions).reshape(-1, 3)
    colors = None
    if found.colors:
        colors = vertex_colors(np.array(found.colors).reshape(-1, 3), np.arange(len(positions)), None)
    warnings = []
    if len(points) and len(segments):
        warnings.append(f"{counted(len(points), 'point')} beside the segments are left out")
    index = segments if len(segments) else points[:, None]
    return load_wires(path, Wires(positions, index - 1, colors), warnings)


def check_numbers(path: Path, found: ObjLines, numbers: Integers) -> None:
    """Raise MeshFileError for the first corner that names something that the file does not have."""
    counts = (len(found.positions) // 3, len(found.uvs) // 2, len(found.normals) // 3)
    wrong = (numbers > np.array(counts)) | (numbers < 0) | (numbers < np.array([1, 0, 0]))
    if wrong.any():
        corner, kind = (int(places[0]) for places in np.nonzero(wrong))
        line = found.lines[int(np.searchsorted(np.cumsum(found.sizes), corner, side="right"))]
        raise MeshFileError(
            f"{path.name}, line {line}: a face names {KINDS[kind]} {numbers[corner, kind]}, "
            f"the file has {counts[kind]}, counted from 1"
        )


def build_meshes(
    path: Path, found: ObjLines, numbers: Integers, textures: TextureReader, report: Report
) -> LoadedMeshes:
    """Make the meshes of the runs of one material; ``numbers`` (n, 3) count from 0, -1 is none."""
    positions = np.array(found.positions).reshape(-1, 3)
    uvs, normals = np.array(found.uvs).reshape(-1, 2), np.array(found.normals).reshape(-1, 3)
    colors = np.array(found.colors).reshape(-1, 3)
    sizes = np.array(found.sizes, np.int64)
    parts = runs(found, len(sizes))
    check_mesh_count(path, len(parts), "runs of faces with one material")
    check_positions(path, positions, first=1)
    corners, faces = triangulate_polygons(positions, numbers[:, 0], sizes, report)
    corners = numbers[corners]
    averaged = None
    materials, warnings = find_materials(
        textures, found.libraries, [name for _, name in found.materials], bool(found.uvs)
    )
    meshes: list[Mesh] = []
    for first, end, name in parts:
        report(first / len(sizes), "making a mesh of each material")
        look = materials.get(name, ObjMaterial(name))
        chosen = slice(*np.searchsorted(faces, [first, end]))
        part = corners[chosen]
        is_textured, is_smooth = bool((part[..., 1] >= 0).any()), bool((part[..., 2] >= 0).all())
        warnings += partial_warnings(part, look.name or path.stem)

        # One vertex for corners that agree in all that is used of them.
        used = [0] + [1] * is_textured + [2] * is_smooth
        triangles, sources = share_vertices(*(part[..., kind] for kind in used))
        v = sources[0]
        if is_smooth:
            vertex_normal = normals[sources[-1]]
        elif (v[1:] == v[:-1]).any() or len(meshes) or end < len(sizes):
            # Seams of texture and material are no creases: average over the whole file.
            if averaged is None:
                averaged = vertex_normals(positions, corners[..., 0])
            vertex_normal = averaged[v]
        else:
            vertex_normal = None
        meshes.append(
            Mesh(
                positions=positions[v],
                triangles=triangles,
                normals=vertex_normal,
                uvs=np.where(sources[1][:, None] < 0, 0.0, uvs[sources[1]]) if is_textured else None,
                colors=vertex_colors(colors, v, materials.get(name)),
                texture=look.texture if is_textured else None,
                faces=faces[chosen],
                material=look.material,
                name=look.name or path.stem,
            )
        )
    return LoadedMeshes(tuple(meshes), tuple(warnings))


def runs(found: ObjLines, count: int) -> list[tuple[int, int, str]]:
    """Return first face, end and material name of every run of faces with one material, in order."""
    starts: list[tuple[int, str]] = [(0, "")]
    for face, name in found.materials:
        if face == starts[-1][0]:
            starts.pop()
        if not starts or starts[-1][1] != name:
            starts.append((face, name))
    ends = [face for face, _ in starts[1:]] + [count]
    return [(face, end, name) for (face, name), end in zip(starts, ends, strict=True) if face < end]


def partial_warnings(part: Integers, name: str) -> list[str]:
    """Say which of texture coordinates and normals only some corners of ``part`` have."""
    instead = {1: "they get (0, 0)", 2: "the normals of all are averaged from the faces"}
    return [
        f"some corners of {name} have no {KINDS[kind]}; {instead[kind]}"
        for kind in (1, 2)
        if (part[..., kind] >= 0).any() and (part[..., kind] < 0).any()
    ]


def vertex_colors(colors: Floats, v: Integers, look: ObjMaterial | None) -> Floats | None:
    """Return (N, 4) linear colours of the vertices ``v``: their own, else those of the material, if any."""
    if len(colors):
        own = np.ones((len(v), 4))
        has_color = v < len(colors)
        own[has_color, :3] = linear_from_srgb(colors[v[has_color]])
        return own
    return None if look is None else np.tile(look.color, (len(v), 1))
