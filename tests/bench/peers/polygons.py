#!/usr/bin/env python3
"""Side by side with LAMMPS `body/rounded/polygon` (Debian's lammps): a settled bed of squares, grain-steps per CPU second.

Both run in turn (A B A B ...); only the step loop counts. What LAMMPS computes is less per grain: rigid squares of one body
each with rounded edges, at most two contacts a pair, linear repulsion of vertex-edge distances, dashpots; no area of
overlap, no deformation, no beams. Its squares are those of the network with the same outer size, rounded by RADIUS, spread
by SPREAD (it smashes its stack in dense beds where the rounding is small against the overlap) and settled again in a box.
    polygons.py STATE.h5 NETWORK.net WIDTH [--program build/release/bin/isostat] [--rounds 3]
The state is what Isostat marches; NETWORK the same bed by `isostat convert`; WIDTH [cm] of its box.
"""
import argparse
import json
import math
import os
import statistics
import subprocess
import tempfile

import lammps

HERE = os.path.dirname(os.path.abspath(__file__))
ROOT = os.path.abspath(os.path.join(HERE, "..", "..", ".."))
RADIUS, SPREAD, DENSITY = 0.01, 1.04, 1.0
SETTLE, GRAIN_STEPS = 20000, {"lammps": 1.2e6, "isostat": 6e6}


def squares(network):
    """(centre, side, angle) of every grain, from its triangles: the first corner is the middle of the square."""
    grains = {}
    with open(network) as file:
        for line in file:
            f = line.split()
            if f and f[0] == "triangle":
                p = [complex(float(f[k]), float(f[k + 1])) for k in (3, 5, 7)]
                grains.setdefault(f[2], []).append(p)
    found = []
    for triangles in grains.values():
        outer = [p for t in triangles for p in t]
        # The corner that all four triangles share, nearly, is the one nearest to the mean of all.
        mean = sum(outer) / len(outer)
        tip = max(outer, key=lambda p: abs(p - mean))
        area = sum(abs(((t[1] - t[0]).conjugate() * (t[2] - t[0])).imag) / 2 for t in triangles)
        found.append((mean, math.sqrt(area), math.atan2((tip - mean).imag, (tip - mean).real)))
    return found


def write_data(path, grains, width):
    low = complex(-width / 2, 0)
    height = 2 * SPREAD * max(c.imag for c, _, _ in grains) + 1
    with open(path, "w") as file:
        file.write(f"squares\n\n{len(grains)} atoms\n{len(grains)} bodies\n1 atom types\n\n0 {width * SPREAD:.17g} xlo xhi\n"
                   f"0 {height:.17g} ylo yhi\n-0.5 0.5 zlo zhi\n\nAtoms\n\n")
        for n, (centre, side, _) in enumerate(grains, 1):
            at = (centre - low) * SPREAD
            file.write(f"{n} 1 1 {DENSITY * side * side:.17g} {at.real:.17g} {at.imag:.17g} 0\n")
        file.write("\nBodies\n\n")
        for n, (_, side, angle) in enumerate(grains, 1):
            reach, inertia = (side / 2 - RADIUS) * math.sqrt(2), DENSITY * side**4 / 6
            corners = [reach * complex(math.cos(a), math.sin(a)) for a in (angle + k * math.pi / 2 for k in range(4))]
            half = inertia / 2  # of a plate about axes in its plane
            file.write(f"{n} 1 19\n4\n{half:.17g} {half:.17g} {inertia:.17g} 0 0 0\n")
            file.writelines(f"{c.real:.17g} {c.imag:.17g} 0\n" for c in corners)
            file.write(f"{2 * RADIUS}\n")
    return height


def lammps_rate(directory, count, width, height, settle):
    log = lammps.run(os.path.join(HERE, "polygons.in"), directory, [], data="bed.data", width=width * SPREAD, height=height,
                     settle=settle, warm=200, steps=max(int(GRAIN_STEPS["lammps"] / count), 100))
    steps, grains, seconds = lammps.loops(log)[-1]
    return steps * grains / seconds / 1e6


def isostat_rate(program, state, count):
    steps = max(int(GRAIN_STEPS["isostat"] / count), 100)
    process = subprocess.run([program, "lab", "throughput", state, "--steps", str(steps)], check=True, capture_output=True,
                             text=True)
    return json.loads(process.stdout)["grain_steps_per_cpu_second"] / 1e6


if __name__ == "__main__":
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("state")
    parser.add_argument("network")
    parser.add_argument("width", type=float)
    parser.add_argument("--program", default=os.path.join(ROOT, "build/release/bin/isostat"))
    parser.add_argument("--rounds", type=int, default=3)
    parser.add_argument("--settle", type=int, default=SETTLE)
    options = parser.parse_args()
    grains = squares(options.network)
    rates = {"isostat": [], "lammps": []}
    with tempfile.TemporaryDirectory() as directory:
        height = write_data(os.path.join(directory, "bed.data"), grains, options.width)
        for _ in range(options.rounds):
            rates["isostat"].append(isostat_rate(os.path.abspath(options.program), options.state, len(grains)))
            rates["lammps"].append(lammps_rate(directory, len(grains), options.width, height, options.settle))
    middle = {code: statistics.median(found) for code, found in rates.items()}
    print("grains,code,rounds,median_million_grain_steps_per_cpu_second,min,max,ns_per_grain_step,ratio_to_lammps")
    for code, found in rates.items():
        print(f"{len(grains)},{code},{len(found)},{middle[code]:.4g},{min(found):.4g},{max(found):.4g},{1e3 / middle[code]:.4g},"
              f"{middle[code] / middle['lammps']:.4g}")
