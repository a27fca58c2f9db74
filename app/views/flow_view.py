"""The view of the pipeline in four stages: what goes in and what comes out, counted in the traced picture."""

import numpy as np
from PySide6.QtCore import Slot
from PySide6.QtWidgets import QWidget

from app.views.chapters import chapters_of, traced_counts
from app.views.stage_view import StageView
from core import STAGES
from core.explain.subjects.interpolation import ATTRIBUTE_NAMES
from core.records.nouns import nouns
from core.records.words import counted, joined
from core.scene import ClipScene
from core.stages.declared import PHASES
from widgets.timeline.chapter_button import Spelling
from widgets.timeline.phases import Part, PhaseCard, Phases


class FlowView(StageView):
    """Four columns: vertices, primitives, fragments, pixels; a click on a stage steps it."""

    name, title = "flow", "Flow"

    def make_widget(self) -> QWidget:
        """Return the columns."""
        self._phases = Phases()
        self._phases.setAccessibleName("The pipeline in four stages")
        self._phases.stage_chosen.connect(self._choose)
        return self._phases

    def made_from(self) -> object:
        """Return trace, stage, and whether numbers would tell an answer."""
        return (self.moment.trace, self.moment.cursor.stage, self.moment.is_predicting)

    def draw(self) -> None:
        """Count what goes through the four stages."""
        trace, stage = self.moment.trace, self.moment.cursor.stage
        chapters = chapters_of(trace, current=stage, is_predicting=self.moment.is_predicting)
        by_stage = dict(zip(STAGES, chapters, strict=True))
        layout = trace.source.geometry.primitives.layout
        # A vertex in object space has its place there, not in the world.
        takes, gives = (
            joined([ATTRIBUTE_NAMES.get(name, name) for name in layout if name != without])
            for without in ("position", "")
        )
        cards = []
        for place, (phase, (incoming, outgoing)) in enumerate(zip(PHASES, self._ends(), strict=True)):
            text = phase.takes.format(values=gives if place else takes)
            if place == 0 and isinstance(trace.source.scene, ClipScene):
                text = f"given in clip space, with {takes}"
            parts = tuple(
                Part(
                    by_stage[name].title,
                    by_stage[name].second_line(Spelling.UNITS),
                    by_stage[name].reason or by_stage[name].counts,
                    name == stage,
                )
                for name in phase.stages
            )
            cards.append(
                PhaseCard(phase.title, incoming, text, outgoing, phase.gives.format(values=gives), parts)
            )
        self._phases.show_cards(cards)

    def _ends(self) -> list[tuple[str, str]]:
        """Return how many of what go into each of the four stages and come out."""
        trace = self.moment.trace
        geometry, size = trace.source.geometry, trace.source.scene.size
        given, drawn = geometry.assembled, nouns(trace.source.scene.corner_count)
        corners = geometry.vertices.all_corners[given.triangle]

        def said(count: int, noun: str, plural: str = "") -> str:
            hidden = f"? {plural or noun + 's'}"
            return hidden if self.moment.is_predicting else counted(count, noun, plural)

        vertices = said(len(np.unique(corners)), "vertex", "vertices")
        fragments = said(traced_counts(trace)["interpolate"][1], "fragment")
        return [
            (vertices, vertices),
            (said(len(given), drawn.one, drawn.many), fragments),
            (fragments, fragments),
            (fragments, said(size[0] * size[1], "pixel")),
        ]

    @Slot(int)
    def _choose(self, place: int) -> None:
        """Go to the start of a stage."""
        self.session.set_stage(STAGES[place], 0)
