"""The table of depths in the Scene pane: each edit makes another table, and so another scene, which undo takes back."""

from collections.abc import Callable
from dataclasses import replace

import numpy as np
from PySide6.QtCore import QObject, Slot

from app.pages.page_bar import Page
from app.session.document import TeachingRaster
from app.session.moment import Moment
from app.session.session import Session
from core.assembly.depth_tables import table_scene
from core.records.depth_table import DepthTable, depth_of_text, depths_of_text
from core.scene import ClipScene
from lessons.depth_tables import COLORS
from lessons.shapes import linear_color
from widgets.tables.depth_table_editor import DepthTableEditor


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
