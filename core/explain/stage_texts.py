"""Texts of every stage and method: titles, cards, summaries, where a method is exact and where it breaks."""

from collections.abc import Callable, Mapping
from dataclasses import dataclass, replace
from typing import NamedTuple

from core.coverage.pixel_runs import fill_traits
from core.explain.records import StageCard
from core.methods import table
from core.records.steps import Level, RowOrder
from core.records.words import TRIANGLES, Nouns, counted, nouns
from core.settings import FIELDS
from core.stages.declared import STAGES, Stage, stage_of
from core.trace.stage_trace import MARKS, PRESENTED

Account = Callable[[Mapping[str, int], Nouns], list[str]]
"""Makes of the counts of rows and marks what a larger step did, in a few parts; takes what is drawn, too."""


def _cull_account(counts: Mapping[str, int], drawn: Nouns) -> list[str]:
    verdicts = [f"{counts['covered']:,} kept"] if counts["covered"] else []
    verdicts += [f"{counts['rejected']:,} dropped"] if counts["rejected"] else []
    boxes, tests = counts["boxes"], counts["rows"] - counts["boxes"]
    asked = [counted(boxes, "step on a box", "steps on boxes")] if boxes else []
    if boxes and not tests:
        return asked
    return [*asked, counted(tests, "test"), *(verdicts or ["nothing decided yet"])]


def _clip_account(counts: Mapping[str, int], drawn: Nouns) -> list[str]:
    outside = [f"{counts['rejected']:,} wholly outside"] if counts["rejected"] else []
    if drawn.edge == drawn.one:
        return [counted(counts["rows"], drawn.one, drawn.many), *outside]
    one, many = f"edge or untouched {drawn.one}", f"edges or untouched {drawn.many}"
    return [counted(counts["rows"], one, many), *outside]


def _edges_account(counts: Mapping[str, int], drawn: Nouns) -> list[str]:
    flat = (
        [f"{counted(counts['rejected'], drawn.one, drawn.many)} without area"] if counts["rejected"] else []
    )
    return [f"{counted(counts['rows'], 'corner, area or edge', 'corners, areas and edges')} set up", *flat]


def _bin_account(counts: Mapping[str, int], drawn: Nouns) -> list[str]:
    blocks = [f"{counted(counts['covered'], 'block')} accepted", f"{counts['rejected']:,} rejected"]
    tested = f"{counted(counts['rows'], 'box or block', 'boxes and blocks')} tested"
    return [tested, *(blocks if counts["covered"] + counts["rejected"] else [])]


def _place(counts: Mapping[str, int]) -> str:
    """Return what is covered or not: a pixel, or a sample of one."""
    return "sample" if counts["samples"] else "pixel"


def _raster_account(counts: Mapping[str, int], drawn: Nouns) -> list[str]:
    ties = [f"{counts['tie']:,} on an edge"] if counts["tie"] else []
    place = _place(counts)
    if not counts["tested"]:
        return [f"{counted(counts['covered'], place)} covered", *ties]
    untested = counts["covered"] + counts["rejected"] - counts["tested"]
    accepted = [f"{untested:,} accepted without a test"] if untested else []
    return [f"{counted(counts['tested'], place)} tested", *accepted, f"{counts['covered']:,} covered", *ties]


def _line_account(counts: Mapping[str, int], drawn: Nouns) -> list[str]:
    ties = [f"{counts['tie']:,} at a tie"] if counts["tie"] else []
    return [f"{counted(counts['covered'], _place(counts))} drawn", *ties]


def _shade_account(counts: Mapping[str, int], drawn: Nouns) -> list[str]:
    skipped = counts["depth-failed"]
    hidden = [f"{skipped:,} hidden already and not shaded"] if skipped else []
    return [f"{counted(counts['rows'] - skipped, _place(counts))} coloured", *hidden]


def _depth_account(counts: Mapping[str, int], drawn: Nouns) -> list[str]:
    fragments = counts["covered"] + counts["depth-failed"]
    tested = [f"{counted(fragments, 'fragment')} tested"]
    if counts["rejected"]:
        # What rays ask and miss is no fragment.
        tested = [counted(fragments + counts["rejected"], "test"), f"{counts['rejected']:,} missed"]
    return [*tested, f"{counts['covered']:,} kept", f"{counts['depth-failed']:,} hidden or out of range"]


def _account_of_order(counts: Mapping[str, int], order: RowOrder) -> list[str]:
    return [
        f"{counted(counts[name], _place(counts) if noun == 'place' else noun)} {done}".rstrip()
        for name, noun, done in order.sums
        if done or counts[name]
    ]


def _resolve_account(counts: Mapping[str, int], drawn: Nouns) -> list[str]:
    pixels = counts["rows"] - sum(counts[name] for name in PRESENTED)
    encoded = [f"{counted(pixels, 'pixel')} encoded for the display"]
    done = {
        "written": ("row written into a buffer", "rows written into buffers"),
        "flushed": ("picture flushed", "pictures flushed"),
        "wait": ("wait for a refresh to end", "waits for a refresh to end"),
        "swap": ("swap", "swaps"),
        "scan": ("row read by the screen", "rows read by the screen"),
    }
    parts = [counted(counts[name], *done[name]) for name in PRESENTED if counts[name]]
    return [*(encoded if pixels or not parts else []), *parts]


def _rows_account(noun: str, done: str) -> Account:
    """Return the account of a stage that does one thing to every row."""
    return lambda counts, _: [
        f"{counted(counts['rows'], _place(counts) if noun == 'pixel' else noun)} {done}"
    ]


LINE_CARD = {
    "title": "Raster: which pixels a line has",
    "gets": "The ends of every line in the window.",
    "gives": "The pixels of every line, in order from its first end.",
    "purpose": "Draws a line as the pixels nearest to it, one in each column or row.",
}
"""The card of the rasterization of lines."""
CARDS: Mapping[tuple[str, str], Mapping[str, str]] = {
    ("cull", "segment"): {"purpose": "Saves all work on segments behind the eye and outside the view."},
    ("cull", "point"): {"purpose": "Saves all work on points behind the eye and outside the view."},
    ("clip", "segment"): {"gives": "Segments wholly inside: of a cut one the part inside."},
    ("clip", "point"): {"gives": "Points wholly inside."},
    ("clip", "polygon"): {
        "title": "Clip: cut polygons at the clip window",
        "gets": "Polygons and the clip window, in pixels.",
        "gives": "The rings of what is left of every polygon.",
        "purpose": "Leaves the part of every polygon that lies in the clip window.",
    },
    ("raster", "point"): {
        "title": "Raster: which pixel contains a point",
        "gets": "The place of every point in the window.",
        "gives": "The pixel of every point.",
        "purpose": "Draws a point as the pixel that contains it.",
    },
    ("raster", "polygon"): {
        "gets": "The rings of every polygon in the window.",
        "purpose": "Counts the edges to the left of the pixel's centre.",
    },
    ("interpolate", "segment"): {
        "gives": "Weights at every pixel, and the weighted sum of the ends' values.",
        "purpose": "Extends the values of both ends over the segment, in correct perspective.",
    },
    ("interpolate", "point"): {
        "gives": "The values of its point at every pixel.",
        "purpose": "Gives each pixel the values of its point.",
    },
    ("interpolate", "polygon"): {
        "gives": "The colour of every pixel.",
        "purpose": "Gives every pixel the colour of corner 0.",
    },
}
"""Texts of cards by stage and what is drawn, where those of triangles say something else."""
BEFORE_TABLES = "A table of depths has no triangles: it begins at the depth test."
"""Why fragments that are given skip a stage."""
ACCOUNTS: Mapping[str, Account] = {
    "transform": _rows_account("position", "transformed to the next space"),
    "cull": _cull_account,
    "clip": _clip_account,
    "edges": _edges_account,
    "bin": _bin_account,
    "raster": _raster_account,
    "interpolate": _rows_account("pixel", "given weights and values"),
    "shade": _shade_account,
    "depth": _depth_account,
    "blend": _rows_account("colour", "written"),
    "resolve": _resolve_account,
}
"""The accounts of all stages."""


@dataclass(frozen=True)
class MethodText:
    """What the table knows of one method, as sentences."""

    title: str
    source: str
    exact_for: str
    breaks_where: str
    """Empty: nowhere."""

    @property
    def tooltip(self) -> str:
        """All of it, a line each."""
        lines = [self.title, f"Source: {self.source}", f"Exact for: {self.exact_for}"]
        return "\n".join(lines + ([f"Breaks: {self.breaks_where}"] if self.breaks_where else []))


class DepthText(NamedTuple):
    """How a buffer of depths is shown."""

    unit: str
    """Behind every number."""
    description: str
    """One sentence: range, cleared value, and which of two is nearer."""


NO_STEPS = "This stage has no steps."


def initial_sentence(stage: str, corner_count: int = 3, *, has_steps: bool = True) -> str:
    """Return the sentence of a stage before its first step, or why primitives of so few corners skip it."""
    said = nouns(corner_count).text(stage_of(stage).initial) if has_steps else NO_STEPS
    return skipped_because(stage, corner_count) or said


def skipped_because(stage: str, corner_count: int) -> str:
    """Return why primitives of so many corners do not go through a stage; empty: they do."""
    if corner_count == 0:
        return BEFORE_TABLES if STAGES.index(stage) < STAGES.index("depth") else ""
    return stage_of(stage).not_for.get(nouns(corner_count).many, "")


def summary_sentence(
    stage: str,
    level: Level,
    counts: Mapping[str, int],
    triangle: int | None,
    corner_count: int = 3,
    method: str = "",
    order: RowOrder | None = None,
    pixel: tuple[int, int] = (-1, -1),
) -> str:
    """Say what a step larger than one operation did.

    Parameters
    ----------
    counts : mapping
        ``rows``, pixels ``tested``, the marks among them and whether they are ``samples``, as ``StageTrace.summary``
        counts them.
    triangle : int, optional
        The triangle that all rows are about; ``None`` or -1: several, or none.
    corner_count : int, optional
        Corners of what is drawn: 2 of segments, 1 of points, 0 of tables of depths.
    method : str, optional
        The method that ran, as ``fill=hierarchy``: what a group of rows is, and what is done to a pixel.
    order : RowOrder, optional
        How rows are listed, if it is not triangle by triangle; then ``pixel`` is that of the step, column and row.
    """
    known = {name: counts.get(name, 0) for name in ("rows", "tested", "samples", "boxes", *PRESENTED, *MARKS)}
    family, _, name = method.partition("=")
    drawn = nouns(corner_count)
    account_of, group = ACCOUNTS[stage], drawn.text(stage_of(stage).group)
    if family == "line":
        account_of, group = _line_account, "" if drawn.one == "point" else "one line"
    if family == "fill":
        # A lane is set up before its spans are filled.
        group = "one " + fill_traits(name).group_label.lower().split(" or ")[-1 if known["covered"] else 0]
    parts = _account_of_order(known, order) if order and order.sums else account_of(known, drawn)
    account = ", ".join(parts)
    if known["nan"]:
        account += f", {known['nan']:,} undefined (NaN)"
    everything = f"All {drawn.many}"
    who = everything if triangle is None or triangle < 0 else f"{drawn.one.capitalize()} {triangle}"
    if level == Level.STAGE:
        who = "Whole stage"
    elif order:
        who = order.unit(level, *pixel)
    elif level == Level.GROUP and group:
        who = group.capitalize() if who == everything else f"{who}, {group}"
    return f"{who}: {account}."


def stage_card(stage: str, method: str = "", corner_count: int = 3) -> StageCard:
    """Return the card of a stage.

    Parameters
    ----------
    stage : str
        A name of ``core.STAGES``.
    method : str, optional
        The method that ran, as ``fill=hierarchy``: the card then names it and its source.
    corner_count : int, optional
        Corners of what is drawn: 2 of segments, 1 of points, 0 of tables of depths.

    Raises
    ------
    ValueError
        If there is no such stage.
    """
    declared = stage_of(stage)
    draws_lines = method.startswith("line=") and corner_count > 0
    drawn = TRIANGLES if declared.not_for else nouns(corner_count)
    texts = LINE_CARD if draws_lines else _own_texts(declared, drawn)
    if drawn.one == "point" or not draws_lines:
        texts = {**texts, **CARDS.get((stage, drawn.one), {})}
    card = StageCard(**texts, source=declared.source)
    if not method:
        return card
    family, name = method.split("=", 1)
    text = method_text(family, name)
    return replace(card, source=f"{card.source}. {family_title(family)}, {text.title}: {text.source}")


def _own_texts(stage: Stage, drawn: Nouns) -> dict[str, str]:
    texts = {"title": stage.title, "gets": stage.takes, "gives": stage.gives, "purpose": stage.purpose}
    return {name: drawn.text(text) for name, text in texts.items()}


NEARNESS = DepthText(
    "",
    "1/w of a perspective scene, else −z/w, where the ray meets the nearest triangle so far: larger is nearer.",
)
"""What rays compare, in float64."""


def depth_text(buffer: str, method: str) -> DepthText | None:
    """Return the text of a buffer of the stage depth under a depth method; ``None``: it holds no depths."""
    if buffer == "nearness":
        return NEARNESS
    if buffer != "depth":
        return None
    kept = table.get("depth", method).function()
    return DepthText(kept.unit, kept.description)


def method_text(family: str, name: str) -> MethodText:
    """Return the texts of a method; a name that is not in the table raises ValueError."""
    found = table.get(family, name)
    return MethodText(found.title, found.source, found.exact_for, found.breaks_where)


def family_title(family: str) -> str:
    """Return what a setting is called; one that settings do not have goes by its own name."""
    return FIELDS[family].title if family in FIELDS else family.replace("_", " ").capitalize()
