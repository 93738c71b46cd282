"""The table of ducts of a study: how it is read, checked and copied into the folder."""

import hashlib
import os
from collections.abc import Iterable, Iterator
from typing import Any

from . import _creepage
from ._arguments import path_of
from ._errors import InputError
from ._files import digest, whole_file, write
from ._scene import Source

#: Rows of ducts that are read at once.
DUCTS_AT_ONCE = 8192
#: What ducts may be.
TABLES = "a file that ends in .parquet or .csv, or a table with __arrow_c_stream__ (pyarrow, polars, pandas from 3 on)"


def ducts_per_group(per_part: int) -> int:
    """No part lies in two groups of ducts."""
    return per_part * -(-DUCTS_AT_ONCE // per_part)


def lasting(ducts: Any) -> Any:
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
    with whole_file(ducts, TABLES) as path, pyarrow.parquet.ParquetFile(path) as file:
        yield from _groups(file.iter_batches(size), size)


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


def fingerprint(ducts: Any) -> str:
    """What distinguishes this table of ducts from another."""
    if isinstance(ducts, str):
        return digest(ducts)
    found = hashlib.sha256()
    for table in _batches(ducts, DUCTS_AT_ONCE):
        found.update(repr(_creepage.texts(table)).encode())
    return found.hexdigest()


def copy_ducts(scene: Source, ducts: Any, path: str, samples: int, per_part: int) -> dict:
    """Copies the ducts with their ids, a few thousand in memory at a time, and checks them: how many, the columns of the parts, and the
    files that they or the scene name."""
    import pyarrow
    import pyarrow.parquet

    group = ducts_per_group(per_part)
    drawn: set = set()
    files: set = set()
    count = 0
    heads: Any = None

    def copy(beside: str) -> None:
        nonlocal count, heads
        writer = None
        for rows in _batches(ducts, group):
            table = _with_ids(rows, count)
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
        if samples and not drawn:
            raise InputError("found samples and no distribution; allowed: a distribution with them, in a cell of the table or in the scene")

    write(path, copy)
    keys = [("id", "string"), *((key, "double") for key in sorted(drawn)), ("sample", "int64")]
    schema = pyarrow.table(heads).schema
    answers = list(schema)[schema.get_field_index("downstream_force_n") :]
    columns = keys + [(field.name, str(field.type)) for field in answers]
    return {"ducts": count, "columns": columns, "files": {file: digest(file) for file in sorted(files)}}


def _with_ids(rows: Any, first: int) -> Any:
    """The rows as texts, with an id each: its own, or else its number."""
    import pyarrow

    names, columns = _creepage.texts(rows)
    numbers = [str(number) for number in range(first, first + len(rows))]
    if "id" in names:
        own = columns[names.index("id")]
        columns[names.index("id")] = [name or number for name, number in zip(own, numbers)]
    else:
        names, columns = ["id", *names], [numbers, *columns]
    return pyarrow.table([pyarrow.array(column, "string") for column in columns], names=names)
