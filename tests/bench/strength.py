#!/usr/bin/env python3
"""Strength of consolidated powders from the tables of data/studies/strength-*.toml: yield loci tau = c + sigma tan(phi) by
Mohr-Coulomb, tensile strength, largest deviator (docs/measured/strength.md).

    strength.py out docs/measured/results

reads out/strength-shear, -biaxial, -tension; writes strength_locus.csv (peak shear stress of each normal stress), strength.csv (a
line a material and consolidation: cohesion c, friction angle, unconfined strength f_c = 2 c cos(phi)/(1 - sin(phi)), tensile
strength, and the largest deviator) and the curves strength_CURVE.csv; prints the first two. Lines are weighted by the standard
errors of the peaks and go through the normal stresses up to the consolidation; errors are those of such fits.
"""
import csv
import math
import pathlib
import sys

from paper_tables import markdown, write

CURVES = (("strength-shear", "shear_stress"), ("strength-shear", "solid_fraction"), ("strength-biaxial", "deviator"),
          ("strength-biaxial", "volumetric_strain"), ("strength-tension", "tension"))


def table(path):
    with open(path) as f:
        return list(csv.DictReader(f))


def shortened(rows, curve):
    """A mean curve with material, consolidation and normal stress in place of the keys that made them."""
    x = list(rows[0])[list(rows[0]).index("runs") - 1]
    lines = [["row", "material", "consolidation", "normal_stress", x, "runs", curve, curve + "_se"]]
    for r in rows:
        normal = r.get("stage.1.stress_2", "")
        lines.append([r["row"], r["row"].split("-P")[0], f"{float(r['stage.0.pressure']):g}",
                      f"{float(normal):g}" if normal else "", f"{float(r[x]):.4g}", r["n"],
                      *(f"{float(r[k] or 'nan'):.4g}" for k in (curve, curve + "_se"))])
    return lines


def line(points):
    """(c, its error, slope, its error) of y = c + slope x; points: (x, y, error of y)."""
    w = [1 / e**2 for _, _, e in points]
    s, sx, sy = (sum(k * v for k, v in zip(w, values)) for values in
                 ([1] * len(points), [p[0] for p in points], [p[1] for p in points]))
    sxx = sum(k * p[0] ** 2 for k, p in zip(w, points))
    sxy = sum(k * p[0] * p[1] for k, p in zip(w, points))
    d = s * sxx - sx * sx
    return (sxx * sy - sx * sxy) / d, math.sqrt(sxx / d), (s * sxy - sx * sy) / d, math.sqrt(s / d)


def main():
    out, target = pathlib.Path(sys.argv[1]), pathlib.Path(sys.argv[2])
    for study, curve in CURVES:
        write(target / f"strength_{curve}.csv", shortened(table(out / study / f"curve.{curve}.csv"), curve))
    peaks = [r for r in table(out / "strength-shear/peaks.csv") if r["curve"] == "shear_stress"]
    locus = [["row", "material", "consolidation", "normal_stress", "runs", "peak", "peak_se", "at_strain"]]
    sets = {}
    for r in peaks:
        material = r["row"].split("-P")[0]
        key = material, float(r["stage.0.pressure"])
        sets.setdefault(key, []).append((float(r["stage.1.stress_2"]), float(r["peak"]), float(r["peak_se"] or "nan")))
        locus.append([r["row"], material, f"{key[1]:g}", f"{float(r['stage.1.stress_2']):g}", r["n"],
                      *(f"{float(r[k] or 'nan'):.4g}" for k in ("peak", "peak_se", "at"))])
    largest = {(study, r["row"]): r for study, curve in (("strength-biaxial", "deviator"), ("strength-tension", "tension"))
               for r in table(out / study / "peaks.csv") if r["curve"] == curve}
    lines = [["material", "consolidation", "c", "c_error", "tan_phi", "tan_phi_error", "phi_degrees", "f_c", "tensile_strength",
              "tensile_se", "deviator_peak", "deviator_se"]]
    for (material, pressure), points in sets.items():
        c, c_error, slope, slope_error = line([p for p in points if p[0] <= pressure])
        phi = math.atan(slope)
        row = f"{material}-P{pressure:g}"
        of = [largest.get((study, row), {}).get(k) or "nan" for study in ("strength-tension", "strength-biaxial")
              for k in ("peak", "peak_se")]
        lines.append([material, f"{pressure:g}", *(f"{v:.3g}" for v in (c, c_error, slope, slope_error, math.degrees(phi),
                                                                          2 * c * math.cos(phi) / (1 - math.sin(phi)))),
                      *(f"{float(v):.3g}" for v in of)])
    write(target / "strength_locus.csv", locus)
    write(target / "strength.csv", lines)
    markdown(locus)
    markdown(lines)


if __name__ == "__main__":
    main()
