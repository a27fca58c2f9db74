"""Rules on LaTeX text: cut it into cells, colour a vertex's symbols, write it plainly, and in words.

A formula is two lines, the symbols and the same with numbers put in. Both are cut into cells at ``&``, or,
where there is none, at every relation, plus and binary minus outside brackets. Equal cell counts put each
number under its symbol; and as only the cells with numbers change from step to step, the others come from the
cache.
"""

import re
import unicodedata
from collections.abc import Callable, Sequence
from functools import lru_cache

from core.explain.records import Formula

# Rules on LaTeX text: cut it into cells, colour a vertex's symbols, and write it plainly.


_TOKEN = re.compile(r"\\(?:[A-Za-z]+|.)|\s+|.", re.DOTALL)
_OPENING = {"{", "(", "[", r"\{", r"\left", r"\begin", r"\lfloor", r"\lceil", r"\langle"}
_CLOSING = {"}", ")", "]", r"\}", r"\right", r"\end", r"\rfloor", r"\rceil", r"\rangle"}
_RELATIONS = {
    *(
        *("=", "<", ">", r"\le", r"\leq", r"\ge", r"\geq", r"\ne", r"\neq", r"\approx", r"\to"),
        *(r"\equiv", r"\in"),
    ),
    *(
        *(r"\Rightarrow", r"\rightarrow", r"\mapsto", r"\land", r"\lor", r"\wedge", r"\vee", r"\iff"),
        *(r"\quad", r"\qquad"),
    ),
}
_SIGNS = {"+", "-", r"\pm"}
_PRODUCTS = {r"\cdot", r"\times"}
_VERTEX_MACRO = re.compile(r"\\vertex\s*\{([012])\}")
_SUBSCRIPTED = re.compile(
    r"(?P<symbol>\\(?:[A-Za-z]+)|[A-Za-z])_(?:(?P<bare>[012])|\{(?P<braced>[012])\})(?![0-9])"
)
_EDGE_LETTER = re.compile(r"\\(alpha|beta|gamma)(?![A-Za-z_])(?!\s*_)")
MATRIX_WITH_SCRIPT = re.compile(
    r"(\\begin\{([bpvBV]?matrix|array)\}(?:(?!\\begin).)*?\\end\{\2\})(?=\s*[\^_])", re.DOTALL
)
_BETWEEN = re.compile(r"(?<=[^\s&])[\s&]*\\q?quad(?![A-Za-z])(?![\s&]*\(\\mathrm\{mod)[\s&]*(?=\S)")
"""What stands between two statements of one line, but not before a modulus."""
_EDGE_LETTERS = {"alpha": 0, "beta": 1, "gamma": 2}
_PLAIN = {
    **{
        r"\cdot": "\u00b7",
        r"\times": "\u00d7",
        r"\le": "\u2264",
        r"\leq": "\u2264",
        r"\ge": "\u2265",
        r"\geq": "\u2265",
    },
    **{r"\ne": "\u2260", r"\neq": "\u2260", r"\approx": "\u2248", r"\to": "\u2192", r"\rightarrow": "\u2192"},
    **{
        r"\Rightarrow": "\u21d2",
        r"\alpha": "\u03b1",
        r"\beta": "\u03b2",
        r"\gamma": "\u03b3",
        r"\lambda": "\u03bb",
    },
    **{
        r"\pi": "\u03c0",
        r"\theta": "\u03b8",
        r"\Delta": "\u0394",
        r"\delta": "\u03b4",
        r"\epsilon": "\u03b5",
        r"\rho": "\u03c1",
        r"\log": "log",
    },
    **{r"\infty": "\u221e", r"\pm": "\u00b1", r"\sqrt": "\u221a", r"\sum": "\u03a3", r"\in": "\u2208"},
    **{r"\land": "and", r"\wedge": "and", r"\lor": "or", r"\vee": "or", r"\max": "max", r"\min": "min"},
    **{r"\lfloor": "\u230a", r"\rfloor": "\u230b", r"\lceil": "\u2308", r"\rceil": "\u2309", r"\det": "det"},
}


def split_cells(latex: str, *, splits_products: bool = False) -> tuple[str, ...]:
    """Cut a line at top-level ``&``, or else around each top-level relation, plus and binary minus.

    Parameters
    ----------
    latex : str
        One line of mathematics.
    splits_products : bool
        Cut around multiplication signs as well.

    Returns
    -------
    tuple of str
        Cells in reading order, none empty; joined by blanks they are the line again, less the ``&``.
    """
    marked = _cut(latex, lambda token, _: token == "&")
    if "&" in marked:
        return tuple(cell for cell in marked if cell != "&")
    return _cut(
        latex,
        lambda token, before: (
            token in _RELATIONS
            or (token in _PRODUCTS and splits_products)
            or (token in _SIGNS and _ends_a_term(before))
        ),
    )


def split_products(latex: str) -> tuple[str, ...]:
    r"""Cut a cell around its top-level multiplication signs.

    >>> split_products(r"a \cdot (b \cdot c)")
    ('a', '\\cdot', '(b \\cdot c)')
    """
    return _cut(latex, lambda token, _: token in _PRODUCTS)


def _cut(latex: str, cuts_at: Callable[[str, str], bool]) -> tuple[str, ...]:
    """Cut a line around top-level tokens that are asked for, each with what stands before it since the last cut."""
    cells, depth = [""], 0
    for token in _TOKEN.findall(latex):
        depth += (token in _OPENING) - (token in _CLOSING)
        if depth <= 0 and token not in _CLOSING and cuts_at(token, cells[-1]):
            cells.extend((token, ""))
        else:
            cells[-1] += token
    return tuple(cell.strip() for cell in cells if cell.strip())


def _ends_a_term(before: str) -> bool:
    present = before.rstrip()
    return bool(present) and not present.endswith(("^", "_", r"\cdot", r"\times", ",", "/"))


def is_operator(cell: str) -> bool:
    """Return whether a cell is a lone relation, sign or multiplication sign, which takes room on both sides."""
    return cell in _RELATIONS or cell in _SIGNS or cell in _PRODUCTS


def is_product(cell: str) -> bool:
    """Return whether a cell is a lone multiplication sign."""
    return cell in _PRODUCTS


def may_begin_line(cells: Sequence[str], place: int) -> bool:
    """Return whether a wrapped line may begin at a cell: not at a product, nor behind an operator."""
    return cells[place] not in _PRODUCTS and (place == 0 or not is_operator(cells[place - 1]))


def vertex_of(latex: str) -> int | None:
    """Return the vertex (0, 1, 2) that all symbols of a cell belong to; None where there is none."""
    found = {int(match[1]) for match in _VERTEX_MACRO.finditer(latex)}
    if found:
        return found.pop() if len(found) == 1 else None
    rest = _EDGE_LETTER.sub("", _SUBSCRIPTED.sub("", latex))
    if re.search(r"[A-Za-z]", re.sub(r"\\[A-Za-z]+", "", rest)):
        return None
    found = {int(match["bare"] or match["braced"]) for match in _SUBSCRIPTED.finditer(latex)}
    found |= {_EDGE_LETTERS[match[1]] for match in _EDGE_LETTER.finditer(latex)}
    return found.pop() if len(found) == 1 else None


def color_vertices(latex: str, colors: Sequence[str]) -> str:
    r"""Give each vertex's symbols its colour.

    Parameters
    ----------
    latex : str
        Symbols with a subscript 0, 1 or 2, the edge functions ``\alpha``, ``\beta``, ``\gamma`` (edges 0, 1,
        2), and anything inside ``\vertex{k}{...}`` belong to a vertex.
    colors : sequence of str
        Three colours as ``#rrggbb``.
    """
    if _VERTEX_MACRO.search(latex):
        return _VERTEX_MACRO.sub(lambda match: rf"\textcolor{{{colors[int(match[1])]}}}", latex)

    def subscripted(match: re.Match[str]) -> str:
        number = match["bare"] or match["braced"]
        return rf"\textcolor{{{colors[int(number)]}}}{{{match['symbol']}_{number}}}"

    def letter(match: re.Match[str]) -> str:
        return rf"\textcolor{{{colors[_EDGE_LETTERS[match[1]]]}}}{{\{match[1]}}}"

    return _EDGE_LETTER.sub(letter, _SUBSCRIPTED.sub(subscripted, latex))


def without_macros(latex: str) -> str:
    r"""Return standard LaTeX for the clipboard: ``\vertex{k}{...}`` becomes ``{...}``, alignment marks go."""
    text = _VERTEX_MACRO.sub("", latex)
    cells = split_cells(text)
    return " ".join(cells)


@lru_cache(maxsize=4096)
def plain_text(latex: str) -> str:
    """Readable text for screen readers, tooltips, and formulas that cannot be typeset."""
    text = _BETWEEN.sub("; ", _VERTEX_MACRO.sub("", latex)).replace(r"\_", "_")
    text = re.sub(r"\\(?:textcolor|color)\{[^{}]*\}", "", text)
    text = re.sub(r"\\(?:mathrm|text)\s*\{([^{}]*)\}", r"\1", text)
    for _ in range(4):
        text = re.sub(r"([_^])\{\s*([^{}]*?)\s*\}", r"\1\2", text)
        text = re.sub(r"(?<![A-Za-z}_^])\{([^{}]*)\}", r"\1", text)
        text = re.sub(r"\\[dt]?frac\s*\{([^{}]*)\}\s*\{([^{}]*)\}", r"(\1)/(\2)", text)
    text = re.sub(r"\\(?:begin|end)\{[^{}]*\}(?:\{[^{}]*\})?", " ", text).replace(r"\\", "; ")
    text = re.sub(r"\\(?:quad|qquad|,|;|!|left|right)(?![A-Za-z])", " ", text)
    text = re.sub(r"\\[A-Za-z]+", lambda match: _PLAIN.get(match[0], match[0][1:]), text)
    text = re.sub(r"[{}&\\]", " ", text).replace("-", "\u2212")
    text = re.sub(r"\((\w+)\)/\((\w+)\)", r"\1/\2", text)
    return re.sub(r"\s+", " ", text).strip()


# Formulas in words, for those who hear them.


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
    text = plain_text(latex)
    for pattern, replacement in _PATTERNS:
        text = re.sub(pattern, replacement, text)
    return re.sub(r" ([.,])(?= |$)", r"\1", " ".join("".join(map(_said, text)).split()))


def _said(sign: str) -> str:
    """Return what is said for one character."""
    if sign in _WORDS:
        return f" {_WORDS[sign]} "
    name = unicodedata.name(sign, "")
    return f" {name.split()[-1].lower().replace('lamda', 'lambda')} " if name.startswith("GREEK") else sign
