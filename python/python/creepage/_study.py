"""A network of ducts with a Monte Carlo each, as a folder of Parquet parts that any engine may compute.

A part is a function of its number alone, and stands in the folder whole or not at all: it is written beside its place and renamed. So a
rerun computes what is missing and nothing else, whatever was killed, and the bytes are the same on any engine and any number of workers.

    study.json          the manifest: scene, samples, seed, how many ducts a part; whoever has it can compute any part
    ducts.parquet       the ducts, with their ids
    parts/part-*.parquet    a row a sample: id, what was drawn, sample, answer, status, error
"""

import hashlib
import heapq
import json
import os
import uuid
from collections import Counter
from collections.abc import Iterable, Iterator
from functools import lru_cache
from pathlib import Path
from typing import Any, Callable, Optional, Union

from . import _creepage
from ._arguments import LARGEST_SEED, MOST_SAMPLES, path_of, threads_of, whole
from ._engines import on_dask, on_this_machine
from ._errors import InputError
from ._progress import callback
from ._scene import Scene, Source, source

#: What the folder looks like.
FORMAT = 2
#: Rows that a part has at least, if there are as many: about half a minute of one core.
ROWS_OF_A_PART = 2000
#: Rows of ducts that are read at once.
DUCTS_AT_ONCE = 8192
#: More is a slip.
MOST_DUCTS = 10**12
#: What the rows of a summary say of the samples of a duct.
FORCES = ("downstream_force_n", "upstream_force_n", "max_compression_n")
QUANTILES = (0.05, 0.5, 0.95)

#: What ducts may be.
TABLES = "a file that ends in .parquet or .csv, or a table with __arrow_c_stream__ (pyarrow, polars, pandas from 3 on)"

PathLike = Union[str, "os.PathLike[str]"]


def study(
    scene: Scene,
    ducts: Any,
    out: PathLike,
    *,
    samples: int = 0,
    seed: int = 1,
    ducts_per_part: Optional[int] = None,
    client: Any = None,
    threads: Optional[int] = None,
    progress: Any = None,
) -> "Study":
    """Computes every duct of a table, each with so many samples, into the folder ``out``. Run again, it computes what is missing.

    ducts: a Parquet or CSV file, or anything with ``__arrow_c_stream__``; a row a duct, columns named as keys of the scene, and ``id``.
    Only Parquet files are read a few thousand rows at a time, all others as a whole.
    A cell, or a value of the scene, may be a distribution: ``normal(0.25, 0.03)``. client: a client of Dask whose workers see the
    folder; without one, this machine computes in so many threads. progress: called with the share of the parts that are done, or a bar
    of tqdm.

    Samples are as exact as their scatter asks for: to ``solver.tolerance``, or to a quarter of the standard deviation of the duct's
    largest force where that is more, up to 5 %. Each says its error in ``error_estimate``.
    """
    threads, show = threads_of(threads), callback(progress)
    made = Study.create(scene, ducts, out, samples=samples, seed=seed, ducts_per_part=ducts_per_part)
    missing = made.missing()
    done = made.parts - len(missing)

    def tell(count: int) -> None:
        if show is not None:
            show((done + count) / made.parts)

    tell(0)
    if client is None:
        on_this_machine(compute_part, made.out, missing, threads, tell)
    else:
        on_dask(client, compute_part, made.out, missing, tell)
    made.tidy()
    return made


def compute_part(out: PathLike, number: int, threads: int = 1, progress: Any = None) -> bool:
    """Computes one part, unless it is there; whether it did. Nothing else is needed on another engine: see docs/python.md."""
    return Study(out).compute(number, threads, progress)


class Study:
    """A study in its folder, finished or not."""

    def __init__(self, out: PathLike) -> None:
        self.out = os.path.abspath(path_of("out", out, "a folder"))
        manifest = _manifest(self.out)
        self.ducts: int = manifest["ducts"]
        self.samples: int = manifest["samples"]
        self.seed: int = manifest["seed"]
        self.ducts_per_part: int = manifest["ducts_per_part"]
        self._scene = Source(**manifest["scene"])
        self._files: dict = manifest["files"]
        self._columns: list = manifest["columns"]

    @classmethod
    def create(
        cls,
        scene: Scene,
        ducts: Any,
        out: PathLike,
        *,
        samples: int = 0,
        seed: int = 1,
        ducts_per_part: Optional[int] = None,
    ) -> "Study":
        """Makes the folder and checks keys and distributions of all ducts, without computing any. The same study is opened again."""
        out = os.path.abspath(path_of("out", out, "a folder"))
        own = source(scene)
        samples = whole("samples", samples, 0, MOST_SAMPLES)
        seed = whole("seed", seed, 0, LARGEST_SEED)
        if os.path.exists(own.name):
            # Beside it a table of axle loads may lie.
            own = own._replace(name=os.path.abspath(own.name))
        per_part = max(1, ROWS_OF_A_PART // max(1, samples))
        if ducts_per_part is not None:
            per_part = whole("ducts_per_part", ducts_per_part, 1, MOST_DUCTS)
        ducts = _lasting(ducts)
        wanted = {
            "format": FORMAT,
            "version": _creepage.__version__,
            "scene": own._asdict(),
            "samples": samples,
            "seed": seed,
            "ducts_per_part": per_part,
            "source": _fingerprint(ducts),
        }
        # In this order: the parts of a study come after its manifest.
        strange = any(Path(out, "parts").glob("part-*.parquet"))
        if os.path.exists(os.path.join(out, "study.json")):
            found = _manifest(out)
            other = [key for key, value in wanted.items() if found.get(key) != value]
            if other:
                raise InputError(f"{out}: found another study, with another {' and '.join(other)}; allowed: the same study, or an empty folder")
            _check_files(found["files"])
            return cls(out)
        if strange:
            raise InputError(f"{out}: found parts of a study without its manifest, study.json; allowed: a folder without them")
        try:
            os.makedirs(os.path.join(out, "parts"), exist_ok=True)
        except OSError as error:
            raise InputError(f"{out}: cannot be the folder of a study: {error}; allowed: a folder that can be written") from error
        checked = _copy_ducts(own, ducts, os.path.join(out, "ducts.parquet"), samples, per_part)
        # The manifest comes last: where it is, all else is.
        text = json.dumps({**wanted, **checked}, indent=1)
        _write(os.path.join(out, "study.json"), lambda path: Path(path).write_text(text, encoding="utf-8"))
        return cls(out)

    @property
    def parts(self) -> int:
        """How many parts there are."""
        return -(-self.ducts // self.ducts_per_part)

    def part(self, number: int) -> str:
        """The file of a part."""
        return os.path.join(self.out, "parts", f"part-{number:07}.parquet")

    def missing(self) -> list:
        """Numbers of the parts that are not computed yet."""
        there = {entry.name for entry in os.scandir(os.path.join(self.out, "parts"))}
        return [number for number in range(self.parts) if os.path.basename(self.part(number)) not in there]

    def compute(self, number: int, threads: int = 1, progress: Any = None) -> bool:
        """Computes a part, unless it is there; whether it did."""
        import pyarrow
        import pyarrow.parquet

        path = self.part(whole("number", number, 0, self.parts - 1))
        call = (threads_of(threads), callback(progress))
        if os.path.exists(path):
            return False
        _check_files(self._files)
        schema = self._schema()
        drawn = schema.names[1 : schema.names.index("sample")]
        rows = pyarrow.table(_creepage.sweep(self._scene, self._ducts(number), self.samples, self.seed, drawn, call))
        rows = rows.append_column("sample", pyarrow.nulls(len(rows), "int64")) if "sample" not in rows.column_names else rows
        rows = rows.select(schema.names).cast(schema)
        _write(path, lambda path: pyarrow.parquet.write_table(rows, path, compression="snappy"))
        return True

    def _schema(self) -> Any:
        import pyarrow

        return pyarrow.schema([(name, pyarrow.type_for_alias(kind)) for name, kind in self._columns])

    def _ducts(self, number: int) -> Any:
        """The ducts of a part."""
        import pyarrow.parquet

        group = _ducts_per_group(self.ducts_per_part)
        first = number * self.ducts_per_part
        with pyarrow.parquet.ParquetFile(os.path.join(self.out, "ducts.parquet")) as file:
            return file.read_row_group(first // group).slice(first % group, self.ducts_per_part)

    def tidy(self) -> None:
        """Removes what killed processes have left half written, once no part is missing."""
        if not self.missing():
            for entry in os.scandir(os.path.join(self.out, "parts")):
                if entry.name.endswith(".tmp"):
                    os.remove(entry.path)

    def dataset(self) -> Any:
        """All finished parts as a pyarrow dataset, which reads only what is asked of it."""
        import pyarrow.dataset

        return pyarrow.dataset.dataset([self.part(number) for number in self._finished()], schema=self._schema(), format="parquet")

    def _finished(self) -> Iterator[int]:
        missing = set(self.missing())
        return (number for number in range(self.parts) if number not in missing)

    def _read(self, number: int, columns: list) -> Any:
        """Columns of a finished part."""
        import pyarrow
        import pyarrow.parquet

        path = self.part(number)
        try:
            return pyarrow.parquet.read_table(path, columns=columns)
        except pyarrow.ArrowException as error:
            raise InputError(f"{path}: found no whole part: {error}; remove it, and the same study computes it again") from error

    def summary(self) -> Iterator[dict]:
        """A row a duct, one part in memory at a time: ``id``, ``samples`` with an answer, ``failed``, and of each force the mean,
        the largest and the quantiles ``_q05``, ``_q50``, ``_q95`` (between two samples linear)."""
        import pyarrow.compute as compute

        each = max(1, self.samples)
        for number in self._finished():
            part = self._read(number, ["id", *FORCES])
            for first in range(0, len(part), each):
                rows = part.slice(first, each)
                count = rows["downstream_force_n"].null_count
                row = {"id": rows["id"][0].as_py(), "samples": len(rows) - count, "failed": count}
                for force in FORCES:
                    values = rows[force]
                    row[f"{force}_mean"] = compute.mean(values).as_py()
                    row[f"{force}_max"] = compute.max(values).as_py()
                    found = compute.quantile(values, q=QUANTILES).to_pylist()
                    row.update({f"{force}_{_name(q)}": value for q, value in zip(QUANTILES, found)})
                yield row

    def worst(self, count: int = 1000, by: str = "max_compression_n_q95") -> list:
        """The rows of the summary where this is largest, the worst first."""
        measures = ["samples", "failed", *(f"{force}_{name}" for force in FORCES for name in ("mean", "max", *map(_name, QUANTILES)))]
        if by not in measures:
            raise InputError(f"found by = {by!r}; allowed: {', '.join(measures)}")
        count = whole("count", count, 0, MOST_DUCTS)
        known = (row for row in self.summary() if row[by] is not None)
        return heapq.nlargest(count, known, key=lambda row: row[by])

    def failures(self) -> Iterator[dict]:
        """The samples without an answer: ``id``, ``sample`` and the ``error``."""
        import pyarrow.compute as compute

        for number in self._finished():
            part = self._read(number, ["id", "sample", "error"])
            yield from part.filter(compute.is_valid(part["error"])).to_pylist()

    def reasons(self) -> Counter:
        """How many samples failed for which reason."""
        return Counter(row["error"] for row in self.failures())


def _name(quantile: float) -> str:
    return f"q{100 * quantile:02.0f}"


@lru_cache(maxsize=16)
def _read_manifest(path: str, changed: int) -> dict:
    return json.loads(Path(path).read_text(encoding="utf-8"))


def _manifest(out: str) -> dict:
    path = os.path.join(out, "study.json")
    try:
        found = _read_manifest(path, os.stat(path).st_mtime_ns)
    except (OSError, ValueError) as error:
        raise InputError(f"{out}: found no study: {error}; allowed: a folder that `study` made") from error
    if (found.get("format"), found.get("version")) != (FORMAT, _creepage.__version__):
        raise InputError(f"{out}: found a study of creepage {found.get('version')}; allowed: one of {_creepage.__version__}, lest two versions mix")
    return found


def _write(path: str, write: Callable[[str], Any]) -> None:
    """Writes beside the place and renames: a file is there whole or not at all, also after a loss of power."""
    beside = f"{path}.{uuid.uuid4().hex}.tmp"
    try:
        write(beside)
        with open(beside, "rb") as file:
            os.fsync(file.fileno())
        os.replace(beside, path)
    except FileNotFoundError:
        # Somebody else has written the same, and tidied up.
        if not os.path.exists(path):
            raise
    finally:
        Path(beside).unlink(missing_ok=True)


def _ducts_per_group(per_part: int) -> int:
    """No part lies in two groups of ducts."""
    return per_part * -(-DUCTS_AT_ONCE // per_part)


def _lasting(ducts: Any) -> Any:
    """The ducts as a table in memory, or as the path of a Parquet file: both can be read twice."""
    import pyarrow

    if hasattr(ducts, "__arrow_c_stream__"):
        return pyarrow.RecordBatchReader.from_stream(ducts).read_all()
    path = path_of("ducts", ducts, TABLES)
    if not os.path.isfile(path):
        raise InputError(f"{path}: found no such file of ducts; allowed: {TABLES}")
    if path.lower().endswith(".parquet"):
        return path
    if path.lower().endswith(".csv"):
        return pyarrow.table(_creepage.read_rows(path))
    raise InputError(f"{path}: found no table of ducts; allowed: {TABLES}")


def _batches(ducts: Any, size: int) -> Iterator[Any]:
    """The ducts in tables of so many rows."""
    import pyarrow
    import pyarrow.parquet

    if isinstance(ducts, pyarrow.Table):
        yield from (ducts.slice(first, size) for first in range(0, len(ducts), size))
        return
    try:
        with pyarrow.parquet.ParquetFile(ducts) as file:
            yield from _groups(file.iter_batches(size), size)
    except pyarrow.ArrowException as error:
        raise InputError(f"{ducts}: found no table of ducts that can be read: {error}; allowed: {TABLES}") from error


def _groups(batches: Iterable, size: int) -> Iterator[Any]:
    """The rows of the batches in tables of so many rows."""
    import pyarrow

    waiting: list = []
    rows = 0
    for batch in batches:
        waiting.append(batch)
        rows += len(batch)
        while rows >= size:
            table = pyarrow.Table.from_batches(waiting)
            yield table.slice(0, size)
            waiting = table.slice(size).to_batches()
            rows -= size
    if rows:
        yield pyarrow.Table.from_batches(waiting)


def _fingerprint(ducts: Any) -> str:
    """What distinguishes this table of ducts from another."""
    if isinstance(ducts, str):
        return _digest(ducts)
    found = hashlib.sha256()
    for table in _batches(ducts, DUCTS_AT_ONCE):
        found.update(repr(_creepage.texts(table)).encode())
    return found.hexdigest()


def _digest(path: str) -> str:
    """What distinguishes this content of a file from another; empty where there is none."""
    found = hashlib.sha256()
    try:
        with open(path, "rb") as file:
            for block in iter(lambda: file.read(1 << 20), b""):
                found.update(block)
    except OSError:
        return ""
    return found.hexdigest()


def _check_files(files: dict) -> None:
    """Refuses to go on where a file that the scene or the ducts name is not what it was."""
    for path, digest in files.items():
        if _digest(path) != digest:
            raise InputError(f"{path}: found that it has changed since the study was made; allowed: what it was, or another folder")


def _copy_ducts(scene: Source, ducts: Any, path: str, samples: int, per_part: int) -> dict:
    """Copies the ducts with their ids, a few thousand in memory at a time, and checks them: how many, the columns of the parts, and the
    files that they or the scene name."""
    import pyarrow
    import pyarrow.parquet

    group = _ducts_per_group(per_part)
    drawn: set = set()
    files: set = set()
    unnamed: list = []
    count = 0
    heads: Any = None

    def copy(beside: str) -> None:
        nonlocal count, heads
        writer = None
        for rows in _batches(ducts, group):
            table = _with_ids(rows, count, unnamed)
            heads, keys, named = _creepage.heads(scene, table, samples)
            drawn.update(keys)
            files.update(map(str, named))
            if writer is None:
                writer = pyarrow.parquet.ParquetWriter(beside, table.schema)
            writer.write_table(table, row_group_size=group)
            count += len(table)
        if writer is None:
            raise InputError("found no row in the table of ducts; allowed: one or more")
        writer.close()
        if unnamed:
            _check_ids(beside, unnamed)
        if samples and not drawn:
            raise InputError("found samples and no distribution; allowed: a distribution with them, in a cell of the table or in the scene")

    _write(path, copy)
    keys = [("id", "string"), *((key, "double") for key in sorted(drawn)), ("sample", "int64")]
    schema = pyarrow.table(heads).schema
    answers = list(schema)[schema.get_field_index("downstream_force_n") :]
    columns = keys + [(field.name, str(field.type)) for field in answers]
    return {"ducts": count, "columns": columns, "files": {file: _digest(file) for file in sorted(files)}}


def _with_ids(rows: Any, first: int, unnamed: list) -> Any:
    """The rows as texts, with an id each: its own, or else its number, which is added to the unnamed where others have ids."""
    import pyarrow

    names, columns = _creepage.texts(rows)
    numbers = [str(number) for number in range(first, first + len(rows))]
    if "id" in names:
        own = columns[names.index("id")]
        columns[names.index("id")] = [name or number for name, number in zip(own, numbers)]
        unnamed.extend(number for name, number in zip(own, numbers) if not name)
    else:
        names, columns = ["id", *names], [numbers, *columns]
    return pyarrow.table([pyarrow.array(column, "string") for column in columns], names=names)


def _check_ids(path: str, unnamed: list) -> None:
    """Refuses a row without an id whose number is the id of another: both would draw the same samples."""
    import pyarrow
    import pyarrow.parquet

    ids = Counter(pyarrow.parquet.read_table(path, columns=["id"])["id"].to_pylist())
    twice = next((number for number in unnamed if ids[number] > 1), None)
    if twice is not None:
        raise InputError(
            f"found the id `{twice}`, by which a row without an id is known too, as its number from 0 is {twice}; "
            "allowed: an id in every row, or ids that are no such numbers"
        )
