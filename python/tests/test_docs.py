"""The blocks of docs/python.md: those of Python run in turn in one folder, those of other engines give the same bytes."""

import os
import re
import subprocess
import sys

import pytest
from conftest import ROOT, digest, ducts

PAGE = (ROOT / "docs/python.md").read_text(encoding="utf-8")
#: Lines that a recipe for another engine may have.
LONGEST_RECIPE = 30


def blocks(language):
    return re.findall(rf"^```{language}\n(.*?)^```$", PAGE, re.DOTALL | re.MULTILINE)


def page(count, samples, folder):
    """Runs the page in a process of its own, with so many ducts and samples, and returns what it prints."""
    code = "\n".join(blocks("python"))
    assert "DUCTS = 2000" in code and "samples=40" in code
    code = code.replace("DUCTS = 2000", f"DUCTS = {count}").replace("samples=40", f"samples={samples}")
    run = subprocess.run([sys.executable, "-c", code], cwd=folder, capture_output=True, text=True)
    assert run.returncode == 0, run.stderr
    return run.stdout


def check_page(printed, folder):
    lines = printed.splitlines()
    assert re.match(r"\d+ N after 200 passes", lines[0])
    assert lines[2].startswith("duct.depth None --set duct.depth=1.2 kN")
    assert len(lines) == 2 + 1 + 1 + 1 + 10 + 3
    image = (folder / "network.png").read_bytes()
    assert image.startswith(b"\x89PNG") and len(image) > 10_000


def test_the_page_runs(tmp_path):
    pytest.importorskip("matplotlib")
    check_page(page(16, 8, tmp_path), tmp_path)


@pytest.mark.slow
def test_the_page_runs_with_all_ducts(tmp_path):
    pytest.importorskip("matplotlib")
    check_page(page(2000, 40, tmp_path), tmp_path)


def recipe(engine, scene, folder):
    """Runs the recipe of an engine in a process of its own: the study that it makes."""
    (code,) = blocks(f"python {engine}")
    import pyarrow.parquet

    pyarrow.parquet.write_table(ducts(30), folder / "ducts.parquet")
    (folder / "scene.toml").write_text(scene, encoding="utf-8")
    code = f"SCENE, ducts = 'scene.toml', 'ducts.parquet'\n{code}"
    # Spark's workers take whatever `python3` is unless they are told.
    environment = {**os.environ, "PYSPARK_PYTHON": sys.executable}
    subprocess.run([sys.executable, "-c", code], cwd=folder, env=environment, check=True, timeout=600)
    return folder / "results"


@pytest.mark.slow
@pytest.mark.parametrize("engine, module", [("ray", "ray"), ("spark", "pyspark")])
def test_another_engine_gives_the_same_bytes(engine, module, quick_scene, tmp_path):
    import creepage

    pytest.importorskip(module)
    out = recipe(engine, quick_scene, tmp_path)
    expected = creepage.study(quick_scene, ducts(30), tmp_path / "expected")
    assert creepage.Study(out).missing() == []
    assert digest(out) == digest(expected.out)


def test_recipes_are_short():
    for engine in ("dask", "ray", "spark"):
        (code,) = blocks(f"python {engine}")
        assert len(code.splitlines()) <= LONGEST_RECIPE
