"""Which buffer is looked at: chosen by its name, or in a row of small linked pixel grids."""

from collections.abc import Sequence

from PySide6.QtCore import QPoint, QSize, Qt, QTimer, Signal, Slot
from PySide6.QtGui import QAction, QResizeEvent, QShowEvent, QWheelEvent
from PySide6.QtWidgets import QComboBox, QLabel, QMenu, QScrollArea, QSizePolicy, QToolButton, QWidget

from widgets.basics.accessibility import ArrowGroup
from widgets.basics.choice_box import ChoiceBox
from widgets.basics.controls import column_layout, row_layout
from widgets.basics.theme import current_theme, text_font, theme_notifier
from widgets.grid.canvas import OutlineLayer
from widgets.grid.geometry import GridGeometry
from widgets.grid.layers import GridBuffer, Overlay
from widgets.grid.marks import StepMark
from widgets.grid.pixel_grid import PixelGrid
from widgets.grid.view import FIT, GridView

# Which buffer the main grid shows, chosen by its name.


ROOM = 11
"""Letters that the box has room for: other buffers must not move what stands beside it."""


class BufferChoice(ChoiceBox):
    """The buffers of the stage at hand; set by code, it emits nothing."""

    buffer_chosen = Signal(str)
    """Name of the buffer that was chosen."""

    def __init__(self, parent: QWidget | None = None) -> None:
        super().__init__(parent)
        self._names: list[tuple[str, str]] = []
        self.setFocusPolicy(Qt.FocusPolicy.TabFocus)
        self.setAccessibleName("Buffer in the main view")
        self.setToolTip("Choose the buffer in the main view")
        self.setSizeAdjustPolicy(QComboBox.SizeAdjustPolicy.AdjustToMinimumContentsLengthWithIcon)
        self.setMinimumContentsLength(ROOM)
        self.activated.connect(self._choose)

    def show_buffers(self, buffers: Sequence[GridBuffer], chosen: str) -> None:
        """Offer buffers and mark the one that is shown; there is nothing to choose of one."""
        names = [(buffer.name, buffer.label) for buffer in buffers]
        if names != self._names:
            self._names = names
            self.clear()
            for buffer in buffers:
                self.addItem(buffer.label, buffer.name)
                self.setItemData(self.count() - 1, buffer.description, Qt.ItemDataRole.ToolTipRole)
            self.setEnabled(len(names) > 1)
        self.setCurrentIndex(self.findData(chosen))

    @Slot(int)
    def _choose(self, index: int) -> None:
        self.buffer_chosen.emit(self.itemData(index))


# A row of small linked pixel grids: the same pixel in every buffer, with its value under each.


class BufferTile(QWidget):
    """One buffer of the strip: its title, a small grid, and the value at the pixel in question."""

    title_clicked = Signal(str)
    """Name of the buffer."""

    def __init__(self, name: str, parent: QWidget | None = None) -> None:
        """Make the tile of the buffer called ``name``."""
        super().__init__(parent)
        self.name = name
        self.grid = PixelGrid(self, compact=True)
        self.title = QToolButton(self)
        self.title.setProperty("flat", True)
        self.title.setCheckable(True)
        self.title.setSizePolicy(QSizePolicy.Policy.Expanding, QSizePolicy.Policy.Fixed)
        self.title.clicked.connect(self._tell)
        self.value = QLabel(self, alignment=Qt.AlignmentFlag.AlignCenter)
        self.value.setSizePolicy(QSizePolicy.Policy.Ignored, QSizePolicy.Policy.Fixed)
        self._pixel: tuple[int, int] | None = None
        column = column_layout(self, 2)
        column.addWidget(self.title)
        column.addWidget(self.grid, 1)
        column.addWidget(self.value)

    def show_buffer(self, buffer: GridBuffer) -> None:
        """Show a buffer."""
        if self.title.text() != buffer.label:
            self.title.setText(buffer.label)
            self.title.setAccessibleName(f"Show {buffer.label} in the main view")
        if self.title.toolTip() != buffer.description:
            self.title.setToolTip(buffer.description)
        self.grid.show_buffer(buffer)

    def show_value(self, pixel: tuple[int, int] | None) -> None:
        """Write the value of a pixel under the grid, with four digits or as many as there is room for."""
        self._pixel = pixel
        text = ""
        if pixel is not None:
            metrics = self.value.fontMetrics()
            for digits in (4, 3, 2, 1):
                text = self.grid.value_text(pixel, digits)
                if metrics.horizontalAdvance(text) <= self.width():
                    break
            text = metrics.elidedText(text, Qt.TextElideMode.ElideRight, max(self.width(), 1))
        if text != self.value.text():
            self.value.setText(text)
            self.value.setToolTip("" if pixel is None else self.grid.value_text(pixel, digits=0))

    def resizeEvent(self, event: QResizeEvent) -> None:
        """Fit the value to the new width."""
        super().resizeEvent(event)
        self.show_value(self._pixel)

    def _tell(self) -> None:
        """Tell that the buffer was chosen; which one is checked is for the owner to say."""
        self.title_clicked.emit(self.name)


class BufferStrip(QWidget):
    """Buffers side by side under one pointer, zoom and pan; a click on a title chooses the main one."""

    buffer_chosen = Signal(str)
    """Name of the buffer whose title was clicked."""
    pixel_hovered = Signal(int, int)
    """Column and row under the pointer in any of the grids."""
    pixel_left = Signal()
    """The pointer left the grid that it was in."""
    pixel_clicked = Signal(int, int)
    """Column and row clicked in any of the grids."""
    pixel_menu_requested = Signal(int, int, QPoint)
    """Column, row and global position of a right click in any of the grids."""
    view_changed = Signal(object)
    """The new :class:`~widgets.grid.view.GridView` after the user zoomed or panned; all grids followed."""
    strip_shown = Signal()
    """The strip has come into sight: what it shows may be of an earlier step."""

    def __init__(self, parent: QWidget | None = None) -> None:
        """Make an empty strip."""
        super().__init__(parent)
        self._tiles: dict[str, BufferTile] = {}
        self._arrows = ArrowGroup((), self)
        self._hidden: frozenset[str] = frozenset()
        self._chosen = ""
        self._hover: tuple[int, int] | None = None
        self._pin: tuple[int, int] | None = None
        self._step = StepMark()
        self._geometry: GridGeometry | None = None
        # Tiles side by side differ by a pixel in width.
        self._outlines = OutlineLayer(most=4)
        self._overlays: tuple[Overlay, ...] = ()
        self._view = FIT
        self.setAccessibleName("Buffers")
        self._menu = QMenu(self)
        self._menu.triggered.connect(self._choose_hidden)
        self._more = QToolButton(self, popupMode=QToolButton.ToolButtonPopupMode.InstantPopup)
        self._more.setProperty("flat", True)
        self._more.setText("⋮")
        self._more.setToolTip("Choose which buffers are shown")
        self._more.setAccessibleName("Choose which buffers are shown")
        self._more.setStyleSheet("QToolButton::menu-indicator { image: none; }")
        self._more.setMenu(self._menu)
        content = QWidget()
        self._row = row_layout(content, 3 * current_theme().unit)
        self._area = _SidewaysArea(self)
        self._area.setWidget(content)
        self._bringing = QTimer(self, singleShot=True)
        self._bringing.setInterval(0)  # Once the tiles have been laid out.
        self._bringing.timeout.connect(self._bring_chosen_into_sight)
        content.setAutoFillBackground(False)
        self._area.viewport().setAutoFillBackground(False)
        whole = row_layout(self, current_theme().unit)
        whole.addWidget(self._area, 1)
        whole.addWidget(self._more, 0, Qt.AlignmentFlag.AlignTop)
        theme_notifier().theme_changed.connect(self._take_font)
        self._take_font()

    def showEvent(self, event: QShowEvent) -> None:
        """Ask for what is true now."""
        super().showEvent(event)
        self.strip_shown.emit()

    def show_buffers(self, buffers: tuple[GridBuffer, ...] | list[GridBuffer]) -> None:
        """Show buffers in this order; tiles of names that stay are kept and paint only what changed."""
        names = [buffer.name for buffer in buffers]
        if len(set(names)) != len(names):
            raise ValueError(f"buffers must have names of their own, got {', '.join(names)}")
        labels = [action.text() for action in self._menu.actions()]
        if names != list(self._tiles):
            self._arrange(names)
        for buffer in buffers:
            self._tiles[buffer.name].show_buffer(buffer)
        self._show_values()
        if labels != [buffer.label for buffer in buffers] or names != self._menu_names():
            self._fill_menu(buffers)

    def show_chosen(self, name: str) -> None:
        """Mark the title of the buffer that stands in the main view, and bring it into sight where it has changed."""
        if name != self._chosen:
            self._bringing.start()
        self._chosen = name
        for key, tile in self._tiles.items():
            tile.title.setChecked(key == name)

    def show_hover(self, pixel: tuple[int, int] | None) -> None:
        """Mark the pixel under the pointer in every grid, with its value."""
        self._hover = pixel
        for tile in self._tiles.values():
            tile.grid.show_hover(pixel)
        self._show_values()

    def show_pin(self, pixel: tuple[int, int] | None) -> None:
        """Mark the pinned pixel in every grid; its value is written while no other is pointed at."""
        self._pin = pixel
        for tile in self._tiles.values():
            tile.grid.show_pin(pixel)
        self._show_values()

    def show_step(self, mark: StepMark) -> None:
        """Mark the step just done in every grid."""
        self._step = mark
        for tile in self._tiles.values():
            tile.grid.show_step(mark)

    def show_geometry(self, geometry: GridGeometry | None) -> None:
        """Show triangles as thin lines in every grid."""
        self._geometry = geometry
        for tile in self._tiles.values():
            tile.grid.show_geometry(geometry)

    def show_overlays(self, overlays: tuple[Overlay, ...] | list[Overlay]) -> None:
        """Lay overlays over every grid."""
        self._overlays = tuple(overlays)
        for tile in self._tiles.values():
            tile.grid.show_overlays(self._overlays)

    def set_view(self, view: GridView) -> None:
        """Zoom and pan every grid; emits nothing."""
        self._view = view
        for tile in self._tiles.values():
            tile.grid.set_view(view)

    def hidden_names(self) -> frozenset[str]:
        """Return the names of the buffers that are hidden."""
        return self._hidden

    def set_hidden_names(self, names: frozenset[str]) -> None:
        """Hide these buffers again; emits nothing."""
        self._hidden = frozenset(names)
        for name, tile in self._tiles.items():
            tile.setVisible(name not in self._hidden)
        for action in self._menu.actions():
            action.setChecked(str(action.data()) not in self._hidden)

    def menu(self) -> QMenu:
        """Return the menu that shows and hides buffers, to be offered elsewhere too."""
        return self._menu

    def tile(self, name: str) -> BufferTile:
        """Return the tile of a buffer."""
        return self._tiles[name]

    def names(self) -> tuple[str, ...]:
        """Return the names of the buffers in their order, hidden ones included."""
        return tuple(self._tiles)

    def sizeHint(self) -> QSize:
        """Return a size for one row of thumbnails."""
        return QSize(640, 200)

    def _arrange(self, names: list[str]) -> None:
        """Make, reuse and drop tiles so that they stand in the order of ``names``."""
        tiles = {name: self._tiles.get(name) or self._make_tile(name) for name in names}
        for name, tile in self._tiles.items():
            if name not in tiles:
                tile.hide()
                tile.deleteLater()
        while self._row.count():
            self._row.takeAt(0)
        for name, tile in tiles.items():
            self._row.addWidget(tile, 1)
            tile.setVisible(name not in self._hidden)
        self._tiles = tiles
        self._arrows.show_buttons([tile.title for tile in tiles.values()])
        self._bringing.start()

    @Slot()
    def _bring_chosen_into_sight(self) -> None:
        """Scroll to the buffer that stands in the main view."""
        tile = self._tiles.get(self._chosen)
        if tile is not None and not tile.isHidden():
            self._area.ensureWidgetVisible(tile, 0, 0)

    def _make_tile(self, name: str) -> BufferTile:
        """Return a new tile that is linked with the others."""
        tile = BufferTile(name, self._area.widget())
        grid = tile.grid
        grid.setMinimumWidth(88)
        grid.set_view(self._view)
        grid.share_outlines(self._outlines)
        grid.show_geometry(self._geometry)
        grid.show_overlays(self._overlays)
        grid.show_step(self._step)
        grid.show_pin(self._pin)
        grid.show_hover(self._hover)
        grid.pixel_hovered.connect(self._hover_all)
        grid.pixel_left.connect(self._leave_all)
        grid.pixel_clicked.connect(self.pixel_clicked)
        grid.pixel_menu_requested.connect(self.pixel_menu_requested)
        grid.view_changed.connect(self._view_all)
        tile.title.setChecked(name == self._chosen)
        tile.title_clicked.connect(self._choose)
        tile.value.setFont(text_font(current_theme()))
        return tile

    def _hover_all(self, column: int, row: int) -> None:
        """Mark the pixel in every grid at once, and report it."""
        self.show_hover((column, row))
        self.pixel_hovered.emit(column, row)

    def _leave_all(self) -> None:
        """Unmark the pixel in every grid, and report it."""
        self.show_hover(None)
        self.pixel_left.emit()

    def _view_all(self, view: GridView) -> None:
        """Let every grid follow, and report it."""
        self.set_view(view)
        self.view_changed.emit(view)

    def _choose(self, name: str) -> None:
        """Mark the chosen title, and report it."""
        self.show_chosen(name)
        self.buffer_chosen.emit(name)

    def _choose_hidden(self, action: QAction) -> None:
        """Show or hide the buffer of a menu entry."""
        name = str(action.data())
        self.set_hidden_names(self._hidden - {name} if action.isChecked() else self._hidden | {name})

    def _show_values(self) -> None:
        """Write the value at the hovered pixel, or else at the pinned one, under every grid."""
        for tile in self._tiles.values():
            tile.show_value(self._hover if self._hover is not None else self._pin)

    def _fill_menu(self, buffers: tuple[GridBuffer, ...] | list[GridBuffer]) -> None:
        """Offer every buffer with a check mark."""
        self._menu.clear()
        for buffer in buffers:
            action = self._menu.addAction(buffer.label)
            action.setData(buffer.name)
            action.setCheckable(True)
            action.setChecked(buffer.name not in self._hidden)

    def _menu_names(self) -> list[str]:
        """Return the names of the buffers in the menu."""
        return [str(action.data()) for action in self._menu.actions()]

    def _take_font(self) -> None:
        """Write values in the size of the present theme, with tabular figures."""
        for tile in self._tiles.values():
            tile.value.setFont(text_font(current_theme()))


class _SidewaysArea(QScrollArea):
    """Scrolls sideways only, also with the wheel where it is not over a grid."""

    def __init__(self, parent: QWidget | None = None) -> None:
        super().__init__(parent)
        self.setWidgetResizable(True)
        self.setVerticalScrollBarPolicy(Qt.ScrollBarPolicy.ScrollBarAlwaysOff)
        self.setFocusPolicy(Qt.FocusPolicy.NoFocus)

    def wheelEvent(self, event: QWheelEvent) -> None:
        """Scroll sideways."""
        bar = self.horizontalScrollBar()
        bar.setValue(bar.value() - event.angleDelta().y() - event.angleDelta().x())
        event.accept()
