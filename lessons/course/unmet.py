"""What of a task does not hold yet, in a sentence that names no solution."""

import re
from collections.abc import Callable, Mapping

import numpy as np

from core.methods import table
from core.settings import FIELDS
from lessons.course.quoted import Situation, flags_of, is_right, value_of
from lessons.course.record import UntilPart
from lessons.course.tasks import fails_on, first_open, is_kept
from lessons.exercises.drafting import different_pixels

KEPT_TEXTS = {
    "scene": "the task keeps the scene, and it has changed",
    "size": "the task keeps the size of the picture, and it has changed",
    "camera": "the task keeps the camera, and it has changed",
    "settings": "the task keeps the methods, and another one is chosen",
    "window": "the task keeps all corners inside the window",
}
COUNTED = {"drawn": "{} drawn", "tested": "{} tested", "seen": "{} seen"}
"""Names of numbers that are counts of pixels, and what is said of these."""
_RIGHT = {
    "twice": "draws no pixel twice",
    "differs": "still draws the right picture",
    "nothing": "still draws something",
}
"""What a method does that does not fail."""
OF_EDITED = {"drawn": "{} drawn by your version", "twice": "{} drawn twice by your version"}
_EDITED = re.compile(r"edited\((\w+)(?:\((\d+), (\d+)\))?\) [=<>!]")
"""A number that is asked of the edited listings: of the picture, or at a pixel."""
_COLOR = re.compile(r"(?:linear|shown)\((\d+), (\d+), \d\)")
"""A quoted number that is a channel of a pixel."""


def unmet(until: UntilPart, situation: Situation, start: Situation) -> str:
    """Return what does not hold yet; empty: all of it does, or the stage at hand does not have what is asked."""
    try:
        key = first_open(until, situation, start)
        said = _SAID[key](until, situation, start) if key in _SAID else ""
    except ValueError:
        return ""
    return f"Not yet: {said}." if said else "Not yet." if key else ""


def _pixels(count: int, said: str = "{}") -> str:
    """Return a count of pixels, as in ``1 pixel is drawn``."""
    return said.format(f"{count:,} pixels are" if count > 1 else f"{'1' if count else 'no'} pixel is")


def _steps(condition: str, situation: Situation) -> str:
    count = int(np.count_nonzero(flags_of(condition, situation.trace)))
    if not count:
        return "no step of this stage does what the task asks for"
    return f"{count:,} {'step' if count == 1 else 'steps'} of this stage {'does' if count == 1 else 'do'} it"


def _some(until: UntilPart, situation: Situation, start: Situation) -> str:
    return "no step of this stage does what the task asks for"


def _none(until: UntilPart, situation: Situation, start: Situation) -> str:
    count = max(int(np.count_nonzero(flags_of(condition, situation.trace))) for condition in until.none)
    return f"{count:,} {'step is' if count == 1 else 'steps are'} left that the task wants gone"


def _counted(until: UntilPart, situation: Situation, start: Situation) -> str:
    condition, _ = until.count or until.least or until.most or ("", 0)
    return _steps(condition, situation)


def _settings(until: UntilPart, situation: Situation, start: Situation) -> str:
    chosen = until.settings
    family = next(name for name in chosen if getattr(situation.settings, name) != chosen[name])
    return f"the task asks for another choice of {FIELDS[family].title}"


def _keeps(until: UntilPart, situation: Situation, start: Situation) -> str:
    lost = next(name for name in until.keeps if not is_kept(name, situation, start))
    if lost in KEPT_TEXTS:
        return KEPT_TEXTS[lost]
    return f"the task keeps the choice of {FIELDS[lost].title}, and another one is made"


def _drawn(until: UntilPart, situation: Situation, start: Situation) -> str:
    return _pixels(value_of("drawn", situation), COUNTED["drawn"])


def _tested(until: UntilPart, situation: Situation, start: Situation) -> str:
    return _pixels(value_of("tested", situation), COUNTED["tested"])


def _decisions(until: UntilPart, situation: Situation, start: Situation) -> str:
    return f"{value_of('decisions', situation):,} blocks and pixels are tested"


def _same(until: UntilPart, situation: Situation, start: Situation) -> str:
    count = len(different_pixels(situation.frame(), situation.frame(until.same)))
    return f"{count:,} {'pixel still differs' if count == 1 else 'pixels still differ'}"


def _fails(until: UntilPart, situation: Situation, start: Situation) -> str:
    assert until.fails is not None
    if fails_on(until.fails, situation, until.fails.weak):
        return f"{_titles(until.fails.robust)} should stay right, and fails, too"
    return f"{_titles(until.fails.weak)} {_RIGHT[until.fails.by]}"


def _titles(chosen: Mapping[str, str]) -> str:
    return " with ".join(f"“{table.get(family, name).title}”" for family, name in chosen.items())


def _holds(until: UntilPart, situation: Situation, start: Situation) -> str:
    text = next(text for text in until.holds if not is_right(text, situation))
    name = text.split()[0]
    if name in COUNTED:
        return _pixels(value_of(name, situation), COUNTED[name])
    if name.startswith("edited("):
        return _edited(text, situation) if situation.edits else "the listing is unchanged"
    if name.startswith("differs("):
        count = value_of(text[: text.index(")") + 1], situation)
        return f"{count:,} {'pixel differs' if count == 1 else 'pixels differ'}"
    if (place := _COLOR.match(text)) is not None:
        at = f"{place[1]}, {place[2]}"
        shown = ", ".join(str(value_of(f"shown({at}, {channel})", situation)) for channel in range(3))
        return f"pixel ({at}) has the colour ({shown}), and should have another"
    if name.startswith("apart("):
        count = value_of(text[: text.index(")") + 1], situation)
        return f"the largest difference of a colour is {count} of 255"
    return ""


def _edited(text: str, situation: Situation) -> str:
    """Return what the edited listings give where ``text`` asks for something else."""
    found = _EDITED.match(text)
    name, x, y = found.groups() if found is not None else ("", None, None)
    if x is None and name in OF_EDITED:
        return _pixels(value_of(f"edited({name})", situation), OF_EDITED[name])
    if x is None or name not in ("drawn", "u", "v"):
        return "your version gives other values"
    value = value_of(f"edited({name}({x}, {y}))", situation)
    if name != "drawn":
        return f"your version finds {name} = {value:.4g} at pixel ({x}, {y})"
    often = {0: "does not draw", 1: "draws"}.get(value, "draws more than once")
    return f"your version {often} pixel ({x}, {y})"


_SAID: dict[str, Callable[[UntilPart, Situation, Situation], str]] = {
    "settings": _settings,
    "keeps": _keeps,
    "some": _some,
    "none": _none,
    "count": _counted,
    "least": _counted,
    "most": _counted,
    "pixels": _drawn,
    "tested": _tested,
    "decisions": _decisions,
    "same": _same,
    "fails": _fails,
    "holds": _holds,
}
"""By key of `UntilPart`, what is said while it does not hold; nothing of where the cursor is to stand."""
