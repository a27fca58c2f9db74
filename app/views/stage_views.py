"""The views beside the pixel grid: the 3D scene, the run as chapters in four stages, and `VIEWS`."""

from collections.abc import Mapping

import numpy as np
from PySide6.QtCore import QEvent, QObject, Signal, Slot
from PySide6.QtWidgets import QWidget

from app.session.moment import Moment
from app.session.session import Session
from app.views.companions import ClipView, PyramidView, StageView, TextureView
from app.views.scene3d_presenter import Scene3dPresenter
from core import STAGES, Trace
from core.antialiasing.sampling import Sampling
from core.coverage.told_edges import replaced_fill
from core.explain.stage_texts import skipped_because
from core.interpolation.told import ATTRIBUTE_NAMES
from core.records.frame import StageCount
from core.records.words import POLYGON, counted, joined, nouns
from core.resolved import resolve
from core.scene import ClipScene
from core.stages.declared import GEOMETRY_STAGES, PHASES, stage_of
from core.trace.sample_sources import stepped_sources
from core.trace.source import TraceSource
from core.visibility.hit_lists import HIT_BYTES
from widgets.space.orbit import Orbit
from widgets.space.scene_view import SceneView
from widgets.space.view import OrbitArea
from widgets.timeline.chapters import Chapter, ChapterState, Spelling
from widgets.timeline.stage_cards import Part, PhaseCard, Phases

# The run as chapters: what went into each stage and came out, how long it took, why it is there.


INSERTED_FOR = {"clip": "corners in front of the eye", "blend": 'its pixels blended "over"'}
"""What a method lacked that made the pipeline insert a stage."""
COMPUTED = "No pixel is tested: the ends of the spans are computed."
"""Why the pixels that go into the rasterization are those that come out."""
_TRIANGLES, _PIXELS, _FRAGMENTS = ("triangles", "tri"), ("pixels", "px"), ("fragments", "frag")
_SAMPLES, _PIECES = ("samples", "smp"), ("pieces", "pcs")
Units = tuple[tuple[str, str], tuple[str, str]]
_PRIMITIVES = {4: ("polygons", "poly"), 2: ("segments", "seg"), 1: ("points", "pt"), 0: ("fragments", "frag")}
_UNITS = dict.fromkeys(GEOMETRY_STAGES, (_TRIANGLES, _TRIANGLES)) | {
    "bin": (_TRIANGLES, _PIXELS),
    "raster": (_PIXELS, _FRAGMENTS),
    "resolve": (_PIXELS, _PIXELS),
}
"""What goes into a stage and comes out, in words and in signs, where it is not fragments; of one sample a pixel."""


def traced_counts(trace: Trace) -> dict[str, tuple[int, int]]:
    """Return what goes into and comes out of every stage of the trace.

    The picture has all triangles, and interpolates and shades only what is seen in the end; the trace may have one
    triangle in focus, and does it with every fragment, in pipeline order.
    """
    source, geometry = trace.source, trace.source.geometry
    given, pieces = len(geometry.assembled), len(geometry.primitives)
    kept = int(np.count_nonzero(geometry.culled.kept))
    counts = source.picture.statistics
    found = {stage: (count.incoming, count.outgoing) for stage, count in counts.items()}
    found |= {"transform": (given, given), "cull": (given, kept)}
    found |= {"clip": (kept, pieces), "edges": (pieces, pieces)}
    tested, fragments, interpolated, shaded, passed = trace.fragment_counts
    found |= {"bin": (pieces, tested), "raster": (tested, fragments)}
    found |= {"interpolate": (interpolated, interpolated), "shade": (interpolated, shaded)}
    found |= {"depth": (fragments, passed), "blend": (passed, passed)}
    if source.scene.corner_count != 3:
        found |= {"bin": (pieces, pieces), "raster": (pieces, found["raster"][1])}
    elif not found["raster"][0] and found["raster"][1]:
        found["raster"] = found["bin"][1], found["raster"][1]
    return found


def chapters_of(trace: Trace, *, current: str, is_predicting: bool) -> list[Chapter]:
    """Return the chapters of all stages.

    Parameters
    ----------
    trace : Trace
        What is stepped; the times are those of its picture.
    current : str
        The stage that is stepped.
    is_predicting : bool
        Whether counts would tell the answer.
    """
    counts, through = trace.source.picture.statistics, traced_counts(trace)
    whole_seconds = sum(count.seconds for count in counts.values())
    is_whole, corner_count = trace.source.triangle is None, trace.source.scene.corner_count
    sampling = resolve(trace.source.settings).sampling
    chapters = []
    for index, stage in enumerate(STAGES):
        count, (incoming, outgoing) = counts[stage], through[stage]
        state, is_inserted, reason = _state_and_reason(stage, current, count, trace.source)
        if stage == "raster" and outgoing and not count.incoming and corner_count == 3:
            reason = reason or COMPUTED
        if stage == "depth" and incoming and not is_predicting:
            reason = reason or _accesses(trace, incoming)
        if is_whole and not is_predicting and stage in ("interpolate", "shade") and outgoing > count.outgoing:
            reason = f"The picture needs only the {count.outgoing:,} that are seen in the end."
        share = count.seconds / whole_seconds if whole_seconds > 0 else 0.0
        words, short = (
            _counted(_units(stage, corner_count, sampling), incoming, outgoing, is_predicting, form)
            for form in (0, 1)
        )
        duration = (
            "" if is_predicting else f"{count.seconds * 1000:.1f} ms, {100 * share:.0f} % of all stages"
        )
        key = str((index + 1) % 10) if index < 10 else ""
        chapters.append(
            Chapter(stage_of(stage).short_title, key, words, short, duration, state, is_inserted, reason)
        )
    return chapters


def _accesses(trace: Trace, fragment_count: int) -> str:
    """Return how often a method accesses what is drawn, and how often pixels or samples: each loop one of them once."""
    source, geometry = trace.source, trace.source.geometry
    drawn, sampling = nouns(source.scene.corner_count), resolve(source.settings).sampling
    if sampling.is_area or source.scene.corner_count == 0:
        return ""
    work = source.exact_tests.work if source.exact_tests is not None else {}
    if "hits listed" in work:
        return _kept_in_lists(source)
    if work:
        return "" if sampling.count > 1 else _compared_at_ends(work, fragment_count)
    one, many = (
        ("piece", "pieces") if len(geometry.primitives) > len(geometry.kept) else (drawn.one, drawn.many)
    )
    place = "sample" if sampling.count > 1 else "pixel"
    places = source.raster.shape[0] * source.raster.shape[1] * sampling.count
    count = len(geometry.primitives)
    if geometry.drawing.asks_all:
        return f"Accessed: each {place} once, {many} {counted(places * count, 'time')}."
    return f"Accessed: each {one} once, {place}s {counted(fragment_count, 'time')}."


def _kept_in_lists(source: TraceSource) -> str:
    """Return how many hits are in lists, in how many bytes, against those of the samples of a z-buffer."""
    samples, _ = stepped_sources(source)
    work = [of.exact_tests.work for of in samples if of.exact_tests is not None]
    hits, size = (sum(of[name] for of in work) for name in ("hits listed", "bytes of lists"))
    longest, places = max(of["longest list"] for of in work), sum(of.place_count for of in samples)
    return (
        f"Listed: {counted(hits, 'hit')}, {size:,} bytes; the longest list has {longest:,}. A z-buffer holds "
        f"{HIT_BYTES * places:,} bytes."
    )


def _compared_at_ends(work: Mapping[str, int], fragment_count: int) -> str:
    """Return how many depths scan lines compute, against the fragments that a depth buffer tests."""
    return (
        f"Computed: {counted(work['depths computed'], 'depth')}, at the ends of segments; a z-buffer tests "
        f"{counted(fragment_count, 'fragment')}. Halved: {counted(work['halvings'], 'segment')}."
    )


def _units(stage: str, corner_count: int, sampling: Sampling) -> Units:
    """Return what goes into a stage and comes out of it, each in words and in signs."""
    takes, gives = _UNITS.get(stage, (_FRAGMENTS, _FRAGMENTS))
    if stage == "resolve":
        takes = _PIECES if sampling.is_area else _SAMPLES if sampling.count > 1 else takes
    elif sampling.count > 1 and (sampling.side or stage not in ("interpolate", "shade")):
        takes, gives = (_SAMPLES if unit in (_PIXELS, _FRAGMENTS) else unit for unit in (takes, gives))
    if corner_count == 3:
        return takes, gives
    primitives = _PRIMITIVES[min(corner_count, POLYGON)]
    return {"bin": (primitives, primitives), "raster": (primitives, gives)}.get(
        stage, (primitives, primitives) if takes == _TRIANGLES else (takes, gives)
    )


def _counted(units: Units, incoming: int, outgoing: int, is_predicting: bool, form: int) -> str:
    """Return what goes in and comes out with its units, in words (0) or signs (1); one unit is written once."""
    takes, gives = (
        unit[form].removesuffix("s") if count == 1 and not is_predicting else unit[form]
        for unit, count in zip(units, (incoming, outgoing), strict=True)
    )
    ins, outs = ("?", "?") if is_predicting else (f"{incoming:,}", f"{outgoing:,}")
    return f"{ins} → {outs} {gives}" if units[0] == units[1] else f"{ins} {takes} → {outs} {gives}"


def _state_and_reason(
    stage: str, current: str, count: StageCount, source: TraceSource
) -> tuple[ChapterState, bool, str]:
    """Return where a stage lies in the run, whether the pipeline has put it in by itself, and why."""
    place, present = STAGES.index(stage), STAGES.index(current)
    state = ChapterState.DONE if place < present else ChapterState.AHEAD
    if place == present:
        state = ChapterState.CURRENT
    skipped = skipped_because(stage, source.scene.corner_count)
    if skipped:
        return state if place == present else ChapterState.SKIPPED, False, skipped
    if count.note == "not-chosen":
        is_behind = bool((source.geometry.vertices.clip[:, 3] <= 0).any())
        what = "Nothing is clipped, though a part lies behind the eye" if is_behind else "Nothing is clipped"
        reason = f"{what}: homogeneous rasterization needs no clipping."
        if source.geometry.vertices.rings is not None:
            reason = "Nothing is clipped: choose a method of polygon clipping."
        return state if place == present else ChapterState.SKIPPED, False, reason
    if count.note and stage == "raster":
        return state, True, replaced_fill(count.note, source.settings.coverage)
    if count.note:
        return state, True, f"Inserted because {count.note} needs {INSERTED_FOR[stage]}."
    return state, False, ""


# The view of the pipeline in four stages: what goes in and what comes out, counted in the traced picture.


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


# The views beside the pixel grid: the 3D scene and `VIEWS`. Only what is seen is drawn.


VIEWS: tuple[type[StageView], ...] = (
    ClipView,
    PyramidView,
    TextureView,
    FlowView,
)
"""The views behind the 3D scene, in the order of their tabs."""


class StageViews(QObject):
    """Makes the 3D view and all others, and keeps the visible ones up to date."""

    triangle_picked = Signal(int)
    """A triangle of the scene was clicked in the 3D view."""
    refused = Signal(str)
    """Why a drag in a view did nothing."""
    message_sent = Signal(str)
    """What a click in a view found."""

    def __init__(self, session: Session, parent: QObject | None = None) -> None:
        super().__init__(parent)
        self._moment = session.moment
        self._scene = SceneView()
        self._others = {view.name: view for view in (make(session) for make in VIEWS)}
        self._views: dict[str, QWidget] = {
            "scene": self._scene,
            **{name: view.widget for name, view in self._others.items()},
        }
        self._stale = set(self._views)
        self._scene_presenter = Scene3dPresenter(session, self._scene, self)
        self._scene_presenter.triangle_picked.connect(self.triangle_picked)
        self._scene_presenter.refused.connect(self.refused)
        self._scene_presenter.message_sent.connect(self.message_sent)
        for widget in self._views.values():
            widget.installEventFilter(self)

    @property
    def widgets(self) -> list[tuple[str, str, QWidget]]:
        """Name, title and widget of every view, in order."""
        others = [(name, view.title, view.widget) for name, view in self._others.items()]
        return [("scene", "3D scene", self._scene), *others]

    @property
    def scene_presenter(self) -> Scene3dPresenter:
        """What drives the 3D view."""
        return self._scene_presenter

    @property
    def is_drawing(self) -> bool:
        """Whether a picture is still being drawn in the background."""
        return self._scene_presenter.is_drawing

    def show(self, name: str) -> None:
        """Bring a view up to date, as when it is about to be seen."""
        if name not in self._views:
            raise ValueError(f"view must be one of {', '.join(self._views)}, got {name}")
        self._refresh(name)

    def show_figures(self, is_shown: bool) -> None:
        """Say below the 3D scene what it shows and in its corner what each picture took, or leave it out."""
        self._scene.corner().set_wanted(is_shown)
        self._scene.show_caption(is_shown)

    def chosen_orbits(self) -> dict[str, Orbit]:
        """Return from where the views in space are seen that the user has turned, by their names."""
        found = {
            name: widget.chosen_orbit()
            for name, widget in self._views.items()
            if isinstance(widget, OrbitArea)
        }
        return {name: orbit for name, orbit in found.items() if orbit is not None}

    def look_from(self, orbits: Mapping[str, Orbit]) -> None:
        """Look from there in these views in space, and in the others from where they are first seen."""
        for name, widget in self._views.items():
            if isinstance(widget, OrbitArea):
                if name in orbits:
                    self._refresh(name)  # What is seen first would be seen from where it is first seen.
                widget.look_from(orbits.get(name))

    def look_at_focus(self) -> None:
        """Magnify the triangle in focus in the 3D view."""
        self._scene_presenter.look_at_focus()

    def look_home(self) -> None:
        """Show the whole scene in the 3D view again."""
        self._scene_presenter.look_home()

    def stop(self) -> None:
        """End drawing in the background."""
        self._scene_presenter.stop()

    def eventFilter(self, watched: QObject, event: QEvent) -> bool:
        """Bring a view up to date when it appears."""
        if watched is self._scene and event.type() == QEvent.Type.Show:
            self._scene_presenter.appear()
        if event.type() == QEvent.Type.Show:
            for name, widget in self._views.items():
                if widget is watched and name in self._stale:
                    self._refresh(name)
        return False

    def refresh(self, moment: Moment) -> None:
        """Bring the visible views up to date, and remember that the others are not."""
        self._moment = moment
        for name, widget in self._views.items():
            if widget.isVisible():
                self._refresh(name)
            else:
                self._stale.add(name)

    def _refresh(self, name: str) -> None:
        self._stale.discard(name)
        if name in self._others:
            self._others[name].refresh(self._moment)
        else:
            self._scene_presenter.refresh(self._moment)
