"""Where the attempts of this user are kept."""

from lessons.attempts.store import FILE_NAME, AttemptFile

SIZE_LIMIT = 1 << 26
"""Most bytes of an imported file."""


def attempt_file() -> AttemptFile:
    """Return the file of attempts in the user's folder of data; FileWriteError where there is none."""
    from app.files.user_folders import data_folder  # Qt takes a moment: not before an attempt is kept.

    return AttemptFile(data_folder() / FILE_NAME)
