#!/usr/bin/env python3
"""The bar of xml-cases/speed in Beadwork and in other programs, those that are installed, in one go on one machine.

    tools/peers/compare.py                                     (needs Debian's python3-h5py)
    tools/peers/compare.py --elements 2000 --repeats 1         a quick look at whether all works

Prints a table and leaves its numbers in results.json of the folder --out. What the columns mean: tools/peers/README.md.
Ends with 1 if a program failed, or gave other bonds or another answer than Beadwork.
"""
import argparse
import json
import os
import re
import shutil
import statistics
import subprocess
import sys

try:
    import numpy as np
    import inputs
except ImportError as error:
    sys.exit(f"compare: {error}; apt-get install python3-h5py, and run with that python (/usr/bin/python3)")

HERE = os.path.dirname(os.path.abspath(__file__))
CASE = os.path.join(HERE, "..", "..", "xml-cases", "speed")
LARGEST_DIFFERENCE = 0.1


class Failed(Exception):
    """A program did not do what it should; the text says what is known of it."""


def shell(command, folder, **environment):
    """Runs a command in a folder; gives what it printed. Where it fails, the folder has that in failed.log."""
    done = subprocess.run(command, cwd=folder, env=os.environ | environment, text=True, errors="replace",
                          stdin=subprocess.DEVNULL, stdout=subprocess.PIPE, stderr=subprocess.STDOUT)
    if done.returncode:
        with open(os.path.join(folder, "failed.log"), "w") as file:
            file.write(done.stdout)
        raise Failed(f"{os.path.basename(command[0])} ended with {done.returncode}, see {file.name}")
    return done.stdout


def last_line(text):
    lines = [line.strip() for line in text.splitlines() if re.search(r"\w", line)]
    return lines[-1] if lines else "it printed nothing"


def need(found, text):
    if not found:
        raise Failed(text)
    return found


def mpi(processes):
    """mpirun of Open MPI refuses root, and more processes than processors, unless told."""
    environment = {"OMP_NUM_THREADS": "1", "OMPI_MCA_rmaps_base_oversubscribe": "1"}
    if os.geteuid() == 0:
        environment |= {"OMPI_ALLOW_RUN_AS_ROOT": "1", "OMPI_ALLOW_RUN_AS_ROOT_CONFIRM": "1"}
    return ["mpirun", "-np", str(processes)], environment


class Program:
    """missing: why it cannot run here, or nothing; run: one run, which gives bonds, steps and seconds that were timed, and
    version; answer: the displacements of all elements over that run."""

    def __init__(self, options, folder):
        self.options, self.folder = options, folder

    def missing(self):
        return ""

    def clear(self):
        for name in ("positions.txt", "positions.dump", "count.txt"):
            if os.path.exists(os.path.join(self.folder, name)):
                os.remove(os.path.join(self.folder, name))

    def result(self, text):
        """Of a deck in Python: the numbers on its line 'result: {...}'."""
        line = re.search(r"^result: (.*)$", text, re.MULTILINE)
        return json.loads(need(line, "no result: " + last_line(text)).group(1))

    def positions(self):
        return np.loadtxt(os.path.join(self.folder, "positions.txt"))

    def answer(self, bar):
        return self.positions() - bar.position


class Beadwork(Program):
    name = "Beadwork"

    def fill(self):
        self.deck(os.path.join(CASE, "bar.xml"), "filling", 1, count=self.options.elements, steps=1)

    def deck(self, deck, name, threads, **values):
        out = os.path.join(self.options.out, name)
        settings = [word for key, value in values.items() for word in ("--set", f"{key}={value}")]
        shell([self.options.beadwork, "run", deck, "--out", out, "--overwrite", "--quiet", "--threads", str(threads)] + settings,
              self.options.out)
        return out

    def stored(self, deck, name, threads):
        packing = os.path.join(self.options.out, "filling", "run.h5")
        return self.deck(deck, name, threads, packing=packing, steps=self.options.steps)

    def record(self):
        """A run whose first and last frame are recorded: the bar for all, and Beadwork's answer."""
        with open(os.path.join(CASE, "stored.xml")) as file:
            text = file.read().replace("</watch>", '<snapshot at="0, ${steps}"/></watch>')
        deck = os.path.join(self.options.out, "recorded.xml")
        with open(deck, "w") as file:
            file.write(text)
        return self.stored(deck, "recorded", 1)

    def run(self, threads):
        out = self.stored(os.path.join(CASE, "stored.xml"), "beadwork", threads)
        with open(os.path.join(out, "summary.json")) as file:
            summary = json.load(file)
        return {"bonds": summary["bonds"]["beam"], "steps": summary["steps"], "seconds": summary["loop_seconds"],
                "version": summary["version"]}

    def positions(self):
        """Of the run that was recorded: runs that are timed record nothing, and give the same bits."""
        return inputs.last_positions(os.path.join(self.options.out, "recorded"))


class Lammps(Program):
    name = "LAMMPS"

    def missing(self):
        if not self.options.lammps:
            return "no lmp here; it needs the package BPM, of March 2023 or later (Debian 12's is older)"
        said = shell([self.options.lammps, "-h"], self.options.out)
        version = re.search(r"Simulator - (.*)", said)
        if "bpm/rotational" not in said:
            return f"{self.options.lammps} ({version.group(1) if version else '?'}) has no bond_style bpm/rotational"
        return "" if shutil.which("mpirun") else "no mpirun here"

    def run(self, threads):
        start, environment = mpi(threads)
        with open(os.path.join(self.folder, "scene.json")) as file:
            scene = json.load(file)
        values = {"steps": scene["steps"], "step": scene["time_step"], "rate": scene["rate"], "reach": 3 * scene["largest_radius"]}
        words = [word for key, value in values.items() for word in ("-var", key, repr(value))]
        said = shell(start + [self.options.lammps, "-in", os.path.join(HERE, "lammps.in"), "-log", "none"] + words,
                     self.folder, **environment)
        return self.read(said, threads)

    def read(self, said, threads):
        loop = need(re.search(r"Loop time of (\S+) on (\d+) procs for (\d+) steps", said), "no loop time: " + last_line(said))
        need(int(loop[2]) == threads, f"it ran on {loop[2]} processes instead of {threads}")
        bonds = need(re.search(r"^counted: (\d+) bonds", said, re.MULTILINE), "no number of bonds: " + last_line(said))
        return {"bonds": int(bonds[1]), "steps": int(loop[3]), "seconds": float(loop[1]),
                "version": re.search(r"LAMMPS \((.*?)\)", said)[1]}

    def positions(self):
        return np.loadtxt(os.path.join(self.folder, "positions.dump"), skiprows=9)[:, 1:]


class Yade(Program):
    name = "Yade"

    def missing(self):
        return "" if shutil.which("yade") else "no yade here; apt-get install yade"

    def run(self, threads):
        return self.result(shell(["yade", "-n", "-x", f"-j{threads}", os.path.join(HERE, "yade_bar.py")], self.folder))


class Esys(Program):
    name = "ESyS-Particle"
    at_rest = None

    def missing(self):
        return "" if shutil.which("esysparticle") and shutil.which("mpirun") else "no esysparticle here; apt-get install esys-particle"

    def run(self, threads, *more):
        """One process more than workers: it only tells them what to do, and must not keep them from a processor."""
        start, environment = mpi(threads + 1)
        environment |= {"OMPI_MCA_mpi_yield_when_idle": "1", "OMPI_MCA_hwloc_base_binding_policy": "none"}
        return self.result(shell(start + ["esysparticle", os.path.join(HERE, "esys_bar.py"), str(threads), *more],
                                 self.folder, **environment))

    def answer(self, bar):
        """Bonds over a gap are stretched from the start here: what they do by themselves is taken off."""
        moving = self.positions()
        if self.at_rest is None:
            self.run(1, "still")
            self.at_rest = self.positions()
        return moving - self.at_rest


def prepare(beadwork):
    """Fills the bar, records it, and writes it for the others."""
    say(f"filling with {beadwork.options.elements} elements")
    beadwork.fill()
    bar = inputs.Bar(beadwork.record())
    inputs.write_all(bar, beadwork.folder)
    return bar


def elastic(bar, answer):
    """Displacements less those of a bar whose elements fly on freely."""
    free = np.zeros_like(answer)
    free[:, 2] = np.where(bar.held, 0, bar.rate * bar.position[:, 0] * bar.time_step * bar.steps)
    return answer - free


def tip(bar, answer):
    """Mean displacement along z of the elements in the last fiftieth of the length."""
    x = bar.position[:, 0]
    return answer[x > 0.98 * x.max(), 2].mean()


def measure(row, bar, reference):
    """One run more: its rate, and how far its answer is from Beadwork's."""
    program = row["program"]
    program.clear()
    done = program.run(row["threads"])
    answer = program.answer(bar)
    own, other = elastic(bar, reference), elastic(bar, answer)
    row["rates"].append(done["bonds"] * done["steps"] / done["seconds"])
    row["differences"].append(float(np.linalg.norm(other - own) / np.linalg.norm(own)))
    row |= {"bonds": done["bonds"], "version": done["version"], "tip": tip(bar, answer)}


def rows_of(programs, threads):
    """A row of the table for each program that can run here and each number of threads; and why the others have none."""
    rows, left_out = [], {}
    for program in programs:
        reason = program.missing()
        if reason:
            left_out[program.name] = "not run: " + reason
        else:
            rows += [{"program": program, "threads": n, "rates": [], "differences": []} for n in threads]
    return rows, left_out


def measure_all(rows, left_out, repeats, bar, reference):
    """Programs take turns, so that a slow hour of the machine meets all of them. Gives the rows of those that did not fail."""
    for repeat in range(repeats):
        for row in rows:
            name = row["program"].name
            if name in left_out:
                continue
            say(f"{name}, {row['threads']} threads, {repeat + 1} of {repeats}")
            try:
                measure(row, bar, reference)
            except Failed as failure:
                if name == "Beadwork":
                    raise
                left_out[name] = f"failed: {failure}"
    return [row for row in rows if row["program"].name not in left_out]


def say(text):
    print(text, file=sys.stderr, flush=True)


def table(bar, rows, left_out):
    print(f"{len(bar.radius)} elements, {len(bar.ends)} bonds, {bar.steps} steps of {bar.time_step * 1e9:.4g} ns; "
          "million bond updates per second")
    print(f"{'program':<32}{'threads':>8}{'median':>9}{'lowest':>9}{'highest':>9}{'Beadwork is':>13}{'bonds':>9}{'tip [um]':>11}{'differs by':>12}")
    own = {row["threads"]: statistics.median(row["rates"]) for row in rows if row["program"].name == "Beadwork"}
    for row in rows:
        rates = [rate / 1e6 for rate in row["rates"]]
        ratio = own[row["threads"]] / statistics.median(row["rates"])
        print(f"{row['program'].name + ' ' + row['version']:<32}{row['threads']:>8}{statistics.median(rates):>9.2f}{min(rates):>9.2f}"
              f"{max(rates):>9.2f}{ratio:>7.2f} times{row['bonds']:>9}{row['tip'] * 1e6:>11.4f}{100 * max(row['differences']):>10.2f} %")
    for name, reason in left_out.items():
        print(f"{name:<32}{reason}")


def keep(rows, left_out, out):
    with open(os.path.join(out, "results.json"), "w") as file:
        json.dump({"rows": [row | {"program": row["program"].name} for row in rows], "left out": left_out}, file, indent=2)


def faults(bar, rows, left_out):
    """What must not be: a program that failed, other bonds, another answer."""
    found = [f"{name} {reason}" for name, reason in left_out.items() if reason.startswith("failed")]
    for row in rows:
        name = f"{row['program'].name} with {row['threads']} threads"
        if row["bonds"] != len(bar.ends):
            found.append(f"{name} has {row['bonds']} bonds instead of {len(bar.ends)}")
        if not max(row["differences"]) < LARGEST_DIFFERENCE:
            found.append(f"{name} gives another answer, {100 * max(row['differences']):.2g} % off")
    return found


def program_file(name):
    """Of a name or path of a program; nothing if there is none."""
    found = shutil.which(name)
    return os.path.abspath(found) if found else None


def read_options():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    own = os.path.join(HERE, "..", "..", "build", "release", "bin", "beadwork")
    others = ["lammps", "yade", "esys-particle"]
    parser.add_argument("--elements", type=int, default=40000)
    parser.add_argument("--steps", type=int, default=500)
    parser.add_argument("--repeats", type=int, default=5)
    parser.add_argument("--threads", type=int, nargs="+", default=[1, 2], help="numbers of threads, or of processes where there are no threads")
    parser.add_argument("--only", nargs="+", choices=others, default=others, help="the programs beside Beadwork")
    parser.add_argument("--beadwork", default=own if os.path.exists(own) else "beadwork")
    parser.add_argument("--lammps", default="lmp")
    parser.add_argument("--out", default="out/peers")
    options = parser.parse_args()
    if options.steps < 10:
        parser.error("--steps must be 10 or more")
    options.beadwork, options.lammps = program_file(options.beadwork), program_file(options.lammps)
    if not options.beadwork:
        parser.error("no beadwork; tools/build.sh makes one, or say --beadwork PATH")
    options.out = os.path.abspath(options.out)
    return options


def main():
    options = read_options()
    folder = os.path.join(options.out, "bar")
    os.makedirs(folder, exist_ok=True)
    others = [kind for kind in (Lammps, Yade, Esys) if kind.name.lower() in options.only]
    say(f"load of the machine: {os.getloadavg()[0]:.1f} on {os.cpu_count()} processors")
    beadwork = Beadwork(options, folder)
    bar = prepare(beadwork)
    rows, left_out = rows_of([beadwork] + [kind(options, folder) for kind in others], options.threads)
    rows = measure_all(rows, left_out, options.repeats, bar, beadwork.answer(bar))
    table(bar, rows, left_out)
    keep(rows, left_out, options.out)
    found = faults(bar, rows, left_out)
    for fault in found:
        say("compare: " + fault)
    return 1 if found else 0


if __name__ == "__main__":
    try:
        sys.exit(main())
    except Failed as failure:
        sys.exit(f"compare: {failure}")
