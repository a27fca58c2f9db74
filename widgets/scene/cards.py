"""Scenes as cards: a picture, a title and a sentence; a click or Return opens one, arrows walk."""

from collections.abc import Mapping, Sequence, Set
from dataclasses import dataclass
from itertools import groupby

from PySide6.QtCore import QEvent, QPoint, QRect, QSize, Qt, Signal, Slot
from PySide6.QtGui import (
    QColor,
    QImage,
    QKeyEvent,
    QPainter,
    QPaintEvent,
    QResizeEvent,
)
from PySide6.QtWidgets import QWidget

from core.records.words import has_words
from widgets.basics.accessibility import ArrowGroup, give_focus
from widgets.basics.card import GAP, SPACING, Card
from widgets.basics.controls import FlowLayout, column_layout, text_label
from widgets.basics.theme import current_theme, theme_notifier

PICTURE = QSize(64, 48)
"""Logical pixels of a picture at a text size of 13, times 3 or 4: a teaching raster keeps square pixels."""
SIZES = (3, 4)
MANY = 5
"""Cards in a row that the larger pictures leave room for."""
STEPS = {Qt.Key.Key_Left: (-1, 0), Qt.Key.Key_Right: (1, 0), Qt.Key.Key_Up: (0, -1), Qt.Key.Key_Down: (0, 1)}
"""Columns and rows that an arrow goes."""
CENTERED = int(Qt.AlignmentFlag.AlignCenter) | int(Qt.TextFlag.TextWordWrap)


@dataclass(frozen=True)
class SceneEntry:
    """One scene."""

    name: str
    title: str
    description: str


class SceneCard(Card):
    """A button with a picture, which may come later."""

    def __init__(self, entry: SceneEntry, parent: QWidget | None = None) -> None:
        super().__init__(entry.name, (entry.title, entry.description), (*STEPS, Qt.Key.Key_Space), parent)
        self.entry = entry
        self._image: QImage | None = None
        self._hidden = ""
        """Why the picture is hidden; empty: it is not."""
        self._size = SIZES[0]
        self.setAccessibleDescription(entry.description)
        self.setToolTip(entry.description)

    @Slot(QImage)
    def show_picture(self, image: QImage) -> None:
        """Show the picture of the scene."""
        self._image = image
        self.update()

    def hide_picture(self, why: str) -> None:
        """Show these words in place of the picture; none: the picture."""
        if why != self._hidden:
            self._hidden = why
            self.setAccessibleDescription(f"{self.entry.description} {why}".strip())
            self.update()

    def set_size(self, size: int) -> None:
        """Show the picture so many times as large as `PICTURE`."""
        self._size = size

    def has_picture(self) -> bool:
        """Return whether its picture is there."""
        return self._image is not None

    def sizeHint(self) -> QSize:
        """Return the size of picture, title and sentence; the parent gives a group the height of its highest."""
        text = sum(self.text_heights(self._picture_size().width()))
        return QSize(self._picture_size().width() + 2 * GAP, self._picture_size().height() + text + 3 * GAP)

    def paintEvent(self, event: QPaintEvent) -> None:
        """Paint the card, with a frame where it has the keyboard or the pointer."""
        theme = current_theme()
        with QPainter(self) as painter:
            self.paint_card(painter)
            picture = QRect(GAP, GAP, self._picture_size().width(), self._picture_size().height())
            painter.fillRect(picture, QColor(theme.canvas))
            if self._hidden:
                painter.setPen(QColor(theme.muted_text))
                painter.drawText(picture.adjusted(GAP, GAP, -GAP, -GAP), CENTERED, self._hidden)
            elif self._image is not None:
                # Pixels of a small raster stay squares; a large picture is made smaller smoothly.
                is_small = self._image.width() < picture.width()
                painter.setRenderHint(QPainter.RenderHint.SmoothPixmapTransform, not is_small)
                size = self._image.size().scaled(picture.size(), Qt.AspectRatioMode.KeepAspectRatio)
                shown = QRect(QPoint(), size)
                shown.moveCenter(picture.center())
                painter.drawImage(shown, self._image)
            text = picture.translated(0, picture.height() + GAP // 2)
            text.setBottom(self.height())
            self.paint_texts(painter, text, self.text_heights(picture.width())[0])

    def _picture_size(self) -> QSize:
        return PICTURE * (self._size * current_theme().text_px / 13)


class SceneCards(QWidget):
    """All cards, group by group below its title, as many in a row as fit."""

    scene_chosen = Signal(str)
    """Name of a scene."""

    def __init__(self, parent: QWidget | None = None) -> None:
        super().__init__(parent)
        self.cards: list[SceneCard] = []
        self._groups: list[tuple[QWidget, QWidget, list[SceneCard]]] = []
        """Title, what holds the cards below it, and they."""
        self._column = column_layout(self, 8)
        self.setAccessibleName("Scenes")

    def show_scenes(self, groups: Mapping[str, Sequence[SceneEntry]]) -> None:
        """Make a card for each scene: the title of a group, which is one stop of Tab, to its scenes."""
        for title, entries in groups.items():
            group = QWidget(self, accessibleName=title)
            flow = FlowLayout(group, SPACING)
            if self.cards:
                self._column.addSpacing(SPACING)
            heading = text_label(title, self, role="title", wraps=True)
            self._column.addWidget(heading)
            self._column.addWidget(group)
            cards = [SceneCard(entry, group) for entry in entries]
            self._groups.append((heading, group, cards))
            ArrowGroup(cards, group)
            for card in cards:
                card.clicked.connect(self._choose)
                card.installEventFilter(self)
                flow.addWidget(card)
            self.cards += cards
        theme_notifier().theme_changed.connect(self._fit)

    def resizeEvent(self, event: QResizeEvent) -> None:
        """Choose the size of the pictures."""
        super().resizeEvent(event)
        self._fit()

    @Slot()
    def _fit(self) -> None:
        """Take the larger pictures where there is room, and make the cards of a group as high as its highest."""
        small, large = SIZES
        scale = current_theme().text_px / 13
        width = MANY * (large * PICTURE.width() * scale + 2 * GAP + SPACING)
        for card in self.cards:
            card.set_size(large if width <= self.width() else small)
        for _, cards in groupby(self.cards, QWidget.parentWidget):
            sizes = [(card, card.sizeHint()) for card in cards]
            height = max(size.height() for _, size in sizes)
            for card, size in sizes:
                card.setFixedSize(size.width(), height)

    def show_only(self, words: Sequence[str]) -> int:
        """Leave out the scenes that do not have all ``words`` in their texts; return how many are left."""
        count = 0
        for heading, group, cards in self._groups:
            found = [
                has_words(words, card.entry.title, card.entry.description, card.entry.name) for card in cards
            ]
            for card, is_found in zip(cards, found, strict=True):
                card.setHidden(not is_found)
            for widget in (heading, group):
                widget.setVisible(any(found))
            count += sum(found)
        return count

    def show_picture(self, name: str, image: QImage) -> None:
        """Show the picture of a scene by its name."""
        next(card for card in self.cards if card.entry.name == name).show_picture(image)

    def next_without_picture(self, top: int, height: int) -> str:
        """Return the scene nearest to a part in sight that has no picture yet; empty: none up to half of it away."""
        far = {}
        for card in self.cards:
            if not (card.has_picture() or card.isHidden()):
                y = card.mapTo(self, QPoint()).y()
                far[card.entry.name] = max(y - top - height, top - y - card.height(), 0)
        name = min(far, key=far.__getitem__, default="")
        return name if far and far[name] <= height // 2 else ""

    def hide_pictures(self, names: Set[str], why: str) -> None:
        """Show words in place of the pictures of these scenes, and of no others."""
        for card in self.cards:
            card.hide_picture(why if card.entry.name in names else "")

    def eventFilter(self, watched: object, event: QEvent) -> bool:
        """Go with an arrow to the card on that side; Qt would go to the next in the order of Tab."""
        if isinstance(event, QKeyEvent) and event.type() == QEvent.Type.KeyPress and watched in self.cards:
            step = STEPS.get(Qt.Key(event.key()))
            if step is not None:
                card = self._beside(self.cards.index(watched), *step)
                if card is not None:
                    give_focus(card)
                return True
        return False

    def _beside(self, index: int, columns: int, rows: int) -> SceneCard | None:
        """Return the card before or after one, or the nearest in the row above or below it; ``None``: there is none."""
        shown = [k for k, card in enumerate(self.cards) if not card.isHidden()]
        if columns:
            place = shown.index(index) + columns
            return self.cards[shown[place]] if 0 <= place < len(shown) else None
        places = [card.mapTo(self, QPoint()) for card in self.cards]
        here = places[index]
        others = [k for k in shown if (places[k].y() - here.y()) * rows > 0]
        nearest = min(
            others, key=lambda k: (abs(places[k].y() - here.y()), abs(places[k].x() - here.x())), default=None
        )
        return None if nearest is None else self.cards[nearest]

    @Slot()
    def _choose(self) -> None:
        self.scene_chosen.emit(self.sender().objectName())
