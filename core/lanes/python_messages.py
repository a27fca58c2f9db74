"""What is said of a text that is no Python: Python's own messages in plain words, with what is mostly meant."""

import re

from core.lanes.problem import Limits, Place, Problem

OPEN, CLOSED = "([{", ")]}"
_STRING = re.compile(r"\"[^\"\n]*\"|'[^'\n]*'")
_JOINED = re.compile(r"(?<![A-Za-z_])\d[\d.]*(?:and|or|if|else|in|is|not|for)\b")
_SIGNS = re.compile(r"(?:(?:\bnot\b|[-+~])\s*){33}")


def check_text(text: str, limits: Limits) -> None:
    """Raise `Problem` for a text that is larger or deeper than the limits, before anything else reads it."""
    if len(text) > limits.characters:
        raise Problem(
            Place(1), f"a text has at most {limits.characters:,} characters here, this one has {len(text):,}"
        )
    for number, line in enumerate(text.split("\n"), start=1):
        if len(line) > limits.line_length:
            column = limits.line_length + 1
            raise Problem(Place(number, column), f"a line has at most {limits.line_length} characters here")
        if _SIGNS.search(line) or line.count(" if ") > limits.brackets:
            raise Problem(Place(number), "too much stands in each other here")
        if "\\" in line:
            raise Problem(
                Place(number, line.index("\\") + 1), "this character is not in the language of listings"
            )
        if joined := _JOINED.search(_bare(line)):
            raise Problem(Place(number, joined.start() + 1), "a blank is missing between a number and a word")
    open_places: list[tuple[Place, str]] = []
    for number, line in enumerate(text.split("\n"), start=1):
        for column, letter in enumerate(_bare(line), start=1):
            if letter in OPEN:
                open_places.append((Place(number, column), letter))
            elif letter in CLOSED and open_places:
                open_places.pop()
            if len(open_places) > limits.brackets:
                raise Problem(Place(number, column), f"brackets stand at most {limits.brackets} deep here")


def _bare(line: str) -> str:
    """Return a line with its texts and its comment blanked out; columns stay."""
    blanked = _STRING.sub(lambda found: " " * len(found.group()), line)
    return blanked.partition("#")[0]


def open_bracket(text: str) -> tuple[Place, str] | None:
    """Return the innermost bracket that is never closed, or that is closed by another kind; ``None``: all are."""
    open_places: list[tuple[Place, str]] = []
    for number, line in enumerate(text.split("\n"), start=1):
        for column, letter in enumerate(_bare(line), start=1):
            if letter in OPEN:
                open_places.append((Place(number, column), letter))
            elif letter in CLOSED and open_places:
                place, opened = open_places.pop()
                if OPEN.index(opened) != CLOSED.index(letter):
                    return place, opened
    return open_places[-1] if open_places else None


_MEANT = (
    ("", "unmatched|does not match", "this bracket was never opened"),
    ("", "unterminated|EOL while", "the quotation mark is never closed"),
    (r"&&|\|\|", "", "write and, or"),
    (r"!(?!=)", "", "write not"),
    (r"\+\+|--", "", "write += 1 or -= 1"),
    (r"=>|=<", "", "write >= or <="),
    (r"[<>=!]\s+=", "", "write <=, >=, == and != without a blank between the two signs"),
    (r"\w ?:=", "", "write = to store a value"),
    (
        r"^(int|float|double|bool|var|let|const|auto)\s+\w",
        "",
        "a variable has no type in front of it: it begins with name = value",
    ),
    (r"\.\.", "", "write range(first, end) for numbers one after the other"),
    ("", "expected 'else'", "else is missing: one value if a condition else another"),
    (r"<>", "", "write != for unequal"),
    (r"^(if|while|elif)\b.*(?<![=<>!])=(?!=)", "==", "= stores a value; to compare write =="),
    ("", "expected an indented block", "the lines that belong to the line above must stand further right"),
    ("", "indent", "this line begins further left or right than the others of its block"),
    ("", "cannot assign", "the left side of = must be a name, or several"),
    (r"[;{}]", "", "no ; { } here: a line ends by itself, and blocks are indented"),
    (
        "",
        "leading zeros|invalid decimal literal",
        "this cannot be read: names begin with a letter, numbers without a 0 in front",
    ),
    ("", "invalid character|non-printable", "this character is not in the language of listings"),
)
"""Pattern of a line, or of Python's message, and what is said where the first one of them is found."""


def problem_of(error: SyntaxError, text: str) -> Problem:
    """Return what is said of a text that Python does not read."""
    lines = text.split("\n")
    number = min(max(error.lineno or 1, 1), len(lines))
    place, said = Place(number, max(error.offset or 1, 1)), error.msg
    typed = _bare(lines[number - 1])
    line = typed.strip()
    bracket = open_bracket(text)
    if re.search(r"\belse if\b", line) and not re.search(r"\bif\b.*\belse if\b.*\belse\b", line):
        return Problem(place, "write elif")
    if "expected ':'" in said or _lacks_colon(line):
        return Problem(Place(number, len(typed.rstrip()) + 1), "a colon is missing at the end of this line")
    if bracket is not None:
        return Problem(bracket[0], f"the bracket {bracket[1]} is never closed")
    for in_line, in_message, meant in _MEANT:
        if (in_line and re.search(in_line, line)) or (in_message and re.search(in_message, said)):
            return Problem(place, meant)
    if re.search(r"[-+*/%=<>,]\s*:?$|\b(and|or|not|in)\s*:?$", line):
        return Problem(Place(number, len(typed.rstrip()) + 1), "something is missing at the end of this line")
    if "perhaps you forgot a comma" in said.lower() or _begins_a_value(typed, place.column):
        return Problem(place, "an operator or a comma is missing here")
    return Problem(
        place, "this cannot be read: a bracket, comma or operator is missing here, or stands here twice"
    )


def _begins_a_value(line: str, column: int) -> bool:
    """Return whether a name or a number begins at a column, right behind another value."""
    before, here = line[: column - 1].rstrip(), line[column - 1 :]
    is_behind = re.search(r"[\w)\]]$", before) and not re.search(r"\b(and|or|not|if|else|in|return)$", before)
    return bool(is_behind and re.match(r"\w", here))


def _lacks_colon(line: str) -> bool:
    return (
        bool(re.match(r"(if|elif|else|for|while|def)\b", line))
        and not re.search(r":", line)
        and ("else if" not in line)
        and not line.endswith((",", "(", "[", "\\", "{"))
    )
