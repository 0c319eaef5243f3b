#!/usr/bin/env python3
"""Opens the record of a run in ParaView itself and compares what ParaView sees with what the file holds.

    tools/check-paraview.py RUN-FOLDER          (needs Debian's packages paraview and python3-paraview)

Prints blocks, points, cells, arrays and ranges for each time; ends with 1 if anything differs. What the file holds is
read with h5py where that is installed; otherwise extents are compared with run.xmf, and ranges are only printed.
"""
import os
import sys

try:
    from paraview import servermanager, simple
except ImportError:
    if os.environ.get("BEADWORK_IN_PVPYTHON"):
        sys.exit("check-paraview: this pvpython has no module 'paraview'")
    os.environ["BEADWORK_IN_PVPYTHON"] = "1"
    try:
        os.execvp("pvpython", ["pvpython", "--force-offscreen-rendering", os.path.abspath(__file__)] + sys.argv[1:])
    except FileNotFoundError:
        sys.exit("check-paraview: no ParaView here; apt-get install paraview python3-paraview")

from vtkmodules.vtkCommonDataModel import vtkCompositeDataSet

try:
    import h5py
except ImportError:
    h5py = None

faults = []


# ParaView makes nine components of a symmetric tensor's six: xx xy xz yy yz zz.
NINE_OF_SIX = [0, 1, 2, 1, 3, 4, 2, 4, 5]


def expect(same, text):
    if not same:
        faults.append(text)
        print("  DIFFERS: " + text)


class Expected:
    """The frames of a run: (time, {block: (points, cells, {array: (width, range of each component)})})."""

    def __init__(self, folder):
        if h5py:
            with h5py.File(os.path.join(folder, "run.h5"), "r") as record:
                frames = sorted(record["frames"].values(), key=lambda frame: frame.attrs["step"])
                self.frames = [(frame.attrs["time"], self.blocks(frame)) for frame in frames]
        else:
            self.frames = self.from_view(os.path.join(folder, "run.xmf"))

    @staticmethod
    def arrays(group, skip):
        found = {}
        for name, data in group.items():
            if name == skip:
                continue
            numbers = data[()].reshape(len(data), -1)
            if numbers.shape[1] == 6:
                numbers = numbers[:, NINE_OF_SIX]
            found[name] = (numbers.shape[1], [(float(c.min()), float(c.max())) for c in numbers.T])
        return found

    def blocks(self, frame):
        count = len(frame["elements/position"])
        blocks = {"elements": (count, count, self.arrays(frame["elements"], "position"))} if count else {}
        for family, group in frame.get("bonds", {}).items():
            if len(group["ends"]):
                blocks["bonds " + family] = (count, len(group["ends"]), self.arrays(group, "ends"))
        return blocks

    @staticmethod
    def from_view(view):
        import xml.etree.ElementTree as xml

        def extent(item):
            return [int(n) for n in item.find("DataItem").get("Dimensions").split()]

        frames = {}
        for grid in xml.parse(view).getroot().iterfind("Domain/Grid/Grid"):
            widths = {a.get("Name"): (extent(a) + [1])[1] for a in grid.iterfind("Attribute")}
            arrays = {name: (9 if width == 6 else width, None) for name, width in widths.items()}
            points = extent(grid.find("Geometry"))[0]
            cells = int(grid.find("Topology").get("NumberOfElements"))
            frames.setdefault(float(grid.find("Time").get("Value")), {})[grid.get("Name")] = (points, cells, arrays)
        return sorted(frames.items())


def close(a, b):
    return all(abs(x - y) <= 1e-6 * max(abs(x), abs(y), 1e-300) for x, y in zip(a, b))


def check_arrays(block, data, expected):
    name = block.split()[0]
    attributes = data.GetPointData() if name == "elements" else data.GetCellData()
    seen = {attributes.GetArrayName(i): attributes.GetArray(i) for i in range(attributes.GetNumberOfArrays())}
    expect(set(seen) == set(expected), f"{block}: arrays {sorted(seen)} in ParaView, {sorted(expected)} in the file")
    for array in sorted(set(seen) & set(expected)):
        width, ranges = expected[array]
        got = seen[array]
        shown = [got.GetRange(c) for c in range(got.GetNumberOfComponents())]
        print(f"    {array}: {got.GetNumberOfComponents()} x {got.GetNumberOfTuples()}, " +
              ", ".join(f"{low:.6g} .. {high:.6g}" for low, high in shown))
        expect(got.GetNumberOfComponents() == width, f"{block}/{array}: {got.GetNumberOfComponents()} components, not {width}")
        if ranges and width == got.GetNumberOfComponents():
            for c in range(width):
                expect(close(shown[c], ranges[c]), f"{block}/{array}[{c}]: range {shown[c]}, not {ranges[c]}")


def check_block(block, data, expected):
    points, cells, arrays = expected
    print(f"  {block}: {data.GetNumberOfPoints()} points, {data.GetNumberOfCells()} cells")
    expect(data.GetNumberOfPoints() == points, f"{block}: {data.GetNumberOfPoints()} points, not {points}")
    expect(data.GetNumberOfCells() == cells, f"{block}: {data.GetNumberOfCells()} cells, not {cells}")
    kinds = {data.GetCell(i).GetClassName() for i in {0, data.GetNumberOfCells() - 1} if data.GetNumberOfCells()}
    wanted = {"vtkVertex", "vtkPolyVertex"} if block == "elements" else {"vtkLine", "vtkPolyLine"}
    expect(kinds <= wanted, f"{block}: cells are {kinds}")
    check_arrays(block, data, arrays)


def blocks_of(output):
    found = {}
    for i in range(output.GetNumberOfBlocks()):
        if output.GetBlock(i) is not None:
            found[output.GetMetaData(i).Get(vtkCompositeDataSet.NAME())] = output.GetBlock(i)
    return found


def main():
    if len(sys.argv) != 2:
        sys.exit(__doc__)
    folder = sys.argv[1]
    expected = Expected(folder).frames
    print("ParaView", simple.GetParaViewVersion(), "against h5py" if h5py else "against run.xmf (no h5py)")
    reader = simple.XDMFReader(FileNames=[os.path.join(folder, "run.xmf")])
    reader.UpdatePipelineInformation()
    times = list(reader.TimestepValues)
    expect(len(times) == len(expected) and close(times, [time for time, _ in expected]),
           f"times {times} in ParaView, {[time for time, _ in expected]} in the file")
    for time, blocks in expected:
        print(f"time {time:.9g} s")
        reader.UpdatePipeline(time)
        seen = blocks_of(servermanager.Fetch(reader))
        expect(set(seen) == set(blocks), f"blocks {sorted(seen)} in ParaView, {sorted(blocks)} in the file")
        for block in sorted(set(seen) & set(blocks)):
            check_block(block, seen[block], blocks[block])
    print(f"{len(faults)} differences" if faults else f"ParaView sees {len(expected)} frames as they are in the file")
    return 1 if faults else 0


if __name__ == "__main__":
    sys.exit(main())
