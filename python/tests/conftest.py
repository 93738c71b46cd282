"""What the tests share: the scenes, the command line as the other judge, and a small network."""

import hashlib
import os
import random
import subprocess
from pathlib import Path

import pyarrow
import pytest

ROOT = Path(__file__).resolve().parents[2]
SCENES = sorted((ROOT / "examples/scenes").glob("*.toml"))
UPPER = ROOT / "examples/scenes/full-scale-upper.toml"
#: What makes a run of a few milliseconds of it.
QUICK = {"traffic.passes": 1, "solver.tolerance": 0.1}


@pytest.fixture(scope="session")
def command():
    """The program `creepage`, built if it is not there; calls it and returns what it prints."""
    program = Path(os.environ.get("CREEPAGE", ROOT / "target/release/creepage"))
    if not program.exists():
        subprocess.run(["cargo", "build", "--release", "--locked", "--bin", "creepage"], cwd=ROOT, check=True)

    def call(*arguments):
        return subprocess.run([program, *map(str, arguments)], check=True, capture_output=True, text=True).stdout

    return call


@pytest.fixture
def quick_scene():
    """The text of a scene whose runs take a few milliseconds."""
    text = UPPER.read_text(encoding="utf-8")
    return text.replace("passes = 200", "passes = 1") + "\n[solver]\ntolerance = 0.1\n"


def ducts(count, law=None):
    """A table of ducts."""
    draw = random.Random(5)
    columns = {
        "id": [f"D{number:05}" for number in range(count)],
        "duct.depth": [f"{draw.uniform(0.9, 2.0):.3f} m" for _ in range(count)],
        "friction.dynamic_coefficient": [law or draw.uniform(0.2, 0.4) for _ in range(count)],
    }
    return pyarrow.table(columns)


def digest(out):
    """What distinguishes the parts of a study from others, byte for byte."""
    found = hashlib.sha256()
    for part in sorted((Path(out) / "parts").iterdir()):
        found.update(part.name.encode())
        found.update(part.read_bytes())
    return found.hexdigest()
