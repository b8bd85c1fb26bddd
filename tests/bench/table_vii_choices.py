#!/usr/bin/env python3
"""What moves xi and d_F (Table VII) and <R>_w (Eq. 30) of Gilabert 2007 on given states: window, weights, constant, unit of
k; gap tolerance, normalisation, weights. The fits are done here anew (scipy), so that they also check those of the program.
Writes a CSV. Needs python3-scipy.

    tests/bench/table_vii_choices.py build/release/bin/isostat out/aggregation docs/measured/results/table_vii_choices.csv
"""
import csv
import glob
import json
import subprocess
import sys

import numpy as np
from scipy.optimize import least_squares
from scipy.special import gamma

program, states, output = sys.argv[1:]
TWO_PI = 2 * np.pi
COLUMNS = {  # name: files, xi / a and <R>_w / a of the paper
    "no RR, P* = 0": (["A.000?.stage1.h5", "A-5600.001?.stage1.h5"], 8.29, None),
    "no RR, P* = .01": (["A.000?.h5", "A-5600.001?.h5"], 6.07, 6.6),
    "RR, P* = 0": (["A-RR.000?.stage1.h5", "A-RR-5600.001?.stage1.h5"], 9.3, None),
    "RR, P* = .01": (["A-RR.000?.h5", "A-RR-5600.001?.h5"], 5.06, 5.47),
}


def files_of(column):
    return [f for pattern in COLUMNS[column][0] for f in sorted(glob.glob(f"{states}/{pattern}"))]


def analyze(files, *options):
    return json.loads(subprocess.run([program, "analyze", *files, *options, "--json", "-"], check=True,
                                     capture_output=True).stdout)


def shape(d, x):  # 2F1((1 + d)/2, d/2; 1; -x^2) by the Legendre series
    z = 1 / np.sqrt(1 + x * x)
    argument, term, total = x * x * z * z / (2 * (1 + z)), np.ones_like(x), np.ones_like(x)
    for n in range(60):
        term = term * (n - d + 1) * (n + d) / (n + 1) ** 2 * argument
        total = total + term
    return z**d * total


def model(p, k):  # ln amplitude, d_F, ln xi, constant
    return p[3] + np.exp(p[0] + p[1] * p[2]) * gamma(p[1]) * shape(p[1], np.exp(p[2]) * k)


def descend(k, residual, start, free):
    def of(q):
        p = np.array(start)
        p[free] = q
        return residual(p) if 0.05 < p[1] < 2.95 and abs(p[2]) < 12 else np.full_like(k, 1e6)

    found = least_squares(of, np.array(start)[free], x_scale="jac", max_nfev=400)
    p = np.array(start)
    p[free] = found.x
    sigma = np.sqrt(np.diag(np.linalg.pinv(found.jac.T @ found.jac)))
    return found.cost, p, {n: s for n, s in zip(free, sigma)}


def fit(k, intensity, modes, weights="modes", constant=True, xi=None):
    free = [0, 1] + ([2] if xi is None else []) + ([3] if constant else [])
    weight = np.sqrt(modes) / intensity
    best = None
    for iteration in range(60):
        if weights == "log":
            residual = lambda p: np.log(np.maximum(model(p, k), 1e-30) / intensity)
        elif weights == "linear":
            residual = lambda p: model(p, k) - intensity
        else:
            residual = lambda p: (model(p, k) - intensity) * weight
        if best is None:
            starts = [[np.log(intensity[0] / (gamma(d) * length**d)), d, np.log(length), 0.0]
                      for d in (1.3, 1.9) for length in ([0.7, 2.5, 9] if xi is None else [xi])]
        else:
            starts = [best[1]]
        best = min((descend(k, residual, s, free) for s in starts), key=lambda end: end[0])
        if weights != "modes":
            break
        new = np.sqrt(modes) / np.maximum(model(best[1], k), 1e-9)
        if np.max(abs(new / weight - 1)) < 1e-4:
            break
        weight = new
    chi2 = np.sum(modes * (intensity / model(best[1], k) - 1) ** 2)
    scale = 1 if weights == "modes" else np.sqrt(2 * best[0] / (len(k) - len(free)))
    return best[1][1], best[2][1] * scale, np.exp(best[1][2]), np.exp(best[1][2]) * best[2].get(2, 0) * scale, chi2 / (
        len(k) - len(free))


rows = []
for column, (_, paper_xi, paper_radius) in COLUMNS.items():
    files = files_of(column)
    s = analyze(files, "--only", "scattering", "--k-max", repr(16 * np.pi))["scattering"]["pooled"]
    k, intensity, modes = (np.array([v[b] for b in range(len(s["k"])) if s["modes"][b]], float)
                           for v in (s["k"], s["I"], s["modes"]))

    def add(choice, low, high, **options):
        inside = (k >= low) & (k <= high)
        d, sd, xi, sx, chi2 = fit(k[inside], intensity[inside], modes[inside], **options)
        rows.append([choice, column, f"{d:.3f}", f"{sd:.3f}", f"{xi:.2f}", f"{sx:.2f}", f"{TWO_PI * xi:.2f}",
                     f"{chi2:.1f}", "", ""])

    add("as analyze does: modes; constant; k a < 2 pi", 0, TWO_PI)
    add("k a < pi", 0, np.pi)
    add("k a < 16 pi", 0, 8 * TWO_PI)
    add("k a > .4", 0.4, TWO_PI)
    add("no constant", 0, TWO_PI, constant=False)
    add("logarithms unweighted", 0, TWO_PI, weights="log")
    add("logarithms unweighted; no constant; k a < pi", 0, np.pi, weights="log", constant=False)
    add("intensities unweighted", 0, TWO_PI, weights="linear")
    add("xi fixed at the paper's", 0, TWO_PI, xi=paper_xi)
    add("xi fixed at the paper's / 2 pi", 0, TWO_PI, xi=paper_xi / TWO_PI)
    if paper_radius is None:
        continue

    def radius(choice, values):
        v = np.array(values)
        rows.append([choice, column] + [""] * 6 + [f"{v.mean():.2f}", f"{v.std(ddof=1) / len(v)**.5:.2f}"])

    for gap in (0, 0.01, 0.05):
        pores = [analyze([f], "--only", "pores", "--gap-tolerance", str(gap))["pores"] for f in files]
        radius(f"pores: gap tolerance {gap} a", [p["mean_radius_weighted"] for p in pores])
        if gap == 0:
            finite = [np.array([[q["area"], q["R"]] for q in p["list"] if not q["percolating"]]).T for p in pores]
    radius("pores: without the factor 2 of Eq. 29", [(a * r).sum() / a.sum() / 2**0.5 for a, r in finite])
    radius("pores: times sqrt 2", [(a * r).sum() / a.sum() * 2**0.5 for a, r in finite])
    radius("pores: diameters", [2 * (a * r).sum() / a.sum() for a, r in finite])
    radius("pores: radius of a disk of the same area", [(a * np.sqrt(a / np.pi)).sum() / a.sum() for a, r in finite])
    radius("pores: weighted by N^2", [(a * a * r).sum() / (a * a).sum() for a, r in finite])
    radius("pores: only R > a", [(a * r)[r > 1].sum() / a[r > 1].sum() for a, r in finite])
    radius("pores: the largest", [r.max() for a, r in finite])

with open(output, "w", newline="") as file:
    table = csv.writer(file, lineterminator="\n")
    table.writerow(["choice", "column", "d_F", "d_F_error", "xi", "xi_error", "two_pi_xi", "chi2_per_dof", "R_w", "R_w_error"])
    table.writerows(rows)
