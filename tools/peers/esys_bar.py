"""The bar in ESyS-Particle: mpirun -np WORKERS+1 esysparticle esys_bar.py WORKERS [still], in the folder that inputs.py
has written. 'still': without the initial velocity. Ends with a line 'result: {...}'.
"""
import json
import math
import sys
import time

from esys.lsm import *
from esys.lsm.util import Vec3

scene = json.load(open("scene.json"))
workers = int(sys.argv[1])
still = "still" in sys.argv[2:]


def simulation():
    sim = LsmMpi(numWorkerProcesses=workers, mpiDimList=[workers, 1, 1])
    drift = scene["largest_radius"]   # neighbours are looked up anew when an element has moved so far: never here
    sim.initNeighbourSearch(particleType="RotSphere", gridSpacing=2 * scene["largest_radius"] + 2 * drift, verletDist=drift)
    sim.setTimeStepSize(scene["time_step"])
    sim.setNumTimeSteps(scene["steps"])
    return sim


def beams():
    """Stiffnesses are scaled by the program with half of the length R = L/2: R^2/L along and across, R^4/(4 L) bending,
    R^4/(2 L) twisting. Half of the bending stiffness acts on the relative turn."""
    section, never = math.pi * scene["ratio"]**2, 1e30
    young = scene["young"]
    shear = young / (2 * (1 + scene["poisson"]))
    slender = section * scene["ratio"]**2
    return RotBondPrms(name="beams", normalK=young * section, shearK=0.75 * young * slender, torsionK=shear * slender,
                       bendingK=2 * young * slender, normalBrkForce=never, shearBrkForce=never, torsionBrkForce=never,
                       bendingBrkForce=never, tag=0, scaling=True, meanR_scaling=True)


def add_bar(sim):
    sim.readGeometry("bar.geo")
    sim.createInteractionGroup(beams())
    sim.setParticleDensity(1, -1, scene["density"])
    sim.setParticleDensity(2, -1, scene["density"])
    sim.setParticleNonDynamic(2)


def set_moving(sim):
    for row, line in enumerate(open("elements.txt")):
        x, y, z, radius, held = (float(n) for n in line.split())
        if not held:
            sim.setParticleVelocity(row, Vec3(0, 0, scene["rate"] * x))


def count_bonds_at_end(sim):
    last = scene["steps"]
    sim.createFieldSaver(InteractionScalarFieldSaverPrms("beams", "count", "count.txt", "SUM", last, last, 1))


def seconds(sim):
    """Of all steps but the first, which looks up the neighbours."""
    sim.runTimeStep()
    start = time.perf_counter()
    for step in range(1, scene["steps"]):
        sim.runTimeStep()
    return time.perf_counter() - start


def write_positions(sim):
    with open("positions.txt", "w") as file:
        for particle in sorted(sim.getParticleList(), key=lambda p: p.getId()):
            file.write("%.17g %.17g %.17g\n" % tuple(particle.getPosn()))


sim = simulation()
add_bar(sim)
if not still:
    set_moving(sim)
count_bonds_at_end(sim)
taken = seconds(sim)
write_positions(sim)
version = sim.getLsmVersion()
sim.exit()
bonds = int(float(open("count.txt").read().split()[-1]))   # the file grows with each run
print("result:", json.dumps({"bonds": bonds, "steps": scene["steps"] - 1, "seconds": taken, "version": version}), flush=True)
