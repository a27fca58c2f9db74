"""Why the system refused a file, in words."""


def os_error_reason(problem: OSError) -> str:
    """Return the reason as the end of a sentence, as ``no space left on device``."""
    if isinstance(problem, PermissionError):
        return "permission is denied"
    return (problem.strerror or str(problem) or type(problem).__name__).lower()


def problem_text(problem: Exception) -> str:
    """Return what a message says of a problem: its own sentence, or that of the file which the system refused."""
    if not isinstance(problem, OSError) or problem.strerror is None:
        return str(problem)
    reason = os_error_reason(problem)
    return reason if problem.filename is None else f"{problem.filename} cannot be read or written: {reason}"
