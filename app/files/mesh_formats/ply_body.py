"""The rows behind the header of a PLY file, where a row with lists has no fixed length."""

from collections.abc import Callable
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

from app.files.file_access import open_input
from app.files.mesh_formats.reading import MeshFileError, Report, numbers_of
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
        return block.view(np.dtype(self.order + kind))

    def counter(self, kind: str) -> Callable[[int], int]:
        """Return a function that reads the count of a list at a cell."""
        cells, width = self.cells, self.width(kind)
        if self.order == "ascii":
            # A count that is no whole number is none.
            return lambda place: int(count) if (count := float(cells[place])).is_integer() else -1
        raw = memoryview(cells)  # type: ignore[arg-type]
        if self.order == "<":
            return lambda place: int.from_bytes(raw[place : place + width], "little")
        return lambda place: int.from_bytes(raw[place : place + width], "big")


def read_body(
    path: Path, elements: tuple[Element, ...], encoding: str, start: int, report: Report
) -> dict[str, Rows]:
    """Read the rows of all ``elements`` behind byte ``start`` of ``path``.

    Raises MeshFileError if the file ends before its header says, or a text holds something other than numbers.
    """
    if encoding == "ascii":
        layout = Layout(read_numbers(path, start, report), encoding)
    else:
        report(None, "reading bytes")
        with open_input(path) as file:
            layout = Layout(np.fromfile(file, np.uint8, offset=start), encoding)
    rows: dict[str, Rows] = {}
    place = 0
    for element in elements:
        if not element.properties:
            continue  # Any number of rows takes no room.
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
    with open_input(path) as file:
        number = file.read(start).count(b"\n")
        while lines := file.readlines(2**20):
            try:
                pieces.append(np.array([float(word) for word in b" ".join(lines).split()]))
            except ValueError:
                for line in lines:
                    number += 1
                    try:
                        numbers_of(line.decode(errors="replace").split())
                    except ValueError as problem:
                        raise MeshFileError(f"{path.name}, line {number}: {problem}") from None
            number += len(lines)
            report(min(1.0, file.tell() / size), "reading numbers")
    return np.concatenate(pieces) if pieces else np.zeros(0)


def read_element(
    path: Path, element: Element, layout: Layout, start: int, report: Report
) -> tuple[Rows, int]:
    """Read the rows of ``element`` from cell ``start``; returns them and the cell behind them."""
    # Nearly always all rows are as long as the first.
    _, lengths, first_end = walk_rows(path, element, layout, start, min(element.count, 1), report)
    end = start + (first_end - start) * element.count
    values = None
    if end <= len(layout.cells):
        block = layout.cells[start:end].reshape(element.count, first_end - start)
        values = row_values(element, layout, block, lengths.ravel().tolist())
    if values is not None:
        lengths = np.repeat(lengths, element.count, axis=0)
    else:
        starts, lengths, end = walk_rows(path, element, layout, start, element.count, report)
        values = values_by_length(element, layout, starts, lengths)
    list_names = [p.name for p in element.properties if p.count_kind]
    lists = {name: Column(sizes, values.pop(name)) for name, sizes in zip(list_names, lengths.T, strict=True)}
    scales = {p.name: float(np.iinfo(p.kind).max) if p.kind[0] in "iu" else 1.0 for p in element.properties}
    return Rows(element.count, values, lists, scales), end


def walk_rows(
    path: Path, element: Element, layout: Layout, start: int, count: int, report: Report
) -> tuple[Integers, Integers, int]:
    """Return first cells (count,) of rows, lengths (count, lists) of their lists, and the cell behind the last."""
    steps = [
        (
            cells_before(p, layout),
            layout.width(p.kind),
            layout.counter(p.count_kind) if p.count_kind else None,
        )
        for p in element.properties
    ]
    total = len(layout.cells)
    places: list[int] = []
    lengths: list[int] = []
    place = start
    for row in range(count):
        if row % ROWS_PER_REPORT == 0 and count > 1:
            report(row / count, f"finding rows of {element.name}")
        places.append(place)
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
    list_count = sum(counter is not None for _, _, counter in steps)
    return np.array(places, np.int64), np.array(lengths, np.int64).reshape(count, list_count), place


def row_values(element: Element, layout: Layout, block: Cells, lengths: list[int]) -> dict[str, Cells] | None:
    """Return the values of each property in ``block`` (rows, cells), row after row, with lists of these ``lengths``.

    ``None`` if a list of some row has another length.
    """
    place, expected = 0, iter(lengths)
    values: dict[str, Cells] = {}
    for p in element.properties:
        length = 1
        if p.count_kind:
            length = next(expected, 0)
            counts = layout.values(block[:, place : place + cells_before(p, layout)], p.count_kind)
            if (counts != length).any():
                return None
            place += cells_before(p, layout)
        end = place + layout.width(p.kind) * length
        values[p.name] = layout.values(block[:, place:end], p.kind).reshape(-1)
        place = end
    return values


def values_by_length(
    element: Element, layout: Layout, starts: Integers, lengths: Integers
) -> dict[str, Cells]:
    """Return the values of each property in rows that begin at cells ``starts`` (n,), with ``lengths`` (n, lists)."""
    counts = dict.fromkeys((p.name for p in element.properties), np.ones(len(starts), np.int64))
    counts |= zip((p.name for p in element.properties if p.count_kind), lengths.T, strict=True)
    firsts = {name: np.cumsum(count) - count for name, count in counts.items()}
    columns = {
        p.name: np.zeros(int(counts[p.name].sum()), np.float64 if layout.order == "ascii" else p.kind)
        for p in element.properties
    }
    # Rows with lists of the same lengths have the same layout: read them together.
    shapes, which, sizes = np.unique(lengths, axis=0, return_inverse=True, return_counts=True)
    order = np.split(np.argsort(which.reshape(-1), kind="stable"), np.cumsum(sizes)[:-1])
    for chosen, shape in zip(order, shapes.tolist(), strict=True):
        left = iter(shape)
        width = sum(
            cells_before(p, layout) + layout.width(p.kind) * (next(left) if p.count_kind else 1)
            for p in element.properties
        )
        block = layout.cells[starts[chosen][:, None] + np.arange(width)]
        values = row_values(element, layout, block, shape)
        assert values is not None
        for name, part in values.items():
            places = firsts[name][chosen][:, None] + np.arange(len(part) // len(chosen))
            columns[name][places] = part.reshape(places.shape)
    return columns


def cells_before(p: Property, layout: Layout) -> int:
    """Cells of the count that stands before the values of a list."""
    return layout.width(p.count_kind) if p.count_kind else 0
