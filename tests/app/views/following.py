"""Shows each moment of a session in views that stand alone, as the page does in the window."""

from PySide6.QtCore import QObject, Slot

from app.session.moment import Change
from app.session.session import Session
from app.views.stage_views import StageViews


class Following(QObject):
    """Ends with the views."""

    def __init__(self, session: Session, views: StageViews) -> None:
        super().__init__(views)
        self._session, self._views = session, views
        session.changed.connect(self._show)

    @Slot(Change)
    def _show(self, what: Change) -> None:
        self._views.refresh(self._session.moment)
