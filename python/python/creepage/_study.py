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
from ._engines import on_dask, on_this_machine
from ._errors import InputError
from ._progress import callback
from ._scene import Scene, Source, source

#: What the folder looks like.
FORMAT = 1
#: Rows that a part has at least, if there are as many: about half a minute of one core.
ROWS_OF_A_PART = 2000
#: Rows of ducts that are read at once.
DUCTS_AT_ONCE = 8192
#: What the rows of a summary say of the samples of a duct.
FORCES = ("downstream_force_n", "upstream_force_n", "max_compression_n")
QUANTILES = (0.05, 0.5, 0.95)

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
    A cell, or a value of the scene, may be a distribution: ``normal(0.25, 0.03)``. client: a client of Dask whose workers see the
    folder; without one, this machine computes in so many threads. progress: called with the share of the parts that are done, or a bar
    of tqdm.

    Samples are as exact as their scatter asks for: to ``solver.tolerance``, or to a quarter of the standard deviation of the duct's
    largest force where that is more, up to 5 %. Each says its error in ``error_estimate``.
    """
    made = Study.create(scene, ducts, out, samples=samples, seed=seed, ducts_per_part=ducts_per_part)
    missing = made.missing()
    done = made.parts - len(missing)
    show = callback(progress)

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
        self.out = os.path.abspath(out)
        manifest = _manifest(self.out)
        self.ducts: int = manifest["ducts"]
        self.samples: int = manifest["samples"]
        self.seed: int = manifest["seed"]
        self.ducts_per_part: int = manifest["ducts_per_part"]
        self._scene = Source(**manifest["scene"])
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
        out = os.path.abspath(out)
        own = source(scene)
        if os.path.exists(own.name):
            # Beside it a table of axle loads may lie.
            own = own._replace(name=os.path.abspath(own.name))
        per_part = ducts_per_part or max(1, ROWS_OF_A_PART // max(1, samples))
        wanted = {
            "format": FORMAT,
            "version": _creepage.__version__,
            "scene": own._asdict(),
            "samples": samples,
            "seed": seed,
            "ducts_per_part": per_part,
            "source": _fingerprint(ducts),
        }
        if os.path.exists(os.path.join(out, "study.json")):
            found = _manifest(out)
            other = [key for key, value in wanted.items() if found.get(key) != value]
            if other:
                raise InputError(f"{out}: found another study, with another {' and '.join(other)}; allowed: the same study, or an empty folder")
            return cls(out)
        os.makedirs(os.path.join(out, "parts"), exist_ok=True)
        count, columns = _copy_ducts(own, ducts, os.path.join(out, "ducts.parquet"), samples, per_part)
        # The manifest comes last: where it is, all else is.
        text = json.dumps({**wanted, "ducts": count, "columns": columns}, indent=1)
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

        path = self.part(number)
        if os.path.exists(path):
            return False
        ducts = self._ducts(number)
        rows = pyarrow.table(_creepage.sweep(self._scene, ducts, self.samples, self.seed, (threads, progress)))
        schema = pyarrow.schema([(name, pyarrow.type_for_alias(kind)) for name, kind in self._columns])
        rows = rows.append_column("sample", pyarrow.nulls(len(rows), "int64")) if "sample" not in rows.column_names else rows
        rows = rows.select(schema.names).cast(schema)
        _write(path, lambda path: pyarrow.parquet.write_table(rows, path, compression="snappy"))
        return True

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

        there = sorted(entry.path for entry in os.scandir(os.path.join(self.out, "parts")) if entry.name.endswith(".parquet"))
        return pyarrow.dataset.dataset(there, format="parquet")

    def summary(self) -> Iterator[dict]:
        """A row a duct, one part in memory at a time: ``id``, ``samples`` with an answer, ``failed``, and of each force the mean,
        the largest and the quantiles ``_q05``, ``_q50``, ``_q95`` (between two samples linear)."""
        import pyarrow.compute as compute
        import pyarrow.parquet

        each = max(1, self.samples)
        missing = set(self.missing())
        for number in range(self.parts):
            if number in missing:
                continue
            part = pyarrow.parquet.read_table(self.part(number), columns=["id", "status", *FORCES])
            for first in range(0, len(part), each):
                rows = part.slice(first, each)
                count = rows["downstream_force_n"].null_count
                row = {"id": rows["id"][0].as_py(), "samples": len(rows) - count, "failed": count}
                for force in FORCES:
                    values = rows[force]
                    row[f"{force}_mean"] = compute.mean(values).as_py()
                    row[f"{force}_max"] = compute.max(values).as_py()
                    found = compute.quantile(values, q=QUANTILES).to_pylist()
                    row.update({f"{force}_q{100 * q:02.0f}": value for q, value in zip(QUANTILES, found)})
                yield row

    def worst(self, count: int = 1000, by: str = "max_compression_n_q95") -> list:
        """The rows of the summary where this is largest, the worst first."""
        known = (row for row in self.summary() if row[by] is not None)
        return heapq.nlargest(count, known, key=lambda row: row[by])

    def failures(self) -> Iterator[dict]:
        """The samples without an answer: ``id``, ``sample`` and the ``error``."""
        import pyarrow.dataset

        failed = pyarrow.dataset.field("status") == "error"
        for batch in self.dataset().to_batches(columns=["id", "sample", "error"], filter=failed, batch_readahead=1, fragment_readahead=1):
            yield from batch.to_pylist()

    def reasons(self) -> Counter:
        """How many samples failed for which reason."""
        return Counter(row["error"] for row in self.failures())


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
    write(beside)
    try:
        with open(beside, "rb") as file:
            os.fsync(file.fileno())
        os.replace(beside, path)
    except FileNotFoundError:
        # Somebody else has written the same, and tidied up.
        if not os.path.exists(path):
            raise


def _ducts_per_group(per_part: int) -> int:
    """No part lies in two groups of ducts."""
    return per_part * -(-DUCTS_AT_ONCE // per_part)


def _batches(ducts: Any) -> Any:
    """The ducts as a stream of Arrow batches."""
    import pyarrow
    import pyarrow.csv
    import pyarrow.parquet

    if hasattr(ducts, "__arrow_c_stream__"):
        return pyarrow.RecordBatchReader.from_stream(ducts)
    path = os.fspath(ducts)
    if path.endswith(".parquet"):
        file = pyarrow.parquet.ParquetFile(path)
        return pyarrow.RecordBatchReader.from_batches(file.schema_arrow, file.iter_batches(DUCTS_AT_ONCE))
    if path.endswith(".csv"):
        with pyarrow.csv.open_csv(path) as head:
            names = head.schema.names
        # Texts, so that `0.90` and `90 cm` may stand in one column.
        texts = pyarrow.csv.ConvertOptions(column_types={name: pyarrow.string() for name in names}, strings_can_be_null=True)
        return pyarrow.csv.open_csv(path, convert_options=texts)
    raise InputError(f"{path}: found no table of ducts; allowed: a file that ends in .parquet or .csv, or a table with __arrow_c_stream__")


def _fingerprint(ducts: Any) -> str:
    """What distinguishes this table of ducts from another."""
    found = hashlib.sha256()
    if hasattr(ducts, "__arrow_c_stream__"):
        for batch in _batches(ducts):
            found.update(repr(batch.schema.names).encode())
            found.update(repr(_creepage.texts(_as_table(batch))[1]).encode())
        return found.hexdigest()
    _batches(ducts).close()
    with open(ducts, "rb") as file:
        for block in iter(lambda: file.read(1 << 20), b""):
            found.update(block)
    return found.hexdigest()


def _as_table(batch: Any) -> Any:
    import pyarrow

    return pyarrow.Table.from_batches([batch])


def _copy_ducts(scene: Source, ducts: Any, path: str, samples: int, per_part: int) -> tuple:
    """Copies the ducts with their ids, a few thousand in memory at a time, and checks them: how many, and the columns of the parts."""
    import pyarrow
    import pyarrow.parquet

    group = _ducts_per_group(per_part)
    drawn = set(_creepage.drawn(scene))
    count = 0
    heads: Any = None

    def copy(beside: str) -> None:
        nonlocal count, heads
        writer = None
        for table in _groups(_batches(ducts), group):
            table = _with_ids(table, count)
            heads = pyarrow.table(_creepage.heads(scene, table, samples)).schema
            numbers = (name for name in table.column_names if str(heads.field(name).type) == "double")
            drawn.update(name for name in numbers if _draws(table[name]))
            if writer is None:
                writer = pyarrow.parquet.ParquetWriter(beside, table.schema)
            writer.write_table(table.cast(writer.schema), row_group_size=group)
            count += len(table)
        if writer is None:
            raise InputError("found no row in the table of ducts; allowed: one or more")
        writer.close()

    _write(path, copy)
    if samples and not drawn:
        raise InputError("found samples and no distribution; allowed: a distribution with them, in a cell of the table or in the scene")
    keys = [("id", "string"), *((key, "double") for key in sorted(drawn)), ("sample", "int64")]
    first = heads.names.index("downstream_force_n")
    columns = keys + [(name, str(heads.field(name).type)) for name in heads.names[first:]]
    return count, [list(column) for column in columns]


def _draws(column: Any) -> bool:
    """Whether a cell of a column of numbers is a distribution: no other number has brackets."""
    import pyarrow.compute as compute

    is_text = any(kind in str(column.type) for kind in ("string", "utf8"))
    return bool(is_text and compute.any(compute.match_substring(column.cast("string"), "(")).as_py())


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


def _with_ids(table: Any, first: int) -> Any:
    """The rows with an id as text each: its own, or else its number."""
    import pyarrow
    import pyarrow.compute as compute

    numbers = pyarrow.array([str(number) for number in range(first, first + len(table))])
    if "id" not in table.column_names:
        return table.add_column(0, "id", numbers)
    own = compute.utf8_trim_whitespace(table["id"].cast("string"))
    own = compute.if_else(compute.equal(own, ""), None, own)
    return table.set_column(table.column_names.index("id"), "id", compute.coalesce(own, numbers))
