#!/usr/bin/env python3
"""Series A of method 2 to certified equilibrium at P* = 0 and .01, 1400 grains, by two builds in turn (A B A B):
CPU seconds of the whole process on one core, medians.

    tests/bench/series_a.py OTHER_BUILD/bin/isostat build/release/bin/isostat tests/bench/results/series_a.csv
"""
import csv
import os
import pathlib
import statistics
import subprocess
import sys
import tempfile

SCENE = pathlib.Path(__file__).resolve().parents[2] / "data/scenes/disks-method2-a.toml"
SEEDS, ROUNDS = (1, 2, 3, 4), 2
# The readings of the paper with which the results were measured.
READINGS = ("cell.inertia=0.3", 'stage.0.velocity_of="vector"', "stage.2.max_edge_speed=1000.0")


def cpu_seconds(program, rolling, seed, folder):
    command = [program, "pack", SCENE, "-o", f"{folder}/state-{rolling}-{seed}.h5", "--set", f"seed={seed}", "--set",
               f"law.rolling={rolling}", *(word for r in READINGS for word in ("--set", r))]
    process = subprocess.Popen(command, stderr=subprocess.DEVNULL)
    _, status, usage = os.wait4(process.pid, 0)
    if status != 0:
        raise RuntimeError(f"{command} ended with {os.waitstatus_to_exitcode(status)}")
    return usage.ru_utime


def main():
    other, this, output = sys.argv[1:]
    with tempfile.TemporaryDirectory() as folder, open(output, "w", newline="") as f:
        table = csv.writer(f, lineterminator="\n")
        table.writerow(["rolling", "seed", "cpu_seconds_other", "cpu_seconds_this", "ratio"])
        for rolling in ("true", "false"):
            for seed in SEEDS:
                rounds = [[cpu_seconds(p, rolling, seed, folder) for p in (other, this)] for _ in range(ROUNDS)]
                a, b = (statistics.median(x) for x in zip(*rounds))
                table.writerow([rolling, seed, f"{a:.2f}", f"{b:.2f}", f"{a / b:.2f}"])
                f.flush()


main()
