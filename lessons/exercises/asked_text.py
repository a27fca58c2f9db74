"""A question and its hints in one block of text, as templates and tasks have it."""


def parts_of(asked: str) -> tuple[str, tuple[str, ...]]:
    """Return the question and the hints of a block of text; each hint begins a line with ``Hint:``.

    Examples
    --------
    >>> parts_of('''What is D? It begins
    ...     with 2 dy - dx.
    ...     Hint: Begin with the first D.
    ...     Hint: Add 2 dy every time.''')
    ('What is D? It begins with 2 dy - dx.', ('Begin with the first D.', 'Add 2 dy every time.'))
    """
    text, *hints = " ".join(line.strip() for line in asked.split("\n")).split(" Hint: ")
    return text, tuple(hints)
