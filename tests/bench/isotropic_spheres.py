#!/usr/bin/env python3
"""Frictionless Hertz spheres towards the isostatic limit: the table of docs/measured/spheres.md.

    isostat study data/studies/spheres-isotropic.toml -o out/spheres-isotropic
    isotropic_spheres.py out/spheres-isotropic [--results docs/measured/results]

Prints means with standard errors and the exponents between neighbouring pressures; writes spheres_isotropic.csv, which
`isostat plot --what bench` draws against the pressure over the modulus.
"""
import argparse
import csv
import glob
import json
import math
import os
import statistics

ROOT = os.path.abspath(os.path.join(os.path.dirname(os.path.abspath(__file__)), "..", ".."))
PRESSURES = (1e-3, 1e-4, 1e-5, 1e-6)  # [E] of the stages of data/scenes/spheres-isostatic.toml
MODULUS = 1e6
COLUMNS = ("z_star", "Phi", "rattlers", "bulk", "shear", "ratio", "H", "mechanisms")


def of_run(folder, stage):
    for path in sorted(glob.glob(os.path.join(folder, f"*.stage{stage}.analysis.json"))):
        with open(path) as file:
            r = json.load(file)
        r = r["report"]
        counts, moduli, rigidity = r["counts"], r["moduli"], r["rigidity"]
        yield (counts["z_star"], counts["solid_fraction"], counts["rattlers"] / counts["grains"], moduli["bulk"] / MODULUS,
               moduli["shear"] / MODULUS, moduli["shear"] / moduli["bulk"], rigidity["H"], rigidity["mechanisms"])


if __name__ == "__main__":
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("folder")
    parser.add_argument("--results", default=os.path.join(ROOT, "docs/measured/results"))
    options = parser.parse_args()
    rows = []
    print("P/E", *COLUMNS, sep="  ")
    for stage, pressure in enumerate(PRESSURES):
        runs = list(of_run(options.folder, stage))
        mean = [statistics.mean(r[k] for r in runs) for k in range(len(COLUMNS))]
        se = [statistics.stdev([r[k] for r in runs]) / math.sqrt(len(runs)) for k in range(len(COLUMNS))]
        print(f"{pressure:g}", *(f"{m:.5g}+-{e:.2g}" for m, e in zip(mean, se)), sep="  ")
        rows.append((pressure, mean[0] - 6, mean[5]))
    for a, b in zip(rows, rows[1:]):
        exponent = [math.log(a[k] / b[k]) / math.log(a[0] / b[0]) for k in (1, 2)]
        print(f"{a[0]:g} to {b[0]:g}: z* - 6 ~ P^{exponent[0]:.3f}, G/K ~ P^{exponent[1]:.3f} ~ "
              f"(z* - 6)^{exponent[1] / exponent[0]:.2f}")
    with open(os.path.join(options.results, "spheres_isotropic.csv"), "w", newline="") as file:
        writer = csv.writer(file, lineterminator="\n")
        writer.writerow(("P/E", "z* - 6", "G/K"))
        writer.writerows([[f"{v:.5g}" for v in row] for row in rows])
