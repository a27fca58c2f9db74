"""What the traces of several samples a pixel are made from: the pipeline, run on each of them.

Multisampling: the samples of one place in all pixels are a source of their own, whose triangles are moved so that they
lie at the pixels' centres; colours are those of the unmoved triangles. Supersampling: one source at n times the size.
"""

from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import NDArray

from core.antialiasing.resolve import at_sample, finer_raster, finer_scene, finer_settings, in_squares
from core.antialiasing.sampling import ROTATED_GRID
from core.coverage.fills import Fragments
from core.coverage.pixel_runs import Raster
from core.records.arrays import Flags, Floats, cached_property
from core.records.frame import Frame, StageCount
from core.resolved import resolve
from core.stages.declared import STAGES
from core.stages.fragments import fragment_values, fragments_at, owner_of, texture_slopes
from core.stages.geometry import Geometry
from core.stages.vertices import process_geometry
from core.trace.source import TraceSource


@dataclass(frozen=True, eq=False)
class SampleSource(TraceSource):
    """One of the four samples of every pixel."""

    whole: TraceSource | None = None
    """The pixels' own source."""
    sample: int = 0

    @cached_property
    def geometry(self) -> Geometry:
        """The traced triangles, the sample at the pixels' centres."""
        assert self.whole is not None
        return at_sample(self.whole.geometry, self.sample)

    @cached_property
    def start(self) -> Frame:
        """The buffers of the sample before the first row."""
        assert self.whole is not None
        frame = self.whole.start
        samples = frame.samples
        assert samples is not None
        return replace(
            frame,
            color=samples.color[self.sample],
            depth=samples.depth[self.sample],
            primitive=samples.primitive[self.sample],
            cover_count=samples.cover_count[self.sample],
            samples=None,
        )

    @property
    def seen(self) -> NDArray[np.int32]:
        """(H, W) int32, the triangle that the sample shows in the end, -1: none."""
        assert self.whole is not None
        samples = self.whole.picture.samples
        assert samples is not None
        shown: NDArray[np.int32] = samples.primitive[self.sample]
        return shown

    @cached_property
    def interpolated(self) -> tuple[Floats, Floats]:
        """Weights (F, 3) and values (F, K) of the fragments, at the pixels' centres."""
        assert self.whole is not None
        return fragment_values(self.whole.geometry, self.fragments, self.raster)

    @cached_property
    def uv_slopes(self) -> Floats | None:
        """(4, F) float64 du/dx, dv/dx, du/dy, dv/dy of the fragments, at the pixels' centres."""
        assert self.whole is not None
        return texture_slopes(self.whole.geometry, self.raster, self.fragments, self.interpolated[1])


@dataclass(frozen=True, eq=False)
class CenterSource(TraceSource):
    """What is shaded of four samples: one fragment for every triangle in a pixel, at the pixel's centre."""

    samples: tuple[SampleSource, ...] = ()

    @cached_property
    def geometry(self) -> Geometry:
        """The traced triangles, not moved."""
        assert self.samples[0].whole is not None
        return self.samples[0].whole.geometry

    @cached_property
    def fragments(self) -> Fragments:
        """(F) pixels with a covered sample, by owner, row and column."""
        owner, row, column = (
            np.concatenate(parts)
            for parts in zip(
                *((owner_of(f), f.row, f.column) for f in (s.fragments for s in self.samples)), strict=True
            )
        )
        once = np.unique(np.stack([owner, row, column], axis=1), axis=0)
        return fragments_at(self.geometry, once[:, 0], once[:, 2], once[:, 1])

    @property
    def is_tested_alone(self) -> bool:
        """Every covered sample of a fragment is tested."""
        return False

    @property
    def _passed(self) -> Flags:
        """(F,) bool, the fragments of which some sample passes."""
        return self._of_some_sample([source.depth_tests.passes for source in self.samples])

    @property
    def _left(self) -> Flags:
        """(F,) bool, the fragments of which some sample's depth is left in the end."""
        return self._of_some_sample([source.shaded for source in self.samples])

    def _of_some_sample(self, chosen: list[Flags]) -> Flags:
        pixels = self.raster.shape[0] * self.raster.shape[1]
        found = [
            (owner_of(source.fragments) * pixels + source.place)[flags]
            for source, flags in zip(self.samples, chosen, strict=True)
        ]
        return np.isin(owner_of(self.fragments) * pixels + self.place, np.concatenate(found))


@dataclass(frozen=True, eq=False)
class FinerSource(TraceSource):
    """The samples as the pixels of a picture of n times the size."""

    whole: TraceSource | None = None
    side: int = 2

    @cached_property
    def raster(self) -> Raster:
        """The samples of the pixels that are shown."""
        assert self.whole is not None
        return finer_raster(self.whole.raster, self.side)

    @cached_property
    def geometry(self) -> Geometry:
        """The traced triangles at n times the size."""
        assert self.whole is not None
        chosen = None if self.triangle is None else np.array([self.triangle])
        counts = {stage: StageCount() for stage in STAGES}
        geometry = process_geometry(self.scene, self.settings, counts, chosen)
        return in_squares(geometry, self.whole.settings, self.side)

    @cached_property
    def start(self) -> Frame:
        """The buffers of the samples before the first row, (n H, n W)."""
        assert self.whole is not None
        samples = self.whole.start.samples
        assert samples is not None
        return replace(
            self.whole.start,
            color=self._laid_out(samples.color),
            depth=self._laid_out(samples.depth),
            primitive=self._laid_out(samples.primitive),
            cover_count=self._laid_out(samples.cover_count),
            samples=None,
        )

    @property
    def seen(self) -> NDArray[np.int32]:
        """(n H, n W) int32, the triangle that each sample shows in the end, -1: none."""
        assert self.whole is not None
        samples = self.whole.picture.samples
        assert samples is not None
        return self._laid_out(samples.primitive)

    def _laid_out(self, by_place: np.ndarray) -> np.ndarray:
        """Return samples (S, H, W, ...) as a picture (n H, n W, ...)."""
        side = self.side
        _, height, width, *channels = by_place.shape
        squares = by_place.reshape(side, side, height, width, *channels)
        return np.moveaxis(squares, (0, 1), (1, 3)).reshape(side * height, side * width, *channels)


def stepped_sources(whole: TraceSource) -> tuple[tuple[TraceSource, ...], TraceSource]:
    """Return the sources of all fragments that are stepped, and the source of those that are shaded."""
    sampling = resolve(whole.settings).sampling
    if sampling.count == 1:
        return (whole,), whole
    if sampling.side:
        finer = finer_source(whole, sampling.side)
        return (finer,), finer
    samples = sources_of_samples(whole)
    return samples, center_source(whole, samples)


def count_fragments(whole: TraceSource) -> tuple[int, int, int, int, int]:
    """Count pixels or samples that are tested and covered, what is interpolated and shaded, what passes the depth test.

    Interpolation comes before the depth test, and shading, too, where it is late: what is hidden in the end counts.
    """
    sources, shaded = stepped_sources(whole)
    fragments = [len(source.fragments) for source in sources]
    is_filled = whole.geometry.outlines is None
    tested = [int(source.runs.lengths.sum()) for source in sources] if is_filled else fragments
    passed = sum(int(source.depth_tests.passes.sum()) for source in sources)
    return sum(tested), sum(fragments), len(shaded.fragments), int(shaded.shaded.sum()), passed


def center_source(whole: TraceSource, samples: tuple[SampleSource, ...]) -> CenterSource:
    """Return the source of what is shaded of four samples."""
    return CenterSource(
        whole.scene, whole.settings, whole.triangle, whole.region, whole.before, whole.lanes, samples=samples
    )


def sources_of_samples(whole: TraceSource) -> tuple[SampleSource, ...]:
    """Return the sources of the four samples."""
    return tuple(
        SampleSource(
            whole.scene,
            whole.settings,
            whole.triangle,
            whole.region,
            whole.before,
            whole.lanes,
            whole=whole,
            sample=sample,
        )
        for sample in range(len(ROTATED_GRID))
    )


def finer_source(whole: TraceSource, side: int) -> FinerSource:
    """Return the source of ``side`` x ``side`` samples a pixel."""
    scene, settings = finer_scene(whole.scene, side), finer_settings(whole.settings)
    run = scene, settings, whole.triangle, None, whole.before, whole.lanes
    return FinerSource(*run, whole=whole, side=side)
