"""The sentence of every step: keys and numbers of a trace become plain words.

All words about steps stand here and in ``sentences_vertex``, ``sentences_edges``, ``sentences_raster``,
``sentences_numbers`` and ``sentences_pixel``, one small function for every key: another language is another set of
these modules.
"""

from collections.abc import Callable, Mapping

import numpy as np

from core.explain.number_text import counted, joined, spoken, vector_text
from core.explain.sentences import area_cuts as sentences_area_cuts
from core.explain.sentences import clip_order as sentences_clip_order
from core.explain.sentences import edges as sentences_edges
from core.explain.sentences import line_clipping as sentences_line_clipping
from core.explain.sentences import lines as sentences_lines
from core.explain.sentences import numbers as sentences_numbers
from core.explain.sentences import pixel as sentences_pixel
from core.explain.sentences import raster as sentences_raster
from core.explain.sentences import samples as sentences_samples
from core.explain.sentences import smooth_lines as sentences_smooth_lines
from core.explain.sentences import vertex as sentences_vertex
from core.explain.step_values import StepValues
from core.records.steps import Level
from core.trace import Explanation

SENTENCES: Mapping[str, Callable[[StepValues], str]] = {
    **sentences_vertex.SENTENCES,
    **sentences_clip_order.SENTENCES,
    **sentences_edges.SENTENCES,
    **sentences_raster.SENTENCES,
    **sentences_numbers.SENTENCES,
    **sentences_lines.SENTENCES,
    **sentences_line_clipping.SENTENCES,
    **sentences_pixel.SENTENCES,
    **sentences_smooth_lines.BLEND_SENTENCES,
    **sentences_area_cuts.SENTENCES,
    **sentences_samples.SENTENCES,
}
"""``stage.kind.operation`` to the maker of its sentence; all interpolated values share one, ``value``."""

INITIAL = {
    "transform": "Nothing is transformed yet: the corners stand where the scene puts them.",
    "cull": "No triangle has been tested yet.",
    "clip": "No triangle has been clipped yet.",
    "edges": "No corner has been snapped and no edge function set up yet.",
    "bin": "No box and no block has been looked at yet.",
    "raster": "No pixel has been looked at yet.",
    "interpolate": "No pixel has weights and values yet.",
    "shade": "No fragment has a colour yet.",
    "depth": "No fragment has been tested yet: the depth buffer is as it was before.",
    "blend": "No fragment has been written yet: the colour buffer is as it was before.",
    "resolve": "No pixel has display bytes yet.",
}
"""What is said before the first step."""

GROUPS = {
    "transform": "one corner",
    "cull": "one kind of test",
    "clip": "one plane",
    "edges": "one part of the set-up",
    "bin": "one block with its parts",
    "raster": "one row or block",
}
"""What a step of level GROUP is; from interpolation on it is one row of pixels."""


def sentence(explanation: Explanation, triangle: int, pixel: tuple[int, int] | None) -> str:
    """Say in one sentence what a step did and why.

    Parameters
    ----------
    explanation : Explanation
    triangle : int
        Number of the triangle that the step is about, -1 for none.
    pixel : (column, row), optional
        The pixel that it is about; by default the one that the explanation names.
    """
    step = StepValues(explanation, triangle, pixel)
    say = SENTENCES.get(step.key)
    return say(step) if say is not None else _plain_account(step)


def initial_sentence(stage: str) -> str:
    """Say how a stage stands before its first step."""
    return INITIAL[stage]


def summary_sentence(stage: str, level: Level, counts: Mapping[str, int], triangle: int | None) -> str:
    """Say what a step larger than one operation did.

    Parameters
    ----------
    stage : str
    level : Level
    counts : mapping
        ``rows`` and the marks among them, as ``StageTrace.summary`` counts them.
    triangle : int, optional
        The triangle that all rows are about; ``None`` or -1: several, or none.
    """
    known = {
        name: counts.get(name, 0) for name in ("rows", "covered", "rejected", "tie", "nan", "depth-failed")
    }
    account = ", ".join(_ACCOUNTS[stage](known))
    if known["nan"]:
        account += f", {known['nan']:,} undefined (NaN)"
    if level == Level.STAGE:
        who = "Whole stage"
    else:
        who = "All triangles" if triangle is None or triangle < 0 else f"Triangle {triangle}"
    if level == Level.GROUP:
        group = GROUPS.get(stage, "one row of pixels")
        who = group.capitalize() if who == "All triangles" else f"{who}, {group}"
    return f"{who}: {account}."


def _plain_account(step: StepValues) -> str:
    """Tell what an operation that has no sentence of its own has set."""
    found = []
    for name in step.explanation.changed:
        value = step.explanation.values.get(name)
        if isinstance(value, np.ndarray) and value.dtype.kind in "fiu":
            shown = vector_text([float(number) for number in value.ravel()])
        else:
            shown = spoken(value) if isinstance(value, float) else str(value)
        found.append(f"{name.replace('_', ' ')} is {shown}")
    done = f"{step.kind}, {step.operation}".replace("-", " ").capitalize()
    return f"{done}: {joined(found)}." if found else f"{done}."


def _transform(counts: Mapping[str, int]) -> list[str]:
    return [f"{counted(counts['rows'], 'position')} computed, each in one more space"]


def _cull(counts: Mapping[str, int]) -> list[str]:
    verdicts = [f"{counts['covered']:,} kept"] if counts["covered"] else []
    verdicts += [f"{counts['rejected']:,} dropped"] if counts["rejected"] else []
    return [f"{counted(counts['rows'], 'test')}", *(verdicts or ["nothing decided yet"])]


def _clip(counts: Mapping[str, int]) -> list[str]:
    outside = [f"{counts['rejected']:,} wholly outside"] if counts["rejected"] else []
    return [
        f"{counted(counts['rows'], 'edge or untouched triangle', 'edges or untouched triangles')}",
        *outside,
    ]


def _edges(counts: Mapping[str, int]) -> list[str]:
    flat = [f"{counted(counts['rejected'], 'triangle')} without area"] if counts["rejected"] else []
    return [f"{counted(counts['rows'], 'corner, area or edge', 'corners, areas and edges')} set up", *flat]


def _bin(counts: Mapping[str, int]) -> list[str]:
    blocks = [f"{counted(counts['covered'], 'block')} accepted", f"{counts['rejected']:,} rejected"]
    looked_at = f"{counted(counts['rows'], 'box or block', 'boxes and blocks')} looked at"
    return [looked_at, *(blocks if counts["covered"] + counts["rejected"] else [])]


def _raster(counts: Mapping[str, int]) -> list[str]:
    looked_at = counted(counts["covered"] + counts["rejected"], "pixel")
    ties = [f"{counts['tie']:,} on an edge"] if counts["tie"] else []
    return [f"{looked_at} looked at", f"{counts['covered']:,} covered", *ties]


def _interpolate(counts: Mapping[str, int]) -> list[str]:
    return [f"{counted(counts['rows'], 'pixel')} given weights and values"]


def _shade(counts: Mapping[str, int]) -> list[str]:
    return [f"{counted(counts['rows'], 'pixel')} coloured"]


def _depth(counts: Mapping[str, int]) -> list[str]:
    looked_at = f"{counted(counts['rows'], 'fragment')} looked at"
    return [looked_at, f"{counts['covered']:,} kept", f"{counts['depth-failed']:,} hidden or out of range"]


def _blend(counts: Mapping[str, int]) -> list[str]:
    return [f"{counted(counts['rows'], 'colour')} written"]


def _resolve(counts: Mapping[str, int]) -> list[str]:
    return [f"{counted(counts['rows'], 'pixel')} encoded for the display"]


_ACCOUNTS: Mapping[str, Callable[[Mapping[str, int]], list[str]]] = {
    "transform": _transform,
    "cull": _cull,
    "clip": _clip,
    "edges": _edges,
    "bin": _bin,
    "raster": _raster,
    "interpolate": _interpolate,
    "shade": _shade,
    "depth": _depth,
    "blend": _blend,
    "resolve": _resolve,
}
