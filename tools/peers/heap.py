#!/usr/bin/python3
"""The cube of xml-cases/speed/heap.xml in Beadwork, in LAMMPS (its granular package) and in Yade, in turns on one machine: particle steps a second.

Beadwork fills the cube once; places and radii are read from its run.h5, so that all have the same, and the same time step.
The law is the same but for the rule by which friction is kept when the overlap changes, for how damping is stated, and for the clipping of pulls.
"""
import argparse
import json
import re
import shutil
import statistics
import subprocess
import sys
from pathlib import Path

import h5py

HERE = Path(__file__).resolve().parent
TOP = HERE.parent.parent
DECK = TOP / "xml-cases/speed/heap.xml"
YOUNG, POISSON, FRICTION, RESTITUTION, DENSITY = 50e6, 0.3, 0.5, 0.3, 2500.0
SKIN = 0.3  # over the smallest radius


def arguments():
    parser = argparse.ArgumentParser(description=__doc__.split("\n")[0])
    parser.add_argument("--beadwork", default=TOP / "build/release/bin/beadwork")
    parser.add_argument("--lammps", default="lmp")
    parser.add_argument("--yade", default="yade")
    parser.add_argument("--elements", type=int, default=40000)
    parser.add_argument("--steps", type=int, default=1000)
    parser.add_argument("--repeats", type=int, default=3)
    parser.add_argument("--threads", type=int, nargs="+", default=[1, 2])
    parser.add_argument("--out", type=Path, default=Path("out/peers"))
    return parser.parse_args()


def beadwork(options, threads, out):
    subprocess.run([options.beadwork, "run", "-q", DECK, "--out", out, "--overwrite", "--threads", str(threads), "--set", f"count={options.elements}",
                    "--set", f"steps={options.steps}"], check=True)
    return json.loads((out / "summary.json").read_text())


def filled(run):
    """Places, radii and the time step of what Beadwork began with."""
    with h5py.File(run / "run.h5") as file:
        frame = file["frames"][min(file["frames"])]
        place, radius = frame["elements/position"][:], frame["elements/radius"][:]
    return place, radius, json.loads((run / "summary.json").read_text())["time_step"]


def write_yade(options, run, folder):
    place, radius, step = filled(run)
    (folder / "yade-heap.json").write_text(json.dumps({
        "young": YOUNG, "poisson": POISSON, "density": DENSITY, "friction": FRICTION, "restitution": RESTITUTION, "skin": SKIN * radius.min(), "held_below": 1.5e-3,
        "time_step": step, "steps": options.steps, "spheres": [[*x, r] for x, r in zip(place.tolist(), radius.tolist())]}))


def yade(options, threads, folder):
    said = subprocess.run([options.yade, "-n", "-x", f"-j{threads}", HERE / "yade_heap.py"], cwd=folder, capture_output=True, text=True, check=False)
    found = re.search(r"result: (\{.*\})", said.stdout)
    if not found:
        sys.exit(f"Yade failed:\n{said.stdout[-2000:]}{said.stderr[-2000:]}")
    result = json.loads(found[1])
    return options.elements * result["steps"] / result["seconds"] / 1e6


def write_lammps(options, run, folder):
    place, radius, step = filled(run)
    low, high = place.min(axis=0) - 5e-3, place.max(axis=0) + 5e-3
    lines = ["spheres", "", f"{len(radius)} atoms", "1 atom types", ""]
    lines += [f"{low[k]} {high[k]} {'xyz'[k]}lo {'xyz'[k]}hi" for k in range(3)] + ["", "Atoms # sphere", ""]
    lines += [f"{i + 1} 1 {2 * radius[i]!r} {DENSITY} {x!r} {y!r} {z!r}" for i, (x, y, z) in enumerate(place.tolist())]
    (folder / "heap.data").write_text("\n".join(lines) + "\n")
    stiffness = 2 * YOUNG / (3 * (1 - POISSON**2))                         # 4/3 E*
    across = stiffness * 1.5 * 2 * (1 - POISSON) / (2 - POISSON)           # k_t over sqrt(R* delta)
    damping = 2e3
    (folder / "heap.in").write_text(f"""units si
atom_style sphere
boundary f f f
newton off
comm_modify vel yes
read_data {folder / 'heap.data'}
neighbor {SKIN * radius.min()} bin
neigh_modify delay 0 every 1 check yes
pair_style gran/hertz/history {stiffness} {across} {damping} 0 {FRICTION} 0
pair_coeff * *
region bottom block INF INF INF INF INF 1.5e-3
group bottom region bottom
group free subtract all bottom
fix 1 all gravity 9.80665 vector 0 0 -1
fix 2 free nve/sphere
fix 3 bottom setforce 0 0 0
fix 4 bottom nve/sphere
timestep {step}
thermo {options.steps}
run {options.steps}
""")


def lammps(options, processes, folder):
    launch = ["mpirun", "--allow-run-as-root", "--oversubscribe", "-np", str(processes)] if processes > 1 else []
    said = subprocess.run([*launch, options.lammps, "-in", folder / "heap.in", "-log", "none"], capture_output=True, text=True, check=False)
    found = re.search(r"Loop time of ([\d.e+-]+)", said.stdout)
    if not found:
        sys.exit(f"LAMMPS failed:\n{said.stdout[-2000:]}{said.stderr[-2000:]}")
    return options.elements * options.steps / float(found[1]) / 1e6


def main():
    options = arguments()
    options.out.mkdir(parents=True, exist_ok=True)
    folder, rates = options.out.resolve(), {}
    others = {"LAMMPS": (options.lammps, "lammps", write_lammps, lammps), "Yade": (options.yade, "yade", write_yade, yade)}
    for name, (program, package, _, _) in list(others.items()):
        if not shutil.which(program):
            print(f"{name} is missing: apt-get install {package}")
            del others[name]
    for repeat in range(options.repeats):
        for threads in options.threads:
            run = options.out / "heap"
            summary = beadwork(options, threads, run)
            rates.setdefault(("Beadwork", threads), []).append(options.elements * summary["steps"] / summary["loop_seconds"] / 1e6)
            for name, (_, _, write, go) in others.items():
                if repeat == 0 and threads == options.threads[0]:
                    write(options, run, folder)
                rates.setdefault((name, threads), []).append(go(options, threads, folder))
    print(f"{options.elements} spheres, {summary['contacts']['grains']} pairs, million particle steps a second: median (lowest, highest)")
    for (program, threads), all_rates in sorted(rates.items()):
        ratio = statistics.median(rates["Beadwork", threads]) / statistics.median(all_rates)
        print(f"  {program:9} on {threads}: {statistics.median(all_rates):6.2f} ({min(all_rates):.2f}, {max(all_rates):.2f}); Beadwork is {ratio:.2f} times as fast")


if __name__ == "__main__":
    main()
