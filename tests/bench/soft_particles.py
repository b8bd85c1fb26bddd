#!/usr/bin/env python3
"""The constitutive laws of soft-particles, measured: the tables of docs/measured/spheres.md.

    soft_particles.py OUT [--program build/release/bin/isostat] [-j 2] [--only table1,table2,...]
                          [--results docs/measured/results]

Runs `isostat lab soft-particle` for every case below, keeps its JSON, raw forces and CPU time in OUT and skips what is
there; then writes soft_*.csv of the cases that are. About 20 minutes on two cores, most of it the paper's protocol.
Errors: "mean" is a mean over packings of F - F_ref of the same packing, "rms" the root mean square, "se" the standard
error of a mean. CPU seconds are of one curve, its packing included.
"""
import argparse
import concurrent.futures
import csv
import json
import math
import os
import shutil
import statistics
import subprocess
import time

ROOT = os.path.abspath(os.path.join(os.path.dirname(os.path.abspath(__file__)), "..", ".."))
WALL, SOFT = "0.05,0.1,0.15,0.2,0.25,0.3", "0.05,0.1,0.15,0.2,0.25,0.3,0.35"
NINE = "0.05,0.08125,0.1125,0.14375,0.175,0.20625,0.2375,0.26875,0.3"
PAPER = {"wall": (73.669, 2.799, -0.035, 0.065), "soft": (28.512, 5.003, -0.002, 0.148)}
PAPER_SLOPE = {"wall": (0.740, 2.100, -0.0024, 0.065), "soft": (0.982, 4.422, -0.00021, 0.148)}
SEVEN, SOME, MANY = 7, 14, 28
SLOW = ["--speed", "0.0015625", "--step", "2", "--stops", "3"]  # the reference: half the speed, a smaller step, more waits


def case(partner, protocol, delta, packings, *more):
    return ["--partner", partner, "--protocol", protocol, "--delta", delta, "--packings", str(packings), *more]


def packings_of(protocol):
    return SEVEN if protocol == "paper" else MANY


CASES = {}  # table: {name: arguments}
CASES["table1"] = {f"{partner}-{protocol}": case(partner, protocol, delta, packings_of(protocol))
                   for partner, delta in (("wall", WALL), ("soft", SOFT))
                   for protocol in ("fire", "quasistatic", "paper")}
CASES["table1"]["soft-fire-0.4"] = case("soft", "fire", SOFT + ",0.4", MANY)
CASES["table2"] = {f"{partner}-{protocol}": case(partner, protocol, delta, n, "--alpha=-4,4")
                   for partner, delta, protocol, n in (("wall", WALL, "fire", MANY), ("soft", SOFT, "fire", MANY),
                                                       ("wall", WALL, "quasistatic", MANY),
                                                       ("soft", "0.15,0.2,0.25,0.3,0.35", "quasistatic", SOME))}
CASES["table2"]["wall-paper"] = case("wall", "paper", "0.1,0.2,0.3", SEVEN, "--alpha=-4,4")
CASES["range"] = {f"{partner}-fire": case(partner, "fire", delta, n, "--alpha=-4,-2,-1,-0.3,0.3,1,2,4")
                  for partner, delta, n in (("wall", "0.1,0.2,0.3", MANY), ("soft", "0.2,0.3", SOME))}
CASES["prestrain"] = {"wall-fire": case("wall", "fire", "0.2,0.3", 112, "--alpha=4")}
CASES["friction"] = {f"{partner}-fire": case(partner, "fire", delta, SOME, "--alpha=2,5,10,15,20,30")
                     for partner, delta in (("wall", "0.1,0.2,0.3"), ("soft", "0.2,0.3"))}
CASES["scaling"] = {}
for r in (0.004, 0.008, 0.016, 0.032):
    CASES["scaling"][f"all-{r}"] = case("wall", "fire", "0.1,0.2,0.3", SEVEN, "--radius", str(r))
for r in (0.012, 0.016, 0.024, 0.032):
    CASES["scaling"][f"grains-{r}"] = case("wall", "fire", "0.1,0.2,0.3", 14, "--radius", str(r), "--largest",
                                           f"{0.008 / r:.6g}", "--solid-fraction", "0.715")
SENSITIVE = {
    "fire": [(), ("--largest", "0.35"), ("--largest", "0.6"), ("--ratio", "5"), ("--ratio", "15"), ("--exponent", "3"),
             ("--exponent", "4"), ("--volume-factor", "2"), ("--volume-factor", "4"), ("--trials", "3000"),
             ("--trials", "300000"), ("--solid-fraction", "0.65"), ("--solid-fraction", "0.7"),
             ("--solid-fraction", "0.73"), ("--friction", "0"), ("--friction", "0.1"), ("--friction", "0.5"),
             ("--shell-friction", "0"), ("--modulus", "1e6"), ("--density", "250"), ("--damping", "0.1"),
             ("--step", "1"), ("--step", "4"), ("--speed", "0.0125"), ("--speed", "0.2")],
    "quasistatic": [(), ("--damping", "0.1"), ("--damping", "0.7"), ("--speed", "0.0125"), ("--speed", "0.05"),
                    ("--stops", "0"), ("--stops", "3"), ("--wait", "0.06")],
    "paper": [(), ("--stops", "1"), ("--wait", "0.1"), ("--speed", "0.0125"), ("--speed", "0.2")],
}
CASES["sensitivity"] = {f"{protocol}{'.'.join(('', *more))}": case("wall", protocol, WALL, SEVEN if protocol == "paper" else
                                                              SOME, *more)
                        for protocol, trials in SENSITIVE.items() for more in trials}
PRECISE = {
    "fire": [(), ("--step", "2"), ("--step", "1"), ("--speed", "0.2"), ("--speed", "0.0125")],
    "quasistatic": [(), ("--speed", "0.0125"), ("--speed", "0.05"), ("--wait", "0.005"), ("--step", "2")],
    "paper": [(), ("--wait", "0.1"), ("--wait", "0.02"), ("--stops", "1"), ("--step", "3")],
}
CASES["precision"] = {}
for what, partner, delta, n, more in (("normal", "wall", WALL, SOME, []), ("soft", "soft", SOFT, SOME, []),
                                      ("tangential", "wall", "0.1,0.2,0.3", SOME, ["--alpha=-4,4"])):
    CASES["precision"][f"{what}-reference"] = case(partner, "quasistatic", delta, n, *SLOW, *more)
    for protocol, trials in PRECISE.items():
        if protocol == "paper" and what != "normal":
            continue
        for trial in trials if what != "tangential" else trials[:3]:
            CASES["precision"][f"{what}-{protocol}{'.'.join(('', *trial))}"] = case(
                partner, protocol, delta, min(n, packings_of(protocol)), *trial, *more)
CASES["time"] = {protocol: case("wall", protocol, NINE, SEVEN) for protocol in ("fire", "quasistatic", "paper")}
CASES["time"]["generator"] = case("wall", "fire", "0.001", SEVEN)
CASES["time"]["solid"] = case("none", "fire", "0.1,0.2,0.3", 1)


class Bench:
    def __init__(self, options):
        self.out, self.program, self.results = options.out, options.program, options.results
        os.makedirs(self.out, exist_ok=True)
        os.makedirs(self.results, exist_ok=True)

    def stem(self, table, name):
        return os.path.join(self.out, f"{table}_{name.replace('.--', '~')}")

    def run(self, table, name):
        stem, threads = self.stem(table, name), "2" if table == "time" else "1"
        if os.path.exists(stem + ".time.json"):
            return
        twin = next((self.stem(t, n) for t in CASES if t != "time" for n in CASES[t]
                     if table != "time" and CASES[t][n] == CASES[table][name] and self.has(t, n)), None)
        if twin:
            for end in (".csv", ".json", ".time.json"):
                shutil.copy(twin + end, stem + end)
            return
        command = [self.program, "lab", "soft-particle", *CASES[table][name], "--threads", threads, "--raw", stem + ".csv",
                   "--json", stem + ".json"]
        start = time.monotonic()
        process = subprocess.Popen(command, stdout=subprocess.DEVNULL, stderr=subprocess.PIPE, text=True)
        said = process.stderr.read()
        _, status, usage = os.wait4(process.pid, 0)
        process.returncode = status
        if status:
            print(f"{table} {name} failed: {said}", flush=True)
            return
        with open(stem + ".time.json", "w") as file:
            json.dump({"cpu": usage.ru_utime + usage.ru_stime, "wall": time.monotonic() - start}, file)
        print(f"{table} {name}: {usage.ru_utime:.1f} CPU s, {time.monotonic() - start:.1f} s", flush=True)

    def has(self, table, name):
        return os.path.exists(self.stem(table, name) + ".time.json")

    def json(self, table, name):
        with open(self.stem(table, name) + ".json") as file:
            return json.load(file)

    def time(self, table, name):
        with open(self.stem(table, name) + ".time.json") as file:
            return json.load(file)

    def forces(self, table, name):
        """[(seed, delta, alpha, normal, along, perpendicular)]"""
        with open(self.stem(table, name) + ".csv") as file:
            return [tuple(float(x) if x else math.nan for x in row) for row in list(csv.reader(file))[1:]]

    def normal(self, table, name):
        """{delta: {seed: F}} of the states before any rotation."""
        found = {}
        for seed, delta, alpha, f, _, _ in self.forces(table, name):
            if alpha == 0:
                found.setdefault(delta, {})[seed] = f
        return found

    def cpu_per_curve(self, table, name):
        return self.time(table, name)["cpu"] / self.json(table, name)["packings"]

    def write(self, name, header, rows):
        if not rows:
            return
        path = os.path.join(self.results, f"soft_{name}.csv")
        with open(path, "w", newline="") as file:
            writer = csv.writer(file, lineterminator="\n")
            writer.writerow(header)
            writer.writerows([[f"{v:.4g}" if isinstance(v, float) else v for v in row] for row in rows])
        print(f"\n{path}\n" + ",".join(header))
        for row in rows:
            print(*(f"{v:.4g}" if isinstance(v, float) else v for v in row), sep="  ")


def se(values):
    return statistics.stdev(values) / math.sqrt(len(values)) if len(values) > 1 else math.nan


def slopes(rows, reach):
    """{delta: [(along, perpendicular) of each packing]}: least-squares lines through the angles within reach."""
    groups = {}
    for seed, delta, alpha, _, along, across in rows:
        if abs(alpha) <= reach:
            groups.setdefault(delta, {}).setdefault(seed, []).append((alpha, along, across))
    found = {}
    for delta, packings in groups.items():
        for points in packings.values():
            x = [p[0] for p in points]
            found.setdefault(delta, []).append(tuple(
                statistics.linear_regression(x, [p[k] for p in points]).slope for k in (1, 2)))
    return found


def table1(b):
    rows = []
    for name in CASES["table1"]:
        if not b.has("table1", name):
            continue
        r = b.json("table1", name)
        f, points = r["fit"], {round(p["delta"], 4): p for p in r["normal"]}
        row = [name.split("-")[0], name.partition("-")[2], r["packings"]]
        for key in ("a", "b", "c", "delta"):
            row += [f[key], f[key + "_error"]]
        for delta in (0.1, 0.15, 0.2, 0.25, 0.3, 0.35):
            row += [points[delta]["F"], points[delta]["F_error"]] if delta in points else ["", ""]
        rows.append(row + [r["density"], r["grains"], r["exponent"], max(p["largest_overlap"] for p in r["normal"]),
                           b.cpu_per_curve("table1", name)])
    rows += [[partner, "printed", "7", *(x for v in PAPER[partner] for x in (v, ""))] + [""] * 17 for partner in PAPER]
    for row in rows[-2:]:
        a, power, c, delta = PAPER[row[0]]
        row[11:23] = [x for d in (0.1, 0.15, 0.2, 0.25, 0.3, 0.35)
                      for x in (a * d**power + c if d > delta else 0.0, "")]
    header = ["partner", "protocol", "packings"] + [x for k in ("a", "b", "c", "delta") for x in (k, k + "_error")]
    header += [x for d in (0.1, 0.15, 0.2, 0.25, 0.3, 0.35) for x in (f"F({d})", f"F({d})_error")]
    b.write("table1", header + ["density", "grains", "exponent", "largest_overlap", "cpu_seconds_per_curve"], rows)
    rows = []
    for partner in ("wall", "soft"):
        names = [f"{partner}-paper", f"{partner}-quasistatic", f"{partner}-fire"]
        if not all(b.has("table1", n) for n in names):
            continue
        paper, slow, fire = (b.normal("table1", n) for n in names)
        for delta in slow:
            sd = statistics.stdev(slow[delta].values())
            for what, one in (("paper", paper), ("fire", fire)):
                d = [one[delta][s] - slow[delta][s] for s in one[delta]]
                rows.append([partner, what, delta, sd, statistics.mean(d), se(d),
                             math.sqrt(statistics.mean(x * x for x in d)), statistics.mean(d) / sd if sd else math.nan])
    b.write("protocols", ["partner", "protocol", "delta", "scatter", "mean", "se", "rms", "mean_over_scatter"], rows)


def table2(b):
    rows, fits = [], []
    for name in CASES["table2"]:
        if not b.has("table2", name):
            continue
        partner, protocol = name.split("-")
        r, raw = b.json("table2", name), b.forces("table2", name)
        by_delta = slopes(raw, 4)
        for p in r["tangential"]:
            both = by_delta[p["delta"]]
            side = [s[1] for s in both]
            rows.append([partner, protocol, r["packings"], p["delta"], p["k_t"], p["k_t_error"], statistics.mean(side),
                         se(side), b.cpu_per_curve("table2", name)])
        f = r["tangential_fit"]
        fits.append([partner, protocol, r["packings"]] + [x if x is not None else math.nan for k in ("a", "b", "c", "delta")
                                                          for x in (f[k], f[k + "_error"])])
    fits += [[partner, "printed", 7, *(x for v in PAPER_SLOPE[partner] for x in (v, ""))] for partner in PAPER_SLOPE]
    b.write("slopes", ["partner", "protocol", "packings", "delta", "k_t", "k_t_error", "perpendicular",
                       "perpendicular_error", "cpu_seconds_per_curve"], rows)
    b.write("table2", ["partner", "protocol", "packings"] + [x for k in ("a", "b", "c", "delta") for x in (k, k + "_error")],
            fits)
    rows = []
    for name in CASES["range"]:
        if b.has("range", name):
            for reach in (0.3, 1, 2, 4):
                for delta, found in slopes(b.forces("range", name), reach).items():
                    along = [s[0] for s in found]
                    rows.append([name.split("-")[0], delta, reach, statistics.mean(along), se(along)])
    b.write("range", ["partner", "delta", "alpha_range", "k_t", "k_t_error"], rows)


def prestrain(b):
    if not b.has("prestrain", "wall-fire"):
        return
    rows = []
    for delta in (0.2, 0.3):
        values = [(r[4], r[5]) for r in b.forces("prestrain", "wall-fire") if r[1] == delta and r[2] == 0]
        for n in (1, 2, 4, 7, 14, 28):
            means = [statistics.mean(v[k] for v in values[i:i + n]) for i in range(0, len(values) - n + 1, n) for k in (0, 1)]
            rows.append([delta, n, math.sqrt(statistics.mean(m * m for m in means)),
                         math.sqrt(n) * math.sqrt(statistics.mean(m * m for m in means))])
        for k in (0, 1):
            v = [x[k] for x in values]
            print(f"prestrain Delta {delta} component {k}: mean {statistics.mean(v):.4f} +- {se(v):.4f} N of {len(v)}")
    b.write("prestrain", ["delta", "packings", "rms_of_means", "times_root_packings"], rows)


def friction(b):
    rows = []
    for name in CASES["friction"]:
        if not b.has("friction", name):
            continue
        groups = {}
        for _, delta, alpha, normal, along, _ in b.forces("friction", name):
            groups.setdefault((delta, alpha), []).append((normal, along))
        for (delta, alpha), found in groups.items():
            n, t = statistics.mean(f[0] for f in found), statistics.mean(f[1] for f in found)
            if alpha == 0 or not n > 0:
                continue
            rest = [f[1] - t / n * f[0] for f in found]  # of the ratio of two means
            rows.append([*name.split("-"), len(found), delta, alpha, n, t, t / n, se(rest) / n])
    b.write("friction", ["partner", "protocol", "packings", "delta", "alpha", "F_n", "F_t", "ratio", "ratio_error"], rows)


def scaling(b):
    rows = []
    for name in CASES["scaling"]:
        if b.has("scaling", name):
            what, radius = name.split("-")
            r = b.json("scaling", name)
            rows.append([what, float(radius), r["packings"], r["grains"], r["density"]] +
                        [x for p in r["normal"] for x in (p["F"] / float(radius)**2, (p["F_error"] or 0) / float(radius)**2)] +
                        [b.cpu_per_curve("scaling", name)])
    b.write("scaling", ["fixed", "R_s", "packings", "grains", "density"] +
            [x for d in (0.1, 0.2, 0.3) for x in (f"F/R_s^2({d})", "error")] + ["cpu_seconds_per_curve"], rows)


def sensitivity(b):
    rows = []
    for protocol, trials in SENSITIVE.items():
        for more in trials:
            name = f"{protocol}{'.'.join(('', *more))}"
            if b.has("sensitivity", name):
                r = b.json("sensitivity", name)
                points = {round(p["delta"], 4): p for p in r["normal"]}
                rows.append([protocol, " ".join(more).removeprefix("--") or "default", r["packings"], r["density"], r["grains"]] +
                            [x for d in (0.1, 0.2, 0.3) for x in (points[d]["F"], points[d]["F_error"])] +
                            [r["fit"]["a"] or math.nan, r["fit"]["b"] or math.nan, r["fit"]["delta"] or math.nan])
    b.write("sensitivity", ["protocol", "changed", "packings", "density", "grains"] +
            [x for d in (0.1, 0.2, 0.3) for x in (f"F({d})", "error")] + ["a", "b", "delta"], rows)


def precision(b):
    rows = []
    for name in CASES["precision"]:
        what, _, setting = name.partition("-")
        if setting == "reference" or not b.has("precision", name) or not b.has("precision", f"{what}-reference"):
            continue
        if what == "tangential":
            read = lambda n: {d: dict(enumerate(s[0] for s in found)) for d, found in
                              slopes(b.forces("precision", n), 4).items()}
        else:
            read = lambda n: b.normal("precision", n)
        reference, mine = read(f"{what}-reference"), read(name)
        row = [what, setting.replace(".--", " ").replace(".", " ", 1) if ".--" in setting else setting,
               b.json("precision", name)["packings"], b.cpu_per_curve("precision", name)]
        for delta in ((0.2, 0.3, 0.35) if what == "soft" else (0.1, 0.2, 0.3)):
            sd = statistics.stdev(reference[delta].values())
            d = [mine[delta][s] - reference[delta][s] for s in mine[delta]]
            row += [delta, statistics.mean(d), se(d), math.sqrt(statistics.mean(x * x for x in d)), sd]
        rows.append(row)
    b.write("precision", ["what", "setting", "packings", "cpu_seconds_per_curve"] +
            [f"{k}_{n}" for n in (1, 2, 3) for k in ("delta", "mean", "se", "rms", "scatter")], rows)
    for what in ("normal", "soft", "tangential"):
        if b.has("precision", f"{what}-reference"):
            print(f"{what} reference: {b.cpu_per_curve('precision', f'{what}-reference'):.2f} CPU s a curve")


def times(b):
    rows = [[name, t["cpu"], t["wall"]] for name in CASES["time"] if b.has("time", name)
            for t in [b.time("time", name)]]
    b.write("time", ["protocol", "cpu_seconds_of_seven_curves", "wall_seconds_on_two_threads"], rows)


if __name__ == "__main__":
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("out")
    parser.add_argument("--program", default=os.path.join(ROOT, "build/release/bin/isostat"))
    parser.add_argument("--results", default=os.path.join(ROOT, "docs/measured/results"))
    parser.add_argument("-j", type=int, default=2)
    parser.add_argument("--only", type=lambda text: text.split(","), default=list(CASES))
    parser.add_argument("--tables", action="store_true", help="run nothing, only write the tables of what is there")
    arguments = parser.parse_args()
    bench = Bench(arguments)
    if not arguments.tables:
        jobs = [(table, name) for table in arguments.only if table != "time" for name in CASES[table]]
        with concurrent.futures.ThreadPoolExecutor(arguments.j) as pool:
            list(pool.map(lambda job: bench.run(*job), jobs))
        if "time" in arguments.only:
            for case_name in CASES["time"]:
                bench.run("time", case_name)
    for table in (table1, table2, prestrain, friction, scaling, sensitivity, precision, times):
        table(bench)
