"""Single runs, sweeps over rows and fits."""

import html
import json
import os
from collections.abc import Iterable, Mapping
from pathlib import Path
from typing import Any, Optional

from . import _creepage
from ._arguments import LARGEST_SEED, MOST_SAMPLES, threads_of, whole
from ._errors import InputError
from ._progress import callback
from ._scene import Scene, Source, source


class Run(dict):
    """What ``creepage run --json`` prints, as a dict whose keys are attributes too.

    So are the fields of the last pass: ``run.downstream_force_n``. In Jupyter it shows its report. ``run.state`` is the cable as the last
    pass leaves it, as bytes: ``creepage.run(scene, from_state=run.state)`` goes on from there.
    """

    def __init__(self, values: Mapping[str, Any], scene: Source, state: bytes = b"") -> None:
        super().__init__(values)
        self.scene = scene
        self.state = state

    def __getattr__(self, name: str) -> Any:
        if name in self:
            return self[name]
        passes = self.get("passes")
        if passes and not name.startswith("_") and name in passes[-1]:
            return passes[-1][name]
        raise AttributeError(f"a run has no {name!r}")

    def __reduce__(self) -> tuple:
        return Run, (dict(self), self.scene, self.state)

    def __dir__(self) -> Iterable[str]:
        return [*super().__dir__(), *self]

    def report(self) -> str:
        """The report as a page of HTML, as ``creepage report`` writes it. It runs the scene again."""
        return _creepage.report(self.scene, (None, None))

    def _repr_html_(self) -> str:
        page = html.escape(self.report(), quote=True)
        return f'<iframe srcdoc="{page}" style="width: 100%; height: 48em; border: 0"></iframe>'


def run(
    scene: Scene,
    overrides: Optional[Mapping[str, Any]] = None,
    *,
    verify: bool = False,
    from_state: Optional[bytes] = None,
    threads: Optional[int] = None,
    progress: Any = None,
) -> Run:
    """The force after every pass.

    scene: path, TOML text or dict. overrides: keys with values, ``{"traffic.passes": 200}``; None removes a key.
    verify: measures the error by a run on a finer mesh. from_state: ``run.state`` of another run of the same duct, or the bytes of a file
    of ``creepage run --save-state``, with which this one begins. threads: at most so many; all cores if left out.
    progress: called with the share that is done, or a bar of tqdm; an exception from it, as Ctrl-C, stops the run.

    Raises InputError or ComputationError, with ``line`` and ``key`` where a key of the scene is at fault.
    """
    own = source(scene, overrides)
    if not isinstance(from_state, (bytes, bytearray, type(None))):
        raise InputError(f"found from_state of type {type(from_state).__name__}; allowed: bytes, as run.state has them")
    begin = None if from_state is None else bytes(from_state).decode(errors="replace")
    answer, state = _creepage.run(own, bool(verify), begin, (threads_of(threads), callback(progress)))
    return Run(json.loads(answer), own, state.encode())


def sweep(
    scene: Scene,
    rows: Any,
    overrides: Optional[Mapping[str, Any]] = None,
    *,
    samples: int = 0,
    seed: int = 1,
    threads: Optional[int] = None,
    progress: Any = None,
) -> Any:
    """One row a duct: the scene with the values of its columns, which are named as keys; the table of ``creepage sweep --rows``.

    rows: anything with ``__arrow_c_stream__``. What comes back is of the same library where that is pyarrow, polars or pandas,
    and else a Table, which these take over. An empty cell leaves the scene's own value; a column ``id`` is carried over.
    samples: of every row, where cells or the scene hold distributions such as ``normal(0.25, 0.03)``; a sample's values follow
    from seed, id, key and its number alone.

    A row that fails has its error in the column ``error``. Raises as run does.
    """
    call = (threads_of(threads), callback(progress))
    samples = whole("samples", samples, 0, MOST_SAMPLES)
    seed = whole("seed", seed, 0, LARGEST_SEED)
    table = _creepage.sweep(source(scene, overrides), _stream(rows), samples, seed, None, call)
    return _as_given(rows, table)


def calibrate(
    scene: Scene,
    rows: Any,
    overrides: Optional[Mapping[str, Any]] = None,
    *,
    fit: Iterable[str] = (),
    robust: bool = False,
    read: Optional[Mapping[str, Any]] = None,
    threads: Optional[int] = None,
    progress: Any = None,
) -> dict:
    """Friction and ground from readings: what ``creepage calibrate --json`` prints, as a dict.

    rows: columns ``pass``, ``force_n`` and, if wanted, ``sigma_n``, or others that the command reads, in anything with
    ``__arrow_c_stream__``; or the path of such a table. fit: names of what is fitted. robust: ignore outliers.
    read: how the table is written, where that is not recognised, by the names of the command's options:
    ``{"decimal": "comma", "column_force": "Kraft", "unit": "kN"}``; a list names several columns.
    """
    if isinstance(rows, (str, os.PathLike)):
        name = os.fspath(rows)
        try:
            readings = Path(name).read_bytes()
        except (OSError, ValueError) as error:
            raise InputError(f"{name}: found no readings that can be read: {error}; allowed: a table of them", file=name) from error
    else:
        name, readings = "rows", _csv(rows)
    call = (threads_of(threads), callback(progress))
    own = source(scene, overrides)
    names = [fit] if isinstance(fit, str) else [str(name) for name in fit or ()]
    if not isinstance(read, (Mapping, type(None))):
        raise InputError(f"found read = {read!r}; allowed: a dict of options")
    values = ((option, given if isinstance(given, (list, tuple)) else [given]) for option, given in (read or {}).items())
    options = [(str(option), str(value)) for option, given in values for value in given if value is not None]
    return json.loads(_creepage.calibrate(own, (name, readings, options), names, bool(robust), call))


def _stream(rows: Any) -> Any:
    if not hasattr(rows, "__arrow_c_stream__"):
        message = f"found rows of type {type(rows).__name__}; allowed: a table with __arrow_c_stream__ (pyarrow, polars, pandas from 3 on)"
        raise InputError(message)
    return rows


def _as_given(rows: Any, table: Any) -> Any:
    """The table in the library of the rows."""
    library = type(rows).__module__.partition(".")[0]
    if library == "pyarrow":
        import pyarrow

        return pyarrow.table(table)
    if library == "polars":
        import polars

        return polars.DataFrame(table)
    if library == "pandas":
        import pandas

        return pandas.DataFrame.from_arrow(table)
    return table


def _csv(rows: Any) -> bytes:
    """The rows as the text of a table."""
    names, columns = _creepage.texts(_stream(rows))
    cell = '"{}"'.format
    lines = [names, *zip(*columns)]
    return "\n".join(",".join(cell(text.replace('"', '""')) for text in line) for line in lines).encode()
