"""Everything that happened to one pixel: the verdict, then each event with before, out, after and reason."""

from dataclasses import dataclass

from PySide6.QtCore import (
    QAbstractListModel,
    QModelIndex,
    QPersistentModelIndex,
    QPointF,
    QRect,
    QRectF,
    QSize,
    QSortFilterProxyModel,
    Qt,
    Signal,
    Slot,
)
from PySide6.QtGui import (
    QAction,
    QColor,
    QFont,
    QFontMetrics,
    QGuiApplication,
    QKeySequence,
    QPainter,
    QPaintEvent,
    QPen,
    QPolygonF,
)
from PySide6.QtWidgets import (
    QAbstractItemView,
    QCheckBox,
    QHBoxLayout,
    QLabel,
    QListView,
    QStyle,
    QStyledItemDelegate,
    QStyleOptionViewItem,
    QVBoxLayout,
    QWidget,
)

from widgets.marks import Mark, blended, draw_mark, mark_pixmap
from widgets.roles import set_role
from widgets.theme import current_theme, theme_notifier
from widgets.typed_value import full_text, number_text

_ENTRY = Qt.ItemDataRole.UserRole


@dataclass(frozen=True)
class PixelValue:
    """A colour with the depth that goes with it."""

    rgba: tuple[int, int, int, int]
    """Display (sRGB) bytes with straight alpha."""
    depth: float | None = None
    """As the depth method stores it; None where there is none."""


@dataclass(frozen=True)
class HistoryEntry:
    """One event at the pixel."""

    title: str
    """``Initial value``, ``Clear``, ``Triangle 12`` ..."""
    before: PixelValue | None = None
    out: PixelValue | None = None
    """What the fragment offers."""
    after: PixelValue | None = None
    mark: Mark | None = None
    """Kept (`Mark.RIGHT` or `Mark.COVERED`), or how it was rejected; None where it is no fragment."""
    reason: str = ""
    """Why it was kept or rejected, in words."""
    is_rejected: bool = False
    is_current: bool = False
    """The step just done belongs to it."""


@dataclass(frozen=True)
class PixelStory:
    """The history of one pixel."""

    column: int
    row: int
    verdict: str
    """One sentence: what became of the pixel and why."""
    mark: Mark | None = None
    entries: tuple[HistoryEntry, ...] = ()


class _Entries(QAbstractListModel):
    """The entries as a list model; a role tells the row in the story."""

    def __init__(self, parent: QWidget) -> None:
        super().__init__(parent)
        self.entries: tuple[HistoryEntry, ...] = ()

    def show_entries(self, entries: tuple[HistoryEntry, ...]) -> None:
        self.beginResetModel()
        self.entries = entries
        self.endResetModel()

    def rowCount(self, parent: QModelIndex | QPersistentModelIndex = QModelIndex()) -> int:  # noqa: B008
        return 0 if parent.isValid() else len(self.entries)

    def data(
        self, index: QModelIndex | QPersistentModelIndex, role: int = Qt.ItemDataRole.DisplayRole
    ) -> object:
        entry = self.entries[index.row()]
        if role == _ENTRY:
            return entry
        if role == Qt.ItemDataRole.DisplayRole:
            return f"{entry.title}: {entry.reason}" if entry.reason else entry.title
        if role in (Qt.ItemDataRole.ToolTipRole, Qt.ItemDataRole.AccessibleTextRole):
            return entry_text(entry)
        return None


class _Filter(QSortFilterProxyModel):
    """Leaves out rejected fragments when told to."""

    def __init__(self, parent: QWidget) -> None:
        super().__init__(parent)
        self.shows_rejected = True

    def show_rejected(self, is_shown: bool) -> None:
        self.beginFilterChange()
        self.shows_rejected = is_shown
        self.endFilterChange()

    def filterAcceptsRow(self, source_row: int, source_parent: QModelIndex | QPersistentModelIndex) -> bool:
        entry: HistoryEntry = self.sourceModel().index(source_row, 0, source_parent).data(_ENTRY)
        return self.shows_rejected or not entry.is_rejected


def entry_text(entry: HistoryEntry) -> str:
    """Return an entry as text with full precision, for tooltips, screen readers and the clipboard."""
    lines = [entry.title]
    for name, value in (("before", entry.before), ("out", entry.out), ("after", entry.after)):
        if value is not None:
            depth = "" if value.depth is None else f", depth {full_text(value.depth)}"
            lines.append(
                f"{name}: sRGB ({', '.join(map(str, value.rgba[:3]))}), alpha {value.rgba[3]}{depth}"
            )
    if entry.mark is not None or entry.reason:
        lines.append(
            ": ".join(part for part in ("rejected" if entry.is_rejected else "", entry.reason) if part)
        )
    return "\n".join(line for line in lines if line)


class _EntryDelegate(QStyledItemDelegate):
    """Draws an entry in two lines: title and three swatches with depth, then mark and reason."""

    def sizeHint(self, option: QStyleOptionViewItem, index: QModelIndex | QPersistentModelIndex) -> QSize:
        entry: HistoryEntry = index.data(_ENTRY)
        metrics = QFontMetrics(_small_font())
        lines = QFontMetrics(_text_font()).height() + 10
        return QSize(200, lines + (metrics.height() + 3 if entry.reason else 0))

    def paint(
        self, painter: QPainter, option: QStyleOptionViewItem, index: QModelIndex | QPersistentModelIndex
    ) -> None:
        theme = current_theme()
        entry: HistoryEntry = index.data(_ENTRY)
        box: QRect = option.rect
        ground = QColor(theme.window if index.row() % 2 else theme.panel)
        if entry.is_current:
            ground = blended(theme.accent, ground.name(), 0.12)
        if option.state & QStyle.StateFlag.State_Selected:
            ground = QColor(theme.selection)
        painter.save()
        painter.fillRect(box, ground)
        if entry.is_current:
            painter.fillRect(QRect(box.left(), box.top(), 4, box.height()), QColor(theme.accent))
        text_height = QFontMetrics(_text_font()).height()
        top = box.top() + 5
        mark_side = text_height - 2
        if entry.mark is not None:
            draw_mark(painter, entry.mark, QRectF(box.left() + 7, top + 1, mark_side, mark_side))
        cells = value_columns(box)
        title = QRect(
            box.left() + 12 + mark_side, top, cells[0].left() - box.left() - 14 - mark_side, text_height
        )
        font = _text_font()
        font.setBold(entry.is_current)
        painter.setFont(font)
        painter.setPen(QColor(theme.text))
        painter.drawText(title, _LEFT, QFontMetrics(font).elidedText(entry.title, _ELIDE, title.width()))
        for cell, value in zip(cells, (entry.before, entry.out, entry.after), strict=True):
            if value is not None:
                self._paint_value(painter, QRect(cell.left(), top, cell.width(), text_height), value)
        if entry.reason:
            metrics = QFontMetrics(_small_font())
            line = QRect(
                title.left(), top + text_height + 2, box.right() - title.left() - 8, metrics.height()
            )
            painter.setFont(_small_font())
            painter.setPen(QColor(theme.muted_text))
            painter.drawText(line, _LEFT, metrics.elidedText(entry.reason, _ELIDE, line.width()))
        painter.restore()

    @staticmethod
    def _paint_value(painter: QPainter, cell: QRect, value: PixelValue) -> None:
        theme = current_theme()
        side = cell.height() - 2
        swatch = QRectF(cell.left() + 0.5, cell.top() + 1.5, side, side)
        red, green, blue, alpha = value.rgba
        solid = QColor(red, green, blue)
        painter.fillRect(swatch, solid)
        if alpha < 255:
            # The lower right half shows the colour as it lies over the ground.
            painter.save()
            painter.setRenderHint(QPainter.RenderHint.Antialiasing)
            painter.setPen(Qt.PenStyle.NoPen)
            painter.setBrush(blended(solid.name(), theme.panel, alpha / 255))
            painter.drawPolygon(
                QPolygonF([swatch.topRight(), swatch.bottomRight(), QPointF(swatch.left(), swatch.bottom())])
            )
            painter.restore()
        painter.setPen(QPen(QColor(theme.outline), 1.0))
        painter.setBrush(Qt.BrushStyle.NoBrush)
        painter.drawRect(swatch)
        if value.depth is not None:
            painter.setFont(_small_font())
            painter.setPen(QColor(theme.text))
            room = cell.adjusted(side + 4, 0, 0, 0)
            text = number_text(value.depth)
            painter.drawText(room, _LEFT, QFontMetrics(_small_font()).elidedText(text, _ELIDE, room.width()))


_LEFT = Qt.AlignmentFlag.AlignLeft | Qt.AlignmentFlag.AlignVCenter
_ELIDE = Qt.TextElideMode.ElideRight


def value_columns(box: QRect) -> tuple[QRect, QRect, QRect]:
    """Return where Before, Out and After stand inside a row; the title has what is left."""
    width = min(
        104, max(round(QFontMetrics(_small_font()).horizontalAdvance("0.0000") * 1.7), box.width() // 5)
    )
    left = box.right() - 3 * width + 1
    cells = [QRect(left + k * width, box.top(), width - 4, box.height()) for k in range(3)]
    return cells[0], cells[1], cells[2]


def _text_font() -> QFont:
    font = QFont(QGuiApplication.font())
    font.setPixelSize(current_theme().text_px)
    return font


def _small_font() -> QFont:
    font = QFont(QGuiApplication.font())
    font.setPixelSize(current_theme().small_px)
    font.setFeature(QFont.Tag("tnum"), 1)
    return font


class _Header(QWidget):
    """The names over the three columns of values."""

    def __init__(self, view: QListView, parent: QWidget) -> None:
        super().__init__(parent)
        self._view = view

    def sizeHint(self) -> QSize:
        return QSize(200, QFontMetrics(_small_font()).height() + 6)

    def minimumSizeHint(self) -> QSize:
        return self.sizeHint()

    def paintEvent(self, event: QPaintEvent) -> None:
        painter = QPainter(self)
        painter.setFont(_small_font())
        painter.setPen(QColor(current_theme().muted_text))
        box = QRect(0, 0, self._view.viewport().width(), self.height())
        for cell, name in zip(value_columns(box), ("Before", "Out", "After"), strict=True):
            painter.drawText(cell, _LEFT, name)
        painter.drawText(box.adjusted(8, 0, 0, 0), _LEFT, "Event")


class PixelHistory(QWidget):
    """Verdict, filter and rows; double click or Enter jumps to the row's step."""

    row_activated = Signal(int)
    """The user wants to go to an entry, by its number in the story (also when rejected ones are left out)."""
    rejected_toggled = Signal(bool)
    """The user shows (True) or leaves out (False) rejected fragments."""

    def __init__(self, parent: QWidget | None = None) -> None:
        super().__init__(parent)
        self._story: PixelStory | None = None
        self.setProperty("role", "panel")
        self.setAttribute(Qt.WidgetAttribute.WA_StyledBackground)
        self._model = _Entries(self)
        self._filter = _Filter(self)
        self._filter.setSourceModel(self._model)
        self._icon = QLabel(self)
        self.verdict = QLabel(self)
        self.verdict.setProperty("role", "title")
        self.verdict.setWordWrap(True)
        self.verdict.setAccessibleName("Verdict")
        self.verdict.setTextInteractionFlags(Qt.TextInteractionFlag.TextSelectableByMouse)
        self.place = QLabel(self)
        self.place.setProperty("role", "muted")
        self.rejected_box = QCheckBox("Show rejected", self)
        self.rejected_box.setChecked(True)
        self.rejected_box.setToolTip("Show fragments that did not reach the pixel, too")
        self.rejected_box.setFocusPolicy(Qt.FocusPolicy.TabFocus)
        self.rejected_box.toggled.connect(self._filter.show_rejected)
        self.rejected_box.clicked.connect(self.rejected_toggled)
        self.view = QListView(self)
        self.view.setModel(self._filter)
        self.view.setItemDelegate(_EntryDelegate(self.view))
        self.view.setAccessibleName("Pixel history")
        self.view.setVerticalScrollMode(QAbstractItemView.ScrollMode.ScrollPerPixel)
        self.view.setEditTriggers(QAbstractItemView.EditTrigger.NoEditTriggers)
        self.view.setResizeMode(QListView.ResizeMode.Adjust)
        self.view.setHorizontalScrollBarPolicy(Qt.ScrollBarPolicy.ScrollBarAlwaysOff)
        self.view.activated.connect(self._activate)
        copy = QAction("Copy with full precision", self.view)
        copy.setShortcut(QKeySequence(QKeySequence.StandardKey.Copy))
        copy.setShortcutContext(Qt.ShortcutContext.WidgetShortcut)
        copy.triggered.connect(self._copy)
        self.view.addAction(copy)
        self.view.setContextMenuPolicy(Qt.ContextMenuPolicy.ActionsContextMenu)
        self._header = _Header(self.view, self)
        top = QHBoxLayout()
        top.setSpacing(8)
        top.addWidget(self._icon, 0, Qt.AlignmentFlag.AlignTop)
        top.addWidget(self.verdict, 1)
        second = QHBoxLayout()
        second.addWidget(self.place, 1)
        second.addWidget(self.rejected_box)
        layout = QVBoxLayout(self)
        layout.setContentsMargins(8, 4, 8, 4)
        layout.setSpacing(4)
        layout.addLayout(top)
        layout.addLayout(second)
        layout.addWidget(self._header)
        layout.addWidget(self.view, 1)
        theme_notifier().theme_changed.connect(self._follow_theme)
        self.show_story(None)

    @Slot(object)
    def show_story(self, story: PixelStory | None) -> None:
        """Show the history of a pixel, or the hint for an empty pane."""
        self._story = story
        entries = story.entries if story else ()
        self._model.show_entries(entries)
        hint = "Point at a pixel or click one: what happened to it appears here."
        self.verdict.setText(story.verdict if story else hint)
        is_hint = story is None
        set_role(self.verdict, "muted" if is_hint else "title")
        for part in (self.view, self._header):
            part.setVisible(bool(entries))
        rejected = sum(entry.is_rejected for entry in entries)
        self.rejected_box.setVisible(rejected > 0)
        self.rejected_box.setText(f"Show rejected ({rejected})")
        self.place.setVisible(not is_hint)
        if story:
            self.place.setText(f"Pixel column {story.column}, row {story.row}")
        current = next((k for k, entry in enumerate(entries) if entry.is_current), None)
        if current is not None:
            self.view.scrollTo(self._filter.mapFromSource(self._model.index(current)))
        self._follow_theme()

    @Slot(bool)
    def show_rejected(self, is_shown: bool) -> None:
        """Show or leave out rejected fragments."""
        self.rejected_box.setChecked(is_shown)

    @Slot(QModelIndex)
    def _activate(self, index: QModelIndex) -> None:
        self.row_activated.emit(self._filter.mapToSource(index).row())

    @Slot()
    def _copy(self) -> None:
        indexes = self.view.selectionModel().selectedIndexes()
        if indexes:
            QGuiApplication.clipboard().setText(
                "\n".join(entry_text(index.data(_ENTRY)) for index in indexes)
            )

    @Slot()
    def _follow_theme(self) -> None:
        mark = self._story.mark if self._story else None
        self._icon.setVisible(mark is not None)
        if mark is not None:
            side = current_theme().title_px + 3
            self._icon.setPixmap(mark_pixmap(mark, side, self.devicePixelRatioF()))
            self._icon.setToolTip(mark.value)
        self.view.viewport().update()
        self._header.update()
