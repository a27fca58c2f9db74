"""What is drawn before the picture, beside it: the depths that the light sees, and the texels that a pixel looks up."""

import numpy as np
from PySide6.QtCore import QPoint, Slot
from PySide6.QtWidgets import QMenu, QWidget

from app.session.moment import Moment
from app.session.passes import looked_up_texels, open_pass, passes_of, shaded_row
from app.views.companions import GridBeside
from core.records.passes import PlannedPass
from core.records.words import joined
from core.stages.passes import drawn_depth
from widgets.grid.layers import GridBuffer
from widgets.grid.marks import StepMark


class PassBeside(GridBeside):
    """The shadow map; a right click opens it."""

    name = "pass"

    def make_widget(self) -> QWidget:
        """Return the grid below its title, with a menu."""
        pane = super().make_widget()
        self.grid.setAccessibleName("Shadow map: the depths that the light sees")
        self.grid.pixel_menu_requested.connect(self._offer)
        self.menu = QMenu(pane)
        self.menu.addAction("Open this pass").triggered.connect(self._open)
        return pane

    def is_wanted(self, moment: Moment) -> bool:
        """Return whether the picture looks into a map."""
        return _map_of(moment) is not None

    def made_from(self) -> object:
        """Return trace and the row that looks into the map."""
        return self.moment.trace, shaded_row(self.moment)

    def draw(self) -> None:
        """Show the map, with the texels marked."""
        planned = _map_of(self.moment)
        assert planned is not None
        width, height = planned.scene.size
        self._title.setText(f"{planned.title}: depth, {width} × {height} texels")
        self.grid.show_buffer(GridBuffer("shadow map", drawn_depth(planned), range=(0.0, 1.0), title="depth"))
        texels = looked_up_texels(self.moment, shaded_row(self.moment))
        self.grid.show_step(StepMark(np.array(texels)) if texels else StepMark())
        said = (
            f"Looked up: {joined([str(texel) for texel in texels])}." if texels else "No texel is looked up."
        )
        self.grid.setAccessibleDescription(said)

    @Slot(int, int, QPoint)
    def _offer(self, _column: int, _row: int, place: QPoint) -> None:
        self.menu.popup(place)

    @Slot()
    def _open(self) -> None:
        open_pass(self.session)


def _map_of(moment: Moment) -> PlannedPass | None:
    """Return the pass of the shadow map."""
    return next((planned for planned in passes_of(moment.document) if planned.name == "shadow-map"), None)
