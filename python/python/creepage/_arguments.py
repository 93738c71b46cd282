"""What arguments may be: an error names the argument, what was found and what is allowed."""

import operator
import os
from typing import Any, Optional

from ._errors import InputError

#: Another seed gives other samples; it has 64 bits.
LARGEST_SEED = 2**64 - 1
#: More is a slip.
MOST_SAMPLES = 10**6
#: More has no machine.
MOST_THREADS = 1024


def whole(name: str, value: Any, least: int, most: int) -> int:
    """The argument as a whole number from ``least`` to ``most``."""
    try:
        number = operator.index(value)
    except TypeError:
        number = least - 1
    if not least <= number <= most:
        raise InputError(f"found {name} = {value!r}; allowed: a whole number from {least} to {most}")
    return number


def threads_of(threads: Any) -> Optional[int]:
    """None for all cores."""
    return None if threads is None else whole("threads", threads, 1, MOST_THREADS)


def path_of(name: str, value: Any, allowed: str) -> str:
    """The argument as a path."""
    if not isinstance(value, (str, os.PathLike)):
        raise InputError(f"found {name} of type {type(value).__name__}; allowed: {allowed}")
    return os.fspath(value)
