"""The page that charts speed against accuracy."""

from PySide6.QtWidgets import QLabel, QVBoxLayout, QWidget

from app.pages import Page
from app.session import Session


class ComparePage(Page):
    """Under way."""

    def __init__(self, session: Session, parent: QWidget | None = None) -> None:
        super().__init__(parent)
        layout = QVBoxLayout(self)
        layout.addWidget(QLabel("Speed against accuracy", self))
