#!/usr/bin/env python3
"""Time and memory of every section of `analyze` on large packings: a dense state tiled K x K times, with its contacts and
forces. One process a section, CPU seconds and peak memory of the whole command, reading included (row `info`: reading alone).

    tests/bench/sections.py build/release/bin/isostat docs/measured/results/sections.csv [--tiles 3,9,27] [--only LIST] [--limit SECONDS]

A section over the limit of CPU seconds is stopped; its row then has the limit, and `ended` 0. The exponent is that of
seconds ~ grains^exponent from the size before. Without a limit the last size takes an hour, most of it in modes and dacf.
"""
import argparse
import csv
import json
import math
import os
import pathlib
import resource
import subprocess
import tempfile

ROOT = pathlib.Path(__file__).resolve().parents[2]
SECTIONS = ["info", "counts", "equilibrium", "stress", "forces", "percolation", "stressed", "two_contacts", "rigidity",
            "clusters", "loops", "stiffness", "moduli", "modes", "bases", "pores", "scattering", "dacf"]


def rows_of(path):
    with open(path) as file:
        return list(csv.DictReader(file))


def tile(stem, cell, k, target):
    """K x K copies of STEM.grains.csv and STEM.contacts.csv beside each other, as TARGET.grains.csv and .contacts.csv."""
    grains, contacts = rows_of(f"{stem}.grains.csv"), rows_of(f"{stem}.contacts.csv")
    place = {g["id"]: n for n, g in enumerate(grains)}
    with open(f"{target}.grains.csv", "w") as file:
        file.write("id,x,y,r\n")
        for a in range(k):
            for b in range(k):
                for n, g in enumerate(grains):
                    x, y = float(g["x"]) + a * cell[0], float(g["y"]) + b * cell[1]
                    file.write(f"{(a * k + b) * len(grains) + n},{x:.17g},{y:.17g},{g['r']}\n")
    with open(f"{target}.contacts.csv", "w") as file:
        file.write("i,j,s1,s2,kind,h,N,T,M\n")
        for a in range(k):
            for b in range(k):
                for c in contacts:
                    to = (a + int(c["s1"]), b + int(c["s2"]))
                    i = (a * k + b) * len(grains) + place[c["i"]]
                    j = (to[0] % k * k + to[1] % k) * len(grains) + place[c["j"]]
                    end = ",".join(c[key] for key in ("kind", "h", "N", "T", "M"))
                    file.write(f"{i},{j},{to[0] // k},{to[1] // k},{end}\n")
    return len(grains) * k * k


def measured(command, limit):
    """(ended, CPU seconds, peak MB); a command over the limit is stopped by the system."""
    def bound():
        if limit:
            resource.setrlimit(resource.RLIMIT_CPU, (limit, limit + 5))
    child = subprocess.Popen(command, stdout=subprocess.DEVNULL, stderr=subprocess.PIPE, preexec_fn=bound)
    message = child.stderr.read()
    _, status, usage = os.wait4(child.pid, 0)
    child.returncode = 0
    seconds = usage.ru_utime + usage.ru_stime
    if status and not (limit and seconds > 0.95 * limit):
        raise SystemExit(f"{' '.join(command)}: {message.decode()}")
    return int(status == 0), seconds, usage.ru_maxrss / 1024


def main():
    arguments = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    arguments.add_argument("program")
    arguments.add_argument("output")
    arguments.add_argument("--tiles", default="3,9,27")
    arguments.add_argument("--only", default=",".join(SECTIONS))
    arguments.add_argument("--limit", type=int, default=0)
    given = arguments.parse_args()
    os.environ.setdefault("OMP_NUM_THREADS", "1")
    rows, before = [], {}
    with tempfile.TemporaryDirectory() as folder:
        state, stem = f"{folder}/state.h5", f"{folder}/state"
        subprocess.run([given.program, "pack", str(ROOT / "data/scenes/disks-method1.toml"), "-o", state], check=True,
                       stderr=subprocess.DEVNULL)
        subprocess.run([given.program, "convert", state, "-o", f"{stem}.csv"], check=True)
        network = subprocess.run([given.program, "info", state], check=True, capture_output=True, text=True).stdout
        cell = json.loads(network)["cell"]
        for k in map(int, given.tiles.split(",")):
            grains = tile(stem, cell, k, f"{folder}/tiled")
            tiled = f"{folder}/tiled.h5"
            subprocess.run([given.program, "convert", f"{folder}/tiled.csv", "--box",
                            ",".join(f"{k * edge:.17g}" for edge in cell), "-o", tiled], check=True)
            for section in given.only.split(","):
                command = [given.program, "info", tiled] if section == "info" else [
                    given.program, "analyze", tiled, "--only", section, "--json", f"{folder}/report.json"]
                ended, seconds, memory = measured(command, given.limit)
                exponent = ""
                if ended and section in before:
                    n, s = before[section]
                    exponent = f"{math.log(seconds / s) / math.log(grains / n):.2f}"
                if ended:
                    before[section] = (grains, seconds)
                rows.append((section, grains, ended, f"{seconds:.3g}", f"{memory:.0f}", exponent))
                print(*rows[-1], flush=True)
    with open(given.output, "w") as file:
        csv.writer(file, lineterminator="\n").writerows(
            [("section", "grains", "ended", "cpu_seconds", "peak_MB", "exponent"), *rows])


if __name__ == "__main__":
    main()
