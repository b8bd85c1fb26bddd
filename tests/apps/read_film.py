"""read_film.py FILE: the frames of an extended XYZ, a LAMMPS dump or a .pvd, read by their documented formats and by
nothing of ours. A line a frame: time or step, then id, x, y, radius of each grain, with all digits."""
import base64
import os
import struct
import sys
import xml.etree.ElementTree as xml


def of_xyz(path):
    with open(path) as film:
        while count := film.readline():
            head = film.readline()
            names, at = {}, 0
            for name, kind, size in zip(*[iter(head.split("Properties=")[1].split()[0].split(":"))] * 3):
                names[name], at = at, at + int(size)
            rows = [film.readline().split() for _ in range(int(count))]
            time = float(head.split("Time=")[1].split()[0])
            yield time, [(row[names["id"]], *row[names["pos"]:names["pos"] + 2], row[names["radius"]]) for row in rows]


def of_dump(path):
    with open(path) as film:
        while film.readline():
            step = int(film.readline())
            assert film.readline() == "ITEM: NUMBER OF ATOMS\n"
            count = int(film.readline())
            assert film.readline().startswith("ITEM: BOX BOUNDS")
            for _ in range(3):
                film.readline()
            names = film.readline().split()[2:]
            rows = [film.readline().split() for _ in range(count)]
            yield step, [[row[names.index(n)] for n in ("id", "x", "y", "radius")] for row in rows]


def array(piece, name, letter):
    data = base64.b64decode(piece.find(f".//DataArray[@Name='{name}']").text)
    return struct.unpack(f"<{(len(data) - 8) // 8}{letter}", data[8:])


def of_pvd(path):
    for frame in xml.parse(path).getroot().find("Collection"):
        piece = xml.parse(os.path.join(os.path.dirname(path), frame.get("file"))).getroot().find("PolyData/Piece")
        count = int(piece.get("NumberOfVerts"))
        ids, radius, place = array(piece, "id", "q"), array(piece, "radius", "d"), array(piece, "Points", "d")
        yield float(frame.get("timestep")), [(ids[k], place[3 * k], place[3 * k + 1], radius[k]) for k in range(count)]


read = {"xyz": of_xyz, "dump": of_dump, "pvd": of_pvd}[sys.argv[1].rsplit(".", 1)[1]]
for time, grains in read(sys.argv[1]):
    print(repr(float(time)), *(repr(float(number)) for grain in grains for number in grain))
