#!/usr/bin/env python3
"""Cost of the step loop: lean scenes against the full one, scaling with the number of grains, two threads against one;
and work-precision of the time step: error of `lab` experiments against closed forms or a finer step, against run time.
Writes tests/bench/results/{lean,scaling,work_precision}.csv.   step_loop.py [--program build/release/bin/isostat]
"""
import argparse
import json
import os
import statistics
import subprocess
import sys
import tempfile
import time

HERE = os.path.dirname(os.path.abspath(__file__))
sys.path.insert(0, os.path.join(HERE, "peers"))
from tile import read_net, tile, write_net  # noqa: E402

ROOT = os.path.abspath(os.path.join(HERE, "..", ".."))
ROUNDS = 3


def run(program, *words):
    start = time.process_time()
    text = subprocess.run([program, "lab", *words], check=True, capture_output=True, text=True).stdout
    return json.loads(text), time.process_time() - start


def rate(program, net, *words):
    return run(program, "throughput", net, *words)[0]["grain_steps_per_cpu_second"] / 1e6


def write(name, header, rows):
    with open(os.path.join(HERE, "results", name), "w") as out:
        out.write(header + "\n" + "".join(",".join(str(x) for x in row) + "\n" for row in rows))
    print(name, *rows, sep="\n  ")


def lean(program, net):
    scenes = {"full: cohesion, rolling, free cell": ["--cohesion", "--cell", "free"], "fixed cell": ["--cohesion"],
              "no cohesion": ["--cell", "free"], "no rolling": ["--cohesion", "--cell", "free", "--law", "friction"],
              "frictionless": ["--cohesion", "--cell", "free", "--law", "frictionless"],
              "leanest: frictionless, no cohesion, fixed cell": ["--law", "frictionless"]}
    samples = {name: [] for name in scenes}
    for _ in range(ROUNDS):
        for name, words in scenes.items():
            samples[name].append(rate(program, net, "--steps", "20000", *words))
    full = statistics.median(samples["full: cohesion, rolling, free cell"])
    write("lean.csv", "scene,million_grain_steps_per_cpu_second,ratio_to_full",
          [(f'"{n}"', round(statistics.median(s), 2), round(statistics.median(s) / full, 3)) for n, s in samples.items()])


def scaling(program, directory, cell, grains):
    rows = []
    for k in (1, 2, 4, 8, 16, 27):
        net = os.path.join(directory, f"{k}.net")
        write_net(net, *tile(cell, grains, k), f"tiled {k} x {k}")
        steps = str(max(10, int(3e7 / (len(grains) * k * k))))
        one = [run(program, "throughput", net, "--steps", steps)[0] for _ in range(2)]
        two = [run(program, "throughput", net, "--steps", steps, "--threads", "2")[0] for _ in range(2)]
        wall = max(t["grain_steps_per_wall_second"] for t in two) / max(t["grain_steps_per_wall_second"] for t in one)
        rows.append((len(grains) * k * k, round(max(t["grain_steps_per_cpu_second"] for t in one) / 1e6, 2), round(wall, 2)))
    write("scaling.csv", "grains,million_grain_steps_per_cpu_second,wall_speedup_two_threads", rows)


def work_precision(program):
    rows, reference = [], run(program, "cluster", "double-triangle", "--step", "0.002")[0]["N_outer"]
    for step in (0.12, 0.06, 0.03, 0.015, 0.0075):
        pair, seconds = run(program, "pair", "restitution", "--step", str(step))
        r = pair["restitution"]
        rows.append(("pair restitution", step, abs(r["mean"] - r["exact"]), r["spread"]))
        cluster, _ = run(program, "cluster", "double-triangle", "--step", str(step))
        rows.append(("double triangle N_outer", step, abs(cluster["N_outer"] - reference), ""))
    fine = run(program, "pair", "oblique", "--step", "0.002")[0]["oblique"]
    for step in (0.12, 0.06, 0.03, 0.015, 0.0075):
        coarse = run(program, "pair", "oblique", "--step", str(step))[0]["oblique"]
        rows.append(("oblique impact", step, max(abs(a["tangential"] - b["tangential"]) for a, b in zip(coarse, fine)),
                     max(a["spread"] for a in coarse)))
    write("work_precision.csv", "label,step_fraction,error,spread", rows)


if __name__ == "__main__":
    parser = argparse.ArgumentParser()
    parser.add_argument("--program", default=os.path.join(ROOT, "build/release/bin/isostat"))
    program = parser.parse_args().program
    source = os.path.join(ROOT, "data/clusters/dense_1400.net")
    lean(program, source)
    work_precision(program)
    with tempfile.TemporaryDirectory() as directory:
        scaling(program, directory, *read_net(source))
