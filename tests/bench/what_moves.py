#!/usr/bin/env python3
"""What changes from pressure to pressure of a load path: `isostat compare` between the states of successive stages, means over
the samples (docs/measured/consolidation.md, "What moves").

    what_moves.py FOLDER ROW --stages 2,3,4 [--program build/release/bin/isostat]

FOLDER: of a study that has been run; ROW: one of its rows; the stages are those after which its states are kept.
"""
import argparse
import glob
import json
import os
import statistics
import subprocess

ROOT = os.path.abspath(os.path.join(os.path.dirname(os.path.abspath(__file__)), "..", ".."))


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("folder")
    parser.add_argument("row")
    parser.add_argument("--stages", required=True)
    parser.add_argument("--program", default=os.path.join(ROOT, "build/release/bin/isostat"))
    options = parser.parse_args()
    stages = [int(s) for s in options.stages.split(",")]
    samples = sorted(p for p in glob.glob(os.path.join(options.folder, options.row + ".[0-9]*.h5"))
                     if ".stage" not in os.path.basename(p))
    print("| from stage | to | samples | lost | gained | non-affine rms | over affine | in rigid regions | mean size |")
    print("|" + " --- |" * 9)
    for before, after in zip(stages, stages[1:]):
        columns = [[] for _ in range(6)]
        for sample in samples:
            states = [sample.replace(".h5", f".stage{k}.h5") for k in (before, after)]
            states = [s if os.path.exists(s) else sample for s in states]
            r = json.loads(subprocess.run([options.program, "compare", *states, "--json", "-"], check=True,
                                          capture_output=True, text=True).stdout)
            values = (r["contacts"]["lost"] / r["contacts"]["before"], r["contacts"]["gained"] / r["contacts"]["before"],
                      r["displacement"]["nonaffine_rms"], r["displacement"]["nonaffine_over_affine"],
                      r["rigid_regions"]["share_of_grains"], r["rigid_regions"]["mean_size_weighted"])
            for column, value in zip(columns, values):
                if value is not None:
                    column.append(value)
        cells = [f"{statistics.mean(c):.3g} +- {statistics.stdev(c) / len(c) ** .5:.1g}" if len(c) > 1 else
                 f"{c[0]:.3g}" if c else "-" for c in columns]
        print(f"| {before} | {after} | {len(samples)} | " + " | ".join(cells) + " |")


if __name__ == "__main__":
    main()
