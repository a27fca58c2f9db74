"""The plan: look at a scene, choose stage by stage what is cheapest within the tolerance, and say why."""

from dataclasses import replace
from time import perf_counter

from core.methods import table
from core.scene import AnyScene
from core.settings import Settings
from core.study.planner.bounds.color_ranges import ColorRanges, color_ranges
from core.study.planner.bounds.translucency import is_translucent
from core.study.planner.choices.costs import Costs, TriedCosts
from core.study.planner.choices.surface_choice import SurfaceChoice, SurfaceChooser
from core.study.planner.choices.value_choice import ValueChoice, choose_values
from core.study.planner.progress import Pause, Watch, unpaused, unwatched
from core.study.planner.records import Decision, Findings, Plan, Tolerance
from core.study.planner.reference_settings import everything_on
from core.study.planner.scene_analysis.conservative_coverage import Touched, touch
from core.study.planner.scene_analysis.surfaces import may_be_seen
from core.study.planner.scene_analysis.tessellation import tessellations
from core.study.planner.words.facts import facts_of
from core.study.planner.words.surface_reasons import surface_reasons
from core.study.planner.words.value_reasons import value_reasons

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
    """Look at a scene, and return what a plan would be made of.

    Notes
    -----
    See ``touched`` for what the look costs: about as much as one or two unantialiased pictures with all buffers.
    """
    start = perf_counter()
    touched, colors = _look(scene, everything_on(scene, base))
    return Findings(facts_of(touched, colors, scene), perf_counter() - start)


def plan(
    scene: AnyScene,
    tolerance: Tolerance | None = None,
    base: Settings | None = None,
    watch: Watch = unwatched,
    costs: Costs | None = None,
) -> Plan:
    """Choose the cheapest methods whose bounded errors stay within a tolerance.

    Parameters
    ----------
    scene : Scene or ClipScene
    tolerance : Tolerance, optional
    base : Settings, optional
        What to draw, not how well, see `everything_on`.
    watch : callable, optional
        Told what is done, see `Watch`.
    costs : Costs, optional
        What is known of how long settings take; small pictures of the scene are drawn and timed by default.

    Returns
    -------
    Plan

    Raises
    ------
    ValueError
        If the scene is too large to be looked at, see ``touched.MOST_PAIRS``.

    Notes
    -----
    Bounds of colour are sums, see ``surface_choice`` and ``value_choice``. Outlines have no areas to be bounded: of a
    wireframe everything is kept.
    """
    tolerance = tolerance or Tolerance()
    everything = everything_on(scene, base)
    step = (0.0, "Looking at the scene")

    def pause() -> None:
        """Tell the step that is being done once more."""
        watch(*step)

    pause()
    start = perf_counter()
    touched, colors = _look(scene, everything, pause)
    pause()
    findings = Findings(facts_of(touched, colors, scene), perf_counter() - start)
    advice = tessellations(scene)
    if table.get("polygon_mode", everything.polygon_mode).function():
        kept = tuple(
            Decision(name, getattr(everything, name), getattr(everything, name), WIREFRAME, 0.0)
            for name in STAGES
        )
        return Plan(tolerance, everything, everything, kept, findings, advice)
    step = (1 / 4, "Choosing how what is seen is found")
    costs = TriedCosts(scene, pause) if costs is None else costs
    pause()
    surface = SurfaceChooser(touched, colors, scene, everything, tolerance, costs, pause).choose()
    step = (1 / 2, "Choosing how it is coloured")
    pause()
    # Beyond the corners of a triangle only what makes no difference at all is sure.
    left = tolerance.bytes - surface.error if surface.pattern.stays_inside else 0.0
    seen, pattern = surface.surfaces.is_candidate, surface.pattern
    values = choose_values(
        touched, surface.colors, scene, surface.settings, seen, left, pattern, costs, pause
    )
    chosen = replace(
        surface.settings,
        interpolation=values["interpolation"].chosen,
        texture_filter=values["texture_filter"].chosen,
        shading=values["shading"].chosen,
    )
    decisions = _decisions(everything, chosen, surface, values, tolerance, touched, colors, scene)
    error = surface.error + sum(value.error for value in values.values())
    step = (3 / 4, "Predicting the time")
    pause()
    pixels = surface.pixels
    if costs.is_slower(chosen, everything):
        chosen, error, pixels = everything, 0.0, 0
        decisions = tuple(
            Decision(each.setting, each.dearest, each.dearest, f"{each.reason} {ALL_SLOWER}", 0.0)
            for each in decisions
        )
    seconds = costs.seconds((everything, chosen)) or (None, None)
    return Plan(tolerance, everything, chosen, decisions, findings, advice, error, pixels, *seconds)


ALL_SLOWER = "All choices together take longer here than everything on, so none is made."
WIREFRAME = "Outlines have no areas whose colours could be bounded, so nothing is left out."


def _look(scene: AnyScene, everything: Settings, pause: Pause = unpaused) -> tuple[Touched, ColorRanges]:
    touched = touch(scene, replace(everything, polygon_mode="fill"), pause)
    is_blended = is_translucent(touched, scene) or everything.blend == "additive"
    pause()
    seen = may_be_seen(touched, is_blended)
    pause()
    return touched, color_ranges(touched, scene, everything, seen, pause=pause)


def _decisions(
    everything: Settings,
    chosen: Settings,
    surface: SurfaceChoice,
    values: dict[str, ValueChoice],
    tolerance: Tolerance,
    touched: Touched,
    colors: ColorRanges,
    scene: AnyScene,
) -> tuple[Decision, ...]:
    reasons = surface_reasons(surface, everything, chosen, tolerance)
    reasons |= value_reasons(values, surface, touched, colors, scene)
    decisions = []
    for name in STAGES:
        dearest, found = getattr(everything, name), getattr(chosen, name)
        error, pixels = 0.0, 0
        if name in values:
            error = values[name].error
        elif name in SHARED and found != dearest:
            error = surface.error if surface.by_widths or name == "antialiasing" else 0.0
            pixels = {"cull": surface.cull_pixels, "depth": surface.depth_pixels}.get(
                name, surface.sample_pixels
            )
        is_slower = name in dict(surface.slower) or (name in values and values[name].slower)
        is_needed = found == dearest and dearest != CHEAPEST[name] and not is_slower
        rests_on = tuple(
            other for other in RESTS_ON.get(name, ()) if getattr(chosen, other) != getattr(everything, other)
        )
        decisions.append(
            Decision(name, found, dearest, reasons[name], error, pixels, is_needed, rests_on=rests_on)
        )
    return tuple(decisions)


SHARED = ("cull", "clipping", "depth", "antialiasing")
"""Families that share one bound where there is one sample a pixel."""
RESTS_ON = {
    "cull": ("antialiasing",),
    "clipping": ("antialiasing",),
    "shading": ("antialiasing",),
    "interpolation": ("shading", "texture_filter", "antialiasing"),
    "texture_filter": ("antialiasing",),
    "visibility": ("cull", "clipping", "depth", "antialiasing"),
    "depth": ("cull", "antialiasing"),
}
"""Whose choices each family's bound takes for granted."""
CHEAPEST = {
    "cull": "back",
    "clipping": "homogeneous",
    "interpolation": "flat",
    "texture_filter": "nearest",
    "shading": "unlit",
    "visibility": "last-drawn",
    "depth": "z-16",
    "blend": "opaque",
    "antialiasing": "none",
}
