#!/usr/bin/env python3
"""The paper's numbers (data/papers/gilabert2007.csv) beside those of the studies in data/studies.

    isostat study data/studies/NAME.toml -o out/NAME        for NAME in method1 aggregation agitation limits choices
    tests/bench/paper_tables.py out docs/measured/results

writes docs/measured/results/gilabert2007.csv and prints it as markdown, study_choices.csv (means of the study of that name), and
runs_NAME.csv, every run with its end, CPU time and hash.

A row such as A+A-5600 pools the samples of both: the paper does not distinguish sizes. Errors are standard errors over
samples. `gap` is (ours - paper) in units of the combined error, where the paper gives one.
"""
import csv
import json
import math
import pathlib
import sys

COLUMNS = {"Phi": ("counts", "solid_fraction"), "z": ("counts", "z"), "F_perc": ("percolation", "F_perc"),
           "mean_radius_weighted": ("pores", "mean_radius_weighted"), "rattlers": ("counts", "rattlers"),
           "distant": ("counts", "distant")}
OVER = {"rattlers": "grains", "distant": "contacts"}  # a proportion of


def values(folder, row, stage, quantity):
    """The quantity of every certified sample of a row."""
    section, key = COLUMNS.get(quantity, ("forces", quantity))
    found = []
    with open(folder / "runs.csv") as f:
        runs = [r for r in csv.DictReader(f) if r["row"] == row and r["status"] == "ok"]
    for run in runs:
        stem = f"{row}.{int(run['seed']):04d}"
        names = [f"{stem}.stage{stage}.analysis.json"] if stage else []
        path = next((folder / n for n in names + [f"{stem}.analysis.json"] if (folder / n).exists()), None)
        if path is None:
            continue
        report = json.loads(path.read_text())
        report = report.get("report", report)
        value = report.get(section, {}).get(key)
        if value is not None:
            found.append(float(value) / (report[section][OVER[key]] if key in OVER else 1))
    return found


def statistics(x):
    n = len(x)
    if n == 0:
        return math.nan, math.nan
    mean = sum(x) / n
    sd = math.sqrt(sum((v - mean) ** 2 for v in x) / (n - 1)) if n > 1 else math.nan
    return mean, sd / math.sqrt(n) if n > 1 else math.nan


def write(path, rows):
    with open(path, "w", newline="") as f:
        csv.writer(f, lineterminator="\n").writerows(rows)


def write_choices(folder, target):
    """Means of the rows of data/studies/choices.toml, by stage."""
    names = {"Phi": "counts.solid_fraction", "z": "counts.z", "zero_fraction": "forces.zero_fraction",
             "above_tenth_fraction": "forces.above_tenth_fraction"}
    rows = [["row", "stage", *(n for name in names for n in (name, name + "_se")), "samples"]]
    for r in csv.DictReader(open(folder / "study.csv")):
        columns = [c for key in names.values() for c in (key, key + "_se")]
        rows.append([r["row"], r["stage"], *(f"{float(r[c] or 'nan'):.6g}" for c in columns), r["n"]])
    write(target / "study_choices.csv", rows)


def write_runs(folder, target):
    rows = [[v for k, v in r.items() if k != "reason"] for r in csv.DictReader(open(folder / "runs.csv"))]
    header = [k for k in next(csv.reader(open(folder / "runs.csv"))) if k != "reason"]
    write(target / f"runs_{folder.name}.csv", [header, *rows])


def main():
    out, target = pathlib.Path(sys.argv[1]), pathlib.Path(sys.argv[2])
    data = pathlib.Path(__file__).resolve().parents[2] / "data/papers/gilabert2007.csv"
    lines = [["table", "case", "quantity", "ours", "error", "samples", "paper", "paper_error", "gap", "reference",
              "difference"]]
    for r in csv.DictReader(open(data)):
        folder = out / r["study"]
        if not (folder / "runs.csv").exists():
            continue
        x = [v for row in r["row"].split("+") for v in values(folder, row, r["stage"], r["quantity"])]
        mean, error = statistics(x)
        paper = float(r["paper"])
        combined = math.hypot(error if error == error else 0, float(r["paper_error"] or 0))
        gap = f"{(mean - paper) / combined:.1f}" if r["paper_error"] and combined > 0 else ""
        difference = f"{mean - float(r['reference']):+.4f}" if r["reference"] else ""
        lines.append([r["table"], r["case"], r["quantity"], f"{mean:.4g}", f"{error:.2g}", str(len(x)), r["paper"],
                      r["paper_error"], gap, r["reference"], difference])
    write(target / "gilabert2007.csv", lines)
    for folder in sorted(p.parent for p in out.glob("*/runs.csv")):
        write_runs(folder, target)
    if (out / "choices/study.csv").exists():
        write_choices(out / "choices", target)
    for k, line in enumerate(lines):
        print("| " + " | ".join(line) + " |")
        if k == 0:
            print("|" + " --- |" * len(line))


main()
