"""Mutated inputs of every reader: each command ends with 0, 2 or 3, says why when it refuses, and writes nothing then."""
import os
import shutil

from tools import content, ends_badly, leftovers, run

NUMBERS = ["0", "-1", "1", "2", "1e308", "-1e308", "1e-308", "nan", "inf", "-inf", "1e9", "1e15", "0x10", "9223372036854775807",
           "1e-15", "99999999999999999999", "1e400", ".", "1.", "+1", "''", "true", "5e-324", "0.1", "1e5"]
BYTES = [b"\x00", b"\xff", b"\xe9", b"\n", b"\r", b",", b" ", b"\"", b"[", b"]", b"=", b"#", b"\xef\xbf\xbd", b"\t", b"'"]


def mutated(random, data):
    """One to four changes of bytes, numbers, lines or length."""
    for _ in range(random.choice([1, 1, 1, 2, 4])):
        if not data:
            return data
        kind = random.randrange(9)
        at = random.randrange(len(data))
        lines = data.split(b"\n")
        line = random.randrange(len(lines))
        if kind == 0:
            data = data[:at] + bytes([data[at] ^ (1 << random.randrange(8))]) + data[at + 1:]
        elif kind == 1:
            data = data[:at] + random.choice(BYTES) + data[at + random.randrange(2):]
        elif kind == 2:
            data = data[:at]
        elif kind == 3:
            words = lines[line].split(b" ")
            words[random.randrange(len(words))] = random.choice(NUMBERS).encode()
            lines[line] = b" ".join(words)
            data = b"\n".join(lines)
        elif kind == 4:
            fields = lines[line].split(b"," if b"," in lines[line] else b"=")
            fields[-1 if b"=" in lines[line] else random.randrange(len(fields))] = random.choice(NUMBERS).encode()
            lines[line] = (b"," if b"," in lines[line] else b"=").join(fields)
            data = b"\n".join(lines)
        elif kind == 5:
            lines.insert(line, lines[random.randrange(len(lines))])
            data = b"\n".join(lines)
        elif kind == 6:
            del lines[line]
            data = b"\n".join(lines)
        elif kind == 7:
            lines[line] = lines[line] * random.choice([2, 50])
            data = b"\n".join(lines)
        else:
            end = min(len(data), at + random.randrange(1, 40))
            data = data[:at] + data[end:]
    return data


def seeds(program, data, folder):
    """(file name, bytes, commands): INPUT and OUTPUT stand for the files."""
    def shipped(sub, end, most=6000):
        where = os.path.join(data, sub)
        return [(name, content(os.path.join(where, name))) for name in sorted(os.listdir(where))
                if name.endswith(end) and os.path.getsize(os.path.join(where, name)) < most]

    packings = [["analyze", "INPUT", "--json", "OUTPUT.json"], ["analyze", "INPUT", "--only", "dacf,counts", "--json", "OUTPUT.json"],
                ["analyze", "INPUT", "--cell", "free", "--law", "rolling", "--json", "OUTPUT.json"],
                ["convert", "INPUT", "-o", "OUTPUT.h5"], ["convert", "INPUT", "-o", "OUTPUT.net"],
                ["convert", "INPUT", "-o", "OUTPUT.vtp"], ["convert", "INPUT", "-o", "OUTPUT.csv"],
                ["draw", "INPUT", "-o", "OUTPUT.svg"], ["draw", "INPUT", "-o", "OUTPUT.png", "--what", "clusters"],
                ["draw", "INPUT", "-o", "OUTPUT.svg", "--what", "pores"], ["lab", "throughput", "INPUT", "--steps", "1"]]
    few = ["--max-time", "1e-3", "--set", "grains.count=12"]
    scenes = [["pack", "INPUT", "-o", "OUTPUT.h5", *few]]
    all_seeds = [(name, text, packings) for name, text in shipped("clusters", ".net")]
    all_seeds += [(name, text, scenes) for name, text in shipped("scenes", ".toml")]

    small = os.path.join(folder, "small")
    os.makedirs(small, exist_ok=True)
    made = []
    for name, scene, more in [("disks", "disks-method1", []), ("triangles", "triangles-settle", ["--set", "container.width=1.2"]),
                              ("spheres", "spheres-method1", [])]:
        state = f"{name}.h5"
        run([program, "pack", os.path.join(data, "scenes", scene + ".toml"), "-o", state, "--max-time", "0.05", "--set",
             "grains.count=12", "--set", f'output.series="{name}.csv"', *more], small)
        made.append(state)
        for end in ("csv", "dump", "net"):
            run([program, "convert", state, "-o", f"{name}.c.{end}"], small)
        run([program, "analyze", state, "--json", f"{name}.json"], small)
    for name in sorted(os.listdir(small)):
        text = content(os.path.join(small, name))
        if name.endswith(".h5"):
            all_seeds.append((name, text, [["info", "INPUT"], *packings[:5]]))
        elif name.endswith(".json"):
            all_seeds.append((name, text, [["plot", "INPUT", "-o", "OUTPUT.svg", "--what", what] for what in
                                           ("force-histogram", "coordination", "scattering", "pores", "NT")]))
        elif name.endswith((".grains.csv", ".dump", ".net")) and ".contacts." not in name:
            all_seeds.append((name, text, packings))
        elif name.endswith(".csv") and ".contacts." not in name:
            all_seeds.append((name, text, [["plot", "INPUT", "-o", "OUTPUT.png", "--what", "series"],
                                           ["plot", "INPUT", "-o", "OUTPUT.svg", "--x", "t", "--y", "z", "--log-y"]]))
    study = b'scene = "scene.toml"\nseeds = 1\nanalyze = ["counts"]\n[set]\n"grains.count" = 12\n[[row]]\nname = "a"\n[grid]\nlaw.friction = [0.1, 0.5]\n'
    all_seeds.append(("study.toml", study, [["study", "INPUT", "-o", "OUTPUT.d"]]))
    pairs = b"0,0,1,0,0,1,.2,.2,1.2,.2,.2,1.2\n0,0,1,0,0,1,5,5,6,5,5,6\n"
    all_seeds.append(("pairs.csv", pairs, [["lab", "overlap", "INPUT", "--json", "OUTPUT.json"]]))
    return [s for s in all_seeds if s[1]]


def torture(program, data, folder, random, faults, count, until):
    all_seeds = seeds(program, data, folder)
    # A study's scene, so quick that what is left of it may run.
    scene = b"[grains]\nsolid_fraction = 0.4\n[law]\nnormal_stiffness = 1e4\n[[stage]]\nvelocity = 1.0\nuntil = \"time\"\ntime = 0.01\n"
    for n in range(count):
        if until():
            break
        place = os.path.join(folder, "one")
        shutil.rmtree(place, ignore_errors=True)
        os.makedirs(place)
        name, text, commands = random.choice(all_seeds)
        path = os.path.join(place, name)
        with open(path, "wb") as file:
            file.write(mutated(random, text))
        with open(os.path.join(place, "scene.toml"), "wb") as file:
            file.write(scene)
        output = os.path.join(place, "output")
        command = [program] + [w.replace("INPUT", path).replace("OUTPUT", output) for w in random.choice(commands)]
        before = set(os.listdir(place))
        interrupted = command[1] in ("pack", "study")  # a mutated scene may be sound and long
        result = run(command if not interrupted else ["timeout", "--signal=INT", "--kill-after=15", "5", *command], place)
        allowed = (0, 2, 3, 124, 130) if interrupted else (0, 2, 3)
        why = ends_badly(result, allowed)
        if not why and result.code == 2:
            new = set(os.listdir(place)) - before - {"output.d"}
            if new:
                why = f"exit 2, and yet it wrote {sorted(new)}"
        if not why and leftovers(place):
            why = f"left {leftovers(place)}"
        if why:
            faults.add("input", command, why, [path])
        faults.did("inputs")
