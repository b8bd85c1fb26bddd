#!/usr/bin/env python3
"""The mean pore radius of Gilabert 2007, Eqs. 29 and 30, on a mesh, with two mistakes that are easy to make in a periodic
cell: holes cut at its edge, and holes joined across it whose coordinates are not unwrapped. Beside `isostat analyze --only
pores` this tells which would give the paper's values (docs/measured/paper.md). Needs python3-h5py and python3-scipy.

    tests/bench/pore_radius_wrapped.py STATE.h5 ...
"""
import sys

import h5py
import numpy as np
from scipy import ndimage

MESH = 0.02  # [a]


def read(name):
    with h5py.File(name) as file:
        grains = file["particles/grains"]
        edges = grains["box/edges"]
        cell = np.array(edges["value"] if isinstance(edges, h5py.Group) else edges).ravel()[:2]
        radius = grains["radius"]
        radius = np.array(radius["value"] if isinstance(radius, h5py.Group) else radius).ravel()
        return np.array(grains["position/value"]).reshape(-1, 2), radius, cell


def void_of(position, radius, cell):
    nodes = np.round(cell / MESH).astype(int)
    step = cell / nodes
    void = np.ones(nodes, bool)
    for (x, y), r in zip(position % cell, radius):
        reach = int(r / step.min()) + 2
        i = np.arange(int(x / step[0]) - reach, int(x / step[0]) + reach + 1)
        j = np.arange(int(y / step[1]) - reach, int(y / step[1]) + reach + 1)
        inside = (i * step[0] - x)[:, None] ** 2 + (j * step[1] - y)[None, :] ** 2 <= r * r
        rows, columns = np.nonzero(inside)
        void[i[rows] % nodes[0], j[columns] % nodes[1]] = False
    return void, step


def mean_radius(label, count, step):
    i, j = np.nonzero(label)
    hole, x, y = label[i, j], i * step[0], j * step[1]
    total = lambda v: np.bincount(hole, weights=v, minlength=count + 1)[1:]
    n = np.bincount(hole, minlength=count + 1)[1:]
    safe = np.maximum(n, 1)
    square = (total(x * x) + total(y * y)) / safe - (total(x) / safe) ** 2 - (total(y) / safe) ** 2
    return (n * np.sqrt(2 * np.maximum(square, 0))).sum() / n.sum()


def joined_across_the_edge(label, count):
    parent = np.arange(count + 1)

    def root(a):
        while parent[a] != a:
            a = parent[a]
        return a

    for a, b in [*zip(label[0], label[-1]), *zip(label[:, 0], label[:, -1])]:
        if a and b:
            parent[root(a)] = root(b)
    names, of = np.unique([root(a) for a in range(count + 1)], return_inverse=True)
    return of.reshape(-1)[label], len(names) - 1


for name in sys.argv[1:]:
    void, step = void_of(*read(name))
    label, count = ndimage.label(void)
    print(name, f"cut at the edge {mean_radius(label, count, step):.2f} a,",
          f"not unwrapped {mean_radius(*joined_across_the_edge(label, count), step):.2f} a")
