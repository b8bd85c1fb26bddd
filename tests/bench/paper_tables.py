#!/usr/bin/env python3
"""The paper's numbers (data/papers/gilabert2007.csv) beside those of the studies in data/studies, and chi^2 a table.

    isostat study data/studies/NAME.toml -o out/NAME        for NAME in method1 aggregation agitation limits choices
    tests/bench/paper_tables.py out docs/measured/results

writes docs/measured/results/gilabert2007.csv and prints it as markdown, study_choices.csv (means of the study of that name),
runs_NAME.csv, every run with its end, CPU time and hash, and gilabert2007_chi2.csv.

A row such as A+A-5600 pools the samples of both: the paper does not distinguish sizes. Errors are standard errors over
samples. `gap` is (ours - paper) over the root of the sum of squares of our standard error and of the paper's printed error,
which is a standard deviation in Tables II and III (`sd`, Sec. III.A) and not said to be one or the other elsewhere; `words`:
a sentence without an error. `before`: the gap in gilabert2007_before.csv, with the readings that study_choices.csv keeps,
whose number stands where a study has not been run. Numbers of studies that are not in `out` stay as they are. Numbers that Table III has twice, and once by a slip, are left out of chi^2 (`slip`).
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
DATA = pathlib.Path(__file__).resolve().parents[2] / "data/papers/gilabert2007.csv"


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


def gap_of(mean, error, row):
    """(ours - paper) in units of the combined error; nan where the paper gives none."""
    if not row["paper_error"] or mean != mean:
        return math.nan
    return (mean - float(row["paper"])) / math.hypot(error if error == error else 0, float(row["paper_error"]))


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


def markdown(lines):
    for k, line in enumerate(lines):
        print("| " + " | ".join(line) + " |")
        if k == 0:
            print("|" + " --- |" * len(line))
    print()


def name_of(row):
    return row["table"], row["case"].removeprefix("Phi_I .36 "), row["quantity"]


def rows_before(target):
    path = target / "gilabert2007_before.csv"
    return {name_of(r): r for r in csv.DictReader(open(path))} if path.exists() else {}


def chi_squares(rows):
    """rows: (table, before or "", gap, doubtful). Chi^2 a table, over the same numbers where both are known."""
    lines = [["table", "numbers", "chi2", "of_numbers_before", "chi2_before", "chi2_of_these"]]
    for table in dict.fromkeys(r[0] for r in rows):
        sure = [r for r in rows if r[0] == table and not r[3] and r[2] == r[2]]
        both = [r for r in sure if r[1]]
        if sure:
            lines.append([table, str(len(sure)), f"{sum(r[2] ** 2 for r in sure):.0f}", str(len(both)),
                          f"{sum(float(r[1]) ** 2 for r in both):.0f}", f"{sum(r[2] ** 2 for r in both):.0f}"])
    return lines


def main():
    out, target = pathlib.Path(sys.argv[1]), pathlib.Path(sys.argv[2])
    before = rows_before(target)
    path = target / "gilabert2007.csv"
    kept = {(r["table"], r["case"], r["quantity"]): r for r in csv.DictReader(open(path))} if path.exists() else {}
    lines = [["table", "case", "quantity", "ours", "error", "samples", "paper", "paper_error", "kind", "gap", "before"]]
    gaps = []
    for r in csv.DictReader(open(DATA)):
        folder = out / r["study"]
        was = before.get(name_of(r), {}).get("gap", "")
        kind = r["error_kind"] + (", " + r["doubt"] if r["doubt"] else "")
        x = []
        if (folder / "runs.csv").exists():
            x = [v for row in r["row"].split("+") for v in values(folder, row, r["stage"], r["quantity"])]
        old = kept.get((r["table"], r["case"], r["quantity"]))
        if not x and old and old["ours"]:  # not run again
            lines.append(list(old.values()))
            gaps.append((r["table"], was, gap_of(float(old["ours"]), float(old["error"] or "nan"), r), r["doubt"]))
            continue
        if not x:
            if old := before.get(name_of(r)):
                lines.append([r["table"], r["case"], r["quantity"], "", "", "", r["paper"], r["paper_error"], kind,
                              f"not run; {old['ours']} +- {old['error']} ({old['samples']}) before", was])
            continue
        mean, error = statistics(x)
        gap = gap_of(mean, error, r)
        lines.append([r["table"], r["case"], r["quantity"], f"{mean:.4g}", f"{error:.2g}" if error == error else "", str(len(x)),
                      r["paper"], r["paper_error"], kind, f"{gap:.1f}" if gap == gap else "", was])
        gaps.append((r["table"], was, gap, r["doubt"]))
    write(target / "gilabert2007.csv", lines)
    chi2 = chi_squares(gaps)
    write(target / "gilabert2007_chi2.csv", chi2)
    for folder in sorted(p.parent for p in out.glob("*/runs.csv")):
        write_runs(folder, target)
    if (out / "choices/study.csv").exists():
        write_choices(out / "choices", target)
    markdown(lines)
    markdown(chi2)


if __name__ == "__main__":
    main()
