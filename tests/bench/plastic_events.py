#!/usr/bin/env python3
"""What happens when a loaded packing gives way: a biaxial compression cut into short intervals, and `isostat compare` over each
(docs/measured/strength.md).

    plastic_events.py STATE.h5... [--program build/release/bin/isostat] [--pressure 0.1] [--rate 1e-4] [--strain 0.03]
                      [--interval 5] [--drop 0.2] [--tolerance 1e-3] [--folder out/plastic-events] [-o docs/measured/results/plastic_events.csv]

STATE: packings in equilibrium at the pressure. Each is compressed along direction 1 at the rate [1/T0], its lateral stress kept,
with a snapshot every `interval` [T0]. The table has a line an interval: deviator before and after [F0/a], contacts lost and
gained, rms of the non-affine displacement and its ratio to the affine one, share of the grains in regions that moved rigidly
and the mean size of these. An interval is an event where the deviator falls by more than `drop` of what it has been at most so
far; regions are rigid to `tolerance` [rad]. Prints means over events and over the other intervals, and draws the largest event of the first state.
"""
import argparse
import csv
import glob
import json
import os
import statistics
import subprocess

HERE = os.path.dirname(os.path.abspath(__file__))
ROOT = os.path.abspath(os.path.join(HERE, "..", ".."))
HEADER = ("state", "strain", "deviator_before", "deviator_after", "event", "lost", "gained", "nonaffine_rms",
          "nonaffine_over_affine", "rigid_share", "rigid_mean_size")


def intervals(options, state, folder):
    """[(row, before, after)] of the compression of one state."""
    output = os.path.join(folder, os.path.splitext(os.path.basename(state))[0] + ".biaxial.h5")
    series = output.replace(".h5", ".csv")
    settings = {"grains.file": json.dumps(state), "stage.0.pressure": options.pressure, "stage.1.stress_2": options.pressure,
                "stage.1.strain_rate_1": options.rate, "stage.1.strain": options.strain, "output.series": json.dumps(series),
                "output.series_interval": 0.5, "output.snapshot_interval": options.interval}
    subprocess.run([options.program, "pack", os.path.join(ROOT, "data/scenes/disks-biaxial.toml"), "-o", output, "--force",
                    *(word for key, value in settings.items() for word in ("--set", f"{key}={value}"))],
                   check=True, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
    with open(series) as f:
        rows = [{k: float(v or "nan") for k, v in r.items()} for r in csv.DictReader(f)]
    rows = [r for r in rows if r["stage"] == 1]
    snapshots = [s for s in sorted(glob.glob(output.replace(".h5", ".snapshot*.h5")))]
    times = [json.loads(subprocess.run([options.program, "info", s], check=True, capture_output=True, text=True).stdout)["time"]
             for s in snapshots]
    found, highest = [], 0.0
    for before, after, start, end in zip(snapshots, snapshots[1:], times, times[1:]):
        if start < rows[0]["t"]:
            continue
        about = [statistics.mean(r["sigma11"] - r["sigma22"] for r in rows if abs(r["t"] - t) <= 1) for t in (start, end)]
        report = json.loads(subprocess.run([options.program, "compare", before, after, "--tolerance", str(options.tolerance),
                                            "--json", "-"], check=True,
                                           capture_output=True, text=True).stdout)
        contacts, moved, rigid = report["contacts"], report["displacement"], report["rigid_regions"]
        highest = max(highest, about[0])
        found.append(({"state": os.path.basename(state), "strain": next(r["strain1"] for r in rows if r["t"] >= end - 1e-6),
                       "deviator_before": about[0], "deviator_after": about[1],
                       "event": int(about[1] < about[0] - options.drop * highest), "lost": contacts["lost"] / contacts["before"],
                       "gained": contacts["gained"] / contacts["before"], "nonaffine_rms": moved["nonaffine_rms"],
                       "nonaffine_over_affine": moved["nonaffine_over_affine"], "rigid_share": rigid["share_of_grains"],
                       "rigid_mean_size": rigid["mean_size_weighted"]}, before, after))
    return found


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("states", nargs="+")
    parser.add_argument("--program", default=os.path.join(ROOT, "build/release/bin/isostat"))
    parser.add_argument("--pressure", type=float, default=0.1)
    parser.add_argument("--rate", type=float, default=1e-4)
    parser.add_argument("--strain", type=float, default=0.03)
    parser.add_argument("--interval", type=float, default=5)
    parser.add_argument("--drop", type=float, default=0.2)
    parser.add_argument("--tolerance", type=float, default=1e-3)
    parser.add_argument("--folder", default=os.path.join(ROOT, "out/plastic-events"))
    parser.add_argument("-o", dest="output", default=os.path.join(ROOT, "docs/measured/results/plastic_events.csv"))
    options = parser.parse_args()
    os.makedirs(options.folder, exist_ok=True)
    found = [intervals(options, state, options.folder) for state in options.states]
    rows = [row for of_state in found for row, _, _ in of_state]
    with open(options.output, "w", newline="") as f:
        writer = csv.DictWriter(f, HEADER, lineterminator="\n")
        writer.writeheader()
        writer.writerows({k: f"{v:.6g}" if isinstance(v, float) else v for k, v in row.items()} for row in rows)
    print("| | intervals | " + " | ".join(HEADER[5:]) + " |")
    print("|" + " --- |" * (len(HEADER) - 3))
    for name, event in (("events", 1), ("others", 0)):
        group = [r for r in rows if r["event"] == event]
        means = [statistics.mean(r[k] for r in group if r[k] is not None) if group else float("nan") for k in HEADER[5:]]
        print(f"| {name} | {len(group)} | " + " | ".join(f"{m:.3g}" for m in means) + " |")
    largest = max(found[0], key=lambda i: i[0]["deviator_before"] - i[0]["deviator_after"])
    picture = os.path.join(options.folder, "largest.svg")
    subprocess.run([options.program, "compare", largest[1], largest[2], "--tolerance", str(options.tolerance), "-o", picture], check=True, stdout=subprocess.DEVNULL)
    print(f"largest event of {largest[0]['state']}, strain {largest[0]['strain']:.4f}: {picture}")


if __name__ == "__main__":
    main()
