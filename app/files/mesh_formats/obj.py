"""OBJ, the Wavefront text format: polygons over positions, texture coordinates and normals numbered apart."""

from array import array
from collections.abc import Sequence
from dataclasses import dataclass, field
from pathlib import Path

import numpy as np

from app.files.mesh_formats.images import linear_from_srgb
from app.files.mesh_formats.mtl import ObjMaterial, find_materials
from app.files.mesh_formats.polygons import share_vertices, triangulate_polygons
from app.files.mesh_formats.reading import (
    LoadedMeshes,
    MeshFileError,
    Report,
    check_memory,
    check_positions,
    check_text,
)
from core.geometry.vertex_stage import vertex_normals
from core.records.arrays import Floats, Integers
from core.scene import Mesh

MEMORY_PER_BYTE = 16
"""Bytes of memory that a byte of an OBJ file takes at most while it is opened (measured)."""

REPORT_LINES = 20000
"""Lines between two reports of progress."""

KINDS = ("vertex", "texture coordinate", "normal")


@dataclass
class ObjLines:
    """The numbers of an OBJ file, as its lines give them."""

    positions: "array[float]" = field(default_factory=lambda: array("d"))
    colors: "array[float]" = field(default_factory=lambda: array("d"))
    uvs: "array[float]" = field(default_factory=lambda: array("d"))
    normals: "array[float]" = field(default_factory=lambda: array("d"))
    corners: list[Integers] = field(default_factory=list)
    """Pieces (n, 3): numbers of position, texture coordinate and normal from 1, or 0 for none."""
    sizes: "array[int]" = field(default_factory=lambda: array("q"))
    """Corners of each face."""
    lines: "array[int]" = field(default_factory=lambda: array("q"))
    """Line of each face."""
    materials: list[tuple[int, str]] = field(default_factory=list)
    """First face and name of each ``usemtl``."""
    libraries: list[str] = field(default_factory=list)
    words: list[str] = field(default_factory=list)
    """Corners as text, not yet turned into numbers."""

    def vertex(self, numbers: list[float]) -> None:
        """Add a ``v`` line: x y z, x y z w, x y z r g b or x y z r g b a."""
        if len(numbers) not in (3, 4, 6, 7):
            raise ValueError(f"a vertex needs 3 numbers, got {len(numbers)}")
        if len(numbers) >= 6:
            self.colors.extend([1.0] * (len(self.positions) - len(self.colors)))
            self.colors.extend(numbers[3:6])
        self.positions.extend(numbers[:3])

    def face(self, words: list[str], line: int) -> None:
        """Add an ``f`` line."""
        if len(words) < 3:
            raise ValueError(f"a face needs at least 3 corners, got {len(words)}")
        self.words += words
        self.sizes.append(len(words))
        self.lines.append(line)
        if len(self.words) > 200000:
            self.convert()

    def absolute(self, word: str) -> str:
        """Return a corner whose negative numbers, which count back from here, are counted from 1."""
        counts = (len(self.positions) // 3, len(self.uvs) // 2, len(self.normals) // 3)
        numbers = [int(number) if number else 0 for number in word.split("/")]
        from_start = [n + count + 1 if n < 0 else n for n, count in zip(numbers, counts, strict=False)]
        if any(old < 0 and new < 1 for old, new in zip(numbers, from_start, strict=False)):
            raise ValueError(f"corner {word} counts back beyond the first vertex")
        return "/".join(str(number) if number else "" for number in from_start)

    def convert(self) -> None:
        """Turn the corners read so far into numbers."""
        if self.words:
            try:
                self.corners.append(corner_numbers(self.words))
            except BadCornerError as problem:
                ends = np.cumsum(self.sizes)
                corner = ends[-1] - len(self.words) + problem.place
                line = self.lines[int(np.searchsorted(ends, corner, side="right"))]
                raise MeshFileError(f"line {line}: {problem} is not a corner of a face") from problem
            self.words = []


class BadCornerError(ValueError):
    """A corner of a face that is not ``v``, ``v/vt``, ``v//vn`` or ``v/vt/vn``."""

    def __init__(self, word: str, place: int) -> None:
        super().__init__(word)
        self.place = place


def corner_numbers(words: Sequence[str]) -> Integers:
    """Return (n, 3) int64 numbers of position, texture coordinate and normal; 0 where there is none."""
    numbers = np.zeros((len(words), 3), np.int64)
    shapes = {(word.count("/"), "//" in word) if "/" in word else (0, False) for word in words}
    columns = {(0, False): [0], (1, False): [0, 1], (2, True): [0, 2], (2, False): [0, 1, 2]}

    # Nearly always all corners have one shape: then they are one row of numbers.
    if len(shapes) == 1 and (shape := shapes.pop()) in columns:
        try:
            row = [int(number) for number in "/".join(words).replace("//", "/").split("/")]
        except ValueError:
            row = []
        if len(row) == len(words) * len(columns[shape]):
            numbers[:, columns[shape]] = np.array(row, np.int64).reshape(len(words), -1)
            return numbers
    for place, word in enumerate(words):
        try:
            parts = [int(number) if number else 0 for number in word.split("/")]
            numbers[place, : len(parts)] = parts
        except ValueError as problem:
            raise BadCornerError(word, place) from problem
    return numbers


def read_lines(path: Path, report: Report) -> ObjLines:
    """Read all lines of ``path``; a line that cannot be read raises MeshFileError with its number."""
    found = ObjLines()
    size, done, number, held = path.stat().st_size, 0, 0, ""
    with path.open(encoding="utf-8-sig", errors="replace") as file:
        for line in file:
            number += 1
            if number % REPORT_LINES == 0:
                report(min(1.0, done / size), "reading lines")
            done += len(line)
            if line.endswith("\\\n"):
                held += line[:-2] + " "
                continue
            try:
                read_line(found, held + line, number)
            except ValueError as problem:
                raise MeshFileError(f"{path.name}, line {number}: {problem}") from problem
            held = ""
    try:
        found.convert()
    except MeshFileError as problem:
        raise MeshFileError(f"{path.name}, {problem}") from problem
    return found


def read_line(found: ObjLines, line: str, number: int) -> None:
    """Put what one line says into ``found``; keywords that draw no triangles are passed over."""
    words = line.split()
    if not words:
        return
    keyword = words[0]
    if "#" in line and keyword in ("v", "vt", "vn", "f"):
        line = line.partition("#")[0]
        words = line.split()
    if keyword == "v":
        found.vertex([float(word) for word in words[1:]])
    elif keyword == "f":
        corners = words[1:]
        found.face([found.absolute(corner) for corner in corners] if "-" in line else corners, number)
    elif keyword == "vt":
        u, v = [float(word) for word in words[1:3]] if len(words) > 2 else (float(words[1]), 0.0)
        found.uvs.extend((u, v))
    elif keyword == "vn":
        x, y, z = [float(word) for word in words[1:]]
        found.normals.extend((x, y, z))
    elif keyword == "usemtl":
        found.materials.append((len(found.sizes), line.strip()[6:].strip()))
    elif keyword == "mtllib":
        found.libraries.append(line.strip()[6:].strip())


def read_obj(path: Path, report: Report) -> LoadedMeshes:
    """Read an OBJ file with its materials and textures.

    Each run of faces with one material is a mesh, so that triangles stay in the order of the file. Where
    the file names no material library and has texture coordinates, an image that stands beside it as
    ``<stem>_texture.png`` or ``<stem>.png`` (or ``.jpg``) is its texture. Vertex colours, ``v x y z r g b``,
    count as sRGB.

    Raises
    ------
    MeshFileError
        If a line cannot be read, a number names something that is not there, or there are no faces.
    OSError
        If ``path`` cannot be read.
    """
    check_memory(path, path.stat().st_size * MEMORY_PER_BYTE)
    check_text(path, "OBJ")
    found = read_lines(path, report)
    report(None, "joining corners")
    if not found.positions:
        raise MeshFileError(f"{path.name} has no vertices: it is empty or no OBJ file")
    if not found.sizes:
        raise MeshFileError(f"{path.name} has no faces")
    numbers = np.concatenate(found.corners)
    check_numbers(path, found, numbers)
    return build_meshes(path, found, numbers - 1)


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


def build_meshes(path: Path, found: ObjLines, numbers: Integers) -> LoadedMeshes:
    """Make the meshes of the runs of one material; ``numbers`` (n, 3) count from 0, -1 is none."""
    positions = np.array(found.positions).reshape(-1, 3)
    uvs, normals = np.array(found.uvs).reshape(-1, 2), np.array(found.normals).reshape(-1, 3)
    colors = np.array(found.colors).reshape(-1, 3)
    sizes = np.array(found.sizes, np.int64)
    check_positions(path, positions, first=1)
    corners, faces = triangulate_polygons(positions[numbers[:, 0]], sizes)
    corners = numbers[corners]
    averaged = None
    materials, warnings = find_materials(
        path, found.libraries, [name for _, name in found.materials], bool(found.uvs)
    )
    meshes: list[Mesh] = []
    for first, end, name in runs(found, len(sizes)):
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
        elif len(v) > len(np.unique(v)) or len(meshes) or end < len(sizes):
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
