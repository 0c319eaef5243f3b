"""What was exported reads in other programs' readers as what run.h5 holds.   Usage: export.py RUN VTU XYZ CSV"""
import csv
import sys
import xml.etree.ElementTree
from pathlib import Path

import h5py
import meshio
import numpy

run, vtu, xyz, table = map(Path, sys.argv[1:])
record = h5py.File(run / "run.h5")
steps = list(record["frames"])
assert len(steps) > 3
seen_broken = False

for step in steps:
    frame = record[f"frames/{step}"]
    elements = {name: frame[f"elements/{name}"][:] for name in frame["elements"]}
    families = {name: {column: family[column][:] for column in family} for name, family in frame["bonds"].items()}

    # VTU, by meshio
    mesh = meshio.read(vtu / f"elements-{step}.vtu")
    numpy.testing.assert_array_equal(mesh.points, elements["position"])
    numpy.testing.assert_array_equal(numpy.ravel(mesh.point_data["id"]), elements["id"])
    numpy.testing.assert_array_equal(numpy.ravel(mesh.point_data["radius [m]"]), elements["radius"])
    numpy.testing.assert_array_equal(mesh.point_data["orientation"], elements["orientation"])
    numpy.testing.assert_array_equal(mesh.point_data["virial [Pa]"], elements["virial"][:, [0, 3, 5, 1, 4, 2]])
    for name, family in families.items():
        if len(family["ends"]) == 0:
            continue  # contacts that are none yet: meshio wants a cell
        mesh = meshio.read(vtu / f"bonds-{name}-{step}.vtu")
        assert mesh.cells[0].type == "line"
        numpy.testing.assert_array_equal(mesh.cells[0].data, family["ends"])
        numpy.testing.assert_array_equal(numpy.ravel(mesh.cell_data["state"][0]), family["state"])
        if "axial-force" in family:
            numpy.testing.assert_array_equal(numpy.ravel(mesh.cell_data["axial-force [N]"][0]), family["axial-force"])
        seen_broken |= bool((family["state"] == 2).any())
    walls = meshio.read(vtu / f"walls-{step}.vtu")
    numpy.testing.assert_array_equal(walls.points.reshape(-1, 6), frame["walls"][:])

    # XYZ, in mm
    lines = (xyz / f"elements-{step}.xyz").read_text().splitlines()
    assert int(lines[0]) == len(elements["id"]) == len(lines) - 2
    assert 'length_unit="mm"' in lines[1] and "displacement:R:3" in lines[1]
    rows = numpy.array([line.split()[1:] for line in lines[2:]], dtype=float)
    numpy.testing.assert_allclose(rows[:, :3], 1e3 * elements["position"], rtol=1e-15)
    numpy.testing.assert_array_equal(rows[:, 3], elements["id"])
    numpy.testing.assert_allclose(rows[:, 4], 1e3 * elements["radius"], rtol=1e-15)
    try:
        import ase.io
    except ImportError:
        ase = None
    if ase:
        atoms = ase.io.read(xyz / f"elements-{step}.xyz")
        numpy.testing.assert_allclose(atoms.positions, 1e3 * elements["position"], rtol=1e-15)
        numpy.testing.assert_allclose(atoms.arrays["displacement"], 1e3 * elements["displacement"], rtol=1e-15)
    dump = (xyz / f"bonds-{step}.dump").read_text().splitlines()
    assert dump[0] == "ITEM: TIMESTEP" and int(dump[1]) == int(step)
    head = dump[8].split()[2:]
    bonds = [dict(zip(head, line.split(), strict=True)) for line in dump[9:]]
    assert len(bonds) == int(dump[3]) == sum(len(family["ends"]) for family in families.values())
    thin = next(bond for bond in bonds if bond["family"] == str(1 + list(families).index("thin")))
    assert [int(thin["element-1"]), int(thin["element-2"])] == list(elements["id"][families["thin"]["ends"][0]])
    assert int(thin["state"]) == families["thin"]["state"][0]

    # CSV
    with open(table / f"elements-{step}.csv", newline="", encoding="utf-8") as file:
        rows = list(csv.DictReader(file))
    assert [float(row["position-x [m]"]) for row in rows] == list(elements["position"][:, 0])
    assert [float(row["virial-xz [Pa]"]) for row in rows] == list(elements["virial"][:, 2])
    with open(table / f"bonds-thick-{step}.csv", newline="", encoding="utf-8") as file:
        (row,) = csv.DictReader(file)
    assert float(row["axial-force [N]"]) == families["thick"]["axial-force"][0]
    assert int(row["element-2 [1]"]) == elements["id"][families["thick"]["ends"][0][1]]

assert seen_broken
with open(table / "breaks.csv", newline="", encoding="utf-8") as file:
    (row,) = csv.DictReader(file)
assert (row["family"], row["mode"], row["bond [1]"]) == ("thin", "axial", "0"), row
assert float(row["time [s]"]) == record["breaks/time"][0] and float(row["place-x [m]"]) == record["breaks/place"][0][0]

series = xml.etree.ElementTree.parse(vtu / "elements.pvd").findall(".//DataSet")
assert [each.get("file") for each in series] == [f"elements-{step}.vtu" for step in steps]
assert [float(each.get("timestep")) for each in series] == [record[f"frames/{step}"].attrs["time"] for step in steps]
