"""The whole run by OpenSees, a general code for structures, against `creepage run`.

    pip install openseespy numpy
    cargo build --release
    python validation/opensees/whole_run.py target/release/creepage

writes docs/charts/opensees.csv, from which `cargo run --release -p creepage-validation opensees` draws the chart. It takes about five minutes.

The cable is a chain of trusses. A spring with a yield force, elastic and perfectly plastic, ties each of its nodes to a node of the duct,
whose displacement is imposed at every step of the vehicle. Nodes, springs and steps are those of `creepage run` on the same mesh, so that both
solve the same equations and differ by how they do it.

OpenSees is given the benefit of every doubt: its import is not timed, it computes one mesh without an estimate of the error, one call
takes a whole pass, and what is set below is the fastest of what was tried. Of `creepage run` the whole process is timed.
"""

import csv
import json
import resource
import subprocess
import sys
import time
from pathlib import Path

import numpy as np
import openseespy.opensees as ops

ROOT = Path(__file__).resolve().parents[2]
SCENE = ROOT / "examples/scenes/full-scale-upper.toml"
TABLE = ROOT / "docs/charts/opensees.csv"
# The last commit of these names the program, as in the other tables.
SOURCES = ["src", "crates/*/src/*", "Cargo.lock"]

# The scene. The duct's motion is compared with the program's, the rest by the forces on the same mesh.
LENGTH, DEPTH = 30.0, 1.2  # m
YOUNG_MODULUS, POISSON_RATIO, LOAD = 800e6, 0.4, 20e3 * 9.80665  # Pa, 1, N
AXIAL_STIFFNESS = 8.01e6  # N
LIMIT = 0.25 * 108.8  # friction per metre q, N/m
SLIP = 2.0 / 7.352941e6  # at which friction reaches its limit, 2/b, m
PASSES, APPROACH = 5, 15.0  # m

DENSITIES = [3, 4, 6, 8, 12, 24, 48]  # nodes a depth
TRUE_DENSITY = 192
TOLERANCES = [0.1, 0.05, 0.03, 0.02, 0.01, 5e-3, 3e-3, 1e-3]

# Springs that hold the duct's nodes to their motion: 30 000 times as stiff as a truss of the finest mesh.
PENALTY = 1e13  # N/m
# Iterations end when the nodes move by less; 1e-12 m changes forces by 5e-8.
CONVERGED = 1e-10  # m
NEWTON = ("NewtonLineSearch", "-type", "InitialInterpolated")
QUASI_NEWTON = ("BFGS",)
PATIENCE = 3.0  # s for which a computation is repeated; the least time counts


def duct_motion(ahead):
    """Displacement of the duct where it is so far ahead of the load (K. L. Johnson, Contact Mechanics, 1985, eq. 3.18)."""
    distance = np.abs(ahead)
    slant = np.hypot(distance, DEPTH)
    shape = distance * DEPTH / slant**3 - (1 - 2 * POISSON_RATIO) * distance / (slant * (slant + DEPTH))
    return np.sign(ahead) * (1 + POISSON_RATIO) * LOAD / (2 * np.pi * YOUNG_MODULUS) * shape


def paths(nodes, step):
    """Displacement of every node of the duct during a pass: at rest, vehicle from before the duct to past it, at rest."""
    count = round((LENGTH + 2 * APPROACH) / step)
    vehicle = -APPROACH + step * np.arange(count + 1)
    return np.pad(duct_motion(nodes[:, None] - vehicle), ((0, 0), (1, 1)))


def opensees(density, steps_per_node):
    """Forces on the load cell after every pass, and how many steps and nodes were solved for (iterations are not counted)."""
    elements = round(LENGTH / DEPTH * density)
    spacing = LENGTH / elements
    nodes = spacing * np.arange(elements + 1)
    motion = paths(nodes, spacing / steps_per_node)

    ops.wipe()
    ops.model("basic", "-ndm", 1, "-ndf", 1)
    duct = elements + 1  # number of the duct's first node
    bar, whole, half = 1, 2, 3
    ops.uniaxialMaterial("Elastic", bar, AXIAL_STIFFNESS)
    ops.uniaxialMaterial("ElasticPP", whole, LIMIT * spacing / SLIP, SLIP)
    ops.uniaxialMaterial("ElasticPP", half, 0.5 * LIMIT * spacing / SLIP, SLIP)
    for node, x in enumerate(nodes.tolist()):
        ops.node(node, x)
        ops.node(duct + node, x)
    for element in range(elements):
        ops.element("Truss", element, element, element + 1, 1.0, bar)
    for node in range(elements + 1):
        friction = half if node in (0, elements) else whole
        ops.element("zeroLength", elements + node, duct + node, node, "-mat", friction, "-dir", 1)
    ops.fix(elements, 1)  # the load cell
    for node, path in enumerate(motion.tolist()):
        ops.timeSeries("Path", node + 1, "-dt", 1.0, "-values", *path)
        ops.pattern("Plain", node + 1, node + 1)
        ops.sp(duct + node, 1, 1.0)

    # With `Transformation` in place of `Penalty` the first step fails: the duct moves before the cable does, all springs yield, and
    # nothing holds the cable. Without line search Newton's method fails on 8 nodes a depth and fewer.
    ops.constraints("Penalty", PENALTY, PENALTY)
    ops.numberer("RCM")
    ops.system("ProfileSPD")
    ops.test("NormDispIncr", CONVERGED, 100, 0)
    ops.algorithm(*NEWTON)
    ops.integrator("LoadControl", 1.0)
    ops.analysis("Static")

    steps = motion.shape[1] - 1
    forces = []
    for _ in range(PASSES):
        ops.setTime(0.0)
        while (left := steps - round(ops.getTime())) > 0:
            if ops.analyze(left) == 0:
                continue
            # On 3 and 4 nodes a depth Newton's method gives up at a few steps, which another takes.
            ops.algorithm(*QUASI_NEWTON)
            if ops.analyze(1) != 0:
                raise RuntimeError(f"no equilibrium with {density} nodes a depth")
            ops.algorithm(*NEWTON)
        ops.reactions()
        forces.append(-ops.nodeReaction(elements, 1))
    return forces, PASSES * steps, PASSES * steps * len(nodes)


def said(*command):
    """What a command prints."""
    return subprocess.run(command, cwd=ROOT, capture_output=True, text=True, check=True).stdout.strip()


def creepage(program, command, *settings):
    """What the program answers as JSON."""
    arguments = [program, command, str(SCENE), "--json"]
    for setting in settings:
        arguments += ["--set", setting]
    done = subprocess.run(arguments, stdout=subprocess.PIPE, stderr=subprocess.DEVNULL, check=True)
    return json.loads(done.stdout)


def run(program, *settings):
    """As `opensees`, and the mesh's nodes a depth."""
    answer = creepage(program, "run", f"traffic.passes={PASSES}", f"solver.approach={APPROACH} m", *settings)
    forces = [record["downstream_force_n"] for record in answer["passes"]]
    cost = answer["cost"]
    return forces, cost["steps"], cost["node_updates"], DEPTH / answer["plan"]["node_spacing_m"]


def on_mesh(program, density):
    spacing = DEPTH / density
    return run(program, f"solver.node_spacing={spacing} m", f"solver.vehicle_step={spacing / 2} m")


def processor_seconds():
    """Of this process and of those that it started and that have ended."""
    usages = [resource.getrusage(who) for who in (resource.RUSAGE_SELF, resource.RUSAGE_CHILDREN)]
    return sum(usage.ru_utime + usage.ru_stime for usage in usages)


def timed(work):
    """What `work` returns, and the least time that it took."""
    least, begin = np.inf, time.monotonic()
    while least == np.inf or time.monotonic() - begin < PATIENCE:
        before = processor_seconds()
        result = work()
        least = min(least, processor_seconds() - before)
    return result, least


def error(found, truth):
    return max(abs(one - true) / abs(true) for one, true in zip(found, truth))


def main():
    program = str(Path(sys.argv[1]).resolve())
    profile = creepage(program, "profile")
    theirs = np.array(profile["longitudinal_m"])
    ours = duct_motion(np.array(profile["positions_m"]))
    assert np.abs(ours - theirs).max() < 1e-8 * np.abs(theirs).max(), "not the same motion of the duct"

    truth, *_ = on_mesh(program, TRUE_DENSITY)
    coarser, *_ = on_mesh(program, TRUE_DENSITY / 2)

    header = ["series", "knob", "knob_unit", "nodes_a_depth", "steps", "node_updates", "error_share_of_force", "processor_seconds"]
    with TABLE.open("w", newline="") as file:
        file.write(f"# {said(program, '--version')}, commit {said('git', 'log', '-1', '--format=%h', '--', *SOURCES)}\n")
        table = csv.writer(file, lineterminator="\n")

        def write(series, knob, unit, density, steps, nodes, error, seconds, forces):
            row = [series, knob, unit, f"{density:g}", steps, nodes, f"{error:.3e}", seconds]
            row += [f"{force:.5f}" for force in forces]
            table.writerow(row)
            file.flush()
            print(*row, flush=True)

        def measure(series, knob, unit, work):
            (forces, steps, nodes, density), seconds = timed(work)
            write(series, knob, unit, density, steps, nodes, error(forces, truth), f"{seconds:.3e}", forces)

        table.writerow(header + [f"force_{number}_n" for number in range(1, PASSES + 1)])
        # What a scheme of second order leaves.
        write("truth", TRUE_DENSITY, "nodes a depth", TRUE_DENSITY, "", "", error(coarser, truth) / 3, "", truth)
        for tolerance in TOLERANCES:
            work = lambda: run(program, f"solver.tolerance={tolerance}")
            measure("creepage run, tolerance 10 % to 0.1 %", tolerance, "tolerance", work)
        for density in DENSITIES:
            measure("creepage run, same mesh", density, "nodes a depth", lambda: on_mesh(program, density))
        for series, steps_per_node in [("OpenSees", 2), ("OpenSees, half as many steps", 1)]:
            for density in DENSITIES:
                work = lambda: (*opensees(density, steps_per_node), density)
                measure(series, density, "nodes a depth", work)


if __name__ == "__main__":
    main()
