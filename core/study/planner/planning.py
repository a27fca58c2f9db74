"""The plan: try cheaper methods family by family, keep the cheapest within the tolerance, and say why.

Measured, not bounded: on 56 random scenes, chosen settings take 0.43 of the time of the reference
settings (geometric mean). Bounds of light, texels, depth and coverage took 3,000 lines and as long to plan, and
left 0.56: they reject whatever they cannot prove.
"""

from collections.abc import Callable
from math import ceil, log2
from time import perf_counter

from core.records.words import capitalized, counted, joined, nouns
from core.scene import AnyScene
from core.settings import DEFAULTS, Settings, with_method
from core.study.planner.findings import Seen, facts_of, look, tessellations
from core.study.planner.records import (
    Decision,
    Fact,
    Findings,
    Plan,
    Tolerance,
    Watch,
    figure,
    in_bytes,
    phrase,
    unwatched,
)
from core.study.planner.reference_settings import reference_settings
from core.study.planner.trials import Choice, Costs, Trial, Trials, TriedCosts, loses_fragments
from core.visibility.hit_lists import HIT_BYTES

# Why each method was chosen: what was seen in the scene, and what was measured of the cheaper methods.


ALL_SLOWER = "All choices together take longer here than the reference settings, so none is made."
EVEN = 1e-9
"""Ratios of w no farther from 1 are 1, but for rounding."""
CROSS = "cross a plane of the view volume or lie"
FLAT = 1e-5
"""Degrees by which normals that are the same may differ, for rounding."""


def reason(choice: Choice, tolerance: Tolerance, seen: Seen, is_compared: bool) -> str:
    """Return sentences with the numbers: of the scene, of every method that was tried, and what stays.

    Depths may be ``is_compared`` or not.
    """
    parts = [_fact(choice, seen, is_compared)]
    for name, trial in choice.rejected:
        many = f"{counted(trial.beyond, 'pixel')} {'changes' if trial.beyond == 1 else 'change'}"
        parts.append(
            f"{capitalized(phrase(choice.family, name))}: {many} by more than {tolerance.bytes}/255, "
            f"by up to {in_bytes(trial.largest)}."
        )
    if choice.unseen:
        unseen = capitalized(joined([phrase(choice.family, name) for name in choice.unseen]))
        parts.append(f"{unseen} may {_unseen_change(choice, seen)} between the rows that were tried.")
    if choice.slower:
        slower = capitalized(joined([phrase(choice.family, name) for name in choice.slower]))
        parts.append(f"{slower} would do, but {'take' if len(choice.slower) > 1 else 'takes'} longer here.")
    chosen = capitalized(phrase(choice.family, choice.chosen))
    if choice.trial is not None:
        parts.append(f"{chosen}: {change_text(choice.trial)}.")
    elif choice.rejected or choice.slower or choice.unseen:
        parts.append(f"{chosen}: kept.")
    return nouns(seen.corner_count).text(" ".join(part for part in parts if part))


def _unseen_change(choice: Choice, seen: Seen) -> str:
    """Return what methods that were not tried may do to single pixels."""
    if choice.family == "clipping":
        return "change a pixel on a cut edge"
    assert seen.depth is not None
    return f"store z = {seen.depth[1]:.8g}, the farthest depth, as the cleared value, and lose such pixels"


def change_text(trial: Trial) -> str:
    """Return how far a choice changes the picture: ``pixels change by 2/255 at most, but for 3 pixels``."""
    where = " in the rows that were tried" if trial.error > trial.largest else ""
    if not trial.largest:
        return f"no pixel changes{where}"
    but = f", except for {counted(trial.pixels, 'pixel')}" if trial.pixels else ""
    return f"pixels change by {in_bytes(min(trial.error, trial.largest))} at most{but}{where}"


def _fact(choice: Choice, seen: Seen, is_compared: bool) -> str:
    """Return what of the scene bears on a family, with names of what is drawn in braces."""
    match choice.family:
        case "cull" if seen.corner_count < 3:
            return "Without an area nothing faces away."
        case "cull" if choice.dearest != "none":
            return "The settings leave out front faces."
        case "cull" if not seen.backs:
            return "No {one} in view faces away."
        case "cull":
            face = "faces" if seen.backs == 1 else "face"
            return f"{seen.backs:,} of {counted(seen.in_view, '{one}', '{many}')} in view {face} away."
        case "clipping" if not seen.cut:
            return "No {one} crosses a plane of the view volume: there is nothing to clip."
        case "clipping":
            cross = "crosses a plane of the view volume or lies" if seen.cut == 1 else CROSS
            return f"{seen.cut:,} of {counted(seen.triangles, '{one}', '{many}')} {cross} beyond one."
        case "interpolation" if seen.w_ratio - 1 < EVEN:
            return "Within every {one} w is the same."
        case "interpolation":
            return f"Within a {{one}} w changes by a factor of {seen.w_ratio:.4g} at most."
        case "texture_filter":
            return _texture_fact(seen)
        case "shading":
            return _light_fact(seen)
        case "visibility":
            return _visibility_fact(seen)
        case "depth" if not is_compared:
            return "Depth is not compared, so its format does not matter."
        case "blend" if choice.dearest == "additive":
            return "The settings ask for additive light."
        case "blend" if seen.is_translucent:
            return "Some alpha is below 1: what is behind shines through."
        case "blend":
            return "Every alpha is 1: nothing shines through."
        case "antialiasing" if seen.is_moving:
            return "Something moves between pictures: mixed over time, it leaves ghosts, or thin details flicker."
        case "antialiasing":
            return "Nothing moves between pictures: mixed over time by 1/k, each picture is one sample more."
    return ""


def _visibility_fact(seen: Seen) -> str:
    text = f"A pixel has at most {counted(seen.layers, 'fragment')}."
    if seen.failing:
        fail = "fails" if seen.failing == 1 else "fail"
        many = counted(seen.fragments, "fragment")
        text += f" Of {many} that were looked at, {seen.failing:,} {fail} the depth test: tested early, "
        text += "they need no shading."
    if seen.in_view and seen.corner_count == 3:
        asked = counted(seen.in_view, "{one}", "{many}")
        text += f" Rays, one for each pixel, would ask {asked} {counted(seen.pixels, 'time')}."
        text += _tree_fact(seen.triangles)
        if seen.is_translucent and seen.fragments:
            text += (
                f" Lists of hits would keep {counted(seen.fragments, 'fragment')} that were looked at, "
                f"{HIT_BYTES * seen.fragments:,} bytes, and blend them in order."
            )
        text += (
            f" Scan lines would compare depths only where {{many}} overlap: in {seen.overlapped:,} of "
            f"{counted(seen.covered, 'pixel')} that {'was' if seen.covered == 1 else 'were'} looked at."
        )
    return text


def _tree_fact(count: int) -> str:
    """Return what a ray asks in a tree of boxes, cut in the middle, that it goes down once."""
    in_leaf = DEFAULTS.leaf_size
    if count <= in_leaf:
        return ""
    boxes = 1 + 2 * ceil(log2(count / in_leaf))
    return (
        f" In a BVH of all, {in_leaf} to a leaf, a ray that meets one box in each level would ask at most {boxes} "
        f"boxes and {in_leaf} {{many}}."
    )


def _texture_fact(seen: Seen) -> str:
    if seen.texels is None:
        return "There is no texture in view, so every filter gives the same picture."
    size = "minified" if seen.texels > 1 else "nowhere minified"
    return f"A step of one pixel is at most {figure(seen.texels)} texels long, so the texture is {size}."


def _light_fact(seen: Seen) -> str:
    if seen.lean is None:
        return "Nothing is lit, so there is nothing to shade."
    text = f"Within a {{one}} normals lean up to {figure(seen.lean)} degrees from their mean"
    if seen.lean < FLAT:
        text = "Within every {one} the normals are the same"
    if seen.highlight is None:
        return f"{text}, and nothing has highlights."
    return f"{text}, and a highlight falls to half its light within {figure(seen.highlight)} degrees."


CHEAPER = {
    "antialiasing": ("none", "msaa-4", "ssaa-4"),
    "clipping": ("homogeneous",),
    "cull": ("back",),
    "visibility": ("last-drawn", "painters"),
    "depth": ("z-16", "z-24", "z-float32"),
    "blend": ("opaque",),
    "shading": ("unlit", "flat", "gouraud"),
    "texture_filter": ("nearest", "bilinear"),
    "interpolation": ("flat", "affine", "affine-n"),
}
"""Methods that are tried instead of the reference method, the cheaper first; families in the order of choosing.

Samples come first, as everything after them is drawn that much faster. Not tried: exact areas, which take 0.8 to 60
times as long as 4 x 4 samples, and 3 x 3 samples, which are within 8/255 on 25 of 70 random scenes where 2 x 2
are on 23."""
STAGES = (
    *("cull", "clipping", "interpolation", "texture_filter", "shading", "visibility", "depth"),
    *("blend", "antialiasing"),
)
"""Families that a plan decides on, in pipeline order."""


def look_at(scene: AnyScene, base: Settings | None = None) -> Findings:
    """Look at a scene, and return what a plan would be made of: an unantialiased picture in the places of `Trials`."""
    return _look(scene, reference_settings(scene, base), Trials(scene, Tolerance()))[1]


def plan(
    scene: AnyScene,
    tolerance: Tolerance | None = None,
    base: Settings | None = None,
    watch: Watch = unwatched,
    costs: Costs | None = None,
) -> Plan:
    """Choose the cheapest methods that stay within a tolerance where they are tried.

    Parameters
    ----------
    scene : Scene or ClipScene
    tolerance : Tolerance, optional
    base : Settings, optional
        What to draw, not how well, see `reference_settings`.
    watch : callable, optional
        Called with what is done, see `Watch`.
    costs : Costs, optional
        What is known of how long settings take; small pictures of the scene are drawn and timed by default.

    Returns
    -------
    Plan

    Raises
    ------
    ValueError
        For a table of depths: no method is chosen there.

    Notes
    -----
    Each cheaper method, together with all choices before it, is compared with the reference settings: errors are
    measured, not added. Small pictures are tried whole, so their predictions are what `measure_plan`
    measures; of larger ones only bands of rows, see ``trials``. Methods whose errors are single pixels, which bands
    miss, are not chosen there: without clipping, 23 of 60 pictures of random triangles around the eye changed.
    """
    if scene.corner_count == 0:
        raise ValueError(
            "a table of depths has nothing to plan: it begins at the depth test, and has its own"
        )
    tolerance = tolerance or Tolerance()
    everything = reference_settings(scene, base)
    step = (0.0, "Analysing the scene")

    def pause() -> None:
        watch(*step)

    pause()
    trials = Trials(scene, tolerance, pause)
    costs = TriedCosts(scene, pause) if costs is None else costs
    seen, findings = _look(scene, everything, trials)
    settings, choices = everything, {}
    for place, family in enumerate(CHEAPER):

        def tried(name: str, done: float = (1 + place) / (2 + len(CHEAPER)), family: str = family) -> None:
            nonlocal step
            step = (done, f"Trying {phrase(family, name)}")
            pause()

        choices[family] = _choose(family, scene, settings, everything, trials, costs, seen, tried)
        settings = with_method(settings, family, choices[family].chosen)
    step = ((1 + len(CHEAPER)) / (2 + len(CHEAPER)), "Predicting the time")
    pause()
    decisions = tuple(_decision(choices, family, tolerance, seen) for family in STAGES)
    if costs.is_slower(settings, everything):
        settings = everything
        decisions = tuple(
            Decision(each.setting, each.dearest, each.dearest, f"{each.reason} {ALL_SLOWER}", 0.0)
            for each in decisions
        )
    whole = trials.compare(settings, everything)
    seconds = costs.seconds((everything, settings)) or (None, None)
    advice = tessellations(scene, everything)
    return Plan(
        tolerance, everything, settings, decisions, findings, advice, whole.error, whole.pixels, *seconds
    )


def _look(scene: AnyScene, everything: Settings, trials: Trials) -> tuple[Seen, Findings]:
    start = perf_counter()
    seen = look(scene, everything, trials.regions)
    tried = Fact(
        "tried", "Rows of pixels that settings are tried on", f"{trials.rows:,} of {scene.size[1]:,}"
    )
    return seen, Findings((*facts_of(seen), tried), perf_counter() - start, seen.corner_count)


def _choose(
    family: str,
    scene: AnyScene,
    before: Settings,
    everything: Settings,
    trials: Trials,
    costs: Costs,
    seen: Seen,
    tried: Callable[[str], None],
) -> Choice:
    """Return the first cheaper method of a family that is within the tolerance and takes no longer."""
    dearest = getattr(before, family)
    if family == "cull" and seen.corner_count < 3:
        return Choice(family, dearest, dearest)
    if (family == "cull" and dearest != "none") or dearest == "additive" or dearest == CHEAPER[family][0]:
        return Choice(family, dearest, dearest)
    if has_no_effect(family, before, seen):
        return Choice(family, CHEAPER[family][0], dearest)
    rejected: list[tuple[str, Trial]] = []
    slower: list[str] = []
    unseen: list[str] = []
    for name in CHEAPER[family]:
        if name == dearest:
            break
        tried(name)
        settings = with_method(before, family, name)
        if not trials.is_whole and (
            family == "clipping" or (family == "depth" and loses_fragments(scene, settings, seen.far[name]))
        ):
            unseen.append(name)
            continue
        trial = trials.compare(settings, everything)
        if not trial.is_within:
            rejected.append((name, trial))
        elif costs.is_slower(settings, before):
            slower.append(name)
        else:
            step = trials.compare(settings, before)
            return Choice(family, name, dearest, step, tuple(rejected), tuple(slower), tuple(unseen))
    return Choice(family, dearest, dearest, None, tuple(rejected), tuple(slower), tuple(unseen))


def has_no_effect(family: str, settings: Settings, seen: Seen) -> bool:
    """Return whether all methods of a family draw the same in the same time, so that the cheapest is chosen untried."""
    return (
        (family == "clipping" and seen.cut == 0)
        or (family == "texture_filter" and seen.texels is None)
        or (family == "shading" and seen.lean is None)
        or (family == "depth" and settings.visibility != "z-buffer")
    )


def _decision(choices: dict[str, Choice], family: str, tolerance: Tolerance, seen: Seen) -> Decision:
    choice = choices[family]
    error, pixels = (0, 0) if choice.trial is None else (choice.trial.error, choice.trial.pixels)
    order = list(choices)
    return Decision(
        family,
        choice.chosen,
        choice.dearest,
        reason(choice, tolerance, seen, is_compared=choices["visibility"].chosen == "z-buffer"),
        float(error),
        pixels,
        is_needed=choice.chosen == choice.dearest
        and bool(choice.rejected or choice.unseen)
        and not choice.slower,
        rests_on=tuple(
            other for other in order[: order.index(family)] if choices[other].chosen != choices[other].dearest
        ),
    )
