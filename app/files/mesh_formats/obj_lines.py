"""The lines of an OBJ file: what each says in numbers, and which one is wrong."""

from array import array
from collections.abc import Sequence
from dataclasses import dataclass, field
from itertools import pairwise
from pathlib import Path

from app.files.input_files import open_input
from app.files.mesh_formats.alike_lines import corner_rows, decimal_rows, runs_of_lines, single_spaced
from app.files.mesh_formats.reading import MeshFileError, Report, numbers_of

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


def read_lines(path: Path, report: Report) -> ObjLines:
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
        raise MeshFileError(f"{path.name}, line {number}: {problem}") from problem
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
        found.vertex(numbers_of(words[1:]))
    elif keyword == "f":
        found.face(words[1:], number)
    elif keyword == "l":
        found.line(words[1:])
    elif keyword == "p":
        found.points.extend(found.corner(word)[0] for word in words[1:])
    elif keyword == "vt":
        if len(words) < 2:
            raise ValueError("a texture coordinate needs 1 number or more, got 0")
        found.uvs.extend([*numbers_of(words[1:3]), 0.0][:2])
    elif keyword == "vn":
        if len(words) != 4:
            raise ValueError(f"a normal needs 3 numbers, got {len(words) - 1}")
        found.normals.extend(numbers_of(words[1:]))
    elif keyword == "usemtl":
        found.materials.append((len(found.sizes), line.strip()[6:].strip()))
    elif keyword == "mtllib":
        found.libraries.append(line.strip()[6:].strip())
