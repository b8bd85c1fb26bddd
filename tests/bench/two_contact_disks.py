#!/usr/bin/env python3
"""Eq. 20 of Gilabert 2007: a disk of radius R whose only two loaded contacts are with disks R1, R2 that touch each other
carries in both, without rolling moments, |T/N| = sqrt(R (R1 + R2 + R) / (R1 R2)).

    two_contact_disks.py STATE.h5 ... > docs/measured/results/eq20.csv       (python3-h5py, numpy)
"""
import sys

import h5py
import numpy as np

LOADED = 1e-4   # [F0] a contact that carries less is left out: equilibrium is certified to that
DISTANT = 4     # links/kind


def deviations(path):
    """Relative deviation from Eq. 20 of both contacts of every such disk."""
    with h5py.File(path, "r") as f:
        i, j, kind = (np.asarray(f["links"][name]) for name in ("i", "j", "kind"))
        normal, tangential = np.asarray(f["links/normal_force"]), np.asarray(f["links/tangential_force"])
        radius = np.asarray(f["particles/grains/radius"])
    closed = kind != DISTANT
    touching = {(min(p), max(p)) for p, c in zip(zip(i, j), closed) if c}
    loaded = [[] for _ in radius]
    for k in np.flatnonzero(np.hypot(normal, tangential) > LOADED):
        loaded[i[k]].append((j[k], k))
        loaded[j[k]].append((i[k], k))
    found = []
    for disk, links in enumerate(loaded):
        if len(links) != 2 or not all(closed[k] for _, k in links):
            continue
        (a, _), (b, _) = links
        if (min(a, b), max(a, b)) in touching:
            ratio = np.sqrt(radius[disk] * (radius[a] + radius[b] + radius[disk]) / (radius[a] * radius[b]))
            found += [abs(abs(tangential[k] / normal[k]) / ratio - 1) for _, k in links]
    return np.asarray(found), len(radius)


print("state,grains,disks,median_deviation,within_1_percent")
for path in sys.argv[1:]:
    d, grains = deviations(path)
    print(path.split("/")[-1], grains, len(d) // 2, f"{np.median(d):.2g}", f"{np.mean(d < 0.01):.3f}", sep=",")
