"""Textures: look-up, mipmaps, footprints of pixels, and packed texels for pictures."""
