"""A network of ducts with a Monte Carlo each, as a folder of Parquet parts that any engine may compute.

A part is a function of its number alone, and stands in the folder whole or not at all: it is written beside its place and renamed. So a
rerun computes what is missing and nothing else, whatever was killed, and the bytes are the same on any engine and any number of workers.

    study.json          the manifest: scene, samples, seed, how many ducts a part; whoever has it can compute any part
    ducts.parquet       the ducts, with their ids
    parts/part-*.parquet    a row a sample: id, what was drawn, sample, answer, status, error
"""

import heapq
import json
import os
from collections import Counter
from collections.abc import Iterator
from functools import lru_cache
from pathlib import Path
from typing import Any, Optional, Union

from . import _creepage
from ._arguments import LARGEST_SEED, MOST_SAMPLES, path_of, threads_of, whole
from ._ducts import copy_ducts, ducts_per_group, fingerprint, lasting
from ._engines import on_dask, on_this_machine
from ._errors import InputError
from ._files import check_files, whole_file, write
from ._progress import callback
from ._scene import Scene, Source, source

#: What the folder looks like.
FORMAT = 2
#: Rows that a part has at least, if there are as many: about six minutes of one core.
ROWS_OF_A_PART = 2000
#: More is a slip.
MOST_DUCTS = 10**12
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
    Only Parquet files are read a few thousand rows at a time, all others as a whole.
    A cell, or a value of the scene, may be a distribution: ``normal(0.25, 0.03)``. client: a client of Dask whose workers see the
    folder; without one, this machine computes in so many threads. progress: called with the share of the parts that are done, or a bar
    of tqdm.

    Samples are computed to 2 %, unless the scene or a column names ``solver.tolerance``. Each says its error in ``error_estimate``.
    """
    threads, show = threads_of(threads), callback(progress)
    if client is not None and not hasattr(client, "nthreads"):
        raise InputError(f"found client = {client!r}; allowed: a client of Dask, or None for this machine")
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
        ducts = lasting(ducts)
        wanted = {
            "format": FORMAT,
            "version": _creepage.__version__,
            "scene": own._asdict(),
            "samples": samples,
            "seed": seed,
            "ducts_per_part": per_part,
            "source": fingerprint(ducts),
        }
        # In this order: the parts of a study come after its manifest.
        strange = any(Path(out, "parts").glob("part-*.parquet"))
        if os.path.exists(os.path.join(out, "study.json")):
            found = _manifest(out)
            other = [key for key, value in wanted.items() if found.get(key) != value]
            if other:
                raise InputError(f"{out}: found another study, with another {' and '.join(other)}; allowed: the same study, or an empty folder")
            check_files(found["files"])
            return cls(out)
        if strange:
            raise InputError(f"{out}: found parts of a study without its manifest, study.json; allowed: a folder without them")
        try:
            os.makedirs(os.path.join(out, "parts"), exist_ok=True)
        except OSError as error:
            raise InputError(f"{out}: cannot be the folder of a study: {error}; allowed: a folder that can be written") from error
        checked = copy_ducts(own, ducts, os.path.join(out, "ducts.parquet"), samples, per_part)
        # The manifest comes last: where it is, all else is.
        text = json.dumps({**wanted, **checked}, indent=1)
        write(os.path.join(out, "study.json"), lambda path: Path(path).write_text(text, encoding="utf-8"))
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
        check_files(self._files)
        schema = self._schema()
        drawn = schema.names[1 : schema.names.index("sample")]
        rows = pyarrow.table(_creepage.sweep(self._scene, self._ducts(number), self.samples, self.seed, drawn, call))
        rows = rows.append_column("sample", pyarrow.nulls(len(rows), "int64")) if "sample" not in rows.column_names else rows
        rows = rows.select(schema.names).cast(schema)
        write(path, lambda path: pyarrow.parquet.write_table(rows, path, compression="snappy"))
        return True

    def _schema(self) -> Any:
        import pyarrow

        return pyarrow.schema([(name, pyarrow.type_for_alias(kind)) for name, kind in self._columns])

    def _ducts(self, number: int) -> Any:
        """The ducts of a part."""
        import pyarrow.parquet

        group = ducts_per_group(self.ducts_per_part)
        first = number * self.ducts_per_part
        with whole_file(os.path.join(self.out, "ducts.parquet"), "the ducts of this study") as path, pyarrow.parquet.ParquetFile(path) as file:
            return file.read_row_group(first // group).slice(first % group, self.ducts_per_part)

    def tidy(self) -> None:
        """Removes what killed processes have left half written, once no part is missing."""
        if not self.missing():
            for left in Path(self.out, "parts").glob("part-*.tmp"):
                left.unlink(missing_ok=True)

    def dataset(self) -> Any:
        """All finished parts as a pyarrow dataset, which reads only what is asked of it."""
        import pyarrow.dataset

        return pyarrow.dataset.dataset([self.part(number) for number in self._finished()], schema=self._schema(), format="parquet")

    def _finished(self) -> Iterator[int]:
        missing = set(self.missing())
        return (number for number in range(self.parts) if number not in missing)

    def _read(self, number: int, columns: list) -> Any:
        """Columns of a finished part."""
        import pyarrow.parquet

        with whole_file(self.part(number), "a whole part: remove it, and the same study computes it again") as path:
            return pyarrow.parquet.read_table(path, columns=columns)

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
    return dict(json.loads(Path(path).read_text(encoding="utf-8")))


def _manifest(out: str) -> dict:
    path = os.path.join(out, "study.json")
    try:
        found = _read_manifest(path, os.stat(path).st_mtime_ns)
    except (OSError, ValueError) as error:
        raise InputError(f"{out}: found no study: {error}; allowed: a folder that `study` made") from error
    if (found.get("format"), found.get("version")) != (FORMAT, _creepage.__version__):
        raise InputError(f"{out}: found a study of creepage {found.get('version')}; allowed: one of {_creepage.__version__}, lest two versions mix")
    return found
