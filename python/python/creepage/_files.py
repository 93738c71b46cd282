"""Files that are written and read as a whole, and noticed where they change."""

import hashlib
import os
import uuid
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path
from typing import Any, Callable

from ._errors import InputError


def write(path: str, make: Callable[[str], Any]) -> None:
    """Writes beside the place and renames: a file is there whole or not at all, also after a loss of power."""
    beside = f"{path}.{uuid.uuid4().hex}.tmp"
    try:
        make(beside)
        with open(beside, "rb") as file:
            os.fsync(file.fileno())
        os.replace(beside, path)
    except FileNotFoundError:
        # Somebody else has written the same, and tidied up.
        if not os.path.exists(path):
            raise
    finally:
        Path(beside).unlink(missing_ok=True)


@contextmanager
def whole_file(path: str, allowed: str) -> Iterator[str]:
    """Tells of the Parquet file that is read where it cannot be."""
    import pyarrow

    try:
        yield path
    except (pyarrow.ArrowException, OSError) as error:
        raise InputError(f"{path}: found what cannot be read: {error}; allowed: {allowed}") from error


def digest(path: str) -> str:
    """What distinguishes this content of a file from another; empty where there is none."""
    found = hashlib.sha256()
    try:
        with open(path, "rb") as file:
            for block in iter(lambda: file.read(1 << 20), b""):
                found.update(block)
    except OSError:
        return ""
    return found.hexdigest()


def check_files(files: dict) -> None:
    """Refuses to go on where a file that the scene or the ducts name is not what it was."""
    for path, before in files.items():
        if digest(path) != before:
            raise InputError(f"{path}: found that it has changed since the study was made; allowed: what it was, or another folder")
