#!/usr/bin/env python3
"""Which readings of the paper's open process numbers fit best: chi^2 of Tables II to V of Gilabert 2007 against the mass of
the cell, the cap on the speed of its edges, the reading of V0 and, in series B, how the contacts are stiffened.

    isostat study data/studies/NAME.toml -o out/NAME
        for NAME in readings-method1 readings-aggregates readings-loads readings-stiffening (in this order: the last two
        take states of the second)
    tests/bench/paper_readings.py out docs/measured/results

writes readings.csv (every mean with its error and gap, by reading) and readings_chi2.csv, and prints the latter. Table II and
III: rows Phi_I = .36; IV and V: series A and B. A gap is that of paper_tables.py.
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
    with open(folder / "runs.csv") as f:
        return list(dict.fromkeys(r["row"] for r in csv.DictReader(f)))


def method1(folder):
    """(table, case, mass, cap, velocity reading, stiffening): [(folder, row, stage)]"""
    found = {}
    for row in names(folder):
        m = re.fullmatch(r"(III?)-inertia([\d.]+)-friction([\d.]+)-rolling(true|false)", row)
        case = f"mu {m[3][1:]}" + (" RR" if m[4] == "true" else "")
        found[(m[1], case, float(m[2]), NO_CAP, "-", "-")] = [(folder, row, "")]
    return found


def method2(aggregates, loads, stiffened):
    found = {}
    for row in names(aggregates):
        m = re.fullmatch(r"([AB])(-RR)?-velocity_of(component|vector)", row)
        case, stage = m[1] + (" RR" if m[2] else ""), 1 if m[1] == "A" else 2
        slow = SLOW if m[1] == "B" else "-"
        found[("IV", case, 1.0, "0.05", m[3], slow)] = [(aggregates, row, stage)]
        found[("V", case, 1.0, "0.05", m[3], slow)] = [(aggregates, row, stage + 1)]
    for row in names(loads) if (loads / "runs.csv").exists() else []:
        m = re.fullmatch(r"([AB])(-RR)?-(component|vector)-\d+-inertia([\d.]+)-max_edge_speed([\d.]+)", row)
        cap = NO_CAP if float(m[5]) >= 100 else m[5]
        if (float(m[4]), cap) == (1.0, "0.05"):
            continue  # the run straight through stands for it
        case = m[1] + (" RR" if m[2] else "")
        slow = SLOW if m[1] == "B" else "-"
        found.setdefault(("V", case, float(m[4]), cap, m[3], slow), []).append((loads, row, ""))
    for row in names(stiffened):
        m = re.fullmatch(r"B(-RR)?-\d+", row)
        case = "B" + (" RR" if m[1] else "")
        for table, stage in (("IV", 2), ("V", 3)):
            found.setdefault((table, case, 1.0, "0.05", "component", FAST), []).append((stiffened, row, stage))
    return found


def main():
    out, target = pathlib.Path(sys.argv[1]), pathlib.Path(sys.argv[2])
    numbers = paper()
    table = [["table", "case", "quantity", "mass", "edge_speed", "V0_of", "stiffened", "ours", "error", "samples", "paper",
              "paper_error", "gap"]]
    sums = {}
    for key, sources in {**method1(out / "readings-method1"),
                         **method2(out / "readings-aggregates", out / "readings-loads",
                                   out / "readings-stiffening")}.items():
        for quantity in ("Phi", "z", "mean_radius_weighted"):
            name, case, *reading = key
            r = numbers.get((name, case, quantity)) or numbers.get(("text", case + " P* .01", quantity))
            if not r or (quantity == "mean_radius_weighted" and name != "V"):
                continue
            x = [v for folder, row, stage in sources for v in values(folder, row, stage, quantity)]
            if len(x) < LEAST:
                continue
            mean, error = statistics(x)
            gap = gap_of(mean, error, r)
            table.append([name, case, quantity, *map(str, reading), f"{mean:.5g}", f"{error:.2g}", str(len(x)),
                          r["paper"], r["paper_error"], f"{gap:.2f}"])
            if (name, quantity) == ("IV", "Phi") or quantity == "mean_radius_weighted" or (name, case, quantity) == MISPRINT:
                continue  # the start's, no fit; of another definition (measured/paper.md)
            series = name if name in ("II", "III") else f"{name}, {case[0]}"
            part = sums.setdefault((series, *reading), [0, 0, 0])
            part[0] += gap**2
            part[1] += gap**2 if quantity == "Phi" else 0
            part[2] += 1
    write(target / "readings.csv", table)
    lines = [["table", "mass", "edge_speed", "V0_of", "stiffened", "numbers", "chi2", "of_Phi", "of_z"]]
    for (name, mass, *rest), (total, phi, n) in sorted(sums.items()):
        lines.append([name, str(mass), *rest, str(n), f"{total:.0f}", f"{phi:.0f}", f"{total - phi:.0f}"])
    write(target / "readings_chi2.csv", lines)
    markdown(lines)


if __name__ == "__main__":
    main()
