"""Pictures as textures: sRGB bytes of an image file become linear float32, within a bound on memory."""

import logging
import os
import re
import warnings
from pathlib import Path
from typing import TYPE_CHECKING, BinaryIO

import numpy as np
from numpy.typing import ArrayLike

from app.files.file_access import NamedFileError, NamedFiles, open_input
from app.session.memory import MemoryBoundError, Need
from core.framebuffer.display import Bytes, from_display, linear_light
from core.records.arrays import Floats, Singles
from core.scene import Texture
from lessons.os_errors import os_error_reason

if TYPE_CHECKING:
    from PIL import Image

PIXEL_LIMIT = 2**26
"""Most pixels of a texture: 8192 x 8192, which is 1 GiB as four float32 channels."""
FILE_LIMIT = 2**29
"""Most bytes of an image file."""
FORMATS = ("PNG", "JPEG", "BMP", "GIF", "TGA", "TIFF", "WEBP", "PPM", "DDS")
"""Kinds of images that are read. Pillow knows others, and starts a program of its own for some of them."""
COMPRESSION = 1100
"""Most bytes of pixels that a byte of an image file can hold: a little more than deflate."""
BAND = 2**20
"""Pixels that are converted at a time."""
SAMPLE_BYTES = {"1": 1, "L": 1, "P": 1, "I;16": 2, "I;16B": 2, "I;16L": 2, "I;16N": 2}
"""Bytes of a decoded pixel by Pillow's mode; of all other modes 4."""
BITS = {
    "1": 1,
    "L": 8,
    "P": 8,
    "LA": 16,
    "PA": 16,
    "I;16": 16,
    "I;16B": 16,
    "RGB": 24,
    "YCbCr": 24,
    "LAB": 24,
}
"""Bits of a pixel in a file by mode; of all other modes 32."""


class ImageError(NamedFileError):
    """An image cannot be used; the message says why, after the name of the image."""


def linear_from_srgb(values: ArrayLike) -> Floats:
    """Return linear light of sRGB ``values``, any shape; they are cut to [0, 1]."""
    return linear_light(np.clip(np.asarray(values, np.float64), 0, 1))


class TextureReader:
    """Reads the textures that one file names: each once, all of them together within a bound on memory."""

    def __init__(self, files: NamedFiles) -> None:
        self.files = files
        self._read: dict[Path, Texture | str] = {}
        self._need = Need()

    def read(self, name: str, folder: Path | None = None) -> Texture:
        """Return the texture ``name``, found as in `NamedFiles.find`, or raise NamedFileError."""
        path = self.files.find(name, folder)
        if path not in self._read:
            try:
                with open_input(path) as file:
                    self._read[path] = self.decode(file, path.name)
            except ImageError as problem:
                self._read[path] = str(problem)
            except OSError as problem:
                self._read[path] = f"cannot be read: {os_error_reason(problem)}"
        found = self._read[path]
        if isinstance(found, str):
            raise ImageError(found)
        return found

    def decode(self, file: BinaryIO, name: str) -> Texture:
        """Return the image in an open file as a texture of three channels, or four where it has transparency.

        Raises ImageError if it cannot be decoded, or takes more memory than an image of its size should.
        """
        from PIL import Image, UnidentifiedImageError  # Pillow takes a moment: not before there is an image.

        logging.getLogger("PIL").setLevel(logging.CRITICAL)
        size = file.seek(0, os.SEEK_END)
        if size > FILE_LIMIT:
            raise ImageError(f"has {size} bytes, more than the limit of {FILE_LIMIT}")
        file.seek(0)
        try:
            with warnings.catch_warnings():
                warnings.simplefilter("ignore")
                image = Image.open(file, formats=FORMATS)
                self._need.ask(
                    *image_memory(image, size), f"has {image.width} x {image.height} pixels, which"
                )
                return Texture(texture_pixels(image), name)
        except ImageError:
            raise
        except MemoryBoundError as problem:
            raise ImageError(str(problem)) from problem
        except UnidentifiedImageError as problem:
            raise ImageError("is not an image") from problem
        except Exception as problem:  # Whatever a decoder says of a broken file.
            text = " ".join(str(problem).split())[:200] or type(problem).__name__
            raise ImageError(f"cannot be decoded: {text}") from problem


def image_memory(image: "Image.Image", size: int) -> tuple[int, int]:
    """Return the bytes that an opened image takes as a texture, and the bytes of the pixels that its file holds.

    Parameters
    ----------
    image : Image
        Not yet decoded.
    size : int
        Bytes of its file.

    Raises
    ------
    ImageError
        If it has more than PIXEL_LIMIT pixels.
    """
    count = image.width * image.height
    if count > PIXEL_LIMIT:
        raise ImageError(f"has {image.width} x {image.height} pixels, more than the limit of {PIXEL_LIMIT}")
    tile = getattr(image, "tile", None)
    coding = tile[0][3] if tile else ""
    packed = re.search(r";([124])\b", coding) if isinstance(coding, str) else None
    bits = int(packed[1]) if packed else BITS.get(image.mode, 32)
    channels = channel_count(image)
    # Decoded, as float32, and the look whether all of them are finite.
    taken = count * (SAMPLE_BYTES.get(image.mode, 4) + 6 * channels)
    return taken, min(count * bits // 8, size * COMPRESSION)


def channel_count(image: "Image.Image") -> int:
    """Return the channels that the texture of an image has; 16 bits of grey have no transparency."""
    return 4 if image.has_transparency_data and not image.mode.startswith("I") else 3


def texture_pixels(image: "Image.Image") -> Singles:
    """Return the linear colours (h, w, 3 or 4) float32 of an image, row 0 at the bottom, read-only."""
    channels = channel_count(image)
    pixels = np.empty((image.height, image.width, channels), np.float32)
    rows = max(1, BAND // image.width)
    for top in range(0, image.height, rows):
        band = image.crop((0, top, image.width, min(top + rows, image.height)))
        end = image.height - top
        pixels[end - band.height : end] = from_display(display_bytes(band, channels)[::-1])
    pixels.flags.writeable = False
    return pixels


def display_bytes(image: "Image.Image", channels: int) -> Bytes:
    """Return the sRGB bytes (h, w, channels) uint8 of an image; of 16 bits of grey the upper 8 are kept."""
    if image.mode.startswith("I"):
        grey = (np.asarray(image).astype(np.int64) >> 8).clip(0, 255).astype(np.uint8)
        return np.repeat(grey[..., None], channels, axis=2)
    return np.asarray(image.convert("RGBA" if channels == 4 else "RGB"))
