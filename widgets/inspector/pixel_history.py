"""Everything that happened to one pixel: the verdict, then each event with what was there before and after."""

from dataclasses import dataclass

from PySide6.QtCore import (
    QAbstractListModel,
    QModelIndex,
    QPersistentModelIndex,
    QPoint,
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
    QShowEvent,
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

from core.explain.number_text import exact_text, full_text
from widgets.basics.accessibility import KeyClaim
from widgets.basics.controls import set_role, text_label
from widgets.basics.drawing import Mark, blended, draw_mark, mark_pixmap
from widgets.basics.theme import current_theme, theme_notifier

# The history of a pixel as records, and as the list model that a view shows.


ENTRY_ROLE = Qt.ItemDataRole.UserRole
"""Role of the `HistoryEntry` itself."""


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


@dataclass(frozen=True)
class PixelStory:
    """The history of one pixel."""

    column: int
    row: int
    verdict: str
    """One sentence: what became of the pixel and why."""
    mark: Mark | None = None
    entries: tuple[HistoryEntry, ...] = ()


class StoryModel(QAbstractListModel):
    """The entries as a list model; a role tells the row in the story."""

    def __init__(self, parent: QWidget) -> None:
        super().__init__(parent)
        self.entries: tuple[HistoryEntry, ...] = ()

    def show_entries(self, entries: tuple[HistoryEntry, ...]) -> None:
        """Take other entries."""
        self.beginResetModel()
        self.entries = entries
        self.endResetModel()

    def rowCount(self, parent: QModelIndex | QPersistentModelIndex = QModelIndex()) -> int:  # noqa: B008
        """Count the entries."""
        return 0 if parent.isValid() else len(self.entries)

    def data(
        self, index: QModelIndex | QPersistentModelIndex, role: int = Qt.ItemDataRole.DisplayRole
    ) -> object:
        """Return the entry itself, its line, or its full text."""
        entry = self.entries[index.row()]
        if role == ENTRY_ROLE:
            return entry
        if role == Qt.ItemDataRole.DisplayRole:
            return f"{entry.title}: {entry.reason}" if entry.reason else entry.title
        if role in (Qt.ItemDataRole.ToolTipRole, Qt.ItemDataRole.AccessibleTextRole):
            return entry_text(entry)
        return None


class StoryFilter(QSortFilterProxyModel):
    """Leaves out rejected fragments on request."""

    def __init__(self, parent: QWidget) -> None:
        super().__init__(parent)
        self.shows_rejected = True

    def show_rejected(self, is_shown: bool) -> None:
        """Let rejected fragments through or leave them out."""
        self.shows_rejected = is_shown
        self.invalidate()

    def filterAcceptsRow(self, source_row: int, source_parent: QModelIndex | QPersistentModelIndex) -> bool:
        """Let an entry through unless it is rejected and left out."""
        entry: HistoryEntry = self.sourceModel().index(source_row, 0, source_parent).data(ENTRY_ROLE)
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


# How one event of a pixel's history is drawn: mark and title, three swatches with depth, the reason.


class EntryDelegate(QStyledItemDelegate):
    """Draws an entry in two lines: title and three swatches with depth, then mark and reason."""

    def sizeHint(self, option: QStyleOptionViewItem, index: QModelIndex | QPersistentModelIndex) -> QSize:
        """Title and values, below each other where the row is narrow, and as many lines as the reason takes."""
        entry: HistoryEntry = index.data(ENTRY_ROLE)
        lines = QFontMetrics(_text_font()).height() + 10
        if any((entry.before, entry.out, entry.after)) and is_stacked(option.rect.width()):
            lines += QFontMetrics(_text_font()).height() + 2
        return QSize(200, lines + (_reason_room(option.rect, entry).height() + 3 if entry.reason else 0))

    def paint(
        self, painter: QPainter, option: QStyleOptionViewItem, index: QModelIndex | QPersistentModelIndex
    ) -> None:
        """Draw ground, mark, title, values and reason."""
        theme = current_theme()
        entry: HistoryEntry = index.data(ENTRY_ROLE)
        box: QRect = option.rect
        ground = QColor(theme.window if index.row() % 2 else theme.panel)
        if option.state & QStyle.StateFlag.State_Selected:
            ground = QColor(theme.selection)
        painter.save()
        painter.fillRect(box, ground)
        if option.state & QStyle.StateFlag.State_Selected:
            painter.setPen(QColor(theme.text))
            painter.drawRect(box.adjusted(0, 0, -1, -1))
        text_height = QFontMetrics(_text_font()).height()
        top = box.top() + 5
        mark_side = text_height - 2
        if entry.mark is not None:
            draw_mark(painter, entry.mark, QRectF(box.left() + 7, top + 1, mark_side, mark_side))
        cells = value_columns(box)
        title = QRect(box.left() + 12 + mark_side, top, 0, text_height)
        values_top = top
        values = entry.before, entry.out, entry.after
        if is_stacked(box.width()) or not any(values):
            title.setRight(box.right() - 4)
            values_top += text_height + 2
        else:
            title.setRight(cells[0].left() - 3)
        font = _text_font()
        painter.setFont(font)
        painter.setPen(QColor(theme.text))
        painter.drawText(title, _LEFT, QFontMetrics(font).elidedText(entry.title, _ELIDE, title.width()))
        for cell, value in zip(cells, values, strict=True):
            if value is not None:
                place = QRect(cell.left(), values_top, cell.width(), text_height)
                self._paint_value(painter, place, value)
        if entry.reason:
            room = _reason_room(box, entry)
            room.moveTopLeft(QPoint(title.left(), box.bottom() - 4 - room.height()))
            painter.setFont(_small_font())
            painter.setPen(QColor(theme.muted_text))
            painter.drawText(room, Qt.TextFlag.TextWordWrap, entry.reason)
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
            text = exact_text(value.depth)
            painter.drawText(room, _LEFT, QFontMetrics(_small_font()).elidedText(text, _ELIDE, room.width()))


_LEFT = Qt.AlignmentFlag.AlignLeft | Qt.AlignmentFlag.AlignVCenter
_ELIDE = Qt.TextElideMode.ElideRight


def _reason_room(box: QRect, entry: HistoryEntry) -> QRect:
    """Return how much of a row's box its reason takes, wrapped."""
    width = box.width() - QFontMetrics(_text_font()).height() - 18
    metrics = QFontMetrics(_small_font())
    wrapped = metrics.boundingRect(QRect(0, 0, width, 10_000), Qt.TextFlag.TextWordWrap, entry.reason)
    return QRect(0, 0, width, wrapped.height())


def is_stacked(width: int) -> bool:
    """Return whether a row is too narrow for title and values on one line."""
    title = QFontMetrics(_text_font()).horizontalAdvance("Triangle 00")
    return width - 3 * _value_width(width) < title + 2 * QFontMetrics(_text_font()).height()


def value_columns(box: QRect) -> tuple[QRect, QRect, QRect]:
    """Return where Before, Out and After stand in a row: at the right, or across a row that is stacked."""
    width = _value_width(box.width())
    left = box.right() - 3 * width + 1
    if is_stacked(box.width()):
        left = box.left() + 12 + QFontMetrics(_text_font()).height() - 2
        width = min(width, (box.right() - left) // 3)
    cells = [QRect(left + k * width, box.top(), width - 4, box.height()) for k in range(3)]
    return cells[0], cells[1], cells[2]


def _value_width(width: int) -> int:
    # A depth in float32 needs eight digits to be told from its neighbours.
    figures = QFontMetrics(_small_font()).horizontalAdvance("0.00000000")
    least = figures + QFontMetrics(_text_font()).height() + 8
    return min(3 * least // 2, max(least, width // 5))


def _text_font() -> QFont:
    font = QFont(QGuiApplication.font())
    font.setPixelSize(current_theme().text_px)
    return font


def _small_font() -> QFont:
    font = QFont(QGuiApplication.font())
    font.setPixelSize(current_theme().small_px)
    font.setFeature(QFont.Tag("tnum"), 1)
    return font


class ValueHeader(QWidget):
    """The names over the three columns of values."""

    def __init__(self, view: QListView, parent: QWidget) -> None:
        super().__init__(parent)
        self._view = view

    def sizeHint(self) -> QSize:
        """One line of small text."""
        return QSize(200, QFontMetrics(_small_font()).height() + 6)

    def minimumSizeHint(self) -> QSize:
        """Never less than that line."""
        return self.sizeHint()

    def paintEvent(self, event: QPaintEvent) -> None:
        """Draw the names where the values stand."""
        painter = QPainter(self)
        painter.setFont(_small_font())
        painter.setPen(QColor(current_theme().muted_text))
        box = QRect(0, 0, self._view.viewport().width(), self.height())
        for cell, name in zip(value_columns(box), ("Before", "Out", "After"), strict=True):
            painter.drawText(cell, _LEFT, name)
        if not is_stacked(box.width()):
            painter.drawText(box.adjusted(8, 0, 0, 0), _LEFT, "Event")


# Everything that happened to one pixel: the verdict, then each event with before, out, after and reason.

HINT = "Point at a pixel, or click one, to see its history."
"""What an empty pane is for."""


class PixelHistory(QWidget):
    """Verdict, filter and rows; double click or Enter jumps to the row's step."""

    row_activated = Signal(int)
    """The user wants to go to an entry, by its number in the story (also when rejected ones are left out)."""
    rejected_toggled = Signal(bool)
    """The user shows (True) or leaves out (False) rejected fragments."""
    history_shown = Signal()
    """The pane has become visible, by its tab or with its page: it may be out of date."""

    def __init__(self, parent: QWidget | None = None) -> None:
        super().__init__(parent)
        self._story: PixelStory | None = None
        self.setProperty("role", "panel")
        self.setAttribute(Qt.WidgetAttribute.WA_StyledBackground)
        self._model = StoryModel(self)
        self._filter = StoryFilter(self)
        self._filter.setSourceModel(self._model)
        self._icon = QLabel(self)
        self.verdict = text_label("", self, role="strong", name="Verdict", wraps=True, is_selectable=True)
        self.place = text_label("", self, role="muted", wraps=True)
        self.rejected_box = QCheckBox("Show rejected", self)
        self.rejected_box.setChecked(True)
        self.rejected_box.setToolTip("Also show rejected fragments")
        self.rejected_box.setFocusPolicy(Qt.FocusPolicy.TabFocus)
        self.rejected_box.toggled.connect(self._filter.show_rejected)
        self.rejected_box.clicked.connect(self.rejected_toggled)
        self.view = QListView(self, resizeMode=QListView.ResizeMode.Adjust)
        self.view.setModel(self._filter)
        self.view.setItemDelegate(EntryDelegate(self.view))
        self.view.setAccessibleName("Pixel history")
        self.view.setVerticalScrollMode(QAbstractItemView.ScrollMode.ScrollPerPixel)
        self.view.setEditTriggers(QAbstractItemView.EditTrigger.NoEditTriggers)
        self.view.setHorizontalScrollBarPolicy(Qt.ScrollBarPolicy.ScrollBarAlwaysOff)
        KeyClaim(self.view, (Qt.Key.Key_Up, Qt.Key.Key_Down, Qt.Key.Key_Home, Qt.Key.Key_End))
        self.view.activated.connect(self._activate)
        self.view.clicked.connect(self._activate)
        copy = QAction("Copy with full precision", self.view)
        copy.setShortcut(QKeySequence(QKeySequence.StandardKey.Copy))
        copy.setShortcutContext(Qt.ShortcutContext.WidgetShortcut)
        copy.triggered.connect(self._copy)
        self.view.addAction(copy)
        self.view.setContextMenuPolicy(Qt.ContextMenuPolicy.ActionsContextMenu)
        self._header = ValueHeader(self.view, self)
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
    def show_story(self, story: PixelStory | None, hint: str = HINT) -> None:
        """Show the history of a pixel, or the hint why the pane is empty."""
        self._story = story
        entries = story.entries if story else ()
        self._model.show_entries(entries)
        self.verdict.setText(story.verdict if story else hint)
        is_hint = story is None
        set_role(self.verdict, "muted" if is_hint else "strong")
        for part in (self.view, self._header):
            part.setVisible(bool(entries))
        rejected = sum(entry.is_rejected for entry in entries)
        self.rejected_box.setVisible(rejected > 0)
        self.rejected_box.setText(f"Show rejected ({rejected})")
        self.place.setVisible(not is_hint)
        if story:
            self.place.setText(f"Pixel column {story.column}, row {story.row}")
        self._follow_theme()

    def showEvent(self, event: QShowEvent) -> None:
        """Tell that the pane is in sight."""
        super().showEvent(event)
        self.history_shown.emit()

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
                "\n".join(entry_text(index.data(ENTRY_ROLE)) for index in indexes)
            )

    @Slot()
    def _follow_theme(self) -> None:
        mark = self._story.mark if self._story else None
        self._icon.setVisible(mark is not None)
        if mark is not None:
            side = current_theme().text_px + 3
            self._icon.setPixmap(mark_pixmap(mark, side, self.devicePixelRatioF()))
            self._icon.setToolTip(mark.value)
        self.view.viewport().update()
        self._header.update()
