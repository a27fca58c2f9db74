"""Record small cases and what OpenGL draws of them, for the tests that run without OpenGL.

From the top of the project, where the extra ``gpu`` is installed::

    python -m tests.oracle.record_cases

makes the files of tests/oracle/cases afresh, from fixed seeds. See the README there.
"""

import argparse
import json
import sys
from collections import Counter
from pathlib import Path
from typing import Any

import numpy as np

from app.opengl_check.cases import Case, OpenGLMissingError, OpenGLRenderer, Picture
from app.opengl_check.families import FAMILIES, make_case
from core.scene import Texture

FOLDER = Path(__file__).parent / "cases"
SEED = 0
LARGEST = 26
"""Largest side of a raster, in pixels: the files stay small."""
LARGEST_OF = {"mesh": 40, "offscreen": 32, "octants": 48}
PER_VARIANT = {
    "single": 4,
    "shared": 4,
    "sliver": 3,
    "offscreen": 3,
    "clipped": 2,
    "near": 6,
    "depth": 4,
    "octants": 3,
    "line-ends": 3,
    "off-grid": 2,
    "one-ended": 5,
    "ground": 4,
    "any-w": 3,
    "zero-w": 3,
    "guard-band": 3,
    "depth-planes": 2,
}
"""Cases to keep of each variant (culling, provoking corner, wrap ...) of a family; one of the others."""
TRIED = 60
"""Random cases of a family that are looked through for its variants."""


def chosen_cases(family: str, renderer: OpenGLRenderer) -> list[tuple[Case, Picture]]:
    """Return the first cases of each variant of ``family`` that show something, and OpenGL's picture."""
    kept: list[tuple[Case, Picture]] = []
    counts: Counter[tuple[object, ...]] = Counter()
    for number in range(TRIED):
        case = make_case(family, SEED, number, LARGEST_OF.get(family, LARGEST))
        variant = (case.cull, case.interpolation, case.provoking, case.texture_filter, case.wrap)
        picture = renderer.draw(case)
        if counts[variant] < PER_VARIANT.get(family, 1) and (picture.primitive >= 0).any():
            counts[variant] += 1
            kept.append((case, picture))
    return kept


def write_case(path: Path, case: Case, picture: Picture, renderer: str) -> None:
    """Write a case and OpenGL's picture of it to an ``.npz`` file."""
    names = ("family", "cull", "depth_test", "interpolation", "provoking", "texture_filter", "wrap", "guard")
    options = {name: getattr(case, name) for name in names} | {"size": case.size, "renderer": renderer}
    arrays: dict[str, Any] = {
        "clip": case.clip,
        "attributes": case.attributes,
        "color": picture.color,
        "depth": picture.depth,
        "primitive": picture.primitive.astype(np.int16),
    }
    if case.texture is not None:
        arrays["texture"] = case.texture.pixels
    np.savez_compressed(path, options=np.array(json.dumps(options)), **arrays)


def read_case(path: Path) -> tuple[Case, Picture]:
    """Read what `write_case` wrote."""
    with np.load(path) as file:
        options = json.loads(str(file["options"]))
        del options["renderer"]
        options["size"] = tuple(options["size"])
        texture = Texture(file["texture"]) if "texture" in file else None
        case = Case(clip=file["clip"], attributes=file["attributes"], texture=texture, **options)
        return case, Picture(file["color"], file["depth"], file["primitive"].astype(np.int32))


def main() -> int:
    """Write all files and say how many bytes they take."""
    parser = argparse.ArgumentParser(
        prog="python -m tests.oracle.record_cases", description=__doc__.split("\n")[0]
    )
    parser.add_argument("--folder", type=Path, default=FOLDER, help="where to (default: %(default)s)")
    folder = parser.parse_args().folder
    try:
        with OpenGLRenderer() as renderer:
            folder.mkdir(parents=True, exist_ok=True)
            for path in folder.glob("*.npz"):
                path.unlink()
            for family in FAMILIES:
                for number, (case, picture) in enumerate(chosen_cases(family, renderer)):
                    write_case(folder / f"{family}_{number}.npz", case, picture, renderer.name)
            name = renderer.name
    except OpenGLMissingError as error:
        print(error, file=sys.stderr)
        return 2
    files = list(folder.glob("*.npz"))
    print(
        f"{len(files)} cases drawn by {name}, {sum(path.stat().st_size for path in files):,} bytes: {folder}"
    )
    return 0


if __name__ == "__main__":
    sys.exit(main())
