"""Pictures as textures: sRGB bytes of an image file become linear float32."""

import warnings
from io import BytesIO
from pathlib import Path
from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import ArrayLike

from core.framebuffer.display import from_display, linear_light
from core.records.arrays import Floats
from core.scene import Texture

if TYPE_CHECKING:
    from PIL import Image

PIXEL_LIMIT = 2**26
"""Most pixels of a texture: 8192 x 8192, which is 1 GiB as four float32 channels."""


class ImageError(ValueError):
    """An image cannot be used; the message says why, after the name of the image."""


def linear_from_srgb(values: ArrayLike) -> Floats:
    """Return linear light of sRGB ``values``, any shape; they are cut to [0, 1]."""
    return linear_light(np.clip(np.asarray(values, np.float64), 0, 1))


def read_texture(path: Path) -> Texture:
    """Return the image file ``path`` as a texture, or raise ImageError."""
    try:
        content = path.read_bytes()
    except OSError as problem:
        raise ImageError(
            "does not exist" if isinstance(problem, FileNotFoundError) else f"{problem.strerror}"
        ) from problem
    return decode_texture(content, path.name)


def decode_texture(content: bytes, name: str) -> Texture:
    """Return the bytes of an image file as a texture, or raise ImageError."""
    from PIL import Image, UnidentifiedImageError  # Pillow takes a moment: not before there is an image.

    try:
        with warnings.catch_warnings():
            warnings.simplefilter("ignore", Image.DecompressionBombWarning)
            image = Image.open(BytesIO(content))
        return texture_from_image(image, name)
    except UnidentifiedImageError as problem:
        raise ImageError("is not an image") from problem
    except (OSError, SyntaxError, ValueError, EOFError, Image.DecompressionBombError) as problem:
        raise ImageError(str(problem)) from problem


def texture_from_image(image: "Image.Image", name: str) -> Texture:
    """Return ``image`` as a texture of three channels, or four where it has transparency.

    Raises
    ------
    ImageError
        If it has more than PIXEL_LIMIT pixels.
    """
    if image.width * image.height > PIXEL_LIMIT:
        raise ImageError(f"has {image.width} x {image.height} pixels, more than the limit of {PIXEL_LIMIT}")
    if image.mode.startswith("I"):
        from PIL import Image

        # 16 bits of grey: the upper 8 are kept.
        grey = (np.asarray(image).astype(np.int64) >> 8).clip(0, 255).astype(np.uint8)
        image = Image.fromarray(grey)
    has_alpha = image.has_transparency_data
    pixels = np.asarray(image.convert("RGBA" if has_alpha else "RGB"))
    return Texture(pixels=from_display(pixels[::-1]), name=name)
