"""Why each method was chosen: what was seen in the scene, and what was measured of the cheaper methods."""

from core.records.nouns import nouns
from core.records.words import counted, joined
from core.study.planner.findings import Seen
from core.study.planner.phrases import capitalized, figure, in_bytes, phrase
from core.study.planner.records import Tolerance
from core.study.planner.trials import Choice, Trial

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
            return f"A pixel has at most {counted(seen.layers, 'fragment')}."
        case "depth" if not is_compared:
            return "Depth is not compared, so its format does not matter."
        case "blend" if choice.dearest == "additive":
            return "The settings ask for additive light."
        case "blend" if seen.is_translucent:
            return "Some alpha is below 1: what is behind shines through."
        case "blend":
            return "Every alpha is 1: nothing shines through."
    return ""


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
