"""A layout that fills one line after another, as text does: controls keep their sizes in a narrow window."""

from PySide6.QtCore import QPoint, QRect, QSize, Qt
from PySide6.QtWidgets import QLayout, QLayoutItem, QWidget


class FlowLayout(QLayout):
    """Places items from left to right and begins a new line where the next does not fit."""

    def __init__(self, parent: QWidget | None = None, spacing: int = 8, is_spread: bool = False) -> None:
        """Make an empty layout; ``is_spread``: the last item of several on a line stands at its right end."""
        super().__init__(parent)
        self._items: list[QLayoutItem] = []
        self._heights: dict[int, int] = {}
        """By width, as long as nothing in it has changed."""
        self._is_spread = is_spread
        self.setSpacing(spacing)
        self.setContentsMargins(0, 0, 0, 0)

    def addItem(self, item: QLayoutItem) -> None:
        """Take an item; Qt calls this."""
        self._items.append(item)

    def insert_widget(self, index: int, widget: QWidget) -> None:
        """Take a widget before the item of an index."""
        self.addWidget(widget)
        self._items.insert(index, self._items.pop())
        self.invalidate()

    def count(self) -> int:
        """Return the number of items."""
        return len(self._items)

    def itemAt(self, index: int) -> QLayoutItem:
        """Return an item; ``None`` beyond the last."""
        return self._items[index] if 0 <= index < len(self._items) else None  # type: ignore[return-value]

    def takeAt(self, index: int) -> QLayoutItem:
        """Remove an item and return it; ``None`` beyond the last."""
        return self._items.pop(index) if 0 <= index < len(self._items) else None  # type: ignore[return-value]

    def expandingDirections(self) -> Qt.Orientation:
        """Take no more room than is needed."""
        return Qt.Orientation(0)

    def hasHeightForWidth(self) -> bool:
        """Say that a narrower layout is a higher one."""
        return True

    def heightForWidth(self, width: int) -> int:
        """Return the height of all lines."""
        if width not in self._heights:
            self._heights[width] = self._place(QRect(0, 0, width, 0), is_only_measured=True)
        return self._heights[width]

    def invalidate(self) -> None:
        """Forget what was measured; Qt calls this."""
        self._heights.clear()
        super().invalidate()

    def setGeometry(self, rect: QRect) -> None:
        """Place the items."""
        super().setGeometry(rect)
        self._place(rect, is_only_measured=False)

    def sizeHint(self) -> QSize:
        """Return the size of all items on one line."""
        sizes = [item.sizeHint() for item in self._items if not item.isEmpty()]
        width = sum(size.width() for size in sizes) + self.spacing() * max(len(sizes) - 1, 0)
        return QSize(width, max((size.height() for size in sizes), default=0))

    def minimumSize(self) -> QSize:
        """Return the size of the largest item."""
        size = QSize()
        for item in self._items:
            size = size.expandedTo(item.minimumSize())
        return size

    def _place(self, rect: QRect, is_only_measured: bool) -> int:
        """Go through the lines; return their height."""
        x, y, line_height = rect.x(), rect.y(), 0
        line: list[tuple[QLayoutItem, int, QSize]] = []
        for item in self._items:
            if item.isEmpty():
                continue
            size = item.sizeHint()
            if line and x + size.width() > rect.right() + 1:
                self._set_line(line, rect, y, line_height, is_only_measured)
                x, y, line_height, line = rect.x(), y + line_height + self.spacing(), 0, []
            line.append((item, x, size))
            x += size.width() + self.spacing()
            line_height = max(line_height, size.height())
        self._set_line(line, rect, y, line_height, is_only_measured)
        return y + line_height - rect.y()

    def _set_line(
        self,
        line: list[tuple[QLayoutItem, int, QSize]],
        rect: QRect,
        y: int,
        height: int,
        is_only_measured: bool,
    ) -> None:
        """Place the items of one line, centred on it."""
        for place, (item, x, size) in enumerate(line if not is_only_measured else ()):
            is_at_end = self._is_spread and 0 < place == len(line) - 1
            left = rect.right() + 1 - size.width() if is_at_end else x
            item.setGeometry(QRect(QPoint(left, y + (height - size.height()) // 2), size))
