"""The cube of spheres in Yade: yade -n -x -j THREADS yade_heap.py, in the folder that heap.py has written.

Hertz and Mindlin with Coulomb friction and damping, pairs from a sweep with a skin. Ends with a line 'result: {...}'.
"""
import json
import math
import time   # for the clock among the engines

import yade
from yade import *

scene = json.load(open("yade-heap.json"))
moments = []

O.materials.append(FrictMat(young=scene["young"], poisson=scene["poisson"], density=scene["density"], frictionAngle=math.atan(scene["friction"])))
for x, y, z, radius in scene["spheres"]:
    ball = O.bodies[O.bodies.append(sphere((x, y, z), radius))]
    if z < scene["held_below"]:
        ball.state.blockedDOFs = "xyz"
O.engines = [
    ForceResetter(),
    InsertionSortCollider([Bo1_Sphere_Aabb()], verletDist=0.5 * scene["skin"]),   # each of the two brings half of it
    InteractionLoop([Ig2_Sphere_Sphere_ScGeom()],
                    [Ip2_FrictMat_FrictMat_MindlinPhys(en=scene["restitution"], es=scene["restitution"])],
                    [Law2_ScGeom_MindlinPhys_Mindlin(preventGranularRatcheting=False)]),
    NewtonIntegrator(damping=0, gravity=(0, 0, -9.80665)),
    PyRunner(command="moments.append(time.perf_counter())", initRun=True, iterPeriod=scene["steps"] - 1),
]
O.dt = scene["time_step"]
O.run(scene["steps"], True)
print("result:", json.dumps({"steps": scene["steps"] - 1, "seconds": moments[1] - moments[0], "pairs": len(O.interactions), "version": yade.config.version}), flush=True)
