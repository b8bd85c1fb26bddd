#!/usr/bin/env python3
"""Density of states by kernel polynomials against all modes one by one: error of the number of modes below omega, over
moments and random vectors, against CPU time; then time and memory on large packings.

    tests/bench/density_of_states.py build/release/bin/isostat docs/measured/results/density_of_states.csv [--tiles 3,9,27]

Errors are shares of the degrees of freedom, over the edges of 100 bins: root mean square, largest, and what the program says
of itself (root mean square of below_error: the vectors alone). CPU seconds are those of the command less those of reading and
`counts`; the exact number of zero modes is in them. Tiles are K x K copies of a packing of 1400 grains side by side; rows without an error are too large for `--modes all`.
"""
import argparse
import bisect
import csv
import json
import math
import os
import pathlib
import subprocess
import sys
import tempfile

ROOT = pathlib.Path(__file__).resolve().parents[2]
sys.path.insert(0, str(pathlib.Path(__file__).parent))
from sections import measured, tile  # noqa: E402

MOMENTS = (100, 200, 400, 800, 1600, 3200)
VECTORS = (4, 16, 64)
HEADER = ["packing", "dofs", "zero_modes", "moments", "vectors", "cpu_seconds", "rms_error", "largest_error", "told_error",
          "resolution", "peak_MB"]


class Bench:
    def __init__(self, program, folder):
        self.program, self.report, self.rows = program, f"{folder}/report.json", []

    def modes(self, state, *options):
        """Section, CPU seconds and peak memory."""
        _, seconds, memory = measured([self.program, "analyze", state, "--only", "modes", *options, "--json", self.report], 0)
        with open(self.report) as file:
            return json.load(file)["modes"], seconds, memory

    def add(self, name, state, moments, vectors, options, exact, before):
        m, seconds, memory = self.modes(state, *options, "--density-of-states", "100", "--moments", str(moments),
                                        "--random-vectors", str(vectors))
        h, dofs, errors = m["density"]["histogram"], m["degrees_of_freedom"], ("", "", "")
        if exact:
            off = [b - bisect.bisect_right(exact, edge) for b, edge in zip(h["below"], h["edges"][1:])]
            rms = math.sqrt(sum(e * e for e in off) / len(off))
            told = math.sqrt(sum(e * e for e in h["below_error"]) / len(off))
            errors = tuple(f"{e / dofs:.3g}" for e in (rms, max(map(abs, off)), told))
        self.rows.append([name, dofs, m["zero_modes"], moments, vectors, f"{seconds - before:.3g}", *errors,
                          f"{m['density']['resolution']:.4g}", f"{memory:.0f}"])
        print(*self.rows[-1], flush=True)

    def seconds_before(self, state):
        return measured([self.program, "analyze", state, "--only", "counts", "--json", self.report], 0)[1]

    def small(self, name, state, options):
        m, seconds, memory = self.modes(state, *options, "--modes", "all")
        exact = sorted(m["omega"] + [0.0] * m["zero_modes"])
        before = self.seconds_before(state)
        self.rows.append([name, len(exact), m["zero_modes"], "all", "", f"{seconds - before:.3g}", 0, 0, "", "",
                          f"{memory:.0f}"])
        print(*self.rows[-1], flush=True)
        for vectors in VECTORS:
            for moments in MOMENTS:
                self.add(name, state, moments, vectors, options, exact, before)


def main():
    arguments = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    arguments.add_argument("program")
    arguments.add_argument("output")
    arguments.add_argument("--tiles", default="3,9,27")
    given = arguments.parse_args()
    os.environ.setdefault("OMP_NUM_THREADS", "1")
    with tempfile.TemporaryDirectory() as folder:
        bench = Bench(given.program, folder)
        bench.small("dense", str(ROOT / "data/clusters/dense_1400.net"), ["--law", "frictionless"])
        state, stem = f"{folder}/state.h5", f"{folder}/state"
        def pack(*more):
            subprocess.run([given.program, "pack", str(ROOT / "data/scenes/disks-method1.toml"), "-o", state, "--force", *more],
                           check=True, stderr=subprocess.DEVNULL)
        pack("--set", "grains.count=700")
        bench.small("cohesive", state, [])
        pack()
        subprocess.run([given.program, "convert", state, "-o", f"{stem}.csv"], check=True)
        cell = json.loads(subprocess.run([given.program, "info", state], check=True, capture_output=True,
                                         text=True).stdout)["cell"]
        for k in map(int, filter(None, given.tiles.split(","))):
            tile(stem, cell, k, f"{folder}/tiled")
            tiled = f"{folder}/tiled.h5"
            subprocess.run([given.program, "convert", f"{folder}/tiled.csv", "--box",
                            ",".join(f"{k * edge:.17g}" for edge in cell), "-o", tiled], check=True)
            before = bench.seconds_before(tiled)
            bench.add("tiled", tiled, 800, 4, [], None, before)
    with open(given.output, "w") as file:
        csv.writer(file, lineterminator="\n").writerows([HEADER, *bench.rows])


if __name__ == "__main__":
    main()
