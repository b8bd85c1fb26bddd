#!/usr/bin/env python3
"""Cost of the step loop: lean scenes against the full one, scaling with the number of grains, two threads against one,
memory per grain; and work-precision of the time step: error of `lab` experiments against closed forms or a finer step,
against run time. Writes tests/bench/results/{lean,scaling,memory,work_precision}.csv.
    step_loop.py [--program build/release/bin/isostat] [lean|scaling|memory|work_precision ...]   default: all
"""
import argparse
import json
import os
import statistics
import subprocess
import sys
import tempfile

HERE = os.path.dirname(os.path.abspath(__file__))
sys.path.insert(0, os.path.join(HERE, "peers"))
from tile import read_net, tile, write_net  # noqa: E402

ROOT = os.path.abspath(os.path.join(HERE, "..", ".."))
ROUNDS = 3
STEPS = (0.12, 0.06, 0.03, 0.015, 0.0075)  # step.fraction


def measured(*command):
    """Standard output, CPU seconds and peak memory [kB] of a process."""
    with tempfile.TemporaryFile("w+") as out:
        process = subprocess.Popen(command, stdout=out, stderr=subprocess.DEVNULL)
        _, status, usage = os.wait4(process.pid, 0)
        if status != 0:
            raise RuntimeError(f"{' '.join(command)} ended with {status}")
        out.seek(0)
        return out.read(), usage.ru_utime + usage.ru_stime, usage.ru_maxrss


def run(program, *words):
    return json.loads(measured(program, "lab", *words)[0])


def rate(program, net, *words):
    return run(program, "throughput", net, *words)["grain_steps_per_cpu_second"] / 1e6


def tiled(directory, cell, grains, k):
    net = os.path.join(directory, f"{k}.net")
    write_net(net, *tile(cell, grains, k), f"tiled {k} x {k}")
    return net


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
        net, count = tiled(directory, cell, grains, k), len(grains) * k * k
        steps = str(max(10, int(3e7 / count)))
        one, two = [], []
        for _ in range(ROUNDS):
            one.append(run(program, "throughput", net, "--steps", steps))
            two.append(run(program, "throughput", net, "--steps", steps, "--threads", "2"))
        wall = [statistics.median(t["grain_steps_per_wall_second"] for t in runs) for runs in (one, two)]
        rows.append((count, round(statistics.median(t["grain_steps_per_cpu_second"] for t in one) / 1e6, 2),
                     round(wall[1] / wall[0], 2)))
    write("scaling.csv", "grains,million_grain_steps_per_cpu_second,wall_speedup_two_threads", rows)


def memory(program, directory, cell, grains):
    """Growth of the peak resident memory of the whole process between two sizes."""
    scene = os.path.join(directory, "gas.toml")
    with open(scene, "w") as out:
        out.write('[law]\nnormal_stiffness = 1e4\n[[stage]]\nvelocity = 1\nuntil = "time"\ntime = 0.02\n')
    commands = {"lab throughput, dense state, plain text": lambda k: ["lab", "throughput", tiled(directory, cell, grains, k),
                                                                      "--steps", "20"],
                "pack, gas, state file": lambda k: ["pack", scene, "-o", os.path.join(directory, f"gas{k}.h5"), "--set",
                                                    f"grains.count={len(grains) * k * k}"]}
    small, large = 8, 16
    rows = []
    for name, words in commands.items():
        peak = [measured(program, *words(k))[2] for k in (small, large)]
        rows.append((f'"{name}"', len(grains) * large**2, peak[1],
                     round((peak[1] - peak[0]) * 1024 / (len(grains) * (large**2 - small**2)))))
    write("memory.csv", "command,grains,peak_kB,bytes_per_grain", rows)


def work_precision(program):
    """An experiment takes milliseconds, less than the program takes to start: its CPU time is that of a step, from two fine
    step sizes (least of several runs), times the number of steps."""
    experiments = {"pair restitution": ("pair", "restitution"), "double triangle N_outer": ("cluster", "double-triangle"),
                   "oblique impact": ("pair", "oblique")}
    fine, finer, finest = 0.004, 0.002, 0.001

    def seconds_times_step(words):
        coarse, dense = (min(measured(program, "lab", *words, "--step", str(s))[1] for _ in range(7)) for s in (fine, finest))
        return (dense - coarse) / (1 / finest - 1 / fine)

    cost = {name: seconds_times_step(words) for name, words in experiments.items()}
    outer = run(program, "cluster", "double-triangle", "--step", str(finer))["N_outer"]
    oblique = run(program, "pair", "oblique", "--step", str(finer))["oblique"]
    rows = []
    for step in STEPS:
        answer = {name: run(program, *words, "--step", str(step)) for name, words in experiments.items()}
        r = answer["pair restitution"]["restitution"]
        impacts = answer["oblique impact"]["oblique"]
        errors = {"pair restitution": (abs(r["mean"] - r["exact"]), r["spread"]),
                  "double triangle N_outer": (abs(answer["double triangle N_outer"]["N_outer"] - outer), ""),
                  "oblique impact": (max(abs(a["tangential"] - b["tangential"]) for a, b in zip(impacts, oblique)),
                                     max(a["spread"] for a in impacts))}
        rows += [(name, step, f"{cost[name] / step:.3g}", *error) for name, error in errors.items()]
    write("work_precision.csv", "label,step_fraction,cpu_seconds,error,spread", rows)


if __name__ == "__main__":
    parser = argparse.ArgumentParser()
    parser.add_argument("--program", default=os.path.join(ROOT, "build/release/bin/isostat"))
    parser.add_argument("parts", nargs="*", default=[])
    options = parser.parse_args()
    program = os.path.abspath(options.program)
    source = os.path.join(ROOT, "data/clusters/dense_1400.net")
    wanted = options.parts or ["lean", "work_precision", "memory", "scaling"]
    with tempfile.TemporaryDirectory() as directory:
        for part in wanted:
            if part in ("lean", "work_precision"):
                {"lean": lambda: lean(program, source), "work_precision": lambda: work_precision(program)}[part]()
            else:
                {"memory": memory, "scaling": scaling}[part](program, directory, *read_net(source))
