"""The rows behind the header of a PLY file, where a row with lists has no fixed length."""

from collections.abc import Callable
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

from app.files.mesh_formats.reading import MeshFileError, Report
from core.records.arrays import Integers

Cells = NDArray[Any]
"""The body as one row: bytes (uint8), or the numbers of a text (float64)."""

ROWS_PER_REPORT = 50000


@dataclass(frozen=True)
class Property:
    """One value of a row, or a list of values after their count."""

    name: str
    kind: str
    """NumPy's name of the type without byte order, as ``f4``."""
    count_kind: str = ""
    """Type of the count of a list; empty for a single value."""


@dataclass(frozen=True)
class Element:
    """A table of the file."""

    name: str
    count: int
    properties: tuple[Property, ...]


@dataclass(frozen=True, eq=False)
class Column:
    """Lists of a property, one behind the other."""

    sizes: Integers
    """(rows,) int64."""
    items: Cells
    """(sum of sizes,)."""


@dataclass(frozen=True, eq=False)
class Rows:
    """The rows of one element, by property."""

    count: int
    columns: dict[str, Cells]
    """(count,) each."""
    lists: dict[str, Column]
    scales: dict[str, float] = field(default_factory=dict)
    """What stands for 1 in each column: the largest integer of its type, or 1.0 for floats."""


@dataclass(frozen=True, eq=False)
class Layout:
    """How values lie in the cells: by bytes of a byte order, or one number a cell for text."""

    cells: Cells
    order: str
    """``<``, ``>`` or ``ascii``."""

    def width(self, kind: str) -> int:
        """Cells that one value takes."""
        return 1 if self.order == "ascii" else np.dtype(kind).itemsize

    def values(self, block: Cells, kind: str) -> Cells:
        """Return the values in ``block`` (rows, cells)."""
        if self.order == "ascii":
            return block
        return np.ascontiguousarray(block).view(np.dtype(self.order + kind))

    def counter(self, kind: str) -> Callable[[int], int]:
        """Return a function that reads the count of a list at a cell."""
        cells, width = self.cells, self.width(kind)
        if self.order == "ascii":
            return lambda place: int(cells[place])
        raw = memoryview(cells)  # type: ignore[arg-type]
        if self.order == "<":
            return lambda place: int.from_bytes(raw[place : place + width], "little")
        return lambda place: int.from_bytes(raw[place : place + width], "big")


def read_body(
    path: Path, elements: tuple[Element, ...], encoding: str, start: int, report: Report
) -> dict[str, Rows]:
    """Read the rows of all ``elements`` behind byte ``start`` of ``path``.

    Raises
    ------
    MeshFileError
        If the file ends before its header says, or a text holds something other than numbers.
    """
    if encoding == "ascii":
        layout = Layout(read_numbers(path, start, report), encoding)
    else:
        report(None, "reading bytes")
        layout = Layout(np.fromfile(path, np.uint8, offset=start), encoding)
    rows: dict[str, Rows] = {}
    place = 0
    for element in elements:
        # A header may claim any count: rows that cannot be there are refused before room is made for them.
        least = sum(layout.width(p.count_kind or p.kind) for p in element.properties)
        if element.count < 0 or place + element.count * least > len(layout.cells):
            raise MeshFileError(
                f"{path.name} is cut short: it has no room for its {element.count} x {element.name}"
            )
        rows[element.name], place = read_element(path, element, layout, place, report)
    return rows


def read_numbers(path: Path, start: int, report: Report) -> Cells:
    """Return all numbers of the text behind byte ``start``, float64."""
    pieces = []
    size = path.stat().st_size
    with path.open("rb") as file:
        file.seek(start)
        while lines := file.readlines(2**20):
            try:
                pieces.append(np.array([float(word) for word in b" ".join(lines).split()]))
            except ValueError as problem:
                raise MeshFileError(
                    f"{path.name} has something other than numbers in its rows: {problem}"
                ) from problem
            report(min(1.0, file.tell() / size), "reading numbers")
    return np.concatenate(pieces) if pieces else np.zeros(0)


def read_element(
    path: Path, element: Element, layout: Layout, start: int, report: Report
) -> tuple[Rows, int]:
    """Read the rows of ``element`` from cell ``start``; returns them and the cell behind them."""
    starts, lengths, end = find_rows(path, element, layout, start, report)
    names = [p.name for p in element.properties if p.count_kind]
    sizes = dict(zip(names, lengths.T, strict=True))
    firsts = {name: np.cumsum(size) - size for name, size in sizes.items()}
    columns: dict[str, Cells] = {}
    for p in element.properties:
        count = int(sizes[p.name].sum()) if p.count_kind else element.count
        columns[p.name] = np.zeros(count, np.float64 if layout.order == "ascii" else p.kind)

    # Rows with lists of the same lengths have the same layout: read them together.
    shapes, which = np.unique(lengths, axis=0, return_inverse=True)
    for number, shape in enumerate(shapes.tolist()):
        chosen = np.nonzero(which.reshape(-1) == number)[0]
        length_of = dict(zip(names, shape, strict=True))
        width = sum(
            cells_before(p, layout) + layout.width(p.kind) * length_of.get(p.name, 1)
            for p in element.properties
        )
        if len(shapes) == 1:
            block = layout.cells[start:end].reshape(element.count, width)
        else:
            block = layout.cells[starts[chosen][:, None] + np.arange(width)]
        place = 0
        for p in element.properties:
            place += cells_before(p, layout)
            length = length_of.get(p.name, 1)
            values = layout.values(block[:, place : place + layout.width(p.kind) * length], p.kind)
            place += layout.width(p.kind) * length
            if p.count_kind:
                columns[p.name][firsts[p.name][chosen][:, None] + np.arange(length)] = values
            else:
                columns[p.name][chosen] = values[:, 0]
    scales = {p.name: float(np.iinfo(p.kind).max) if p.kind[0] in "iu" else 1.0 for p in element.properties}
    lists = {name: Column(sizes[name], columns.pop(name)) for name in names}
    return Rows(element.count, columns, lists, scales), end


def cells_before(p: Property, layout: Layout) -> int:
    """Cells of the count that stands before the values of a list."""
    return layout.width(p.count_kind) if p.count_kind else 0


def find_rows(
    path: Path, element: Element, layout: Layout, start: int, report: Report
) -> tuple[Integers, Integers, int]:
    """Return first cells (n,) of the rows, lengths (n, lists) of their lists, and the cell behind all."""
    counts = [p for p in element.properties if p.count_kind]
    steps = [
        (
            cells_before(p, layout),
            layout.width(p.kind),
            layout.counter(p.count_kind) if p.count_kind else None,
        )
        for p in element.properties
    ]
    total = len(layout.cells)

    def row_end(place: int, lengths: list[int]) -> int:
        for count_width, width, counter in steps:
            length = 1
            if counter is not None:
                length = counter(place) if place + count_width <= total else total
                lengths.append(length)
            if length < 0:
                raise MeshFileError(f"{path.name}: a list of {element.name} has length {length}")
            place += count_width + width * length
        if place > total:
            raise MeshFileError(
                f"{path.name} is cut short: it ends within its {element.count} x {element.name}"
            )
        return place

    if not element.count:
        return np.zeros(0, np.int64), np.zeros((0, len(counts)), np.int64), start

    # Nearly always all rows are as long as the first.
    first: list[int] = []
    stride = row_end(start, first) - start
    end = start + stride * element.count
    if end <= total:
        block = layout.cells[start:end].reshape(element.count, stride)
        if has_equal_counts(element, layout, block, first):
            lengths = np.tile(np.array(first, np.int64).reshape(1, -1), (element.count, 1))
            return start + stride * np.arange(element.count), lengths, end

    # Lists of several lengths: only a walk finds where the rows begin.
    places: list[int] = []
    walked: list[int] = []
    place = start
    for row in range(element.count):
        if row % ROWS_PER_REPORT == 0:
            report(row / element.count, f"finding rows of {element.name}")
        places.append(place)
        place = row_end(place, walked)
    return np.array(places), np.array(walked, np.int64).reshape(element.count, len(counts)), place


def has_equal_counts(element: Element, layout: Layout, block: Cells, first: list[int]) -> bool:
    """Whether all rows of ``block`` (rows, cells) have the list lengths of the ``first`` row."""
    place, lengths = 0, iter(first)
    for p in element.properties:
        length = 1
        if p.count_kind:
            length = next(lengths)
            counts = layout.values(block[:, place : place + cells_before(p, layout)], p.count_kind)
            if (counts != length).any():
                return False
        place += cells_before(p, layout) + layout.width(p.kind) * length
    return True
