"""Usage: damaged.py RUN went-on STEPS | older | odd-states

went-on: the run went on with a new record, and its summary says so, also after going on once more.
older: the checkpoint now says that another version wrote it.
odd-states: a checkpoint whose check sum fits and whose numbers do not is refused, and all is left as it was."""
import json
import subprocess
import sys
from pathlib import Path

import h5py
import numpy as np

sys.dont_write_bytecode = True
sys.path.append(str(Path(__file__).parents[2] / "damaged"))
from corpus import edit_checkpoint

run = Path(sys.argv[1])


def went_on():
    summary = json.loads((run / "summary.json").read_text())
    assert summary["status"] == "done" and summary["steps"] == int(sys.argv[3]), summary
    assert "run.h5 is damaged" in summary["notes"][0], summary["notes"]
    with h5py.File(run / "run.h5") as file:
        assert list(file["frames"])[-1] == f"{int(sys.argv[3]):012}" and "000000000000" not in file["frames"], list(file["frames"])


def older():
    edit_checkpoint(run / "checkpoint.h5", lambda root: root["meta"].attrs.__setitem__("version", np.bytes_("0.0.9")))


def files():
    return {file: file.read_bytes() for file in run.rglob("*") if file.is_file() and file.name != "run.log"}


def odd_states():
    whole = (run / "checkpoint.h5").read_bytes()
    numbers = (-1.0, 1e300, float("nan"))
    odd = [("scene", "looks-owed", value) for value in numbers] + [("meta", "time-step", float(value)) for value in ("nan", "inf")]
    odd += [("meta", "stage-step", step) for step in (-1, 10**6)] + [("meta", "stage-start", float("nan"))]
    texts = [("texts", name, "[" * 100000) for name in ("packing", "files")]
    for group, name, value in [*odd, *texts, ("meta", "stage", 1), ("meta", "stage", 2**31 - 1)]:

        def change(root, group=group, name=name, value=value):
            if group == "meta":
                root[group].attrs[name] = value
            elif group == "texts":
                place = f"meta/value-{[key.decode() for key in root['meta/keys'][()]].index(name)}"
                del root[place]
                root[place] = np.bytes_(value)
            else:
                root[group][name][...] = value

        (run / "checkpoint.h5").write_bytes(whole)
        edit_checkpoint(run / "checkpoint.h5", change)
        before = files()
        done = subprocess.run(["beadwork", "run", "-q", "others.xml", "--out", run, "--threads", "1", "--resume", "--set", "end=400"], stderr=subprocess.PIPE, text=True, check=False)
        assert done.returncode == 1 and "checkpoint" in done.stderr, (name, done.returncode, done.stderr)
        assert files() == before, name


{"went-on": went_on, "older": older, "odd-states": odd_states}[sys.argv[2]]()
