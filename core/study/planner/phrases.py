"""What methods and numbers are called in the sentences of a plan."""

PHRASES = {
    "cull": {
        "none": "drawing both faces",
        "back": "leaving out back faces",
        "front": "leaving out front faces",
    },
    "clipping": {
        "homogeneous": "homogeneous rasterization without clipping",
        "sutherland-hodgman": "clipping to the view volume",
    },
    "interpolation": {
        "perspective": "perspective-correct interpolation",
        "affine": "affine interpolation",
        "affine-n": "affine interpolation corrected every few pixels",
        "flat": "one value without interpolation",
    },
    "texture_filter": {
        "nearest": "the nearest texel",
        "bilinear": "bilinear filtering",
        "trilinear": "trilinear filtering",
    },
    "shading": {
        "phong": "Phong shading",
        "gouraud": "Gouraud shading",
        "flat": "flat shading",
        "unlit": "leaving out the light",
    },
    "visibility": {
        "z-buffer": "the z-buffer",
        "last-drawn": "drawing without a depth test",
        "painters": "the painter's algorithm",
    },
    "depth": {
        "z-16": "depth in 16 bits",
        "z-24": "depth in 24 bits",
        "z-float32": "depth in float32",
        "reversed-z": "reversed depth in float32",
    },
    "blend": {"opaque": "drawing without blending", "over": "blending", "additive": "additive blending"},
    "antialiasing": {
        "none": "one sample a pixel",
        "msaa-4": "multisampling with 4 samples",
        "ssaa-4": "2 x 2 samples",
        "ssaa-16": "4 x 4 samples",
    },
}
"""What a method that a plan may choose is called within a sentence, by family and name."""


def phrase(family: str, method: str) -> str:
    """Return what a method is called within a sentence."""
    return PHRASES[family][method]


def capitalized(text: str) -> str:
    """Return a text that a sentence begins with."""
    return text[:1].upper() + text[1:]


def in_bytes(error: float) -> str:
    """Return a difference of bytes as text: ``2/255``."""
    return f"{error:,g}/255"


def figure(value: float) -> str:
    """Return a number of three digits, with commas and no exponent: ``5,190``, ``0.82``; small ones as ``0.001``."""
    if 0 < value < SMALLEST:
        return f"{SMALLEST:g}"
    rounded = float(f"{value:.3g}")
    return f"{rounded:,.0f}" if rounded >= 1000 else f"{rounded:g}"


SMALLEST = 0.001
"""Smaller numbers display as this."""
