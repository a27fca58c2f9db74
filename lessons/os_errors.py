"""Why the system refused a file, in words."""


def os_error_reason(problem: OSError) -> str:
    """Return the reason as the end of a sentence, as ``no space left on device``."""
    if isinstance(problem, PermissionError):
        return "permission is denied"
    return (problem.strerror or str(problem) or type(problem).__name__).lower()
