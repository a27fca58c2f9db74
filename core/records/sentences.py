"""How messages are put together from what others say: where a sentence begins with a capital and where it ends."""

ENDS = (".", "!", "?", "…")
"""What a sentence ends with."""


def sentence_case(text: str) -> str:
    """Return a text with a capital at its beginning, unless it begins with a symbol or the name of a file.

    ``nothing is there`` becomes ``Nothing is there``; ``E0 is 3`` and ``teapot.obj has no faces`` stay as they are,
    since a name that is written otherwise is another name.
    """
    first = text.partition(" ")[0]
    is_symbol = len(first) < 3
    is_file_name = "." in first.rstrip(".,;:")
    return text if is_symbol or is_file_name else text[:1].upper() + text[1:]


def sentences(*parts: object) -> str:
    """Return parts as sentences that follow each other, each with a full stop where it has no end of its own."""
    texts = [str(part).strip() for part in parts]
    return " ".join(text if text.endswith(ENDS) else f"{text}." for text in texts if text)
