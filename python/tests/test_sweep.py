"""Rows in and out by Arrow, equal to the command line's CSV to the last bit."""

import time

import creepage
import pyarrow
import pyarrow.compute
import pyarrow.csv
import pytest
from conftest import QUICK, UPPER, ducts


def by_command(command, tmp_path, rows, schema, *arguments):
    """The table of this schema that the command line writes of these rows."""
    pyarrow.csv.write_csv(rows, tmp_path / "rows.csv")
    settings = [word for key, value in QUICK.items() for word in ("--set", f"{key}={value}")]
    out = tmp_path / "out.csv"
    command("sweep", UPPER, *settings, "--rows", tmp_path / "rows.csv", "--out", out, *arguments)
    as_in_schema = pyarrow.csv.ConvertOptions(column_types=schema, strings_can_be_null=True)
    table = pyarrow.csv.read_csv(out, convert_options=as_in_schema)
    # In CSV an apostrophe stands before a text that a spreadsheet would take for a formula.
    place = table.column_names.index("error")
    return table.set_column(place, "error", pyarrow.compute.replace_substring_regex(table["error"], "^'", ""))


def assert_same_bits(table, expected):
    assert table.column_names == expected.column_names
    for name in table.column_names:
        one, other = (column.combine_chunks() for column in (table[name], expected[name]))
        if pyarrow.types.is_floating(one.type):
            one, other = one.view("int64"), other.view("int64")
        assert one.equals(other), name


def test_a_table_is_that_of_the_command_line(command, tmp_path):
    rows = ducts(60)
    wrong = rows.slice(0, 1).set_column(1, "duct.depth", pyarrow.array(["-1 m"]))
    rows = pyarrow.concat_tables([rows, wrong])
    table = creepage.sweep(UPPER, rows, QUICK)
    assert_same_bits(table, by_command(command, tmp_path, rows, table.schema))
    assert table["status"].to_pylist() == ["ok"] * 60 + ["error"]
    assert "duct.depth" in table["error"][60].as_py()


def test_samples_are_those_of_the_command_line(command, tmp_path):
    rows = ducts(3, "normal(0.25, 0.03)")
    table = creepage.sweep(UPPER, rows, QUICK, samples=35, seed=9, threads=2)
    assert_same_bits(table, by_command(command, tmp_path, rows, table.schema, "--samples", 35, "--seed", 9))
    assert table.num_rows == 105
    # Any part can be computed anywhere.
    alone = creepage.sweep(UPPER, rows.slice(1, 1), QUICK, samples=35, seed=9, threads=1)
    assert_same_bits(alone, table.slice(35, 35))


@pytest.mark.slow
def test_ten_thousand_rows_are_those_of_the_command_line_and_as_quick(command, tmp_path):
    rows = ducts(10_000)
    begun = time.perf_counter()
    table = creepage.sweep(UPPER, rows, QUICK, threads=2)
    own = time.perf_counter() - begun
    begun = time.perf_counter()
    expected = by_command(command, tmp_path, rows, table.schema, "--threads", 2)
    print(f"{own:.1f} s, by the command line {time.perf_counter() - begun:.1f} s")
    assert_same_bits(table, expected)


def test_what_comes_back_is_of_the_same_library():
    rows = ducts(2)
    expected = creepage.sweep(UPPER, rows, QUICK)
    assert isinstance(expected, pyarrow.Table)
    polars = pytest.importorskip("polars")
    frame = creepage.sweep(UPPER, polars.DataFrame(rows), QUICK)
    assert isinstance(frame, polars.DataFrame)
    assert frame["downstream_force_n"].to_list() == expected["downstream_force_n"].to_pylist()


def test_pandas_comes_in_and_out():
    pandas = pytest.importorskip("pandas", minversion="3")
    rows = ducts(2)
    frame = pandas.DataFrame.from_arrow(rows)
    frame["ends.downstream"] = pandas.Categorical(["free", "fixed"])
    frame = creepage.sweep(UPPER, frame, QUICK)
    assert isinstance(frame, pandas.DataFrame) and list(frame["status"]) == ["ok", "ok"]
    assert frame["downstream_force_n"][0] == 0.0 < frame["downstream_force_n"][1]


class Bare:
    """Rows of a library that is not known."""

    def __init__(self, rows):
        self.__arrow_c_stream__ = rows.__arrow_c_stream__


def test_any_other_rows_give_a_table_that_all_take_over():
    table = creepage.sweep(UPPER, Bare(ducts(2)), QUICK)
    assert isinstance(table, creepage.Table) and len(table) == 2
    assert table.column_names == pyarrow.table(table).column_names
    assert pyarrow.table(table) == creepage.sweep(UPPER, ducts(2), QUICK)


def test_missing_cells_leave_the_scenes_own():
    depths = pyarrow.table({"duct.depth": [1.2, None, float("nan")], "traffic.passes": pyarrow.nulls(3)})
    forces = creepage.sweep(UPPER, depths, QUICK)["downstream_force_n"].to_pylist()
    assert len(set(forces)) == 1
