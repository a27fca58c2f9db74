"""Tracing again after an edit: the pixels of primitives that did not change are those of the run before.

Most of a trace is work on pixels that know only of their own primitive: which are covered, what is interpolated,
their colour, their depth. All of it is made of numbers of the primitive, and no rule depends on what else is computed
with it, so where these numbers are the same bits, the results are. They are taken over; the same stages run on the
primitives that changed alone, and the rows are put together in drawing order. Where pixels of several primitives
meet, in the buffers, everything is looked at again: that is what those stages are about.

What changed is found by comparing (``unchanged``), so any edit will do: a corner that is dragged, a colour, undo.
"""

from collections.abc import Callable
from dataclasses import dataclass, field, replace
from typing import Any
from weakref import ReferenceType, ref

import numpy as np

from core.raster.coverage import Fragments, PixelTests
from core.raster.pixel_runs import Boxes, Runs, expand
from core.records.arrays import Flags, Floats, Integers, Singles
from core.records.cached import cached_property
from core.stages.fragment_color import Surface
from core.stages.vertices import Geometry
from core.trace.incremental.row_pieces import RowPieces, pieces_of
from core.trace.incremental.unchanged import unchanged_primitives
from core.trace.source import TraceSource
from core.trace.stage_rows import StageRows


@dataclass(frozen=True, eq=False)
class ChangedSource(TraceSource):
    """The primitives that changed, under the numbers that they have among all.

    It is given what it would compute, and not the source of all: each would keep the other in memory.
    """

    geometry: Geometry = field(kw_only=True)
    """All traced triangles."""
    _schedule: tuple[Boxes, Runs] = field(kw_only=True)
    """What all may touch, and what the fill looks at of those that changed."""


@dataclass(frozen=True, eq=False)
class Retrace(TraceSource):
    """A source that takes over what an earlier one has computed.

    Notes
    -----
    The earlier source is not kept in memory. It is there while an editor still shows it, and what is asked for after
    that is computed as in every source; so is what the earlier source itself had never been asked for.
    """

    earlier: "ReferenceType[TraceSource] | None" = None

    @cached_property
    def number_before(self) -> Integers | None:
        """(P,) int64, what number primitives had that did not change, -1: they did; ``None``: all, or nothing known."""
        earlier = None if self.earlier is None else self.earlier()
        if earlier is None:
            return None
        numbers = unchanged_primitives(self, earlier)
        return numbers if (numbers >= 0).any() else None

    @cached_property
    def changed(self) -> ChangedSource:
        """The primitives that changed."""
        assert self.number_before is not None
        run = self.scene, self.settings, self.triangle, self.region, self.before, self.lanes
        runs = self.runs.take(np.flatnonzero(self.number_before[self.runs.triangle] < 0))
        return ChangedSource(*run, geometry=self.geometry, _schedule=(self.boxes, runs))

    def _source_before(self) -> TraceSource | None:
        """Return the source that results can be taken over from: hold it as long as it is asked for them."""
        earlier = None if self.earlier is None else self.earlier()
        return None if self.number_before is None else earlier

    @cached_property
    def _fragment_pieces(self) -> RowPieces:
        """How fragments are put together; asked for while the source before is held."""
        earlier = self._source_before()
        assert earlier is not None
        assert self.number_before is not None
        return pieces_of(earlier.fragments.primitive, self.changed.fragments.primitive, self.number_before)

    def _joined(self, name: str) -> Any:
        """Return a result for all fragments where the previous one can be reused, else ``None``."""
        earlier = self._source_before()
        known = None if earlier is None else vars(earlier).get(name)
        return None if known is None else self._fragment_pieces.join_all(known, getattr(self.changed, name))

    @cached_property
    def tests(self) -> PixelTests:
        """Every pixel that is looked at."""
        earlier = self._source_before()
        before: PixelTests | None = None if earlier is None else vars(earlier).get("tests")
        if before is None or self.number_before is None:
            return super().tests
        new = self.changed.tests
        joined = pieces_of(before.primitive, new.primitive, self.number_before).join_all(before, new)
        return replace(joined, run=expand(self.runs.lengths)[0])

    @cached_property
    def fragments(self) -> Fragments:
        """(F) covered pixels, whether in depth range or not."""
        joined: Fragments | None = self._joined("fragments")
        return super().fragments if joined is None else joined

    @cached_property
    def interpolated(self) -> tuple[Floats, Floats]:
        """Weights (F, 3) and values (F, K) of the fragments."""
        joined: tuple[Floats, Floats] | None = self._joined("interpolated")
        return super().interpolated if joined is None else joined

    @cached_property
    def uv_slopes(self) -> Floats | None:
        """(4, F) float64 du/dx, dv/dx, du/dy, dv/dy of the fragments; ``None``: the texture filter needs none."""
        earlier = self._source_before()
        before: Floats | None = None if earlier is None else vars(earlier).get("uv_slopes")
        new = None if before is None else self.changed.uv_slopes
        if before is None or new is None:
            return super().uv_slopes
        return self._fragment_pieces.join(before.T, new.T).T

    @cached_property
    def inverse_w(self) -> Floats:
        """(F,) float64, 1/w at the fragments."""
        joined: Floats | None = self._joined("inverse_w")
        return super().inverse_w if joined is None else joined

    @cached_property
    def surface(self) -> Surface:
        """The fragments' colours."""
        joined: Surface | None = self._joined("surface")
        return super().surface if joined is None else joined

    @cached_property
    def depths(self) -> tuple[Floats, Flags, Singles]:
        """Window depth (F,), whether it is in range (F,), stored value (F,)."""
        joined: tuple[Floats, Flags, Singles] | None = self._joined("depths")
        return super().depths if joined is None else joined

    def rows_of(self, stage: str, make: Callable[[TraceSource], StageRows]) -> StageRows:
        """Return the rows of a stage; ``make`` makes those of a source."""
        earlier = self._source_before()
        before = None if earlier is None else earlier.known_rows.get(stage)
        if before is None or self.number_before is None:
            return super().rows_of(stage, make)
        new = make(self.changed)
        pieces = pieces_of(before.columns["primitive"], new.columns["primitive"], self.number_before)
        joined = pieces.join_all(before, new)
        columns = {**joined.columns, "primitive": pieces.primitive}
        self.known_rows[stage] = replace(joined, columns=columns)
        return self.known_rows[stage]


def after_edit(source: TraceSource, earlier: TraceSource) -> Retrace:
    """Return ``source`` as one that takes over what ``earlier`` has computed."""
    run = source.scene, source.settings, source.triangle, source.region, source.before, source.lanes
    return Retrace(*run, earlier=ref(earlier))
