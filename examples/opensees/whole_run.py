"""The first passes of the full-scale experiment by a general structural code, OpenSees, beside `creepage run`.

    python -m venv .venv && .venv/bin/pip install openseespy==3.7.1.2
    cargo build --release && .venv/bin/python examples/opensees/whole_run.py

writes docs/charts/opensees.csv; `cargo run --release --example charts opensees` draws it.

OpenSees gets the same equations: the cable is a chain of bars, each node held by an elastic-perfectly plastic spring whose foot is moved as the
duct moves, and at rest after each pass. Friction has memory, inertia is left out, and both ends are those of the scene. The motion is Boussinesq's closed form,
which is checked against `creepage profile`. Time is processor time of the analysis alone, for `creepage run` that of the whole program.
"""

import csv
import json
import math
import resource
import subprocess
import sys
import time
from pathlib import Path

import openseespy.opensees as ops

ROOT = Path(__file__).resolve().parents[2]
PROGRAM = ROOT / "target/release/creepage"
SCENE = ROOT / "examples/scenes/full-scale-upper.toml"
PASSES = 5
APPROACH = 15.0
# Those of the scene.
LENGTH, DEPTH = 30.0, 1.2
LOAD, YOUNG, POISSON = 20e3 * 9.80665, 800e6, 0.4
STIFFNESS, LIMIT, SHAPE = 8.01e6, 0.25 * 108.8, 7.352941e6
NODES_A_DEPTH = (3, 6, 12, 24)
TOLERANCES = (0.1, 0.05, 0.03, 0.02, 0.01, 5e-3, 3e-3, 1e-3)
TRUTH = 192
BY_TOLERANCE = "creepage run, tolerance 10 % to 0.1 %"
BY_MESH = "creepage run on the same meshes"
OPENSEES = "OpenSees, 3 to 24 nodes a depth"


def moved(xi):
    """Displacement of the duct along its axis at `xi` ahead of the load (Boussinesq 1885) [m]."""
    r = math.hypot(xi, DEPTH)
    shape = DEPTH * xi / r**3 - (1 - 2 * POISSON) * xi / (r * (r + DEPTH))
    return LOAD * (1 + POISSON) / (2 * math.pi * YOUNG) * shape


def creepage(command, *arguments):
    """The JSON document of a command, and its processor time [s]."""
    before = resource.getrusage(resource.RUSAGE_CHILDREN).ru_utime
    done = subprocess.run(
        [PROGRAM, command, SCENE, "--json", *arguments], capture_output=True, text=True, check=True
    )
    seconds = resource.getrusage(resource.RUSAGE_CHILDREN).ru_utime - before
    return json.loads(done.stdout), seconds


def run(*arguments):
    """Force at the load cell after the passes, and processor time [s]."""
    document, seconds = creepage(
        "run", f"--set=traffic.passes={PASSES}", f"--set=solver.approach={APPROACH}", *arguments
    )
    return [record["downstream_force_n"] for record in document["passes"]], seconds


def opensees(nodes_a_depth):
    """The same by OpenSees, with the vehicle's step of `creepage`: half the distance of nodes."""
    pieces = math.ceil(LENGTH * nodes_a_depth / DEPTH)
    spacing = LENGTH / pieces
    stride = 0.5 * spacing
    # The load from before the duct to beyond it, and then no load.
    places = [-APPROACH + stride * k for k in range(1 + math.ceil((LENGTH + 2 * APPROACH) / stride))]
    ops.wipe()
    ops.model("basic", "-ndm", 1, "-ndf", 1)
    ops.uniaxialMaterial("Elastic", 1, STIFFNESS)
    for i in range(pieces + 1):
        cable, foot, x = i + 1, pieces + 2 + i, i * spacing
        ops.node(cable, x)
        ops.node(foot, x)
        held = LIMIT * spacing * (0.5 if i in (0, pieces) else 1.0)
        slope = 0.5 * SHAPE * held
        ops.uniaxialMaterial("ElasticPP", 2 + i, slope, held / slope)
        ops.element("zeroLength", pieces + 1 + i, foot, cable, "-mat", 2 + i, "-dir", 1)
        history = ([moved(x - place) for place in places] + [0.0]) * PASSES
        ops.timeSeries("Path", 1 + i, "-dt", 1.0, "-values", 0.0, *history)
        ops.pattern("Plain", 1 + i, 1 + i)
        ops.sp(foot, 1, 1.0)
    for i in range(pieces):
        ops.element("truss", 1 + i, i + 1, i + 2, 1.0, 1)
    ops.fix(pieces + 1, 1)
    ops.constraints("Transformation")
    ops.numberer("RCM")
    ops.system("BandGeneral")
    # Newton's method goes round in circles, with and without line search: a spring that slips has no stiffness. Iterations with
    # the stiffness of the cable at rest converge, and Krylov acceleration makes them four times as fast.
    ops.test("NormUnbalance", 1e-6, 5000)
    ops.algorithm("KrylovNewton", "-iterate", "initial", "-increment", "initial")
    ops.integrator("LoadControl", 1.0)
    ops.analysis("Static")
    forces = []
    begun = time.process_time()
    for _ in range(PASSES):
        if ops.analyze(len(places) + 1) != 0:
            raise RuntimeError(f"OpenSees does not converge with {nodes_a_depth} nodes a depth")
        ops.reactions()
        # What presses on the load cell, which pushes back.
        forces.append(-ops.nodeReaction(pieces + 1)[0])
    return forces, time.process_time() - begun


def main():
    checked, _ = creepage("profile", "--positions=-3,-1,0.5,2,10")
    for xi, value in zip(checked["positions_m"], checked["longitudinal_m"]):
        assert abs(moved(xi) - value) < 1e-6 * abs(moved(0.7)), (xi, moved(xi), value)
    truth, _ = run(f"--set=solver.node_spacing={DEPTH / TRUTH}", "--set=solver.method=quasi-static")

    def error(forces):
        return max(abs(force / true - 1.0) for force, true in zip(forces, truth))

    rows = []
    for tolerance in TOLERANCES:
        forces, seconds = run(f"--set=solver.tolerance={tolerance}")
        rows.append((BY_TOLERANCE, tolerance, seconds, forces[-1], error(forces)))
        print(rows[-1], file=sys.stderr)
    for nodes in NODES_A_DEPTH:
        forces, seconds = opensees(nodes)
        rows.append((OPENSEES, nodes, seconds, forces[-1], error(forces)))
        print(rows[-1], file=sys.stderr)
        forces, seconds = run(f"--set=solver.node_spacing={DEPTH / nodes}", "--set=solver.method=quasi-static")
        rows.append((BY_MESH, nodes, seconds, forces[-1], error(forces)))
        print(rows[-1], file=sys.stderr)
    with open(ROOT / "docs/charts/opensees.csv", "w", newline="") as file:
        table = csv.writer(file, lineterminator="\n")
        table.writerow(("series", "knob", "processor_seconds", "force_n", "error_share_of_force"))
        for series, knob, seconds, force, off in rows:
            table.writerow((series, f"{knob:g}", f"{seconds:.3f}", f"{force:.5f}", f"{off:.3e}"))


if __name__ == "__main__":
    main()
