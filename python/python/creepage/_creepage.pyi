"""The native module; the package's own functions take what people write."""

from os import PathLike
from pathlib import Path
from typing import Any, Callable, Optional, Union

from ._scene import Source

Call = tuple[Optional[int], Optional[Callable[[float], Any]]]

__version__: str

class Table:
    @property
    def column_names(self) -> list[str]: ...
    def __len__(self) -> int: ...
    def __arrow_c_stream__(self, requested_schema: Any = None) -> Any: ...

def run(scene: Source, verify: bool, call: Call) -> str: ...
def report(scene: Source, call: Call) -> str: ...
def sweep(
    scene: Source, rows: Any, samples: int, seed: int, drawn: Optional[list[str]], call: Call
) -> Table: ...
def heads(scene: Source, rows: Any, samples: int) -> tuple[Table, set[str], set[Path]]: ...
def texts(rows: Any) -> tuple[list[str], list[list[str]]]: ...
def read_rows(file: Union[str, PathLike[str]]) -> Table: ...
def calibrate(
    scene: Source,
    name: str,
    readings: bytes,
    fit: list[str],
    robust: bool,
    call: Call,
) -> str: ...
