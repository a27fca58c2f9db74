"""The pages of the window and the bar that chooses among them."""

from collections.abc import Callable
from dataclasses import dataclass
from typing import TYPE_CHECKING

from PySide6.QtCore import QByteArray, QEvent, Qt, Signal, Slot
from PySide6.QtGui import QResizeEvent
from PySide6.QtWidgets import QApplication, QSplitter, QStackedWidget, QTabBar, QWidget

from app.background import Job, end_work
from app.pages.cover import Cover
from app.session.moment import Change
from app.session.session import Session
from core.explain.records import Formula
from core.settings import Settings
from widgets.basics.accessibility import GIVEN_BACK, first_stop
from widgets.basics.controls import column_layout, row_layout
from widgets.basics.message_bar import Progress

if TYPE_CHECKING:
    from app.files.preferences import Preferences
    from core.edits.edit import Edit
    from core.scene import AnyScene
    from core.study.record import Opening


# The pages of the window and the bar that chooses among them; a page is made when it is first shown.


@dataclass(frozen=True, eq=False)
class StepRequest:
    """What another page wants to see on the Step page."""

    opening: "Opening"
    title: str
    other: Settings | None = None
    """Settings of B, for A | B; ``None``: only A is shown."""
    triangle: int | None = None
    """The triangle to be stepped, where there are too many to step all; ``None``: the one that is seen at the pixel."""
    other_scene: "AnyScene | None" = None
    """What B draws, of the same size; ``None``: what A does."""
    other_title: str = ""
    """What B is called, where it is a run that no settings can name."""
    edits: "tuple[Edit, ...]" = ()
    """Edited listings that B runs, in A | B; the user can go on editing them."""
    hides_right: bool = False
    """Whether the listings as they are stay hidden: an exercise still asks for them."""
    position: int | None = None
    """Steps of the stage that are done; ``None``: those up to the pixel, or none."""
    is_asked: bool | None = None
    """Whether an exercise asks for it, so that it is hidden as while predicting; ``None``: as it is now."""


@dataclass(frozen=True)
class Caption:
    """What a page says of its main view."""

    sentence: str = ""
    formula: Formula | None = None


def percent_done(fraction: float | None, doing: str) -> Progress:
    """Return what is told of a job that has done a fraction of its work; ``None``: nobody knows how much."""
    return Progress(doing, 0, 0) if fraction is None else Progress(doing, round(100 * fraction), 100)


class Page(QWidget):
    """One page of the window. What it does not say otherwise, a page does not do."""

    read: QWidget | None = None
    """The column at its right that is read while a message is shown, which floats beside it; ``None``: none is."""
    message_sent = Signal(str)
    """Information for the user; nothing is wrong."""
    edit_refused = Signal(str)
    """Why what was asked for came to nothing."""
    went_well = Signal()
    """A file was opened or saved: what was refused before is of no interest any more."""
    step_requested = Signal(object)
    """A `StepRequest`: the user wants to step something that this page shows."""

    question_requested = Signal(str)
    """The line of a question that the Exercises page is to ask."""

    work_progressed = Signal(object)
    """A ``Progress``: how far the work of this page has come; ``None``: it does none any more."""

    open_requested = Signal(str)
    """A file or built-in scene that is to be opened."""

    help_requested = Signal(str)
    """Address of a page of Help, as ``family/fill``."""

    lesson_requested = Signal(str, int)
    """Name and step, from 0, of a lesson that is to be opened."""

    link_requested = Signal(str)
    """What is to be opened, as links of Help say it: ``exercise/shared-edge``."""

    preference_changed = Signal(str, object)
    """Name and value of a field of ``app.files.saved_windows.Preferences`` that the user has changed."""

    action_requested = Signal(str)
    """Name of an action of ``app.window.actions.ACTIONS`` that is another page's, or shows another page."""

    def follow(self, job: Job) -> None:
        """Show how far a job of the page has come, until it has ended."""
        job.progressed.connect(self._tell_progress)
        job.ended.connect(self._tell_end)

    @Slot(object, str)
    def _tell_progress(self, fraction: float | None, doing: str) -> None:
        self.work_progressed.emit(percent_done(fraction, doing))

    @Slot()
    def _tell_end(self) -> None:
        self.work_progressed.emit(None)

    def tell(self, text: str) -> None:
        """Tell the user something; nothing is wrong."""
        self.message_sent.emit(text)

    def tell_done(self, text: str) -> None:
        """Tell that something went well: what was refused before is of no interest any more."""
        self.went_well.emit()
        self.message_sent.emit(text)

    def refuse(self, text: str) -> None:
        """Say why what was asked for came to nothing."""
        self.edit_refused.emit(text)

    def step_to(self, request: StepRequest) -> None:
        """Show something on the Step page."""
        self.step_requested.emit(request)

    def undo(self) -> bool:
        """Take an edit of the page itself back; return whether it has a history of its own."""
        return False

    def redo(self) -> bool:
        """Do it again; return whether the page has a history of its own."""
        return False

    def export_view(self) -> bool:
        """Ask where to export what the page draws; return whether it does so itself."""
        return False

    def copy_view(self) -> bool:
        """Copy what the page draws; return whether it does so itself."""
        return False

    def dismiss(self) -> bool:
        """Close what is on top or stop what runs (Escape); return whether there was anything."""
        return False

    def is_busy(self) -> bool:
        """Return whether something runs that Escape would stop."""
        return False

    def main_view(self) -> QWidget:
        """Return what is exported and copied as "the view"."""
        return self

    def settle(self) -> None:
        """Wait until everything that is drawn a moment later is there."""

    def caption(self) -> Caption:
        """Return what can be exported and printed with the view."""
        return Caption()

    def take_focus(self) -> None:
        """Give the keyboard to what the page begins with."""
        first = self.focusProxy() or first_stop([self.main_view(), self]) or self
        by_mouse = QApplication.mouseButtons() != Qt.MouseButton.NoButton
        first.setFocus(Qt.FocusReason.MouseFocusReason if by_mouse else GIVEN_BACK)

    def first_pane(self) -> QWidget:
        """Return what F6 and Tab begin with: the main view, or a part of it."""
        return self.main_view()

    def focus_panes(self) -> list[QWidget]:
        """Return what F6 goes through after that, each with a name; Tab takes the same way."""
        return [self]

    def open_path(self, path: str) -> None:
        """Show a file that has one of the endings of this page."""
        self.edit_refused.emit(f"This page cannot show {path}.")

    def resume(self) -> None:
        """Show what was shown when the program ended, before anything else is."""

    def show_preferences(self, preferences: "Preferences") -> None:
        """Show what the program remembers, as far as the page does."""

    def keep_results(self) -> None:
        """Show the results of the last start of the window, and keep those that come for the next one."""

    def set_presenting(self, is_presenting: bool) -> None:
        """Leave out what an audience does not need, or bring it back."""

    def show_way_back(self, is_shown: bool, task: str = "") -> None:
        """Offer to go back to the lesson that is open on the Step page; ``task``: what its step asks on this page."""

    def leave(self) -> None:
        """Stop what nobody sees: another page is shown now."""

    def stop(self) -> None:
        """End all work: the window closes."""
        end_work(self)

    def splitters(self) -> dict[str, QSplitter]:
        """Return what divides the panes, by names that no other page uses."""
        return {}

    def layout_state(self) -> dict[str, str]:
        """Return sizes of panes as texts, by names that no other page uses."""
        return {
            name: splitter.saveState().toBase64().toStdString() for name, splitter in self.splitters().items()
        }

    def restore_layout(self, state: dict[str, str]) -> None:
        """Give panes the sizes that they had."""
        for name, splitter in self.splitters().items():
            if name in state:
                splitter.restoreState(QByteArray.fromBase64(state[name].encode("ascii")))


@dataclass(frozen=True)
class PageKind:
    """A page as the bar offers it."""

    name: str
    """Its actions have this ``page``; ``page_NAME`` is the action that shows it."""
    title: str
    tip: str
    make: Callable[[Session, QWidget], Page]
    """Called when it is first shown; imports what only this page needs."""
    endings: tuple[str, ...] = ()
    """Files with these endings are shown on this page, not opened as scenes; lower case."""
    signature: bytes = b""
    """Stands at the beginning of its files, where another page has files of the same ending."""
    hides_itself: bool = False
    """Whether it hides by itself what an exercise asks about."""


LEAST_MESSAGE_PX = 320
"""Room beside what is read from which on messages keep to it."""


class Pages(QWidget):
    """The bar of pages, what stands under it for all of them, and the page that is shown."""

    page_made = Signal(object)
    """A `Page`, shown for the first time."""
    page_changed = Signal(str)
    """Name of the page that is shown now."""

    def __init__(
        self,
        kinds: tuple[PageKind, ...],
        session: Session,
        hints: QWidget,
        messages: QWidget,
        first: str,
        parent: QWidget | None = None,
    ) -> None:
        """Show the page ``first``, with hints beside the bar; messages float over both: they move no page."""
        super().__init__(parent)
        self._kinds, self._session = kinds, session
        self._made: dict[str, Page] = {}
        self.bar = QTabBar(self, drawBase=False, expanding=False)
        self.bar.setAccessibleName("Pages")
        self.bar.setFocusPolicy(
            Qt.FocusPolicy.NoFocus
        )  # Its keys are actions; the arrows belong to the page.
        self._stack = QStackedWidget(self)
        self.cover = Cover(self)
        self._stack.addWidget(self.cover)
        session.changed.connect(self._follow)
        for kind in kinds:
            index = self.bar.addTab(kind.title)
            self.bar.setTabToolTip(index, kind.tip)
        self._row = QWidget(self)
        row = row_layout(self._row, margins=(8, 0, 8, 0))
        row.addWidget(self.bar)
        row.addWidget(hints, 1)
        layout = column_layout(self, 0)
        layout.addWidget(self._row)
        layout.addWidget(self._stack, 1)
        self._messages = messages
        messages.setParent(self)
        messages.installEventFilter(self)
        self.bar.setCurrentIndex(self.names.index(first))
        self._show_index(self.bar.currentIndex())
        self.bar.currentChanged.connect(self._show_index)

    def eventFilter(self, watched: object, event: QEvent) -> bool:
        """Give a message as much height as it needs, when it comes and while it grows."""
        if watched is self._messages and event.type() in (QEvent.Type.Show, QEvent.Type.LayoutRequest):
            self._place_messages()
        return False

    def resizeEvent(self, event: QResizeEvent) -> None:
        """Keep the messages inside."""
        super().resizeEvent(event)
        self._place_messages()

    def _place_messages(self) -> None:
        """Let messages float right of the bar, beside what the page wants to be read meanwhile if both have room."""
        left = self.bar.geometry().right() + 12
        page = self._made.get(self.current_name)
        free = self.width() - left - 8
        read = None if page is None else page.read
        beside = free - (0 if read is None or read.isHidden() else read.width())
        width = beside if beside >= LEAST_MESSAGE_PX else max(free, 1)
        self._messages.setGeometry(left, 0, width, self._messages.heightForWidth(width))
        self._messages.raise_()

    @property
    def current(self) -> Page:
        """The page that is shown."""
        return self._made[self.current_name]

    def file_stem(self) -> str:
        """Return what a picture of the page is called: by the scene and its stage, or by the scene and the page."""
        name, moment = self.current_name, self._session
        return f"{moment.document.file_stem}-{moment.cursor.stage if name == 'step' else name}"

    @property
    def current_name(self) -> str:
        """Its name."""
        return self._kinds[self.bar.currentIndex()].name

    @property
    def is_covered(self) -> bool:
        """Whether the page is hidden, for an exercise asks about the scene that it shows."""
        return self._session.is_asked_about and not self._kinds[self.bar.currentIndex()].hides_itself

    def is_made(self, name: str) -> bool:
        """Return whether a page has been made."""
        return name in self._made

    @property
    def names(self) -> list[str]:
        """Names of all pages in the order of the bar."""
        return [kind.name for kind in self._kinds]

    @property
    def made(self) -> tuple[Page, ...]:
        """The pages that have been shown so far."""
        return tuple(self._made.values())

    def page(self, name: str) -> Page:
        """Return a page by its name, made if need be."""
        if name not in self._made:
            kind = next(kind for kind in self._kinds if kind.name == name)
            # At once where it stays: to give all that it holds another parent takes 20 ms.
            page = kind.make(self._session, self._stack)
            self._made[name] = page
            page.work_progressed.connect(self._show_work)
            self._stack.addWidget(page)
            self.page_made.emit(page)
        return self._made[name]

    def show_page(self, name: str) -> None:
        """Show a page by its name; a name that no page has shows nothing else."""
        if name in self.names:
            self.bar.setCurrentIndex(self.names.index(name))

    def show_bar(self, is_shown: bool) -> None:
        """Show the row of names above the pages, or give its room to the page."""
        self._row.setVisible(is_shown)

    def show_next(self, direction: int) -> None:
        """Show the page to the right (1) or to the left (-1), round and round."""
        self.bar.setCurrentIndex((self.bar.currentIndex() + direction) % self.bar.count())

    @Slot(object)
    def _show_work(self, progress: Progress | None) -> None:
        """Write beside the name of a page how far its work is, for those who look at another page."""
        name = next(name for name, page in self._made.items() if page is self.sender())
        index = self.names.index(name)
        title = self._kinds[index].title
        if progress is not None:
            done = f"{100 * progress.done // progress.total} %" if progress.total else "…"
            title = f"{title} {done}"
        self.bar.setTabText(index, title)

    @Slot(int)
    def _show_index(self, index: int) -> None:
        self._place()
        if self.isVisible() and self.is_covered:
            self.cover.setFocus()
        elif self.isVisible():
            self.current.take_focus()
        self._place_messages()
        self.page_changed.emit(self._kinds[index].name)

    @Slot(Change)
    def _follow(self, what: Change) -> None:
        if Change.ASKED in what:
            self._place()

    def _place(self) -> None:
        """Show the page of the bar, or its cover."""
        before, page = self._stack.currentWidget(), self.page(self.current_name)
        shown = self.cover if self.is_covered else page
        if self.is_covered:
            self.cover.show_asker(self._session.asker)
        if isinstance(before, Page) and before is not shown:
            before.leave()
        self._stack.setCurrentWidget(shown)
