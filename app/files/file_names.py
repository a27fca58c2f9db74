"""Names of files: those that are not text (some systems allow any bytes, kept as lone surrogates), and endings."""

import re

VIEW_ENDINGS = (".png", ".svg", ".pdf")
"""Of pictures of a view."""
IMAGE_FORMATS = {
    ".png": "PNG",
    ".ppm": "PPM",
    ".pgm": "PPM",
    ".bmp": "BMP",
    ".tga": "TGA",
    ".jpg": "JPEG",
    ".jpeg": "JPEG",
}
"""Pillow's names of the images that other programs drew, by ending."""
DRAWN_ENDINGS = (*IMAGE_FORMATS, ".npz", ".csv")
"""Of pictures that other programs drew."""


def shown_name(name: str) -> str:
    """Return a name with a replacement character for each byte that is not text, to be shown and saved."""
    return re.sub("[\ud800-\udfff]", "\N{REPLACEMENT CHARACTER}", name)


def is_text(name: str) -> bool:
    """Return whether a name can be written to a file of text, and be read again as the same name."""
    return shown_name(name) == name
