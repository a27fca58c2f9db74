"""The cases recorded from a real OpenGL, where they lie beside the project: identical triangles everywhere.

The tolerances are those of the recording: coverage is identical but where OpenGL clips and snaps again
(families ``near`` and ``tex``), depth and attributes differ by OpenGL's float32.
"""

import json
from pathlib import Path

import numpy as np
import pytest

from core import Frame, Settings, Texture, draw_triangles
from tests.core.drawing import TESTING_FILLS
from tests.covering import in_turn

CASES = sorted(
    path.stem
    for path in (Path(__file__).resolve().parents[2].parent / "shared" / "oracle").glob("*.npz")
    if path.stem.split("_")[0] in ("single", "shared", "sliver", "near", "tex", "depth", "mesh")
)
PIXELS_ALLOWED = {"near": 2, "tex": 2}
DEPTH_TOLERANCE = {"shared": 2e-5, "sliver": 5e-4, "near": 1e-5}
COLOR_TOLERANCE = {"shared": 2e-4, "sliver": 1e-3, "tex": 5e-4}
INTERPOLATION = {"smooth": "perspective", "noperspective": "affine", "flat": "flat"}
FILTER = {"nearest": "nearest", "linear": "bilinear"}


def load(folder: Path, name: str) -> tuple[dict[str, np.ndarray], dict]:
    with np.load(folder / "oracle" / f"{name}.npz") as case:
        arrays = {key: case[key] for key in case.files}
    return arrays, json.loads(str(arrays.pop("meta")))


def settings_of(meta: dict, **changes: str) -> Settings:
    values = {
        "cull": meta["cull"] or "none",
        "interpolation": INTERPOLATION[meta["interp"]],
        "provoking": meta["provoking"],
        "visibility": "z-buffer" if meta["depth_test"] else "last-drawn",
        **changes,
    }
    if meta.get("filter"):
        values |= {"texture_filter": FILTER[meta["filter"]], "wrap": meta["wrap"]}
    return Settings(**values)


def draw(case: dict[str, np.ndarray], meta: dict, **changes: str) -> Frame:
    width, height = (int(n) for n in case["size"])
    texture = Texture(case["texture"]) if "texture" in case else None
    return draw_triangles(case["verts"], width, height, case["attrs"], texture, settings_of(meta, **changes))


@pytest.mark.parametrize("name", CASES)
def test_pixels_depth_and_colour(shared_folder: Path, name: str) -> None:
    case, meta = load(shared_folder, name)
    family = name.split("_")[0]
    frame = draw(case, meta)
    same = frame.primitive == case["prim"]
    assert (~same).sum() <= PIXELS_ALLOWED.get(family, 0)
    assert np.abs(frame.depth - case["depth"])[same].max() <= DEPTH_TOLERANCE.get(family, 2e-6)
    differing = (np.abs(frame.color - case["color"]).max(axis=2) > COLOR_TOLERANCE.get(family, 2e-5)) & same
    nearest = meta.get("filter") == "nearest"
    assert differing.sum() <= (1e-4 * differing.size if nearest else 0)
    if "uv" in case:
        drawn = same & (case["prim"] >= 0)
        assert np.abs(frame.attributes - case["uv"])[drawn].max() <= 2e-4
    if "count" in case:
        assert np.array_equal(frame.cover_count, case["count"])


@pytest.mark.parametrize(("name", "fill"), in_turn(CASES, TESTING_FILLS))
def test_every_fill_draws_every_case_alike(shared_folder: Path, name: str, fill: str) -> None:
    case, meta = load(shared_folder, name)
    if fill == "brute-force" and name.startswith("mesh"):
        case |= {key: case[key][::16] for key in ("verts", "attrs")}
    frame, usual = draw(case, meta, fill=fill), draw(case, meta)
    for buffer in ("primitive", "depth", "color", "attributes", "cover_count"):
        assert np.array_equal(getattr(frame, buffer), getattr(usual, buffer)), buffer


def test_fixed_depth_shows_the_same_triangles_as_opengl(shared_folder: Path) -> None:
    for name in CASES:
        case, meta = load(shared_folder, name)
        differing = draw(case, meta, fill="spans", depth="fixed-38").primitive != case["prim"]
        assert differing.sum() <= PIXELS_ALLOWED.get(name.split("_")[0], 0), name


def test_clipping_draws_every_case_within_the_tolerance_of_new_corners(shared_folder: Path) -> None:
    for name in CASES:
        case, meta = load(shared_folder, name)
        differing = draw(case, meta, clipping="sutherland-hodgman").primitive != case["prim"]
        allowed = 2 if name.split("_")[0] in PIXELS_ALLOWED or meta.get("guard") else 0
        assert differing.sum() <= allowed, name


@pytest.mark.parametrize("name", [name for name in CASES if name.startswith("mesh")])
def test_inverse_w_shows_the_same_triangles_of_a_mesh(shared_folder: Path, name: str) -> None:
    case, meta = load(shared_folder, name)
    z, inverse_w = draw(case, meta), draw(case, meta, depth="inverse-w")
    # Where two triangles meet, float32 may tell either of them the nearer.
    assert (z.primitive != inverse_w.primitive).mean() <= 1e-3


def test_the_recorded_families_are_all_read(shared_folder: Path) -> None:
    assert {name.split("_")[0] for name in CASES} == {
        "single",
        "shared",
        "sliver",
        "near",
        "tex",
        "depth",
        "mesh",
    }
