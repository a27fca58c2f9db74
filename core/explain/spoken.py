"""Formulas in words, for those who hear them."""

import re
import unicodedata

from core.explain.latex import plain_text, split_cells
from core.explain.records import Formula

_PATTERNS = (
    (r"\u00b7 10\^(\u2212?\d+)", r"times 10 to the power \1"),
    (r"\(([\w.\u2212]+(?: times 10 to the power \u2212?\d+)?)\)", r" \1"),
    (r"\^T\b", " transposed"),
    (r"\b([A-Z]) \u00b7 ([A-Z])\b", r"\1 dot \2"),
    (r"\|(\w+)\|", r"length of \1"),
    (r"\^2\b", " squared"),
    (r"(?<=[a-z]{2})_(?=[a-z]{2})", " "),
    (r" ?; ?", ". "),
)
"""Patterns of plain text and what is said for them, in this order; brackets around one number are not said."""
_WORDS = {
    "=": "equals",
    "\u2248": "is about",
    "\u2260": "is not",
    "<": "is less than",
    "\u2264": "is at most",
    ">": "is greater than",
    "\u2265": "is at least",
    "\u2261": "is equivalent to",
    "\u2208": "is in",
    "\u00b7": "times",
    "\u00d7": "times",
    "+": "plus",
    "\u2212": "minus",
    "\u00b1": "plus or minus",
    "/": "over",
    "\u2192": "becomes",
    "\u21d2": "so",
    "^": "to the power",
    "_": "",
    "\u221a": "root of",
    "\u03a3": "sum of",
    "\u221e": "infinity",
    "\u230a": "floor of",
    "\u230b": "",
    "\u2308": "ceiling of",
    "\u2309": "",
    "(": "open bracket",
    ")": "close bracket",
}
_DECIDES = r"\Rightarrow"


def spoken(formula: Formula) -> str:
    r"""Return a formula in words.

    Parameters
    ----------
    formula : Formula
        A decision (with ``\Rightarrow``) is said once, every symbol with its number; of an equation the symbols are
        said first, then the numbers.

    Returns
    -------
    str
        Words, numbers and names, without signs that a screen reader leaves out.

    Examples
    --------
    >>> from core.explain.records import Formula
    >>> spoken(Formula(r"E_0 > 0 \Rightarrow \text{covered}", r"460.75 > 0 \Rightarrow \text{covered}"))
    'E 0 = 460.75 is greater than 0, so covered'
    >>> spoken(Formula(r"E_0 = a_0 \cdot x + c_0", r"-2 = 4 \cdot 0.5 + (-4)"))
    'E 0 equals a 0 times x plus c 0. minus 2 equals 4 times 0.5 plus minus 4'
    """
    symbols, numbers = split_cells(formula.symbolic), split_cells(formula.substituted)
    if _DECIDES not in symbols or len(symbols) != len(numbers):
        return ". ".join(_words(line) for line in (formula.symbolic, formula.substituted) if line)
    end = symbols.index(_DECIDES)
    said = []
    for place, (symbol, number) in enumerate(zip(symbols, numbers, strict=True)):
        is_value = symbol != number and place < end and re.search(r"\d", number)
        said.append(f"{_words(symbol)} = {_words(number)}" if is_value else _words(number))
    return " ".join(said).replace(" so ", ", so ")


def _words(latex: str) -> str:
    """Return one line of LaTeX in words."""
    text = plain_text(re.sub(r"\\q?quad(?![A-Za-z])", ";", latex))
    for pattern, replacement in _PATTERNS:
        text = re.sub(pattern, replacement, text)
    return re.sub(r" ([.,])(?= |$)", r"\1", " ".join("".join(map(_said, text)).split()))


def _said(sign: str) -> str:
    """Return what is said for one character."""
    if sign in _WORDS:
        return f" {_WORDS[sign]} "
    name = unicodedata.name(sign, "")
    return f" {name.split()[-1].lower().replace('lamda', 'lambda')} " if name.startswith("GREEK") else sign
