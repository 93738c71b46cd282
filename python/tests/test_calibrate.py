"""Fits equal those of the command line."""

import json

import creepage
import pyarrow
import pyarrow.csv
import pytest
from conftest import ROOT, UPPER

DATA = ROOT / "examples/data/synthetic-upper.csv"


def test_a_fit_is_that_of_the_command_line(command, tmp_path):
    lines = [line for line in DATA.read_text(encoding="utf-8").splitlines() if not line.startswith("#")]
    data = tmp_path / "rows.csv"
    data.write_text("\n".join(lines[:9]) + "\n", encoding="utf-8")
    expected = json.loads(
        command("calibrate", UPPER, "--data", data, "--fit", "dynamic_coefficient", "--set", "solver.tolerance=0.05", "--json")
    )
    rows = pyarrow.csv.read_csv(data)
    for given in (rows, data):
        fit = creepage.calibrate(UPPER, given, {"solver.tolerance": 0.05}, fit=["dynamic_coefficient"])
        assert fit == expected
    assert fit["parameters"][0]["name"] == "dynamic_coefficient"


def test_readings_that_are_none_are_told():
    with pytest.raises(creepage.InputError, match="pass"):
        creepage.calibrate(UPPER, pyarrow.table({"apples": [1.0, 2.0]}))
    with pytest.raises(creepage.InputError):
        creepage.calibrate(UPPER, pyarrow.table({"pass": [1, 2], "force_n": [1.0, 2.0]}), fit=["apples"])


def test_a_table_is_read_as_it_is_said(tmp_path):
    rows = [(1, "0,1022"), (2, "0,1407"), (5, "0,2106"), (10, "0,2838"), (20, "0,3808"), (40, "0,4820")]
    data = tmp_path / "cell.txt"
    data.write_text("Station 7\nNr.;A;B\n" + "".join(f"{number};{force};9\n" for number, force in rows), encoding="utf-8")
    read = {"header_line": 2, "decimal": "comma", "column_pass": "Nr.", "column_force": ["downstream=A"], "unit": "kN"}
    fit = creepage.calibrate(UPPER, data, {"solver.tolerance": 0.05}, fit="dynamic_coefficient", read=read)
    assert [reading["force_n"] for reading in fit["fit"]] == pytest.approx([102.2, 140.7, 210.6, 283.8, 380.8, 482.0])
    for wrong in ({"decimals": "comma"}, {"decimal": "point"}, {"skip": "many"}, {"tension_positive": "yes"}, "comma"):
        with pytest.raises(creepage.InputError, match="allowed: "):
            creepage.calibrate(UPPER, data, read=wrong if isinstance(wrong, str) else {**read, **wrong})
