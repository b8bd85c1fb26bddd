#!/usr/bin/env python3
"""tile.py INPUT.net K OUTPUT.net: the periodic packing repeated K x K times, for larger N of the same dense state.

Grains only: contacts are found by touching, so the tiled file lists none.
"""
import sys


def read_net(path):
    """(L1, L2), [(id, x, y, r)] of a plain-text network; contact lines are left out."""
    cell, grains = None, []
    with open(path) as file:
        for line in file:
            fields = line.split("#")[0].split()
            if not fields:
                continue
            if fields[0] == "cell":
                cell = (float(fields[1]), float(fields[2]))
            elif fields[0] == "grain":
                grains.append((int(fields[1]), *map(float, fields[2:5])))
    if cell is None or not grains:
        sys.exit(f"{path}: a cell and at least one grain are needed")
    return cell, grains


def write_net(path, cell, grains, comment):
    with open(path, "w") as file:
        file.write(f"# {comment}\ncell {cell[0]:.17g} {cell[1]:.17g}\n")
        for name, x, y, r in grains:
            file.write(f"grain {name} {x:.17g} {y:.17g} {r:.17g}\n")


def tile(cell, grains, k):
    tiled = [(x + a * cell[0], y + b * cell[1], r) for a in range(k) for b in range(k) for _, x, y, r in grains]
    return (k * cell[0], k * cell[1]), [(name, *grain) for name, grain in enumerate(tiled)]


if __name__ == "__main__":
    if len(sys.argv) != 4:
        sys.exit(__doc__)
    source, k, target = sys.argv[1], int(sys.argv[2]), sys.argv[3]
    write_net(target, *tile(*read_net(source), k), f"{source} tiled {k} x {k}")
