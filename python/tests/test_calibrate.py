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
