"""Studies: the same bytes whoever computes them, nothing computed twice, and what is read from them."""

import os
import shutil
import statistics
import subprocess
import sys

import creepage
import pyarrow
import pyarrow.csv
import pyarrow.parquet
import pytest
from conftest import UPPER, digest, ducts


@pytest.fixture(scope="module")
def finished(tmp_path_factory):
    """A finished study of 24 ducts, a third of whose samples fail in one duct."""
    out = tmp_path_factory.mktemp("study") / "out"
    rows = ducts(24, "normal(0.25, 0.03)")
    wrong = rows["friction.dynamic_coefficient"].to_pylist()
    wrong[5] = "uniform(-0.1, 0.2)"
    rows = rows.set_column(2, "friction.dynamic_coefficient", pyarrow.array(wrong))
    text = UPPER.read_text(encoding="utf-8").replace("passes = 200", "passes = 1") + "\n[solver]\ntolerance = 0.1\n"
    return text, rows, creepage.study(text, rows, out, samples=9, ducts_per_part=4, threads=1)


def inodes(out):
    """Files of parts; a part that is written again is another file."""
    return {entry.name: entry.inode() for entry in os.scandir(os.path.join(out, "parts"))}


def test_the_parts_are_the_sweep(finished):
    text, rows, study = finished
    assert study.parts == 6 and study.missing() == []
    table = study.dataset().to_table()
    expected = creepage.sweep(text, rows, samples=9)
    assert table.equals(expected.select(table.column_names))
    assert table.column_names[:3] == ["id", "friction.dynamic_coefficient", "sample"]


def test_a_summary_says_what_the_samples_say(finished):
    _, _, study = finished
    summary = {row["id"]: row for row in study.summary()}
    table = study.dataset().to_table()
    assert len(summary) == 24
    for name, row in summary.items():
        forces = [
            sample["max_compression_n"]
            for sample in table.to_pylist()
            if sample["id"] == name and sample["status"] == "ok"
        ]
        assert (row["samples"], row["failed"]) == (len(forces), 9 - len(forces))
        assert row["max_compression_n_q50"] == pytest.approx(statistics.median(forces))
        assert row["max_compression_n_mean"] == pytest.approx(statistics.fmean(forces))
        assert row["max_compression_n_max"] == max(forces)
    worst = study.worst(3)
    assert [row["id"] for row in worst] == sorted(summary, key=lambda name: -summary[name]["max_compression_n_q95"])[:3]


def test_failures_have_their_reasons(finished):
    _, _, study = finished
    failures = list(study.failures())
    assert failures and {row["id"] for row in failures} == {"D00005"}
    assert all("friction.dynamic_coefficient" in row["error"] for row in failures)
    assert sum(study.reasons().values()) == len(failures)


def test_any_number_of_threads_gives_the_same_bytes(finished, tmp_path):
    text, rows, study = finished
    other = creepage.study(text, rows, tmp_path / "out", samples=9, ducts_per_part=4, threads=3)
    assert digest(other.out) == digest(study.out)


def test_a_rerun_computes_what_is_missing_and_nothing_else(finished, tmp_path):
    text, rows, study = finished
    out = tmp_path / "out"
    shutil.copytree(study.out, out)
    for number in (1, 4):
        os.remove(out / "parts" / f"part-{number:07}.parquet")
    (out / "parts" / "part-0000001.parquet.killed.tmp").write_bytes(b"half a part")
    before, shares = inodes(out), []
    again = creepage.study(text, rows, out, samples=9, ducts_per_part=4, progress=shares.append)
    assert shares == [4 / 6, 5 / 6, 1.0]
    after = inodes(out)
    assert {name: after[name] for name in before if name in after} == {
        name: inode for name, inode in before.items() if not name.endswith(".tmp")
    }
    assert digest(again.out) == digest(study.out)
    assert not creepage.compute_part(out, 1)


def test_ducts_may_be_a_file(finished, tmp_path):
    text, rows, study = finished
    pyarrow.csv.write_csv(rows, tmp_path / "ducts.csv")
    pyarrow.parquet.write_table(rows, tmp_path / "ducts.parquet")
    for name in ("ducts.csv", "ducts.parquet"):
        other = creepage.study(text, tmp_path / name, tmp_path / f"{name}.out", samples=9, ducts_per_part=4)
        assert digest(other.out) == digest(study.out)


def test_the_scene_may_hold_the_distribution(quick_scene, tmp_path):
    scene = quick_scene.replace("dynamic_coefficient = 0.25", 'dynamic_coefficient = "normal(0.25, 0.03)"')
    rows = ducts(3).drop_columns(["friction.dynamic_coefficient"])
    table = creepage.study(scene, rows, tmp_path / "out", samples=4).dataset().to_table()
    expected = creepage.sweep(quick_scene, ducts(3, "normal(0.25, 0.03)"), samples=4)
    assert table["downstream_force_n"].to_pylist() == expected["downstream_force_n"].to_pylist()


def test_brackets_in_a_title_draw_nothing(quick_scene, tmp_path):
    rows = ducts(2, "normal(0.25, 0.03)").append_column("title", pyarrow.array(["Main road (north)", "normal(1, 2)"]))
    study = creepage.study(quick_scene, rows, tmp_path / "out", samples=2)
    assert study.dataset().schema.names[:3] == ["id", "friction.dynamic_coefficient", "sample"]


def test_another_study_is_not_written_over(finished, tmp_path):
    text, rows, study = finished
    for other in ({"samples": 8}, {"samples": 9, "seed": 2}, {"samples": 9, "ducts_per_part": 5}):
        with pytest.raises(creepage.InputError, match="another study"):
            creepage.study(text, rows, study.out, **{"ducts_per_part": 4, **other})
    with pytest.raises(creepage.InputError, match="another study, with another source"):
        creepage.study(text, rows.slice(1), study.out, samples=9, ducts_per_part=4)


def test_wrong_ducts_are_told_before_anything_is_computed(quick_scene, tmp_path):
    for rows, samples, part in [
        (pyarrow.table({"duct.depht": ["1 m"]}), 0, "did you mean `duct.depth`"),
        (ducts(2), 5, "samples and no distribution"),
        (ducts(2, "normal(1)"), 5, "normal"),
        (ducts(0), 0, "no row"),
    ]:
        with pytest.raises(creepage.InputError, match=part):
            creepage.study(quick_scene, rows, tmp_path / "out", samples=samples)
        assert not [path for path in (tmp_path / "out").rglob("*") if path.is_file()]
    with pytest.raises(creepage.InputError, match=r"found normal\(1\); allowed: normal") as raised:
        creepage.study(quick_scene, ducts(2, "normal(1)"), tmp_path / "out", samples=5)
    assert raised.value.key == "friction.dynamic_coefficient"
    with pytest.raises(creepage.InputError, match=".parquet or .csv"):
        creepage.study(quick_scene, tmp_path / "ducts.txt", tmp_path / "out")
    with pytest.raises(creepage.InputError, match="found no study"):
        creepage.Study(tmp_path / "nowhere")


@pytest.mark.slow
def test_memory_is_flat_from_ten_thousand_to_a_million_rows(quick_scene, tmp_path):
    """The driver's: copying, checking and listing; ten parts are computed of each study."""
    code = """
import resource, sys, creepage, pyarrow
scene, count, out = sys.argv[1], int(sys.argv[2]), sys.argv[3]
def batches():
    for first in range(0, count, 10_000):
        rows = range(first, min(first + 10_000, count))
        yield pyarrow.record_batch({"id": [str(row) for row in rows], "duct.depth": [1 + row % 7 / 7 for row in rows]})
table = batches()
first = next(table)
with pyarrow.ipc.new_file(out + ".arrow", first.schema) as file:
    file.write(first)
    for batch in table:
        file.write(batch)
import pyarrow.parquet
reader = pyarrow.ipc.open_file(pyarrow.memory_map(out + ".arrow"))
with pyarrow.parquet.ParquetWriter(out + ".parquet", reader.schema) as file:
    for number in range(reader.num_record_batches):
        file.write_batch(reader.get_batch(number))
study = creepage.Study.create(scene, out + ".parquet", out, ducts_per_part=20)
for part in study.missing()[:: study.parts // 10]:
    study.compute(part)
assert len(list(study.summary())) >= 200
print(resource.getrusage(resource.RUSAGE_SELF).ru_maxrss / 1024)
"""
    peaks = []
    for count in (10_000, 1_000_000):
        arguments = [sys.executable, "-c", code, quick_scene, str(count), str(tmp_path / str(count))]
        peaks.append(float(subprocess.run(arguments, check=True, capture_output=True, text=True).stdout))
    print(f"{peaks[0]:.0f} MB and {peaks[1]:.0f} MB")
    assert peaks[1] < 1.3 * peaks[0]


def test_blank_ids_are_numbers_of_rows_whatever_the_parts(quick_scene, tmp_path):
    rows = ducts(4).set_column(0, "id", pyarrow.array(["", " ", None, "a"]))
    study = creepage.study(quick_scene, rows, tmp_path / "out", ducts_per_part=1)
    assert [row["id"] for row in study.summary()] == ["0", "1", "2", "a"]


def test_a_study_of_another_version_is_refused(quick_scene, tmp_path):
    study = creepage.study(quick_scene, ducts(1), tmp_path / "out")
    manifest = tmp_path / "out" / "study.json"
    manifest.write_text(manifest.read_text().replace(f'"version": "{creepage.__version__}"', '"version": "9.9"'))
    with pytest.raises(creepage.InputError, match="9.9"):
        creepage.compute_part(study.out, 0)


def test_a_title_of_any_characters_is_read(quick_scene):
    tomllib = pytest.importorskip("tomllib")
    assert creepage.run({**tomllib.loads(quick_scene), "title": "🚚 é"})["title"] == "🚚 é"
