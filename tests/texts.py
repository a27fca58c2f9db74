"""Tables of texts that are wrong, and what is said of them: a line a case."""

from pathlib import Path


def cases_of(file: str, name: str) -> list[tuple[str, ...]]:
    """Return the lines of a table beside a file of tests, cut at ``¦``; ``⏎`` stands for the end of a line."""
    lines = Path(file).with_name(name).read_text(encoding="utf-8").splitlines()
    return [tuple(cell.replace("⏎", "\n") for cell in line.split(" ¦ ")) for line in lines]
