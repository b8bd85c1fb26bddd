# Run by YADE: a static packing marched in its fixed periodic cell. spheres_yade.py PACKING.net STEPS DT; prints CPU seconds.
import sys
import time

from yade import O, FrictMat, utils
from yade.wrapper import *

net, steps, dt = sys.argv[1], int(sys.argv[2]), float(sys.argv[3])
O.periodic = True
material = O.materials.append(FrictMat(young=1e6, poisson=0.3, frictionAngle=0.29145679, density=1))  # tan = .3
smallest = 1e300
for fields in (line.split("#")[0].split() for line in open(net)):
    if fields and fields[0] == "cell":
        O.cell.setBox(*(float(x) for x in fields[1:4]))
    elif fields and fields[0] == "grain":
        x, y, z, r = (float(v) for v in fields[2:6])
        smallest = min(smallest, r)
        O.bodies.append(utils.sphere((x, y, z), r, material=material))
O.engines = [
    ForceResetter(),
    InsertionSortCollider([Bo1_Sphere_Aabb()], verletDist=0.04 * smallest, allowBiggerThanPeriod=True),
    InteractionLoop([Ig2_Sphere_Sphere_ScGeom()], [Ip2_FrictMat_FrictMat_MindlinPhys(en=0.335, es=0.335)],
                    [Law2_ScGeom_MindlinPhys_Mindlin()]),
    NewtonIntegrator(damping=0),
]
O.dt = dt
O.run(max(steps // 20, 5), True)
start = time.process_time()
O.run(steps, True)
print("cpu_seconds", time.process_time() - start, len([i for i in O.interactions if i.isReal]))
