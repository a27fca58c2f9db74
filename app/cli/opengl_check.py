"""``rasterscope opengl-check``: the core against the OpenGL of this machine, family by family, on random cases."""

import argparse
import sys
from collections.abc import Callable, Iterable

import numpy as np

from app.opengl_check.cases import OpenGLMissingError, OpenGLRenderer
from app.opengl_check.compare import BOUND, Comparison, compare
from app.opengl_check.families import FAMILIES, make_case
from app.opengl_check.shaders import SHADERS, check_shaders

# The command that compares the core with the OpenGL of this machine, family by family, on random cases.


LISTED = 5
"""Cases of a family that are listed one by one where they disagree."""
TITLES = ("cases", "pixels", "drawn", "differing", "px from edge", "depth error", "colour error")
WIDTHS = (6, 12, 12, 11, 14, 14, 14)


def run_opengl_check(
    families: Iterable[str] | None = None,
    count: int = 25,
    seed: int = 0,
    write: Callable[[str], object] = print,
) -> int:
    """Draw random cases with OpenGL and with the core, and write a table of how they compare.

    Parameters
    ----------
    families : iterable of str, optional
        Some of `app.opengl_check.families.FAMILIES`, or ``shaders``; all by default.
    count : int
        Cases of each family.
    seed : int
        Another seed makes other cases; the same seed the same ones.
    write : callable
        Takes the lines of the report.

    Returns
    -------
    int
        Exit code: 0 if all families agree, 1 if one does not or there is no OpenGL, 2 if there is no such family, or
        for a wrong number. What went wrong is one line on stderr.
    """
    chosen = [*FAMILIES, SHADERS] if families is None else list(families)
    try:
        if count < 1:
            raise ValueError(f"count must be at least 1, got {count}")
        if seed < 0:
            raise ValueError(f"seed must be at least 0, got {seed}")
        drawn = [family for family in chosen if family != SHADERS]
        for family in drawn:
            if family not in FAMILIES:
                raise ValueError(f"family must be one of {', '.join((*FAMILIES, SHADERS))}, got {family}")
            make_case(family, seed, 0)
        with OpenGLRenderer() as renderer:
            write(f"Core against {renderer.name}; seed {seed}")
            write(_row("family", TITLES))
            disagreeing = [
                family for family in drawn if not _check_family(renderer, family, count, seed, write)
            ]
            if SHADERS in chosen and not check_shaders(renderer, seed, write):
                disagreeing.append(SHADERS)
    except (OpenGLMissingError, ValueError) as error:
        print(f"rasterscope opengl-check: {error}", file=sys.stderr)
        return 1 if isinstance(error, OpenGLMissingError) else 2
    if disagreeing:
        write(f"Not the same: {', '.join(disagreeing)}.")
        return 1
    write(
        f"Pixels that differ lie within {BOUND:.4f} px (sqrt(2)/256) of an edge, in exact arithmetic; "
        "on the 1/256-pixel grid none differs."
    )
    write("All families agree within the tolerances.")
    return 0


def _check_family(
    renderer: OpenGLRenderer, family: str, count: int, seed: int, write: Callable[[str], object]
) -> bool:
    """Compare the cases of one family, write its line of the table, and return whether all agree."""
    results = []
    for number in range(count):
        case = make_case(family, seed, number)
        results.append(compare(case, renderer.draw(case)))
    disagreeing = [number for number, result in enumerate(results) if not result.agrees]
    sums = [
        f"{sum(numbers):,}"
        for numbers in zip(
            *((result.pixels, result.drawn, len(result.differing)) for result in results), strict=True
        )
    ]
    errors = [
        f"{max(numbers):.1e}"
        for numbers in zip(*((result.depth_error, result.color_error) for result in results), strict=True)
    ]
    distance = np.concatenate([result.distance for result in results])
    beside = f"{distance.max():.4f}" if len(distance) and np.isfinite(distance).all() else ""
    verdict = f"{len(disagreeing)} cases differ" if disagreeing else "agrees"
    write(f"{_row(family, (str(count), *sums, beside, *errors))}  {verdict}")
    for number in disagreeing[:LISTED]:
        write(f"    case {number}: {describe(results[number])}")
    return not disagreeing


def _row(family: str, cells: Iterable[str]) -> str:
    """Align the cells of one line of the table."""
    return f"{family:<14}" + "".join(f"{cell:>{width}}" for cell, width in zip(cells, WIDTHS, strict=True))


def describe(result: Comparison) -> str:
    """Say in one line what is not the same in a case."""
    parts = []
    if len(result.differing):
        column, row, ours, theirs = result.differing[0].tolist()
        parts.append(
            f"{len(result.differing)} pixels show another primitive, {result.unexplained} of them not beside an edge "
            f"({result.allowed} allowed), first column {column}, row {row}: {ours}, OpenGL {theirs}"
        )
    for name, error, excess in (
        ("depth", result.depth_error, result.depth_excess),
        ("colour", result.color_error, result.color_excess),
    ):
        if excess > 1:
            parts.append(f"{name} off by {error:.1e}, {excess:.1f} times what is tolerated")
    return "; ".join(parts) or "the same"


# ``rasterscope opengl-check``: the core against the OpenGL of this machine.


DESCRIPTION = """Draw random cases with OpenGL and with the core, and write a table of how they compare.
Needs the extra gpu: pip install moderngl."""
EXAMPLES = """examples:
  rasterscope opengl-check
  rasterscope opengl-check single shared --count 100 --seed 7

Exit code: 0 all families agree, 1 a family differs, or there is no OpenGL (stderr says why), 2 wrong usage.
"""


def add_arguments(parser: argparse.ArgumentParser) -> None:
    """Say what the command takes."""
    parser.add_argument("families", metavar="FAMILY", nargs="*", help="kinds of cases; default: all")
    parser.add_argument("--count", metavar="N", type=int, default=25, help="cases of each family (25)")
    parser.add_argument("--seed", metavar="N", type=int, default=0, help="seed of the random cases (0)")


def run(options: argparse.Namespace) -> int:
    """Compare; 0 if all families agree."""
    return run_opengl_check(options.families or None, options.count, options.seed)
