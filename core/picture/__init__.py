"""Pictures as fast as NumPy draws them: a scene becomes the bytes of a screen.

``render`` keeps every buffer; a picture keeps none that it does not need, and chooses how it is drawn by what the scene
holds: see `Route`. Which triangle is seen at which pixel is decided by the same rules for both, bit for bit.
"""

from core.picture.draw import draw_picture
from core.picture.record import Picture, Route, Split

__all__ = ["Picture", "Route", "Split", "draw_picture"]
