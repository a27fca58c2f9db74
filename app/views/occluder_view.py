"""The depth of the occluders beside the boxes: the level of the pyramid at hand, and what a box is compared with."""

import numpy as np
from PySide6.QtWidgets import QWidget

from app.session.moment import Moment
from app.session.passes import passes_of
from app.views.pass_view import OpensPass
from core.culling.traced_occlusion import OCCLUSION_OPERATIONS
from core.records.words import joined
from widgets.grid.layers import GridBuffer
from widgets.grid.marks import StepMark, box_lines

WITHOUT_DEPTH = ("occluder", "no-occluder")
"""Kinds of rows that come before there is a depth."""


class OccludersBeside(OpensPass):
    """A level of the pyramid, and the pass that draws its bottom."""

    name, is_alike, is_all_done = "occluders", False, True

    def make_widget(self) -> QWidget:
        """Return the grid below its title, with a menu."""
        pane = super().make_widget()
        self.grid.setAccessibleName("Pyramid over the depth of the occluders")
        return pane

    def pass_number(self, moment: Moment) -> int:
        """Return the pass that draws the occluders."""
        return [planned.name for planned in passes_of(moment.document)].index("occluders")

    def is_wanted(self, moment: Moment) -> bool:
        """Return whether the row at hand makes a level, or compares a box with one."""
        kind = moment.stage_trace.kind_of(moment.row) if moment.row >= 0 else ""
        return kind in OCCLUSION_OPERATIONS and kind not in WITHOUT_DEPTH

    def made_from(self) -> object:
        """Return trace and cursor: the level appears with its operation."""
        return self.moment.trace, self.moment.cursor

    def draw(self) -> None:
        """Show the level, with the rectangle and the texels of the box."""
        trace, row = self.moment.stage_trace, self.moment.row
        pyramid = trace.extra["culled"].objects.occlusion.tests.pyramid
        explanation = trace.explain(self.moment.cursor.position)
        assert explanation is not None
        level, known, values = int(trace.columns["made_level"][row]), explanation.known, trace.variables(row)
        if level < 0:
            level = int(np.asarray(values["box_level"])) if "box_level" in known else 0
        bottom = pyramid[0][np.isfinite(pyramid[0])]
        side = 2**level
        what = "depth of the occluders" if level == 0 else f"{side} × {side} pixels a texel"
        self._title.setText(f"Level {level}: {what}")
        ends = float(bottom.min()), float(bottom.max())
        buffer = GridBuffer("pyramid", pyramid[level], range=ends, title="depth", has_centres=level == 0)
        self.grid.show_buffer(buffer)
        mark, said = StepMark(), "No texel is compared."
        if "box_rectangle" in known:
            left, low, right, high = np.asarray(values["box_rectangle"]) / side
            lines = box_lines(left, low, right + 1 / side, high + 1 / side)
            texels = np.asarray(values["box_texels"]) if "box_texels" in known else np.empty((0, 2), np.int64)
            mark = StepMark(texels[texels[:, 0] >= 0], lines)
            named = [str((column, line)) for column, line in mark.pixels.tolist()]
            said = f"Compared with: {joined(named)}." if named else said
        self.grid.show_step(mark)
        self.grid.setAccessibleDescription(said)
