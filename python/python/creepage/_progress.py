"""Progress as a callback or a bar of tqdm."""

from typing import Any, Callable, Optional

from ._errors import InputError


def callback(progress: Any) -> Optional[Callable[[float], Any]]:
    """What is called with the share that is done. A bar of tqdm shows it as a percentage."""
    if progress is None:
        return None
    if not hasattr(progress, "refresh"):
        if not callable(progress):
            raise InputError(f"found progress = {progress!r}; allowed: a function of the share that is done, or a bar of tqdm")
        return progress
    bar = progress
    bar.total = 100

    def show(share: float) -> None:
        bar.n = round(100 * share)
        bar.refresh()

    return show
