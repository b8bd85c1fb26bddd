#!/usr/bin/env python3
"""Work-precision of two colliding squares (`lab collide-squares`): error of the final spin, and of the energy without
dampers, against step and CPU time, for both integrators and both laws. Reference of a spin: Gear at step .0025.
Without dampers the energy that is missing at the end, neither in motion nor stored in beams, is the error (of the paper's
law also at vanishing step: its forces have no energy). Writes results/triangle_precision.csv, and the root mean squares
over the speeds as results/triangle_precision_plot.csv for `isostat plot`.
    triangle_precision.py [--program build/release/bin/isostat]
"""
import argparse
import csv
import json
import os
import subprocess

HERE = os.path.dirname(os.path.abspath(__file__))
ROOT = os.path.abspath(os.path.join(HERE, "..", ".."))
SPEEDS, STEPS, REFERENCE = (10, 50, 100), (0.8, 0.6, 0.4, 0.2, 0.1, 0.05, 0.025, 0.0125), 0.0025
LAWS, INTEGRATORS, ROUNDS = ("overlap-energy", "paper"), ("verlet", "gear"), 5


def collide(program, law, integrator, speed, step, damping):
    """The answer, or none where the step is unstable or the squares blow up."""
    words = [program, "lab", "collide-squares", "--speed", speed, "--law", law, "--integrator", integrator, "--step", step,
             "--damping", damping]
    process = subprocess.run([str(w) for w in words], capture_output=True, text=True)
    return json.loads(process.stdout) if process.returncode == 0 else None


def energy_error(answer):
    return abs(answer["translation"] + answer["rotation"] + answer["stored"] - 1)


def measure(program):
    rows = []
    for law in LAWS:
        for speed in SPEEDS:
            exact = collide(program, law, "gear", speed, REFERENCE, 9)["omega_final"]
            for integrator in INTEGRATORS:
                for step in STEPS:
                    damped = [collide(program, law, integrator, speed, step, 9) for _ in range(ROUNDS)]
                    free = collide(program, law, integrator, speed, step, 0)
                    if damped[0] is None:
                        continue
                    rows.append({"law": law, "speed": speed, "integrator": integrator, "step_fraction": step,
                                 "cpu_seconds": min(a["cpu_seconds"] for a in damped), "steps": damped[0]["steps"],
                                 "omega_error": abs(damped[0]["omega_final"] / exact - 1),
                                 "energy_error": energy_error(free) if free else ""})
                    print(*rows[-1].values(), flush=True)
    return rows


def write(name, header, rows):
    with open(os.path.join(HERE, "results", name), "w", newline="") as file:
        writer = csv.writer(file, lineterminator="\n")
        writer.writerow(header)
        writer.writerows([[f"{v:.3g}" if isinstance(v, float) else v for v in row] for row in rows])


def over_speeds(rows):
    """Root mean squares over the speeds, for `isostat plot`; only steps that all of them survive."""
    table = []
    for law in LAWS:
        for integrator in INTEGRATORS:
            for step in STEPS:
                some = [r for r in rows if (r["law"], r["integrator"], r["step_fraction"]) == (law, integrator, step)]
                if len(some) < len(SPEEDS) or any(r["energy_error"] == "" for r in some):
                    continue
                squares = [sum(r[e] ** 2 for r in some) / len(some) for e in ("omega_error", "energy_error")]
                table.append((f"{law} {integrator}", step, sum(r["cpu_seconds"] for r in some) / len(some),
                              *(s ** 0.5 for s in squares)))
    return table


if __name__ == "__main__":
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--program", default=os.path.join(ROOT, "build/release/bin/isostat"))
    rows = measure(os.path.abspath(parser.parse_args().program))
    write("triangle_precision.csv", rows[0].keys(), [r.values() for r in rows])
    write("triangle_precision_plot.csv", ("label", "step_fraction", "cpu_seconds", "omega_error", "energy_error"),
          over_speeds(rows))
