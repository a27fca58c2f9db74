"""One pixel in every number format, in words: the rows of the table, and the sentence above it."""

from core.explain.number_text import number_text
from core.records.words import numbered
from core.study.stability.coverage.dial_pixel import FormatAtPixel, PixelInFormats
from core.study.stability.coverage.precision_dial import DialReading
from widgets.atlas.format_probe import DialRow


def dial_sentence(found: PixelInFormats, run: str) -> str:
    """Return which pixel and which triangles the table is about, and what the run itself makes of them.

    Parameters
    ----------
    run : str
        The method of the run, ``coverage=float32``.
    """
    column, row = found.pixel
    triangles = numbered("triangle", found.triangles)
    if found.is_touched:
        more = f" and {found.left_out:,} more" if found.left_out else ""
        who = f"{triangles}{more}"
    else:
        who = f"not covered in any format, nearest {triangles}"
    if found.run_count is None:
        said = f"{run} does not take the scene"
    else:
        said = f"{times(found.run_count)} by {run}{_fault(found.run_count, found.run_wanted)}"
    rule = "" if found.fill_rule == "shared-edge" else ", and all formats with this rule"
    return f"Pixel ({column}, {row}), {who}: expected {times(found.run_wanted)}, {said}{rule}."


def dial_rows(found: PixelInFormats) -> tuple[DialRow, ...]:
    """Return one row for every format and triangle; the format's own figures stand in its first row."""
    rows: list[DialRow] = []
    for each in found.formats:
        for index, triangle in enumerate(found.triangles):
            own = (each.coverage, drawn_words(each.count, each.wanted), picture_words(each))
            is_count_right = each.count == each.wanted
            decision, is_right = _decision(each.readings[index], each.is_drawn[index], found.is_culled[index])
            cells = (*(own if index == 0 else ("",) * len(own)), str(triangle), *decision)
            rows.append(DialRow(cells, is_right, is_count_right if index == 0 else None))
    return tuple(rows)


def _decision(reading: DialReading, is_drawn: bool, is_culled: bool) -> tuple[tuple[str, ...], bool]:
    """Return what is said of one triangle, and whether it is right; pieces have no edge function to be shown."""
    should_cover = reading.is_covered == reading.is_right
    is_right = is_drawn == should_cover
    said = ("covers" if is_drawn else "outside") + ("" if is_right else ": wrong")
    if is_drawn != reading.is_covered:
        return (
            said,
            "",
            "",
            number_text(reading.exact_value),
            "culled" if is_culled else "clipped first: its pieces decide",
            "",
        ), is_right
    numbers = (str(reading.edge), number_text(reading.values[reading.edge]), number_text(reading.exact_value))
    return (said, *numbers, reading.flipped_by, reading.bits), is_right


def times(count: int) -> str:
    """Return how often in words: ``0 times``, ``once``, ``twice``, ``3 times``."""
    return {1: "once", 2: "twice"}.get(count, f"{count:,} times")


def drawn_words(count: int, wanted: int) -> str:
    """Return how often a pixel is covered, and what is wrong with that."""
    return f"{times(count)}{_fault(count, wanted)}"


def _fault(count: int, wanted: int) -> str:
    """Return what is wrong with a count in brackets, empty where it is right."""
    return "" if count == wanted else " (hole)" if count < wanted else " (too often)"


def picture_words(each: FormatAtPixel) -> str:
    """Return what a format makes of the whole picture."""
    if each.wrong_count is None:
        return "too large"
    if each.first_wrong is None:
        return "right"
    column, row = each.first_wrong
    return f"{each.wrong_count:,} wrong, first ({column}, {row})"
