"""The record of a lesson: what a TOML file holds, field by field."""

from typing import Annotated, Any, Literal

from pydantic import AfterValidator, BeforeValidator, Field, model_validator

from core.shaders.presets import PRESETS
from lessons.exercises.record import AnswerPart, ScenePart
from lessons.exercises.toml_values import (
    AnyMistake,
    AnyNumber,
    MistakeName,
    Part,
    SettingTexts,
    Side,
    StageName,
    Text,
    Word,
)

STEP_WORDS, AFTER_WORDS, LINE_WORDS, NOTE_WORDS = 60, 40, 25, 300
"""Most words of a step with its task, of what is said after it, of one line, and of the notes for a lecturer."""
STEPS = (4, 6)
"""Least and greatest number of steps."""
VIEWS = ("pixels", "scene", "clip", "pyramid", "texture", "flow", "compare")
"""Main views of the Step page."""
PANES = ("scene", "methods", "overlays", "shaders", "details", "thumbnails", "navigator", "listing")
"""What may stand beside the grid: only what a state names does."""
KEPT = ("scene", "size", "camera", "settings", "window")
"""What a task may leave as it is: all of it, or for ``window`` that every corner stays in the window."""


def word_count(text: str) -> int:
    """Return how many words a text has; signs alone, as ``=``, are none."""
    return sum(any(map(str.isalnum, word)) for word in text.split())


def _at_most(limit: int) -> AfterValidator:
    def check(text: str) -> str:
        if word_count(text) > limit:
            raise ValueError(f"expected at most {limit} words, got {word_count(text)}")
        return text.strip()

    return AfterValidator(check)


def _scene_table(given: object) -> object:
    return {"builtin": given} if isinstance(given, str) else given


def _conditions(given: object) -> object:
    return [given] if isinstance(given, str) else given


Line = Annotated[Text, _at_most(LINE_WORDS)]
After = Annotated[Text, _at_most(AFTER_WORDS)]
Condition = Annotated[str, Field(min_length=1, max_length=300)]
Conditions = Annotated[list[Condition], BeforeValidator(_conditions)]
Numbers = list[AnyNumber]
Pixel = Annotated[list[Annotated[int, Field(ge=0)]], Field(max_length=2)]
SourceText = Annotated[str, Field(max_length=6000)]
Name = Annotated[str, Field(pattern=r"^[a-z0-9]+(-[a-z0-9]+)*$", max_length=60)]


class CameraPart(Part):
    """Numbers of the camera; what is not named stays."""

    eye: Numbers | None = Field(None, min_length=3, max_length=3)
    target: Numbers | None = Field(None, min_length=3, max_length=3)
    up: Numbers | None = Field(None, min_length=3, max_length=3)
    near: AnyNumber | None = None
    far: AnyNumber | None = None
    field_of_view: AnyNumber | None = None
    """In degrees."""
    view_height: AnyNumber | None = None
    projection: Literal["perspective", "orthographic"] | None = None


class MaterialPart(Part):
    """Numbers of the material of all meshes; what is not named stays."""

    ambient: AnyNumber | None = None
    diffuse: AnyNumber | None = None
    specular: AnyNumber | None = None
    shininess: AnyNumber | None = None


class ChangePart(Part):
    """What is different from a scene as it is named."""

    corners: list[Annotated[Numbers, Field(min_length=4, max_length=4)]] = Field(default_factory=list)
    """[triangle, corner, x, y] in pixels; corners that are shared move along."""
    depth: list[Annotated[Numbers, Field(min_length=3, max_length=3)]] = Field(default_factory=list)
    """[triangle, corner, window depth]."""
    w: list[Annotated[Numbers, Field(min_length=3, max_length=3)]] = Field(default_factory=list)
    """[triangle, corner, w]."""
    camera: CameraPart | None = None
    light: list[Annotated[Numbers, Field(min_length=4, max_length=4)]] = Field(default_factory=list)
    """[light, x, y, z]: where it stands, or the way it goes."""
    edit: list[Annotated[list[SourceText], Field(min_length=3, max_length=3)]] = Field(default_factory=list)
    """[part, old, new]: a text that stands once becomes another one, in the listing of a part that
    `core.edits.EDITABLE` has, or in the ``vertex`` or ``fragment`` shader."""


class StatePart(ChangePart):
    """What is open and where the cursor stands; what a step does not say holds as the file says for all steps."""

    scene: Annotated[ScenePart, BeforeValidator(_scene_table)] | None = None
    """Name of a scene, or a table as in the file of an exercise."""
    size: list[Side] | None = Field(None, min_length=2, max_length=2)
    """Columns and rows of a scene that is named; left out: its own."""
    vertices: list[Annotated[Numbers, Field(min_length=5, max_length=5)]] = Field(default_factory=list)
    """[mesh, vertex, x, y, z] in object space."""
    material: MaterialPart | None = None
    shaders: Literal[tuple(PRESETS)] | None = None  # type: ignore[valid-type]
    """Preset of shaders that draw the scene in place of the built-in ones."""
    shared: bool = False
    """Corners at one place move together."""
    settings: SettingTexts = Field(default_factory=dict)
    """Those that are not the scene's own."""
    other: SettingTexts | None = None
    """What B does otherwise, for A | B; an empty table: only A is shown."""
    printed: str | None = None
    """Name of a listing that B runs as it is printed."""
    stage: StageName | None = None
    at: Condition | None = None
    """What has just happened, as `core.trace.run_to.named_position` reads it."""
    operation: str | None = None
    """The operation of that row that is done last; left out: the whole row."""
    pixel: Pixel | None = None
    """Column and row of the pinned pixel; an empty list: none."""
    triangle: Annotated[int, Field(ge=0)] | None = None
    """The triangle in focus, where a mesh is stepped one triangle at a time."""
    buffer: str | None = None
    """What the grid shows; left out: what the stage shows first."""
    view: Literal[VIEWS] | None = None  # type: ignore[valid-type]
    panes: list[Literal[PANES]] | None = None  # type: ignore[valid-type]


class FailsPart(Part):
    """A method that fails on the open scene, and one that does not."""

    weak: SettingTexts
    robust: SettingTexts
    by: Literal["twice", "differs", "nothing"] = "differs"
    """A pixel is drawn twice, the picture differs from that of ``robust``, or no pixel is drawn."""


class UntilPart(Part):
    """When a task is done: all that is named must hold of what is open."""

    some: Conditions = Field(default_factory=list)
    """Each is met by a row of the stage."""
    none: Conditions = Field(default_factory=list)
    """None is met by any row."""
    count: list[Any] | None = Field(None, min_length=2, max_length=2)
    least: list[Any] | None = Field(None, min_length=2, max_length=2)
    most: list[Any] | None = Field(None, min_length=2, max_length=2)
    """[condition, number of rows that meet it]."""
    here: Condition | None = None
    """The row that was just done meets it."""
    settings: SettingTexts = Field(default_factory=dict)
    """These are chosen."""
    fails: FailsPart | None = None
    pixels: Annotated[int, Field(ge=0)] | None = None
    """So many are drawn."""
    tested: Annotated[int, Field(ge=0)] | None = None
    decisions: Annotated[int, Field(ge=0)] | None = None
    """At most so many pixels are tested, or pixels and blocks together."""
    same: SettingTexts = Field(default_factory=dict)
    """These settings draw the same picture."""
    holds: Conditions = Field(default_factory=list)
    """Quoted numbers that are right, as in ``check``."""
    stage: StageName | None = None
    """The cursor is in it."""
    pixel: Pixel | None = None
    """This pixel is pinned."""
    keeps: list[str] = Field(default_factory=list)
    """What must be as the step gave it: of `KEPT`, or families of methods."""

    @model_validator(mode="after")
    def _says_something(self) -> "UntilPart":
        for name in ("count", "least", "most"):
            pair = getattr(self, name)
            if pair and not (isinstance(pair[0], str) and type(pair[1]) is int and pair[1] >= 0):
                raise ValueError(f'expected {name} = ["covered", 12], a condition and a number of rows')
        if not self.model_fields_set - {"keeps"}:
            raise ValueError("expected a condition that says when the task is done")
        return self


class SolutionPart(ChangePart):
    """What a student does to solve a task: tests do it."""

    settings: SettingTexts = Field(default_factory=dict)
    size: list[Side] | None = Field(None, min_length=2, max_length=2)
    stage: StageName | None = None
    at: Condition | None = None
    pixel: Pixel | None = None


class WrongPart(Part):
    """A wrong answer and what is said of it."""

    given: Any
    says: After
    mistake: AnyMistake | None = None
    """Name on the shelf: B runs with it, where it is a run."""
    at: Condition | None = None
    """The step that refutes it."""
    stage: StageName | None = None


class StepPart(Part):
    """One step."""

    kind: Literal["look", "predict", "do", "break", "measure"]
    text: Text
    task: Line | None = None
    """What is to be done, where the text does not end with it."""
    state: StatePart = Field(default_factory=StatePart)
    answer: Annotated[AnswerPart, Field(discriminator="type")] | None = None
    mistakes: list[MistakeName] = Field(default_factory=list)
    """Of pixels that are found by drawing: runs whose pixels are named as wrong answers."""
    wrong: list[WrongPart] = Field(default_factory=list, max_length=8)
    after: After | None = None
    """What is said when the answer was given or the task is done."""
    reveal: StatePart | None = None
    """What is shown then; left out: the step's own state."""
    until: UntilPart | None = None
    solution: SolutionPart | None = None
    check: Conditions = Field(default_factory=list)
    """Numbers that the text quotes, in the step's state."""
    check_after: Conditions = Field(default_factory=list)
    """Numbers that ``after`` quotes: in ``reveal``, or in what the solution leaves."""
    covers: list[Word] = Field(default_factory=list, max_length=20)
    """Slides that this step covers."""
    show: Word | None = None
    """Of ``measure``: what is opened, as ``compare/fill``, ``stability/slivers`` or ``plan``."""

    @model_validator(mode="after")
    def _is_whole(self) -> "StepPart":
        words = word_count(self.text) + word_count(self.task or "")
        if words > STEP_WORDS:
            raise ValueError(f"expected at most {STEP_WORDS} words in text and task, got {words}")
        has = {"answer": self.answer is not None, "show": self.show is not None}
        for field, kinds in (("answer", ("predict",)), ("show", ("measure",))):
            if has[field] != (self.kind in kinds):
                wanted = "an" if field == "answer" else "a"
                raise ValueError(
                    f"expected {wanted} {field} in a step of kind {kinds[0]}"
                    if self.kind in kinds
                    else f"expected no {field} in a step of kind {self.kind}"
                )
        if (self.until is None) != (self.solution is None):
            raise ValueError("expected until together with its recorded solution")
        if self.kind in ("do", "break") and self.until is None:
            raise ValueError(f"expected until and solution in a step of kind {self.kind}")
        if self.kind not in ("do", "break", "look") and self.until is not None:
            raise ValueError(f"expected no until in a step of kind {self.kind}")
        if self.answer is None and (self.wrong or self.mistakes):
            raise ValueError("expected wrong answers only where there is an answer")
        return self


class NextPart(Part):
    """What the last screen says of the lesson that follows."""

    lesson: Name
    text: Line
    """Its question, in one sentence."""


class LessonPart(Part):
    """A whole file."""

    version: Literal[1]
    """Of the format; files of later versions are refused."""
    title: Word
    question: Line
    """What one wants to know."""
    minutes: Annotated[int, Field(ge=1, le=60)]
    covers: list[Word] = Field(default_factory=list, max_length=40)
    """Slides that the whole lesson covers, as ``Zwicker: Shared edges``."""
    needs: list[Name] = Field(default_factory=list, max_length=8)
    """Lessons to walk first; shown, never forced."""
    answers: Line | None = None
    """The printed question of a lecture that one can now answer."""
    recall: Name | None = None
    """An exercise of an earlier lesson that is asked before the first step, of who has finished that lesson."""
    recall_of: Name | None = None
    """The lesson that it is about; left out: the one that closes with it."""
    exercises: list[Name] = Field(default_factory=list, max_length=2)
    """What closes the lesson."""
    next: NextPart | None = None
    """Left out: the lesson that follows in the order, with its own question."""
    notes: Annotated[Text, _at_most(NOTE_WORDS)] | None = None
    """For a lecturer."""
    state: StatePart = Field(default_factory=StatePart)
    """Where every step begins."""
    step: list[StepPart] = Field(min_length=STEPS[0], max_length=STEPS[1])
