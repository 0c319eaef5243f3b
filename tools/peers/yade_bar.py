"""The bar in Yade: yade -n -x -j THREADS yade_bar.py, in the folder that inputs.py has written.

No collider: the bonds are made one by one before the run, and nothing else can touch. Ends with a line 'result: {...}'.
"""
import json
import time   # for the clock among the engines

import yade
from yade import *

scene = json.load(open("scene.json"))
moments = []


def rows(name):
    return [[float(n) for n in line.split()] for line in open(name)]


def material():
    never = 1e30   # Pa, of the cohesion
    return CohFrictMat(young=scene["young"], poisson=scene["poisson"], density=scene["density"], frictionAngle=0.5,
                       isCohesive=True, momentRotationLaw=True, alphaKr=1, alphaKtw=1, etaRoll=-1, etaTwist=-1,
                       normalCohesion=never, shearCohesion=never, fragile=True)


def add_elements(elements):
    glued = O.materials.append(material())
    for x, y, z, radius, held in elements:
        ball = O.bodies[O.bodies.append(sphere((x, y, z), radius, material=glued))]
        if held:
            ball.state.blockedDOFs = "xyz"
        else:
            ball.state.vel = (0, 0, scene["rate"] * x)


def add_bonds(bonds):
    for first, second, along, across, bending, twisting in bonds:
        bond = createInteraction(int(first), int(second))
        bond.phys.kn, bond.phys.ks, bond.phys.kr, bond.phys.ktw = along, across, bending, twisting
        bond.phys.unp = bond.geom.penetrationDepth   # the length at rest is the one that it has now


def engines():
    """The clock looks twice: after the first step, which sets up, and after the last."""
    return [
        ForceResetter(),
        InteractionLoop([Ig2_Sphere_Sphere_ScGeom6D()],
                        [Ip2_CohFrictMat_CohFrictMat_CohFrictPhys(setCohesionOnNewContacts=True)],
                        [Law2_ScGeom6D_CohFrictPhys_CohesionMoment()]),
        NewtonIntegrator(damping=0, gravity=(0, 0, 0)),
        PyRunner(command="moments.append(time.perf_counter())", initRun=True, iterPeriod=scene["steps"] - 1),
    ]


def write_positions():
    with open("positions.txt", "w") as file:
        for body in O.bodies:
            file.write("%.17g %.17g %.17g\n" % tuple(body.state.pos))


O.engines = engines()
O.dt = scene["time_step"]
add_elements(rows("elements.txt"))
add_bonds(rows("bonds.txt"))
O.run(scene["steps"], True)
write_positions()
bonds = sum(1 for bond in O.interactions if bond.isReal and not bond.phys.cohesionBroken)
print("result:", json.dumps({"bonds": bonds, "steps": scene["steps"] - 1, "seconds": moments[1] - moments[0],
                             "version": yade.config.version}), flush=True)
