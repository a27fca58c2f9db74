"""OBJ, the Wavefront text format: polygons over positions, texture coordinates and normals, read line by line.

Most lines of a large file say the same as the line before with other numbers. Where that is certain for a whole run of
lines, one call reads all of them. Every other line is read by itself, by rules that name what is wrong with it.
"""

from array import array
from collections.abc import Iterator, Sequence
from dataclasses import dataclass, field, replace
from itertools import pairwise
from pathlib import Path

import numpy as np

from app.files.file_access import NamedFiles, open_input
from app.files.mesh_formats import reading
from app.files.mesh_formats.images import TextureReader, linear_from_srgb
from app.files.mesh_formats.mtl import ObjMaterial, find_materials
from core.records.arrays import Floats, Integers
from core.records.words import counted
from core.scene import Mesh
from core.transform.vertex_stage import vertex_normals

# Lines of an OBJ file that are alike but for their numbers, which are read together.


DIGITS = b"0123456789"
DECIMALS = DIGITS + b"+-.eE"
"""What decimal numbers consist of; other spellings, as ``nan``, make a line unlike."""

COLUMNS = {b"": [0], b"/": [0, 1], b"//": [0, 1, 2]}
"""Which of position, texture coordinate and normal a corner names, by its text without digits."""

CLAMPED = np.iinfo(np.int64).max
"""What NumPy reads larger integers as."""


def runs_of_lines(content: bytes, fewest: int, most: int) -> Iterator[tuple[bytes, int]]:
    r"""Yield consecutive parts of a text, each with the number of its lines.

    Parameters
    ----------
    content : bytes
        Lines, each with ``\n`` at its end.
    fewest, most : int
        At least ``fewest`` lines that begin with the same two bytes are a part of their own; so are the lines between
        such parts. No part has more than ``most`` lines.
    """
    cells = np.frombuffer(content, np.uint8)
    ends = np.flatnonzero(cells == ord("\n")) + 1
    starts = np.concatenate([[0], ends[:-1]])
    keyword = cells[starts].astype(np.uint16) << 8 | cells.take(starts + 1, mode="clip")
    bounds = np.concatenate([[0], np.flatnonzero(np.diff(keyword)) + 1, [len(ends)]])
    is_run = np.diff(bounds) >= fewest
    is_kept = np.concatenate([[True], is_run[1:] | is_run[:-1], [True]])
    cuts = np.unique(np.concatenate([bounds[is_kept], np.arange(0, len(ends), most)]))
    for first, end in pairwise(cuts.tolist()):
        yield content[starts[first] : ends[end - 1]], end - first


def decimal_rows(block: bytes, count: int) -> Floats | None:
    """Return the (count, n) numbers of ``count`` lines of a keyword and n decimals each; ``None`` if they are not."""
    shape = block.translate(None, DECIMALS)
    first = shape[: shape.index(b"\n") + 1]
    keyword, *words = first[:-1].split(b" ")
    if not words or any(words) or shape != first * count:
        return None
    numbers = block.translate(None, keyword).split()
    try:
        return np.fromiter(map(float, numbers), np.float64, len(numbers)).reshape(count, -1)
    except ValueError:
        return None


def corner_rows(block: bytes) -> tuple[Integers, Integers] | None:
    """Return the corners (n, 3) of ``f`` lines, where all name the same, and how many each line (L,) has.

    Numbers that a corner does not have are 0. ``None``: some words are no corners, or name something else.

    A word with one slash holds at most two numbers, one with two slashes three, or two if the slashes are side by
    side. So where there are as many numbers as that in all, each word has them.
    """
    shapes = block.translate(None, DIGITS).splitlines()
    words_of = {shape: shape.split(b" ")[1:] for shape in set(shapes)}
    words = {word for of_line in words_of.values() for word in of_line}
    columns = COLUMNS.get(words.pop()) if len(words) == 1 else None
    size_of = {shape: len(of_line) for shape, of_line in words_of.items()}
    sizes = np.fromiter(map(size_of.__getitem__, shapes), np.int64, len(shapes))
    if columns is None or sizes.min() < 3:
        return None
    count = int(sizes.sum())
    if block.count(b"//") == count:
        columns = [0, 2]
    try:
        named = np.fromstring(block.replace(b"/", b" ").translate(None, b"f"), np.int64, sep=" ")
    except ValueError:  # Something other than numbers; the line is named where lines are read one by one.
        return None
    if len(named) != count * len(columns) or named.max() == CLAMPED:
        return None
    corners = np.zeros((count, 3), np.int64)
    corners[:, columns] = named.reshape(count, -1)
    return corners, sizes


def single_spaced(block: bytes) -> bytes:
    """Return lines with one space between their words, and none behind the last."""
    if b"  " in block or b" \n" in block or b"\t" in block:
        return b"".join(b" ".join(line.split()) + b"\n" for line in block.splitlines())
    return block


# The lines of an OBJ file: what each says in numbers, and which one is wrong.


FEWEST_ALIKE = 16
"""Lines of one keyword side by side that are worth reading together."""

REPORT_LINES = 20000
"""Most lines between two reports of progress."""


@dataclass
class ObjLines:
    """The numbers of an OBJ file, as its lines give them."""

    positions: "array[float]" = field(default_factory=lambda: array("d"))
    colors: "array[float]" = field(default_factory=lambda: array("d"))
    uvs: "array[float]" = field(default_factory=lambda: array("d"))
    normals: "array[float]" = field(default_factory=lambda: array("d"))
    corners: "array[int]" = field(default_factory=lambda: array("q"))
    """Three a corner: numbers of position, texture coordinate and normal from 1, or 0 for none."""
    sizes: "array[int]" = field(default_factory=lambda: array("q"))
    """Corners of each face."""
    lines: "array[int]" = field(default_factory=lambda: array("q"))
    """Line of each face."""
    materials: list[tuple[int, str]] = field(default_factory=list)
    """First face and name of each ``usemtl``."""
    libraries: list[str] = field(default_factory=list)
    segments: "array[int]" = field(default_factory=lambda: array("q"))
    """Two a segment of ``l`` lines: numbers of positions from 1."""
    points: "array[int]" = field(default_factory=lambda: array("q"))
    """Numbers of positions of ``p`` lines, from 1."""

    def vertex(self, numbers: Sequence[float]) -> None:
        """Add a ``v`` line: x y z, x y z w, x y z r g b or x y z r g b a."""
        if len(numbers) not in (3, 4, 6, 7):
            raise ValueError(f"a vertex needs 3 numbers, got {len(numbers)}")
        if len(numbers) >= 6:
            self.whiten()
            self.colors.extend(numbers[3:6])
        self.positions.extend(numbers[:3])

    def whiten(self) -> None:
        """Give all vertices so far a colour."""
        self.colors.extend([1.0] * (len(self.positions) - len(self.colors)))

    def face(self, words: list[str], line: int) -> None:
        """Add an ``f`` line."""
        if len(words) < 3:
            raise ValueError(f"a face needs at least 3 corners, got {len(words)}")
        for word in words:
            self.corners.extend(self.corner(word))
        self.sizes.append(len(words))
        self.lines.append(line)

    def line(self, words: list[str]) -> None:
        """Add an ``l`` line: a strip of segments."""
        if len(words) < 2:
            raise ValueError(f"a line needs at least 2 vertices, got {len(words)}")
        numbers = [self.corner(word)[0] for word in words]
        for ends in pairwise(numbers):
            self.segments.extend(ends)

    def corner(self, word: str) -> list[int]:
        """Return the three numbers of ``v``, ``v/vt``, ``v//vn`` or ``v/vt/vn``; negative ones count back from here."""
        if word.isdecimal() and len(word) < 19:
            return [int(word), 0, 0]
        try:
            numbers = [int(number) if number else 0 for number in word.split("/")]
        except ValueError:
            numbers = []
        if not 1 <= len(numbers) <= 3 or max(numbers) >= 1 << 63:
            raise ValueError(f"{word} is not a corner of a face")
        if min(numbers) < 0:
            counts = (len(self.positions) // 3, len(self.uvs) // 2, len(self.normals) // 3)
            if any(number < -count for number, count in zip(numbers, counts, strict=False)):
                raise ValueError(f"corner {word} counts back beyond the first vertex")
            numbers = [n + count + 1 if n < 0 else n for n, count in zip(numbers, counts, strict=False)]
        return numbers + [0] * (3 - len(numbers))

    def add_alike(self, block: bytes, count: int, line: int) -> bool:
        """Add ``count`` lines from number ``line`` on, if they are alike and right; return whether they were added."""
        block = single_spaced(block)
        keyword = block[: max(block.find(b" "), 0)]
        if keyword == b"f":
            faces = corner_rows(block)
            if faces is not None:
                self.corners.frombytes(faces[0].tobytes())
                self.sizes.frombytes(faces[1].tobytes())
                self.lines.extend(range(line, line + count))
            return faces is not None
        rows = decimal_rows(block, count) if keyword in (b"v", b"vt", b"vn") else None
        if rows is None:
            return False
        width = rows.shape[1]
        if keyword == b"v" and width in (3, 4, 6, 7):
            if width >= 6:
                self.whiten()
                self.colors.frombytes(rows[:, 3:6].tobytes())
            self.positions.frombytes(rows[:, :3].tobytes())
        elif keyword == b"vt" and width >= 2:
            self.uvs.frombytes(rows[:, :2].tobytes())
        elif keyword == b"vn" and width == 3:
            self.normals.frombytes(rows.tobytes())
        else:
            return False
        return True


def read_lines(path: Path, report: reading.Report) -> ObjLines:
    """Read all lines of ``path``; a line that cannot be read raises MeshFileError with its number."""
    found = ObjLines()
    with open_input(path) as file:
        content = file.read().removeprefix(b"\xef\xbb\xbf")
    content = content.replace(b"\r\n", b"\n").replace(b"\r", b"\n") + b"\n"
    # A line that goes on in the next one is not read together with others.
    fewest = len(content) if b"\\\n" in content else FEWEST_ALIKE
    number, done, held = 0, 0, ""
    try:
        for block, count in runs_of_lines(content, fewest, REPORT_LINES):
            if count >= fewest and found.add_alike(block, count, number + 1):
                number += count
            else:
                for line in block.decode(errors="replace").split("\n")[:-1]:
                    number += 1
                    if line.endswith("\\"):
                        held += line[:-1] + " "
                    else:
                        read_line(found, held + line, number)
                        held = ""
            done += len(block)
            report(done / len(content), "reading lines")
        read_line(found, held, number)
    except ValueError as problem:
        raise reading.MeshFileError(f"{path.name}, line {number}: {problem}") from problem
    return found


def read_line(found: ObjLines, line: str, number: int) -> None:
    """Put what one line says into ``found``; keywords that draw nothing are passed over."""
    words = line.split()
    if not words:
        return
    keyword = words[0]
    if "#" in line and keyword in ("v", "vt", "vn", "f", "l", "p"):
        words = line.partition("#")[0].split()
    if keyword == "v":
        found.vertex(reading.numbers_of(words[1:]))
    elif keyword == "f":
        found.face(words[1:], number)
    elif keyword == "l":
        found.line(words[1:])
    elif keyword == "p":
        found.points.extend(found.corner(word)[0] for word in words[1:])
    elif keyword == "vt":
        if len(words) < 2:
            raise ValueError("a texture coordinate needs 1 number or more, got 0")
        found.uvs.extend([*reading.numbers_of(words[1:3]), 0.0][:2])
    elif keyword == "vn":
        if len(words) != 4:
            raise ValueError(f"a normal needs 3 numbers, got {len(words) - 1}")
        found.normals.extend(reading.numbers_of(words[1:]))
    elif keyword == "usemtl":
        found.materials.append((len(found.sizes), line.strip()[6:].strip()))
    elif keyword == "mtllib":
        found.libraries.append(line.strip()[6:].strip())


# OBJ, the Wavefront text format: polygons over positions, texture coordinates and normals numbered apart.


MEMORY_PER_BYTE = 16
"""Bytes of memory that a byte of an OBJ file takes at most while it is opened (measured)."""

KINDS = ("vertex", "texture coordinate", "normal")


def read_obj(path: Path, report: reading.Report, files: NamedFiles) -> reading.LoadedMeshes:
    """Read an OBJ file with its materials and textures.

    Each run of faces with one material is a mesh, so that triangles stay in the order of the file. Where the file names
    no material library and has texture coordinates, an image that stands beside it as ``<stem>_texture.png`` or
    ``<stem>.png`` (or ``.jpg``) is its texture. Vertex colours, ``v x y z r g b``, count as sRGB. Of a file without
    faces, ``l`` lines are segments, without those ``p`` lines are points, and without these all vertices are. Raises
    MeshFileError if a line cannot be read, a number names something that is not there, or there are no vertices;
    OSError if ``path`` cannot be read.
    """
    reading.check_memory(path, path.stat().st_size * MEMORY_PER_BYTE)
    reading.check_text(path, "OBJ")
    found = read_lines(path, report)
    report(None, "joining corners")
    if not found.positions:
        raise reading.MeshFileError(f"{path.name} has no vertices: it is empty or no OBJ file")
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


def read_wires(path: Path, found: ObjLines, points: Integers, segments: Integers) -> reading.LoadedMeshes:
    """Return the segments (K, 2) of a file without faces, or else its points (K,); both count from 1."""
    positions = np.array(found.positions).reshape(-1, 3)
    colors = None
    if found.colors:
        colors = vertex_colors(np.array(found.colors).reshape(-1, 3), np.arange(len(positions)), None)
    warnings = []
    if len(points) and len(segments):
        warnings.append(f"{counted(len(points), 'point')} beside the segments are left out")
    index = segments if len(segments) else points[:, None]
    return reading.load_wires(path, reading.Wires(positions, index - 1, colors), warnings)


def check_numbers(path: Path, found: ObjLines, numbers: Integers) -> None:
    """Raise MeshFileError for the first corner that names something that the file does not have."""
    counts = (len(found.positions) // 3, len(found.uvs) // 2, len(found.normals) // 3)
    wrong = (numbers > np.array(counts)) | (numbers < 0) | (numbers < np.array([1, 0, 0]))
    if wrong.any():
        corner, kind = (int(places[0]) for places in np.nonzero(wrong))
        line = found.lines[int(np.searchsorted(np.cumsum(found.sizes), corner, side="right"))]
        raise reading.MeshFileError(
            f"{path.name}, line {line}: a face names {KINDS[kind]} {numbers[corner, kind]}, "
            f"the file has {counts[kind]}, counted from 1"
        )


def build_meshes(
    path: Path, found: ObjLines, numbers: Integers, textures: TextureReader, report: reading.Report
) -> reading.LoadedMeshes:
    """Make the meshes of the runs of one material; ``numbers`` (n, 3) count from 0, -1 is none."""
    positions = np.array(found.positions).reshape(-1, 3)
    uvs, normals = np.array(found.uvs).reshape(-1, 2), np.array(found.normals).reshape(-1, 3)
    colors = np.array(found.colors).reshape(-1, 3)
    sizes = np.array(found.sizes, np.int64)
    parts = runs(found, len(sizes))
    reading.check_mesh_count(path, len(parts), "runs of faces with one material")
    reading.check_positions(path, positions, first=1)
    corners, faces = reading.triangulate_polygons(positions, numbers[:, 0], sizes, report)
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
        triangles, sources = reading.share_vertices(*(part[..., kind] for kind in used))
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
    return reading.LoadedMeshes(tuple(meshes), tuple(warnings))


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
