"""Lines of an OBJ file that are alike but for their numbers, which are read together.

Most lines of a large file say the same as the line before with other numbers. Where that is certain for a whole run of
lines, one call reads all of them. Every other line is read by itself, by rules that name what is wrong with it.
"""

from collections.abc import Iterator
from itertools import pairwise

import numpy as np

from core.records.arrays import Floats, Integers

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
