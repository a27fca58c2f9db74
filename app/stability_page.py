"""The page of the atlas: experiments, one map for each method, and the case behind a cell."""

from pathlib import Path

from PySide6.QtCore import QByteArray, Qt, Slot
from PySide6.QtWidgets import QFileDialog, QHBoxLayout, QPushButton, QSplitter, QVBoxLayout, QWidget

from app.atlas_export import atlas_content
from app.atlas_files import EXTENSION, AtlasFileError, load_atlas
from app.export import copy_widget, export_widget
from app.file_writing import whole_file
from app.pages import Handlers, Page
from app.session import Session
from app.shrunk_files import save_shrunk, shrunk_name
from app.stability_case_presenter import StabilityCasePresenter
from app.stability_choices import AtlasResult
from app.stability_desk import StabilityDesk
from app.stability_presenter import StabilityPresenter
from app.state_files import EXTENSION as STATE_EXTENSION
from widgets.atlas_view import AtlasView
from widgets.case_view import CaseView
from widgets.elided_label import ElidedLabel
from widgets.family_list import FamilyList
from widgets.readout import Readout
from widgets.stability_controls import StabilityControls

FILE_KINDS = (
    "Maps with claim and machine (*.png);;Drawing (*.svg);;Table of all cells (*.csv);;"
    f"Atlas, to be opened again (*{EXTENSION});;Page as it is seen (*.pdf)"
)
CASE_KINDS = f"Scene, to be opened again (*{STATE_EXTENSION});;Python test (*.py)"


class StabilityPage(Page):
    """All panes of the Stability page and their presenters."""

    def __init__(self, session: Session, parent: QWidget | None = None) -> None:
        super().__init__(parent)
        self.desk = StabilityDesk(self)
        self.experiments, self.readout = FamilyList(self), Readout("Figures", self)
        self.experiments.setAccessibleName("Experiments")
        self.controls, self.maps, self.case = StabilityControls(self), AtlasView(self), CaseView(self)
        self.shown_text = ElidedLabel(self)
        self.runs = StabilityPresenter(
            session, self.desk, self.experiments, self.controls, self.maps, self.readout, self
        )
        self.opened = StabilityCasePresenter(self.runs, self.desk, self.maps, self.case, self)
        self._lay_out()
        self.setFocusProxy(self.maps)
        self.runs.shown_text_changed.connect(self.shown_text.setText)
        self.runs.message_sent.connect(self.message_sent)
        self.runs.refused.connect(self.edit_refused)
        self.opened.message_sent.connect(self.message_sent)
        self.opened.refused.connect(self.edit_refused)
        self.opened.step_requested.connect(self.step_requested)
        self.case.save_requested.connect(self.ask_save_case)

    # Layout.

    def _lay_out(self) -> None:
        self.left = QSplitter(Qt.Orientation.Vertical, self)
        self.left.addWidget(self.experiments)
        self.left.addWidget(self.readout)
        self.left.setStretchFactor(1, 1)
        self.left.setSizes([360, 300])
        self.left.setMinimumWidth(160)
        self.columns = QSplitter(Qt.Orientation.Horizontal, self)
        self.columns.addWidget(self.left)
        self.columns.addWidget(self._main())
        self.columns.setStretchFactor(1, 1)
        self.columns.setSizes([264, 1000])
        page = QVBoxLayout(self)
        page.setContentsMargins(8, 4, 8, 8)
        page.addWidget(self.columns, 1)

    def _main(self) -> QWidget:
        self.shown_text.setProperty("role", "muted")
        self.shown_text.setAccessibleName("What the maps show")
        top = QWidget(self)
        layout = QVBoxLayout(top)
        layout.setContentsMargins(0, 0, 0, 0)
        layout.setSpacing(4)
        layout.addWidget(self.controls)
        layout.addWidget(self.maps, 1)
        layout.addLayout(self._foot())
        self.rows = QSplitter(Qt.Orientation.Vertical, self)
        self.rows.addWidget(top)
        self.rows.addWidget(self.case)
        self.rows.setStretchFactor(0, 3)
        self.rows.setStretchFactor(1, 2)
        self.rows.setSizes([440, 240])
        return self.rows

    def _foot(self) -> QHBoxLayout:
        self.export_button = QPushButton("Export…", self)
        self.export_button.setToolTip("Write the maps, all cells or the whole atlas to a file (Ctrl+E)")
        self.export_button.clicked.connect(self.ask_export)
        self.copy_button = QPushButton("Copy", self)
        self.copy_button.setToolTip("Put the maps on the clipboard")
        self.copy_button.clicked.connect(self.copy)
        row = QHBoxLayout()
        row.setSpacing(8)
        row.addWidget(self.shown_text, 1)
        row.addWidget(self.export_button)
        row.addWidget(self.copy_button)
        return row

    # As a page of the window.

    def handlers(self) -> Handlers:
        """Return what the keys of this page do."""
        return {
            "run_experiment": self.runs.run,
            "cancel_experiment": self.runs.cancel,
            "next_experiment": lambda: self.runs.show_neighbour(1),
            "previous_experiment": lambda: self.runs.show_neighbour(-1),
            "step_cell": self.opened.step,
            "shrink_cell": self.opened.shrink,
            "save_case": self.ask_save_case,
            "export_view": self.ask_export,
            "copy_view": self.copy,
        }

    def dismiss(self) -> bool:
        """Stop running, or else close the case."""
        if self.desk.is_running:
            self.runs.cancel()
            return True
        is_open = self.runs.choice.chosen is not None
        self.opened.close()
        return is_open

    def main_view(self) -> QWidget:
        """Return what is copied: the maps."""
        return self.maps

    def stop(self) -> None:
        """End all runs."""
        self.desk.shut_down()

    def layout_state(self) -> dict[str, str]:
        """Return the splitters' positions as texts."""
        return {
            name: splitter.saveState().toBase64().toStdString()
            for name, splitter in self._splitters().items()
        }

    def restore_layout(self, state: dict[str, str]) -> None:
        """Put the splitters where they were."""
        for name, splitter in self._splitters().items():
            if name in state:
                splitter.restoreState(QByteArray.fromBase64(state[name].encode("ascii")))

    def _splitters(self) -> dict[str, QSplitter]:
        return {
            "stability columns": self.columns,
            "stability left": self.left,
            "stability rows": self.rows,
        }

    # Files.

    def open_path(self, path: str) -> None:
        """Open a saved atlas and show it as what it is."""
        try:
            atlas = load_atlas(path)
        except AtlasFileError as error:
            self.edit_refused.emit(f"{error}. What is shown stays as it was.")
            return
        self.runs.take_saved(atlas, Path(path).name)

    @Slot()
    def ask_export(self) -> None:
        """Ask where the atlas is to go, and write it there."""
        result = self._finished()
        if result is None:
            return
        name = f"stress-{result.atlas.experiment.name}.png"
        path, _ = QFileDialog.getSaveFileName(self.window(), "Export atlas", name, FILE_KINDS)
        if path:
            self.export_to(path)

    def export_to(self, path: str) -> None:
        """Write the atlas by the ending of the file."""
        result = self._finished()
        if result is None:
            return
        try:
            self._write(result, path)
        except (OSError, ValueError) as error:
            self.edit_refused.emit(f"The atlas was not exported: {error}")
        else:
            self.message_sent.emit(f"Exported {Path(path).name}.")

    def _write(self, result: AtlasResult, path: str) -> None:
        content = atlas_content(result.atlas, Path(path).suffix.lower())
        if content is None:
            export_widget(self.maps, path)
            return
        with whole_file(path) as file:
            file.write(content)

    def _finished(self) -> AtlasResult | None:
        if self.runs.result is None or self.runs.is_partial:
            self.message_sent.emit("There is nothing to export yet: run the experiment first (F5).")
            return None
        return self.runs.result

    @Slot()
    def copy(self) -> None:
        """Put the maps on the clipboard as a picture."""
        copy_widget(self.maps)
        self.message_sent.emit("Copied the maps.")

    @Slot()
    def ask_save_case(self) -> None:
        """Ask where the small case is to go, and write it there."""
        found = self.opened.shrunk
        if found is None:
            self.message_sent.emit("Shrink a failing cell first (S): the smallest case is worth a file.")
            return
        name = f"{shrunk_name(found.order.experiment.info.name, found.order.place.key)}{STATE_EXTENSION}"
        path, _ = QFileDialog.getSaveFileName(self.window(), "Save case", name, CASE_KINDS)
        if path:
            self.save_case_to(path)

    def save_case_to(self, path: str) -> None:
        """Write the small case as a scene or as a Python test, by the ending of the file."""
        found = self.opened.shrunk
        assert found is not None
        try:
            save_shrunk(
                Path(path), found.shrunk, f"{found.order.experiment.info.name}: {found.order.place.key}"
            )
        except (OSError, ValueError) as error:
            self.edit_refused.emit(f"The case was not saved: {error}")
        else:
            self.message_sent.emit(f"Saved {Path(path).name}.")
