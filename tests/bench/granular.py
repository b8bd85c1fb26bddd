#!/usr/bin/env python3
"""What the studies of hopper, vibrated hopper and drum say (docs/measured/granular.md).

    isostat study data/studies/hopper.toml -o out/hopper
    ... and hopper-disks, hopper-waves, hopper-vibrated, hopper-vibrated-disks, drum, drum-disks, each in out/NAME
    granular.py out [--results docs/measured/results]

Reads the folders of those studies that are there, their run.json and series alone. Writes one row a run
(granular_hopper_runs.csv, granular_drum_runs.csv), means in the form of a study.csv, for `isostat plot --what study`
(granular_hopper.csv, granular_vibrated.csv, granular_waves.csv, granular_drum.csv), and thinned series
(granular_series_*.csv); prints means and fits. All in cm, g, s: disks are scaled by their a and by 981 cm/s^2.
"""
import argparse
import csv
import glob
import json
import math
import os
import re
import statistics

G = 981.0
A_HOPPER, A_DRUM = 0.226, 0.158  # [cm] largest disk: area of the largest square
START, END = 0.1, 0.7            # part of the grains between which a flow rate is taken
TURNED = 40.0                    # [degrees] of the drum before its bed is taken to be steady
DROP = 1.0                       # [degrees] least fall of the centre of mass that counts as an avalanche


def read_series(path):
    with open(path) as file:
        rows = list(csv.reader(file))
    columns = {name: k for k, name in enumerate(rows[0])}
    data = [[float(x) for x in row] for row in rows[1:]]
    return {name: [row[k] for row in data] for name, k in columns.items()}


def runs_of(folder):
    for path in sorted(glob.glob(os.path.join(folder, "*.run.json"))):
        stem = path[:-len(".run.json")]
        with open(path) as file:
            run = json.load(file)
        if run["status"] in ("ok", "unfinished"):
            run["row"], run["seed"] = os.path.basename(stem).rsplit(".", 1)
            yield run, read_series(stem + ".series.csv")


def scale(disks, a):
    """Time and mass of the reduced units in s and g (density 1 g/cm^2)."""
    return (math.sqrt(a / G), math.pi / 4 * a * a) if disks else (1.0, 1.0)


def crossing(t, y, level):
    """First time at which y reaches the level, linear between rows."""
    for k in range(1, len(t)):
        if y[k] >= level:
            return t[k - 1] + (t[k] - t[k - 1]) * (level - y[k - 1]) / (y[k] - y[k - 1])
    return None


def flow(series, disks):
    """Flow rate [grains/s] while the part START to END of the grains goes below the outlet, or what had gone before a
    clog, if that is at least twice START; grains kept; time from the first grain to the last [s]."""
    time, _ = scale(disks, A_HOPPER)
    t, above = [x * time for x in series["t"]], series["grains_above"]
    total = above[0]
    out = [total - x for x in above]
    end = min(END * total, out[-1])
    rate = None
    if end >= 2 * START * total:
        rate = (end - START * total) / (crossing(t, out, end) - crossing(t, out, START * total))
    return rate, int(above[-1]), crossing(t, out, out[-1]) - crossing(t, out, 1) if out[-1] > 1 else 0.0


def hopper_runs(out):
    for study in ("hopper", "hopper-disks", "hopper-vibrated", "hopper-vibrated-disks"):
        disks = study.endswith("disks")
        for run, series in runs_of(os.path.join(out, study)):
            name = run["row"]
            end = "empty" if run["status"] == "ok" else "clogged" if "clogged" in run["reason"] else "time"
            opening = float(re.search(r"opening([\d.]+)", name)[1]) * (A_HOPPER if disks else 1)
            shake = re.match(r"(\d+)Hz-([\d.]+)g", name)
            rate, kept, duration = flow(series, disks)
            grains = "disks" if disks else "squares"
            if name.startswith("frictionless"):
                grains = "frictionless disks"
            yield {"study": study, "grains": grains, "opening": round(opening, 2),
                   "frequency": float(shake[1]) if shake else 0.0, "acceleration": float(shake[2]) if shake else 0.0,
                   "seed": int(run["seed"]), "end": end, "kept": kept, "duration": duration, "rate": rate,
                   "cpu_seconds": float(run["cpu_seconds"])}


def mean_error(values):
    values = [v for v in values if v is not None]
    if not values:
        return None, None
    mean = statistics.mean(values)
    return mean, statistics.stdev(values) / math.sqrt(len(values)) if len(values) > 1 else None


def text(value):
    return "" if value is None else f"{value:.5g}" if isinstance(value, float) else str(value)


def write(path, header, rows):
    with open(path, "w", newline="") as file:
        writer = csv.writer(file, lineterminator="\n")
        writer.writerow(header)
        writer.writerows([text(row[name]) for name in header] for row in rows)
    print(path, len(rows), "rows")


def grouped(runs, keys):
    groups = {}
    for run in runs:
        groups.setdefault(tuple(run[k] for k in keys), []).append(run)
    return groups


def weighted_line(x, y, error):
    """Least squares y = a + b x: a, b, their errors, chi^2."""
    w = [1 / e ** 2 for e in error]
    s, sx, sy = sum(w), sum(a * b for a, b in zip(w, x)), sum(a * b for a, b in zip(w, y))
    sxx, sxy = sum(a * b * b for a, b in zip(w, x)), sum(a * b * c for a, b, c in zip(w, x, y))
    d = s * sxx - sx * sx
    a, b = (sxx * sy - sx * sxy) / d, (s * sxy - sx * sy) / d
    chi2 = sum(k * (q - a - b * p) ** 2 for k, p, q in zip(w, x, y))
    return a, b, math.sqrt(sxx / d), math.sqrt(s / d), chi2


def edge_error(x, y, error):
    """Of the zero of the line through the points: each moved by its error in turn."""
    def edge(values):
        a, b = weighted_line(x, values, error)[:2]
        return -a / b
    moved = [[v + (error[k] if k == n else 0) for k, v in enumerate(y)] for n in range(len(y))]
    return math.sqrt(sum((edge(m) - edge(y)) ** 2 for m in moved))


def hopper(runs, results):
    write(os.path.join(results, "granular_hopper_runs.csv"), list(runs[0]), runs)
    means = []
    for key, group in grouped(runs, ("study", "grains", "opening", "frequency", "acceleration")).items():
        rate, error = mean_error([r["rate"] for r in group])
        kept, kept_error = mean_error([float(r["kept"]) for r in group])
        ends = [r["end"] for r in group]
        means.append(dict(zip(("study", "grains", "opening", "frequency", "acceleration"), key),
                          row="-".join(map(str, key)), runs=len(group), n=len(group), empty=ends.count("empty"),
                          clogged=ends.count("clogged"), rate=rate, rate_se=error, kept=kept, kept_se=kept_error))
    tail = ["runs", "n", "empty", "clogged", "rate", "rate_se", "kept", "kept_se"]
    still = [m for m in means if m["study"] in ("hopper", "hopper-disks")]
    write(os.path.join(results, "granular_hopper.csv"), ["row", "grains", "opening"] + tail, still)
    shaken = [m for m in means if "vibrated" in m["study"]]
    if shaken:
        write(os.path.join(results, "granular_vibrated.csv"),
              ["row", "grains", "opening", "frequency", "acceleration"] + tail, shaken)
    for m in means:
        print(f"{m['row']:50} n {m['n']} empty {m['empty']} clogged {m['clogged']} rate {text(m['rate'])} +- "
              f"{text(m['rate_se'])} kept {text(m['kept'])} +- {text(m['kept_se'])}")
    for grains in sorted({m["grains"] for m in still}):
        points = [m for m in still if m["grains"] == grains and m["rate"] and m["rate_se"] and m["empty"] == m["n"]]
        if len(points) < 3:
            continue
        x = [m["opening"] for m in points]
        y = [m["rate"] ** (2 / 3) for m in points]
        error = [2 / 3 * m["rate_se"] / m["rate"] ** (1 / 3) for m in points]
        a, b, da, db, chi2 = weighted_line(x, y, error)
        print(f"Beverloo {grains}: C (D - D0)^1.5, C = {b ** 1.5:.0f} +- {1.5 * b ** .5 * db:.0f} grains/s cm^-1.5, "
              f"D0 = {-a / b:.3f} +- {edge_error(x, y, error):.3f} cm, chi2 {chi2:.1f} of {len(points)} points")


def without_mean(values, half):
    """Less the running mean over 2 half + 1 rows; shorter by half at both ends."""
    return [values[k] - statistics.mean(values[k - half:k + half + 1]) for k in range(half, len(values) - half)]


def correlation(a, b, lag):
    """Of b, lag rows later than a."""
    pairs = [(a[k], b[k + lag]) for k in range(max(0, -lag), min(len(a), len(a) - lag))]
    return sum(x * y for x, y in pairs) / math.sqrt(sum(x * x for x, _ in pairs) * sum(y * y for _, y in pairs))


def waves(out, results):
    """Correlation of the solid fractions of a slice and of the next one above it, a lag later: a wave that rises has a
    peak at a positive lag, structure that sinks with the grains at a negative one."""
    groups = {}
    for run, series in runs_of(os.path.join(out, "hopper-waves")):
        time, _ = scale(run["row"] != "squares", A_HOPPER)
        t, above = [x * time for x in series["t"]], series["grains_above"]
        flowing = [k for k in range(len(t)) if 0.5 * above[0] <= above[k] <= 0.95 * above[0]]
        if len(flowing) < 50:  # clogged
            continue
        step = (t[flowing[-1]] - t[flowing[0]]) / (len(flowing) - 1)
        slices = [[series[f"Phi_{n:02}"][k] for k in flowing] for n in range(2, 7)]
        slices = [without_mean(s, round(0.03 / step)) for s in slices]
        for lag in range(-round(0.06 / step), round(0.06 / step) + 1):
            values = [correlation(a, b, lag) for a, b in zip(slices, slices[1:])]
            groups.setdefault((run["row"], round(lag * step, 4)), []).append(statistics.mean(values))
    if not groups:
        return
    rows = []
    for (grains, lag), values in sorted(groups.items()):
        mean, error = mean_error(values)
        rows.append({"row": f"{grains}{lag:g}", "grains": grains, "lag": lag, "runs": len(values), "n": len(values),
                     "correlation": mean, "correlation_se": error})
    write(os.path.join(results, "granular_waves.csv"), list(rows[0]), rows)
    for grains in ("squares", "frictionless-disks", "disks"):
        for r in sorted((r for r in rows if r["grains"] == grains), key=lambda r: -r["correlation"])[:3]:
            print(f"waves {grains}: {text(r['correlation'])} +- {text(r['correlation_se'])} at {r['lag']} s")


def drum_run(run, series, disks):
    time, _ = scale(disks, A_DRUM)
    t = [x * time for x in series["t"]]
    angle, mass, surface = series["angle"], series["inclination_mass"], series["inclination_surface"]
    frictionless, omega = run["row"].startswith("frictionless-"), float(run["row"].removeprefix("frictionless-"))
    begin = next((k for k in range(len(t)) if angle[k] >= max(TURNED, omega * 57.3)), None)
    if begin is None:
        return None
    t, angle, mass, surface = t[begin:], angle[begin:], mass[begin:], surface[begin:]
    grains = "frictionless disks" if frictionless else "disks" if disks else "squares"
    result = {"grains": grains, "omega": omega, "seed": int(run["seed"]),
              "seconds": t[-1] - t[0]}
    for name, values in (("mass", mass), ("surface", surface)):
        blocks = 8
        size = len(values) // blocks
        parts = [statistics.mean(values[b * size:(b + 1) * size]) for b in range(blocks)]
        result[name], result[name + "_se"] = statistics.mean(parts), statistics.stdev(parts) / math.sqrt(blocks)
    # Avalanches: falls of the centre of mass by DROP or more between a top and the next bottom.
    tops, bottoms, top, bottom, falling = [], [], mass[0], mass[0], False
    for value in mass:
        if falling:
            bottom = min(bottom, value)
            if value - bottom >= DROP / 2:
                bottoms.append(bottom)
                falling, top = False, value
        else:
            top = max(top, value)
            if top - value >= DROP:
                tops.append(top)
                falling, bottom = True, value
    falls = [a - b for a, b in zip(tops, bottoms)]
    result["avalanches"] = len(falls)
    result["fall"] = statistics.mean(falls) if falls else None
    result["fall_sd"] = statistics.stdev(falls) if len(falls) > 1 else None
    result["top"] = statistics.mean(tops) if tops else None
    result["bottom"] = statistics.mean(bottoms) if bottoms else None
    result["sd"] = statistics.stdev(mass)
    # Part of the time in which the bed turns with the drum, to a fifth, over windows in which the drum turns .5 degrees
    # or, where that is shorter, between two rows.
    step = max(1, round(0.5 / max((angle[-1] - angle[0]) / (len(angle) - 1), 1e-9)))
    windows = range(0, len(mass) - step, step)
    turns = [(mass[k + step] - mass[k]) / (angle[k + step] - angle[k]) for k in windows]
    result["stuck"] = sum(abs(turn - 1) < 0.2 for turn in turns) / len(turns)
    result["cpu_seconds"] = float(run["cpu_seconds"])
    return result


def drum(out, results):
    runs = [r for study in ("drum", "drum-disks") for run, series in runs_of(os.path.join(out, study))
            if (r := drum_run(run, series, study == "drum-disks"))]
    if not runs:
        return
    write(os.path.join(results, "granular_drum_runs.csv"), list(runs[0]), runs)
    means = []
    for (grains, omega), group in grouped(runs, ("grains", "omega")).items():
        row = {"row": f"{grains}-{omega:g}", "grains": grains, "omega2": omega ** 2, "omega": omega, "runs": len(group),
               "n": len(group)}
        for name in ("mass", "surface"):
            inside = math.sqrt(sum(r[name + "_se"] ** 2 for r in group)) / len(group)
            mean, between = mean_error([r[name] for r in group])
            row[name], row[name + "_se"] = mean, max(inside, between or 0)
        for name in ("fall", "top", "bottom", "stuck", "sd"):
            row[name] = mean_error([r[name] for r in group])[0]
        row["avalanches"] = sum(r["avalanches"] for r in group)
        row["seconds"] = sum(r["seconds"] for r in group)
        means.append(row)
    write(os.path.join(results, "granular_drum.csv"),
          ["row", "grains", "omega2", "omega", "runs", "n", "mass", "mass_se", "surface", "surface_se", "seconds",
           "avalanches", "fall", "top", "bottom", "stuck", "sd"], means)
    for m in means:
        print(" ".join(f"{k} {text(v)}" for k, v in m.items()))
    for grains in sorted({m["grains"] for m in means}):
        for name in ("mass", "surface"):
            points = [m for m in means if m["grains"] == grains]
            for power in (1, 2):
                if len(points) > 2:
                    a, b, da, db, chi2 = weighted_line([m["omega"] ** power for m in points], [m[name] for m in points],
                                                       [m[name + "_se"] for m in points])
                    print(f"{grains} {name}: Theta = {a:.2f} +- {da:.2f} + ({b:.3f} +- {db:.3f}) Omega^{power}, "
                          f"chi2 {chi2:.1f} of {len(points)} points")


def thin(source, target, columns, time, every):
    series = read_series(source)
    names = [c for c in columns if c in series]
    with open(target, "w") as file:
        file.write(",".join(["time"] + names) + "\n")
        for k in range(0, len(series["t"]), every):
            file.write(",".join([f"{series['t'][k] * time:.4g}"] + [f"{series[n][k]:.4g}" for n in names]) + "\n")
    print(target)


def series_files(out, results):
    hopper_columns = ("grains_left", "grains_above", "kinetic_energy", "Phi_01", "Phi_02", "Phi_03", "Phi_04", "Phi_05")
    drum_columns = ("angle", "inclination_surface", "inclination_mass")
    for study, row, columns, disks, a, every in (
            ("hopper", "squares-opening0.93", hopper_columns, False, 1, 1),
            ("hopper", "squares-opening0.33", hopper_columns, False, 1, 2),
            ("drum", "0.1", drum_columns, False, 1, 5), ("drum", "3", drum_columns, False, 1, 2),
            ("drum-disks", "0.1", drum_columns, True, A_DRUM, 5), ("drum-disks", "3", drum_columns, True, A_DRUM, 2)):
        source = os.path.join(out, study, f"{row}.0001.series.csv")
        if os.path.exists(source):
            target = os.path.join(results, f"granular_series_{study}-{row}.csv")
            thin(source, target, columns, scale(disks, a)[0], every)


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    here = os.path.dirname(os.path.abspath(__file__))
    parser.add_argument("out", help="folder that holds the folders of the studies")
    parser.add_argument("--results", default=os.path.join(here, "..", "..", "docs", "measured", "results"))
    options = parser.parse_args()
    runs = list(hopper_runs(options.out))
    if runs:
        hopper(runs, options.results)
    waves(options.out, options.results)
    drum(options.out, options.results)
    series_files(options.out, options.results)


if __name__ == "__main__":
    main()
