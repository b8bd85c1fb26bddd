#!/usr/bin/env python3
"""The step loop of two builds side by side, A B A B: medians of `isostat lab throughput` on the same packing.

    against.py OTHER_PROGRAM [--program build/release/bin/isostat] [--packing data/clusters/dense_1400.net]
               [--rounds 9] [--isa avx512] [--seconds 1]
prints million grain-steps per CPU second, nanoseconds a grain-step of motion and forces, and the ratio of the rates.
"""
import argparse
import json
import os
import statistics
import subprocess

ROOT = os.path.abspath(os.path.join(os.path.dirname(os.path.abspath(__file__)), "..", ".."))


def measure(program, packing, steps, isa):
    environment = dict(os.environ, **({"ISOSTAT_ISA": isa} if isa else {}))
    command = [program, "lab", "throughput", packing, "--steps", str(steps), "--json", "-"]
    report = json.loads(subprocess.run(command, check=True, capture_output=True, text=True, env=environment).stdout)
    work = report["grains"] * report["steps"]
    return (report["grain_steps_per_cpu_second"] / 1e6, 1e9 * report["stages"]["motion"] / work,
            1e9 * report["stages"]["forces"] / work)


if __name__ == "__main__":
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("other")
    parser.add_argument("--program", default=os.path.join(ROOT, "build/release/bin/isostat"))
    parser.add_argument("--packing", default=os.path.join(ROOT, "data/clusters/dense_1400.net"))
    parser.add_argument("--rounds", type=int, default=9)
    parser.add_argument("--isa", default="")
    parser.add_argument("--seconds", type=float, default=1)
    options = parser.parse_args()
    programs = [os.path.abspath(options.other), os.path.abspath(options.program)]
    with open(options.packing) as lines:
        grains = sum(line.startswith("grain ") for line in lines)
    steps = max(int(options.seconds * 1e8 / grains), 10)
    found = {p: [] for p in programs}
    for _ in range(options.rounds):
        for p in programs:
            found[p].append(measure(p, options.packing, steps, options.isa))
    medians = {p: [statistics.median(column) for column in zip(*rows)] for p, rows in found.items()}
    for p, (rate, motion, forces) in medians.items():
        print(f"{p}: {rate:.1f} million/s, motion {motion:.2f} ns, forces {forces:.2f} ns")
    print(f"ratio {medians[programs[1]][0] / medians[programs[0]][0]:.3f}")
