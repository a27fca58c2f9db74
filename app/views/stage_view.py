"""What each view beside the pixel grid shows of a moment: clip space, (x, y, w), texture."""

from PySide6.QtWidgets import QWidget

from app.session.moment import Moment
from app.session.session import Session
from app.views.clip_diagram import clip_diagram, clip_state
from app.views.pointed_pixel import pointed_pixels, shown_triangle
from app.views.pyramid_diagram import pyramid_diagram
from app.views.texture_footprint import texture_pictures
from core import STAGES
from core.trace.geometry_progress import CLIP, WINDOW, spaces_reached
from widgets.space.texture_levels import TextureLevels
from widgets.space.view import SpaceView


class StageView:
    """One view: its widget, and what brings it up to date."""

    name = ""
    """The spelling of command line and state files."""
    title = ""
    """What its tab says."""

    def __init__(self, session: Session) -> None:
        self.session, self.moment = session, session.moment
        self.widget = self.make_widget()
        self._drawn: object = None

    def make_widget(self) -> QWidget:
        """Return the widget that it draws on."""
        raise NotImplementedError

    def made_from(self) -> object:
        """Return what the drawing is made from: the same again is not drawn again."""
        return (self.moment.trace, shown_triangle(self.moment), pointed_pixels(self.moment))

    def draw(self) -> None:
        """Draw the moment."""
        raise NotImplementedError

    def refresh(self, moment: Moment) -> None:
        """Draw the moment where it is not what is drawn already."""
        self.moment = moment
        now = self.made_from()
        if self._drawn is None or self._drawn != now:
            self._drawn = now
            self.draw()


NOT_YET = "The vertices come to clip space here, at the end of Transform."


def is_there(moment: Moment, space: int = CLIP) -> bool:
    """Return whether the triangle shown has come to a space: before that the views of it would show what comes."""
    cursor, trace = moment.cursor, moment.trace
    if cursor.stage != STAGES[0]:
        return True
    assembled = trace.source.geometry.assembled.triangle
    reached = spaces_reached(trace, cursor.stage, cursor.position)
    return bool((reached[assembled == shown_triangle(moment)] >= space).all())


class ClipView(StageView):
    """Triangles and planes in clip space, up to the step of the clipping that the cursor is at."""

    name, title = "clip", "Clip space"

    def make_widget(self) -> QWidget:
        """Return the drawing in space."""
        self._space = SpaceView()
        self._space.setAccessibleName("Clip space")
        self._space.empty_text = NOT_YET
        return self._space

    def made_from(self) -> object:
        """Return trace, triangle and how much is clipped: the row of the step, and how many rows are done."""
        done: object = self._position()
        if self.moment.cursor.stage == "clip":
            done = self.moment.row, self.moment.rows_done
        return (self.moment.trace, shown_triangle(self.moment), done, is_there(self.moment))

    def draw(self) -> None:
        """Draw the triangle and what clipping leaves of it."""
        if not is_there(self.moment):
            self._space.show_diagram(None)
            return
        state = clip_state(self.moment.trace, shown_triangle(self.moment), self._position())
        self._space.show_diagram(clip_diagram(state))

    def _position(self) -> int | None:
        """Return how much of the clipping is done at the cursor; None: all of it."""
        cursor = self.moment.cursor
        if cursor.stage == "clip":
            return cursor.position
        return 0 if STAGES.index(cursor.stage) < STAGES.index("clip") else None


class PyramidView(StageView):
    """The homogeneous triangle in (x, y, w)."""

    name, title = "pyramid", "(x, y, w)"

    def make_widget(self) -> QWidget:
        """Return the drawing in space."""
        self._space = SpaceView()
        self._space.setAccessibleName("Homogeneous rasterization: triangle in (x, y, w)")
        self._space.empty_text = NOT_YET
        return self._space

    def made_from(self) -> object:
        """Return trace, triangle and the first pixel that is pointed at."""
        pixels = pointed_pixels(self.moment)[:1]
        return (self.moment.trace, shown_triangle(self.moment), pixels, self._is_there())

    def draw(self) -> None:
        """Draw the triangle, and the ray of the pixel."""
        if not self._is_there():
            self._space.show_diagram(None)
            return
        pixels = pointed_pixels(self.moment)
        pixel = pixels[0] if pixels else None
        triangle = shown_triangle(self.moment)
        self._space.show_diagram(pyramid_diagram(self.moment.trace.source, triangle, pixel))

    def _is_there(self) -> bool:
        """Return whether it may be drawn: it has the grid of the window, in which predicting asks for the places."""
        return is_there(self.moment, WINDOW if self.moment.is_predicting else CLIP)


class TextureView(StageView):
    """The texture, and what pixels see of it."""

    name, title = "texture", "Texture"

    def make_widget(self) -> QWidget:
        """Return the pictures of the levels."""
        self._levels = TextureLevels()
        return self._levels

    def draw(self) -> None:
        """Draw the texture with the footprints of pixels."""
        self._levels.show_pictures(*texture_pictures(self.moment))
