"""Whether two runs left the same: the resolved deck, every curve, every number of every frame, and the state at the end."""
import h5py
import numpy

WALL_CLOCK = {"loop-seconds", "wall-seconds"}  # told, not computed


def numbers(group, file):
    """Every dataset in a group, by its name."""
    found = {}
    file[group].visititems(lambda name, item: found.setdefault(name, numpy.asarray(item[()])) if isinstance(item, h5py.Dataset) else None)
    return found


def differences_of_groups(one, other, file, group):
    with h5py.File(one / file) as a, h5py.File(other / file) as b:
        if (group in a) != (group in b):
            return [f"{group} in one {file} only"]
        left, right = (numbers(group, each) if group in each else {} for each in (a, b))
    odd = [f"{group}/{name} in one {file} only" for name in left.keys() ^ right.keys()]
    same = left.keys() & right.keys() - {name for name in left if name.split("/")[-1] in WALL_CLOCK}
    return odd + [f"{file}: {group}/{name} differs" for name in sorted(same) if left[name].tobytes() != right[name].tobytes()]


def differences(one, other):
    """In words; nothing where the runs left the same."""
    found = []
    names = [{file.name for file in (folder / "curves").glob("*.csv")} for folder in (one, other)]
    found += [f"curves/{name} in one run only" for name in names[0] ^ names[1]]
    for name in ["resolved.xml", *(f"curves/{name}" for name in sorted(names[0] & names[1]))]:
        if (one / name).read_bytes() != (other / name).read_bytes():
            found.append(f"{name} differs")
    for file, group in (("run.h5", "frames"), ("run.h5", "breaks"), ("run.h5", "sets"), ("checkpoint.h5", "elements"),
                        ("checkpoint.h5", "bonds"), ("checkpoint.h5", "scene"), ("checkpoint.h5", "lists")):
        found += differences_of_groups(one, other, file, group)
    return found
