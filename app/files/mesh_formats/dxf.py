"""DXF, the drawing exchange format of AutoCAD: lines, polylines, circles and arcs of a flat drawing, as segments."""

import re
from collections import Counter
from pathlib import Path

import numpy as np

from app.files.file_access import NamedFiles, open_text_input
from app.files.mesh_formats import reading

MEMORY_PER_BYTE = 400
"""Bytes of memory that a byte of a DXF file takes at most while it is opened: a circle has 80 segments (measured)."""

MEMORY_PER_LETTER = 16
"""Bytes for each letter of all lines, once they are as long as the longest: trimesh keeps two tables of them."""

DRAWN = {"LINE", "LWPOLYLINE", "POLYLINE", "CIRCLE", "ARC", "INSERT"}
"""Entities that are read."""

SILENT = {"VERTEX", "SEQEND", "BLOCK", "ENDBLK", "SECTION", "ENDSEC", "ATTDEF", "ATTRIB", "VIEWPORT"}
"""What belongs to these, or draws nothing."""


def read_dxf(path: Path, report: reading.Report, files: NamedFiles) -> reading.LoadedMeshes:
    """Read a DXF file of text: its lines, polylines, circles, arcs and inserted blocks are segments with z = 0.

    Other entities, such as splines and texts, and heights are left out with a warning. Raises MeshFileError if it is
    cut short, is no DXF file, or has nothing that is read; OSError if ``path`` cannot be read.
    """
    size = path.stat().st_size
    reading.check_memory(path, size * MEMORY_PER_BYTE)
    reading.check_text(path, "DXF")
    with open_text_input(path) as file:
        lines = [line.strip().upper() for line in file.read().strip().splitlines()]
    codes, values = lines[::2], lines[1::2]
    if (
        len(codes) > len(values)
        or "ENTITIES" not in values
        or "ENDSEC" not in values[values.index("ENTITIES") :]
    ):
        raise reading.MeshFileError(
            f"{path.name} is cut short or not a DXF file: its lines are not pairs with a whole section ENTITIES"
        )
    reading.check_memory(path, len(lines) * max(map(len, lines)) * MEMORY_PER_LETTER)
    reading.check_memory(
        path, size * (1 + values.count("INSERT")) * MEMORY_PER_BYTE if "BLOCKS" in values else 0
    )
    report(None, "reading lines, circles and arcs")
    with reading.translated_errors(path, "an entity does not have the numbers that it needs"):
        strips = [
            entity.discrete(np.asarray(drawing.vertices), scale=float(np.ptp(drawing.vertices)))
            for drawing in reading.load_with_trimesh(path).geometry.values()
            for entity in drawing.entities
            if type(entity).__name__ in ("Line", "Arc")
        ]
    if not strips:
        raise reading.MeshFileError(f"{path.name} has no lines, circles or arcs")
    positions = np.concatenate(strips)
    is_last = np.zeros(len(positions), np.bool_)
    is_last[np.cumsum([len(strip) for strip in strips]) - 1] = True
    first = np.flatnonzero(~is_last)
    wires = reading.Wires(
        np.column_stack([positions, np.zeros(len(positions))]), np.column_stack([first, first + 1])
    )
    return reading.load_wires(path, wires, left_out(codes, values))


def left_out(codes: list[str], values: list[str]) -> list[str]:
    """Return sentences for what the drawing has and what is not drawn, or not where it is."""
    entities = values.index("ENTITIES")
    begin = values.index("BLOCKS") if "BLOCKS" in values else entities
    others: Counter[str] = Counter()
    has_heights = is_turned = has_placed = False
    kind = ""
    for place in range(begin, values.index("ENDSEC", entities)):
        code, value = codes[place], values[place]
        if code == "0":
            kind = value
            others[kind] += kind not in DRAWN | SILENT
        has_heights |= code in ("30", "31", "38") and re.search("[1-9]", value) is not None
        is_turned |= code == "230" and not value.startswith("1")
        # trimesh passes over the base point of a block, the rows of an insertion, and insertions in blocks.
        has_placed |= kind == "INSERT" and (place < entities or (code in ("70", "71") and value > "1"))
        has_placed |= kind == "BLOCK" and code in ("10", "20") and re.search("[1-9]", value) is not None
    names = ", ".join(f"{count} {kind}" for kind, count in others.items() if count)
    said = {
        f"entities that are not read: {names}": bool(names),
        "heights (z) are left out: the drawing is flat": has_heights,
        "entities of another plane (extrusion) are drawn as if they lay in that of x and y": is_turned,
        "each block is drawn once, without its base point and the blocks inserted in it": has_placed,
    }
    return [sentence for sentence, is_said in said.items() if is_said]
