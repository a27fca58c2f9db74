"""The history of a pixel in plain words: the keys and numbers of ``core.pixel_history`` become sentences.

Every key has one sentence in a table; a number goes through the same text rules as everywhere else.
"""

from collections.abc import Sequence

from core.explain.number_text import exact_text, pair_text, steps_apart
from core.pixel_history.fragments import Link, PixelEvent, PixelHistory
from core.pixel_history.told_coverage import COVERAGE, Sentence, Values, has_area
from core.records.words import TRIANGLES, Nouns, counted, joined, piece_name

POLYGONS = {3: "a triangle", 4: "a quad", 5: "a pentagon", 6: "a hexagon"}


def verdict_sentence(history: PixelHistory, drawn: Nouns = TRIANGLES) -> str:
    """Return the first line of a history."""
    return link_sentence(history.verdict, drawn)


def event_title(event: PixelEvent, drawn: Nouns = TRIANGLES) -> str:
    """Return what an event is called: ``Initial value``, ``Clear``, ``Triangle 12, piece 1 of 2``."""
    if event.triangle < 0:
        return {"initial": "Initial value", "clear": "Clear", "resolve": "Resolved"}[event.kind]
    clip, name = event.link("clip"), f"{drawn.one.capitalize()} {event.triangle}"
    if clip is not None and clip.values.get("tree_piece"):
        name = f"{name}, piece {clip.values['tree_piece']} of its cuts"
    if event.primitive >= 0 and clip is not None and clip.values.get("piece_count", 1) > 1:
        values = clip.values
        return f"{name}, piece {values['piece'] + 1} of {values['piece_count']}"
    return name


def event_reason(event: PixelEvent, drawn: Nouns = TRIANGLES) -> str:
    """Return why an event was kept or rejected; clipping on the way there comes first.

    Of a fragment: a sentence for each of coverage, weights, depth test and blending, as far as it came.
    """
    links = [event.reason]
    if event.kind == "fragment":
        stages = ("raster", "interpolate", "depth", "blend")
        links = [
            link for link in event.chain if link.stage in stages or link.key in ("not-shaded", "not-left")
        ]
    first = link_sentence(links[0], drawn)
    clip = event.link("clip")
    if clip is not None and clip is not event.reason and clip.key == "clipped":
        first = f"{link_sentence(clip, drawn)[:-1]}; {_words(links[0], drawn)}."
    return " ".join([first, *(link_sentence(link, drawn) for link in links[1:])])


def count_sentences(history: PixelHistory, drawn: Nouns = TRIANGLES) -> tuple[str, ...]:
    """Return one line for every group of triangles that are not listed."""
    one, many = f"more {drawn.one}", f"more {drawn.many}"
    return tuple(
        f"{counted(count, one, many)}: {COUNTED[reason]}." for reason, count in history.counts.items()
    )


def link_sentence(link: Link, drawn: Nouns = TRIANGLES) -> str:
    """Return the sentence of one link of a chain."""
    text = _words(link, drawn)
    return text[0].upper() + text[1:] + "."


def _words(link: Link, drawn: Nouns) -> str:
    """Return a sentence without its capital and full stop, to be a part of another; ``drawn`` is one of its values."""
    sentence = SENTENCES[link.stage, link.key]
    return drawn.text(sentence) if isinstance(sentence, str) else sentence({**link.values, "drawn": drawn})


# Pieces of sentences


def _name(values: Values, which: str = "triangle") -> str:
    """Return what is drawn, and its number."""
    return f"{values['drawn'].one} {values[which]}"


def _corners(drawn: Nouns, numbers: tuple[int, ...]) -> str:
    """Return ``vertex 2 is``, ``vertices 0 and 1 are`` or ``all vertices are``."""
    if len(numbers) == 3:
        return drawn.all_vertices
    if drawn.one == "segment":
        # Its second end stands twice.
        numbers = numbers[:1]
    if len(numbers) == 1:
        return f"{drawn.vertex} {numbers[0]} is"
    return f"{drawn.vertices} {' and '.join(map(str, numbers))} are"


DIVISIONS = {
    "mirrored": "the division by w has mirrored the part behind the eye",
    "undefined": "{a_vertex} cannot be divided by its w",
}
"""What dividing before clipping did to a triangle."""


def _outside(values: Values) -> str:
    """Return which vertices lie outside which planes; of many planes the first is named.

    Where the division came first, what it did to vertices that are not in front of the eye.
    """
    if values["division"]:
        return str(values["drawn"].text(DIVISIONS[values["division"]]))
    planes_of: dict[tuple[int, ...], list[str]] = {}
    for plane, corners in values["outside"]:
        planes_of.setdefault(corners, []).append(PLANES[plane])
    parts = []
    for corners, planes in planes_of.items():
        more = f" and outside {counted(len(planes) - 1, 'more plane')}" if len(planes) > 1 else ""
        parts.append(f"{_corners(values['drawn'], corners)} {planes[0]}{more}")
    return ", ".join(parts)


def _weights(values: Values) -> str:
    """Return the weights, and where they are divided by w, those in the window."""
    text = f"weights {joined([exact_text(w) for w in values['weights']])}"
    if "in_window" not in values:
        return text
    return f"{text} after the division by w (in the window {joined([exact_text(w) for w in values['in_window']])})"


def _shaded(values: Values) -> str:
    """Return the colour, what of it is mirrored, and whether the light that casts shadows arrives."""
    text, share = "colour " + _channels(values["color"]), values.get("light_share")
    mirrored = values.get("mirrored")
    if mirrored is not None and any(mirrored):
        text += f", of which {_channels(mirrored)} is mirrored"
    if share in (None, 1.0):
        return text
    return f"{text}; in the shadow" if share == 0 else f"{text}; {exact_text(share)} of the light arrives"


def _channels(color: Sequence[float]) -> str:
    return ", ".join(exact_text(channel) for channel in color)


def _would(values: Values) -> str:
    return "; otherwise it would have a fragment here" if values.get("would_cover") else ""


def _clipped(values: Values) -> str:
    polygon = POLYGONS.get(values["corner_count"], f"a polygon of {values['corner_count']} corners")
    asked = f" (for {values['inserted_for']})" if values["inserted_for"] else ""
    return f"{_outside(values)}; clipped to {polygon}{asked}"


def _compared(values: Values, verdict: str) -> str:
    """Return the stored depth and that of the buffer, with digits that tell them apart, and how far apart they are."""
    new, old = pair_text(values["stored"], values["before"])
    holder = "the cleared depth" if values["against"] < 0 else _name(values, "against")
    apart = steps_apart(values["stored"], values["before"], values["scale"] != 1)
    return f"{new} {verdict} {holder} ({old}){f', {apart}' if apart else ''}"


def _against(values: Values) -> str:
    holder = "the cleared depth" if values["against"] < 0 else _name(values, "against")
    return f"{holder} ({exact_text(values['before'])})"


def _painted_over(values: Values) -> str:
    one = values["drawn"].one
    below, plane = (piece_name(one, *values[name]) for name in ("below", "plane"))
    because = {
        "apart": f"it lies on the eye's side of the plane of {plane}, which parts the two",
        "other": f"it lies on the eye's side of the plane of {plane}",
        "own": f"that lies on the other side of the plane of {plane} than the eye",
        "level": "both lie in one plane, of which the first is drawn last",
    }
    return f"painted over {below}: {because[values['how']]}"


def _holder(values: Values) -> str:
    return "all others so far" if values["against"] < 0 else _name(values, "against")


def _reason(values: Values) -> str:
    return _words(values["reason"], values["drawn"])


def _all_rejected(values: Values) -> str:
    count = values["fragment_count"]
    if not count:
        return f"nothing is drawn here: {_name(values)} was dropped; {_reason(values)}"
    if count == 1:
        return f"the only fragment here, of {_name(values)}, was rejected; {_reason(values)}"
    return f"all {count} fragments here were rejected, the last one: {_reason(values)}"


def _nothing_near(values: Values) -> str:
    count, drawn = values["triangle_count"], values["drawn"]
    if drawn.one == "patch":
        return f"no {drawn.one} covers this pixel"
    boxes = (
        f"the bounding box of the only {drawn.one}"
        if count == 1
        else f"the bounding boxes of all {count} {drawn.many}"
    )
    return f"no {drawn.one} covers this pixel: it lies outside {boxes}"


def _all_missed(values: Values) -> str:
    return f"no {values['drawn'].one} covers this pixel. The nearest is {_name(values)}: {_reason(values)}"


def _seen(values: Values) -> str:
    rejected = values["fragment_count"] - values["passed_count"]
    behind = f"; {counted(rejected, 'fragment')} rejected" if rejected else ""
    return f"{_name(values)} is visible here{behind}"


def _seen_over(values: Values) -> str:
    return f"{_seen(values)}, {counted(values['overwritten_count'], 'fragment')} overwritten"


PLANES = {
    "near": "behind the near plane",
    "far": "beyond the far plane",
    "left": "left of the view",
    "right": "right of the view",
    "bottom": "below the view",
    "top": "above the view",
}


def _mixed(values: Values) -> str:
    share, before = values["share"], counted(values["before"], "picture")
    history = ", ".join(exact_text(float(value)) for value in values["history"][:3])
    place = f", looked up at ({exact_text(values['place'][0])}, {exact_text(values['place'][1])})"
    how = f"{place if values['is_moved'] else ''}{', limited to the colours around' if values['is_limited'] else ''}"
    return (
        f"mixed over time: this picture with weight {exact_text(share)}, and what the {before} before it left, "
        f"({history}){how}, with weight {exact_text(1 - share)}"
    )


def _smoothed(values: Values) -> str:
    across = (("left of it", "right of it"), ("below it", "above it"))[values["is_horizontal"]]
    share = values["share"]
    return (
        f"beside an edge, so it is smoothed: {exact_text(1 - share)} of its colour and {exact_text(share)} of the "
        f"pixel {across[values['side'] > 0]}"
    )


SENTENCES: dict[tuple[str, str], Sentence] = {
    ("verdict", "nothing-near"): _nothing_near,
    ("verdict", "all-missed"): _all_missed,
    ("verdict", "all-rejected"): _all_rejected,
    ("verdict", "seen"): _seen,
    ("verdict", "seen-over"): _seen_over,
    ("verdict", "blended"): lambda v: (
        f"{v['passed_count'] - v['overwritten_count']} fragments are blended here, {_name(v)} last"
    ),
    ("verdict", "from-front"): lambda v: (
        f"{v['passed_count'] - v['overwritten_count']} hits are blended here from front to back, {_name(v)} in front"
    ),
    ("verdict", "seen-in-front"): lambda v: (
        f"{_name(v)} is visible here, and hides {counted(v['overwritten_count'], 'hit')} behind it"
    ),
    ("verdict", "triangle-seen"): lambda v: f"{_name(v)} is visible here",
    ("verdict", "triangle-blended"): lambda v: f"{_name(v)} is blended here, under {_name(v, 'seen')}",
    ("verdict", "triangle-overwritten"): lambda v: (
        f"{_name(v)} was drawn here and then overwritten by {v['drawn'].one} {v['reason'].values['by']}"
    ),
    ("verdict", "triangle-shut-out"): lambda v: (
        f"{_name(v)} is hidden here behind {v['drawn'].one} {v['reason'].values['by']}, which lets nothing through"
    ),
    ("verdict", "triangle-rejected"): lambda v: f"{_name(v)} was rejected here: {_reason(v)}",
    ("verdict", "triangle-absent"): lambda v: f"{_name(v)} has no fragment here: {_reason(v)}",
    ("blend", "initial"): "nothing is written here yet",
    ("blend", "clear"): "the background colour and the farthest depth",
    ("transform", "in-front"): "{three_vertices} in front of the eye",
    ("transform", "crosses-eye"): lambda v: f"{_corners(v['drawn'], v['behind'])} behind the eye (w ≤ 0)",
    ("transform", "behind-eye"): "{three_vertices} behind the eye (w ≤ 0)",
    ("cull", "kept"): lambda v: (
        f"not culled: its {'front' if v['facing'] > 0 else 'back'} faces the eye"
        if has_area(v)
        else "not culled"
    ),
    ("cull", "back-facing"): lambda v: f"culled: its back faces the eye{_would(v)}",
    ("cull", "front-facing"): lambda v: f"culled: its front faces the eye{_would(v)}",
    ("cull", "degenerate"): "culled: it has no area",
    ("cull", "behind-eye"): "culled: {three_vertices} behind the eye (w ≤ 0)",
    ("cull", "outside-plane"): lambda v: f"culled: {v['drawn'].all_vertices} {PLANES[v['plane']]}{_would(v)}",
    ("cull", "with-its-box"): lambda v: (
        f"culled with node {v['node']}, whose box lies {PLANES[v['plane']]}{_would(v)}"
    ),
    ("cull", "behind-occluders"): lambda v: (
        f"culled with node {v['node']}, whose box is hidden behind the occluders{_would(v)}"
    ),
    ("clip", "no-clipping"): "not clipped",
    ("clip", "inside"): "not clipped: inside all planes",
    ("clip", "clipped"): _clipped,
    ("clip", "clipped-away"): lambda v: f"{_outside(v)}; wholly clipped away",
    ("raster", "empty-cell"): "its cell is empty",
    **COVERAGE,
    ("interpolate", "weights"): _weights,
    ("shade", "color"): _shaded,
    ("shade", "not-shaded"): "not shaded, as it failed the depth test before",
    ("shade", "not-left"): "not shaded, as the prepass left another depth",
    ("depth", "passed"): lambda v: f"passed the depth test: {_compared(v, 'against')}",
    ("depth", "failed"): lambda v: f"failed the depth test: {_compared(v, 'is not nearer than')}",
    ("depth", "tied"): lambda v: (
        f"failed the depth test: equal to {_against(v)}, and a tie keeps the stored depth"
    ),
    ("depth", "ray-nearer"): lambda v: f"the ray meets it before {_holder(v)}, compared exactly",
    ("depth", "ray-farther"): lambda v: f"the ray meets {_holder(v)} first, compared exactly",
    ("depth", "ray-tied"): lambda v: (
        f"the ray meets it exactly where it meets {_holder(v)}, which came first"
    ),
    (
        "depth",
        "scan-nearest",
    ): "the nearest in its segment of the row: nothing here is nearer, compared exactly",
    ("depth", "scan-farther"): lambda v: (
        f"in its segment of the row {_holder(v)} is nearer, compared exactly"
    ),
    ("depth", "scan-tied"): lambda v: f"exactly as near as {_holder(v)}, and a tie keeps what is drawn first",
    ("depth", "scan-farthest"): "the farthest in its segment of the row, so it is drawn first",
    ("depth", "scan-layer"): lambda v: f"drawn over {_holder(v)}, which is not nearer, compared exactly",
    ("depth", "list-front"): lambda v: f"at the front of the sorted list of {counted(v['length'], 'hit')}",
    ("depth", "list-behind"): lambda v: (
        f"at place {v['place']} of {v['length']} in the sorted list, behind {_holder(v)}"
    ),
    ("depth", "list-beyond"): "not in the list: its depth is not nearer than the cleared one",
    ("depth", "painted-over"): _painted_over,
    ("depth", "ray-hidden"): lambda v: (
        f"hidden by the tree: the ray does not open node {v['node']}, missed, or behind another hit"
    ),
    ("depth", "not-tested"): lambda v: f"depth {exact_text(v['stored'])} stored without a test",
    ("depth", "before-near"): lambda v: (
        f"in front of the near plane: depth {exact_text(v['depth'])} is below 0"
    ),
    ("depth", "behind-far"): lambda v: f"beyond the far plane: depth {exact_text(v['depth'])} is above 1",
    ("depth", "undefined"): "its depth is not a number",
    ("depth", "discarded"): "discarded by the fragment shader",
    ("blend", "written"): "written and visible",
    ("blend", "overwritten"): lambda v: (
        f"{'its depth was ' if v['is_depth'] else ''}written, later overwritten by {_name(v, 'by')}"
    ),
    ("blend", "blended"): lambda v: f"blended with alpha {exact_text(v['alpha'])}",
    ("blend", "added"): lambda v: f"blended with alpha {exact_text(v['alpha'])}, from front to back",
    ("blend", "shut-out"): lambda v: f"not blended: {_name(v, 'by')} in front of it lets nothing through",
    ("resolve", "mixed"): _mixed,
    ("resolve", "begun"): "this picture is the first, so its colour stays",
    (
        "resolve",
        "lost",
    ): "outside of the picture before, so it has no history, and the colour of this picture stays",
    ("resolve", "smoothed"): _smoothed,
    ("resolve", "edge-kept"): "beside an edge, whose ends give it no part of another pixel: unchanged",
    ("resolve", "no-edge"): lambda v: (
        f"the luma of it and its four neighbours differs by {exact_text(v['contrast'])}, less than "
        f"{exact_text(v['threshold'])}: unchanged"
    ),
}
"""Stage and key to the sentence, without capital and full stop."""

COUNTED = {
    "back-facing": "culled, back-facing",
    "front-facing": "culled, front-facing",
    "degenerate": "culled, no area",
    "behind-eye": "culled, behind the eye",
    "outside-plane": "culled, outside the view",
    "with-its-box": "culled with a box outside the view",
    "behind-occluders": "culled with a box behind the occluders",
    "clipped-away": "clipped away",
    "no-fragment": "no fragment here",
    "outside-box": "the pixel is outside their bounding box",
    "missed": "the pixel is in their bounding box, but farther from them than from those listed",
}
"""Reason of triangles that are not listed, to words."""
