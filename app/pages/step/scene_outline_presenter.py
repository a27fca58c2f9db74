"""The left side: what is in the scene, and which method runs at each stage."""

from dataclasses import replace

from PySide6.QtCore import QObject, Signal, Slot

from app.session.document import Document, focus_on
from app.session.scene_edits import outline, set_value
from app.session.session import Session
from core.explain.stage_texts import FAMILY_TITLES
from core.methods import table
from core.scene import ClipScene, Scene
from core.settings import WHOLE_NUMBERS, families
from widgets.basics.scene_outline import OutlineGroup, OutlineRow, OutlineValue, SceneOutline
from widgets.basics.settings_panel import Setting, SettingChoice, SettingsPanel

NUMBERS_OFFERED = {
    "block_size": ((1, 2, 4, 8, 16, 32), "{0} × {0} pixels"),
    "correction_interval": ((1, 2, 4, 8, 16, 32, 64), "every {0} pixels"),
    "samples_across": (tuple(range(1, 9)), "{0} × {0} samples"),
}
"""Settings that are numbers: the ones to choose from, and how they are called."""


class SceneOutlinePresenter(QObject):
    """Shows and edits scene values and settings."""

    edit_refused = Signal(str)
    """Why a typed value was not taken."""

    def __init__(
        self,
        session: Session,
        scene_outline: SceneOutline,
        panel: SettingsPanel,
        parent: QObject | None = None,
    ) -> None:
        super().__init__(parent)
        self._session, self._outline, self._panel = session, scene_outline, panel
        session.document_changed.connect(self.refresh)
        scene_outline.value_edited.connect(self._edit_value)
        scene_outline.row_selected.connect(scene_outline.show_selection)
        panel.setting_chosen.connect(self._choose)
        self.refresh()

    @Slot()
    def refresh(self) -> None:
        """Show the document."""
        document = self._session.document
        size = document.traced_scene.size
        groups = (_document_group(document), *outline(document.scene, document.triangle, size))
        self._outline.show_groups(groups)
        self._panel.show_settings(settings_records(document))

    @Slot(str, float)
    def _edit_value(self, path: str, value: float) -> None:
        document = self._session.latest
        try:
            if path == "document/focus/triangle":
                edited = self._focus(document, value)
            else:
                scene = set_value(document.scene, path, value, document.traced_scene.size)
                edited = replace(document, scene=scene)
            self._session.edit(edited)
        except ValueError as error:
            self.edit_refused.emit(str(error))
            self.refresh()

    @staticmethod
    def _focus(document: Document, value: float) -> Document:
        count = document.triangle_count
        if value != int(value) or not 0 <= value < count:
            raise ValueError(f"triangle must be a whole number from 0 to {count - 1}, got {value:g}")
        return focus_on(document, int(value))

    @Slot(str, str)
    def _choose(self, family: str, value: str) -> None:
        try:
            self._session.set_setting(family, int(value) if family in WHOLE_NUMBERS else value)
        except ValueError as error:
            self.edit_refused.emit(str(error))
            self.refresh()


def _document_group(document: Document) -> OutlineGroup:
    count = document.triangle_count
    rows = [OutlineRow("document/raster", document.raster.label)]
    if document.triangle is None:
        text = "One triangle" if count == 1 else f"All {count:,} triangles are stepped"
        rows.append(OutlineRow("document/all", text))
    else:
        value = OutlineValue("triangle", document.triangle, 0, count - 1)
        rows.append(OutlineRow("document/focus", f"Triangle in focus, of {count:,}", (value,)))
    return OutlineGroup("document", document.title or "Scene", tuple(rows))


def settings_records(document: Document) -> list[Setting]:
    """Return one record per family, with what does not matter now and why."""
    records = []
    last_group = ""
    for family in _in_order():
        title, group = FAMILY_TITLES[family]
        heading = group if group != last_group else ""
        last_group = group
        current = str(getattr(document.settings, family))
        if family in WHOLE_NUMBERS:
            offered, unit = NUMBERS_OFFERED[family]
            numbers = [str(number) for number in offered]
            numbers += [] if current in numbers else [current]
            choices = tuple(SettingChoice(number, unit.format(number)) for number in numbers)
        else:
            choices = tuple(_choice(document, family, name) for name in table.names(family))
        records.append(Setting(family, title, choices, current, _no_effect(document, family), heading))
    return records


def _in_order() -> list[str]:
    """Return families and numbers as the panel lists them: a number behind the family that it belongs to."""
    number_of = {
        "fill": "block_size",
        "interpolation": "correction_interval",
        "antialiasing": "samples_across",
    }
    return [name for family in families() for name in (family, number_of.get(family, "")) if name]


def _choice(document: Document, family: str, name: str) -> SettingChoice:
    found = table.get(family, name)
    breaks = f"\nBreaks: {found.breaks_where}." if found.breaks_where else ""
    tooltip = f"{name}\nSource: {found.source}.\nExact for {found.exact_for}.{breaks}"
    refusal = ""
    scene = document.scene
    is_orthographic = isinstance(scene, Scene) and scene.camera.projection == "orthographic"
    if "perspective" in found.needs and is_orthographic:
        refusal = "It needs a perspective camera: 1/w is constant for an orthographic one."
    return SettingChoice(name, found.title, tooltip, refusal)


def _no_effect(document: Document, family: str) -> str:
    """Return why a family has no effect on this document, or nothing."""
    settings, scene = document.settings, document.scene
    wireframe = settings.polygon_mode == "wireframe"
    if family == "block_size" and settings.fill not in ("hierarchy", "blocks"):
        return "Only fills by blocks have a block size."
    if family == "correction_interval" and settings.interpolation != "affine-n":
        return "Only affine interpolation that is corrected has an interval."
    if family == "correction_interval" and wireframe:
        return "Lines are interpolated with perspective at every pixel."
    if family == "samples_across" and settings.antialiasing != "ssaa-n":
        return "Only supersampling with n x n samples leaves their number open."
    if family in ("fill", "fill_rule", "block_size") and wireframe:
        return "Wireframes are not filled."
    if family in ("line", "line_clipping") and not wireframe:
        return "Lines are drawn where polygons are wireframes."
    if family == "resolve_filter" and settings.antialiasing in ("none", "area"):
        return "Only several samples a pixel are filtered."
    if family == "provoking" and settings.interpolation != "flat":
        return "Only flat interpolation takes one corner's value."
    if family in ("texture_filter", "wrap"):
        textures = (
            [scene.texture] if isinstance(scene, ClipScene) else [mesh.texture for mesh in scene.meshes]
        )
        if not any(texture is not None for texture in textures):
            return "This scene has no texture."
    if family == "shading" and isinstance(scene, ClipScene):
        return "Typed triangles have no lights: they are unlit."
    return ""
