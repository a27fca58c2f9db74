"""What is drawn before the picture, beside it: what light or mirror sees, and the texels that a pixel looks up."""

import numpy as np
from PySide6.QtCore import QPoint, Slot
from PySide6.QtWidgets import QMenu, QWidget

from app.session.moment import Moment
from app.session.passes import looked_into, looked_up_texels, open_pass, passes_of, shaded_row
from app.views.companions import GridBeside
from core.records.words import joined
from core.shading.environment import FACES
from core.stages.environment import drawn_faces
from core.stages.passes import drawn_depth
from widgets.grid.layers import GridBuffer
from widgets.grid.marks import StepMark

MAPS = {"shadow-map", "environment"}


class OpensPass(GridBeside):
    """A grid that shows what a pass has drawn; a right click opens the pass."""

    def make_widget(self) -> QWidget:
        """Return the grid below its title, with a menu."""
        pane = super().make_widget()
        self.grid.pixel_menu_requested.connect(self._offer)
        self.menu = QMenu(pane)
        self.menu.addAction("Open this pass").triggered.connect(self._open)
        return pane

    def pass_number(self, moment: Moment) -> int:
        """Return which of the passes it shows; -1: none."""
        raise NotImplementedError

    @Slot(int, int, QPoint)
    def _offer(self, _column: int, _row: int, place: QPoint) -> None:
        self.menu.popup(place)

    @Slot()
    def _open(self) -> None:
        open_pass(self.session, self.pass_number(self.moment))


class PassBeside(OpensPass):
    """The shadow map, or the face of the environment map that a mirror looks into."""

    name = "pass"

    def pass_number(self, moment: Moment) -> int:
        """Return the map that is looked into, else the first; -1: there is no map."""
        names = [planned.name for planned in passes_of(moment.document)]
        into = looked_into(moment, shaded_row(moment)) if set(names) & MAPS else -1
        return into if into >= 0 else next((k for k, name in enumerate(names) if name in MAPS), -1)

    def is_wanted(self, moment: Moment) -> bool:
        """Return whether the picture looks into a map."""
        return self.pass_number(moment) >= 0

    def made_from(self) -> object:
        """Return trace and the row that looks into the map."""
        return self.moment.trace, shaded_row(self.moment)

    def draw(self) -> None:
        """Show the map, with the texels marked."""
        number, planned = self.pass_number(self.moment), passes_of(self.moment.document)
        shown = planned[number]
        width, height = shown.scene.size
        if shown.name == "environment":
            first = [each.name for each in planned].index(shown.name)
            start = number - (number - first) % len(FACES)
            color = drawn_faces(planned[start : start + len(FACES)])[number - start].pixels
            buffer, what = GridBuffer("environment map", color, "color", title="colour"), "colour"
        else:
            buffer = GridBuffer("shadow map", drawn_depth(shown), range=(0.0, 1.0), title="depth")
            what = "depth"
        self._title.setText(f"{shown.title}: {what}, {width} × {height} texels")
        self.grid.show_buffer(buffer)
        self.grid.setAccessibleName(f"{buffer.name.capitalize()}: {shown.title}")
        texels = looked_up_texels(self.moment, shaded_row(self.moment), number)
        self.grid.show_step(StepMark(np.array(texels)) if texels else StepMark())
        said = f"Looked up: {joined(list(map(str, texels)))}." if texels else "No texel is looked up."
        self.grid.setAccessibleDescription(said)
