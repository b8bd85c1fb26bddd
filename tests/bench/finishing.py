#!/usr/bin/env python3
"""The same samples ended by the bare law, by a drag and by static solves (docs/measured/equilibrium.md).

Method 1, and method 2 to P* = 0: whole runs, identical up to the finishing. The load P* = .01 of method 2 begins with a
collapse, which is chaotic: it is run by each method from one and the same state at P* = 0. Writes every sample to
docs/measured/results/finishing.csv and prints means of the pairs' differences.
    finishing.py [--program build/release/bin/isostat] [--grains 400] [--jobs 1] [--only TEXT]
With --only, the cases whose name holds the text are run and replace their rows in the table.
"""
import argparse
import concurrent.futures
import csv
import json
import math
import os
import statistics
import subprocess
import tempfile

HERE = os.path.dirname(os.path.abspath(__file__))
ROOT = os.path.abspath(os.path.join(HERE, "..", ".."))
SCENES = os.path.join(ROOT, "data", "scenes")
OUTPUT = os.path.join(ROOT, "docs", "measured", "results", "finishing.csv")
METHODS = ("none", "drag", "newton")
# The readings of the paper with which the results were measured.
READINGS = {"method1": ("cell.inertia=0.3", "stage.0.max_strain_rate=0.05"),
            "method2": ("cell.inertia=0.3", 'stage.0.velocity_of="vector"')}
NUMBERS = ("solid_fraction", "z", "z_star", "N_plus", "N_minus", "zero_fraction", "above_tenth_fraction", "max_force",
           "cpu_seconds")
HEADER = ("scene", "rolling", "seed", "finishing", "equilibrated") + NUMBERS
CASES = (("disks-method1", False, 8), ("disks-method1-cohesionless", False, 8), ("disks-method1", True, 4),
         ("disks-method2-a, P* = 0", False, 4), ("disks-method2-a, last stage", False, 6),
         ("disks-method2-a, last stage", True, 6))  # scene, rolling, seeds

LAST_STAGE = """[grains]
file = "{state}"
[law]
normal_stiffness = 1e5
rolling = {rolling}
[step]
fraction = 0.12
[[stage]]
pressure = 0.01
max_strain_rate = 0.05
"""


def pack(program, scene, output, *settings):
    """CPU seconds; exit code 3 is a result: no equilibrium within stage.max_time."""
    words = [word for s in settings for word in ("--set", s)]
    if os.path.exists(output):
        os.unlink(output)  # of another scene: pack would ask for --force
    process = subprocess.Popen([program, "pack", scene, "-o", output, *words], stdout=subprocess.DEVNULL,
                               stderr=subprocess.DEVNULL)
    _, status, usage = os.wait4(process.pid, 0)
    if os.waitstatus_to_exitcode(status) not in (0, 3):
        raise RuntimeError(f"pack {scene} {settings} ended with {os.waitstatus_to_exitcode(status)}")
    return usage.ru_utime


def analysis(program, state):
    text = subprocess.run([program, "analyze", state, "--only", "counts,forces,equilibrium", "--json", "-"], check=True,
                          capture_output=True, text=True).stdout
    return json.loads(text)


def sample(program, grains, scene, rolling, seed):
    rows, truth = [], str(rolling).lower()
    with tempfile.TemporaryDirectory() as directory:
        path, settings = os.path.join(SCENES, scene.split(",")[0] + ".toml"), [f"law.rolling={truth}"]
        shared = [f"grains.count={grains}", f"seed={seed}", "step.fraction=0.12",
                  *READINGS["method1" if "method1" in scene else "method2"]]
        if "last stage" in scene:
            pack(program, path, os.path.join(directory, "s.h5"), *settings, *shared, 'finish.method="newton"',
                 "output.stages=true")
            path = os.path.join(directory, "last.toml")
            with open(path, "w") as out:
                out.write(LAST_STAGE.format(state=os.path.join(directory, "s.stage1.h5"), rolling=truth))
        else:
            settings += shared
        if "P* = 0" in scene:
            with open(path) as whole:
                first_two = whole.read().rsplit("[[stage]]", 1)[0]
            path = os.path.join(directory, "two.toml")
            with open(path, "w") as out:
                out.write(first_two)
        for method in METHODS:
            state = os.path.join(directory, f"{method}.h5")
            seconds = pack(program, path, state, *settings, f'finish.method="{method}"')
            report = analysis(program, state)
            counts, forces, certificate = report["counts"], report["forces"], report["equilibrium"]
            rows.append((scene, truth, seed, method, int(certificate["equilibrated"]), counts["solid_fraction"], counts["z"],
                         counts["z_star"], forces["N_plus"], forces["N_minus"], forces["zero_fraction"],
                         forces["above_tenth_fraction"], certificate["max_force"], seconds))
    return rows


def summary(rows):
    table = {}
    for row in rows:
        table.setdefault(row[:2], {}).setdefault(row[2], {})[row[3]] = dict(zip(HEADER[4:], row[4:]))
    for case, seeds in table.items():
        print(*case)
        for method in METHODS:
            mine = [s[method] for s in seeds.values()]
            print(f"  {method}: {sum(m['equilibrated'] for m in mine)} of {len(mine)} certified,",
                  *(f"{n} {statistics.mean(m[n] or 0 for m in mine):.6g}" for n in NUMBERS))
        pairs = [s for s in seeds.values() if all(s[m]["equilibrated"] for m in METHODS)]
        for method in METHODS[1:] if len(pairs) > 1 else ():
            for n in NUMBERS[:7]:
                d = [(s[method][n] or 0) - (s["none"][n] or 0) for s in pairs]
                print(f"  {method} - none: {n} {statistics.mean(d):+.6f} +- {statistics.stdev(d) / math.sqrt(len(d)):.6f}"
                      f" (sd of none {statistics.stdev(s['none'][n] or 0 for s in pairs):.6f}, {len(d)} pairs)")


def main():
    parser = argparse.ArgumentParser()
    parser.add_argument("--program", default=os.path.join(ROOT, "build/release/bin/isostat"))
    parser.add_argument("--grains", type=int, default=400)
    parser.add_argument("--jobs", type=int, default=1)
    parser.add_argument("--only", default="")
    options = parser.parse_args()
    program = os.path.abspath(options.program)
    cases = [c for c in CASES if options.only in c[0]]
    names = {(scene, str(rolling).lower()) for scene, rolling, _ in cases}
    kept = []
    if options.only:
        with open(OUTPUT) as table:
            kept = [row for row in list(csv.reader(table))[1:] if (row[0], row[1]) not in names]
    rows = []
    with concurrent.futures.ThreadPoolExecutor(options.jobs) as pool:
        work = [pool.submit(sample, program, options.grains, scene, rolling, seed)
                for scene, rolling, seeds in cases for seed in range(1, seeds + 1)]
        for done in work:
            rows += done.result()
            with open(OUTPUT, "w", newline="") as out:  # as far as it is
                writer = csv.writer(out, lineterminator="\n")
                writer.writerow(HEADER)
                writer.writerows(kept)
                writer.writerows([f"{x:.6g}" if isinstance(x, float) else x for x in row] for row in rows)
    summary(rows)


if __name__ == "__main__":
    main()
