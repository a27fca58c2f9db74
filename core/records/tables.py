"""A table that fills as a stage is stepped: what the rows of a trace have found by one step, and nothing later."""

from dataclasses import dataclass

Place = tuple[int, int]
"""Row and column of a cell."""


@dataclass(frozen=True)
class TableColumn:
    """One column."""

    symbol: str
    """Its heading: the symbol of formulas and variables, which may have two lines."""
    meaning: str
    """One sentence for the tooltip."""
    vertex: int | None = None
    """0, 1 or 2 where the column belongs to that vertex."""


@dataclass(frozen=True)
class TableCell:
    """What stands in one cell."""

    text: str
    """As formulas write it."""
    full: str
    """With all digits, for copying."""
    position: int
    """Of the step that made it, in the trace of its stage."""


@dataclass(frozen=True)
class StepTable:
    """A table after one step."""

    title: str
    row_title: str
    """What the labels of the rows are, as ``Border``."""
    columns: tuple[TableColumn, ...]
    rows: tuple[str, ...]
    """Labels."""
    cells: tuple[tuple[TableCell | None, ...], ...]
    """One row of cells for each label; ``None``: not found by now, and empty."""
    made: frozenset[Place] = frozenset()
    """The cells that this step has made."""
    row: int = -1
    """The row of this step, -1: none."""
    note: str = ""
    """What the finished table decides, in one sentence; empty before."""

    def text(self) -> str:
        """Return the table as text: cells apart by tabs, numbers with all digits, then the note."""
        lines = ["\t".join([self.row_title, *(" ".join(column.symbol.split()) for column in self.columns)])]
        for label, cells in zip(self.rows, self.cells, strict=True):
            lines.append("\t".join([label, *("" if cell is None else cell.full for cell in cells)]))
        return "\n".join([self.title, *lines, *([self.note] if self.note else [])]) + "\n"
