"""How much memory a picture with all its buffers takes, and whether this machine has it."""

import os

from core import Settings
from core.resolved import resolve

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
    """Raise ValueError for a picture of ``size`` pixels that may not fit into the memory of this machine."""
    if not hasattr(os, "sysconf"):
        return
    needed = size[0] * size[1] * bytes_per_pixel(settings)
    present = os.sysconf("SC_PHYS_PAGES") * os.sysconf("SC_PAGE_SIZE")
    if needed > present:
        count = resolve(settings).sampling.count
        samples = f" with {count} samples each" if count > 1 else ""
        raise ValueError(
            f"a picture of {size[0]}x{size[1]} pixels{samples} may take {needed / 2**30:.0f} GiB of memory, "
            f"this machine has {present / 2**30:.0f}"
        )
