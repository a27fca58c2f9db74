"""What a click on a point of a study opens: its pictures, two of them locked together, and the way to the stepper."""

from dataclasses import replace

import numpy as np
from numpy.typing import NDArray
from PySide6.QtCore import QObject, Slot

from app.export.views import copy_widget
from app.pages.compare.charts import title_of
from app.pages.compare.jobs import PointsShown, StudyJobs
from app.pages.compare.presenter import StudyPresenter
from app.pages.page_bar import Page, StepRequest
from core.study.accuracy.record import Pictures
from widgets.charts.chart import Chart
from widgets.charts.legend import ChartLegend
from widgets.charts.study_pictures import PicturesRecord, StudyPictures
from widgets.charts.study_table import StudyTable
from widgets.grid.buffer import BufferKind, GridBuffer, number_text

LETTERS = ("A", "B")
HINT = "Click a mark for its pictures; Ctrl+click another one to compare the two."


class StudyPicturesPresenter(QObject):
    """Keeps the one or two chosen points and shows what they drew."""

    def __init__(
        self,
        studies: StudyPresenter,
        jobs: StudyJobs,
        charts: tuple[Chart | ChartLegend, ...],
        numbers: StudyTable,
        view: StudyPictures,
        page: Page,
    ) -> None:
        super().__init__(page)
        self._page = page
        self._studies, self._jobs, self._charts, self._view = studies, jobs, charts, view
        self._chosen: tuple[str, ...] = ()
        self._shown: PointsShown | None = None
        for chart in charts:
            chart.series_chosen.connect(self.choose)
        numbers.row_chosen.connect(self._choose_row)
        studies.shown_changed.connect(self.clear)
        jobs.drawing.succeeded.connect(self._show_pictures)
        jobs.drawing.failed.connect(self._show_failure)
        jobs.searching.succeeded.connect(self._take_divergence)
        jobs.searching.failed.connect(self._tell_no_divergence)
        view.step_requested.connect(self.step)
        view.divergence_requested.connect(self.step_to_divergence)
        view.copy_requested.connect(self.copy)
        view.closing_requested.connect(self.close)
        self.clear()

    @property
    def chosen(self) -> tuple[str, ...]:
        """Methods of the chosen points: A, or A and B."""
        return self._chosen

    @Slot(str, bool)
    def choose(self, method: str, is_added: bool = False) -> None:
        """Open the pictures of a point; ``is_added``: beside the one that is open."""
        result, point = self._studies.result, self._studies.point(method)
        if self._studies.is_partial or result is None or point is None:
            self._page.tell("Pictures are available when the measurement is finished.")
            return
        if is_added and self._chosen and method != self._chosen[0]:
            self._chosen = (self._chosen[0], method)
        else:
            self._chosen = (method,)
        self._shown = None
        for chart in self._charts:
            chart.show_marks(dict(zip(self._chosen, LETTERS, strict=False)))
        self._studies.choose(self._chosen[-1])
        self._view.show()
        if point.refused:
            self._view.show_waiting(f"{point.title} drew nothing: {point.refused}")
        elif not result.can_run_again:
            self._view.show_waiting(
                f"This study was saved without its scene, {result.study.scene}. Open that scene and measure it."
            )
        else:
            names = " and ".join(self._title(each) for each in self._chosen)
            self._view.show_waiting(f"Drawing {names} …")
            points = tuple(found for each in self._chosen if (found := self._studies.point(each)) is not None)
            self._jobs.draw(result, points)

    @Slot(str)
    def _choose_row(self, method: str) -> None:
        self.choose(method)

    def _title(self, method: str) -> str:
        point, study = self._studies.point(method), self._studies.study
        assert point is not None
        assert study is not None
        return title_of(point, [each.method for each in study.points])

    @Slot()
    def clear(self) -> None:
        """Choose no point; the pane keeps its place, so that no mark moves when one is chosen."""
        self._jobs.stop_drawing()
        self._chosen, self._shown = (), None
        for chart in self._charts:
            chart.show_marks({})
        self._studies.choose("")
        self._view.show_waiting(HINT)

    @Slot()
    def close(self) -> None:
        """Choose no point and leave the room to the charts, until a point is chosen again."""
        self.clear()
        self._view.hide()

    def dismiss(self) -> bool:
        """Choose no point; return whether there was one."""
        is_open = bool(self._chosen)
        self.clear()
        return is_open

    @Slot(object)
    def _show_pictures(self, shown: PointsShown) -> None:
        self._shown = shown
        titles = [self._title(point.method) for point in shown.points]
        if len(shown.points) == 1:
            self._view.show_pictures(_one(shown, titles[0]))
        else:
            self._view.show_pictures(_two(shown, titles))

    @Slot(object)
    def _show_failure(self, error: Exception) -> None:
        self._view.show_waiting(f"It cannot be drawn: {error}")

    # To the stepper.

    @Slot()
    def step(self) -> None:
        """Open the run on the Step page, at the pinned pixel or where it is wrong first."""
        if self._shown is None:
            self._page.tell("Click a point first: its run opens in the stepper.")
            return
        shown = self._shown
        opening, pictures, point = shown.openings[-1], shown.pictures[-1], shown.points[-1]
        if opening is None:
            self._page.tell(f"{point.title} cannot be stepped: it is not a stage of the pipeline.")
            return
        if self._view.pin is not None and self._is_of_scene(pictures, opening.scene.size):
            opening = replace(opening, pixel=self._view.pin)
        self._page.step_to(StepRequest(opening, self._title(point.method)))

    @staticmethod
    def _is_of_scene(pictures: Pictures, size: tuple[int, int]) -> bool:
        """Return whether the pixels of a picture are those of the scene."""
        return pictures.result.shape[:2] == (size[1], size[0])

    @Slot()
    def step_to_divergence(self) -> None:
        """Open both runs on the Step page, where they first part ways."""
        if self._shown is None or len(self._shown.points) < 2:
            self._page.tell("Select two points first: click one, then Ctrl+click another.")
            return
        self._view.show_busy("Searching for the first divergence …")
        self._jobs.find_divergence(self._shown)

    @Slot(object)
    def _take_divergence(self, found: StepRequest | str) -> None:
        if self._shown is not None:
            self._show_pictures(self._shown)
        if isinstance(found, str):
            self._page.tell(found)
        else:
            self._page.step_to(found)

    @Slot(object)
    def _tell_no_divergence(self, error: Exception) -> None:
        if self._shown is not None:
            self._show_pictures(self._shown)
        self._page.refuse(f"They cannot be traced: {error}")

    @Slot()
    def copy(self) -> None:
        """Put the three pictures on the clipboard."""
        if self._shown is not None:
            copy_widget(self._view.linked)
            self._page.tell("Copied the pictures.")


def _one(shown: PointsShown, title: str) -> PicturesRecord:
    """Return what one method drew, the reference, and where they differ."""
    pictures = shown.pictures[0]
    scale = _scale(pictures.result, pictures.reference)
    return PicturesRecord(
        heading=f"{title}: {_amount(pictures.difference)}",
        buffers=(
            _buffer("picture", pictures.result, scale),
            _buffer("reference", pictures.reference, scale),
            GridBuffer("difference", pictures.difference, "signed"),
        ),
        titles=(title, "Reference", "Difference"),
        can_step=shown.openings[0] is not None,
    )


def _two(shown: PointsShown, titles: list[str]) -> PicturesRecord:
    """Return what two methods drew and where they differ: B minus A; of colours the largest channel."""
    first, second = shown.pictures
    if first.result.shape != second.result.shape:
        raise ValueError("two methods of one study must draw pictures of one size")
    amount = difference_of(first.result, second.result)
    scale = _scale(first.result, second.result)
    return PicturesRecord(
        heading=f"A and B: {_amount(amount)}",
        buffers=(
            _buffer("A", first.result, scale),
            _buffer("B", second.result, scale),
            GridBuffer("difference", amount, "signed"),
        ),
        titles=(f"A: {titles[0]}", f"B: {titles[1]}", "Difference, B − A"),
        can_step=shown.openings[1] is not None,
        can_diverge=None not in shown.openings,
    )


def difference_of(first: NDArray[np.float32], second: NDArray[np.float32]) -> NDArray[np.float32]:
    """Return (H, W) second minus first, of (H, W, C) colours the channel that differs most."""
    amount = second - first
    if amount.ndim == 2:
        return amount
    largest = np.abs(amount).argmax(axis=2)
    return np.take_along_axis(amount, largest[..., None], axis=2)[..., 0]


def _buffer(name: str, values: NDArray[np.float32], scale: tuple[float, float] | None) -> GridBuffer:
    kind: BufferKind = "color" if values.ndim == 3 else "scalar"
    return GridBuffer(name, values, kind, range=None if kind == "color" else scale)


def _scale(first: NDArray[np.float32], second: NDArray[np.float32]) -> tuple[float, float] | None:
    """Return one range for two pictures, so that equal values look alike."""
    finite = np.concatenate([values[np.isfinite(values)] for values in (first, second)])
    return (float(finite.min()), float(finite.max())) if len(finite) else None


def _amount(difference: NDArray[np.float32]) -> str:
    """Return in words how much of a picture differs."""
    differs = difference != 0
    count = int(np.count_nonzero(differs))
    if not count:
        return f"none of {differs.size:,} pixels differs."
    largest = number_text(float(np.nanmax(np.abs(difference))))
    return f"{count:,} of {differs.size:,} pixels differ; largest difference {largest}."
