#!/usr/bin/python3
"""The cube of xml-cases/speed/heap.xml in Beadwork and in LAMMPS (its granular package), in turns on one machine: particle steps a second.

Beadwork fills the cube once; places and radii are read from its run.h5, so that both have the same, and the same time step.
The law is the same but for the rule by which friction is kept when the overlap changes, and for the clipping of pulls.
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
YOUNG, POISSON, FRICTION, DENSITY = 50e6, 0.3, 0.5, 2500.0
SKIN = 0.3  # over the smallest radius


def arguments():
    parser = argparse.ArgumentParser(description=__doc__.split("\n")[0])
    parser.add_argument("--beadwork", default=TOP / "build/release/bin/beadwork")
    parser.add_argument("--lammps", default="lmp")
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


def write_lammps(options, run, folder):
    with h5py.File(run / "run.h5") as file:
        frame = file["frames"][min(file["frames"])]
        place, radius = frame["elements/position"][:], frame["elements/radius"][:]
    step = json.loads((run / "summary.json").read_text())["time_step"]
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
    return float(found[1])


def main():
    options = arguments()
    options.out.mkdir(parents=True, exist_ok=True)
    rates = {}
    there = shutil.which(options.lammps)
    if not there:
        print("LAMMPS is missing: apt-get install lammps")
    for repeat in range(options.repeats):
        for threads in options.threads:
            run = options.out / "heap"
            summary = beadwork(options, threads, run)
            rates.setdefault(("Beadwork", threads), []).append(options.elements * summary["steps"] / summary["loop_seconds"] / 1e6)
            if there:
                if repeat == 0 and threads == options.threads[0]:
                    write_lammps(options, run, options.out.resolve())
                rates.setdefault(("LAMMPS", threads), []).append(options.elements * options.steps / lammps(options, threads, options.out.resolve()) / 1e6)
    print(f"{options.elements} spheres, {summary['contacts']['grains']} pairs, million particle steps a second: median (lowest, highest)")
    for (program, threads), all_rates in sorted(rates.items()):
        print(f"  {program:9} on {threads}: {statistics.median(all_rates):6.2f} ({min(all_rates):.2f}, {max(all_rates):.2f})")
    for threads in options.threads:
        if there:
            print(f"  ratio on {threads}: {statistics.median(rates['Beadwork', threads]) / statistics.median(rates['LAMMPS', threads]):.2f}")


if __name__ == "__main__":
    main()
