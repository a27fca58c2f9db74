"""The variables of line clipping as the table shows them."""

from collections.abc import Mapping

from core.explain.variable_text import VariableText
from core.trace.line_clipping import CLIP_OPERATIONS

CLIPPING_VARIABLES: Mapping[str, VariableText] = {
    "border": VariableText("border", "Border of the raster that the edge is compared with."),
    "normal": VariableText("N", "Outward normal of the border.", "approach"),
    "border_point": VariableText("Pₑ", "A point on the border.", "approach"),
    "approach": VariableText("p, or N·D", "Below 0 the edge enters here, above 0 it leaves, 0 is parallel."),
    "room": VariableText("q, or −N·(P₀ − Pₑ)", "Room inside the border at the first end; below 0: outside."),
    "crossing_t": VariableText("t of the border", "Where the edge crosses the border's line."),
    "bound_before": VariableText(
        "bound before", "The latest entry, or earliest exit, of the borders before."
    ),
    "t_enter": VariableText("t enter", "Latest entry by now."),
    "t_leave": VariableText("t leave", "Earliest exit by now."),
    "pass_start": VariableText("first end now", "First end as this pass finds it.", "code_start"),
    "pass_end": VariableText("second end now", "Second end as this pass finds it.", "code_end"),
    "code_start": VariableText("outcode of first", "1 left, 2 right, 4 bottom, 8 top, added up."),
    "code_end": VariableText("outcode of second", "1 left, 2 right, 4 bottom, 8 top, added up."),
    "moved_end": VariableText("moved end", "The end that moves: 0 the first, 1 the second."),
    "moved_to": VariableText("moves to", "Where the edge crosses the border."),
    "kept_start": VariableText("drawn from", "First end of the part that is drawn."),
    "kept_end": VariableText("drawn to", "Second end of the part that is drawn."),
}

CLIPPING_KINDS = tuple(CLIP_OPERATIONS)
"""Kinds of rows that are about no pixel."""
