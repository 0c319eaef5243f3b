#!/usr/bin/python3
"""Damages a run in hundreds of ways, each in a folder of its own, and has all read.   Usage: corpus.py DAMAGED

The damage is the same each time: numbers are drawn from one seed."""
import json
import os
import random
import shutil
import struct
import subprocess
import sys
import tempfile
from pathlib import Path

import h5py
import numpy as np

draw = random.Random(20)
MARK = b"\nbeadwork check sum "
TRAILER = len(MARK) + 17


def check_sum(data):
    """That of core/io/check_sum.cpp, so that a damaged checkpoint is believed to be whole."""
    mask, prime = (1 << 64) - 1, 0x9E3779B97F4A7C15

    def add(total, word):
        total = ((total ^ word) * prime) & mask
        return total ^ (total >> 29)

    padded = data + bytes(32 - len(data) % 32)
    words = struct.unpack(f"<{len(padded) // 8}Q", padded)
    lanes = [1, 2, 3, 4]
    for k in range(4):
        for word in words[k::4]:
            lanes[k] = add(lanes[k], word)
    total = len(data)
    for lane in lanes:
        total = add(total, lane)
    return total


def edit_checkpoint(path, change):
    """Changes a checkpoint through h5py, and gives it a check sum that fits."""
    path.write_bytes(path.read_bytes()[:-TRAILER])
    with h5py.File(path, "r+") as root:
        change(root)
    data = path.read_bytes()
    path.write_bytes(data + MARK + b"%016x\n" % check_sum(data))


class Corpus:
    def __init__(self, out, seeds):
        self.out, self.seeds, self.cases = out, seeds, []

    def case(self, kind, seed, name):
        """A new folder, to be damaged."""
        folder = self.out / f"{kind}-{len(self.cases):03}-{name.replace('/', '_').strip('_')}"
        shutil.copytree(self.seeds / seed, folder, symlinks=True)
        self.cases.append(folder)
        return folder

    def edit(self, kind, seed, file, name, change):
        """Damages one HDF5 file through h5py."""
        path = self.case(kind, seed, name) / file
        if file == "checkpoint.h5":
            return edit_checkpoint(path, change)
        with h5py.File(path, "r+") as root:
            change(root)


def attribute_values():
    texts = h5py.string_dtype()
    return {
        "array": np.arange(1000.0), "numbers": np.arange(7), "text": np.bytes_("x"), "long-text": np.bytes_("y" * 60000), "real": 0.5,
        "huge": np.int64(2**62), "nothing": h5py.Empty("f8"), "variable": np.array("free", dtype=texts), "pair": np.array((1, 2.0), dtype=[("a", "i4"), ("b", "f8")]),
        "many-texts": np.array([b"a", b"b"] * 50), "none": np.zeros((0,)),
    }


def objects_of(file):
    """Names of all objects of a file, of attributes of each, and which are datasets."""
    with h5py.File(file, "r") as root:
        found = [("/", sorted(root.attrs), False)]

        def note(name, item):
            found.append((name, sorted(item.attrs), isinstance(item, h5py.Dataset)))

        root.visititems(note)
    return found


def damage_attributes(corpus, seed, file, count):
    values = attribute_values()
    places = [(name, attribute) for name, attributes, _ in objects_of(corpus.seeds / seed / file) for attribute in attributes]
    for name, attribute in draw.sample(places, min(count, len(places))):
        for kind in draw.sample(sorted(values), 2):

            def change(root, name=name, attribute=attribute, kind=kind):
                del root[name].attrs[attribute]
                root[name].attrs[attribute] = values[kind]

            corpus.edit("any", seed, file, f"{file}-{name}.{attribute}-{kind}", change)


def replacements(root, name):
    """What else may stand in the place of a dataset."""
    data = root[name][()]
    shape = root[name].shape
    rows = shape[0] if shape else 0

    def huge(place):
        place.create_dataset(name, shape=(2**40,), dtype="f8", chunks=(1024,))

    def huge_contiguous(place):
        place.create_dataset(name, shape=(2**40,), dtype="f8")

    def outside(place):
        place.create_dataset(name, shape=(64,), dtype="u1", external=[("/etc/passwd", 0, 64)])

    def virtual(place):
        layout = h5py.VirtualLayout(shape=(8,), dtype="f8")
        layout[:] = h5py.VirtualSource("/etc/passwd", "x", shape=(8,))
        place.create_virtual_dataset(name, layout)

    def put(value):
        return lambda place: place.create_dataset(name, data=value)

    def link(value):
        return lambda place: place.__setitem__(name, value)

    changes = {
        "text": put(np.bytes_("word")), "variable": put(np.array(["free", "text"], dtype=h5py.string_dtype())), "cube": put(np.zeros((3, 3, 3))),
        "scalar": put(1.5), "nothing": put(h5py.Empty("f8")), "pair": put(np.zeros(4, dtype=[("a", "i4"), ("b", "f8")])), "huge": huge,
        "huge-contiguous": huge_contiguous, "outside": outside, "virtual": virtual, "soft-link": link(h5py.SoftLink("/meta")),
        "self-link": link(h5py.SoftLink("/" + name)), "elsewhere": link(h5py.ExternalLink("/etc/passwd", "/")), "group": lambda place: place.create_group(name),
        "gone": lambda place: None, "odd-integers": put(np.zeros(rows, dtype="u8")), "half": put(np.zeros(shape or (1,), dtype="f2")),
    }
    if rows > 0:
        changes["longer"] = put(np.concatenate([data, data]))
        changes["shorter"] = put(data[:-1])
        changes["flat"] = put(np.zeros(int(np.prod(shape))))
    return changes


def damage_datasets(corpus, seed, file, count, each=2):
    names = [name for name, _, dataset in objects_of(corpus.seeds / seed / file) if dataset]
    with h5py.File(corpus.seeds / seed / file, "r") as root:
        kinds = {name: replacements(root, name) for name in names}
    for name in draw.sample(names, min(count, len(names))):
        for kind in draw.sample(sorted(kinds[name]), each):

            def change(root, name=name, kind=kind):
                attributes = dict(root[name].attrs)
                del root[name]
                kinds[name][kind](root)
                if root.get(name, getclass=True, getlink=True) is h5py.HardLink and isinstance(root[name], h5py.Dataset):
                    for key, value in attributes.items():
                        root[name].attrs[key] = value

            corpus.edit("any", seed, file, f"{file}-{name}-{kind}", change)


def damage_groups(corpus, seed, file):
    for name, _, dataset in objects_of(corpus.seeds / seed / file):
        if dataset or name == "/":
            continue

        def dataset_instead(root, name=name):
            del root[name]
            root[name] = np.arange(5)

        def circle(root, name=name):
            del root[name]
            root[name] = root["/"]

        def gone(root, name=name):
            del root[name]

        change = draw.choice([dataset_instead, circle, gone])
        corpus.edit("any", seed, file, f"{file}-{name}-{change.__name__}", change)


def numbers_out_of_range(corpus):
    """What follows a number to a row, a name or a stage: each must be refused."""

    def element(name, row, value):
        def change(root):
            data = root[name][()]
            data[row] = value
            root[name][...] = data

        return change

    def attribute(place, name, value):
        def change(root):
            root[place].attrs[name] = value

        return change

    changes = {
        "set-beyond": element("sets/left", 3, 120), "set-negative": element("sets/right", 0, -1), "set-far": element("sets/left", 0, 2**31 - 1),
        "first-beyond": element("bonds/resin/first", 5, 120), "second-negative": element("bonds/interface/second", 2, -7),
        "bond-id-beyond": element("bonds/resin/id", 1, 100000), "bond-id-twice": element("bonds/resin/id", 1, 2), "element-id-twice": element("elements/id", 1, 2),
        "element-id-negative": element("elements/id", 0, -1), "state": element("bonds/resin/state", 4, 7), "mode": element("breaks/indices", (0, 2), 9),
        "mode-negative": element("breaks/indices", (1, 2), -1), "family": element("breaks/indices", (0, 0), 5), "broken-bond": element("breaks/indices", (0, 1), 10**6),
        "rows-huge": attribute("elements", "rows", np.int64(2**40)), "rows-many": attribute("elements", "rows", np.int64(2**26)), "rows-negative": attribute("bonds/resin", "rows", np.int64(-1)),
        "rows-few": attribute("bonds/interface", "rows", np.int64(3)), "stage": attribute("meta", "stage", np.int64(7)), "stage-negative": attribute("meta", "stage", np.int64(-1)),
        "stage-huge": attribute("meta", "stage", np.int64(2**40)), "step": attribute("meta", "step", np.int64(-5)), "time": attribute("meta", "time", float("nan")),
        "format": attribute("meta", "format", np.int64(99)), "breaks-short": lambda root: (root.__delitem__("breaks/reals"), root.create_dataset("breaks/reals", data=np.zeros((1, 5)))),
    }
    for name, change in changes.items():
        corpus.edit("refuse", "finished", "checkpoint.h5", name, change)


def cut_and_flipped(corpus):
    for seed, file, cuts, flips in (("finished", "checkpoint.h5", 6, 6), ("finished", "run.h5", 14, 60), ("going-on", "run.h5", 8, 30), ("going-on", "frames/000000000000.h5", 10, 40),
                                    ("finished", "curves/force.csv", 4, 8), ("finished", "summary.json", 4, 12), ("going-on", "run.files", 4, 12)):
        size = (corpus.seeds / seed / file).stat().st_size
        kind = "refuse" if file == "checkpoint.h5" else "any"
        for _ in range(cuts):
            os.truncate(corpus.case(kind, seed, f"{file}-cut") / file, draw.randrange(size))
        for _ in range(flips):
            path = corpus.case(kind, seed, f"{file}-flipped") / file
            data = bytearray(path.read_bytes())
            for _ in range(draw.choice([1, 1, 8])):
                data[draw.randrange(size)] ^= 1 << draw.randrange(8)
            path.write_bytes(data)


def odd_texts(corpus):
    """JSON deeper than any stack, and numbers that are none, in whatever a report reads."""
    for file in ("summary.json", "curves/force.json"):
        (corpus.case("draw", "finished", f"{file}-deep") / file).write_text("[" * 3000000)
        (corpus.case("draw", "finished", f"{file}-deep-closed") / file).write_text('{"energy":' * 300000 + "1" + "}" * 300000)
    odd = {"status": 3, "name": [1], "energy": 5, "breaks": {"shear": "many"}, "packing": {"a": [{"edges": "x", "counts": []}]}, "bonds": {"resin": {"x": []}}, "notes": [1], "time_step": "x"}
    (corpus.case("draw", "finished", "odd-summary") / "summary.json").write_text(json.dumps(odd))
    rows = "step [1],time [s],force [N]\n0,0,1\n10,nan,2\n20,2e-6,inf\n30,3e-6,-1e308\n40,1e999,1e308\n50,5e-6,1e-999\n60,6e-6,3\n"
    (corpus.case("draw", "finished", "odd-curve") / "curves/force.csv").write_text(rows)
    (corpus.case("draw", "finished", "odd-ledger") / "curves/energy.csv").write_text(rows.replace("force [N]", "work [J]"))
    (corpus.case("draw", "finished", "one-odd-number") / "curves/force.csv").write_text("step [1],time [s],force [N]\n0,nan,nan\n")


def odd_numbers(corpus):
    for name, value in (("nan", np.nan), ("infinite", np.inf), ("large", 1e308), ("far", 1e6), ("negative", -1.0), ("zero", 0.0)):
        for field in ("position", "radius"):

            def change(root, field=field, value=value):
                for frame in root["frames"].values():
                    data = frame[f"elements/{field}"][()]
                    data[3] = value
                    frame[f"elements/{field}"][...] = data

            corpus.edit("draw" if field == "position" else "any", "finished", "run.h5", f"{field}-{name}", change)

        def all_of_them(root, value=value):
            root["frames/000000000000"].attrs["time"] = value
            root["frames/000000000000/elements/position"][...] = value
            root["breaks/time"][...] = value
            root["breaks/energy"][...] = value

        corpus.edit("any", "finished", "run.h5", f"all-{name}", all_of_them)


def links_and_pipes(corpus):
    for file in ("run.h5", "summary.json", "run.log", "resolved.xml", "checkpoint.h5", "curves/force.csv", "curves/force.json", "frames/000000000000.h5", "run.files",
                 "report.html.part", "run.h5.part", "curves", "frames"):
        for kind in ("link", "pipe", "folder"):
            folder = corpus.case("any", "going-on", f"{file}-{kind}")
            path = folder / file
            if path.is_dir():
                shutil.rmtree(path)
            path.unlink(missing_ok=True)
            if kind == "link":
                path.symlink_to(corpus.seeds / "going-on" / (file if (corpus.seeds / "going-on" / file).exists() else "run.log"))
            elif kind == "pipe":
                os.mkfifo(path)
            else:
                path.mkdir()


def main():
    damaged = Path(sys.argv[1]).resolve()
    with tempfile.TemporaryDirectory() as folder:
        seeds = Path(folder) / "seeds"
        subprocess.run([damaged, "make", seeds], check=True)
        corpus = Corpus(Path(folder) / "corpus", seeds)
        damage_attributes(corpus, "finished", "checkpoint.h5", 40)
        damage_attributes(corpus, "finished", "run.h5", 30)
        damage_attributes(corpus, "going-on", "frames/000000000000.h5", 12)
        damage_datasets(corpus, "finished", "checkpoint.h5", 30)
        damage_datasets(corpus, "finished", "run.h5", 30)
        damage_datasets(corpus, "going-on", "frames/000000000000.h5", 8)
        damage_groups(corpus, "finished", "checkpoint.h5")
        damage_groups(corpus, "finished", "run.h5")
        numbers_out_of_range(corpus)
        cut_and_flipped(corpus)
        odd_texts(corpus)
        odd_numbers(corpus)
        links_and_pipes(corpus)
        before = {path: path.read_bytes() for path in seeds.rglob("*") if path.is_file()}
        options = {"ASAN_OPTIONS": "detect_leaks=0:allocator_may_return_null=0:max_allocation_size_mb=2000", "UBSAN_OPTIONS": "halt_on_error=1:print_stacktrace=1"}
        done = subprocess.run([damaged, "read", *corpus.cases], env={**os.environ, **options}, stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True, errors="replace", timeout=500, check=False)
        assert before == {path: path.read_bytes() for path in seeds.rglob("*") if path.is_file()}, "what a link pointed to was written to"
    lines = done.stdout.splitlines()
    print(f"{len(corpus.cases)} damaged runs")
    if done.returncode != 0:
        wrong = [k for k, line in enumerate(lines) if line.startswith("WRONG")]
        print("\n".join("\n".join(lines[max(0, k - 5):k + 1]) for k in wrong) or "\n".join(lines[-60:]))
    return done.returncode


if __name__ == "__main__":
    sys.exit(main())
