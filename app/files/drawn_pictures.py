"""Pictures that other programs drew, to be compared with a scene: images, npz, CSV."""

import csv
import io
import warnings
import zipfile
import zlib
from collections.abc import Callable
from pathlib import Path
from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import NDArray

from app.files.file_access import DRAWN_ENDINGS, IMAGE_FORMATS, read_input
from app.files.mesh_formats.images import display_bytes
from core.framebuffer.display import Bytes, to_display
from lessons.diagnosis import PIXEL_LIMIT, Drawn, check_size

if TYPE_CHECKING:
    from PIL import Image

FILE_LIMIT = 1 << 26
"""Most bytes of a file, and of an array in it."""
PNG = b"\x89PNG\r\n\x1a\n"
"""First bytes of a PNG file; its columns and rows are bytes 16 to 24."""
Size = tuple[int, int]


def read_drawn(path: Path, size: Size) -> Drawn:
    """Return the picture of a file.

    Parameters
    ----------
    path : Path
        An image (PNG, PPM, BMP, TGA, or lossy JPEG), its top row first; npz with one of the arrays ``color``,
        ``primitive`` and ``pixels``, or CSV with a pixel a line (column, row and then nothing, the number of its
        triangle, or red, green, blue), row 0 at the bottom.
    size : (columns, rows)
        What the picture must have.

    Raises
    ------
    ValueError
        For what is no such picture, or one of another size; the message is one sentence that names the file.
    OSError
        If the file cannot be read.
    """
    ending = path.suffix.lower()
    if ending not in DRAWN_ENDINGS:
        raise ValueError(f"{path}: expected a picture as {', '.join(DRAWN_ENDINGS)}")
    content = read_input(path, FILE_LIMIT)
    try:
        if ending in IMAGE_FORMATS:
            return _image(content, size, IMAGE_FORMATS[ending])
        return (_npz if ending == ".npz" else _csv)(content, size)
    except ValueError as problem:
        raise ValueError(f"{path}: {problem}") from None


def _image(content: bytes, size: Size, kind: str) -> Drawn:
    from PIL import Image  # Pillow takes a moment: not before there is an image.

    with warnings.catch_warnings():
        warnings.simplefilter("ignore")
        # The size first, from the header: Pillow opens no picture that is too large to be decoded.
        if kind == "PNG" and content.startswith(PNG):
            check_size((int.from_bytes(content[16:20]), int.from_bytes(content[20:24])), size)
        try:
            image = Image.open(io.BytesIO(content), formats=(kind,))
        except Exception:  # Whatever a decoder says of another file, or of one that is far too large.
            raise ValueError(f"expected a {kind} picture") from None
        check_size(image.size, size)
        channels = 4 if image.has_transparency_data else 3
        loses = None if kind != "JPEG" else _jpeg_again(image)
        try:
            colors = display_bytes(image, channels)[::-1]
        except Exception as problem:  # Whatever a decoder says of a broken file.
            raise ValueError(
                f"expected a whole {kind} picture: {' '.join(str(problem).split())[:200]}"
            ) from None
    is_opaque = channels == 3 or bool((colors[..., 3] == 255).all())
    return Drawn(colors=colors[..., :3] if is_opaque else colors, loses=loses)


def _jpeg_again(image: "Image.Image") -> Callable[[Bytes], Bytes]:
    """Return what saves colours (H, W, 3) as an opened JPEG picture was saved, and reads them again."""
    from PIL import Image, JpegImagePlugin

    mode = "L" if image.mode == "L" else "RGB"
    # As many tables as there are: Pillow's own would stand for the others.
    tables = {number: list(table) for number, table in vars(image)["quantization"].items()}
    sampling = JpegImagePlugin.get_sampling(image) if mode == "RGB" else -1

    def loses(colors: Bytes) -> Bytes:
        file = io.BytesIO()
        picture = Image.fromarray(np.ascontiguousarray(colors[::-1])).convert(mode)
        picture.save(file, "JPEG", qtables=tables, subsampling=sampling)
        with Image.open(file, formats=("JPEG",)) as saved:
            return np.asarray(saved.convert("RGB"))[::-1]

    return loses


def _npz(content: bytes, size: Size) -> Drawn:
    try:
        with zipfile.ZipFile(io.BytesIO(content)) as archive:
            names = {name.removesuffix(".npy") for name in archive.namelist()}
            known = [name for name in ("color", "primitive", "pixels") if name in names]
            if not known:
                raise ValueError("expected an array color, primitive or pixels")
            array = _array(archive, known[0], size)
    except (zipfile.BadZipFile, zlib.error, EOFError, NotImplementedError, RuntimeError) as problem:
        raise ValueError(f"expected a whole npz file: {problem}") from None
    if known[0] == "pixels":
        if array.ndim != 2 or array.shape[1] != 2 or array.dtype.kind not in "iu":
            raise ValueError(f"expected pixels (N, 2) whole numbers, got {array.shape} {array.dtype}")
        return _covered(array.astype(np.int64), size)
    if known[0] == "primitive":
        if array.ndim != 2 or array.dtype.kind not in "iu":
            raise ValueError(f"expected whole numbers (H, W) as primitive, got {array.shape} {array.dtype}")
        return Drawn(primitive=array.astype(np.int64))
    if (
        array.ndim != 3
        or array.shape[2] not in (3, 4)
        or not (array.dtype == np.uint8 or array.dtype.kind == "f")
    ):
        raise ValueError(f"expected color (H, W, 3 or 4) as bytes or floats, got {array.shape} {array.dtype}")
    if array.dtype == np.uint8:
        return Drawn(colors=array[..., :3].astype(np.uint8))
    if not np.isfinite(array).all():
        raise ValueError("expected finite numbers as color, got NaN or infinity")
    return Drawn(colors=to_display(array.astype(np.float32)).pixels[..., :3])


def _array(archive: zipfile.ZipFile, name: str, size: Size) -> NDArray[np.generic]:
    """Return an array of an npz file, once its header says that it is small enough, and a picture of this size."""
    readers = {(1, 0): np.lib.format.read_array_header_1_0, (2, 0): np.lib.format.read_array_header_2_0}
    with archive.open(f"{name}.npy") as file:
        version = np.lib.format.read_magic(file)
        if version not in readers:
            raise ValueError(f"expected an array of numbers as {name}")
        shape, _, dtype = readers[version](file)
        if name != "pixels":
            if len(shape) < 2:
                raise ValueError(f"expected an array of {size[1]} x {size[0]} pixels, got {shape}")
            check_size((shape[1], shape[0]), size)
        if dtype.hasobject or np.prod(shape, dtype=float) * dtype.itemsize > FILE_LIMIT:
            raise ValueError(
                f"expected up to {FILE_LIMIT >> 20} MiB of numbers as {name}, got {shape} {dtype}"
            )
        file.seek(0)
        array: NDArray[np.generic] = np.lib.format.read_array(file, allow_pickle=False)
    return array


def _csv(content: bytes, size: Size) -> Drawn:
    try:
        text = content.decode("utf-8-sig")
    except UnicodeDecodeError:
        raise ValueError("expected text in UTF-8") from None
    if max(text.count("\n"), text.count("\r")) > PIXEL_LIMIT:
        raise ValueError(f"expected up to {PIXEL_LIMIT} pixels, got more lines")
    try:
        lines = [row for row in csv.reader(text.splitlines()) if row]
    except csv.Error as problem:
        raise ValueError(f"expected lines of numbers: {problem}") from None
    begin = 1 if lines and not lines[0][0].strip().lstrip("-").isdecimal() else 0
    widths = {len(row) for row in lines[begin:]}
    if len(widths) != 1 or not widths <= {2, 3, 5}:
        raise ValueError(
            "expected lines of column, row; of column, row, triangle; or of column, row, red, green, blue"
        )
    values = np.array(
        [[_whole(text, number) for text in row] for number, row in enumerate(lines, 1) if number > begin]
    )
    pixels, rest = values[:, :2], values[:, 2:]
    covered = _covered(pixels, size)
    if not rest.size:
        return covered
    columns, rows = size
    if rest.shape[1] == 1:
        primitive = np.full((rows, columns), -1)
        primitive[pixels[:, 1], pixels[:, 0]] = rest[:, 0]
        return Drawn(primitive=primitive)
    if rest.min() < 0 or rest.max() > 255:
        raise ValueError("expected red, green and blue from 0 to 255")
    colors = np.zeros((rows, columns, 3), np.uint8)
    colors[pixels[:, 1], pixels[:, 0]] = rest
    return Drawn(colors=colors)


def _whole(text: str, line: int) -> int:
    plain = text.strip()
    if not (plain.isascii() and plain.removeprefix("-").isdecimal() and len(plain) <= 9):
        raise ValueError(f"line {line}: expected a whole number, got {text!a:.40}")
    return int(plain)


def _covered(pixels: NDArray[np.int64], size: Size) -> Drawn:
    is_outside = (pixels < 0).any(axis=1) | (pixels >= size).any(axis=1)
    if is_outside.any():
        column, row = pixels[is_outside][0].tolist()
        raise ValueError(f"expected pixels inside of {size[0]} x {size[1]}, got ({column}, {row})")
    covered = np.zeros((size[1], size[0]), bool)
    covered[pixels[:, 1], pixels[:, 0]] = True
    return Drawn(covered=covered)
