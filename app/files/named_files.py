"""The files that another file names, as a mesh its textures: read from its folder, from elsewhere only if allowed."""

import os
import re
from dataclasses import dataclass
from pathlib import Path


class OutsideWarning(str):
    """A warning about a file that was not read because it lies outside the folder of the file that names it."""

    __slots__ = ()


class NamedFileError(ValueError):
    """A named file is not to be had; the message goes on after its name, as ``does not exist``."""


class OutsideError(NamedFileError):
    """A named file lies outside the folder of the file that names it, and only its folder is allowed."""


@dataclass(frozen=True)
class NamedFiles:
    """Finds the files that a file names."""

    path: Path
    """The file that was opened."""
    allows_outside: bool = False
    """Whether files may be read that lie outside its folder."""

    def find(self, name: str, folder: Path | None = None) -> Path:
        """Return where the file ``name`` is.

        Parameters
        ----------
        name : str
            The name, as the file gives it.
        folder : Path, optional
            The folder of the file in which it is written; that of ``path`` by default.

        Raises
        ------
        OutsideError
            If it is outside the folder of ``path``, with all links followed, and that is not allowed.
        NamedFileError
            If it is not there, or on a network.

        Notes
        -----
        Names written on another machine may have backslashes, or folders that are not here; then the file that stands
        beside is meant. Nothing outside the folder is even looked for unless that is allowed: a look at a network path
        may already send the user's name and password.
        """
        name = name.strip().strip('"').replace("\\", "/")
        folder = self.path.parent if folder is None else folder
        whole = Path(os.path.normpath(folder / name))
        near = folder / name.rsplit("/", 1)[-1]
        on_network = is_network_path(name)
        may_look = not on_network and (self.allows_outside or self._is_inside(whole))
        for place in [whole, near] if may_look else [near]:
            if (self.allows_outside or self._is_inside(place)) and os.path.isfile(place):
                return place
        if on_network:
            raise NamedFileError("is on a network, from where no named file is read")
        if not may_look or (
            os.path.lexists(whole) and not self.allows_outside and not self._is_inside(whole)
        ):
            raise OutsideError(f"is outside the folder of {self.path.name}")
        raise NamedFileError("is not a file" if os.path.lexists(whole) else "does not exist")

    def _is_inside(self, place: Path) -> bool:
        """Return whether a place is in the folder of ``path`` or below, by its name and with all links followed."""
        folder = os.path.abspath(self.path.parent)
        try:
            return Path(os.path.abspath(place)).is_relative_to(folder) and Path(
                os.path.realpath(place)
            ).is_relative_to(os.path.realpath(folder))
        except ValueError:  # a zero byte, which no name of a file has
            return False


def left_out(what: str, problem: NamedFileError) -> str:
    """Return the warning that a named file, ``what``, is not used."""
    text = f"{what} {problem}; it is left out"
    return OutsideWarning(text) if isinstance(problem, OutsideError) else text


def is_network_path(name: str) -> bool:
    """Return whether a name is that of a file on another machine: ``//server/share`` or ``http://server``."""
    return re.match(r"[/\\]{2}|[A-Za-z][A-Za-z0-9+.-]+://", name) is not None
