"""Single runs: the command line's answer to the last digit, from Python."""

import json
import pickle
import signal
import subprocess
import sys
import time
import tomllib

import creepage
import pytest
from conftest import QUICK, ROOT, SCENES, UPPER


@pytest.mark.parametrize("scene", SCENES, ids=lambda scene: scene.stem)
def test_a_run_is_that_of_the_command_line(scene, command):
    assert creepage.run(scene) == json.loads(command("run", scene, "--json"))


def test_a_scene_is_a_path_a_text_or_a_dict():
    text = UPPER.read_text(encoding="utf-8")
    by_path = creepage.run(str(UPPER), QUICK)
    assert creepage.run(text, QUICK) == by_path
    assert creepage.run(tomllib.loads(text), QUICK) == by_path
    deeper = creepage.run(UPPER, {**QUICK, "duct.depth": 2.0, "ends.upstream": {"spring": "3 MN/m"}, "traffic": {"passes": 1}})
    assert deeper.downstream_force_n < by_path.downstream_force_n


def test_a_run_has_its_keys_and_the_last_pass_as_attributes():
    run = creepage.run(UPPER, {**QUICK, "traffic.passes": 3})
    assert run.passes is run["passes"] and len(run.passes) == 3
    assert run.downstream_force_n == run["passes"][-1]["downstream_force_n"] > 0
    assert "saturation" in dir(run)
    with pytest.raises(AttributeError):
        run.no_such_key
    assert pickle.loads(pickle.dumps(run)) == run


def test_an_override_of_none_removes_the_key():
    with pytest.raises(creepage.InputError, match="`traffic.passes` is missing") as raised:
        creepage.run(UPPER, {"traffic.passes": None})
    assert raised.value.key == "traffic.passes"


def test_errors_name_file_line_and_key():
    text = UPPER.read_text(encoding="utf-8").replace('"1.2 m"', '"1.2 kN"')
    line = 1 + [number for number, line in enumerate(text.splitlines()) if "1.2 kN" in line][0]
    with pytest.raises(creepage.InputError) as raised:
        creepage.run(text)
    error = raised.value
    assert (error.file, error.line, error.key) == ("scene", line, "duct.depth")
    assert isinstance(error, ValueError) and "1.2 kN" in str(error)
    again = pickle.loads(pickle.dumps(error))
    assert (str(again), again.line, again.key) == (str(error), error.line, error.key)
    with pytest.raises(creepage.InputError, match="no-such-file"):
        creepage.run("no-such-file.toml")
    with pytest.raises(creepage.InputError, match="TOML"):
        creepage.run("duct = [\n")
    with pytest.raises(creepage.InputError, match="threads = 0"):
        creepage.run(UPPER, threads=0)
    with pytest.raises(creepage.InputError, match="found <object"):
        creepage.run({"duct": {"length": object()}})


def test_progress_is_told_and_its_exception_stops_the_run():
    shares = []
    creepage.run(UPPER, {"solver.tolerance": 0.005}, progress=shares.append)
    assert shares[-1] == 1.0 and len(shares) > 2 and all(0 <= share <= 1 for share in shares)

    def stop(share):
        raise KeyError("enough")

    begun = time.perf_counter()
    with pytest.raises(KeyError, match="enough"):
        creepage.run(UPPER, {"solver.tolerance": 0.0005}, progress=stop)
    assert time.perf_counter() - begun < 5


def test_a_bar_of_tqdm_shows_it():
    tqdm = pytest.importorskip("tqdm")
    with tqdm.tqdm(disable=None) as bar:
        creepage.run(UPPER, QUICK, progress=bar)
    assert (bar.n, bar.total) == (100, 100)


def test_ctrl_c_stops_a_run_at_once():
    code = f"import creepage\nprint('begun', flush=True)\ncreepage.run({str(UPPER)!r}, {{'solver.tolerance': 1e-4}}, threads=2)\n"
    with subprocess.Popen([sys.executable, "-c", code], stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True) as process:
        assert process.stdout.readline() == "begun\n"
        time.sleep(0.5)
        begun = time.perf_counter()
        process.send_signal(signal.SIGINT)
        _, errors = process.communicate(timeout=20)
    assert "KeyboardInterrupt" in errors and process.returncode != 0
    assert time.perf_counter() - begun < 5


def test_one_thread_takes_one_core():
    code = f"""
import creepage, time
wall, processor = time.perf_counter(), time.process_time()
creepage.run({str(UPPER)!r}, {{"solver.tolerance": 0.002}}, threads=1)
print((time.process_time() - processor) / (time.perf_counter() - wall))
"""
    cores = subprocess.run([sys.executable, "-c", code], check=True, capture_output=True, text=True).stdout
    assert float(cores) <= 1.05


def test_jupyter_shows_the_report():
    page = creepage.run(UPPER, QUICK)._repr_html_()
    assert page.startswith("<iframe srcdoc=") and "Full-scale experiment" in page
    assert "&lt;svg" in page and '"' not in page[len('<iframe srcdoc="') :].split('" style=')[0]


def test_the_package_is_typed():
    assert (ROOT / "python/python/creepage/py.typed").exists()
    stub = (ROOT / "python/python/creepage/_creepage.pyi").read_text(encoding="utf-8")
    native = [name for name in dir(creepage._creepage) if not name.startswith("_")]
    assert all(f"def {name}(" in stub or f"class {name}" in stub for name in native), native


@pytest.mark.slow
def test_a_call_costs_less_than_a_millisecond_beside_its_run():
    """Of runs that differ in nothing: one call each against all in one call, on a quiet machine."""
    import pyarrow

    count = 200
    # Each on a ground of its own, which no call can share with the one before.
    rows = pyarrow.table({"duct.depth": [1.2 + 1e-3 * row for row in range(count)]})
    whole = time.process_time()
    creepage.sweep(UPPER, rows, QUICK, threads=1)
    whole = time.process_time() - whole
    single = time.process_time()
    for row in range(count):
        creepage.sweep(UPPER, rows.slice(row, 1), QUICK, threads=1)
    single = time.process_time() - single
    each = 1e3 * (single - whole) / count
    print(f"{each:.2f} ms a call besides {1e3 * whole / count:.2f} ms of its run")
    assert each < 1


def test_a_run_goes_on_from_the_state_of_another():
    scene = UPPER
    passes = {"solver.node_spacing": "0.1 m", "solver.vehicle_step": "0.05 m", "solver.method": "quasi-static"}
    whole = creepage.run(scene, {**passes, "traffic.passes": 8})
    first = creepage.run(scene, {**passes, "traffic.passes": 5})
    second = creepage.run(scene, {**passes, "traffic.passes": 3}, from_state=pickle.loads(pickle.dumps(first)).state)
    assert second.start == {"passes": 5}
    assert second.downstream_force_n == pytest.approx(whole.downstream_force_n, rel=1e-9)
    for bad in ["text", b"no state", b"{}"]:
        with pytest.raises(creepage.InputError):
            creepage.run(scene, from_state=bad)
