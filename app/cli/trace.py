"""``rasterscope trace``: what one stage did, row by row."""

import argparse
import re
import sys
from collections.abc import Iterable
from contextlib import ExitStack
from dataclasses import replace
from time import monotonic

import numpy as np

from app.cli import arguments
from app.cli.commands import whole_number
from app.cli.render import add_shaders, with_shaders
from app.cli.trace_tables import arrays, table_parts
from app.files.file_access import check_writable, whole_file
from app.files.open_any import Opened
from app.session.document import MOST_TRIANGLES, Document, focus_on
from app.session.memory import check_free
from app.usage import PROGRAM, UsageError
from core import STAGES, Trace, trace
from core.coverage.binning import bound
from core.coverage.pixel_runs import fill_traits
from core.scene import Scene

DESCRIPTION = """Write the trace of one stage: a row for each step, with every number involved."""
EXAMPLES = """text  for reading: rows with the sentence and the formula of every operation, in symbols and in numbers
json  rows with kind, triangle, pixel, all numbers, and for every operation its key, its sentence, its formula
      (LaTeX) and the line of the algorithm's listing; no value (NaN) is null
csv   rows with all numbers; no value is an empty cell
npz   each column as an array, row_kind, row_triangle, row_pixel, marks, and the buffers after the last row

Without --size and --region these are the pixels that the window shows: those of the state file, all of a
small scene, else those around the triangle. Row 0 is the bottom row.

examples:
  rasterscope trace shared-edge --triangle 1 --stage raster --format csv
  rasterscope trace teapot.obj --triangle 2000 --stage depth --format json -o depth.json
  rasterscope trace cube --triangle 3 --stage raster --size 24x16 --set fill=blocks --format npz -o fill.npz
"""

TRIANGLE_BYTES, TEST_BYTES = 5_000, 700
"""Bytes that a triangle, and a pixel test, takes in the trace of one stage (measured)."""
SPOKEN = ("text", "json")
"""Formats with a sentence and a formula for every operation."""
MANY_ROWS = 200_000
"""Rows from which it is said how long these take."""
ROWS_A_MINUTE = 50_000
PAUSE = 0.2
"""Seconds between two reports of progress."""
LONGEST_TRACE = 5_000_000
"""Pixel tests that a trace may have: each keeps all its numbers."""


def region_from_text(text: str) -> tuple[int, int, int, int]:
    """Return the region of a text such as ``10,20,64,48``."""
    found = re.fullmatch(r"(\d{1,9}),(\d{1,9}),(\d{1,9}),(\d{1,9})", text)
    if not found:
        raise argparse.ArgumentTypeError(f"must be COLUMN,ROW,COLUMNS,ROWS such as 10,20,64,48, got {text}")
    column, row, columns, rows = (int(number) for number in found.groups())
    return column, row, columns, rows


def add_arguments(parser: argparse.ArgumentParser) -> None:
    """Say what the command takes."""
    arguments.add_file(parser)
    parser.add_argument(
        "--triangle", metavar="N", type=whole_number(0), help="number in the scene, from 0; default: all"
    )
    parser.add_argument("--stage", metavar="NAME", choices=STAGES, required=True, help=", ".join(STAGES))
    parser.add_argument(
        "--format", choices=("json", "text", "csv", "npz"), default="json", help="default: json"
    )
    parser.add_argument("-o", "--output", metavar="PATH", help="file; default: standard output (not npz)")
    parser.add_argument(
        "--size",
        metavar="WxH",
        type=arguments.size_from_text,
        help="trace the whole view at this size, same camera",
    )
    parser.add_argument(
        "--region",
        metavar="C,R,COLUMNS,ROWS",
        type=region_from_text,
        help="trace these pixels only: column and row of the lower left one, columns, rows",
    )
    parser.add_argument(
        "--before",
        choices=("earlier", "cleared"),
        help="buffers at the start: as earlier triangles left them, or cleared",
    )
    parser.add_argument(
        "--lanes",
        choices=("one", "together"),
        help="order of a shader's steps: one vertex or fragment after another, or those of a triangle together",
    )
    arguments.add_settings(parser)
    arguments.add_edits(parser)
    add_shaders(parser)


def run(options: argparse.Namespace) -> int:
    """Trace and write."""
    if options.format == "npz" and options.output is None:
        raise UsageError("argument --format: npz needs a file, -o PATH")
    if options.output is not None:
        check_writable(options.output)
    opened = arguments.open_file(options)
    with arguments.overflow_reported():
        traced = make_trace(opened, options)
        check_count(traced)
        if STAGES.index(options.stage) >= STAGES.index("raster"):
            check_length(traced, options)
        stage = traced.stage(options.stage)
    if options.format == "npz":
        with whole_file(options.output) as file:
            np.savez(file, **arrays(stage))  # type: ignore[arg-type]
        return 0
    if options.format in SPOKEN and stage.steps.row_count > MANY_ROWS:
        print(
            f"{PROGRAM}: {stage.steps.row_count:,} rows with sentences and formulas take about a minute for each "
            f"{ROWS_A_MINUTE:,}; csv and npz take seconds",
            file=sys.stderr,
        )
    write_parts(
        table_parts(stage, header_of(traced, opened.document), options.format),
        stage.steps.row_count,
        options.output,
    )
    return 0


def make_trace(opened: Opened, options: argparse.Namespace) -> Trace:
    """Prepare the trace that the options ask for."""
    document = replace(opened.document, scene=with_shaders(opened.document.scene, options))
    triangle = document.triangle if options.triangle is None else options.triangle
    if options.triangle is None and opened.state is None:
        triangle = None
    if triangle is not None and triangle >= document.triangle_count:
        raise UsageError(
            f"argument --triangle: must be 0 to {document.triangle_count - 1} in {options.file}, got {triangle}"
        )
    settings = arguments.chosen_settings(document.settings, options.set, options.edit)
    before, lanes = options.before or document.before, options.lanes or document.lanes
    if options.size is not None or options.region is not None:
        scene = arguments.sized(document.scene, options)
        check_region(options.region, scene.size)
        return trace(scene, settings, triangle, options.region, before, lanes=lanes)
    document = replace(document, settings=settings, before=before, lanes=lanes)
    if opened.state is None:
        document = focus_on(document, triangle)
    return replace(document, triangle=triangle).make_trace()


def check_region(region: tuple[int, int, int, int] | None, size: tuple[int, int]) -> None:
    """Raise UsageError for a region without pixels of the picture."""
    if region is not None:
        column, row, columns, rows = region
        if not (column < size[0] and row < size[1] and columns and rows):
            raise UsageError(
                f"argument --region: must contain pixels of the {size[0]}x{size[1]} picture, got {region}"
            )


def check_count(traced: Trace) -> None:
    """Raise ValueError for a trace of more vertices or triangles than can be kept."""
    source = traced.source
    if source.triangle is not None or not isinstance(source.scene, Scene):
        return
    count = max(
        sum(len(m.positions) for m in source.scene.meshes), sum(len(m.triangles) for m in source.scene.meshes)
    )
    if count > MOST_TRIANGLES:
        raise ValueError(
            f"the trace would have {count:,} triangles or vertices, and at most {MOST_TRIANGLES:,} fit: "
            "choose one --triangle"
        )
    check_free(count * TRIANGLE_BYTES, f"a trace of {count:,} triangles or vertices")


def check_length(traced: Trace, options: argparse.Namespace) -> None:
    """Raise ValueError for a trace that tests more pixels than can be kept."""
    source = traced.source
    if source.geometry.outlines is not None:
        return
    boxes = bound(source.geometry.edges, source.raster)
    tests = int(((boxes.column_end - boxes.column) * (boxes.row_end - boxes.row)).sum())
    if fill_traits(source.settings.fill).looks_everywhere:
        tests = len(source.geometry.edges) * source.raster.shape[0] * source.raster.shape[1]
    if tests > LONGEST_TRACE:
        ways = ["one --triangle"] * (source.triangle is None and len(source.geometry.edges) > 1)
        ways.append("a smaller --region" if options.region is not None else "a smaller --size, or a --region")
        if fill_traits(source.settings.fill).looks_everywhere:
            ways.append(f"another fill than {source.settings.fill}")
        raise ValueError(
            f"the trace would have {tests:,} pixel tests, and at most {LONGEST_TRACE:,} fit: "
            f"choose {', or '.join(ways)}"
        )
    check_free(tests * TEST_BYTES, f"a trace of {tests:,} pixel tests")


def header_of(traced: Trace, document: Document) -> dict[str, object]:
    """Return what was traced, in values that JSON has."""
    source = traced.source
    return {
        "program": "rasterscope",
        "scene": document.title,
        "size": list(source.scene.size),
        "region": list(source.region) if source.region is not None else None,
        "triangle": source.triangle,
        "before": source.before,
        "settings": {name: getattr(source.settings, name) for name in source.settings.__dataclass_fields__},
    }


def write_parts(parts: Iterable[tuple[int, str]], row_count: int, path: str | None) -> None:
    """Write pieces of text, each with the rows done, into a file or on the standard output, and show progress."""
    is_seen = path is None and sys.stdout is not None and sys.stdout.isatty()
    with ExitStack() as stack:
        report = None if is_seen else stack.enter_context(arguments.progress_line())
        file = None if path is None else stack.enter_context(whole_file(path))
        reported = monotonic()
        for rows, text in parts:
            if file is None:
                sys.stdout.write(text)
            else:
                file.write(text.encode())
            if report is not None and monotonic() - reported > PAUSE:
                reported = monotonic()
                report(rows / row_count, f"Writing row {rows:,} of {row_count:,}")
