#!/usr/bin/env python3
"""What the text of Gilabert 2007 says of its states and no table has: stressed clusters, compensation, loop forces, Eq. 20,
pores, Eqs. 26 to 28. Writes a CSV: one line a set of states and quantity, with the paper's words beside it.

    tests/bench/paper_text.py build/release/bin/isostat out/aggregation [out/limits] > docs/measured/results/paper_text.csv
"""
import csv
import glob
import json
import subprocess
import sys

program, folders = sys.argv[1], sys.argv[2:]

# name: files (of any folder), threshold of stressed links [F0], whether loaded
SETS = {
    "A, P* = 0": ("A.00*.stage1.h5", 1e-4),
    "A, P* = .01": ("A.00??.h5", 1e-2),
    "A RR, P* = 0": ("A-RR.00*.stage1.h5", 1e-2),
    "A RR, P* = .01": ("A-RR.00??.h5", 1e-2),
    "B, P* = 0": ("B.00*.stage2.h5", 1e-4),
    "B, P* = .01": ("B.00??.h5", 1e-2),
    "B RR, P* = 0": ("B-RR.00*.stage2.h5", 1e-2),
    "B RR, P* = .01": ("B-RR.00??.h5", 1e-2),
    "large RR, P* = 0": ("rolling-.5*.stage1.h5", 1e-2),
}
# quantity: (path in the report, what the paper says)
QUANTITIES = {
    "clusters_above_threshold": ("stressed.count", ""),
    "mean_size": ("stressed.mean_size", "a few units to a few tens"),
    "mean_size_of_a_grains_cluster": ("stressed.mean_size_weighted", "a few units to a few tens"),
    "spanning": ("stressed.spanning", "isolated at P* = 0"),
    "size_exponent": ("stressed.size_law.exponent", ""),
    "compensation": ("stressed.compensation.value", "local balance, conspicuous at P* = 0"),
    "compensation_if_shuffled": ("stressed.compensation.if_shuffled", ""),
    "tensile_rims": ("stressed.compensation.tensile_rim", "peripheral tension, radial compression"),
    "compressed_rims": ("stressed.compensation.compressed_rim", "or the other way round"),
    "loop_force_median": ("loops.loops.median", "mu_r F0/a with RR"),
    "loop_force_median_over_scale": ("loops.loops.median_over_scale", "order 1"),
    "tree_force_largest": ("loops.trees.largest", "0"),
    "cluster_force_median": ("loops.clusters.median", "order F0"),
    "eq20_median_deviation": ("two_contacts.touching.median_deviation", "0 without RR"),
    "eq20_within_1_percent": ("two_contacts.touching.within_1_percent", "1 without RR"),
    "pore_exponent": ("pores.size_law.exponent", "rapid power law"),
    "void_in_pores_below_a": ("pores.small.share_of_void", ""),
    "mass_radius_dimension": ("dacf.mass_radius.dimension", ""),
}


def value_of(report, path):
    for key in path.split("."):
        if not isinstance(report, dict) or key not in report:
            return None, None
        report = report[key]
    if isinstance(report, dict):
        return report.get("mean"), report.get("se")
    return report, None


def text(x):
    return "" if x is None else f"{x:.4g}"


rows = csv.writer(sys.stdout)
rows.writerow(["states", "samples", "quantity", "value", "error", "identifiable", "paper or message"])
for name, (pattern, threshold) in SETS.items():
    files = sorted(f for folder in folders for f in glob.glob(f"{folder}/{pattern}") if ".stage0." not in f)
    if not files:
        print(f"{name}: no file {pattern}", file=sys.stderr)
        continue
    report = json.loads(subprocess.run(
        [program, "analyze", *files, "--only", "stressed,loops,two_contacts,pores,dacf,scattering", "--threshold",
         repr(threshold), "--fit-constant", "nonnegative", "--json", "-"], check=True, capture_output=True).stdout)
    for quantity, (path, paper) in QUANTITIES.items():
        value, error = value_of(report, path)
        rows.writerow([name, len(files), quantity, text(value), text(error), "", paper])
    for section, law in (("scattering", "fit"), ("scattering", "power"), ("dacf", "fit")):
        fit = report[section].get("pooled", report[section])[law]
        equation = {"scattering.fit": "Eq. 28", "scattering.power": "Eq. 26", "dacf.fit": "Eq. 27"}[f"{section}.{law}"]
        sampled = fit.get("bootstrap") or {}
        for quantity in ("d_F", "xi"):
            if quantity not in fit:
                continue
            error = sampled.get(f"{quantity}_error", fit.get(f"{quantity}_error"))
            told = fit["identifiable"]  # else there is no number
            rows.writerow([name, len(files), f"{quantity} ({equation})", text(fit[quantity]) if told else "",
                           text(error) if told else "", int(told), fit["message"]])
