"""Full disks, quotas and closed descriptors: a file is whole or as it was, and the program says what failed."""
import os
import shutil
import subprocess

from tools import content, ends_badly, leftovers, run


def commands(program, data):
    scene = os.path.join(data, "scenes", "disks-method1.toml")
    few = ["--set", "grains.count=30", "--set", "stage.0.until=\"time\"", "--set", "stage.0.time=0.2"]
    return [
        ([program, "pack", scene, "-o", "x.h5", "--force", *few], ["x.h5"]),
        ([program, "pack", scene, "-o", "x.h5", "--force", "--set", 'output.series="x.csv"', "--set",
          "output.series_interval=0.001", "--timings", "t.json", *few], ["x.h5", "t.json"]),
        ([program, "analyze", "in.h5", "--json", "x.json"], ["x.json"]),
        ([program, "analyze", "in.h5", "--csv", "tables"], []),
        ([program, "convert", "in.h5", "-o", "x.vtp"], ["x.vtp"]),
        ([program, "convert", "in.h5", "-o", "x.csv"], ["x.grains.csv", "x.contacts.csv"]),
        ([program, "draw", "in.h5", "-o", "x.svg"], ["x.svg"]),
        ([program, "draw", "in.h5", "-o", "x.png"], ["x.png"]),
    ]


def torture(program, data, folder, random, faults, count, until):
    all_commands = commands(program, data)
    place = os.path.join(folder, "disk")
    source = os.path.join(folder, "in.h5")
    run([program, "pack", os.path.join(data, "scenes", "disks-method1.toml"), "-o", source, "--max-time", "1", "--set",
         "grains.count=30"], folder)
    whole = {}
    os.makedirs(place, exist_ok=True)
    full = os.path.join(folder, "full")
    os.makedirs(full, exist_ok=True)
    mounted = subprocess.run(["mount", "-t", "tmpfs", "-o", "size=256k", "tmpfs", full], capture_output=True).returncode == 0
    if not mounted:
        print("NOT RUN: full disks (mount needs root); quotas are", flush=True)
    try:
        for n in range(count):
            if until():
                break
            command, outputs = random.choice(all_commands)
            disk = mounted and random.random() < 0.4
            where = full if disk else place
            for name in os.listdir(where):
                path = os.path.join(where, name)
                shutil.rmtree(path) if os.path.isdir(path) else os.unlink(path)
            shutil.copy(source, os.path.join(where, "in.h5"))
            old = b"an older result\n"
            for name in outputs:
                with open(os.path.join(where, name), "wb") as file:
                    file.write(old)
            room, size = None, None
            if disk:  # leave so much free
                room = random.randrange(0, 120000)
                stat = os.statvfs(where)
                filler = max(0, stat.f_bavail * stat.f_frsize - room)
                with open(os.path.join(where, "filler"), "wb") as file:
                    file.write(b"\0" * filler)
            else:
                size = int(10 ** (6 * random.random()))
            result = run(command, where, file_size=size)
            why = ends_badly(result)
            key = tuple(command)
            if not why and leftovers(where):
                why = f"left {leftovers(where)}"
            for name in outputs:
                got = content(os.path.join(where, name))
                if why:
                    break
                if result.code == 2 and got not in (old, whole.get((key, name), old)) and name != "t.json":
                    why = f"exit 2, and {name} is neither the old file nor the new one"
                if result.code in (0, 3):
                    if got == old:
                        why = f"exit {result.code}, and {name} was not written"
                    elif name != "t.json":
                        if whole.setdefault((key, name), got) != got:
                            why = f"{name} is not the file that it was before"
            if why:
                faults.add("disk", command, f"{'disk with ' + str(room) if disk else 'files up to ' + str(size)} bytes: {why}")
            faults.did("full disks" if disk else "quotas")
    finally:
        if mounted:
            subprocess.run(["umount", full])
    for streams in ("<&-", ">&-", "2>&-", "<&- >&-", "<&- >&- 2>&-", ">&- 2>&-"):
        for command, outputs in all_commands:
            for name in os.listdir(place):
                path = os.path.join(place, name)
                shutil.rmtree(path) if os.path.isdir(path) else os.unlink(path)
            shutil.copy(source, os.path.join(place, "in.h5"))
            quoted = " ".join("'" + w + "'" for w in command)
            result = run(["bash", "-c", f"{quoted} {streams}"], place)
            if result.code not in (0, 3) or any(not content(os.path.join(place, o)) for o in outputs):
                faults.add("disk", command, f"{streams}: exit {result.code}")
            faults.did("closed streams")
