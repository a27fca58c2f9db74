"""What a comparison of pictures found, in the words of command line and window."""

import numpy as np

from core.records.arrays import Flags
from core.scene import AnyScene
from lessons.diagnosis import Drawn

PIXELS_SHOWN = 20


def scene_text(title: str, scene: AnyScene) -> str:
    """Return which scene a picture is compared with."""
    return f"{title or 'the open scene'}, {scene.size[0]} x {scene.size[1]} pixels"


def right_text(drawn: Drawn) -> str:
    """Return what is right of a picture in which nothing differs: no more than was compared."""
    if drawn.covered is not None:
        return "exactly the pixels that this scene and its settings cover"
    if drawn.primitive is not None:
        return "every pixel shows the triangle that this scene and its settings draw there"
    return "every pixel has the colour that this scene and its settings draw there"


def pixels_text(differing: Flags, name: str) -> str:
    """Return how many pixels differ from the picture of a ``name``, and the first of them as (column, row)."""
    places = [f"({column}, {row})" for row, column in np.argwhere(differing)[:PIXELS_SHOWN].tolist()]
    count = int(differing.sum())
    more = f" and {count - PIXELS_SHOWN} more" if count > PIXELS_SHOWN else ""
    verb = "pixel differs" if count == 1 else "pixels differ"
    return f"{count} of {differing.size} {verb} from {name}: {' '.join(places)}{more}"
