"""``rasterscope render``: a picture and its buffers, without a window."""

import argparse
import os

import numpy as np

from app.cli.arguments import (
    add_edits,
    add_file,
    add_settings,
    add_size,
    chosen_settings,
    open_file,
    overflow_reported,
    sized,
)
from app.cli.shaders import add_shaders, with_shaders
from app.files.file_writing import check_writable, whole_file
from app.session.memory import check_free
from app.usage import UsageError
from core import Frame, Settings, render
from core.framebuffer.display import picture_bytes
from core.resolved import resolve

DESCRIPTION = (
    """Draw a scene into a PNG file (sRGB, straight alpha), its buffers into an npz file, or both."""
)
EXAMPLES = """The npz file has three arrays; row 0 is the bottom row.
  color      (H, W, 4) float32, linear, as the blend method leaves it
  depth      (H, W) float32, as the depth method stores it
  primitive  (H, W) int32, number of the visible triangle, -1 for none

examples:
  rasterscope render teapot.obj -o teapot.png
  rasterscope render teapot.obj -o teapot.png --size 640x480 --set shading=flat cull=back
  rasterscope render teapot.obj -o toon.png --fragment toon.glsl --uniform steps=4
  rasterscope render shared-edge -o edge.png --set fill=blocks block_size=4 --buffers edge.npz
"""


def add_arguments(parser: argparse.ArgumentParser) -> None:
    """Say what the command takes."""
    add_file(parser)
    parser.add_argument("-o", "--output", metavar="out.png", help="the picture")
    add_size(parser)
    add_settings(parser)
    add_edits(parser)
    add_shaders(parser)
    parser.add_argument("--buffers", metavar="out.npz", help="color, depth and primitive as arrays")


def run(options: argparse.Namespace) -> int:
    """Draw and write."""
    for path, name, ending in ((options.output, "-o", ".png"), (options.buffers, "--buffers", ".npz")):
        if path is not None and not path.lower().endswith(ending) and not is_device(path):
            raise UsageError(f"argument {name}: the name of the file must end with {ending}, got {path}")
    if options.output is None and options.buffers is None:
        raise UsageError("nothing would be written: give -o out.png, --buffers out.npz or both")
    for path in filter(None, (options.output, options.buffers)):
        check_writable(path)

    opened = open_file(options)
    settings = chosen_settings(opened.document.settings, options.set, options.edit)
    scene = with_shaders(sized(opened.document.scene, options), options)
    blend = resolve(settings).blend_name
    check_memory(scene.size, settings)
    with overflow_reported():
        frame = render(scene, settings)

    if options.output is not None:
        write_picture(options.output, frame, blend)
    if options.buffers is not None:
        with whole_file(options.buffers) as file:
            np.savez(file, color=frame.color, depth=frame.depth, primitive=frame.primitive)
    return 0


def write_picture(path: str, frame: Frame, blend: str) -> None:
    """Write the colours of a frame as a PNG file, top row first."""
    from PIL import Image

    pixels = picture_bytes(frame.color, blend)
    with whole_file(path) as file:
        Image.fromarray(np.ascontiguousarray(pixels[::-1])).save(file, "PNG")


def is_device(path: str) -> bool:
    """Return whether a path names something that is written to directly, as /dev/null."""
    return os.path.exists(path) and not os.path.isfile(path) and not os.path.isdir(path)


BYTES_PER_PIXEL = {"opaque": 380}
BYTES_PER_BLENDED_PIXEL = 530
"""Memory that drawing takes at its peak where every pixel is textured, lit and seen; measured at 4096x4096."""
BYTES_PER_SAMPLE = {"opaque": 130}
BYTES_PER_BLENDED_SAMPLE = 150
"""The same of a sample of supersampling, which is drawn in bands: only its buffers are kept; measured with 2 x 2, 4 x 4
and 8 x 8 samples."""
BYTES_PER_MULTISAMPLED_PIXEL = {"opaque": 650}
BYTES_PER_BLENDED_MULTISAMPLED_PIXEL = 1040
"""The same of a pixel with the four samples of multisampling, which is shaded once; measured at 2048x2048."""


def bytes_per_pixel(settings: Settings) -> int:
    """Return how many bytes a pixel may take at the peak of drawing, beside what does not grow with the picture."""
    resolved = resolve(settings)
    blend, sampling = resolved.blend_name, resolved.sampling
    whole = BYTES_PER_PIXEL.get(blend, BYTES_PER_BLENDED_PIXEL)
    if settings.antialiasing == "msaa-4":
        whole = BYTES_PER_MULTISAMPLED_PIXEL.get(blend, BYTES_PER_BLENDED_MULTISAMPLED_PIXEL)
    elif sampling.side:
        of_sample = BYTES_PER_SAMPLE.get(blend, BYTES_PER_BLENDED_SAMPLE)
        whole = max(whole, of_sample * sampling.count)
    return whole


def check_memory(size: tuple[int, int], settings: Settings) -> None:
    """Raise ValueError for a picture of ``size`` pixels that may not fit into the memory that is free."""
    count = resolve(settings).sampling.count
    samples = f" with {count} samples each" if count > 1 else ""
    needed = size[0] * size[1] * bytes_per_pixel(settings)
    check_free(needed, f"a picture of {size[0]}x{size[1]} pixels{samples}")
