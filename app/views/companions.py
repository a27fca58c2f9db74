"""What each view beside the pixel grid shows of a moment, and what stands beside it where a stage has two sides."""

import numpy as np
from PySide6.QtWidgets import QWidget

from app.session.moment import Moment
from app.session.session import Session
from app.views.clip_diagram import clip_diagram, clip_state, cube_strokes
from app.views.pointed_pixel import pointed_pixels, shown_triangle
from app.views.pyramid_diagram import pyramid_diagram
from app.views.texture_footprint import texture_of, texture_pictures
from core import STAGES
from core.explain.step_tables import first_in_table, largest_tables, step_table
from core.records.arrays import Floats
from core.records.words import nouns
from core.scene import Scene
from core.trace.stage_trace import StageTrace
from core.transform.traced import CLIP, SPACES, WINDOW, spaces_reached
from widgets.basics.controls import column_layout, text_label
from widgets.grid.layers import GridBuffer
from widgets.grid.marks import StepMark, box_lines
from widgets.grid.pixel_grid import PixelGrid
from widgets.inspector.step_table import StepTableView
from widgets.space.diagram import CUBE, Diagram, Spot, Stroke, Word
from widgets.space.texture_view import TextureLevels
from widgets.space.view import SpaceView

# What each view beside the pixel grid shows of a moment: clip space, (x, y, w), texture.


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


# What stands beside the main view where a stage has two sides: the space entered, tables, texture, new
# depths.


NDC = SPACES.index("NDC")
MOST_TRIANGLES = 400
"""Triangles that are drawn: of more, a part would look like a shape of its own."""


class Companion(StageView):
    """A view beside the main one."""

    is_alike = False
    """Whether it is a picture like the main one: then both have titles, and may lie one above the other."""
    is_all_done = False
    """Whether it shows nothing that a later step finds: then it is seen while that step is to be predicted."""

    def is_wanted(self, moment: Moment) -> bool:
        """Return whether it has something to show at the stage of the cursor."""
        return True

    def wanted_size(self, moment: Moment, width: int) -> tuple[int, int]:
        """Return the width that it needs to be read as a whole, and the height that it needs in ``width``, in pixels.

        0: any. A step does not change it.
        """
        return 0, 0

    def made_from(self) -> object:
        """Return trace, the row of the step, and how many rows are done."""
        return self.moment.trace, self.moment.row, self.moment.rows_done


class EnteredSpace(Companion):
    """Normalized device coordinates, where corners appear as they are divided by w."""

    name = "entered"

    def make_widget(self) -> QWidget:
        """Return the drawing in space."""
        self._space = SpaceView()
        self._space.setAccessibleName("The space that vertices enter: normalized device coordinates")
        return self._space

    def is_wanted(self, moment: Moment) -> bool:
        """Return whether there are corners, but no bones or shapes that move them first: those need the room."""
        scene = moment.document.scene
        meshes = scene.meshes if isinstance(scene, Scene) else ()
        return moment.steps.row_count > 0 and all(mesh.deformation is None for mesh in meshes)

    def draw(self) -> None:
        """Draw the corners that have been divided by w, and the triangles of three such corners."""
        self._space.show_diagram(entered_diagram(self.moment))


class TextureBeside(TextureView, Companion):
    """The texture with what the pixel of the step reads of it."""

    def is_wanted(self, moment: Moment) -> bool:
        """Return whether the triangle of the step has a texture."""
        return texture_of(moment.trace.source, shown_triangle(moment)) is not None


class FillingTable(Companion):
    """The table that fills as the stage is stepped: planes of the frustum, borders of a clip window."""

    def make_widget(self) -> QWidget:
        """Return the table."""
        self._view = StepTableView()
        self._view.step_requested.connect(self.session.go_to)
        self._roomed: StageTrace | None = None
        return self._view

    def is_wanted(self, moment: Moment) -> bool:
        """Return whether some row of the stage stands in a table; where vertices are moved first, one that is done."""
        first = first_in_table(moment.stage_trace)
        return first < moment.steps.row_count and (moment.cursor.stage != STAGES[0] or moment.row >= first)

    def wanted_size(self, moment: Moment, width: int) -> tuple[int, int]:
        """Return the size in which the largest tables of the stage are seen whole."""
        if self._roomed is not moment.stage_trace:
            self._roomed = moment.stage_trace
            self._view.make_room(largest_tables(moment.stage_trace))
        return self._view.wanted_size(width)

    def made_from(self) -> object:
        """Return trace and cursor: a cell appears with its operation."""
        return self.moment.trace, self.moment.cursor

    def draw(self) -> None:
        """Show the table with the cells filled so far."""
        self._view.show_table(step_table(self.moment.stage_trace, self.moment.cursor.position))


class GridBeside(Companion):
    """A grid of another buffer, below a title that says what it holds."""

    is_alike = True

    def make_widget(self) -> QWidget:
        """Return the grid below its title."""
        pane = QWidget()
        self.grid = PixelGrid(pane)
        self._title = text_label("", pane, role="muted")
        layout = column_layout(pane, 4)
        layout.addWidget(self._title)
        layout.addWidget(self.grid, 1)
        return pane


class NewDepths(GridBeside):
    """The depths of the triangle at hand, beside those that the depth buffer holds."""

    name = "new-depths"

    def draw(self) -> None:
        """Show what has been compared so far of the triangle of the step."""
        stage, row = self.moment.stage_trace, self.moment.row
        triangle = -1 if row < 0 else int(stage.triangle[row])
        one = nouns(self.moment.trace.source.scene.corner_count).one
        self._title.setText(f"New depths: {'none yet' if triangle < 0 else f'{one} {triangle}'}")
        self.grid.show_buffer(new_depths(self.moment, stage, row))
        origin = self.moment.trace.source.raster.bounds[:2]
        has_pixel = row >= 0 and stage.pixel[row, 0] >= 0
        self.grid.show_step(StepMark(stage.pixel[[row]] - np.array(origin)) if has_pixel else StepMark())


class ScreenBeside(GridBeside):
    """The screen, beside the buffer that is drawn into, with the row that was read last."""

    name = "screen"

    def is_wanted(self, moment: Moment) -> bool:
        """Return whether the picture is presented."""
        return "scan" in moment.steps.kinds

    def draw(self) -> None:
        """Show the rows that have been read, and mark the last one."""
        stage, done = self.moment.stage_trace, self.moment.rows_done
        raster = self.moment.trace.source.raster
        track = next(track for track in stage.buffers if track.name == "screen")
        buffer = GridBuffer(
            "screen", track.at(done), "color", origin=raster.bounds[:2], known=track.known_at(done)
        )
        self.grid.show_buffer(buffer)
        read = np.flatnonzero(stage.steps.kind[:done] == stage.steps.kinds.index("scan"))
        if not len(read):
            self._title.setText("Screen: not read yet")
            self.grid.show_step(StepMark())
            return
        refresh, line = (int(stage.columns[name][read[-1]]) for name in ("refresh", "line"))
        self._title.setText(f"Screen: refresh {refresh}, row {line} from the top")
        height, width = track.initial.shape[:2]
        row = height - 1 - line
        self.grid.show_step(StepMark(lines=box_lines(0, row, width, row + 1)))


COMPANIONS: dict[str, type[Companion]] = {
    "transform": EnteredSpace,
    **dict.fromkeys(("cull", "clip", "raster"), FillingTable),
    "shade": TextureBeside,
    "depth": NewDepths,
    "resolve": ScreenBeside,
    "order": FillingTable,
}
"""By stage; ``order`` takes the place of ``depth`` and ``transform`` where the rows that come first have a table."""


def new_depths(moment: Moment, stage: StageTrace, row: int) -> GridBuffer:
    """Return the depths that the triangle of a row has had compared up to it, in the range of the depth buffer."""
    raster = moment.trace.source.raster
    values, known = np.zeros(raster.shape), np.zeros(raster.shape, bool)
    if row >= 0:
        is_own = (stage.triangle[: row + 1] == stage.triangle[row]) & (stage.pixel[: row + 1, 0] >= 0)
        rows = np.flatnonzero(is_own)
        place = raster.index(*stage.pixel[rows].T)
        values.ravel()[place], known.ravel()[place] = stage.columns["stored"][rows], True
    track = next(track for track in stage.buffers if track.name == "depth")
    return GridBuffer("new depth", values, range=track.value_range, origin=raster.bounds[:2], known=known)


def entered_diagram(moment: Moment) -> Diagram:
    """Draw the cube of NDC with the corners that are in it after the step, the one of the step in the accent."""
    trace, position = moment.trace, moment.cursor.position
    geometry, stage = trace.source.geometry, moment.stage_trace
    assembled = geometry.assembled.triangle
    is_there = spaces_reached(trace, "transform", position) >= NDC
    corners = _placed(geometry.vertices.ndc[geometry.vertices.corners_of(assembled)])
    spots, strokes = [], list(cube_strokes())
    row = moment.row
    current = -1 if row < 0 else int(np.flatnonzero(assembled == stage.triangle[row])[0])
    for number in np.flatnonzero(is_there.any(axis=1))[:MOST_TRIANGLES].tolist():
        there = is_there[number]
        if there.all():
            strokes += [
                Stroke(corners[number, ring], "text", 1.2, is_closed=True)
                for ring in geometry.vertices.ring_slices
            ]
        if number == current or not there.all():
            # Of whole triangles the outline is enough: hundreds of dots take long to paint.
            spots += [
                Spot(corners[number, k], f"vertex {geometry.vertices.colors[k]}", radius=3.0)
                for k in np.flatnonzero(there).tolist()
            ]
    drawn = nouns(is_there.shape[1])
    said = f"{drawn.vertices.capitalize()} appear here when they are divided by w."
    if row >= 0 and (k := int(stage.columns["corner"][row])) >= 0:
        space = SPACES[int(spaces_reached(trace, "transform", position)[current, k])]
        said = f"Vertex {k} of {drawn.one} {stage.triangle[row]} is in {space} space."
        if is_there[current, k]:
            spots.append(Spot(corners[current, k], "accent", "ring", 7.0))
        else:
            said += " It comes here when x, y and z are divided by w."
    empty = Word(np.zeros(3), "empty so far", "muted_text")
    return Diagram(
        strokes=tuple(strokes),
        spots=tuple(spots),
        words=() if is_there.any() else (empty,),
        frame=CUBE * 1.05,
        azimuth=0.55,
        elevation=0.35,
        caption=f"{said} Normalized device coordinates: what the camera sees is this cube.",
    )


def _placed(ndc: Floats) -> Floats:
    """Return positions with z turned towards the viewer."""
    placed: Floats = ndc * np.array([1.0, 1.0, -1.0])
    return placed
