"""Each scene shows what it is named for, by its own settings: one claim of its card for each."""

from dataclasses import dataclass, replace
from functools import cached_property

import numpy as np
import pytest

from app.files.open_any import open_any
from core import Frame, Trace, draw_picture, render
from core.stages.before_matrices import before_matrices
from core.tessellation.measured_dice import disc
from lessons.lectures.scenes import ALL_SCENES
from lessons.shapes import RED_GREEN_BLUE


@dataclass
class Shown:
    """A scene as it is opened."""

    name: str

    @cached_property
    def document(self):
        return open_any(self.name).document

    @cached_property
    def run(self) -> Trace:
        return self.document.make_trace()

    def frame(self, **chosen: str) -> Frame:
        """The whole picture, with other settings for those that are chosen."""
        return render(self.document.traced_scene, replace(self.document.settings, **chosen))

    def ids(self, **chosen: str) -> np.ndarray:
        return self.frame(**chosen).primitive

    def pixels(self, **chosen: str) -> list[tuple[int, int]]:
        return [(x, y) for y, x in np.argwhere(self.frame(**chosen).cover_count).tolist()]

    def column(self, stage: str, name: str) -> np.ndarray:
        return self.run.stage(stage).columns[name]

    def kinds(self, stage: str) -> set[str]:
        steps = self.run.stage(stage).steps
        return {steps.kinds[kind] for kind in steps.kind}

    def clipped(self) -> tuple[float, float]:
        """The last t of entry and exit."""
        found = (self.column("raster", name) for name in ("t_enter", "t_leave"))
        enter, leave = (values[np.isfinite(values)][-1] for values in found)
        return round(float(enter), 9), round(float(leave), 9)


def once(shown: Shown) -> bool:
    """Whether every pixel is drawn once at most, some lie on an edge, and another rule draws some twice."""
    is_tied = "tie" in shown.run.stage("raster").marks and shown.run.stage("raster").marks["tie"].any()
    more = shown.frame(fill_rule="inclusive").cover_count.max() > 1
    return bool(shown.frame().cover_count.max() == 1 and is_tied and more)


def is_clear_of(shown: Shown, far: float) -> bool:
    """Whether depths meet an empty buffer of ``far``, and some fail."""
    before, passes = shown.column("depth", "before"), shown.column("depth", "passes")
    return bool((before == far).any() and not passes.all() and passes.any())


def most_cyan(shown: Shown) -> int:
    """By how much the pixel nearest to cyan differs from it on the screen, in a channel."""
    pixels = draw_picture(shown.document.scene, shown.document.settings).pixels[..., :3].astype(int)
    return int(np.abs(pixels - (0, 255, 255)).max(axis=2).min())


def brightest(shown: Shown, **chosen: str) -> float:
    """The largest channel of any pixel, linear."""
    return round(float(shown.frame(**chosen).color[..., :3].max()), 3)


def unlike(shown: Shown, **chosen: str) -> int:
    return int((shown.frame().color != shown.frame(**chosen).color).any(axis=2).sum())


def smeared(shown: Shown, history: str) -> float:
    """How far the picture is from the mean of 16 samples of the scene at rest, which no history has."""
    still = render(
        replace(shown.document.scene, motion=None), replace(shown.document.settings, antialiasing="ssaa-16")
    )
    return float(np.sqrt(np.mean((shown.frame(history=history).color - still.color) ** 2)))


FIRST_TABLE = Shown("jubair-z-buffer")
CLAIMS = {
    "single-triangle": lambda s: (s.document.scene.attributes[0] == RED_GREEN_BLUE).all(),
    "shared-edge": once,
    "fan": lambda s: once(s) and len(s.run.stage("raster").rows_at_pixel(32, 24)) == 16,
    "segment": lambda s: s.column("raster", "decision")[1:].tolist() == [-2, 4, -6, 0, -10, -4, 2, -8],
    "clipped-segment": lambda s: s.clipped() == (round(2 / 9, 9), round(8 / 9, 9)),
    "polygon-window": lambda s: {f"side {k}" for k in range(5)} <= set(s.column("raster", "border")),
    "line-strip": lambda s: s.frame().cover_count.max() == 1 and len(np.unique(s.ids())) == 6,
    "points": lambda s: len(s.pixels()) == 4 and s.document.triangle_count == 5,
    "triangle-strip": lambda s: once(s) and (s.run.stage("cull").columns["facing"] >= 0).all(),
    "polygon": lambda s: once(s) and s.document.triangle_count == 8,
    "polygon-holes": lambda s: "active-enter" in s.kinds("raster") and len(s.document.scene.rings) == 3,
    "weiler-atherton": lambda s: {"wa-start", "wa-switch"} <= s.kinds("clip"),
    "connecting-edges": lambda s: (
        "sh-out-in" in s.kinds("clip") and s.pixels() == s.pixels(polygon_clipping="weiler-atherton")
    ),
    "pentagram": lambda s: (16, 12) not in s.pixels() and (16, 12) in s.pixels(polygon_fill="non-zero"),
    "near-plane": lambda s: set(np.sign(s.column("transform", "after_w"))) == {-1, 1},
    "intersecting": lambda s: unlike(s, visibility="painters") > 100,
    "crossing-glass": lambda s: np.any(
        s.run.source.picture.color
        != render(s.run.source.scene, replace(s.run.source.settings, visibility="painters")).color
    ),
    "bar-and-wire": lambda s: s.run.source.picture.color[10, 38, 0] > 0.1 and not s.pixels().count((38, 10)),
    "circle-of-bars": lambda s: (
        unlike(s, visibility="ray-casting") == 8 and len(s.run.stage("depth").extra["sorted"].pairs) == 3
    ),
    "depth-table": lambda s: is_clear_of(s, np.inf),
    "four-layers": lambda s: (
        not unlike(s, depth_test_time="late")
        and np.sum(s.run.stage("shade").marks["depth-failed"]) == 3 * 768
    ),
    "two-buffers": lambda s: (
        np.sum(
            (s.column("resolve", "above") >= 0)
            & (s.column("resolve", "above") != s.column("resolve", "picture"))
        )
        == 3
    ),
    "z-fighting": lambda s: unlike(s, depth="z-24") > 300 and unlike(s, depth="z-16") == 0,
    "textured-floor": lambda s: unlike(s, interpolation="affine") > 1000,
    "moving-camera": lambda s: 3 * smeared(s, "reprojected") < smeared(s, "kept"),
    "lit-floor": lambda s: (brightest(s), brightest(s, shading="gouraud")) == (0.787, 0.221),
    "box-in-light": lambda s: np.sum(s.column("shade", "light_share") == 0) == 118,
    "mirror-cube": lambda s: (
        unlike(s, environment="rays") > 0 and np.sum(s.column("shade", "mirror") == 1) == 449
    ),
    "cube": lambda s: (s.document.triangle_count, len(np.unique(s.ids() // 2)) - 1) == (12, 3),
    "boxes-around": lambda s: (
        not unlike(s, object_culling="none") and np.sum(s.column("cull", "box_verdict") == "outside") >= 5
    ),
    "boxes-behind-wall": lambda s: (
        not unlike(s, object_culling="none")
        and (np.sum(s.column("cull", "is_hidden")), len(set(range(9)) - set(s.ids()[s.ids() >= 0] // 12)))
        == (3, 4)
    ),
    "two-boxes": lambda s: (
        not unlike(s, visibility="z-buffer") and {"tree-missed", "tree-leaf"} < s.kinds("depth")
    ),
    "bent-bar": lambda s: (
        unlike(s, skinning="dual-quaternion") > 20 and {"bone", "skin"} < s.kinds("transform")
    ),
    "twisted-tube": lambda s: len(s.pixels(skinning="dual-quaternion")) > len(s.pixels()) + 50,
    "blended-bar": lambda s: "blend" in s.kinds("transform") and not unlike(s, skinning="dual-quaternion"),
    "curve": lambda s: s.document.triangle_count == 6 and len(s.column("transform", "level")) > 7 * 6,
    "curve-in-depth": lambda s: set(s.document.scene.curves.control[0, :, 3]) == {1, 2, 4},
    "hill": lambda s: s.document.triangle_count == 72 and "normal" in s.kinds("transform"),
    "diced-hill": lambda s: {"cut-split", "cut-dice"} <= s.kinds("transform"),
    "diced-ball": lambda s: (
        len(before_matrices(s.document.scene, s.document.settings).meshes[0].positions) == 1352
        and ((s.ids() >= 0) != disc()).sum() == 16
    ),
    "folded-glass": lambda s: (
        s.column("depth", "length").max() == 4
        and np.any(
            s.frame().color
            != render(s.document.scene, replace(s.document.settings, visibility="z-buffer")).color
        )
    ),
    "cracked-patches": lambda s: (
        (counts := s.column("transform", "count"))[counts > 0].tolist() == [2, 1, 3, 1]
        and s.frame().cover_count[4:44].min(axis=0).size == 64
        and len(s.pixels(tessellation="uniform")) > len(s.pixels())
    ),
    "teapot": lambda s: s.document.triangle_count == 2256,
    "sphere": lambda s: s.document.triangle_count == 2208 and "lit" in s.kinds("shade"),
    "torus": lambda s: s.run.stage("depth").marks["depth-failed"].any(),
    "knot": lambda s: s.document.triangle_count == 20_000,
    "zwicker-4x3": lambda s: s.document.scene.size == (4, 3) and len(s.pixels()) == 6,
    "zwicker-shared-edge": lambda s: once(s) and len(s.pixels()) == 12,
    "zwicker-z-buffer": lambda s: (
        is_clear_of(s, 0)
        and (s.frame().depth == np.nan_to_num(s.document.scene.table.depths).max(axis=0)).all()
    ),
    "zwicker-perspective": lambda s: (
        unlike(s, interpolation="affine") > 300
        and (s.document.scene.clip[..., 3] > 0).all()
        and s.kinds("clip") == {"untouched"}
    ),
    "pellacini-line": lambda s: s.pixels() == [(0, 0), (1, 0), (2, 1), (3, 1), (4, 2), (5, 2)],
    "pellacini-rectangle": lambda s: (
        np.bincount([x for x, _ in s.pixels()]).tolist() == [0, *[1, 2] * 6, 1]
        and len(s.pixels(line="midpoint")) == 13
    ),
    "pellacini-frustum": lambda s: (
        np.unique(s.ids()).tolist() == [-1, 0] and 0.75 in s.column("clip", "t").tolist()
    ),
    "pellacini-z-buffer": lambda s: (s.frame().depth == FIRST_TABLE.frame().depth).all(),
    "jubair-triangle": lambda s: (s.frame().color[0, 1, :3] == s.column("interpolate", "weights")[1]).all(),
    "jubair-cyrus-beck": lambda s: s.clipped() == (round(1 / 6, 9), round(7 / 9, 9)),
    "jubair-rejected": lambda s: s.clipped() == (1 / 2, 1 / 4) and not s.pixels(),
    "jubair-parallel": lambda s: len(s.pixels()) == 5 and not s.pixels(line_clipping="cyrus-beck"),
    "jubair-degenerate": lambda s: {"clip-parallel", "clip-outside", "clip-kept"} <= s.kinds("raster"),
    "jubair-backfaces": lambda s: (len(s.pixels()), len(s.pixels(cull="back-axis"))) == (619, 468),
    "jubair-z-buffer": lambda s: is_clear_of(s, np.inf) and s.document.scene.size == (8, 8),
    "lmu-clipped": lambda s: s.clipped() == (1 / 4, 1),
    "lmu-line": lambda s: (3, 2) in s.pixels() and s.document.settings.line == "bresenham-lecture",
    "lmu-falling-line": lambda s: s.column("raster", "decision")[1] == -1,
    "lmu-scanline-triangle": lambda s: (
        len({y for _, y in s.pixels()}) == 12 and s.document.settings.fill == "scanline-lecture"
    ),
    "lmu-equal-depths": lambda s: (
        s.ids()[1:3, 2:4].tolist() == [[0, 0], [0, 0]]
        and (np.diff(s.document.scene.table.depths[:, 1:3, 2:4], axis=0) == 0).all()
    ),
    "lmu-three-js": lambda s: not s.pixels(cull="front") and most_cyan(s) < 16,
    "lmu-minimal-shaders": lambda s: (
        s.frame().color[s.ids() >= 0].tolist() == [[1, 1, 0, 1]] * len(s.pixels()) and len(s.pixels()) > 900
    ),
    "lmu-shaders": lambda s: s.pixels() == Shown("lmu-three-js").pixels() and not s.pixels(cull="front"),
}


@pytest.mark.parametrize("name", CLAIMS)
def test_a_scene_shows_what_it_is_named_for(name):
    assert CLAIMS[name](Shown(name))


def test_every_scene_claims_something():
    assert list(CLAIMS) == list(ALL_SCENES)
