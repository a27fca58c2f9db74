"""What B is beside A: the same run with other settings, or a run with a mistake, which may draw another scene."""

from collections.abc import Mapping
from dataclasses import dataclass, field, replace

from app.pages.step.ab_settings import settings_difference
from app.pages.step.scene_outline_presenter import settings_records
from app.session.document import Document
from core.methods import ReplacedName
from core.scene import AnyScene
from widgets.basics.settings_panel import Setting, SettingChoice


@dataclass(frozen=True, eq=False)
class OtherRun:
    """A run that B is beside one scene: that of a mistake, which may draw something else."""

    of: AnyScene
    """What A draws; beside another scene B is a run of the page again."""
    scene: AnyScene
    """What B draws."""
    title: str


@dataclass(frozen=True, eq=False)
class BChoice:
    """What B does otherwise than A."""

    differences: Mapping[str, str | int] = field(default_factory=dict)
    """Family and value."""
    is_chosen: bool = False
    """Whether the user has chosen it; else it follows the stage that is shown."""
    run: OtherRun | None = None
    """The run with a mistake that B is; ``None``: it is one that the settings can name."""
    printed: str = ""
    """Name of the listing as printed that B runs; empty: none."""

    @property
    def named(self) -> dict[str, str | int]:
        """The differences that settings can name."""
        return {name: of for name, of in self.differences.items() if not isinstance(of, ReplacedName)}

    def run_beside(self, document: Document) -> OtherRun | None:
        """Return the run with a mistake that B is beside the scene that is open."""
        return self.run if self.run is not None and self.run.of is document.scene else None

    def title(self, document: Document) -> str:
        """Return B in words."""
        run = self.run_beside(document)
        if run is not None:
            return run.title
        return settings_difference(document.settings, self.document(document).settings) or "the same settings"

    def document(self, document: Document) -> Document:
        """Return what B draws beside a document."""
        run = self.run_beside(document)
        settings = replace(document.settings, **self.differences)  # type: ignore[arg-type]
        return replace(document, settings=settings, scene=document.scene if run is None else run.scene)

    def shown_settings(self, document: Document) -> list[Setting]:
        """Return B's settings as the view offers them; a listing as printed stands where no method does."""
        shown, run = settings_records(self.document(document)), self.run_beside(document)
        if not self.printed or run is None:
            return shown
        label = SettingChoice("", run.title)
        return [
            replace(each, choices=(label, *each.choices), current="")
            if each.family in self.differences
            else each
            for each in shown
        ]
