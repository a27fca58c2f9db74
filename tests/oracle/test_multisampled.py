"""Four samples a pixel against OpenGL, sample for sample; needs no OpenGL."""

import json
from pathlib import Path

import numpy as np
import pytest

from core import Settings, draw_triangles
from tests.covering import in_turn
from tests.oracle.record_multisampled import FOLDER

FILES = sorted(path.stem for path in FOLDER.glob("*.npz"))
COLOR_TOLERANCE = {"sliver": 1e-3, "shared": 2e-4}
FILLS = ["spans", "hierarchy", "blocks", "bounding-box", "scanline"]


def read(path: Path) -> tuple[dict[str, np.ndarray], dict]:
    with np.load(path) as file:
        arrays = {name: file[name] for name in file.files}
    return arrays, json.loads(str(arrays.pop("options")))


@pytest.mark.parametrize(("name", "fill"), in_turn(FILES, FILLS))
def test_every_sample_shows_the_same_triangle(name: str, fill: str) -> None:
    case, options = read(FOLDER / f"{name}.npz")
    settings = Settings(
        antialiasing="msaa-4",
        fill=fill,
        cull=options["cull"],
        interpolation=options["interpolation"],
        provoking=options["provoking"],
        visibility="z-buffer" if options["depth_test"] else "last-drawn",
    )
    frame = draw_triangles(case["clip"], *options["size"], case["attributes"], settings=settings)
    assert np.array_equal(frame.samples.primitive, case["sample_primitive"])
    tolerance = COLOR_TOLERANCE.get(options["family"], 2e-5)
    assert np.abs(frame.samples.color - case["sample_color"]).max() <= tolerance
    mean = case["sample_color"].astype(float).mean(axis=0)
    assert np.abs(frame.color - mean).max() <= tolerance
    assert (case["sample_primitive"] != case["sample_primitive"][0]).any()


def test_families_are_recorded() -> None:
    assert {name.rsplit("_")[0] for name in FILES} >= {"single", "shared", "sliver", "depth", "mesh"}


@pytest.mark.parametrize("name", ["msaa_00", "msaa_02", "msaa_04"])
def test_the_cases_beside_the_project(shared_folder: Path, name: str) -> None:
    with np.load(shared_folder / "oracle" / f"{name}.npz") as file:
        case = {key: file[key] for key in file.files}
    visibility = "z-buffer" if json.loads(str(case["meta"]))["depth_test"] else "last-drawn"
    settings = Settings(antialiasing="msaa-4", visibility=visibility)
    width, height = case["size"].tolist()
    frame = draw_triangles(case["verts"], width, height, case["attrs"], settings=settings)
    assert np.array_equal(frame.samples.position, case["sample_pos"])
    assert np.array_equal(frame.samples.primitive, case["sample_prim"])
    assert np.abs(frame.samples.depth - case["sample_depth"]).max() <= 2e-6
    assert np.abs(frame.color - case["color"]).max() <= 2e-5
    assert np.array_equal(frame.primitive, case["prim"])
    assert np.array_equal(frame.depth, frame.samples.depth[0])
