"""``rasterscope diagnose``: homework as PNG, npz and CSV, and one sentence for what is no picture."""

import io
import re
import zipfile
import zlib
from pathlib import Path

import numpy as np
import pytest
from PIL import Image

from app.files.drawn_pictures import read_drawn
from core import Settings, render
from core.framebuffer.display import to_display
from lessons.diagnosis import compared_text, diagnose
from lessons.scenes import make_scene
from tests.app.cli.cli_runs import refused, run_program

SCENE = "shared-edge"
INCLUSIVE = render(make_scene(SCENE), Settings(fill_rule="inclusive"))
COLORS = to_display(INCLUSIVE.color).pixels[..., :3]
PLACES = np.argwhere(INCLUSIVE.primitive >= 0)[:, ::-1]


def png(path: Path) -> None:
    Image.fromarray(np.ascontiguousarray(COLORS[::-1])).save(path)


@pytest.mark.parametrize("ending", ["ppm", "bmp", "tga"])
def test_other_images_are_read(ending: str, tmp_path: Path) -> None:
    path = tmp_path / f"homework.{ending}"
    png(path)
    np.testing.assert_array_equal(read_drawn(path, (64, 48)).colors, COLORS)


def test_a_lossy_image_is_compared_as_it_was_saved(tmp_path: Path) -> None:
    path, scene = tmp_path / "homework.jpg", make_scene(SCENE)
    png(path)
    diagnosis = diagnose(scene, Settings(), read_drawn(path, (64, 48)))
    assert diagnosis.found[0].name == "all-edges-inclusive"
    assert diagnose(scene, Settings(fill_rule="inclusive"), read_drawn(path, (64, 48))).is_right
    assert "lossy" in compared_text(diagnosis.drawn)
    ink = np.where(INCLUSIVE.primitive[::-1] >= 0, 255, 0).astype(np.uint8)
    Image.fromarray(ink).save(path)
    covered = diagnose(scene, Settings(), read_drawn(path, (64, 48)))
    assert covered.drawn.covered is not None
    assert "all-edges-inclusive" in [each.name for each in covered.found]


def palette_png(path: Path) -> None:
    Image.fromarray((INCLUSIVE.primitive[::-1] >= 0).astype(np.uint8) * 255).convert("P").save(path)


def color_npz(path: Path) -> None:
    np.savez(path, color=INCLUSIVE.color, depth=INCLUSIVE.depth)


def pixel_npz(path: Path) -> None:
    np.savez(path, pixels=PLACES)


def number_npz(path: Path) -> None:
    np.savez(path, primitive=INCLUSIVE.primitive)


def number_csv(path: Path) -> None:
    lines = [f"{column},{row},{INCLUSIVE.primitive[row, column]}" for column, row in PLACES]
    path.write_text("\n".join(["column,row,triangle", *lines]))


def color_csv(path: Path) -> None:
    path.write_text("\n".join(f"{x}, {y}, {', '.join(map(str, COLORS[y, x]))}" for x, y in PLACES))


@pytest.mark.parametrize("write", [png, palette_png, color_npz, pixel_npz, number_npz, number_csv, color_csv])
def test_pictures_of_every_kind_are_read_from_the_bottom_row_up(write, tmp_path: Path) -> None:
    path = tmp_path / f"homework.{write.__name__.split('_')[-1]}"
    write(path)
    drawn = read_drawn(path, (64, 48))
    is_covered = INCLUSIVE.primitive >= 0
    if write is pixel_npz:
        np.testing.assert_array_equal(drawn.covered, is_covered)
    elif write in (number_npz, number_csv):
        np.testing.assert_array_equal(drawn.primitive, INCLUSIVE.primitive)
    else:
        wanted = is_covered[..., None] * [255, 255, 255] if write is palette_png else COLORS
        np.testing.assert_array_equal(drawn.colors, wanted)


def test_homework_is_diagnosed(tmp_path: Path) -> None:
    path = tmp_path / "homework.png"
    png(path)
    done = run_program("diagnose", SCENE, path)
    assert done.returncode == 0, done.stderr
    lines = done.stdout.splitlines()
    assert lines[0].startswith("mistake all-edges-inclusive: Every centre on an edge was counted")
    assert "method fill_rule=inclusive: Fill rule: " in done.stdout
    assert lines[-2].startswith("9 of 3072 pixels differ from the right picture: (12, 6) ")
    right = run_program("diagnose", SCENE, path, "--set", "fill_rule=inclusive").stdout.splitlines()
    assert right == [
        "right: every pixel has the colour that this scene and its settings draw there",
        "scene: Two triangles sharing an edge, 64 x 48 pixels. Compared: the colours of all pixels. "
        "Not compared: depths and numbers of triangles.",
    ]


def test_what_fits_nothing_is_unknown(tmp_path: Path) -> None:
    pixels = np.array([[x, y] for x in range(30) for y in range(2)])
    np.savez(tmp_path / "a.npz", pixels=pixels)
    lines = run_program("diagnose", SCENE, tmp_path / "a.npz").stdout.splitlines()
    assert lines[0] == "unknown: no mistake on the shelf and no method makes this picture"
    assert re.match(r"\d+ of 3072 pixels differ from the right picture: \(0, 0\) ", lines[1])
    assert re.search(r" and \d+ more$", lines[1])


def zipped(array: bytes) -> bytes:
    file = io.BytesIO()
    with zipfile.ZipFile(file, "w") as archive:
        archive.writestr("color.npy", array)
    return file.getvalue()


def npz(**arrays) -> bytes:
    file = io.BytesIO()
    np.savez(file, **arrays)
    return file.getvalue()


def png_of(columns: int, rows: int) -> bytes:
    file = io.BytesIO()
    Image.new("RGB", (columns, rows)).save(file, "PNG")
    return file.getvalue()


def png_head(columns: int, rows: int) -> bytes:
    """Return the beginning of a PNG file, of as many bits as there are pixels."""
    size = columns.to_bytes(4) + rows.to_bytes(4)
    head = b"IHDR" + size + b"\x01\0\0\0\0"
    return b"\x89PNG\r\n\x1a\n" + b"\0\0\0\x0d" + head + zlib.crc32(head).to_bytes(4) + b"\0\0\0\x09IDAT"


def garbled() -> bytes:
    """Return an npz file whose compressed bytes are no such bytes."""
    file = io.BytesIO()
    np.savez_compressed(file, color=np.zeros((48, 64, 3)))
    content = bytearray(file.getvalue())
    content[80:120] = b"\xff" * 40
    return bytes(content)


HUGE = b"{'descr': '<f8', 'fortran_order': False, 'shape': (48, 64, 99999999999), }".ljust(117) + b"\n"


@pytest.mark.parametrize(
    ("name", "content", "wanted"),
    [
        ("a.txt", b"", "expected a picture as .png, .ppm, .pgm, .bmp, .tga, .jpg, .jpeg, .npz, .csv"),
        ("a.png", b"", "expected a PNG picture"),
        ("a.png", b"no picture", "expected a PNG picture"),
        ("a.png", png_of(64, 48)[:-40], "expected a whole PNG picture"),
        ("a.jpg", png_of(64, 48), "expected a JPEG picture"),
        ("a.tga", b"no picture", "expected a TGA picture"),
        ("a.ppm", b"P6 48 64 255 ", "expected a picture of 64 x 48 pixels, got 48 x 64"),
        ("a.ppm", b"P6 64 48 255 ", "expected a whole PPM picture"),
        ("a.ppm", b"P6 30000 30000 255 ", "expected a PPM picture"),
        ("a.bmp", b"BM" + bytes(60), "expected a BMP picture"),
        ("a.png", png_of(48, 64), "expected a picture of 64 x 48 pixels, got 48 x 64"),
        ("a.png", png_of(1000, 1000), "expected a picture of 64 x 48 pixels, got 1000 x 1000"),
        ("a.png", png_head(20_000, 20_000), "expected a picture of 64 x 48 pixels, got 20000 x 20000"),
        ("a.npz", npz(color=np.zeros((48, 64, 3)))[:200], "expected a whole npz file"),
        ("a.npz", garbled(), "expected a whole npz file"),
        ("a.npz", npz(color=np.zeros((1000, 1000, 3), bool)), "got 1000 x 1000"),
        ("a.npz", npz(depth=np.zeros((48, 64))), "expected an array color, primitive or pixels"),
        ("a.npz", npz(color=np.zeros((64, 48, 3))), "expected a picture of 64 x 48 pixels, got 48 x 64"),
        ("a.npz", npz(color=np.zeros((48, 64))), "expected color"),
        (
            "a.npz",
            npz(color=np.full((48, 64, 3), np.nan)),
            "expected finite numbers as color, got NaN or infinity",
        ),
        ("a.npz", npz(color=np.full((48, 64), {})), "expected up to 64 MiB of numbers as color"),
        ("a.npz", npz(color=np.zeros(3)), "expected an array of 48 x 64 pixels, got (3,)"),
        ("a.npz", npz(primitive=np.zeros((48, 64))), "expected whole numbers"),
        ("a.npz", npz(pixels=np.array([[64, 0]])), "expected pixels inside of 64 x 48, got (64, 0)"),
        ("a.npz", zipped(b"\x93NUMPY\x01\x00\x76\x00" + HUGE), "expected up to 64 MiB of numbers as color"),
        ("a.npz", zipped(b"\x93NUMPY\x07\x00"), "expected an array of numbers as color"),
        ("a.npz", zipped(b"no array"), "magic string"),
        ("a.csv", b"", "expected lines of column, row"),
        ("a.csv", b"column,row\n1,2\n3\n", "expected lines of column, row"),
        ("a.csv", b"1,2\n3,1e400\n", "line 2: expected a whole number, got '1e400'"),
        ("a.csv", b"1,2\n3,\xd9\xa1\n", "line 2: expected a whole number"),
        ("a.csv", b"1,2\n3,nan\n", "line 2: expected a whole number, got 'nan'"),
        ("a.csv", b"1,2\n-1,2\n", "expected pixels inside of 64 x 48, got (-1, 2)"),
        ("a.csv", b"1,2,0,0,256\n", "expected red, green and blue from 0 to 255"),
        ("a.csv", b"1,2\n\xff,3\n", "expected text in UTF-8"),
        ("a.csv", b"1," + b"2" * 200_000, "expected lines of numbers: field larger than field limit"),
        ("a.csv", b"1,2\n" * 300_000, "expected up to 262144 pixels"),
    ],
)
def test_what_is_no_picture_is_refused_in_one_sentence(
    name: str, content: bytes, wanted: str, tmp_path: Path
) -> None:
    path = tmp_path / name
    path.write_bytes(content)
    sentence = refused(1, "diagnose", SCENE, path)
    assert wanted in sentence
    assert name in sentence
    assert len(sentence) - len(str(path)) < 250


def test_too_many_pixels_are_refused_before_they_are_drawn(tmp_path: Path) -> None:
    (tmp_path / "a.png").write_bytes(png_of(1000, 1000))
    sentence = refused(1, "diagnose", SCENE, tmp_path / "a.png", "--size", "1000x1000")
    assert sentence.endswith("expected a picture of up to 262144 pixels, got 1000 x 1000")
    assert "cannot be read" in refused(1, "diagnose", SCENE, tmp_path / "missing.png")
