"""One texture view, or two side by side: the mipmap levels that a pixel reads."""

from PySide6.QtWidgets import QWidget

from widgets.basics.controls import row_layout
from widgets.space.texture_picture import TexturePicture
from widgets.space.texture_view import TextureView

GAP = 4
"""Logical pixels between the views."""


class TextureLevels(QWidget):
    """Shows a texture, or the finer level on the left and the coarser one on the right; each has its own view."""

    def __init__(self, parent: QWidget | None = None) -> None:
        super().__init__(parent)
        self._views = TextureView(), TextureView()
        layout = row_layout(self, GAP)
        for view in self._views:
            layout.addWidget(view)
        self.setAccessibleName("Texture space")
        self._views[1].setAccessibleName("Texture space, coarser level")
        self._views[1].hide()
        self.setFocusProxy(self._views[0])

    def views(self) -> tuple[TextureView, TextureView]:
        """Return the views of the finer and of the coarser level."""
        return self._views

    def pictures(self) -> tuple[TexturePicture, ...]:
        """Return what is shown."""
        found = (view.picture() for view in self._views)
        return tuple(picture for picture in found if picture is not None)

    def show_pictures(self, pictures: tuple[TexturePicture, ...], empty_text: str) -> None:
        """Show one texture, or two levels; of none, the empty text."""
        for place, view in enumerate(self._views):
            view.empty_text = empty_text
            view.show_picture(pictures[place] if place < len(pictures) else None)
        self._views[1].setVisible(len(pictures) > 1)
        captions = " ".join(picture.caption for picture in pictures)
        self.setAccessibleDescription(captions if pictures else empty_text)
