"""Workers, schedulers and drivers that are killed with -9: a rerun has the same bytes, and what was finished is not computed again."""

import os
import random
import subprocess
import sys
import time
from pathlib import Path
from signal import SIGINT, SIGKILL

import creepage
import pyarrow.parquet
import pytest
from conftest import UPPER, digest, ducts

pytest.importorskip("distributed")
from cluster import Cluster

DUCTS, PER_PART = 120, 5
TIMES = [pytest.param(0), *(pytest.param(seed, marks=pytest.mark.slow) for seed in range(1, 20))]


@pytest.fixture(scope="module")
def network(tmp_path_factory):
    """A scene, its ducts, and the study that nobody disturbed."""
    folder = tmp_path_factory.mktemp("network")
    scene, rows = folder / "scene.toml", folder / "ducts.parquet"
    # A row takes some ten milliseconds, a part a twentieth of a second.
    text = UPPER.read_text(encoding="utf-8").replace("passes = 200", "passes = 2") + "\n[solver]\ntolerance = 0.05\n"
    scene.write_text(text, encoding="utf-8")
    pyarrow.parquet.write_table(ducts(DUCTS), rows)
    calm = creepage.study(text, rows, folder / "calm", ducts_per_part=PER_PART)
    return scene, rows, digest(calm.out)


def finished(out: Path) -> dict:
    """The parts that are there. One that is computed again is renamed into its place, and is another file."""
    parts = out / "parts"
    there = os.scandir(parts) if parts.exists() else []
    return {entry.name: entry.inode() for entry in there if entry.name.endswith(".parquet")}


def wait_for_parts(process, out: Path, count: int) -> None:
    deadline = time.monotonic() + 60
    while len(finished(out)) < count:
        assert process.poll() is None and time.monotonic() < deadline, "the study does not get on"
        time.sleep(0.002)


def kill_at_random(victim, out: Path, seed: int) -> None:
    """Kills it once the first part is there, at any moment of the study."""
    draw = random.Random(seed)
    wait_for_parts(victim, out, draw.randrange(1, DUCTS // PER_PART - 4))
    time.sleep(draw.uniform(0, 0.1))
    victim.kill()
    victim.wait()


def check(out: Path, before: dict, expected: str) -> None:
    after = finished(out)
    assert len(after) == DUCTS // PER_PART
    assert {name: after[name] for name in before} == before, "what was finished was computed again"
    assert not list(out.glob("parts/*.tmp"))
    assert digest(out) == expected


@pytest.mark.parametrize("seed", TIMES)
def test_a_killed_worker_is_made_up_for(network, tmp_path, seed):
    scene, rows, expected = network
    out = tmp_path / "out"
    with Cluster(tmp_path, workers=2) as cluster:
        driver = cluster.drive(scene, rows, out, PER_PART)
        kill_at_random(cluster.workers[0], out, seed)
        before = finished(out)
        assert driver.wait(timeout=120) == 0
    check(out, before, expected)


@pytest.mark.parametrize("seed", TIMES)
def test_a_killed_scheduler_loses_nothing_finished(network, tmp_path, seed):
    scene, rows, expected = network
    out = tmp_path / "out"
    with Cluster(tmp_path, workers=2) as cluster:
        driver = cluster.drive(scene, rows, out, PER_PART)
        kill_at_random(cluster.scheduler, out, seed)
        # The driver ends by itself, with an error unless all was done.
        driver.wait(timeout=60)
    before = finished(out)
    with Cluster(tmp_path, workers=1) as cluster:
        assert cluster.drive(scene, rows, out, PER_PART).wait(timeout=120) == 0
    check(out, before, expected)


@pytest.mark.parametrize("seed", TIMES)
def test_a_killed_driver_loses_nothing_finished(network, tmp_path, seed):
    scene, rows, expected = network
    out = tmp_path / "out"
    with Cluster(tmp_path, workers=2) as cluster:
        driver = cluster.drive(scene, rows, out, PER_PART)
        kill_at_random(driver, out, seed)
        before = finished(out)
        assert cluster.drive(scene, rows, out, PER_PART).wait(timeout=120) == 0
    check(out, before, expected)


@pytest.mark.parametrize("workers", [1, 2, 4])
def test_any_number_of_workers_gives_the_same_bytes(network, tmp_path, workers):
    scene, rows, expected = network
    with Cluster(tmp_path, workers) as cluster:
        assert cluster.drive(scene, rows, tmp_path / "out", PER_PART).wait(timeout=120) == 0
    check(tmp_path / "out", {}, expected)


def alone(scene, rows, out) -> list:
    """A process that makes the study in two threads."""
    code = """
import sys, creepage
scene, ducts, out, per_part = sys.argv[1:]
creepage.study(open(scene).read(), ducts, out, ducts_per_part=int(per_part), threads=2)
"""
    return [sys.executable, "-c", code, str(scene), str(rows), str(out), str(PER_PART)]


@pytest.mark.parametrize("signal", [SIGKILL, SIGINT])
def test_a_stopped_process_without_a_cluster_loses_nothing_finished(network, tmp_path, signal):
    scene, rows, expected = network
    out = tmp_path / "out"
    arguments = alone(scene, rows, out)
    process = subprocess.Popen(arguments, stderr=subprocess.DEVNULL)
    wait_for_parts(process, out, 4)
    process.send_signal(signal)
    assert process.wait(timeout=10) != 0
    before = finished(out)
    assert len(before) < DUCTS // PER_PART
    subprocess.run(arguments, check=True, timeout=120)
    check(out, before, expected)
