"""The plan: try cheaper methods family by family, keep the cheapest within the tolerance, and say why.

Measured, not bounded: on 56 random scenes, chosen settings take 0.43 of the time of the reference
settings (geometric mean). Bounds of light, texels, depth and coverage took 3,000 lines and as long to plan, and
left 0.56: they reject whatever they cannot prove.
"""

from collections.abc import Callable
from time import perf_counter

from core.scene import AnyScene
from core.settings import Settings, with_method
from core.study.planner.costs import Costs, TriedCosts
from core.study.planner.findings import Seen, facts_of, look
from core.study.planner.lost_fragments import loses_fragments
from core.study.planner.phrases import phrase
from core.study.planner.reasons import ALL_SLOWER, reason
from core.study.planner.records import Decision, Fact, Findings, Plan, Tolerance, Watch, unwatched
from core.study.planner.reference_settings import reference_settings
from core.study.planner.tessellation import tessellations
from core.study.planner.trials import Choice, Trial, Trials

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
    "cull",
    "clipping",
    "interpolation",
    "texture_filter",
    "shading",
    "visibility",
    "depth",
    "blend",
    "antialiasing",
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
    advice = tessellations(scene)
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
