#!/usr/bin/env python3
"""Numbers of the figures of Gilabert 2007 that the text describes: local coordinations (Figs. 3, 6), slopes and symmetry of
the distributions of normal forces (Fig. 9), series A against B (Fig. 10), angles of forces (Fig. 15).

    isostat study data/studies/NAME.toml -o out/NAME        for NAME in method1 aggregation
    tests/bench/paper_figures.py out docs/measured/results/figures.csv

A row such as A+A-5600 pools both by their samples. Errors are standard errors over samples.
"""
import csv
import json
import math
import pathlib
import sys

from paper_tables import markdown, statistics, write

EXPONENTIAL = (0.1, 0.6)  # [F0] of |N|, where ln p falls in a line
EXPONENTIAL_OF_MEAN = (1.0, 4.0)  # of N over its mean, without cohesion
PEAK = 10  # [degrees] half width of a peak of Fig. 15

METHOD1 = [(f"{t} mu .{m} {'RR' if rr == 'true' else 'no RR'}", f"{t}-solid_fraction0.36-friction=0.{m}-rolling={rr}", "")
           for t in ("II", "III") for m in ("15", "5") for rr in ("false", "true")]
SERIES_A = [(f"A {'RR' if rr else 'no RR'} {p}", f"A{rr}+A{rr}-5600", stage)
            for rr in ("", "-RR") for p, stage in (("P* 0", 1), ("P* .01", 2))]
SERIES_B = [(f"B {'RR' if rr else 'no RR'} {p}", f"B{rr}+B{rr}-5600", stage)
            for rr in ("", "-RR") for p, stage in (("P* 0", 2), ("P* .01", 3))]


def reports(folder, rows, stage):
    with open(folder / "runs.csv") as f:
        runs = [(r["row"], int(r["seed"])) for r in csv.DictReader(f) if r["status"] == "ok"]
    for row, seed in runs:
        if row not in rows.split("+"):
            continue
        for name in ([f"{row}.{seed:04d}.stage{stage}.analysis.json"] if stage != "" else []) + \
                [f"{row}.{seed:04d}.analysis.json"]:
            if (folder / name).exists():
                report = json.loads((folder / name).read_text())
                yield report.get("report", report)
                break


def slope(histogram, low, high, sign):
    """d ln p / d|N| over the bins with low < |N| < high on one side, weighted by their counts."""
    edges, density = histogram["edges"], histogram["density"]
    points = [(sign * (a + b) / 2, math.log(d), d) for a, b, d in zip(edges, edges[1:], density)
              if d > 0 and low < sign * (a + b) / 2 < high]
    if len(points) < 3:
        return math.nan
    w = sum(p[2] for p in points)
    x, y = sum(p[2] * p[0] for p in points) / w, sum(p[2] * p[1] for p in points) / w
    return sum(p[2] * (p[0] - x) * (p[1] - y) for p in points) / sum(p[2] * (p[0] - x) ** 2 for p in points)


def share(histogram, low, high):
    edges, density = histogram["edges"], histogram["density"]
    return sum(d * max(0, min(b, high) - max(a, low)) for a, b, d in zip(edges, edges[1:], density))


def peaks(histogram):
    """Share of the angles within PEAK of 60 and of 120 degrees, over that of a flat distribution."""
    flat = 4 * PEAK / 180
    return (share(histogram, 60 - PEAK, 60 + PEAK) + share(histogram, 120 - PEAK, 120 + PEAK)) / flat


def quantities(report, cohesive):
    x = report["counts"]["x"]
    yield from ((f"x_{k}", x[k]) for k in range(7))
    h = report["forces"]["histograms"]
    if not cohesive:
        yield "Fig. 9a slope of ln p(N/<N>)", slope(h["N_over_mean"], *EXPONENTIAL_OF_MEAN, 1)
        return
    yield "Fig. 9 slope N > 0", slope(h["N"], *EXPONENTIAL, 1)
    yield "Fig. 9 slope N < 0", slope(h["N"], *EXPONENTIAL, -1)
    yield "Fig. 9 share N > 1e-4", report["forces"]["z_plus"] / report["counts"]["z"]
    yield "Fig. 9 share N < -1e-4", report["forces"]["z_minus"] / report["counts"]["z"]
    yield "Fig. 9 zero fraction", report["forces"]["zero_fraction"]
    yield "Figs. 9, 10 share |N| < .1", share(h["N"], -0.1, 0.1)
    yield "Figs. 9, 10 share |N| > .5", 1 - share(h["N"], -0.5, 0.5)
    yield "Fig. 15 peaks at 60, 120 degrees over flat", peaks(h["angle"])


def main():
    out = pathlib.Path(sys.argv[1])
    lines = [["case", "quantity", "value", "error", "samples"]]
    for study, cases in (("method1", METHOD1), ("aggregation", SERIES_A + SERIES_B)):
        if not (out / study / "runs.csv").exists():
            continue
        for case, rows, stage in cases:
            found = {}
            for report in reports(out / study, rows, stage):
                for name, value in quantities(report, not case.startswith("II ")):
                    if value == value:
                        found.setdefault(name, []).append(value)
            for name, x in found.items():
                mean, error = statistics(x)
                lines.append([case, name, f"{mean:.4g}", f"{error:.2g}", str(len(x))])
    write(sys.argv[2], lines)
    markdown(lines)


if __name__ == "__main__":
    main()
