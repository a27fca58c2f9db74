"""Presentation: rows are drawn into a buffer, which waits for a refresh to end, is swapped, and read by the screen.

Times are those of the model, in milliseconds: nothing of them is measured.
"""

from core.explain.formulas import call, formula_of, named
from core.explain.number_text import spoken
from core.explain.records import Asked, choice
from core.explain.step_values import Said, StepValues, explains
from core.explain.steps import VariableText, given, hides, shows
from core.records.words import counted


def _buffer(step: StepValues) -> str:
    """Return the name of the buffer of a step: a single one has no number."""
    return "the buffer" if step.whole("buffer_count") == 1 else f"buffer {step.whole('buffer')}"


@explains("resolve.written|flushed.write")
def written(step: StepValues) -> Said:
    """When a row of a picture, or all of it, is drawn."""
    line, height, time = step.whole("line"), step.whole("height"), step.named("time", "t")
    begun = step.named("begun", r"t_{\mathrm{begun}}")
    what = f"row {line} from the top of picture {step.whole('picture')}"
    if step.kind == "flushed":
        what = f"the last row of picture {step.whole('picture')}"
    text = f"At {time} ms {what} is drawn, which the renderer began at {begun} ms."
    share = (named("r", line) + 1) / named("H", height)
    return text, formula_of(time.equals(begun + share * step.named("drawing_time", "T")))


@explains("resolve.written|flushed.transfer")
def transferred(step: StepValues) -> Said:
    """How many transfers the picture has taken so far."""
    count = counted(step.whole("transfers"), "transfer")
    if step.kind == "flushed":
        return f"The whole picture goes into {_buffer(step)} in {count}.", None
    return f"The row goes into {_buffer(step)}, which makes {count} for this picture so far.", None


@explains("resolve.wait.wait")
def waits(step: StepValues) -> Said:
    """A picture that is ready waits for the end of the refresh."""
    picture, ready = step.whole("picture"), step.named("ready", r"t_{\mathrm{ready}}")
    blank = step.named("blank", r"t_{\mathrm{swap}}")
    period = step.named("refresh_time", "P")
    later = step.whole("next_begun")
    text = f"Picture {picture} is ready at {ready} ms and waits for the end of a refresh at {blank} ms"
    end = -(-ready.value // period.value) * period.value
    first, is_first = call("ceil", ready / period) * period, blank.value == end
    if not is_first:
        text += f", since picture {picture - 1} takes the one before"
    if later > ready.value:
        text += f", and the renderer waits too, until a buffer is free at {later} ms."
    else:
        text += f", while the renderer begins picture {picture + 1}."
    if is_first:
        return text, formula_of(blank.equals(first))
    earlier = named(r"t_{\mathrm{end}}", end)
    return text, formula_of(earlier.equals(first), blank.compared(">", earlier))


@explains("resolve.swap.swap")
def swapped(step: StepValues) -> Said:
    """The back buffer becomes the front buffer."""
    line, height, time = step.whole("line"), step.whole("height"), step.named("time", "t")
    period, refresh = step.named("refresh_time", "P"), step.whole("refresh")
    text = f"At {time} ms {_buffer(step)} with picture {step.whole('picture')} becomes the front buffer, "
    into = time.value - refresh * period.value
    if into == 0:
        text += "between two refreshes."
    elif line >= height:
        text += f"after the last row of refresh {refresh} is read."
    else:
        text += f"and refresh {refresh} reads it from row {line} from the top on."
    at = named("x", into / period.value * height)
    return text, formula_of(at.equals((time - named("f", refresh) * period) / period * named("H", height)))


@explains("resolve.scan.time")
def scan_time(step: StepValues) -> Said:
    """When the screen reads a row."""
    line, refresh, time = step.whole("line"), step.whole("refresh"), step.named("time", "t")
    text = f"Refresh {refresh} reads its row {line} from the top at {time} ms."
    height, period = named("H", step.whole("height")), step.named("refresh_time", "P")
    return text, formula_of(time.equals((named("f", refresh) + named("r", line) / height) * period))


def is_torn(step: StepValues) -> Asked | None:
    """Ask whether the screen is torn here."""
    above, picture = step.whole("above"), step.whole("picture")
    if above < 0:
        return None
    row = f"row {step.whole('line')} from the top of refresh {step.whole('refresh')}"
    reveal = f"it is of picture {picture}, and the row above of picture {above}."
    return choice(
        f"The screen reads {row}, at {spoken(step.number('time'))} ms. "
        "Is it of another picture than the row above?",
        0 if above != picture else 1,
        reveal,
    )


@explains("resolve.scan.read", asks=is_torn, decides=True)
def scanned(step: StepValues) -> Said:
    """Which picture the row shows."""
    above, picture, line = step.whole("above"), step.whole("picture"), step.whole("line")
    text = f"Row {line} from the top of refresh {step.whole('refresh')} is read from {_buffer(step)}"
    if above >= 0 and above != picture:
        text += f" and shows picture {picture}, under a row of picture {above}: the screen is torn here."
    else:
        text += f" and shows picture {picture}."
    return text, None


shows(
    "resolve",
    {
        "refresh": VariableText("f", "Number of the refresh that reads the screen's rows, from 0."),
        "line": VariableText("r", "Row from the top, from 0."),
        "picture": VariableText("picture", "Number of the picture; 0 is shown at the beginning."),
        "begun": VariableText("begun", "When the renderer began the picture, in milliseconds."),
        "ready": VariableText("ready", "When the picture was ready, in milliseconds.", after="blank"),
        "time": VariableText("t", "When this happens, in milliseconds of the model."),
        "blank": VariableText("blank", "When the picture is swapped to the front, in milliseconds."),
        "buffer": VariableText("buffer", "Number of the buffer."),
        "transfers": VariableText("transfers", "Transfers of this picture so far."),
        "drawing_time": given("T", "Time to draw a picture, in milliseconds."),
        "refresh_time": given("P", "Time between two refreshes, in milliseconds."),
        "height": given("H", "Rows of the screen."),
    },
)
hides("resolve.written|flushed|wait|swap|scan", ("column", "row"))
hides("resolve.encode|average|areas|kept|smoothed", ("drawing_time", "refresh_time", "height"))
