#!/usr/bin/env python3
"""Soft-particles used: the tables of docs/measured/spheres.md, section "The model".

    soft_model.py OUT [--program build/release/bin/isostat] [-j 2] [--results docs/measured/results]

Measures the laws of three levels of soft-particles (isostat lab soft-laws), compresses packings of grains and
soft-particles in three resolutions (isostat lab soft-packing), keeps the JSON in OUT and skips what is there; then
writes soft_laws.csv, soft_cage.csv, soft_packing.csv and soft_decades.csv. About 25 minutes on two cores, nearly all of
it the resolved packings.
"""
import argparse
import csv
import json
import os
import subprocess

ROOT = os.path.abspath(os.path.join(os.path.dirname(os.path.abspath(__file__)), "..", ".."))
PACKING = ["--packings", "6", "--edge", "1.2", "--filled", "0.62", "--strain", "0.12", "--points", "12", "--increment",
           "0.005", "--iterations", "2000"]


def run(program, out, name, arguments):
    path = os.path.join(out, name + ".json")
    if not os.path.exists(path):
        subprocess.run([program, "lab", *arguments, "--json", path], check=True)
    with open(path, encoding="utf-8") as file:
        return json.load(file)


def write(path, header, rows):
    with open(path, "w", newline="", encoding="utf-8") as file:
        table = csv.writer(file, lineterminator="\n")
        table.writerow(header)
        table.writerows([[f"{x:.4g}" if isinstance(x, float) else x for x in row] for row in rows])


def laws_rows(laws, name=""):
    for level in laws["levels"]:
        for partner in ("soft_solid", "soft_soft"):
            law = level[partner]
            yield [level["level"], level["bodies"], level["soft_particles"], level["solid_fraction"], name + partner,
                   law["force"], law["exponent"], law["offset"], law["tangential"], law["tangential_exponent"],
                   law["friction"], level["soft_curvature"], level["cpu_seconds"] / laws["packings"]]


def packing_rows(name, result, pair):
    for point in result[pair]:
        yield [name, pair, point["strain"], *(point[quantity][key] for quantity in ("pressure", "solid_load")
                                              for key in ("mean", "resolved", "scatter", "deviation",
                                                          "deviation_error")), point["correlation"]]


def decade_rows(resolved, model, laws):
    """Counts and cost per unit of time of a packing of 1 + below decades, against those that were measured of two."""
    grains = model["solid_grains"]
    per_decade = (resolved["bodies"] - resolved["soft_particles"] - grains) / grains
    for decades in (2, 3, 4):
        full = grains * sum(per_decade ** k for k in range(decades))
        step = 10.0 ** (decades - 1)  # the smallest grain's, shorter by this
        laws_cost = sum(level["cpu_seconds"] for level in laws["levels"][:decades - 1])
        yield [decades, full, model["bodies"], full / model["bodies"], step, full / model["bodies"] * step, laws_cost]


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("out")
    parser.add_argument("--program", default=os.path.join(ROOT, "build/release/bin/isostat"))
    parser.add_argument("-j", default="2")
    parser.add_argument("--results", default=os.path.join(ROOT, "docs/measured/results"))
    args = parser.parse_args()
    os.makedirs(args.out, exist_ok=True)
    threads = ["--threads", args.j]
    laws = run(args.program, args.out, "laws", ["soft-laws", "--levels", "3", "--packings", "14", *threads])
    path = os.path.join(args.out, "laws.json")
    packing = run(args.program, args.out, "packing",
                  ["soft-packing", "--laws", path, "--resolutions", "model,shells,free", *PACKING, *threads])
    plane = run(args.program, args.out, "packing-plane",
                ["soft-packing", "--laws", path, "--resolutions", "model", "--plane-law", *PACKING, *threads])
    confined = run(args.program, args.out, "laws-confined",
                   ["soft-laws", "--confined", "--levels", "1", "--packings", "14", *threads])
    caged = run(args.program, args.out, "packing-confined",
                ["soft-packing", "--laws", os.path.join(args.out, "laws-confined.json"), "--resolutions", "model", *PACKING,
                 *threads])
    write(os.path.join(args.results, "soft_cage.csv"), ["delta", "F", "over_wall"],
          [[point[key] for key in ("delta", "F", "over_wall")] for point in confined["levels"][0]["cage"]])
    write(os.path.join(args.results, "soft_laws.csv"),
          ["level", "bodies", "soft_particles", "solid_fraction", "partner", "force", "exponent", "offset", "tangential",
           "tangential_exponent", "friction", "curvature", "cpu_seconds_per_packing"], [*laws_rows(laws), *laws_rows(confined, "confined ")])
    quantities = [f"{q}_{k}" for q in ("pressure", "load") for k in ("first", "second", "scatter", "deviation", "error")]
    rows = [row for pair in ("model_against_shells", "model_against_free", "shells_against_free")
            for row in packing_rows("measured", packing, pair)]
    for name, other in (("plane law", plane), ("confined", caged)):
        for point, measured in zip(other["model"]["curve"], packing["model_against_shells"]):
            shells = measured["pressure"]
            rows.append([name, "model_against_shells", point["strain"], point["pressure"], shells["resolved"],
                         shells["scatter"], (point["pressure"] - shells["resolved"]) / shells["scatter"]])
    write(os.path.join(args.results, "soft_packing.csv"), ["law", "pair", "strain", *quantities, "correlation"], rows)
    write(os.path.join(args.results, "soft_decades.csv"),
          ["decades", "grains", "model_bodies", "fewer", "longer_step", "cheaper", "laws_cpu_seconds"],
          decade_rows(packing["shells"], packing["model"], laws))
    for name in ("model", "shells", "free"):
        print(name, {k: v for k, v in packing[name].items() if k != "curve"})


if __name__ == "__main__":
    main()
