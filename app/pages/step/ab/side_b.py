"""What B is beside A: the same run with other settings, or a listing as printed or edited, tried first."""

from collections.abc import Iterator, Mapping
from dataclasses import dataclass, field, replace
from typing import TYPE_CHECKING

from app.pages.step.setting_records import settings_records
from app.session.document import Document
from app.session.tracing import QUICK_SECONDS
from core import STAGES, Settings, Trace
from core.explain.stage_texts import family_title
from core.methods import ReplacedName, table
from core.scene import AnyScene, Scene
from core.settings import FAMILIES, no_effect
from core.shaders.presets import preset_of
from widgets.basics.settings_panel import Setting, SettingChoice

if TYPE_CHECKING:
    from core.edits.edit import Edit


# What B is beside A: the same run with other settings, a listing as printed or edited, or a run with a
# mistake.


SAME = "the same settings"
NAMED = 3
"""Settings in a title at most."""
FIRST_CHOICES = {
    "transform": (("skinning", "dual-quaternion"), ("tessellation", "bound"), ("depth", "reversed-z")),
    "edges": (("coverage", "float32"),),
    "bin": (("fill", "hierarchy"), ("fill", "blocks")),
    "raster": (("line", "midpoint"), ("fill", "scanline"), ("fill_rule", "inclusive")),
    "interpolate": (("interpolation", "affine"),),
    "depth": (("visibility", "last-drawn"), ("visibility", "z-buffer"), ("depth", "z-16")),
    "blend": (("blend", "over"), ("blend", "additive")),
    "resolve": (("antialiasing", "msaa-4"),),
}
"""Stage to families and methods that are tried before the classical ones of the stage."""
BY_OUTCOME = frozenset({"depth"})
"""Stages in which other steps to the same result are no difference: where no triangle is hidden, B keeps the test."""
ANYWHERE = (("interpolation", "affine"), ("depth", "z-16"), ("fill", "scanline"))
"""What is tried where no method of the stage makes a difference."""


ABOUT = ("line_clipping", "line", "tessellation", "skinning")
"""Families of which a scene that chooses a method itself is about that method."""
AS_PRINTED = "-lecture"
"""What the names of methods as printed end in, behind the name of the right one."""


AGAINST: Mapping[str, Mapping[str, tuple[str, ...]]] = {
    "visibility": {
        "painters": ("bsp",),
        "scan-line": ("z-buffer",),
        "hit-lists": ("z-buffer",),
        "ray-casting-tree": ("ray-casting-by-pixel",),
        "ray-casting-by-pixel": ("z-buffer",),
    },
    "object_culling": {"frustum": ("none",), "occlusion": ("frustum",)},
    "depth_test_time": {"early": ("late",), "prepass": ("early",)},
    "shadow": {"map": ("rays",), "map-average": ("map",), "rays": ("map",)},
    "environment": {"cube": ("rays",), "rays": ("cube",)},
    "presentation": {
        "single": ("double",),
        "double": ("triple",),
        "double-at-once": ("double",),
        "triple": ("double",),
    },
    "history": {"kept": ("clamped",), "reprojected": ("kept",), "clamped": ("reprojected",)},
}
"""Family and method to what it is compared with in the lectures, though both may end with the same picture."""
SHOWN_IN = {
    "visibility": ("depth",),
    "object_culling": ("cull",),
    "depth_test_time": ("shade", "depth"),
    "shadow": ("shade",),
    "environment": ("shade",),
    "presentation": ("resolve",),
    "history": ("resolve",),
}
"""The stages whose steps show what such methods do otherwise."""


def counterparts(settings: Settings, stage: str) -> Iterator[tuple[str, str]]:
    """Yield families and methods that are compared with what is chosen, by the lectures' own words."""
    for family, against in AGAINST.items():
        chosen = getattr(settings, family)
        if stage in SHOWN_IN[family] and isinstance(chosen, str):
            yield from ((family, method) for method in against.get(chosen, ()))


def right_ones(settings: Settings, stage: str) -> Iterator[tuple[str, str]]:
    """Yield the right methods where ones as printed are chosen at a stage, and others where a scene is about one."""
    chosen = {
        name: of
        for name, of in Settings().differences(settings).items()
        if name in FAMILIES and FAMILIES[name].stage == stage
    }
    for family, method in chosen.items():
        if isinstance(method, str) and method.endswith(AS_PRINTED):
            yield family, method.removesuffix(AS_PRINTED)
    for family in filter(chosen.__contains__, ABOUT):
        yield from ((family, method) for method in FAMILIES[family].classical)


def first_difference(
    document: Document, trace: Trace, stage: str, shown: Mapping[str, str | int]
) -> dict[str, str | int]:
    """Return family and method in which B differs from a document at first: what is ``shown``, where that differs.

    B can draw the scene. It is what the lectures compare with what is chosen, or it does something else than the
    ``trace`` in the stage that is shown, if any method does.
    """
    # The window opens without the studies.
    from core.study.divergence import is_same_schedule, stage_divergence

    drawn: dict[str, str | int] = {}
    own = [(name, method) for name, of in FAMILIES.items() if of.stage == stage for method in of.classical]
    against = tuple(counterparts(document.settings, stage))
    others = (*right_ones(document.settings, stage), *FIRST_CHOICES.get(stage, ()), *own, *ANYWHERE)
    for family, method in (*shown.items(), *against, *others):
        settings = replace(document.settings, **{family: method})  # type: ignore[arg-type]
        other = replace(document, settings=settings)
        if settings == document.settings or no_effect(settings, family, document.scene):
            continue
        if other.estimated_seconds > QUICK_SECONDS:
            return {family: method}
        try:
            mine, theirs = trace.stage(stage), other.make_trace().stage(stage)
        except ValueError:
            continue
        by_outcome = stage in BY_OUTCOME
        has_other_steps = not by_outcome and not is_same_schedule(mine, theirs)
        is_compared = (family, method) in against
        if is_compared or has_other_steps or stage_divergence(mine, theirs, by_outcome) is not None:
            return {family: method}
        drawn = drawn or {family: method}
    return drawn


def settings_difference(mine: Settings, other: Settings) -> str:
    """Return in words what ``other`` does otherwise than ``mine``, and where that is much, how much more."""
    parts = []
    for name, value in mine.differences(other).items():
        text = table.get(name, value).title if isinstance(value, str) else str(value)
        parts.append(f"{family_title(name).lower()}: {text}")
    return ", ".join([*parts[:NAMED], *([f"and {len(parts) - NAMED} more"] if len(parts) > NAMED else [])])


def shaders_of(scenes: tuple[AnyScene, AnyScene]) -> str | None:
    """Return A's shaders in words where two scenes have others; ``None``: they differ in something else."""
    mine, other = scenes
    if not isinstance(mine, Scene) or not isinstance(other, Scene) or mine.program == other.program:
        return None
    if mine.program is None:
        return "built-in shading"
    return mine.program.name if preset_of(mine.program) else "own shaders"


@dataclass(frozen=True, eq=False)
class SideB:
    """What B does otherwise than A."""

    differences: Mapping[str, str | int] = field(default_factory=dict)
    """Family and value."""
    title: str = ""
    """Of a run that is shown and never used by the page: with a mistake, or as printed; empty: settings name it."""
    printed: str = ""
    """Name of the listing as printed that B runs; empty: none."""
    edits: tuple["Edit", ...] = ()
    """Edited listings that B runs."""
    scenes: tuple[AnyScene, AnyScene] | None = None
    """Where a mistake is in the scene: that of A, beside which B draws the other one."""

    @property
    def first_stage(self) -> str:
        """The first stage of the settings that differ; the first of all where something else differs."""
        stages = [FAMILIES[name].stage for name in self.differences if name in FAMILIES]
        is_known = stages and len(stages) == len(self.differences) and self.scenes is None
        return min(stages, key=STAGES.index) if is_known else STAGES[0]

    def is_beside(self, document: Document) -> bool:
        """Return whether this is a B for what is open."""
        return self.scenes is None or self.scenes[0] is document.scene

    def opened_beside(self, document: Document) -> "SideB | None":
        """Return what is left of it beside another scene: settings that have an effect there; ``None``: nothing."""
        other = self.document(document).settings
        left = {
            name: value
            for name, value in document.settings.differences(other).items()
            if not no_effect(other, name, document.scene)
        }
        # What has a title was shown for its own scene.
        return SideB(left) if left and not self.title else None

    def document(self, document: Document) -> Document:
        """Return what B draws beside a document."""
        settings = replace(document.settings, **self.differences)  # type: ignore[arg-type]
        return replace(
            document, settings=settings, scene=document.scene if self.scenes is None else self.scenes[1]
        )

    def titles(self, document: Document) -> tuple[str, str]:
        """Return A and B in words: the settings in which they differ."""
        mine, other = document.settings, self.document(document).settings
        plain = "without the mistake" if self.title and not self.edits else SAME
        if self.scenes is not None and (program := shaders_of(self.scenes)) is not None:
            return program, self.title
        first = settings_difference(other, mine) or plain
        return first, self.title or settings_difference(mine, other) or SAME

    def named(self) -> dict[str, str | int]:
        """Return the differences that settings can name."""
        return {name: of for name, of in self.differences.items() if not isinstance(of, ReplacedName)}

    def shown_settings(self, document: Document) -> list[Setting]:
        """Return B's settings as the view offers them; a listing as printed stands where no method does."""
        label = SettingChoice("", self.title)
        return [
            replace(each, choices=(label, *each.choices), current="")
            if (self.printed or self.edits) and each.family in self.differences
            else each
            for each in settings_records(self.document(document))
        ]
