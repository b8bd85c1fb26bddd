#!/usr/bin/env python3
"""What loading costs and how far it is from quasi-static: compression, biaxial and tensile tests of the same samples by
protocols of different rate, step, cell and method (docs/measured/loading.md).

Load paths begin with an aggregate at P* = 0 (method 2), the other tests with a packing of method 1 at P* = .01; each seed is
made once and all protocols start from its file. Writes every sample to docs/measured/results/quasistatic.csv, errors beside run
times to quasistatic_TEST.csv, and prints means.
    quasistatic.py [--program build/release/bin/isostat] [--grains 400] [--seeds 4] [--jobs 1] [--only TEXT]
                   [--folder out/quasistatic]
With --only, the protocols whose name holds the text are run and replace their rows in the table.
"""
import argparse
import concurrent.futures
import csv
import json
import os
import statistics
import subprocess

HERE = os.path.dirname(os.path.abspath(__file__))
ROOT = os.path.abspath(os.path.join(HERE, "..", ".."))
OUTPUT = os.path.join(ROOT, "docs", "measured", "results", "quasistatic.csv")
MARKS = (0.01, 0.1, 1.0)            # P* of the load path
STEPS = (0.01, 0.03, 0.1, 0.3, 1.0)
STRAINS = (0.005, 0.01, 0.02, 0.04)  # of the biaxial test
KEYS = ("Phi_0.01", "Phi_0.1", "Phi_1", "z_0.01", "z_0.1", "z_1") + tuple(f"deviator_{e:g}" for e in STRAINS) + (
    "peak", "lateral_rms", "inertial_number", "stress_error")
HEADER = ("test", "protocol", "seed", "cpu_seconds", "exit") + KEYS

MATERIAL = """[grains]
{grains}
[law]
normal_stiffness = 1e5
[step]
fraction = 0.12
[finish]
method = "newton"
{finish}
[cell]
{cell}
[output]
stages = true
{output}
"""


def decades(steps):
    """P* from .001 to 1, so many steps a decade."""
    return [float(f"{10 ** (-3 + k / steps):.6g}") for k in range(3 * steps + 1)]


class Protocol:
    """How a test is run: rate [1/T0] is the cap of a load path and the strain rate of the other tests."""

    def __init__(self, test, name, rate, pressures=MARKS, ramp=0, cell="", increment=0):
        self.test, self.name, self.rate, self.ramp, self.cell = test, name, rate, ramp, cell
        self.pressures, self.increment = pressures, increment
        self.finish = "quiet_time = 0\n" if increment or len(pressures) > len(STEPS) else ""

    def scene(self, start, series):
        text = MATERIAL.format(grains=f'file = "{start}"', finish=self.finish, cell=self.cell,
                               output="" if self.increment or self.test == "path" else
                               f'series = "{series}"\nseries_interval = 0.5')
        ramp = f"ramp_time = {self.ramp}\n" if self.ramp else ""
        if self.test == "path":
            return text + f"[[stage]]\npressures = {list(self.pressures)}\nmax_strain_rate = {self.rate}\n{ramp}"
        sign, lateral, strain = (1, 0.01, 0.041) if self.test == "biaxial" else (-1, 0.0, 0.03)
        if not self.increment:
            return text + (f"[[stage]]\nstrain_rate_1 = {sign * self.rate}\nstress_2 = {lateral}\n{ramp}"
                           f'until = "strain"\nstrain = {strain}\n')
        step = (f"[[stage]]\nstrain_rate_1 = {sign * self.rate}\nstress_2 = {lateral}\n{ramp}until = \"strain\"\n"
                f"strain = {self.increment}\n"
                f"[[stage]]\nstrain_rate_1 = 0.0\nstress_2 = {lateral}\n{ramp}max_time = 400\n")
        return text + step * round(strain / self.increment)


PAPER, LIGHT = "inertia = 0.3", "inertia = 0.003\ndamping = 3.0"
PROTOCOLS = [
    *(Protocol("path", f"paper's cell, cap {rate:g}", rate, cell=PAPER) for rate in (0.05, 8e-4)),
    *(Protocol("path", f"damped cell, cap {rate:g}", rate, cell=LIGHT) for rate in (0.05, 4e-3, 8e-4, 1.6e-4)),
    Protocol("path", "damped cell, ramp 20, cap 0.0008", 8e-4, ramp=20, cell=LIGHT),
    *(Protocol("path", f"damped cell, 5 ramps of 50, cap {rate:g}", rate, STEPS, ramp=50, cell=LIGHT)
      for rate in (8e-4, 4e-4)),
    Protocol("path", "damped cell, 5 ramps of 250, cap 8e-05", 8e-5, STEPS, ramp=250, cell=LIGHT),
    *(Protocol("path", f"damped cell, 8 static steps a decade, cap {rate:g}", rate, decades(8), cell=LIGHT)
      for rate in (0.05, 8e-4)),
    *(Protocol(test, f"paper's cell, at once, rate {rate:g}", rate, cell=PAPER)
      for test in ("biaxial", "tension") for rate in (1e-3, 2e-4)),
    *(Protocol(test, f"damped cell, ramp 20, rate {rate:g}", rate, ramp=20, cell=LIGHT)
      for test in ("biaxial", "tension") for rate in (1e-3, 2e-4, 4e-5)),
    *(Protocol(test, "static steps of 0.001 at once", 1e-3, cell=LIGHT, increment=1e-3)
      for test in ("biaxial", "tension")),
    *(Protocol(test, "static steps of 0.001 by ramps of 2", 2e-4, ramp=2, cell=LIGHT, increment=1e-3)
      for test in ("biaxial", "tension")),
]


class Bench:
    def __init__(self, options):
        self.program, self.grains, self.folder = os.path.abspath(options.program), options.grains, options.folder
        os.makedirs(self.folder, exist_ok=True)

    def pack(self, text, output, *words):
        """Exit code (3 is a result) and CPU seconds."""
        scene = output.replace(".h5", ".toml")
        with open(scene, "w") as out:
            out.write(text)
        process = subprocess.Popen([self.program, "pack", scene, "-o", output, "--force", *words],
                                   stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
        _, status, usage = os.wait4(process.pid, 0)
        code = os.waitstatus_to_exitcode(status)
        if code not in (0, 3):
            raise RuntimeError(f"pack {scene} ended with {code}")
        return code, usage.ru_utime

    def start(self, test, seed):
        """The sample that a test begins with; made once."""
        name = os.path.join(self.folder, f"{'aggregate' if test == 'path' else 'method1'}.{self.grains}.{seed}.h5")
        if os.path.exists(name):
            return name
        stages = ('[[stage]]\nvelocity = 9.48\nuntil = "aggregated"\n[[stage]]\npressure = 0.0\nmax_strain_rate = 1e-3\n'
                  if test == "path" else "[[stage]]\npressure = 0.01\n")
        grains = f"count = {self.grains}\nsolid_fraction = 0.36"
        code, _ = self.pack(MATERIAL.format(grains=grains, finish="", cell="inertia = 1.0", output="") + stages, name,
                            "--seed", str(seed))
        if code != 0:
            raise RuntimeError(f"{name} is not in equilibrium")
        return name

    def report(self, state):
        text = subprocess.run([self.program, "analyze", state, "--only", "counts,equilibrium,stress", "--json", "-"],
                              check=True, capture_output=True, text=True).stdout
        return json.loads(text)

    def sample(self, protocol, seed):
        start = self.start(protocol.test, seed)
        output = os.path.join(self.folder, f"{protocol.test}.{abs(hash(protocol.name))}.{seed}.h5")
        series = output.replace(".h5", ".csv")
        code, seconds = self.pack(protocol.scene(start, series), output)
        states = [output.replace(".h5", f".stage{k}.h5") for k in range(1000)]
        states = [s for s in states if os.path.exists(s)] + [output]
        result = dict.fromkeys(KEYS, "")
        if protocol.test == "path":
            self.path(protocol, states, result)
        elif protocol.increment:
            self.increments(protocol, start, states[1::2], result)
        else:
            self.curve(protocol, series, result)
        reports = [self.report(s)["equilibrium"] for s in states] if not protocol.increment else []
        for key in ("inertial_number", "stress_error"):
            result[key] = max((r[key] for r in reports if r.get(key) is not None), default="")
        for path in states + [series, output.replace(".h5", ".toml")]:
            if os.path.exists(path):
                os.unlink(path)
        return (protocol.test, protocol.name, seed, seconds, code, *(result[k] for k in KEYS))

    def path(self, protocol, states, result):
        for pressure, state in zip(protocol.pressures, states):
            if pressure in MARKS:
                counts = self.report(state)["counts"]
                result[f"Phi_{pressure:g}"], result[f"z_{pressure:g}"] = counts["solid_fraction"], counts["z"]

    def increments(self, protocol, start, states, result):
        lateral = 0.01 if protocol.test == "biaxial" else 0.0
        before = self.length(start)
        curve = [(abs(1 - self.length(s) / before), abs(self.report(s)["stress"]["tensor"][0][0] - lateral)) for s in states]
        self.marks(protocol, curve, result)

    def length(self, state):
        text = subprocess.run([self.program, "info", state], check=True, capture_output=True, text=True).stdout
        return json.loads(text)["cell"][0]

    def curve(self, protocol, series, result):
        """The deviator, a mean over 10 T0 or 1e-3 of strain, whichever is longer, and the rms of the lateral stress."""
        with open(series) as table:
            rows = [{k: float(v) for k, v in row.items()} for row in csv.DictReader(table)]
        width = max(10.0, 1e-3 / protocol.rate) / 0.5
        curve, n = [], len(rows)
        for k in range(n):
            part = rows[max(0, int(k - width / 2)):int(k + width / 2) + 1]
            curve.append((abs(rows[k]["strain1"]), abs(statistics.fmean(r["sigma11"] - r["imposed22"] for r in part))))
        self.marks(protocol, curve, result)
        late = [r for r in rows if r["t"] > protocol.ramp]
        result["lateral_rms"] = statistics.fmean((r["sigma22"] - r["imposed22"]) ** 2 for r in late) ** 0.5

    def marks(self, protocol, curve, result):
        result["peak"] = max(q for _, q in curve)
        if protocol.test == "biaxial":
            for strain in STRAINS:
                result[f"deviator_{strain:g}"] = min(curve, key=lambda point: abs(point[0] - strain))[1]


def mean(rows, key):
    values = [float(r[HEADER.index(key)]) for r in rows if r[HEADER.index(key)] != ""]
    if not values:
        return None
    return statistics.fmean(values), statistics.stdev(values) if len(values) > 1 else 0.0


def summary(rows):
    for test, name in dict.fromkeys((r[0], r[1]) for r in rows):
        mine = [r for r in rows if (r[0], r[1]) == (test, name)]
        told = ((key, mean(mine, key)) for key in ("cpu_seconds",) + KEYS)
        print(f"{test}: {name}: ", "  ".join(f"{key} {m[0]:.4g} ({m[1]:.2g})" for key, m in told if m), flush=True)


REFERENCES = {"path": "damped cell, cap 0.00016", "biaxial": "damped cell, ramp 20, rate 4e-05",
              "tension": "damped cell, ramp 20, rate 4e-05"}
ERRORS = {"path": ("Phi_0.1", "Phi_1"), "biaxial": ("deviator_0.02", "peak"), "tension": ("peak",)}


def precision(rows):
    """Of each test a table: error of a protocol, the mean over the seeds of |difference to the reference| of the same
    seed, beside its run time."""
    for test, reference in REFERENCES.items():
        value = {(r[1], int(r[2]), key): r[HEADER.index(key)] for r in rows if r[0] == test for key in ERRORS[test]}
        lines = []
        for name in dict.fromkeys(r[1] for r in rows if r[0] == test):
            seeds = [int(r[2]) for r in rows if r[0] == test and r[1] == name]
            if name == reference or any((reference, seed, key) not in value for seed in seeds for key in ERRORS[test]):
                continue
            seconds = statistics.fmean(float(r[3]) for r in rows if r[0] == test and r[1] == name)
            errors = [statistics.fmean(abs(float(value[name, seed, key]) - float(value[reference, seed, key]))
                                       for seed in seeds) for key in ERRORS[test]]
            lines.append((name.split(", cap")[0].split(", rate")[0], seconds, *errors))
        with open(OUTPUT.replace(".csv", f"_{test}.csv"), "w", newline="") as out:
            writer = csv.writer(out, lineterminator="\n")
            writer.writerow(("method", "cpu_seconds") + tuple("error_" + key for key in ERRORS[test]))
            writer.writerows([line[0]] + [f"{x:.4g}" for x in line[1:]] for line in lines)


def main():
    parser = argparse.ArgumentParser()
    parser.add_argument("--program", default=os.path.join(ROOT, "build/release/bin/isostat"))
    parser.add_argument("--grains", type=int, default=400)
    parser.add_argument("--seeds", type=int, default=4)
    parser.add_argument("--jobs", type=int, default=1)
    parser.add_argument("--only", default="")
    parser.add_argument("--folder", default=os.path.join(ROOT, "out", "quasistatic"))
    options = parser.parse_args()
    bench = Bench(options)
    wanted = [p for p in PROTOCOLS if options.only in f"{p.test}: {p.name}"]
    names = {(p.test, p.name) for p in wanted}
    kept = []
    if os.path.exists(OUTPUT):
        with open(OUTPUT) as table:
            kept = [tuple(row) for row in list(csv.reader(table))[1:] if (row[0], row[1]) not in names]
    rows = []
    with concurrent.futures.ThreadPoolExecutor(options.jobs) as pool:
        work = [pool.submit(bench.sample, p, seed) for p in wanted for seed in range(1, options.seeds + 1)]
        for done in work:
            rows.append(done.result())
            with open(OUTPUT, "w", newline="") as out:  # as far as it is
                writer = csv.writer(out, lineterminator="\n")
                writer.writerow(HEADER)
                writer.writerows([f"{x:.6g}" if isinstance(x, float) else x for x in row] for row in kept + rows)
    summary(rows)
    precision(kept + rows)


if __name__ == "__main__":
    main()
