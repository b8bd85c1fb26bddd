#!/usr/bin/env python3
"""Which readings of the paper's open process numbers fit best: chi^2 of Tables II to V of Gilabert 2007 against the mass of
the cell, the cap on the speed of its edges, the reading of V0 and, in series B, how the contacts are stiffened.

    isostat study data/studies/NAME.toml -o out/NAME        for NAME in method1 readings-method1 aggregation readings readings-loads
    tests/bench/paper_readings.py out docs/measured/results

writes readings.csv (every mean with its error and gap, by reading), readings_chi2.csv (a table and reading) and
readings_joint.csv (all tables together), and prints the last two. Table II and III: rows Phi_I = .36; IV and V: series A and
B, 1400 disks. A gap is that of paper_tables.py.
"""
import csv
import pathlib
import re
import sys

from paper_tables import DATA, gap_of, markdown, statistics, values, write

NO_CAP = "none"
SLOW, FAST = "200 T0, free cell", "3 T0, fixed cell"
LEAST = 3  # samples of a mean that counts
MISPRINT = ("IV", "B", "z")  # 3.123: no reading comes near; 3.213?


def paper():
    return {(r["table"], r["case"].removeprefix("Phi_I .36 "), r["quantity"]): r for r in csv.DictReader(open(DATA))}


def names(folder):
    if not (folder / "runs.csv").exists():
        return []
    with open(folder / "runs.csv") as f:
        return list(dict.fromkeys(r["row"] for r in csv.DictReader(f)))


def method1(*folders):
    """(table, case, mass, cap, velocity reading, stiffening): [(folder, row, stage)]"""
    found = {}
    for folder, row in ((f, row) for f in folders for row in names(f)):
        m = re.fullmatch(r"(III?)-(?:inertia=([\d.]+)|solid_fraction0.36)-friction=([\d.]+)-rolling=(true|false)", row)
        if m:
            case = f"mu {m[3][1:]}" + (" RR" if m[4] == "true" else "")
            found[(m[1], case, float(m[2] or 1), NO_CAP, "-", "-")] = [(folder, row, "")]
    return found


READINGS = {  # suffix of a row of readings.toml: mass, cap, V0, stiffening of B; aggregation.toml has the first
    "": (1.0, "0.05", "component", FAST),
    "-vector": (1.0, "0.05", "vector", FAST),
    "-slow": (1.0, "0.05", "component", SLOW),
    "-vector-slow": (1.0, "0.05", "vector", SLOW),
}


def loads(folder):
    """The grid of masses and caps (readings-loads.toml): Table V of the component's aggregates."""
    found = {}
    for row in names(folder):
        m = re.fullmatch(r"([AB])(-RR)?-inertia=([\d.]+)-max_edge_speed=([\d.e+]+)", row)
        cap = NO_CAP if float(m[4]) > 1 else f"{float(m[4]):g}"
        found[("V", m[1] + (" RR" if m[2] else ""), float(m[3]), cap, "component", FAST if m[1] == "B" else "-")] = [
            (folder, row, "")]
    return found


def method2(tables, others):
    found = {}
    for folder, row in [(tables, r) for r in names(tables)] + [(others, r) for r in names(others)]:
        m = re.fullmatch(r"([AB])(-RR)?(-.*)?", row)
        if not m or (m[3] or "") not in READINGS:
            continue
        mass, cap, velocity, stiffened = READINGS[m[3] or ""]
        case, stage = m[1] + (" RR" if m[2] else ""), 1 if m[1] == "A" else 2
        stiffened = stiffened if m[1] == "B" else "-"
        if cap == "0.05" and mass == 1:  # the cell does not move before
            found[("IV", case, mass, cap, velocity, stiffened)] = [(folder, row, stage)]
        found[("V", case, mass, cap, velocity, stiffened)] = [(folder, row, stage + 1)]
    return found


def joint(sums):
    """Chi^2 of all tables against mass, cap and reading of V0. The mass acts where the cell moves (II, III, V), the cap in
    V, the reading of V0 in IV, whose B of the vector is the one stiffened slowly, for it fits better."""
    lines = [["row", "mass", "edge_speed", "V0_of", "runs", "numbers", "chi2", "II", "III", "IV", "V_A", "V_B"]]
    for mass, cap in sorted({k[1:3] for k in sums if k[0] == "V, B"}):
        for velocity in ("component", "vector"):
            b = {"component": FAST, "vector": SLOW}[velocity]
            known = ("V, A", mass, cap, velocity, "-") in sums and ("V, B", mass, cap, velocity, b) in sums
            of = (velocity, b) if known else ("component", FAST)  # under load the reading hardly shows
            parts = {"II": [("II", mass, NO_CAP, "-", "-")], "III": [("III", mass, NO_CAP, "-", "-")],
                     "IV": [("IV, A", 1.0, "0.05", velocity, "-"), ("IV, B", 1.0, "0.05", velocity, b)],
                     "V_A": [("V, A", mass, cap, of[0], "-")], "V_B": [("V, B", mass, cap, *of)]}
            found = {name: [sums[k] for k in keys if k in sums] for name, keys in parts.items()}
            if all(len(found[name]) == len(keys) for name, keys in parts.items()):
                chi2 = {name: sum(part[0] for part in group) for name, group in found.items()}
                numbers, runs = (sum(part[k] for group in found.values() for part in group) for k in (2, 3))
                lines.append([f"{mass:g} {cap} {velocity}", str(mass), cap, velocity, str(runs), str(numbers),
                              f"{sum(chi2.values()):.0f}",
                              *(f"{chi2[name]:.0f}" for name in parts)])
    return lines


HEADER = ["table", "case", "quantity", "mass", "edge_speed", "V0_of", "stiffened", "ours", "error", "samples", "paper",
          "paper_error", "gap"]


def means(out, numbers):
    """Rows of readings.csv by their first seven columns."""
    rows = {}
    for key, sources in {**method1(out / "method1", out / "readings-method1"), **loads(out / "readings-loads"),
                         **method2(out / "aggregation", out / "readings")}.items():
        for quantity in ("Phi", "z", "mean_radius_weighted"):
            name, case, *reading = key
            r = numbers.get((name, case, quantity)) or numbers.get(("text", case + " P* .01", quantity))
            if not r or (quantity == "mean_radius_weighted" and name != "V"):
                continue
            x = [v for folder, row, stage in sources for v in values(folder, row, stage, quantity)]
            if len(x) < LEAST:
                continue
            mean, error = statistics(x)
            row = [name, case, quantity, *map(str, reading), f"{mean:.5g}", f"{error:.2g}", str(len(x)), r["paper"],
                   r["paper_error"], f"{gap_of(mean, error, r):.4g}"]
            rows[tuple(row[:7])] = row
    return rows


def main():
    out, target = pathlib.Path(sys.argv[1]), pathlib.Path(sys.argv[2])
    path = target / "readings.csv"
    kept = [list(r.values()) for r in csv.DictReader(open(path))] if path.exists() else []
    rows = {**{tuple(row[:7]): row for row in kept}, **means(out, paper())}
    write(path, [HEADER, *rows.values()])
    sums = {}
    for name, case, quantity, mass, *reading, _, _, samples, _, _, gap in rows.values():
        if (name, quantity) == ("IV", "Phi") or quantity == "mean_radius_weighted" or (name, case, quantity) == MISPRINT:
            continue  # the start's, no fit; of another definition (measured/paper.md)
        series = name if name in ("II", "III") else f"{name}, {case[0]}"
        part = sums.setdefault((series, float(mass), *reading), [0, 0, 0, 0])
        part[0] += float(gap)**2
        part[1] += float(gap)**2 if quantity == "Phi" else 0
        part[2] += 1
        part[3] += int(samples) if quantity == "z" else 0
    lines = [["table", "mass", "edge_speed", "V0_of", "stiffened", "numbers", "chi2", "of_Phi", "of_z"]]
    for (name, mass, *rest), (total, phi, n, _) in sorted(sums.items()):
        lines.append([name, str(mass), *rest, str(n), f"{total:.0f}", f"{phi:.0f}", f"{total - phi:.0f}"])
    write(target / "readings_chi2.csv", lines)
    markdown(lines)
    together = joint(sums)
    write(target / "readings_joint.csv", together)
    markdown(together)


if __name__ == "__main__":
    main()
