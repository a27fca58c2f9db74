"""What a window is made of: its parts reach each other through it, and know no more of it than this."""

from abc import abstractmethod

from PySide6.QtWidgets import QMainWindow

from app.pages.page_bar import Pages
from app.pages.step.page import StepPage
from app.session.document_edits import DocumentEdits
from app.session.session import Session
from app.window.appearance import Appearance
from app.window.export_desk import ExportActions
from app.window.file_desk import FileActions
from app.window.menus import Menus
from app.window.notices import Notices
from app.window.overlays import Overlays
from widgets.basics.message_bar import MessageBar


class WindowParts(QMainWindow):
    """One session, the pages around it, and what is around the pages."""

    session: Session
    pages: Pages
    page: StepPage
    messages: MessageBar
    notices: Notices
    menus: Menus
    appearance: Appearance
    edits: DocumentEdits
    overlays: Overlays
    files: FileActions
    exports: ExportActions

    @abstractmethod
    def run_action(self, name: str) -> None:
        """Do an action of the table of actions."""

    @abstractmethod
    def open_path(self, path: str, allows_outside: bool = False) -> None:
        """Open a scene or a state, or what a page knows how to show, on that page."""

    @abstractmethod
    def show_printed(self, name: str) -> None:
        """Show the right method in A, and a listing as a slide prints it in B."""
