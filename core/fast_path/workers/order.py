"""What is to be drawn, by one process as a whole or by several in bands of rows."""

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray

from core.fast_path.draw import draw_picture
from core.fast_path.record import Picture
from core.records.arrays import Flags, Integers, read_only
from core.scene import AnyScene
from core.settings import Settings


@dataclass(frozen=True, eq=False)
class Order:
    """What is to be drawn, by however many processes."""

    scene: AnyScene
    settings: Settings
    encoding: str
    depth_at: Integers | None
    out: NDArray[np.uint8] | None

    def draw(
        self, out: NDArray[np.uint8] | None, rows: tuple[int, int] | None = None, plain_colors: bool = False
    ) -> Picture:
        """Draw rows from first to end, or all, in this process; pixels go to ``out`` (H, W, 4)."""
        return draw_picture(
            self.scene,
            self.settings,
            encoding=self.encoding,
            depth_at=self.depth_at if rows is None else self.depth_in(*rows),
            region=None if rows is None else self.region(*rows),
            out=out,
            plain_colors=plain_colors,
        )

    def region(self, first: int, end: int) -> tuple[int, int, int, int]:
        """Return the region of rows ``first`` to ``end``."""
        return 0, first, self.scene.size[0], end - first

    def depth_in(self, first: int, end: int) -> Integers | None:
        """Return the places in the band of rows ``first`` to ``end`` whose depth is asked for."""
        return (
            None if self.depth_at is None else self.depth_at[self.is_in(first, end)] - first * self.shape[1]
        )

    def is_in(self, first: int, end: int) -> Flags:
        """Return which pixels whose depth is asked for (N,) are in rows ``first`` to ``end``."""
        assert self.depth_at is not None
        columns = self.shape[1]
        return (self.depth_at >= first * columns) & (self.depth_at < end * columns)

    def joined_depth(
        self, rows: Sequence[tuple[int, int]], of_bands: Sequence[NDArray[Any] | None]
    ) -> NDArray[Any] | None:
        """Return the depth (N,) that is asked for, from that of the bands of ``rows``."""
        if self.depth_at is None or of_bands[0] is None:
            return None
        depth = np.empty(len(self.depth_at), of_bands[0].dtype)
        for band, found in zip(rows, of_bands, strict=True):
            depth[self.is_in(*band)] = found
        return read_only(depth)

    @property
    def shape(self) -> tuple[int, int, int]:
        """Of the pixels: rows, columns, 4."""
        width, height = self.scene.size
        return height, width, 4
