"""What a window remembers from one start to the next: its place, panes and choices, and what is open."""

import sys
from collections.abc import Sequence
from pathlib import Path

from PySide6.QtCore import QByteArray, QObject, Signal, Slot

from app.files.file_dialogs import keep_folder, last_folder
from app.files.preferences import Preferences, save_preferences, with_recent_file
from app.files.saved_windows import Autosave
from app.files.state_scenes import StateFileError
from app.pages.page_bar import Page
from app.window.appearance import DESK_THEMES
from app.window.keys import KeyAction, KeyChoices, choices_from
from app.window.parts import WindowParts
from core.records.steps import Level


class Remembering(QObject):
    """Holds the preferences of a window, and saves them and what is open."""

    recent_changed = Signal(object)
    """The files that were open last: a list of paths."""

    def __init__(self, window: WindowParts, preferences: Preferences) -> None:
        super().__init__(window)
        self.preferences = preferences
        page = window.page
        places = page.stepping.places_changed, page.lessons.place_changed
        edits = page.look_changed, page.panes_changed, page.editing.drafts_changed, *places
        self.autosave = Autosave(window.session, window.files.kept_state, edits, self)
        self._keeps_results = False

    def restore(self, window: WindowParts) -> None:
        """Put window and panes where they were left, and keep results from this start to the next."""
        self._keeps_results = True
        keep_folder(self.preferences.folder)
        window.restoreGeometry(QByteArray.fromBase64(self.preferences.geometry.encode()))
        window.appearance.set_text_size(self.preferences.text_size)
        for page in window.pages.made:
            self.restore_page(page)
        window.page.show_panes(self.preferences.shown_panes)
        window.page.inspector.set_folded(self.preferences.folded_cards)
        window.page.settings_panel.show_more(self.preferences.shows_all_methods)
        window.page.timeline.show_speed(self.preferences.speed)
        window.session.set_level(Level(self.preferences.level))
        window.pages.show_page(self.preferences.page)

    @Slot(object)
    def restore_page(self, page: Page) -> None:
        """Give the panes of a page the sizes that they had."""
        page.restore_layout(self.preferences.layout)
        if self._keeps_results:
            page.keep_results()

    @Slot(float)
    def remember_speed(self, speed: float) -> None:
        """Keep how fast it plays."""
        self.preferences = self.preferences.model_copy(update={"speed": speed})

    @Slot(str, object)
    def remember(self, name: str, value: object) -> None:
        """Keep a preference by its name."""
        self.preferences = self.preferences.model_copy(update={name: value})

    def key_choices(self, actions: Sequence[KeyAction]) -> KeyChoices:
        """Return the keys that were chosen in earlier windows."""
        return choices_from(self.preferences.keys, self.preferences.has_character_keys, actions)

    def remember_keys(self, choices: KeyChoices) -> None:
        """Keep which keys do what."""
        keys = {name: list(keys) for name, keys in choices.changed.items()}
        update = {"keys": keys, "has_character_keys": choices.has_characters}
        self.preferences = self.preferences.model_copy(update=update)

    @Slot(str)
    def remember_theme(self, name: str) -> None:
        """Keep the theme; a presenter's goes with its arrangement."""
        if name in DESK_THEMES:
            self.preferences = self.preferences.model_copy(update={"theme": name})

    @Slot(int)
    def remember_text_size(self, percent: int) -> None:
        """Keep the size of the text."""
        self.preferences = self.preferences.model_copy(update={"text_size": percent})

    @Slot(str)
    def remember_file(self, path: str) -> None:
        """Keep a file among those that were open last, and its folder for the next question."""
        self.preferences = with_recent_file(self.preferences, path)
        keep_folder(str(Path(self.preferences.recent_files[0]).parent))
        self.recent_changed.emit(self.preferences.recent_files)

    def save_open(self, is_last_chance: bool) -> str:
        """Save what is open, for the window closes.

        Parameters
        ----------
        is_last_chance : bool
            The window closes whatever comes of it: a failure is one line on stderr.

        Returns
        -------
        str
            Why it could not be saved; empty if it was.
        """
        try:
            self.autosave.finish()
        except (OSError, StateFileError, MemoryError) as error:
            reason = str(error) or "there is not enough memory"
            if is_last_chance:
                self.autosave.end()
                print(f"rasterscope: what is open could not be saved: {reason}", file=sys.stderr)
            return reason
        return ""

    def save_preferences(self, window: WindowParts) -> None:
        """Save how the window looks; a failure is one line on stderr."""
        layout = dict(self.preferences.layout)
        for page in window.pages.made:
            layout |= page.layout_state()
        self.preferences = self.preferences.model_copy(
            update={
                "geometry": window.saveGeometry().toBase64().toStdString(),
                "layout": layout,
                "folder": last_folder(),
                "page": window.pages.current_name if window.pages.current_name != "start" else "step",
                "shows_all_methods": window.page.settings_panel.more_button.isChecked(),
                "shown_panes": window.page.lessons.desk_panes(),
                "folded_cards": window.page.inspector.folded(),
                "level": int(window.session.cursor.level),
            }
        )
        try:
            save_preferences(self.preferences)
        except OSError as error:
            print(f"rasterscope: the preferences could not be saved: {error}", file=sys.stderr)
