"""What goes wrong, as exceptions."""

from typing import Optional


class CreepageError(Exception):
    """An error of this package. ``file``, ``line`` and ``key`` say where its cause stands in the scene, where that is known."""

    def __init__(
        self, message: str, file: Optional[str] = None, line: Optional[int] = None, key: Optional[str] = None
    ) -> None:
        super().__init__(message)
        self.file = file
        self.line = line
        self.key = key

    def __reduce__(self):
        return type(self), (str(self), self.file, self.line, self.key)


class InputError(CreepageError, ValueError):
    """The scene, a row or an argument is wrong."""


class ComputationError(CreepageError, RuntimeError):
    """The computation failed: there is an error in place of a doubtful number."""
