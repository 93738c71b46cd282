"""What people do wrong, and what happens to files and processes: an error that says what is allowed, never a panic or a wrong number."""

import multiprocessing
import os
import threading
from decimal import Decimal
from pathlib import Path

import creepage
import pyarrow
import pyarrow.csv
import pytest
from conftest import QUICK, UPPER, digest, ducts

LAW = "normal(0.25, 0.03)"
FRICTION = "friction.dynamic_coefficient"


@pytest.fixture
def study(quick_scene, tmp_path):
    """A study of two parts, none of them computed."""
    return creepage.Study.create(quick_scene, ducts(2), tmp_path / "out", ducts_per_part=1)


@pytest.mark.parametrize(
    "argument, values",
    [
        ("samples", (-1, 2.5, "3", 2**62, 2**64)),
        ("seed", (-1, 2**64, None)),
        ("threads", (-1, 0, 1.5, 2**40)),
        ("progress", (5,)),
    ],
)
def test_wrong_arguments_are_told(quick_scene, tmp_path, argument, values):
    for value in values:
        with pytest.raises(creepage.InputError, match=f"found {argument} = .*allowed: ") as raised:
            creepage.sweep(UPPER, ducts(2, LAW), QUICK, **{"samples": 2, argument: value})
        assert repr(value) in str(raised.value)
        with pytest.raises(creepage.InputError, match=f"found {argument} = .*allowed: "):
            creepage.study(quick_scene, ducts(2, LAW), tmp_path / "out", **{"samples": 2, argument: value})
    assert not (tmp_path / "out").exists()


def test_more_wrong_arguments_are_told(quick_scene, study, tmp_path):
    for value in (0, -1):
        with pytest.raises(creepage.InputError, match=f"found ducts_per_part = {value}; allowed: "):
            creepage.study(quick_scene, ducts(2), tmp_path / "other", ducts_per_part=value)
    for number in (2, 7, -1):
        with pytest.raises(creepage.InputError, match=f"found number = {number}; allowed: a whole number from 0 to 1"):
            study.compute(number)
    with pytest.raises(creepage.InputError, match="found threads = 0"):
        study.compute(0, threads=0)
    with pytest.raises(creepage.InputError, match="found by = 'zz'; allowed: .*max_compression_n_q95"):
        study.worst(by="zz")
    for missing in ("nowhere.csv", "nowhere.parquet"):
        with pytest.raises(creepage.InputError, match=missing):
            creepage.study(quick_scene, tmp_path / missing, tmp_path / "other")
    with pytest.raises(creepage.InputError, match="nowhere.csv"):
        creepage.calibrate(UPPER, "nowhere.csv")
    with pytest.raises(creepage.InputError, match="found seed = -1"):
        creepage.sweep(UPPER, ducts(1), samples=1, seed=-1)
    for rows in (5, None, [{"duct.depth": 1}]):
        with pytest.raises(creepage.InputError, match="__arrow_c_stream__"):
            creepage.study(quick_scene, rows, tmp_path / "other")
    with pytest.raises(creepage.InputError, match="found client = 5"):
        creepage.study(quick_scene, ducts(1), tmp_path / "other", client=5)
    (tmp_path / "empty.csv").write_text("")
    with pytest.raises(creepage.InputError, match="empty.csv.*no rows"):
        creepage.study(quick_scene, tmp_path / "empty.csv", tmp_path / "other")
    for scene in (5, None, b"scene.toml", ["a"], "a\0b"):
        with pytest.raises(creepage.InputError, match="scene"):
            creepage.run(scene)
    with pytest.raises(creepage.InputError, match="found overrides"):
        creepage.run(UPPER, ["traffic.passes=1"])
    (tmp_path / "file").write_text("")
    with pytest.raises(creepage.InputError, match="file"):
        creepage.study(quick_scene, ducts(1), tmp_path / "file")
    # Largest seed that there is.
    assert len(creepage.sweep(UPPER, ducts(1, LAW), QUICK, samples=2, seed=2**64 - 1)) == 2


def test_a_study_that_has_no_part_yet_is_empty(study):
    assert (list(study.summary()), study.worst(), list(study.failures()), study.reasons()) == ([], [], [], {})
    assert study.dataset().to_table().num_rows == 0


@pytest.mark.parametrize("ids", [[1, 2], [1.0, 2.0], [Decimal("1"), Decimal("2")], ["1", " 2"]])
def test_an_id_is_the_same_in_a_study_and_a_sweep(quick_scene, tmp_path, ids):
    rows = ducts(2, LAW).set_column(0, "id", pyarrow.array(ids))
    table = creepage.study(quick_scene, rows, tmp_path / "out", samples=2).dataset().to_table()
    expected = creepage.sweep(quick_scene, rows.set_column(0, "id", pyarrow.array(["1", "2"])), samples=2)
    assert table[FRICTION].to_pylist() == expected[FRICTION].to_pylist()
    assert table["id"].to_pylist() == ["1", "1", "2", "2"]


@pytest.mark.parametrize("place", ["scene", "table"])
def test_a_changed_table_of_axles_is_noticed(quick_scene, tmp_path, place):
    axles = tmp_path / "axles.csv"
    axles.write_text("load,count\n50 kN,3\n100 kN,1\n")
    scene = tmp_path / "scene.toml"
    text = quick_scene[: quick_scene.index("[[vehicles]]")] + "[traffic]\npasses = 4\nspeed = \"40 km/h\"\n[solver]\ntolerance = 0.1\n"
    rows = ducts(2)
    if place == "scene":
        text = text.replace("passes = 4", 'passes = 4\nhistogram = "axles.csv"')
    else:
        rows = rows.append_column("traffic.histogram", pyarrow.array(["axles.csv"] * 2))
    scene.write_text(text)
    study = creepage.Study.create(scene, rows, tmp_path / "out", ducts_per_part=1)
    study.compute(0)
    assert study.reasons() == {}
    creepage.Study.create(scene, rows, tmp_path / "out", ducts_per_part=1)
    axles.write_text("load,count\n50 kN,3\n120 kN,1\n")
    for go_on in (lambda: creepage.study(scene, rows, tmp_path / "out", ducts_per_part=1), lambda: study.compute(1)):
        with pytest.raises(creepage.InputError, match="axles.csv.* changed"):
            go_on()


def test_columns_of_all_types_are_read_or_refused_by_name(quick_scene, tmp_path):
    text = pyarrow.array(["1.2 m", "1.5 m"])
    good = [
        text,
        text.cast("large_string"),
        text.cast("string_view"),
        text.dictionary_encode(),
        pyarrow.array([Decimal("1.20"), Decimal("1.50")]),
        pyarrow.array([1.2, 1.5]),
    ]
    forces = []
    for number, depth in enumerate(good):
        rows = pyarrow.table({"duct.depth": depth, FRICTION: pyarrow.nulls(2)})
        forces.append(creepage.sweep(UPPER, rows, QUICK)["downstream_force_n"].to_pylist())
        study = creepage.study(quick_scene, rows, tmp_path / str(number))
        forces.append(study.dataset().to_table()["downstream_force_n"].to_pylist())
    assert all(force == forces[0] for force in forces)
    bad = [pyarrow.array([[1], [2]]), pyarrow.array([1, 2], "date32"), pyarrow.array([{"a": 1}] * 2), pyarrow.array([b"1", b"2"])]
    for depth in bad:
        for compute in (creepage.sweep, lambda scene, rows: creepage.study(scene, rows, tmp_path / "bad")):
            with pytest.raises(creepage.InputError, match="column `duct.depth`: found .*allowed: ") as raised:
                compute(quick_scene, pyarrow.table({"duct.depth": depth}))
            assert raised.value.key == "duct.depth"


def test_columns_of_other_libraries_are_read(quick_scene, tmp_path):
    polars = pytest.importorskip("polars")
    frame = polars.DataFrame({"id": ["ä", "🚚"], "duct.depth": ["1.2 m", "1.5 m"], FRICTION: [None, None]})
    frame = frame.with_columns(polars.col("duct.depth").cast(polars.Categorical))
    study = creepage.study(quick_scene, frame, tmp_path / "out")
    assert [row["id"] for row in study.summary()] == ["ä", "🚚"] and study.reasons() == {}
    pandas = pytest.importorskip("pandas", minversion="3")
    frame = pandas.DataFrame({"id": ["a", "b", "c"], "duct.depth": [1.0, 1.2, 1.5]})
    # Filtered rows keep their numbers as an index, which is no column.
    assert list(creepage.sweep(UPPER, frame[frame["duct.depth"] > 1.1], QUICK)["id"]) == ["b", "c"]
    assert list(creepage.sweep(UPPER, frame.set_index("id"), QUICK)["id"]) == ["a", "b", "c"]


def test_a_text_among_distributions_is_a_row_that_failed(quick_scene, tmp_path):
    for name, cells in [("one part", [LAW, "abc", "0.3"]), ("no other law", ["0.3", "abc", LAW])]:
        rows = ducts(3).set_column(2, FRICTION, pyarrow.array(cells))
        study = creepage.study(quick_scene, rows, tmp_path / name, samples=2, ducts_per_part=2)
        table = study.dataset().to_table()
        assert table["status"].to_pylist() == ["ok", "ok", "error", "error", "ok", "ok"]
        assert {row["id"] for row in study.failures()} == {"D00001"}
        assert all("abc" in reason for reason in study.reasons())
        values = table[FRICTION].to_pylist()
        assert values[2:4] == [None, None] and None not in values[:2] + values[4:]
        assert values == creepage.sweep(quick_scene, rows, samples=2)[FRICTION].to_pylist()


def test_a_stream_that_can_be_read_once_is_read_once(quick_scene, tmp_path):
    rows = ducts(5)
    whole = creepage.study(quick_scene, rows, tmp_path / "whole")
    once = creepage.study(quick_scene, rows.to_reader(max_chunksize=2), tmp_path / "once")
    assert digest(once.out) == digest(whole.out) and once.ducts == 5
    # The same rows in other batches are the same study.
    creepage.study(quick_scene, rows.to_reader(max_chunksize=3), whole.out)


@pytest.mark.parametrize(
    "text",
    [
        "# from the office\nid;duct.depth\nA;1,2 m\nB;90 cm\n",
        "\ufeffid\tduct.depth\nA\t1,25\nB\t0,9 m\n",
        'id,duct.depth\n# half\nA , 1.2 m\n"B",0.9\n',
    ],
)
def test_a_file_of_ducts_is_read_as_the_command_line_reads_it(command, quick_scene, tmp_path, text):
    rows, scene = tmp_path / "ducts.csv", tmp_path / "scene.toml"
    rows.write_text(text, encoding="utf-8")
    scene.write_text(quick_scene, encoding="utf-8")
    command("sweep", scene, "--rows", rows, "--out", tmp_path / "out.csv")
    expected = pyarrow.csv.read_csv(tmp_path / "out.csv")
    table = creepage.study(scene, rows, tmp_path / "out").dataset().to_table()
    for name in ("id", "downstream_force_n", "status"):
        assert table[name].to_pylist() == expected[name].to_pylist()


def _in_a_child(send, threads):
    send.send(creepage.sweep(UPPER, ducts(2), QUICK, threads=threads)["downstream_force_n"].to_pylist())
    send.send(creepage.run(UPPER, QUICK, threads=threads).downstream_force_n)


@pytest.mark.skipif("fork" not in multiprocessing.get_all_start_methods(), reason="this system has no fork")
@pytest.mark.parametrize("threads", [None, 2])
def test_a_forked_process_computes_too(threads):
    expected = creepage.sweep(UPPER, ducts(2), QUICK)["downstream_force_n"].to_pylist()
    fork = multiprocessing.get_context("fork")
    receive, send = fork.Pipe(duplex=False)
    child = fork.Process(target=_in_a_child, args=(send, threads))
    child.start()
    try:
        assert receive.poll(30), "the child hangs"
        assert receive.recv() == expected
        assert receive.poll(30) and receive.recv() == creepage.run(UPPER, QUICK).downstream_force_n
        child.join(10)
        assert child.exitcode == 0
    finally:
        child.kill()


def test_parts_of_nobody_are_not_taken_for_the_studys(study, quick_scene):
    study.compute(0)
    os.remove(Path(study.out) / "study.json")
    with pytest.raises(creepage.InputError, match="parts of a study without its manifest"):
        creepage.study(quick_scene, ducts(3), study.out, ducts_per_part=1)


def test_other_files_in_the_folder_are_left_alone(quick_scene, tmp_path):
    out = tmp_path / "out"
    (out / "parts").mkdir(parents=True)
    for name in ("notes.txt", "parts/notes.parquet", "parts/notes.tmp"):
        (out / name).write_text("mine")
    study = creepage.study(quick_scene, ducts(2), out)
    assert len(list(study.summary())) == study.dataset().to_table().num_rows == 2
    assert all((out / f"parts/notes.{kind}").read_text() == "mine" for kind in ("parquet", "tmp"))


def test_a_part_that_was_cut_off_is_named(study):
    study.compute(0)
    part = Path(study.part(0))
    part.write_bytes(part.read_bytes()[:-9])
    for read in (lambda: list(study.summary()), lambda: list(study.failures())):
        with pytest.raises(creepage.InputError, match="part-0000000.parquet.*remove it"):
            read()
    (Path(study.out) / "ducts.parquet").write_bytes(b"PAR1")
    with pytest.raises(creepage.InputError, match="ducts.parquet"):
        study.compute(1)


def test_two_drivers_at_a_time_make_one_study(quick_scene, tmp_path):
    expected = creepage.study(quick_scene, ducts(12), tmp_path / "calm", ducts_per_part=1)
    failed = []

    def drive():
        try:
            creepage.study(quick_scene, ducts(12), tmp_path / "out", ducts_per_part=1, threads=1)
        except Exception as error:
            failed.append(error)

    drivers = [threading.Thread(target=drive) for _ in range(3)]
    for driver in drivers:
        driver.start()
    for driver in drivers:
        driver.join()
    assert not failed
    assert digest(tmp_path / "out") == digest(expected.out)
