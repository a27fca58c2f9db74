"""The left side: what is in the scene, value by value, which method runs at each stage, and the table of depths."""

from collections.abc import Callable, Mapping
from dataclasses import replace

import numpy as np
from PySide6.QtCore import QEvent, QObject, Slot
from PySide6.QtWidgets import QWidget

from app.pages.page_bar import Page
from app.pages.step.scene_values import outline
from app.pages.step.setting_records import settings_records
from app.session.document import Document, TeachingRaster, focus_on
from app.session.moment import Moment
from app.session.session import Session
from core.depth.whole_depths import table_scene
from core.records.depth_table import DepthTable, depth_of_text, depths_of_text
from core.records.words import nouns
from core.scene import ClipScene
from core.settings import WHOLE_NUMBERS
from lessons.scene_edits import set_values
from lessons.shapes import linear_color
from lessons.window_scenes import COLORS
from widgets.basics.settings_panel import SettingsPanel
from widgets.scene.depth_table import DepthTableEditor
from widgets.scene.outline import OutlineGroup, OutlineRow, OutlineValue, SceneOutline

# The left side: what is in the scene, and which method runs at each stage.


FOCUS = "document/focus/triangle"
"""Path of the number of the triangle in focus."""


class SceneOutlinePresenter(QObject):
    """Shows and edits scene values and settings."""

    def __init__(
        self,
        session: Session,
        scene_outline: SceneOutline,
        panel: SettingsPanel,
        page: Page,
    ) -> None:
        super().__init__(page)
        self._page = page
        self._session, self._outline, self._panel = session, scene_outline, panel
        self._shown: dict[QWidget, Document] = {}
        """What each pane shows: while it is folded away, not the newest."""
        for pane in (scene_outline, panel):
            pane.installEventFilter(self)
        scene_outline.value_edited.connect(self._edit_value)
        scene_outline.values_edited.connect(self._edit_values)
        scene_outline.row_selected.connect(scene_outline.show_selection)
        panel.setting_chosen.connect(self._choose)
        self.refresh(session.moment)

    def refresh(self, moment: Moment) -> None:
        """Show the document in the panes that are in sight, also where it is the same and something else was typed."""
        for pane in (self._outline, self._panel):
            if pane.isVisible():
                self._shown.pop(pane, None)
                self._fill(pane, moment.document)

    def prepare(self, document: Document) -> None:
        """Fill the panes that are folded away with a document that may be shown in them next."""
        for pane in (self._outline, self._panel):
            if not pane.isVisible():
                self._fill(pane, document)

    def eventFilter(self, watched: QObject, event: QEvent) -> bool:
        """Bring a pane up to date when it is unfolded."""
        if event.type() == QEvent.Type.Show and watched in (self._outline, self._panel):
            assert isinstance(watched, QWidget)
            self._fill(watched, self._session.document)
        return False

    def _fill(self, pane: QWidget, document: Document) -> None:
        if self._shown.get(pane) is document:
            return
        self._shown[pane] = document
        if pane is self._panel:
            self._panel.show_settings(settings_records(document))
        else:
            size = document.traced_scene.size
            groups = outline(document.scene, document.triangle, size)
            self._outline.show_groups((_document_group(document), *groups))

    @Slot(str, float)
    def _edit_value(self, path: str, value: float) -> None:
        self._edit_values({path: value})

    @Slot(object)
    def _edit_values(self, values: Mapping[str, float]) -> None:
        document = self._session.latest
        try:
            if FOCUS in values:
                document = self._focus(document, values[FOCUS])
            else:
                scene = set_values(document.scene, values, document.traced_scene.size)
                document = replace(document, scene=scene)
            self._session.edit(document)
        except ValueError as error:
            self._page.refuse(str(error))
            self.refresh(self._session.moment)

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
            self._page.refuse(str(error))
            self.refresh(self._session.moment)


def _document_group(document: Document) -> OutlineGroup:
    count, drawn = document.triangle_count, nouns(document.scene.corner_count)
    rows = [OutlineRow("document/raster", document.raster.label)]
    if document.triangle is None:
        text = f"One {drawn.one}" if count == 1 else f"All {count:,} {drawn.many} are stepped"
        rows.append(OutlineRow("document/all", text))
    else:
        value = OutlineValue("triangle", document.triangle, 0, count - 1)
        label = f"{drawn.one.capitalize()} in focus, of {count:,}"
        rows.append(OutlineRow("document/focus", label, (value,)))
    return OutlineGroup("document", document.title or "Scene", tuple(rows))


# The table of depths in the Scene pane: each edit makes another table, and so another scene, which undo
# takes back.


class DepthTablePresenter(QObject):
    """Shows the table of the session's scene while it has one, and edits it."""

    def __init__(self, session: Session, editor: DepthTableEditor, page: Page) -> None:
        super().__init__(page)
        self._page = page
        self._session, self._editor = session, editor
        self._shown: DepthTable | None = None
        editor.cell_edited.connect(self._set_cell)
        editor.patch_pasted.connect(self._paste)
        editor.patch_moved.connect(self._move)
        editor.patch_added.connect(self._add)
        editor.patch_removed.connect(self._remove)
        editor.test_chosen.connect(self._choose_test)
        editor.size_chosen.connect(self._resize)
        self.refresh(session.moment)

    def refresh(self, moment: Moment) -> None:
        """Show the table, or nothing where the scene is another one."""
        table = self._table()
        self._editor.setVisible(table is not None)
        if table is not None and table is not self._shown:
            self._editor.show_table(table)
        self._shown = table

    def _table(self) -> DepthTable | None:
        scene = self._session.latest.scene
        return scene.table if isinstance(scene, ClipScene) else None

    @Slot(int, int, int, str)
    def _set_cell(self, patch: int, row: int, column: int, text: str) -> None:
        def changed(table: DepthTable) -> DepthTable:
            depths = table.depths.copy()
            depths[patch, row, column] = depth_of_text(text)
            return replace(table, depths=depths)

        self._edit(changed)

    @Slot(int, str)
    def _paste(self, patch: int, text: str) -> None:
        def changed(table: DepthTable) -> DepthTable:
            cells = depths_of_text(text)
            if cells.shape != table.depths.shape[1:]:
                columns, rows = table.size
                raise ValueError(
                    f"the pasted patch has {cells.shape[1]} × {cells.shape[0]} cells, the table {columns} × {rows}"
                )
            depths = table.depths.copy()
            depths[patch] = cells
            return replace(table, depths=depths)

        self._edit(changed)

    @Slot(int, int)
    def _move(self, patch: int, place: int) -> None:
        def changed(table: DepthTable) -> DepthTable:
            order = [number for number in range(len(table.depths)) if number != patch]
            order.insert(place, patch)
            return replace(table, depths=table.depths[order], colors=table.colors[order])

        self._edit(changed)
        self._editor.show_current_patch(place)

    @Slot()
    def _add(self) -> None:
        def changed(table: DepthTable) -> DepthTable:
            count = len(table.depths)
            color = linear_color(COLORS[count % len(COLORS)])
            empty = np.full_like(table.depths[:1], np.nan)
            return replace(
                table,
                depths=np.concatenate([table.depths, empty]),
                colors=np.concatenate([table.colors, color[None]]),
            )

        self._edit(changed)
        self._editor.show_current_patch(self._editor.patches.count() - 1)

    @Slot(int)
    def _remove(self, patch: int) -> None:
        self._edit(
            lambda table: replace(
                table,
                depths=np.delete(table.depths, patch, axis=0),
                colors=np.delete(table.colors, patch, axis=0),
            )
        )

    @Slot(str)
    def _choose_test(self, test: str) -> None:
        self._edit(lambda table: replace(table, test=test))

    @Slot(int, int)
    def _resize(self, columns: int, rows: int) -> None:
        """Cut or fill up at the right and the top."""

        def changed(table: DepthTable) -> DepthTable:
            depths = np.full((len(table.depths), rows, columns), np.nan)
            kept = table.depths[:, :rows, :columns]
            depths[:, : kept.shape[1], : kept.shape[2]] = kept
            return replace(table, depths=depths)

        self._edit(changed)

    def _edit(self, change: Callable[[DepthTable], DepthTable]) -> None:
        """Take over a changed table, or show the present one again and say what was wrong."""
        document, table = self._session.latest, self._table()
        if table is None:
            return
        try:
            scene = table_scene(change(table))
            document = replace(document, scene=scene, raster=TeachingRaster(*scene.size))
            if document.triangle is not None and document.triangle >= document.triangle_count:
                document = replace(document, triangle=None)
            self._session.edit(document)
        except ValueError as error:
            self._page.refuse(str(error))
            self._editor.show_table(table)
