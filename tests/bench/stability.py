#!/usr/bin/env python3
"""Extreme scenes of method 2 (and of method 1 where it says so): each must end in certified equilibrium (0), in a named
non-convergence (3) or in a clear error (2), never in a NaN or a crash; and a long aggregation keeps momentum and energy.

    tests/bench/stability.py build/release/bin/isostat tests/bench/results/stability.csv [-j 2]
"""
import concurrent.futures
import csv
import json
import math
import pathlib
import subprocess
import sys
import tempfile

import h5py
import numpy as np

ROOT = pathlib.Path(__file__).resolve().parents[2]
SMALL = ["grains.count=150", "step.fraction=0.1"]
M2, M1 = "disks-method2-a", "disks-method1"
# The readings of the paper with which the results were measured.
READINGS = {M2: ["cell.inertia=0.3", 'stage.0.velocity_of="vector"', "stage.2.max_strain_rate=0.05",
                 "stage.2.max_edge_speed=1000.0"],
            M1: ["cell.inertia=0.3", "stage.0.max_strain_rate=0.05"]}
CASES = []


def case(name, *settings, scene=M2, base=SMALL):
    CASES.append((name, scene, [*base, *settings]))


for v0 in (0.01, 0.1, 1, 10, 100):
    case(f"V0 {v0} V*", f"stage.0.velocity={float(v0)}")
for kappa in ("1e2", "1e3", "1e4", "1e5", "1e6"):
    case(f"kappa {kappa}", f"law.normal_stiffness={kappa}")
for p in (0.0, 1e-3, 0.1, 1.0, 10.0, 100.0):
    case(f"P* {p:g}", f"stage.2.pressure={p}", "law.normal_stiffness=1e5")
for mu in (0.0, 0.05, 1.0, 2.0):
    for rolling in ("false", "true"):
        if mu or rolling == "false":
            case(f"mu {mu:g} rolling {rolling}", f"law.friction={mu}", f"law.rolling={rolling}")
for mu_r in (0.05, 0.5):
    case(f"mu_r {mu_r} a", f"law.rolling_friction={mu_r}")
for ratio in (10, 100):
    case(f"polydispersity {ratio}", f"grains.diameter_min={1 / ratio}", "step.fraction=0.01" if ratio == 10 else
         "step.fraction=0.0012", "stage.2.max_time=60.0", "stage.0.max_time=60.0", "stage.1.max_time=60.0")
case("one disk", "grains.count=1", "grains.solid_fraction=0.1")
case("two disks", "grains.count=2", "grains.solid_fraction=0.05")
case("equal disks", "grains.diameter_min=1.0")
case("equal disks, method 1, P* 10", "grains.diameter_min=1.0", "stage.0.pressure=10.0", scene=M1)
case("equal disks, no cohesion", "grains.diameter_min=1.0", scene="disks-method1-cohesionless")
case("no rate cap", "stage.2.max_strain_rate=0.0")
case("zeta 0.01", "law.damping=0.01")
case("zeta 1.5", "law.damping=1.5", "step.fraction=0.06")


def run(program, folder, number, name, scene, settings):
    state = folder / f"{number}.h5"
    command = [program, "pack", str(ROOT / f"data/scenes/{scene}.toml"), "-o", str(state)]
    for s in [*READINGS[M2 if scene == M2 else M1], *settings]:
        command += ["--set", s]
    command += ["--timings", str(folder / f"{number}.json")]
    try:
        done = subprocess.run(command, capture_output=True, text=True, timeout=600)
        code, said = done.returncode, done.stderr.strip().splitlines()
    except subprocess.TimeoutExpired:
        return [name, "timeout", "", "", "", "", "600 s"]
    row = [name, code, "", "", "", ""]
    if state.exists():
        with h5py.File(state) as f:
            arrays = [f["particles/grains/position/value"][()], f["particles/grains/velocity/value"][()]]
            finite = all(np.isfinite(a).all() for a in arrays)
        report = subprocess.run([program, "analyze", str(state), "--only", "counts,equilibrium", "--json", "-"],
                                capture_output=True, text=True)
        if not finite or report.returncode != 0:
            return [name, "NOT FINITE", "", "", "", "", report.stderr]
        d = json.loads(report.stdout)
        cpu = json.load(open(folder / f"{number}.json"))["cpu_seconds"] if (folder / f"{number}.json").exists() else ""
        row = [name, code, f"{d['counts']['solid_fraction']:.4f}", f"{d['counts']['z']:.3f}",
               f"{d['equilibrium']['max_force']:.2g}", f"{cpu:.1f}" if cpu != "" else ""]
    return row + [said[-1][:160] if code and said else ""]


def long_run(program, folder):
    """2e7 steps of an aggregation: drift of the momentum, error of the energy ledger."""
    scene = folder / "long.toml"
    scene.write_text("[grains]\ncount = 30\nsolid_fraction = 0.3\n[law]\nnormal_stiffness = 1e4\n[step]\nfraction = 0.06\n"
                     '[output]\nseries = "%s"\nseries_interval = 500.0\nenergies = true\n'
                     '[[stage]]\nvelocity = 9.48\nuntil = "time"\ntime = 12000.0\n' % (folder / "long.csv"))
    subprocess.run([program, "pack", str(scene), "-o", str(folder / "long.h5")], check=True, capture_output=True)
    with h5py.File(folder / "long.h5") as f:
        v = f["particles/grains/velocity/value"][()].reshape(-1, 2)  # one frame
        m = np.array(f["particles/grains/mass/value"] if isinstance(f["particles/grains/mass"], h5py.Group) else
                     f["particles/grains/mass"]).ravel()
        steps = int(f["run"].attrs["step"])
    rows = list(csv.DictReader(open(folder / "long.csv")))
    total = [float(r["E_total"]) for r in rows]
    kinetic = 0.5 * 30 * 9.48**2 * 1e-3 * float(np.mean(m))
    momentum = float(np.abs((m[:, None] * v).sum(axis=0)).max()) / (float(m.sum()) * 9.48 * math.sqrt(1e-3))
    return ["long aggregation", steps, f"{momentum:.2g}", f"{max(abs(t - total[0]) for t in total) / kinetic:.2g}", "", "",
            "steps, momentum / (M V0), largest energy error / initial kinetic energy"]


def main():
    program, target = sys.argv[1], sys.argv[2]
    workers = int(sys.argv[sys.argv.index("-j") + 1]) if "-j" in sys.argv else 1
    with tempfile.TemporaryDirectory() as name, concurrent.futures.ThreadPoolExecutor(workers) as pool:
        folder = pathlib.Path(name)
        jobs = [pool.submit(run, program, folder, k, *c) for k, c in enumerate(CASES)] + [pool.submit(long_run, program, folder)]
        rows = [["case", "exit", "Phi", "z", "max_force", "cpu_seconds", "message"]]
        for job in jobs:
            rows.append(job.result())
            print(*rows[-1], sep="  ", flush=True)
    with open(target, "w", newline="") as f:
        csv.writer(f, lineterminator="\n").writerows(rows)
    bad = [r[0] for r in rows[1:] if r[1] not in (0, 2, 3) and r[0] != "long aggregation"]
    sys.exit(f"neither equilibrium nor a named end: {bad}" if bad else 0)


main()
