"""A | B | difference: the traced picture under the page's settings and under other ones, on the same input."""

from collections.abc import Callable, Mapping
from dataclasses import replace
from functools import partial

import numpy as np
from PySide6.QtCore import QObject, Signal, Slot

from app.background.workers import Job, Progress
from app.pages.step.grid_records import geometry_of
from app.pages.step.scene_outline_presenter import settings_records
from app.pages.step.vertex_drags import VertexDrags
from app.session.session import Session
from app.session.tracing import QUICK_SECONDS
from core import Frame, Settings
from core.explain.stage_texts import family_title
from core.methods import table
from core.settings import WHOLE_NUMBERS
from core.trace import TraceSource
from widgets.grid.buffer import BufferKind, GridBuffer, number_text
from widgets.grid.compare_view import CompareView, Comparison
from widgets.grid.overlay import Mark, MaskOverlay

BUFFERS = (
    ("color", "Colour"),
    ("primitive", "Triangles"),
    ("depth", "Depth"),
    ("cover_count", "Cover count"),
)


class ComparePresenter(QObject):
    """Keeps the settings of B and shows both pictures while the view is open."""

    edit_refused = Signal(str)
    look_changed = Signal()
    """B differs otherwise, or another buffer is compared."""

    def __init__(self, session: Session, view: CompareView, parent: QObject | None = None) -> None:
        super().__init__(parent)
        self._session, self._view = session, view
        self._differences: dict[str, str | int] = {"fill": "scanline-lecture"}
        """The family in which B differs from A: family and value."""
        self._buffer = "color"
        self._is_active = False
        self._job = Job(self)
        self._job.succeeded.connect(self._show)
        self._job.failed.connect(self._refuse)
        self._drags = VertexDrags(session, view.linked.grids, self._no_triangle, "drag in A | B", self)
        self._drags.refused.connect(self.edit_refused)
        session.document_changed.connect(self.refresh)
        session.pin_changed.connect(self.refresh_pointing)
        session.hover_changed.connect(self.refresh_pointing)
        view.setting_chosen.connect(self._choose)
        view.buffer_chosen.connect(self.set_buffer)
        view.reset_requested.connect(self._reset)
        view.swap_requested.connect(self._swap)
        view.pixel_hovered.connect(self._hover)
        view.pixel_left.connect(self._leave)
        view.pixel_clicked.connect(self._pin)

    @property
    def other(self) -> Settings:
        """Settings of B: those of the page, but for what it does otherwise."""
        return replace(self._session.document.settings, **self._differences)  # type: ignore[arg-type]

    @property
    def differences(self) -> Mapping[str, str | int]:
        """What B does otherwise than A: family and value."""
        return self._differences

    @property
    def buffer(self) -> str:
        """Name of the buffer in which both are compared."""
        return self._buffer

    def set_active(self, is_active: bool) -> None:
        """Show the comparison from now on, or stop computing it."""
        self._is_active = is_active
        self.refresh()
        if is_active and self._differences:
            self._view.show_family(next(iter(self._differences)))

    @Slot()
    def refresh(self) -> None:
        """Draw both pictures and their difference."""
        if not self._is_active:
            return
        session = self._session
        document, source = session.document, session.trace.source
        self._view.show_buffers(BUFFERS, self._buffer)
        self._view.show_settings(settings_records(replace(document, settings=self.other)))
        self._view.show_geometry(geometry_of(document, session.trace))
        self._view.set_pixel_center(document.settings.pixel_center)
        other = TraceSource(source.scene, self.other, source.triangle, source.region, source.before)
        self._job.cancel()
        if replace(document, settings=self.other).estimated_seconds > QUICK_SECONDS:
            self._view.show_refusal("Drawing B …")
            self._job.start(partial(_draw, other))
            return
        try:
            self._show(other)
        except ValueError as error:
            self._refuse(error)

    @Slot(object)
    def _show(self, other: TraceSource) -> None:
        """Show both pictures and their difference."""
        document, source = self._session.document, self._session.trace.source
        origin = source.raster.bounds[:2]
        comparison = compare(
            source.picture, other.picture, self._buffer, document.settings, self.other, origin
        )
        self._view.show_comparison(comparison)
        self.refresh_pointing()

    @Slot(object)
    def _refuse(self, error: Exception) -> None:
        self._view.show_refusal(f"B cannot be drawn: {error}")

    @staticmethod
    def _no_triangle() -> int | None:
        """Return that only the document's own triangle has handles here."""
        return None

    def stop(self) -> None:
        """End drawing in the background."""
        self._job.shut_down()

    @Slot()
    def refresh_pointing(self) -> None:
        """Mark pin and hover."""
        if self._is_active:
            first_column, first_row, _, _ = self._session.trace.source.raster.bounds
            marks = [
                None if pixel is None else (pixel[0] - first_column, pixel[1] - first_row)
                for pixel in (self._session.pin, self._session.hover)
            ]
            self._view.show_pointing(marks[0], marks[1])

    def set_differences(self, differences: Mapping[str, str | int]) -> None:
        """Choose what B does otherwise than the page."""
        mine = self._session.document.settings
        self._differences = mine.differences(replace(mine, **differences))  # type: ignore[arg-type]
        self.refresh()
        self.look_changed.emit()

    @Slot(str, str)
    def _choose(self, family: str, value: str) -> None:
        chosen: str | int = int(value) if family in WHOLE_NUMBERS else value
        self.set_differences({**self._differences, family: chosen})

    @Slot(str)
    def set_buffer(self, name: str) -> None:
        """Compare in another buffer."""
        if name in dict(BUFFERS):
            self._buffer = name
            self.refresh()
            self.look_changed.emit()

    @Slot()
    def _reset(self) -> None:
        self.set_differences({})

    @Slot()
    def _swap(self) -> None:
        document, other = self._session.document, self.other
        before, self._differences = (
            self._differences,
            {f: getattr(document.settings, f) for f in self._differences},
        )
        try:
            self._session.edit(replace(self._session.latest, settings=other))
        except ValueError as error:
            self._differences = before
            self.edit_refused.emit(str(error))

    @Slot(int, int)
    def _hover(self, column: int, row: int) -> None:
        first_column, first_row, _, _ = self._session.trace.source.raster.bounds
        self._session.set_hover((column + first_column, row + first_row))

    @Slot()
    def _leave(self) -> None:
        self._session.set_hover(None)

    @Slot(int, int)
    def _pin(self, column: int, row: int) -> None:
        first_column, first_row, _, _ = self._session.trace.source.raster.bounds
        self._session.set_pin((column + first_column, row + first_row))


def _draw(source: TraceSource, progress: Progress, is_cancelled: Callable[[], bool]) -> TraceSource:
    """Draw the picture of B in a thread."""
    assert source.picture is not None
    return source


def compare(
    first: Frame, second: Frame, buffer: str, mine: Settings, other: Settings, origin: tuple[int, int]
) -> Comparison:
    """Return both buffers, their difference (B minus A; colours: the largest channel) and how many pixels differ."""
    a, b = getattr(first, buffer), getattr(second, buffer)
    differs = (a != b).any(axis=2) if a.ndim == 3 else a != b
    amount = b.astype(float) - a.astype(float)
    if a.ndim == 3:
        largest = np.abs(amount).argmax(axis=2)
        amount = np.take_along_axis(amount, largest[..., None], axis=2)[..., 0]
    kind: BufferKind = "color" if buffer == "color" else "ids" if buffer == "primitive" else "scalar"
    scale = None
    if kind == "scalar":
        scale = (float(min(a.min(), b.min())), float(max(a.max(), b.max())))
    count = int(np.count_nonzero(differs))
    summary = f"{count:,} of {differs.size:,} pixels differ"
    if buffer == "primitive":
        amount = differs.astype(float)
        in_a, in_b = a >= 0, b >= 0
        summary += (
            f"; {np.count_nonzero(in_a & ~in_b):,} only in A, {np.count_nonzero(in_b & ~in_a):,} only in B"
        )
    elif count:
        summary += f"; largest difference {number_text(float(np.abs(amount).max()))}"
    return Comparison(
        GridBuffer("A", a, kind, range=scale, origin=origin),
        GridBuffer("B", b, kind, range=scale, origin=origin),
        GridBuffer("difference", amount, "bool" if buffer == "primitive" else "signed", origin=origin),
        "A, current settings",
        "B, " + (settings_difference(mine, other) or "the same settings"),
        summary + ".",
        (MaskOverlay("difference", Mark.DIFFERENCE, differs),),
    )


def settings_difference(mine: Settings, other: Settings) -> str:
    """Return in words what ``other`` does otherwise than ``mine``."""
    parts = []
    for name, value in mine.differences(other).items():
        text = table.get(name, value).title if isinstance(value, str) else str(value)
        parts.append(f"{family_title(name).lower()}: {text}")
    return ", ".join(parts)
