"""Random small networks against a rank of our own: rows written out from Gilabert 2007, Eq. A2 (normal and tangential
ones scaled by |r_ij|), as integers, eliminated modulo a prime and, where that differs from the program, without one."""
import json
import os
from fractions import Fraction

from tools import ends_badly, run

PRIME = (1 << 61) - 1


def rank_mod(rows, prime=PRIME):
    rows = [[x.numerator * pow(x.denominator, -1, prime) % prime for x in row] for row in rows]
    rank, columns = 0, len(rows[0]) if rows else 0
    for c in range(columns):
        pivot = next((r for r in range(rank, len(rows)) if rows[r][c]), None)
        if pivot is None:
            continue
        rows[rank], rows[pivot] = rows[pivot], rows[rank]
        inverse = pow(rows[rank][c], -1, prime)
        for r in range(rank + 1, len(rows)):
            if rows[r][c]:
                f = rows[r][c] * inverse % prime
                rows[r] = [(a - f * b) % prime for a, b in zip(rows[r], rows[rank])]
        rank += 1
    return rank


def rank_exact(rows):
    rows, rank = [list(row) for row in rows], 0
    for c in range(len(rows[0]) if rows else 0):
        pivot = next((r for r in range(rank, len(rows)) if rows[r][c]), None)
        if pivot is None:
            continue
        rows[rank], rows[pivot] = rows[pivot], rows[rank]
        for r in range(rank + 1, len(rows)):
            if rows[r][c]:
                f = rows[r][c] / rows[rank][c]
                rows[r] = [a - f * b for a, b in zip(rows[r], rows[rank])]
        rank += 1
    return rank


def random_network(random):
    """Positions on a coarse lattice (collinear, square, coincident radii) or anywhere; own images and multiple links."""
    d = random.choice([2, 2, 3])
    n = random.randrange(1, 8 if d == 2 else 6)
    lattice = random.random() < 0.6
    cell = [random.choice([2, 3, 4.5]) for _ in range(d)] if random.random() < 0.6 else None
    def coordinate():
        return random.randrange(0, 4) if lattice else random.randrange(-3000, 3000) / 1024
    grains, taken = [], set()
    while len(grains) < n:
        x = tuple(coordinate() for _ in range(d))
        if x in taken:
            if lattice and len(taken) >= 4 ** d // 2:
                lattice = False
            continue
        taken.add(x)
        grains.append((x, random.choice([0.5, 0.5, 0.75, 1, 0.3125])))
    links, seen = [], set()
    for _ in range(random.randrange(0, 4 * n + 2)):
        i, j = random.randrange(n), random.randrange(n)
        shift = tuple(random.choice([0, 0, 1, -1]) for _ in range(d)) if cell else (0,) * d
        back = tuple(-s for s in shift)
        if (i, j, shift) in seen or (j, i, back) in seen:
            continue
        r = [grains[j][0][k] - grains[i][0][k] + (shift[k] * cell[k] if cell else 0) for k in range(d)]
        if not any(r):
            continue
        seen.add((i, j, shift))
        links.append((i, j, shift, random.choice(["c", "c", "c", "s", "r", "sr", "d"])))
    return d, cell, grains, links


def text_of(network):
    d, cell, grains, links = network
    lines = ["cell " + " ".join(map(repr, cell))] if cell else []
    lines += [f"grain {7 * k + 3} " + " ".join(repr(float(x)) for x in position) + f" {radius!r}"
              for k, (position, radius) in enumerate(grains)]
    for i, j, shift, kind in links:
        lines.append(f"contact {7 * i + 3} {7 * j + 3} {kind}" + (" " + " ".join(map(str, shift)) if cell else ""))
    return "\n".join(lines) + "\n"


def rows_of(network, law, free):
    d, cell, grains, links = network
    spins = 0 if law == "frictionless" else (1 if d == 2 else 3)
    per = d + spins
    width = per * len(grains) + (d if free else 0)
    rows = []
    for i, j, shift, kind in links:
        r = [Fraction(grains[j][0][k]) - Fraction(grains[i][0][k]) + (shift[k] * Fraction(cell[k]) if cell else 0)
             for k in range(d)]
        ri, rj = Fraction(grains[i][1]), Fraction(grains[j][1])
        part_i, part_j = ri / (ri + rj), rj / (ri + rj)

        def row():
            rows.append([Fraction(0)] * width)
            return rows[-1]

        def add(target, direction):  # direction . (v_j - v_i), and the strains
            for k in range(d):
                target[per * j + k] += direction[k]
                target[per * i + k] -= direction[k]
                if free:
                    target[per * len(grains) + k] += direction[k] * r[k]
        tangential = law != "frictionless" and kind in ("c", "r")
        rolling = law == "rolling" and kind in ("c", "s")
        if d == 2:
            add(row(), r)
            if tangential:
                t, square = row(), r[0] * r[0] + r[1] * r[1]
                add(t, [-r[1], r[0]])
                t[per * i + 2] -= square * part_i
                t[per * j + 2] -= square * part_j
            if rolling:
                m = row()
                m[per * j + 2] += 1
                m[per * i + 2] -= 1
        else:
            if tangential:
                for a in range(3):
                    t, b, c = row(), (a + 1) % 3, (a + 2) % 3
                    add(t, [Fraction(int(k == a)) for k in range(3)])
                    for g, part in ((i, part_i), (j, part_j)):  # -(w x part r)_a = -(w_b r_c - w_c r_b) part
                        t[per * g + 3 + b] -= r[c] * part
                        t[per * g + 3 + c] += r[b] * part
            else:
                add(row(), r)
            if rolling:
                for a in range(3):
                    m = row()
                    m[per * j + 3 + a] += 1
                    m[per * i + 3 + a] -= 1
    return rows, width


def torture(program, data, folder, random, faults, count, until):
    path = os.path.join(folder, "random.net")
    for n in range(count):
        if until():
            break
        network = random_network(random)
        law = random.choice(["frictionless", "friction", "rolling"])
        free = network[1] is not None and random.random() < 0.4
        with open(path, "w") as file:
            file.write(text_of(network))
        command = [program, "analyze", path, "--only", "rigidity", "--law", law, "--cell", "free" if free else "fixed", "--json", "-"]
        if not network[3]:
            command[command.index("--json"):] = ["--gap-tolerance", "0", "--json", "-"]
            continue
        result = run(command, folder)
        why = ends_badly(result, (0,))
        if not why:
            told = json.loads(result.out)["rigidity"]
            rows, width = rows_of(network, law, free)
            rank = rank_mod(rows)
            expected = {"N_f": width, "M": len(rows), "rank": rank, "H": len(rows) - rank, "K": width - rank}
            if any(told[k] != v for k, v in expected.items()):
                rank = rank_exact(rows)
                expected.update(rank=rank, H=len(rows) - rank, K=width - rank)
            wrong = {k: (told[k], v) for k, v in expected.items() if told[k] != v}
            if wrong:
                why = f"(told, true): {wrong}"
        if why:
            faults.add("network", command, why, [path])
        faults.did("networks")
